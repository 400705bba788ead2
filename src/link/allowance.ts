// Until when a request is worth sending: one that is sent too late expires without an answer, and takes the connection with it.
import type { Job, JobEnd } from './framing'
import type { RoundTrips } from './round-trips'

/** A request is sent only while so much of its allowance is left, and while an answer usually comes within what is left. */
const SHARE = 1 / 10
/** A request that has not waited is sent whatever the round trips were: they may have become shorter. */
const LARGEST_SHARE = 0.9

/** After this it is not sent any more. */
export function sendBy({ deadline, allowance, lineTime = 0, roundTrips }: Job, usual: RoundTrips): number {
  if (allowance === undefined) return deadline
  const needed = Math.max(allowance * SHARE, (roundTrips ?? usual).long + lineTime)
  return deadline - Math.min(needed, allowance * LARGEST_SHARE)
}

/** What is known of who answers. */
interface Answers {
  readonly answeredAt: number
  readonly roundTrips: RoundTrips
}

/** Why a job that waits cannot be answered in time any more. `waiting`: requests that wait, itself included. */
export function whyUnsent(job: Job, waiting: number, { answeredAt, roundTrips: usual }: Answers): JobEnd {
  const { deadline, allowance, lineTime = 0, roundTrips = usual } = job
  // While it waited the peer answered others, only not soon enough; otherwise it is silent.
  if (allowance === undefined || answeredAt < deadline - allowance) return { kind: 'timedOut', sent: false }
  return { kind: 'tooLate', waiting, roundTrip: roundTrips.usual && roundTrips.usual + lineTime }
}
