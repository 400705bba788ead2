import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { ProtocolError } from '../../src/errors'
import { type PlcValue, parseType, typeNames, valueTypes, wordsOf } from '../../src/value/value'
import { decode, encode, numbers, orders, refusal, words } from './support'

test('the tests know every numeric type', () => {
  const numeric = typeNames.filter((name) => valueTypes[name].kind !== 'text' && valueTypes[name].kind !== 'bit')
  expect(Object.keys(numbers).sort()).toEqual([...numeric].sort())
})

describe('words of known values', () => {
  test.each<[string, PlcValue, number[]]>([
    // SLMP Reference Manual, data of reading and writing in word units: 0.75 in D0, D1 = 0000H, 3F40H
    ['REAL', 0.75, [0x0000, 0x3f40]],
    ['REAL', -0, [0x0000, 0x8000]],
    ['REAL', 2 ** -149, [0x0001, 0x0000]],
    ['REAL', 3.4028234663852886e38, [0xffff, 0x7f7f]],
    ['LREAL', 1, [0, 0, 0, 0x3ff0]],
    ['LREAL', -0, [0, 0, 0, 0x8000]],
    ['LREAL', 5e-324, [1, 0, 0, 0]],
    ['LREAL', 2 ** 53 + 2, [0x0001, 0, 0, 0x4340]],
    ['INT', -1, [0xffff]],
    ['INT', -32768, [0x8000]],
    ['UINT', 65535, [0xffff]],
    ['WORD', 0x12af, [0x12af]],
    ['DINT', 0x12345678, [0x5678, 0x1234]],
    ['DINT', -2147483648, [0x0000, 0x8000]],
    ['UDINT', 4294967295, [0xffff, 0xffff]],
    ['DWORD', 0x80000001, [0x0001, 0x8000]],
    ['TIME', -2147483648, [0x0000, 0x8000]],
    ['TIME', 90061001, [0x38c9, 0x055e]],
    ['LINT', -1n, [0xffff, 0xffff, 0xffff, 0xffff]],
    ['LINT', 2n ** 53n + 1n, [0x0001, 0, 0, 0x0020]],
    ['LINT', -(2n ** 63n), [0, 0, 0, 0x8000]],
    ['ULINT', 0x0123456789abcdefn, [0xcdef, 0x89ab, 0x4567, 0x0123]],
    ['ULINT', 2n ** 64n - 1n, [0xffff, 0xffff, 0xffff, 0xffff]],
    ['BCD16', 1234, [0x1234]],
    ['BCD32', 12345678, [0x5678, 0x1234]],
    ['BCD32', 99999999, [0x9999, 0x9999]],
  ])('%s %p', (type, value, expected) => {
    expect(encode(type, value)).toEqual(expected)
    expect(Object.is(decode(type, expected), value)).toBe(true)
  })

  test('another order moves words, bytes or both', () => {
    const expected: [number, number[]][] = [
      [0, [0x5678, 0x1234]],
      [2, [0x1234, 0x5678]],
      [3, [0x7856, 0x3412]],
      [4, [0x3412, 0x7856]],
    ]
    for (const [order, image] of expected) expect(encode('DINT', 0x12345678, orders[order])).toEqual(image)
    expect(encode('ULINT', 0x0123456789abcdefn, orders[2])).toEqual([0x0123, 0x4567, 0x89ab, 0xcdef])
    expect(encode('INT', 0x1234, orders[2])).toEqual([0x1234])
    expect(encode('INT', 0x1234, orders[3])).toEqual([0x3412])
  })
})

describe.each(orders)('in order %j', (order) => {
  test.each(Object.entries(numbers))('%s comes back as it was written', (type, values) => {
    fc.assert(
      fc.property(values, (value) => {
        const image = encode(type, value, order)
        expect(image).toHaveLength(wordsOf(parseType(type)))
        expect(decode(type, image, order)).toBe(value)
      }),
    )
  })

  test.each(Object.keys(numbers))('%s: any words that hold a value are written back as they were', (type) => {
    fc.assert(
      fc.property(words(wordsOf(parseType(type))), (image) => {
        // Binary coded decimal and floating point have patterns that are no number.
        const value = valueOrFault(type, image, order)
        if (value === undefined) return
        expect(encode(type, value, order)).toEqual(image)
      }),
    )
  })
})

function valueOrFault(type: string, image: number[], order: (typeof orders)[number]): PlcValue | undefined {
  try {
    const value = decode(type, image, order)
    return typeof value === 'number' && !Number.isFinite(value) ? undefined : value
  } catch (error) {
    expect(type).toMatch(/^BCD/)
    expect(error).toBeInstanceOf(ProtocolError)
    return undefined
  }
}

describe('what the PLC holds', () => {
  test('a digit above 9 is no binary coded decimal', () => {
    expect(refusal('BAD_FIELD', () => decode('BCD16', [0x12af]))).toMatch(/12AFH .*BCD16.*WORD/)
    expect(refusal('BAD_FIELD', () => decode('BCD32', [0x0000, 0xa000]))).toMatch(/A000H/)
    expect(refusal('BAD_FIELD', () => decode('BCD32', [0x000a, 0x0000]))).toMatch(/000AH/)
  })

  test('infinities and not-a-number are shown as they are', () => {
    expect(decode('REAL', [0, 0x7f80])).toBe(Number.POSITIVE_INFINITY)
    expect(decode('REAL', [0, 0xff80])).toBe(Number.NEGATIVE_INFINITY)
    expect(decode('REAL', [1, 0x7fc0])).toBeNaN()
    expect(decode('LREAL', [0, 0, 0, 0x7ff0])).toBe(Number.POSITIVE_INFINITY)
    expect(decode('LREAL', [1, 0, 0, 0x7ff8])).toBeNaN()
  })
})

const wholeNumbers = ['INT', 'UINT', 'WORD', 'DINT', 'UDINT', 'DWORD', 'TIME', 'BCD16', 'BCD32', 'LINT', 'ULINT']
const notNumbers: readonly unknown[] = [
  '12',
  '',
  true,
  false,
  null,
  undefined,
  {},
  [],
  [1],
  new Date(0),
  Symbol('s'),
  () => 1,
]

describe('what is written', () => {
  function refused(type: string, value: unknown): string {
    return refusal('BAD_VALUE', () => Reflect.apply(encode, undefined, [type, value]))
  }

  test.each(Object.keys(numbers))('%s refuses every other kind of value', (type) => {
    for (const value of notNumbers) refused(type, value)
    refused(type, Object(1))
  })

  test.each(wholeNumbers)('%s refuses fractions, infinities and not-a-number', (type) => {
    for (const value of [0.5, 1e-9, Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY])
      refused(type, value)
  })

  test.each(wholeNumbers)('%s refuses the first number outside its range, on both sides and as BigInt', (type) => {
    const row = valueTypes[parseType(type).name]
    if (!('min' in row)) throw new Error(`${type} has no range`)
    for (const outside of [BigInt(row.min) - 1n, BigInt(row.max) + 1n, 2n ** 70n]) {
      expect(refused(type, outside)).toContain(`${row.max}`)
      refused(type, Number(outside))
    }
  })

  test.each(['REAL', 'LREAL'])('%s refuses infinities, not-a-number and BigInt', (type) => {
    for (const value of [Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY, 1n]) refused(type, value)
  })

  test('REAL refuses what would become infinity, and takes the largest that does not', () => {
    expect(refused('REAL', 3.5e38)).toMatch(/3\.5e\+38.*REAL.*3\.4028235e38/)
    refused('REAL', -Number.MAX_VALUE)
    // Half a unit above the largest REAL is where rounding goes up.
    refused('REAL', 3.4028235677973366e38)
    expect(decode('REAL', encode('REAL', 3.4028235e38))).toBe(3.4028234663852886e38)
  })

  test('REAL is the nearest 32-bit number', () => {
    fc.assert(
      fc.property(fc.double({ min: -3.4e38, max: 3.4e38, noNaN: true }), (value) => {
        expect(decode('REAL', encode('REAL', value))).toBe(Math.fround(value))
      }),
    )
  })

  test('a BigInt within the range is a whole number like any other', () => {
    expect(encode('INT', -1n)).toEqual([0xffff])
    expect(encode('UDINT', 4294967295n)).toEqual([0xffff, 0xffff])
    expect(encode('BCD16', 1234n)).toEqual([0x1234])
  })

  test('a 64-bit type takes a safe whole number, and no other number', () => {
    expect(decode('LINT', encode('LINT', Number.MIN_SAFE_INTEGER))).toBe(-(2n ** 53n) + 1n)
    expect(decode('ULINT', encode('ULINT', Number.MAX_SAFE_INTEGER))).toBe(2n ** 53n - 1n)
    expect(refused('LINT', 2 ** 53)).toMatch(/BigInt/)
    refused('ULINT', -1)
  })

  test('minus zero is zero for whole numbers', () => {
    for (const type of wholeNumbers) expect(encode(type, -0)).toEqual(encode(type, 0))
  })

  test('the message says what was given and what the type takes', () => {
    expect(refused('INT', 40000)).toBe('40000 is not a value of INT: it takes a whole number from -32768 to 32767')
    expect(refused('INT', '12')).toMatch(/^'12' is not/)
  })
})

test('BOOL is refused: a word is not a bit', () => {
  refusal('BAD_TYPE', () => encode('BOOL', true))
  refusal('BAD_TYPE', () => decode('BOOL', [1]))
})
