// Values of items: what is read, what became of it, and what may be written.
import type { PlcError } from '../../errors'
import type { PlcValue, ValueOf } from '../../value/value'
import type { Item } from './item'

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

/** What became of one item. `timestamp`: when the answer with its (last) value arrived, or the failure was known. */
export type ReadResult =
  | {
      readonly item: string
      readonly ok: true
      readonly value: PlcValue | PlcValue[]
      readonly timestamp: number
      /** The array was read by more than one request: its values may be of different moments. */
      readonly torn?: true
      /** Of a label: its data type, as the PLC says it, e.g. `REAL`. */
      readonly type?: string
    }
  | { readonly item: string; readonly ok: false; readonly error: PlcError; readonly timestamp: number }

/** A value for a single item, an array for an item with a count or a range. */
export type PlainValue = PlcValue | readonly PlcValue[]

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
  /** What is written. */
  readonly item: Item
  /** A value of its type; of an array all of them. */
  readonly value: WriteValue
}

/** Values to write: a list of entries, or an object by address. */
export type WriteValues = readonly WriteEntry[] | Readonly<Record<string, WriteValue>>
