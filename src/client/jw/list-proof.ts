/**
 * Whether the PLC reads lists of relays and registers (21H, 27H, 31H, 37H) as they are written here. The manual draws the marker
 * FFH once, before the first address, and where an address stands alone before each: which of the two holds for two addresses
 * and more, no source says. A read tells: its answer repeats the addresses. So nothing is written by a list before one was read.
 */
import { type EndCodeAbout, type EndCodeError, type PlcError, ProtocolError, TimeoutError } from '../../errors'

/** Refusals that may be about lists as such: the PLC has none, or writes FFH elsewhere. */
export const OF_LISTS: ReadonlySet<EndCodeAbout> = new Set(['command', 'request'])

export class ListProof {
  #state: 'unknown' | 'proved' | 'refused'
  #reason: PlcError | undefined

  /** @param isWanted the option `lists`, on a model that has them */
  constructor(isWanted: boolean) {
    this.#state = isWanted ? 'unknown' : 'refused'
  }

  /** Whether plans may have lists. */
  get mayBeUsed(): boolean {
    return this.#state !== 'refused'
  }

  /** Whether a list has been read. */
  get isProved(): boolean {
    return this.#state === 'proved'
  }

  /** A list of two addresses or more was answered. */
  proved(): void {
    if (this.#state === 'unknown') this.#state = 'proved'
  }

  /** A list was refused. When it was refused as such, plans that are made from now on have none. */
  refusedBy(refusal: EndCodeError): void {
    if (OF_LISTS.has(refusal.about)) this.#refuse(refusal)
  }

  /** A list got no answer, or one that is none: so does a PLC that writes FFH elsewhere. */
  failed(error: unknown): void {
    const isSilence = error instanceof TimeoutError && error.outcome === 'unknown'
    if (isSilence || error instanceof ProtocolError) this.#refuse(error)
  }

  #refuse(reason: PlcError): void {
    if (this.#state !== 'unknown') return
    this.#state = 'refused'
    this.#reason = reason
  }

  /** For people who look at a plan. */
  get note(): string | undefined {
    if (this.#reason === undefined) return undefined
    return `Lists of scattered operands are not used, because the first one was not read: try the other marker, if there is one for this PLC. ${this.#reason.message}`
  }
}
