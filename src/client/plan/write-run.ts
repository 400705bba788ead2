// One run of a prepared write, whatever family the requests are of: what became of each entry so far.
import { ClosedError, EndCodeError, PlcError, type WriteResult } from '../../errors'
import { about, isAboutNoItem } from '../item/about'
import { stopsOrder } from '../item/write-outcome'
import type { SendExchange } from './request'

/** One request, or one that reads and one that writes, and which values of which entries it writes. */
export interface RunStep {
  readonly units: readonly { readonly entry: number; readonly count: number }[]
  /** Rejects with an error whose outcome is that of the write. */
  perform(send: SendExchange): Promise<void>
}

export interface WriteRunOptions {
  /** Of the entries. */
  readonly texts: readonly string[]
  /** Entries that cannot be written. */
  readonly errors: ReadonlyMap<number, PlcError>
  readonly allOrNothing: boolean
  /** Of entries that are refused together, these are named first. */
  readonly isLikely?: (entry: number) => boolean
}

/**
 * Writes all steps once, one after another.
 *
 * - A merged request that is refused because of an item was not carried out: its entries are written one by one.
 *   Any other refusal goes to all its entries, and the next request is sent.
 * - After any other failure, an end code with which it may have been carried out among them, nothing more is sent: the entries left over get an error with the outcome `notSent`.
 *
 * @param apart the units of a step, each in a request of its own
 * @param send what it rejects with is a `PlcError`
 * @returns a result for each entry, in their order; it rejects only with what is no `PlcError`, which is a bug
 */
export async function runWrites<S extends RunStep>(
  steps: readonly S[],
  apart: (step: S) => readonly S[],
  options: WriteRunOptions,
  send: SendExchange,
): Promise<WriteResult[]> {
  const run = new WriteRun(options)
  for (const step of steps) {
    const refusal = await run.attempt(step, send)
    if (refusal === undefined) continue
    if (run.goesOnApart(step, refusal)) for (const single of apart(step)) await run.single(single, send)
    else run.fail(step, refusal)
  }
  return run.results()
}

/** Where all or nothing shall be written: one entry that cannot be written keeps the others from being sent. */
export function refuseAll(texts: readonly string[], errors: Map<number, PlcError>): void {
  const [first] = [...errors.values()]
  if (first === undefined) return
  texts.forEach((text, entry) => {
    if (errors.has(entry)) return
    const message = `${text} was not written, because all or nothing shall be: ${first.message}`
    errors.set(entry, new ClosedError('ABORTED', message, 'notSent', first))
  })
}

/** One run: what became of each entry so far. */
class WriteRun {
  readonly #texts: readonly string[]
  readonly #errors: Map<number, PlcError>
  readonly #allOrNothing: boolean
  readonly #isLikely: (entry: number) => boolean
  /** Values of each entry that were written. */
  readonly #written = new Map<number, number>()
  /** Why nothing more is sent. */
  #stopped: PlcError | undefined

  constructor({ texts, errors, allOrNothing, isLikely = () => false }: WriteRunOptions) {
    this.#texts = texts
    this.#errors = new Map(errors)
    this.#allOrNothing = allOrNothing
    this.#isLikely = isLikely
  }

  /**
   * Sends one request.
   * @returns the end code, when it was refused; other failures, and what may have been carried out, are given to the entries
   */
  async attempt(step: RunStep, send: SendExchange): Promise<EndCodeError | undefined> {
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

  async single(step: RunStep, send: SendExchange): Promise<void> {
    const refusal = await this.attempt(step, send)
    if (refusal !== undefined) this.fail(step, refusal)
  }

  /** Whether a refused request is written again, one entry at a time: it was not carried out, and one is to blame. */
  goesOnApart({ units }: RunStep, { about: blamed, carriedOut }: EndCodeError): boolean {
    const isOneToBlame = blamed === 'item' && carriedOut === false
    return units.length > 1 && !this.#allOrNothing && isOneToBlame
  }

  fail(step: RunStep, error: PlcError): void {
    if (this.#allOrNothing) this.#stopped ??= error
    const entries = [...new Set(step.units.map(({ entry }) => entry))]
    const likely = [...entries].sort((a, b) => Number(this.#isLikely(b)) - Number(this.#isLikely(a)))
    const told = mayBeAbout(error, entries.length)
      ? about(
          error,
          likely.map((entry) => ({ item: this.#text(entry) })),
        )
      : error
    for (const entry of entries) this.#set(entry, told)
  }

  #notSent(step: RunStep, cause: PlcError): void {
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
    return this.#texts[entry] ?? ''
  }

  results(): WriteResult[] {
    return this.#texts.map((item, entry) => {
      const error = this.#errors.get(entry)
      return error === undefined ? { item, ok: true } : { item, ok: false, error }
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
