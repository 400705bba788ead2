// How many bytes a message takes, without writing it.
import { asked, type Context, countToRead, elementsAsked, sizeIn } from './count'
import type { ValueCodec } from './cursor'
import {
  type BulkField,
  type Count,
  type Field,
  type IntegerField,
  type Message,
  type Shape,
  standsIn,
  WIDTH,
} from './field'

/** What is known of a message when its size is asked for. */
export interface Measured {
  readonly ascii: boolean
  readonly form: number
  /** The message itself, when it is known (a request that is sent, a response that was built). */
  readonly message?: Message
  /** The request, when a response is measured. */
  readonly context?: Context
}

/**
 * Bytes a message of `shape` takes, without encoding it.
 * Frames without a length (1E, Sharp JW) need this to know where an answer ends.
 */
export function measure(shape: Shape, known: Measured): number {
  let total = 0
  for (const name in shape) total += span(shape[name] as Field, name, known)
  return total
}

function span(field: Field, name: string, known: Measured): number {
  const digits = known.ascii ? 2 : 1
  const own = known.message?.[name]
  const count = (of: Count) => sizeIn(own) ?? countToRead(of, name, known.message ?? {}, known.context)
  switch (field.kind) {
    case 'u8':
    case 'u16':
    case 'u32':
      return WIDTH[field.kind] * digits
    case 'fixed':
      if (!standsIn(field, known)) return 0
      return known.ascii && field.ascii !== undefined ? field.ascii.length : field.width * digits
    case 'spare':
      return field.size * digits
    case 'count':
      return field.width * digits
    case 'echo':
      return spanOfEcho(field.of, known)
    case 'value':
      return (field.codec as ValueCodec<unknown>).size(known.ascii, known.form, own ?? field.default)
    case 'words':
    case 'doubleWords':
    case 'bits':
    case 'bytes':
      return bulkSize(field.kind, count(field.count), known.ascii)
    case 'text':
      return count(field.count) * (field.digits === true ? digits : 1)
    case 'list':
      return spanOfList(field.item, own, count(field.count), known)
    case 'rest':
      return count(name) * digits
    case 'each':
      return spanOfEach(field, known)
    case 'repeat':
      return sum(elementsAsked(field.of, known.context), (element) => measure(field.item, around(element, known)))
    default:
      return field satisfies never
  }
}

function spanOfEach({ of, item, front = {} }: Extract<Field, { kind: 'each' }>, known: Measured): number {
  return sum(
    elementsAsked(of, known.context),
    (element) => measure(front, around(element, known)) + spanOfItem(item, element.message, known.ascii),
  )
}

function spanOfItem(item: BulkField | IntegerField, element: Message, ascii: boolean): number {
  if (!('count' in item)) return WIDTH[item.kind] * (ascii ? 2 : 1)
  return bulkSize(item.kind, countToRead(item.count, '', element, undefined), ascii)
}

/** What is known of the part of an answer that stands for an element of the request. */
function around(element: Context, { ascii, form }: Measured): Measured {
  return { ascii, form, message: {}, context: element }
}

function sum<T>(parts: readonly T[], of: (part: T) => number): number {
  return parts.reduce((total, part) => total + of(part), 0)
}

/**
 * Whether only a message of `shape` itself says how long it is: something in it is counted by a number that stands in it and
 * not in the request.
 */
export function saysItsLength(shape: Shape, request: Shape): boolean {
  return Object.values(shape).some((field) => {
    if (!('count' in field) || typeof field.count !== 'string' || field.count in request) return false
    return shape[field.count] !== undefined
  })
}

function spanOfEcho(of: string, known: Measured): number {
  const { shape, message } = asked(known.context)
  return span(shape[of] as Field, of, { ascii: known.ascii, form: known.form, message })
}

function spanOfList(item: Shape, own: unknown, count: number, known: Measured): number {
  const { message: _, ...rest } = known
  if (Array.isArray(own) && !isFixed(item)) {
    return (own as readonly Message[]).reduce(
      (total, element) => total + measure(item, { ...rest, message: element }),
      0,
    )
  }
  return count * measure(item, rest)
}

const fixed = new WeakMap<Shape, boolean>()

/** Whether every message of the shape is as long as any other. Kept per shape. */
function isFixed(shape: Shape): boolean {
  let isIt = fixed.get(shape)
  if (isIt === undefined) {
    isIt = Object.values(shape).every((field) => {
      const { kind } = field
      if (kind === 'value') return field.codec.variable !== true
      return kind === 'u8' || kind === 'u16' || kind === 'u32' || kind === 'fixed' || kind === 'spare'
    })
    fixed.set(shape, isIt)
  }
  return isIt
}

function bulkSize(kind: BulkField['kind'], count: number, ascii: boolean): number {
  if (kind === 'bits') return ascii ? count : (count + 1) >> 1
  const bytes = { words: 2, doubleWords: 4, bytes: 1 }[kind] * count
  return ascii ? bytes * 2 : bytes
}
