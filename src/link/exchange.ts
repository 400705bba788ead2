import type { Effect } from '../codec/codec'
import type { BodyLength, ResponseFrame } from './framing'

/** One request ready to be sent, and how to read what comes back: what a protocol family hands to the client's shell. */
export interface Exchange<Head, T> {
  /** Manual's name of the command, for messages and traces. */
  readonly title: string
  readonly effect: Effect
  /** The message the body says. */
  readonly message: Readonly<Record<string, unknown>>
  readonly head: Head
  readonly body: Buffer
  /** `false`: the PLC does not answer when it succeeds (Remote Reset). */
  readonly answered: boolean
  readonly responseLength: BodyLength<Head>
  /** @throws EndCodeError when the PLC refused, ProtocolError when the answer cannot be one to this request. */
  decode(frame: ResponseFrame<Head>): T
}
