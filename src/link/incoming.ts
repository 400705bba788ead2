// What a stream has brought and nobody has read yet, and what may come first in it and means nothing.

const EMPTY = Buffer.alloc(0)

export class Incoming {
  #bytes: Buffer = EMPTY
  /** The bytes are those of a chunk, which are the transport's. */
  #isLent = false
  /** What may still follow the last answer. */
  #follows: Buffer = EMPTY
  /** What a line that repeats everything brings first: the last request. */
  #echo: Buffer = EMPTY

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

  /** Throws everything away, also what was expected. */
  clear(): void {
    this.#bytes = EMPTY
    this.#follows = EMPTY
    this.#echo = EMPTY
  }

  /** These bytes may come behind the last answer, perhaps late. */
  mayFollow(bytes: Buffer | undefined): void {
    this.#follows = bytes ?? EMPTY
  }

  /** These bytes may come back, behind those that may follow the last answer. */
  mayEcho(bytes: Buffer): void {
    this.#echo = bytes
  }

  /** Takes away what may come first. @returns whether it is there in part */
  passOver(): boolean {
    const follows = this.#without(this.#follows)
    if (follows === 'all' || follows === 'nothing') this.#follows = EMPTY
    if (follows === 'part') return true
    const echo = this.#without(this.#echo)
    if (echo === 'all' || echo === 'nothing') this.#echo = EMPTY
    return echo === 'part'
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
