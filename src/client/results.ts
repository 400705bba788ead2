// Results of many items into what the caller asked for.
import { RequestError } from '../errors'
import type { PlcValue } from '../value/value'
import type { ReadResult } from './plan'

/** The value. @throws PlcError what went wrong instead */
export function plainValue(result: ReadResult | undefined): PlcValue | PlcValue[] {
  if (result?.ok === true) return result.value
  throw result?.error ?? new RequestError('BAD_ADDRESS', 'There is nothing to read.')
}

/** Values in the order of their names. */
export function byName<T>(names: readonly string[], values: readonly T[]): Record<string, T> {
  return Object.fromEntries(names.map((name, i) => [name, values[i] as T]))
}
