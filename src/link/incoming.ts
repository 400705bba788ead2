// What a stream has brought and nobody has read yet, and what may come first in it and means nothing.
import { ProtocolError } from '../errors'
import type { OwnEcho } from './own-echo'

const EMPTY = Buffer.alloc(0)
const MAX_FRAME = 65_536

export class Incoming {
  #bytes: Buffer = EMPTY
  /** The bytes are those of a chunk, which are the transport's. */
  #isLent = false
  /** What may still follow the last answer. */
  #follows: Buffer = EMPTY
  readonly #echo: OwnEcho | undefined

  /** `echo`: where the line may bring the last request first. */
  constructor(echo?: OwnEcho) {
    this.#echo = echo
  }

  get bytes(): Buffer {
    return this.#bytes
  }

  get length(): number {
    return this.#bytes.length
  }

  add(chunk: Buffer): void {
    this.#isLent = this.#bytes.length === 0
    this.#bytes = this.#isLent ? chunk : Buffer.concat([this.#bytes, chunk])
  }

  /** The chunk goes back to the transport: what nobody has read yet is copied. */
  keep(): void {
    if (!this.#isLent || this.#bytes.length === 0) return
    this.#bytes = Buffer.from(this.#bytes)
    this.#isLent = false
  }

  /** Takes bytes away from the front. */
  take(count: number): void {
    this.#bytes = count >= this.#bytes.length ? EMPTY : this.#bytes.subarray(count)
  }

  /** @throws ProtocolError when more is kept than a frame can have */
  refuseEndless(limit = MAX_FRAME): void {
    if (this.length <= limit) return
    throw new ProtocolError('BAD_FRAME', `A frame of more than ${limit} bytes does not end.`)
  }

  /** Throws everything away, also what was expected. */
  clear(): void {
    this.#bytes = EMPTY
    this.#follows = EMPTY
    this.#echo?.forget()
  }

  /** These bytes may come behind the last answer, perhaps late. */
  mayFollow(bytes: Buffer | undefined): void {
    this.#follows = bytes ?? EMPTY
  }

  /** These bytes may come back, behind those that may follow the last answer. */
  mayEcho(bytes: Buffer): void {
    this.#echo?.sent(bytes)
  }

  /**
   * Takes away what may come first.
   * @param isAll nothing more comes for now
   * @returns whether it is there in part
   * @throws ProtocolError when an echo must come first and does not
   */
  passOver(isAll: boolean): boolean {
    const follows = this.#without(this.#follows)
    if (follows === 'all' || follows === 'nothing') this.#follows = EMPTY
    if (follows === 'part') return true
    const echo = this.#echo?.find(this.#bytes, isAll) ?? 0
    if (echo === 'unlike') {
      const message = 'The line gives back what is sent, but this is neither that nor an answer.'
      throw new ProtocolError('BAD_FRAME', message, { offset: 0, bytes: this.#bytes })
    }
    if (echo === 'part') return true
    if (echo > 0) this.take(echo)
    return false
  }

  /** Takes the bytes away from the front, when all of them are there. @returns how much of them is */
  #without(expected: Buffer): 'all' | 'part' | 'nothing' | undefined {
    const here = Math.min(expected.length, this.#bytes.length)
    if (here === 0) return undefined
    if (!this.#bytes.subarray(0, here).equals(expected.subarray(0, here))) return 'nothing'
    if (here < expected.length) return 'part'
    this.take(here)
    return 'all'
  }
}
