import type { Item } from '../item/parts'
import type { ReadPlan } from './plans'

/** Plans of `read` that are kept. A program that reads ever new lists must not fill the memory with them. */
const PREPARED_PLANS = 500

/** A plan is made once and found again by its texts: programs read the same few lists of items all day. */
export class PreparedPlans {
  readonly #plan: (items: readonly Item[]) => ReadPlan
  readonly #prepared = new Map<string, ReadPlan>()
  /** Of lists of one item, by its text. */
  readonly #alone = new Map<string, ReadPlan>()

  constructor(plan: (items: readonly Item[]) => ReadPlan) {
    this.#plan = plan
  }

  prepare(items: readonly Item[]): Pick<ReadPlan, 'run'> {
    if (!items.every((item) => typeof item === 'string')) return this.#plan(items)
    const [only] = items
    if (items.length === 1 && only !== undefined) return this.#kept(this.#alone, only, items)
    // Not joined: whatever stood between two texts could also stand in one.
    return this.#kept(this.#prepared, JSON.stringify(items), items)
  }

  #kept(plans: Map<string, ReadPlan>, key: string, items: readonly Item[]): ReadPlan {
    const known = plans.get(key)
    if (known !== undefined) return known
    const plan = this.#plan(items)
    if (plans.size >= PREPARED_PLANS) plans.clear()
    plans.set(key, plan)
    return plan
  }
}
