// What is asked of a label: its name, how many elements, and what the user expects of it.

import { shown } from '../../basics/show'
import { RequestError } from '../../errors'
import { type LabelAddress, parseLabel } from '../../melsec/label/label'
import { checkFormat, type Encoding, parseType, type ValueType } from '../../value/value'
import type { CallOptions } from '../connection/call'

/** How the value of a label is taken out of its words. The data type is the PLC's business. */
export interface LabelFormat {
  /** Character code of STRING labels. Default `ascii`. */
  readonly encoding?: Encoding
  /** Cut spaces at the end of text that is read. */
  readonly trimSpaces?: boolean
  /**
   * ASCII code only: which word of a value of two or four words comes first. The manual does not say it clearly, and the
   * wrong one gives wrong values, so such labels are refused in ASCII code until this says it (try it on a label whose
   * value you know), or use binary code.
   */
  readonly asciiWordOrder?: 'low-first' | 'high-first'
}

/** What a call about labels may say: the format of text, too. */
export interface LabelOptions extends CallOptions, LabelFormat {}

/** A label with what is particular about it; what is left out is the call's, and then the client's. */
export interface LabelItemOptions extends LabelFormat {
  /** Name of the label, as in GX Works3. */
  readonly label: string
  /** That many elements of an array, from the one that is named. */
  readonly count?: number
  /** The data type it should have, e.g. `REAL`. The PLC knows it; another one is an error. */
  readonly type?: string
}

/** A label by name; with a count that many elements of an array, from the one that is named. */
export type LabelItem = string | LabelItemOptions

/** A label as it is asked for. */
export interface AskedLabel {
  readonly address: LabelAddress
  readonly count?: number
  /** What the user says it is: checked against what the PLC says. */
  readonly type?: ValueType
  /** Its own, before those of the call. */
  readonly format?: LabelFormat
}

const FIELDS = {
  label: true,
  count: true,
  type: true,
  encoding: true,
  trimSpaces: true,
  asciiWordOrder: true,
} as const satisfies Record<keyof LabelItemOptions, true>

/** Most elements of one label: as many as its length can say. */
const MOST_ELEMENTS = 0xffff

/** Longer than any name that fits into a request (SLMP reference manual 5.3: 1920 bytes of 2 for each character). */
const LONGEST_NAME = 1000

function addressOf(text: string): LabelAddress {
  const address = parseLabel(text)
  if (address.name.length <= LONGEST_NAME) return address
  const message = `'${address.name.slice(0, 40)}...' has ${address.name.length} characters; no request takes such a name.`
  throw new RequestError('LIMIT_EXCEEDED', message, 'label')
}

/** @throws RequestError BAD_ADDRESS, BAD_TYPE, BAD_OPTION, OUT_OF_RANGE, LIMIT_EXCEEDED */
export function askedLabel(item: LabelItem): AskedLabel {
  if (typeof item === 'string') return { address: addressOf(item) }
  if (typeof item !== 'object' || item === null) {
    throw new RequestError('BAD_ADDRESS', 'A label is its name, or { label, count }.')
  }
  const address = addressOf(item.label)
  for (const name of Object.keys(item)) {
    if (Object.hasOwn(FIELDS, name)) continue
    const list = Object.keys(FIELDS).join(', ')
    throw new RequestError(
      'BAD_OPTION',
      `${address.name}: a label has no ${JSON.stringify(name)}. It has ${list}.`,
      name,
    )
  }
  const { count, type, encoding, trimSpaces, asciiWordOrder } = item
  if (count !== undefined) checkElements(address, count)
  const format: LabelFormat = {
    ...(encoding === undefined ? {} : { encoding }),
    ...(trimSpaces === undefined ? {} : { trimSpaces }),
    ...(asciiWordOrder === undefined ? {} : { asciiWordOrder }),
  }
  checkLabelFormat(format)
  return {
    address,
    ...(count === undefined ? {} : { count }),
    ...(type === undefined ? {} : { type: givenType(address, type) }),
    ...(Object.keys(format).length === 0 ? {} : { format }),
  }
}

/** @throws RequestError OUT_OF_RANGE, BAD_ADDRESS when it does not say where the elements begin */
export function checkElements({ name, index }: LabelAddress, count: number): void {
  if (!Number.isInteger(count) || count < 1 || count > MOST_ELEMENTS) {
    throw new RequestError('OUT_OF_RANGE', `${name}: ${shown(count)} elements; give 1 to ${MOST_ELEMENTS}.`, 'count')
  }
  if (index !== undefined) return
  throw new RequestError('BAD_ADDRESS', `${name}: name the first element of the array, as in ${name}[0].`, 'label')
}

function givenType({ name }: LabelAddress, text: string): ValueType {
  try {
    return parseType(text)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    throw new RequestError(error.code, `${name}: ${error.message}. Leave the type out: the PLC says it.`, 'type')
  }
}

/** @throws RequestError BAD_OPTION */
export function checkLabelFormat({ encoding, trimSpaces, asciiWordOrder }: LabelFormat): void {
  checkFormat({
    ...(encoding === undefined ? {} : { encoding }),
    ...(trimSpaces === undefined ? {} : { trimSpaces }),
  })
  if (asciiWordOrder === undefined || ['low-first', 'high-first'].includes(asciiWordOrder)) return
  const message = `asciiWordOrder is ${shown(asciiWordOrder)}; it must be low-first or high-first.`
  throw new RequestError('BAD_OPTION', message, 'asciiWordOrder')
}
