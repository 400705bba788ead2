import { describe, expect, test } from '@jest/globals'
import {
  formatType,
  type PlcValue,
  parseType,
  type TypeToValue,
  typeNames,
  type ValueOf,
  valueTypes,
  wordsOf,
} from '../../src/value/value'
import { refusal } from './support'

describe('parseType', () => {
  test('every name of the table parses to itself and formats back', () => {
    for (const name of typeNames) {
      const text = valueTypes[name].kind === 'text' ? `${name}(7)` : name
      expect(formatType(parseType(text))).toBe(text)
    }
  })

  test.each([
    ['real', 'REAL'],
    [' Real ', 'REAL'],
    ['string(20)', 'STRING(20)'],
    ['STRING ( 020 )', 'STRING(20)'],
    ['wstring(16383)', 'WSTRING(16383)'],
    ['FLOAT', 'REAL'],
    ['float64', 'LREAL'],
    ['INT16', 'INT'],
    ['UINT32', 'UDINT'],
    ['int64', 'LINT'],
    ['STR(20)', 'STRING(20)'],
    ['Bit', 'BOOL'],
    ['Word [Signed]', 'INT'],
    ['Word [Unsigned]/Bit String [16-bit]', 'WORD'],
    ['Double  Word [Signed]', 'DINT'],
    ['Double Word [Unsigned]/Bit String [32-bit]', 'DWORD'],
    ['FLOAT [Single Precision]', 'REAL'],
    ['FLOAT [Double Precision]', 'LREAL'],
    ['Time', 'TIME'],
    ['String(32)', 'STRING(32)'],
    ['String [Unicode](32)', 'WSTRING(32)'],
  ])('accepts %s as %s', (text, canonical) => {
    expect(formatType(parseType(text))).toBe(canonical)
  })

  test.each([
    ['DOUBLE', /LREAL.*DINT/],
    ['long', /DINT has 32 bits, LINT has 64/],
    ['BCD', /BCD16 has 4 digits/],
    ['D', /UDINT/],
    ['STRING[20]', /parentheses: STRING\(20\)/],
    ['STRING', /needs a length: write STRING\(20\)/],
    ['STRING(0)', /from 1 to 16383/],
    ['WSTRING(16384)', /from 1 to 16383/],
    ['REAL(4)', /REAL has no length/],
    ['REALL', /Types: BOOL INT .*STRING\(n\)/],
    ['', /is not a type/],
    ['(3)', /is not a type/],
    ['STRING(-1)', /is not a type/],
    ['STRING(1.5)', /is not a type/],
    ['STRING(20', /is not a type/],
    ['toString', /is not a type/],
    ['__proto__', /is not a type/],
  ])('refuses %s and says what to write', (text, message) => {
    expect(refusal('BAD_TYPE', () => parseType(text))).toMatch(message)
  })

  test('refuses what is no text', () => {
    const parse: (text: never) => unknown = parseType
    refusal('BAD_TYPE', () => Reflect.apply(parse, undefined, [5]))
    refusal('BAD_TYPE', () => Reflect.apply(parse, undefined, [undefined]))
  })
})

describe('a type made by hand is held to the same rules', () => {
  test.each([
    [{ name: 'STRING' }],
    [{ name: 'STRING', length: 1.5 }],
    [{ name: 'STRING', length: 0 }],
    [{ name: 'INT', length: 2 }],
    [{ name: 'FLOAT' }],
    [{ name: 'constructor' }],
  ])('%j', (type) => {
    refusal('BAD_TYPE', () => Reflect.apply(formatType, undefined, [type]))
    refusal('BAD_TYPE', () => Reflect.apply(wordsOf, undefined, [type]))
  })
})

describe('wordsOf', () => {
  test.each([
    ['INT', 1],
    ['UINT', 1],
    ['WORD', 1],
    ['BCD16', 1],
    ['DINT', 2],
    ['UDINT', 2],
    ['DWORD', 2],
    ['BCD32', 2],
    ['REAL', 2],
    ['TIME', 2],
    ['LINT', 4],
    ['ULINT', 4],
    ['LREAL', 4],
    ['STRING(1)', 1],
    ['STRING(2)', 1],
    ['STRING(5)', 3],
    ['WSTRING(5)', 5],
  ])('%s takes %d words', (type, count) => {
    expect(wordsOf(parseType(type))).toBe(count)
  })

  test('BOOL is no words', () => {
    expect(refusal('BAD_TYPE', () => wordsOf(parseType('BOOL')))).toMatch(/D100\.F/)
  })
})

test('the JavaScript type of a value follows from the type, at compile time', () => {
  const real: ValueOf<'REAL'> = 0.75
  const small: ValueOf<'int'> = 1
  const big: ValueOf<'LINT'> = 1n
  const text: ValueOf<'string(20)'> = 'A'
  const bit: TypeToValue['BOOL'] = true
  const any: ValueOf<string> = text satisfies PlcValue
  // @ts-expect-error a LINT is a BigInt
  const wrong: ValueOf<'LINT'> = 1
  expect([real, small, big, text, bit, any, wrong]).toEqual([0.75, 1, 1n, 'A', true, 'A', 1])
})
