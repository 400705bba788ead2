/**
 * A prepared write: everything is checked and encoded before the first request, the requests are sent one after another
 * in the order of the entries, and nothing that may have been carried out is ever sent again.
 */

import { type PlcError, RequestError, type WriteResult } from '../../errors'
import type { Notation } from '../../melsec/device/json'
import { addressOptionsOf } from '../../melsec/profiles/profile'
import type { CallOptions } from '../connection/call'
import { about } from '../item/about'
import type { ParsedItem, RefusedItem } from '../item/item'
import type { PlainValue } from '../item/item-value'
import { Areas } from './layout'
import type { PlanProtocol } from './limit'
import { describePrepared, type PlanDescription, planText, type SendExchange } from './request'
import { alone, type Batch, batchesOf } from './write-batch'
import { cheapestBatches } from './write-cheapest'
import { prepareWrite, type WriteContext, type WriteStep } from './write-request'
import { refuseAll, runWrites } from './write-run'
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
  readonly #texts: readonly string[]
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
    this.#texts = entries.map(({ item }) => item.text)
    this.#options = options
    const units = entries.flatMap((entry, index) => this.#unitsOf(entry, index))
    this.#refuseDoubles()
    if (options.allOrNothing === true) refuseAll(this.#texts, this.#errors)
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

  /** Writes all entries once, one request after another, as `runWrites` does. */
  run(send: SendExchange): Promise<WriteResult[]> {
    const options = {
      texts: this.#texts,
      errors: this.#errors,
      allOrNothing: this.#options.allOrNothing === true,
      isLikely: (entry: number) => this.#isBeyond(entry),
    }
    return runWrites(this.#steps, (step) => this.#apart(step), options, send)
  }

  /** Whether a usual CPU of the family has no such device: of items that are refused together it is named first. */
  #isBeyond(entry: number): boolean {
    const item = this.#entries[entry]?.item
    if (item === undefined || 'error' in item || item.address.extension !== undefined) return false
    const points = this.#context.protocol.profile.ranges.points[item.address.device]
    return points !== undefined && item.address.number >= points
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
    return this.#texts[entry] ?? ''
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
