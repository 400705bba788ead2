// Global labels by name: typed values out of the label commands, in as few requests as fit (SLMP reference manual 5.3).

import type { OptionNames } from '../../basics/option-checks'
import { checkBooleans } from '../../basics/option-checks'
import type { PlcError } from '../../errors'
import { type CallOptions, callOptionsOf } from '../connection/call'
import { listOf, namesOf } from '../item/input-checks'
import type { WriteValue } from '../item/item-value'
import { asPlainValue, byName } from '../item/plain-values'
import { attempt, isFine } from '../item/value-or-error'
import { checkAllWritten } from '../item/write-outcome'
import { askedLabel, checkLabelFormat, type LabelFormat, type LabelItem, type LabelOptions } from './item'
import { type LabelValue, readLabels } from './read'
import { type LabelCall, LabelRequests } from './request'
import { labelEntry, labelWrites } from './write'

export type { LabelFormat, LabelItem, LabelItemOptions, LabelOptions } from './item'
export type { LabelValue } from './read'

/** What became of one label of a read. */
export type LabelReadResult =
  | {
      /** The label as it was given. */
      readonly label: string
      /** Whether there is a value. */
      readonly ok: true
      /** One value, or an array where the label has a count. */
      readonly value: LabelValue
      /** Data type of the label, as the PLC says it: `REAL`, `STRING(21)`. */
      readonly type: string
      /** ms since 1970 */
      readonly timestamp: number
      /** The elements were read by more than one request: the PLC may have changed them in between. */
      readonly torn?: true
    }
  | {
      readonly label: string
      readonly ok: false
      /** Why there is no value. */
      readonly error: PlcError
      readonly timestamp: number
    }

/** What became of one label of a write. */
export type LabelWriteResult =
  | {
      /** The label as it was given. */
      readonly label: string
      /** Whether it was written. */
      readonly ok: true
    }
  | {
      readonly label: string
      readonly ok: false
      /** Why not; `error.outcome` says whether the PLC may have been changed. */
      readonly error: PlcError
    }

/**
 * Global labels of an iQ-R CPU, by name. They must be open to external devices in GX Works3 ("Access from External
 * Device" of the global label editor). The PLC says the data type of each label, so none is given here.
 */
export interface Labels {
  /**
   * Reads one label: its value; throws what went wrong. Many: a result each, as `readEach` of the client.
   * @example await plc.labels.read('Line1.Speed')
   * @example await plc.labels.read(['Line1.Speed', { label: 'Line1.Values[0]', count: 10 }])
   */
  read(label: LabelItem, options?: LabelOptions): Promise<LabelValue>
  read(labels: readonly LabelItem[], options?: LabelOptions): Promise<LabelReadResult[]>
  /**
   * Writes labels in the order given. Needs `allowWrites`. The data types are read before anything is written. A list
   * goes to an array from the element named on. A write whose outcome is unknown is never repeated, and what stands
   * behind it is not sent.
   * @throws WriteError of many, when anything was not written; its `results` have each label as `item`
   * @example await plc.labels.write('Line1.Speed', 12.5)
   * @example await plc.labels.write({ 'Line1.Speed': 12.5, 'Line1.Values[0]': [1, 2, 3] })
   */
  write(label: string, value: WriteValue, options?: LabelOptions): Promise<void>
  write(values: Readonly<Record<string, WriteValue>>, options?: LabelOptions): Promise<void>
  /** Writes many as `write` does, with a result for each label instead of an error. Look at each of them. */
  writeEach(
    values: Readonly<Record<string, WriteValue>>,
    options?: LabelOptions,
  ): Promise<Record<string, LabelWriteResult>>
}

const LABEL_OPTIONS: OptionNames<LabelFormat> = { encoding: true, trimSpaces: true, asciiWordOrder: true }

/** What the client lends. */
export interface LabelParts {
  /** One call: all its requests share one deadline. */
  readonly call: (options: CallOptions | undefined) => LabelCall
  /** @throws RequestError NOT_PERMITTED */
  readonly permitWrite: () => void
  /** ms since 1970 */
  readonly time: () => number
  /** The client's own, unless a call says otherwise. */
  readonly format: LabelFormat
}

export function labelsOf(parts: LabelParts): Labels {
  return new LabelAccess(parts)
}

class LabelAccess implements Labels {
  readonly #parts: LabelParts

  constructor(parts: LabelParts) {
    this.#parts = parts
  }

  read(label: LabelItem, options?: LabelOptions): Promise<LabelValue>
  read(labels: readonly LabelItem[], options?: LabelOptions): Promise<LabelReadResult[]>
  async read(labels: LabelItem | readonly LabelItem[], options: LabelOptions = {}): Promise<unknown> {
    if (isItem(labels)) {
      const [result] = await this.#readList([labels], options)
      if (result?.ok === true) return result.value
      throw result?.error
    }
    return this.#readList(listOf(labels, 'labels'), options)
  }

  /** One call: its requests, and its options with the client's own behind them. @throws RequestError BAD_OPTION */
  #opened(options: LabelOptions): { readonly requests: LabelRequests; readonly format: LabelFormat } {
    const call = callOptionsOf(options, LABEL_OPTIONS)
    checkBooleans(options, ['trimSpaces'])
    const { encoding, trimSpaces, asciiWordOrder } = options
    const own = { encoding, trimSpaces, asciiWordOrder }
    const given: LabelFormat = Object.fromEntries(Object.entries(own).filter(([, value]) => value !== undefined))
    checkLabelFormat(given)
    return { requests: new LabelRequests(this.#parts.call(call)), format: { ...this.#parts.format, ...given } }
  }

  /** Many labels, each with its own result. */
  async #readList(items: readonly LabelItem[], options: LabelOptions): Promise<LabelReadResult[]> {
    const { requests, format } = this.#opened(options)
    const asked = items.map((item) => attempt(() => askedLabel(item)))
    const outcomes = await readLabels(asked, { requests, format, time: this.#parts.time })
    return outcomes.map((outcome, at) => ({ label: textOf(items[at]), ...outcome }))
  }

  write(label: string, value: WriteValue, options?: LabelOptions): Promise<void>
  write(values: Readonly<Record<string, WriteValue>>, options?: LabelOptions): Promise<void>
  async write(
    target: string | Readonly<Record<string, WriteValue>>,
    second?: WriteValue | LabelOptions,
    third?: LabelOptions,
  ): Promise<void> {
    if (typeof target === 'string') {
      const [result] = await this.#writeList([[target, second as WriteValue]], third)
      if (result?.ok === false) throw result.error
      return
    }
    const results = await this.writeEach(target, second as LabelOptions | undefined)
    checkAllWritten(Object.values(results).map(({ label, ...outcome }) => ({ item: label, ...outcome })))
  }

  async writeEach(
    values: Readonly<Record<string, WriteValue>>,
    options?: LabelOptions,
  ): Promise<Record<string, LabelWriteResult>> {
    const names = namesOf(values, 'Labels to write are a name and its value, or an object by name')
    const entries = names.map((name) => [name, values[name] as WriteValue] as const)
    return byName(names, await this.#writeList(entries, options))
  }

  async #writeList(
    entries: readonly (readonly [label: string, value: WriteValue])[],
    options: LabelOptions = {},
  ): Promise<LabelWriteResult[]> {
    // Before anything is sent, also the reading of the data types.
    this.#parts.permitWrite()
    const { requests, format } = this.#opened(options)
    const asked = entries.map(([label, value]) => attempt(() => labelEntry(askedLabel(label), asPlainValue(value))))
    const writes = await labelWrites(asked, requests, format)
    const errors = await requests.write(writes.filter(isFine))
    return writes.map((write, at): LabelWriteResult => {
      const label = entries[at]?.[0] ?? ''
      const error = isFine(write) ? errors.get(write.asked) : write
      return error === undefined ? { label, ok: true } : { label, ok: false, error }
    })
  }
}

function isItem(given: LabelItem | readonly LabelItem[]): given is LabelItem {
  return !Array.isArray(given)
}

function textOf(item: LabelItem | undefined): string {
  return typeof item === 'string' ? item : String(item?.label)
}
