// Values for labels: their types are read before anything is written, then the values are made into words.
import { ClosedError, PlcError, RequestError } from '../../errors'
import type { PlainValue } from '../item/item-value'
import { attemptFor, isFine } from '../item/value-or-error'
import { type AskedLabel, checkElements, type LabelFormat } from './item'
import { typeOf } from './read'
import type { LabelRequests, LabelWrite } from './request'
import { encodeLabel } from './value'

/** A label and what it is to hold. A list goes to an array from the element named on. */
export interface LabelEntry {
  readonly asked: AskedLabel
  readonly value: PlainValue
}

/**
 * How many elements are written follows from the value.
 * @throws RequestError OUT_OF_RANGE for an empty list, BAD_ADDRESS when a list has no first element, BAD_VALUE when a
 *   count says otherwise
 */
export function labelEntry(asked: AskedLabel, value: PlainValue): LabelEntry {
  const { address, count, ...others } = asked
  const length = Array.isArray(value) ? value.length : undefined
  if (length !== undefined) checkElements(address, length)
  if (count !== undefined && count !== length) {
    const found = length === undefined ? 'one value' : `${length} values`
    throw new RequestError('BAD_VALUE', `${address.name}: ${count} elements take a list of ${count}, not ${found}.`)
  }
  return { asked: { address, ...others, ...(length === undefined ? {} : { count: length }) }, value }
}

/** The words of each entry, or why it cannot be written. Reads the types, writes nothing. */
export async function labelWrites(
  entries: readonly (LabelEntry | PlcError)[],
  requests: LabelRequests,
  format: LabelFormat,
): Promise<(LabelWrite | PlcError)[]> {
  const answers = await requests.random(entries.filter(isFine).map(({ asked }) => asked))
  return entries.map((entry) => {
    if (!isFine(entry)) return entry
    const { asked, value } = entry
    const answer = answers.get(asked)
    if (answer instanceof PlcError && answer.outcome === 'unknown') return untouched(asked, answer)
    return attemptFor(asked.address.name, () => {
      const type = typeOf(asked, answer)
      const content = encodeLabel(type, value, requests.protocol.code, { ...format, ...asked.format })
      return { asked, content }
    })
  })
}

/** Whether its type was read is not known; that it was not written is. */
function untouched({ address }: AskedLabel, cause: PlcError): ClosedError {
  const message = `${address.name} was not written, because its data type could not be read: ${cause.message}`
  return new ClosedError('ABORTED', message, 'notSent', cause)
}
