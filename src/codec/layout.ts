// The one place that gives a field its meaning, for both directions and both codes.
import { ProtocolError, RequestError } from '../errors'
import { asked, type Context, countIn, countToRead, elementsAsked, isArrayLike } from './count'
import { badMessage, placeText, type Reader, type Writer } from './cursor'
import {
  type BulkField,
  boundsOf,
  type Charset,
  type CountField,
  type Field,
  type IntegerField,
  isVisible,
  type Message,
  type MessageInput,
  type MessageOf,
  type RestField,
  type Shape,
  standsIn,
  type VisibleField,
  WIDTH,
} from './field'
import { namesOf } from './takes'

export type { Context } from './count'

/**
 * Writes `message` as `shape` says.
 * @throws RequestError BAD_MESSAGE naming the field, when the message does not fit the shape. A field that the shape
 * does not have, or derives by itself, is refused too: a misspelt option would otherwise be dropped without a word.
 */
export function encode<S extends Shape>(shape: S, message: MessageInput<S>, writer: Writer, context?: Context): void {
  encodeMessage(shape, message, writer, context)
}

function encodeMessage(shape: Shape, given: unknown, writer: Writer, context: Context | undefined): void {
  const message = messageToWrite(shape, given)
  for (const name in shape) {
    try {
      put(shape[name] as Field, name, message[name], message, writer, context)
    } catch (error) {
      throw named(name, error)
    }
  }
}

function messageToWrite(shape: Shape, given: unknown): Message {
  if (typeof given !== 'object' || given === null || Array.isArray(given)) {
    badMessage(`must be an object with ${namesOf(shape)}, is ${show(given)}`)
  }
  const message = given as Message
  for (const name in message) {
    const field = Object.hasOwn(shape, name) ? shape[name] : undefined
    if (message[name] === undefined || (field !== undefined && isVisible(field))) continue
    const reason = field === undefined ? 'is not a field of this message' : 'is filled in by itself'
    throw named(name, new RequestError('BAD_MESSAGE', `${reason}; it has ${namesOf(shape)}`))
  }
  return message
}

/** Puts the field's name in front of what is wrong with it, so that nested lists give a path. */
function named(name: string, error: unknown): unknown {
  if (!(error instanceof RequestError)) return error
  const path = error.field === undefined ? name : `${name}.${error.field}`
  const reason = error.field === undefined ? error.message : error.message.slice(error.field.length + 2)
  return new RequestError(error.code, `${path}: ${reason}`, path)
}

function put(
  field: Field,
  name: string,
  given: unknown,
  message: Message,
  writer: Writer,
  context: Context | undefined,
): void {
  switch (field.kind) {
    case 'u8':
    case 'u16':
    case 'u32':
      writer.uint(integerToWrite(field, given), WIDTH[field.kind])
      return
    case 'fixed':
      if (!standsIn(field, writer)) return
      if (writer.ascii && field.ascii !== undefined) writer.text(field.ascii)
      else writer.uint(field.value, field.width)
      return
    case 'spare':
      writer.bytes(new Uint8Array(field.size))
      return
    case 'count':
      writer.uint(countToWrite(field, lengthOf(message[field.of], field.of), context), field.width)
      return
    case 'echo':
      putEcho(field.of, writer, context)
      return
    case 'value':
      putValue(field, given, writer)
      return
    case 'words':
      writer.words(arrayToWrite(field, name, given, message, context) as ArrayLike<number>)
      return
    case 'doubleWords':
      writer.doubleWords(arrayToWrite(field, name, given, message, context) as ArrayLike<number>)
      return
    case 'bits':
      writer.bits(booleansToWrite(arrayToWrite(field, name, given, message, context)))
      return
    case 'bytes':
      writer.bytes(arrayToWrite(field, name, given, message, context) as ArrayLike<number>)
      return
    case 'text':
      putText(field, textToWrite(field, name, given, message, context), writer)
      return
    case 'list':
      eachToWrite(listToWrite(field, name, given, message, context), (element) => {
        encodeMessage(field.item, element, writer, context)
      })
      return
    case 'rest':
      writer.bytes(restToWrite(field, given))
      return
    case 'each':
      putEach(field, given, writer, context)
      return
    case 'repeat':
      eachOfRequest(field.of, context, (inner) => encodeMessage(field.item, {}, writer, inner))
      return
    default:
      field satisfies never
  }
}

function putValue(field: Extract<Field, { kind: 'value' }>, given: unknown, writer: Writer): void {
  const value = given === undefined ? field.default : given
  if (value === undefined || value === null) badMessage('is missing')
  field.codec.write(writer, value)
}

function putEcho(of: string, writer: Writer, context: Context | undefined): void {
  const { shape, message } = asked(context)
  put(shape[of] as Field, of, message[of], message, writer, undefined)
}

function putEach(
  { of, item, front }: Extract<Field, { kind: 'each' }>,
  given: unknown,
  writer: Writer,
  context: Context | undefined,
): void {
  const elements = elementsAsked(of, context)
  if (!Array.isArray(given)) badMessage(`must be an array, is ${show(given)}`)
  if (given.length !== elements.length)
    badMessage(`has ${given.length} element(s), the request's ${of} has ${elements.length}`)
  eachToWrite(given as readonly unknown[], (part, i) => {
    const inner = elements[i] as Context
    if (front !== undefined) encodeMessage(front, {}, writer, inner)
    put(item, '', part, inner.message, writer, undefined)
  })
}

function eachOfRequest(of: string, context: Context | undefined, run: (element: Context) => void): void {
  for (const element of elementsAsked(of, context)) run(element)
}

function restToWrite({ min, max }: RestField, given: unknown): ArrayLike<number> {
  if (!isArrayLike(given)) badMessage(`must be an array, is ${show(given)}`)
  if (given.length < min || given.length > max) {
    badMessage(`has ${given.length} element(s), must have ${min} to ${max}`)
  }
  return given as ArrayLike<number>
}

/** Also goes over the holes of an array, which forEach leaves out: they were counted. */
function eachToWrite(given: readonly unknown[], write: (element: unknown, i: number) => void): void {
  for (let i = 0; i < given.length; i++) {
    try {
      write(given[i], i)
    } catch (error) {
      throw named(String(i), error)
    }
  }
}

function integerToWrite(field: IntegerField, given: unknown): number {
  const number = given === undefined ? field.default : given
  if (typeof number !== 'number' || !Number.isInteger(number)) badMessage(`must be a whole number, is ${show(given)}`)
  const [min, max] = boundsOf(field)
  if (number < min || number > max) badMessage(`is ${number}, must be ${min} to ${max}`)
  if (!isMultiple(field, number)) badMessage(`is ${number}, must be a multiple of ${field.multipleOf}`)
  if (field.oneOf?.includes(number) === false) badMessage(`is ${number}, must be one of ${field.oneOf.join(', ')}`)
  if (number === field.zeroMeans) return 0
  return field.bcd === true ? toBcd(number) : number
}

function toBcd(number: number): number {
  return Number.parseInt(String(number), 16)
}

/** The number of decimal digits, `undefined` where one of them is none. */
function fromBcd(digits: number): number | undefined {
  const text = digits.toString(16)
  return /^\d+$/.test(text) ? Number(text) : undefined
}

function isMultiple({ multipleOf }: { readonly multipleOf?: number }, number: number): boolean {
  return multipleOf === undefined || number % multipleOf === 0
}

function countToWrite(field: CountField, length: number, context: Context | undefined): number {
  const max = field.max ?? 2 ** (8 * field.width) - 1
  if (length < (field.min ?? 0) || length > max) {
    badMessage(`${field.of} has ${length} element(s), must have ${field.min ?? 0} to ${max}`)
  }
  if (!isMultiple(field, length)) {
    badMessage(`${field.of} has ${length} element(s), must have a multiple of ${field.multipleOf}`)
  }
  const most = mostAsked(field, context)
  if (length > most) badMessage(`${field.of} has ${length} element(s), the request wants no more than ${most}`)
  return length === field.zeroMeans ? 0 : length
}

/** How many the request wants, where that bounds the answer. */
function mostAsked({ atMost }: CountField, context: Context | undefined): number {
  return atMost === undefined ? Number.POSITIVE_INFINITY : Number(asked(context).message[atMost])
}

function lengthOf(given: unknown, name: string): number {
  if (typeof given === 'string' || isArrayLike(given)) return given.length
  return badMessage(`${name} is missing`)
}

function arrayToWrite(
  field: BulkField,
  name: string,
  given: unknown,
  message: Message,
  context: Context | undefined,
): ArrayLike<unknown> {
  if (!isArrayLike(given)) badMessage(`must be an array, is ${show(given)}`)
  const expected = countIn(field.count, name, message, context)
  if (expected !== undefined && given.length !== expected)
    badMessage(`has ${given.length} element(s), must have ${expected}`)
  return given
}

function booleansToWrite(values: ArrayLike<unknown>): ArrayLike<boolean> {
  for (let i = 0; i < values.length; i++) {
    if (typeof values[i] !== 'boolean') badMessage(`element ${i} is ${show(values[i])}, must be true or false`)
  }
  return values as ArrayLike<boolean>
}

function putText(field: Extract<Field, { kind: 'text' }>, text: string, writer: Writer): void {
  if (field.digits === true) writer.bytes(Array.from(text, (character) => character.charCodeAt(0)))
  else writer.text(text)
}

const CHARSETS: Readonly<Record<Exclude<Charset, 'any'>, { readonly has: RegExp; readonly text: string }>> = {
  hexDigits: { has: /^[0-9A-F]*$/, text: '0-9 and A-F' },
  printable: { has: /^[\x20-\x7e]*$/, text: '20H to 7EH (ASCII)' },
  alphanumeric: { has: /^[0-9A-Za-z]*$/, text: '0-9, A-Z and a-z' },
}

function textToWrite(
  field: Extract<Field, { kind: 'text' }>,
  name: string,
  given: unknown,
  message: Message,
  context: Context | undefined,
): string {
  if (typeof given !== 'string')
    badMessage(field.secret === true ? 'must be a text' : `must be a text, is ${show(given)}`)
  const expected = countIn(field.count, name, message, context)
  if (expected !== undefined && given.length !== expected)
    badMessage(`has ${given.length} character(s), must have ${expected}`)
  const missing = notInCharset(field.charset, given)
  if (missing !== undefined) badMessage(`may hold only the characters ${missing}`)
  return given
}

/** The characters that may be there, when there are others. */
function notInCharset(charset: Charset | undefined, given: string): string | undefined {
  if (charset === undefined || charset === 'any') return undefined
  return CHARSETS[charset].has.test(given) ? undefined : CHARSETS[charset].text
}

function listToWrite(
  field: Extract<Field, { kind: 'list' }>,
  name: string,
  given: unknown,
  message: Message,
  context: Context | undefined,
): readonly unknown[] {
  if (!Array.isArray(given)) badMessage(`must be an array, is ${show(given)}`)
  const expected = countIn(field.count, name, message, context)
  if (expected !== undefined && given.length !== expected)
    badMessage(`has ${given.length} element(s), must have ${expected}`)
  return given
}

function show(given: unknown): string {
  if (given === undefined) return 'missing'
  if (typeof given === 'string') return JSON.stringify(given.slice(0, 40))
  if (typeof given === 'function') return 'a function'
  // Not String(): objects exist that cannot be turned into text.
  if (typeof given === 'object' && given !== null) return Array.isArray(given) ? 'an array' : 'an object'
  return String(given)
}

/**
 * Reads a message of `shape`. The caller ends with `reader.end()`.
 * @throws ProtocolError naming the field, when the bytes are not such a message.
 */
export function decode<S extends Shape>(shape: S, reader: Reader, context?: Context): MessageOf<S> {
  return decodeMessage(shape, reader, context) as MessageOf<S>
}

function decodeMessage(shape: Shape, reader: Reader, context: Context | undefined): Message {
  const message: Record<string, unknown> = {}
  let counts: Record<string, number> | undefined
  let at = ''
  try {
    for (const name in shape) {
      at = name
      const field = shape[name] as Field
      if (field.kind === 'count') {
        counts ??= {}
        counts[field.of] = readCount(field, reader, context)
      } else if (field.kind === 'fixed') readFixed(field, name, reader)
      else if (field.kind === 'spare') readSpare(field.size, reader)
      else if (field.kind === 'echo') readEcho(field.of, name, reader, context)
      else if (field.kind === 'repeat') readRepeat(field, reader, context)
      else message[name] = get(field, name, counts?.[name], message, reader, context)
    }
  } catch (error) {
    throw located(at, error)
  }
  return message
}

/** Says of a reading error which field it is about, so that nested lists give a path. */
function located(name: string, error: unknown): unknown {
  if (!(error instanceof ProtocolError)) return error
  const { code, message, offset = 0, bytes, field } = error
  const path = field === undefined ? name : `${name}.${field}`
  const reason = message.slice(placeText(offset, field).length)
  return new ProtocolError(code, `${placeText(offset, path)}${reason}`, {
    offset,
    ...(bytes === undefined ? {} : { bytes }),
    field: path,
  })
}

function get(
  field: VisibleField,
  name: string,
  counted: number | undefined,
  message: Message,
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
      return reader.words(counted ?? countToRead(field.count, name, message, context))
    case 'doubleWords':
      return reader.doubleWords(counted ?? countToRead(field.count, name, message, context))
    case 'bits':
      return reader.bits(counted ?? countToRead(field.count, name, message, context))
    case 'bytes':
      return reader.bytes(counted ?? countToRead(field.count, name, message, context))
    case 'text':
      return readText(field, counted ?? countToRead(field.count, name, message, context), reader)
    case 'list':
      return readList(field.item, counted ?? countToRead(field.count, name, message, context), reader, context)
    case 'rest':
      return readRest(field, reader)
    case 'each':
      return readEach(elementsAsked(field.of, context), (element) => {
        if (field.front !== undefined) decodeMessage(field.front, reader, element)
        return get(field.item, '', undefined, element.message, reader, undefined)
      })
    default:
      return field satisfies never
  }
}

function readInteger(field: IntegerField, reader: Reader): number {
  const read = reader.uint(WIDTH[field.kind])
  const said = field.bcd === true ? (fromBcd(read) ?? reader.fail('BAD_FIELD', 'a digit is not 0 to 9')) : read
  const number = said === 0 && field.zeroMeans !== undefined ? field.zeroMeans : said
  const [min, max] = boundsOf(field)
  if (number < min || number > max) reader.fail('BAD_FIELD', `${number} is not within ${min} to ${max}`)
  if (!isMultiple(field, number)) reader.fail('BAD_FIELD', `${number} is no multiple of ${field.multipleOf}`)
  if (field.oneOf?.includes(number) === false)
    reader.fail('BAD_FIELD', `${number} is not one of ${field.oneOf.join(', ')}`)
  return number
}

function readCount(field: CountField, reader: Reader, context: Context | undefined): number {
  const read = reader.uint(field.width)
  if (read === field.noneToo) return 0
  const count = read === 0 && field.zeroMeans !== undefined ? field.zeroMeans : read
  if (count < (field.min ?? 0) || count > (field.max ?? count)) {
    reader.fail('BAD_FIELD', `${count} ${field.of}, must be ${field.min ?? 0} to ${field.max ?? 'the width'}`)
  }
  if (!isMultiple(field, count)) {
    reader.fail('BAD_FIELD', `${count} ${field.of}, must be a multiple of ${field.multipleOf}`)
  }
  const most = mostAsked(field, context)
  if (count > most) reader.fail('BAD_FIELD', `${count} ${field.of}, asked were no more than ${most}`)
  return count
}

function readFixed(field: Extract<Field, { kind: 'fixed' }>, name: string, reader: Reader): void {
  if (!standsIn(field, reader)) return
  const { ascii } = field
  if (reader.ascii && ascii !== undefined) {
    const characters = reader.text(ascii.length)
    if (characters !== ascii) reader.fail('BAD_FIELD', `${name} is fixed to "${ascii}", found others`)
    return
  }
  const found = reader.uint(field.width)
  if (found !== field.value) reader.fail('BAD_FIELD', `${name} is fixed to ${field.value}, found ${found}`)
}

function readSpare(size: number, reader: Reader): void {
  if (reader.ascii) reader.text(2 * size)
  else reader.bytes(size)
}

function readEcho(of: string, name: string, reader: Reader, context: Context | undefined): void {
  const { shape, message } = asked(context)
  const field = shape[of] as Field
  const found =
    field.kind === 'count'
      ? readCount(field, reader, undefined)
      : get(field as VisibleField, of, undefined, {}, reader, undefined)
  if (!same(found, sentIn(field, of, message))) reader.fail('ECHO_MISMATCH', `${name} does not repeat the request`)
}

function readRepeat(
  { of, item }: Extract<Field, { kind: 'repeat' }>,
  reader: Reader,
  context: Context | undefined,
): void {
  readEach(elementsAsked(of, context), (element) => decodeMessage(item, reader, element))
}

/** All that is left, but no more than may be: what follows then belongs to something else. */
function readRest({ min, max }: RestField, reader: Reader): Buffer {
  const left = reader.ascii ? reader.remaining >> 1 : reader.remaining
  return reader.bytes(Math.min(Math.max(left, min), max))
}

/** What the request said, also where it said it by leaving the field out. */
function sentIn(field: Field, name: string, message: Message): unknown {
  if (field.kind === 'count') return lengthOf(message[field.of], field.of)
  return message[name] ?? ('default' in field ? field.default : undefined)
}

/** Equality of plain data. */
function same(a: unknown, b: unknown): boolean {
  if (a === b) return true
  if (typeof a !== 'object' || typeof b !== 'object' || a === null || b === null) return false
  const names = new Set([...Object.keys(a), ...Object.keys(b)])
  for (const name of names) if (!same((a as Message)[name], (b as Message)[name])) return false
  return true
}

function readText(field: Extract<Field, { kind: 'text' }>, count: number, reader: Reader): string {
  const read = field.digits === true ? reader.bytes(count).toString('latin1') : reader.text(count)
  const allowed = notInCharset(field.charset, read)
  if (allowed !== undefined) reader.fail('BAD_FIELD', `a character other than ${allowed}`)
  return read
}

function readList(item: Shape, count: number, reader: Reader, context: Context | undefined): Message[] {
  return readEach({ length: count }, () => decodeMessage(item, reader, context))
}

function readEach<E, T>(elements: ArrayLike<E>, read: (element: E) => T): T[] {
  const values: T[] = []
  try {
    while (values.length < elements.length) values.push(read(elements[values.length] as E))
  } catch (error) {
    throw located(String(values.length), error)
  }
  return values
}
