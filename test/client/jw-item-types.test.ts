/**
 * The compiler and the parser read the same texts of a Sharp JW. One table, read by both: `tsc` compares the second column with
 * `JwItemValue`, the tests with what bytes of zeros are as such an item.
 */
import { expect, test } from '@jest/globals'
import type { ReadValue, WriteValue } from '../../src/client/item/item-value'
import type { Item } from '../../src/client/item/parts'
import { parseJwItem } from '../../src/client/jw/item'
import type { JwItemInput, JwItemValue } from '../../src/client/jw/item-text'
import { RequestError } from '../../src/errors'
import { assumedJwAreas } from '../../src/jw/operand/area'
import { bytesOf } from '../../src/value/byte-type'
import { valuesOfBytes } from '../../src/value/byte-value'
import type { PlcValue } from '../../src/value/type'

/** What values are, by names that can stand in a table. */
interface Kinds {
  readonly boolean: boolean
  readonly number: number
  readonly bigint: bigint
  readonly string: string
  readonly 'boolean[]': boolean[]
  readonly 'number[]': number[]
  readonly 'bigint[]': bigint[]
  readonly 'string[]': string[]
  /** Of a type that nobody can know from the text. */
  readonly one: PlcValue
  readonly many: PlcValue[]
  readonly any: ReadValue
}
type Row = readonly [item: Item, kind: keyof Kinds, refused?: 'refused']

const ROWS = [
  ['004033', 'boolean'],
  ['04033', 'boolean'],
  ['09012', 'number'],
  ['19012', 'number'],
  [' 09012 ', 'number'],
  ['09012.3', 'boolean'],
  ['KO0403', 'number'],
  ['ko0403', 'number'],
  ['コ0403', 'number'],
  ['KO0403.7', 'boolean'],
  ['b0012', 'number'],
  ['B0012.1', 'boolean'],
  ['E0012', 'number'],
  ['T-C0012', 'boolean'],
  ['TMR0012', 'number'],
  ['cnt0012', 'number'],
  ['MD0012', 'number'],
  ['TMR0012:BOOL', 'boolean'],
  ['#0201', 'number'],
  ['#0201.3', 'boolean'],
  ['F1:00001234', 'number'],
  ['f1:1234.3', 'boolean'],
  ['F1:00001234:REAL', 'number'],
  ['F1:00001234:LINT', 'bigint'],
  ['F1:00001234:STRING(5)', 'string'],
  ['F1:00001234:INT[4]', 'number[]'],
  ['F1:00001234[4]', 'number[]'],
  ['F1:00001234.3[4]', 'boolean[]'],
  ['F1:00001234,4', 'number[]'],
  ['F1:00000000..F1:00000017', 'number[]'],
  ['F1:0.0..F1:1.7', 'boolean[]'],
  ['F1:0..F1:17:LINT', 'bigint[]'],
  ['09012:BYTE', 'number'],
  ['09012:SINT', 'number'],
  ['09012:uint8', 'number'],
  ['09012:BCD8', 'number'],
  ['09012:BCD16', 'number'],
  ['09012:BCD32[2]', 'number[]'],
  ['09012:Word [Signed]', 'number'],
  ['09012:Word [Signed][4]', 'number[]'],
  ['09012:ULINT', 'bigint'],
  ['09012:STRING(20)', 'string'],
  ['09012:STRING(2)[3]', 'string[]'],
  ['09012:WSTRING(2)', 'string'],
  ['09012[16]', 'number[]'],
  ['09012,16', 'number[]'],
  ['09000..09017', 'number[]'],
  ['09000..09017:LREAL', 'number[]'],
  ['004000[16]', 'boolean[]'],
  ['004000..004017', 'boolean[]'],
  ['09012.6[4]', 'boolean[]'],
  ['TMR0000[16]', 'number[]'],
  [{ address: '09012' }, 'number'],
  [{ address: '09012', type: 'LINT' }, 'bigint'],
  [{ address: '09012', type: 'BCD8', count: 4 }, 'number[]'],
  [{ address: '09012:STRING(4)', encoding: 'shift-jis' }, 'string'],
  // What these would be is not known: they are refused before anything is sent.
  ['D100', 'one', 'refused'],
  ['Motor', 'one', 'refused'],
  ['04083', 'one', 'refused'],
  ['09012.8', 'one', 'refused'],
  ['09012:FOO', 'one', 'refused'],
  ['', 'one', 'refused'],
] as const satisfies readonly Row[]

type Same<A, B> = [A, B] extends [B, A] ? true : false
type Checked<L extends readonly Row[]> = {
  [K in keyof L]: Same<JwItemValue<L[K][0]>, Kinds[L[K][1]]> extends true ? true : L[K]
}
/** `true`, or the rows that the compiler reads otherwise. */
type Wrong = Checked<typeof ROWS>[number]
const compiled: Wrong extends true ? true : Wrong = true

const OPTIONS = { areas: assumedJwAreas }

/** What bytes of zeros are as this item. */
function zerosAs(item: Item): PlcValue | PlcValue[] {
  const { type, count } = parseJwItem(item, OPTIONS)
  const isBit = type.name === 'BOOL'
  const size = isBit ? 0 : bytesOf(type) * (count ?? 1)
  const values = isBit
    ? Array<boolean>(count ?? 1).fill(false)
    : valuesOfBytes(type, new Uint8Array(size), 0, count ?? 1)
  return count === undefined ? (values[0] ?? '') : values
}

test.each(ROWS)('%p is %s', (item: Item, kind: string, ...[refused]: readonly string[]) => {
  expect(compiled).toBe(true)
  if (refused !== undefined) {
    expect(() => parseJwItem(item, OPTIONS)).toThrow(RequestError)
    return
  }
  const value = zerosAs(item)
  const name = Array.isArray(value) ? `${typeof value[0]}[]` : typeof value
  expect(name).toBe(kind)
})

test('texts that are put together have the type that is certain, or any', () => {
  const number: number = 12
  const rows = <A, B>(same: Same<A, B>): true => same as true
  expect(rows<JwItemValue<string>, ReadValue>(true)).toBe(true)
  expect(rows<JwItemValue<`0901${number}`>, ReadValue>(true)).toBe(true)
  expect(rows<JwItemValue<`09012:INT[${number}]`>, number[]>(true)).toBe(true)
  expect(rows<JwItemValue<`b00${number}:REAL`>, number | number[]>(true)).toBe(true)
  expect(rows<JwItemInput<'004033'>, boolean>(true)).toBe(true)
  expect(rows<JwItemInput<'09012'>, number | bigint>(true)).toBe(true)
  expect(rows<JwItemInput<'09012:STRING(4)'>, string>(true)).toBe(true)
  expect(rows<JwItemInput<string>, WriteValue>(true)).toBe(true)
  expect(number).toBe(12)
})
