// Results of many items into what the caller asked for.

import { shown } from '../../basics/show'
import { ClosedError, type Outcome, type PlcError, RequestError, WriteError, type WriteResult } from '../../errors'
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
export function valueGiven(value: WriteValue): PlainValue {
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

type Failed = WriteResult & { readonly ok: false }

/** Failures that are told in the message; `results` have all. */
const MOST_TOLD = 3

/** @throws WriteError when anything was not written */
export function checkAllWritten(results: readonly WriteResult[]): void {
  const failed = results.filter((result): result is Failed => !result.ok)
  const ranked = [...failed].sort((a, b) => rankOf(a.error) - rankOf(b.error))
  const [first] = ranked
  if (first === undefined) return
  const outcome = outcomeOfAll(results.length - failed.length, failed)
  throw new WriteError(messageOf(results.length, ranked), outcome, results, first.error)
}

/** What the outcomes of the items make together: whoever writes all of them again must know what that would do. */
function outcomeOfAll(written: number, failed: readonly Failed[]): Outcome {
  const outcomes = failed.map(({ error }) => error.outcome)
  if (written > 0 || outcomes.includes('unknown')) return 'unknown'
  return outcomes.includes('refused') ? 'refused' : 'notSent'
}

/** What nobody knows comes first, what was left out because of another item last. */
function rankOf(error: PlcError): number {
  if (error.outcome === 'unknown') return 0
  return error instanceof ClosedError && error.code === 'ABORTED' ? 2 : 1
}

function messageOf(count: number, ranked: readonly Failed[]): string {
  const told = ranked.slice(0, MOST_TOLD).map(({ item, error: { message } }) => {
    const name = shown(item)
    return message.startsWith(name) || message.startsWith(JSON.stringify(item)) ? message : `${name}: ${message}`
  })
  const left = ranked.length - told.length
  const reasons = [...told, ...(left === 0 ? [] : [`And ${left} more: see results.`])].join(' ')
  if (count === 1) return reasons
  const unknown = ranked.filter(({ error }) => error.outcome === 'unknown').length
  const counts = [
    [count - ranked.length, 'written'],
    [ranked.length - unknown, 'not written'],
    [unknown, 'not known'],
  ] as const
  const sums = counts.flatMap(([number, what]) => (number === 0 ? [] : [`${number} ${what}`])).join(', ')
  return `Of ${count} items: ${sums}. ${reasons}`
}
