// What is known of a watched item: its value, how far to trust it, and since when.
import type { PlcError } from '../../errors'
import { hasChanged } from '../../tags/table/deadband'
import type { ReadResult, ReadValue } from '../item/item-value'

/**
 * A watched value. `good`: the last scan has read it. `uncertain`: the array was read by several requests, it is a tag whose
 * scaling has clamped it, or no scan has ended for longer than `staleAfter`. `bad`: the last scan could not read it; the value is the last that was known.
 */
export type WatchedValue<V = ReadValue> =
  | {
      /** How far to trust the value. */
      readonly quality: 'good'
      /** One value, or an array where the item has a count or a range. */
      readonly value: V
      /** Why it is not good, for people. */
      readonly reason?: undefined
      /** What went wrong, of a bad one that was asked for. */
      readonly error?: undefined
      /** When it was read, ms since 1970. */
      readonly timestamp: number
      /** When it was seen to change last, by more than its deadband; ms since 1970. */
      readonly changedAt: number
      /** It is older than the last scan, or than `staleAfter`. */
      readonly stale: false
    }
  | {
      /** How far to trust the value. */
      readonly quality: 'uncertain'
      readonly value: V
      readonly reason: string
      readonly error?: undefined
      readonly timestamp: number
      readonly changedAt: number
      readonly stale: boolean
    }
  | {
      /** How far to trust the value. */
      readonly quality: 'bad'
      /** The last that was known; undefined when it was never read. */
      readonly value: V | undefined
      readonly reason: string
      /** Undefined until it was asked for. */
      readonly error: PlcError | undefined
      readonly timestamp: number | undefined
      readonly changedAt: number | undefined
      readonly stale: true
    }

const NOT_READ: WatchedValue = {
  quality: 'bad',
  value: undefined,
  reason: 'It has not been read yet.',
  error: undefined,
  timestamp: undefined,
  changedAt: undefined,
  stale: true,
}

const TORN = 'The array was read by several requests: its values may be of different moments.'

export class WatchedState {
  /** How far it may move before it counts as changed. */
  readonly #reach: number
  #view: WatchedValue = NOT_READ
  /** What a change is measured from; undefined as long as nothing was read. */
  #base: ReadValue | undefined

  constructor(reach: number) {
    this.#reach = reach
  }

  get view(): WatchedValue {
    return this.#view
  }

  /** @returns whether value or quality have changed */
  take(result: ReadResult): boolean {
    const before = this.#view
    const hasMoved = result.ok && this.#hasMoved(result.value)
    this.#view = result.ok ? read(result, hasMoved ? undefined : before.changedAt) : failed(before, result.error)
    if (!hasMoved && !isOtherQuality(before, this.#view)) return false
    this.told()
    return true
  }

  #hasMoved(value: ReadValue): boolean {
    return this.#base === undefined || hasChanged(this.#reach, this.#base, value)
  }

  /** Nothing has been read for so long that nobody knows. @returns whether that is new */
  outdate(reason: string): boolean {
    const before = this.#view
    if (before.quality === 'bad' || before.stale) return false
    const { value, timestamp, changedAt } = before
    this.#view = { quality: 'uncertain', value, reason, timestamp, changedAt, stale: true }
    return true
  }

  /** The value as it is now is what people know: changes are measured from it. */
  told(): void {
    this.#base = this.#view.value
  }
}

const CLAMPED = 'It is beyond the limits of its scaling: the value is the limit.'

function read(
  { value, timestamp, torn, clamped }: ReadResult & { readonly ok: true },
  changedBefore?: number,
): WatchedValue {
  const known = { value, timestamp, changedAt: changedBefore ?? timestamp }
  if (torn === true) return { quality: 'uncertain', ...known, reason: TORN, stale: false }
  if (clamped === true) return { quality: 'uncertain', ...known, reason: CLAMPED, stale: false }
  return { quality: 'good', ...known, stale: false }
}

function failed({ value, timestamp, changedAt }: WatchedValue, error: PlcError): WatchedValue {
  return { quality: 'bad', value, reason: error.message, error, timestamp, changedAt, stale: true }
}

function isOtherQuality(before: WatchedValue, after: WatchedValue): boolean {
  if (before.quality !== after.quality || before.stale !== after.stale) return true
  return after.quality === 'bad' && before.quality === 'bad' && before.error?.code !== after.error?.code
}
