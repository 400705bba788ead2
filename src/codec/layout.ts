// The one place that gives a field its meaning, for both directions and both codes.
import { RequestError } from '../errors'
import type { Reader, ValueCodec, Writer } from './cursor'
import type { BulkField, Charset, Count, Field, IntegerField, MessageInput, MessageOf, Shape } from './field'

/** The request a response answers: `echo`, `each` and counts refer to it. */
export interface Context {
  readonly shape: Shape
  readonly message: Readonly<Record<string, unknown>>
}

type Bag = Record<string, unknown>

const WIDTH = { u8: 1, u16: 2, u32: 4 } as const

/**
 * Writes `message` as `shape` says.
 * @throws RequestError BAD_MESSAGE naming the field, when the message does not fit the shape.
 */
export function encode<S extends Shape>(shape: S, message: MessageInput<S>, writer: Writer, context?: Context): void {
  encodeBag(shape, message as Bag, writer, context)
}

function encodeBag(shape: Shape, message: Bag, writer: Writer, context: Context | undefined): void {
  for (const name in shape) {
    try {
      put(shape[name] as Field, message[name], message, writer, context)
    } catch (error) {
      throw named(name, error)
    }
  }
}

/** Puts the field's name in front of what is wrong with it, so that nested lists give a path. */
function named(name: string, error: unknown): unknown {
  if (!(error instanceof RequestError)) return error
  const path = error.field === undefined ? name : `${name}.${error.field}`
  const reason = error.field === undefined ? error.message : error.message.slice(error.field.length + 2)
  return new RequestError(error.code, `${path}: ${reason}`, path)
}

function put(field: Field, given: unknown, message: Bag, writer: Writer, context: Context | undefined): void {
  switch (field.kind) {
    case 'u8':
    case 'u16':
    case 'u32':
      writer.uint(integerToWrite(field, given), WIDTH[field.kind])
      return
    case 'fixed':
      writer.uint(field.value, field.width)
      return
    case 'count':
      writer.uint(countToWrite(field, lengthOf(message[field.of], field.of)), field.width)
      return
    case 'echo':
      putEcho(field.of, writer, context)
      return
    case 'value':
      if (given === undefined) bad('is missing')
      field.codec.write(writer, given)
      return
    case 'words':
      writer.words(arrayToWrite(field, given, message, context) as ArrayLike<number>)
      return
    case 'doubleWords':
      writer.doubleWords(arrayToWrite(field, given, message, context) as ArrayLike<number>)
      return
    case 'bits':
      writer.bits(booleansToWrite(arrayToWrite(field, given, message, context)))
      return
    case 'bytes':
      writer.bytes(arrayToWrite(field, given, message, context) as ArrayLike<number>)
      return
    case 'text':
      writer.text(textToWrite(field, given, message, context))
      return
    case 'list':
      listToWrite(given).forEach((element, i) => {
        try {
          encodeBag(field.item, element, writer, context)
        } catch (error) {
          throw named(String(i), error)
        }
      })
      return
    case 'each':
      putEach(field.of, field.item, given, writer, context)
      return
    default:
      field satisfies never
  }
}

function putEcho(of: string, writer: Writer, context: Context | undefined): void {
  const { shape, message } = asked(context)
  put(shape[of] as Field, message[of], message as Bag, writer, undefined)
}

function putEach(of: string, item: BulkField, given: unknown, writer: Writer, context: Context | undefined): void {
  const elements = asked(context).message[of] as readonly Bag[]
  const parts = listToWrite(given) as readonly unknown[]
  if (parts.length !== elements.length)
    bad(`has ${parts.length} element(s), the request's ${of} has ${elements.length}`)
  elements.forEach((element, i) => {
    put(item, parts[i], element, writer, undefined)
  })
}

function bad(reason: string): never {
  throw new RequestError('BAD_MESSAGE', reason)
}

function asked(context: Context | undefined): Context {
  if (context === undefined) throw new TypeError('A response is encoded and decoded with the request it answers')
  return context
}

function integerToWrite(field: IntegerField, given: unknown): number {
  const number = given ?? field.default
  if (typeof number !== 'number' || !Number.isInteger(number)) bad(`must be a whole number, is ${show(given)}`)
  const [min, max] = boundsOf(field)
  if (number < min || number > max) bad(`is ${number}, must be ${min} to ${max}`)
  if (field.oneOf?.includes(number) === false) bad(`is ${number}, must be one of ${field.oneOf.join(', ')}`)
  return number === field.zeroMeans ? 0 : number
}

function boundsOf(field: IntegerField): readonly [min: number, max: number] {
  return [field.min ?? 0, field.max ?? 2 ** (8 * WIDTH[field.kind]) - 1]
}

function countToWrite(field: Extract<Field, { kind: 'count' }>, length: number): number {
  const max = field.max ?? 2 ** (8 * field.width) - 1
  if (length < (field.min ?? 0) || length > max) {
    bad(`${field.of} has ${length} element(s), must have ${field.min ?? 0} to ${max}`)
  }
  return length === field.zeroMeans ? 0 : length
}

function lengthOf(given: unknown, name: string): number {
  if (typeof given === 'string' || isArrayLike(given)) return given.length
  return bad(`${name} is missing`)
}

function isArrayLike(given: unknown): given is ArrayLike<unknown> {
  return Array.isArray(given) || ArrayBuffer.isView(given)
}

function arrayToWrite(
  field: BulkField,
  given: unknown,
  message: Bag,
  context: Context | undefined,
): ArrayLike<unknown> {
  if (!isArrayLike(given)) bad(`must be an array, is ${show(given)}`)
  const expected = countIn(field.count, message, context)
  if (expected !== undefined && given.length !== expected) bad(`has ${given.length} element(s), must have ${expected}`)
  return given
}

function booleansToWrite(values: ArrayLike<unknown>): ArrayLike<boolean> {
  for (let i = 0; i < values.length; i++) {
    if (typeof values[i] !== 'boolean') bad(`element ${i} is ${show(values[i])}, must be true or false`)
  }
  return values as ArrayLike<boolean>
}

const CHARSETS: Readonly<Record<Exclude<Charset, 'any'>, RegExp>> = { hexDigits: /^[0-9A-F]*$/ }

function textToWrite(
  field: Extract<Field, { kind: 'text' }>,
  given: unknown,
  message: Bag,
  context: Context | undefined,
): string {
  if (typeof given !== 'string') bad(`must be a text, is ${show(given)}`)
  const expected = countIn(field.count, message, context)
  if (expected !== undefined && given.length !== expected)
    bad(`has ${given.length} character(s), must have ${expected}`)
  if (!inCharset(field.charset, given)) bad('may hold only the characters 0-9 and A-F')
  return given
}

function inCharset(charset: Charset | undefined, given: string): boolean {
  return charset === undefined || charset === 'any' || CHARSETS[charset].test(given)
}

function listToWrite(given: unknown): readonly Bag[] {
  if (!Array.isArray(given)) bad(`must be an array, is ${show(given)}`)
  return given as readonly Bag[]
}

function show(given: unknown): string {
  if (given === undefined) return 'missing'
  return typeof given === 'string' ? JSON.stringify(given.slice(0, 40)) : String(given)
}

/**
 * The number a count refers to: a number, or the length of what has the name, in this message or else in the request.
 * `undefined` when neither has it, as for a derived count of the message that is being encoded.
 */
function countIn(count: Count, message: Bag, context: Context | undefined): number | undefined {
  if (typeof count === 'number') return count
  return sizeIn(message[count]) ?? (context === undefined ? undefined : sizeInRequest(count, context))
}

function sizeIn(found: unknown): number | undefined {
  if (typeof found === 'number') return found
  return typeof found === 'string' || isArrayLike(found) ? found.length : undefined
}

function sizeInRequest(name: string, context: Context): number | undefined {
  const field = context.shape[name]
  return sizeIn(context.message[field?.kind === 'count' ? field.of : name])
}

/**
 * Reads a message of `shape`. The caller ends with `reader.end()`.
 * @throws ProtocolError when the bytes are not such a message.
 */
export function decode<S extends Shape>(shape: S, reader: Reader, context?: Context): MessageOf<S> {
  return decodeBag(shape, reader, context) as MessageOf<S>
}

function decodeBag(shape: Shape, reader: Reader, context: Context | undefined): Bag {
  const message: Bag = {}
  let counts: Record<string, number> | undefined
  for (const name in shape) {
    const field = shape[name] as Field
    if (field.kind === 'count') {
      counts ??= {}
      counts[field.of] = readCount(field, reader)
    } else if (field.kind === 'fixed') readFixed(field, name, reader)
    else if (field.kind === 'echo') readEcho(field.of, name, reader, context)
    else message[name] = get(field, counts?.[name], message, reader, context)
  }
  return message
}

type Visible = Exclude<Field, { kind: 'count' | 'fixed' | 'echo' }>

function get(
  field: Visible,
  counted: number | undefined,
  message: Bag,
  reader: Reader,
  context: Context | undefined,
): unknown {
  switch (field.kind) {
    case 'u8':
    case 'u16':
    case 'u32':
      return readInteger(field, reader)
    case 'value':
      return field.codec.read(reader)
    case 'words':
      return reader.words(counted ?? countToRead(field.count, message, context))
    case 'doubleWords':
      return reader.doubleWords(counted ?? countToRead(field.count, message, context))
    case 'bits':
      return reader.bits(counted ?? countToRead(field.count, message, context))
    case 'bytes':
      return reader.bytes(counted ?? countToRead(field.count, message, context))
    case 'text':
      return readText(field, counted ?? countToRead(field.count, message, context), reader)
    case 'list':
      return readList(field.item, counted ?? countToRead(field.count, message, context), reader, context)
    case 'each':
      return (asked(context).message[field.of] as readonly Bag[]).map((element) =>
        get(field.item, undefined, element, reader, undefined),
      )
    default:
      return field satisfies never
  }
}

function countToRead(count: Count, message: Bag, context: Context | undefined): number {
  const found = countIn(count, message, context)
  if (found === undefined) throw new TypeError(`Nothing tells the count ${count}`)
  return found
}

function readInteger(field: IntegerField, reader: Reader): number {
  const read = reader.uint(WIDTH[field.kind])
  const number = read === 0 && field.zeroMeans !== undefined ? field.zeroMeans : read
  const [min, max] = boundsOf(field)
  if (number < min || number > max) reader.fail('BAD_FIELD', `${number} is not within ${min} to ${max}`)
  if (field.oneOf?.includes(number) === false)
    reader.fail('BAD_FIELD', `${number} is not one of ${field.oneOf.join(', ')}`)
  return number
}

function readCount(field: Extract<Field, { kind: 'count' }>, reader: Reader): number {
  const read = reader.uint(field.width)
  const count = read === 0 && field.zeroMeans !== undefined ? field.zeroMeans : read
  if (count < (field.min ?? 0) || count > (field.max ?? count)) {
    reader.fail('BAD_FIELD', `${count} ${field.of}, must be ${field.min ?? 0} to ${field.max ?? 'the width'}`)
  }
  return count
}

function readFixed(field: Extract<Field, { kind: 'fixed' }>, name: string, reader: Reader): void {
  const found = reader.uint(field.width)
  if (found !== field.value) reader.fail('BAD_FIELD', `${name} is fixed to ${field.value}, found ${found}`)
}

function readEcho(of: string, name: string, reader: Reader, context: Context | undefined): void {
  const { shape, message } = asked(context)
  const field = shape[of] as Field
  const found =
    field.kind === 'count' ? readCount(field, reader) : get(field as Visible, undefined, {}, reader, undefined)
  const sent = field.kind === 'count' ? lengthOf(message[field.of], field.of) : message[of]
  if (!same(found, sent)) reader.fail('ECHO_MISMATCH', `${name} does not repeat the request`)
}

/** Equality of decoded plain data. A field the caller left at its default compares equal to the decoded default. */
function same(a: unknown, b: unknown): boolean {
  if (Object.is(a, b)) return true
  if (typeof a !== 'object' || typeof b !== 'object' || a === null || b === null) return false
  const names = new Set([...Object.keys(a), ...Object.keys(b)])
  for (const name of names) if (!same((a as Bag)[name], (b as Bag)[name])) return false
  return true
}

function readText(field: Extract<Field, { kind: 'text' }>, count: number, reader: Reader): string {
  const read = reader.text(count)
  if (!inCharset(field.charset, read)) reader.fail('BAD_FIELD', 'a character other than 0-9 and A-F')
  return read
}

function readList(item: Shape, count: number, reader: Reader, context: Context | undefined): Bag[] {
  const elements: Bag[] = []
  for (let i = 0; i < count; i++) elements.push(decodeBag(item, reader, context))
  return elements
}

/** What is known of a message when its size is asked for. */
export interface Measured {
  readonly ascii: boolean
  readonly form: number
  /** The message itself, when it is known (a request that is sent, a response that was built). */
  readonly message?: Readonly<Record<string, unknown>>
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
  const count = (of: Count) => sizeIn(own) ?? countToRead(of, (known.message ?? {}) as Bag, known.context)
  switch (field.kind) {
    case 'u8':
    case 'u16':
    case 'u32':
      return WIDTH[field.kind] * digits
    case 'fixed':
    case 'count':
      return field.width * digits
    case 'echo':
      return spanOfEcho(field.of, known)
    case 'value':
      return (field.codec as ValueCodec<unknown>).size(known.ascii, known.form, own)
    case 'words':
    case 'doubleWords':
    case 'bits':
    case 'bytes':
      return bulkSize(field.kind, count(field.count), known.ascii)
    case 'text':
      return count(field.count)
    case 'list':
      return spanOfList(field.item, own, count(field.count), known)
    case 'each':
      return (asked(known.context).message[field.of] as readonly Bag[]).reduce(
        (total, element) =>
          total + bulkSize(field.item.kind, countToRead(field.item.count, element, undefined), known.ascii),
        0,
      )
    default:
      return field satisfies never
  }
}

function spanOfEcho(of: string, known: Measured): number {
  const { shape, message } = asked(known.context)
  return span(shape[of] as Field, of, { ascii: known.ascii, form: known.form, message })
}

function spanOfList(item: Shape, own: unknown, count: number, known: Measured): number {
  const { message: _, ...rest } = known
  if (Array.isArray(own)) {
    return (own as readonly Bag[]).reduce((total, element) => total + measure(item, { ...rest, message: element }), 0)
  }
  return count * measure(item, rest)
}

function bulkSize(kind: BulkField['kind'], count: number, ascii: boolean): number {
  if (kind === 'bits') return ascii ? count : (count + 1) >> 1
  const bytes = { words: 2, doubleWords: 4, bytes: 1 }[kind] * count
  return ascii ? bytes * 2 : bytes
}
