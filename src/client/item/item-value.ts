// Values of items: what is read, what became of it, and what may be written.
import type { PlcError } from '../../errors'
import type { PlcValue, TypeToValue, TypeToWritten } from '../../value/value'
import type { FactsOf, ItemFacts } from './item-text'
import type { Item } from './parts'

/** A value read from an item without, or with, a count or range. */
export type ReadValue = PlcValue | PlcValue[]

/**
 * The type of an item's value, as far as its text says it: `M10` boolean, `D100` number, `D100:REAL[4]` number[],
 * `D200:STRING(20)` string. Where nobody can know it, e.g. of a label without a type, any {@link ReadValue}.
 */
export type ItemValue<I> = I extends Item ? ValueRead<FactsOf<I>> : ReadValue

type ValueRead<F extends ItemFacts> = [F['type']] extends [never]
  ? F['count'] extends 'unknown'
    ? ReadValue
    : Counted<F['count'], PlcValue>
  : Counted<F['count'], TypeToValue[F['type']]>

/** A value, or an array where the item has a count. */
export type Counted<N extends ItemFacts['count'], V> = N extends 'one' | 'element'
  ? V
  : N extends 'many'
    ? V[]
    : V | V[]

/**
 * What may be written to an item, as far as its text says it: to `M10` true or false, to `D100:REAL[4]` numbers, also
 * as a typed array. Where nobody can know it, any {@link WriteValue}.
 */
export type ItemInput<I> = I extends Item ? ValueWritten<FactsOf<I>> : WriteValue

type ValueWritten<F extends ItemFacts> = [F['type']] extends [never]
  ? F['count'] extends 'unknown' | 'element'
    ? WriteValue
    : CountedInput<F['count'], PlcValue>
  : CountedInput<F['count'], TypeToWritten[F['type']]>

/** A value, or all of an array where the item has a count. */
export type CountedInput<N extends ItemFacts['count'], V> = N extends 'one'
  ? V
  : N extends 'many'
    ? readonly V[] | ArrayOf<V>
    : V | readonly V[] | ArrayOf<V>

/** The typed arrays whose elements can be written as such values. */
type ArrayOf<V> = bigint extends V ? NumberArray : number extends V ? Exclude<NumberArray, BigIntArray> : never
type BigIntArray = BigInt64Array | BigUint64Array

/** What became of one item. `timestamp`: when the answer with its (last) value arrived, or the failure was known. */
export type ReadResult<V = ReadValue> =
  | {
      /** The item as it was given. */
      readonly item: string
      /** Whether there is a value. */
      readonly ok: true
      /** One value, or an array where the item has a count or a range. */
      readonly value: V
      /** Milliseconds since 1970. */
      readonly timestamp: number
      /** The array was read by more than one request: its values may be of different moments. */
      readonly torn?: true
      /** Of a tag: it was beyond the limits of its scaling, and the value is the limit. */
      readonly clamped?: true
      /** Of a label: its data type, as the PLC says it, e.g. `REAL`. */
      readonly type?: string
    }
  | {
      readonly item: string
      readonly ok: false
      /** Why there is no value. */
      readonly error: PlcError
      readonly timestamp: number
    }

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

// With `& unknown` editors show the values instead of the name.
/** The values of items, in their order or by their names. */
export type ItemValues<L extends Items> = { -readonly [K in keyof L]: ItemValue<L[K]> } & unknown

/** What became of items, in their order or by their names. */
export type ItemResults<L extends Items> = { -readonly [K in keyof L]: ReadResult<ItemValue<L[K]>> } & unknown

/** One value to write. */
export interface WriteEntry<I extends Item = Item> {
  /** What is written. */
  readonly item: I
  /** A value of its type; of an array all of them. */
  readonly value: ItemInput<I>
}

/** Entries to write, one for each item of a list. */
export type WriteEntries<L extends readonly Item[]> = { readonly [K in keyof L]: WriteEntry<L[K]> }

/** Values to write, by address. */
export type ItemInputs<A extends string> = { readonly [I in A]: ItemInput<I> }

/** Values to write: a list of entries, or an object by address. */
export type WriteValues = readonly WriteEntry[] | Readonly<Record<string, WriteValue>>
