/** Words of 16 bits: one word, its bits and its bytes, and several in another order. */
import { hex } from '../basics/hex'
import { RequestError } from '../errors'

/** Words as a reader gives them: whole numbers from 0 to 65535. */
export type Words = ArrayLike<number>

/** The manuals' spelling of a word: `12AFH`. */
export function formatWord(word: number): string {
  return `${hex(word, 4)}H`
}

/** The word at an index. Whatever is not one (missing, negative, a fraction) is refused: it would become a value. */
export function wordAt(words: Words, at: number): number {
  const word = words[at]
  const low = (word ?? -1) & 0xffff
  if (low !== word) throw notAWord(words, at)
  return low
}

function notAWord(words: Words, at: number): RequestError {
  const message =
    at in words ? `word ${at} is ${String(words[at])}, not a whole number from 0 to 65535` : `there is no word ${at}`
  return new RequestError('OUT_OF_RANGE', `${message} (${words.length} words given)`)
}

/** Refuses an offset and size that do not lie within the words. */
export function requireWords(words: Words, offset: number, size: number): void {
  if (Number.isInteger(offset) && offset >= 0 && offset + size <= words.length) return
  throw new RequestError(
    'OUT_OF_RANGE',
    `${size} words from offset ${offset} are needed, but ${words.length} words are given`,
  )
}

/** The word with its two bytes exchanged. */
export function swapBytes(word: number): number {
  return ((word & 0xff) << 8) | (word >>> 8)
}

/**
 * One bit of a word; bit 0 is the lowest.
 * @throws RequestError OUT_OF_RANGE for a bit outside 0 to 15 or a number that is not a word
 * @example bitOf(0x8000, 15) // true, as D100.F
 */
export function bitOf(word: number, bit: number): boolean {
  if (!Number.isInteger(bit) || bit < 0 || bit > 15)
    throw new RequestError('OUT_OF_RANGE', `a word has the bits 0 to F, not ${bit}`)
  return ((wordAt([word], 0) >>> bit) & 1) === 1
}
