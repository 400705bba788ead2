// What the client gives and takes, beside its calls.
import type { ProtocolError } from '../../errors'
import type { Route } from '../../melsec/frame/route'
import type { ConnectionState } from '../connection/connection-options'
import type { TraceEntry } from '../connection/trace'

/** What a client tells those who listen. */
export interface ClientEvents {
  /** The state of the connection changed. */
  readonly state: ConnectionState
  /** A frame was sent or received. Costs time only while somebody listens. */
  readonly trace: TraceEntry
  /** Data that the PLC sent unasked (On-demand, 2101). Nothing is answered. Not with 1E; over UDP it needs `localPort`. */
  readonly onDemand: OnDemand
  /** A frame that the PLC sent unasked, as it is: each one, also what cannot be read. */
  readonly unsolicited: UnsolicitedFrame
}

/** A frame that arrived in the form of a request. */
export interface UnsolicitedFrame {
  /** As the frame says it. */
  readonly route: Route
  /** Command, subcommand and data, in the data code of the connection. */
  readonly body: Buffer
  /** Milliseconds since 1970. */
  readonly timestamp: number
  /** Why it is no On-demand that can be read; absent when `onDemand` tells it. */
  readonly error?: ProtocolError
}

/** What a program in the PLC has sent of its own accord (SLMP reference manual 5.11). */
export interface OnDemand {
  /** As the frame says it. */
  readonly route: Route
  /** 0 to 1920 bytes, low byte of each word first. */
  readonly data: Buffer
  /** The same as words, 0 to 65535 each; `undefined` when the number of bytes is odd. */
  readonly words: readonly number[] | undefined
  /** Milliseconds since 1970: when it was received. */
  readonly timestamp: number
}
