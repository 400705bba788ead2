// What a write node writes: values of its rows, or values by name or address out of the message.
import type { Item, PlcValue } from '../src/index'
import { refusal } from './failure'
import { kindOf } from './kind'
import { type ItemRow, itemOf, nameOf } from './stored'
import type { Texts } from './texts'

export type WritableValue = PlcValue | PlcValue[]

/** One value to write, with the name that errors call it by. */
export interface NamedEntry {
  readonly name: string
  readonly item: Item
  readonly value: WritableValue
}

/**
 * @param given values by the name of a row or by address, e.g. `{ setpoint: 71.5, M10: true }`
 * @throws NodeFailure BAD_INPUT when it is not that; nothing is written then.
 */
export function entriesByName(given: unknown, rows: readonly ItemRow[], texts: Texts): NamedEntry[] {
  if (typeof given !== 'object' || given === null || Array.isArray(given) || ArrayBuffer.isView(given)) {
    throw refusal('BAD_INPUT', texts('error.notValues', { kind: kindOf(given) }))
  }
  const entries = Object.entries(given)
  if (entries.length === 0) throw refusal('BAD_INPUT', texts('error.noValues'))
  const moved = entries.length > 1 ? entries.find(([name]) => isWholeNumber(name)) : undefined
  if (moved !== undefined) throw refusal('BAD_INPUT', texts('error.numbersFirst', { name: moved[0] }))
  return entries.map(([name, value]: [string, unknown]) => entryOf(name, value, rows, texts))
}

/**
 * @param topic the name of a row, or an address
 * @throws NodeFailure BAD_INPUT when the topic is no text; nothing is written then.
 */
export function entryByTopic(topic: unknown, value: unknown, rows: readonly ItemRow[], texts: Texts): NamedEntry {
  if (typeof topic === 'string' && topic.trim() !== '') return entryOf(topic, value, rows, texts)
  throw refusal('BAD_INPUT', texts('error.notTopic', { kind: topic === '' ? '""' : kindOf(topic) }))
}

/** JavaScript moves such names of an object to the front: the order of the writes would be lost, such as of register 19000. */
function isWholeNumber(name: string): boolean {
  return /^(?:0|[1-9][0-9]*)$/.test(name)
}

function entryOf(name: string, value: unknown, rows: readonly ItemRow[], texts: Texts): NamedEntry {
  const row = rows.find((candidate) => nameOf(candidate) === name)
  return { name, item: row === undefined ? name : itemOf(row), value: writable(name, value, texts) }
}

/** @throws NodeFailure BAD_VALUE naming the item when it is no value a PLC can hold. */
export function writable(name: string, value: unknown, texts: Texts): WritableValue {
  if (isPlcValue(value)) return value
  const list = isNumberArray(value) ? Array.from(value) : value
  if (Array.isArray(list) && list.every(isPlcValue)) return list
  throw refusal('BAD_VALUE', texts('error.notWritable', { name, kind: kindOf(value) }), { field: name })
}

/**
 * A typed array, also of a function node's realm. A Buffer holds bytes, and whether one of them or two are a word nobody
 * knows.
 */
function isNumberArray(value: unknown): value is ArrayLike<number | bigint> {
  return ArrayBuffer.isView(value) && !Buffer.isBuffer(value) && 'length' in value
}

function isPlcValue(value: unknown): value is PlcValue {
  return ['boolean', 'number', 'bigint', 'string'].includes(typeof value)
}

/**
 * The number that was typed. A whole number beyond what a JavaScript number can hold exactly is a BigInt, so that no
 * digit is lost on the way to a LINT.
 */
export function typedNumber(text: string): number | bigint {
  const trimmed = text.trim()
  const value = trimmed === '' ? Number.NaN : Number(trimmed)
  return Number.isSafeInteger(value) || !/^[+-]?[0-9]+$/.test(trimmed) ? value : BigInt(trimmed)
}

/**
 * Whether what was read back is what was written.
 * @param type of the item; REAL keeps 32 bits of a number, so what comes back is the nearest of those
 */
export function isSame(written: WritableValue, read: WritableValue, type: string): boolean {
  if (Array.isArray(written) || Array.isArray(read)) {
    if (!Array.isArray(written) || !Array.isArray(read) || written.length !== read.length) return false
    return written.every((value, index) => isSame(value, read[index] ?? Number.NaN, type))
  }
  if (typeof written === 'bigint' || typeof read === 'bigint') {
    return isWhole(written) && isWhole(read) && BigInt(written) === BigInt(read)
  }
  if (typeof written === 'number' && typeof read === 'number') {
    const kept = type === 'REAL' ? Math.fround(written) : written
    // Not a number is kept as such, and minus zero is zero.
    return kept === read || (Number.isNaN(kept) && Number.isNaN(read))
  }
  return written === read
}

function isWhole(value: PlcValue): value is number | bigint {
  return typeof value === 'bigint' || Number.isInteger(value)
}
