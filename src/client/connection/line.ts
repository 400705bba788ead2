// One attempt to connect and the connection it becomes: a transport, a session, and the first request that proves it.
import { type ConnectionError, EndCodeError, endsConnection, type PlcError, ProtocolError } from '../../errors'
import {
  type Fence,
  type Outcome,
  type ResponseFrame,
  type RoundTrips,
  type SerialNumbers,
  Session,
  type SessionEvent,
} from '../../link/link'
import type { Transport } from '../../transport/transport'
import type { Call } from './call'
import type { ConnectionOptions, TracedFrame } from './connection-options'
import * as failure from './failure'
import { Opening } from './opening'
import type { NextProbe } from './probing'
import type { Counters } from './statistics'
import { tellListener } from './tell-listener'

/** Requests without any answer in a row after which the connection counts as dead, although nobody closed it. */
const SILENT_REQUESTS = 2

/** What a line needs of the connection it is a part of. */
export interface LineOwner {
  readonly counters: Counters
  readonly serials: SerialNumbers
  readonly fence: Fence
  readonly roundTrips: RoundTrips
  /** The PLC has answered the first request; or nothing is asked, and the first request of the program proves it. */
  verified(answered: boolean): void
  /** The PLC has answered a request of the program. */
  proved(): void
  /** The line is of no use any more: the owner ends it. */
  lost(error: PlcError): void
  /** Something is due at another time than before. */
  schedule(): void
  trace(direction: TracedFrame['direction'], bytes: Buffer): void
  /** Ranked causes of a silence of this peer. `asked`: the client's own request, when it was asked no other. */
  causes(peer: string, asked?: string): readonly string[]
  /** The client's own requests that got no answer on the connections just before. */
  readonly unanswered: readonly string[]
}

type Done = Extract<SessionEvent<Call>, { kind: 'done' }>

type TooLate = Extract<Outcome, { kind: 'tooLate' }>

export class Line {
  readonly #options: ConnectionOptions
  readonly #owner: LineOwner
  #transport: Transport | undefined
  #session: Session<Call> | undefined
  readonly #opening: Opening
  #openBy: number | undefined
  #silent = 0
  #receivedAnything = false
  #ended = false

  constructor(options: ConnectionOptions, owner: LineOwner, probe: NextProbe | undefined) {
    this.#options = options
    this.#owner = owner
    this.#opening = new Opening(options, probe)
  }

  /** Name of the request that is to prove the connection and has no answer yet. */
  get probing(): string | undefined {
    return this.#opening.probing
  }

  /** Whether bytes can be sent; the PLC need not have answered yet. */
  get isOpen(): boolean {
    return this.#session !== undefined
  }

  get peer(): string {
    return this.#transport?.description ?? 'the PLC'
  }

  get queued(): number {
    // While the connection is opened nothing waits on it but its own requests.
    return this.#opening.isGoingOn ? 0 : (this.#session?.queued ?? 0)
  }

  get inFlight(): number {
    return this.#session?.inFlight ?? 0
  }

  /** @throws what the transport throws when it cannot be made or opened */
  open(): void {
    const { clock, connectTimeout, openTransport } = this.#options
    this.#openBy = clock.now() + connectTimeout
    const transport = openTransport()
    this.#transport = transport
    transport.open({
      opened: () => this.#guard(() => this.#opened(transport)),
      renewed: () => this.#guard(() => this.flush()),
      received: (bytes) => this.#guard(() => this.#received(bytes)),
      closed: (error) => this.#guard(() => this.#closed(error)),
    })
  }

  /**
   * For what the transport calls. One that was given up may still have a callback under way, which is not listened to.
   * Anything that is thrown is a bug of this package; the machine beside us must not lose its program to it.
   */
  #guard(run: () => void): void {
    if (this.#ended) return
    try {
      run()
    } catch (error) {
      this.#lost(failure.asPlcError(error))
    }
  }

  #lost(error: PlcError): void {
    if (!this.#ended) this.#owner.lost(error)
  }

  #opened(transport: Transport): void {
    const { framing, inFlight, clock } = this.#options
    const { serials, roundTrips } = this.#owner
    this.#openBy = undefined
    const options = { kind: transport.kind, window: inFlight, serials, roundTrips }
    this.#session = new Session<Call>(framing, options, this.#fenceFor(transport))
    const first = this.#opening.begin(clock.now())
    if (first === undefined) this.#owner.verified(false)
    else this.submit(first)
    this.flush()
  }

  /** Where a late answer can come to the port of the next request, also one of the program before. */
  #fenceFor({ kind, renewable }: Transport): Fence | undefined {
    return kind === 'stream' || renewable ? undefined : this.#owner.fence
  }

  /** A first request was answered. */
  #goOn(refusal: PlcError | undefined): void {
    const next = this.#opening.next(refusal, this.#options.clock.now())
    if (next === undefined) this.#owner.verified(true)
    else if ('exchange' in next) this.submit(next)
    else this.#lost(next)
  }

  #received(bytes: Buffer): void {
    this.#receivedAnything = true
    this.#opening.heard(this.#options.clock.now())
    this.#owner.counters.add('bytesReceived', bytes.length)
    this.#owner.trace('received', bytes)
    if (this.#ended) return
    this.#session?.receive(bytes, this.#options.clock.now())
    this.flush()
  }

  #closed(error: ConnectionError | undefined): void {
    this.#lost(error ?? failure.closedByPeer(this.peer, this.#receivedAnything, this.#askedAlone()))
  }

  /** The client's own requests, when no other was asked since a connection that worked. */
  #askedAlone(): readonly string[] {
    const { probing } = this.#opening
    return probing === undefined ? [] : [...this.#owner.unanswered, probing]
  }

  #causes(): readonly string[] {
    const asked = this.#askedAlone()
    return this.#owner.causes(this.peer, asked.length === 1 ? asked[0] : undefined)
  }

  /** Sends it when its turn comes. `flush` afterwards. */
  submit(call: Call): void {
    this.#session?.submit(call, this.#options.clock.now())
  }

  /** Gives a call up. `flush` afterwards. @returns whether it had been sent; `undefined` when it is not known here */
  abandon(call: Call): boolean | undefined {
    return this.#session?.abandon(call, this.#options.clock.now())
  }

  /** Takes what the session has to say, then what it has to send, until it is quiet. */
  flush(): void {
    const session = this.#session
    if (session === undefined) return
    for (let event = session.poll(); event !== undefined; event = session.poll()) {
      this.#take(event)
      if (this.#ended) return
    }
    while (this.#transport?.ready === true) {
      const bytes = session.transmit()
      if (bytes === undefined) break
      this.#send(bytes)
      if (this.#ended) return
    }
    this.#owner.schedule()
  }

  /** Why nothing may be sent any more without a new line. */
  expired(): PlcError | undefined {
    if (this.#transport?.kind !== 'datagram' || this.inFlight > 0) return undefined
    return this.#opening.expired(this.#options.clock.now(), this.peer)
  }

  /** What the PLC refuses has been corrected. */
  correct(): void {
    this.#opening.correct()
  }

  /** Whether another attempt would end for the same reason. */
  isFinal(reason: PlcError): boolean {
    return this.#opening.isFinal(reason)
  }

  nextTimeout(): number | undefined {
    return this.#openBy ?? this.#session?.nextTimeout()
  }

  timeout(now: number): void {
    if (this.#openBy !== undefined && this.#openBy <= now) {
      this.#lost(failure.connectTimedOut(this.peer, this.#options.connectTimeout))
      return
    }
    this.#session?.timeout(now)
    this.flush()
  }

  /** Ends it, and everything on it: what has no answer is handed back with whether it had been sent. */
  end(handBack: (call: Call, sent: boolean) => void): void {
    if (this.#ended) return
    this.#ended = true
    this.#transport?.close()
    const session = this.#session
    session?.disconnected()
    for (let event = session?.poll(); event !== undefined; event = session?.poll()) {
      if (event.kind === 'drop' || event.kind === 'renew') continue
      // An answer that arrived just before is one all the same.
      if (event.kind !== 'done' || event.outcome.kind !== 'disconnected') this.#take(event)
      else if (!this.#opening.owns(event.job)) handBack(event.job, event.outcome.sent)
    }
  }

  #send(bytes: Buffer): void {
    this.#owner.counters.add('bytesSent', bytes.length)
    this.#owner.trace('sent', bytes)
    if (!this.#ended) this.#transport?.send(bytes)
  }

  #take(event: SessionEvent<Call>): void {
    const { counters } = this.#owner
    switch (event.kind) {
      case 'done':
        this.#settle(event)
        return
      case 'unsolicited':
        counters.add('unsolicited')
        tellListener(this.#options.onUnsolicited, event.frame)
        return
      case 'stale':
        // Too late for its request, but the PLC is alive.
        this.#silent = 0
        counters.add('stale')
        return
      case 'stray':
        counters.add('stale')
        return
      case 'renew':
        this.#transport?.renew()
        return
      case 'drop':
        if (event.error instanceof ProtocolError) counters.add('protocolErrors')
        this.#lost(event.error)
        return
      default:
        event satisfies never
    }
  }

  #settle({ job, outcome, sentAt }: Done): void {
    if (outcome.kind === 'answered') this.#answered(job, outcome.frame, sentAt)
    else if (outcome.kind === 'timedOut') this.#timedOut(job, outcome.sent)
    else if (outcome.kind === 'unproved') this.#unproved(job)
    else if (outcome.kind === 'tooLate') this.#tooLate(job, outcome)
    // `disconnected` is met by `end` only.
    else if (outcome.kind === 'failed') job.fail(outcome.error)
  }

  #answered(job: Call, frame: ResponseFrame, sentAt: number | undefined): void {
    const { counters } = this.#owner
    const isProbe = this.#opening.owns(job)
    this.#silent = 0
    const roundTrip = sentAt === undefined ? undefined : this.#options.clock.now() - sentAt
    const error = job.answer(frame, roundTrip)
    if (!isProbe) {
      counters.add('answered')
      if (error instanceof EndCodeError) counters.add('refused')
      if (roundTrip !== undefined) counters.roundTrip(roundTrip)
    }
    if (error !== undefined && endsConnection(error, this.#options.framing.correlation)) {
      counters.add('protocolErrors')
      this.#lost(error)
    } else if (this.#ended) return
    else if (isProbe) this.#goOn(error)
    else {
      const locked = error === undefined ? undefined : this.#opening.lockedBy(error, this.peer)
      if (locked === undefined) this.#owner.proved()
      else this.#lost(locked)
    }
  }

  #timedOut(job: Call, sent: boolean): void {
    const isProbe = this.#opening.owns(job)
    if (sent && !job.exchange.answered) {
      takeAsDone(job)
      // The PLC has forgotten this connection: a request on it would be lost, and of a write nobody would know.
      this.#lost(failure.reset(this.peer))
      return
    }
    if (!isProbe) this.#owner.counters.add('timeouts')
    const causes = this.#causes()
    if (!sent) {
      const error = failure.notSentInTime(job.exchange.title)
      job.fail(error)
      // The attempt ends with its first request: nothing else is due on a line that nobody may use yet.
      if (isProbe) this.#lost(failure.silent(this.peer, causes, error, this.#askedAlone()))
      return
    }
    this.#silence(job, causes, failure.noAnswer(job.exchange.title, this.peer, causes))
  }

  /** It waited so long that an answer would not come in time: the connection is as good as before. */
  #tooLate(job: Call, { waiting, roundTrip }: TooLate): void {
    if (!this.#opening.owns(job)) this.#owner.counters.add('overloaded')
    job.fail(failure.overloaded(job.exchange.title, waiting, roundTrip))
  }

  /** What must come back before a request on a fixed port did not: the request was not sent. */
  #unproved(job: Call): void {
    if (!this.#opening.owns(job)) this.#owner.counters.add('timeouts')
    const causes = [failure.NO_SELF_TEST, ...this.#causes()]
    this.#silence(job, causes, failure.unproved(job.exchange.title, this.peer, causes))
  }

  #silence(job: Call, causes: readonly string[], error: PlcError): void {
    // Without an answer of any kind there is nothing to lose; the probe is such a case.
    const unproved = this.#opening.owns(job) || !this.#receivedAnything
    job.fail(error)
    this.#silent += 1
    // Without bytes for a while nothing tells a dead cable from a slow PLC, so the connection is made anew.
    if (unproved || this.#silent >= SILENT_REQUESTS)
      this.#lost(failure.silent(this.peer, causes, error, this.#askedAlone()))
  }
}

/** A command that is not answered when it succeeds (Remote Reset): silence and a lost connection are its success. */
export function takeAsDone(call: Call): void {
  call.answer({ head: {}, serial: undefined, endCode: 0, body: Buffer.alloc(0) })
}
