// What the failure of some writes means for the others, and for the call that asked for all of them.
import { shown } from '../../basics/show'
import {
  ClosedError,
  EndCodeError,
  type Outcome,
  type PlcError,
  RequestError,
  WriteError,
  type WriteResult,
} from '../../errors'

/**
 * Whether nothing behind a failed write may be sent, so that the order is kept: a flag must not be written when its data
 * was not. A refused or forbidden one says nothing about the next; of everything else nobody knows how far it came.
 */
export function stopsOrder(error: PlcError): boolean {
  const isRefused = error instanceof EndCodeError && error.outcome === 'refused'
  return !isRefused && !(error instanceof RequestError)
}

type Failed = WriteResult & { readonly ok: false }

/** Failures that are told in the message; `results` have all. */
const MOST_TOLD = 3

/** @throws WriteError when anything was not written */
export function checkAllWritten(results: readonly WriteResult[]): void {
  const failed = results.filter((result): result is Failed => !result.ok)
  const ranked = [...failed].sort((a, b) => rankOf(a.error) - rankOf(b.error))
  const [first] = ranked
  if (first === undefined) return
  const outcome = outcomeOfAll(results.length - failed.length, failed)
  throw new WriteError(messageOf(results.length, ranked), outcome, results, first.error)
}

/** What the outcomes of the items make together: whoever writes all of them again must know what that would do. */
function outcomeOfAll(written: number, failed: readonly Failed[]): Outcome {
  const outcomes = failed.map(({ error }) => error.outcome)
  if (written > 0 || outcomes.includes('unknown')) return 'unknown'
  return outcomes.includes('refused') ? 'refused' : 'notSent'
}

/** What nobody knows comes first, what was left out because of another item last. */
function rankOf(error: PlcError): number {
  if (error.outcome === 'unknown') return 0
  return error instanceof ClosedError && error.code === 'ABORTED' ? 2 : 1
}

function messageOf(count: number, ranked: readonly Failed[]): string {
  const told = ranked.slice(0, MOST_TOLD).map(({ item, error: { message } }) => {
    const name = shown(item)
    return message.startsWith(name) || message.startsWith(JSON.stringify(item)) ? message : `${name}: ${message}`
  })
  const left = ranked.length - told.length
  const reasons = [...told, ...(left === 0 ? [] : [`And ${left} more: see results.`])].join(' ')
  if (count === 1) return reasons
  const unknown = ranked.filter(({ error }) => error.outcome === 'unknown').length
  const counts = [
    [count - ranked.length, 'written'],
    [ranked.length - unknown, 'not written'],
    [unknown, 'not known'],
  ] as const
  const sums = counts.flatMap(([number, what]) => (number === 0 ? [] : [`${number} ${what}`])).join(', ')
  return `Of ${count} items: ${sums}. ${reasons}`
}
