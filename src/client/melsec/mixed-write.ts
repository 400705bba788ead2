/**
 * Labels beside devices in one write, in the order given.
 *
 * Everything about devices is checked before anything is sent. Then the types of all labels are read, and their values
 * made into words, before anything is written. Entries of one kind that follow one another go out together.
 */
import { ClosedError, type PlcError } from '../../errors'
import type { PlainValue } from '../item/item-value'
import { attempt, isFine } from '../item/value-or-error'
import { stopsOrder } from '../item/write-outcome'
import { describeLabelTypes, describeLabelWrite } from '../label/describe'
import { type AnyItem, isLabel, type LabelInItems } from '../label/in-items'
import { type LabelRequests, type LabelWrite, notWritten } from '../label/request'
import { type LabelEntry, labelEntry, labelWrites } from '../label/write'
import type { MonitorCall } from '../plan/monitor'
import type { PlanDescription } from '../plan/request'
import { planText } from '../plan/request'
import { type PlannedEntry, type PlanWriteOptions, planWrite, type WriteResult } from '../plan/write'
import { type LabelLender, labelRequests } from './mixed-read'

/** One value to write, its item understood. */
export interface MixedEntry {
  readonly item: AnyItem
  readonly value: PlainValue
}

/** A label of the write. */
interface LabelStep extends LabelInItems {
  readonly entry: number
  readonly written: LabelEntry
}

/** Entries of one kind that follow one another. */
type Step = { readonly entries: readonly number[] } & (
  | { readonly labels: readonly LabelStep[] }
  | { readonly plan: ReturnType<typeof planWrite> }
)

export class MixedWrite {
  readonly #entries: readonly MixedEntry[]
  readonly #lender: LabelLender
  readonly #options: PlanWriteOptions
  /** Entries that cannot be written, as far as it is known without the PLC. */
  readonly #errors = new Map<number, PlcError>()
  readonly #steps: readonly Step[]

  constructor(entries: readonly MixedEntry[], lender: LabelLender, options: PlanWriteOptions) {
    this.#entries = entries
    this.#lender = lender
    this.#options = options
    this.#checkDevices()
    this.#steps = this.#stepsOf(this.#labelSteps())
  }

  get changesBits(): boolean {
    return this.#steps.some((step) => 'plan' in step && step.plan.changesBits)
  }

  get #stops(): boolean {
    return this.#options.allOrNothing === true
  }

  /** All devices as one plan: what is wrong with one of them, and one that is written twice. */
  #checkDevices(): void {
    const devices = this.#entries.flatMap((entry, index) => (isDevice(entry) ? [{ entry, index }] : []))
    const options = { ...this.#options, allOrNothing: false }
    const plan = planWrite(
      devices.map(({ entry }) => entry),
      this.#lender.protocol,
      options,
    )
    devices.forEach(({ index }, at) => {
      const error = plan.errorOf(at)
      if (error !== undefined) this.#errors.set(index, error)
    })
  }

  #labelSteps(): ReadonlyMap<number, LabelStep> {
    const steps = new Map<number, LabelStep>()
    this.#entries.forEach(({ item, value }, entry) => {
      if (!isLabel(item)) return
      const written = attempt(() => labelEntry(item.label, value))
      if (isFine(written)) steps.set(entry, { text: item.text, label: written.asked, entry, written })
      else this.#errors.set(entry, written)
    })
    return steps
  }

  #stepsOf(labels: ReadonlyMap<number, LabelStep>): Step[] {
    const runs: number[][] = []
    for (const entry of this.#entries.keys()) {
      if (this.#errors.has(entry)) continue
      const last = runs.at(-1)
      if (last?.[0] !== undefined && labels.has(last[0]) === labels.has(entry)) last.push(entry)
      else runs.push([entry])
    }
    return runs.map((entries): Step => {
      const steps = entries.flatMap((entry) => labels.get(entry) ?? [])
      return steps.length > 0 ? { entries, labels: steps } : { entries, plan: this.#devicePlan(entries) }
    })
  }

  #devicePlan(entries: readonly number[]) {
    const devices = entries.flatMap((entry) => this.#entries[entry] ?? []).filter(isDevice)
    return planWrite(devices, this.#lender.protocol, this.#options)
  }

  /** Writes all entries once. @returns a result for each, in their order */
  async run(call: MonitorCall): Promise<WriteResult[]> {
    const errors = new Map(this.#errors)
    const requests = labelRequests(this.#lender.protocol, call)
    const writes = this.#stops && errors.size > 0 ? undefined : await this.#writesOf(requests, errors)
    if (writes === undefined || (this.#stops && errors.size > 0)) this.#refuseAll(errors)
    else for (const step of this.#steps) await this.#perform(step, { call, requests, writes, errors })
    return this.#entries.map(({ item: { text: item } }, entry) => {
      const error = errors.get(entry)
      return error === undefined ? { item, ok: true } : { item, ok: false, error }
    })
  }

  /** What the labels are to hold. Reads their types. */
  async #writesOf(requests: LabelRequests, errors: Map<number, PlcError>): Promise<ReadonlyMap<number, LabelWrite>> {
    const labels = this.#steps.flatMap((step) => ('labels' in step ? step.labels : []))
    const written = labels.map((label) => label.written)
    const contents = await labelWrites(written, requests, this.#lender.format)
    const writes = new Map<number, LabelWrite>()
    contents.forEach((content, at) => {
      const entry = labels[at]?.entry ?? -1
      if (isFine(content)) writes.set(entry, content)
      else errors.set(entry, content)
    })
    return writes
  }

  #refuseAll(errors: Map<number, PlcError>): void {
    const [cause] = errors.values()
    if (cause === undefined) return
    this.#entries.forEach(({ item: { text } }, entry) => {
      if (errors.has(entry)) return
      const message = `${text} was not written, because all or nothing shall be: ${cause.message}`
      errors.set(entry, new ClosedError('ABORTED', message, 'notSent', cause))
    })
  }

  async #perform(step: Step, { call, requests, writes, errors }: Writing): Promise<void> {
    const cause = [...errors.values()].find((error) => this.#stops || stopsOrder(error))
    if (cause !== undefined) {
      for (const entry of step.entries) if (!errors.has(entry)) errors.set(entry, notWritten(cause))
      return
    }
    if ('plan' in step) {
      const results = await step.plan.run(call.send)
      step.entries.forEach((entry, at) => {
        const result = results[at]
        if (result?.ok === false) errors.set(entry, result.error)
      })
      return
    }
    const failed = await requests.write(
      step.entries.flatMap((entry) => writes.get(entry) ?? []),
      this.#stops,
    )
    for (const entry of step.entries) {
      const write = writes.get(entry)
      const error = write && failed.get(write.asked)
      if (error !== undefined) errors.set(entry, error)
    }
  }

  describe(): PlanDescription {
    const labels = this.#steps.flatMap((step) => ('labels' in step ? step.labels : []))
    const { protocol } = this.#lender
    const types = describeLabelTypes(protocol, labels)
    const steps = this.#steps.map((step): PlanDescription => {
      return 'plan' in step ? step.plan.describe() : { requests: describeLabelWrite(protocol, step.labels), notes: [] }
    })
    return {
      requests: [...types, ...steps.flatMap(({ requests }) => requests)],
      notes: [
        ...steps.flatMap(({ notes }) => notes),
        ...(labels.length === 0 ? [] : [UNKNOWN_SIZES]),
        ...[...this.#errors].map(
          ([entry, { message }]) => `${this.#entries[entry]?.item.text} is not written. ${message}`,
        ),
      ],
    }
  }

  toString(): string {
    return planText(this.describe())
  }
}

const UNKNOWN_SIZES =
  'The PLC says the types of labels before they are written: how long these requests are, and whether one holds them, is known then.'

/** One run. */
interface Writing {
  readonly call: MonitorCall
  readonly requests: LabelRequests
  /** By entry. */
  readonly writes: ReadonlyMap<number, LabelWrite>
  /** What became of the entries so far; no error: written, or still to be. */
  readonly errors: Map<number, PlcError>
}

function isDevice(entry: MixedEntry): entry is PlannedEntry {
  return !isLabel(entry.item)
}
