// One direction of a serial line: characters that take their time.
import type { Clock } from '../transport/clock'

export interface LaneParts {
  readonly clock: Clock
  /** ms that a character takes; 0: none. */
  readonly character: number
  /** Characters that wait; what comes when there are so many is lost, as in the buffer of a device server. */
  readonly most: number
  readonly arrive: (bytes: Buffer) => void
}

export class Lane {
  readonly #parts: LaneParts
  #waiting: Buffer = Buffer.alloc(0)
  /** When the first of the waiting characters began. */
  #begun = 0
  #cancel: (() => void) | undefined
  #late = 0

  constructor(parts: LaneParts) {
    this.#parts = parts
  }

  /**
   * ms that the last character arrived later than the line would have brought it, because timers are late. Who answers it
   * began its answer so much later, too; a bench of the line must not count that.
   */
  get late(): number {
    return this.#late
  }

  /** Characters on their way. */
  get waiting(): number {
    return this.#waiting.length
  }

  /** `credit`: ms that whoever sends would have sent earlier, had it heard in time. Returns how many were lost. */
  send(bytes: Buffer, credit: number): number {
    const { character, clock, most, arrive } = this.#parts
    if (character === 0) {
      arrive(bytes)
      return 0
    }
    const taken = bytes.subarray(0, Math.max(0, most - this.#waiting.length))
    // Never before the line was free: characters are not sent at the same time.
    if (this.#waiting.length === 0) this.#begun = Math.max(this.#begun, clock.now() - credit)
    this.#waiting = Buffer.concat([this.#waiting, taken])
    this.#wait()
    return bytes.length - taken.length
  }

  /** What has not arrived never does. */
  clear(): void {
    this.#cancel?.()
    this.#cancel = undefined
    this.#waiting = Buffer.alloc(0)
  }

  #wait(): void {
    if (this.#cancel !== undefined || this.#waiting.length === 0) return
    const { clock, character } = this.#parts
    this.#cancel = clock.timer(this.#begun + character - clock.now(), () => {
      this.#cancel = undefined
      this.#arrive()
    })
  }

  /** All that are due, so that a timer that is late slows nothing down. */
  #arrive(): void {
    const { clock, character, arrive } = this.#parts
    const now = clock.now()
    // A timer never fires early, but sums of fractions may say so.
    const due = Math.max(1, Math.floor((now - this.#begun) / character))
    const bytes = this.#waiting.subarray(0, due)
    this.#waiting = this.#waiting.subarray(bytes.length)
    this.#begun += bytes.length * character
    this.#late = Math.max(0, now - this.#begun)
    this.#wait()
    arrive(bytes)
  }
}
