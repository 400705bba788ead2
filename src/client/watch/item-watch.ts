// One watch: its items, what is known of them, and whoever is told.
import { RequestError } from '../../errors'
import type { Clock } from '../../transport/clock'
import { listenerFailed } from '../connection/listeners'
import { nameResults } from '../item/about'
import type { ReadResult } from '../item/item-value'
import { byName } from '../item/plain-values'
import type { WatchSettings } from './options'
import { Outbox } from './outbox'
import type { Watch, WatchStatistics, WatchUpdate } from './watch'
import type { WatchedItem } from './watched-item'
import type { WatchedValue } from './watched-value'

/** Node.js before 20.5 has no such symbol; programs for it bring one of this name. */
const asyncDispose: typeof Symbol.asyncDispose = Symbol.asyncDispose ?? Symbol.for('Symbol.asyncDispose')

/** Values by name, or of a list in its order. */
type Values = Readonly<Record<string, WatchedValue>> | readonly WatchedValue[]
type Update = WatchUpdate<Values>
type Taken = IteratorResult<Update, undefined>

/** What was read of an item, by its place; what was not asked for is missing. */
export type Scanned = readonly (ReadResult | undefined)[]

const ENDED: Taken = { value: undefined, done: true }

export class ItemWatch implements Watch<Values> {
  readonly items: readonly WatchedItem[]
  readonly every: number
  readonly #names: readonly string[] | undefined
  readonly #settings: WatchSettings
  readonly #clock: Clock
  readonly #onClose: () => void
  readonly #outbox = new Outbox()
  #waiting: ((taken: Taken) => void)[] = []
  #listenerIsBusy = false
  #closed = false
  /** The PLC does not answer: nothing is asked for but now and then. */
  #paused = false
  /** Until then the values count as known. */
  #freshUntil: number
  #isOutdated = false
  #toldAt: number
  /** The last scan that read anything, ms since 1970. */
  #lastRead: number | undefined
  /** Scans since then that read nothing. */
  #unread = 0
  readonly #counts = { scans: 0, late: 0, unread: 0, merged: 0 }
  #duration: number | undefined

  /** @param names of the items; undefined of a list */
  constructor(
    items: readonly WatchedItem[],
    names: readonly string[] | undefined,
    settings: WatchSettings,
    { clock, onClose }: { readonly clock: Clock; readonly onClose: () => void },
  ) {
    this.items = items
    this.every = settings.every
    this.#names = names
    this.#settings = settings
    this.#clock = clock
    this.#onClose = onClose
    this.#toldAt = clock.now()
    this.#freshUntil = this.#toldAt + settings.staleAfter
  }

  get values(): Values {
    const views = this.items.map(({ state }) => state.view)
    return this.#names === undefined ? views : byName(this.#names, views)
  }

  get statistics(): WatchStatistics {
    return { ...this.#counts, duration: this.#duration }
  }

  get isClosed(): boolean {
    return this.#closed
  }

  /** When it has something to do beside its scans. */
  get nextTick(): number {
    const beat = this.#outbox.isFull ? Number.POSITIVE_INFINITY : this.#toldAt + this.#settings.heartbeat
    return this.#isOutdated ? beat : Math.min(beat, this.#freshUntil)
  }

  /** Time has passed: values may be too old, a heartbeat due. */
  tick(now: number): void {
    if (!this.#isOutdated && now >= this.#freshUntil) this.#outdate()
    if (!this.#outbox.isFull && now >= this.#toldAt + this.#settings.heartbeat) this.#tell([])
  }

  #outdate(): void {
    this.#isOutdated = true
    const reason = `No scan has ended for ${this.#settings.staleAfter} ms.`
    const changed = this.#placesOf(({ state }) => state.outdate(reason))
    if (changed.length > 0) this.#tell(changed)
  }

  #placesOf(choose: (item: WatchedItem) => boolean): number[] {
    return this.items.flatMap((item, place) => (choose(item) ? [place] : []))
  }

  /** A scan begins; so many were skipped before it. */
  begun(late: number): void {
    this.#counts.late += late
    this.#outbox.late(late)
  }

  /**
   * A scan has ended.
   * @param wasRead whether the PLC has answered
   * @returns whether an item is demoted from now on, or no longer
   */
  scanned(results: Scanned, wasRead: boolean, duration: number): boolean {
    if (this.#closed) return false
    const now = this.#clock.now()
    this.#counts.scans += 1
    this.#duration = duration
    if (wasRead) this.#wasRead(now)
    else this.unread(1)
    const named = this.#named(results)
    const changed = this.#placesOfResults(named, (item, result) => item.take(result))
    const judged = this.#placesOfResults(named, (item, result) => item.judge(result, now))
    const isFirst = this.#counts.scans === 1
    if (changed.length > 0 || judged.length > 0 || isFirst || this.#settings.tellsScans) this.#tell(changed)
    return judged.length > 0
  }

  #placesOfResults(results: Scanned, choose: (item: WatchedItem, result: ReadResult) => boolean): number[] {
    return results.flatMap((result, place) => {
      const item = this.items[place]
      return result !== undefined && item !== undefined && choose(item, result) ? [place] : []
    })
  }

  /** Errors call the items by their names. */
  #named(results: Scanned): Scanned {
    const names = this.#names
    if (names === undefined || results.every((result) => result?.ok !== false)) return results
    return results.map((result, place) => {
      const [named] = result === undefined ? [] : nameResults([result], [names[place] ?? ''])
      return named
    })
  }

  #wasRead(now: number): void {
    const time = this.#clock.time()
    this.#isOutdated = false
    this.#freshUntil = now + this.#settings.staleAfter
    if (this.#unread > 0 && this.#lastRead !== undefined) {
      this.#outbox.gap({ from: this.#lastRead, to: time, scans: this.#unread })
    }
    this.#unread = 0
    this.#lastRead = time
  }

  /** So many scans read nothing. */
  unread(scans: number): void {
    this.#unread += scans
    this.#counts.unread += scans
  }

  /** The PLC does not answer, and is asked now and then only; or it does again. */
  pause(paused: boolean): void {
    if (this.#paused === paused || this.#closed) return
    this.#paused = paused
    this.#tell([])
  }

  #tell(changed: readonly number[]): void {
    this.#toldAt = this.#clock.now()
    if (this.#outbox.add(changed)) this.#counts.merged += 1
    this.#deliver()
  }

  #deliver(): void {
    if (this.#closed || !this.#outbox.isFull) return
    if (this.#settings.onChange === undefined) this.#waiting.shift()?.({ value: this.#update(), done: false })
    else if (!this.#listenerIsBusy) this.#call(this.#settings.onChange as (update: Update) => unknown)
  }

  #update(): Update {
    const { changed, late, merged, gap } = this.#outbox.take()
    // Changes are measured from what somebody has got, which may be later than what made the update.
    for (const place of changed) this.items[place]?.state.told()
    const demoted = this.#placesOf((item) => this.#paused || item.isDemoted)
    return {
      values: this.values,
      changed: this.#called(changed),
      late,
      merged,
      ...(gap === undefined ? {} : { gap }),
      demoted: this.#called(demoted),
    }
  }

  #called(places: readonly number[]): readonly (string | number)[] {
    const names = this.#names
    return names === undefined ? places : places.map((place) => names[place] ?? '')
  }

  #call(listener: (update: Update) => unknown): void {
    try {
      const told = listener(this.#update())
      if (isPromise(told)) void this.#wait(told)
    } catch (error) {
      listenerFailed('onChange of a watch', error)
    }
  }

  async #wait(told: PromiseLike<unknown>): Promise<void> {
    this.#listenerIsBusy = true
    try {
      await told
    } catch (error) {
      listenerFailed('onChange of a watch', error)
    }
    this.#listenerIsBusy = false
    this.#deliver()
  }

  next(): Promise<Taken> {
    if (this.#closed) return Promise.resolve(ENDED)
    if (this.#settings.onChange !== undefined) return Promise.reject(toldElsewhere())
    if (this.#outbox.isFull) return Promise.resolve({ value: this.#update(), done: false })
    return new Promise((resolve) => this.#waiting.push(resolve))
  }

  async return(): Promise<Taken> {
    await this.close()
    return ENDED
  }

  [Symbol.asyncIterator](): this {
    if (this.#settings.onChange !== undefined) throw toldElsewhere()
    return this
  }

  async close(): Promise<void> {
    if (this.#closed) return
    this.#closed = true
    this.#onClose()
    const waiting = this.#waiting
    this.#waiting = []
    for (const resolve of waiting) resolve(ENDED)
  }

  async [asyncDispose](): Promise<void> {
    await this.close()
  }
}

function toldElsewhere(): RequestError {
  const message =
    'The updates of this watch go to onChange. Open another watch for the loop: what both watch is read once.'
  return new RequestError('BAD_OPTION', message, 'onChange')
}

function isPromise(value: unknown): value is PromiseLike<unknown> {
  return typeof value === 'object' && value !== null && 'then' in value && typeof value.then === 'function'
}
