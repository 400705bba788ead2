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
import { RequestError } from '../../errors'
import {
  type AddressOptions,
  formatDevice,
  formatParsedDevice,
  type ParsedDevice,
  parseDevice,
} from '../../melsec/device/address'
import { deviceInfo, LAST_NUMBER } from '../../melsec/device/device'
// Not by the public names of the room: its conversions need Node.js, and items are checked in browsers, too.
import type { ValueFormat } from '../../value/format'
import { formatType, parseType, type TypeName, typeNames, type ValueType, valueTypes, wordsOf } from '../../value/type'
import { otherNotation } from './notation'
import {
  checkedItem,
  checkValues,
  counted,
  type Fail,
  formatOf,
  type Item,
  type ItemOptions,
  type ItemStyle,
  onlyOne,
  splitText,
  typeOf,
  valuesIn,
} from './parts'

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
  const parts = splitText(given.address, STYLE, fail)
  const device = parseDevice(parts.first, options)
  const typeText = onlyOne('type', parts.type, given.type, fail)
  const type = typeText === undefined ? defaultType(device) : typeOf(typeText, parseType, fail)
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

const STYLE: ItemStyle = {
  typed: /^([^:]*)(?::(.*))?$/s,
  examples: { array: 'D100:REAL[10]', comma: 'D100,10', counted: 'D100[10]', range: 'M0..M15' },
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
  return valuesIn(points, size, formatType(type), fail)
}

function samePlace(a: ParsedDevice, b: ParsedDevice): boolean {
  const place = ({ address, bit, digits }: ParsedDevice) =>
    `${formatDevice({ ...address, number: 0 }, { xyRadix: 16 })} ${bit === undefined} ${digits}`
  return place(a) === place(b)
}

function checkCount(count: number, { address }: ParsedDevice, fail: Fail): void {
  checkValues(count, fail)
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
