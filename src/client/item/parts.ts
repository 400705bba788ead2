/**
 * What the texts and objects of items have in common, whatever PLC they are of: address, range, type, count and format.
 */
import { show } from '../../basics/show'
import { RequestError, type RequestErrorCode } from '../../errors'
// Not by the public names of the room: its conversions need Node.js, and items are checked in browsers, too.
import { checkFormat, type ValueFormat } from '../../value/format'

/** An item with options of its own; what is left out is the client's. */
export interface ItemOptions extends ValueFormat {
  /** Any text an item can be, e.g. `D100`, `D100:REAL[10]`, `M0..M15`. */
  readonly address: string
  /** e.g. `REAL`, when it is not in the address. */
  readonly type?: string
  /** Number of values of an array, when it is not in the address. */
  readonly count?: number
}

/**
 * What a user reads or writes: a text such as `D100:REAL`, or an object with such an address and options of its own.
 */
export type Item = string | ItemOptions

/** More values than this in one item are a mistake: no device has as many points. */
const MOST_VALUES = 1 << 20

/** The count of an item, when it has one. */
export function counted(count: number | undefined): { readonly count?: number } {
  return count === undefined ? {} : { count }
}

/** Refuses an item. */
export type Fail = (code: RequestErrorCode, message: string) => never

const ITEM_FIELDS = ['address', 'type', 'count', 'wordOrder', 'byteOrder', 'encoding', 'trimSpaces'] as const

/** An item whose address is no text. */
export function badAddress(address: unknown): RequestError {
  const message = `The address of an item is a text, e.g. { address: 'D100', type: 'REAL' }, not ${show(address)}.`
  return new RequestError('BAD_ADDRESS', message, 'address')
}

/** An item as an object. @throws RequestError BAD_ADDRESS when it is none, BAD_OPTION for a field that no item has */
export function checkedItem(item: Item): ItemOptions {
  if (typeof item === 'string') return { address: item }
  if (typeof item === 'object' && item !== null && 'address' in item && typeof item.address !== 'string') {
    throw badAddress(item.address)
  }
  if (typeof item !== 'object' || item === null || typeof item.address !== 'string') {
    throw new RequestError('BAD_ADDRESS', 'An item is a text such as D100:REAL, or an object with such an address.')
  }
  const known: readonly string[] = ITEM_FIELDS
  const unknown = Object.keys(item).find((name) => !known.includes(name))
  if (unknown === undefined) return item
  const list = ITEM_FIELDS.join(', ')
  throw new RequestError(
    'BAD_OPTION',
    `${item.address}: an item has no ${JSON.stringify(unknown)}. It has ${list}. If address is the name of an item among others, use readEach() or readValues().`,
  )
}

/** What an item text says, in pieces. `first`, `last`: addresses. */
export interface ItemParts {
  readonly first: string
  readonly last?: string
  readonly type?: string
  readonly count?: number
}

/** Says that a text is the name of a label, whatever it looks like. */
export const LABEL_PREFIX = /^\s*label:/i

/** How the addresses of a family of PLCs stand in items. */
export interface ItemStyle {
  /** An item in two groups: the address or range in front of the colon, and what is behind it. */
  readonly typed: RegExp
  /** Examples in messages. */
  readonly examples: {
    readonly array: string
    readonly comma: string
    readonly counted: string
    readonly range: string
  }
}

/** Address, range, type and count of an item text. @throws RequestError by `fail` */
export function splitText(text: string, { typed, examples }: ItemStyle, fail: Fail): ItemParts {
  if (ALONE.test(text)) return { first: text }
  if (LABEL_PREFIX.test(text)) fail('UNSUPPORTED', 'a label is no device: a client of a PLC with labels takes it.')
  const [, device = '', type] = typed.exec(text) ?? []
  const [, counted = '', digits] = /^(.*?)(?:\[\s*(\d+)\s*\])?$/s.exec(type ?? device) ?? []
  const [, before, points] = type === undefined && digits === undefined ? (COUNTED.exec(device) ?? []) : []
  if (before !== undefined) return { first: before, count: Number(points) }
  const area = type === undefined ? counted : device
  if (area.includes('[')) {
    fail('BAD_ADDRESS', `the number of values stands in brackets at the end, behind the type, e.g. ${examples.array}.`)
  }
  if (area.includes(',')) {
    fail(
      'BAD_ADDRESS',
      `behind a comma stands how many values, a whole number, e.g. ${examples.comma}, which is ${examples.counted}.`,
    )
  }
  const [first = '', last, more] = area.split('..')
  if (more !== undefined) fail('BAD_ADDRESS', `a range has two ends, e.g. ${examples.range}.`)
  if (last?.trim() === '') fail('BAD_ADDRESS', `the end of the range is missing, e.g. ${examples.range}.`)
  return {
    first,
    ...(last === undefined ? {} : { last }),
    ...(type === undefined ? {} : { type: counted }),
    ...(digits === undefined ? {} : { count: Number(digits) }),
  }
}

/** A device and nothing behind it. */
const ALONE = /^[^:,.[\]]*$/

/** A count behind a comma, as other drivers have it. Behind the bit of a word it may be another bit. */
const COUNTED = /^([^.,]+),\s*(0|[1-9]\d*)\s*$/

/** A type by its text, read by `parse`. @throws RequestError by `fail` */
export function typeOf<T>(text: string, parse: (text: string) => T, fail: Fail): T {
  try {
    return parse(text)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    return fail(error.code, `${error.message}.`)
  }
}

/** What may stand in the text or beside it. @throws RequestError by `fail` when the two differ */
export function onlyOne<T extends string | number>(
  what: string,
  inText: T | undefined,
  given: T | undefined,
  fail: Fail,
): T | undefined {
  if (inText !== undefined && given !== undefined && inText !== given) {
    fail('BAD_OPTION', `the ${what} is given twice, as ${inText} and as ${given}: leave one out.`)
  }
  return inText ?? given
}

/** Values in a range of so many points. @throws RequestError by `fail` when they do not come out even */
export function valuesIn(points: number, size: number, type: string, fail: Fail): number {
  if (points <= 0) fail('BAD_ADDRESS', 'the range ends before it starts: write the lower number first.')
  if (points % size !== 0) {
    fail(
      'BAD_ADDRESS',
      `the range has ${points} points, and one ${type} takes ${size}: give a count instead, e.g. [${Math.ceil(points / size)}].`,
    )
  }
  return points / size
}

/** @throws RequestError by `fail` when so many values cannot be */
export function checkValues(count: number, fail: Fail): void {
  if (Number.isInteger(count) && count >= 1 && count <= MOST_VALUES) return
  fail('OUT_OF_RANGE', `the number of values is a whole number from 1 to ${MOST_VALUES}, not ${count}.`)
}

/** The format of an item: its own options, and the client's where it says nothing. @throws RequestError BAD_OPTION */
export function formatOf({ wordOrder, byteOrder, encoding, trimSpaces }: ItemOptions, usual: ValueFormat): ValueFormat {
  const isUsual =
    wordOrder === undefined && byteOrder === undefined && encoding === undefined && trimSpaces === undefined
  const format: ValueFormat = isUsual
    ? usual
    : {
        ...usual,
        ...(wordOrder === undefined ? {} : { wordOrder }),
        ...(byteOrder === undefined ? {} : { byteOrder }),
        ...(encoding === undefined ? {} : { encoding }),
        ...(trimSpaces === undefined ? {} : { trimSpaces }),
      }
  checkFormat(format)
  return format
}
