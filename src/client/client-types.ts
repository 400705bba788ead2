// What the client gives and takes, beside its calls.
import type { Head3e } from '../melsec/frame-3e'
import type { PlcValue, ValueOf } from '../value/value'
import type { CallOptions } from './call'
import type { ConnectionState } from './connection-options'
import type { Item, PlanDescription, ReadResult, WriteResult } from './plan'
import type { TraceEntry } from './trace'

/** A value read from an item without, or with, a count or range. */
export type ReadValue = PlcValue | PlcValue[]

/** The type of an item's value as far as its text says it: `D100:REAL` number, `D100:REAL[4]` number[]. */
export type ItemValue<I> = I extends `${string}:${infer T}[${string}]`
  ? ValueOf<T>[]
  : I extends `${string}..${string}`
    ? PlcValue[]
    : I extends `${string}:${infer T}`
      ? ValueOf<T>
      : ReadValue

/** What a client tells those who listen. */
export interface ClientEvents {
  /** The state of the connection changed. */
  readonly state: ConnectionState
  /** A frame was sent or received. Costs time only while somebody listens. */
  readonly trace: TraceEntry
  /** A frame that the PLC sent unasked. */
  readonly unsolicited: UnsolicitedFrame
}

/** A frame that arrived in the form of a request. */
export interface UnsolicitedFrame {
  readonly route: Head3e['route']
  /** Command, subcommand and data, in the data code of the connection. */
  readonly body: Buffer
}

/** One value to write. */
export interface WriteEntry {
  readonly item: Item
  readonly value: ReadValue
}

/** A prepared read: run it again and again; nothing is parsed or encoded anew. */
export interface ReadPlan {
  /** Reads all items once. Each has its own result; it rejects only for a bug. */
  run(options?: CallOptions): Promise<ReadResult[]>
  /** Requests, points, bytes and notes, for people. */
  describe(): PlanDescription
  toString(): string
}

/** A prepared write. */
export interface WritePlan {
  /** Writes all entries once, in their order. Needs `allowWrites`. */
  run(options?: CallOptions): Promise<WriteResult[]>
  describe(): PlanDescription
  toString(): string
}
