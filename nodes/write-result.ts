// What became of a write: one failure that says which items were written and which were not.
import type { ReadResult, WriteResult } from '../src/index'
import { carried } from './carried-value'
import { detailsOf, type FailureDetails, NodeFailure } from './failure'
import type { Texts } from './texts'
import { isSame, type NamedEntry, type WritableValue } from './write-values'

/** An entry of `msg.error.cause.items`. */
export interface WrittenItem extends Partial<FailureDetails> {
  readonly name: string
  readonly item: string
  readonly written: boolean
}

/** The failure of a write of which not every item succeeded; undefined when all were written. */
export function writeFailure(
  entries: readonly NamedEntry[],
  results: readonly WriteResult[],
  texts: Texts,
): NodeFailure | undefined {
  const failed = results.flatMap((result) => (result.ok ? [] : [detailsOf(result.error, texts)]))
  // What nobody knows the outcome of is the worst news, so it speaks for all. What was only left out because of
  // another item (ABORTED) speaks for nobody.
  const worst =
    failed.find(({ outcome }) => outcome === 'unknown') ?? failed.find(({ code }) => code !== 'ABORTED') ?? failed[0]
  if (worst === undefined) return undefined
  return new NodeFailure(worst, { items: entries.map((entry, index) => itemOf(entry, results[index], texts)) })
}

function itemOf({ name }: NamedEntry, result: WriteResult | undefined, texts: Texts): WrittenItem {
  if (result === undefined || result.ok) return { name, item: result?.item ?? name, written: result !== undefined }
  return { name, item: result.item, written: false, ...detailsOf(result.error, texts) }
}

/** An entry of `msg.error.cause.differences`. */
export interface Difference {
  readonly name: string
  readonly item: string
  readonly written: WritableValue
  /** Missing when it could not be read back. */
  readonly read?: WritableValue
  readonly error?: FailureDetails
}

/**
 * The failure when the PLC does not hold what was written and acknowledged; undefined when it does.
 * @param types of the items, as `explain` tells them
 */
export function readBackFailure(
  entries: readonly NamedEntry[],
  results: readonly ReadResult[],
  types: readonly string[],
  texts: Texts,
): NodeFailure | undefined {
  const differences = entries.flatMap(({ name, value }, index): Difference[] => {
    const result = results[index]
    if (result === undefined) return []
    // A failure is looked at as JSON, too.
    const written = carried(value, 'number')
    if (!result.ok) return [{ name, item: result.item, written, error: detailsOf(result.error, texts) }]
    const same = isSame(value, result.value, types[index] ?? '')
    return same ? [] : [{ name, item: result.item, written, read: carried(result.value, 'number') }]
  })
  if (differences.length === 0) return undefined
  const names = differences.map(({ name }) => name).join(', ')
  // The PLC acknowledged the write; what it did with it since is not known.
  return new NodeFailure(
    { code: 'READ_BACK', message: texts('error.readBack', { names }), outcome: 'unknown' },
    { differences },
  )
}
