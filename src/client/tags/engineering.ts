// What is read of a tag, in its unit.
import { ProtocolError } from '../../errors'
import { engineeringOf } from '../../tags/table/scaling'
import type { Tag } from '../../tags/table/tag'
import type { PlcValue } from '../../value/value'
import type { ReadResult } from '../item/item-value'

/** The result with the value for people; an error where its scaling has none. */
export function engineeringResult(tag: Tag, result: ReadResult): ReadResult {
  const { scaling } = tag
  if (scaling === undefined || !result.ok) return result
  const raw: readonly PlcValue[] = Array.isArray(result.value) ? result.value : [result.value]
  const values: number[] = []
  let isClamped = false
  for (const [at, one] of raw.entries()) {
    const isNumber = typeof one === 'number' || typeof one === 'bigint'
    const scaled = isNumber ? engineeringOf(scaling, one) : NO_NUMBER
    if (!scaled.ok) return failed(tag, result, Array.isArray(result.value) ? `element ${at}: ` : '', scaled.reason)
    values.push(scaled.value)
    isClamped ||= scaled.clamped
  }
  const [first = 0] = values
  return {
    ...result,
    value: Array.isArray(result.value) ? values : first,
    ...(isClamped ? { clamped: true } : {}),
  }
}

/** Of a label whose type only the PLC knows. */
const NO_NUMBER = { ok: false, reason: 'what is in the PLC is no number, so it cannot be scaled.' } as const

function failed({ name, address }: Tag, { item, timestamp }: ReadResult, where: string, reason: string): ReadResult {
  const error = new ProtocolError('BAD_FIELD', `${name} (${address}): ${where}${reason}`)
  return { item, ok: false, error, timestamp }
}
