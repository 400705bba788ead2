import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { PlcError } from '../../src/errors'
import { bytesOf, byteTypes, formatByteType, parseByteType } from '../../src/value/byte-type'
import { bytesOfValues, valuesOfBytes } from '../../src/value/byte-value'
import type { ValueFormat } from '../../src/value/format'
import { type PlcValue, typeNames } from '../../src/value/type'

const read = (type: string, hex: string, count = 1, format?: ValueFormat) =>
  valuesOfBytes(parseByteType(type), Buffer.from(hex, 'hex'), 0, count, format)
const written = (type: string, values: readonly PlcValue[], format?: ValueFormat) =>
  Buffer.from(bytesOfValues(parseByteType(type), values, format))
    .toString('hex')
    .toUpperCase()

function messageOf(run: () => unknown): string {
  try {
    run()
  } catch (error) {
    if (error instanceof PlcError) return `${error.code} ${error.message}`
    throw error
  }
  return 'no error'
}

describe('values in bytes', () => {
  test.each<[string, readonly PlcValue[], string, ValueFormat?]>([
    ['BYTE', [0, 0x7f, 0x80, 0xff], '007F80FF'],
    ['USINT', [255], 'FF'],
    ['SINT', [0, 127, -128, -1], '007F80FF'],
    ['BCD8', [0, 9, 10, 99], '00091099'],
    // Low byte first (JW-20FL5 manual, 9-28: 34 92), low word first.
    ['UINT', [0x1234], '3412'],
    ['INT', [-2, 1], 'FEFF0100'],
    ['UDINT', [0x12345678], '78563412'],
    ['BCD16', [1234], '3412'],
    ['BCD32', [12345678], '78563412'],
    ['REAL', [0.75], '0000403F'],
    ['LINT', [-2n], 'FEFFFFFFFFFFFFFF'],
    ['UINT', [0x1234], '1234', { byteOrder: 'high-first' }],
    ['UDINT', [0x12345678], '34127856', { wordOrder: 'high-first' }],
    ['UDINT', [0x12345678], '12345678', { wordOrder: 'high-first', byteOrder: 'high-first' }],
    ['STRING(5)', ['ABCDE'], '4142434445'],
    ['STRING(5)', ['AB'], '4142000000'],
    ['STRING(3)', ['ABC', 'D', 'EFG'], '414243440000454647'],
    ['STRING(4)', ['12AB'], '3132' + '4142'],
    ['STRING(4)', ['12AB'], '3231' + '4241', { byteOrder: 'high-first' }],
    ['WSTRING(2)', ['あ'], '42300000'],
  ])('%s %p is %s', (...[type, values, hex, format]) => {
    expect(written(type, values, format)).toBe(hex)
    expect(read(type, hex, values.length, format)).toEqual(values)
  })

  test('begin at any byte', () => {
    expect(valuesOfBytes({ name: 'UINT' }, Buffer.from('FF341200', 'hex'), 1, 1)).toEqual([0x1234])
    expect(valuesOfBytes({ name: 'STRING', length: 1 }, Buffer.from('4142', 'hex'), 1, 1)).toEqual(['B'])
  })

  test('bytes are those of the types: nothing beside them is read or written', () => {
    expect(bytesOf(parseByteType('BCD8'))).toBe(1)
    expect(bytesOf(parseByteType('INT'))).toBe(2)
    expect(bytesOf(parseByteType('LREAL'))).toBe(8)
    expect(bytesOf(parseByteType('STRING(5)'))).toBe(5)
    expect(bytesOf(parseByteType('WSTRING(5)'))).toBe(10)
    expect(messageOf(() => bytesOf({ name: 'BOOL' }))).toContain('BAD_TYPE')
  })

  test('every type is read by its name and its other spellings', () => {
    for (const name of [...Object.keys(byteTypes), ...typeNames]) {
      const text = name.endsWith('STRING') ? `${name}(4)` : name
      expect(formatByteType(parseByteType(text.toLowerCase()))).toBe(text)
    }
    expect(parseByteType(' uint8 ')).toEqual({ name: 'USINT' })
    expect(parseByteType('INT8')).toEqual({ name: 'SINT' })
    expect(messageOf(() => parseByteType('OCTET'))).toMatch(/BAD_TYPE 'OCTET' is not a type.* BYTE USINT SINT BCD8/)
  })

  test.each<[string, PlcValue]>([
    ['BYTE', 256],
    ['BYTE', -1],
    ['SINT', 128],
    ['BCD8', 100],
    ['BYTE', 1.5],
    ['BYTE', '1'],
    ['BYTE', true],
    ['BYTE', Number.NaN],
    ['STRING(3)', 'ABCD'],
  ])('%s refuses %p', (type, value) => {
    expect(messageOf(() => written(type, [value]))).toMatch(/^BAD_VALUE/)
  })

  test('what is no value is told', () => {
    expect(messageOf(() => read('BCD8', '12A4', 2))).toBe(
      'BAD_FIELD element 1: A4H in the PLC is not a value of BCD8: a digit is above 9; read it as BYTE, or correct its type',
    )
    expect(messageOf(() => read('BCD16', '34A2'))).toContain('A234H in the PLC is not a value of BCD16')
    expect(messageOf(() => read('INT', '01'))).toBe(
      'OUT_OF_RANGE 2 bytes from offset 0 are needed, but 1 bytes are given',
    )
    expect(messageOf(() => read('STRING(3)', '414243', 1, { byteOrder: 'high-first' }))).toContain('use an even length')
    expect(messageOf(() => written('STRING(3)', ['A'], { byteOrder: 'high-first' }))).toContain('use an even length')
  })

  test('numbers of one byte come back as they were written', () => {
    const ranges = { BYTE: [0, 255], USINT: [0, 255], SINT: [-128, 127], BCD8: [0, 99] } as const
    for (const [name, [min, max]] of Object.entries(ranges)) {
      const all = Array.from({ length: max - min + 1 }, (_, i) => min + i)
      expect(valuesOfBytes(parseByteType(name), bytesOfValues(parseByteType(name), all), 0, all.length)).toEqual(all)
      expect(bytesOfValues(parseByteType(name), all.map(BigInt))).toEqual(bytesOfValues(parseByteType(name), all))
    }
  })

  test('texts of any length and number come back', () => {
    const printable = fc.string({ unit: fc.integer({ min: 0x20, max: 0x7e }).map((c) => String.fromCharCode(c)) })
    fc.assert(
      fc.property(fc.integer({ min: 1, max: 9 }), fc.array(printable, { maxLength: 5 }), (length, texts) => {
        const values = texts.map((text) => text.slice(0, length))
        const type = { name: 'STRING', length } as const
        const bytes = bytesOfValues(type, values)
        expect(bytes).toHaveLength(length * values.length)
        expect(valuesOfBytes(type, bytes, 0, values.length)).toEqual(values)
      }),
    )
  })
})
