// Values in words: device addresses as GX Works writes them, and which device each value of a message belongs to.

import { hex } from '../../basics/hex'
import type { Context, DataCode, Declaration, Message, Shape } from '../../codec/codec'
import { type AnnotatedRow, type Leaf, showBytes } from '../../codec/explanation'
import { commands } from '../commands/commands'
import { type AddressOptions, formatDevice } from '../device/address'
import { type DeviceAddress, deviceInfo } from '../device/device'
import { setReset } from '../device/set-reset'
import { isDevice } from '../device-field'
import { attributeText } from '../file/attribute'
import { driveNumber, fileName } from '../file/codec'
import { type FileTime, formatFileTime } from '../file/time'
import { modelOf } from '../model-code'

/** How values are put into words. */
export interface WordsFor extends AddressOptions {
  readonly code: DataCode
}

/** The device of the n-th value of a row. */
type DeviceAt = (index: number) => NamedValue
interface NamedValue {
  readonly name: string
  /** The word holds 16 bit devices from here on. */
  readonly bits?: DeviceAddress
}

/** Words for the fields of a command's data. */
export function describeValue({ field, value }: Leaf, words: WordsFor): string | undefined {
  if (isDevice(field)) {
    const address = value as DeviceAddress
    return `${formatDevice(address, words)} (${deviceInfo(address.device).title})`
  }
  if (field.kind === 'value' && field.codec === setReset) return value === true ? '1 (set: ON)' : '0 (reset: OFF)'
  if (field === commands.readTypeName.response.modelCode && typeof value === 'number') {
    const models = modelOf(value)?.models.join(' or ') ?? 'not a model code of the manuals'
    return `${hex(value, 4)}H (${models})`
  }
  if (field === listedFile.attribute && typeof value === 'number') return `${hex(value, 2)}H (${attributeText(value)})`
  if (field.kind === 'value' && isFileTimeCodec(field.codec)) return formatFileTime(value as FileTime)
  if (field.kind === 'u16' || field.kind === 'u32') {
    if (field.doc === undefined) return signedText(value, field.kind === 'u16' ? 16 : 32)
    return `${String(value)} (${field.doc})`
  }
  if (field.kind === 'u8' && field.doc !== undefined) return `${String(value)} (${field.doc})`
  return field.kind === 'echo' ? `${describeEcho(value, words)} (repeats the request)` : undefined
}

const listedFile = commands.readDirectory.response.files.item

function isFileTimeCodec(codec: unknown): boolean {
  return codec === listedFile.modified.codec || codec === commands.changeFileDate.request.date.codec
}

function describeEcho(value: unknown, words: WordsFor): string {
  return isAddress(value) ? formatDevice(value, words) : String(value)
}

function isAddress(value: unknown): value is DeviceAddress {
  return typeof value === 'object' && value !== null && 'device' in value
}

/** As GX Works shows a word by default: signed; its digits beside it. */
function signedText(value: unknown, bits: 16 | 32): string {
  return typeof value === 'number' ? `${signed(value, bits)} (${hex(value, bits / 4)}H)` : String(value)
}

function signed(value: number, bits: 16 | 32): number {
  return value >= 2 ** (bits - 1) ? value - 2 ** bits : value
}

/** Values of a bulk row that go into one row together. */
const TOGETHER = { words: 8, doubleWords: 4, bits: 16, bytes: 16 } as const
type BulkKind = keyof typeof TOGETHER

/**
 * Splits the row of a bulk field into rows short enough to read, each naming the devices its values belong to.
 * `message` is what was read so far: the values of a write stand behind their head device.
 */
export function splitRow(
  row: AnnotatedRow,
  bytes: Buffer,
  words: WordsFor,
  deviceAt: DeviceAt | undefined,
): readonly AnnotatedRow[] {
  const values = row.value
  if (!isBulk(row.kind) || !Array.isArray(values) || values.length === 0) return [row]
  const together = deviceAt?.(0).bits === undefined ? TOGETHER[row.kind] : 1
  const rows: AnnotatedRow[] = []
  for (let from = 0; from < values.length; from += together) {
    const to = Math.min(from + together, values.length)
    const piece = bytes.subarray(byteAt(row, bytes, values, from, words), byteAt(row, bytes, values, to, words))
    rows.push({
      ...row,
      offset: row.offset + byteAt(row, bytes, values, from, words),
      length: piece.length,
      name: values.length <= together ? row.name : nameOfPart(row.name, from, to),
      value: values.slice(from, to),
      bytes: showBytes(piece, words.code),
      text: textOf(row.kind, values.slice(from, to), from, words, deviceAt),
    })
  }
  return rows
}

function isBulk(kind: string): kind is BulkKind {
  return Object.hasOwn(TOGETHER, kind)
}

function nameOfPart(name: string, from: number, to: number): string {
  return to - from === 1 ? `${name}.${from}` : `${name}.${from}..${to - 1}`
}

/** Values take equal shares of the bytes, but two bits share a byte in binary code. */
function byteAt(row: AnnotatedRow, bytes: Buffer, values: readonly unknown[], index: number, words: WordsFor): number {
  if (row.kind === 'bits' && words.code === 'binary') return Math.min((index + 1) >> 1, bytes.length)
  return (bytes.length / values.length) * index
}

function textOf(
  kind: BulkKind,
  values: readonly unknown[],
  from: number,
  words: WordsFor,
  deviceAt: DeviceAt | undefined,
): string {
  const first = deviceAt?.(from)
  const last = deviceAt?.(from + values.length - 1)
  const label =
    first === undefined ? '' : first.name === last?.name ? `${first.name}: ` : `${first.name}..${last?.name ?? ''}: `
  if (first?.bits !== undefined) return bitsOfWord(first.bits, values[0], words)
  if (kind === 'bits') return `${label}${values.map((value) => (value === true ? '1' : '0')).join(' ')}`
  const bits = kind === 'doubleWords' ? 32 : 16
  if (values.length === 1) return `${label}${signedText(values[0], bits)}`
  return `${label}${values.map((value) => (typeof value === 'number' ? signed(value, bits) : value)).join(' ')}`
}

/** A word of 16 bit devices: the first device is the lowest bit. */
function bitsOfWord(first: DeviceAddress, word: unknown, words: WordsFor): string {
  const nameAt = (bit: number) => formatDevice({ ...first, number: first.number + bit }, words)
  const on = Array.from({ length: 16 }, (_, bit) => bit).filter((bit) => (Number(word) >> bit) & 1)
  const what = on.length === 0 ? 'all OFF' : on.length === 16 ? 'all ON' : `ON ${on.map(nameAt).join(' ')}`
  return `${nameAt(0)}..${nameAt(15)}: ${what}`
}

/** What the values of a field are values of: found in the declarations, never listed. */
export interface Placed {
  /** Shape and message that the field stands in. */
  readonly shape: Shape
  readonly message: Message
  /** The request, when it is a response. */
  readonly context?: Context
}

/**
 * The devices that the values of the bulk field at `path` belong to, or `undefined` when they belong to none:
 * - in a request, those from the head device beside them;
 * - in a response, those from the head device beside what counts them, or one each of the list that counts them;
 * - of `each`, those from the head device of the element.
 */
export function devicesOf(path: string, { shape, message, context }: Placed, words: WordsFor): DeviceAt | undefined {
  const [name = '', index, inner] = path.split('.')
  const field = shape[name]
  if (field === undefined) return undefined
  if (field.kind === 'list') {
    const element = elementOf(message[name], Number(index))
    return fromHead(field.item, element, field.item[inner ?? '']?.kind, words)
  }
  if (field.kind === 'each') {
    const list = context?.shape[field.of]
    if (context === undefined || list?.kind !== 'list') return undefined
    return fromHead(list.item, elementOf(context.message[field.of], Number(index)), field.item.kind, words)
  }
  if (context === undefined) return fromHead(shape, message, field.kind, words)
  const counter = 'count' in field ? context.shape[field.count] : undefined
  if (counter?.kind !== 'list') return fromHead(context.shape, context.message, field.kind, words)
  const list = context.message[String('count' in field ? field.count : '')]
  return (at) => {
    const element = elementOf(list, at)
    const head = headOf(counter.item, element)
    return { name: head === undefined ? `element ${at}` : formatDevice(head, words) }
  }
}

function elementOf(list: unknown, index: number): Message {
  const element: unknown = Array.isArray(list) ? list[index] : undefined
  return typeof element === 'object' && element !== null ? (element as Message) : {}
}

function headOf(shape: Shape, message: Message): DeviceAddress | undefined {
  const name = Object.keys(shape).find((key) => isDevice(shape[key]))
  const found = name === undefined ? undefined : message[name]
  return isAddress(found) ? found : undefined
}

function fromHead(shape: Shape, message: Message, kind: string | undefined, words: WordsFor): DeviceAt | undefined {
  const head = headOf(shape, message)
  return head === undefined ? undefined : (index) => deviceOf(head, kind, index, words)
}

/** The n-th value from a head device: a word of bit devices holds 16, some devices take several words. */
function deviceOf(head: DeviceAddress, kind: string | undefined, index: number, words: WordsFor): NamedValue {
  const { unit, wordsPerDevice = 1 } = deviceInfo(head.device)
  const at = (number: number): DeviceAddress => ({ ...head, number: head.number + number })
  if (kind === 'bits') return { name: formatDevice(at(index), words) }
  if (unit === 'bit') return { name: formatDevice(at(16 * index), words), bits: at(16 * index) }
  const name = formatDevice(at(Math.floor(index / wordsPerDevice)), words)
  return { name: wordsPerDevice === 1 ? name : `${name} word ${index % wordsPerDevice}` }
}

/** What a request is about, for its title: `D100, 10 points`, `LINE.CSV`. */
export function summaryOf({ request }: Declaration, message: Message, words: WordsFor): string {
  const files = filesOf(request, message)
  if (files.length > 0) return files.join(', ')
  const head = headOf(request, message)
  const count = Object.entries(request).flatMap(([name, { kind }]) => {
    const value = message[name]
    if (kind === 'u8' || kind === 'u16') return name === 'points' && typeof value === 'number' ? [value] : []
    return Array.isArray(value) ? [value.length] : []
  })
  const points = count.reduce((sum, part) => sum + part, 0)
  return [
    ...(head === undefined ? [] : [formatDevice(head, words)]),
    ...(count.length === 0 || head === undefined ? [] : [`${points} ${points === 1 ? 'point' : 'points'}`]),
  ].join(', ')
}

/** Names of files, each behind the number of its drive: `4:LINE.CSV`. */
function filesOf(request: Shape, message: Message): string[] {
  let drive: unknown
  return Object.entries(request).flatMap(([name, field]) => {
    if (field.kind !== 'value') return []
    if (field.codec === driveNumber) drive = message[name]
    return field.codec === fileName ? [`${String(drive)}:${String(message[name])}`] : []
  })
}
