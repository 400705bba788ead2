// Ring buffers and specified buffers of a simulated JW (COM 28, 29, 38, 39, 68, 69, 78, 79). Their bytes are in the files.
import { Refusal } from '../refusal'
import type { Files } from './files'
import { result } from './result'

/** Where a buffer of a simulated JW is. */
export interface SimulatedBuffer {
  /** File, 00 to 80H, and first byte. */
  readonly file: number
  /** First byte in the file. */
  readonly address: number
  /** Bytes, 1 to 65535. */
  readonly length: number
  /** Default `indirect`. */
  readonly definition?: 'direct' | 'indirect'
}

/** Where a ring buffer of a simulated JW is. A byte of it stays free, so that full is not empty. */
export interface SimulatedRingBuffer extends SimulatedBuffer {
  /** 80H read, 81H write, from the client's side; it is reported and not enforced. Default `read`. */
  readonly direction?: 'read' | 'write'
}

export const DEFINITION = { none: 0, direct: 1, indirect: 2, invalid: 0x80 } as const
export const DIRECTION = { read: 0x80, write: 0x81 } as const

export interface Definition {
  readonly definition: number
  readonly file: number
  readonly address: number
  readonly length: number
}

export interface RingDefinition extends Definition {
  readonly direction: number
  readonly writePointer: number
  readonly readPointer: number
}

interface Ring extends Definition {
  readonly direction: number
  writePointer: number
  readPointer: number
}

/** Confirmed type: bytes that were read or written and not yet acknowledged. */
interface Unconfirmed {
  read: number
  written: number
}

const UNDEFINED: Definition = { definition: DEFINITION.none, file: 0, address: 0, length: 0 }
const UNDEFINED_RING: RingDefinition = { ...UNDEFINED, direction: 0, writePointer: 0, readPointer: 0 }

/** Function switch of 39H; that of 29H is taken to be the same. */
const FUN = { request: 1, acknowledge: 2, confirmed: 0x80 } as const

export class SpecifiedBuffers {
  readonly #files: Files
  readonly #defined = new Map<number, Definition>()

  constructor(files: Files) {
    this.#files = files
  }

  define(buffer: number, definition: Definition): void {
    this.#defined.set(buffer, checked(this.#files, definition))
  }

  information(buffer: number): Definition {
    return this.#defined.get(buffer) ?? UNDEFINED
  }

  read(buffer: number, offset: number, length: number): Buffer {
    return this.#files.read(this.#place(buffer, offset, length), length)
  }

  write(buffer: number, offset: number, data: Uint8Array): void {
    this.#files.write(this.#place(buffer, offset, data.length), data)
  }

  #place(buffer: number, offset: number, length: number): { readonly file: number; readonly address: number } {
    const found = this.information(buffer)
    if (found.definition === DEFINITION.none)
      throw new Refusal(result.bufferUndefined, `specified buffer ${buffer} is not defined`)
    if ((found.definition & DEFINITION.invalid) !== 0)
      throw new Refusal(result.bufferInvalid, `specified buffer ${buffer} is wrong`)
    if (offset + length > found.length)
      throw new Refusal(result.bufferOver, `specified buffer ${buffer} has ${found.length} bytes`)
    return { file: found.file, address: found.address + offset }
  }
}

/** What came out of a ring buffer. */
export interface TakenFromRing {
  readonly pointer: number
  readonly data: Buffer
  /** There are more that nobody has read. */
  readonly more: boolean
}

/** What became of a write to a ring buffer. */
export interface PutIntoRing {
  /** Write pointer before. */
  readonly pointer: number
  readonly written: number
  readonly free: number
}

export class RingBuffers {
  readonly #files: Files
  readonly #defined = new Map<number, Ring>()
  readonly #unconfirmed = new Map<number, Unconfirmed>()

  constructor(files: Files) {
    this.#files = files
  }

  define(buffer: number, definition: RingDefinition): void {
    this.#defined.set(buffer, checked(this.#files, { ...definition }))
    this.#unconfirmed.set(buffer, { read: 0, written: 0 })
  }

  information(buffer: number): RingDefinition {
    return this.#defined.get(buffer) ?? UNDEFINED_RING
  }

  /** Bytes that wait to be read. @throws Refusal */
  waiting(buffer: number): number {
    return used(this.#ring(buffer))
  }

  /**
   * Confirmed type: the read pointer moves when the answer is acknowledged, so that what was lost is read again.
   * @throws Refusal
   */
  take(buffer: number, most: number, functions: number = FUN.request): TakenFromRing {
    const ring = this.#ring(buffer)
    const unconfirmed = this.#unconfirmed.get(buffer) ?? { read: 0, written: 0 }
    if ((functions & FUN.acknowledge) !== 0) {
      ring.readPointer = (ring.readPointer + unconfirmed.read) % ring.length
      unconfirmed.read = 0
    }
    const pointer = ring.readPointer
    const count = (functions & FUN.request) === 0 ? 0 : Math.min(most, used(ring))
    const data = this.#bytes(ring, pointer, count)
    const more = used(ring) > count
    if ((functions & FUN.confirmed) !== 0) unconfirmed.read = count
    else ring.readPointer = (pointer + count) % ring.length
    return { pointer, data, more }
  }

  /** All of it or nothing. @throws Refusal */
  put(buffer: number, data: Uint8Array, functions: number = FUN.request): PutIntoRing {
    const ring = this.#ring(buffer)
    const unconfirmed = this.#unconfirmed.get(buffer) ?? { read: 0, written: 0 }
    if ((functions & FUN.acknowledge) !== 0) {
      ring.writePointer = (ring.writePointer + unconfirmed.written) % ring.length
      unconfirmed.written = 0
    }
    const pointer = ring.writePointer
    const free = ring.length - 1 - used(ring)
    const bytes = (functions & FUN.request) === 0 ? data.subarray(0, 0) : data
    if (bytes.length > ring.length - 1)
      throw new Refusal(result.ringOver, `ring buffer ${buffer} has ${ring.length} bytes`)
    if (bytes.length > free) throw new Refusal(result.ringFull, `ring buffer ${buffer} has room for ${free}`)
    this.#store(ring, pointer, bytes)
    if ((functions & FUN.confirmed) !== 0) unconfirmed.written = bytes.length
    else ring.writePointer = (pointer + bytes.length) % ring.length
    return { pointer, written: bytes.length, free: free - bytes.length }
  }

  #ring(buffer: number): Ring {
    const ring = this.#defined.get(buffer)
    if (ring === undefined) throw new Refusal(result.ringUndefined, `ring buffer ${buffer} is not defined`)
    if ((ring.definition & DEFINITION.invalid) !== 0)
      throw new Refusal(result.ringInvalid, `ring buffer ${buffer} is wrong`)
    if (ring.readPointer < ring.length && ring.writePointer < ring.length) return ring
    throw new Refusal(result.ringPointer, `a pointer of ring buffer ${buffer} is outside of it`)
  }

  #bytes({ file, address, length }: Ring, from: number, count: number): Buffer {
    const first = Math.min(count, length - from)
    return Buffer.concat([
      this.#files.read({ file, address: address + from }, first),
      this.#files.read({ file, address }, count - first),
    ])
  }

  #store({ file, address, length }: Ring, from: number, bytes: Uint8Array): void {
    const first = Math.min(bytes.length, length - from)
    this.#files.write({ file, address: address + from }, bytes.subarray(0, first))
    this.#files.write({ file, address }, bytes.subarray(first))
  }
}

function used({ writePointer, readPointer, length }: Ring): number {
  return (writePointer - readPointer + length) % length
}

/** A definition of memory that is not there is kept and marked as wrong, as 68H and 69H say it. */
function checked<D extends Definition>(files: Files, given: D): D {
  try {
    files.check(given, given.length)
    if (given.length > 0) return given
  } catch (error) {
    if (!(error instanceof Refusal)) throw error
  }
  return { ...given, definition: given.definition | DEFINITION.invalid }
}
