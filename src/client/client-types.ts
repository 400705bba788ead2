// What the client gives and takes, beside its calls.
import type { ProtocolError } from '../errors'
import type { Head3e } from '../melsec/frame-3e'
import type { PlcValue, ValueOf } from '../value/value'
import type { CallOptions } from './call'
import type { ConnectionState } from './connection-options'
import type { Item, PlanDescription, ReadResult, WriteResult } from './plan'
import type { TraceEntry } from './trace'

/** A value read from an item without, or with, a count or range. */
export type ReadValue = PlcValue | PlcValue[]

/**
 * The type of an item's value as far as its text says it: `D100:REAL` number, `D100:REAL[4]` number[]. Brackets behind
 * the name of a label are an index and no count.
 */
export type ItemValue<I> =
  Lowercase<I & string> extends `label:${infer L}`
    ? LabelItemValue<L>
    : I extends `${string}:${infer T}[${string}]`
      ? ValueOf<T>[]
      : I extends `${string}..${string}`
        ? PlcValue[]
        : I extends `${string}:${infer T}`
          ? ValueOf<T>
          : ReadValue

type LabelItemValue<L> = L extends `${string}:${infer T}[${string}]`
  ? ValueOf<T>[]
  : L extends `${string}:${infer T}`
    ? ValueOf<T>
    : ReadValue

/** What a client tells those who listen. */
export interface ClientEvents {
  /** The state of the connection changed. */
  readonly state: ConnectionState
  /** A frame was sent or received. Costs time only while somebody listens. */
  readonly trace: TraceEntry
  /** Data that the PLC sent unasked (On-demand, 2101). Nothing is answered. Not with 1E; over UDP it needs `localPort`. */
  readonly ondemand: OnDemand
  /** A frame that the PLC sent unasked, as it is: each one, also what cannot be read. */
  readonly unsolicited: UnsolicitedFrame
}

/** A frame that arrived in the form of a request. */
export interface UnsolicitedFrame {
  readonly route: Head3e['route']
  /** Command, subcommand and data, in the data code of the connection. */
  readonly body: Buffer
  /** Milliseconds since 1970. */
  readonly timestamp: number
  /** Why it is no On-demand that can be read; absent when `ondemand` tells it. */
  readonly error?: ProtocolError
}

/** What a program in the PLC has sent of its own accord (SLMP reference manual 5.11). */
export interface OnDemand {
  /** As the frame says it. */
  readonly route: Head3e['route']
  /** 0 to 1920 bytes, low byte of each word first. */
  readonly data: Buffer
  /** The same as words, 0 to 65535 each; `undefined` when the number of bytes is odd. */
  readonly words: readonly number[] | undefined
  /** Milliseconds since 1970: when it was received. */
  readonly timestamp: number
}

/** A typed array, as a value of an array of numbers. */
export type NumberArray =
  | Int8Array
  | Uint8Array
  | Uint8ClampedArray
  | Int16Array
  | Uint16Array
  | Int32Array
  | Uint32Array
  | Float32Array
  | Float64Array
  | BigInt64Array
  | BigUint64Array

/** A value for an item without a count or range, or an array, also a typed one, for one with. */
export type WriteValue = PlcValue | readonly PlcValue[] | NumberArray

/** Items to read: a list, or an object by name. */
export type Items = readonly Item[] | Readonly<Record<string, Item>>

/** One value to write. */
export interface WriteEntry {
  readonly item: Item
  readonly value: WriteValue
}

/** Values to write: a list of entries, or an object by address. */
export type WriteValues = readonly WriteEntry[] | Readonly<Record<string, WriteValue>>

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
  /**
   * Writes all entries once, in their order. Needs `allowWrites`.
   * @throws WriteError when anything was not written
   */
  run(options?: CallOptions): Promise<void>
  /** As `run`, with a result for each entry instead of an error. Look at each of them. */
  runEach(options?: CallOptions): Promise<WriteResult[]>
  describe(): PlanDescription
  toString(): string
}
