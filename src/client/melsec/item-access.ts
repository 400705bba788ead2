// Typed items of one client: what becomes a plan, a monitor, or a call to the labels.

import type { OptionNames } from '../../basics/option-checks'
import { checkBooleans, checkNames } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { RequestError } from '../../errors'
import type { Exchange } from '../../link/link'
import { longCounterHint, namedAsFx5 } from '../../melsec/a-compatible/windows'
import type { ClientProtocol } from '../../melsec/client-protocol'
import { commands } from '../../melsec/commands/commands'
import type { AddressOptions } from '../../melsec/device/address'
import { frameFacts } from '../../melsec/frame/frames'
import { type CallOptions, callOptionsOf } from '../connection/call'
import { isItem, listOf } from '../item/input-checks'
import { type ItemParseOptions, type ParsedItem, parseItem } from '../item/item'
import type { WriteEntry } from '../item/item-value'
import type { Item } from '../item/parts'
import { asPlainValue } from '../item/plain-values'
import { checkAllWritten } from '../item/write-outcome'
import { refuseAmbiguousXy } from '../item/xy-notation'
import { explainLabel, type ItemExplanation } from '../label/explain'
import { type AnyItem, hasPrefix, isLabel, itemText, labelInstead, parsedLabel } from '../label/in-items'
import { randomMessage } from '../label/request'
import { explainItem } from '../plan/explain'
import type { ItemSource } from '../plan/item-calls'
import { ItemMonitor, type Monitor, type Registration } from '../plan/monitor'
import type { ReadPlan, WritePlan } from '../plan/plans'
import { PreparedPlans } from '../plan/prepared-plans'
import { planRead } from '../plan/read'
import { rejecting } from '../plan/rejecting'
import type { SendExchange } from '../plan/request'
import { type PlannedEntry, planWrite, type WriteCallOptions, type WriteOptions, type WriteResult } from '../plan/write'
import type { OpenCall } from '../plan/write-turns'
import { type LabelLender, MixedItems, mixedMonitor, mixedReadPlan } from './mixed-read'
import { type MixedEntry, MixedWrite } from './mixed-write'
import type { Settings } from './settings'

const WRITE_OPTIONS: OptionNames<WriteOptions> = { readModifyWrite: true, allOrNothing: true }

/** What the client lends to its items. */
export interface ItemParts {
  readonly settings: Settings
  readonly protocol: ClientProtocol
  readonly registration: Registration
  /** One call: all its requests share one deadline. @throws RequestError BAD_OPTION */
  readonly call: (options: CallOptions | undefined) => OpenCall
  /** @throws RequestError NOT_PERMITTED */
  readonly permit: (effect: Exchange<unknown>['effect'], title: string) => void
}

export class ItemAccess implements ItemSource {
  readonly #parts: ItemParts
  readonly #lender: LabelLender
  readonly #itemOptions: ItemParseOptions
  readonly #prepared = new PreparedPlans((items) => this.plan(items))
  /** A monitor of this client is registered, as far as UDP goes: see `#monitorUnusable`. */
  #monitored = false

  constructor(parts: ItemParts) {
    const { settings, protocol } = parts
    this.#parts = parts
    this.#itemOptions = { ...this.#notation, format: settings.format }
    this.#lender = { protocol, format: settings.labelFormat, time: () => settings.clock.time() }
  }

  prepare(items: readonly Item[]): Pick<ReadPlan, 'run'> {
    return this.#prepared.prepare(items)
  }

  plan(items: readonly Item[]): ReadPlan {
    const { protocol, call } = this.#parts
    const mixed = new MixedItems(listOf(items, 'items').map((item, index) => this.#listed(item, `items[${index}]`)))
    const plan = planRead(mixed.devices, protocol, this.#planOptions)
    if (mixed.labels.length > 0) return mixedReadPlan(mixed, plan, this.#lender, call)
    return {
      run: (options) => rejecting(() => plan.run(call(options).send, this.#lender.time)),
      describe: () => plan.describe(),
      toString: () => plan.toString(),
    }
  }

  /** A result for each entry, in their order. */
  async write(entries: readonly WriteEntry[], options: WriteCallOptions | undefined): Promise<WriteResult[]> {
    const call = callOptionsOf(options, WRITE_OPTIONS)
    const { readModifyWrite, allOrNothing } = options ?? {}
    const how = {
      ...(readModifyWrite === undefined ? {} : { readModifyWrite }),
      ...(allOrNothing === undefined ? {} : { allOrNothing }),
    }
    return this.planWrite(entries, how).runEach(call)
  }

  planWrite(entries: readonly WriteEntry[], options: WriteOptions = {}): WritePlan {
    const { protocol, call, permit } = this.#parts
    checkNames('', options, { ...WRITE_OPTIONS })
    checkBooleans(options, ['readModifyWrite', 'allOrNothing'])
    // An entry that is none is an item that is none.
    const parsed = listOf(entries, 'entries').map(
      (entry, index): MixedEntry => ({
        item: this.#listed(entry?.item, `entries[${index}].item`),
        value: asPlainValue(entry?.value),
      }),
    )
    const all = { ...options, ...this.#notation }
    const devices: readonly PlannedEntry[] = parsed.filter(isPlanned)
    const isMixed = devices.length < parsed.length
    const plan = isMixed ? new MixedWrite(parsed, this.#lender, all) : planWrite(devices, protocol, all)
    const runEach = async (callOptions?: CallOptions) => {
      // Before anything is sent, also the reading of a word that a bit is changed in, or of the type of a label.
      permit('write', 'Writing')
      const opened = call(callOptions)
      const run = (send: SendExchange) => (plan instanceof MixedWrite ? plan.run({ ...opened, send }) : plan.run(send))
      return plan.changesBits ? opened.alone(run) : run(opened.send)
    }
    return {
      run: async (callOptions) => checkAllWritten(await runEach(callOptions)),
      runEach,
      describe: () => plan.describe(),
      toString: () => plan.toString(),
    }
  }

  monitor(items: readonly Item[]): Monitor {
    const { settings, protocol, registration, call } = this.#parts
    const mixed = new MixedItems(listOf(items, 'items').map((item, index) => this.#listed(item, `items[${index}]`)))
    const monitor = new ItemMonitor(mixed.devices, protocol, {
      ...this.#planOptions,
      call,
      time: () => settings.clock.time(),
      registration,
      unusable: this.#monitorUnusable(),
    })
    if (mixed.labels.length > 0 && mixed.devices.length === 0) return mixedMonitor(mixed, undefined, this.#lender, call)
    this.#monitored ||= monitor.mode === 'monitor'
    return mixed.labels.length === 0 ? monitor : mixedMonitor(mixed, monitor, this.#lender, call)
  }

  /** @throws RequestError when it is not an item. */
  explain(item: Item): ItemExplanation {
    const parsed = this.#parse(item)
    if ('error' in parsed) throw parsed.error
    if (isLabel(parsed)) return explainLabel(parsed, this.#parts.protocol)
    return explainItem(parsed, this.#parts.protocol, this.#notation)
  }

  get #isCalledAsInFrame(): boolean {
    return this.#parts.settings.profile.aCompatible?.calledAsInFrame === true
  }

  get #planOptions(): { readonly gap: number } & AddressOptions {
    return { gap: this.#parts.settings.gap, ...this.#notation }
  }

  get #notation(): AddressOptions {
    const { xyRadix, wRadix } = this.#parts.settings
    return { xyRadix, wRadix }
  }

  /** An item of a list. What is none has no text to be called by, so its place names it. */
  #listed(item: Item, place: string): AnyItem {
    return isItem(item) ? this.#parse(item) : { text: place, error: noItem(item, place) }
  }

  #parse(item: Item): AnyItem {
    if (hasPrefix(item)) return this.#askable(parsedLabel(item))
    const longCounter = this.#longCounter(item)
    if (longCounter !== undefined) return longCounter
    const { xyUnknown, profile } = this.#parts.settings
    try {
      const parsed = this.#renamed(parseItem(item, this.#itemOptions))
      if (xyUnknown) refuseAmbiguousXy(item, parsed)
      return parsed
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
      return this.#askable(labelInstead(item, error, { profile }))
    }
  }

  /** A label that this PLC can be asked for: it has labels, and a request holds the name. */
  #askable(item: AnyItem): AnyItem {
    if (!isLabel(item)) return item
    try {
      this.#parts.protocol.exchange(commands.readRandomLabels, randomMessage([item.label]))
      return item
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
      const message = `${shown(item.text)}: ${error.message}`
      return { text: item.text, error: new RequestError(error.code, message, error.field) }
    }
  }

  /** At once, because the ways over its parts would lead to a counter of 16 bits first. */
  #longCounter(item: Item): AnyItem | undefined {
    if (!this.#isCalledAsInFrame) return undefined
    const text = itemText(item)
    const hint = longCounterHint(text)
    if (hint === undefined) return undefined
    return { text, error: new RequestError('BAD_ADDRESS', `${JSON.stringify(text)}: ${hint}`, text) }
  }

  #renamed(item: ParsedItem): ParsedItem {
    return this.#isCalledAsInFrame ? { ...item, address: namedAsFx5(item.address) } : item
  }

  /** The PLC registers per connection; over UDP that is the local port, on a serial line whoever speaks. */
  #monitorUnusable(): string | undefined {
    const { transport, frame, serialLine } = this.#parts.settings
    if (serialLine?.isShared === true) return ON_SHARED_LINE
    if (transport !== 'udp') return undefined
    if (!frameFacts[frame].serial) {
      return `Over UDP the ${frameFacts[frame].title} frame changes the local port with every request, so the PLC would not find the registration again. The 4E frame or TCP would.`
    }
    if (!this.#monitored) return undefined
    return 'Another monitor of this client is registered. Over UDP a registration may arrive twice or late, and take the place of this one without anybody noticing. Over TCP they take turns.'
  }
}

const ON_SHARED_LINE =
  'A PLC on a serial line remembers one registration, whoever made it: others who ask it on a line that is shared, or behind a device server, could replace it without anybody noticing.'

function noItem(given: unknown, place: string): RequestError {
  const isObject = typeof given === 'object' && given !== null && 'address' in given
  const what = isObject ? `${place}.address is ${shown(given.address)}` : `${place} is ${shown(given)}`
  const message = `${what}: an item is a text such as D100:REAL, or an object with such an address.`
  return new RequestError('BAD_ADDRESS', message, isObject ? 'address' : place)
}

function isPlanned(entry: MixedEntry): entry is PlannedEntry {
  return !isLabel(entry.item)
}
