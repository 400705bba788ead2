import { expect } from '@jest/globals'
import fc from 'fast-check'
import { PlcError, type PlcErrorCode } from '../../src/errors'
import { decodeValue, encodeValue, type PlcValue, parseType, type ValueFormat } from '../../src/value/value'

/** Runs, expects an error of this package with the code, and gives its message. */
export function refusal(code: PlcErrorCode, run: () => unknown): string {
  let error: unknown
  try {
    run()
  } catch (thrown) {
    error = thrown
  }
  expect(error).toBeInstanceOf(PlcError)
  if (!(error instanceof PlcError)) return ''
  expect(error.code).toBe(code)
  return error.message
}

export function encode(type: string, value: PlcValue, format?: ValueFormat): number[] {
  return encodeValue(parseType(type), value, format)
}

export function decode(type: string, words: ArrayLike<number>, format?: ValueFormat): PlcValue {
  return decodeValue(parseType(type), words, 0, format)
}

/** Every order there is, also the ones left out. */
export const orders: readonly ValueFormat[] = [
  {},
  { wordOrder: 'low-first', byteOrder: 'low-first' },
  { wordOrder: 'high-first' },
  { byteOrder: 'high-first' },
  { wordOrder: 'high-first', byteOrder: 'high-first' },
]

export function words(count: number): fc.Arbitrary<number[]> {
  return fc.array(fc.integer({ min: 0, max: 0xffff }), { minLength: count, maxLength: count })
}

/** Values of every numeric type, with their edges. */
export const numbers: { readonly [type: string]: fc.Arbitrary<number | bigint> } = {
  INT: fc.integer({ min: -0x8000, max: 0x7fff }),
  UINT: fc.integer({ min: 0, max: 0xffff }),
  WORD: fc.integer({ min: 0, max: 0xffff }),
  DINT: fc.integer({ min: -0x80000000, max: 0x7fffffff }),
  UDINT: fc.integer({ min: 0, max: 0xffffffff }),
  DWORD: fc.integer({ min: 0, max: 0xffffffff }),
  TIME: fc.integer({ min: -0x80000000, max: 0x7fffffff }),
  LINT: fc.bigInt({ min: -(2n ** 63n), max: 2n ** 63n - 1n }),
  ULINT: fc.bigInt({ min: 0n, max: 2n ** 64n - 1n }),
  REAL: fc.float({ noNaN: true, noDefaultInfinity: true }),
  LREAL: fc.double({ noNaN: true, noDefaultInfinity: true }),
  BCD16: fc.integer({ min: 0, max: 9999 }),
  BCD32: fc.integer({ min: 0, max: 99999999 }),
}
