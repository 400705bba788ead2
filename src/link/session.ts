// The client's side of one connection, sans-IO: bytes and the time go in; bytes, outcomes and the next deadline come
// out. No sockets, no timers, no promises.
//
// Without a serial number a late answer would be taken for the next one. So `order` means one request in flight, and
// after a timeout or an abandoned request the connection is dropped (stream) or the local port is changed (datagram).
// The same holds with serial numbers for a stream that stopped in the middle of an answer.
// With datagrams the network may also duplicate, so there the port is changed after every answer. A port that stays
// needs a fence (fence.ts): each request waits until it is proved that nothing earlier is under way.
// A line that is no connection (serial) cannot be made anew: it is brought to a known state (recovery.ts) instead.
import { ConnectionError, PlcError, ProtocolError, RequestError } from '../errors'
import { sendBy, whyUnsent } from './allowance'
import type { Fence } from './fence'
import { endsWith, type Found, findFrame } from './found'
import type { AnswerFraming, Job, JobEnd, ResponseFrame, SessionEvent } from './framing'
import { Incoming } from './incoming'
import { OwnEcho } from './own-echo'
import { type Recovery, type RecoveryOptions, recoveryOf } from './recovery'
import { RoundTrips } from './round-trips'
import { Scheduler } from './scheduler'
import { SerialNumbers } from './serial-numbers'

/** How the session reads its bytes, and how much may be under way. */
export interface SessionOptions {
  /** `datagram`: one chunk is one frame, consumed exactly. */
  readonly kind: 'stream' | 'datagram'
  /** Requests in flight at once. More than 1 needs a frame with a serial number. */
  readonly window: number
  /** Bytes of an unfinished frame that are kept; more is a broken peer. */
  readonly maxFrame?: number
  /** Of the peer; hand the same one to each of its sessions, so that no number is used again too soon. */
  readonly serials?: SerialNumbers
  /** Of the peer, too. */
  readonly roundTrips?: RoundTrips
  /** For framings with `recovery`: the line is brought to a known state instead of being dropped. */
  readonly recovery?: RecoveryOptions
}

/** Bytes to send. On datagram links one buffer is one datagram. */
export interface Sent<J> {
  readonly bytes: Buffer
  /** Whose request it is; `undefined`: the session's own question. */
  readonly job: J | undefined
}

/** How a job ended. */
export type Done<J extends Job> = Extract<SessionEvent<J>, { kind: 'done' }>

interface Outgoing<J> {
  readonly bytes: Buffer
  readonly job: J | undefined
  /** Handed out by `transmit()`. Until then the PLC cannot have seen it. */
  sent: boolean
}

interface Pending<J> extends Outgoing<J> {
  readonly job: J
  readonly serial: number
  readonly sentAt: number
}

export class Session<J extends Job = Job> {
  readonly #framing: AnswerFraming
  readonly #options: SessionOptions
  readonly #fence: Fence | undefined
  readonly #recovery: Recovery | undefined
  #pending: Pending<J>[] = []
  readonly #waiting = new Scheduler<J>()
  #output: Outgoing<J>[] = []
  #events: SessionEvent<J>[] = []
  readonly #received: Incoming
  /** What has come is an answer, if nothing more comes. */
  #isHeld = false
  readonly #serials: SerialNumbers
  readonly #roundTrips: RoundTrips
  #answeredAt = Number.NEGATIVE_INFINITY
  /** Set once the connection must go: nothing more is sent or attributed on it. */
  #dropped = false

  /** `fence`: for datagrams where the local port stays. */
  constructor(framing: AnswerFraming, options: SessionOptions, fence?: Fence) {
    if (framing.correlation === 'order' && options.window !== 1) {
      const message = `The ${framing.name} frame has no serial number, so only one request may be in flight; asked for ${options.window}.`
      throw new RequestError('BAD_OPTION', message, 'inFlight')
    }
    this.#framing = framing
    this.#options = options
    this.#fence = fence
    fence?.begin()
    this.#recovery = options.kind === 'stream' ? recoveryOf(framing, options.recovery) : undefined
    this.#received = new Incoming(this.#recovery && new OwnEcho(options.recovery?.echo ?? 'auto'))
    this.#serials = options.serials ?? new SerialNumbers()
    this.#roundTrips = options.roundTrips ?? new RoundTrips()
  }

  /** Requests sent, or just about to be, and not answered. */
  get inFlight(): number {
    return this.#pending.length
  }

  /** Requests accepted and not sent. */
  get queued(): number {
    return this.#waiting.size
  }

  /** Bytes of an unfinished frame that are kept: never more than `maxFrame`. */
  get buffered(): number {
    return this.#received.length
  }

  /** As `inFlight` and `queued`, of the jobs that belong. */
  counts(belongs: (job: J) => boolean): { readonly inFlight: number; readonly queued: number } {
    let queued = 0
    for (const job of this.#waiting) if (belongs(job)) queued += 1
    return { inFlight: this.#pending.filter(({ job }) => belongs(job)).length, queued }
  }

  /**
   * Brings a line that can recover to a known state, when it begins, and when an answer turned out to be none: what was asked
   * before may still be answered. What was about to be sent waits.
   */
  restore(now: number): void {
    if (this.#recovery === undefined) return
    this.#recovery.mayBeAsked(now)
    for (const { job } of this.#pending.filter((entry) => !entry.sent)) this.#waiting.add(job)
    this.#pending = this.#pending.filter((entry) => entry.sent)
    this.#output = []
    this.#recover(now)
  }

  /** Until when nothing may be sent: the line is not in a known state, or rests between two requests. */
  pausesUntil(now: number): number | undefined {
    return this.#recovery?.due(now)
  }

  submit(job: J, now: number): void {
    this.#waiting.add(job)
    this.#fill(now)
  }

  /**
   * Gives a job up. A request that is in flight may still be carried out and answered, so it ends as a timeout does.
   * @returns whether it had been sent; `undefined` when the session does not know the job.
   */
  abandon(job: J, now: number): boolean | undefined {
    if (this.#waiting.remove(job)) return false
    const pending = this.#pending.find((entry) => entry.job === job)
    if (pending === undefined) return undefined
    this.#giveUp([pending], 'a request in flight was abandoned', now)
    this.#fill(now)
    return pending.sent
  }

  /** Gives up the jobs that belong, and tells here instead of by events how they ended, also those that just have. */
  release(belongs: (job: J) => boolean, now: number): readonly Done<J>[] {
    for (const job of [...this.#waiting].filter(belongs)) {
      this.#waiting.remove(job)
      this.#finish(job, { kind: 'disconnected', sent: false }, undefined)
    }
    const pending = this.#pending.filter(({ job }) => belongs(job))
    for (const { job, sent, sentAt } of pending) this.#finish(job, { kind: 'disconnected', sent }, sentAt)
    const isTheirs = (event: SessionEvent<J>): event is Done<J> => event.kind === 'done' && belongs(event.job)
    const ends = this.#events.filter(isTheirs)
    this.#events = this.#events.filter((event) => !isTheirs(event))
    if (pending.length > 0) this.#giveUp(pending, 'a request in flight was abandoned', now)
    this.#fill(now)
    return ends
  }

  /** `readAt`: where that is later than `now`, because bytes that came before may wait to be read. */
  receive(chunk: Buffer, now: number, readAt = now): void {
    if (this.#dropped) return
    if (this.#options.kind === 'datagram') this.#receiveDatagram(chunk, now)
    else if (this.#recovery?.swallows(now, readAt) === true) this.#events.push({ kind: 'stray' })
    else this.#receiveStream(chunk, now)
    this.#fill(now)
  }

  /** Ends what is overdue. Call it when `nextTimeout` is reached. `listened`: until when, where a program stood still since. */
  timeout(now: number, listened = now): void {
    if (listened < now) this.#recovery?.listenAnew(listened, now)
    for (const job of [...this.#waiting].filter((entry) => sendBy(entry, this.#roundTrips) <= now)) this.#tooLate(job)
    const late = this.#pending.filter((entry) => entry.job.deadline <= now)
    for (const { job, sentAt, sent } of late) this.#finish(job, { kind: 'timedOut', sent }, sentAt)
    if (late.length > 0) this.#giveUp(late, 'no answer before the deadline', now)
    if (this.#halfUntil !== undefined && this.#halfUntil <= now) this.#endHalf(now)
    if (this.#answerBy !== undefined && this.#answerBy <= now) this.#silence(now)
    this.#fill(now)
  }

  /** The connection is gone: what was in flight has an unknown outcome, the rest was not sent. */
  disconnected(): void {
    const [pending, waiting] = [this.#pending, this.#waiting.clear()]
    this.#pending = []
    this.#output = []
    this.#received.clear()
    this.#dropped = true
    for (const { job, serial, sentAt, sent } of pending) {
      if (sent) this.#serials.rest(serial)
      this.#finish(job, { kind: 'disconnected', sent }, sentAt)
    }
    for (const job of waiting) this.#finish(job, { kind: 'disconnected', sent: false }, undefined)
  }

  /** When something is due, or `undefined` when nothing waits. */
  nextTimeout(now: number): number | undefined {
    let earliest: number | undefined
    if (this.#waiting.peek(now) !== undefined) earliest = this.#fence?.due ?? this.#recovery?.due(now)
    earliest = earlier(earlier(earliest, this.#halfUntil), this.#answerBy)
    if (this.#pending.length < this.#options.window) earliest = earlier(earliest, this.#waiting.due(now))
    for (const { job } of this.#pending) if (earliest === undefined || job.deadline < earliest) earliest = job.deadline
    // Nothing waits between the requests of most programs.
    if (this.#waiting.size === 0) return earliest
    for (const job of this.#waiting) earliest = earlier(earliest, sendBy(job, this.#roundTrips))
    return earliest
  }

  /** The next bytes to send, or `undefined`. */
  transmit(): Buffer | undefined {
    return this.next()?.bytes
  }

  /** The next bytes to send, with whose they are. */
  next(): Sent<J> | undefined {
    const next = this.#output.shift()
    if (next === undefined) return undefined
    next.sent = true
    const { bytes, job } = next
    if (this.#recovery !== undefined && job !== undefined) {
      this.#received.mayEcho(bytes)
      this.#recovery.asked(bytes.length, job.answerDelay ?? 0, this.#pending.at(-1)?.sentAt ?? 0)
    }
    return next
  }

  /** The next event, or `undefined`. */
  poll(): SessionEvent<J> | undefined {
    return this.#events.shift()
  }

  #fill(now: number): void {
    while (!this.#dropped && this.#pending.length < this.#options.window) {
      const job = this.#waiting.peek(now)
      if (job === undefined) return
      if (sendBy(job, this.#roundTrips) <= now) {
        this.#tooLate(job)
        continue
      }
      if (!this.#mayLeave(job, now)) return
      this.#waiting.take(now)
      this.#fence?.sent()
      const serial = this.#serials.take((used) => this.#pending.some((entry) => entry.serial === used))
      const entry = { job, serial, bytes: job.write(serial), sentAt: now, sent: false }
      this.#pending.push(entry)
      this.#output.push(entry)
    }
  }

  /** Ends a waiting job that cannot be answered in time any more. */
  #tooLate(job: J): void {
    const waiting = this.#waiting.size
    this.#waiting.remove(job)
    const why = whyUnsent(job, waiting, { answeredAt: this.#answeredAt, roundTrips: this.#roundTrips })
    const isUnproved = why.kind === 'timedOut' && this.#fence?.due !== undefined && job.needsNoProof !== true
    this.#finish(job, isUnproved ? { kind: 'unproved' } : why, undefined)
  }

  /** Whether its answer could be told from earlier ones; asks for the proof when it is due. */
  #mayLeave(job: J, now: number): boolean {
    if (this.#recovery?.holds(now) === true) return false
    const fence = this.#fence
    if (fence === undefined || job.needsNoProof === true || fence.allows(now)) return true
    const bytes = fence.ask(now)
    if (bytes !== undefined) this.#output.push({ bytes, job: undefined, sent: false })
    return false
  }

  #receiveStream(chunk: Buffer, now: number): void {
    this.#received.add(chunk)
    this.#readStream(now, false)
  }

  /** @param isAll nothing more comes for now */
  #readStream(now: number, isAll: boolean): void {
    this.#isHeld = false
    try {
      while (!this.#dropped && !this.#received.passOver(isAll) && this.#received.length > 0) {
        if (this.#skipNoise()) continue
        const found = this.#find(this.#received.bytes, isAll || this.#recovery === undefined)
        this.#isHeld = found?.kind === 'held'
        if (found === undefined || this.#isHeld) break
        this.#received.mayFollow(found.kind === 'answer' ? found.answer.mayFollow : undefined)
        this.#take(found, now)
        this.#received.take(found.used)
      }
      this.#received.refuseEndless(this.#options.maxFrame)
    } catch (error) {
      this.#fail(error, now)
    }
    this.#received.keep()
  }

  #skipNoise(): boolean {
    const noise = this.#recovery === undefined ? 0 : (this.#framing.response.noise?.(this.#received.bytes) ?? 0)
    if (noise === 0) return false
    this.#received.take(noise)
    this.#events.push({ kind: 'stray' })
    return true
  }

  /** Until when the rest of half a frame may come; `undefined` where it may come at any time, or nothing is there. */
  get #halfUntil(): number | undefined {
    return this.#received.length === 0 ? undefined : this.#recovery?.halfUntil(this.#isHeld)
  }

  /** Of a request of which nothing has come. */
  get #answerBy(): number | undefined {
    return this.#received.length > 0 ? undefined : this.#recovery?.answerBy
  }

  #silence(now: number): void {
    const silent = this.#pending.filter((entry) => entry.sent)
    for (const { job, sentAt } of silent) this.#finish(job, { kind: 'timedOut', sent: true, isSilent: true }, sentAt)
    this.#giveUp(silent, 'no answer within its time', now)
  }

  #endHalf(now: number): void {
    this.#readStream(now, true)
    const { bytes } = this.#received
    if (bytes.length === 0) return
    if (this.#pending.some((entry) => entry.sent)) {
      const message = `An answer stopped after ${bytes.length} byte(s).`
      this.#fail(new ProtocolError('TRUNCATED', message, { offset: bytes.length, bytes }), now)
      return
    }
    this.#received.clear()
    this.#events.push({ kind: 'stray' })
  }

  /** One datagram is one frame. What does not fit is looked at before anything of it is believed. */
  #receiveDatagram(datagram: Buffer, now: number): void {
    const { length } = datagram
    if (this.#isOfFence(datagram)) return
    try {
      const found = this.#find(datagram, true)
      if (found === undefined) {
        throw new ProtocolError('TRUNCATED', 'A datagram ended before its frame did.', {
          offset: length,
          bytes: datagram,
        })
      }
      if (!endsWith(found, datagram)) {
        const message = `A datagram holds ${length - found.used} byte(s) behind its frame.`
        throw new ProtocolError('TRAILING', message, { offset: found.used, bytes: datagram })
      }
      this.#take(found, now)
    } catch (error) {
      this.#fail(error, now)
    }
  }

  /** Whether it is the fence's, or of something before it: no request in flight is answered by it. */
  #isOfFence(datagram: Buffer): boolean {
    if (this.#fence === undefined || this.#framing.response.isUnsolicited?.(datagram) === true) return false
    const seen = this.#fence.look(datagram)
    if (seen === 'stray') this.#events.push({ kind: 'stray' })
    return seen !== undefined
  }

  #find(bytes: Buffer, isAll: boolean): Found | undefined {
    return findFrame(this.#framing, bytes, {
      isAsked: this.#framing.correlation === 'serial' || this.#pending.some((entry) => entry.sent),
      responseLength: (head, soFar) => this.#pending[0]?.job.responseLength(head, soFar),
      isAll,
    })
  }

  #take(found: Found, now: number): void {
    switch (found.kind) {
      case 'answer':
        this.#attribute(found.answer.frame, now)
        return
      case 'unsolicited':
        this.#events.push({ kind: 'unsolicited', frame: found.frame })
        return
      case 'held':
        return
      case 'unasked':
        if (this.#options.kind === 'stream' && this.#recovery === undefined) {
          throw new ProtocolError('UNEXPECTED_ANSWER', 'An answer arrived that nobody asked for.', {
            offset: 0,
            bytes: this.#received.bytes,
          })
        }
        this.#events.push({ kind: 'stale', serial: undefined })
        return
      default:
        found satisfies never
    }
  }

  #attribute(frame: ResponseFrame, now: number): void {
    const at =
      this.#framing.correlation === 'serial'
        ? this.#pending.findIndex((entry) => entry.serial === frame.serial)
        : this.#pending.length - 1
    const found = this.#pending[at]
    if (found === undefined) {
      // The late answer to a request that was given up: its number may be used again from now on.
      this.#serials.release(frame.serial)
      this.#events.push({ kind: 'stale', serial: frame.serial })
      return
    }
    const mismatch = found.job.mismatch(frame.head)
    if (mismatch !== undefined)
      throw new ProtocolError('ECHO_MISMATCH', `The answer is not the request's: ${mismatch}.`)
    // Mostly it is the only one, and the last is taken for less than any is cut out.
    if (this.#pending.length === 1) this.#pending.pop()
    else this.#pending.splice(at, 1)
    // The first requests on a connection meet a peer that is still waking up.
    const { allowance, lineTime = 0, roundTrips = this.#roundTrips } = found.job
    if (allowance !== undefined) roundTrips.add(Math.max(0, now - found.sentAt - lineTime))
    this.#answeredAt = now
    this.#fence?.answered()
    this.#recovery?.answered()
    this.#finish(found.job, { kind: 'answered', frame, at: now }, found.sentAt)
    if (this.#options.kind === 'datagram' && this.#framing.correlation === 'order') this.#renew('answered')
  }

  #giveUp(entries: readonly Pending<J>[], why: string, now: number): void {
    this.#pending = this.#pending.filter((entry) => !entries.includes(entry))
    this.#output = this.#output.filter((entry) => !entries.some((gone) => gone === entry))
    const sent = entries.filter((entry) => entry.sent)
    if (sent.length === 0) return
    if (this.#framing.correlation === 'serial') {
      for (const { serial } of sent) this.#serials.rest(serial)
      this.#leaveHalfAnswer(why)
      return
    }
    if (this.#options.kind === 'datagram') {
      this.#renew('givenUp')
      return
    }
    if (this.#recover(now)) return
    const message = `The connection was dropped: ${why}, and without a serial number a late answer could not be told from the next one.`
    this.#drop(new ConnectionError('DISCONNECTED', message, 'unknown'))
  }

  /** Brings the line to a known state, where that can be done. @returns whether it can */
  #recover(now: number): boolean {
    if (this.#recovery === undefined) return false
    const hasCome = this.#received.length > 0
    this.#received.clear()
    const bytes = this.#recovery.begin(now, hasCome)
    if (bytes.length > 0) this.#output.unshift({ bytes, job: undefined, sent: false })
    return true
  }

  /** A late or second answer may come to this port; a fence is told to stand again before the next request. */
  #renew(reason: 'answered' | 'givenUp'): void {
    if (this.#fence === undefined) this.#events.push({ kind: 'renew', reason })
  }

  /**
   * The end of half an answer may never come: the next answer would be read as a part of it, and a write that was
   * carried out would end as unknown. As long as others are in flight it may still come with their answers.
   */
  #leaveHalfAnswer(why: string): void {
    if (this.#received.length === 0 || this.#pending.some((entry) => entry.sent)) return
    const message = `The connection was dropped: ${why}, and ${this.#received.length} byte(s) of an unfinished answer had arrived.`
    this.#drop(new ConnectionError('DISCONNECTED', message, 'unknown'))
  }

  #fail(error: unknown, now: number): void {
    if (!(error instanceof PlcError)) throw error
    const failed = this.#pending.filter((entry) => entry.sent)
    // What is still here was not sent: it ends with the connection, and its owner may send it on the next one.
    this.#pending = this.#pending.filter((entry) => !entry.sent)
    for (const { job, serial, sentAt } of failed) {
      this.#serials.rest(serial)
      this.#finish(job, { kind: 'failed', error }, sentAt)
    }
    if (!this.#recover(now)) this.#drop(error)
  }

  #drop(error: PlcError): void {
    this.#dropped = true
    this.#received.clear()
    this.#output = []
    this.#events.push({ kind: 'drop', error })
  }

  #finish(job: J, outcome: JobEnd, sentAt: number | undefined): void {
    this.#events.push({ kind: 'done', job, outcome, sentAt })
  }
}

function earlier(a: number | undefined, b: number | undefined): number | undefined {
  return a === undefined || (b !== undefined && b < a) ? b : a
}
