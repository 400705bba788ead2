// What is to be told of a watch and was not taken yet: the latest wins, and what it replaced is counted.
import type { WatchGap } from './watch'

/** Facts of one update, by the places of the items. */
export interface Parcel {
  readonly changed: readonly number[]
  readonly late: number
  readonly merged: number
  readonly gap: WatchGap | undefined
}

export class Outbox {
  readonly #changed = new Set<number>()
  #late = 0
  #gap: WatchGap | undefined
  /** Updates that wait. */
  #updates = 0

  /** Whether there is anything to tell. */
  get isFull(): boolean {
    return this.#updates > 0
  }

  /** Scans that were skipped are told with the next update, whenever that is. */
  late(scans: number): void {
    this.#late += scans
  }

  gap({ from, to, scans }: WatchGap): void {
    const before = this.#gap
    this.#gap = before === undefined ? { from, to, scans } : { from: before.from, to, scans: before.scans + scans }
  }

  /** There is something to tell. @returns whether it is merged into what waits already */
  add(changed: Iterable<number>): boolean {
    for (const place of changed) this.#changed.add(place)
    this.#updates += 1
    return this.#updates > 1
  }

  take(): Parcel {
    const changed = [...this.#changed].sort((a, b) => a - b)
    const parcel = { changed, late: this.#late, merged: Math.max(0, this.#updates - 1), gap: this.#gap }
    this.#changed.clear()
    this.#late = 0
    this.#gap = undefined
    this.#updates = 0
    return parcel
  }
}
