/** Random lives of a PLC and of programs that watch it: what is told is what was there, and everything is good again in the end. */
import { expect, test } from '@jest/globals'
import fc from 'fast-check'
import type { WatchUpdate } from '../../../src/index'
import { refusal, WatchBench } from './bench'

const ITEMS = ['D0', 'D1', 'D2', 'D3', 'D4', 'D5'] as const
const RATES = [50, 130, 1000]

const item = fc.constantFrom(...ITEMS)
const event = fc.oneof(
  fc.record({ kind: fc.constant('pass' as const), ms: fc.integer({ min: 0, max: 3000 }) }),
  fc.record({ kind: fc.constant('pass' as const), ms: fc.integer({ min: 0, max: 60_000 }) }),
  fc.record({ kind: fc.constant('value' as const), item }),
  fc.record({ kind: fc.constant('refuse' as const), item, on: fc.boolean() }),
  fc.record({ kind: fc.constant('silent' as const), on: fc.boolean() }),
  fc.record({ kind: fc.constant('slow' as const), ms: fc.constantFrom(0, 0, 20, 400, 4000) }),
  fc.record({ kind: fc.constant('state' as const), name: fc.constantFrom('connected' as const, 'waiting' as const) }),
  fc.record({ kind: fc.constant('reopen' as const), rate: fc.nat(RATES.length - 1) }),
)
type Event = typeof event extends fc.Arbitrary<infer E> ? E : never

/** Values that never come again, each with the item it is of. */
class World {
  readonly bench = new WatchBench()
  /** When each value was there, ms since 1970. */
  readonly history = new Map<unknown, { readonly item: string; readonly from: number; to: number }>()
  readonly watches = RATES.map((_rate, at) => this.open(at))
  readonly problems: string[] = []
  #next = 1

  constructor() {
    for (const name of ITEMS) this.set(name)
  }

  set(name: string): void {
    const now = this.bench.clock.time()
    const before = this.history.get(this.bench.values.get(name))
    if (before !== undefined) before.to = now
    this.bench.values.set(name, this.#next)
    this.history.set(this.#next, { item: name, from: now, to: Number.POSITIVE_INFINITY })
    this.#next += 1
  }

  open(at: number) {
    const names = ITEMS.slice(at, at + 4)
    const items = Object.fromEntries(names.map((name) => [`of ${name}`, name]))
    const onChange = (update: WatchUpdate) => this.judge(update)
    return this.bench.watching.open(items, { every: RATES[at], onChange })
  }

  judge({ values }: WatchUpdate): void {
    for (const [name, { quality, value, timestamp, stale }] of Object.entries(values)) {
      if (value === undefined) continue
      const was = this.history.get(value)
      if (`of ${was?.item}` !== name) this.problems.push(`${name} has a value of ${was?.item}`)
      if (was === undefined || timestamp === undefined || timestamp < was.from || timestamp > was.to) {
        this.problems.push(`${name}: ${value} was not there at ${timestamp}`)
      }
      if (quality === 'good' && stale) this.problems.push(`${name} is good and stale`)
    }
  }

  async live(event: Event): Promise<void> {
    const { bench } = this
    switch (event.kind) {
      case 'pass':
        return bench.pass(event.ms)
      case 'value':
        return this.set(event.item)
      case 'refuse':
        if (event.on) bench.refused.set(event.item, refusal())
        else bench.refused.delete(event.item)
        return
      case 'silent':
        bench.silent = event.on
        return
      case 'slow':
        bench.takes = () => event.ms
        return
      case 'state':
        return bench.state(event.name, 1)
      case 'reopen':
        await this.watches[event.rate]?.close()
        this.watches[event.rate] = this.open(event.rate)
    }
  }
}

test('whatever happens, values are those of their items and times, and good and new when all is well again', async () => {
  const property = fc.asyncProperty(fc.array(event, { maxLength: 40 }), async (events) => {
    const world = new World()
    const { bench } = world
    for (const event of events) await world.live(event)
    bench.silent = false
    bench.refused.clear()
    bench.takes = () => 0
    // Longer than the longest pauses of PLC and items together.
    await bench.pass(75_000)
    for (const name of ITEMS) world.set(name)
    await bench.pass(2100)
    for (const watch of world.watches) {
      for (const [name, value] of Object.entries(watch.values)) {
        expect(value).toMatchObject({ quality: 'good', stale: false, value: bench.values.get(name.slice(3)) })
      }
    }
    expect(world.problems).toEqual([])
    bench.watching.close()
    expect(bench.clock.pending).toBe(0)
  })
  await fc.assert(property, { numRuns: 40 })
}, 60_000)
