/** Values of PLCs whose registers are bytes: from the bytes as a PLC sends them, and back. */
import { hex } from '../basics/hex'
import { RequestError } from '../errors'
import { type ByteName, type ByteType, bytesOf, byteTypes, formatByteType, isWordType } from './byte-type'
import { decodeArray, encodeArray } from './convert'
import { badContent, badValue } from './fault'
import { checkFormat, type ValueFormat } from './format'
import { isText, type PlcValue } from './type'

/**
 * `count` values that follow one another.
 *
 * @param bytes as a PLC sends them: low byte of a word first, low word first, unless the format says otherwise
 * @param offset in bytes
 * @throws RequestError BAD_TYPE, BAD_OPTION, or OUT_OF_RANGE when there are too few bytes
 * @throws ProtocolError BAD_FIELD when the bytes are no value of the type; the message names the element
 * @example valuesOfBytes(parseByteType('INT'), Buffer.from('34120100', 'hex'), 0, 2) // [0x1234, 1]
 */
export function valuesOfBytes(
  type: ByteType,
  bytes: Uint8Array,
  offset: number,
  count: number,
  format: ValueFormat = {},
): PlcValue[] {
  checkFormat(format)
  checkWhole(type, format)
  const size = bytesOf(type)
  requireBytes(bytes, offset, count * size)
  if (!isWordType(type)) return Array.from(bytes.subarray(offset, offset + count), byteReaders[type.name])
  if (!isText(type)) return decodeArray(type, wordsIn(bytes, offset, count * size), 0, count, format)
  const padded = size + (size % 2)
  const words = Array.from({ length: count }, (_, index) => wordsIn(bytes, offset + index * size, size))
  return decodeArray(type, words.flat().slice(0, (count * padded) / 2), 0, count, format)
}

/**
 * The bytes of values that follow one another, as a PLC takes them.
 *
 * @throws RequestError BAD_VALUE when a value does not fit the type, BAD_TYPE, BAD_OPTION; the message names the element
 * @example bytesOfValues(parseByteType('BCD16'), [1234]) // 34 12
 */
export function bytesOfValues(type: ByteType, values: readonly PlcValue[], format: ValueFormat = {}): Uint8Array {
  checkFormat(format)
  checkWhole(type, format)
  if (!Array.isArray(values)) throw badValue(`an array of ${formatByteType(type)}`, values, 'an array')
  if (!isWordType(type)) return Uint8Array.from(values, (value, index) => byteOf(type.name, value, index))
  const words = encodeArray(type, values, format)
  const size = bytesOf(type)
  const padded = size + (size % 2)
  const out = new Uint8Array(values.length * size)
  for (let at = 0; at < out.length; at++) {
    const from = Math.floor(at / size) * padded + (at % size)
    const word = words[from >> 1] ?? 0
    out[at] = from % 2 === 0 ? word & 0xff : word >>> 8
  }
  return out
}

/** Half a word cannot have its bytes exchanged. */
function checkWhole(type: ByteType, { byteOrder }: ValueFormat): void {
  if (type.name !== 'STRING' || byteOrder !== 'high-first' || bytesOf(type) % 2 === 0) return
  throw new RequestError(
    'BAD_OPTION',
    `${formatByteType(type)} with the high byte first takes whole words: use an even length`,
    'byteOrder',
  )
}

function requireBytes(bytes: Uint8Array, offset: number, size: number): void {
  if (Number.isInteger(offset) && offset >= 0 && size >= 0 && offset + size <= bytes.length) return
  throw new RequestError(
    'OUT_OF_RANGE',
    `${size} bytes from offset ${offset} are needed, but ${bytes.length} bytes are given`,
  )
}

/** A byte alone at the end has 0 above it. */
function wordsIn(bytes: Uint8Array, offset: number, size: number): number[] {
  const words = new Array<number>(Math.ceil(size / 2))
  for (let at = 0; at < words.length; at++) {
    const low = offset + 2 * at
    const high = 2 * at + 1 < size ? (bytes[low + 1] ?? 0) : 0
    words[at] = (bytes[low] ?? 0) | (high << 8)
  }
  return words
}

/** Reads one byte of each type. */
const byteReaders: { readonly [N in ByteName]: (byte: number, index: number) => number } = {
  BYTE: (byte) => byte,
  USINT: (byte) => byte,
  SINT: (byte) => (byte << 24) >> 24,
  BCD8: (byte, index) => {
    const digits = hex(byte, 2)
    if (/^\d+$/.test(digits)) return Number(digits)
    throw badContent('BCD8', `element ${index}: ${digits}H`, 'a digit is above 9; read it as BYTE, or correct its type')
  },
}

function byteOf(name: ByteName, value: unknown, index: number): number {
  const { min, max, kind } = byteTypes[name]
  const number = typeof value === 'bigint' ? Number(value) : value
  if (typeof number !== 'number' || !Number.isInteger(number) || number < min || number > max) {
    throw badValue(name, value, `a whole number from ${min} to ${max} (element ${index})`)
  }
  return kind === 'bcd' ? Math.floor(number / 10) * 16 + (number % 10) : number & 0xff
}
