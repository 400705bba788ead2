// How messages carry 64-bit numbers: JSON, JSONata, dashboards and files of the context cannot take a BigInt.
import type { ReadValue } from '../src/index'

/** `number`: a number when it is exact, else text. `bigint`: always a BigInt. `text`: always text. */
export const int64Forms = ['number', 'bigint', 'text'] as const
export type Int64Form = (typeof int64Forms)[number]

/**
 * The value as a message carries it; only BigInts are changed, each element by itself.
 * @example carried(2n ** 53n, 'number')   // '9007199254740992': the number could be its neighbour, too
 */
export function carried(value: ReadValue, form: Int64Form): ReadValue {
  if (Array.isArray(value)) return value.map((element) => one(element, form))
  return one(value, form)
}

function one<T>(value: T, form: Int64Form): T | bigint | number | string {
  if (typeof value !== 'bigint' || form === 'bigint') return value
  const number = Number(value)
  return form === 'number' && Number.isSafeInteger(number) ? number : String(value)
}
