// Watching, as users see it.
import type { Deadband } from '../../tags/table/tag'
import type { WatchedValue } from './watched-value'

/** How a watch calls its items: by their names, or of a list by their places. */
export type WatchedName<V> = V extends readonly unknown[] ? number : keyof V & string

/** What is watched and how. `V`: the watched values. */
export interface WatchOptions<V = Readonly<Record<string, WatchedValue>>> {
  /** ms between two scans, a whole number. They begin at fixed instants: nothing drifts. */
  readonly every: number
  /**
   * Is told each update, instead of a loop over the watch. While a promise that it returns is pending, updates are merged into
   * one. What it throws is a warning of the process.
   */
  readonly onChange?: (update: WatchUpdate<V>) => unknown
  /** How far a number may move before it counts as changed: of all items, or by their names. Default: any difference. */
  readonly deadband?: Deadband | { readonly [N in WatchedName<V>]?: Deadband }
  /** `changes`: an update when something has changed (default). `scans`: one for each scan. */
  readonly tell?: 'changes' | 'scans'
  /** ms after which an update comes also when nothing has changed, so that silence means that something is wrong. */
  readonly heartbeat?: number
  /** ms without a scan after which values are `uncertain`. Default: three times `every`, at least 1000. */
  readonly staleAfter?: number
  /** Refusals of an item in a row after which it is tried rarely, so that it costs the others no requests. Default 3. */
  readonly demoteAfter?: number
  /** ms between two attempts of an item that is tried rarely, at most; they begin with 1000 and double. Default 30000. */
  readonly probeEvery?: number
  /** Ends the watch. */
  readonly signal?: AbortSignal
}

/** A time in which the PLC could not be read: what it did then is not known. */
export interface WatchGap {
  /** The last scan before, ms since 1970. */
  readonly from: number
  /** The first scan after it, ms since 1970. */
  readonly to: number
  /** Scans that were not read. */
  readonly scans: number
}

/** What became of the watched items since the update before. */
export interface WatchUpdate<V = Readonly<Record<string, WatchedValue>>> {
  /** All values as they are now, by the names of their items or in their order. */
  readonly values: V
  /** Whose value or quality has changed: names, or of a list places. The first update has all of them. */
  readonly changed: readonly WatchedName<V>[]
  /** Scans that were skipped because the one before had not ended, or the program stood still. */
  readonly late: number
  /** Updates that nobody took in time: they are merged into this one, which has the latest values. */
  readonly merged: number
  /** The PLC could not be read in between. */
  readonly gap?: WatchGap
  /** Items that are tried rarely now, because they fail; all of them when the PLC does not answer. */
  readonly demoted: readonly WatchedName<V>[]
}

/** What a watch has done so far. */
export interface WatchStatistics {
  /** Scans that have ended, also those that read nothing. */
  readonly scans: number
  /** Scans that were skipped because the one before had not ended, or the program stood still. */
  readonly late: number
  /** Scans that read nothing, because the PLC did not answer or was not asked. */
  readonly unread: number
  /** Updates that were merged into the next, because nobody took them in time. */
  readonly merged: number
  /** ms that the last scan took; undefined before the first. */
  readonly duration: number | undefined
}

/**
 * Items that are read again and again until `close()`, the signal, the end of the loop or of the client.
 * @example for await (const { values, changed } of plc.watch({ level: 'D100:REAL' }, { every: 100 })) console.log(values.level)
 */
export interface Watch<V = Readonly<Record<string, WatchedValue>>> {
  /** All values as they are now. */
  readonly values: V
  /** Counters since it was opened. */
  readonly statistics: WatchStatistics
  /** Whether it has ended. */
  readonly isClosed: boolean
  /** The next update. A loop that is slow gets the latest values, and how many updates were merged into one. */
  next(): Promise<IteratorResult<WatchUpdate<V>, undefined>>
  /** Leaving the loop ends the watch. */
  return(): Promise<IteratorResult<WatchUpdate<V>, undefined>>
  /** @throws RequestError BAD_OPTION when updates go to `onChange`: each goes to one place. Another watch costs no requests. */
  [Symbol.asyncIterator](): Watch<V>
  /** Ends it: nothing is read for it any more, and loops end. */
  close(): Promise<void>
  /** `await using watch = plc.watch(...)`: `close()` at the end of the block. */
  [Symbol.asyncDispose](): Promise<void>
}
