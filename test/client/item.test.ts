import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { formatItem, type ParsedItem, parseItem, tryParseItem } from '../../src/client/item/item'
import type { Item } from '../../src/client/item/parts'
import { RequestError } from '../../src/errors'
import { devices } from '../../src/melsec/device/device'

const options = { xyRadix: 16 } as const

function parse(item: Item, xyRadix: 8 | 16 = 16): Omit<ParsedItem, 'text' | 'format'> {
  const { text: _, format: __, ...parsed } = parseItem(item, { xyRadix })
  return parsed
}

function refused(item: Item): RequestError {
  try {
    parseItem(item, options)
  } catch (error) {
    if (error instanceof RequestError) return error
    throw error
  }
  throw new Error(`${JSON.stringify(item)} was accepted`)
}

describe('an item without a type', () => {
  test.each([
    ['D100', 'INT'],
    ['SD203', 'INT'],
    ['TN5', 'INT'],
    ['U3\\G100', 'INT'],
    ['M0', 'BOOL'],
    ['X1F', 'BOOL'],
    ['TS5', 'BOOL'],
    ['LTS5', 'BOOL'],
    ['LTN5', 'DINT'],
    ['LCN5', 'DINT'],
    ['LZ1', 'DINT'],
    ['D100.F', 'BOOL'],
    ['K1M0', 'INT'],
    ['K4M0', 'INT'],
    ['K5M0', 'DINT'],
    ['K8M0', 'DINT'],
  ])('%s is %s, one value', (text, type) => {
    const { type: parsed, count } = parse(text)
    expect(parsed).toEqual({ name: type })
    expect(count).toBeUndefined()
  })
})

describe('a type, a count, a range', () => {
  test('the type stands behind a colon, in any case and with spaces', () => {
    expect(parse('d100:real')).toEqual({ address: { device: 'D', number: 100 }, type: { name: 'REAL' } })
    expect(parse(' D0100 : STRING( 20 ) ').type).toEqual({ name: 'STRING', length: 20 })
    expect(parse('D100:Word [Signed]').type).toEqual({ name: 'INT' })
    expect(parse('D100:FLOAT').type).toEqual({ name: 'REAL' })
  })

  test.each([
    ['D100:REAL[10]', 10],
    ['D100[1]', 1],
    ['M0[16]', 16],
    ['M0..M15', 16],
    ['M5..M5', 1],
    ['X0..X1F', 32],
    ['D0..D9', 10],
    ['D0..D9:DINT', 5],
    ['D0..D9:LINT', undefined],
    ['D100.0..D100.F', 16],
    ['D100.8..D101.7', 16],
    ['D100.3[20]', 20],
    ['LTN0..LTN9', 10],
    ['K4M0..K4M48', 4],
    ['K4M0[3]', 3],
    ['D0..D39:STRING(20)', 4],
    ['U3\\G0..U3\\G9', 10],
    ['J1\\W0..J1\\WF', 16],
  ])('%s has %s values', (text, count) => {
    if (count === undefined) expect(refused(text).code).toBe('BAD_ADDRESS')
    else expect(parse(text).count).toBe(count)
  })

  test('a range counts in the radix of its device', () => {
    expect(parse('X0..X17', 8)).toEqual({ address: { device: 'X', number: 0 }, type: { name: 'BOOL' }, count: 16 })
    expect(parse('X0..X17', 16).count).toBe(24)
  })
})

describe('an object', () => {
  test('carries what the text does not', () => {
    const item = parseItem(
      { address: 'D100', type: 'REAL', count: 10, wordOrder: 'high-first', trimSpaces: true },
      options,
    )
    expect(item).toEqual({
      text: 'D100:REAL[10]',
      address: { device: 'D', number: 100 },
      type: { name: 'REAL' },
      count: 10,
      format: { wordOrder: 'high-first', trimSpaces: true },
    })
  })

  test('overrides the usual format field by field', () => {
    const format = { encoding: 'shift-jis', byteOrder: 'high-first' } as const
    const item = parseItem({ address: 'D0:STRING(4)', encoding: 'utf8' }, { ...options, format })
    expect(item.format).toEqual({ encoding: 'utf8', byteOrder: 'high-first' })
  })

  test('may repeat what the text says, but not contradict it', () => {
    expect(parse({ address: 'D0:REAL[2]', type: 'REAL', count: 2 }).count).toBe(2)
    expect(refused({ address: 'D0:REAL', type: 'DINT' }).message).toContain('given twice, as REAL and as DINT')
    expect(refused({ address: 'D0[2]', count: 3 }).message).toContain('given twice')
    expect(refused('M0..M15[8]').message).toContain('given twice, as 16 and as 8')
  })

  test('with an unknown field is refused, because a misspelt order would give wrong values', () => {
    const misspelt = { address: 'D0', wordorder: 'high-first' }
    expect(refused(misspelt).message).toContain('no "wordorder"')
  })

  test('with a wrong order is refused', () => {
    // @ts-expect-error: what a program without types may pass
    const wrong: Item = { address: 'D0', wordOrder: 'reversed' }
    expect(refused(wrong).code).toBe('BAD_OPTION')
  })
})

describe('what is no item says what to write', () => {
  test.each([
    ['D100.3,10', 'BAD_ADDRESS', 'D100.3[10]'],
    ['DREAL100', 'BAD_ADDRESS', 'D100:REAL'],
    ['DFLOAT6000', 'BAD_ADDRESS', 'D6000:REAL'],
    ['DSTR6200,20', 'BAD_ADDRESS', 'D6200:STRING(20)'],
    ['DREAL100,5', 'BAD_ADDRESS', 'D100:REAL[5]'],
    ['WINT1F', 'BAD_ADDRESS', 'W1F:INT'],
    ['D100[10]:REAL', 'BAD_ADDRESS', 'D100:REAL[10]'],
    ['D100[x]', 'BAD_ADDRESS', 'in brackets at the end'],
    ['M0..M5..M9', 'BAD_ADDRESS', 'two ends'],
    ['M9..M0', 'BAD_ADDRESS', 'lower number first'],
    ['M0..L15', 'BAD_ADDRESS', 'same device'],
    ['M0..15', 'BAD_ADDRESS', 'M0..M15'],
    ['D0.1..D5', 'BAD_ADDRESS', 'same device'],
    ['D0..D8:DINT', 'BAD_ADDRESS', '9 points'],
    ['D0[0]', 'OUT_OF_RANGE', '1 to'],
    ['D4294967295:DINT', 'OUT_OF_RANGE', 'last device number'],
    ['D0[2000000]', 'OUT_OF_RANGE', '1 to 1048576'],
    ['D0:FOO', 'BAD_TYPE', 'FOO'],
    ['D0:STRING[20]', 'BAD_TYPE', 'STRING(20)'],
    ['D100:BOOL', 'BAD_TYPE', 'D100.0'],
    ['D100.3:INT', 'BAD_TYPE', 'leave .3 out'],
    ['M0:REAL', 'BAD_TYPE', 'K8M'],
    ['M0:STRING(4)', 'BAD_TYPE', 'bit device'],
    ['K4M0:REAL', 'BAD_TYPE', '16 bits'],
    ['K7M0:REAL', 'BAD_TYPE', '28 bits'],
    ['K4M0:BOOL', 'BAD_TYPE', '16 bits'],
    ['LTN0:REAL', 'BAD_TYPE', 'DINT, UDINT, DWORD, TIME'],
    ['LTN0:INT', 'BAD_TYPE', '32 bits'],
    ['@D0:LREAL', 'BAD_TYPE', 'one or two words'],
    ['@D0[4]', 'UNSUPPORTED', 'one value only'],
    ['T5', 'BAD_ADDRESS', 'TN5'],
    ['', 'BAD_ADDRESS', ''],
    ['D0:', 'BAD_TYPE', ''],
  ])('%s', (text, code, part) => {
    const error = refused(text)
    expect(error.code).toBe(code)
    expect(error.message).toContain(part)
  })

  test.each([undefined, null, 5, {}, []])('%p is no item', (given) => {
    // @ts-expect-error: what a program without types may pass
    const item: Item = given
    expect(refused(item).code).toBe('BAD_ADDRESS')
  })

  test('all types of a bit device need digits, and K8 takes 32-bit numbers', () => {
    expect(parse('K8M0:REAL').type).toEqual({ name: 'REAL' })
    expect(parse('K2M0:BCD16').type).toEqual({ name: 'BCD16' })
    expect(parse('K8M0:TIME').type).toEqual({ name: 'TIME' })
  })
})

test('tryParseItem gives the error beside the text', () => {
  const bad = tryParseItem('D100:FOO', options)
  expect(bad).toMatchObject({ text: 'D100:FOO', error: { code: 'BAD_TYPE' } })
  expect(tryParseItem('D100', options)).toMatchObject({ text: 'D100', address: { number: 100 } })
})

describe('formatItem', () => {
  test.each([
    ['d0100 : int', 'D100'],
    ['M0..M15', 'M0[16]'],
    ['D0..D9:dint', 'D0:DINT[5]'],
    ['k4m0', 'K4M0'],
    ['lcn3:dint', 'LCN3'],
    ['d100.f', 'D100.F'],
    ['u3/g100:str(4)', 'U3\\G100:STRING(4)'],
  ])('%s is %s', (text, formatted) => {
    expect(formatItem(parseItem(text, options), options)).toBe(formatted)
  })

  test('is the inverse of parseItem', () => {
    const device = fc.constantFrom(...devices.filter((info) => info.extensionOnly !== true))
    const words = fc.constantFrom('INT', 'REAL', 'LREAL', 'STRING(7)', 'BCD32', 'ULINT')
    const item = fc
      .tuple(
        device,
        fc.nat(8000),
        fc.option(fc.nat(15)),
        fc.integer({ min: 1, max: 8 }),
        words,
        fc.option(fc.integer({ min: 1, max: 99 })),
      )
      .map(([{ name, unit }, number, bit, digits, type, count]): Item => {
        const digitsOf = unit === 'bit' && bit === null ? `K${digits}` : ''
        const plain = formatItem({ address: { device: name, number }, type: { name: 'BOOL' } }, options).split(':')[0]
        const tail = unit === 'word' ? (bit === null ? `:${type}` : `.${bit.toString(16)}`) : ''
        return `${digitsOf}${plain}${tail}${count === null ? '' : `[${count}]`}`
      })
    fc.assert(
      fc.property(item, fc.constantFrom(8 as const, 16 as const), (given, xyRadix) => {
        const parsed = parseItem(given, { xyRadix: 16 })
        const text = formatItem(parsed, { xyRadix })
        expect(parseItem(text, { xyRadix })).toEqual({ ...parsed, text })
      }),
      { numRuns: 500 },
    )
  })
})
