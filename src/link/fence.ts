// How answers without a serial number are told apart on a port that stays: before each request a question whose answer
// nobody can confuse, a self test with a fresh pattern. A PLC answers in order, so once the pattern has come back
// nothing of what was asked before is under way any more: no late answer, and no second copy of one.
import { PlcError } from '../errors'
import type { BodyLength, Framing, ResponseFrame } from './framing'

/** A question with a fresh pattern, and how its answer is known. */
export interface Echo<Head> {
  readonly head: Head
  readonly body: Uint8Array
  readonly responseLength: BodyLength<Head>
  /** Whether the frame answers exactly this question. */
  isEcho(frame: ResponseFrame<Head>): boolean
}

export interface FenceOptions<Head> {
  /** A new question each time: a pattern that comes again proves nothing. */
  readonly ask: () => Echo<Head>
  /** ms after which it is asked once more, because datagrams get lost; doubled each time, because a PLC may be slow. */
  readonly patience: number
}

/** Copies of an echo may come later; so many questions are known. */
const REMEMBERED = 8

/** It outlives a session: an answer to a request of an earlier one can still come to the same port. */
export class Fence<Head> {
  readonly #framing: Framing<Head>
  readonly #options: FenceOptions<Head>
  /** Since the last request, the latest last. Any of them proves it, because all were asked behind that request. */
  #asked: Echo<Head>[] = []
  /** Whose answers prove nothing any more. */
  #former: Echo<Head>[] = []
  #askAgainAt = Number.NEGATIVE_INFINITY
  #stands = false
  /** A request has left and its answer has not come: it may come at any time. */
  #owed = false
  /** Whether the PLC returns self tests; unknown until it did once, or did not. */
  #echoes: boolean | undefined

  constructor(framing: Framing<Head>, options: FenceOptions<Head>) {
    this.#framing = framing
    this.#options = options
  }

  /** When the question is asked again, or what may leave without it does; `undefined` when nothing was asked. */
  get due(): number | undefined {
    return this.#asked.length === 0 ? undefined : this.#askAgainAt
  }

  /** A session begins: of what came before on this port nothing is known. */
  begin(): void {
    this.#fall()
    // Not returned once is not proof that it never is.
    if (this.#echoes === false) this.#echoes = undefined
  }

  /** A request leaves: from now on its answer may be on its way, and later a second copy of it. */
  sent(): void {
    this.#fall()
    this.#owed = true
  }

  /** The request that left was answered. */
  answered(): void {
    this.#owed = false
  }

  /**
   * Whether the next request may leave. A PLC that returned no self test at all is used without, but only as long as it
   * has answered everything.
   */
  allows(now: number): boolean {
    if (this.#stands) return true
    if (this.#owed || this.#echoes === true) return false
    if (this.#asked.length > 0 && now >= this.#askAgainAt) this.#echoes = false
    return this.#echoes === false
  }

  /** The frame of the question, when it is time to ask, again or for the first time. */
  ask(now: number): Buffer | undefined {
    if (now < this.#askAgainAt) return undefined
    const echo = this.#options.ask()
    this.#asked.push(echo)
    if (this.#asked.length > REMEMBERED) this.#asked.shift()
    this.#askAgainAt = now + this.#options.patience * 2 ** (this.#asked.length - 1)
    return this.#framing.request.write(echo.head, 0, echo.body)
  }

  /**
   * Looks at a datagram.
   * @returns `echo`: the fence stands from now on; `stray`: an answer to something before it; `undefined`: it may be the
   * answer to the request in flight.
   */
  look(datagram: Buffer): 'echo' | 'stray' | undefined {
    if (this.#asked.some((echo) => this.#isEcho(echo, datagram))) {
      this.#fall()
      this.#stands = true
      this.#owed = false
      this.#echoes = true
      return 'echo'
    }
    if (this.#asked.length > 0) return 'stray'
    if (!this.#former.some((echo) => this.#isEcho(echo, datagram))) return undefined
    // Later than was waited for: it does return them.
    this.#echoes = true
    return 'stray'
  }

  #fall(): void {
    this.#stands = false
    this.#former = [...this.#former, ...this.#asked].slice(-2 * REMEMBERED)
    this.#asked = []
    this.#askAgainAt = Number.NEGATIVE_INFINITY
  }

  #isEcho(echo: Echo<Head>, datagram: Buffer): boolean {
    try {
      const scanned = this.#framing.response.scan(datagram, (head, soFar) => echo.responseLength(head, soFar))
      if (scanned === undefined || scanned.used !== datagram.length) return false
      return this.#framing.mismatch(echo.head, scanned.frame.head) === undefined && echo.isEcho(scanned.frame)
    } catch (error) {
      // Whatever it is, it is no echo.
      if (error instanceof PlcError) return false
      throw error
    }
  }
}
