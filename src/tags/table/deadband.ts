/**
 * Whether a value has changed enough to be told again. Compared is with what was told last, never with what was read last: a slow
 * drift adds up, and is told as soon as it exceeds the deadband. No change that exceeds it is ever hidden.
 */
import { isPlainObject } from '../../basics/option-checks'
import { show } from '../../basics/show'
import type { PlcValue } from '../../value/type'
import { deadbandKinds, type Tag } from './tag'

/** A value, or the values of an array. */
export type TagValue = PlcValue | readonly PlcValue[]

/**
 * The deadband of a tag as a number in its unit; 0 when it has none. Percent are of the engineering limits of its scaling, else of
 * its `min` and `max`; `problemsOfTags` refuses percent of a tag that has neither.
 */
export function thresholdOf({
  deadband,
  scaling,
  min,
  max,
}: Pick<Tag, 'deadband' | 'scaling' | 'min' | 'max'>): number {
  if (deadband === undefined) return 0
  if (deadband.kind === 'absolute') return deadband.value
  const [low, high] = deadband.of ?? scaling?.engineering ?? [min ?? 0, max ?? 0]
  return (Math.abs(high - low) * deadband.value) / 100
}

const FIELDS: readonly string[] = ['kind', 'value', 'of']

/** What is wrong with a deadband as data; undefined when nothing is. */
export function deadbandProblem(given: unknown): string | undefined {
  const kinds: readonly unknown[] = deadbandKinds
  if (!isPlainObject(given) || !kinds.includes(given.kind) || !isAmount(given.value)) {
    return `A deadband is { kind: ${deadbandKinds.join(' or ')}, value: a number from 0 }.`
  }
  const { kind, value, of } = given
  const unknown = Object.keys(given).find((field) => !FIELDS.includes(field))
  if (unknown !== undefined) return `There is no ${show(unknown)} in it; there is ${FIELDS.join(', ')}.`
  if (of === undefined) return kind === 'percent' && value > 100 ? 'A deadband has at most 100 percent.' : undefined
  if (kind === 'absolute') return 'A range belongs to a deadband in percent: leave of out.'
  if (value > 100) return 'A deadband has at most 100 percent.'
  return isRange(of) ? undefined : 'The range of a deadband in percent is two numbers, the lower first, as in [0, 250].'
}

function isAmount(value: unknown): value is number {
  return typeof value === 'number' && Number.isFinite(value) && value >= 0
}

function isRange(of: unknown): boolean {
  const ends: readonly unknown[] = Array.isArray(of) ? of : []
  const [low, high] = ends
  // Of a range that is too wide for a number no part is known.
  return (
    ends.length === 2 &&
    Number(low) < Number(high) &&
    ends.every(Number.isFinite) &&
    Number.isFinite(Number(high) - Number(low))
  )
}

/**
 * Whether to tell `now` when `told` was told last. Numbers: when they differ by more than the threshold, compared exactly. NaN is equal
 * to itself only. Of arrays one element that changed is enough. Whatever is no number has changed when it is another one.
 *
 * @param threshold see `thresholdOf`
 * @example hasChanged(1, 20.5, 21.5)   // false
 * @example hasChanged(1, 20.5, 21.6)   // true
 */
export function hasChanged(threshold: number, told: TagValue, now: TagValue): boolean {
  if (!isList(told) || !isList(now)) return isList(told) || isList(now) || valueChanged(threshold, told, now)
  return told.length !== now.length || now.some((value, at) => valueChanged(threshold, told[at], value))
}

function isList(value: TagValue): value is readonly PlcValue[] {
  return typeof value === 'object'
}

function valueChanged(threshold: number, told: PlcValue | undefined, now: PlcValue): boolean {
  if (typeof told === 'number' && typeof now === 'number') return numberChanged(threshold, told, now)
  if (typeof told === 'bigint' && typeof now === 'bigint') {
    const difference = told > now ? told - now : now - told
    return difference !== 0n && difference > threshold
  }
  return told !== now
}

function numberChanged(threshold: number, told: number, now: number): boolean {
  // 0 and -0 are the same number, NaN is equal to itself here.
  if (told === now || (Number.isNaN(told) && Number.isNaN(now))) return false
  const high = Math.max(told, now)
  const low = Math.min(told, now)
  const difference = high - low
  // NaN and infinity: no deadband is as wide.
  if (!Number.isFinite(difference)) return true
  if (difference !== threshold) return difference > threshold
  // Rounded, it is the threshold: what the rounding took away decides (Knuth's exact sum).
  const back = difference - high
  return high - (difference - back) - (low + back) > 0
}
