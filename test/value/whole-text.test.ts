import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { bytesOfText, type Encoding, formatOptions, textOfBytes } from '../../src/value/value'
import { refusal } from './support'

describe('bytes of a whole text', () => {
  test.each<[Encoding, string, string]>([
    ['ascii', 'A,1\r\n', '412c310d0a'],
    ['utf8', '温度', 'e6b8a9e5baa6'],
    ['shift-jis', '温度', '89b79378'],
    ['shift-jis', 'ｶﾞｽ', 'b6debd'],
    ['gbk', '温度', 'cec2b6c8'],
    ['gb18030', '温😀', 'cec29439fc36'],
    ['utf16', '温A', '296e4100'],
    ['utf16', '\ufeffA', 'fffe4100'],
    ['utf8', '\ufeffA', 'efbbbf41'],
    // NUL ends a STRING, and is a character of a file like any other.
    ['ascii', 'A\0B', '410042'],
    ['utf16', '', ''],
  ])('%s %j', (encoding, text, hex) => {
    expect(bytesOfText(text, encoding).toString('hex')).toBe(hex)
    expect(textOfBytes(Buffer.from(hex, 'hex'), encoding)).toBe(text)
    // Part of a larger array, at any place in it.
    expect(textOfBytes(new Uint8Array(Buffer.from(`ff${hex}ff`, 'hex')).subarray(1, -1), encoding)).toBe(text)
  })

  test.each(formatOptions.encoding)('in %s every text that can be written is read back', (encoding) => {
    fc.assert(
      fc.property(fc.string({ unit: 'binary' }), (text) => {
        let bytes: Buffer
        try {
          bytes = bytesOfText(text, encoding)
        } catch {
          return
        }
        if (encoding === 'utf16' && text.startsWith('\ufffe')) return
        expect(textOfBytes(bytes, encoding)).toBe(text)
      }),
    )
  })
})

describe('refused', () => {
  test.each<[Encoding, string]>([
    ['ascii', '41e9'],
    ['utf8', '4182'],
    ['shift-jis', '4181'],
    ['shift-jis', 'a0'],
    ['gbk', '41ce'],
    ['gb18030', '9439fc'],
    ['utf16', '410042'],
    ['utf16', '00d8'],
    // High byte first.
    ['utf16', 'feff0041'],
  ])('%s: bytes %s are no text', (encoding, hex) => {
    expect(refusal('BAD_FIELD', () => textOfBytes(Buffer.from(hex, 'hex'), encoding))).toContain('set the encoding')
  })

  test.each<[Encoding, string, string]>([
    ['ascii', 'A é', 'U+00E9'],
    ['shift-jis', '温😀', 'U+1F600'],
    ['gbk', '温😀', 'U+1F600'],
    ['utf8', 'A\ud800', 'UTF-8'],
  ])('%s: %j is not written', (encoding, text, says) => {
    expect(refusal('BAD_VALUE', () => bytesOfText(text, encoding))).toContain(says)
  })

  test.each([undefined, null, 'latin1', 'toString', 5])('the encoding %j does not exist', (given) => {
    const encoding = given as Encoding
    expect(refusal('BAD_OPTION', () => textOfBytes(Buffer.from('A'), encoding))).toContain('shift-jis')
    expect(refusal('BAD_OPTION', () => bytesOfText('A', encoding))).toContain('shift-jis')
  })

  test.each<unknown>([undefined, 5, Buffer.from('A')])('%j is no text', (given) => {
    expect(refusal('BAD_VALUE', () => bytesOfText(given as string, 'utf8'))).toContain('a string')
  })
})
