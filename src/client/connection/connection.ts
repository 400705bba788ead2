// The connection to one PLC, in the background: joins the supervisor with one attempt after the other, and gives promises.
// It knows no protocol family; Exchange brings that. What carries the bytes is the line, which PLCs may share.
import type { ConnectionError, PlcError } from '../../errors'
import { type Exchange, type ResponseFrame, RoundTrips } from '../../link/link'
import type { Clock } from '../../transport/clock'
import { Alarm } from './alarm'
import { Attempt, type AttemptOwner, takeAsDone } from './attempt'
import { type BoundOptions, Call, type CallOptions, isChange, optionProblem, type Settle } from './call'
import type { ConnectionOptions, ConnectionState, TracedFrame } from './connection-options'
import * as failure from './failure'
import type { Line } from './line'
import { Probing } from './probing'
import { Signals } from './signals'
import { Counters, type Statistics } from './statistics'
import { Supervisor } from './supervisor'
import { tellListener } from './tell-listener'

export type { ConnectionOptions, ConnectionState, Silence, TracedFrame } from './connection-options'

export class Connection {
  readonly #options: ConnectionOptions
  readonly #clock: Clock
  readonly #supervisor: Supervisor
  readonly #counters = new Counters()
  readonly #alarm: Alarm
  readonly #signals = new Signals()
  readonly #line: Line
  readonly #owner: AttemptOwner
  readonly #probing: Probing
  /** Calls that wait for the connection. */
  #held: Call[] = []
  #attempt: Attempt | undefined
  #answeredBefore = false
  #since: number
  #generation = 0
  #finishing: Promise<void> | undefined
  #endWaiting: (() => void) | undefined
  /** Set by the owner to see every frame; costs nothing while unset. */
  onTrace: ((frame: TracedFrame) => void) | undefined

  constructor(line: Line, options: ConnectionOptions) {
    this.#line = line
    this.#options = options
    this.#clock = options.clock
    this.#supervisor = new Supervisor(options.supervisor)
    this.#alarm = new Alarm(options.clock, () => this.#guard(() => this.#timeout()))
    this.#since = options.clock.time()
    const { explainSilence, probes } = options
    const probing = new Probing(probes)
    this.#probing = probing
    this.#owner = {
      counters: this.#counters,
      roundTrips: new RoundTrips(),
      verified: (answered) => this.#verified(answered),
      proved: () => {
        this.#answeredBefore = true
        this.#supervisor.proved()
      },
      lost: (error) => this.#lost(error),
      trace: (direction, bytes) => {
        if (this.onTrace !== undefined) tellListener(this.onTrace, { time: this.#clock.time(), direction, bytes })
      },
      causes: (silence) => explainSilence({ ...silence, answeredBefore: this.#answeredBefore }),
      get unanswered() {
        return probing.unanswered
      },
    }
  }

  get state(): ConnectionState {
    const { phase, attempt } = this.#supervisor
    const known = { since: this.#since, attempt }
    if (phase.nextAttempt === undefined) return { ...phase, ...known }
    return { ...phase, ...known, nextAttempt: this.#clock.time() + phase.nextAttempt - this.#clock.now() }
  }

  /** Counts the connections that worked: what the PLC remembers per connection is gone when this changes. */
  get generation(): number {
    return this.#generation
  }

  get statistics(): Statistics {
    return this.#counters.read(this.#waiting(), this.#attempt?.inFlight ?? 0)
  }

  /** Sends a request when its turn comes and resolves with its answer. Every rejection is a `PlcError`. */
  request<T>(exchange: Exchange<T>, options: BoundOptions = {}): Promise<T> {
    return this.#ask(exchange, options, (answer) => answer)
  }

  /** As `request`, for how long it took: ms from sending to the answer, without connecting and waiting. */
  roundTrip(exchange: Exchange<unknown>, options: CallOptions = {}): Promise<number> {
    return this.#ask(exchange, options, (_answer, roundTrip) => roundTrip)
  }

  #ask<T, R>(exchange: Exchange<T>, options: BoundOptions, result: (answer: T, roundTrip: number) => R): Promise<R> {
    return new Promise<R>((resolve, fail) => {
      const answer = (frame: ResponseFrame | undefined, roundTrip: number) => {
        if (frame !== undefined) resolve(result(exchange.decode(frame), roundTrip))
      }
      this.#submit(exchange, { answer, fail }, options, this.#options.timeout, true)
    })
  }

  /** Resolves when the PLC has answered on this connection; keeps the connection up from now on. */
  connect(options: CallOptions = {}): Promise<void> {
    const problem = optionProblem(options)
    if (problem !== undefined) return Promise.reject(problem)
    const { signal } = options
    if (signal?.aborted === true) return Promise.reject(failure.abortedBeforeSending(failure.CONNECTING, signal.reason))
    if (this.#supervisor.name === 'connected') return Promise.resolve()
    // Longer than an attempt can take with all its probes, so that it ends with the attempt's own reason.
    const { connectTimeout, supervisor, probes } = this.#options
    const timeout = Math.max(1, probes.length) * (2 * connectTimeout + supervisor.settleGap) + 1
    return new Promise<void>((resolve, fail) => {
      // What proves the connection is the attempt's own probe.
      this.#submit(CONNECTING, { answer: () => resolve(), fail }, options, timeout, false)
    })
  }

  #submit(exchange: Exchange<unknown>, settle: Settle, options: BoundOptions, usual: number, sends: boolean): void {
    const refusal = optionProblem(options) ?? this.#refusalOf(exchange, options.signal)
    if (refusal !== undefined) {
      settle.fail(refusal)
      return
    }
    const { signal, onlyOn, caller, priority } = options
    const now = this.#clock.now()
    const timeout = (options.timeout ?? usual) + this.#onTop(exchange, options)
    const call = new Call(exchange, now + timeout, settle, { sends, onlyOn, allowance: timeout, caller, priority })
    if (sends) this.#counters.counts.requests += 1
    if (signal !== undefined) {
      call.abortedBy(
        signal,
        this.#signals.watch(signal, () => this.#guard(() => this.#abort(call))),
      )
    }
    this.#guard(() => this.#start(call, now))
  }

  /** What a request takes on a slow line: nobody who leaves the timeout to us need know it. */
  #onTop(exchange: Exchange<unknown>, { timeout, growing }: BoundOptions): number {
    if (timeout !== undefined && growing === undefined) return 0
    const ms = this.#line.timeOf(exchange, this.#options.messageWait)
    if (ms > 0) growing?.grow(ms)
    return ms
  }

  #refusalOf(exchange: Exchange<unknown>, signal: AbortSignal | undefined): PlcError | undefined {
    const { title } = exchange
    const { name, hopeful, error } = this.#supervisor
    if (name === 'closed' || this.#finishing !== undefined) return failure.closedBeforeSending(title)
    if (signal?.aborted === true) return failure.abortedBeforeSending(title, signal.reason)
    if (name !== 'connected' && !hopeful) return this.#offline(title, error)
    return this.#hasRoom(exchange) ? undefined : failure.queueFull(title, this.#waiting())
  }

  /** Reads may fill the queue; what changes the PLC has as much room beside them. */
  #hasRoom(exchange: Exchange<unknown>): boolean {
    const { queueLimit } = this.#options
    if (this.#waiting() < queueLimit) return true
    if (!isChange(exchange)) return false
    const held = this.#held.filter(({ priority }) => priority === 'control').length
    return held + (this.#attempt?.queuedChanges ?? 0) < queueLimit
  }

  #offline(title: string, error: PlcError | undefined): ConnectionError {
    return this.#supervisor.givenUp ? failure.refusedToUnlock(title, error) : failure.offline(title, error)
  }

  /** Requests that wait for the connection or for their turn on it. */
  #waiting(): number {
    return this.#held.length + (this.#attempt?.queued ?? 0)
  }

  #start(call: Call, now: number): void {
    const expired = this.#expired()
    if (expired !== undefined) this.#lost(expired)
    if (call.onlyOn !== undefined && (this.#supervisor.name !== 'connected' || call.onlyOn !== this.#generation)) {
      call.fail(failure.otherConnection(call.exchange.title))
      return
    }
    if (this.#supervisor.name === 'connected' && this.#attempt !== undefined) {
      this.#attempt.submit(call, now)
      this.#attempt.flush(now)
      return
    }
    this.#held.push(call)
    if (this.#supervisor.want()) this.#open()
    this.#schedule()
  }

  #abort(call: Call): void {
    const held = this.#held.indexOf(call)
    if (held >= 0) this.#held.splice(held, 1)
    // A call that nobody knows any more has just been settled in the session: only "unknown" is certain to be true.
    const sent = held < 0 && (this.#attempt?.abandon(call) ?? true)
    if (call.sends) this.#counters.counts.aborted += 1
    call.fail(call.aborted(sent ? 'unknown' : 'notSent'))
    this.#attempt?.flush()
  }

  #expired(): PlcError | undefined {
    return this.#supervisor.name === 'connected' ? this.#attempt?.expired() : undefined
  }

  /** What the PLC refused for good has been corrected: attempts go on. */
  retry(): void {
    this.#attempt?.correct()
    if (this.#supervisor.retry()) this.#open()
  }

  /** Sends a last request if the PLC is there, takes nothing more, and ends everything. */
  finish(last: Exchange<unknown>, timeout: number): Promise<void> {
    if (this.#finishing !== undefined) return this.#finishing
    if (this.#supervisor.name !== 'connected' || this.#expired() !== undefined) {
      this.close()
      return Promise.resolve()
    }
    // It is a courtesy: whatever becomes of it, the connection ends now.
    const sent = this.request(last, { timeout }).catch(() => {})
    this.#finishing = sent.then(() => this.close())
    return this.#finishing
  }

  /** Ends everything. Calls in flight are settled with `CLOSED`. */
  close(): void {
    if (this.#supervisor.name === 'closed') return
    this.#supervisor.close()
    this.#endWaiting?.()
    this.#alarm.cancel()
    const attempt = this.#attempt
    const held = this.#held
    this.#attempt = undefined
    this.#held = []
    attempt?.end((call, sent) => call.fail(failure.closedMeanwhile(call, sent ? 'unknown' : 'notSent')))
    for (const call of held) call.fail(failure.closedMeanwhile(call, 'notSent'))
    this.#tellState()
  }

  /** Anything that is thrown here is a bug of this package; the machine beside us must not lose its program to it. */
  #guard(run: () => void): void {
    try {
      run()
    } catch (error) {
      this.#lost(failure.asPlcError(error))
    }
  }

  #open(): void {
    this.#endWaiting?.()
    this.#counters.counts.connects += 1
    const attempt = new Attempt(this.#options, this.#line, this.#owner, this.#probing.next)
    this.#attempt = attempt
    this.#tellState()
    this.#guard(() => {
      // A listener may have closed the connection meanwhile.
      if (this.#attempt === attempt) attempt.open()
    })
    this.#schedule()
  }

  #verified(answered: boolean): void {
    if (answered) this.#answeredBefore = true
    this.#probing.answered()
    this.#generation += 1
    this.#supervisor.connected(this.#clock.now())
    // Before anybody is told: what a listener writes now must not go ahead of what waited, and it may close the connection.
    const held = this.#held
    this.#held = []
    for (const call of held) {
      if (call.sends) this.#attempt?.submit(call)
      else call.answer(undefined)
    }
    this.#tellState()
  }

  #lost(error: PlcError): void {
    if (this.#supervisor.name === 'closed') return
    const attempt = this.#attempt
    this.#attempt = undefined
    const probe = attempt?.probing
    const absentFor = attempt?.absentFor
    const pause = attempt?.isFinal(error) === true ? Number.POSITIVE_INFINITY : absentFor
    const isUnanswered = probe !== undefined && this.#probing.lost(error)
    if (attempt !== undefined && isUnanswered && (absentFor === undefined || this.#isNew)) {
      const next = this.#probing.next?.probe.name ?? ''
      this.#supervisor.again(failure.probeUnanswered(attempt.peer, probe, next, error), this.#clock.now())
    } else this.#supervisor.lost(error, this.#clock.now(), pause, absentFor !== undefined)
    if (attempt?.isOpen === true) this.#counters.counts.disconnects += 1
    attempt?.end((call, sent) => this.#handedBack(call, sent, error))
    if (attempt?.isLineLost === true) this.#waitForLine()
    if (!this.#supervisor.hopeful) {
      const held = this.#held
      this.#held = []
      for (const call of held) call.fail(call.sends ? this.#offline(call.exchange.title, error) : error)
    }
    this.#tellState()
    this.#schedule()
  }

  /** Whoever shares the line may open it before the next attempt. */
  #waitForLine(): void {
    this.#endWaiting?.()
    this.#endWaiting = this.#line.whenOpen(() =>
      this.#guard(() => {
        if (this.#supervisor.hurry()) this.#open()
      }),
    )
  }

  /**
   * Whether it was never reached, at the first attempt. Where silence costs others their time, only then the next probe is
   * tried at once: later each attempt asks the next one.
   */
  get #isNew(): boolean {
    return !this.#answeredBefore && this.#supervisor.attempt <= 1
  }

  /** A call on a connection that is gone. What was sent is never sent again; the rest may wait for the next one. */
  #handedBack(call: Call, sent: boolean, reason: PlcError): void {
    // It was aborted by somebody who was told of something else meanwhile.
    if (call.isSettled) return
    const { title, answered } = call.exchange
    if (sent && !answered && failure.isGone(reason)) takeAsDone(call)
    else if (sent) call.fail(failure.lostInFlight(title, reason))
    else if (call.onlyOn !== undefined) call.fail(failure.otherConnection(title, reason))
    else if (this.#supervisor.hopeful) this.#held.push(call)
    else call.fail(failure.offline(title, reason))
  }

  /** A call that waited for the connection in vain. */
  #notConnected(call: Call): void {
    if (call.sends) this.#counters.counts.timeouts += 1
    const { peer = 'the PLC', isOpen: open = false, probing: asked, noticed = { peer } } = this.#attempt ?? {}
    const waitsForTurn = this.#attempt?.waitsForTurn ?? false
    const causes =
      open && !waitsForTurn
        ? this.#owner.causes({ ...noticed, ...(asked === undefined ? {} : { onlyAsked: asked }) })
        : []
    const attempt = { peer, open, waitsForTurn, causes, reason: this.#supervisor.error, asked }
    call.fail(failure.notConnectedInTime(call.sends ? call.exchange.title : undefined, attempt))
  }

  #tellState(): void {
    this.#since = this.#clock.time()
    tellListener(this.#options.onState, this.state)
  }

  #schedule(): void {
    if (this.#supervisor.name === 'closed') return
    let due = this.#supervisor.nextAttempt ?? Number.POSITIVE_INFINITY
    for (const call of this.#held) due = Math.min(due, call.deadline)
    this.#alarm.set(due)
  }

  #timeout(): void {
    const now = this.#clock.now()
    for (const call of this.#held.filter((held) => held.deadline <= now)) {
      this.#held.splice(this.#held.indexOf(call), 1)
      this.#notConnected(call)
    }
    if (this.#supervisor.timeout(now)) this.#open()
    this.#schedule()
  }
}

const NOTHING = Buffer.alloc(0)

/** Stands for a call that only waits for the connection: it is never sent. */
const CONNECTING: Exchange<undefined> = {
  title: failure.CONNECTING,
  effect: 'diagnose',
  message: {},
  body: NOTHING,
  answered: true,
  write: () => NOTHING,
  mismatch: () => undefined,
  responseLength: () => undefined,
  answerBody: () => undefined,
  answerSize: () => 0,
  decode: () => undefined,
}
