// The wire of a simulated serial line: hosts on one side, stations on the other, and the time that characters take.
import type { Clock } from '../transport/clock'
import { Lane } from './lane'

export interface WireParts {
  readonly clock: Clock
  /** ms that a character takes on the line; 0: the line takes no time. */
  readonly character: number
  /** ms without a character after which a message that has begun is broken off. */
  readonly timeout: number
  /** Hosts hear what they send, as on one pair of RS-485. */
  readonly echo: boolean
  readonly toHosts: (bytes: Buffer) => void
  /** Whether the stations wait for the rest of something. */
  readonly toStations: (bytes: Buffer) => boolean
  /** No more characters have come. */
  readonly quiet: () => void
}

/** More than any conversation holds. */
const MOST_WAITING = 65_536

export class Wire {
  readonly #parts: WireParts
  readonly #up: Lane
  readonly #down: Lane
  #cancel: (() => void) | undefined

  constructor(parts: WireParts) {
    this.#parts = parts
    const { clock, character } = parts
    const common = { clock, character, most: MOST_WAITING }
    this.#up = new Lane({ ...common, arrive: (bytes) => this.#heard(bytes) })
    this.#down = new Lane({ ...common, arrive: (bytes) => parts.toHosts(bytes) })
  }

  /** A host speaks. Returns how many characters the line had no room for. */
  hear(bytes: Buffer): number {
    return this.#up.send(bytes, this.#down.late)
  }

  /** A station speaks. */
  say(bytes: Buffer): void {
    this.#down.send(bytes, this.#up.late)
  }

  /** What stations have said and is not out yet stays unsaid. */
  hush(): void {
    this.#down.clear()
  }

  close(): void {
    this.#up.clear()
    this.#down.clear()
    this.#rest()
  }

  #heard(bytes: Buffer): void {
    const { echo, toHosts, toStations, clock, timeout, quiet } = this.#parts
    this.#rest()
    if (echo) toHosts(bytes)
    if (!toStations(bytes)) return
    this.#cancel = clock.timer(timeout, () => {
      this.#cancel = undefined
      quiet()
    })
  }

  #rest(): void {
    this.#cancel?.()
    this.#cancel = undefined
  }
}
