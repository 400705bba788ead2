// One item of a watch: what is known of it, and how often it is asked for.
import { EndCodeError } from '../../errors'
import { isAboutNoItem } from '../item/about'
import type { ReadResult } from '../item/item-value'
import type { Item } from '../item/parts'
import { Demotion } from './demotion'
import { WatchedState } from './watched-value'

/** First pause of an item that fails, ms. */
const FIRST_PAUSE = 1000

export class WatchedItem {
  readonly state: WatchedState
  readonly #demotion: Demotion

  constructor(
    readonly item: Item,
    reach: number,
    { demoteAfter, probeEvery }: { readonly demoteAfter: number; readonly probeEvery: number },
  ) {
    this.state = new WatchedState(reach)
    this.#demotion = new Demotion({ after: demoteAfter, first: FIRST_PAUSE, longest: probeEvery })
  }

  /** It is tried rarely, because the PLC refuses it again and again. */
  get isDemoted(): boolean {
    return this.#demotion.isDemoted
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
