// The first requests on a connection, which no caller asked for: unlocking, then the probe that proves the PLC is there.
import { EndCodeError, type PlcError } from '../errors'
import type { Exchange } from '../link/link'
import { Call } from './call'
import type { ConnectionOptions } from './connection-options'
import * as failure from './failure'

/**
 * ms without traffic after which a UDP connection is unlocked again before the next request: the PLC locks it after 10
 * minutes (FX5 communication manual 13.2).
 */
const UNLOCKED_FOR = 9 * 60_000

export class Opening<Head> {
  readonly #options: Pick<ConnectionOptions<Head>, 'unlocking' | 'probe' | 'timeout' | 'connectTimeout'>
  #call: Call<Head> | undefined
  #unlocking = false
  #corrected = false
  #heardAt = 0

  constructor(options: Pick<ConnectionOptions<Head>, 'unlocking' | 'probe' | 'timeout' | 'connectTimeout'>) {
    this.#options = options
  }

  /** The first call of a new connection. */
  begin(now: number): Call<Head> {
    const unlock = this.#options.unlocking?.exchange()
    this.#unlocking = unlock !== undefined
    this.#corrected = false
    const call = this.#make(unlock ?? this.#options.probe(), now)
    call.needsNoProof = this.#unlocking
    return call
  }

  /** Whether the call is the opening's own. */
  owns(call: Call<Head>): boolean {
    return call === this.#call
  }

  /** Its call was answered. @returns the next one, why there is none, or `undefined` when the connection is open */
  next(refusal: PlcError | undefined, now: number): Call<Head> | PlcError | undefined {
    // Any answer to the probe, also a refusal, proves that the PLC is there.
    this.#call = undefined
    if (!this.#unlocking) return undefined
    this.#unlocking = false
    return refusal ?? this.#make(this.#options.probe(), now)
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
  expired(now: number, peer: string): PlcError | undefined {
    if (now - this.#heardAt < UNLOCKED_FOR) return undefined
    return this.#options.unlocking?.exchange() === undefined ? undefined : failure.unlockExpired(peer)
  }

  /** Why a refused request says that the PLC is locked again. */
  lockedBy(refusal: PlcError | undefined, peer: string): PlcError | undefined {
    const { unlocking } = this.#options
    if (!(refusal instanceof EndCodeError) || unlocking?.isLocked(refusal) !== true) return undefined
    return unlocking.exchange() === undefined ? undefined : failure.lockedAgain(peer, refusal)
  }

  #make(exchange: Exchange<Head, unknown>, now: number): Call<Head> {
    const { timeout, connectTimeout } = this.#options
    // Nobody awaits it; how it ends is seen by the connection.
    this.#call = new Call(exchange, now + Math.min(timeout, connectTimeout), {
      answer: (frame) => {
        if (frame !== undefined) exchange.decode(frame)
      },
      fail: () => {},
    })
    return this.#call
  }
}
