import type { Clock } from '../../transport/clock'

/** More than this late, and the program stood still: what arrived meanwhile has not been read yet. */
const STALLED = 50

/**
 * One timer for everything that is due. A timer that would fire earlier than needed is left alone, so that steady
 * traffic does not set a timer per request; whoever is called looks at the time and sets the next one.
 */
export class Alarm {
  readonly #clock: Clock
  readonly #ring: () => void
  #due = Number.POSITIVE_INFINITY
  #cancel: (() => void) | undefined

  constructor(clock: Clock, ring: () => void) {
    this.#clock = clock
    this.#ring = ring
  }

  /** Makes sure that it rings at `due` or earlier. `Infinity`: nothing is due. */
  set(due: number): void {
    if (due >= this.#due) return
    this.#cancel?.()
    this.#due = due
    this.#cancel = this.#clock.timer(Math.max(0, due - this.#clock.now()), () => this.#rung())
  }

  cancel(): void {
    this.#cancel?.()
    this.#cancel = undefined
    this.#due = Number.POSITIVE_INFINITY
  }

  /** After a stall the answers in the socket come first: nothing is overdue that has only not been looked at. */
  #rung(): void {
    if (this.#clock.now() - this.#due <= STALLED) {
      this.#finish()
      return
    }
    this.#cancel = this.#clock.timer(0, () => this.#finish())
  }

  #finish(): void {
    this.#cancel = undefined
    this.#due = Number.POSITIVE_INFINITY
    this.#ring()
  }
}
