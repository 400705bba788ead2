// How far a value may move before it counts as changed, as data.
import { badOption, checkNames, isPlainObject } from '../../basics/option-checks'
import { shown } from '../../basics/show'

/**
 * How far a number may be from the one that was told last before it counts as changed; of an array each of its numbers. What
 * is no number changes with any difference.
 * @example { absolute: 0.5 }
 * @example { percent: 1, of: [0, 250] }   // 2.5
 */
export type WatchDeadband =
  | {
      /** In units of the value, 0 or more. */
      readonly absolute: number
    }
  | {
      /** 0 to 100. */
      readonly percent: number
      /** Of this range. */
      readonly of: readonly [low: number, high: number]
    }

/** The deadband in units of the value. @throws RequestError BAD_OPTION */
export function reachOf(field: string, given: WatchDeadband): number {
  if (!isPlainObject(given)) badOption(field, `${field} is ${shown(given)}; it must be an object, ${EXAMPLE}.`)
  if ('absolute' in given) {
    checkNames(`${field}.`, given, { absolute: true })
    return amountOf(`${field}.absolute`, given.absolute, Number.MAX_VALUE)
  }
  checkNames(`${field}.`, given, { percent: true, of: true })
  const percent = amountOf(`${field}.percent`, given.percent, 100)
  const [low, high] = rangeOf(`${field}.of`, given.of)
  return ((high - low) * percent) / 100
}

const EXAMPLE = 'e.g. { absolute: 0.5 } or { percent: 1, of: [0, 250] }'

function amountOf(field: string, amount: unknown, most: number): number {
  if (typeof amount === 'number' && amount >= 0 && amount <= most) return amount
  const range = most === 100 ? 'from 0 to 100' : '0 or more'
  return badOption(field, `${field} is ${shown(amount)}; it must be a number, ${range}.`)
}

function rangeOf(field: string, range: readonly [number, number]): readonly [number, number] {
  const ends: readonly unknown[] = Array.isArray(range) ? range : []
  const [low, high] = ends
  const isRange = ends.length === 2 && ends.every(Number.isFinite) && Number(low) < Number(high)
  return isRange ? range : badOption(field, `${field} must be a range, the lower end first, e.g. [0, 250].`)
}
