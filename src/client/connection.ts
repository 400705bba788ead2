// One connection to one PLC, in the background: joins the pure parts (supervisor, session) with a transport and the
// clock, and gives promises. It knows no protocol family; Exchange and Framing bring that.
import { ClosedError, type ConnectionError, EndCodeError, endsConnection, PlcError } from '../errors'
import {
  type Exchange,
  type Framing,
  type RequestFrame,
  type ResponseFrame,
  Session,
  type SessionEvent,
} from '../link/link'
import type { Clock } from '../transport/clock'
import type { OpenTransport, Transport } from '../transport/transport'
import { Call, type CallOptions } from './call'
import * as failure from './failure'
import { Counters, type Statistics } from './statistics'
import { type ConnectionStateName, Supervisor, type SupervisorOptions } from './supervisor'

/** A frame as it went over the wire. */
export interface TracedFrame {
  /** Milliseconds since 1970. */
  readonly time: number
  readonly direction: 'sent' | 'received'
  readonly bytes: Buffer
}

/** The state of a connection, for people and programs. */
export interface ConnectionState {
  readonly name: ConnectionStateName
  /** Milliseconds since 1970. */
  readonly since: number
  /** Attempts since the last connection that worked. */
  readonly attempt: number
  /** Why there is no connection. */
  readonly error?: PlcError
  /** Milliseconds since 1970: when the next attempt starts. */
  readonly nextAttempt?: number
}

/** What is known about a silence, for whoever explains it. */
export interface Silence {
  /** What was tried, e.g. `tcp 192.168.3.39:5007`. */
  readonly peer: string
  /** Whether this PLC ever answered this client. */
  readonly answeredBefore: boolean
}

export interface ConnectionOptions<Head> {
  readonly framing: Framing<Head>
  readonly openTransport: OpenTransport
  readonly clock: Clock
  readonly supervisor: SupervisorOptions
  readonly inFlight: number
  readonly queueLimit: number
  /** ms */
  readonly connectTimeout: number
  /** Default deadline of a call, ms. */
  readonly timeout: number
  /** The first request on a new connection. Any answer to it, also a refusal, proves that the PLC is there. */
  readonly probe: () => Exchange<Head, unknown>
  /** Ranked causes, most likely first. */
  readonly explainSilence: (silence: Silence) => readonly string[]
  readonly onState: (state: ConnectionState) => void
  readonly onUnsolicited: (frame: RequestFrame<Head>) => void
}

/** Requests without any answer in a row after which the connection counts as dead, although nobody closed it. */
const SILENT_REQUESTS = 2

export class Connection<Head> {
  readonly #options: ConnectionOptions<Head>
  readonly #clock: Clock
  readonly #supervisor: Supervisor
  readonly #counters = new Counters()
  /** Calls that wait for the connection. */
  #held: Call<Head>[] = []
  #transport: Transport | undefined
  #session: Session<Head, Call<Head>> | undefined
  #probe: Call<Head> | undefined
  #cancelTimer: (() => void) | undefined
  #timerAt = Number.POSITIVE_INFINITY
  #attemptDeadline: number | undefined
  #answeredBefore = false
  #silent = 0
  #receivedInAttempt = false
  #since: number
  /** Set by the owner to see every frame; costs nothing while unset. */
  onTrace: ((frame: TracedFrame) => void) | undefined

  constructor(options: ConnectionOptions<Head>) {
    this.#options = options
    this.#clock = options.clock
    this.#supervisor = new Supervisor(options.supervisor)
    this.#since = options.clock.time()
  }

  get state(): ConnectionState {
    const { name, attempt, error, nextAttempt } = this.#supervisor
    return {
      name,
      since: this.#since,
      attempt,
      ...(error === undefined ? {} : { error }),
      ...(nextAttempt === undefined ? {} : { nextAttempt: this.#clock.time() + nextAttempt - this.#clock.now() }),
    }
  }

  get statistics(): Statistics {
    return this.#counters.read(this.#held.length + (this.#session?.queued ?? 0), this.#session?.inFlight ?? 0)
  }

  /** Sends a request when its turn comes and resolves with its answer. Every rejection is a `PlcError`. */
  request<T>(exchange: Exchange<Head, T>, options: CallOptions = {}): Promise<T> {
    return new Promise<T>((resolve, reject) => {
      const answer = (frame: ResponseFrame<Head> | undefined) => {
        if (frame !== undefined) resolve(exchange.decode(frame))
      }
      this.#submit(new Call(exchange, this.#deadline(options), { answer, fail: reject }), options.signal)
    })
  }

  /** Resolves when the PLC has answered on this connection; keeps the connection up from now on. */
  connect(options: CallOptions = {}): Promise<void> {
    if (this.#supervisor.name === 'connected') return Promise.resolve()
    const exchange = { ...this.#options.probe(), title: 'Connecting' }
    return new Promise<void>((resolve, reject) => {
      // It only waits: what proves the connection is the attempt's own probe.
      this.#submit(
        new Call(exchange, this.#deadline(options), { answer: () => resolve(), fail: reject }, false),
        options.signal,
      )
    })
  }

  #deadline(options: CallOptions): number {
    return this.#clock.now() + (options.timeout ?? this.#options.timeout)
  }

  #submit(call: Call<Head>, signal: AbortSignal | undefined): void {
    const refusal = this.#refusalOf(call.exchange, signal)
    if (refusal !== undefined) {
      call.fail(refusal)
      return
    }
    if (call.sends) this.#counters.add('requests')
    if (signal !== undefined) call.watch(signal, () => this.#abort(call))
    this.#start(call, this.#clock.now())
  }

  #refusalOf({ title }: Exchange<Head, unknown>, signal: AbortSignal | undefined): PlcError | undefined {
    const { name, hopeful, error } = this.#supervisor
    if (name === 'closed') return failure.closedBeforeSending(title)
    if (signal?.aborted === true) {
      return new ClosedError('ABORTED', `${title} was aborted before it was sent.`, 'notSent', signal.reason)
    }
    if (name !== 'connected' && !hopeful) return failure.offline(title, error)
    const waiting = this.#held.length + (this.#session?.queued ?? 0)
    return waiting < this.#options.queueLimit ? undefined : failure.queueFull(title, waiting)
  }

  #start(call: Call<Head>, now: number): void {
    if (this.#supervisor.name === 'connected' && this.#session !== undefined) {
      this.#session.submit(call, now)
      this.#flush()
      return
    }
    this.#held.push(call)
    if (this.#supervisor.want()) this.#open()
    this.#schedule()
  }

  /** Ends everything. Calls in flight are settled with `CLOSED`. */
  close(): void {
    if (this.#supervisor.name === 'closed') return
    this.#supervisor.close()
    const session = this.#session
    const calls = this.#held
    this.#held = []
    this.#dropTransport()
    session?.disconnected()
    if (session !== undefined) this.#closeCalls(session)
    for (const call of calls) this.#closed(call, 'notSent')
    this.#cancelTimer?.()
    this.#cancelTimer = undefined
    this.#tellState()
  }

  #closeCalls(session: Session<Head, Call<Head>>): void {
    for (let event = session.poll(); event !== undefined; event = session.poll()) {
      if (event.kind !== 'done') continue
      const sent = event.outcome.kind === 'disconnected' && event.outcome.sent
      this.#closed(event.job, sent ? 'unknown' : 'notSent')
    }
  }

  #closed(call: Call<Head>, outcome: 'notSent' | 'unknown'): void {
    call.fail(failure.closedMeanwhile(call.exchange.title, outcome))
  }

  #abort(call: Call<Head>): void {
    const held = this.#held.indexOf(call)
    let sent = false
    if (held >= 0) this.#held.splice(held, 1)
    else sent = this.#session?.abandon(call, this.#clock.now()) ?? false
    this.#counters.add('aborted')
    call.fail(call.aborted(sent ? 'unknown' : 'notSent'))
    this.#flush()
  }

  // --- the connection

  #open(): void {
    const now = this.#clock.now()
    this.#attemptDeadline = now + this.#options.connectTimeout
    this.#receivedInAttempt = false
    this.#silent = 0
    this.#counters.add('connects')
    let transport: Transport
    try {
      transport = this.#options.openTransport()
    } catch (error) {
      this.#lost(asPlcError(error))
      return
    }
    this.#transport = transport
    this.#tellState()
    // A transport that was given up may still have a callback under way: only the present one is listened to.
    const present = () => this.#transport === transport
    transport.open({
      opened: () => present() && this.#opened(transport),
      received: (bytes) => present() && this.#received(bytes),
      closed: (error) => present() && this.#disconnected(error),
    })
  }

  #opened(transport: Transport): void {
    const now = this.#clock.now()
    const { framing, inFlight, timeout, connectTimeout } = this.#options
    this.#session = new Session<Head, Call<Head>>(framing, { kind: transport.kind, window: inFlight })
    const exchange = this.#options.probe()
    // Nobody awaits the probe; how it ends is seen in #answered and #timedOut.
    this.#probe = new Call(exchange, now + Math.min(timeout, connectTimeout), {
      answer: (frame) => {
        if (frame !== undefined) exchange.decode(frame)
      },
      fail: () => {},
    })
    this.#attemptDeadline = undefined
    this.#session.submit(this.#probe, now)
    this.#flush()
  }

  #received(bytes: Buffer): void {
    this.#receivedInAttempt = true
    this.#counters.add('bytesReceived', bytes.length)
    this.onTrace?.({ time: this.#clock.time(), direction: 'received', bytes })
    try {
      this.#session?.receive(bytes, this.#clock.now())
    } catch (error) {
      // Anything but a ProtocolError here is a bug of this package; the machine beside us must not lose its program to it.
      this.#lost(asPlcError(error))
    }
    this.#flush()
  }

  #disconnected(error: ConnectionError | undefined): void {
    this.#counters.add('disconnects')
    this.#lost(error ?? failure.closedByPeer(this.#peer(), this.#receivedInAttempt))
  }

  #verified(): void {
    this.#probe = undefined
    this.#answeredBefore = true
    this.#supervisor.connected(this.#clock.now())
    this.#tellState()
    const held = this.#held
    this.#held = []
    for (const call of held) {
      if (call.sends) this.#session?.submit(call, this.#clock.now())
      else call.answer(undefined)
    }
  }

  #dropTransport(): void {
    this.#transport?.close()
    this.#transport = undefined
    this.#session = undefined
    this.#probe = undefined
    this.#attemptDeadline = undefined
  }

  #lost(error: PlcError, pauseAtLeast = 0): void {
    const session = this.#session
    this.#dropTransport()
    this.#supervisor.lost(error, this.#clock.now(), pauseAtLeast)
    session?.disconnected()
    if (session !== undefined) this.#settleLost(session, error)
    if (!this.#supervisor.hopeful) {
      const held = this.#held
      this.#held = []
      for (const call of held) call.fail(call.sends ? failure.offline(call.exchange.title, error) : error)
    }
    this.#tellState()
    this.#schedule()
  }

  #settleLost(session: Session<Head, Call<Head>>, reason: PlcError): void {
    for (let event = session.poll(); event !== undefined; event = session.poll()) {
      if (event.kind !== 'done') continue
      const { job, outcome } = event
      if (outcome.kind !== 'disconnected') this.#settle(event)
      else if (outcome.sent) this.#settleUnknown(job, reason)
      else if (this.#supervisor.hopeful) this.#held.push(job)
      else job.fail(failure.offline(job.exchange.title, reason))
    }
  }

  #settleUnknown(call: Call<Head>, reason: PlcError): void {
    if (call.exchange.answered) call.fail(failure.lostInFlight(call.exchange.title, reason))
    else this.#takeAsDone(call)
  }

  /** A command that is not answered when it succeeds (Remote Reset): silence and a lost connection are its success. */
  #takeAsDone(call: Call<Head>): void {
    call.answer({ head: call.head, serial: undefined, endCode: 0, body: Buffer.alloc(0) })
  }

  // --- events and time

  /** Takes what the session has to say, then what it has to send, until it is quiet. */
  #flush(): void {
    const session = this.#session
    if (session === undefined) return
    for (let event = session.poll(); event !== undefined; event = session.poll()) {
      this.#take(event)
      if (this.#session !== session) return
    }
    for (let bytes = session.transmit(); bytes !== undefined; bytes = session.transmit()) {
      this.#send(bytes)
      if (this.#session !== session) return
    }
    this.#schedule()
  }

  #send(bytes: Buffer): void {
    this.#counters.add('bytesSent', bytes.length)
    this.onTrace?.({ time: this.#clock.time(), direction: 'sent', bytes })
    try {
      this.#transport?.send(bytes)
    } catch (error) {
      this.#lost(asPlcError(error))
    }
  }

  #take(event: SessionEvent<Head, Call<Head>>): void {
    switch (event.kind) {
      case 'done':
        this.#settle(event)
        return
      case 'unsolicited':
        this.#options.onUnsolicited(event.frame)
        return
      case 'stale':
        this.#counters.add('stale')
        return
      case 'renew':
        this.#renew(event.reason)
        return
      case 'drop':
        this.#counters.add('disconnects')
        this.#lost(event.error)
        return
      default:
        event satisfies never
    }
  }

  /** Where the local port is fixed a late answer can still arrive, so after a timeout the port is left alone for a while. */
  #renew(reason: 'answered' | 'givenUp'): void {
    if (this.#transport?.renew() === true || reason === 'answered') return
    this.#lost(failure.quarantine(this.#peer()), this.#options.timeout)
  }

  #settle({ job, outcome, sentAt }: Extract<SessionEvent<Head, Call<Head>>, { kind: 'done' }>): void {
    switch (outcome.kind) {
      case 'answered':
        this.#answered(job, outcome.frame, sentAt)
        return
      case 'timedOut':
        this.#timedOut(job, outcome.sent)
        return
      case 'failed':
        this.#counters.add('protocolErrors')
        job.fail(outcome.error)
        return
      case 'disconnected':
        // Only `disconnected()` gives this outcome, and #settleLost and #closeCalls take it there.
        return
      default:
        outcome satisfies never
    }
  }

  #answered(job: Call<Head>, frame: ResponseFrame<Head>, sentAt: number | undefined): void {
    this.#silent = 0
    this.#counters.add('answered')
    if (sentAt !== undefined) this.#counters.roundTrip(this.#clock.now() - sentAt)
    const error = job.answer(frame)
    if (error instanceof EndCodeError) this.#counters.add('refused')
    else if (error instanceof PlcError && endsConnection(error, this.#options.framing.correlation)) {
      this.#counters.add('protocolErrors')
      this.#lost(error)
      return
    }
    if (job === this.#probe) this.#verified()
  }

  #timedOut(job: Call<Head>, sent: boolean): void {
    if (sent && !job.exchange.answered) {
      this.#takeAsDone(job)
      return
    }
    this.#counters.add('timeouts')
    if (!sent) {
      job.fail(failure.notSentInTime(job.exchange.title))
      return
    }
    const causes = this.#causes()
    const error = failure.noAnswer(job.exchange.title, this.#peer(), causes)
    job.fail(error)
    this.#silent += 1
    // Without bytes for a while nothing tells a dead cable from a slow PLC, so the connection is made anew.
    if (job !== this.#probe && this.#silent < SILENT_REQUESTS) return
    this.#lost(failure.silent(this.#peer(), causes, error))
  }

  #peer(): string {
    return this.#transport?.description ?? 'the PLC'
  }

  #causes(): readonly string[] {
    return this.#options.explainSilence({ peer: this.#peer(), answeredBefore: this.#answeredBefore })
  }

  #tellState(): void {
    this.#since = this.#clock.time()
    this.#options.onState(this.state)
  }

  /**
   * Sets the one timer to the next thing that is due. A timer that would fire earlier than needed is left alone, so
   * that steady traffic does not set a timer per request.
   */
  #schedule(): void {
    const due = this.#nextTimeout()
    if (due === undefined || due >= this.#timerAt) return
    this.#cancelTimer?.()
    this.#timerAt = due
    this.#cancelTimer = this.#clock.timer(Math.max(0, due - this.#clock.now()), () => {
      this.#timerAt = Number.POSITIVE_INFINITY
      this.#cancelTimer = undefined
      this.#timeout()
    })
  }

  #nextTimeout(): number | undefined {
    let due = this.#session?.nextTimeout()
    const earlier = (time: number | undefined) => {
      if (time !== undefined && (due === undefined || time < due)) due = time
    }
    earlier(this.#supervisor.nextAttempt)
    earlier(this.#attemptDeadline)
    for (const call of this.#held) earlier(call.deadline)
    return due
  }

  #timeout(): void {
    const now = this.#clock.now()
    for (const call of this.#held.filter((held) => held.deadline <= now)) {
      this.#held.splice(this.#held.indexOf(call), 1)
      this.#timedOut(call, false)
    }
    if (this.#attemptDeadline !== undefined && this.#attemptDeadline <= now) {
      this.#lost(failure.connectTimedOut(this.#peer(), this.#options.connectTimeout))
    }
    if (this.#supervisor.timeout(now)) this.#open()
    this.#session?.timeout(now)
    this.#flush()
    this.#schedule()
  }
}

function asPlcError(error: unknown): PlcError {
  return error instanceof PlcError ? error : failure.unexpected(error)
}
