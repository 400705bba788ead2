/**
 * The compiler and the parser read the same texts: what is inferred of an item's value is what the PLC's answer becomes.
 * One table, read by both: `tsc` compares the second column with `ItemValue`, the tests with what a simulated PLC gave.
 */
import { afterAll, beforeAll, expect, test } from '@jest/globals'
import { tryParseItem, valueTypes } from '../../src/entry/address'
import { createPlcSimulator } from '../../src/entry/simulator'
import {
  createMelsecClient,
  type Item,
  type ItemInput,
  type ItemValue,
  type MelsecClient,
  type PlcClient,
  type PlcValue,
  type ReadResult,
  type ReadValue,
  type WriteEntry,
  type WriteValue,
} from '../../src/index'
import { devices } from '../../src/melsec/device/device'
import { clientOptions, kind } from './line'

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
  /** Of a type that nobody can know from the text: one value, an array, or either. */
  readonly one: PlcValue
  readonly many: PlcValue[]
  readonly any: ReadValue
}
type Row = readonly [item: Item, kind: keyof Kinds, refused?: 'refused']

const DEVICES = [
  ['SM400', 'boolean'],
  ['SD203', 'number'],
  ['X1F', 'boolean'],
  ['XFF', 'boolean'],
  ['Y10', 'boolean'],
  ['M10', 'boolean'],
  ['L7', 'boolean'],
  ['F3', 'boolean'],
  ['V5', 'boolean'],
  ['B1F', 'boolean'],
  ['BED', 'boolean'],
  ['D5', 'number'],
  ['W1F', 'number'],
  ['TS5', 'boolean'],
  ['TC5', 'boolean'],
  ['TN5', 'number'],
  ['LTS5', 'boolean'],
  ['LTC5', 'boolean'],
  ['LTN5', 'number'],
  ['STS5', 'boolean'],
  ['STC5', 'boolean'],
  ['STN5', 'number'],
  ['LSTS5', 'boolean'],
  ['LSTC5', 'boolean'],
  ['LSTN5', 'number'],
  ['CS5', 'boolean'],
  ['CC5', 'boolean'],
  ['CN5', 'number'],
  ['LCS5', 'boolean'],
  ['LCC5', 'boolean'],
  ['LCN5', 'number'],
  ['SB10', 'boolean'],
  ['SBED', 'boolean'],
  ['SW1F', 'number'],
  ['S8', 'boolean'],
  ['DX1F', 'boolean'],
  ['DY1F', 'boolean'],
  ['Z2', 'number'],
  ['LZ1', 'number'],
  ['R100', 'number'],
  ['ZR32768', 'number'],
  ['RD12', 'number'],
  ['U3\\G100', 'number'],
  ['U3E0\\G100', 'number'],
  ['U3E0\\HG0', 'number'],
  ['J1\\W10', 'number'],
  ['J1\\X1F', 'boolean'],
] as const satisfies readonly Row[]

const ADDRESSES = [
  ['d5', 'number'],
  ['xff', 'boolean'],
  [' D5 ', 'number'],
  ['D0005', 'number'],
  ['u3/g100', 'number'],
  ['J1¥SB1F', 'boolean'],
  ['D100.F', 'boolean'],
  ['d100.a', 'boolean'],
  ['W1F.0', 'boolean'],
  ['U3\\G100.3', 'boolean'],
  ['D100Z2', 'number'],
  ['D100LZ1', 'number'],
  ['M100Z2', 'boolean'],
  ['WFFZ1', 'number'],
  ['U3Z1\\G0', 'number'],
  ['J1Z1\\B10', 'boolean'],
  ['@D0', 'number'],
  ['K4M0', 'number'],
  ['K8M0', 'number'],
  ['K1X0', 'number'],
  ['K4M0Z1', 'number'],
  // A zero too many in a digit designation: the parser is not so strict.
  ['K04M0', 'one'],
  // Of these the compiler says what they would be. They are refused before anything is sent.
  ['G100', 'number', 'refused'],
  ['D100.1', 'boolean'],
  ['D100.15', 'one', 'refused'],
  ['D100.G', 'one', 'refused'],
  ['M0.1', 'one', 'refused'],
  ['D100A', 'one', 'refused'],
  ['D1e2', 'one', 'refused'],
  ['D-1', 'one', 'refused'],
  ['D', 'one', 'refused'],
  ['', 'one', 'refused'],
  ['T5', 'one', 'refused'],
  ['SBX1', 'one', 'refused'],
  ['K4D0', 'one', 'refused'],
  ['Q1', 'one', 'refused'],
  ['Ｄ１００', 'one', 'refused'],
] as const satisfies readonly Row[]

const COUNTS = [
  ['M0..M15', 'boolean[]'],
  ['M0 .. M15', 'boolean[]'],
  ['M0[16]', 'boolean[]'],
  ['M0[ 16 ]', 'boolean[]'],
  ['M0[1]', 'boolean[]'],
  ['X0,16', 'boolean[]'],
  ['D0..D9', 'number[]'],
  ['D0[10]', 'number[]'],
  ['D100,10', 'number[]'],
  ['D100, 10', 'number[]'],
  ['D100.0[20]', 'boolean[]'],
  ['D10.A..D11.3', 'boolean[]'],
  ['K4M0[3]', 'number[]'],
  ['K4M0..K4M48', 'number[]'],
  ['U3\\G0[4]', 'number[]'],
  ['LTN0[2]', 'number[]'],
  ['D0..D9:DINT', 'number[]'],
  ['D0..D3:LINT', 'bigint[]'],
  ['D100:REAL[4]', 'number[]'],
  ['D100:REAL [ 4 ]', 'number[]'],
  ['D100:STRING(8)[4]', 'string[]'],
  ['D100:FLOAT [Single Precision][4]', 'number[]'],
  ['D100:ワード[符号付き][4]', 'number[]'],
  ['D100:文字列[Unicode](4)[2]', 'string[]'],
  ['D100:LINT[2]', 'bigint[]'],
  ['D100[]', 'any', 'refused'],
  ['D100[x]', 'any', 'refused'],
  ['D100,bit3', 'one', 'refused'],
  ['D100..', 'number[]', 'refused'],
  ['D100:INT,10', 'one', 'refused'],
  ['D100[4]:INT', 'number', 'refused'],
] as const satisfies readonly Row[]

const TYPES = [
  ['D100:INT', 'number'],
  ['D100:INT16', 'number'],
  ['D100:Word [Signed]', 'number'],
  ['D100:ワード[符号付き]', 'number'],
  ['D100:字[有符号]', 'number'],
  ['D100:字[有符號]', 'number'],
  ['D100:UINT', 'number'],
  ['D100:UINT16', 'number'],
  ['D100:WORD', 'number'],
  ['D100:Word [Unsigned]/Bit String [16-bit]', 'number'],
  ['D100:Word [Unsigned]', 'number'],
  ['D100:Bit String [16-bit]', 'number'],
  ['D100:ワード[符号なし]/ビット列[16ビット]', 'number'],
  ['D100:ワード[符号なし]', 'number'],
  ['D100:ビット列[16ビット]', 'number'],
  ['D100:字[无符号]/位列[16位]', 'number'],
  ['D100:字[无符号]', 'number'],
  ['D100:位列[16位]', 'number'],
  ['D100:字[無符號]/位元列[16位元]', 'number'],
  ['D100:字[無符號]', 'number'],
  ['D100:位元列[16位元]', 'number'],
  ['D100:DINT', 'number'],
  ['D100:INT32', 'number'],
  ['D100:Double Word [Signed]', 'number'],
  ['D100:ダブルワード[符号付き]', 'number'],
  ['D100:双字[有符号]', 'number'],
  ['D100:雙字[有符號]', 'number'],
  ['D100:UDINT', 'number'],
  ['D100:UINT32', 'number'],
  ['D100:DWORD', 'number'],
  ['D100:Double Word [Unsigned]/Bit String [32-bit]', 'number'],
  ['D100:Double Word [Unsigned]', 'number'],
  ['D100:Bit String [32-bit]', 'number'],
  ['D100:ダブルワード[符号なし]/ビット列[32ビット]', 'number'],
  ['D100:ダブルワード[符号なし]', 'number'],
  ['D100:ビット列[32ビット]', 'number'],
  ['D100:双字[无符号]/位列[32位]', 'number'],
  ['D100:双字[无符号]', 'number'],
  ['D100:位列[32位]', 'number'],
  ['D100:雙字[無符號]/位元列[32位元]', 'number'],
  ['D100:雙字[無符號]', 'number'],
  ['D100:位元列[32位元]', 'number'],
  ['D100:LINT', 'bigint'],
  ['D100:INT64', 'bigint'],
  ['D100:ULINT', 'bigint'],
  ['D100:UINT64', 'bigint'],
  ['D100:REAL', 'number'],
  ['D100:FLOAT', 'number'],
  ['D100:FLOAT32', 'number'],
  ['D100:FLOAT [Single Precision]', 'number'],
  ['D100:単精度実数', 'number'],
  ['D100:单精度实数', 'number'],
  ['D100:單精度實數', 'number'],
  ['D100:LREAL', 'number'],
  ['D100:FLOAT64', 'number'],
  ['D100:FLOAT [Double Precision]', 'number'],
  ['D100:倍精度実数', 'number'],
  ['D100:双精度实数', 'number'],
  ['D100:雙精度實數', 'number'],
  ['D100:BCD16', 'number'],
  ['D100:BCD32', 'number'],
  ['D100:TIME', 'number'],
  ['D100:時間', 'number'],
  ['D100:时间', 'number'],
  ['D100:STRING(20)', 'string'],
  ['D100:STR(20)', 'string'],
  ['D100:文字列(20)', 'string'],
  ['D100:字符串(20)', 'string'],
  ['D100:字串(20)', 'string'],
  ['D100:WSTRING(20)', 'string'],
  ['D100:String [Unicode](20)', 'string'],
  ['D100:文字列[Unicode](20)', 'string'],
  ['D100:字符串[Unicode](20)', 'string'],
  ['D100:字串[Unicode](20)', 'string'],
  ['M0:BOOL', 'boolean'],
  ['M0:Bit', 'boolean'],
  ['M0:ビット', 'boolean'],
  ['M0:位', 'boolean'],
  ['M0:位元', 'boolean'],
  ['D100.3:BOOL', 'boolean'],
  ['K8M0:REAL', 'number'],
  ['LTN4:UDINT', 'number'],
  ['D100:real', 'number'],
  ['d100 : Real ', 'number'],
  ['D100:word[signed]', 'number'],
  ['D100:FLOAT  [ Single Precision ]', 'number'],
  ['D100:string( 20 )', 'string'],
  // Full-width characters are beyond the compiler, but there is one value.
  ['D100:ＲＥＡＬ', 'one'],
  ['D100:ワード［符号付き］', 'one'],
  ['D100:FOO', 'one', 'refused'],
  ['D100:F', 'one', 'refused'],
  ['D100:STRING[20]', 'string[]', 'refused'],
  ['D100:INT(5)', 'one', 'refused'],
  ['D100:BOOL', 'boolean', 'refused'],
] as const satisfies readonly Row[]

const LABELS = [
  ['Line1.Speed', 'one'],
  ['Line1.Speed:REAL', 'number'],
  ['Line1.Speed:FLOAT [Single Precision]', 'number'],
  ['Line1.Speed:単精度実数', 'number'],
  ['label:Line1.Speed', 'one'],
  ['LABEL:Line1.Speed:REAL', 'number'],
  ['Line1.Values[1]', 'any'],
  ['Line1.Values[1]:INT', 'number'],
  ['Line1.Values[0]:INT[3]', 'number[]'],
  ['label:Line1.Values[0]:INT[3]', 'number[]'],
  ['label:Line1.Values[2]', 'one'],
  ['Ready', 'one'],
  // Not the digits of bits, because of its underscore.
  ['K4_Motor', 'one'],
  ['K1ZR1_0', 'one'],
  ['Ready:BOOL', 'boolean'],
  // With `label:` it is a label, whatever it looks like.
  ['label:D100', 'one'],
  ['label:M1', 'one'],
] as const satisfies readonly Row[]

const OBJECTS = [
  [{ address: 'M10' }, 'boolean'],
  [{ address: 'D100', type: 'REAL' }, 'number'],
  [{ address: 'D100', type: 'FLOAT [Single Precision]' }, 'number'],
  [{ address: 'D100:LINT', wordOrder: 'high-first' }, 'bigint'],
  [{ address: 'D100', type: 'REAL', count: 4 }, 'number[]'],
  [{ address: 'D100', count: 1 }, 'number[]'],
  [{ address: 'D100:STRING(20)', encoding: 'shift-jis', trimSpaces: true }, 'string'],
  [{ address: 'D0..D9', type: 'DINT' }, 'number[]'],
  [{ address: 'Line1.Speed' }, 'one'],
  [{ address: 'Line1.Speed', type: 'REAL' }, 'number'],
  [{ address: 'Line1.Values[0]', count: 3 }, 'many'],
  [{ address: 'Line1.Values[0]', type: 'INT', count: 3 }, 'number[]'],
] as const satisfies readonly Row[]

const TABLE = { DEVICES, ADDRESSES, COUNTS, TYPES, LABELS, OBJECTS }
const rows: readonly Row[] = Object.values(TABLE).flat()

/** Exactly the same type. */
type Equal<A, B> = (<T>() => T extends A ? 1 : 2) extends <T>() => T extends B ? 1 : 2 ? true : false
/** The rows of which the compiler infers something else. */
type WrongRow<R extends Row> = R extends Row
  ? Equal<ItemValue<R[0]>, Kinds[R[1]]> extends true
    ? never
    : { readonly row: R; readonly inferred: ItemValue<R[0]> }
  : never
/** `true`, or what is wrong. */
type None<W> = [W] extends [never] ? true : W

test('the compiler infers what stands in the table', () => {
  const checked = [
    true satisfies None<WrongRow<(typeof DEVICES)[number]>>,
    true satisfies None<WrongRow<(typeof ADDRESSES)[number]>>,
    true satisfies None<WrongRow<(typeof COUNTS)[number]>>,
    true satisfies None<WrongRow<(typeof TYPES)[number]>>,
    true satisfies None<WrongRow<(typeof LABELS)[number]>>,
    true satisfies None<WrongRow<(typeof OBJECTS)[number]>>,
  ]
  expect(checked).toHaveLength(Object.keys(TABLE).length)
})

test('every device is in the table', () => {
  const items = DEVICES.map(([item]) => tryParseItem(item, { xyRadix: 16 }))
  const read = new Set(items.map((item) => ('error' in item ? item.text : item.address.device)))
  expect(devices.map(({ name }) => name).filter((name) => !read.has(name))).toEqual([])
})

test('every spelling of a type is in the table', () => {
  const texts = TYPES.map(([item]) =>
    item
      .slice(item.indexOf(':') + 1)
      .replace(/\(20\)$/, '')
      .toUpperCase(),
  )
  const spellings = Object.entries(valueTypes).flatMap(([name, row]) => {
    const aliases = 'aliases' in row ? row.aliases : []
    const labels = [...('gxWorks' in row ? [row.gxWorks] : []), ...('translated' in row ? row.translated : [])]
    return [name, ...aliases, ...labels.flatMap((text) => [text, ...text.split('/')])]
  })
  expect(spellings.filter((text) => !texts.includes(text.toUpperCase()))).toEqual([])
})

test('of texts that are made at run time nothing is guessed', () => {
  const checked = [
    true satisfies Equal<ItemValue<string>, ReadValue>,
    true satisfies Equal<ItemValue<Item>, ReadValue>,
    // biome-ignore lint/suspicious/noExplicitAny: what a program without types may pass
    true satisfies Equal<ItemValue<any>, ReadValue>,
    // D1.5 is a bit.
    true satisfies Equal<ItemValue<`D${number}`>, PlcValue>,
    true satisfies Equal<ItemValue<`D${number}:REAL`>, number>,
    true satisfies Equal<ItemValue<`D${number}:REAL[${number}]`>, number[]>,
    true satisfies Equal<ItemValue<`D0..D${number}`>, number[]>,
    // D0..D9 may be in front, and [4] behind.
    true satisfies Equal<ItemValue<`${string}:REAL`>, number | number[]>,
    true satisfies Equal<ItemValue<`D100:${string}`>, ReadValue>,
    true satisfies Equal<ItemValue<`D0..${string}`>, PlcValue[]>,
    true satisfies Equal<ItemValue<`label:${string}`>, ReadValue>,
    true satisfies Equal<ItemValue<'M10' | 'D100:REAL[2]'>, boolean | number[]>,
    true satisfies Equal<ItemValue<{ address: 'D100'; type: string }>, PlcValue>,
    true satisfies Equal<ItemValue<{ address: 'D100'; type?: 'REAL' }>, PlcValue>,
    true satisfies Equal<ItemValue<{ address: 'D100'; count?: number }>, number | number[]>,
    true satisfies Equal<ItemValue<{ address: string; type: 'REAL' }>, number | number[]>,
    true satisfies Equal<ItemInput<string>, WriteValue>,
    true satisfies Equal<ItemInput<Item>, WriteValue>,
  ]
  expect(checked).not.toContain(false)
})

const plc = createPlcSimulator({
  profile: 'iq-r',
  extensions: {
    modules: [{ unit: 3, points: 1000 }],
    networks: [{ network: 1, points: { W: 1000, X: 1000, SB: 1000, B: 1000 } }],
    cpus: [{ cpu: 1, points: { G: 1000, HG: 1000 } }],
  },
  labels: {
    'Line1.Speed': { type: 'REAL' },
    'Line1.Values': { type: 'INT', dimensions: [10] },
    Ready: { type: 'BOOL' },
    K4_Motor: { type: 'REAL' },
    K1ZR1_0: { type: 'BOOL' },
    D100: { type: 'DINT' },
    M1: { type: 'STRING(10)' },
  },
})
let client: MelsecClient

beforeAll(async () => {
  await plc.listen()
  plc.adrset('D100', 'D0')
  client = createMelsecClient(clientOptions(kind('tcp 4E binary iq-r'), plc))
})

afterAll(async () => {
  await client.close()
  await plc.close()
})

function kindOf(value: ReadValue): string {
  if (!Array.isArray(value)) return typeof value
  return [...new Set(value.map((one) => `${typeof one}[]`))].join()
}

function fits(value: ReadValue, kind: keyof Kinds): boolean {
  if (kind === 'any') return true
  if (kind === 'one' || kind === 'many') return Array.isArray(value) === (kind === 'many')
  return kindOf(value) === kind
}

test.each(rows.map(([item, kind, refused]) => ({ item, kind, refused })))(
  '$item is read as $kind',
  async ({ item, kind, refused }) => {
    const [result] = await client.readEach([item])
    if (refused !== undefined) {
      expect(result).toMatchObject({ ok: false, error: { outcome: 'notSent' } })
      return
    }
    if (result?.ok !== true) throw result?.error
    const { value } = result
    expect({ value, fits: fits(value, kind) }).toEqual({ value, fits: true })
  },
)

/** An item, a value that it takes, and one of a type that it never takes. */
const INPUTS = [
  ['M10', true, 1],
  ['M10:Bit', false, 'true'],
  ['D5', 7, '7'],
  ['D5', 7n, true],
  ['D100:REAL', 1.5, 'x'],
  ['D100:FLOAT [Single Precision]', 1.5, 1n],
  ['D100:LINT', 5n, '5'],
  ['D100:LINT', 5, true],
  ['D100:BCD16', 1234, '1234'],
  ['D100:STRING(20)', 'A', 5],
  ['D100:文字列(20)', 'A', true],
  ['K4M0', 5, true],
  ['TN5', 5, '5'],
  ['D0[3]', [1, 2, 3], 5],
  ['D0..D2', [1, 2, 3], ['1', '2', '3']],
  ['D0[3]', Int16Array.of(1, 2, 3), { 0: 1 }],
  ['D0:REAL[2]', Float32Array.of(1, 2), BigInt64Array.of(1n, 2n)],
  ['D0:LINT[2]', BigInt64Array.of(1n, 2n), 5n],
  ['D0', 5, [5]],
  ['M0[2]', [true, false], Uint8Array.of(0, 1)],
  ['D0:STRING(4)[2]', ['A', 'B'], 'A'],
  ['Line1.Speed:REAL', 2.5, 'x'],
  ['Line1.Values[0]:INT', [1, 2], 'x'],
  ['Line1.Values[0]:INT', 1, true],
  [{ address: 'D100', type: 'REAL' }, 1.5, 'x'],
  [{ address: 'D100', type: 'REAL', count: 2 }, [1, 2], 5],
] as const
type InputRow = (typeof INPUTS)[number]
type WrongInput<R extends InputRow> = R extends InputRow
  ? [R[1] extends ItemInput<R[0]> ? true : false, R[2] extends ItemInput<R[0]> ? true : false] extends [true, false]
    ? never
    : R
  : never
true satisfies None<WrongInput<InputRow>>

test.each(INPUTS.map(([item, good, bad]) => ({ item, good, bad })))('$item takes $good and not $bad', async (row) => {
  const item: Item = row.item
  await client.write(item, row.good)
  const wrong = row.bad as WriteValue
  await expect(client.write(item, wrong)).rejects.toMatchObject({ code: 'BAD_VALUE', outcome: 'notSent' })
})

test('a value of another type does not compile, and is refused', async () => {
  const refused = { code: 'BAD_VALUE', outcome: 'notSent' }
  // @ts-expect-error a REAL is a number
  await expect(client.write('D100:REAL', 'x')).rejects.toMatchObject(refused)
  // @ts-expect-error a bit is true or false
  await expect(client.write('M10', 5)).rejects.toMatchObject(refused)
  const all = { allOrNothing: true }
  // @ts-expect-error a bit is true or false
  await expect(client.write({ M10: 5, 'D5:INT': 7 }, all)).rejects.toThrow('true or false')
  // @ts-expect-error an INT is a number
  await expect(client.writeValues({ M10: true, 'D5:INT': '7' }, all)).rejects.toThrow('whole number')
  // @ts-expect-error an array is no single value
  await expect(client.writeValues({ 'D5[2]': 7 })).rejects.toThrow('D5[2]')
  // @ts-expect-error a bit is true or false
  const each: unknown = await client.writeEach({ M10: 'on', D5: 7 }, all)
  expect(each).toMatchObject({ M10: { ok: false, error: refused }, D5: { ok: false } })
  // @ts-expect-error a bit is true or false
  const list = [await client.writeEach([{ item: 'M10', value: 5 }], all)].flat()
  expect(list).toMatchObject([{ ok: false, error: refused }])
  // @ts-expect-error a REAL is a number
  await expect(client.write([{ item: { address: 'D5', type: 'REAL' }, value: 'x' }])).rejects.toThrow('finite number')
  // @ts-expect-error a value is missing
  await expect(client.write([{ item: 'M10' }])).rejects.toThrow('true or false')
  // @ts-expect-error nothing is no value
  await expect(client.write([{ item: 'M10', value: undefined }])).rejects.toThrow('true or false')
  // @ts-expect-error nothing is no value
  await expect(client.write({ M10: undefined })).rejects.toThrow('true or false')
  // @ts-expect-error an array takes as many values
  const plan = client.planWrite([{ item: 'D5[2]', value: 7 }])
  await expect(plan.run()).rejects.toThrow('D5[2]')
})

test('what is known at run time only is written as before', async () => {
  const texts: readonly string[] = ['D5', 'M10']
  const values: readonly WriteValue[] = [7, true]
  for (const [at, text] of texts.entries()) await client.write(text, values[at] as WriteValue)
  const entries: readonly WriteEntry[] = texts.map((item, at) => ({ item, value: values[at] as WriteValue }))
  await client.write(entries)
  await client.planWrite(entries).run()
  const byAddress: Readonly<Record<string, WriteValue>> = { [`D${5}`]: 7, [`M${10}`]: true }
  await client.writeValues(byAddress)
  const either: readonly WriteEntry[] | Readonly<Record<string, WriteValue>> = byAddress
  await client.write(either)
  const results: Readonly<Record<string, { readonly ok: boolean }>> = await client.writeEach(byAddress)
  expect(Object.values(results)).toMatchObject([{ ok: true }, { ok: true }])
  expect(await client.readValues(texts)).toEqual(values)
})

test('many items are typed one by one, in lists, by name, in plans and monitors', async () => {
  await client.write({ 'D100:REAL': 71.5, M10: true, 'D5[2]': [1, 2] })
  const [level, running, pair] = await client.readValues(['D100:REAL', 'M10', 'D5[2]'])
  const values = [level satisfies number, running satisfies boolean, pair satisfies number[]]
  const named = await client.readValues({ level: 'D100:REAL', running: { address: 'M10' }, pair: 'D5,2' })
  expect([named.level satisfies number, named.running satisfies boolean, named.pair satisfies number[]]).toEqual(values)
  const each = await client.readEach({ level: 'D100:REAL', running: 'M10' })
  const plan = await client.plan(['D100:REAL', 'M10']).run()
  const monitor = await client.monitor(['D100:REAL', 'M10']).read()
  const lists = [await client.read(['D100:REAL', 'M10']), await client.readEach(['D100:REAL', 'M10']), plan, monitor]
  for (const [first, second] of [...lists, [each.level, each.running]] as const) {
    if (!first.ok || !second.ok) throw new Error('not read')
    expect([first.value satisfies number, second.value satisfies boolean]).toEqual([71.5, true])
  }
  const results: ReadResult[] = plan
  expect(results).toHaveLength(2)
})

test('a program may hand items on, and the types go with them', async () => {
  async function through<const I extends Item>(item: I): Promise<ItemValue<I>> {
    return client.read(item)
  }
  async function real<const A extends string>(address: A) {
    return client.read(`${address}:REAL`)
  }
  const values = [(await through('M10')) satisfies boolean, (await real('D100')) satisfies number]
  expect(values.map((value) => typeof value)).toEqual(['boolean', 'number'])
})

test('a program for any family of PLCs takes the client, and knows nothing of the values', async () => {
  const any: PlcClient = client
  await any.write('D9', 12)
  const value: ReadValue = await any.read('D9')
  expect(value).toBe(12)
  // @ts-expect-error: what is not known to be a number is none.
  value satisfies number
})
