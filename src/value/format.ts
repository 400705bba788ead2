/** How a value's words, bytes and characters are arranged, where a PLC program does it otherwise than MELSEC does. */
import { RequestError } from '../errors'

/** Every option and what it may be; the first is the default. */
export const formatOptions = {
  /** Order of the words of a number of 2 or 4 words. MELSEC: low word first. Text is not affected. */
  wordOrder: ['low-first', 'high-first'],
  /** Order of the two bytes of every word, of numbers and of text. MELSEC: low byte first (`AB` is 4241H). */
  byteOrder: ['low-first', 'high-first'],
  /** Character code of STRING. WSTRING is always UTF-16, because its type says so. */
  encoding: ['ascii', 'utf8', 'shift-jis', 'gbk', 'gb18030', 'utf16'],
  /** Whether spaces at the end of text are cut off when it is read. */
  trimSpaces: [false, true],
} as const

/** Options of a value: see {@link formatOptions}. */
export type ValueFormat = {
  readonly [K in keyof typeof formatOptions]?: (typeof formatOptions)[K][number]
}
/** Character code of STRING. */
export type Encoding = NonNullable<ValueFormat['encoding']>
/** Every character code of STRING, the default first. */
export const encodings: readonly [Encoding, ...Encoding[]] = formatOptions.encoding

function isOption(key: string): key is keyof typeof formatOptions {
  return Object.hasOwn(formatOptions, key)
}

/**
 * Refuses a format with an unknown option or value, because a misspelt order would give a wrong value in silence.
 * Decoding and encoding do it by themselves; whoever keeps a format can do it early.
 *
 * @throws RequestError BAD_OPTION
 */
export function checkFormat(format: ValueFormat): void {
  if (typeof format !== 'object' || format === null)
    throw new RequestError('BAD_OPTION', `a value format is an object, not ${String(format)}`)
  for (const key of Object.keys(format)) {
    if (!isOption(key))
      throw new RequestError(
        'BAD_OPTION',
        `a value format has no option '${key}'. Options: ${Object.keys(formatOptions).join(', ')}`,
        key,
      )
    const value = format[key]
    const allowed: readonly (string | boolean)[] = formatOptions[key]
    if (value !== undefined && !allowed.includes(value))
      throw new RequestError('BAD_OPTION', `${key} is ${allowed.join(' or ')}, not '${String(value)}'`, key)
  }
}
