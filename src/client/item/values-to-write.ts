// The values of an item as they were given: one, or all of an array.
import { show } from '../../basics/show'
import { RequestError } from '../../errors'
import type { PlcValue } from '../../value/value'
import type { PlainValue } from './item-value'

/**
 * One value or all values of an array.
 * @param type the name of the type, for messages
 * @throws RequestError BAD_VALUE when an array is given for one value, or not as many as the item has
 */
export function valuesToWrite(
  { text, count }: { readonly text: string; readonly count?: number },
  type: string,
  value: PlainValue,
): readonly PlcValue[] {
  if (count === undefined) {
    if (!isArray(value)) return [value]
    throw fault(text, `${type} is one value, not an array; an array has a count, e.g. [${value.length}].`)
  }
  if (!isArray(value)) throw fault(text, `takes an array of ${count} ${type} values, not ${show(value)}.`)
  if (value.length !== count) throw fault(text, `takes ${count} values of ${type}, and ${value.length} are given.`)
  return value
}

function isArray(value: PlainValue): value is readonly PlcValue[] {
  return Array.isArray(value)
}

function fault(text: string, message: string): RequestError {
  return new RequestError('BAD_VALUE', `${text}: ${message}`, text)
}
