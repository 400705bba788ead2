// What is written, checked and encoded before anything is sent.

import { octal } from '../../basics/octal'
import { RequestError } from '../../errors'
import { FILE_REGISTERS, PAGE } from '../../jw/address'
import { formatByteType, isWordType } from '../../value/byte-type'
import { bytesOfValues } from '../../value/byte-value'
import { badValue } from '../../value/fault'
import type { PlainValue } from '../item/item-value'
import { valuesToWrite } from '../item/values-to-write'
import type { WrittenSpan } from '../plan/written-twice'
import type { ParsedJwItem } from './item'
import { CELL, type JwLayout, type JwSpace, jwPiecesOf } from './layout'
import type { JwLimits } from './limits'

/** What the cells of a unit are set to. */
export type JwContent =
  | { readonly kind: 'bytes'; readonly bytes: Uint8Array }
  /** Relays from bit `at` of the space on. */
  | { readonly kind: 'bits'; readonly at: number; readonly bits: readonly boolean[] }
  /** A timer or counter that is set or reset. */
  | { readonly kind: 'timer'; readonly isSet: boolean }

/** What has to stand in one request: cells `from` to `to - 1`. */
export interface JwWriteUnit {
  readonly entry: number
  readonly space: JwSpace
  readonly from: number
  readonly to: number
  readonly content: JwContent
  /** Values of the entry. */
  readonly count: number
  /** A part of an array that is larger than one request: it shares none with others. */
  readonly isPart: boolean
}

export interface JwUnitOptions {
  readonly limits: JwLimits
  readonly lists: boolean
  /** Bits of the system memory: the byte is read, changed and written back. */
  readonly readModifyWrite: boolean
}

/**
 * The units of one item: one, or the parts of an array that no single request writes.
 * @throws RequestError BAD_VALUE when the value does not fit, UNSUPPORTED when no command writes the operand
 */
export function jwUnitsOf(
  layout: JwLayout,
  item: ParsedJwItem,
  value: PlainValue,
  entry: number,
  options: JwUnitOptions,
): JwWriteUnit[] {
  const { space, start } = layout
  const values = valuesToWrite(item, formatByteType(item.type), value)
  if (item.type.name !== 'BOOL') {
    if (space.in === 'timer') throw onlyRead(item)
    const bytes = bytesOfItem(item, values)
    return bytesUnits(layout, item, entry, bytes, options)
  }
  const bits = Array.from(values, (bit) => {
    if (typeof bit === 'boolean') return bit
    throw badValue('BOOL', bit, 'true or false')
  })
  if (space.in === 'timer') {
    const first = start / CELL
    return bits.map((isSet, i) => ({
      ...{ entry, space, from: first + i, to: first + i + 1, count: 1, isPart: bits.length > 1 },
      content: { kind: 'timer', isSet },
    }))
  }
  if (space.in === 'system' && !options.readModifyWrite) throw bitOfSystem(item)
  return bitUnits(layout, entry, bits, options)
}

function bytesOfItem({ text, type, format }: ParsedJwItem, values: Parameters<typeof bytesOfValues>[1]): Uint8Array {
  try {
    return bytesOfValues(type, values, format)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    throw new RequestError(error.code, `${text}: ${error.message}`, error.field ?? text)
  }
}

function bytesUnits(
  layout: JwLayout,
  item: ParsedJwItem,
  entry: number,
  bytes: Uint8Array,
  { limits }: JwUnitOptions,
): JwWriteUnit[] {
  const { space, width } = layout
  const capacity = space.in === 'system' ? limits.writeSystem : limits.writeBytes
  const size = width / CELL
  const pieces = jwPiecesOf(layout, item, entry, capacity)
  return pieces.map(({ from, to, first, count }) => {
    const own = bytes.subarray(first * size, (first + count) * size)
    return { entry, space, from, to, content: { kind: 'bytes', bytes: own }, count, isPart: pieces.length > 1 }
  })
}

/** Bits that fill bytes are those bytes; others are relays of a list, or one by one where there are no lists. */
function bitUnits(
  { space, start }: JwLayout,
  entry: number,
  bits: readonly boolean[],
  { limits, lists }: JwUnitOptions,
): JwWriteUnit[] {
  const end = start + bits.length
  const unit = (low: number, high: number): Omit<JwWriteUnit, 'isPart'> => {
    const own = bits.slice(low - start, high - start)
    const isBytes = low % CELL === 0 && high % CELL === 0
    const content: JwContent = isBytes ? { kind: 'bytes', bytes: packed(own) } : { kind: 'bits', at: low, bits: own }
    return { entry, space, from: Math.floor(low / CELL), to: Math.ceil(high / CELL), content, count: own.length }
  }
  const relays = space.in === 'file' && lists ? limits.setRelays : 1
  // Bits of the system memory are changed in their byte, all of one byte at once.
  const isOne =
    space.in === 'system' ? Math.floor(start / CELL) === Math.floor((end - 1) / CELL) : bits.length <= relays
  const bytesAtOnce = space.in === 'system' ? limits.writeSystem : limits.writeBytes
  const isWhole = start % CELL === 0 && end % CELL === 0 && bits.length <= CELL * bytesAtOnce
  if (isOne || isWhole) return [{ ...unit(start, end), isPart: false }]
  const cuts = cutsOf(start, end, CELL * bytesAtOnce, space.in === 'system' ? CELL : relays)
  return cuts.slice(1).map((high, i) => ({ ...unit(cuts[i] ?? start, high), isPart: true }))
}

/** Where bits are cut: at the first and the last whole byte, and where a request has no room for more. */
function cutsOf(start: number, end: number, wholeBits: number, loose: number): number[] {
  const firstByte = Math.min(end, Math.ceil(start / CELL) * CELL)
  const lastByte = Math.max(firstByte, Math.floor(end / CELL) * CELL)
  return [
    ...steps(start, firstByte, loose),
    ...steps(firstByte, lastByte, wholeBits),
    ...steps(lastByte, end, loose),
    end,
  ]
}

function steps(from: number, to: number, step: number): number[] {
  return from >= to ? [] : Array.from({ length: Math.ceil((to - from) / step) }, (_, i) => from + i * step)
}

/** The first bit is the lowest. */
function packed(bits: readonly boolean[]): Uint8Array {
  const bytes = new Uint8Array(bits.length / CELL)
  bits.forEach((bit, i) => {
    if (bit) bytes[i >> 3] = (bytes[i >> 3] ?? 0) | (1 << (i & 7))
  })
  return bytes
}

/** What an item writes, in bits. The files from 01 on are counted as one, because an item may go from one to the next. */
export function jwSpanOf(
  { space, start, width, count }: JwLayout,
  { text }: ParsedJwItem,
  entry: number,
): { readonly place: string; readonly span: WrittenSpan } {
  const isRegisters = space.in === 'file' && space.file >= FILE_REGISTERS
  const from = start + (isRegisters && !space.isWhole ? (space.file - FILE_REGISTERS) * PAGE * CELL : 0)
  return { place: isRegisters ? 'registers' : space.in, span: { entry, text, from, to: from + width * count } }
}

function onlyRead({ text, type }: ParsedJwItem): RequestError {
  const name = isWordType(type) ? formatByteType(type) : type.name
  const message = `${JSON.stringify(text)}: no command writes the current value of a timer or counter as ${name}; BOOL sets (true) or resets (false) it.`
  return new RequestError('UNSUPPORTED', message, text)
}

function bitOfSystem({ text, place }: ParsedJwItem): RequestError {
  const byte = place.in === 'system' ? `#${octal(place.address, 4)}` : 'the byte'
  const message =
    `${JSON.stringify(text)} is one bit of the system memory, and no command writes that alone. With the option readModifyWrite ` +
    `${byte} is read, changed and written back; what the PLC changes in it in between is lost.`
  return new RequestError('UNSUPPORTED', message, text)
}
