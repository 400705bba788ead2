// Many labels read at once: types and values by Label Read Random, arrays of known type by Array Label Read.
import { PlcError, ProtocolError } from '../../errors'
import type { PlcValue } from '../../value/value'
import { attemptFor, isFine } from '../item/value-or-error'
import { ArrayParts } from './array'
import type { AskedLabel, LabelFormat } from './item'
import type { LabelAnswer, LabelRequests } from './request'
import { checkGivenType, decodeLabel, type LabelType, labelTypeOf } from './value'

/** What a label holds; of several elements of an array a list. */
export type LabelValue = PlcValue | PlcValue[]

/** What became of one label. */
export type LabelOutcome =
  | {
      readonly ok: true
      readonly value: LabelValue
      readonly type: string
      readonly timestamp: number
      readonly torn?: true
    }
  | { readonly ok: false; readonly error: PlcError; readonly timestamp: number }

export interface LabelReading {
  readonly requests: LabelRequests
  readonly format: LabelFormat
  /** ms since 1970 */
  readonly time: () => number
  /** Told the type of each label, as the PLC says it. */
  readonly onType?: (asked: AskedLabel, type: LabelType) => void
}

/** An outcome for each of them, in their order; an error instead of a label is its own outcome. */
export async function readLabels(
  asked: readonly (AskedLabel | PlcError)[],
  reading: LabelReading,
): Promise<LabelOutcome[]> {
  const { requests, format, time } = reading
  const answers = await requests.random(asked.filter(isFine))
  const timestamp = time()
  const arrays = new ArrayParts(requests)
  const outcomes = asked.map((one) =>
    isFine(one) ? attemptFor(one.address.name, () => readingOf(one, answers.get(one), arrays, reading)) : one,
  )
  const values = await arrays.read(format)
  return outcomes.map((outcome): LabelOutcome => {
    if (!isFine(outcome)) return { ok: false, error: outcome, timestamp }
    if ('value' in outcome) return { ok: true, ...outcome, timestamp }
    const read = values.get(outcome.array)
    if (read === undefined || read instanceof PlcError) {
      return { ok: false, error: read ?? unanswered(outcome.array), timestamp: time() }
    }
    return { ok: true, ...read, timestamp: time() }
  })
}

/** @throws PlcError */
function readingOf(
  asked: AskedLabel,
  answer: LabelAnswer | PlcError | undefined,
  arrays: ArrayParts,
  { requests, format, onType }: LabelReading,
): { readonly value: LabelValue; readonly type: string } | { readonly array: AskedLabel } {
  const type = typeOf(asked, answer)
  onType?.(asked, type)
  if (asked.count !== undefined) {
    arrays.add(asked, type)
    return { array: asked }
  }
  const data = answer instanceof PlcError ? [] : (answer?.data ?? [])
  return { value: decodeLabel(type, data, requests.protocol.code, { ...format, ...asked.format }), type: type.text }
}

/**
 * The type of a label, out of the answer to Label Read Random.
 * @throws PlcError when the label was refused, or is not what the user says
 */
export function typeOf(asked: AskedLabel, answer: LabelAnswer | PlcError | undefined): LabelType {
  if (answer instanceof PlcError) throw answer
  if (answer === undefined) throw unanswered(asked)
  const type = labelTypeOf(asked.address.name, answer.typeId, answer.data.length)
  checkGivenType(asked.type, type)
  return type
}

function unanswered({ address }: AskedLabel): ProtocolError {
  return new ProtocolError('TRUNCATED', `${address.name}: the PLC did not answer it.`)
}
