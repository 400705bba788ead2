// What a connection is told and what it tells.
import type { EndCodeError } from '../../errors'
import type { Exchange, RequestFrame } from '../../link/link'
import type { Clock } from '../../transport/clock'
import type { Phase, SupervisorOptions } from './supervisor'

/** A frame as it went over the wire. */
export interface TracedFrame {
  /** Milliseconds since 1970. */
  readonly time: number
  readonly direction: 'sent' | 'received'
  readonly bytes: Buffer
}

/**
 * The state of a connection, for people and programs: `name` narrows the type. `error` is always there in `waiting`, and in
 * `connecting` and `closed` when the last attempt failed; `nextAttempt` (milliseconds since 1970) is in `waiting` only.
 */
export type ConnectionState = Phase & {
  /** Milliseconds since 1970. */
  readonly since: number
  /** Attempts since the last connection that worked. */
  readonly attempt: number
}

/** What is known about a silence, for whoever explains it. */
export interface Silence {
  /** What was tried, e.g. `tcp 192.168.3.39:5007`. */
  readonly peer: string
  /** Whether this PLC ever answered this client. */
  readonly answeredBefore: boolean
  /** The only request that it was asked, when it is the client's own that proves the connection. */
  readonly onlyAsked?: string
  /** Something came since the line was opened, though no answer. */
  readonly heard?: boolean
  /** Other PLCs on the same line answer. */
  readonly othersAnswer?: boolean
}

/** A request that proves a connection: any answer to it, also a refusal, proves that the PLC is there. */
export interface Probe {
  /** With its number, as people find it in the manual: `Read Type Name (0101)`. */
  readonly name: string
  readonly exchange: () => Exchange<unknown>
}

/** How a locked PLC is opened: before everything else on each connection. */
export interface Unlocking {
  /** `undefined`: there is nothing to unlock. */
  readonly exchange: () => Exchange<unknown> | undefined
  /** The refusal would be repeated, and the PLC lock out: no further attempt before `retry()`. */
  readonly isFinal: (error: EndCodeError) => boolean
  /** A request was refused because the PLC is locked (again). */
  readonly isLocked: (error: EndCodeError) => boolean
}

/** Of the connection to one PLC; what carries its bytes is the line's. */
export interface ConnectionOptions {
  readonly clock: Clock
  readonly supervisor: SupervisorOptions
  readonly queueLimit: number
  /** ms */
  readonly connectTimeout: number
  /** Default deadline of a call, ms; what its request takes on a slow line comes on top. */
  readonly timeout: number
  /** ms that the PLC is told to wait before it answers (message wait of the serial frames); default 0. */
  readonly messageWait?: number
  /** Opens a PLC that is locked by a remote password. */
  readonly unlocking?: Unlocking
  /**
   * The first request on a new connection, behind unlocking. Where it gets no answer the next one is tried, on another
   * connection. None: the first request of the program proves the connection.
   */
  readonly probes: readonly Probe[]
  /** Ranked causes, most likely first. */
  readonly explainSilence: (silence: Silence) => readonly string[]
  readonly onState: (state: ConnectionState) => void
  readonly onUnsolicited: (frame: RequestFrame) => void
}
