/**
 * Text in words: the first character in the low byte of the first word, ended by NUL.
 * Source: MELSEC iQ-R Programming Manual (CPU Module Instructions), 1.2 "Character string data"; SLMP Reference
 * Manual: "12AB" is 3231H, 4241H.
 *
 * Nothing is replaced or cut: a character the code does not have, or bytes that are no text, are errors.
 */

import { isAscii, isUtf8 } from 'node:buffer'
import { type CodePage, decodePage, encodePage } from '../basics/code-page'
import { hex, hexPairs } from '../basics/hex'
import { show } from '../basics/show'
import { ProtocolError, RequestError } from '../errors'
import { badContent, badValue } from './fault'
import type { Encoding, ValueFormat } from './format'
import { formatType, type TextType, wordsOf } from './type'
import { requireWords, swapBytes, type Words, wordAt } from './word'

interface CharacterCode {
  readonly title: string
  /** Bytes of the closing NUL, and what the length of the bytes is a multiple of. */
  readonly unit: 1 | 2
  /** The bytes; characters the code does not have may come out as anything, see `encodeText`. */
  encode(text: string): Buffer
  /** The text, or undefined when the bytes are not text in this code. */
  decode(bytes: Buffer): string | undefined
}

// With the u flag a class of surrogates matches unpaired ones only. They are no characters: UTF-8 cannot carry them.
const unpaired = /\p{Surrogate}/u

/** A character code of one to four bytes for each character. */
function byTable(title: string, table: CodePage): CharacterCode {
  return {
    title,
    unit: 1,
    encode: (text) => encodePage(text, table),
    decode: (bytes) => {
      const text = decodePage(bytes, table)
      return text.includes('\ufffd') ? undefined : text
    },
  }
}

const codes: { readonly [E in Encoding]: CharacterCode } = {
  ascii: {
    title: 'ASCII',
    unit: 1,
    encode: (text) => Buffer.from(text, 'latin1'),
    decode: (bytes) => (isAscii(bytes) ? bytes.toString('latin1') : undefined),
  },
  utf8: {
    title: 'UTF-8',
    unit: 1,
    encode: (text) => Buffer.from(text, 'utf8'),
    decode: (bytes) => (isUtf8(bytes) ? bytes.toString('utf8') : undefined),
  },
  'shift-jis': byTable('Shift-JIS', 'cp932'),
  gbk: byTable('GBK', 'cp936'),
  gb18030: byTable('GB18030', 'gb18030'),
  utf16: {
    title: 'UTF-16',
    unit: 2,
    encode: (text) => Buffer.from(text, 'utf16le'),
    decode: (bytes) => {
      const text = bytes.toString('utf16le')
      return unpaired.test(text) ? undefined : text
    },
  },
}

function codeOf(type: TextType, format: ValueFormat): CharacterCode {
  if (type.name === 'WSTRING') return codes.utf16
  const code = codes[format.encoding ?? 'ascii']
  // Half a UTF-16 unit at the end could be neither read nor written.
  if (code.unit === 2 && (type.length ?? 0) % 2 === 1)
    throw new RequestError(
      'BAD_OPTION',
      `${formatType(type)} in ${code.title}: a STRING's length counts bytes, 2 for a character; use an even one, or WSTRING`,
      'encoding',
    )
  return code
}

/** Bytes the declared length allows. */
function capacity({ name, length = 0 }: TextType): number {
  return name === 'WSTRING' ? 2 * length : length
}

function loadBytes(type: TextType, words: Words, offset: number, swapped: boolean): Buffer {
  requireWords(words, offset, wordsOf(type))
  const bytes = Buffer.allocUnsafe(capacity(type)) // every byte is set below
  for (let at = 0; at < bytes.length; at++) {
    const word = wordAt(words, offset + (at >>> 1))
    bytes[at] = (at & 1) === (swapped ? 0 : 1) ? word >>> 8 : word & 0xff
  }
  return bytes
}

/** Up to the first NUL; what follows it is left over from longer texts. */
function untilNul(bytes: Buffer, unit: 1 | 2): Buffer {
  if (unit === 1) {
    const nul = bytes.indexOf(0)
    return nul < 0 ? bytes : bytes.subarray(0, nul)
  }
  let end = 0
  while (end < bytes.length && bytes.readUInt16LE(end) !== 0) end += 2
  return bytes.subarray(0, end)
}

function withoutTrailingSpaces(text: string): string {
  let end = text.length
  while (end > 0 && text[end - 1] === ' ') end--
  return text.slice(0, end)
}

function firstBytes(bytes: Buffer): string {
  return hexPairs(bytes.subarray(0, 16)) + (bytes.length > 16 ? ' …' : '')
}

/** Text from words: up to the first NUL or the declared length. */
export function decodeText(type: TextType, words: Words, offset: number, format: ValueFormat): string {
  const code = codeOf(type, format)
  const bytes = untilNul(loadBytes(type, words, offset, format.byteOrder === 'high-first'), code.unit)
  const text = code.decode(bytes)
  if (text === undefined) {
    throw badContent(
      type,
      `the bytes ${firstBytes(bytes)}`,
      `they are no ${code.title} text; set the encoding or the byte order that the PLC program uses`,
    )
  }
  return format.trimSpaces === true ? withoutTrailingSpaces(text) : text
}

/** The first character a code does not have, or undefined. */
function foreign(text: string, code: CharacterCode): string | undefined {
  for (const character of text) if (code.decode(code.encode(character)) !== character) return character
  return undefined
}

/** @throws RequestError BAD_VALUE naming the character that the code does not have */
function bytesIn(code: CharacterCode, text: string): Buffer {
  const bytes = code.encode(text)
  // Reading back what will be written is the one test that holds for every code: no '?' gets through.
  if (!unpaired.test(text) && code.decode(bytes) === text) return bytes
  const character = foreign(text, code) ?? text
  const point = hex(character.codePointAt(0) ?? 0, 4)
  throw new RequestError(
    'BAD_VALUE',
    `${show(text)}: the character ${show(character)} (U+${point}) does not exist in ${code.title}; set another encoding or leave it out`,
  )
}

function encodeBytes(type: TextType, text: string, code: CharacterCode): Buffer {
  const bytes = bytesIn(code, text)
  if (bytes.length > capacity(type)) {
    const needed = bytes.length / code.unit
    const held = capacity(type) / code.unit
    throw badValue(
      formatType(type),
      text,
      `${held} ${code.unit === 2 ? 'UTF-16 units' : 'bytes'}, the text has ${needed}`,
    )
  }
  return bytes
}

/** Words from text, the rest filled with NUL. */
export function encodeText(type: TextType, value: unknown, format: ValueFormat): number[] {
  const code = codeOf(type, format)
  const name = formatType(type)
  if (typeof value !== 'string') throw badValue(name, value, 'a string')
  if (value.includes('\0')) throw badValue(name, value, 'text without NUL, which would end it in the PLC')
  const bytes = encodeBytes(type, value, code)
  const words = new Array<number>(wordsOf(type))
  for (let at = 0; at < words.length; at++) {
    const word = (bytes[2 * at] ?? 0) | ((bytes[2 * at + 1] ?? 0) << 8)
    words[at] = format.byteOrder === 'high-first' ? swapBytes(word) : word
  }
  return words
}

function wholeCode(encoding: Encoding): CharacterCode {
  if (typeof encoding === 'string' && Object.hasOwn(codes, encoding)) return codes[encoding]
  throw new RequestError(
    'BAD_OPTION',
    `encoding is ${show(encoding)}; it is ${Object.keys(codes).join(', ')}`,
    'encoding',
  )
}

/**
 * All of the bytes as text, such as the content of a file. Nothing is left out: a byte order mark is its first
 * character, and NUL a character like any other.
 * @throws RequestError BAD_OPTION for an encoding that does not exist
 * @throws ProtocolError BAD_FIELD when the bytes are no text in this encoding; UTF-16 is that with the low byte first
 * @example textOfBytes(await plc.files.read('4:/LINE.CSV'), 'shift-jis')
 */
export function textOfBytes(bytes: Uint8Array, encoding: Encoding): string {
  const { title, unit, decode } = wholeCode(encoding)
  const all = Buffer.from(bytes.buffer, bytes.byteOffset, bytes.length)
  const text = all.length % unit === 0 ? decode(all) : undefined
  // FFFEH is no character: a byte order mark that says that the high byte is first.
  if (text !== undefined && !text.startsWith('\ufffe')) return text
  const message = `These ${all.length} bytes are no ${title} text (${firstBytes(all)}): set the encoding they are in, or take them as bytes.`
  throw new ProtocolError('BAD_FIELD', message)
}

/**
 * The bytes of a text, without anything before or behind it; UTF-16 with the low byte first.
 * @throws RequestError BAD_OPTION for an encoding that does not exist, BAD_VALUE for a character that it does not have
 * @example await plc.files.write('4:/LINE.CSV', bytesOfText('製品,温度', 'shift-jis'))
 */
export function bytesOfText(text: string, encoding: Encoding): Buffer {
  const code = wholeCode(encoding)
  if (typeof text !== 'string') throw badValue(`${code.title} text`, text, 'a string')
  return bytesIn(code, text)
}
