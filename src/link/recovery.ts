// How a line without connections goes on after silence or rubbish: it is brought to a known state instead of being made
// anew. What the framing says ends what the peer was asked (EOT or CL); then nothing may come for a while, so that no
// late answer is taken for the next one. And what a line needs in time besides. Time is an argument.
import type { AnswerFraming } from './framing'
import type { Echoing } from './own-echo'

/** Of a line that is no connection. Times in ms. */
export interface RecoveryOptions {
  /** Without a byte after which the line is in a known state. */
  readonly quiet: number
  /** Between two bytes of one frame, after which the rest does not come any more; delays of the adapter included. */
  readonly betweenBytes: number
  /**
   * From the last character of a request being out until the first one of its answer. After that the PLC counts as silent,
   * and the line goes on with the others. Absent: silence lasts until the deadline of the call.
   */
  readonly answerTime?: number
  /** That a character takes on the line, so that the time of the request itself counts; default 0. */
  readonly byteTime?: number
  /** Between the end of an answer and the next request, also to another PLC; default 0. */
  readonly gap?: number
  /** Whether the line gives back what is sent (converters with two wires); default `auto`: the first request shows it. */
  readonly echo?: Echoing
}

/** ms within which adapters hand on what they have: the next character of a frame that goes on. */
const ADAPTER = 20

/** Pauses that are counted anew because nobody listened: more would keep the line of a busy program for ever. */
const MOST_ANEW = 3

export class Recovery {
  readonly #bytes: Buffer
  readonly #options: RecoveryOptions
  #quietFrom = Number.NEGATIVE_INFINITY
  #isGoingOn = false
  #anew = 0
  #lastByte = Number.NEGATIVE_INFINITY
  /** When the pause behind the last answer is over. */
  #gapUntil = Number.NEGATIVE_INFINITY
  /** When the request in flight counts as not answered. */
  #answerBy: number | undefined

  constructor(bytes: Buffer, options: RecoveryOptions) {
    this.#bytes = bytes
    this.#options = options
  }

  /** A request of so many bytes goes out. `wait`: what the PLC is told to wait before it answers. */
  asked(bytes: number, wait: number, now: number): void {
    const { answerTime, byteTime = 0 } = this.#options
    if (answerTime !== undefined) this.#answerBy = now + bytes * byteTime + wait + answerTime
  }

  /** Something may have been asked, also by who used the line before, that nothing ends. */
  mayBeAsked(now: number): void {
    if (this.#bytes.length === 0) this.#answerBy = now + (this.#options.answerTime ?? 0)
  }

  /** It was answered with what came last. */
  answered(): void {
    this.#answerBy = undefined
    this.#gapUntil = this.#lastByte + (this.#options.gap ?? 0)
  }

  /** When a request in flight of which nothing has come counts as not answered; `undefined`: not before its deadline. */
  get answerBy(): number | undefined {
    return this.#answerBy
  }

  /**
   * It begins, or begins again. An answer that may still come is waited for as long as it may take, before the line has
   * to be quiet: where nothing ends what the PLC was asked, and where nothing has come of it, because what ends it may get
   * lost on the line. @returns what is sent, ahead of everything else
   */
  begin(now: number, hasCome: boolean): Buffer {
    const isEnded = hasCome && this.#bytes.length > 0
    this.#isGoingOn = true
    this.#anew = 0
    this.#quietFrom = isEnded ? now : Math.max(now, this.#answerBy ?? now)
    this.#answerBy = undefined
    return this.#bytes
  }

  /** Bytes have come, and were read at that time. @returns whether they are thrown away: the line is not in a known state, and must be quiet anew */
  swallows(now: number, readAt: number): boolean {
    this.#lastByte = readAt
    if (!this.#isNotKnown(now)) return false
    this.#quietFrom = Math.max(this.#quietFrom, readAt)
    return true
  }

  /** Nobody listened since `then`: whether it was quiet is not known. */
  listenAnew(then: number, now: number): void {
    if (!this.#isNotKnown(then) || this.#anew === MOST_ANEW) return
    this.#anew += 1
    this.#quietFrom = Math.max(this.#quietFrom, now)
  }

  /** Whether nothing may be sent yet. */
  holds(now: number): boolean {
    return this.#isNotKnown(now) || now < this.#gapUntil
  }

  #isNotKnown(now: number): boolean {
    if (this.#isGoingOn && now >= this.#quietUntil) this.#isGoingOn = false
    return this.#isGoingOn
  }

  /** When sending may go on; `undefined` when it may. */
  due(now: number): number | undefined {
    if (!this.holds(now)) return undefined
    return this.#isGoingOn ? Math.max(this.#quietUntil, this.#gapUntil) : this.#gapUntil
  }

  get #quietUntil(): number {
    return this.#quietFrom + this.#options.quiet
  }

  /** When half a frame counts as all that comes of it. `isHeld`: it is whole, if nothing more comes. */
  halfUntil(isHeld: boolean): number {
    const { betweenBytes, byteTime = 0 } = this.#options
    return this.#lastByte + (isHeld ? Math.min(betweenBytes, ADAPTER + 2 * byteTime) : betweenBytes)
  }
}

/** For a framing that has a way to recover, when it is wanted. */
export function recoveryOf(framing: AnswerFraming, options: RecoveryOptions | undefined): Recovery | undefined {
  if (framing.recovery === undefined || options === undefined) return undefined
  return new Recovery(framing.recovery, options)
}
