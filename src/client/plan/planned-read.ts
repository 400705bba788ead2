/**
 * A prepared read, whatever family the requests are of: many items, few requests, a result for each item, again and again
 * without parsing.
 *
 * A request that the PLC refuses is divided until the items that are to blame stand alone, so that they do not take the
 * others down; later runs use what was learnt. Only reads are repeated like this, and only after an end code: after a
 * timeout or a lost connection every item of the request gets that error.
 */
import { EndCodeError, PlcError, type RequestError } from '../../errors'
import type { PlcValue } from '../../value/value'
import { about, isAboutNoItem } from '../item/about'
import type { ReadResult } from '../item/item-value'
import { type PlanDescription, planText, type RequestDescription, type SendExchange } from './request'

/** Requests handed to `send` at the same time: enough to fill any pipeline, few enough to leave the queue to others. */
const LANES = 32

/** Where values of an item stand in an answer. */
export interface ReadPlace {
  readonly item: number
  readonly part: number
}

/** One request of a plan, which is answered with an `A`, and where its values go. */
export interface ReadStepOf<A, P extends ReadPlace> {
  readonly prepared: { fetch(send: SendExchange): Promise<A> }
  readonly pieces: readonly { readonly item: number }[]
  readonly places: readonly P[]
}

/** A part of a divided request and how it ended. `lost`: it says nothing about its items. */
export interface LeafOf<S> {
  readonly step: S
  readonly outcome: 'read' | 'lost' | EndCodeError
}

/** Which requests a plan consists of, and what refusals taught about them. */
export interface PlanShape<S> {
  /** Items that cannot be asked for. */
  readonly errors: ReadonlyMap<number, RequestError>
  readonly steps: readonly S[]
  /** Pieces an item is cut into, 1 unless it is larger than one request; 0 when it cannot be asked for. */
  partsOf(item: number): number
  /** Smaller requests for what a refused one asked for; empty when there is nothing smaller. */
  divided(step: S, refusal: EndCodeError): readonly S[]
  /** Whether a smaller request may be answered: the end code is about an item, or about the size of the request. */
  mayHelp(refusal: EndCodeError): boolean
  /** Whether all items of this request were refused one by one with this code, so that dividing it is of no use. */
  isHopeless(step: S, refusal: EndCodeError): boolean
  /** A request was answered: what was noted against its items no longer holds. */
  answered(step: S): void
  /** Puts what was learnt from a refusal in the place of the refused request. */
  learn(step: S, refusal: EndCodeError, leaves: readonly LeafOf<S>[]): void
  notes(): readonly string[]
  describe(step: S, items: readonly string[]): RequestDescription
}

/** What a family reads out of an answer. `owned`: nobody else needs the answer. */
export type ValueAt<A, P> = (answer: A, place: P, owned?: boolean) => PlcValue | PlcValue[]

export class PlannedRead<A, P extends ReadPlace, S extends ReadStepOf<A, P>> {
  readonly #texts: readonly string[]
  readonly #shape: PlanShape<S>
  readonly #valueAt: ValueAt<A, P>

  /** @param texts of the items */
  constructor(texts: readonly string[], shape: PlanShape<S>, valueAt: ValueAt<A, P>) {
    this.#texts = texts
    this.#shape = shape
    this.#valueAt = valueAt
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
    const run = new ReadRun<A, P, S>(this.#texts, this.#shape, this.#valueAt, send, now)
    const queue = [...this.#shape.steps].reverse()
    const lane = async () => {
      for (let step = queue.pop(); step !== undefined; step = queue.pop()) await this.#read(step, run)
    }
    const lanes = await Promise.allSettled(Array.from({ length: Math.min(LANES, queue.length) }, lane))
    for (const ended of lanes) if (ended.status === 'rejected') throw ended.reason
    return run.results()
  }

  /** As most plans are run: nothing waits for anything else, so that it costs as few turns of the queue as can be. */
  async #readAlone(step: S, send: SendExchange, now: () => number): Promise<ReadResult[]> {
    let answer: A
    try {
      answer = await step.prepared.fetch(send)
    } catch (error) {
      const run = new ReadRun<A, P, S>(this.#texts, this.#shape, this.#valueAt, send, now)
      await this.#settle(step, run.failed(step, error), run)
      return run.results()
    }
    this.#shape.answered(step)
    const [place] = step.places
    if (place !== undefined && this.#texts.length === 1 && this.#shape.partsOf(0) === 1) {
      return [this.#only(answer, place, now())]
    }
    const run = new ReadRun<A, P, S>(this.#texts, this.#shape, this.#valueAt, send, now)
    run.take(step, answer)
    return run.results()
  }

  /** Of the only item: the words are nobody else's, so that they may become its value. */
  #only(answer: A, place: P, timestamp: number): ReadResult {
    const [item = ''] = this.#texts
    try {
      return { item, ok: true, value: this.#valueAt(answer, place, true), timestamp }
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      return { item, ok: false, error: about(error, [{ item }]), timestamp }
    }
  }

  async #read(step: S, run: ReadRun<A, P, S>): Promise<void> {
    await this.#settle(step, await run.attempt(step), run)
  }

  async #settle(step: S, outcome: LeafOf<S>['outcome'], run: ReadRun<A, P, S>): Promise<void> {
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
  async #divide(step: S, refusal: EndCodeError, run: ReadRun<A, P, S>, division: Division): Promise<LeafOf<S>[]> {
    const parts = this.#shape.divided(step, refusal)
    if (parts.length === 0) {
      run.fail(step, refusal)
      return [{ step, outcome: refusal }]
    }
    const tried: LeafOf<S>[] = []
    for (const part of parts) tried.push({ step: part, outcome: await run.attempt(part, division) })
    // The same code for every part, and it is about none of them: the PLC is not ready, and asking more does not help.
    const same = tried.every(({ outcome }) => outcome instanceof EndCodeError && outcome.endCode === refusal.endCode)
    const hopeless = same && !this.#shape.mayHelp(refusal)
    const leaves: LeafOf<S>[] = []
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
    const requests = this.#shape.steps.map((step) => {
      const items = new Set(step.pieces.map(({ item }) => this.#texts[item] ?? ''))
      return this.#shape.describe(step, [...items])
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
class ReadRun<A, P extends ReadPlace, S extends ReadStepOf<A, P>> {
  readonly #texts: readonly string[]
  readonly #shape: PlanShape<S>
  readonly #valueAt: ValueAt<A, P>
  readonly #send: SendExchange
  readonly #now: () => number
  readonly #values: (PlcValue | PlcValue[] | undefined)[]
  /** Of arrays larger than one request. */
  #parts: Map<number, Parts<S>> | undefined
  readonly #errors: (PlcError | undefined)[]
  readonly #timestamps: number[]

  constructor(
    texts: readonly string[],
    shape: PlanShape<S>,
    valueAt: ValueAt<A, P>,
    send: SendExchange,
    now: () => number,
  ) {
    this.#valueAt = valueAt
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
  async attempt(step: S, division: Division = {}): Promise<LeafOf<S>['outcome']> {
    if (division.lost !== undefined) return this.give(step, division.lost).outcome
    try {
      this.take(step, await step.prepared.fetch(this.#send))
      return 'read'
    } catch (error) {
      return this.failed(step, error, division)
    }
  }

  /** The request got no answer that could be taken. */
  failed(step: S, error: unknown, division: Division = {}): LeafOf<S>['outcome'] {
    if (error instanceof EndCodeError) return error
    if (!(error instanceof PlcError)) throw error
    division.lost = error
    return this.give(step, error).outcome
  }

  take(step: S, answer: A): void {
    const timestamp = this.#now()
    for (const place of step.places) {
      const { item } = place
      this.#timestamps[item] = timestamp
      try {
        this.#keep(place, step, this.#valueAt(answer, place))
      } catch (error) {
        if (!(error instanceof PlcError)) throw error
        this.#errors[item] = about(error, [{ item: this.#texts[item] ?? '' }])
      }
    }
  }

  #keep({ item, part }: P, step: S, value: PlcValue | PlcValue[]): void {
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
  give(step: S, error: PlcError): LeafOf<S> {
    this.#set(step, () => error)
    return { step, outcome: 'lost' }
  }

  /** Gives each item the refusal that may be about it. */
  fail(step: S, refusal: EndCodeError): void {
    this.#set(step, (item) => about(refusal, [{ item }]))
  }

  #set(step: S, errorOf: (item: string) => PlcError): void {
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
interface Parts<S> {
  readonly values: (PlcValue | PlcValue[])[]
  readonly sources: Set<S>
}
