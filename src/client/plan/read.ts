/**
 * A prepared read: many items, few requests, a result for each item, again and again without parsing.
 *
 * A request that the PLC refuses is divided until the items that are to blame stand alone, so that they do not take the
 * others down; later runs use what was learnt. Only reads are repeated like this, and only after an end code: after a
 * timeout or a lost connection every item of the request gets that error.
 */

import { EndCodeError, PlcError, type RequestError } from '../../errors'
import type { PlcValue, Words } from '../../value/value'
import { about, isAboutNoItem } from '../item/about'
import type { ParsedItem, RefusedItem } from '../item/item'
import type { ReadResult } from '../item/item-value'
import type { PlanProtocol } from './limit'
import { type Leaf, ReadShape, type ReadShapeOptions, type ReadStep } from './read-shape'
import { describePrepared, type PlanDescription, planText, type SendExchange } from './request'
import { type Place, valueAt } from './value'

/** Requests handed to `send` at the same time: enough to fill any pipeline, few enough to leave the queue to others. */
const LANES = 32

/**
 * The requests that read the items. Items that cannot be read keep their error; they do not harm the others.
 *
 * @param options.gap words that may be read in vain between two items to read them by one request
 * @example const plan = planRead(items, protocol, { gap: 64 }); const results = await plan.run(send, clock.time)
 */
export function planRead(
  items: readonly (ParsedItem | RefusedItem)[],
  protocol: PlanProtocol,
  options: ReadShapeOptions,
): DeviceRead {
  return new DeviceRead(items, protocol, options)
}

export class DeviceRead {
  readonly #protocol: PlanProtocol
  readonly #texts: readonly string[]
  readonly #shape: ReadShape

  constructor(items: readonly (ParsedItem | RefusedItem)[], protocol: PlanProtocol, options: ReadShapeOptions) {
    this.#protocol = protocol
    this.#texts = items.map(({ text }) => text)
    this.#shape = new ReadShape(items, protocol, options)
  }

  /**
   * Reads all items once.
   *
   * @param send called for several requests before the first has answered; what it rejects with is a `PlcError`
   * @param now milliseconds since 1970
   * @returns a result for each item, in their order; it rejects only with what is no `PlcError`, which is a bug
   */
  run(send: SendExchange, now: () => number): Promise<ReadResult[]> {
    const [only] = this.#shape.steps
    const isAlone = only !== undefined && this.#shape.steps.length === 1
    return isAlone ? this.#readAlone(only, send, now) : this.#readAll(send, now)
  }

  async #readAll(send: SendExchange, now: () => number): Promise<ReadResult[]> {
    const run = new ReadRun(this.#texts, this.#shape, send, now)
    const queue = [...this.#shape.steps].reverse()
    const lane = async () => {
      for (let step = queue.pop(); step !== undefined; step = queue.pop()) await this.#read(step, run)
    }
    const lanes = await Promise.allSettled(Array.from({ length: Math.min(LANES, queue.length) }, lane))
    for (const ended of lanes) if (ended.status === 'rejected') throw ended.reason
    return run.results()
  }

  /** As most plans are run: nothing waits for anything else, so that it costs as few turns of the queue as can be. */
  async #readAlone(step: ReadStep, send: SendExchange, now: () => number): Promise<ReadResult[]> {
    let words: Words
    try {
      words = await step.prepared.fetch(send)
    } catch (error) {
      const run = new ReadRun(this.#texts, this.#shape, send, now)
      await this.#settle(step, run.failed(step, error), run)
      return run.results()
    }
    this.#shape.answered(step)
    const [place] = step.places
    if (place !== undefined && this.#texts.length === 1 && this.#shape.partsOf(0) === 1) {
      return [this.#only(words, place, now())]
    }
    const run = new ReadRun(this.#texts, this.#shape, send, now)
    run.take(step, words)
    return run.results()
  }

  /** Of the only item: the words are nobody else's, so that they may become its value. */
  #only(words: Words, place: Place, timestamp: number): ReadResult {
    const [item = ''] = this.#texts
    try {
      return { item, ok: true, value: valueAt(words, place, true), timestamp }
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      return { item, ok: false, error: about(error, [{ item }]), timestamp }
    }
  }

  async #read(step: ReadStep, run: ReadRun): Promise<void> {
    await this.#settle(step, await run.attempt(step), run)
  }

  async #settle(step: ReadStep, outcome: Leaf['outcome'], run: ReadRun): Promise<void> {
    if (outcome === 'read') this.#shape.answered(step)
    if (!(outcome instanceof EndCodeError)) return
    if (isAboutNoItem(outcome)) {
      run.give(step, outcome)
      return
    }
    if (this.#shape.isHopeless(step, outcome)) {
      run.fail(step, outcome)
      return
    }
    const leaves = await this.#divide(step, outcome, run, {})
    if (leaves.every((leaf) => leaf.outcome !== 'lost')) this.#shape.learn(step, outcome, leaves)
  }

  /** Reads the parts of a refused request one after another, smaller and smaller. */
  async #divide(step: ReadStep, refusal: EndCodeError, run: ReadRun, division: Division): Promise<Leaf[]> {
    const parts = this.#shape.divided(step, refusal)
    if (parts.length === 0) {
      run.fail(step, refusal)
      return [{ step, outcome: refusal }]
    }
    const tried: Leaf[] = []
    for (const part of parts) tried.push({ step: part, outcome: await run.attempt(part, division) })
    // The same code for every part, and it is about none of them: the PLC is not ready, and asking more does not help.
    const same = tried.every(({ outcome }) => outcome instanceof EndCodeError && outcome.endCode === refusal.endCode)
    const hopeless = same && !this.#shape.mayHelp(refusal)
    const leaves: Leaf[] = []
    for (const leaf of tried) {
      if (!(leaf.outcome instanceof EndCodeError)) leaves.push(leaf)
      else if (hopeless) leaves.push(run.give(leaf.step, leaf.outcome))
      else leaves.push(...(await this.#divide(leaf.step, leaf.outcome, run, division)))
    }
    return leaves
  }

  /** Why an item cannot be asked for; `undefined` when it can. */
  errorOf(item: number): RequestError | undefined {
    return this.#shape.errors.get(item)
  }

  /** The plan as it stands now: what was learnt from refusals is in it. */
  describe(): PlanDescription {
    const requests = this.#shape.steps.map(({ prepared, pieces }) => {
      const items = new Set(pieces.map(({ item }) => this.#texts[item] ?? ''))
      return describePrepared(this.#protocol, prepared, [...items])
    })
    return { requests, notes: this.#shape.notes() }
  }

  toString(): string {
    return planText(this.describe())
  }
}

/** A refused request while its parts are read. */
interface Division {
  /** The connection failed: what is left is not asked for any more. */
  lost?: PlcError
}

/** One run: what is known of each item so far. */
class ReadRun {
  readonly #texts: readonly string[]
  readonly #shape: ReadShape
  readonly #send: SendExchange
  readonly #now: () => number
  readonly #values: (PlcValue | PlcValue[] | undefined)[]
  /** Of arrays larger than one request. */
  #parts: Map<number, Parts> | undefined
  readonly #errors: (PlcError | undefined)[]
  readonly #timestamps: number[]

  constructor(texts: readonly string[], shape: ReadShape, send: SendExchange, now: () => number) {
    this.#texts = texts
    this.#shape = shape
    this.#send = send
    this.#now = now
    this.#values = new Array<undefined>(texts.length).fill(undefined)
    this.#errors = new Array<undefined>(texts.length).fill(undefined)
    for (const [item, error] of shape.errors) this.#errors[item] = error
    this.#timestamps = new Array<number>(texts.length).fill(now())
  }

  /** Reads the items of one request, or gives them the error, unless it is an end code: that may be about one of them. */
  async attempt(step: ReadStep, division: Division = {}): Promise<Leaf['outcome']> {
    if (division.lost !== undefined) return this.give(step, division.lost).outcome
    try {
      this.take(step, await step.prepared.fetch(this.#send))
      return 'read'
    } catch (error) {
      return this.failed(step, error, division)
    }
  }

  /** The request got no answer that could be taken. */
  failed(step: ReadStep, error: unknown, division: Division = {}): Leaf['outcome'] {
    if (error instanceof EndCodeError) return error
    if (!(error instanceof PlcError)) throw error
    division.lost = error
    return this.give(step, error).outcome
  }

  take(step: ReadStep, words: Words): void {
    const timestamp = this.#now()
    for (const place of step.places) {
      const { item } = place
      this.#timestamps[item] = timestamp
      try {
        this.#keep(place, step, valueAt(words, place))
      } catch (error) {
        if (!(error instanceof PlcError)) throw error
        this.#errors[item] = about(error, [{ item: this.#texts[item] ?? '' }])
      }
    }
  }

  #keep({ item, part }: Place, step: ReadStep, value: PlcValue | PlcValue[]): void {
    const expected = this.#shape.partsOf(item)
    if (expected === 1) {
      this.#values[item] = value
      return
    }
    this.#parts ??= new Map()
    const parts = this.#parts.get(item) ?? { values: [], sources: new Set() }
    this.#parts.set(item, parts)
    parts.values[part] = value
    parts.sources.add(step)
    const all = parts.values.filter((one) => one !== undefined)
    if (all.length === expected) this.#values[item] = all.flat()
  }

  /** Gives the items an error that says nothing about them. */
  give(step: ReadStep, error: PlcError): Leaf {
    this.#set(step, () => error)
    return { step, outcome: 'lost' }
  }

  /** Gives each item the refusal that may be about it. */
  fail(step: ReadStep, refusal: EndCodeError): void {
    this.#set(step, (item) => about(refusal, [{ item }]))
  }

  #set(step: ReadStep, errorOf: (item: string) => PlcError): void {
    const timestamp = this.#now()
    for (const { item } of step.pieces) {
      this.#errors[item] = errorOf(this.#texts[item] ?? '')
      this.#timestamps[item] = timestamp
    }
  }

  results(): ReadResult[] {
    return this.#texts.map((item, i): ReadResult => {
      const timestamp = this.#timestamps[i] ?? 0
      const error = this.#errors[i]
      if (error !== undefined) return { item, ok: false, error, timestamp }
      const value = this.#values[i]
      if (value === undefined) throw new Error(`${item} has neither a value nor an error`)
      const isTorn = (this.#parts?.get(i)?.sources.size ?? 0) > 1
      return isTorn ? { item, ok: true, value, timestamp, torn: true } : { item, ok: true, value, timestamp }
    })
  }
}

/** Parts of an array and the requests that read them. */
interface Parts {
  readonly values: (PlcValue | PlcValue[])[]
  readonly sources: Set<ReadStep>
}
