/**
 * What a user reads or writes: a device with a type, one value or many, as text or as an object.
 *
 * | text                              | meaning                                                              |
 * |-----------------------------------|----------------------------------------------------------------------|
 * | `D100` `M0` `LCN5`                | INT of a word device, BOOL of a bit device, DINT of a double-word one |
 * | `D100:REAL` `D100:STRING(20)`     | the type as in IEC 61131-3 and GX Works                              |
 * | `D100:REAL[10]` `M0[16]`          | an array of so many values                                           |
 * | `D100,10` `X0,16`                 | the same, as other drivers write it; in our spelling `D100[10]`       |
 * | `M0..M15` `D0..D9:DINT`           | the same by its last device: 16 bits, 5 values of two words each      |
 * | `D100.F` `D100.0[20]`             | bits of words; an array goes on in the next word                     |
 * | `K4M0` `K8M0:REAL` `K4M0[3]`      | 4 bits per digit: INT up to K4, DINT from K5, REAL and TIME with K8   |
 */
import { hex } from '../../basics/hex'
import { show } from '../../basics/show'
import { RequestError, type RequestErrorCode } from '../../errors'
import {
  type AddressOptions,
  formatDevice,
  formatParsedDevice,
  type ParsedDevice,
  parseDevice,
} from '../../melsec/device/address'
import { deviceInfo, LAST_NUMBER } from '../../melsec/device/device'
// Not by the public names of the room: its conversions need Node.js, and items are checked in browsers, too.
import { checkFormat, type ValueFormat } from '../../value/format'
import { formatType, parseType, type TypeName, typeNames, type ValueType, valueTypes, wordsOf } from '../../value/type'
import { otherNotation } from './notation'

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

/** An item that can be read or written, as plain data. At most one of `bit` and `digits` is there. */
export interface ParsedItem extends ParsedDevice {
  /** As it was given; of an object the text that says the same. Results and messages carry it. */
  readonly text: string
  /** Type of each value. */
  readonly type: ValueType
  /** Values of an array; missing: one value. */
  readonly count?: number
  /** Word order, encoding and so on; what is left out is as MELSEC does it. */
  readonly format: ValueFormat
}

/** An item that cannot be read, among others that can. */
export interface RefusedItem {
  /** As it was given. */
  readonly text: string
  /** What is wrong with it. */
  readonly error: RequestError
}

/** How items are read: numbering of X, Y and W, and the format of values. */
export interface ItemParseOptions extends AddressOptions {
  /** Word order, encoding and so on of items that do not say their own. */
  readonly format?: ValueFormat
}

/** More values than this in one item are a mistake: no device has as many points. */
const MOST_VALUES = 1 << 20

/**
 * @throws RequestError BAD_ADDRESS, BAD_TYPE, OUT_OF_RANGE or BAD_OPTION; the message names the item and says what to write.
 * @example parseItem('D100:REAL[10]', { xyRadix: 16 }).count   // 10
 * @example parseItem({ address: 'D200:STRING(20)', encoding: 'shift-jis' }, { xyRadix: 16 })
 */
export function parseItem(item: Item, options: ItemParseOptions): ParsedItem {
  const given = checkedItem(item)
  try {
    return parsedItem(item, given, options)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    // When the text alone is an item, what is wrong is beside it.
    const isOther = !isAlone(given.address, options)
    const meant = isOther ? otherNotation(given.address, (text) => isAlone(text, options)) : undefined
    if (meant === undefined) throw error
    throw new RequestError(error.code, `${JSON.stringify(given.address.trim())}: ${meant}`, given.address)
  }
}

function isAlone(address: string, options: ItemParseOptions): boolean {
  try {
    parsedItem(address, { address }, options)
    return true
  } catch (error) {
    if (error instanceof RequestError) return false
    throw error
  }
}

function parsedItem(item: Item, given: ItemOptions, options: ItemParseOptions): ParsedItem {
  const fail: Fail = (code, message) => {
    throw new RequestError(code, `${JSON.stringify(given.address)}: ${message}`, given.address)
  }
  const parts = splitText(given.address, fail)
  const device = parseDevice(parts.first, options)
  const typeText = onlyOne('type', parts.type, given.type, fail)
  const type = typeText === undefined ? defaultType(device) : typeOf(typeText, fail)
  const problem = typeProblem(device, type)
  if (problem !== undefined) fail('BAD_TYPE', problem)
  const ranged = parts.last === undefined ? undefined : rangeCount(device, parseDevice(parts.last, options), type, fail)
  const count = onlyOne('count', onlyOne('count', ranged, parts.count, fail), given.count, fail)
  if (count !== undefined) checkCount(count, device, fail)
  checkEnd(count ?? 1, device, type, fail)
  const format = formatOf(given, options.format ?? {})
  const text = typeof item === 'string' ? item : formatItem({ ...device, type, ...counted(count) }, options)
  const { address, bit, digits } = device
  // The usual item, written out: a list has hundreds of it.
  if (bit === undefined && digits === undefined && count === undefined) return { text, address, type, format }
  return { text, ...device, type, ...counted(count), format }
}

function counted(count: number | undefined): Pick<ParsedItem, 'count'> {
  return count === undefined ? {} : { count }
}

/** As `parseItem`, with the error instead of the item: for lists in which one bad item must not spoil the others. */
export function tryParseItem(item: Item, options: ItemParseOptions): ParsedItem | RefusedItem {
  try {
    return parseItem(item, options)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    return { text: typeof item === 'string' ? item : String(item?.address), error }
  }
}

/**
 * The text `parseItem` reads back as the same item; a default type is left out, a range becomes a count.
 * The format (word order and so on) has no place in a text.
 */
export function formatItem(item: Omit<ParsedItem, 'text' | 'format'>, options: AddressOptions): string {
  const usual = formatType(defaultType(item))
  const type = formatType(item.type)
  const count = item.count === undefined ? '' : `[${item.count}]`
  return `${formatParsedDevice(item, options)}${type === usual ? '' : `:${type}`}${count}`
}

/** Type of an item that does not say one. */
export function defaultType(device: ParsedDevice): ValueType {
  if (device.bit !== undefined) return { name: 'BOOL' }
  if (device.digits !== undefined) return { name: DEFAULT_TYPES[device.digits <= 4 ? 'word' : 'doubleWord'] }
  return { name: DEFAULT_TYPES[deviceInfo(device.address.device).unit] }
}

const DEFAULT_TYPES = { bit: 'BOOL', word: 'INT', doubleWord: 'DINT' } as const
/** Type of the values of a device, by its unit. */
export type DefaultTypes = typeof DEFAULT_TYPES

type Fail = (code: RequestErrorCode, message: string) => never

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

interface Parts {
  readonly first: string
  readonly last?: string
  readonly type?: string
  readonly count?: number
}

/** Says that a text is the name of a label, whatever it looks like. */
export const LABEL_PREFIX = /^\s*label:/i

function splitText(text: string, fail: Fail): Parts {
  if (ALONE.test(text)) return { first: text }
  if (LABEL_PREFIX.test(text)) fail('UNSUPPORTED', 'a label is no device: a client of a PLC with labels takes it.')
  const [, device = '', type] = /^([^:]*)(?::(.*))?$/s.exec(text) ?? []
  const [, counted = '', digits] = /^(.*?)(?:\[\s*(\d+)\s*\])?$/s.exec(type ?? device) ?? []
  const [, before, points] = type === undefined && digits === undefined ? (COUNTED.exec(device) ?? []) : []
  if (before !== undefined) return { first: before, count: Number(points) }
  const area = type === undefined ? counted : device
  if (area.includes('[')) {
    fail('BAD_ADDRESS', 'the number of values stands in brackets at the end, behind the type, e.g. D100:REAL[10].')
  }
  if (area.includes(',')) {
    fail('BAD_ADDRESS', 'behind a comma stands how many values, a whole number, e.g. D100,10, which is D100[10].')
  }
  const [first = '', last, more] = area.split('..')
  if (more !== undefined) fail('BAD_ADDRESS', 'a range has two ends, e.g. M0..M15.')
  if (last?.trim() === '') fail('BAD_ADDRESS', 'the end of the range is missing, e.g. M0..M15.')
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

function typeOf(text: string, fail: Fail): ValueType {
  try {
    return parseType(text)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    return fail(error.code, `${error.message}.`)
  }
}

function onlyOne<T extends string | number>(
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

/** Why a device has no values of a type, and what to write instead. */
function typeProblem({ address, bit, digits }: ParsedDevice, type: ValueType): string | undefined {
  const info = deviceInfo(address.device)
  const isBit = type.name === 'BOOL'
  if (bit !== undefined) {
    return isBit ? undefined : `one bit of a word is a BOOL, not a ${formatType(type)}: leave .${hex(bit)} out.`
  }
  if (digits !== undefined) return digitsProblem(digits, type)
  if (info.unit === 'bit') {
    if (isBit) return undefined
    return `${info.name} (${info.title}) is a bit device, so its values are BOOL; for a number of 16 bits write K4${info.name}..., for 32 bits K8${info.name}....`
  }
  if (isBit) {
    return `${info.name} (${info.title}) has words, not bits: name the bit, e.g. ${info.name}100.0 to ${info.name}100.F.`
  }
  if (info.unit === 'doubleWord' && !DOUBLE_WORD_TYPES.includes(type.name)) {
    return `${info.name} (${info.title}) has 32 bits, so its values are ${DOUBLE_WORD_TYPES.join(', ')}, not ${formatType(type)}.`
  }
  if (address.indirect === true && wordsOf(type) > 2) {
    return `@ reaches the one or two words whose address stands in ${info.name}${address.number}; ${formatType(type)} has ${wordsOf(type)}.`
  }
  return undefined
}

const DOUBLE_WORD_TYPES: readonly TypeName[] = ['DINT', 'UDINT', 'DWORD', 'TIME']
/** Types that need all of the 32 bits. */
const WHOLE_TYPES: readonly TypeName[] = ['REAL', 'TIME']

function digitsProblem(digits: number, type: ValueType): string | undefined {
  const fitting = typeNames.filter((name) => {
    const { kind, words } = valueTypes[name]
    if (kind === 'text' || words !== (digits <= 4 ? 1 : 2)) return false
    return digits === 8 || !WHOLE_TYPES.includes(name)
  })
  if (fitting.includes(type.name)) return undefined
  return `K${digits} is ${4 * digits} bits, so its value is ${fitting.join(', ')}, not ${formatType(type)}.`
}

/** Device numbers (or bits of words) one value takes. */
function sizeOf({ address, bit, digits }: ParsedDevice, type: ValueType): number {
  if (bit !== undefined) return 1
  if (digits !== undefined) return 4 * digits
  return deviceInfo(address.device).unit === 'word' ? wordsOf(type) : 1
}

function positionOf({ address, bit }: ParsedDevice): number {
  return bit === undefined ? address.number : address.number * 16 + bit
}

/** The last device (or bit) belongs to the range; `K4M48` is M48 to M63. */
function rangeCount(first: ParsedDevice, last: ParsedDevice, type: ValueType, fail: Fail): number {
  if (!samePlace(first, last)) {
    fail('BAD_ADDRESS', 'both ends of a range are the same device, written out, e.g. M0..M15 or D100.0..D100.F.')
  }
  const size = sizeOf(first, type)
  const points = positionOf(last) + (last.digits === undefined ? 1 : 4 * last.digits) - positionOf(first)
  if (points <= 0) fail('BAD_ADDRESS', 'the range ends before it starts: write the lower number first.')
  if (points % size !== 0) {
    fail(
      'BAD_ADDRESS',
      `the range has ${points} points, and one ${formatType(type)} takes ${size}: give a count instead, e.g. [${Math.ceil(points / size)}].`,
    )
  }
  return points / size
}

function samePlace(a: ParsedDevice, b: ParsedDevice): boolean {
  const place = ({ address, bit, digits }: ParsedDevice) =>
    `${formatDevice({ ...address, number: 0 }, { xyRadix: 16 })} ${bit === undefined} ${digits}`
  return place(a) === place(b)
}

function checkCount(count: number, { address }: ParsedDevice, fail: Fail): void {
  if (!Number.isInteger(count) || count < 1 || count > MOST_VALUES) {
    fail('OUT_OF_RANGE', `the number of values is a whole number from 1 to ${MOST_VALUES}, not ${count}.`)
  }
  if (address.indirect === true) {
    fail('UNSUPPORTED', '@ reaches one value only, because the address stands in the PLC: leave the count out.')
  }
}

function checkEnd(count: number, device: ParsedDevice, type: ValueType, fail: Fail): void {
  const { address, bit } = device
  const points = count * sizeOf(device, type)
  const numbers = bit === undefined ? points : Math.ceil((bit + points) / 16)
  if (address.indirect === true || address.number + numbers - 1 <= LAST_NUMBER) return
  fail('OUT_OF_RANGE', 'it ends behind the last device number there can be.')
}

function formatOf({ wordOrder, byteOrder, encoding, trimSpaces }: ItemOptions, usual: ValueFormat): ValueFormat {
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
