/** More is asked than the PLC answers: what waits too long is told as that, and everything else goes on. */
import { describe, expect, test } from '@jest/globals'
import { Bench, type Tracked } from './bench'
import { withLine } from './line'
import { type Script, silent } from './scripted-plc'

const ANSWER = 40

/** One request after another, each in so many ms, as a PLC with that scan time does. */
function slowPlc(bench: Bench): Script {
  let freeAt = 0
  return ({ reply }) => {
    freeAt = Math.max(freeAt, bench.clock.now()) + ANSWER
    bench.clock.timer(freeAt - bench.clock.now(), reply)
  }
}

function count(calls: readonly Tracked<unknown>[]): Record<string, number> {
  const counts: Record<string, number> = {}
  for (const { told } of calls) {
    const what = typeof told === 'string' ? told : 'done'
    counts[what] = (counts[what] ?? 0) + 1
  }
  return counts
}

describe.each(['3E', '4E'] as const)(
  'seven callers every 200 ms, a write every second, a PLC that needs 40 ms (%s)',
  (frame) => {
    test('the connection lives, every write is done, and what could not be answered in time is told as that', async () => {
      const bench = await Bench.connected({ frame, timeout: 3000 })
      bench.plc.script = slowPlc(bench)
      const reads: Tracked<unknown>[][] = Array.from({ length: 7 }, () => [])
      const writes: Tracked<unknown>[] = []
      for (let now = 0; now < 40_000; now += 200) {
        for (const [caller, asked] of reads.entries()) asked.push(bench.read(caller, { caller: `node ${caller}` }))
        if (now % 1000 === 0) writes.push(bench.write(9000, now))
        await bench.pass(200)
      }
      await bench.pass(5000)
      expect(count(writes)).toEqual({ done: 40 })
      const counts = reads.map(count)
      const done = counts.map((each) => each.done ?? 0)
      // 25 answers a second, but for the writes; nobody gets less than the others.
      expect(done.reduce((sum, each) => sum + each, 0)).toBeGreaterThan(900)
      expect(Math.max(...done) - Math.min(...done)).toBeLessThanOrEqual(2)
      expect(new Set(counts.flatMap((each) => Object.keys(each)))).toEqual(new Set(['done', 'OVERLOADED notSent']))
      expect(bench.states).toEqual([])
      expect(bench.connection.statistics).toMatchObject({ connects: 1, disconnects: 0, timeouts: 0, protocolErrors: 0 })
      const refused = reads.flat().find(({ error }) => error !== undefined)
      expect(refused?.error?.message).toMatch(/\d+ requests wait, and the PLC needs about 40 ms for each/)
    })
  },
)

test('a PLC that does not answer is silent, not overloaded', async () => {
  const bench = await Bench.connected({ frame: '4E' })
  bench.plc.script = silent
  const calls = [bench.read(1), bench.read(2), bench.read(3)]
  await bench.pass(1000)
  expect(calls.map(({ told }) => told)).toEqual(['TIMEOUT unknown', 'TIMEOUT notSent', 'TIMEOUT notSent'])
  expect(bench.connection.statistics.overloaded).toBe(0)
})

test('once sent, a request has at least a tenth of its time', async () => {
  const bench = await Bench.connected({ frame: '4E' })
  const sent: number[] = []
  bench.plc.script = ({ device, reply }) => {
    sent.push(device)
    // Round trips of nothing: only the share keeps the late one back.
    if (device === 1) bench.clock.timer(905, reply)
    else reply()
  }
  await bench.pass(0)
  bench.plc.script({ device: 0, reply() {} } as never)
  const [first, late, patient] = [bench.read(1), bench.read(2), bench.read(3, { timeout: 5000 })]
  await bench.pass(1000)
  expect([first.told, late.told, patient.told]).toEqual([{ values: [1] }, 'TIMEOUT notSent', { values: [3] }])
  expect(sent).toEqual([0, 1, 3])
})

test('a call of many requests does not keep those of others waiting', async () => {
  const bench = await Bench.connected({ frame: '3E', timeout: 10_000 })
  bench.plc.script = slowPlc(bench)
  const many = Array.from({ length: 60 }, (_, i) => bench.read(i, { caller: 'many' }))
  await bench.pass(ANSWER)
  const other = bench.read(5000, { caller: 'other' })
  await bench.pass(3 * ANSWER)
  expect(other.told).toEqual({ values: [5000] })
  expect(many.filter(({ told }) => told !== 'pending').length).toBeLessThan(5)
})

test('the requests of one call take one turn, and the callers that the program names take theirs', () =>
  withLine('tcp 3E binary iq-r', { client: { gap: 0, timeout: 10_000 } }, async ({ plc, client }) => {
    await client.connect()
    plc.faults.add({ kind: 'delay', ms: 5 })
    const order: string[] = []
    const note = (name: string) => () => void order.push(name)
    const large = Array.from({ length: 30 }, (_, i) => `D${i * 1000}[900]`)
    const all = [
      client.read(large).then(note('large')),
      ...[1, 2, 3].map((i) => client.read(`D${i}`, { caller: 'trend' }).then(note(`trend ${i}`))),
      client.read('D10').then(note('other')),
    ]
    await Promise.all(all)
    expect(order).toEqual(['trend 1', 'other', 'trend 2', 'trend 3', 'large'])
    await expect(client.read('D0', { caller: 5 as never })).rejects.toMatchObject({
      code: 'BAD_OPTION',
      field: 'caller',
    })
  }))

test('reads that are repeated anyway let the others go first, and come to their end behind eight of them', async () => {
  const bench = await Bench.connected({ frame: '3E', timeout: 10_000 })
  const asked: number[] = []
  const slow = slowPlc(bench)
  bench.plc.script = (request) => {
    asked.push(request.device)
    slow(request)
  }
  bench.read(0)
  bench.read(1, { priority: 'poll' })
  for (let i = 0; i < 9; i++) bench.write(9000 + i, i)
  bench.read(2)
  await bench.pass(20 * ANSWER)
  expect(asked).toEqual([0, 9000, 9001, 9002, 9003, 9004, 9005, 9006, 9007, 2, 1, 9008])
})

test('writes without end do not keep what is repeated from its turn', async () => {
  const bench = await Bench.connected({ frame: '3E', timeout: 60_000 })
  bench.plc.script = slowPlc(bench)
  for (let i = 0; i < 40; i++) bench.write(9000 + i, i)
  const poll = bench.read(1, { priority: 'poll' })
  await bench.pass(10 * ANSWER)
  expect(poll.told).toEqual({ values: [1] })
})

test('a priority that is none is refused', async () => {
  const bench = await Bench.connected({ frame: '3E' })
  const refused = bench.read(1, { priority: 'control' as never })
  await bench.settle()
  expect(refused.error).toMatchObject({ code: 'BAD_OPTION', field: 'priority' })
})
