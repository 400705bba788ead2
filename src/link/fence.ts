// How answers without a serial number are told apart on a port that stays: before each request a question whose answer
// nobody can confuse, a self test with a fresh pattern. A PLC answers in order, so once the pattern has come back
// nothing of what was asked before is under way any more: no late answer, and no second copy of one.
import { PlcError } from '../errors'
import type { AnswerFraming, Question, ResponseFrame } from './framing'

/** A question with a fresh pattern, and how its answer is known. */
export interface Echo extends Question {
  /** A quick look: `false` when the bytes cannot be its answer. */
  mayBeOwn(datagram: Buffer): boolean
  /**
   * Whether the frame answers exactly this question (`own`), or one with another pattern (`another`).
   * @throws PlcError when it is the answer to something else
   */
  read(frame: ResponseFrame): 'own' | 'another'
}

export interface FenceOptions {
  /** A new question each time: a pattern that comes again proves nothing. */
  readonly ask: () => Echo
  /** ms after which it is asked once more, because datagrams get lost; doubled as long as nothing comes, because a PLC may be slow. */
  readonly patience: number
  /**
   * The frames have serial numbers: only at the beginning of a session an answer of an earlier program, which may have
   * used the same numbers, can be taken for another one. A PLC that returns no self test is used without it.
   */
  readonly onlyAtFirst?: boolean
}

/** Copies of an echo may come later; so many questions are known. */
const REMEMBERED = 8
/** Questions answered with something else after which a PLC counts as one that returns no self tests. */
const ENOUGH = 3
const ENOUGH_REFUSED = 2

/** It outlives a session: an answer to a request of an earlier one can still come to the same port. */
export class Fence {
  readonly #framing: AnswerFraming
  readonly #options: FenceOptions
  /** Since the last request, the latest last. Only that one proves it: the others may still be refused, one after another. */
  #asked: Echo[] = []
  /** Answers to something else since then. */
  #strays = 0
  /** Those of them with an end code. */
  #refusals = 0
  /** One answer, whatever it says, to each question so far. */
  #inStep = true
  /** Whose answers prove nothing any more. */
  #former: Echo[] = []
  #askAgainAt = Number.NEGATIVE_INFINITY
  #stands = false
  /** A request has left and its answer has not come: it may come at any time. */
  #owed = false
  /** Whether the PLC returns self tests; unknown until it did once, or did not. */
  #echoes: boolean | undefined

  constructor(framing: AnswerFraming, options: FenceOptions) {
    this.#framing = framing
    this.#options = options
  }

  /** When the question is asked again; `undefined` when nothing was asked. */
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
    if (this.#options.onlyAtFirst === true) return
    this.#fall()
    this.#owed = true
  }

  /** The request that left was answered. */
  answered(): void {
    this.#owed = false
  }

  /**
   * Whether the next request may leave. A PLC that answers self tests with something else, as one does that has none, is
   * used without, but only as long as it has answered everything; these questions, too.
   */
  allows(now: number): boolean {
    const { onlyAtFirst = false } = this.#options
    if (onlyAtFirst && this.#asked.length > 0 && now >= this.#askAgainAt) this.#stand()
    if (this.#stands) return true
    if (this.#owed || this.#echoes === true) return false
    // Each question was answered before the next one was asked, but not with its pattern, and its own answer has had its
    // time. Late answers to something else hardly come in step with the questions; a refusal is the usual answer.
    const enough = this.#refusals === this.#asked.length ? ENOUGH_REFUSED : ENOUGH
    const inStep = this.#inStep && this.#strays === this.#asked.length
    if (inStep && this.#asked.length >= enough && now >= this.#askAgainAt) this.#echoes = false
    return this.#echoes === false
  }

  /** The frame of the question, when it is time to ask, again or for the first time. */
  ask(now: number): Buffer | undefined {
    if (now < this.#askAgainAt) return undefined
    this.#inStep &&= this.#strays === this.#asked.length
    const echo = this.#options.ask()
    this.#asked.push(echo)
    if (this.#asked.length > REMEMBERED) this.#asked.shift()
    const unanswered = Math.max(0, this.#asked.length - 1 - this.#strays)
    this.#askAgainAt = now + this.#options.patience * 2 ** unanswered
    return echo.write(0)
  }

  /**
   * Looks at a datagram.
   * @returns `echo`: the fence stands from now on; `stray`: an answer to something before it; `undefined`: it may be the
   * answer to the request in flight.
   */
  look(datagram: Buffer): 'echo' | 'stray' | undefined {
    const latest = this.#asked.at(-1)
    const known = [...this.#former, ...this.#asked].some(
      (echo) => echo.mayBeOwn(datagram) && this.#kindOf(echo, datagram) === 'own',
    )
    // Also to the program before: then it returns them.
    const kind = latest && this.#kindOf(latest, datagram)
    if (known || kind === 'own' || kind === 'another') this.#echoes = true
    if (kind === 'own') {
      this.#stand()
      return 'echo'
    }
    if (latest === undefined) return known ? 'stray' : undefined
    this.#strays += 1
    if (kind === 'refusal') this.#refusals += 1
    return 'stray'
  }

  #stand(): void {
    this.#fall()
    this.#stands = true
    this.#owed = false
  }

  #fall(): void {
    this.#stands = false
    this.#former = [...this.#former, ...this.#asked].slice(-2 * REMEMBERED)
    this.#asked = []
    this.#strays = 0
    this.#refusals = 0
    this.#inStep = true
    this.#askAgainAt = Number.NEGATIVE_INFINITY
  }

  #kindOf(echo: Echo, datagram: Buffer): 'own' | 'another' | 'refusal' | undefined {
    try {
      const scanned = this.#framing.response.scan(datagram, (head, soFar) => echo.responseLength(head, soFar))
      if (scanned === undefined || scanned.used !== datagram.length) return undefined
      if (echo.mismatch(scanned.frame.head) !== undefined) return undefined
      return scanned.frame.endCode === 0 ? echo.read(scanned.frame) : 'refusal'
    } catch (error) {
      // Whatever it is, it is no answer to a self test.
      if (error instanceof PlcError) return undefined
      throw error
    }
  }
}
