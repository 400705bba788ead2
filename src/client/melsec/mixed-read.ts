// Labels beside devices in one list: a plan and a monitor that read both and give the results in the order of the items.

import { EndCodeError, type PlcError } from '../../errors'
import type { CallOptions } from '../connection/call'
import { about } from '../item/about'
import type { ParsedItem, RefusedItem } from '../item/item'
import type { ReadResult } from '../item/item-value'
import { describeLabelRead } from '../label/describe'
import { type AnyItem, isLabel, type LabelInItems } from '../label/in-items'
import type { AskedLabel, LabelFormat } from '../label/item'
import { type LabelOutcome, readLabels } from '../label/read'
import { LabelRequests } from '../label/request'
import type { LabelType } from '../label/value'
import type { PlanProtocol } from '../plan/limit'
import type { Monitor, MonitorCall } from '../plan/monitor'
import type { ReadPlan } from '../plan/plans'
import type { PlanDescription } from '../plan/request'
import { planText } from '../plan/request'

/** What the client lends for labels among items. */
export interface LabelLender {
  readonly protocol: PlanProtocol
  readonly format: LabelFormat
  /** ms since 1970 */
  readonly time: () => number
}

/** The requests of one call for labels, over the same connection and with the same deadline as the others. */
export function labelRequests(protocol: PlanProtocol, { send }: MonitorCall): LabelRequests {
  return new LabelRequests({ protocol, send: async (command, message) => send(protocol.exchange(command, message)) })
}

/** The items of a list by what they are, and how their results get into one list again. */
export class MixedItems {
  readonly devices: readonly (ParsedItem | RefusedItem)[]
  readonly labels: readonly LabelInItems[]
  readonly #items: readonly AnyItem[]

  constructor(items: readonly AnyItem[]) {
    this.#items = items
    this.labels = items.filter(isLabel)
    this.devices = items.filter((item): item is ParsedItem | RefusedItem => !isLabel(item))
  }

  merged(devices: readonly ReadResult[], labels: readonly LabelOutcome[]): ReadResult[] {
    const left = { devices: [...devices], labels: [...labels] }
    return this.#items.map((item): ReadResult => {
      if (!isLabel(item)) return oneMore(left.devices.shift(), item)
      return labelResult(item, oneMore(left.labels.shift(), item))
    })
  }
}

/** There is a result for each item. */
function oneMore<T>(result: T | undefined, { text }: AnyItem): T {
  if (result !== undefined) return result
  throw new TypeError(`There is no result for ${text}.`)
}

function labelResult({ text: item }: LabelInItems, outcome: LabelOutcome): ReadResult {
  if (outcome.ok || !(outcome.error instanceof EndCodeError)) return { item, ...outcome }
  return { item, ...outcome, error: about(outcome.error, [{ item }]) }
}

/** Reads the labels of a list anew each time, and remembers the types for its description. */
export class LabelReader {
  readonly #labels: readonly LabelInItems[]
  readonly #lender: LabelLender
  readonly #types = new Map<AskedLabel, LabelType>()

  constructor(labels: readonly LabelInItems[], lender: LabelLender) {
    this.#labels = labels
    this.#lender = lender
  }

  read(call: MonitorCall): Promise<LabelOutcome[]> {
    const { protocol, format, time } = this.#lender
    const asked: readonly (AskedLabel | PlcError)[] = this.#labels.map(({ label }) => label)
    const onType = (label: AskedLabel, type: LabelType) => void this.#types.set(label, type)
    return readLabels(asked, { requests: labelRequests(protocol, call), format, time, onType })
  }

  describe(): PlanDescription {
    return describeLabelRead(this.#lender.protocol, this.#labels, this.#types)
  }
}

/** A plan of devices, ready to be sent by a call. */
interface DevicePlan {
  run(send: MonitorCall['send'], time: () => number): Promise<ReadResult[]>
  describe(): PlanDescription
}

export function mixedReadPlan(
  items: MixedItems,
  devices: DevicePlan,
  lender: LabelLender,
  call: (options: CallOptions | undefined) => MonitorCall,
): ReadPlan {
  const labels = new LabelReader(items.labels, lender)
  const describe = () => joined([devices.describe(), labels.describe()])
  return {
    run: async (options) => {
      const opened = call(options)
      const results = await Promise.all([devices.run(opened.send, lender.time), labels.read(opened)])
      return items.merged(...results)
    },
    describe,
    toString: () => planText(describe()),
  }
}

function joined(descriptions: readonly PlanDescription[]): PlanDescription {
  return {
    requests: descriptions.flatMap(({ requests }) => requests),
    notes: descriptions.flatMap(({ notes }) => notes),
  }
}

/** Devices are registered as without labels; the monitor commands know no labels, so they are read each time. */
export function mixedMonitor(
  items: MixedItems,
  devices: Monitor | undefined,
  lender: LabelLender,
  call: (options: CallOptions | undefined) => MonitorCall,
): Monitor {
  const labels = new LabelReader(items.labels, lender)
  const names = items.labels.map(({ text }) => text).join(', ')
  const note = `The monitor commands take devices only: ${names} ${items.labels.length === 1 ? 'is' : 'are'} read anew each time.`
  return {
    get mode() {
      return devices?.mode ?? 'read'
    },
    get note() {
      return devices?.note === undefined ? note : `${devices.note} ${note}`
    },
    read: async (options) => {
      const opened = call(options)
      const left = opened.deadline.options('Reading')
      const results = await Promise.all([devices?.read(left) ?? [], labels.read(opened)])
      return items.merged(...results)
    },
  }
}
