// One call's deadline and signal, for calls of several requests and for what comes before a request.
import { ClosedError, type TimeoutError } from '../../errors'
import type { Clock } from '../../transport/clock'
import { type BoundOptions, type CallOptions, optionProblem } from './call'
import * as failure from './failure'

const USUAL: CallOptions = {}

/** The absolute end of one call: all its requests and all its waiting share it. */
export class Deadline {
  readonly #clock: Clock
  #end: number
  readonly #options: CallOptions

  /**
   * @param usual ms, when the call says no timeout
   * @throws RequestError BAD_OPTION for a timeout or signal that is none
   */
  constructor(clock: Clock, options: CallOptions = USUAL, usual: number) {
    const problem = optionProblem(options)
    if (problem !== undefined) throw problem
    this.#clock = clock
    this.#options = options
    this.#end = clock.now() + (options.timeout ?? usual)
  }

  /** What is left of the call, for its next request. @throws TimeoutError when nothing is left */
  options(title: string): CallOptions {
    // Without a caller of its own, all requests of the call are one caller's: the call's.
    return { caller: this, ...this.#options, timeout: this.#left(title) }
  }

  /** The same for a request of the connection. @throws TimeoutError when nothing is left */
  ofRequest(title: string): BoundOptions {
    const timeout = this.#left(title)
    if (this.#options === USUAL) return { caller: this, timeout, growing: this }
    if (this.#options.timeout !== undefined) return { caller: this, ...this.#options, timeout }
    return { caller: this, ...this.#options, timeout, growing: this }
  }

  #left(title: string): number {
    const left = this.#end - this.#clock.now()
    if (left <= 0) throw failure.notSentInTime(title)
    return left
  }

  /** What its requests take on a slow line comes on top, where nobody said how long it may take. */
  grow(ms: number): void {
    this.#end += ms
  }

  /** Waits for the end of something else. Rejects with a `PlcError` when the call ends before it. */
  wait(turn: Promise<unknown>, title: string): Promise<void> {
    const { signal } = this.#options
    return new Promise<void>((resolve, reject) => {
      const settled = () => {
        cancel()
        signal?.removeEventListener('abort', aborted)
      }
      const fail = (error: TimeoutError | ClosedError) => {
        settled()
        reject(error)
      }
      const aborted = () =>
        fail(new ClosedError('ABORTED', `${title} was aborted before it was sent.`, 'notSent', signal?.reason))
      const left = Math.max(0, this.#end - this.#clock.now())
      const cancel = this.#clock.timer(left, () => fail(failure.notSentInTime(title)))
      signal?.addEventListener('abort', aborted, { once: true })
      if (signal?.aborted === true) aborted()
      const ended = () => {
        settled()
        resolve()
      }
      turn.then(ended, ended)
    })
  }
}
