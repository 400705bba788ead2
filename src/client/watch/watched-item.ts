// One item of a watch: what is known of it, and how often it is asked for.
import { EndCodeError } from '../../errors'
import { isAboutNoItem } from '../item/about'
import type { ReadResult } from '../item/item-value'
import type { Item } from '../item/parts'
import { Demotion } from './demotion'
import { WatchedState } from './watched-value'

/** First pause of an item that fails, ms. */
const FIRST_PAUSE = 1000

/** How an item is looked at. */
export interface ItemView {
  /** How far its value may move before it counts as changed. */
  readonly reach: number
  /** What people see of what was read; missing: the same. */
  readonly seen?: ((result: ReadResult) => ReadResult) | undefined
}

export class WatchedItem {
  readonly state: WatchedState
  readonly #demotion: Demotion
  readonly #seen: ItemView['seen']

  constructor(
    readonly item: Item,
    { reach, seen }: ItemView,
    { demoteAfter, probeEvery }: { readonly demoteAfter: number; readonly probeEvery: number },
  ) {
    this.state = new WatchedState(reach)
    this.#seen = seen
    this.#demotion = new Demotion({ after: demoteAfter, first: FIRST_PAUSE, longest: probeEvery })
  }

  /** It is tried rarely, because the PLC refuses it again and again. */
  get isDemoted(): boolean {
    return this.#demotion.isDemoted
  }

  /** @returns whether value or quality have changed */
  take(result: ReadResult): boolean {
    return this.state.take(this.#seen?.(result) ?? result)
  }

  mayBeTried(now: number): boolean {
    return this.isDemoted && this.#demotion.next <= now
  }

  /** @returns whether it is demoted from now on, or no longer */
  judge(result: ReadResult, now: number): boolean {
    if (result.ok) return this.#demotion.worked()
    const { error } = result
    // What never leaves this computer costs nothing, and what is about the connection or the PLC is about no item.
    return error instanceof EndCodeError && !isAboutNoItem(error) && this.#demotion.failed(now)
  }
}
