import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { type Encoding, formatOptions, type ValueFormat } from '../../src/value/value'
import { decode, encode, orders, refusal, words } from './support'

const sjis: ValueFormat = { encoding: 'shift-jis' }
const swapped: ValueFormat = { byteOrder: 'high-first' }

describe('words of known texts', () => {
  test.each<[string, string, ValueFormat, number[]]>([
    // SLMP Reference Manual, data of reading and writing in word units: "12AB" = 3231H, 4241H
    ['STRING(4)', '12AB', {}, [0x3231, 0x4241]],
    // MELSEC iQ-F FX5 User's Manual (Communication), predefined protocol, storage of non-converted variables
    ['STRING(4)', 'ABCD', {}, [0x4241, 0x4443]],
    ['STRING(4)', 'ABCD', swapped, [0x4142, 0x4344]],
    ['STRING(3)', 'EFG', {}, [0x4645, 0x0047]],
    ['STRING(3)', 'EFG', swapped, [0x4546, 0x4700]],
    ['STRING(6)', 'EFG', {}, [0x4645, 0x0047, 0]],
    ['STRING(1)', '', {}, [0]],
    ['STRING(6)', '日本語', sjis, [0xfa93, 0x7b96, 0xea8c]],
    ['STRING(6)', '日本語', { ...sjis, ...swapped }, [0x93fa, 0x967b, 0x8cea]],
    // Half-width katakana take one byte, with the voiced mark as another.
    ['STRING(5)', 'ｶﾞｽA', sjis, [0xdeb6, 0x41bd, 0x0000]],
    ['STRING(3)', '日A', sjis, [0xfa93, 0x0041]],
    ['STRING(4)', '~\\～', sjis, [0x5c7e, 0x6081]],
    ['STRING(5)', '温度A', { encoding: 'gbk' }, [0xc2ce, 0xc8b6, 0x0041]],
    // GB 18030: four bytes for what GBK does not have.
    ['STRING(6)', '温😀', { encoding: 'gb18030' }, [0xc2ce, 0x3994, 0x36fc]],
    ['STRING(6)', 'é日', { encoding: 'utf8' }, [0xa9c3, 0x97e6, 0x00a5]],
    ['STRING(4)', 'A日', { encoding: 'utf16' }, [0x0041, 0x65e5]],
    ['WSTRING(3)', '日A', {}, [0x65e5, 0x0041, 0]],
    ['WSTRING(3)', '日A', swapped, [0xe565, 0x4100, 0]],
    ['WSTRING(3)', 'A😀', {}, [0x0041, 0xd83d, 0xde00]],
  ])('%s %p %j', (type, text, format, image) => {
    expect(encode(type, text, format)).toEqual(image)
    expect(decode(type, image, format)).toBe(text)
  })

  test('the word order does not concern text', () => {
    expect(encode('STRING(4)', '12AB', { wordOrder: 'high-first' })).toEqual([0x3231, 0x4241])
  })

  test('WSTRING is UTF-16 whatever the encoding says', () => {
    for (const encoding of formatOptions.encoding) expect(encode('WSTRING(1)', '日', { encoding })).toEqual([0x65e5])
  })
})

describe('reading', () => {
  test('ends at the first NUL, whatever follows', () => {
    expect(decode('STRING(6)', [0x4241, 0xff00, 0xffff])).toBe('AB')
    expect(decode('STRING(6)', [0x0041, 0x4242, 0x4242])).toBe('A')
    expect(decode('WSTRING(3)', [0x0041, 0x0000, 0xd800])).toBe('A')
    // A unit with one zero byte is not a NUL.
    expect(decode('WSTRING(3)', [0x0041, 0x0100, 0x0042])).toBe('A\u0100B')
  })

  test('an odd length leaves the last high byte alone', () => {
    expect(decode('STRING(3)', [0x4241, 0x4443])).toBe('ABC')
    expect(decode('STRING(3)', [0x4241, 0xff43])).toBe('ABC')
  })

  test('spaces at the end are cut off only when asked', () => {
    const image = encode('STRING(8)', ' A B  ')
    expect(decode('STRING(8)', image)).toBe(' A B  ')
    expect(decode('STRING(8)', image, { trimSpaces: true })).toBe(' A B')
    expect(decode('STRING(2)', [0x2020], { trimSpaces: true })).toBe('')
  })

  test.each<[string, number[], ValueFormat]>([
    ['a byte above 7FH in ASCII', [0x4180], {}],
    ['a lead byte without its second in Shift-JIS', [0x2093], sjis],
    ['a lead byte cut off at the end', [0x9341], sjis],
    ['a byte Shift-JIS does not have', [0x41ff], sjis],
    ['a lead byte without its second in GBK', [0x2081], { encoding: 'gbk' }],
    ['a pair that GBK does not have', [0xa1aa], { encoding: 'gbk' }],
    ['a lead byte cut off at the end in GB18030', [0x8141], { encoding: 'gb18030' }],
    ['a continuation byte in UTF-8', [0x4180], { encoding: 'utf8' }],
    ['an overlong form in UTF-8', [0xafc0], { encoding: 'utf8' }],
    ['half a surrogate pair in UTF-16', [0xd83d], { encoding: 'utf16' }],
  ])('%s is an error, not another character', (_, image, format) => {
    expect(refusal('BAD_FIELD', () => decode('STRING(2)', image, format))).toMatch(
      /bytes [0-9A-F]{2}.*set the encoding/,
    )
  })

  test('half a surrogate pair in WSTRING is an error', () => {
    refusal('BAD_FIELD', () => decode('WSTRING(2)', [0x0041, 0xd83d]))
    refusal('BAD_FIELD', () => decode('WSTRING(2)', [0xde00, 0xd83d]))
  })

  test.each(formatOptions.encoding)(
    'any words in %s are a text that is written back to the same text, or an error',
    (encoding) => {
      fc.assert(
        fc.property(words(4), (image) => {
          let text: string
          try {
            text = String(decode('STRING(8)', image, { encoding }))
          } catch (error) {
            expect(error).toMatchObject({ code: 'BAD_FIELD' })
            return
          }
          // Code page 932 reads user-defined characters (E000 on) that it cannot write.
          if (encoding === 'shift-jis' && /[\ue000-\uf8ff]/.test(text)) return
          expect(decode('STRING(8)', encode('STRING(8)', text, { encoding }), { encoding })).toBe(text)
        }),
      )
    },
  )
})

describe('writing', () => {
  test.each<[string, string, ValueFormat, RegExp]>([
    ['STRING(4)', 'ABCDE', {}, /STRING\(4\): it takes 4 bytes, the text has 5/],
    ['STRING(3)', 'ABCD', {}, /3 bytes/],
    ['STRING(5)', '日本語', sjis, /takes 5 bytes, the text has 6/],
    ['STRING(5)', '日本', { encoding: 'utf8' }, /takes 5 bytes, the text has 6/],
    ['STRING(4)', '日本語', { encoding: 'utf16' }, /takes 2 UTF-16 units, the text has 3/],
    ['WSTRING(2)', 'A😀', {}, /takes 2 UTF-16 units, the text has 3/],
  ])('%s refuses %p: it is too long', (type, text, format, message) => {
    expect(refusal('BAD_VALUE', () => encode(type, text, format))).toMatch(message)
  })

  test.each<[string, ValueFormat, RegExp]>([
    ['Aé', {}, /'é' \(U\+00E9\) does not exist in ASCII/],
    ['A\u0080', {}, /U\+0080/],
    ['日', {}, /U\+65E5/],
    ['日é', sjis, /'é' \(U\+00E9\) does not exist in Shift-JIS/],
    ['한', sjis, /U\+D55C/],
    ['日😀', sjis, /U\+1F600/],
    ['温é한', { encoding: 'gbk' }, /'한' \(U\+D55C\) does not exist in GBK/],
    ['😀', { encoding: 'gbk' }, /U\+1F600/],
    ['\ufffd', { encoding: 'gb18030' }, /U\+FFFD/],
    // Would become another character: a backslash, a tilde.
    ['¥', sjis, /U\+00A5/],
    ['‾', sjis, /U\+203E/],
    ['\ufffd', sjis, /U\+FFFD/],
    ['A\ud83d', { encoding: 'utf8' }, /U\+D83D/],
    ['\ude00A', { encoding: 'utf16' }, /U\+DE00/],
  ])('%p %j is refused, not replaced', (text, format, message) => {
    expect(refusal('BAD_VALUE', () => encode('STRING(20)', text, format))).toMatch(message)
  })

  test('half a surrogate pair is refused by WSTRING', () => {
    refusal('BAD_VALUE', () => encode('WSTRING(4)', 'A\ud83d'))
  })

  test('a question mark is a character like any other', () => {
    expect(encode('STRING(2)', 'a?', sjis)).toEqual([0x3f61])
  })

  test('NUL within a text is refused', () => {
    for (const type of ['STRING(8)', 'WSTRING(8)'])
      expect(refusal('BAD_VALUE', () => encode(type, 'A\0B'))).toMatch(/without NUL/)
    refusal('BAD_VALUE', () => encode('STRING(8)', '\0'))
  })

  test('no other kind of value is made a text', () => {
    for (const value of [12, 1n, true, null, undefined, {}, ['A'], Object('A')])
      for (const type of ['STRING(8)', 'WSTRING(8)'])
        refusal('BAD_VALUE', () => Reflect.apply(encode, undefined, [type, value]))
  })

  test('an odd STRING is refused in UTF-16, in both directions', () => {
    const utf16: ValueFormat = { encoding: 'utf16' }
    expect(refusal('BAD_OPTION', () => encode('STRING(5)', 'A', utf16))).toMatch(/use an even one, or WSTRING/)
    refusal('BAD_OPTION', () => decode('STRING(5)', [0, 0, 0], utf16))
  })
})

describe.each(orders)('texts in order %j', (order) => {
  const characters: { readonly [E in Encoding]: fc.Arbitrary<string> } = {
    ascii: fc.integer({ min: 1, max: 0x7f }).map((code) => String.fromCharCode(code)),
    utf8: fc.string({ unit: 'binary', minLength: 1, maxLength: 1 }).filter((text) => text !== '\0'),
    'shift-jis': fc.constantFrom(...'A?~\\ 0ｱﾞｶ｡日本語漢字ーソ表能～￥①㈱ぁん'),
    gbk: fc.constantFrom(...'A?~\\ 0温度产品绿茶高级，。￥①㈱é€ぁん'),
    gb18030: fc.constantFrom(...'A?~\\ 0温度产品绿茶，é€ぁん한😀𠀀ﾀ'),
    utf16: fc.string({ unit: 'binary', minLength: 1, maxLength: 1 }).filter((text) => text !== '\0'),
  }

  test.each(formatOptions.encoding)('%s comes back as it was written', (encoding) => {
    const format = { ...order, encoding }
    fc.assert(
      fc.property(fc.array(characters[encoding], { maxLength: 8 }), fc.nat(4), (parts, spare) => {
        const text = parts.join('')
        const type = `STRING(${32 + 2 * spare})`
        expect(decode(type, encode(type, text, format), format)).toBe(text)
      }),
    )
  })

  test('WSTRING comes back as it was written, up to a surrogate pair in its last two words', () => {
    fc.assert(
      fc.property(fc.array(characters.utf16, { maxLength: 8 }), (parts) => {
        const text = `${parts.join('')}😀`
        const type = `WSTRING(${text.length})`
        expect(decode(type, encode(type, text, order), order)).toBe(text)
        refusal('BAD_VALUE', () => encode(type, `${text}A`, order))
      }),
    )
  })
})
