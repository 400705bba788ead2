/** Many callers at once while everything goes wrong at random: no wrong value, no write twice, nothing that hangs. */
import { expect, test } from '@jest/globals'
import type { Fault, PlcSimulator } from '../../src/entry/simulator'
import { type CallOptions, type MelsecClient, type Monitor, PlcError, type ReadResult } from '../../src/index'
import { openHandles } from '../transport/recorder'
import { nextState, until, withLine } from './line'

const CALLS = 800
const CALLERS = 20
const TAGS = 10

/** The same numbers for the same seed, so that a failure can be seen again. */
function randomOf(seed: number): () => number {
  let state = seed
  return () => {
    state = (state + 0x6d2b79f5) | 0
    let t = Math.imul(state ^ (state >>> 15), 1 | state)
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296
  }
}

/** Answers that could be taken for another request's. */
const misleading: readonly Fault[] = [
  { kind: 'late' },
  { kind: 'late', until: 'answer' },
  { kind: 'duplicate' },
  { kind: 'duplicate', copies: 3 },
  { kind: 'merge' },
]

const faults: readonly Fault[] = [
  ...misleading,
  ...misleading,
  ...misleading,
  { kind: 'silence' },
  { kind: 'drop' },
  { kind: 'delay', ms: 10 },
  { kind: 'delay', ms: 200 },
  { kind: 'split', at: 7 },
  { kind: 'split', at: 12 },
  { kind: 'dribble', size: 3 },
  { kind: 'cut', at: 10 },
  { kind: 'disconnect', at: 5 },
  { kind: 'disconnect', how: 'close' },
  { kind: 'garbage' },
  { kind: 'garbage', place: 'after' },
  // Not the number of a request that is under way at the same time: no client could see that.
  { kind: 'wrongSerial', add: 0x1000 },
  { kind: 'wrongRoute' },
  { kind: 'endCode', endCode: 0x4031 },
  { kind: 'endCode', endCode: 0xc051 },
  { kind: 'endCode', endCode: 0xcf00 },
  { kind: 'shortError', bytes: 2 },
  { kind: 'coalesce' },
  { kind: 'closeOnAccept' },
]

/** A plant whose values count up with every request: each value tells which tag it is and when it was true. */
class Plant {
  now = 0
  readonly written = new Map<string, number>()

  constructor(plc: PlcSimulator, random: () => number) {
    this.#set(plc)
    plc.on('request', () => {
      this.now++
      this.#set(plc)
      if (plc.faults.active.length > 2) plc.faults.clear()
      const fault = faults[Math.floor(random() * faults.length)]
      if (random() < 0.1 && fault !== undefined) plc.faults.add({ ...fault, times: 1 })
      if (random() < 0.002) plc.restart(5)
    })
    plc.on('write', ({ message }) => {
      const { head, values } = message as { head: { number: number }; values: number[] }
      const key = `${head.number} ${values.join(' ')}`
      this.written.set(key, (this.written.get(key) ?? 0) + 1)
    })
  }

  #set(plc: PlcSimulator): void {
    for (let tag = 0; tag < TAGS; tag++) plc.write(itemOf(tag), valueOfTag(tag, this.now))
    plc.write('K8M32:DWORD', this.now)
  }
}

const itemOf = (tag: number) => `D${tag * 10}:LINT`
/** The time is in it twice, so that a value put together from two moments shows. */
const valueOfTag = (tag: number, time: number) => (BigInt(tag) << 48n) | (BigInt(time) << 24n) | BigInt(time)

function expectTrue(value: unknown, item: string, from: number, to: number): void {
  const bits = typeof value === 'bigint' ? value : -1n
  const time = item.startsWith('K') ? Number(value) : Number(bits & 0xffffffn)
  if (!item.startsWith('K'))
    expect([item, value]).toEqual([item, valueOfTag(Number.parseInt(item.slice(1), 10) / 10, time)])
  if (time < from || time > to) throw new Error(`${item} is of ${time}, asked at ${from}, answered at ${to}`)
}

class Caller {
  #sequence = 0
  readonly counts = { read: 0, failed: 0, written: 0 }

  constructor(
    readonly id: number,
    readonly client: MelsecClient,
    readonly plant: Plant,
    readonly monitor: Monitor,
    readonly random: () => number,
  ) {}

  async call(): Promise<void> {
    const kind = this.random()
    const options = this.#options()
    if (kind < 0.35) await this.#read(options)
    else if (kind < 0.6) await this.#readList(options)
    else if (kind < 0.75) await this.#readMonitor(options)
    else if (kind < 0.95) await this.#write(options)
    else await this.#settled(() => this.client.selfTest('ABCDEF', options))
    if (this.client.state.name === 'waiting') await nextState(this.client, 'connected')
  }

  #options(): CallOptions {
    const kind = this.random()
    if (kind < 0.04) return { timeout: 1 + this.random() * 20 }
    if (kind > 0.08) return {}
    const controller = new AbortController()
    setImmediate(() => controller.abort())
    return { signal: controller.signal }
  }

  #tag(): number {
    return Math.floor(this.random() * TAGS)
  }

  /** Every failure is one of ours. */
  async #settled<T>(run: () => Promise<T>): Promise<T | undefined> {
    try {
      return await run()
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      this.counts.failed++
      return undefined
    }
  }

  async #read(options: CallOptions): Promise<void> {
    const item = this.random() < 0.2 ? 'K8M32:DWORD' : itemOf(this.#tag())
    const from = this.plant.now
    const value = await this.#settled(() => this.client.read(item, options))
    if (value === undefined) return
    expectTrue(value, item, from, this.plant.now)
    this.counts.read++
  }

  async #readList(options: CallOptions): Promise<void> {
    const items = Array.from({ length: 1 + this.#tag() }, () => itemOf(this.#tag()))
    const from = this.plant.now
    this.#check(await this.client.read([...items, 'K8M32:DWORD'], options), from)
  }

  async #readMonitor(options: CallOptions): Promise<void> {
    const from = this.plant.now
    this.#check(await this.monitor.read(options), from)
  }

  #check(results: readonly ReadResult[], from: number): void {
    for (const result of results) {
      if (result.ok) {
        expectTrue(result.value, result.item, from, this.plant.now)
        this.counts.read++
      } else {
        expect(result.error).toBeInstanceOf(PlcError)
        this.counts.failed++
      }
    }
  }

  async #write(options: CallOptions): Promise<void> {
    const number = 2000 + this.id
    const value = ++this.#sequence
    const outcome = await this.client.write(`D${number}`, value, options).then(
      () => 'done',
      (error: unknown) => (error instanceof PlcError ? error.outcome : Promise.reject(error)),
    )
    const times = this.plant.written.get(`${number} ${value}`) ?? 0
    if (outcome === 'done') this.counts.written++
    // A request that is still on its way may be carried out after its caller was told that nobody knows.
    const right = outcome === 'done' ? times === 1 : outcome === 'unknown' ? times <= 1 : times === 0
    if (!right) throw new Error(`D${number} := ${value} was applied ${times} times and is reported as ${outcome}`)
  }
}

test.each([
  ['tcp 3E binary iq-r', 1, 11],
  ['tcp 4E ascii iq-r', 1, 12],
  ['udp 3E binary iq-r', 1, 13],
  ['udp 4E binary iq-r', 8, 14],
] as const)(
  'over %s, %i in flight, seed %i',
  async (text, inFlight, seed) => {
    const handles = openHandles().length
    const random = randomOf(seed)
    const plcOptions = { latch: ['D', 'M'] } as const
    const options = { inFlight, timeout: 120, connectTimeout: 400, reconnect: { first: 1, longest: 10 } }
    await withLine(text, { plc: plcOptions, client: options }, async ({ plc, client }) => {
      await client.connect()
      const plant = new Plant(plc, random)
      const monitors = [0, 1, 2].map((first) => client.monitor([0, 3, 6].map((tag) => itemOf((first + tag) % TAGS))))
      const callers = Array.from(
        { length: CALLERS },
        (_, id) => new Caller(id, client, plant, monitors[id % 3] as Monitor, random),
      )
      let left = CALLS
      await Promise.all(
        callers.map(async (caller) => {
          while (left-- > 0) await caller.call()
        }),
      )
      plc.faults.clear()
      for (const [write, times] of plant.written) expect([write, times]).toEqual([write, 1])
      const sum = (name: 'read' | 'failed' | 'written') => callers.reduce((all, { counts }) => all + counts[name], 0)
      // Enough went well, and enough went wrong, for the test to mean something.
      expect(sum('read')).toBeGreaterThan(CALLS / 20)
      expect(sum('failed')).toBeGreaterThan(CALLS / 40)
      expect(sum('written')).toBeGreaterThan(CALLS / 40)
      expect(client.statistics).toMatchObject({ queued: 0, inFlight: 0 })
    })
    await until(() => openHandles().length <= handles)
  },
  60_000,
)
