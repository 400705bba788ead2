/**
 * Which characters the bytes of a file are. A byte order mark says it; else UTF-16 shows by its zero bytes and UTF-8 by its form. What is
 * left are the code pages of Windows in Japan, China and Taiwan, which are told by what their texts are made of. No byte becomes a
 * question mark: bytes that are no text are refused.
 */
import { isUtf8 } from 'node:buffer'
import { type CodePage, decodePage, encodePage } from '../../basics/code-page'
import { show } from '../../basics/show'
import { RequestError } from '../../errors'

/** Character codes of files. GBK is read as GB18030, which holds it. */
export const tagFileEncodings = ['utf-8', 'utf-16le', 'utf-16be', 'shift-jis', 'gb18030', 'big5'] as const
/** Character code of a file. */
export type TagFileEncoding = (typeof tagFileEncodings)[number]

/** A file as text. */
export interface FileText {
  /** Without the byte order mark. */
  readonly text: string
  /** Its character code. */
  readonly encoding: TagFileEncoding
  /** Others that it may be as well: it was guessed. */
  readonly alternatives: readonly TagFileEncoding[]
}

const MARKS: readonly (readonly [TagFileEncoding, readonly number[]])[] = [
  ['utf-8', [0xef, 0xbb, 0xbf]],
  ['utf-16le', [0xff, 0xfe]],
  ['utf-16be', [0xfe, 0xff]],
]

const unpaired = /\p{Surrogate}/u

/** The text of the bytes in one code, or undefined when they are none. */
function textIn(bytes: Buffer, encoding: TagFileEncoding): string | undefined {
  switch (encoding) {
    case 'utf-8':
      return isUtf8(bytes) ? bytes.toString('utf8') : undefined
    case 'utf-16le':
    case 'utf-16be': {
      if (bytes.length % 2 === 1) return undefined
      const text = (encoding === 'utf-16le' ? bytes : Buffer.from(bytes).swap16()).toString('utf16le')
      return unpaired.test(text) ? undefined : text
    }
    default: {
      const text = decodePage(bytes, PAGES[encoding].page)
      return text.includes('\ufffd') ? undefined : text
    }
  }
}

type PageName = Extract<TagFileEncoding, 'shift-jis' | 'gb18030' | 'big5'>

interface Page {
  readonly page: CodePage
  /** Whether two bytes are a character that texts are full of: kana, kanji of the first level, full-width signs. */
  readonly isUsual: (lead: number, trail: number) => boolean
  /** Whether a byte begins a character of two. */
  readonly isLead: (byte: number) => boolean
}

const PAGES: { readonly [P in PageName]: Page } = {
  'shift-jis': {
    page: 'cp932',
    isLead: (byte) => (byte >= 0x81 && byte <= 0x9f) || (byte >= 0xe0 && byte <= 0xfc),
    isUsual: (lead) => lead >= 0x81 && lead <= 0x98,
  },
  gb18030: {
    page: 'gb18030',
    isLead: (byte) => byte >= 0x81,
    isUsual: (lead, trail) => trail >= 0xa1 && ((lead >= 0xa1 && lead <= 0xa3) || (lead >= 0xb0 && lead <= 0xd7)),
  },
  big5: {
    page: 'cp950',
    isLead: (byte) => byte >= 0x81,
    isUsual: (lead) => lead >= 0xa1 && lead <= 0xc6,
  },
}
const pageNames = Object.keys(PAGES) as PageName[]

/** How much of what is not ASCII is usual in this code, 0 to 1. Half-width kana alone are half as likely: other codes have such bytes, too. */
function likelihood(bytes: Buffer, { isLead, isUsual }: Page): number {
  let usual = 0
  let all = 0
  for (let at = 0; at < bytes.length; at++) {
    const byte = bytes[at] ?? 0
    if (byte < 0x80) continue
    all++
    if (!isLead(byte)) usual += 0.5
    else if (isUsual(byte, bytes[++at] ?? 0)) usual++
  }
  return all === 0 ? 1 : usual / all
}

/** Codes whose likelihood differs by less cannot be told apart. A few characters tell little: of two words anything may be usual. */
function doubtOf(bytes: Buffer): number {
  const foreign = bytes.reduce((sum, byte) => (byte < 0x80 ? sum : sum + 1), 0)
  return 0.2 + 6 / foreign
}

function guessed(bytes: Buffer, isKnown: (text: string) => boolean): FileText | undefined {
  const found = pageNames.flatMap((encoding) => {
    const text = textIn(bytes, encoding)
    return text === undefined ? [] : [{ encoding, text, likely: likelihood(bytes, PAGES[encoding]) }]
  })
  // Words that such a file has in its heading leave no doubt.
  const known = found.filter(({ text }) => isKnown(text))
  const [best, ...others] = (known.length > 0 ? known : found).sort((a, b) => b.likely - a.likely)
  if (best === undefined) return undefined
  const doubt = doubtOf(bytes)
  const near = others.filter(({ text, likely }) => best.likely - likely < doubt && text !== best.text)
  return { text: best.text, encoding: best.encoding, alternatives: near.map(({ encoding }) => encoding) }
}

/** Which half of each unit is zero in the letters, digits and tabs that every such file has. */
function zerosOf(bytes: Buffer): { readonly even: number; readonly odd: number } {
  const count = [0, 0]
  for (const [at, byte] of bytes.entries()) if (byte === 0) count[at % 2] = (count[at % 2] ?? 0) + 1
  return { even: count[0] ?? 0, odd: count[1] ?? 0 }
}

function detected(bytes: Buffer, isKnown: (text: string) => boolean): FileText | undefined {
  const utf8 = textIn(bytes, 'utf-8')
  const { even, odd } = zerosOf(bytes)
  // Of UTF-16 a quarter at least is zero where it might be UTF-8 as well, which has such a byte by accident only.
  if (even + odd > 0 && (utf8 === undefined || (even + odd) * 4 >= bytes.length)) {
    const encoding = odd > even ? 'utf-16le' : 'utf-16be'
    const text = textIn(bytes, encoding)
    if (text !== undefined) return { text, encoding, alternatives: [] }
  }
  if (utf8 === undefined) return guessed(bytes, isKnown)
  return { text: utf8, encoding: 'utf-8', alternatives: isChance(utf8) ? likelyPages(bytes) : [] }
}

/**
 * Whether a text may be UTF-8 by chance: a few words of Chinese, such as 水位 in GBK, look like Greek or Hebrew letters then. Letters of
 * western Europe, degrees and the like do not, and kana and kanji have a form that nothing else has by chance.
 */
function isChance(text: string): boolean {
  return /[\u0100-\u07ff]/.test(text) && !/[\u0800-\uffff]/.test(text)
}

function likelyPages(bytes: Buffer): PageName[] {
  return pageNames.filter((name) => textIn(bytes, name) !== undefined && likelihood(bytes, PAGES[name]) === 1)
}

/**
 * The text of a file.
 * @param encoding what it is in; without it that is found out
 * @param isKnown whether a text has words by which such files are known
 * @throws RequestError BAD_OPTION for an encoding that does not exist, BAD_VALUE for bytes that are no text
 */
export function textOfFile(
  given: Uint8Array,
  encoding: TagFileEncoding | undefined,
  isKnown: (text: string) => boolean = () => false,
): FileText {
  const bytes = Buffer.from(given.buffer, given.byteOffset, given.length)
  if (encoding !== undefined && !tagFileEncodings.includes(encoding)) {
    throw new RequestError(
      'BAD_OPTION',
      `encoding is ${show(encoding)}; it is ${tagFileEncodings.join(', ')}.`,
      'encoding',
    )
  }
  const mark = MARKS.find(([, first]) => first.every((byte, at) => bytes[at] === byte))
  const [marked, length] = mark === undefined ? [undefined, 0] : [mark[0], mark[1].length]
  if (marked !== undefined && encoding !== undefined && marked !== encoding) {
    throw new RequestError(
      'BAD_OPTION',
      `The file begins with the mark of ${marked}: it is not in ${encoding}.`,
      'encoding',
    )
  }
  const rest = bytes.subarray(length)
  const known = marked ?? encoding
  if (known === undefined) {
    const found = detected(rest, isKnown)
    if (found !== undefined) return found
    throw new RequestError(
      'BAD_VALUE',
      `The bytes of the file are no text in ${tagFileEncodings.join(', ')}.`,
      'encoding',
    )
  }
  const text = textIn(rest, known)
  if (text !== undefined) return { text, encoding: known, alternatives: [] }
  throw new RequestError('BAD_VALUE', `The bytes of the file are no text in ${known}.`, 'encoding')
}

/**
 * The bytes of a text, with a byte order mark where Unicode has one.
 * @throws RequestError BAD_VALUE for a character that the code does not have
 */
export function fileOfText(text: string, encoding: TagFileEncoding): Buffer {
  const bytes = bytesOf(text, encoding)
  if (textIn(bytes, encoding) !== text) {
    const foreign = Array.from(text).find((character) => textIn(bytesOf(character, encoding), encoding) !== character)
    const message = `The character ${show(foreign ?? text)} does not exist in ${encoding}.`
    throw new RequestError('BAD_VALUE', message, 'encoding')
  }
  const mark = MARKS.find(([name]) => name === encoding)?.[1] ?? []
  return Buffer.concat([Buffer.from(mark), bytes])
}

function bytesOf(text: string, encoding: TagFileEncoding): Buffer {
  switch (encoding) {
    case 'utf-8':
      return Buffer.from(text, 'utf8')
    case 'utf-16le':
      return Buffer.from(text, 'utf16le')
    case 'utf-16be':
      return Buffer.from(text, 'utf16le').swap16()
    default:
      return encodePage(text, PAGES[encoding].page)
  }
}
