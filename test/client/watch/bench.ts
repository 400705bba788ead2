/** Watches over a PLC made of a table, with time as numbers. */
import type { CallOptions } from '../../../src/client/connection/call'
import type { ConnectionState } from '../../../src/client/connection/connection-options'
import { Watching } from '../../../src/client/watch/watching'
import type { Watch, WatchedValue, WatchOptions, WatchUpdate } from '../../../src/index'
import {
  EndCodeError,
  type Item,
  type Items,
  type PlcError,
  type ReadResult,
  type ReadValue,
  TimeoutError,
} from '../../../src/index'
import { manualClock } from '../../support/manual-clock'

type Values = Readonly<Record<string, WatchedValue>>

/** As the PLC refuses an item that it does not have. */
export function refusal(about: 'item' | 'state' = 'item'): EndCodeError {
  return new EndCodeError(0x4031, 'Read (0401): end code 4031H.', {
    about,
    family: 'slmp',
    command: 'readWords',
  } as never)
}

export function silence(): TimeoutError {
  return new TimeoutError('Read (0401) got no answer.', 'unknown', [])
}

export class WatchBench {
  readonly clock = manualClock(1000)
  readonly values = new Map<Item, ReadValue>()
  readonly refused = new Map<Item, PlcError>()
  readonly torn = new Set<Item>()
  /** The PLC does not answer anybody. */
  silent = false
  /** ms of a scan. */
  takes: (items: readonly Item[]) => number = () => 0
  /** What was read, at which time. */
  readonly reads: {
    readonly at: number
    readonly items: readonly Item[]
    readonly options: CallOptions | undefined
  }[] = []
  readonly watching = new Watching({ plan: (items) => ({ run: (options) => this.#run(items, options) }) }, this.clock)

  async #run(items: readonly Item[], options: CallOptions | undefined): Promise<ReadResult[]> {
    this.reads.push({ at: this.clock.now() - 1000, items, options })
    const ms = this.takes(items)
    if (ms > 0) await new Promise<void>((resolve) => this.clock.timer(ms, resolve))
    return items.map((item) => this.#result(item))
  }

  #result(item: Item): ReadResult {
    const text = typeof item === 'string' ? item : item.address
    const timestamp = this.clock.time()
    const error = this.silent ? silence() : this.refused.get(item)
    if (error !== undefined) return { item: text, ok: false, error, timestamp }
    const value = this.values.get(item) ?? 0
    return { item: text, ok: true, value, timestamp, ...(this.torn.has(item) ? { torn: true as const } : {}) }
  }

  /** A watch whose updates are collected. */
  watch(
    items: Items,
    options: Omit<WatchOptions<Values>, 'onChange'>,
  ): { watch: Watch<Values>; updates: WatchUpdate<Values>[] } {
    const updates: WatchUpdate<Values>[] = []
    const onChange = (update: WatchUpdate<Values>) => void updates.push(update)
    const watch = this.watching.open(items, { ...options, onChange }) as unknown as Watch<Values>
    return { watch, updates }
  }

  /** A watch without a listener, for a loop. */
  loop(items: Items, options: WatchOptions<Values>): Watch<Values> {
    return this.watching.open(items, options) as unknown as Watch<Values>
  }

  pass(ms: number): Promise<void> {
    return this.clock.advanceAsync(ms)
  }

  state(name: 'connected' | 'waiting', attempt = 0): void {
    this.watching.stateChanged({ name, attempt, since: this.clock.time(), error: silence() } as ConnectionState)
  }

  /** Instants of reading since the last call, ms since the beginning. */
  takeReads(): (readonly [at: number, items: string])[] {
    return this.reads.splice(0).map(({ at, items }) => [at, items.join(' ')])
  }
}
