// One attempt to reach a PLC over a line, and what it becomes: unlocking, the request that proves the PLC, its silence.
import { EndCodeError, endsConnection, type PlcError, ProtocolError } from '../../errors'
import type { JobEnd, RequestFrame, ResponseFrame, RoundTrips } from '../../link/link'
import type { Call } from './call'
import type { ConnectionOptions, Silence, TracedFrame } from './connection-options'
import * as failure from './failure'
import type { Line, LineEnd, LineUser } from './line'
import { Opening } from './opening'
import type { NextProbe } from './probing'
import type { Counters } from './statistics'
import { tellListener } from './tell-listener'

/** Requests without any answer in a row after which the connection counts as dead, although nobody closed it. */
const SILENT_REQUESTS = 2

/** What an attempt needs of the connection it is made for. */
export interface AttemptOwner {
  readonly counters: Counters
  readonly roundTrips: RoundTrips
  /** The PLC has answered the first request; or nothing is asked, and the first request of the program proves it. */
  verified(answered: boolean): void
  /** The PLC has answered a request of the program. */
  proved(): void
  /** It is of no use any more: the owner ends it. */
  lost(error: PlcError): void
  trace(direction: TracedFrame['direction'], bytes: Buffer): void
  /** Ranked causes of a silence of this peer. */
  causes(silence: Omit<Silence, 'answeredBefore'>): readonly string[]
  /** The client's own requests that got no answer on the connections just before. */
  readonly unanswered: readonly string[]
}

type TooLate = Extract<JobEnd, { kind: 'tooLate' }>

export class Attempt implements LineUser {
  readonly #options: ConnectionOptions
  readonly #line: Line
  readonly #owner: AttemptOwner
  readonly #opening: Opening
  #isOpen = false
  #silent = 0
  #receivedAnything = false
  #over = false
  #absentFor: number | undefined
  /** What the line gave back when it ended; what is asked from then on until the owner is told joins it. */
  #ends: readonly LineEnd[] | undefined

  constructor(options: ConnectionOptions, line: Line, owner: AttemptOwner, probe: NextProbe | undefined) {
    this.#options = options
    this.#line = line
    this.#owner = owner
    this.#opening = new Opening(options, probe, line)
  }

  /** Name of the request that is to prove the connection and has no answer yet. */
  get probing(): string | undefined {
    return this.#opening.probing
  }

  /** Whether bytes could be sent; the PLC need not have answered yet. */
  get isOpen(): boolean {
    return this.#isOpen
  }

  /** Its first request was not sent yet, because others use the line. */
  get waitsForTurn(): boolean {
    return this.#opening.waitsForTurn
  }

  get peer(): string {
    return this.#line.peer
  }

  /**
   * On a line where silence shows soon that a PLC is not there, and it did: ms that it is not asked again at least, so that
   * the others keep their pace.
   */
  get absentFor(): number | undefined {
    return this.#absentFor
  }

  get queued(): number {
    // While the connection is opened nothing waits on it but its own requests.
    return this.#opening.isGoingOn ? 0 : this.#line.counts(this).queued
  }

  /** Of what is queued, that which changes the PLC. */
  get queuedChanges(): number {
    return this.#opening.isGoingOn ? 0 : this.#line.queuedChanges(this)
  }

  get inFlight(): number {
    return this.#line.counts(this).inFlight
  }

  /** @throws what the transport throws when it cannot be made or opened */
  open(): void {
    this.#line.join(this)
  }

  #lost(error: PlcError): void {
    if (!this.#over) this.#owner.lost(error)
  }

  opened(): void {
    this.#isOpen = true
    const first = this.#opening.begin(this.#options.clock.now())
    if (first === undefined) this.#owner.verified(false)
    else this.submit(first)
    this.flush()
  }

  /** A first request was answered. */
  #goOn(refusal: PlcError | undefined): void {
    const next = this.#opening.next(refusal, this.#options.clock.now())
    if (next === undefined) this.#owner.verified(true)
    else if ('exchange' in next) this.submit(next)
    else this.#lost(next)
  }

  sent(bytes: Buffer): void {
    this.#owner.counters.counts.bytesSent += bytes.length
    this.#owner.trace('sent', bytes)
  }

  received(bytes: Buffer, now: number): void {
    this.#receivedAnything = true
    this.#opening.heard(now)
    this.#owner.counters.counts.bytesReceived += bytes.length
    this.#owner.trace('received', bytes)
  }

  unsolicited(frame: RequestFrame): void {
    this.#owner.counters.counts.unsolicited += 1
    tellListener(this.#options.onUnsolicited, frame)
  }

  stale(isAlive: boolean): void {
    // Too late for its request, but the PLC is alive.
    if (isAlive) this.#silent = 0
    this.#owner.counters.counts.stale += 1
  }

  ended(ends: readonly LineEnd[]): void {
    this.#ends = ends
  }

  lost(error: PlcError | undefined): void {
    if (error instanceof ProtocolError) this.#owner.counters.counts.protocolErrors += 1
    this.#lost(error ?? failure.closedByPeer(this.peer, this.#receivedAnything, this.#askedAlone()))
  }

  /** The client's own requests, when no other was asked since a connection that worked. */
  #askedAlone(): readonly string[] {
    const { probing } = this.#opening
    return probing === undefined ? [] : [...this.#owner.unanswered, probing]
  }

  #causes(): readonly string[] {
    const asked = this.#askedAlone()
    return this.#owner.causes({ ...this.noticed, ...(asked.length === 1 ? { onlyAsked: asked[0] ?? '' } : {}) })
  }

  /** What came of this attempt that is no answer. */
  get noticed(): Pick<Silence, 'peer' | 'heard' | 'othersAnswer'> {
    return { peer: this.peer, heard: this.#receivedAnything, othersAnswer: this.#line.othersAnswer(this) }
  }

  /** Sends it when its turn comes. `flush` afterwards. */
  submit(call: Call, now = this.#options.clock.now()): void {
    call.over(this, this.#owner.roundTrips)
    if (this.#line.canRecover) call.takes(this.#line.characterTimeOf(call.exchange), this.#options.messageWait)
    if (this.#ends === undefined) this.#line.submit(call, now)
    else this.#ends = [...this.#ends, { job: call, outcome: { kind: 'disconnected', sent: false }, sentAt: undefined }]
  }

  /** Gives a call up. `flush` afterwards. @returns whether it had been sent; `undefined` when it is not known here */
  abandon(call: Call): boolean | undefined {
    if (this.#ends === undefined) return this.#line.abandon(call)
    const outcome = this.#ends.find(({ job }) => job === call)?.outcome
    return outcome?.kind === 'disconnected' ? outcome.sent : undefined
  }

  flush(now = this.#options.clock.now()): void {
    if (!this.#over) this.#line.flush(now)
  }

  /** Why nothing may be sent any more without a new attempt. */
  expired(): PlcError | undefined {
    if (this.#line.kind !== 'datagram' || this.inFlight > 0) return undefined
    return this.#opening.expired(this.#options.clock.now(), () => this.peer)
  }

  /** What the PLC refuses has been corrected. */
  correct(): void {
    this.#opening.correct()
  }

  /** Whether the line has ended or could not be opened, and not this attempt alone. */
  get isLineLost(): boolean {
    return this.#ends !== undefined || !this.#isOpen
  }

  /** Whether another attempt would end for the same reason. */
  isFinal(reason: PlcError): boolean {
    return this.#opening.isFinal(reason)
  }

  /** Ends it, and everything on it: what has no answer is handed back with whether it had been sent. */
  end(handBack: (call: Call, sent: boolean) => void): void {
    if (this.#over) return
    this.#over = true
    for (const end of this.#ends ?? this.#line.leave(this)) {
      // An answer that arrived just before is one all the same.
      if (end.outcome.kind !== 'disconnected') this.settled(end)
      else if (!this.#opening.owns(end.job)) handBack(end.job, end.outcome.sent)
    }
  }

  settled({ job, outcome, sentAt }: LineEnd): void {
    if (outcome.kind === 'answered')
      this.#answered(job, outcome.frame, sentAt === undefined ? undefined : outcome.at - sentAt)
    else if (outcome.kind === 'timedOut')
      this.#timedOut(job, outcome.sent, outcome.isSilent === true ? sentAt : undefined)
    else if (outcome.kind === 'unproved') this.#unproved(job)
    else if (outcome.kind === 'tooLate') this.#tooLate(job, outcome)
    // `disconnected` is met by `end` only.
    else if (outcome.kind === 'failed') this.#failed(job, outcome.error)
  }

  #answered(job: Call, frame: ResponseFrame, roundTrip: number | undefined): void {
    const { counters } = this.#owner
    const isProbe = this.#opening.owns(job)
    this.#silent = 0
    if (this.#line.canRecover && !this.#over && this.#repaired(job, frame)) return
    const error = job.answer(frame, roundTrip)
    if (!isProbe) {
      counters.counts.answered += 1
      if (error instanceof EndCodeError) counters.counts.refused += 1
      if (roundTrip !== undefined) counters.roundTrip(roundTrip)
    }
    if (error !== undefined && endsConnection(error, this.#line.framing.correlation)) {
      counters.counts.protocolErrors += 1
      this.#lost(error)
    } else if (this.#over) return
    else if (isProbe) this.#goOn(error)
    else {
      const locked = error === undefined ? undefined : this.#opening.lockedBy(error, this.peer)
      if (locked === undefined) this.#owner.proved()
      else this.#lost(locked)
    }
  }

  /** On a line that can recover. @returns whether the call goes on, or has ended, because one of its frames was damaged */
  #repaired(job: Call, frame: ResponseFrame): boolean {
    const damage = job.damageOf(frame)
    if (damage === undefined) return false
    if (damage instanceof ProtocolError) {
      // Whose answer it is nobody knows: the right one may still come.
      this.#line.restore()
      this.#failed(job, damage)
      return true
    }
    if (!job.mayResend()) return false
    this.submit(job)
    return true
  }

  /** The answer was damaged, or half of it is missing. Elsewhere than on a line that can recover, the line ends with it. */
  #failed(job: Call, error: PlcError): void {
    const goesOn = this.#line.canRecover && !this.#over
    if (goesOn && job.mayRepeat()) {
      this.submit(job)
      return
    }
    job.fail(error)
    if (!goesOn) return
    this.#owner.counters.counts.protocolErrors += 1
    if (this.#opening.owns(job)) this.#lost(error)
  }

  /** @param silentSince when it was sent, if silence for the answer time of the line has ended it */
  #timedOut(job: Call, sent: boolean, silentSince: number | undefined): void {
    const isProbe = this.#opening.owns(job)
    if (sent && !job.exchange.answered) {
      takeAsDone(job)
      // The PLC has forgotten this connection: a request on it would be lost, and of a write nobody would know. A line that
      // is no connection is as good as before.
      if (!this.#line.canRecover) this.#lost(failure.reset(this.peer))
      return
    }
    if (!isProbe) this.#owner.counters.counts.timeouts += 1
    const causes = this.#causes()
    if (!sent) {
      const error = failure.notSentInTime(job.exchange.title)
      job.fail(error)
      // The attempt ends with its first request: nothing else is due on a line that nobody may use yet.
      if (isProbe) this.#lost(failure.silent(this.peer, causes, error, this.#askedAlone()))
      return
    }
    if (silentSince !== undefined) this.#absentFor = this.#line.pauseOfAbsent(silentSince, !isProbe)
    const by = silentSince === undefined ? 'deadline' : 'answer time'
    this.#silence(job, causes, failure.noAnswer(job.exchange.title, this.peer, causes, by))
  }

  /** It waited so long that an answer would not come in time: the connection is as good as before. */
  #tooLate(job: Call, { waiting, roundTrip }: TooLate): void {
    if (!this.#opening.owns(job)) this.#owner.counters.counts.overloaded += 1
    job.fail(failure.overloaded(job.exchange.title, waiting, roundTrip))
  }

  /** What must come back before a request on a fixed port did not: the request was not sent. */
  #unproved(job: Call): void {
    if (!this.#opening.owns(job)) this.#owner.counters.counts.timeouts += 1
    const causes = [failure.NO_SELF_TEST, ...this.#causes()]
    this.#silence(job, causes, failure.unproved(job.exchange.title, this.peer, causes))
  }

  #silence(job: Call, causes: readonly string[], error: PlcError): void {
    // Without an answer of any kind there is nothing to lose; the probe is such a case.
    const unproved = this.#opening.owns(job) || !this.#receivedAnything
    job.fail(error)
    this.#silent += 1
    // Without bytes for a while nothing tells a dead cable from a slow PLC, so the connection is made anew. Where its
    // answer would have begun by now it is not there: another request would cost the others as much time again.
    if (unproved || this.#absentFor !== undefined || this.#silent >= SILENT_REQUESTS)
      this.#lost(failure.silent(this.peer, causes, error, this.#askedAlone()))
  }
}

/** A command that is not answered when it succeeds (Remote Reset): silence and a lost connection are its success. */
export function takeAsDone(call: Call): void {
  call.answer({ head: {}, serial: undefined, endCode: 0, body: Buffer.alloc(0) })
}
