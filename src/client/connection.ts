// One connection to one PLC, in the background: joins the pure parts (supervisor, session) with a transport and the
// clock, and gives promises. It knows no protocol family; Exchange and Framing bring that.
import {
  ClosedError,
  type ConnectionError,
  EndCodeError,
  endsConnection,
  type PlcError,
  ProtocolError,
} from '../errors'
import { type Exchange, type ResponseFrame, SerialNumbers, Session, type SessionEvent } from '../link/link'
import type { Clock } from '../transport/clock'
import type { Transport } from '../transport/transport'
import { Alarm } from './alarm'
import { Call, type CallOptions, optionProblem, type Settle } from './call'
import type { ConnectionOptions, ConnectionState, TracedFrame } from './connection-options'
import * as failure from './failure'
import { Signals } from './signals'
import { Counters, type Statistics } from './statistics'
import { Supervisor } from './supervisor'
import { tell } from './tell'

export type { ConnectionOptions, ConnectionState, Silence, TracedFrame } from './connection-options'

/** Requests without any answer in a row after which the connection counts as dead, although nobody closed it. */
const SILENT_REQUESTS = 2

export class Connection<Head> {
  readonly #options: ConnectionOptions<Head>
  readonly #clock: Clock
  readonly #supervisor: Supervisor
  readonly #counters = new Counters()
  readonly #serials: SerialNumbers
  readonly #alarm: Alarm
  readonly #signals = new Signals()
  /** Calls that wait for the connection. */
  #held: Call<Head>[] = []
  #transport: Transport | undefined
  #session: Session<Head, Call<Head>> | undefined
  #probe: Call<Head> | undefined
  #attemptDeadline: number | undefined
  #answeredBefore = false
  #silent = 0
  #receivedInAttempt = false
  #since: number
  #generation = 0
  /** Set by the owner to see every frame; costs nothing while unset. */
  onTrace: ((frame: TracedFrame) => void) | undefined

  constructor(options: ConnectionOptions<Head>) {
    this.#options = options
    this.#clock = options.clock
    this.#supervisor = new Supervisor(options.supervisor)
    this.#serials = new SerialNumbers(Math.floor(options.supervisor.random() * 0x10000))
    this.#alarm = new Alarm(options.clock, () => this.#guard(() => this.#timeout()))
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

  /** Counts the connections that worked: what the PLC remembers per connection is gone when this changes. */
  get generation(): number {
    return this.#generation
  }

  get statistics(): Statistics {
    return this.#counters.read(this.#held.length + (this.#session?.queued ?? 0), this.#session?.inFlight ?? 0)
  }

  /** Sends a request when its turn comes and resolves with its answer. Every rejection is a `PlcError`. */
  request<T>(exchange: Exchange<Head, T>, options: CallOptions = {}): Promise<T> {
    return new Promise<T>((resolve, fail) => {
      const answer = (frame: ResponseFrame<Head> | undefined) => {
        if (frame !== undefined) resolve(exchange.decode(frame))
      }
      this.#submit(exchange, { answer, fail }, options, this.#options.timeout, true)
    })
  }

  /** Resolves when the PLC has answered on this connection; keeps the connection up from now on. */
  connect(options: CallOptions = {}): Promise<void> {
    if (this.#supervisor.name === 'connected') return Promise.resolve()
    const exchange = { ...this.#options.probe(), title: 'Connecting' }
    // Longer than an attempt can take, so that it ends with the attempt's own reason.
    const { connectTimeout, supervisor } = this.#options
    const timeout = 2 * connectTimeout + supervisor.settleGap + 1
    // It only waits: what proves the connection is the attempt's own probe.
    return new Promise<void>((resolve, fail) => {
      this.#submit(exchange, { answer: () => resolve(), fail }, options, timeout, false)
    })
  }

  #submit(
    exchange: Exchange<Head, unknown>,
    settle: Settle<Head>,
    options: CallOptions,
    usual: number,
    sends: boolean,
  ): void {
    const refusal = optionProblem(options) ?? this.#refusalOf(exchange, options.signal)
    if (refusal !== undefined) {
      settle.fail(refusal)
      return
    }
    const { timeout = usual, signal } = options
    const now = this.#clock.now()
    const call = new Call(exchange, now + timeout, settle, sends)
    if (sends) this.#counters.add('requests')
    if (signal !== undefined) {
      call.abortedBy(
        signal,
        this.#signals.watch(signal, () => this.#guard(() => this.#abort(call))),
      )
    }
    this.#guard(() => this.#start(call, now))
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
    const held = this.#held
    this.#held = []
    this.#dropTransport()
    this.#alarm.cancel()
    session?.disconnected()
    if (session !== undefined) this.#closeCalls(session)
    for (const call of held) call.fail(failure.closedMeanwhile(call, 'notSent'))
    this.#tellState()
  }

  #closeCalls(session: Session<Head, Call<Head>>): void {
    for (let event = session.poll(); event !== undefined; event = session.poll()) {
      if (event.kind !== 'done') continue
      const { job, outcome } = event
      // An answer that arrived just before is one all the same.
      if (outcome.kind === 'answered') job.answer(outcome.frame)
      else job.fail(failure.closedMeanwhile(job, outcome.kind === 'failed' || outcome.sent ? 'unknown' : 'notSent'))
    }
  }

  #abort(call: Call<Head>): void {
    const held = this.#held.indexOf(call)
    if (held >= 0) this.#held.splice(held, 1)
    // A call that nobody knows any more has just been settled in the session: only "unknown" is certain to be true.
    const sent = held < 0 && (this.#session?.abandon(call, this.#clock.now()) ?? true)
    if (call.sends) this.#counters.add('aborted')
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
      this.#lost(failure.asPlcError(error))
      return
    }
    this.#transport = transport
    this.#tellState()
    // A transport that was given up may still have a callback under way: only the present one is listened to.
    const present = (run: () => void) => {
      if (this.#transport === transport) this.#guard(run)
    }
    present(() =>
      transport.open({
        opened: () => present(() => this.#opened(transport)),
        received: (bytes) => present(() => this.#received(bytes)),
        closed: (error) => present(() => this.#disconnected(error)),
      }),
    )
    this.#schedule()
  }

  /** Anything that is thrown here is a bug of this package; the machine beside us must not lose its program to it. */
  #guard(run: () => void): void {
    try {
      run()
    } catch (error) {
      this.#lost(failure.asPlcError(error))
    }
  }

  #opened(transport: Transport): void {
    const now = this.#clock.now()
    const { framing, inFlight, timeout, connectTimeout } = this.#options
    this.#session = new Session<Head, Call<Head>>(framing, {
      kind: transport.kind,
      window: inFlight,
      serials: this.#serials,
    })
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
    this.#trace('received', bytes)
    this.#session?.receive(bytes, this.#clock.now())
    this.#flush()
  }

  #disconnected(error: ConnectionError | undefined): void {
    this.#lost(error ?? failure.closedByPeer(this.#peer(), this.#receivedInAttempt))
  }

  #verified(): void {
    this.#probe = undefined
    this.#answeredBefore = true
    this.#generation += 1
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

  #lost(error: PlcError): void {
    if (this.#supervisor.name === 'closed') return
    const session = this.#session
    const probe = this.#probe
    const rest = session === undefined ? 0 : this.#restOfPort()
    this.#dropTransport()
    this.#supervisor.lost(error, this.#clock.now(), rest)
    if (session !== undefined) {
      this.#counters.add('disconnects')
      session.disconnected()
      this.#settleLost(session, probe, error)
    }
    if (!this.#supervisor.hopeful) {
      const held = this.#held
      this.#held = []
      for (const call of held) call.fail(call.sends ? failure.offline(call.exchange.title, error) : error)
    }
    this.#tellState()
    this.#schedule()
  }

  /**
   * How long the local port must be left alone: where it is fixed a late answer still arrives on it, and without a
   * serial number it would be taken for the next one.
   */
  #restOfPort(): number {
    const { framing, timeout } = this.#options
    if (this.#transport?.kind !== 'datagram' || framing.correlation === 'serial') return 0
    try {
      return this.#transport.renew() ? 0 : timeout
    } catch {
      // Closed by the system, because nothing receives on the PLC's port: then nothing answers from there either.
      return 0
    }
  }

  #settleLost(session: Session<Head, Call<Head>>, probe: Call<Head> | undefined, reason: PlcError): void {
    for (let event = session.poll(); event !== undefined; event = session.poll()) {
      if (event.kind === 'drop' || event.kind === 'renew') continue
      if (event.kind !== 'done' || event.outcome.kind !== 'disconnected') {
        this.#take(event)
        continue
      }
      const { job, outcome } = event
      if (job === probe) continue
      if (outcome.sent) this.#settleUnknown(job, reason)
      else if (this.#supervisor.hopeful) this.#held.push(job)
      else job.fail(failure.offline(job.exchange.title, reason))
    }
  }

  #settleUnknown(call: Call<Head>, reason: PlcError): void {
    if (!call.exchange.answered && failure.isSuccessOfReset(reason)) this.#takeAsDone(call)
    else call.fail(failure.lostInFlight(call.exchange.title, reason))
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
    this.#trace('sent', bytes)
    try {
      this.#transport?.send(bytes)
    } catch (error) {
      this.#lost(failure.asPlcError(error))
    }
  }

  #trace(direction: TracedFrame['direction'], bytes: Buffer): void {
    if (this.onTrace !== undefined) tell(this.onTrace, { time: this.#clock.time(), direction, bytes })
  }

  #take(event: SessionEvent<Head, Call<Head>>): void {
    switch (event.kind) {
      case 'done':
        this.#settle(event)
        return
      case 'unsolicited':
        tell(this.#options.onUnsolicited, event.frame)
        return
      case 'stale':
        // Too late for its request, but the PLC is alive.
        this.#silent = 0
        this.#counters.add('stale')
        return
      case 'renew':
        this.#renew(event.reason)
        return
      case 'drop':
        if (event.error instanceof ProtocolError) this.#counters.add('protocolErrors')
        this.#lost(event.error)
        return
      default:
        event satisfies never
    }
  }

  /** Where the local port is fixed a late answer can still arrive, so after a timeout it must rest: see #restOfPort. */
  #renew(reason: 'answered' | 'givenUp'): void {
    if (this.#transport?.renew() === true || reason === 'answered') return
    this.#lost(failure.quarantine(this.#peer()))
  }

  #settle({ job, outcome, sentAt }: Extract<SessionEvent<Head, Call<Head>>, { kind: 'done' }>): void {
    if (outcome.kind === 'answered') this.#answered(job, outcome.frame, sentAt)
    else if (outcome.kind === 'timedOut') this.#timedOut(job, outcome.sent)
    // `disconnected` is met by #settleLost and #closeCalls only.
    else if (outcome.kind === 'failed') job.fail(outcome.error)
  }

  #answered(job: Call<Head>, frame: ResponseFrame<Head>, sentAt: number | undefined): void {
    const isProbe = job === this.#probe
    this.#silent = 0
    const error = job.answer(frame)
    if (!isProbe) {
      this.#counters.add('answered')
      if (error instanceof EndCodeError) this.#counters.add('refused')
      if (sentAt !== undefined) this.#counters.roundTrip(this.#clock.now() - sentAt)
    }
    if (error !== undefined && endsConnection(error, this.#options.framing.correlation)) {
      this.#counters.add('protocolErrors')
      this.#lost(error)
    } else if (isProbe) this.#verified()
    else this.#supervisor.proved()
  }

  #timedOut(job: Call<Head>, sent: boolean): void {
    const isProbe = job === this.#probe
    if (sent && !job.exchange.answered) {
      this.#takeAsDone(job)
      // The PLC has forgotten this connection: a request on it would be lost, and of a write nobody would know.
      this.#lost(failure.reset(this.#peer()))
      return
    }
    if (!isProbe) this.#counters.add('timeouts')
    if (!sent) {
      job.fail(failure.notSentInTime(job.exchange.title))
      return
    }
    const causes = this.#causes()
    const error = failure.noAnswer(job.exchange.title, this.#peer(), causes)
    job.fail(error)
    this.#silent += 1
    // Without bytes for a while nothing tells a dead cable from a slow PLC, so the connection is made anew.
    if (isProbe || this.#silent >= SILENT_REQUESTS) this.#lost(failure.silent(this.#peer(), causes, error))
  }

  /** A call that waited for the connection in vain. */
  #notConnected(call: Call<Head>): void {
    if (call.sends) this.#counters.add('timeouts')
    const open = this.#session !== undefined
    const attempt = { peer: this.#peer(), open, causes: open ? this.#causes() : [], reason: this.#supervisor.error }
    call.fail(failure.notConnectedInTime(call.sends ? call.exchange.title : undefined, attempt))
  }

  #peer(): string {
    return this.#transport?.description ?? 'the PLC'
  }

  #causes(): readonly string[] {
    return this.#options.explainSilence({ peer: this.#peer(), answeredBefore: this.#answeredBefore })
  }

  #tellState(): void {
    this.#since = this.#clock.time()
    tell(this.#options.onState, this.state)
  }

  #schedule(): void {
    if (this.#supervisor.name !== 'closed') this.#alarm.set(this.#nextTimeout())
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
      this.#notConnected(call)
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
