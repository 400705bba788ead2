/** Values from words and words from values, one or many, in any word and byte order. */

import { show } from '../basics/show'
import { PlcError, ProtocolError, RequestError } from '../errors'
import { badValue } from './fault'
import { checkFormat, type ValueFormat } from './format'
import { readers, real32, signed16, signed32, unsigned16, writers } from './number'
import { decodeText, encodeText } from './text'
import {
  formatType,
  isText,
  type NumberName,
  numberName,
  type PlcValue,
  type ValueType,
  valueTypes,
  wordsOf,
} from './type'
import { requireWords, swapBytes, type Words, wordAt } from './word'

const melsecOrder: ValueFormat = {}

function isMelsecOrder(format: ValueFormat): boolean {
  return format.wordOrder !== 'high-first' && format.byteOrder !== 'high-first'
}

/** Numbers of `size` words each, between the given order and low-first; the same step leads there and back. */
function rearranged(words: Words, offset: number, count: number, size: number, format: ValueFormat): number[] {
  const flip = format.wordOrder === 'high-first' ? size - 1 : 0
  const swapped = format.byteOrder === 'high-first'
  const out = new Array<number>(count * size)
  for (let at = 0; at < out.length; at += size)
    for (let index = 0; index < size; index++) {
      const word = wordAt(words, offset + at + Math.abs(flip - index))
      out[at + index] = swapped ? swapBytes(word) : word
    }
  return out
}

/** The types that fill whole register files are read in loops of their own, so that nothing is called per number. */
function readNumbers(name: NumberName, words: Words, offset: number, count: number): PlcValue[] {
  const out = new Array<PlcValue>(count)
  const read = readers[name]
  const { words: size } = valueTypes[name]
  switch (name) {
    case 'INT':
      for (let index = 0; index < count; index++) out[index] = signed16(words, offset + index)
      return out
    case 'UINT':
    case 'WORD':
      for (let index = 0; index < count; index++) out[index] = unsigned16(words, offset + index)
      return out
    case 'DINT':
      for (let index = 0; index < count; index++) out[index] = signed32(words, offset + 2 * index)
      return out
    case 'REAL':
      for (let index = 0; index < count; index++) out[index] = real32(words, offset + 2 * index)
      return out
    default:
      return forEach(count, (index) => read(words, offset + size * index))
  }
}

/** Runs for one element after the other; an error says which one. */
function forEach<T>(count: number, run: (index: number) => T): T[] {
  const out = new Array<T>(count)
  let index = 0
  try {
    for (; index < count; index++) out[index] = run(index)
  } catch (error) {
    throw ofElement(index, error)
  }
  return out
}

function ofElement(index: number, error: unknown): unknown {
  if (!(error instanceof PlcError)) return error
  const message = `element ${index}: ${error.message}`
  if (error instanceof RequestError) return new RequestError(error.code, message, error.field)
  return error instanceof ProtocolError ? new ProtocolError(error.code, message) : error
}

/**
 * One value from the words at an offset.
 *
 * Not-a-number and infinities in REAL and LREAL are returned as they are. LINT and ULINT are BigInt.
 *
 * @param words what was read, whole numbers from 0 to 65535, low word first unless the format says otherwise
 * @throws RequestError BAD_TYPE, BAD_OPTION, or OUT_OF_RANGE when there are too few words
 * @throws ProtocolError BAD_FIELD when what the PLC holds is no value of the type: a BCD digit above 9, bytes that are
 *   no text in the encoding. It concerns this value alone, not the connection.
 * @example decodeValue(parseType('REAL'), [0x0000, 0x3f40], 0) // 0.75
 */
export function decodeValue(type: ValueType, words: Words, offset: number, format = melsecOrder): PlcValue {
  const size = wordsOf(type)
  checkFormat(format)
  requireWords(words, offset, size)
  if (isText(type)) return decodeText(type, words, offset, format)
  const read = readers[numberName(type)]
  return isMelsecOrder(format) ? read(words, offset) : read(rearranged(words, offset, 1, size, format), 0)
}

type Decoder = (words: Words, offset: number) => PlcValue

/** Made once for each type, for whoever reads the same values again and again. */
const decoders = new Map<NumberName, Decoder>()

/**
 * Reads values of one type and format, as `decodeValue` does; what can be found out beforehand is.
 * @throws RequestError BAD_TYPE, BAD_OPTION
 * @example decoderOf(parseType('DINT'))([1, 0], 0) // 1
 */
export function decoderOf(type: ValueType, format = melsecOrder): Decoder {
  checkFormat(format)
  const size = wordsOf(type)
  if (isText(type) || !isMelsecOrder(format)) return (words, offset) => decodeValue(type, words, offset, format)
  const name = numberName(type)
  const known = decoders.get(name)
  if (known !== undefined) return known
  const read = readers[name]
  const decoder: Decoder = (words, offset) => {
    requireWords(words, offset, size)
    return read(words, offset)
  }
  decoders.set(name, decoder)
  return decoder
}

/**
 * `count` values that follow one another from an offset, each in `wordsOf(type)` words.
 *
 * @throws as {@link decodeValue}; the message names the element
 * @example decodeArray(parseType('DINT'), [1, 0, 0xffff, 0xffff], 0, 2) // [1, -1]
 */
export function decodeArray(
  type: ValueType,
  words: Words,
  offset: number,
  count: number,
  format = melsecOrder,
): PlcValue[] {
  const size = wordsOf(type)
  checkFormat(format)
  if (!Number.isInteger(count) || count < 0)
    throw new RequestError('OUT_OF_RANGE', `a count of elements is a whole number from 0, not ${show(count)}`)
  requireWords(words, offset, count * size)
  if (isText(type)) return forEach(count, (index) => decodeText(type, words, offset + size * index, format))
  return isMelsecOrder(format)
    ? readNumbers(numberName(type), words, offset, count)
    : readNumbers(numberName(type), rearranged(words, offset, count, size, format), 0, count)
}

/**
 * The words of one value.
 *
 * Nothing is converted: a number is not written from a text, nor text from a number, and nothing is rounded to a whole
 * number, clamped or cut. A BigInt within the range is taken for every whole number, a safe whole number for LINT and
 * ULINT. REAL rounds to the nearest 32-bit number.
 *
 * @returns `wordsOf(type)` words, low word first unless the format says otherwise
 * @throws RequestError BAD_VALUE when the value does not fit the type; BAD_TYPE, BAD_OPTION
 * @example encodeValue(parseType('STRING(4)'), '12AB') // [0x3231, 0x4241]
 */
export function encodeValue(type: ValueType, value: PlcValue, format = melsecOrder): number[] {
  const size = wordsOf(type)
  checkFormat(format)
  if (isText(type)) return encodeText(type, value, format)
  const out = new Array<number>(size)
  writers[numberName(type)](value, out, 0)
  return isMelsecOrder(format) ? out : rearranged(out, 0, 1, size, format)
}

/**
 * The words of values that follow one another.
 *
 * @throws as {@link encodeValue}; the message names the element
 * @example encodeArray(parseType('DINT'), [1, -1]) // [1, 0, 0xffff, 0xffff]
 */
export function encodeArray(type: ValueType, values: readonly PlcValue[], format = melsecOrder): number[] {
  const size = wordsOf(type)
  checkFormat(format)
  if (!Array.isArray(values)) throw badValue(`an array of ${formatType(type)}`, values, 'an array')
  if (isText(type)) return forEach(values.length, (index) => encodeText(type, values[index], format)).flat()
  const out = new Array<number>(values.length * size)
  const write = writers[numberName(type)]
  forEach(values.length, (index) => write(values[index], out, index * size))
  return isMelsecOrder(format) ? out : rearranged(out, 0, values.length, size, format)
}
