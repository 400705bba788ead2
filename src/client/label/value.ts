// Data types of labels and their values: what the PLC says of a label decides how its words are read and written.
import type { DataCode } from '../../codec/codec'
import { ProtocolError, RequestError } from '../../errors'
import { type LabelArea, wordsOfArea } from '../../melsec/label/codec'
import { BIT_TYPE_ID, labelDataType } from '../../melsec/label/label'
import {
  decodeArray,
  decodeValue,
  encodeValue,
  formatType,
  type PlcValue,
  parseType,
  type TypeName,
  type ValueFormat,
  type ValueType,
} from '../../value/value'
import type { LabelFormat } from './item'

/** What is known of a label once the PLC has named its type. */
export interface LabelType {
  readonly name: string
  readonly typeId: number
  readonly isBit: boolean
  /** Words of one element on the wire. */
  readonly size: number
  /** How an element is read. */
  readonly type: ValueType
  /** How an element is written: text leaves room for its closing NUL. */
  readonly written: ValueType
  /** For people, e.g. `REAL` or `STRING(21)`. */
  readonly text: string
}

/**
 * The type of a label from what Label Read Random said of it.
 * @throws ProtocolError BAD_FIELD for an ID nobody knows, or data that are not as long as the type
 */
export function labelTypeOf(name: string, typeId: number, size: number): LabelType {
  const data = labelDataType(typeId)
  if (data === undefined) {
    throw new ProtocolError(
      'BAD_FIELD',
      `${name}: the PLC says data type ID ${typeId}, which the manual does not have.`,
    )
  }
  const isText = data.bytes === undefined
  if (isText ? size === 0 : size !== (data.bytes ?? 0) / 2) {
    throw new ProtocolError('BAD_FIELD', `${name}: the PLC says ${data.title}, but sent ${2 * size} bytes.`)
  }
  const { name: typeName } = parseType(isText ? `${data.title}(1)` : data.title)
  const units = typeName === 'WSTRING' ? size : 2 * size
  const type: ValueType = isText ? { name: typeName, length: units } : { name: typeName }
  const written: ValueType = isText ? { name: typeName, length: units - 1 } : type
  const text = formatType(isText && units > 1 ? written : type)
  return { name, typeId: data.id, isBit: data.id === BIT_TYPE_ID, size, type, written, text }
}

/** WORD and UINT are one type in GX Works3, and so are DWORD and UDINT. */
const SAME: Readonly<Partial<Record<TypeName, TypeName>>> = { UINT: 'WORD', UDINT: 'DWORD' }

/**
 * Holds the type a user gave against the one the PLC says.
 * @throws RequestError BAD_TYPE
 */
export function checkGivenType(given: ValueType | undefined, { name, type, size, text }: LabelType): void {
  if (given === undefined) return
  const { length } = given
  // String(20) and String(21) take the same words (5.3 "Data length of string").
  const words = length === undefined ? size : given.name === 'WSTRING' ? length + 1 : Math.floor(length / 2) + 1
  if ((SAME[given.name] ?? given.name) === type.name && words === size) return
  const message = `${name} is ${text} in the PLC, not ${formatType(given)}: leave the type out, or correct it.`
  throw new RequestError('BAD_TYPE', message, 'type')
}

/** @throws RequestError BAD_OPTION */
function formatOf({ name, type, size }: LabelType, code: DataCode, given: LabelFormat): ValueFormat {
  const { encoding, trimSpaces, asciiWordOrder } = given
  const format: ValueFormat = {
    ...(encoding === undefined ? {} : { encoding }),
    ...(trimSpaces === undefined ? {} : { trimSpaces }),
  }
  if (code === 'binary' || size === 1 || type.length !== undefined) return format
  if (asciiWordOrder === undefined) {
    throw new RequestError(
      'BAD_OPTION',
      `${name} is ${type.name}: the manual does not say clearly which of its words comes first in ASCII code. Set ` +
        'asciiWordOrder to low-first or high-first (try it on a label whose value you know), or use binary code.',
      'asciiWordOrder',
    )
  }
  return { ...format, wordOrder: asciiWordOrder }
}

/** @throws RequestError BAD_OPTION; ProtocolError BAD_FIELD when the words are no value of the type */
export function decodeLabel(type: LabelType, words: readonly number[], code: DataCode, format: LabelFormat): PlcValue {
  if (type.isBit) return ((words[0] ?? 0) & 1) === 1
  return decodeValue(type.type, words, 0, formatOf(type, code, format))
}

/** The elements of an array. */
export function decodeLabelArray(
  type: LabelType,
  { words }: LabelArea,
  count: number,
  code: DataCode,
  format: LabelFormat,
): PlcValue[] {
  if (type.isBit) return Array.from({ length: count }, (_, at) => (((words[at >> 4] ?? 0) >> (at & 15)) & 1) === 1)
  return decodeArray(type.type, words, 0, count, formatOf(type, code, format))
}

/** Bits or bytes that so many elements take, as the array commands count them. */
export function extentOf({ isBit, size }: LabelType, count: number): Pick<LabelArea, 'unit' | 'length'> {
  return isBit ? { unit: 0, length: count } : { unit: 1, length: 2 * size * count }
}

/** What is to be written: the words of one label, or of an array. */
export type LabelContent = { readonly data: readonly number[] } | { readonly area: LabelArea }

function isList(value: PlcValue | readonly PlcValue[]): value is readonly PlcValue[] {
  return Array.isArray(value)
}

/** @throws RequestError BAD_VALUE, BAD_OPTION, LIMIT_EXCEEDED */
export function encodeLabel(
  type: LabelType,
  value: PlcValue | readonly PlcValue[],
  code: DataCode,
  format: LabelFormat,
): LabelContent {
  if (!isList(value)) return { data: wordsOf(type, value, code, format) }
  // Not map(): it would pass over the holes of an array.
  const elements = Array.from(value, (one) => wordsOf(type, one, code, format))
  const extent = extentOf(type, value.length)
  if (extent.length > 0xffff) {
    throw new RequestError('LIMIT_EXCEEDED', `${type.name}: ${value.length} elements are too many for one request.`)
  }
  if (!type.isBit) return { area: { ...extent, words: elements.flat() } }
  const words = new Array<number>(wordsOfArea(extent)).fill(0)
  elements.forEach(([bit = 0], at) => {
    words[at >> 4] = (words[at >> 4] ?? 0) | (bit << (at & 15))
  })
  return { area: { ...extent, words } }
}

function wordsOf(type: LabelType, value: PlcValue, code: DataCode, format: LabelFormat): readonly number[] {
  if (type.isBit) {
    if (typeof value === 'boolean') return [value ? 1 : 0]
    throw new RequestError('BAD_VALUE', `${type.name} is a bit: write true or false, not ${String(value)}.`)
  }
  if (type.written.length === 0) throw new RequestError('BAD_VALUE', `${type.name} has no room for text.`)
  const words = encodeValue(type.written, value, formatOf(type, code, format))
  return [...words, ...new Array<number>(type.size - words.length).fill(0)]
}
