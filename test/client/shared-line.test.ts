// A line that several PLCs share: what carries the bytes is common, what belongs to a PLC is its own.
import { describe, expect, test } from '@jest/globals'
import { Bench, type Station, type Tracked } from './bench'
import { type Asked, replying, type Script, silent } from './scripted-plc'

const stationOf = ({ frame }: Asked): number => frame.head.station

/** What each station does; the others answer. */
const byStation =
  (scripts: Readonly<Record<number, Script>>): Script =>
  (asked) =>
    (scripts[stationOf(asked)] ?? replying)(asked)

/** Three stations on one line; each has answered its probe, and is old enough to count as a good connection. */
async function threeOn(bench: Bench): Promise<readonly [Station, Station, Station]> {
  const stations = [bench.station(1), bench.station(2), bench.station(3)] as const
  for (const { connection } of stations) bench.follow(connection.connect())
  await bench.settle()
  await bench.pass(10_000)
  return stations
}

describe('stations on one line', () => {
  test('share one transport, and each of them is proved by its own probe', async () => {
    const bench = new Bench({ frame: '4E' })
    const probed: number[] = []
    bench.plc.probe = (asked) => {
      probed.push(stationOf(asked))
      asked.reply()
    }
    const stations = await threeOn(bench)
    expect([bench.plc.open, probed]).toEqual([1, [1, 2, 3]])
    for (const { connection, states } of stations) {
      expect(states.map(({ name }) => name)).toEqual(['connecting', 'connected'])
      expect([connection.generation, connection.statistics.connects]).toEqual([1, 1])
    }
  })

  test('count their own requests, answers, refusals and round trips', async () => {
    const bench = new Bench({ frame: '4E' })
    const [first, second, third] = await threeOn(bench)
    bench.plc.script = byStation({ 2: (asked) => asked.peer.send(asked.refuse(0xc056)) })
    for (let i = 0; i < 3; i++) bench.follow(first.connection.request(first.ask.read(i)))
    const refused = bench.follow(second.connection.request(second.ask.read(9)))
    await bench.settle()
    expect(refused.told).toBe('END_CODE refused')
    expect(first.connection.statistics).toMatchObject({ requests: 3, answered: 3, refused: 0, roundTrip: { count: 3 } })
    expect(second.connection.statistics).toMatchObject({
      requests: 1,
      answered: 1,
      refused: 1,
      roundTrip: { count: 1 },
    })
    expect(third.connection.statistics).toMatchObject({ requests: 0, answered: 0, roundTrip: undefined })
  })

  test('take turns, however much one of them is asked; a write to one goes before reads of the others', async () => {
    const bench = new Bench({ frame: '4E' })
    const [first, second, third] = await threeOn(bench)
    bench.plc.asked.length = 0
    for (let i = 0; i < 4; i++) bench.follow(first.connection.request(first.ask.read(100 + i)))
    bench.follow(second.connection.request(second.ask.read(200)))
    bench.follow(third.connection.request(third.ask.read(300)))
    bench.follow(third.connection.request(third.ask.write(301, 1)))
    await bench.settle()
    expect(bench.plc.asked).toEqual([
      'readWords 100',
      'writeWords 301',
      'readWords 101',
      'readWords 200',
      'readWords 300',
      'readWords 102',
      'readWords 103',
    ])
  })

  test('a silent one waits for its next attempt; the others go on, on the same transport', async () => {
    const bench = new Bench({ frame: '4E' })
    const [first, second] = await threeOn(bench)
    bench.plc.script = byStation({ 2: silent })
    bench.plc.probe = byStation({ 2: silent })
    const lost: unknown[] = []
    for (let i = 0; i < 2; i++) {
      const call = bench.follow(second.connection.request(second.ask.read(i)))
      // One request is in flight at a time: who shares a line waits for the answer that others wait for.
      const other = bench.follow(first.connection.request(first.ask.read(10 + i), { timeout: 3000 }))
      await bench.pass(1001)
      lost.push(call.told, other.told)
    }
    expect(lost).toEqual(['TIMEOUT unknown', { values: [10] }, 'TIMEOUT unknown', { values: [11] }])
    expect([first.connection.state.name, second.connection.state.name]).toEqual(['connected', 'waiting'])
    await bench.pass(60_000)
    expect(second.connection.state).toMatchObject({ error: { code: 'SILENT' } })
    expect(second.connection.statistics.connects).toBeGreaterThan(2)
    expect([bench.plc.open, bench.plc.peers.length, first.connection.generation]).toEqual([1, 1, 1])
    expect(first.connection.statistics).toMatchObject({ timeouts: 0, disconnects: 0 })
    // It is there again: its next attempt finds it, and counts as another connection.
    bench.plc.script = replying
    bench.plc.probe = replying
    await bench.pass(31_000)
    expect([second.connection.state.name, second.connection.generation]).toEqual(['connected', 2])
  })

  test('what was given up by one is not held against the others', async () => {
    const bench = new Bench({ frame: '4E' })
    const [first, second] = await threeOn(bench)
    const late: Asked[] = []
    bench.plc.script = byStation({ 1: (asked) => late.push(asked) })
    const given = bench.follow(first.connection.request(first.ask.read(1), { timeout: 100 }))
    const waiting = bench.follow(second.connection.request(second.ask.read(2)))
    await bench.pass(101)
    expect([given.told, waiting.told]).toEqual(['TIMEOUT unknown', { values: [2] }])
    for (const asked of late) asked.reply()
    await bench.settle()
    expect([first.connection.state.name, second.connection.state.name]).toEqual(['connected', 'connected'])
  })

  test('a lost line is lost to all: what was sent is unknown, what waited goes on the next one', async () => {
    const bench = new Bench({ frame: '4E' })
    const [first, second, third] = await threeOn(bench)
    bench.plc.script = silent
    const sent = bench.follow(first.connection.request(first.ask.write(1, 1)))
    const waiting = bench.follow(second.connection.request(second.ask.read(2)))
    await bench.settle()
    bench.plc.script = replying
    bench.plc.peers.at(-1)?.close()
    await bench.settle()
    expect(sent.told).toBe('DISCONNECTED unknown')
    await bench.pass(100)
    expect(waiting.told).toEqual({ values: [2] })
    expect([bench.plc.open, bench.plc.peers.length]).toEqual([1, 2])
    for (const { connection } of [first, second, third]) {
      expect([connection.state.name, connection.generation, connection.statistics.disconnects]).toEqual([
        'connected',
        2,
        1,
      ])
    }
  })

  test('closing one leaves the others; the last one closes the line', async () => {
    const bench = new Bench({ frame: '4E' })
    const [first, second, third] = await threeOn(bench)
    bench.plc.script = silent
    const mine = bench.follow(first.connection.request(first.ask.read(1)))
    const theirs = bench.follow(second.connection.request(second.ask.read(2)))
    await bench.settle()
    bench.plc.script = replying
    first.connection.close()
    await bench.settle()
    expect([mine.told, theirs.told, bench.plc.open]).toEqual(['CLOSED unknown', { values: [2] }, 1])
    second.connection.close()
    third.connection.close()
    await bench.settle()
    expect(bench.leftovers).toEqual({ timers: 0, connections: 0, unsettled: 0 })
  })

  test('who is told of the loss may close all of them: every call is settled once', async () => {
    const bench = new Bench({ frame: '4E' })
    const second: Station = bench.station(2)
    const first: Station = bench.station(1, {
      onState: ({ name }) => {
        if (name !== 'waiting') return
        second.connection.close()
        first.connection.close()
      },
    })
    bench.follow(first.connection.connect())
    bench.follow(second.connection.connect())
    await bench.settle()
    bench.plc.script = silent
    const calls = [first, second].map(({ connection, ask }) => bench.follow(connection.request(ask.read(1))))
    await bench.settle()
    bench.plc.peers.at(-1)?.close()
    await bench.settle()
    expect(calls.map(({ settled }) => settled)).toEqual([1, 1])
    expect(bench.leftovers).toEqual({ timers: 0, connections: 0, unsettled: 0 })
  })

  test('each sees its own frames in a trace', async () => {
    const bench = new Bench({ frame: '4E' })
    const [first, second] = await threeOn(bench)
    const seen: string[] = []
    first.connection.onTrace = ({ direction }) => seen.push(direction)
    bench.follow(second.connection.request(second.ask.read(2)))
    await bench.settle()
    expect(seen).toEqual([])
    bench.follow(first.connection.request(first.ask.read(1)))
    await bench.settle()
    expect(seen).toEqual(['sent', 'received'])
  })

  test('when silence ends the use of one, what ended at the same time is told, too', async () => {
    const bench = new Bench({ frame: '4E', kind: 'datagram', inFlight: 4 })
    const [, second] = await threeOn(bench)
    bench.plc.script = silent
    const calls = [1, 2, 3, 4].map((at) => bench.follow(second.connection.request(second.ask.read(at))))
    await bench.pass(1001)
    expect(calls.map(({ told }) => told)).toEqual(Array.from({ length: 4 }, () => 'TIMEOUT unknown'))
  })

  test('what is asked of another one by who is told of the loss goes on the next line', async () => {
    const bench = new Bench({ frame: '4E' })
    const second: Station = bench.station(2)
    const asked: Tracked<unknown>[] = []
    const abort = new AbortController()
    const first: Station = bench.station(1, {
      onState: ({ name }) => {
        if (name !== 'waiting') return
        asked.push(bench.follow(second.connection.request(second.ask.read(5))))
        asked.push(bench.follow(second.connection.request(second.ask.write(6, 1), { signal: abort.signal })))
        abort.abort()
      },
    })
    bench.follow(first.connection.connect())
    bench.follow(second.connection.connect())
    await bench.settle()
    await bench.pass(10_000)
    bench.plc.peers.at(-1)?.close()
    await bench.settle()
    await bench.pass(100)
    expect(asked.map(({ told }) => told)).toEqual([{ values: [5] }, 'ABORTED notSent'])
    expect(bench.plc.asked).toEqual(['readWords 5'])
  })

  test('what waited and was aborted by who is told of the loss is not sent on the next line', async () => {
    const bench = new Bench({ frame: '4E' })
    const second: Station = bench.station(2)
    const abort = new AbortController()
    const first: Station = bench.station(1, { onState: ({ name }) => name === 'waiting' && abort.abort() })
    bench.follow(first.connection.connect())
    bench.follow(second.connection.connect())
    await bench.settle()
    await bench.pass(10_000)
    bench.plc.script = silent
    bench.follow(first.connection.request(first.ask.write(1, 1)))
    const waiting = bench.follow(second.connection.request(second.ask.write(2, 1), { signal: abort.signal }))
    await bench.settle()
    bench.plc.peers.at(-1)?.close()
    await bench.settle()
    await bench.pass(1000)
    expect(waiting.told).toBe('ABORTED notSent')
    expect(bench.plc.asked).toEqual(['writeWords 1'])
  })
})
