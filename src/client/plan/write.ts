/**
 * A prepared write: everything is checked and encoded before the first request, the requests are sent one after another
 * in the order of the entries, and nothing that may have been carried out is ever sent again.
 */

import { ClosedError, EndCodeError, PlcError, RequestError, type WriteResult } from '../../errors'
import type { Notation } from '../../melsec/device/json'
import { addressOptionsOf, type Profile } from '../../melsec/profiles/profile'
import type { CallOptions } from '../connection/call'
import { about, isAboutNoItem } from '../item/about'
import type { ParsedItem, RefusedItem } from '../item/item'
import type { PlainValue } from '../item/item-value'
import { stopsOrder } from '../item/write-outcome'
import { Areas } from './layout'
import type { PlanProtocol } from './limit'
import { describePrepared, type PlanDescription, planText, type SendExchange } from './request'
import { alone, type Batch, batchesOf } from './write-batch'
import { cheapestBatches } from './write-cheapest'
import { prepareWrite, type WriteContext, type WriteStep } from './write-request'
import { unitsOf, type WriteUnit, writtenTwice } from './write-unit'

export interface PlannedEntry {
  readonly item: ParsedItem | RefusedItem
  readonly value: PlainValue
}

export type { WriteResult } from '../../errors'

/** What a write may say beside its deadline. */
export interface WriteOptions {
  /**
   * Allow bits of words (`D100.3`): the word is read, changed and written back. That is not one step for the PLC: what
   * its program changes in the word in between is lost. Bits of the same word that follow one another are set together.
   */
  readonly readModifyWrite?: boolean
  /** SendExchange nothing when one entry is bad, and nothing more after the first failure. */
  readonly allOrNothing?: boolean
}

/** Options of a call that writes. */
export interface WriteCallOptions extends CallOptions, WriteOptions {}

/** The notation is that of descriptions; default: the profile's. */
export interface PlanWriteOptions extends WriteOptions, Notation {}

/**
 * The requests that write the entries, in their order. Entries that cannot be written keep their error.
 *
 * @example const plan = planWrite([{ item: parseItem('D100:REAL', options), value: 1.5 }], protocol)
 */
export function planWrite(
  entries: readonly PlannedEntry[],
  protocol: PlanProtocol,
  options: PlanWriteOptions = {},
): DeviceWrite {
  return new DeviceWrite(entries, protocol, options)
}

export class DeviceWrite {
  readonly #context: WriteContext
  readonly #areas: Areas
  readonly #entries: readonly PlannedEntry[]
  readonly #options: PlanWriteOptions
  readonly #errors = new Map<number, PlcError>()
  readonly #units: readonly WriteUnit[]
  readonly #steps: readonly WriteStep[]

  constructor(entries: readonly PlannedEntry[], protocol: PlanProtocol, options: PlanWriteOptions) {
    this.#areas = new Areas(protocol, 'write')
    this.#context = {
      protocol,
      readAreas: new Areas(protocol, 'read'),
      options: addressOptionsOf(protocol.profile, options),
    }
    this.#entries = entries
    this.#options = options
    const units = entries.flatMap((entry, index) => this.#unitsOf(entry, index))
    this.#refuseDoubles()
    if (options.allOrNothing === true) this.#refuseAll()
    this.#units = units.filter(({ entry }) => !this.#errors.has(entry))
    this.#steps = this.#batches().map((batch) => prepareWrite(this.#context, batch))
  }

  #batches(): Batch[] {
    const { protocol } = this.#areas
    const { lineCost } = protocol
    return lineCost === undefined
      ? batchesOf(protocol, this.#units)
      : cheapestBatches(this.#areas, this.#units, lineCost.write)
  }

  /** Whether words are read, changed and written back: nobody else may write meanwhile. */
  get changesBits(): boolean {
    return this.#units.some(({ content }) => content.kind === 'masked')
  }

  #unitsOf({ item, value }: PlannedEntry, index: number): WriteUnit[] {
    if ('error' in item) {
      this.#errors.set(index, item.error)
      return []
    }
    try {
      const units = unitsOf(this.#areas, item, value, index, this.#options.readModifyWrite === true)
      for (const unit of units) prepareWrite(this.#context, alone(this.#areas.protocol, unit))
      return units
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
      this.#errors.set(index, about(error, [{ item: item.text }]))
      return []
    }
  }

  #refuseDoubles(): void {
    const written = this.#entries.flatMap(({ item }, entry) =>
      'error' in item || this.#errors.has(entry) ? [] : [{ entry, item }],
    )
    for (const [entry, error] of writtenTwice(this.#areas, written)) this.#errors.set(entry, error)
  }

  #refuseAll(): void {
    const [first] = [...this.#errors.values()]
    if (first === undefined) return
    this.#entries.forEach(({ item }, entry) => {
      if (this.#errors.has(entry)) return
      const message = `${item.text} was not written, because all or nothing shall be: ${first.message}`
      this.#errors.set(entry, new ClosedError('ABORTED', message, 'notSent', first))
    })
  }

  /**
   * Writes all entries once, one request after another.
   *
   * - A merged request that is refused because of a device was not carried out: its entries are written one by one.
   *   Any other refusal goes to all its entries, and the next request is sent.
   * - After any other failure, an end code with which it may have been carried out among them, nothing more is sent: the entries left over get an error with the outcome `notSent`.
   *
   * @param send what it rejects with is a `PlcError`
   * @returns a result for each entry, in their order; it rejects only with what is no `PlcError`, which is a bug
   */
  async run(send: SendExchange): Promise<WriteResult[]> {
    const run = new WriteRun(
      this.#entries,
      this.#errors,
      this.#options.allOrNothing === true,
      this.#context.protocol.profile,
    )
    for (const step of this.#steps) {
      const refusal = await run.attempt(step, send)
      if (refusal === undefined) continue
      if (!run.goesOnApart(step, refusal)) run.fail(step, refusal)
      else for (const single of this.#apart(step)) await this.#single(single, run, send)
    }
    return run.results()
  }

  async #single(step: WriteStep, run: WriteRun, send: SendExchange): Promise<void> {
    const refusal = await run.attempt(step, send)
    if (refusal !== undefined) run.fail(step, refusal)
  }

  #apart({ units }: WriteStep): WriteStep[] {
    return units.map((unit) => prepareWrite(this.#context, alone(this.#areas.protocol, unit)))
  }

  /** Why an entry is not written; undefined when it will be. */
  errorOf(entry: number): PlcError | undefined {
    return this.#errors.get(entry)
  }

  describe(): PlanDescription {
    const requests = this.#steps.flatMap(({ units, prepared }) => {
      const items = [...new Set(units.map(({ entry }) => this.#text(entry)))]
      return prepared.map((one) => describePrepared(this.#context.protocol, one, items))
    })
    return { requests, notes: this.#notes() }
  }

  #text(entry: number): string {
    return this.#entries[entry]?.item.text ?? ''
  }

  #notes(): string[] {
    const parts = new Map<number, number>()
    const masked = new Set<number>()
    for (const { entry, isPart, content } of this.#units) {
      if (isPart) parts.set(entry, (parts.get(entry) ?? 0) + 1)
      if (content.kind === 'masked') masked.add(entry)
    }
    return [
      ...[...parts].map(
        ([entry, count]) => `${this.#text(entry)} is written by ${count} requests: the PLC may see it half written.`,
      ),
      ...[...masked].map(
        (entry) =>
          `${this.#text(entry)} is written with its whole word, read just before: what the PLC program changes in it in between is lost.`,
      ),
      ...[...this.#errors].map(([entry, error]) => `${this.#text(entry)} is not written. ${error.message}`),
    ]
  }

  toString(): string {
    return planText(this.describe())
  }
}

/** One run: what became of each entry so far. */
class WriteRun {
  readonly #entries: readonly PlannedEntry[]
  readonly #errors: Map<number, PlcError>
  readonly #allOrNothing: boolean
  readonly #profile: Profile
  /** Values of each entry that were written. */
  readonly #written = new Map<number, number>()
  /** Why nothing more is sent. */
  #stopped: PlcError | undefined

  constructor(
    entries: readonly PlannedEntry[],
    errors: ReadonlyMap<number, PlcError>,
    allOrNothing: boolean,
    profile: Profile,
  ) {
    this.#profile = profile
    this.#entries = entries
    this.#errors = new Map(errors)
    this.#allOrNothing = allOrNothing
  }

  /**
   * Sends one request.
   * @returns the end code, when it was refused; other failures, and what may have been carried out, are given to the entries
   */
  async attempt(step: WriteStep, send: SendExchange): Promise<EndCodeError | undefined> {
    if (this.#stopped !== undefined) {
      this.#notSent(step, this.#stopped)
      return undefined
    }
    // The parts of an array: after the first that failed the others are not sent.
    if (step.units.every(({ entry }) => this.#errors.has(entry))) return undefined
    try {
      await step.perform(send)
      for (const { entry, count } of step.units) this.#written.set(entry, (this.#written.get(entry) ?? 0) + count)
      return undefined
    } catch (error) {
      if (error instanceof EndCodeError && error.outcome === 'refused') return error
      if (!(error instanceof PlcError)) throw error
      if (stopsOrder(error)) this.#stopped = error
      this.fail(step, error)
      return undefined
    }
  }

  /** Whether a refused request is written again, one entry at a time: it was not carried out, and one is to blame. */
  goesOnApart({ units }: WriteStep, { about: blamed, carriedOut }: EndCodeError): boolean {
    const isOneToBlame = blamed === 'item' && carriedOut === false
    return units.length > 1 && !this.#allOrNothing && isOneToBlame
  }

  fail(step: WriteStep, error: PlcError): void {
    if (this.#allOrNothing) this.#stopped ??= error
    const entries = [...new Set(step.units.map(({ entry }) => entry))]
    const likely = [...entries].sort((a, b) => Number(this.#isBeyond(b)) - Number(this.#isBeyond(a)))
    const told = mayBeAbout(error, entries.length)
      ? about(
          error,
          likely.map((entry) => ({ item: this.#text(entry) })),
        )
      : error
    for (const entry of entries) this.#set(entry, told)
  }

  /** Whether a usual CPU of the family has no such device: of items that are refused together it is named first. */
  #isBeyond(entry: number): boolean {
    const item = this.#entries[entry]?.item
    if (item === undefined || 'error' in item || item.address.extension !== undefined) return false
    const points = this.#profile.ranges.points[item.address.device]
    return points !== undefined && item.address.number >= points
  }

  #notSent(step: WriteStep, cause: PlcError): void {
    for (const { entry } of step.units) {
      const message = `${this.#text(entry)} was not written, because an earlier request of this write failed: ${cause.message}`
      this.#set(entry, new ClosedError('ABORTED', message, 'notSent', cause))
    }
  }

  #set(entry: number, error: PlcError): void {
    if (this.#errors.has(entry)) return
    const written = this.#written.get(entry)
    this.#errors.set(entry, written === undefined ? error : partlyWritten(this.#text(entry), written, error))
  }

  #text(entry: number): string {
    return this.#entries[entry]?.item.text ?? ''
  }

  results(): WriteResult[] {
    return this.#entries.map(({ item }, entry) => {
      const error = this.#errors.get(entry)
      return error === undefined ? { item: item.text, ok: true } : { item: item.text, ok: false, error }
    })
  }
}

/**
 * Whether an error may be about one of so many items: the PLC refuses what is written. That a request is not permitted, or
 * that the PLC is locked, is about none of several.
 */
function mayBeAbout(error: PlcError, items: number): boolean {
  return error instanceof EndCodeError && (items === 1 || !isAboutNoItem(error))
}

/** A failure in the middle of an array: the PLC was changed, so `refused` or `notSent` would be a lie. */
function partlyWritten(text: string, written: number, cause: PlcError): PlcError {
  const others = cause.outcome === 'unknown' ? '; whether more were is not known' : ', the others not'
  const message = `${text}: the first ${written} values were written${others}. ${cause.message}`
  return new ClosedError('ABORTED', message, 'unknown', cause)
}
