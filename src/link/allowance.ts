// Until when a request is worth sending: one that is sent too late expires without an answer, and takes the connection with it.
import type { Job } from './framing'
import type { RoundTrips } from './round-trips'

/** A request is sent only while so much of its allowance is left, and while an answer usually comes within what is left. */
const SHARE = 1 / 10
/** A request that has not waited is sent whatever the round trips were: they may have become shorter. */
const LARGEST_SHARE = 0.9

/** After this it is not sent any more. */
export function sendBy({ deadline, allowance, roundTrips }: Job, usual: RoundTrips): number {
  if (allowance === undefined) return deadline
  const needed = Math.max(allowance * SHARE, (roundTrips ?? usual).long)
  return deadline - Math.min(needed, allowance * LARGEST_SHARE)
}
