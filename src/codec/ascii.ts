import { hex } from '../basics/hex'
import type { Reader, Width, Writer } from './cursor'
import { failAt, Input, Output, refuseElement } from './cursor'

export const DIGITS = Buffer.from('0123456789ABCDEF', 'latin1')

const LOWER_CASE_DIGITS = Buffer.from('0123456789abcdef', 'latin1')

/**
 * Value of a hexadecimal digit by its character code, -1 for any other character. The manuals have upper case only, and
 * only that is written; peers exist that send lower case, and what it means is certain.
 */
export const VALUE = new Int8Array(256).fill(-1)
for (const digits of [DIGITS, LOWER_CASE_DIGITS]) for (const [i, digit] of digits.entries()) VALUE[digit] = i

/** ASCII code: numbers as upper-case hexadecimal digits, high digit first; bits one character each. */
export class AsciiWriter extends Output implements Writer {
  readonly ascii = true

  uint(value: number, width: Width): void {
    const size = width * 2
    const start = this.reserve(size)
    const buffer = this.buffer
    let rest = value
    for (let i = size - 1; i >= 0; i--) {
      buffer[start + i] = DIGITS[rest & 15] as number
      rest >>>= 4
    }
  }

  words(values: ArrayLike<number>): void {
    let at = this.reserve(values.length * 4)
    const buffer = this.buffer
    for (let i = 0; i < values.length; i++, at += 4) {
      const word = values[i] as number
      if (typeof word !== 'number' || (word & 0xffff) !== word) refuseElement(i, word, 'a word is 0 to 65535')
      buffer[at] = DIGITS[word >>> 12] as number
      buffer[at + 1] = DIGITS[(word >>> 8) & 15] as number
      buffer[at + 2] = DIGITS[(word >>> 4) & 15] as number
      buffer[at + 3] = DIGITS[word & 15] as number
    }
  }

  doubleWords(values: ArrayLike<number>): void {
    for (let i = 0; i < values.length; i++) {
      const value = values[i] as number
      if (typeof value !== 'number' || value >>> 0 !== value)
        refuseElement(i, value, 'a double word is 0 to 4294967295')
      this.uint(value, 4)
    }
  }

  bits(values: ArrayLike<boolean>): void {
    let at = this.reserve(values.length)
    const buffer = this.buffer
    for (let i = 0; i < values.length; i++) buffer[at++] = values[i] === true ? 0x31 : 0x30
  }

  bytes(values: ArrayLike<number>): void {
    for (let i = 0; i < values.length; i++) {
      const byte = values[i] as number
      if (typeof byte !== 'number' || (byte & 0xff) !== byte) refuseElement(i, byte, 'a byte is 0 to 255')
      this.uint(byte, 1)
    }
  }
}

/** ASCII code, read. */
export class AsciiReader extends Input implements Reader {
  readonly ascii = true

  uint(width: Width): number {
    const size = width * 2
    const start = this.need(size)
    const buffer = this.buffer
    let value = 0
    for (let i = 0; i < size; i++) {
      const digit = VALUE[buffer[start + i] as number] as number
      if (digit < 0) this.#badDigit(start + i)
      value = value * 16 + digit
    }
    return value
  }

  words(count: number): number[] {
    let at = this.need(count * 4)
    const buffer = this.buffer
    const values = new Array<number>(count)
    let i = 0
    // Four in each turn of the loop, as in binary code; and one check for all their digits.
    for (; i + 4 <= count; i += 4, at += 16) {
      const word = wordAt(buffer, at)
      const second = wordAt(buffer, at + 4)
      const third = wordAt(buffer, at + 8)
      const fourth = wordAt(buffer, at + 12)
      if ((word | second | third | fourth) < 0) this.#badDigitFrom(at)
      values[i] = word
      values[i + 1] = second
      values[i + 2] = third
      values[i + 3] = fourth
    }
    for (; i < count; i++, at += 4) {
      const word = wordAt(buffer, at)
      if (word < 0) this.#badDigitFrom(at)
      values[i] = word
    }
    return values
  }

  doubleWords(count: number): number[] {
    // Before the array is made: a wrong count must not cost memory.
    if (count * 8 > this.remaining) this.need(count * 8)
    const values = new Array<number>(count)
    for (let i = 0; i < count; i++) values[i] = this.uint(4)
    return values
  }

  bits(count: number): boolean[] {
    let at = this.need(count)
    const buffer = this.buffer
    const values = new Array<boolean>(count)
    for (let i = 0; i < count; i++, at++) {
      const character = buffer[at] as number
      if (character !== 0x30 && character !== 0x31)
        failAt('BAD_FIELD', at, buffer, `a bit is 0 or 1, found ${show(character)}`)
      values[i] = character === 0x31
    }
    return values
  }

  bytes(count: number): Buffer {
    if (count * 2 > this.remaining) this.need(count * 2)
    const values = Buffer.allocUnsafe(count)
    for (let i = 0; i < count; i++) values[i] = this.uint(1)
    return values
  }

  #badDigitFrom(start: number): never {
    let at = start
    while ((VALUE[this.buffer[at] as number] as number) >= 0) at++
    return this.#badDigit(at)
  }

  #badDigit(at: number): never {
    return failAt(
      'BAD_DIGIT',
      at,
      this.buffer,
      `${show(this.buffer[at] as number)} is not a hexadecimal digit 0-9, A-F`,
    )
  }
}

/** A single wrong digit is -1 and makes the whole word negative. */
function wordAt(buffer: Buffer, at: number): number {
  return (
    ((VALUE[buffer[at] as number] as number) << 12) |
    ((VALUE[buffer[at + 1] as number] as number) << 8) |
    ((VALUE[buffer[at + 2] as number] as number) << 4) |
    (VALUE[buffer[at + 3] as number] as number)
  )
}

function show(character: number): string {
  const code = hex(character, 2)
  return character > 0x20 && character < 0x7f ? `"${String.fromCharCode(character)}" (${code}H)` : `${code}H`
}
