// A decoder that tells where each value stands: rows for traces and the frame decoder, from the same declarations.
import { hex } from '../basics/hex'
import { ProtocolError } from '../errors'
import { type Context, countToRead, elementsAsked, sizeIn } from './count'
import { placeText, type Reader } from './cursor'
import { type DataCode, readerOf } from './data-code'
import { type Count, type CountField, type EachField, type Field, type Message, type Shape, standsIn } from './field'
import { decode } from './layout'

/** One field of a message, with its bytes. The rows of a message cover every byte exactly once, in order. */
export interface AnnotatedRow {
  /** First byte. */
  readonly offset: number
  /** Bytes; 0 for a list of values that has none. */
  readonly length: number
  /** Path of the field in the message, e.g. `words.0.device`. */
  readonly name: string
  /** Kind of the field, of a value codec its name. */
  readonly kind: string
  /** As it is decoded; of a secret asterisks. */
  readonly value: unknown
  /** The bytes as people read them: hexadecimal in binary code, characters in ASCII code; of a secret asterisks. */
  readonly bytes: string
  /** The value in words. */
  readonly text: string
  /** The bytes are a secret (a password) and must not be shown elsewhere either. */
  readonly secret?: true
}

/** Where reading ended because the bytes are not what the shape says. */
export interface FrameFault {
  /** Byte that is wrong, or the first that is missing. */
  readonly offset: number
  /** What is wrong, as a sentence without its place. */
  readonly message: string
  /** Path of the field, when it is in one. */
  readonly name?: string
}

/** A leaf of a message, for whoever puts it into words. */
export interface Leaf {
  readonly name: string
  readonly field: Field
  readonly value: unknown
}

export interface AnnotateOptions {
  readonly code: DataCode
  /** Form of the value codecs. */
  readonly form?: number
  /** The request, when a response is read. */
  readonly context?: Context
  /** Offset of the first byte in what the reader of the rows sees. */
  readonly base?: number
  /** Words for a value; `undefined` leaves it to the plain ones. */
  readonly describe?: (leaf: Leaf) => string | undefined
}

export interface Annotation {
  readonly rows: readonly AnnotatedRow[]
  /** The message as `decode` gives it; with a fault only what stands before it. Secrets are not masked here. */
  readonly message: Message
  /** Bytes that were read. */
  readonly used: number
  /** What a receiver refuses although it can be read, as sentences. */
  readonly notes: readonly string[]
  readonly fault?: FrameFault
}

/** What stands in place of a secret value, however long it is. */
export const MASK = '********'

/**
 * Reads `bytes` as `shape` says, as far as they are right.
 * Bytes behind the message are left alone: see `used`.
 * @throws TypeError when a response refers to its request and no `context` is given.
 * @example annotate(commands.readWords.request, body, { code: 'binary' }).rows.map(({ name, text }) => `${name}: ${text}`)
 */
export function annotate(shape: Shape, bytes: Buffer, options: AnnotateOptions): Annotation {
  const walk = new Walk(bytes, options)
  const message: MessageSoFar = {}
  try {
    walk.shape(shape, message, '')
    return { rows: walk.rows, message, used: walk.position, notes: walk.notes }
  } catch (error) {
    if (!(error instanceof ProtocolError)) throw error
    const fault = { ...faultOf(error, options.base ?? 0), name: walk.at }
    return { rows: walk.rows, message, used: walk.done, notes: walk.notes, fault }
  }
}

/** Place and reason of a reading error; `base` is where its bytes begin. */
export function faultOf(error: ProtocolError, base: number): FrameFault {
  const { offset = 0, message, field } = error
  const place = placeText(offset, field)
  const reason = message.startsWith(place) ? message.slice(place.length) : message
  return { offset: base + offset, message: reason.replace(/\.$/, '') }
}

/** What has been read of a message. */
type MessageSoFar = Record<string, unknown>

class Walk {
  readonly rows: AnnotatedRow[] = []
  readonly notes: string[] = []
  readonly #bytes: Buffer
  readonly #reader: Reader
  readonly #options: AnnotateOptions
  /** The request, or the element of it that is being repeated. */
  #context: Context | undefined
  /** Path of the field that is being read. */
  at = ''
  /** Bytes the finished rows cover. */
  done = 0

  constructor(bytes: Buffer, options: AnnotateOptions) {
    this.#bytes = bytes
    this.#reader = readerOf(options.code, bytes, options.form)
    this.#options = options
    this.#context = options.context
  }

  get position(): number {
    return this.#reader.position
  }

  /** Reads into `message`, so that what was read is there when a later field is wrong. */
  shape(shape: Shape, message: MessageSoFar, path: string): void {
    // Derived counts are invisible in the message: they are kept by the name of what they count, as `decode` does.
    const counts: Record<string, number> = {}
    for (const [name, field] of Object.entries(shape)) {
      this.at = `${path}${name}`
      if (field.kind === 'count') counts[field.of] = Number(this.#leaf(this.at, field))
      else this.#field(name, field, message, counts[name])
    }
  }

  #field(name: string, field: Exclude<Field, CountField>, message: MessageSoFar, counted: number | undefined): void {
    const path = this.at
    const count = (of: { readonly count: Count }) => counted ?? countToRead(of.count, name, message, this.#context)
    switch (field.kind) {
      case 'u8':
      case 'u16':
      case 'u32':
      case 'value':
      case 'rest':
        message[name] = this.#leaf(path, field)
        return
      case 'fixed':
        if (!standsIn(field, this.#reader)) return
        this.#leaf(path, field)
        return
      case 'spare':
      case 'echo':
        this.#leaf(path, field)
        return
      case 'words':
      case 'doubleWords':
      case 'bits':
      case 'bytes':
      case 'text':
        message[name] = this.#leaf(path, { ...field, count: count(field) })
        return
      case 'list':
        this.#list(name, field, count(field), message)
        return
      case 'each':
        this.#each(name, field, message)
        return
      case 'repeat':
        this.#repeat(field.of, field.item)
        return
      default:
        field satisfies never
    }
  }

  #list(name: string, field: Extract<Field, { kind: 'list' }>, count: number, message: MessageSoFar): void {
    const path = this.at
    const elements: Message[] = []
    message[name] = elements
    for (let i = 0; i < count; i++) {
      const element: MessageSoFar = {}
      elements.push(element)
      this.shape(field.item, element, `${path}.${i}.`)
    }
  }

  #each(name: string, { of, item, front = {} }: EachField, message: MessageSoFar): void {
    const path = this.at
    const parts: unknown[] = []
    message[name] = parts
    for (const [i, element] of elementsAsked(of, this.#context).entries()) {
      this.#around(element, front, `${path}.${i}.`)
      this.at = `${path}.${i}`
      const counted =
        'count' in item ? { ...item, count: countToRead(item.count, '', element.message, undefined) } : item
      parts.push(this.#leaf(this.at, counted))
    }
  }

  #repeat(of: string, item: Shape): void {
    const path = this.at
    for (const [i, element] of elementsAsked(of, this.#context).entries()) this.#around(element, item, `${path}.${i}.`)
  }

  /** Reads what repeats an element of the request. */
  #around(element: Context, shape: Shape, path: string): void {
    const whole = this.#context
    this.#context = element
    this.shape(shape, {}, path)
    this.#context = whole
  }

  /** Reads one field with the decoder itself, so that its checks hold here too. */
  #leaf(name: string, field: Exclude<Field, { kind: 'list' | 'each' | 'repeat' }>): unknown {
    const context = this.#context
    const value = this.#value(name.slice(name.lastIndexOf('.') + 1), withoutMultiple(field))
    this.#checkMultiple(name, field, value)
    const secret = isSecret(field, context)
    const shown = secret ? MASK : value
    const from = this.done
    this.done = this.#reader.position
    const bytes = this.#bytes.subarray(from, this.done)
    this.rows.push({
      offset: from + (this.#options.base ?? 0),
      length: bytes.length,
      name,
      kind: field.kind === 'value' ? field.codec.name : field.kind,
      value: shown,
      bytes: showBytes(bytes, this.#options.code, secret),
      text: (secret ? undefined : this.#options.describe?.({ name, field, value })) ?? plainText(shown),
      ...(secret ? { secret } : {}),
    })
    return value
  }

  /** It says nothing about where the next field stands, so it is no end of reading. */
  #checkMultiple(name: string, field: Field, value: unknown): void {
    const { multipleOf } = 'multipleOf' in field ? field : {}
    if (multipleOf === undefined || Number(value) % multipleOf === 0) return
    this.notes.push(`${name} is ${Number(value)}, which is no multiple of ${multipleOf}: it is refused.`)
  }

  /** The value of a field, of a derived one too: `decode` checks those and keeps them to itself. */
  #value(name: string, field: Exclude<Field, { kind: 'list' | 'each' | 'repeat' }>): unknown {
    const { code } = this.#options
    const context = this.#context
    const start = this.#reader.position
    const { [name]: value } = decode<Shape>({ [name]: field }, this.#reader, context)
    switch (field.kind) {
      case 'fixed':
        return field.ascii ?? field.value
      case 'count': {
        const written = readerOf(code, this.#bytes.subarray(start)).uint(field.width)
        if (written === field.noneToo) return 0
        return written === 0 ? (field.zeroMeans ?? 0) : written
      }
      case 'echo':
        return repeated(field.of, context)
      default:
        return value
    }
  }
}

function withoutMultiple<F extends Field>(field: F): F {
  return 'multipleOf' in field ? { ...field, multipleOf: 1 } : field
}

/** What an echo repeats: it was found equal, so it is the request's. */
function repeated(of: string, context: Context | undefined): unknown {
  const field = context?.shape[of]
  return field?.kind === 'count' ? sizeIn(context?.message[field.of]) : context?.message[of]
}

function isSecret(field: Field, context: Context | undefined): boolean {
  if (field.kind === 'echo') {
    const original = context?.shape[field.of]
    return original !== undefined && isSecret(original, undefined)
  }
  return (field.kind === 'text' && field.secret === true) || (field.kind === 'value' && field.codec.secret === true)
}

/** Whether a shape has a secret anywhere. */
export function hasSecret(shape: Shape): boolean {
  return Object.values(shape).some((field) =>
    field.kind === 'list' ? hasSecret(field.item) : isSecret(field, undefined),
  )
}

/** The message with asterisks in place of its secrets, for logs and events. */
export function withoutSecrets(shape: Shape, message: Message): Record<string, unknown> {
  const entries = Object.entries(message).map(([name, value]): [string, unknown] => {
    const field = shape[name]
    if (field?.kind === 'list' && Array.isArray(value)) {
      return [name, value.map((item: Message) => withoutSecrets(field.item, item))]
    }
    return [name, field !== undefined && isSecret(field, undefined) ? MASK : value]
  })
  return Object.fromEntries(entries)
}

/** The bytes of a row as people read them; a secret leaves one pair or character of asterisks per byte. */
export function showBytes(bytes: Buffer, code: DataCode, secret = false): string {
  if (code === 'ascii')
    return secret ? '*'.repeat(bytes.length) : bytes.toString('latin1').replace(/[^\x20-\x7e]/g, '.')
  const pairs = Array.from(bytes, (byte) => (secret ? '**' : hex(byte, 2)))
  return pairs.join(' ')
}

/** A value in words that know no protocol. */
export function plainText(value: unknown): string {
  if (value === undefined) return 'spare, whatever it holds'
  if (value instanceof Uint8Array) return showBytes(Buffer.from(value), 'binary')
  if (Array.isArray(value)) return value.map(plainText).join(' ')
  if (typeof value === 'string') return value === MASK ? value : JSON.stringify(value)
  if (typeof value === 'boolean') return value ? '1' : '0'
  return typeof value === 'object' ? JSON.stringify(value) : String(value)
}
