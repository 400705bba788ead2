// All watches of one client: one schedule, one plan for what is due together, and what becomes of a PLC that does not answer.
import { ClosedError, ConnectionError, PlcError, RequestError, TimeoutError } from '../../errors'
import type { Clock } from '../../transport/clock'
import { Alarm } from '../connection/alarm'
import type { ConnectionState } from '../connection/connection-options'
import { asPlcError, closedBeforeSending } from '../connection/failure'
import { Signals } from '../connection/signals'
import { isList, namesOf } from '../item/input-checks'
import type { Items, ReadResult } from '../item/item-value'
import type { Item } from '../item/parts'
import { Demotion } from './demotion'
import { ItemWatch } from './item-watch'
import { settleWatch } from './options'
import { type PreparedRead, type Reader, ScanPlans } from './scan-plans'
import { Schedule } from './schedule'
import { type ItemView, WatchedItem } from './watched-item'

/** Of a PLC: scans in a row without an answer after which it is tried rarely, and the pauses, ms. */
const SILENT_PLC = { after: 3, first: 1000, longest: 30_000 }

/** Demoted items that are tried in one scan, each by requests of its own. */
const TRIED_AT_ONCE = 4

/** Behind the writes and reads of everybody else. */
const POLL = { priority: 'poll' } as const

export class Watching {
  readonly #reader: Reader
  readonly #clock: Clock
  readonly #alarm: Alarm
  readonly #schedule: Schedule<ItemWatch>
  readonly #plans: ScanPlans
  readonly #watches = new Set<ItemWatch>()
  readonly #signals = new Signals()
  /** Plans of demoted items, each alone. */
  readonly #alone = new WeakMap<WatchedItem, PreparedRead>()
  #plc = new Demotion(SILENT_PLC)
  /** When a scan last ended without an answer. */
  #silentAt = Number.NEGATIVE_INFINITY
  #isProbing = false
  #closed = false
  /** What ends the watching of their signals. */
  readonly #unwatch = new Map<ItemWatch, () => void>()

  constructor(reader: Reader, clock: Clock) {
    this.#reader = reader
    this.#clock = clock
    this.#alarm = new Alarm(clock, () => this.#ring())
    this.#schedule = new Schedule<ItemWatch>(clock.now())
    this.#plans = new ScanPlans(reader)
  }

  /**
   * @param viewOf how the items of these names are looked at; missing: as `options` say
   * @throws RequestError BAD_OPTION or BAD_ADDRESS, ClosedError when the client is closed
   */
  open(items: Items, options: object, viewOf?: (name: string | number) => ItemView): ItemWatch {
    if (this.#closed) throw closedBeforeSending('Watching')
    const { names, list } = itemsOf(items)
    const settings = settleWatch(options, names ?? list.map((_item, place) => place))
    const watched = list.map((item, place) => {
      const name = names?.[place] ?? place
      return new WatchedItem(item, viewOf?.(name) ?? { reach: settings.reachOf(name) }, settings)
    })
    const watch = new ItemWatch(watched, names, settings, { clock: this.#clock, onClose: () => this.#ended(watch) })
    this.#begin(watch, settings.signal)
    return watch
  }

  #begin(watch: ItemWatch, signal: AbortSignal | undefined): void {
    this.#watches.add(watch)
    this.#schedule.add(watch, watch.every, this.#clock.now())
    if (signal?.aborted === true) void watch.close()
    else if (signal !== undefined)
      this.#unwatch.set(
        watch,
        this.#signals.watch(signal, () => void watch.close()),
      )
    this.#arm()
  }

  #ended(watch: ItemWatch): void {
    this.#watches.delete(watch)
    this.#schedule.remove(watch)
    this.#plans.forget()
    this.#unwatch.get(watch)?.()
    this.#unwatch.delete(watch)
    if (this.#watches.size === 0) this.#alarm.cancel()
  }

  /** The client is closed: so are its watches. */
  close(): void {
    this.#closed = true
    for (const watch of [...this.#watches]) void watch.close()
  }

  /** The connection has changed: what a scan would find out is read at once, instead of at its next instant. */
  stateChanged({ name, attempt }: ConnectionState): void {
    const isBack = name === 'connected' && this.#plc.isFailing
    const isGone = name === 'waiting' && attempt > 0 && !this.#plc.isFailing
    if (this.#watches.size === 0 || !(isBack || isGone)) return
    if (isBack) this.#answers()
    this.#hurry()
  }

  #ring(): void {
    const now = this.#clock.now()
    if (this.#plc.isDemoted) void this.#probe(now)
    else this.#scanDue(now)
    for (const watch of [...this.#watches]) watch.tick(now)
    this.#arm()
  }

  #arm(): void {
    if (this.#watches.size === 0) return
    let due = this.#nextRead
    for (const { nextTick } of this.#watches) due = Math.min(due, nextTick)
    this.#alarm.set(due)
  }

  get #nextRead(): number {
    if (!this.#plc.isDemoted) return this.#schedule.next
    return this.#isProbing ? Number.POSITIVE_INFINITY : this.#plc.next
  }

  #scanDue(now: number): void {
    const turns = this.#schedule.take(now)
    for (const { group, late } of turns) group.begun(late)
    const watches = turns.map(({ group }) => group)
    for (const set of this.#plans.together(watches, now)) void this.#scan(set, now)
  }

  /** Never rejects. */
  async #scan(watches: readonly ItemWatch[], began: number): Promise<void> {
    const [scanned, tried] = await Promise.all([this.#readAll(watches), this.#tryDemoted(watches, began)])
    for (const [watch, results] of tried) {
      const all = scanned.get(watch) ?? []
      results.forEach((result, place) => {
        if (result !== undefined) all[place] = result
      })
    }
    const now = this.#clock.now()
    const answer = answerOf([...scanned.values()].flat())
    if (answer === 'answered') this.#plans.took(watches, now - began, now)
    // Before anybody is told: a listener may look at the watch, or end it.
    for (const watch of watches) this.#schedule.done(watch, now)
    let isRegrouped = false
    for (const watch of watches) {
      const results = scanned.get(watch) ?? []
      isRegrouped = watch.scanned(results, answerOf(results) !== 'silent', now - began) || isRegrouped
    }
    if (isRegrouped) this.#plans.forget()
    this.#judge(answer, began, now)
    this.#arm()
  }

  #judge(answer: Answer, began: number, now: number): void {
    if (answer === 'answered' && this.#answers()) this.#hurry()
    // Scans that were under way together have met one silence, however many they are.
    if (answer !== 'silent' || began < this.#silentAt || this.#plc.isDemoted) return
    this.#silentAt = now
    if (this.#plc.failed(now)) this.#pause(true)
  }

  /** @returns whether the PLC was demoted until now */
  #answers(): boolean {
    const wasDemoted = this.#plc.worked()
    if (wasDemoted) this.#pause(false)
    return wasDemoted
  }

  #pause(paused: boolean): void {
    for (const watch of [...this.#watches]) watch.pause(paused)
  }

  /** Everything is read at once. What passed while the PLC was not asked is told as not read. */
  #hurry(): void {
    for (const [watch, passed] of this.#schedule.hurry(this.#clock.now())) watch.unread(passed)
    this.#arm()
  }

  async #readAll(watches: readonly ItemWatch[]): Promise<Map<ItemWatch, (ReadResult | undefined)[]>> {
    const { read, targets } = this.#plans.of(watches)
    const results = read === undefined ? [] : await this.#run(read)
    const scanned = new Map(watches.map((watch) => [watch, nothingOf(watch)]))
    for (const { watch, place, at } of targets) {
      const all = scanned.get(watch)
      if (all !== undefined) all[place] = results instanceof PlcError ? this.#failed(results) : results[at]
    }
    return scanned
  }

  /** Demoted items whose time has come, each alone and few at once: what fails costs the others as little as can be. */
  async #tryDemoted(watches: readonly ItemWatch[], now: number): Promise<Map<ItemWatch, (ReadResult | undefined)[]>> {
    const due = watches.flatMap((watch) =>
      watch.items.flatMap((item, place) => (item.mayBeTried(now) ? [{ watch, item, place }] : [])),
    )
    const tried = new Map<ItemWatch, (ReadResult | undefined)[]>()
    for (const { watch, item, place } of due.slice(0, TRIED_AT_ONCE)) {
      const all = tried.get(watch) ?? nothingOf(watch)
      tried.set(watch, all)
      all[place] = await this.#readAlone(item)
    }
    return tried
  }

  async #readAlone(item: WatchedItem): Promise<ReadResult | undefined> {
    const plan = this.#alone.get(item) ?? this.#reader.plan([item.item])
    this.#alone.set(item, plan)
    const results = await this.#run(plan)
    return results instanceof PlcError ? this.#failed(results) : results[0]
  }

  /** A plan rejects only for a bug of this package; a watch beside a running machine goes on, and says so. */
  async #run(plan: PreparedRead): Promise<readonly ReadResult[] | PlcError> {
    try {
      return await plan.run(POLL)
    } catch (error) {
      return asPlcError(error)
    }
  }

  #failed(error: PlcError): ReadResult {
    return { item: '', ok: false, error, timestamp: this.#clock.time() }
  }

  /** Asks a PLC that did not answer for one item. */
  async #probe(now: number): Promise<void> {
    if (this.#isProbing || now < this.#plc.next) return
    const item = [...this.#watches].flatMap(({ items }) => items).find(isAskable)
    if (item === undefined) return
    this.#isProbing = true
    const result = await this.#readAlone(item)
    this.#isProbing = false
    const answer = result === undefined ? 'answered' : answerOf([result])
    if (answer === 'silent') this.#plc.failed(this.#clock.now())
    else if (this.#answers()) this.#hurry()
    this.#arm()
  }
}

const ITEMS = 'Items to watch are a list of items, or an object of items by name'

/** @throws RequestError BAD_ADDRESS */
function itemsOf(items: Items): { readonly names: readonly string[] | undefined; readonly list: readonly Item[] } {
  if (isList(items)) return { names: undefined, list: Array.from(items) }
  const names = namesOf(items, ITEMS)
  return { names, list: names.map((name) => items[name] as Item) }
}

function nothingOf({ items }: ItemWatch): (ReadResult | undefined)[] {
  return new Array<undefined>(items.length).fill(undefined)
}

/** It can be asked for: what is wrong with it is no fault of the program. */
function isAskable({ state }: WatchedItem): boolean {
  return !(state.view.quality === 'bad' && state.view.error instanceof RequestError)
}

/** `nothing`: the PLC was not asked. */
type Answer = 'answered' | 'silent' | 'nothing'

function answerOf(results: readonly (ReadResult | undefined)[]): Answer {
  let answer: Answer = 'nothing'
  for (const result of results) {
    if (result === undefined || (!result.ok && result.error instanceof RequestError)) continue
    if (result.ok || !isSilence(result.error)) return 'answered'
    answer = 'silent'
  }
  return answer
}

/** No answer of the PLC came, for whatever reason. */
function isSilence(error: PlcError): boolean {
  return error instanceof TimeoutError || error instanceof ConnectionError || error instanceof ClosedError
}
