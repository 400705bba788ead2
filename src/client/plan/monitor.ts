// Items the PLC is told once (0801) and asked for again and again with a request that names none (0802).

import { EndCodeError, PlcError, RequestError } from '../../errors'
import type { AddressOptions } from '../../melsec/device/address'
import type { CallOptions } from '../connection/call'
import type { Deadline } from '../connection/deadline'
import { about } from '../item/about'
import type { ParsedItem, RefusedItem } from '../item/item'
import type { ReadResult } from '../item/item-value'
import type { Item } from '../item/parts'
import type { Stretch } from './chunk'
import { namedItems } from './item-calls'
import { Areas, piecesOf, readLayout } from './layout'
import type { PlanProtocol } from './limit'
import { type DeviceRead, planRead } from './read'
import { type PreparedMonitor, prepareMonitor, type SendExchange } from './request'
import { type Place, placeOf, valueAt } from './value'
import type { OpenCall } from './write-turns'

/** What a monitor needs of its client. */
export interface MonitorOptions extends AddressOptions {
  readonly gap: number
  /** One call: its deadline, and how it sends. @throws RequestError BAD_OPTION */
  readonly call: (options: CallOptions | undefined) => MonitorCall
  readonly time: () => number
  readonly registration: Registration
  /** Why no registration can last on this connection, in words. */
  readonly unusable?: string | undefined
}

export type MonitorCall = Pick<OpenCall, 'deadline' | 'send'>

/**
 * What the PLC remembers of the connection: one registration at a time, forgotten with the connection. The monitors
 * of a client share it, one after another: between registering and asking no other may register.
 */
export class Registration {
  #owner: object | undefined
  #generation = -1
  #turn: Promise<unknown> = Promise.resolve()
  #turns = 0

  constructor(readonly generation: () => number) {}

  /** Runs `use` when every earlier one has ended. Whoever gives up waiting is passed over. */
  async inTurn<T>(deadline: Deadline, title: string, use: () => Promise<T>): Promise<T> {
    const before = this.#turn
    let end = () => {}
    const own = new Promise<void>((resolve) => {
      end = resolve
    })
    this.#turn = before.then(() => own)
    this.#turns++
    try {
      if (this.#turns > 1) await deadline.wait(before, title)
      return await use()
    } finally {
      this.#turns--
      end()
    }
  }

  isOf(owner: object): boolean {
    return this.#owner === owner && this.#generation === this.generation()
  }

  take(owner: object, generation: number): void {
    this.#owner = owner
    this.#generation = generation
  }

  lose(): void {
    this.#owner = undefined
  }
}

/** Monitoring of some items; made by `client.monitor(items)`. */
export interface Monitor<R = ReadResult[]> {
  /**
   * `monitor`: registered in the PLC. `read`: read anew each time, because they cannot be registered together, or, since
   * the last `read()`, because the PLC has refused to register them.
   */
  readonly mode: 'monitor' | 'read'
  /** Why the PLC's monitor is not used, in words; undefined when it is. */
  readonly note: string | undefined
  /** Reads all items once; each has its own result. */
  read(options?: CallOptions): Promise<R>
}

/** The monitor of items by name: its results are by name, too. */
export function namedMonitor(
  items: Readonly<Record<string, Item>>,
  monitorOf: (items: readonly Item[]) => Monitor,
): Monitor<unknown> {
  const { list, named } = namedItems(items)
  const monitor = monitorOf(list)
  return {
    get mode() {
      return monitor.mode
    },
    get note() {
      return monitor.note
    },
    read: async (options) => named(await monitor.read(options)),
  }
}

/** A refusal of the PLC, and the connection it was on. */
interface Refused {
  readonly error: EndCodeError
  readonly generation: number
}

export class ItemMonitor implements Monitor {
  readonly #options: MonitorOptions
  readonly #registered: Registered | undefined
  readonly #plan: DeviceRead
  readonly #problem: RequestError | undefined
  /** The PLC does not register these items on this connection. After another connection it is asked again. */
  #refused: Refused | undefined

  constructor(items: readonly (ParsedItem | RefusedItem)[], protocol: PlanProtocol, options: MonitorOptions) {
    this.#options = options
    this.#plan = planRead(items, protocol, options)
    try {
      if (options.unusable !== undefined) throw new RequestError('UNSUPPORTED', options.unusable)
      this.#registered = new Registered(items, protocol, options)
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
      this.#problem = error
    }
  }

  get mode(): 'monitor' | 'read' {
    return this.#registered === undefined || this.#refusal() !== undefined ? 'read' : 'monitor'
  }

  get note(): string | undefined {
    const reason = this.#problem ?? this.#refusal()
    return reason && `The items are read without monitor commands. ${reason.message}`
  }

  #refusal(): EndCodeError | undefined {
    const refused = this.#refused
    return refused?.generation === this.#options.registration.generation() ? refused.error : undefined
  }

  async read(options?: CallOptions): Promise<ReadResult[]> {
    const call = this.#options.call(options)
    if (this.#registered === undefined || this.#refusal() !== undefined) return this.#plain(call)
    const results = await this.#registered.read(call)
    if (!(results instanceof EndCodeError)) return results
    // One item may be to blame, or the PLC has no monitor: reading finds out, and leaves the other items alone.
    this.#refused = { error: results, generation: this.#options.registration.generation() }
    return this.#plain(call)
  }

  #plain({ send }: MonitorCall): Promise<ReadResult[]> {
    return this.#plan.run(send, this.#options.time)
  }
}

/** The items as one registration. */
class Registered {
  readonly #items: readonly (ParsedItem | RefusedItem)[]
  readonly #places: readonly Place[]
  readonly #prepared: PreparedMonitor
  readonly #options: MonitorOptions

  /** @throws RequestError when the items cannot be registered together. */
  constructor(items: readonly (ParsedItem | RefusedItem)[], protocol: PlanProtocol, options: MonitorOptions) {
    this.#items = items
    this.#options = options
    const areas = new Areas(protocol, 'read')
    const runs = items.flatMap((item, index) => ('error' in item ? [] : [runOf(areas, item, index)]))
    this.#prepared = prepareMonitor(protocol, runs)
    this.#places = runs.flatMap((run) => placesOf(run, items, this.#prepared.offsets.get(run) ?? 0))
  }

  /** The results; an end code when the PLC refuses to register the items or to read them. */
  async read({ deadline, send }: MonitorCall): Promise<ReadResult[] | EndCodeError> {
    try {
      const { registration } = this.#options
      const words = await registration.inTurn(deadline, 'Execute Monitor', () => this.#fetch(send))
      return this.#results(words)
    } catch (error) {
      if (error instanceof EndCodeError) return error
      if (!(error instanceof PlcError)) throw error
      const timestamp = this.#options.time()
      return this.#items.map((item) => ({
        item: item.text,
        ok: false,
        error: 'error' in item ? item.error : error,
        timestamp,
      }))
    }
  }

  async #fetch(send: SendExchange): Promise<ArrayLike<number>> {
    const { registration } = this.#options
    const isNew = !registration.isOf(this)
    if (isNew) await this.#register(send)
    try {
      return await this.#prepared.fetch(send)
    } catch (error) {
      // A PLC that restarted behind a connection that lives has forgotten the registration, and so has one whose
      // connection was made anew in between: once more, then it is an error.
      if (!(error instanceof EndCodeError) || (isNew && registration.isOf(this))) throw error
      await this.#register(send)
      return this.#prepared.fetch(send)
    }
  }

  async #register(send: SendExchange): Promise<void> {
    const { registration } = this.#options
    registration.lose()
    await send(this.#prepared.entry)
    registration.take(this, registration.generation())
  }

  #results(words: ArrayLike<number>): ReadResult[] {
    const timestamp = this.#options.time()
    const results = this.#items.map((item): ReadResult | undefined =>
      'error' in item ? { item: item.text, ok: false, error: item.error, timestamp } : undefined,
    )
    for (const place of this.#places) results[place.item] = this.#resultOf(words, place, timestamp)
    return results.filter((result) => result !== undefined)
  }

  #resultOf(words: ArrayLike<number>, place: Place, timestamp: number): ReadResult {
    const item = this.#items[place.item]?.text ?? ''
    try {
      return { item, ok: true, value: valueAt(words, place), timestamp }
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      return { item, ok: false, error: about(error, [{ item }]), timestamp }
    }
  }
}

function runOf(areas: Areas, item: ParsedItem, index: number): Stretch {
  const [piece, ...others] = piecesOf(areas, readLayout(areas, item), item, index)
  if (piece === undefined || others.length > 0 || piece.layout.area.ways.random === undefined) {
    const message = 'it cannot be registered: monitors take what Read Random takes.'
    throw about(new RequestError('UNSUPPORTED', message), [{ item: item.text }])
  }
  return { area: piece.layout.area, from: piece.from, to: piece.to, members: [piece] }
}

function placesOf(run: Stretch, items: readonly (ParsedItem | RefusedItem)[], offset: number): Place[] {
  return run.members.flatMap((piece) => {
    const item = items[piece.item]
    return item === undefined || 'error' in item ? [] : [placeOf(piece, item, offset, run.from)]
  })
}
