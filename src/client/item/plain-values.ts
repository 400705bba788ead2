// Values as programs have them: lists, objects by name, typed arrays.

import { RequestError } from '../../errors'
import type { PlcValue } from '../../value/value'
import { isList, namesOf } from './input-checks'
import type { NumberArray, PlainValue, ReadResult, WriteEntry, WriteValue, WriteValues } from './item-value'

/** The value. @throws PlcError what went wrong instead */
export function plainValue(result: ReadResult | undefined): PlcValue | PlcValue[] {
  if (result?.ok === true) return result.value
  throw result?.error ?? new RequestError('BAD_ADDRESS', 'There is nothing to read.')
}

/** Values in the order of their names. */
export function byName<T>(names: readonly string[], values: readonly T[]): Record<string, T> {
  return Object.fromEntries(names.map((name, i) => [name, values[i] as T]))
}

/** A value to write; of a typed array the numbers. Its elements are checked as those of any array. */
export function asPlainValue(value: WriteValue): PlainValue {
  return isTyped(value) ? Array.from<number | bigint>(value) : value
}

/** Also one of another realm; its prototype is not ours. */
export function isTyped(value: unknown): value is NumberArray {
  return ArrayBuffer.isView(value) && Object.prototype.toString.call(value) !== '[object DataView]'
}

/** @throws RequestError BAD_ADDRESS when it is neither a list nor an object */
export function entriesOf(values: WriteValues): readonly WriteEntry[] {
  if (isList(values)) return values
  const names = namesOf(values, 'Values to write are an item and its value, a list of entries, or an object by address')
  return names.map((item) => ({ item, value: values[item] as WriteValue }))
}
