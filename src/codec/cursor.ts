import type { ProtocolErrorCode } from '../errors'
import { ProtocolError, RequestError } from '../errors'

/** Width of an integer field in bytes (in ASCII code twice as many characters). */
export type Width = 1 | 2 | 3 | 4

/**
 * Writes the fields of one body, in one of the two data codes.
 * `form` is opaque here: the protocol's value codecs give its bits a meaning (MELSEC: the subcommand's device form).
 */
export interface Writer {
  readonly ascii: boolean
  form: number
  /** Unsigned integer: binary low byte first; ASCII upper-case hexadecimal digits, high digit first. */
  uint(value: number, width: Width): void
  /** 16-bit words, 0..65535 each. */
  words(values: ArrayLike<number>): void
  /** 32-bit double words, 0..4294967295 each. */
  doubleWords(values: ArrayLike<number>): void
  /** Bits: binary one nibble each, first in the high nibble, odd count padded with 0; ASCII one character `0`/`1` each. */
  bits(values: ArrayLike<boolean>): void
  /** Bytes, 0..255 each; ASCII two hexadecimal digits each. */
  bytes(values: ArrayLike<number>): void
  /** Characters U+0000..U+00FF, one byte each in both codes. */
  text(value: string): void
  /** What was written; the writer is empty afterwards. */
  take(): Buffer
}

/** Reads the fields of one body. Every method throws `ProtocolError` when the bytes do not hold what was asked for. */
export interface Reader {
  readonly ascii: boolean
  readonly form: number
  readonly position: number
  readonly remaining: number
  uint(width: Width): number
  words(count: number): number[]
  doubleWords(count: number): number[]
  bits(count: number): boolean[]
  bytes(count: number): Buffer
  text(count: number): string
  /** Throws a `ProtocolError` that points at the current position. */
  fail(code: ProtocolErrorCode, message: string): never
  /** Throws unless everything was read. */
  end(): void
}

/** The escape hatch: a value whose two codes differ in more than width, e.g. a device address. */
export interface ValueCodec<T> {
  readonly name: string
  /** What a message takes for it, in words; without it the name stands for it. */
  readonly takes?: string
  /** A value that an example of a message may hold. */
  readonly example?: T
  /** The size is in the value and in nothing that stands before it: `size` needs the value. */
  readonly variable?: true
  /** A password: never shown in traces and explanations. */
  readonly secret?: true
  /** Throws `RequestError` when the value cannot be said in this form. */
  write(writer: Writer, value: T): void
  read(reader: Reader): T
  /** Bytes on the wire. `value` is given when it is known; a codec of fixed size ignores it. */
  size(ascii: boolean, form: number, value?: T): number
}

/** Growing output buffer. One per encoder, never shared between encoders, empty again after `take()`. */
export abstract class Output {
  protected buffer: Buffer = Buffer.allocUnsafe(256)
  protected length = 0
  form = 0

  /** Makes room for `size` bytes and returns where they start. The buffer may be replaced: read it afterwards. */
  protected reserve(size: number): number {
    const start = this.length
    const end = start + size
    if (end > this.buffer.length) {
      const grown = Buffer.allocUnsafeSlow(Math.max(this.buffer.length * 2, end))
      this.buffer.copy(grown, 0, 0, start)
      this.buffer = grown
    }
    this.length = end
    return start
  }

  text(value: string): void {
    let at = this.reserve(value.length)
    const buffer = this.buffer
    for (let i = 0; i < value.length; i++) {
      const character = value.charCodeAt(i)
      if (character > 0xff) badMessage(`character ${i} (${value[i]}) is not a one-byte character`)
      buffer[at++] = character
    }
  }

  take(): Buffer {
    const taken = Buffer.from(this.buffer.subarray(0, this.length))
    this.length = 0
    return taken
  }

  /** Forgets what was written: after an error in the middle of a message. */
  clear(): void {
    this.length = 0
  }
}

/** Bounds-checked input over bytes that stay the caller's. */
export abstract class Input {
  #position = 0

  constructor(
    protected readonly buffer: Buffer,
    readonly form: number,
  ) {}

  get position(): number {
    return this.#position
  }

  get remaining(): number {
    return this.buffer.length - this.#position
  }

  protected need(size: number): number {
    const start = this.#position
    if (size > this.buffer.length - start) {
      this.fail('TRUNCATED', `needs ${size} more byte(s), has ${this.buffer.length - start}`)
    }
    this.#position = start + size
    return start
  }

  fail(code: ProtocolErrorCode, message: string): never {
    return failAt(code, this.#position, this.buffer, message)
  }

  text(count: number): string {
    const start = this.need(count)
    return this.buffer.toString('latin1', start, start + count)
  }

  end(): void {
    if (this.remaining > 0) this.fail('TRAILING', `${this.remaining} byte(s) left over`)
  }
}

const SHOWN_BYTES = 64

/** How the message of a reading error begins. */
export function placeText(offset: number, field?: string): string {
  return `Received data is wrong at byte ${offset}${field === undefined ? '' : ` (${field})`}: `
}

/** Throws the `ProtocolError` for bytes that are wrong at `offset`. */
export function failAt(code: ProtocolErrorCode, offset: number, bytes: Buffer, message: string): never {
  const shown = bytes.subarray(0, SHOWN_BYTES)
  throw new ProtocolError(code, `${placeText(offset)}${message}.`, { offset, bytes: shown })
}

/** Throws the `RequestError` for a message value that no frame can carry. */
export function badMessage(message: string): never {
  throw new RequestError('BAD_MESSAGE', message)
}

/** Throws the `RequestError` for an element of a bulk field; it may be of any type, BigInt and text included. */
export function refuseElement(i: number, found: unknown, expected: string): never {
  return badMessage(`element ${i} is ${typeof found === 'number' ? found : `a ${typeof found}`}; ${expected}`)
}
