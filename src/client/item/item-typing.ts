/**
 * How the compiler knows the values of items, whatever family of PLCs a client speaks to: a family says once what the values of
 * an item are, and the signatures of all clients follow.
 */
import type { ItemInput, ItemValue, ReadResult, ReadValue, WriteValue } from './item-value'
import type { Item } from './parts'

/** What a family says of an item, by `this['item']`. */
export interface ItemTyping {
  /** The item, as it was given. */
  readonly item: unknown
  /** What is read of it. */
  readonly value: unknown
  /** What may be written to it. */
  readonly input: unknown
}

/** Items of a MELSEC PLC. */
export interface MelsecItems extends ItemTyping {
  /** By the text of the item. */
  readonly value: ItemValue<this['item']>
  /** By the text of the item. */
  readonly input: ItemInput<this['item']>
}

/** Items of a PLC of any family: nothing is known of their values. */
export interface AnyItems extends ItemTyping {
  /** Any. */
  readonly value: ReadValue
  /** Any. */
  readonly input: WriteValue
}

/** What is read of an item. */
export type ValueIn<T extends ItemTyping, I> = (T & { readonly item: I })['value']
/** What may be written to an item. */
export type InputIn<T extends ItemTyping, I> = (T & { readonly item: I })['input']

// With `& unknown` editors show the values instead of the name.
/** The values of items, in their order or by their names. */
export type ValuesIn<T extends ItemTyping, L> = { -readonly [K in keyof L]: ValueIn<T, L[K]> } & unknown
/** What became of items, in their order or by their names. */
export type ResultsIn<T extends ItemTyping, L> = { -readonly [K in keyof L]: ReadResult<ValueIn<T, L[K]>> } & unknown

/** Entries to write, one for each item of a list. */
export type EntriesIn<T extends ItemTyping, L extends readonly Item[]> = {
  readonly [K in keyof L]: { readonly item: L[K]; readonly value: InputIn<T, L[K]> }
}
/** Values to write, by address. */
export type InputsIn<T extends ItemTyping, A extends string> = { readonly [I in A]: InputIn<T, I> }
