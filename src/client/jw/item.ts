/**
 * What a user reads or writes in a Sharp JW: an operand with a type, one value or many, as text or as an object.
 *
 * | text                               | meaning                                                                       |
 * |------------------------------------|-------------------------------------------------------------------------------|
 * | `004033` `09012.3`                 | BOOL of a relay, or of a bit of a byte                                        |
 * | `09012` `KO0403` `F1:00001234`     | BYTE                                                                          |
 * | `09012:INT` `09012:REAL`           | numbers of two, four or eight bytes from 09012 on, low byte first             |
 * | `09012:BCD8` `09012:BCD16`         | 2 or 4 digits in BCD                                                          |
 * | `09012:STRING(20)`                 | text of 20 bytes                                                              |
 * | `09012[16]` `004000[16]`           | an array of so many values; bits go on in the next byte                       |
 * | `09000..09017:INT`                 | the same by its last byte: 8 values of two bytes each                         |
 * | `TMR0012` `TMR0012:WORD`           | current value of a timer, as its attribute says it is coded; its word as it is |
 * | `b0012` `b0012:WORD`               | bytes of current values as they stand, with bit 15                            |
 * | `TMR0012:BOOL`                     | sets (true) or resets (false) it; written only                                |
 */
import { RequestError } from '../../errors'
import { jwKind } from '../../jw/operand/kind'
import type { JwOperandOptions } from '../../jw/operand/map'
import { formatJwOperand, type JwOperand } from '../../jw/operand/notation'
import { parseJwOperand } from '../../jw/operand/parse'
import { type JwPlace, offsetOfJw, placeOfJw, stepsBehind } from '../../jw/operand/place'
import { type ByteType, bytesOf, formatByteType, parseByteType } from '../../value/byte-type'
import type { ValueFormat } from '../../value/format'
import type { RefusedItem } from '../item/item'
import { otherNotation } from '../item/notation'
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
} from '../item/parts'

/** An item of a Sharp JW that can be read or written, as plain data. */
export interface ParsedJwItem {
  /** As it was given; of an object the text that says the same. Results and messages carry it. */
  readonly text: string
  /** What it begins at. */
  readonly operand: JwOperand
  /** Where it begins. */
  readonly place: JwPlace
  /** Type of each value. */
  readonly type: ByteType
  /** Values of an array; missing: one value. */
  readonly count?: number
  /** Word order, encoding and so on; what is left out is low byte and low word first. */
  readonly format: ValueFormat
}

/** How items are read. */
export interface JwItemOptions extends JwOperandOptions {
  /** Word order, encoding and so on of items that do not say their own. */
  readonly format?: ValueFormat
}

/**
 * @throws RequestError BAD_ADDRESS, BAD_TYPE, OUT_OF_RANGE or BAD_OPTION; the message names the item and says what to write.
 * @example parseJwItem('09012:INT[10]').count // 10
 */
export function parseJwItem(item: Item, options: JwItemOptions = {}): ParsedJwItem {
  const given = checkedItem(item)
  try {
    return parsedItem(item, given, options)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    const isAlone = (address: string): boolean => isItem(address, options)
    // When the text alone is an item, what is wrong is beside it.
    const meant = isAlone(given.address) ? undefined : otherNotation(given.address, isAlone)
    if (meant === undefined) throw error
    throw new RequestError(error.code, `${JSON.stringify(given.address.trim())}: ${meant}`, given.address)
  }
}

/** As `parseJwItem`, with the error instead of the item: for lists in which one bad item must not spoil the others. */
export function tryParseJwItem(item: Item, options: JwItemOptions = {}): ParsedJwItem | RefusedItem {
  try {
    return parseJwItem(item, options)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    return { text: typeof item === 'string' ? item : String(item?.address), error }
  }
}

function isItem(address: string, options: JwItemOptions): boolean {
  try {
    parsedItem(address, { address }, options)
    return true
  } catch (error) {
    if (error instanceof RequestError) return false
    throw error
  }
}

/** A colon in front of a digit is that of a file: `F1:00001234:REAL`. No type begins with a digit. */
const STYLE: ItemStyle = {
  typed: /^((?:[^:]|:(?=\s*\d))*)(?::(.*))?$/s,
  examples: { array: '09012:INT[10]', comma: '09012,10', counted: '09012[10]', range: '004000..004017' },
}

function parsedItem(item: Item, given: ItemOptions, options: JwItemOptions): ParsedJwItem {
  const fail: Fail = (code, message) => {
    throw new RequestError(code, `${JSON.stringify(given.address)}: ${message}`, given.address)
  }
  const parts = splitText(given.address, STYLE, fail)
  const operand = parseJwOperand(parts.first, options)
  const typeText = onlyOne('type', parts.type, given.type, fail)
  const type = typeText === undefined ? defaultType(operand) : typeOf(typeText, parseByteType, fail)
  const problem = typeProblem(operand, type)
  if (problem !== undefined) fail('BAD_TYPE', problem)
  const place = placeOfJw(operand, options)
  const ranged = parts.last === undefined ? undefined : rangeCount(operand, parts.last, type, options, fail)
  const count = onlyOne('count', onlyOne('count', ranged, parts.count, fail), given.count, fail)
  if (count !== undefined) checkValues(count, fail)
  checkEnd(count ?? 1, operand, type, options, fail)
  const format = formatOf(given, options.format ?? {})
  const text = typeof item === 'string' ? item : formatJwItem({ operand, type, ...counted(count) })
  return { text, operand, place, type, ...counted(count), format }
}

/** The text that is read back as the same item; a default type is left out, a range becomes a count. */
export function formatJwItem({ operand, type, count }: Pick<ParsedJwItem, 'operand' | 'type' | 'count'>): string {
  const text = formatByteType(type)
  const behind = text === formatByteType(defaultType(operand)) ? '' : `:${text}`
  return `${formatJwOperand(operand)}${behind}${count === undefined ? '' : `[${count}]`}`
}

const DEFAULT_TYPES = { bit: 'BOOL', byte: 'BYTE', timer: 'UINT' } as const
/** Type of the values of an operand that says none, by what it is. */
export type JwDefaultTypes = typeof DEFAULT_TYPES

function unitOf({ kind, bit }: JwOperand): keyof JwDefaultTypes {
  return bit === undefined ? jwKind(kind).unit : 'bit'
}

function defaultType(operand: JwOperand): ByteType {
  return { name: DEFAULT_TYPES[unitOf(operand)] }
}

/** What a timer has: its current value, its word as it is, and set and reset. */
const TIMER_TYPES: readonly string[] = ['UINT', 'WORD', 'BOOL']

/** Why an operand has no values of a type, and what to write instead. */
function typeProblem(operand: JwOperand, type: ByteType): string | undefined {
  const isBit = type.name === 'BOOL'
  const text = formatJwOperand(operand)
  switch (unitOf(operand)) {
    case 'bit':
      return isBit ? undefined : `${text} is one bit, a BOOL, not ${formatByteType(type)}: ${bytesInstead(operand)}.`
    case 'byte':
      if (isBit) return `${text} is a byte: name the bit, ${text}.0 to ${text}.7.`
      return operand.kind === 'b' ? currentValueProblem(operand, type) : undefined
    default:
      if (isBit && operand.kind === 'MD')
        return `${text} is an MD, which is neither set nor reset (result code 04H). It has a word, WORD.`
      return TIMER_TYPES.includes(type.name)
        ? undefined
        : `${text} has a current value, which is UINT (or WORD: as it is, with bit 15); BOOL sets and resets it. It has no ${formatByteType(type)}.`
  }
}

/** What the bytes of current values are as they stand. */
const CURRENT_VALUE_TYPES: readonly string[] = ['BYTE', 'WORD']

/** Bit 15 of a current value is none of its digits: as a number it would be a wrong one. */
function currentValueProblem(operand: JwOperand, type: ByteType): string | undefined {
  if (type.name === 'WORD' && operand.number % 2 === 1) {
    const { number } = operand
    return `${formatJwOperand(operand)} is the high byte of a current value: its word begins at ${formatJwOperand({ ...operand, number: number - 1 })}.`
  }
  if (CURRENT_VALUE_TYPES.includes(type.name)) return undefined
  const number = Math.floor(operand.number / 2)
  const [timer, counter] = (['TMR', 'CNT'] as const).map((kind) => formatJwOperand({ kind, number }))
  return `${formatJwOperand(operand)} is of a current value, and bit 15 of that is no part of the number, so it is no ${formatByteType(type)}: take ${timer} or ${counter}, BYTE and WORD as they stand, or the byte of the file, e.g. F0:002012, where no timer uses it.`
}

function bytesInstead(operand: JwOperand): string {
  const { kind, number } = operand
  if (kind === 'relay')
    return `a number is in the bytes of relays, ${formatJwOperand({ kind: 'KO', number: number >> 3 })}`
  const { bit, ...byte } = operand
  return bit === undefined ? 'it has no bytes of its own' : `leave .${bit} out, ${formatJwOperand(byte)}`
}

/** Steps that one value takes: bits of a bit, bytes of a byte, numbers of a timer. */
function sizeOf(operand: JwOperand, type: ByteType): number {
  return unitOf(operand) === 'byte' ? bytesOf(type) : 1
}

/** The last byte (or bit) belongs to the range. */
function rangeCount(first: JwOperand, lastText: string, type: ByteType, options: JwItemOptions, fail: Fail): number {
  const last = parseJwOperand(lastText, options)
  if (first.kind !== last.kind || first.file !== last.file || unitOf(first) !== unitOf(last)) {
    fail('BAD_ADDRESS', 'both ends of a range are of one kind, written out, e.g. 004000..004017 or 09000.0..09001.7.')
  }
  const offset = offsetOfJw(placeOfJw(first, options), placeOfJw(last, options))
  if (offset === undefined) return fail('BAD_ADDRESS', 'both ends of a range lie in one file.')
  const points = (unitOf(first) === 'byte' ? offset / 8 : offset) + 1
  return valuesIn(points, sizeOf(first, type), formatByteType(type), fail)
}

function checkEnd(count: number, operand: JwOperand, type: ByteType, options: JwItemOptions, fail: Fail): void {
  const steps = count * sizeOf(operand, type) - 1
  const left = stepsBehind(operand, options)
  if (steps <= left) return
  const what = { bit: 'bits', byte: 'bytes', timer: 'numbers' }[unitOf(operand)]
  fail('OUT_OF_RANGE', `it takes ${steps + 1} ${what}, and from here on ${left + 1} lie in one piece.`)
}
