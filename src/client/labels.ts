// Global labels by name: typed values out of the label commands, in as few requests as fit (SLMP reference manual 5.3).
import { PlcError, ProtocolError } from '../errors'
import type { Encoding, PlcValue } from '../value/value'
import type { CallOptions } from './call'
import { checkBooleans, listOf, namesOf } from './given'
import { ArrayParts } from './label-array'
import { type AskedLabel, askedLabel, type LabelItem, type LabelOptions } from './label-item'
import { type LabelAnswer, type LabelCall, LabelRequests } from './label-request'
import { decodeLabel, encodeLabel, labelTypeOf } from './label-value'

export type { LabelItem, LabelOptions } from './label-item'

/** What a label holds; of several elements of an array a list. */
export type LabelValue = PlcValue | PlcValue[]

export type LabelReadResult =
  | {
      readonly label: string
      readonly ok: true
      readonly value: LabelValue
      /** Data type of the label, as the PLC says it: `REAL`, `STRING(21)`. */
      readonly type: string
      /** ms since 1970 */
      readonly timestamp: number
      /** The elements were read by more than one request: the PLC may have changed them in between. */
      readonly torn?: true
    }
  | { readonly label: string; readonly ok: false; readonly error: PlcError; readonly timestamp: number }

export type LabelWriteResult =
  | { readonly label: string; readonly ok: true }
  | { readonly label: string; readonly ok: false; readonly error: PlcError }

/**
 * Global labels of an iQ-R CPU, by name. They must be open to external devices in GX Works3 ("Access from External
 * Device" of the global label editor). The PLC says the data type of each label, so none is given here.
 */
export interface Labels {
  /**
   * Reads one label: its value; throws what went wrong. Many: a result each.
   * @example await plc.labels.read('Line1.Speed')
   * @example await plc.labels.read(['Line1.Speed', { label: 'Line1.Values[0]', count: 10 }])
   */
  read(label: LabelItem, options?: LabelOptions): Promise<LabelValue>
  read(labels: readonly LabelItem[], options?: LabelOptions): Promise<LabelReadResult[]>
  /**
   * Writes labels in the order given. Needs `allowWrites`. The data types are read before anything is written. A list
   * goes to an array from the element named on. A write whose outcome is unknown is never repeated, and what stands
   * behind it is not sent.
   * @example await plc.labels.write('Line1.Speed', 12.5)
   * @example await plc.labels.write({ 'Line1.Speed': 12.5, 'Line1.Values[0]': [1, 2, 3] })
   */
  write(label: string, value: LabelValue, options?: LabelOptions): Promise<void>
  write(values: Readonly<Record<string, LabelValue>>, options?: LabelOptions): Promise<Record<string, LabelWriteResult>>
}

/** What the client lends. */
export interface LabelParts {
  /** One call: all its requests share one deadline. */
  readonly call: (options: CallOptions | undefined) => LabelCall
  /** @throws RequestError NOT_PERMITTED */
  readonly permitWrite: () => void
  /** ms since 1970 */
  readonly time: () => number
  /** Of the client's own format: what STRING labels hold unless a call says otherwise. */
  readonly encoding: Encoding | undefined
}

export function labelsOf(parts: LabelParts): LabelAccess {
  return new LabelAccess(parts)
}

export class LabelAccess implements Labels {
  readonly #parts: LabelParts

  constructor(parts: LabelParts) {
    this.#parts = parts
  }

  read(label: LabelItem, options?: LabelOptions): Promise<LabelValue>
  read(labels: readonly LabelItem[], options?: LabelOptions): Promise<LabelReadResult[]>
  async read(labels: LabelItem | readonly LabelItem[], options: LabelOptions = {}): Promise<unknown> {
    checkBooleans(options, [])
    if (isItem(labels)) {
      const [result] = await this.readList([labels], options)
      if (result?.ok === true) return result.value
      throw result?.error
    }
    return this.readList(listOf(labels, 'labels'), options)
  }

  /** The options with the client's own encoding. */
  #settled(options: LabelOptions): LabelOptions {
    const { encoding } = this.#parts
    return encoding === undefined ? options : { encoding, ...options }
  }

  /** Many labels, each with its own result. */
  async readList(items: readonly LabelItem[], given: LabelOptions): Promise<LabelReadResult[]> {
    const options = this.#settled(given)
    const requests = new LabelRequests(this.#parts.call(options))
    const asked = items.map((item) => attempt(() => askedLabel(item)))
    const answers = await requests.random(asked.filter(isFine))
    const timestamp = this.#parts.time()
    const arrays = new ArrayParts(requests)
    const outcomes = asked.map((one) => {
      if (one instanceof PlcError) return one
      const answer = answers.get(one)
      if (answer === undefined || answer instanceof PlcError) return answer ?? missing(one)
      return attempt(() => this.#value(one, answer, arrays, requests, options))
    })
    const values = await arrays.read(options)
    return outcomes.map((outcome, at): LabelReadResult => {
      const label = textOf(items[at])
      if (outcome instanceof PlcError) return { label, ok: false, error: outcome, timestamp }
      if ('value' in outcome) return { label, ok: true, ...outcome, timestamp }
      const read = values.get(outcome.array)
      if (read === undefined || read instanceof PlcError) {
        return { label, ok: false, error: read ?? missing(outcome.array), timestamp }
      }
      return { label, ok: true, ...read, timestamp: this.#parts.time() }
    })
  }

  #value(
    asked: AskedLabel,
    { typeId, data }: LabelAnswer,
    arrays: ArrayParts,
    { protocol }: LabelRequests,
    options: LabelOptions,
  ): { readonly value: LabelValue; readonly type: string } | { readonly array: AskedLabel } {
    const type = labelTypeOf(asked.address.name, typeId, data.length)
    if (asked.count === undefined) return { value: decodeLabel(type, data, protocol.code, options), type: type.text }
    arrays.add(asked, type)
    return { array: asked }
  }

  write(label: string, value: LabelValue, options?: LabelOptions): Promise<void>
  write(values: Readonly<Record<string, LabelValue>>, options?: LabelOptions): Promise<Record<string, LabelWriteResult>>
  async write(
    target: string | Readonly<Record<string, LabelValue>>,
    second?: LabelValue | LabelOptions,
    third?: LabelOptions,
  ): Promise<unknown> {
    if (typeof target === 'string') {
      const [result] = await this.writeList([[target, second as LabelValue]], third ?? {})
      if (result?.ok === false) throw result.error
      return undefined
    }
    const names = namesOf(target, 'Labels to write are a name and its value, or an object by name')
    const entries = names.map((name) => [name, target[name] as LabelValue] as const)
    const results = await this.writeList(entries, (second as LabelOptions | undefined) ?? {})
    return Object.fromEntries(results.map((result) => [result.label, result]))
  }

  /** Many labels in their order, the same one also twice. */
  async writeList(
    entries: readonly (readonly [label: string, value: LabelValue])[],
    given: LabelOptions,
  ): Promise<LabelWriteResult[]> {
    checkBooleans(given, [])
    const options = this.#settled(given)
    // Before anything is sent, also the reading of the data types.
    this.#parts.permitWrite()
    const requests = new LabelRequests(this.#parts.call(options))
    const asked = entries.map(([label, value]) =>
      attempt(() => askedLabel(Array.isArray(value) ? { label, count: value.length } : label)),
    )
    const answers = await requests.random(asked.filter(isFine))
    const writes = asked.map((one, at) => {
      if (one instanceof PlcError) return one
      const answer = answers.get(one)
      if (answer === undefined || answer instanceof PlcError) return answer ?? missing(one)
      return attempt(() => {
        const type = labelTypeOf(one.address.name, answer.typeId, answer.data.length)
        return {
          asked: one,
          content: encodeLabel(type, entries[at]?.[1] as LabelValue, requests.protocol.code, options),
        }
      })
    })
    const errors = await requests.write(writes.filter(isFine))
    return writes.map((write, at): LabelWriteResult => {
      const label = entries[at]?.[0] ?? ''
      const error = write instanceof PlcError ? write : errors.get(write.asked)
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

function isFine<T>(outcome: T | PlcError): outcome is T {
  return !(outcome instanceof PlcError)
}

function missing({ address }: AskedLabel): ProtocolError {
  return new ProtocolError('TRUNCATED', `${address.name}: the PLC did not answer it.`)
}

/** The value, or the error that it turned out to be. */
function attempt<T>(run: () => T): T | PlcError {
  try {
    return run()
  } catch (error) {
    if (error instanceof PlcError) return error
    throw error
  }
}
