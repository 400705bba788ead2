// The first requests on a connection, which no caller asked for: unlocking, then the probe that proves the PLC is there.
import { EndCodeError, type PlcError } from '../../errors'
import type { Exchange, ResponseFrame } from '../../link/link'
import { Call } from './call'
import type { ConnectionOptions } from './connection-options'
import * as failure from './failure'
import type { Line } from './line'
import type { NextProbe } from './probing'

/**
 * ms without traffic after which a UDP connection is unlocked again before the next request: the PLC locks it after 10
 * minutes (FX5 communication manual 13.2).
 */
const UNLOCKED_FOR = 9 * 60_000

type Options = Pick<ConnectionOptions, 'unlocking' | 'timeout' | 'connectTimeout' | 'messageWait'>

/** What it needs to know of the line. */
type OpeningLine = Pick<Line, 'timeOf' | 'takesTurns'>

export class Opening {
  readonly #options: Options
  readonly #probe: NextProbe | undefined
  readonly #line: OpeningLine
  #call: Call | undefined
  #unlocking = false
  #corrected = false
  #heardAt = 0

  constructor(options: Options, probe: NextProbe | undefined, line: OpeningLine) {
    this.#options = options
    this.#line = line
    this.#probe = probe
  }

  /** The first call of a new connection; `undefined`: nothing is asked. */
  begin(now: number): Call | undefined {
    const unlock = this.#options.unlocking?.exchange()
    this.#unlocking = unlock !== undefined
    this.#corrected = false
    if (unlock === undefined) return this.#beginProbe(now)
    const call = this.#make(unlock, now, 1)
    call.needsNoProof = true
    return call
  }

  /** The client waits for half as long where another probe follows: a call needs two answers within its time anyway. */
  #beginProbe(now: number): Call | undefined {
    if (this.#probe === undefined) return undefined
    const { probe, hasNext } = this.#probe
    return this.#make(probe.exchange(), now, hasNext ? 0.5 : 1)
  }

  /** Name of the probe that has no answer yet. */
  get probing(): string | undefined {
    return this.#call === undefined || this.#unlocking ? undefined : this.#probe?.probe.name
  }

  /** Others who share the line go first: what it asks was not sent yet. */
  get waitsForTurn(): boolean {
    return this.#call?.waitsForTurn ?? false
  }

  /** Whether one of its calls is not answered yet. */
  get isGoingOn(): boolean {
    return this.#call !== undefined
  }

  /** Whether the call is the opening's own. */
  owns(call: Call): boolean {
    return call === this.#call
  }

  /** Its call was answered. @returns the next one, why there is none, or `undefined` when the connection is open */
  next(refusal: PlcError | undefined, now: number): Call | PlcError | undefined {
    // Any answer to the probe, also a refusal, proves that the PLC is there.
    this.#call = undefined
    if (!this.#unlocking) return undefined
    this.#unlocking = false
    return refusal ?? this.#beginProbe(now)
  }

  /** What the PLC refuses has been corrected: also counts when the old one is just being sent. */
  correct(): void {
    this.#corrected = true
  }

  /** Whether the connection was lost for something that would be refused again and again. */
  isFinal(reason: PlcError): boolean {
    return reason instanceof EndCodeError && !this.#corrected && this.#options.unlocking?.isFinal(reason) === true
  }

  heard(now: number): void {
    this.#heardAt = now
  }

  /** Over UDP: why the PLC must be locked by now although nobody closed the connection. */
  expired(now: number, peer: () => string): PlcError | undefined {
    if (now - this.#heardAt < UNLOCKED_FOR) return undefined
    return this.#options.unlocking?.exchange() === undefined ? undefined : failure.unlockExpired(peer())
  }

  /** Why a refused request says that the PLC is locked again. */
  lockedBy(refusal: PlcError | undefined, peer: string): PlcError | undefined {
    const { unlocking } = this.#options
    if (!(refusal instanceof EndCodeError) || unlocking?.isLocked(refusal) !== true) return undefined
    return unlocking.exchange() === undefined ? undefined : failure.lockedAgain(peer, refusal)
  }

  #make(exchange: Exchange<unknown>, now: number, share: number): Call {
    const { timeout, connectTimeout, messageWait } = this.#options
    const answerIn = share * Math.min(timeout, connectTimeout) + this.#line.timeOf(exchange, messageWait)
    // A PLC that was not asked is not silent: the silence of others takes time, too.
    const deadline = this.#line.takesTurns ? Number.POSITIVE_INFINITY : now + answerIn
    // Nobody awaits it; how it ends is seen by the connection.
    const settle = {
      answer: (frame: ResponseFrame | undefined) => {
        if (frame !== undefined) exchange.decode(frame)
      },
      fail: () => {},
    }
    this.#call = new Call(exchange, deadline, settle, { answerIn })
    return this.#call
  }
}
