// When to connect, when to wait, when to fail fast: the life of one connection as a pure state machine.
// Time is an argument; the shell (connection.ts) owns the transport and the timer.
import type { PlcError } from '../../errors'

/** Where a connection stands. `idle`: nothing was asked yet. */
export type ConnectionStateName = 'idle' | 'connecting' | 'connected' | 'waiting' | 'closed'

/** Where a connection stands: the name says what else there is. */
export type Phase =
  | {
      /** Nothing has gone wrong. */
      readonly name: 'idle' | 'connected'
      readonly error?: undefined
      readonly nextAttempt?: undefined
    }
  | {
      readonly name: 'connecting' | 'closed'
      /** Why there is no connection; absent when none has failed since the last one that worked. */
      readonly error?: PlcError
      readonly nextAttempt?: undefined
    }
  | {
      readonly name: 'waiting'
      /** Why there is no connection. */
      readonly error: PlcError
      /** When the next attempt starts; absent while it waits for a correction by the user. */
      readonly nextAttempt?: number
    }

export interface SupervisorOptions {
  /** First pause after a failed attempt, ms. Doubled each time, up to `longest`, with jitter. */
  readonly first: number
  readonly longest: number
  /** Pause after a connection that worked, ms: a PLC needs a moment to release the entry. */
  readonly settleGap: number
  /** 0 to below 1. Spreads the attempts of many clients after a power cut. */
  readonly random: () => number
}

/** A connection that lived at least this long was a good one: the next attempt starts afresh. ms */
const STABLE = 5_000

export class Supervisor {
  readonly #options: SupervisorOptions
  #phase: Phase = { name: 'idle' }
  #attempt = 0
  #connectedAt = 0
  /** Attempts it took to make the present connection, those that made short-lived ones included. */
  #attemptsSpent = 0
  #useful = false

  constructor(options: SupervisorOptions) {
    this.#options = options
  }

  get phase(): Phase {
    return this.#phase
  }

  get name(): ConnectionStateName {
    return this.#phase.name
  }

  /** Attempts since the last connection that worked; the present one included. */
  get attempt(): number {
    return this.#attempt
  }

  /** Why there is no connection; undefined while there is one or nothing was tried. */
  get error(): PlcError | undefined {
    return this.#phase.error
  }

  /** When the next attempt starts, while `waiting`. */
  get nextAttempt(): number | undefined {
    return this.#phase.nextAttempt
  }

  /** Whether a request may wait for the connection: as long as no attempt has failed since one that was of use. */
  get hopeful(): boolean {
    if (this.name === 'waiting') return this.#attempt === 0
    return this.name === 'idle' || (this.name === 'connecting' && this.#attempt <= 1)
  }

  /** Waiting for a correction by the user: there is no next attempt before `retry()`. */
  get givenUp(): boolean {
    return this.#phase.name === 'waiting' && this.#phase.nextAttempt === undefined
  }

  /** Somebody needs the connection. @returns whether the shell must open a transport now. */
  want(): boolean {
    if (this.name !== 'idle') return false
    this.#connect()
    return true
  }

  /** Time has passed. @returns whether the shell must open a transport now. */
  timeout(now: number): boolean {
    const { nextAttempt } = this.#phase
    if (nextAttempt === undefined || now < nextAttempt) return false
    this.#connect()
    return true
  }

  /** The PLC answered: the connection is good. */
  connected(now: number): void {
    this.#phase = { name: 'connected' }
    this.#attemptsSpent = this.#attempt
    this.#useful = false
    this.#attempt = 0
    this.#connectedAt = now
  }

  /** The PLC has answered a request of the program, not only the first one that proves the connection. */
  proved(): void {
    this.#useful = true
  }

  /** What the next attempt waits for is there. @returns whether the shell must open a transport now */
  hurry(): boolean {
    if (this.nextAttempt === undefined) return false
    this.#connect()
    return true
  }

  /** What made further attempts pointless has been corrected. @returns whether the shell must open a transport now. */
  retry(): boolean {
    if (!this.givenUp) return false
    this.#attempt = 0
    this.#connect()
    return true
  }

  /** The attempt goes on with another connection, after the pause that a PLC needs to release the entry. */
  again(error: PlcError, now: number): void {
    this.#attempt = Math.max(0, this.#attempt - 1)
    this.#phase = { name: 'waiting', error, nextAttempt: now + this.#options.settleGap }
  }

  /**
   * The attempt failed, or the connection is gone or was dropped. `pauseAtLeast` may be Infinity: until `retry()`.
   * `isAbsent`: another attempt would fail as this did, so that nothing waits for it.
   */
  lost(error: PlcError, now: number, pauseAtLeast = 0, isAbsent = false): void {
    if (this.name === 'closed') return
    const shortLived = this.name === 'connected' && now - this.#connectedAt < STABLE
    // A connection that breaks again and again right after it was made must not become a storm of connects: there is at
    // least the first pause, and as long as nothing comes of the connections the pauses go on growing.
    if (shortLived && !this.#useful) this.#attempt = Math.max(1, this.#attemptsSpent)
    const failures = shortLived ? Math.max(1, this.#attempt) : this.#attempt
    if (isAbsent) this.#attempt = Math.max(1, this.#attempt)
    const next = now + Math.max(pauseAtLeast, this.#pause(isAbsent ? this.#attempt : failures))
    this.#phase = { name: 'waiting', error, ...(next === Number.POSITIVE_INFINITY ? {} : { nextAttempt: next }) }
  }

  close(): void {
    this.#phase = { name: 'closed', ...this.#lastError }
  }

  #connect(): void {
    this.#phase = { name: 'connecting', ...this.#lastError }
    this.#attempt += 1
  }

  /** The last error stays until a connection works. */
  get #lastError(): { readonly error?: PlcError } {
    const { error } = this.#phase
    return error === undefined ? {} : { error }
  }

  #pause(failures: number): number {
    const { first, longest, settleGap, random } = this.#options
    if (failures === 0) return settleGap
    const backOff = Math.min(longest, first * 2 ** Math.min(failures - 1, 30))
    return Math.max(settleGap, backOff * (0.5 + random() / 2))
  }
}
