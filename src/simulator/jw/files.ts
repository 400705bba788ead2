// The files of a simulated JW: 64 KB each at most, those of a JW300 from 01 on the pages of its file registers.
import { hex } from '../../basics/hex'
import { octal } from '../../basics/octal'
import { FILE_REGISTERS, type JwAddress, PAGE } from '../../jw/address'
import { Refusal } from '../refusal'
import { result } from './result'

/** Bytes in a row within one file. */
interface Piece {
  readonly file: number
  readonly from: number
  readonly length: number
}

export class Files {
  readonly #sizes: ReadonlyMap<number, number>
  /** Files that somebody has written to. */
  readonly #written = new Map<number, Buffer>()

  /** @param sizes bytes of each file, by the number of its basic form */
  constructor(sizes: ReadonlyMap<number, number>) {
    this.#sizes = sizes
  }

  /** @throws Refusal behind the end of a file, and for files that are not there */
  read(head: JwAddress, length: number): Buffer {
    const pieces = this.#pieces(head, length)
    return Buffer.concat(
      pieces.map(({ file, from, length: count }) => {
        return this.#written.get(file)?.subarray(from, from + count) ?? Buffer.alloc(count)
      }),
    )
  }

  byte(address: JwAddress): number {
    return this.read(address, 1)[0] ?? 0
  }

  /** All of it or nothing. @throws Refusal */
  write(head: JwAddress, bytes: Uint8Array): void {
    let at = 0
    for (const { file, from, length } of this.#pieces(head, bytes.length)) {
      this.#bytesOf(file).set(bytes.subarray(at, at + length), from)
      at += length
    }
  }

  /** @throws Refusal when not all of it is there */
  check(head: JwAddress, length: number): void {
    this.#pieces(head, length)
  }

  bit(address: JwAddress, bit: number): number {
    return (this.byte(address) >> bit) & 1
  }

  setBit(address: JwAddress, bit: number, on: boolean): void {
    const byte = this.byte(address)
    this.write(address, Uint8Array.of(on ? byte | (1 << bit) : byte & ~(1 << bit)))
  }

  #pieces({ file, address, extended }: JwAddress, length: number): readonly Piece[] {
    if (extended !== true || file !== FILE_REGISTERS) return [this.#piece(file, address, length)]
    const pieces: Piece[] = []
    // The pages follow one another.
    for (let at = address; at < address + length; ) {
      const from = at % PAGE
      const count = Math.min(PAGE - from, address + length - at)
      pieces.push(this.#piece(FILE_REGISTERS + Math.floor(at / PAGE), from, count))
      at += count
    }
    return pieces
  }

  #piece(file: number, from: number, length: number): Piece {
    const size = this.#sizes.get(file)
    if (size === undefined) throw new Refusal(result.capacity, `there is no file ${hex(file, 2)}H`)
    if (from + length <= size) return { file, from, length }
    const last = octal(size - 1, 6)
    throw new Refusal(
      result.capacity,
      `${length} byte(s) from ${octal(from, 6)} on: file ${hex(file, 2)}H ends at ${last}`,
    )
  }

  #bytesOf(file: number): Buffer {
    const bytes = this.#written.get(file) ?? Buffer.alloc(this.#sizes.get(file) ?? 0)
    this.#written.set(file, bytes)
    return bytes
  }
}
