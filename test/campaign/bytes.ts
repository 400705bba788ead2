/**
 * Numbers on the wire, by hand: nothing here comes from src. Binary code sends the low byte first; ASCII code sends
 * upper-case hexadecimal digits, the highest first (SLMP reference manual 4.1).
 */
export type Code = 'binary' | 'ascii'

/** Bytes that are no request of the campaign's manual. */
export class NotUnderstood extends Error {}

export class Reader {
  #at = 0

  constructor(
    readonly bytes: Buffer,
    readonly code: Code,
  ) {}

  get left(): number {
    return this.bytes.length - this.#at
  }

  /** A field of so many bytes, of twice as many digits in ASCII code. */
  number(size: number): number {
    if (this.code === 'binary') return this.raw(size).readUIntLE(0, size)
    const digits = this.text(2 * size)
    if (!/^[0-9A-F]+$/.test(digits)) throw new NotUnderstood(`${digits} are no upper-case hexadecimal digits`)
    return Number.parseInt(digits, 16)
  }

  text(length: number): string {
    return this.raw(length).toString('latin1')
  }

  raw(length: number): Buffer {
    if (length > this.left) throw new NotUnderstood(`${length} bytes wanted at ${this.#at}, ${this.left} are left`)
    this.#at += length
    return this.bytes.subarray(this.#at - length, this.#at)
  }

  rest(): Buffer {
    return this.raw(this.left)
  }
}

export class Writer {
  readonly #parts: Buffer[] = []

  constructor(readonly code: Code) {}

  number(value: number, size: number): this {
    const part = Buffer.alloc(size)
    part.writeUIntLE(value, 0, size)
    return this.raw(this.code === 'binary' ? part : digits(value, 2 * size))
  }

  text(text: string): this {
    return this.raw(Buffer.from(text, 'latin1'))
  }

  raw(bytes: Buffer): this {
    this.#parts.push(bytes)
    return this
  }

  done(): Buffer {
    return Buffer.concat(this.#parts)
  }
}

function digits(value: number, count: number): Buffer {
  return Buffer.from(value.toString(16).toUpperCase().padStart(count, '0'), 'latin1')
}
