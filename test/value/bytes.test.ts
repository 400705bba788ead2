import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { decodeValue, parseType, valueOfBytes } from '../../src/value/value'
import { refusal } from './support'

describe('a value of bytes', () => {
  test.each([
    ['INT', [0xff, 0xff], 0, -1],
    ['WORD', [0x34, 0x12], 0, 0x1234],
    ['WORD', [0, 0, 0x34, 0x12], 1, 0x1234],
    ['REAL', [0, 0, 0x40, 0x3f], 0, 0.75],
    ['DINT', [9, 9, 0xfe, 0xff, 0xff, 0xff], 1, -2],
    ['STRING(4)', [0x41, 0x42, 0x43, 0x44], 0, 'ABCD'],
    ['STRING(3)', [0x41, 0x42, 0x43], 0, 'ABC'],
    ['STRING(4)', [0x41, 0x42, 0x43], 0, 'ABC'],
  ])('%s of %j from word %d is %j', (type, bytes, offset, value) => {
    expect(valueOfBytes(Uint8Array.from(bytes), type, offset)).toBe(value)
  })

  test('is that of the same words, whatever the type and order', () => {
    const types = fc.constantFrom('INT', 'UINT', 'DINT', 'UDINT', 'LINT', 'REAL', 'LREAL', 'WSTRING(2)')
    const formats = fc.record({ wordOrder: fc.constantFrom('low-first', 'high-first') } as const)
    fc.assert(
      fc.property(fc.uint8Array({ minLength: 10, maxLength: 11 }), types, formats, (bytes, type, format) => {
        const view = Buffer.from(bytes)
        const words = [0, 1, 2, 3, 4].map((at) => view.readUInt16LE(2 * at))
        const value = (read: () => unknown) => {
          try {
            return read()
          } catch (error) {
            return String(error)
          }
        }
        expect(value(() => valueOfBytes(bytes, type, 1, format))).toEqual(
          value(() => decodeValue(parseType(type), words, 1, format)),
        )
      }),
    )
  })

  test.each([
    ['REAL', [0, 0, 0x40], 0, 'OUT_OF_RANGE'],
    ['INT', [1], 0, 'OUT_OF_RANGE'],
    ['INT', [1, 2], 1, 'OUT_OF_RANGE'],
    ['INT', [1, 2], -1, 'OUT_OF_RANGE'],
    ['BOOL', [1, 2], 0, 'BAD_TYPE'],
    ['STRING', [1, 2], 0, 'BAD_TYPE'],
    ['STRING(5)', [0x41, 0x42, 0x43, 0x44], 0, 'OUT_OF_RANGE'],
  ] as const)('%s of %j from word %d is refused: %s', (type, bytes, offset, code) => {
    expect(refusal(code, () => valueOfBytes(Uint8Array.from(bytes), type, offset))).not.toBe('')
  })
})
