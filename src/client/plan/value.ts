// Values out of the words of an answer, by numbers that were worked out when the plan was made: nothing is parsed here.
import {
  decodeArray,
  decoderOf,
  decodeValue,
  type PlcValue,
  type ValueFormat,
  type ValueType,
  type Words,
  wordsOf,
} from '../../value/value'
import { wordAt } from '../../value/word'
import type { ParsedItem } from '../item/item'
import type { Piece } from './layout'

/** Where the values of a piece stand in the words of an answer; bits are counted from the lowest of word 0. */
export interface Place {
  readonly item: number
  readonly part: number
  readonly at: number
  readonly width: number
  readonly step: number
  readonly pitch: number
  readonly count: number
  /** `values`: words as they stand; `bits`: BOOL; `digits`: numbers put together from their bits. */
  readonly kind: 'values' | 'bits' | 'digits'
  readonly isArray: boolean
  /** The values are the words themselves, as they are or with a sign. */
  readonly words: 'unsigned' | 'signed' | undefined
  /** Of one value of whole words. */
  readonly decode?: (words: Words, offset: number) => PlcValue
  readonly type: ValueType
  readonly format: ValueFormat
}

/** @param from bit of the answer's words at which cell `cell` starts */
export function placeOf(piece: Piece, item: ParsedItem, from: number, cell: number): Place {
  const { layout, first, count } = piece
  const { start, width, step, pitch, area } = layout
  const at = from + start + first * pitch - cell * area.bitsPerCell
  const isBit = item.type.name === 'BOOL'
  const isWhole = !isBit && step === 1 && width % 16 === 0 && pitch % 16 === 0 && at % 16 === 0
  const isArray = item.count !== undefined
  return {
    item: piece.item,
    part: piece.part,
    at,
    width,
    step,
    pitch,
    count,
    // Every value is words of their own, or its bits are looked for one by one.
    kind: isBit ? 'bits' : isWhole ? 'values' : 'digits',
    isArray,
    words: pitch === width && isWhole ? wordsOfItem(item) : undefined,
    ...(isWhole && !isArray ? { decode: decoderOf(item.type, item.format) } : {}),
    type: item.type,
    format: item.format,
  }
}

function wordsOfItem({ type: { name }, format }: ParsedItem): Place['words'] {
  if (format.byteOrder === 'high-first') return undefined
  if (name === 'INT') return 'signed'
  return name === 'UINT' || name === 'WORD' ? 'unsigned' : undefined
}

/**
 * @param owned nobody else needs the words: an array of all of them may become the value
 * @throws ProtocolError BAD_FIELD when the words are no value of the type
 */
export function valueAt(words: Words, place: Place, owned = false): PlcValue | PlcValue[] {
  const { kind, at, type, format, isArray, count, decode } = place
  if (decode !== undefined) return decode(words, at / 16)
  if (kind === 'bits') return isArray ? bitsAt(words, place) : isSet(words, at)
  if (place.words !== undefined && isArray)
    return wordsAt(words, at / 16, count, place.words, owned) ?? decodeArray(type, words, at / 16, count, format)
  if (kind === 'values' && place.pitch === place.width) return decodeArray(type, words, at / 16, count, format)
  const gathered = kind === 'values' ? recordsAt(words, place) : digitsAt(words, place)
  return isArray ? decodeArray(type, gathered, 0, count, format) : decodeValue(type, gathered, 0, format)
}

/** A decoded answer holds nothing but words; copied as a whole they cost a sixth of what each alone would. */
function wordsAt(
  words: Words,
  from: number,
  count: number,
  as: 'unsigned' | 'signed',
  owned: boolean,
): number[] | undefined {
  if (!Array.isArray(words) || from + count > words.length) return undefined
  const isAll = owned && from === 0 && count === words.length
  const values: number[] = isAll ? words : words.slice(from, from + count)
  if (as === 'unsigned') return values
  for (let at = 0; at < count; at++) {
    const word = values[at] as number
    if (word > 0x7fff) values[at] = word - 0x1_0000
  }
  return values
}

function isSet(words: Words, bit: number): boolean {
  return ((wordAt(words, bit >> 4) >> (bit & 15)) & 1) === 1
}

function bitsAt(words: Words, { at, pitch, count }: Place): boolean[] {
  const out = new Array<boolean>(count)
  for (let k = 0; k < count; k++) out[k] = isSet(words, at + k * pitch)
  return out
}

/** The values of long timers: the first words of each record. */
function recordsAt(words: Words, { at, width, pitch, count }: Place): number[] {
  const out: number[] = []
  for (let k = 0; k < count; k++) {
    const from = (at + k * pitch) / 16
    for (let word = 0; word < width / 16; word++) out.push(wordAt(words, from + word))
  }
  return out
}

/** Numbers of any count of bits, each in the words of its type, filled up with 0. */
function digitsAt(words: Words, { at, width, step, pitch, count, type }: Place): number[] {
  const size = wordsOf(type)
  const out = new Array<number>(size * count).fill(0)
  for (let k = 0; k < count; k++) {
    for (let j = 0; j < width; j++) {
      if (!isSet(words, at + k * pitch + j * step)) continue
      const word = k * size + (j >> 4)
      out[word] = (out[word] ?? 0) | (1 << (j & 15))
    }
  }
  return out
}
