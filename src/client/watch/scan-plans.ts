// What is read at one instant: the items of all watches that are due, each once, by one plan.
import type { CallOptions } from '../connection/call'
import type { ReadResult } from '../item/item-value'
import type { Item } from '../item/parts'
import type { ItemWatch } from './item-watch'

/** A prepared read of a client. */
export interface PreparedRead {
  run(options?: CallOptions): Promise<readonly ReadResult[]>
}

/** Who reads, whatever family the PLC is of. */
export interface Reader {
  plan(items: readonly Item[]): PreparedRead
}

/** Where the results of a plan go. */
interface Target {
  readonly watch: ItemWatch
  readonly place: number
  /** Place of its result. */
  readonly at: number
}

/** The plan of one set of watches. */
export interface ScanPlan {
  /** Undefined when nothing is to be read: every item is demoted. */
  readonly read: PreparedRead | undefined
  readonly targets: readonly Target[]
}

/** More sets of rates that coincide than this are no program's; their plans must not fill the memory. */
const KEPT = 64

/** Sets of watches that were too slow together are tried together again after so many ms. */
const APART_FOR = 60_000

export class ScanPlans {
  readonly #reader: Reader
  readonly #plans = new Map<string, ScanPlan>()
  /** Sets whose scan took longer than the shortest of their periods, and until when they are read apart. */
  readonly #slow = new Map<string, number>()
  readonly #numbers = new WeakMap<ItemWatch, number>()
  #last = 0

  constructor(reader: Reader) {
    this.#reader = reader
  }

  /** Other items are read from now on. */
  forget(): void {
    this.#plans.clear()
    this.#slow.clear()
  }

  of(watches: readonly ItemWatch[]): ScanPlan {
    const key = this.#keyOf(watches)
    const known = this.#plans.get(key)
    if (known !== undefined) return known
    const plan = this.#planned(watches)
    if (this.#plans.size >= KEPT) this.#plans.clear()
    this.#plans.set(key, plan)
    return plan
  }

  #keyOf(watches: readonly ItemWatch[]): string {
    return watches.map((watch) => this.#numberOf(watch)).join()
  }

  #numberOf(watch: ItemWatch): number {
    const known = this.#numbers.get(watch)
    if (known !== undefined) return known
    this.#last += 1
    this.#numbers.set(watch, this.#last)
    return this.#last
  }

  #planned(watches: readonly ItemWatch[]): ScanPlan {
    // Texts are alike when they are equal, objects when they are the same: what they say is not looked into here.
    const places = new Map<Item, number>()
    const targets: Target[] = []
    for (const watch of watches) {
      for (const [place, { item, isDemoted }] of watch.items.entries()) {
        if (isDemoted) continue
        const at = places.get(item) ?? places.size
        places.set(item, at)
        targets.push({ watch, place, at })
      }
    }
    return { read: places.size === 0 ? undefined : this.#reader.plan([...places.keys()]), targets }
  }

  /** How those that are due now are read: all by one plan, but for sets in which the slow ones would make the fast ones late. */
  together(watches: readonly ItemWatch[], now: number): (readonly ItemWatch[])[] {
    if (watches.length === 0) return []
    const until = this.#slow.get(this.#keyOf(watches)) ?? Number.NEGATIVE_INFINITY
    if (until <= now) return [watches]
    const fastest = Math.min(...watches.map(({ every }) => every))
    const rest = watches.filter(({ every }) => every !== fastest)
    return [watches.filter(({ every }) => every === fastest), ...this.together(rest, now)]
  }

  /** A set was read together, and it took so long. */
  took(watches: readonly ItemWatch[], duration: number, now: number): void {
    const rates = new Set(watches.map(({ every }) => every))
    if (rates.size < 2 || duration < Math.min(...rates)) return
    if (this.#slow.size >= KEPT) this.#slow.clear()
    this.#slow.set(this.#keyOf(watches), now + APART_FOR)
  }
}
