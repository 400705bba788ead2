// What every client of a PLC can do, whatever its family: what tags, watching and screens are built on.

import type { TagDefinitions, TagTable } from '../../tags/table/table'
import type { CallOptions } from '../connection/call'
import type { ConnectionState } from '../connection/connection-options'
import type { Statistics } from '../connection/statistics'
import type {
  AnyItems,
  EntriesIn,
  InputIn,
  InputsIn,
  ItemTyping,
  ResultsIn,
  ValueIn,
  ValuesIn,
} from '../item/item-typing'
import type { Items } from '../item/item-value'
import type { Item } from '../item/parts'
import type { Watch, WatchOptions } from '../watch/watch'
import type { WatchedValue } from '../watch/watched-value'
import type { ReadPlan, WritePlan } from './plans'
import type { PlcTags, TagsOptions } from './plc-tags'
import type { WriteCallOptions, WriteOptions, WriteResult } from './write'

/** Watched values, in their order or by their names. */
export type WatchedIn<T extends ItemTyping, L> = { readonly [K in keyof L]: WatchedValue<ValueIn<T, L[K]>> } & unknown

/** What every client tells those who listen. */
export interface PlcEvents {
  /** The state of the connection changed. */
  readonly state: ConnectionState
}

/**
 * A client of one PLC. It connects at the first call, stays connected in the background, and reconnects by itself until
 * `close()`. Every rejection is a `PlcError`: its `code` says what, its `outcome` whether the PLC may have carried it out.
 * `T`: how its family of PLCs types items; without it a client of any family, of whose values nothing is known.
 */
export interface PlcClient<Events extends PlcEvents = PlcEvents, T extends ItemTyping = AnyItems> {
  /** How the connection is now; the event `state` tells each change. */
  readonly state: ConnectionState
  /** Counters and round-trip times since the client was made. */
  readonly statistics: Statistics

  /**
   * Listens to an event; does not connect by itself, see `connect()`. @returns what ends it.
   * @throws RequestError BAD_OPTION when there is no such event; also when it could never come
   */
  on<E extends keyof Events>(event: E, listener: (event: Events[E]) => void): () => void
  /** As `on`, for the next event only. @returns what ends it before. @throws RequestError BAD_OPTION as `on` does */
  once<E extends keyof Events>(event: E, listener: (event: Events[E]) => void): () => void
  /** Ends what `on` or `once` began with this function. @throws RequestError BAD_OPTION when there is no such event */
  off<E extends keyof Events>(event: E, listener: (event: Events[E]) => void): void

  /** Connects now instead of at the first call. Resolves when the PLC has answered. */
  connect(options?: CallOptions): Promise<void>
  /** Ends the connection and every call under way. The client cannot be used again. */
  close(): Promise<void>
  /** `await using plc = createMelsecClient(...)`: `close()` at the end of the block. */
  [Symbol.asyncDispose](): Promise<void>

  /**
   * Reads one item: its value. An object with a text `address` is one item; to `readEach` and `readValues` it is many, of
   * which one is named address.
   * @throws PlcError what went wrong
   * @example await plc.read('D100:REAL')
   */
  read<const I extends Item>(item: I, options?: CallOptions): Promise<ValueIn<T, I>>
  /** Reads many items as `readEach`. @example const { level, start } = await plc.read({ level: 'D100:REAL', start: 'M0' }) */
  read<const L extends Items>(items: L, options?: CallOptions): Promise<ResultsIn<T, L>>
  /** Reads many items in few requests, with a result for each: one that cannot be read does not hide the others. */
  readEach<const L extends Items>(items: L, options?: CallOptions): Promise<ResultsIn<T, L>>
  /**
   * Reads many items in few requests and gives plain values.
   * @throws PlcError the first item's error when any item failed
   * @example const { level, temperature } = await plc.readValues({ level: 'D100:REAL', temperature: 'D102:REAL' })
   */
  readValues<const L extends Items>(items: L, options?: CallOptions): Promise<ValuesIn<T, L>>
  /**
   * The requests that read these items: to look at (`describe()`), and to run again and again without parsing.
   * Items that cannot be read keep their error as their result. Of items by name, the results are by name.
   * @example const { level } = await plc.plan({ level: 'D100:REAL', start: 'M0' }).run()
   */
  plan<const L extends Items>(items: L): ReadPlan<ResultsIn<T, L>>

  /**
   * Reads items again and again until the watch is closed, and tells what has changed: `for await`, or `onChange`. The first values
   * come at once. All watches of a client are read together: what is due at the same instant, by one plan, behind writes and other
   * reads.
   * @throws RequestError BAD_OPTION or BAD_ADDRESS; ClosedError when the client is closed
   * @example for await (const { values } of plc.watch({ level: 'D100:REAL' }, { every: 100 })) console.log(values.level.value)
   */
  watch<const L extends Items>(items: L, options: WatchOptions<WatchedIn<T, L>>): Watch<WatchedIn<T, L>>

  /**
   * Tags of a table by name, in the units people use. Nothing is sent for it.
   * @throws RequestError BAD_OPTION with one message for each row that is wrong for this PLC
   * @example await plc.tags(defineTags({ level: 'D100:REAL' })).read('level')
   */
  tags<const D extends TagDefinitions>(table: TagTable<D>, options?: TagsOptions): PlcTags<T, D>

  /** Writes many items as `writeValues`. @example await plc.write({ 'D200:REAL': 71.5, M10: true }) */
  write<const L extends readonly Item[], A extends string>(
    values: EntriesIn<T, L> | InputsIn<T, A>,
    options?: WriteCallOptions,
  ): Promise<void>
  /**
   * Writes one item. Needs `allowWrites`. When it resolves, it was written. A write of unknown outcome is never repeated.
   * @throws PlcError what went wrong
   * @example await plc.write('D200:REAL', 71.5)
   */
  write<const I extends Item>(item: I, value: InputIn<T, I>, options?: WriteCallOptions): Promise<void>
  /**
   * Writes many items, in their order. Needs `allowWrites`. When it resolves, everything was written. A write whose outcome
   * is unknown is never repeated.
   * @throws WriteError when anything was not written: its `results` say what became of each item
   * @example await plc.writeValues({ 'D200:REAL': 71.5, M10: true })
   */
  writeValues<const L extends readonly Item[], A extends string>(
    values: EntriesIn<T, L> | InputsIn<T, A>,
    options?: WriteCallOptions,
  ): Promise<void>
  /**
   * Writes many items as `writeValues` does, with a result for each instead of an error. Look at each of them.
   * @example const results = await plc.writeEach({ 'D200:REAL': 71.5, M10: true })
   */
  writeEach<const L extends readonly Item[]>(
    entries: EntriesIn<T, L>,
    options?: WriteCallOptions,
  ): Promise<WriteResult[]>
  /** The same of an object by address: the results by address. */
  writeEach<A extends string>(values: InputsIn<T, A>, options?: WriteCallOptions): Promise<Record<A, WriteResult>>
  /** The requests that write these values: to look at before they are run. */
  planWrite<const L extends readonly Item[]>(entries: EntriesIn<T, L>, options?: WriteOptions): WritePlan
}
