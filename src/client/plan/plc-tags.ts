// A table of tags read, written and watched by name: what every client gives, whatever its family.

import type { TagDefinition, TagDefinitions, TagTable } from '../../tags/table/table'
import type { Scaling } from '../../tags/table/tag'
import type { CallOptions } from '../connection/call'
import type { InputIn, ItemTyping, ValueIn } from '../item/item-typing'
import type { ReadResult } from '../item/item-value'
import type { Watch, WatchOptions } from '../watch/watch'
import type { WatchedValue } from '../watch/watched-value'
import type { WriteCallOptions, WriteResult } from './write'

/** The part of a definition that says what to read, for the compiler. */
type ItemOf<F> = F extends string
  ? F
  : F extends { readonly address: string }
    ? Pick<F, keyof F & ('address' | 'type' | 'count')>
    : string

/** A scaled value is a number, whatever the PLC holds. */
type Scaled<V> = V extends readonly unknown[] ? number[] : V extends number | bigint ? number : never
type ScaledInput<V> = V extends { readonly length: number }
  ? V extends string
    ? never
    : V | readonly number[]
  : V extends number | bigint
    ? number
    : never

/** The value of a tag in its unit, by its definition. `T`: how its family of PLCs types items. */
export type TagValueIn<T extends ItemTyping, F> = F extends { readonly scaling: Scaling }
  ? Scaled<ValueIn<T, ItemOf<F>>>
  : ValueIn<T, ItemOf<F>>
/** What may be written to a tag, in its unit. */
export type TagInputIn<T extends ItemTyping, F> = F extends { readonly scaling: Scaling }
  ? ScaledInput<InputIn<T, ItemOf<F>>>
  : InputIn<T, ItemOf<F>>

/** Names of the tags of a table. */
export type TagName<D extends TagDefinitions> = keyof D & string

/** Names of those that may be written: `access` is `readWrite`, or not known to the compiler. */
export type WritableTagName<D extends TagDefinitions> = {
  [N in TagName<D>]: D[N] extends { readonly access: infer A }
    ? 'readWrite' extends A
      ? N
      : never
    : TagDefinition extends D[N]
      ? N
      : never
}[TagName<D>]

// With `& unknown` editors show the values instead of the name.
/** Values of tags by name. */
export type TagValuesIn<T extends ItemTyping, D extends TagDefinitions, N extends TagName<D>> = {
  -readonly [K in N]: TagValueIn<T, D[K]>
} & unknown
/** What became of tags, by name. */
export type TagResultsIn<T extends ItemTyping, D extends TagDefinitions, N extends TagName<D>> = {
  -readonly [K in N]: ReadResult<TagValueIn<T, D[K]>>
} & unknown
/** Watched tags by name. */
export type WatchedTagsIn<T extends ItemTyping, D extends TagDefinitions, N extends TagName<D>> = {
  readonly [K in N]: WatchedValue<TagValueIn<T, D[K]>>
} & unknown
/** Values to write, by name. */
export type TagInputsIn<T extends ItemTyping, D extends TagDefinitions, N extends TagName<D>> = {
  readonly [K in N]: TagInputIn<T, D[K]>
}

/** What the table does not say. */
export interface TagsOptions {
  /** ms between two scans, for each scan class that is watched by its name. */
  readonly scanClasses?: Readonly<Record<string, number>>
}

/** As the options of any watch; deadbands are those of the tags. */
export interface TagWatchOptions<V> extends Omit<WatchOptions<V>, 'every' | 'deadband'> {
  /** ms between two scans, a whole number; missing: what `scanClasses` says of the scan class. */
  readonly every?: number
  /** Only the tags of this scan class. */
  readonly scanClass?: string
}

/**
 * The tags of one PLC by name, in the units people use.
 * @example
 * const tags = plc.tags(defineTags({ level: 'D100:REAL', setpoint: { address: 'D110', access: 'readWrite', max: 50 } }))
 * const { level } = await tags.read()
 * await tags.write({ setpoint: 20 })
 */
export interface PlcTags<T extends ItemTyping, D extends TagDefinitions> {
  /** The table. */
  readonly table: TagTable<D>

  /**
   * Reads one tag. @throws PlcError what went wrong; ProtocolError BAD_FIELD when its scaling has no value for what the PLC holds
   * @example await tags.read('level')
   */
  read<const N extends TagName<D>>(name: N, options?: CallOptions): Promise<TagValueIn<T, D[N]>>
  /**
   * Reads the named tags, or all, in few requests: plain values by name.
   * @throws PlcError the first tag's error when any tag failed
   */
  read<const N extends TagName<D> = TagName<D>>(
    names?: readonly N[],
    options?: CallOptions,
  ): Promise<TagValuesIn<T, D, N>>
  /** As `read`, with a result for each: a tag that cannot be read does not hide the others. */
  readEach<const N extends TagName<D> = TagName<D>>(
    names?: readonly N[],
    options?: CallOptions,
  ): Promise<TagResultsIn<T, D, N>>

  /** Writes one tag, as many. @throws PlcError what went wrong */
  write<const N extends WritableTagName<D>>(
    name: N,
    value: TagInputIn<T, D[N]>,
    options?: WriteCallOptions,
  ): Promise<void>
  /**
   * Writes tags, in their order: scaled backwards, and held against access, limits and type. When one is refused nothing is sent, unless
   * `allOrNothing` is false. Needs `allowWrites`. When it resolves, everything was written.
   * @throws WriteError when anything was not written: its `results` say what became of each tag
   */
  write<const N extends WritableTagName<D>>(values: TagInputsIn<T, D, N>, options?: WriteCallOptions): Promise<void>
  /** As `write`, with a result for each instead of an error: what is not refused is written. Look at each of them. */
  writeEach<const N extends WritableTagName<D>>(
    values: TagInputsIn<T, D, N>,
    options?: WriteCallOptions,
  ): Promise<Record<N, WriteResult>>

  /**
   * Watches all tags, or those of a scan class, as `plc.watch` watches items. A change is what exceeds the deadband of its tag; a value
   * that its scaling has clamped is `uncertain`, one that it has none for `bad`.
   * @throws RequestError BAD_OPTION; ClosedError when the client is closed
   * @example for await (const { values, changed } of tags.watch({ every: 100 })) console.log(changed, values.level.value)
   */
  watch(options: TagWatchOptions<WatchedTagsIn<T, D, TagName<D>>>): Watch<WatchedTagsIn<T, D, TagName<D>>>
  /** Watches the named tags. */
  watch<const N extends TagName<D>>(
    names: readonly N[],
    options: TagWatchOptions<WatchedTagsIn<T, D, N>>,
  ): Watch<WatchedTagsIn<T, D, N>>
}
