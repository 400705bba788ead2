/**
 * A prepared write: everything is checked and encoded before the first request, the requests are sent one after another in the
 * order of the entries, and nothing that may have been carried out is ever sent again.
 */
import { type PlcError, RequestError, type WriteResult } from '../../errors'
import { about } from '../item/about'
import type { PlainValue } from '../item/item-value'
import { type PlanDescription, planText, type SendExchange } from '../plan/request'
import type { WriteOptions } from '../plan/write'
import { refuseAll, runWrites } from '../plan/write-run'
import { refuseOverlaps, type WrittenSpan } from '../plan/written-twice'
import { JwSpaces } from './layout'
import { describeJw } from './read-request'
import type { AnyJwItem, JwPlanParts } from './read-shape'
import { jwAlone, jwBatches } from './write-batch'
import { changesBits, type JwWriteStep, jwWriteStep } from './write-request'
import { type JwWriteUnit, jwSpanOf, jwUnitsOf } from './write-unit'

/** One value to write, its item understood. */
export interface JwPlannedEntry {
  readonly item: AnyJwItem
  readonly value: PlainValue
}

export class JwWrite {
  readonly #parts: JwPlanParts
  readonly #options: WriteOptions
  readonly #texts: readonly string[]
  readonly #errors = new Map<number, PlcError>()
  readonly #spaces: JwSpaces
  readonly #spans = new Map<string, WrittenSpan[]>()
  readonly #units: readonly JwWriteUnit[]
  readonly #steps: readonly JwWriteStep[]

  constructor(entries: readonly JwPlannedEntry[], parts: JwPlanParts, options: WriteOptions) {
    this.#parts = parts
    this.#options = options
    this.#texts = entries.map(({ item }) => item.text)
    this.#spaces = new JwSpaces(parts.settings.model)
    const units = entries.flatMap((entry, index) => this.#unitsOf(entry, index))
    for (const [entry, error] of refuseOverlaps([...this.#spans.values()])) this.#errors.set(entry, error)
    if (options.allOrNothing === true) refuseAll(this.#texts, this.#errors)
    this.#units = units.filter(({ entry }) => !this.#errors.has(entry))
    const batches = jwBatches(this.#units, parts.limits, parts.lists.mayBeUsed)
    this.#steps = batches.map((batch) => jwWriteStep(parts, batch))
  }

  /** Whether bytes are read, changed and written back: nobody else may write meanwhile. */
  get changesBits(): boolean {
    return changesBits(this.#units)
  }

  /** Whether any of its requests has such an effect: the system memory is set up, not written. */
  writes(effect: 'write' | 'configure'): boolean {
    return this.#steps.some(({ prepared }) => prepared.some(({ exchange }) => exchange.effect === effect))
  }

  #unitsOf({ item, value }: JwPlannedEntry, index: number): JwWriteUnit[] {
    if ('error' in item) {
      this.#errors.set(index, item.error)
      return []
    }
    try {
      const layout = this.#spaces.layoutOf(item)
      const { limits, lists } = this.#parts
      const readModifyWrite = this.#options.readModifyWrite === true
      const units = jwUnitsOf(layout, item, value, index, { limits, lists: lists.mayBeUsed, readModifyWrite })
      for (const unit of units) jwWriteStep(this.#parts, jwAlone(unit))
      const { place, span } = jwSpanOf(layout, item, index)
      this.#spans.set(place, [...(this.#spans.get(place) ?? []), span])
      return units
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
      this.#errors.set(index, about(error, [{ item: item.text }]))
      return []
    }
  }

  /** Writes all entries once, one request after another, as `runWrites` does. */
  run(send: SendExchange): Promise<WriteResult[]> {
    const allOrNothing = this.#options.allOrNothing === true
    const apart = ({ units }: JwWriteStep) => units.map((unit) => jwWriteStep(this.#parts, jwAlone(unit)))
    return runWrites(this.#steps, apart, { texts: this.#texts, errors: this.#errors, allOrNothing }, send)
  }

  describe(): PlanDescription {
    const requests = this.#steps.flatMap(({ units, prepared }) => {
      const items = [...new Set(units.map(({ entry }) => this.#text(entry)))]
      return prepared.map((one) => describeJw(one, items))
    })
    return { requests, notes: this.#notes() }
  }

  #text(entry: number): string {
    return this.#texts[entry] ?? ''
  }

  #notes(): string[] {
    const parts = new Map<number, number>()
    for (const { entry, isPart } of this.#units) if (isPart) parts.set(entry, (parts.get(entry) ?? 0) + 1)
    const masked = new Set(this.#units.filter((unit) => changesBits([unit])).map(({ entry }) => entry))
    const isUnproved = !this.#parts.lists.isProved && this.#steps.some(({ isList }) => isList)
    return [
      ...[...parts].map(
        ([entry, count]) => `${this.#text(entry)} is written by ${count} requests: the PLC may see it half written.`,
      ),
      ...[...masked].map(
        (entry) =>
          `${this.#text(entry)} is written with its whole byte, read just before: what the PLC changes in it in between is lost.`,
      ),
      ...(isUnproved
        ? [
            'Before the first list is written, two bytes of it are read by a list, which shows that the PLC understands it.',
          ]
        : []),
      ...[...this.#errors].map(([entry, error]) => `${this.#text(entry)} is not written. ${error.message}`),
    ]
  }

  toString(): string {
    return planText(this.describe())
  }
}
