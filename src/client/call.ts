import type { PlcError } from '../errors'
import { ClosedError } from '../errors'
import type { BodyLength, Exchange, Job, ResponseFrame } from '../link/link'

/** What every call may say. */
export interface CallOptions {
  /** ms from now until nobody waits any more: connecting, queueing, sending and answering included. */
  readonly timeout?: number
  readonly signal?: AbortSignal
}

/** What happens to the caller's promise. */
export interface Settle<Head> {
  /** Reads the answer; throws what it turned out to be instead. `undefined`: nothing was asked (only connecting). */
  readonly answer: (frame: ResponseFrame<Head> | undefined) => void
  readonly fail: (error: unknown) => void
}

/** One request of the caller: the job the session carries. Settled exactly once. */
export class Call<Head> implements Job<Head> {
  #signal: AbortSignal | undefined
  #onAbort: (() => void) | undefined
  #settled = false
  readonly #settle: Settle<Head>

  constructor(
    readonly exchange: Exchange<Head, unknown>,
    readonly deadline: number,
    settle: Settle<Head>,
    /** `false`: the call only waits for the connection. */
    readonly sends = true,
  ) {
    this.#settle = settle
  }

  get head(): Head {
    return this.exchange.head
  }

  get body(): Buffer {
    return this.exchange.body
  }

  get responseLength(): BodyLength<Head> {
    return this.exchange.responseLength
  }

  /** Calls `onAbort` when the signal is aborted before the call is settled. */
  watch(signal: AbortSignal, onAbort: () => void): void {
    this.#signal = signal
    this.#onAbort = onAbort
    signal.addEventListener('abort', onAbort, { once: true })
  }

  /** Settles with the answer. @returns the error the answer turned out to be, if any. */
  answer(frame: ResponseFrame<Head> | undefined): unknown {
    if (!this.#finish()) return undefined
    try {
      this.#settle.answer(frame)
      return undefined
    } catch (error) {
      this.#settle.fail(error)
      return error
    }
  }

  fail(error: PlcError): void {
    if (this.#finish()) this.#settle.fail(error)
  }

  /** The error for a call whose signal is aborted. */
  aborted(outcome: 'notSent' | 'unknown'): ClosedError {
    const what = outcome === 'notSent' ? 'before it was sent' : 'in flight; whether the PLC carried it out is not known'
    return new ClosedError('ABORTED', `${this.exchange.title} was aborted ${what}.`, outcome, this.#signal?.reason)
  }

  #finish(): boolean {
    if (this.#settled) return false
    this.#settled = true
    if (this.#onAbort !== undefined) this.#signal?.removeEventListener('abort', this.#onAbort)
    return true
  }
}
