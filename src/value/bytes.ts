/** A value in bytes that stand for themselves, as a PLC sends them unasked. */
import { decodeValue } from './convert'
import type { ValueFormat } from './format'
import { isText, type PlcValue, parseType } from './type'

/**
 * One value from bytes, low byte of each word first.
 *
 * @param type as behind the colon of an item, e.g. `REAL` or `STRING(20)`
 * @param offset in words
 * @throws RequestError BAD_TYPE, BAD_OPTION, or OUT_OF_RANGE when there are too few bytes
 * @throws ProtocolError BAD_FIELD when the bytes are no value of the type, as in {@link decodeValue}
 * @example valueOfBytes(data, 'REAL', 2) // the third and fourth word
 */
export function valueOfBytes(bytes: Uint8Array, type: string, offset = 0, format?: ValueFormat): PlcValue {
  const parsed = parseType(type)
  // The last character of a text may stand alone; half a number is none.
  const size = isText(parsed) ? Math.ceil(bytes.length / 2) : Math.floor(bytes.length / 2)
  const words = Array.from({ length: size }, (_, i) => (bytes[2 * i] ?? 0) | ((bytes[2 * i + 1] ?? 0) << 8))
  return decodeValue(parsed, words, offset, format)
}
