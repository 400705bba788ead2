/** Damages bytes in place, in one buffer that is made once: a million frames cost no memory. */
import type { Random } from './random'

const SIZE = 1 << 17
/** Longer than any frame may become before more is added. */
const LAST = SIZE - (1 << 16)
const BYTES = [0, 1, 2, 3, 0x10, 0x7f, 0x80, 0xfe, 0xff, 0x30, 0x31, 0x46, 0x66, 0x20, 0x2a, 0x40]
const DIGITS = Buffer.from('0123456789ABCDEF', 'latin1')
/** Numbers that counts and lengths lie with. */
const NUMBERS = [0, 1, 2, 0x7f, 0x80, 0xff, 0x100, 0x3ff, 0x7fff, 0x8000, 0xfffe, 0xffff, 0x7fffffff, 0xffffffff]

export class Damage {
  readonly #buffer = Buffer.allocUnsafeSlow(SIZE)
  readonly #random: Random
  readonly #ascii: boolean
  #length = 0

  constructor(random: Random, ascii: boolean) {
    this.#random = random
    this.#ascii = ascii
  }

  /** What there is now. The next call changes these bytes: whoever keeps them must copy them. */
  get bytes(): Buffer {
    return this.#buffer.subarray(0, this.#length)
  }

  /** Starts with a copy of `bytes`. */
  load(bytes: Uint8Array): this {
    this.#buffer.set(bytes, 0)
    this.#length = bytes.length
    return this
  }

  /** Starts with bytes that mean nothing; mostly few, sometimes more than a frame may have. */
  loadAny(): this {
    const random = this.#random
    this.#length = random.oneIn(2000) ? 60_000 + random.below(10_000) : random.below(random.oneIn(8) ? 600 : 60)
    for (let i = 0; i < this.#length; i++) this.#buffer[i] = this.#any()
    return this
  }

  /** One to three of the damages. `other`: bytes of which a part may come in. */
  times(other: Uint8Array): this {
    for (let left = 1 + this.#random.below(3); left > 0; left--) this.#once(other)
    return this
  }

  #any(): number {
    const random = this.#random
    return this.#ascii && !random.oneIn(8) ? (DIGITS[random.below(16)] ?? 0) : random.below(256)
  }

  #once(other: Uint8Array): void {
    const random = this.#random
    const way = random.below(10)
    if (way === 0) this.#flip(1 + random.below(8))
    else if (way === 1) this.#overwrite(1 + random.below(4))
    else if (way === 2) this.#length = random.below(this.#length + 1)
    else if (way === 3) this.#insert(1 + random.below(random.oneIn(16) ? 3000 : 8))
    else if (way === 4) this.#remove(1 + random.below(8))
    else if (way === 5) this.#splice(other)
    else if (way === 6) this.#append(other)
    else if (way === 7) this.#repeat()
    else this.#number()
  }

  #flip(times: number): void {
    for (let i = 0; i < times && this.#length > 0; i++) {
      const at = this.#random.below(this.#length)
      this.#buffer[at] = (this.#buffer[at] ?? 0) ^ (1 << this.#random.below(8))
    }
  }

  #overwrite(times: number): void {
    for (let i = 0; i < times && this.#length > 0; i++)
      this.#buffer[this.#random.below(this.#length)] = this.#random.oneIn(2) ? this.#random.pick(BYTES) : this.#any()
  }

  #insert(count: number): void {
    if (this.#length + count > LAST) return
    const at = this.#random.below(this.#length + 1)
    this.#buffer.copyWithin(at + count, at, this.#length)
    for (let i = 0; i < count; i++) this.#buffer[at + i] = this.#any()
    this.#length += count
  }

  #remove(count: number): void {
    const at = this.#random.below(this.#length + 1)
    const gone = Math.min(count, this.#length - at)
    this.#buffer.copyWithin(at, at + gone, this.#length)
    this.#length -= gone
  }

  /** A number over whatever stands there: lengths, counts, points, addresses. */
  #number(): void {
    const random = this.#random
    const width = 1 << random.below(3)
    const size = this.#ascii ? 2 * width : width
    if (this.#length < size) return
    const at = random.below(random.oneIn(2) ? Math.min(40, this.#length - size + 1) : this.#length - size + 1)
    let number = random.oneIn(4) ? random.next() : random.pick(NUMBERS)
    for (let i = 0; i < size; i++) {
      if (this.#ascii) {
        this.#buffer[at + size - 1 - i] = DIGITS[number & 15] ?? 0
        number >>>= 4
      } else {
        this.#buffer[at + i] = number & 0xff
        number >>>= 8
      }
    }
  }

  /** The beginning of this and the end of the other. */
  #splice(other: Uint8Array): void {
    const at = this.#random.below(this.#length + 1)
    const from = this.#random.below(other.length + 1)
    this.#put(at, other.subarray(from))
  }

  #append(other: Uint8Array): void {
    this.#put(this.#length, other)
  }

  #put(at: number, bytes: Uint8Array): void {
    if (at + bytes.length > LAST) return
    this.#buffer.set(bytes, at)
    this.#length = at + bytes.length
  }

  /** A piece twice. */
  #repeat(): void {
    if (this.#length === 0) return
    const from = this.#random.below(this.#length)
    const count = 1 + this.#random.below(this.#length - from)
    if (this.#length + count > LAST) return
    this.#buffer.copyWithin(from + count, from, this.#length)
    this.#length += count
  }
}
