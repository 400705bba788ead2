// Random items, and what they are worth according to the PLC: computed value by value, without any plan.
import fc from 'fast-check'
import type { ParsedItem } from '../../src/client/item/item'
import { deviceInfo } from '../../src/melsec/device/device'
import { decodeValue, type PlcValue, wordsOf } from '../../src/value/value'
import type { PlanPlc } from './plan-plc'

const wordTypes = ['INT', 'UINT', 'WORD', 'DINT', 'UDINT', 'REAL', 'LREAL', 'LINT', 'ULINT', 'TIME']

/** Numbers that cluster, touch, overlap and lie far apart. */
const number = fc.oneof(fc.nat(40), fc.nat(300), fc.integer({ min: 0, max: 4000 }))
const count = fc.oneof(
  fc.constant(''),
  fc.constant(''),
  fc.integer({ min: 1, max: 40 }).map((n) => `[${n}]`),
)

function textOf(device: fc.Arbitrary<string>, tail: fc.Arbitrary<string>): fc.Arbitrary<string> {
  return fc.tuple(device, number, tail, count).map(([name, at, end, many]) => {
    const place = name.split('\\').at(-1) ?? name
    const radix = /^(K\d)?(X|Y|B|W|SB|SW)$/.test(place) ? 16 : 10
    return `${name}${at.toString(radix).toUpperCase()}${end}${many}`
  })
}

/** Items of an iQ-R: every kind of device, type and address there is, with counts. */
export const itemText: fc.Arbitrary<string> = fc.oneof(
  textOf(
    fc.constantFrom('D', 'W', 'R', 'TN', 'SD', 'U3\\G', 'U3E0\\HG', 'J1\\W'),
    fc.constantFrom(...wordTypes).map((type) => `:${type}`),
  ),
  textOf(
    fc.constantFrom('D', 'W', 'U3\\G'),
    fc.nat(15).map((bit) => `.${bit.toString(16)}`),
  ),
  textOf(
    fc.constantFrom('M', 'X', 'B', 'SM', 'TS', 'CC', 'J1\\B', 'LTS', 'LTC', 'LSTS', 'LCS', 'LCC'),
    fc.constant(''),
  ),
  textOf(fc.constantFrom('K1M', 'K2X', 'K3M', 'K4M', 'K3LTS', 'K2LCS'), fc.constant('')),
  textOf(fc.constantFrom('K5M', 'K8M', 'K8B'), fc.constantFrom('', ':UDINT')),
  textOf(fc.constantFrom('LTN', 'LSTN', 'LCN', 'LZ'), fc.constantFrom('', ':UDINT', ':TIME')),
)

/** Items whose devices only the PLC knows. */
export const modifiedText: fc.Arbitrary<string> = fc.oneof(
  textOf(fc.constantFrom('D', 'W', 'U3\\G'), fc.constantFrom('Z1', 'Z2:REAL', 'Z3:LREAL', 'Z4.A')),
  textOf(fc.constantFrom('M', 'K4M', 'X'), fc.constantFrom('Z1', 'Z2')),
  fc.tuple(number, fc.constantFrom('', ':DINT', '.3', 'Z1')).map(([at, end]) => `@D${at}${end}`),
)

const joined = (...parts: fc.Arbitrary<string | number>[]) => fc.tuple(...parts).map((all) => all.join(''))
const near = fc.oneof(fc.nat(30), fc.nat(120), fc.nat(700))

/** A few items of an FX5 that lie near enough to one another to share requests in many ways. */
export const fx5Items: fc.Arbitrary<string[]> = fc.array(
  fc.oneof(
    joined(
      fc.constantFrom('D', 'D', 'R'),
      near,
      fc.constantFrom('', ':DINT', ':LREAL'),
      fc.constantFrom('', '', '', '[2]', '[5]', '[17]', '[33]'),
    ),
    joined(fc.constant('M'), near, fc.constantFrom('', '', '[3]', '[20]')),
    joined(fc.constantFrom('K4M', 'K8M'), near),
  ),
  { minLength: 1, maxLength: 7 },
)

/** Words, to be compared as they stand: a not-a-number is not equal to itself. */
export function expectedValue(plc: PlanPlc, item: ParsedItem): PlcValue | PlcValue[] {
  const { type, format, count } = item
  const values = Array.from({ length: count ?? 1 }, (_, k): PlcValue => {
    const bits = bitsOf(plc, item, k)
    if (type.name === 'BOOL') return bits[0] ?? false
    const words = new Array<number>(wordsOf(type)).fill(0)
    bits.forEach((bit, i) => {
      if (bit) words[i >> 4] = (words[i >> 4] ?? 0) | (1 << (i & 15))
    })
    return decodeValue(type, words, 0, format)
  })
  return count === undefined ? (values[0] ?? false) : values
}

function bitsOf(plc: PlanPlc, { address, bit, digits, type }: ParsedItem, k: number): boolean[] {
  const { unit } = deviceInfo(address.device)
  const real = plc.resolve(address)
  if (unit === 'bit') {
    const width = digits === undefined ? 1 : 4 * digits
    return Array.from({ length: width }, (_, i) => plc.bit({ ...real, number: real.number + k * width + i }))
  }
  if (unit === 'doubleWord') return plc.doubleWord({ ...real, number: real.number + k }).flatMap(unpacked)
  if (bit !== undefined) {
    const at = bit + k
    return [unpacked(plc.word({ ...real, number: real.number + (at >> 4) }))[at & 15] ?? false]
  }
  const size = wordsOf(type)
  return Array.from({ length: size }, (_, i) => plc.word({ ...real, number: real.number + k * size + i })).flatMap(
    unpacked,
  )
}

function unpacked(word: number): boolean[] {
  return Array.from({ length: 16 }, (_, i) => ((word >> i) & 1) === 1)
}
