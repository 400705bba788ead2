import { hex } from '../basics/hex'
import type { Reader, Width, Writer } from './cursor'
import { failAt, Input, Output, refuseElement } from './cursor'

/** Binary code: numbers low byte first, bits as nibbles. */
export class BinaryWriter extends Output implements Writer {
  readonly ascii = false

  uint(value: number, width: Width): void {
    let at = this.reserve(width)
    const buffer = this.buffer
    for (let i = 0; i < width; i++) buffer[at++] = value >>> (8 * i)
  }

  // The bulk loops index into the buffer directly: methods such as writeUInt16LE cost 2 to 4 times as much per value.
  words(values: ArrayLike<number>): void {
    let at = this.reserve(values.length * 2)
    const buffer = this.buffer
    for (let i = 0; i < values.length; i++) {
      const word = values[i] as number
      if (typeof word !== 'number' || (word & 0xffff) !== word) refuseElement(i, word, 'a word is 0 to 65535')
      buffer[at++] = word
      buffer[at++] = word >>> 8
    }
  }

  doubleWords(values: ArrayLike<number>): void {
    let at = this.reserve(values.length * 4)
    const buffer = this.buffer
    for (let i = 0; i < values.length; i++) {
      const value = values[i] as number
      if (typeof value !== 'number' || value >>> 0 !== value)
        refuseElement(i, value, 'a double word is 0 to 4294967295')
      buffer[at++] = value
      buffer[at++] = value >>> 8
      buffer[at++] = value >>> 16
      buffer[at++] = value >>> 24
    }
  }

  bits(values: ArrayLike<boolean>): void {
    const size = (values.length + 1) >> 1
    const start = this.reserve(size)
    const buffer = this.buffer
    for (let i = 0; i < size; i++) {
      buffer[start + i] = (values[2 * i] === true ? 0x10 : 0) | (values[2 * i + 1] === true ? 0x01 : 0)
    }
  }

  bytes(values: ArrayLike<number>): void {
    let at = this.reserve(values.length)
    const buffer = this.buffer
    for (let i = 0; i < values.length; i++) {
      const byte = values[i] as number
      if (typeof byte !== 'number' || (byte & 0xff) !== byte) refuseElement(i, byte, 'a byte is 0 to 255')
      buffer[at++] = byte
    }
  }
}

/** Binary code, read. */
export class BinaryReader extends Input implements Reader {
  readonly ascii = false

  uint(width: Width): number {
    const start = this.need(width)
    const buffer = this.buffer
    let value = 0
    for (let i = width - 1; i >= 0; i--) value = value * 256 + (buffer[start + i] as number)
    return value
  }

  words(count: number): number[] {
    let at = this.need(count * 2)
    const buffer = this.buffer
    const values = new Array<number>(count)
    let i = 0
    // Four in each turn of the loop cost two thirds of what one would.
    for (; i + 4 <= count; i += 4, at += 8) {
      values[i] = wordAt(buffer, at)
      values[i + 1] = wordAt(buffer, at + 2)
      values[i + 2] = wordAt(buffer, at + 4)
      values[i + 3] = wordAt(buffer, at + 6)
    }
    for (; i < count; i++, at += 2) values[i] = wordAt(buffer, at)
    return values
  }

  doubleWords(count: number): number[] {
    let at = this.need(count * 4)
    const buffer = this.buffer
    const values = new Array<number>(count)
    for (let i = 0; i < count; i++, at += 4) {
      values[i] = wordAt(buffer, at + 2) * 0x10000 + wordAt(buffer, at)
    }
    return values
  }

  bits(count: number): boolean[] {
    const size = (count + 1) >> 1
    const start = this.need(size)
    const buffer = this.buffer
    const values = new Array<boolean>(count)
    for (let i = 0; i < size; i++) {
      const pair = buffer[start + i] as number
      if ((pair & 0xee) !== 0) failAt('BAD_FIELD', start + i, buffer, `a bit is 0 or 1, found ${hex(pair, 2)}`)
      values[2 * i] = (pair & 0x10) !== 0
      if (2 * i + 1 < count) values[2 * i + 1] = (pair & 1) !== 0
      // An odd count leaves the last low nibble unused; the manuals fix it to 0, so anything else is not our answer.
      else if ((pair & 1) !== 0) failAt('BAD_FIELD', start + i, buffer, 'the unused last nibble is not 0')
    }
    return values
  }

  bytes(count: number): Buffer {
    const start = this.need(count)
    return Buffer.from(this.buffer.subarray(start, start + count))
  }
}

function wordAt(buffer: Buffer, at: number): number {
  return (buffer[at] as number) | ((buffer[at + 1] as number) << 8)
}
