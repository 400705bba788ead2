import { checkNames, type OptionNames } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { ClosedError, EndCodeError, type PlcError, ProtocolError, RequestError } from '../../errors'
import type { BodyLength, Exchange, Head, Job, Priority, ResponseFrame, RoundTrips } from '../../link/link'
import type { Clock } from '../../transport/clock'
import { abortedBeforeSending, asPlcError } from './failure'

/** What every call may say. */
export interface CallOptions {
  /** ms from now until nobody waits any more: connecting, queueing, sending and answering included. */
  readonly timeout?: number
  /** Ends the call: with outcome `notSent` as long as it waits, `unknown` when it is under way. */
  readonly signal?: AbortSignal
  /**
   * Who asks, as a text or any object. Calls of one caller wait for one another, and callers take turns, so that one who
   * asks a lot does not keep the others waiting. Without it each call is a caller of its own.
   */
  readonly caller?: string | object
  /**
   * `poll`: a read that is repeated anyway, so that writes and the reads of others go first, but nine of them in a row at most.
   * Default `read`. A write goes first, whatever is said here.
   */
  readonly priority?: 'read' | 'poll'
}

/** What this package's own calls may say beside. */
export interface BoundOptions extends CallOptions {
  /**
   * Number of the connection it belongs to: it is not sent on another. What the PLC remembers of a connection, as a file
   * pointer, may mean something else on the next.
   */
  readonly onlyOn?: number
  /**
   * Set where nobody said how long the call may take, as without a timeout: what the request takes on a slow line comes on
   * top of `timeout`, and this is told how much.
   */
  readonly growing?: { grow(ms: number): void }
}

/** A call may wait for a day, as the option `timeout` of the client. */
const LONGEST = 24 * 60 * 60 * 1000

const OF_EVERY_CALL: OptionNames<CallOptions> = { timeout: true, signal: true, caller: true, priority: true }

/**
 * The part of a call's options that every call has.
 * @param own names of the options that only this kind of call has
 * @throws RequestError BAD_OPTION for an option that this call does not have: misspelt, it would be the usual one, and
 *   nobody would notice
 */
export function callOptionsOf(given: CallOptions | undefined, own: Readonly<Record<string, true>> = {}): CallOptions {
  if (given === undefined) return {}
  checkNames('', given, { ...own, ...OF_EVERY_CALL })
  const problem = optionProblem(given)
  if (problem !== undefined) throw problem
  const { timeout, signal, caller, priority } = given
  return {
    ...(timeout === undefined ? {} : { timeout }),
    ...(signal === undefined ? {} : { signal }),
    ...(caller === undefined ? {} : { caller }),
    ...(priority === undefined ? {} : { priority }),
  }
}

/**
 * What is wrong with the options of a call. Programs without types pass texts and NaN, and a deadline made of those is
 * never reached.
 */
export function optionProblem(options: CallOptions): RequestError | undefined {
  if (typeof options !== 'object' || options === null) {
    return new RequestError('BAD_OPTION', 'The options of a call are an object, e.g. { timeout: 1000 }.', 'options')
  }
  const { timeout, signal, caller, priority } = options
  if (timeout !== undefined && !(typeof timeout === 'number' && timeout > 0 && timeout <= LONGEST)) {
    const message = `timeout is ${String(timeout)}; it must be a number of milliseconds, more than 0 and at most ${LONGEST}.`
    return new RequestError('BAD_OPTION', message, 'timeout')
  }
  if (signal !== undefined && typeof signal?.addEventListener !== 'function') {
    return new RequestError('BAD_OPTION', 'signal is no AbortSignal: use the signal of an AbortController.', 'signal')
  }
  if (caller !== undefined && typeof caller !== 'string' && (typeof caller !== 'object' || caller === null)) {
    return new RequestError('BAD_OPTION', 'caller is a text or an object: who asks.', 'caller')
  }
  if (priority !== undefined && priority !== 'read' && priority !== 'poll') {
    return new RequestError('BAD_OPTION', `priority is ${shown(priority)}; it must be read or poll.`, 'priority')
  }
  return undefined
}

/** What happens to the caller's promise. */
export interface Settle {
  /**
   * Reads the answer; throws what it turned out to be instead. `undefined`: nothing was asked (only connecting).
   * `roundTrip`: ms from sending to the answer.
   */
  readonly answer: (frame: ResponseFrame | undefined, roundTrip: number) => void
  readonly fail: (error: PlcError) => void
}

interface CallFacts {
  readonly sends?: boolean
  readonly onlyOn?: number | undefined
  readonly allowance?: number
  readonly caller?: unknown
  readonly priority?: CallOptions['priority']
  /** ms for its answer from being sent, where it waits for its turn without a deadline. */
  readonly answerIn?: number
}

/** One request of the caller: the job the session carries. Settled exactly once. */
export class Call implements Job {
  #signal: AbortSignal | undefined
  #unwatch: (() => void) | undefined
  #settled = false
  /** Sent a second time. */
  #repeated = false
  readonly #settle: Settle
  /** Set for what opens a locked PLC: until then it returns no self test. */
  needsNoProof = false
  /** `false`: the call only waits for the connection. */
  readonly sends: boolean
  /** Connection it must be sent on, if on none but that. */
  readonly onlyOn: number | undefined
  /** ms it was given in all. */
  readonly allowance?: number
  readonly caller: unknown
  readonly #asks: Priority
  /** Of a call whose time begins when it is sent. */
  readonly #answerIn: number | undefined
  deadline: number
  lineTime: number | undefined
  answerDelay: number | undefined
  #plc: object | undefined
  #roundTrips: RoundTrips | undefined

  constructor(
    readonly exchange: Exchange<unknown>,
    deadline: number,
    settle: Settle,
    { sends = true, onlyOn, allowance, caller, priority = 'read', answerIn }: CallFacts = {},
  ) {
    this.#settle = settle
    this.deadline = deadline
    this.#answerIn = answerIn
    this.sends = sends
    this.onlyOn = onlyOn
    if (allowance !== undefined) this.allowance = allowance
    this.caller = caller
    this.#asks = priority
  }

  /** It goes over a line: for this PLC, whose answers take so long. */
  over(plc: object, roundTrips: RoundTrips): void {
    this.#plc = plc
    this.#roundTrips = roundTrips
  }

  /** It goes out. */
  leaves(clock: Clock): void {
    if (this.#answerIn !== undefined && this.waitsForTurn) this.deadline = clock.now() + this.#answerIn
  }

  /** It waits for its turn, however long that takes. */
  get waitsForTurn(): boolean {
    return this.deadline === Number.POSITIVE_INFINITY
  }

  /** Whose it is on the line. */
  get plc(): object | undefined {
    return this.#plc
  }

  get roundTrips(): RoundTrips | undefined {
    return this.#roundTrips
  }

  /** What changes the PLC does not wait behind what only asks. */
  get priority(): Priority {
    return isChange(this.exchange) ? 'control' : this.#asks
  }

  /** Nobody waits for it any more. */
  get isSettled(): boolean {
    return this.#settled
  }

  write(serial: number): Buffer {
    return this.exchange.write(serial)
  }

  mismatch(answered: Head): string | undefined {
    return this.exchange.mismatch(answered)
  }

  get responseLength(): BodyLength {
    return this.exchange.responseLength
  }

  /** The signal that may abort it, and what ends the watching: done when the call is settled. */
  abortedBy(signal: AbortSignal, unwatch: () => void): void {
    this.#signal = signal
    this.#unwatch = unwatch
  }

  /** On a slow line: ms of the characters of request and answer, and that the PLC is told to wait before it answers. */
  takes(lineTime: number, answerDelay: number | undefined): void {
    this.lineTime = lineTime
    this.answerDelay = answerDelay
  }

  /**
   * Whether its answer may be asked for once more, because what came was damaged. Not of what changes the PLC: it may have
   * been carried out.
   */
  mayRepeat(): boolean {
    const { effect } = this.exchange
    return (effect === 'read' || effect === 'diagnose') && this.#isFirst()
  }

  /** Whether it may be sent once more, because the PLC says that it arrived damaged and did nothing. */
  mayResend(): boolean {
    return this.#isFirst()
  }

  /** Which of its frames was damaged: `request`, says the PLC; or why the answer is none to it. */
  damageOf(frame: ResponseFrame): 'request' | ProtocolError | undefined {
    try {
      this.exchange.decode(frame)
      return undefined
    } catch (error) {
      if (error instanceof ProtocolError) return error
      const isDamaged = error instanceof EndCodeError && error.about === 'transmission' && error.carriedOut === false
      return isDamaged ? 'request' : undefined
    }
  }

  #isFirst(): boolean {
    const isFirst = !this.#repeated && !this.#settled
    this.#repeated = true
    return isFirst
  }

  /** Settles with the answer. @returns the error the answer turned out to be, if any. */
  answer(frame: ResponseFrame | undefined, roundTrip = 0): PlcError | undefined {
    if (!this.#finish()) return undefined
    try {
      this.#settle.answer(frame, roundTrip)
      return undefined
    } catch (thrown) {
      const error = asPlcError(thrown)
      this.#settle.fail(error)
      return error
    }
  }

  fail(error: PlcError): void {
    if (this.#finish()) this.#settle.fail(error)
  }

  /** The error for a call whose signal is aborted. */
  aborted(outcome: 'notSent' | 'unknown'): ClosedError {
    const { title } = this.exchange
    if (outcome === 'notSent') return abortedBeforeSending(title, this.#signal?.reason)
    const message = `${title} was aborted in flight; whether the PLC carried it out is not known.`
    return new ClosedError('ABORTED', message, outcome, this.#signal?.reason)
  }

  #finish(): boolean {
    if (this.#settled) return false
    this.#settled = true
    this.#unwatch?.()
    return true
  }
}

/** Whether it does something to the PLC. */
export function isChange({ effect }: Exchange<unknown>): boolean {
  return effect !== 'read' && effect !== 'diagnose'
}
