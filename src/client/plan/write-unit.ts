// What is written, checked and encoded before anything is sent.

import { show } from '../../basics/show'
import { RequestError } from '../../errors'
import { badValue } from '../../value/fault'
import { encodeArray, encodeValue, formatType, type PlcValue, wordsOf } from '../../value/value'
import type { ParsedItem } from '../item/item'
import type { PlainValue } from '../item/item-value'
import { valuesToWrite } from '../item/values-to-write'
import { type Area, areaKey } from './area'
import { type Areas, type Layout, type Piece, piecesOf, writeLayout } from './layout'
import { refuseOverlaps, type WrittenSpan } from './written-twice'

/** What the cells of a unit are set to. */
export type Content =
  | { readonly kind: 'words'; readonly words: readonly number[] }
  | { readonly kind: 'bits'; readonly bits: readonly boolean[] }
  /** Some bits of each word: the others are read and written back. */
  | { readonly kind: 'masked'; readonly words: readonly number[]; readonly masks: readonly number[] }

/** What has to stand in one request: cells `from` to `to - 1`. */
export interface WriteUnit {
  readonly entry: number
  readonly area: Area
  readonly from: number
  readonly to: number
  readonly content: Content
  /** Values `first` to `first + count - 1` of the entry. */
  readonly first: number
  readonly count: number
  /** A part of an array that is larger than one request: it shares none with others. */
  readonly isPart: boolean
}

/**
 * The units of one item: one, or the parts of an array that is too large for one request.
 *
 * @throws RequestError BAD_VALUE when the value does not fit, UNSUPPORTED when no command writes the device
 */
export function unitsOf(
  areas: Areas,
  item: ParsedItem,
  value: PlainValue,
  entry: number,
  readModifyWrite: boolean,
): WriteUnit[] {
  const layout = writeLayout(areas, item)
  const isMasked = item.bit !== undefined
  if (isMasked && !readModifyWrite) throw bitOfWord(item)
  const words = isMasked || layout.area.kind === 'bit' ? undefined : wordsToWrite(item, value)
  const bits = words === undefined ? bitsToWrite(item, value) : []
  const pieces = piecesOf(areas, layout, item, entry)
  return pieces.map((piece): WriteUnit => {
    const content = contentOf(piece, words, bits, isMasked)
    const { from, to, first, count } = piece
    return { entry, area: layout.area, from, to, content, first, count, isPart: pieces.length > 1 }
  })
}

function contentOf(
  { layout, first, count, from, to }: Piece,
  words: readonly number[] | undefined,
  bits: readonly boolean[],
  isMasked: boolean,
): Content {
  if (words !== undefined) {
    const size = layout.width / 16
    return { kind: 'words', words: words.slice(first * size, (first + count) * size) }
  }
  const own = bits.slice(first * layout.width, (first + count) * layout.width)
  if (!isMasked) return { kind: 'bits', bits: own }
  const masks = new Array<number>(to - from).fill(0)
  const set = [...masks]
  own.forEach((bit, i) => {
    const at = layout.start + first * layout.pitch + i - 16 * from
    const word = Math.floor(at / 16)
    masks[word] = (masks[word] ?? 0) | (1 << (at % 16))
    if (bit) set[word] = (set[word] ?? 0) | (1 << (at % 16))
  })
  return { kind: 'masked', words: set, masks }
}

function bitOfWord({ text }: ParsedItem): RequestError {
  return new RequestError(
    'UNSUPPORTED',
    `${text} is one bit of a word, and no command writes that alone. With the option readModifyWrite the word is read, ` +
      'changed and written back; what the PLC program changes in the word in between is lost. A bit device (M, B) has no such risk.',
    text,
  )
}

/** One value or all values of an array. */
function valuesOf(item: ParsedItem, value: PlainValue): readonly PlcValue[] {
  return valuesToWrite(item, formatType(item.type), value)
}

function fault(text: string, message: string): RequestError {
  return new RequestError('BAD_VALUE', `${text}: ${message}`, text)
}

function wordsToWrite(item: ParsedItem, value: PlainValue): number[] {
  const values = valuesOf(item, value)
  const [only] = values
  // Two calls, because the error of an array names the element.
  return item.count === undefined && only !== undefined
    ? encodeValue(item.type, only, item.format)
    : encodeArray(item.type, values, item.format)
}

function bitsToWrite(item: ParsedItem, value: PlainValue): boolean[] {
  if (item.digits !== undefined) return digitsToWrite(item, item.digits, value)
  // Not map(): it would pass over the holes of an array.
  return Array.from(valuesOf(item, value), (bit) => {
    if (typeof bit === 'boolean') return bit
    throw badValue('BOOL', bit, 'true or false')
  })
}

/** The lowest bits of each value; those above must be 0, because nothing is cut off in silence. */
function digitsToWrite(item: ParsedItem, digits: number, value: PlainValue): boolean[] {
  const words = wordsToWrite(item, value)
  const size = wordsOf(item.type)
  const bits: boolean[] = []
  for (let at = 0; at < words.length; at += size) {
    for (let bit = 0; bit < 16 * size; bit++) {
      const isSet = (((words[at + (bit >> 4)] ?? 0) >> (bit & 15)) & 1) === 1
      if (bit < 4 * digits) bits.push(isSet)
      else if (isSet) {
        const given = valuesOf(item, value)[at / size]
        throw fault(item.text, `${show(given)} does not fit into the ${4 * digits} bits of K${digits}.`)
      }
    }
  }
  return bits
}

/** An item and where its bits lie, to find what is written twice. */
export interface Written {
  readonly entry: number
  readonly item: ParsedItem
}

/**
 * Entries that write the same device or bit, each with its error: which value would stay is not for this program to
 * guess. Devices that are the same by another name (index registers, R and ZR) cannot be found.
 */
export function writtenTwice(areas: Areas, entries: readonly Written[]): Map<number, RequestError> {
  const byPlace = new Map<string, WrittenSpan[]>()
  for (const written of entries) {
    const place = areaKey('word', written.item.address)
    const { entry, item } = written
    const span = { entry, text: item.text, ...bitsIn(writeLayout(areas, written.item), written.item.count ?? 1) }
    byPlace.set(place, [...(byPlace.get(place) ?? []), span])
  }
  return refuseOverlaps([...byPlace.values()])
}

function bitsIn({ start, pitch, width, step }: Layout, count: number): { from: number; to: number } {
  return { from: start, to: start + (count - 1) * pitch + (width - 1) * step + 1 }
}
