/** What a watch reads and tells, over a PLC made of a table, with time as numbers. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { RequestError } from '../../../src/index'
import { refusal, WatchBench } from './bench'

const HOUR = 3_600_000

describe('what is read', () => {
  test('comes at once, then at the instants of the rate, behind writes and other reads', async () => {
    const bench = new WatchBench()
    const { updates } = bench.watch({ level: 'D100' }, { every: 100 })
    await bench.pass(0)
    expect(updates).toMatchObject([{ changed: ['level'], values: { level: { quality: 'good', value: 0 } } }])
    await bench.pass(250)
    expect(bench.reads.every(({ options }) => options?.priority === 'poll')).toBe(true)
    expect(bench.takeReads()).toEqual([
      [0, 'D100'],
      [100, 'D100'],
      [200, 'D100'],
    ])
  })

  test('of several watches is read together when it is due together, each item once', async () => {
    const bench = new WatchBench()
    bench.watch({ a: 'D1', b: 'D2' }, { every: 100 })
    bench.watch(['D2', 'D3'], { every: 200 })
    await bench.pass(450)
    expect(bench.takeReads()).toEqual([
      [0, 'D1 D2 D3'],
      [100, 'D1 D2'],
      [200, 'D1 D2 D3'],
      [300, 'D1 D2'],
      [400, 'D1 D2 D3'],
    ])
  })

  test('costs no more reads at four rates than at the fastest alone, for ten hours', async () => {
    const bench = new WatchBench()
    for (const every of [1000, 2000, 5000, 10_000]) {
      bench.watch({ a: `D${every}` }, { every })
      await bench.pass(130)
    }
    await bench.pass(60_000)
    bench.takeReads()
    await bench.pass(10 * HOUR)
    expect(bench.takeReads()).toHaveLength(36_000)
  })

  test('is read apart where a slow set would make the fast one late', async () => {
    const bench = new WatchBench()
    const fast = bench.watch({ a: 'D1' }, { every: 100 })
    bench.watch({ b: 'D2', c: 'D3' }, { every: 1000 })
    bench.takes = (items) => (items.includes('D2') ? 350 : 20)
    await bench.pass(10_000)
    // Once together: that taught how long it takes.
    expect(fast.watch.statistics.late).toBe(3)
    bench.takeReads()
    await bench.pass(1000)
    expect(bench.takeReads().filter(([at]) => at % 1000 === 0)).toEqual([
      [11_000, 'D1'],
      [11_000, 'D2 D3'],
    ])
  })

  test('is skipped and counted when the scan before has not ended', async () => {
    const bench = new WatchBench()
    const { watch, updates } = bench.watch({ a: 'D1' }, { every: 100, tell: 'scans' })
    bench.takes = () => 250
    await bench.pass(1000)
    expect(bench.takeReads().map(([at]) => at)).toEqual([0, 300, 600, 900])
    expect(updates.map(({ late }) => late)).toEqual([0, 2, 2])
    expect(watch.statistics).toMatchObject({ scans: 3, late: 6, duration: 250 })
  })

  test('goes on at its instants when the clock of the computer is set; time stamps follow the clock', async () => {
    const bench = new WatchBench()
    const { updates } = bench.watch({ a: 'D1' }, { every: 100, tell: 'scans' })
    await bench.pass(150)
    bench.clock.setTime(5)
    await bench.pass(100)
    expect(bench.takeReads().map(([at]) => at)).toEqual([0, 100, 200])
    expect(updates[2]?.values.a?.timestamp).toBe(55)
    expect(updates[2]?.late).toBe(0)
  })
})

describe('what is told', () => {
  test('is what has changed, with all values; nothing when nothing has', async () => {
    const bench = new WatchBench()
    const { updates } = bench.watch({ a: 'D1', b: 'D2', c: 'D3:REAL' }, { every: 100 })
    bench.values.set('D3:REAL', Number.NaN)
    await bench.pass(350)
    expect(updates).toHaveLength(1)
    const before = updates[0]?.values.a
    bench.values.set('D2', 7)
    await bench.pass(200)
    expect(updates.slice(1)).toMatchObject([{ changed: ['b'], values: { a: { value: 0 }, b: { value: 7 } } }])
    const { a, b } = updates[1]?.values ?? {}
    expect([a?.changedAt, b?.changedAt]).toEqual([before?.changedAt, b?.timestamp])
    expect(a?.timestamp).toBe(b?.timestamp)
  })

  test('of no items at all is that there are none', async () => {
    const bench = new WatchBench()
    const { updates } = bench.watch({}, { every: 100 })
    await bench.pass(500)
    expect([updates, bench.reads]).toEqual([[{ values: {}, changed: [], late: 0, merged: 0, demoted: [] }], []])
  })

  test('has places instead of names for a list', async () => {
    const bench = new WatchBench()
    const watch = bench.watching.open(['D1', 'D2'], { every: 100 })
    await bench.pass(0)
    await watch.next()
    bench.values.set('D2', 7)
    await bench.pass(100)
    expect((await watch.next()).value).toMatchObject({ changed: [1], values: [{ value: 0 }, { value: 7 }] })
  })

  test('comes with each scan when it is asked for, and as heartbeat when nothing changes', async () => {
    const bench = new WatchBench()
    const each = bench.watch({ a: 'D1' }, { every: 100, tell: 'scans' })
    const beating = bench.watch({ a: 'D1' }, { every: 100, heartbeat: 300 })
    await bench.pass(950)
    expect(each.updates.map(({ changed }) => changed.length)).toEqual([1, 0, 0, 0, 0, 0, 0, 0, 0, 0])
    expect(beating.updates.map(({ changed }) => changed.length)).toEqual([1, 0, 0, 0])
  })

  test('is not of what moves less than the deadband; drift adds up until it exceeds it', async () => {
    const bench = new WatchBench()
    const { updates } = bench.watch(
      { a: 'D1', b: 'D2', c: 'D3' },
      { every: 100, deadband: { a: { kind: 'absolute', value: 2 }, b: { kind: 'percent', value: 10, of: [0, 50] } } },
    )
    for (let i = 0; i < 10; i++) {
      for (const item of ['D1', 'D2']) bench.values.set(item, i)
      await bench.pass(100)
    }
    const of = (name: string) =>
      updates.filter(({ changed }) => changed.includes(name)).map(({ values }) => values[name]?.value)
    expect([of('a'), of('b'), of('c')]).toEqual([[0, 3, 6, 9], [0, 6], [0]])
  })

  test('has every change that exceeds the deadband since what was taken, whenever somebody takes it', async () => {
    const scan = fc.record({ value: fc.integer({ min: -10, max: 10 }), failed: fc.boolean(), taken: fc.boolean() })
    const property = fc.asyncProperty(
      fc.array(scan, { maxLength: 40 }),
      fc.integer({ min: 0, max: 5 }),
      async (scans, reach) => {
        const bench = new WatchBench()
        const watch = bench.loop(
          { a: 'D1' },
          { every: 100, deadband: { kind: 'absolute', value: reach }, tell: 'scans', demoteAfter: 1000 },
        )
        let told: unknown
        for (const { value, failed, taken } of scans) {
          bench.values.set('D1', value)
          if (failed) bench.refused.set('D1', refusal())
          else bench.refused.delete('D1')
          await bench.pass(100)
          if (!taken) continue
          const { value: update } = await watch.next()
          const now = update?.values.a?.value
          if (update?.changed.includes('a') === true) told = now
          expect(told === now || Math.abs(Number(told) - Number(now)) <= reach).toBe(true)
        }
      },
    )
    await fc.assert(property, { numRuns: 60 })
  })

  test.each([
    ['numbers that are none', [Number.NaN, Number.NaN, 0, -0], 2],
    ['numbers of 64 bits', [2n ** 63n, 2n ** 63n, 2n ** 63n + 1n], 2],
    ['arrays', [[1, 2], [1, 2], [1, 3], [1]], 3],
    [
      'typed arrays',
      [new Float32Array([1, Number.NaN]), new Float32Array([1, Number.NaN]), new Float32Array([2, Number.NaN])],
      2,
    ],
    ['texts and bits', ['a', 'a', 'b', true, true, false], 4],
  ])('compares %s by what they are', async (_what, values, changes) => {
    const bench = new WatchBench()
    const { updates } = bench.watch({ a: 'D1' }, { every: 100 })
    for (const value of values) {
      bench.values.set('D1', value as never)
      await bench.pass(100)
    }
    expect(updates).toHaveLength(changes)
  })

  test('says uncertain of an array that several requests have read', async () => {
    const bench = new WatchBench()
    bench.values.set('D0[2000]', [1, 2])
    bench.torn.add('D0[2000]')
    const { updates } = bench.watch({ a: 'D0[2000]' }, { every: 100 })
    await bench.pass(300)
    expect(updates).toHaveLength(1)
    expect(updates[0]?.values.a).toMatchObject({ quality: 'uncertain', value: [1, 2], stale: false })
    expect(updates[0]?.values.a?.reason).toMatch(/several requests/)
  })

  test('to a loop that is slow is the latest, with how many were merged: nothing piles up', async () => {
    const bench = new WatchBench()
    const watch = bench.loop({ a: 'D1', b: 'D2' }, { every: 100, deadband: { kind: 'absolute', value: 2 } })
    await bench.pass(0)
    expect((await watch.next()).value?.changed).toEqual(['a', 'b'])
    for (const value of [10, 20, 30, 29]) {
      bench.values.set('D1', value)
      await bench.pass(100)
    }
    expect((await watch.next()).value).toMatchObject({ changed: ['a'], merged: 2, values: { a: { value: 29 } } })
    expect(watch.statistics.merged).toBe(2)
    // Measured from what was taken, not from what was never seen.
    bench.values.set('D1', 32)
    await bench.pass(100)
    expect((await watch.next()).value).toMatchObject({ changed: ['a'], merged: 0, values: { a: { value: 32 } } })
  })

  test('to a listener that takes its time is the latest, too', async () => {
    const bench = new WatchBench()
    const seen: unknown[] = []
    let end = () => {}
    const onChange = ({ values, merged }: { values: Readonly<Record<string, { value: unknown }>>; merged: number }) => {
      seen.push([values.a?.value, merged])
      return new Promise<void>((resolve) => {
        end = resolve
      })
    }
    bench.watching.open({ a: 'D1' }, { every: 100, onChange })
    for (const value of [1, 2, 3, 4]) {
      bench.values.set('D1', value)
      await bench.pass(100)
    }
    end()
    await bench.pass(50)
    expect(seen).toEqual([
      [1, 0],
      [4, 2],
    ])
  })
})

describe('an item that fails', () => {
  test('is bad and leaves the others alone; its last value stays, with its time', async () => {
    const bench = new WatchBench()
    const { updates } = bench.watch({ good: 'D1', failing: 'D2' }, { every: 100 })
    bench.values.set('D2', 5)
    await bench.pass(50)
    const { timestamp } = updates[0]?.values.failing ?? {}
    bench.refused.set('D2', refusal())
    bench.values.set('D1', 1)
    await bench.pass(100)
    expect(updates[1]).toMatchObject({
      changed: ['good', 'failing'],
      values: {
        good: { quality: 'good', value: 1 },
        failing: { quality: 'bad', value: 5, timestamp, stale: true, error: { code: 'END_CODE' } },
      },
    })
    bench.refused.delete('D2')
    await bench.pass(100)
    expect(updates[2]).toMatchObject({ changed: ['failing'], values: { failing: { quality: 'good', value: 5 } } })
  })

  test('is tried rarely after three refusals, alone, and tells both', async () => {
    const bench = new WatchBench()
    const { updates } = bench.watch({ good: 'D1', failing: 'D2' }, { every: 100, probeEvery: 4000 })
    bench.refused.set('D2', refusal())
    await bench.pass(250)
    expect(updates.map(({ demoted }) => demoted)).toEqual([[], ['failing']])
    expect(bench.takeReads().map(([, items]) => items)).toEqual(['D1 D2', 'D1 D2', 'D1 D2'])
    await bench.pass(20_000)
    const tried = bench.takeReads().filter(([, items]) => items !== 'D1')
    expect(tried).toEqual([1200, 3200, 7200, 11_200, 15_200, 19_200].map((at) => [at, 'D2']))
    bench.refused.delete('D2')
    await bench.pass(4000)
    expect(updates.at(-1)).toMatchObject({
      changed: ['failing'],
      demoted: [],
      values: { failing: { quality: 'good' } },
    })
    bench.takeReads()
    await bench.pass(100)
    expect(bench.takeReads().map(([, items]) => items)).toEqual(['D1 D2'])
  })

  test('of a thousand others that fail, too, is tried with three more at most in one scan', async () => {
    const bench = new WatchBench()
    const items = Array.from({ length: 1000 }, (_, i) => `D${i}`)
    for (const item of items) bench.refused.set(item, refusal())
    bench.watch(items, { every: 100, demoteAfter: 1, probeEvery: 1000 })
    await bench.pass(50)
    bench.takeReads()
    await bench.pass(10_000)
    const perScan = new Map<number, number>()
    for (const [at] of bench.takeReads()) perScan.set(at, (perScan.get(at) ?? 0) + 1)
    expect(Math.max(...perScan.values())).toBe(4)
  })

  test('because of the state of the PLC is not the item to blame', async () => {
    const bench = new WatchBench()
    const { updates } = bench.watch({ a: 'D1' }, { every: 100 })
    bench.refused.set('D1', refusal('state'))
    await bench.pass(1050)
    expect(updates).toMatchObject([{ changed: ['a'], demoted: [], values: { a: { quality: 'bad' } } }])
    expect(bench.takeReads()).toHaveLength(11)
  })

  test('and never leaves this computer is told, named as the program calls it', async () => {
    const bench = new WatchBench()
    bench.refused.set('nonsense', new RequestError('BAD_ADDRESS', 'nonsense: there is no such device.', 'nonsense'))
    const { updates } = bench.watch({ good: 'D1', wrong: 'nonsense' }, { every: 100 })
    await bench.pass(1000)
    expect(updates).toMatchObject([
      { demoted: [], values: { good: { quality: 'good' }, wrong: { quality: 'bad', value: undefined } } },
    ])
    expect(updates[0]?.values.wrong?.reason).toMatch(/^wrong \(nonsense\): /)
  })
})

describe('a PLC that does not answer', () => {
  test('is tried rarely after three scans, by one item; what was missed is told and not invented', async () => {
    const bench = new WatchBench()
    const { updates, watch } = bench.watch({ a: 'D1', b: 'D2' }, { every: 100 })
    bench.values.set('D1', 5)
    await bench.pass(950)
    const lastRead = bench.clock.time() - 50
    bench.silent = true
    await bench.pass(300)
    bench.takeReads()
    expect(updates.slice(1)).toMatchObject([
      { changed: ['a', 'b'], demoted: [], values: { a: { quality: 'bad', value: 5, stale: true } } },
      { changed: [], demoted: ['a', 'b'] },
    ])
    await bench.pass(10_000)
    expect(bench.takeReads()).toEqual([2200, 4200, 8200].map((at) => [at, 'D1']))
    bench.silent = false
    bench.values.set('D1', 6)
    await bench.pass(8000)
    expect(bench.takeReads().slice(0, 3)).toEqual([
      [16_200, 'D1'],
      [16_200, 'D1 D2'],
      [16_300, 'D1 D2'],
    ])
    const [back, first] = updates.slice(3)
    expect(back).toMatchObject({ changed: [], demoted: [] })
    expect(first).toMatchObject({
      changed: ['a', 'b'],
      late: 0,
      gap: { from: lastRead, to: lastRead + 15_300, scans: 3 + 150 },
      values: { a: { quality: 'good', value: 6 }, b: { quality: 'good', value: 0 } },
    })
    expect(first?.values.b?.changedAt).toBe(updates[0]?.values.b?.changedAt)
    expect(watch.statistics.late).toBe(0)
  })

  test('is read at once when the connection is back, also what is read once a minute', async () => {
    const bench = new WatchBench()
    const { updates } = bench.watch({ a: 'D1' }, { every: 60_000 })
    await bench.pass(1000)
    bench.silent = true
    bench.state('waiting', 1)
    await bench.pass(10)
    expect(updates.at(-1)?.values.a).toMatchObject({ quality: 'bad', value: 0 })
    bench.silent = false
    bench.state('connected')
    await bench.pass(10)
    expect(updates.at(-1)?.values.a).toMatchObject({ quality: 'good', value: 0 })
    expect(bench.takeReads().map(([at]) => at)).toEqual([0, 1000, 1010])
  })

  test('is one silence to the scans of many rates that wait for it', async () => {
    const bench = new WatchBench()
    for (let every = 100; every < 120; every++) bench.watch({ a: `D${every}` }, { every })
    await bench.pass(5000)
    bench.silent = true
    bench.takes = () => 3000
    await bench.pass(3200)
    bench.takes = () => 0
    await bench.pass(200)
    bench.takeReads()
    await bench.pass(3000)
    expect(bench.takeReads().map(([, items]) => items)).toEqual(['D100', 'D100'])
  })

  test('for longer than staleAfter leaves nothing looking good, though its scan has not ended', async () => {
    const bench = new WatchBench()
    const { updates } = bench.watch({ a: 'D1' }, { every: 100, staleAfter: 500 })
    await bench.pass(50)
    bench.takes = () => 5000
    await bench.pass(1000)
    expect(updates.at(-1)).toMatchObject({
      changed: ['a'],
      values: { a: { quality: 'uncertain', value: 0, stale: true } },
    })
    await bench.pass(4200)
    expect(updates.at(-1)).toMatchObject({ changed: ['a'], values: { a: { quality: 'good', stale: false } } })
  })

  test('for days is asked at a bounded rate and costs no memory', async () => {
    const bench = new WatchBench()
    bench.silent = true
    bench.watch({ a: 'D1' }, { every: 100 })
    await bench.pass(48 * HOUR)
    expect(bench.takeReads().length).toBeLessThan(48 * 120 + 20)
    expect(bench.clock.pending).toBe(1)
  })

  test('beside a request that a bug rejects: the watch goes on', async () => {
    const bench = new WatchBench()
    const { updates } = bench.watch({ a: 'D1' }, { every: 100 })
    bench.takes = () => {
      throw new TypeError('a bug')
    }
    await bench.pass(50)
    bench.takes = () => 0
    await bench.pass(100)
    expect(updates).toMatchObject([{ values: { a: { quality: 'bad' } } }, { values: { a: { quality: 'good' } } }])
  })
})

describe('a watch ends', () => {
  test('with the loop, with close, with the signal and with its client: nothing is read, and no timer stays', async () => {
    const bench = new WatchBench()
    const leaving = async () => {
      for await (const _ of bench.loop({ a: 'D1' }, { every: 100 })) return
    }
    const left = leaving()
    const abort = new AbortController()
    const aborted = bench.loop({ b: 'D2' }, { every: 100, signal: abort.signal })
    const closed = bench.loop({ c: 'D3' }, { every: 100 })
    const ofClient = bench.loop({ d: 'D4' }, { every: 100 })
    await bench.pass(0)
    await left
    await closed.next()
    const waiting = closed.next()
    abort.abort()
    await closed.close()
    expect(await waiting).toEqual({ value: undefined, done: true })
    expect([aborted.isClosed, ofClient.isClosed]).toEqual([true, false])
    bench.takeReads()
    await bench.pass(100)
    expect(bench.takeReads()).toEqual([[100, 'D4']])
    bench.watching.close()
    expect([bench.clock.pending, await ofClient.next()]).toEqual([0, { value: undefined, done: true }])
    expect(() => bench.loop({ a: 'D1' }, { every: 100 })).toThrow('the client is closed')
  })

  test('that was opened and ended a thousand times leaves nothing behind', async () => {
    const bench = new WatchBench()
    const { signal } = new AbortController()
    for (let i = 0; i < 1000; i++) {
      const watch = bench.loop({ a: 'D1' }, { every: 100, signal })
      if (i % 10 === 0) await bench.pass(10)
      await watch.close()
    }
    bench.takeReads()
    await bench.pass(10_000)
    expect([bench.clock.pending, bench.takeReads()]).toEqual([0, []])
  })

  test('from within its own listener, while it is told', async () => {
    const bench = new WatchBench()
    const watch = bench.watching.open({ a: 'D1' }, { every: 100, onChange: () => void watch.close() })
    const { updates } = bench.watch({ a: 'D1' }, { every: 100 })
    await bench.pass(500)
    expect([watch.isClosed, updates.length, bench.takeReads().length]).toEqual([true, 1, 6])
  })
})

describe('what is wrong with it', () => {
  test.each([
    [{ every: undefined }, 'every'],
    [{ every: 0 }, 'every'],
    [{ every: 1.5 }, 'every'],
    [{ every: '100' }, 'every'],
    [{ every: 100, heartbeat: -1 }, 'heartbeat'],
    [{ every: 100, tell: 'all' }, 'tell'],
    [{ every: 100, onChange: 5 }, 'onChange'],
    [{ every: 100, signal: {} }, 'signal'],
    [{ every: 100, evry: 1 }, 'evry'],
    [{ every: 100, deadband: 5 }, 'deadband'],
    [{ every: 100, deadband: { kind: 'absolute', value: -1 } }, 'deadband'],
    [{ every: 100, deadband: { kind: 'absolute', value: '1' } }, 'deadband'],
    [{ every: 100, deadband: { kind: 'percent', value: 5 } }, 'deadband.of'],
    [{ every: 100, deadband: { kind: 'percent', value: 5, of: [5, 5] } }, 'deadband'],
    [{ every: 100, deadband: { kind: 'percent', value: 101, of: [0, 5] } }, 'deadband'],
    [{ every: 100, deadband: { b: { kind: 'absolute', value: 1 } } }, 'deadband.b'],
    [{ every: 100, deadband: { a: 1 } }, 'deadband.a'],
    [{ every: 100, demoteAfter: 0 }, 'demoteAfter'],
  ])('%j is refused for %s', (options, field) => {
    const { watching, clock } = new WatchBench()
    expect(() => watching.open({ a: 'D1' }, options)).toThrow(expect.objectContaining({ code: 'BAD_OPTION', field }))
    expect(clock.pending).toBe(0)
  })

  test('items that are neither a list nor an object are refused', () => {
    expect(() => new WatchBench().watching.open('D1' as never, { every: 100 })).toThrow('an object of items by name')
  })

  test('a watch with a listener is no loop', async () => {
    const bench = new WatchBench()
    const { watch } = bench.watch({ a: 'D1' }, { every: 100 })
    expect(() => watch[Symbol.asyncIterator]()).toThrow('Open another watch')
    await expect(watch.next()).rejects.toMatchObject({ code: 'BAD_OPTION' })
  })
})
