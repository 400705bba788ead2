// How a line without connections goes on after silence or rubbish: it is brought to a known state instead of being made
// anew. What the framing says ends what the peer was asked (EOT or CL); then nothing may come for a while, so that no
// late answer is taken for the next one. Time is an argument.
import type { AnswerFraming } from './framing'

export interface RecoveryOptions {
  /** ms without a byte after which the line is in a known state. */
  readonly quiet: number
  /** ms between two bytes of one frame after which the rest does not come any more. */
  readonly betweenBytes: number
}

export class Recovery {
  readonly #bytes: Buffer
  readonly #options: RecoveryOptions
  #quietFrom = Number.NEGATIVE_INFINITY
  #isGoingOn = false
  #lastByte = Number.NEGATIVE_INFINITY

  constructor(bytes: Buffer, options: RecoveryOptions) {
    this.#bytes = bytes
    this.#options = options
  }

  /** It begins, or begins again. @returns what is sent, ahead of everything else */
  begin(now: number): Buffer {
    this.#isGoingOn = true
    this.#quietFrom = now
    return this.#bytes
  }

  /** Bytes have come. @returns whether they are thrown away: the line is not in a known state, and must be quiet anew */
  swallows(now: number): boolean {
    this.#lastByte = now
    if (!this.holds(now)) return false
    this.#quietFrom = now
    return true
  }

  /** Whether nothing may be sent yet. */
  holds(now: number): boolean {
    if (this.#isGoingOn && now >= this.#due) this.#isGoingOn = false
    return this.#isGoingOn
  }

  /** When sending may go on; `undefined` when it may. */
  get due(): number | undefined {
    return this.#isGoingOn ? this.#due : undefined
  }

  get #due(): number {
    return this.#quietFrom + this.#options.quiet
  }

  /** When half a frame counts as all that comes of it. */
  get halfUntil(): number {
    return this.#lastByte + this.#options.betweenBytes
  }
}

/** For a framing that has a way to recover, when it is wanted. */
export function recoveryOf(framing: AnswerFraming, options: RecoveryOptions | undefined): Recovery | undefined {
  if (framing.recovery === undefined || options === undefined) return undefined
  return new Recovery(framing.recovery, options)
}
