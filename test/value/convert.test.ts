import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import {
  decodeArray,
  decoderOf,
  decodeValue,
  encodeArray,
  encodeValue,
  type PlcValue,
  parseType,
  wordsOf,
} from '../../src/value/value'
import { numbers, orders, refusal, words } from './support'

describe.each(orders)('arrays in order %j', (order) => {
  test.each(Object.entries(numbers))('%s: an array is its values one by one', (text, values) => {
    const type = parseType(text)
    const size = wordsOf(type)
    fc.assert(
      fc.property(fc.array(values, { maxLength: 12 }), words(3), (elements, before) => {
        const image = encodeArray(type, elements, order)
        expect(image).toEqual(elements.flatMap((value) => encodeValue(type, value, order)))
        const framed = [...before, ...image, 0xffff]
        expect(decodeArray(type, framed, 3, elements.length, order)).toEqual(elements)
        for (const [index, value] of elements.entries())
          expect(decodeValue(type, framed, 3 + index * size, order)).toBe(value)
        const decode = decoderOf(type, order)
        for (const [index, value] of elements.entries()) expect(decode(framed, 3 + index * size)).toBe(value)
        expect(() => decode(framed, framed.length)).toThrow(`${size} words from offset ${framed.length} are needed`)
      }),
      { numRuns: 40 },
    )
  })
})

test('an array of text has its elements at equal distances', () => {
  const type = parseType('STRING(5)')
  const image = encodeArray(type, ['12AB', '', 'XYZZY'])
  expect(image).toEqual([0x3231, 0x4241, 0, 0, 0, 0, 0x5958, 0x5a5a, 0x0059])
  expect(decodeArray(type, image, 0, 3)).toEqual(['12AB', '', 'XYZZY'])
})

test('words may be a typed array', () => {
  expect(decodeArray(parseType('INT'), Uint16Array.of(1, 0xffff), 0, 2)).toEqual([1, -1])
})

test('no values give no words, and the reverse', () => {
  expect(encodeArray(parseType('INT'), [])).toEqual([])
  expect(decodeArray(parseType('INT'), [], 0, 0)).toEqual([])
})

describe('what does not fit is refused', () => {
  const real = parseType('REAL')

  test('too few words, or an offset outside them', () => {
    expect(refusal('OUT_OF_RANGE', () => decodeValue(real, [0], 0))).toMatch(/2 words from offset 0.*1 words are given/)
    refusal('OUT_OF_RANGE', () => decodeValue(real, [0, 0, 0], 2))
    for (const offset of [-1, 0.5, Number.NaN]) refusal('OUT_OF_RANGE', () => decodeValue(real, [0, 0, 0], offset))
    refusal('OUT_OF_RANGE', () => decodeArray(real, [0, 0, 0], 0, 2))
    refusal('OUT_OF_RANGE', () => decodeValue(parseType('STRING(3)'), [0], 0))
  })

  test('a count that is none', () => {
    for (const count of [-1, 0.5, Number.NaN, 2 ** 40])
      refusal('OUT_OF_RANGE', () => decodeArray(real, [0, 0], 0, count))
  })

  test('what is not a word', () => {
    for (const bad of [-1, 65536, 0.5, Number.NaN])
      for (const type of ['INT', 'DINT', 'LINT', 'BCD16', 'STRING(8)', 'WSTRING(4)'])
        for (const order of orders)
          refusal('OUT_OF_RANGE', () => decodeValue(parseType(type), [bad, bad, bad, bad], 0, order))
  })

  test('a sparse or missing array', () => {
    const sparse: PlcValue[] = [1]
    sparse[2] = 3
    expect(refusal('BAD_VALUE', () => encodeArray(parseType('INT'), sparse))).toMatch(/^element 1: undefined/)
    for (const values of ['12', 12, null, undefined, { length: 1 }])
      refusal('BAD_VALUE', () => Reflect.apply(encodeArray, undefined, [parseType('INT'), values]))
  })

  test('the message names the element', () => {
    expect(refusal('BAD_VALUE', () => encodeArray(parseType('INT'), [1, 2, 70000]))).toMatch(/^element 2: 70000/)
    expect(refusal('BAD_FIELD', () => decodeArray(parseType('BCD16'), [1, 0xf], 0, 2))).toMatch(/^element 1: 000FH/)
    expect(refusal('BAD_FIELD', () => decodeArray(parseType('STRING(2)'), [0x41, 0xff], 0, 2))).toMatch(/^element 1: /)
    expect(refusal('BAD_VALUE', () => encodeValue(parseType('INT'), 70000))).toMatch(/^70000/)
  })
})

describe('a format', () => {
  test.each([
    [{ wordOrder: 'big' }, /wordOrder is low-first or high-first, not 'big'/],
    [{ byteOrder: true }, /byteOrder/],
    [{ encoding: 'sjis' }, /encoding is ascii or utf8 or shift-jis or gbk or gb18030 or utf16/],
    [{ trimSpaces: 'yes' }, /trimSpaces is false or true/],
    [{ wordorder: 'high-first' }, /no option 'wordorder'. Options: wordOrder, byteOrder, encoding, trimSpaces/],
    [{ toString: 1 }, /no option 'toString'/],
    [null, /object/],
    ['high-first', /object/],
  ])('%j is refused by every function', (format, message) => {
    const type = parseType('INT')
    const runs: [(...parameters: never[]) => unknown, unknown[]][] = [
      [decodeValue, [type, [0], 0, format]],
      [decodeArray, [type, [0], 0, 1, format]],
      [decoderOf, [type, format]],
      [encodeValue, [type, 0, format]],
      [encodeArray, [type, [0], format]],
    ]
    for (const [run, parameters] of runs)
      expect(refusal('BAD_OPTION', () => Reflect.apply(run, undefined, parameters))).toMatch(message)
  })

  test('an option may be left undefined', () => {
    expect(Reflect.apply(encodeValue, undefined, [parseType('INT'), 1, { wordOrder: undefined }])).toEqual([1])
  })
})
