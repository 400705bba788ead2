/** Items of a Sharp JW: texts and objects, what they are, and what is refused. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import type { Item } from '../../src/client/item/parts'
import { formatJwItem, type JwItemOptions, type ParsedJwItem, parseJwItem } from '../../src/client/jw/item'
import { RequestError } from '../../src/errors'
import { assumedJwAreas } from '../../src/jw/operand/area'
import { formatJwOperand } from '../../src/jw/operand/notation'
import { formatByteType } from '../../src/value/byte-type'

function messageOf(item: Item, options?: JwItemOptions): string {
  try {
    parseJwItem(item, options)
  } catch (error) {
    if (error instanceof RequestError) return `${error.code} ${error.message}`
    throw error
  }
  return 'no error'
}

/** Text, operand, type, count, canonical text. */
const TEXTS: readonly (readonly [string, string, string, (number | undefined)?, string?])[] = [
  ['004033', '004033', 'BOOL'],
  ['04033', '004033', 'BOOL', undefined, '004033'],
  ['09012', '09012', 'BYTE'],
  ['09012.3', '09012.3', 'BOOL'],
  ['KO0403', 'KO0403', 'BYTE'],
  ['コ0403:WORD', 'KO0403', 'WORD', undefined, 'KO0403:WORD'],
  ['b0012', 'b0012', 'BYTE'],
  ['b0012:WORD', 'b0012', 'WORD'],
  ['#0201', '#0201', 'BYTE'],
  ['TMR0012', 'TMR0012', 'UINT'],
  ['CNT0012:WORD', 'CNT0012', 'WORD'],
  ['TMR0012:BOOL', 'TMR0012', 'BOOL'],
  ['MD0012:WORD', 'MD0012', 'WORD'],
  ['TMR0000[16]', 'TMR0000', 'UINT', 16],
  ['TMR0000..TMR0017', 'TMR0000', 'UINT', 16, 'TMR0000[16]'],
  ['F1:00001234', 'F1:00001234', 'BYTE'],
  ['F1:1234:REAL', 'F1:00001234', 'REAL', undefined, 'F1:00001234:REAL'],
  ['F1:00001234.3', 'F1:00001234.3', 'BOOL'],
  ['F1:00001234:INT[4]', 'F1:00001234', 'INT', 4],
  ['F1:00000000..F1:00000017', 'F1:00000000', 'BYTE', 16, 'F1:00000000[16]'],
  ['F1:0..F1:17:INT', 'F1:00000000', 'INT', 8, 'F1:00000000:INT[8]'],
  ['F2:000000[3]', 'F2:000000', 'BYTE', 3],
  ['F2:000000,3', 'F2:000000', 'BYTE', 3, 'F2:000000[3]'],
  ['09012:int', '09012', 'INT', undefined, '09012:INT'],
  ['09012:DINT', '09012', 'DINT'],
  ['09012:BCD8', '09012', 'BCD8'],
  ['09012:BCD32', '09012', 'BCD32'],
  ['09012:SINT', '09012', 'SINT'],
  ['09012:byte', '09012', 'BYTE', undefined, '09012'],
  ['09012:UINT8', '09012', 'USINT', undefined, '09012:USINT'],
  ['09012:STRING(5)', '09012', 'STRING(5)'],
  ['09012:STRING(5)[3]', '09012', 'STRING(5)', 3],
  ['09012:ワード[符号付き][2]', '09012', 'INT', 2, '09012:INT[2]'],
  ['09012[16]', '09012', 'BYTE', 16],
  ['09012,16', '09012', 'BYTE', 16, '09012[16]'],
  ['09770[16]', '09770', 'BYTE', 16],
  ['09000..09017', '09000', 'BYTE', 16, '09000[16]'],
  ['09000..09017:INT', '09000', 'INT', 8, '09000:INT[8]'],
  ['09770..19007', '09770', 'BYTE', 16, '09770[16]'],
  ['004000[16]', '004000', 'BOOL', 16],
  ['004000..004017', '004000', 'BOOL', 16, '004000[16]'],
  ['003770..004007', '003770', 'BOOL', 16, '003770[16]'],
  ['09012.6[4]', '09012.6', 'BOOL', 4],
  ['09012.6..09013.1', '09012.6', 'BOOL', 4, '09012.6[4]'],
]

describe('items of a Sharp JW', () => {
  test.each(TEXTS)('%s', (...[text, operand, type, count, canonical = text]) => {
    const item = parseJwItem(text)
    expect(formatJwOperand(item.operand)).toBe(operand)
    expect(formatByteType(item.type)).toBe(type)
    expect(item.count).toBe(count)
    expect(item.text).toBe(text)
    expect(formatJwItem(item)).toBe(canonical)
    const { text: _text, ...same } = parseJwItem(canonical)
    expect(same).toEqual({ ...item, text: undefined })
  })

  test('know where they begin', () => {
    expect(parseJwItem('004033').place).toEqual({ in: 'file', file: 0, address: 0x103, bit: 3 })
    expect(parseJwItem('09012:INT').place).toEqual({ in: 'file', file: 0, address: 0x80a })
    expect(parseJwItem('TMR0012').place).toEqual({ in: 'timer', number: 10 })
    expect(parseJwItem('#0201').place).toEqual({ in: 'system', address: 0x81 })
    expect(parseJwItem('E0012', { areas: assumedJwAreas }).place).toEqual({ in: 'file', file: 0, address: 0o16012 })
  })

  test('as objects have type, count and format of their own, and the format of the client where they have none', () => {
    const given = { address: '09012', type: 'UDINT', count: 2, wordOrder: 'high-first' } as const
    expect(parseJwItem(given, { format: { encoding: 'shift-jis' } })).toEqual({
      text: '09012:UDINT[2]',
      operand: { kind: 'register', number: 10 },
      place: { in: 'file', file: 0, address: 0x80a },
      type: { name: 'UDINT' },
      count: 2,
      format: { encoding: 'shift-jis', wordOrder: 'high-first' },
    })
  })

  const types = fc.constantFrom(
    'BYTE',
    'SINT',
    'BCD8',
    'INT',
    'WORD',
    'BCD16',
    'DINT',
    'BCD32',
    'REAL',
    'LREAL',
    'STRING(7)',
  )
  const items = fc.oneof(
    fc.record({
      operand: fc.constantFrom('09012', 'KO0400', '#0201', 'F1:00200000', 'F2:000000'),
      type: types,
    }),
    fc.record({ operand: fc.constantFrom('004033', '09012.7', 'F1:00000000.0'), type: fc.constant('BOOL') }),
    fc.record({ operand: fc.constantFrom('TMR0012', 'CNT0000'), type: fc.constantFrom('UINT', 'WORD', 'BOOL') }),
  )

  test('of any text are items or RequestErrors, and an item is written as what it was read from', () => {
    const pieces = fc.constantFrom(
      '09012',
      '004033',
      'F1:0',
      'F2:',
      'b0012',
      'TMR0001',
      '..',
      ':',
      'INT',
      'BYTE',
      'STRING(3)',
      '[2]',
      ',3',
      '.1',
      ' ',
      '9',
      'コ0001',
    )
    const texts = fc.oneof(
      fc.array(pieces, { maxLength: 6 }).map((parts) => parts.join('')),
      fc.string({ maxLength: 20 }),
    )
    fc.assert(
      fc.property(texts, (text) => {
        if (messageOf(text) !== 'no error') return
        const item = parseJwItem(text)
        expect({ ...parseJwItem(formatJwItem(item)), text }).toEqual(item)
      }),
      { numRuns: 1000 },
    )
  })

  test('formatted are read as the same', () => {
    fc.assert(
      fc.property(items, fc.option(fc.integer({ min: 1, max: 20 })), ({ operand, type }, count) => {
        const item = parseJwItem(`${operand}:${type}${count === null ? '' : `[${count}]`}`)
        const text = formatJwItem(item)
        const again: ParsedJwItem = parseJwItem(text)
        expect({ ...again, text: '' }).toEqual({ ...item, text: '' })
        expect(formatJwItem(again)).toBe(text)
      }),
    )
  })
})

const REFUSED: readonly (readonly [Item, ...string[]])[] = [
  ['D100', 'BAD_ADDRESS "D100": there is no operand', 'MELSEC'],
  ['D100:REAL', 'BAD_ADDRESS', 'MELSEC'],
  ['04083', 'BAD_ADDRESS', 'octal'],
  ['016000', 'OUT_OF_RANGE', 'no source says'],
  ['004033:INT', 'BAD_TYPE', '004033 is one bit', 'KO0403'],
  ['09012.3:BYTE', 'BAD_TYPE', '09012.3 is one bit', 'leave .3 out, 09012'],
  ['09012:BOOL', 'BAD_TYPE', '09012 is a byte: name the bit, 09012.0 to 09012.7'],
  ['TMR0012:REAL', 'BAD_TYPE', 'TMR0012 has a current value, which is UINT', 'no REAL'],
  ['TMR0012:BCD16', 'BAD_TYPE', 'has no BCD16'],
  ['b0012:BCD16', 'BAD_TYPE', 'bit 15 of that is no part of the number', 'take TMR0005 or CNT0005'],
  ['b0013:WORD', 'BAD_TYPE', 'the high byte of a current value: its word begins at b0012'],
  ['b0013:INT', 'BAD_TYPE', 'take TMR0005 or CNT0005, BYTE and WORD'],
  ['09012:FOO', 'BAD_TYPE', "'FOO' is not a type", 'BYTE USINT SINT BCD8'],
  ['09012:BCD', 'BAD_TYPE', 'BCD16 has 4 digits'],
  ['F1:REAL', 'BAD_ADDRESS', 'there is no operand "F1"'],
  ['09012[0]', 'OUT_OF_RANGE', 'a whole number from 1'],
  ['99770:DINT[3]', 'OUT_OF_RANGE', 'it takes 12 bytes, and from here on 8 lie in one piece'],
  ['99777:INT', 'OUT_OF_RANGE', 'it takes 2 bytes, and from here on 1 lie in one piece'],
  ['015777[2]', 'OUT_OF_RANGE', 'it takes 2 bits, and from here on 1 lie in one piece'],
  ['F2:177777:INT', 'OUT_OF_RANGE', 'from here on 1 lie in one piece'],
  ['TMR177770[16]', 'OUT_OF_RANGE', 'it takes 16 numbers, and from here on 8'],
  ['004000..09017', 'BAD_ADDRESS', 'both ends of a range are of one kind'],
  ['09000..09017.3', 'BAD_ADDRESS', 'both ends of a range are of one kind'],
  ['F1:0..F2:17', 'BAD_ADDRESS', 'both ends of a range are of one kind'],
  ['F1:0..17', 'BAD_ADDRESS', '"17"'],
  ['09017..09000', 'BAD_ADDRESS', 'the range ends before it starts'],
  ['09000..09002:INT', 'BAD_ADDRESS', 'the range has 3 points, and one INT takes 2'],
  ['09000~09017', 'BAD_ADDRESS', 'a range is written with two dots: 09000..09017'],
  ['09000-09017', 'BAD_ADDRESS', '09000..09017'],
  ['004000~004017', 'BAD_ADDRESS', '004000..004017'],
  ['09012,bit3', 'BAD_ADDRESS', 'a bit is one digit behind a dot', '09012.3'],
  ['09012, 09013', 'BAD_ADDRESS', 'these are 2 items'],
  ['09012:INT,10', 'BAD_TYPE', '09012:INT[10]'],
  ['09012:STR,10', 'BAD_TYPE', '09012:STRING(10)'],
  ['09012:STRING[5]', 'BAD_TYPE', 'write STRING(20) for up to 20'],
  ['09012[3]:INT', 'BAD_ADDRESS', '09012:INT[3]'],
  ['09012(10)', 'BAD_ADDRESS', '09012[10]'],
  ['09012:3', 'BAD_ADDRESS', '09012.3', '09012[3]'],
  ['label:Motor', 'UNSUPPORTED'],
  [{ address: '09012:INT', type: 'UINT' }, 'BAD_OPTION', 'the type is given twice'],
  [{ address: '09012', bytes: 2 } as Item, 'BAD_OPTION', 'an item has no "bytes"'],
  [{ address: 9012 } as unknown as Item, 'BAD_ADDRESS', 'The address of an item is a text'],
  [{ address: '09012', byteOrder: 'low' } as unknown as Item, 'BAD_OPTION', 'byteOrder'],
]

describe('what is no item is refused', () => {
  test.each(REFUSED)('%p', (item, ...parts) => {
    for (const part of parts) expect(messageOf(item)).toContain(part)
  })
})
