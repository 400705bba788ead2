// Typed items of one client: what becomes a plan, a monitor, or a call to the labels.
import { RequestError } from '../errors'
import type { Exchange } from '../link/link'
import { namedAsFx5 } from '../melsec/a-compatible-rules'
import type { Head3e } from '../melsec/frame-3e'
import type { ClientProtocol } from '../melsec/protocol'
import type { CallOptions } from './call'
import type { ReadPlan, WriteEntry, WritePlan } from './client-types'
import { Deadline } from './deadline'
import { checkBooleans, listOf } from './given'
import { isLabelItem, type MixedAccess, readWithLabels, writeWithLabels } from './label-in-items'
import { ItemMonitor, type Monitor, type MonitorCall, type Registration } from './monitor'
import type { Settings } from './options'
import {
  explainItem,
  type Item,
  type ItemExplanation,
  type ParsedItem,
  parseItem,
  planRead,
  planWrite,
  type RefusedItem,
  type WriteOptions,
  type WriteResult,
} from './plan'
import { refuseAmbiguousXy } from './xy-notation'

/** Plans of `read` that are kept. A program that reads ever new lists must not fill the memory with them. */
const PREPARED_PLANS = 500

/** What the client lends to its items. */
export interface ItemParts {
  readonly settings: Settings
  readonly protocol: ClientProtocol<Head3e>
  readonly labels: MixedAccess['labels']
  readonly registration: Registration
  /** One call: all its requests share one deadline. @throws RequestError BAD_OPTION */
  readonly call: (options: CallOptions | undefined) => MonitorCall<Head3e>
  /** @throws RequestError NOT_PERMITTED */
  readonly permit: (effect: Exchange<Head3e, unknown>['effect'], title: string) => void
}

export class ItemAccess {
  readonly #parts: ItemParts
  readonly #mixed: MixedAccess
  readonly #prepared = new Map<string, ReadPlan>()
  /** A monitor of this client is registered, as far as UDP goes: see `#monitorUnusable`. */
  #monitored = false

  constructor(parts: ItemParts) {
    const { settings, labels } = parts
    this.#parts = parts
    this.#mixed = {
      labels,
      read: (items, call) => this.prepare(items).run(call),
      write: (entries, call) => this.planWrite(entries, call).run(call),
      deadline: (call) => new Deadline(settings.clock, call, settings.timeout),
      time: () => settings.clock.time(),
    }
  }

  /** A plan is made once and found again by its texts: programs read the same few lists of items all day. */
  prepare(items: readonly Item[]): Pick<ReadPlan, 'run'> {
    if (items.some(isLabelItem)) return { run: (options) => readWithLabels(items, options, this.#mixed) }
    if (!items.every((item) => typeof item === 'string')) return this.plan(items)
    // Not joined: whatever stood between two texts could also stand in one.
    const key = JSON.stringify(items)
    const known = this.#prepared.get(key)
    if (known !== undefined) return known
    const plan = this.plan(items)
    if (this.#prepared.size >= PREPARED_PLANS) this.#prepared.clear()
    this.#prepared.set(key, plan)
    return plan
  }

  plan(items: readonly Item[]): ReadPlan {
    const { settings, protocol, call } = this.#parts
    const plan = planRead(
      listOf(items, 'items').map((item) => this.#parse(item)),
      protocol,
      this.#planOptions,
    )
    return {
      run: async (options) => plan.run(call(options).send, () => settings.clock.time()),
      describe: () => plan.describe(),
      toString: () => plan.toString(),
    }
  }

  async write(
    entries: readonly WriteEntry[],
    options: (CallOptions & WriteOptions) | undefined,
  ): Promise<WriteResult[]> {
    const hasLabels = listOf(entries, 'entries').some((entry) => isLabelItem(entry?.item))
    if (hasLabels) return writeWithLabels(entries, options ?? {}, this.#mixed)
    return this.planWrite(entries, options).run(options)
  }

  planWrite(entries: readonly WriteEntry[], options: WriteOptions = {}): WritePlan {
    const { settings, protocol, call, permit } = this.#parts
    checkBooleans(options, ['readModifyWrite', 'allOrNothing'])
    // An entry that is none is an item that is none.
    const parsed = listOf(entries, 'entries').map((entry) => ({ item: this.#parse(entry?.item), value: entry?.value }))
    const plan = planWrite(parsed, protocol, { ...options, xyRadix: settings.xyRadix })
    return {
      run: async (callOptions) => {
        // Before anything is sent, also the reading of a word that a bit is changed in.
        permit('write', 'Writing')
        return plan.run(call(callOptions).send)
      },
      describe: () => plan.describe(),
      toString: () => plan.toString(),
    }
  }

  monitor(items: readonly Item[]): Monitor {
    const { settings, protocol, registration, call } = this.#parts
    const monitor = new ItemMonitor(
      listOf(items, 'items').map((item) => this.#parse(item)),
      protocol,
      {
        ...this.#planOptions,
        call,
        time: () => settings.clock.time(),
        registration,
        unusable: this.#monitorUnusable(),
      },
    )
    this.#monitored ||= monitor.mode === 'monitor'
    return monitor
  }

  /** @throws RequestError when it is not an item. */
  explain(item: Item): ItemExplanation {
    const parsed = this.#parse(item)
    if ('error' in parsed) throw parsed.error
    return explainItem(parsed, this.#parts.protocol, { xyRadix: this.#parts.settings.xyRadix })
  }

  get #planOptions(): { readonly gap: number; readonly xyRadix: 8 | 16 } {
    const { gap, xyRadix } = this.#parts.settings
    return { gap, xyRadix }
  }

  #parse(item: Item): ParsedItem | RefusedItem {
    try {
      const { xyRadix, xyUnknown, format } = this.#parts.settings
      const parsed = this.#renamed(parseItem(item, { xyRadix, format }))
      if (xyUnknown) refuseAmbiguousXy(item, parsed)
      return parsed
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
      return { text: typeof item === 'string' ? item : String(item?.address), error }
    }
  }

  #renamed(item: ParsedItem): ParsedItem {
    return this.#parts.settings.profile.id === 'fx3' ? { ...item, address: namedAsFx5(item.address) } : item
  }

  /** The PLC registers per connection, and over UDP that is the local port. */
  #monitorUnusable(): string | undefined {
    const { transport, frame } = this.#parts.settings
    if (transport !== 'udp') return undefined
    if (frame === '3E') {
      return 'Over UDP the 3E frame changes the local port with every request, so the PLC would not find the registration again. The 4E frame or TCP would.'
    }
    if (!this.#monitored) return undefined
    return 'Another monitor of this client is registered. Over UDP a registration may arrive twice or late, and take the place of this one without anybody noticing. Over TCP they take turns.'
  }
}
