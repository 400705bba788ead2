/** A session with the time as a number, and the PLC's side of its frames. */

import {
  type Framing,
  type Job,
  type RequestFrame,
  Session,
  type SessionEvent,
  type SessionOptions,
} from '../../src/link/link'
import { frameFacts, slmpFrameNames } from '../../src/melsec/frame/frames'
import { ownStation } from '../../src/melsec/frame/route'
import { type SlmpHead, slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { questionOf } from '../support/question'

/** Every frame of the SLMP set in every data code it has. */
export const slmpFrames = slmpFrameNames.flatMap((frame) =>
  frameFacts[frame].codes.map((code) => ({
    title: `${frame} ${code}`,
    frame,
    code,
    framing: slmpFraming(frame, code),
  })),
)

export const HEAD: SlmpHead = { ...ownStation, timer: 0 }

export interface TestJob extends Job {
  readonly name: string
}

/** A job; it gets its frame from the session that it is given to. */
export function job(name: string, deadline = 1000): TestJob {
  const unframed = (): never => {
    throw new Error(`job ${name} was given to no session`)
  }
  return { name, deadline, write: unframed, mismatch: unframed, responseLength: unframed }
}

/** The body of a request names its job, so that the PLC's side can tell the requests apart. */
export class TestSession extends Session<TestJob> {
  readonly #framing: Framing<SlmpHead>

  constructor(framing: Framing<SlmpHead>, options: SessionOptions) {
    super(framing, options)
    this.#framing = framing
  }

  override submit(given: TestJob, now: number): void {
    super.submit(Object.assign(given, questionOf(this.#framing, HEAD, Buffer.from(given.name))), now)
  }
}

export function sessionOf(framing: Framing<SlmpHead>, options: Partial<SessionOptions> = {}): TestSession {
  return new TestSession(framing, { kind: 'stream', window: 1, ...options })
}

/** What the session wants to send, as the PLC reads it. */
export function sent(session: TestSession, framing: Framing<SlmpHead>): RequestFrame<SlmpHead>[] {
  const requests: RequestFrame<SlmpHead>[] = []
  for (let bytes = session.transmit(); bytes !== undefined; bytes = session.transmit()) {
    const scanned = framing.request.scan(bytes, () => undefined)
    if (scanned?.used !== bytes.length) throw new Error('the session sent something else than one frame')
    requests.push(scanned.frame)
  }
  return requests
}

/** The answer to a request: its own body, so that it shows whose answer it is. */
export function answer(
  framing: Framing<SlmpHead>,
  request: Pick<RequestFrame<SlmpHead>, 'serial' | 'body'>,
  { head = HEAD, endCode = 0 } = {},
): Buffer {
  return framing.response.write(head, request.serial ?? 0, endCode, request.body)
}

export function eventsOf<J extends Job>(session: Session<J>): SessionEvent<J>[] {
  const events: SessionEvent<J>[] = []
  for (let event = session.poll(); event !== undefined; event = session.poll()) events.push(event)
  return events
}

/** The events in short, e.g. `A answered A`, `B timedOut unsent`, `drop UNEXPECTED_ANSWER`. */
export function told(session: TestSession): string[] {
  return eventsOf(session).map((event) => {
    switch (event.kind) {
      case 'done':
        return `${event.job.name} ${outcomeOf(event.outcome)}`
      case 'unsolicited':
        return `unsolicited ${event.frame.body.toString('latin1')}`
      case 'stale':
        return `stale ${event.serial ?? ''}`.trim()
      case 'stray':
        return 'stray'
      case 'drop':
        return `drop ${event.error.code}`
      case 'renew':
        return `renew ${event.reason}`
      default:
        return event satisfies never
    }
  })
}

type JobEnd = Extract<SessionEvent<TestJob>, { kind: 'done' }>['outcome']

function outcomeOf(outcome: JobEnd): string {
  switch (outcome.kind) {
    case 'answered':
      return `answered ${outcome.frame.body.toString('latin1')}${outcome.frame.endCode === 0 ? '' : ` ${outcome.frame.endCode.toString(16)}`}`
    case 'failed':
      return `failed ${outcome.error.code}`
    case 'unproved':
    case 'tooLate':
      return outcome.kind
    default:
      return `${outcome.kind} ${outcome.sent ? 'sent' : 'unsent'}`
  }
}
