import type { Clock } from '../../transport/clock'

/** How it knows that the program stood still, and that what arrived meanwhile has not been read yet. In ms. */
export interface AlarmOptions {
  /** So much late at most is usual. */
  readonly stalled: number
  /** That reading takes what has arrived. */
  readonly reading: number
}

/** A socket is read in the same turn. */
const OF_SOCKETS: AlarmOptions = { stalled: 50, reading: 0 }

/**
 * One timer for everything that is due. A timer that would fire earlier than needed is left alone, so that steady
 * traffic does not set a timer per request; whoever is called looks at the time and sets the next one.
 */
export class Alarm {
  readonly #clock: Clock
  readonly #ring: (stoodStill: boolean) => void
  readonly #options: AlarmOptions
  #due = Number.POSITIVE_INFINITY
  #cancel: (() => void) | undefined

  /** `ring`: told whether the program stood still. */
  constructor(clock: Clock, ring: (stoodStill: boolean) => void, options = OF_SOCKETS) {
    this.#clock = clock
    this.#ring = ring
    this.#options = options
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

  /** When it should have rung, where the program stood still: the time until which everything that arrived has been read. */
  missed(now: number): number | undefined {
    return now - this.#due > this.#options.stalled ? this.#due : undefined
  }

  /** After a stall the answers that wait to be read come first: nothing is overdue that has only not been looked at. */
  #rung(): void {
    if (this.missed(this.#clock.now()) === undefined) this.#finish(false)
    else this.#cancel = this.#clock.timer(this.#options.reading, () => this.#finish(true))
  }

  #finish(stoodStill: boolean): void {
    this.#cancel = undefined
    this.#due = Number.POSITIVE_INFINITY
    this.#ring(stoodStill)
  }
}
