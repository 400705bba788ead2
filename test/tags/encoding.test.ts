/** Which characters the bytes of a file are. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { fileOfText, type TagFileEncoding, tagFileEncodings, textOfFile } from '../../src/tags/files/encoding'

const texts: Readonly<Record<string, string>> = {
  'shift-jis': 'タンク１の水位\t運転中\r\nポンプ異常\t温度センサ\r\n',
  gb18030: '水箱液位\t运行中\r\n水泵故障\t温度传感器\r\n',
  big5: '水箱液位\t運轉中\r\n水泵故障\t溫度感測器\r\n',
}

describe('without a mark', () => {
  test.each(Object.entries(texts))('%s is told by what it is made of', (encoding, text) => {
    const bytes = fileOfText(text, encoding as TagFileEncoding)
    expect(textOfFile(bytes, undefined)).toMatchObject({ text, encoding })
  })

  test.each(['utf-16le', 'utf-16be'] as const)('%s is told by its zero bytes', (encoding) => {
    const text = '"Label Name"\t"水位"\r\n'
    const bytes = fileOfText(text, encoding).subarray(2)
    expect(textOfFile(bytes, undefined)).toEqual({ text, encoding, alternatives: [] })
  })

  test('UTF-8 is told by its form, ASCII is UTF-8', () => {
    for (const text of ['水位,D100', 'level,D100', '', '20 °C, 5 m², é'])
      expect(textOfFile(Buffer.from(text), undefined)).toEqual({ text, encoding: 'utf-8', alternatives: [] })
  })

  test('half-width kana are not taken for Chinese', () => {
    const text = 'ｾﾝｻ1,ﾓｰﾀ,ﾎﾟﾝﾌﾟ\r\n'
    expect(textOfFile(fileOfText(text, 'shift-jis'), undefined)).toMatchObject({ text, encoding: 'shift-jis' })
  })

  test('what may be two codes says so, unless it has a word by which it is known', () => {
    // One character: two bytes that are usual ones in Chinese of both kinds.
    const bytes = fileOfText('名', 'gb18030')
    const guess = textOfFile(bytes, undefined)
    expect(guess.alternatives.length).toBeGreaterThan(0)
    // Of few characters the likely code may be the wrong one: it is among those that are named.
    for (const word of ['压力', '阀门', '夹紧', '速度', '水位', '停止']) {
      const { encoding, alternatives } = textOfFile(fileOfText(word, 'gb18030'), undefined)
      expect([encoding, ...alternatives]).toContain('gb18030')
    }
    const known = textOfFile(bytes, undefined, (text) => text === '名')
    expect(known).toEqual({ text: '名', encoding: 'gb18030', alternatives: [] })
  })
})

describe('refused is', () => {
  test('what is no text', () => {
    expect(() => textOfFile(Buffer.from([0xff, 0xff, 0x80, 0x00, 0x01]), undefined)).toThrow(/no text in utf-8, /)
    expect(() => textOfFile(Buffer.from([0x82]), 'shift-jis')).toThrow(
      'The bytes of the file are no text in shift-jis.',
    )
    expect(() => textOfFile(Buffer.from([0xff, 0xfe, 0x41]), undefined)).toThrow('no text in utf-16le')
    expect(() => textOfFile(Buffer.from([0xff, 0xfe, 0x00, 0xd8]), undefined)).toThrow('no text in utf-16le')
  })

  test('an encoding that does not exist, or that the mark denies', () => {
    expect(() => textOfFile(Buffer.from('a'), 'utf8' as never)).toThrow(/encoding is 'utf8'; it is utf-8, utf-16le/)
    expect(() => textOfFile(Buffer.from([0xff, 0xfe]), 'utf-8')).toThrow('begins with the mark of utf-16le')
  })

  test('a character that the code does not have', () => {
    expect(() => fileOfText('a한b', 'shift-jis')).toThrow("The character '한' does not exist in shift-jis.")
    expect(() => fileOfText('运', 'big5')).toThrow("The character '运' does not exist in big5.")
  })
})

test('what is written is read again, with the mark of Unicode or the encoding that is said', () => {
  fc.assert(
    fc.property(fc.constantFrom(...tagFileEncodings), fc.string({ unit: 'grapheme' }), (encoding, given) => {
      const text = /^(shift-jis|gb18030|big5)$/.test(encoding) ? `${texts[encoding]}` : given
      expect(textOfFile(fileOfText(text, encoding), encoding).text).toBe(text)
    }),
  )
})
