// What is asked of a label: its name and how many elements.
import { RequestError } from '../errors'
import { type LabelAddress, parseLabel } from '../melsec/label'
import type { Encoding } from '../value/value'
import type { CallOptions } from './call'

/** A label by name; with a count that many elements of an array, from the one that is named. */
export type LabelItem = string | { readonly label: string; readonly count?: number }

export interface LabelOptions extends CallOptions {
  /** Character code of STRING labels. Default `ascii`. */
  readonly encoding?: Encoding
  /**
   * ASCII code only: which word of a value of two or four words comes first. The manual does not say it clearly, and the
   * wrong one gives wrong values, so such labels are refused in ASCII code until this says it (try it on a label whose
   * value you know), or use binary code.
   */
  readonly asciiWordOrder?: 'low-first' | 'high-first'
}

export interface AskedLabel {
  readonly address: LabelAddress
  readonly count?: number
}

/** @throws RequestError BAD_ADDRESS, OUT_OF_RANGE */
export function askedLabel(item: LabelItem): AskedLabel {
  if (typeof item === 'string') return { address: parseLabel(item) }
  if (typeof item !== 'object' || item === null) {
    throw new RequestError('BAD_ADDRESS', 'A label is its name, or { label, count }.')
  }
  const address = parseLabel(item.label)
  const { count } = item
  if (count === undefined) return { address }
  if (!Number.isInteger(count) || count < 1 || count > 0xffff) {
    throw new RequestError('OUT_OF_RANGE', `${address.name}: ${String(count)} elements; give 1 to 65535.`, 'count')
  }
  if (address.index === undefined) {
    const message = `${address.name}: name the first element of the array, as in ${address.name}[0].`
    throw new RequestError('BAD_ADDRESS', message, 'label')
  }
  return { address, count }
}
