// What a connection tells: states, frames, unsolicited frames, counters; and that nobody who listens can break it.
import { describe, expect, test } from '@jest/globals'
import type { TracedFrame } from '../../src/client/connection/connection'
import type { Transport, TransportHandlers } from '../../src/transport/transport'
import { Bench } from './bench'
import { exchanges, silent } from './scripted-plc'

const frames = ['3E', '4E'] as const
const kinds = ['stream', 'datagram'] as const
const everyLink = frames.flatMap((frame) => kinds.map((kind) => ({ frame, kind })))
const broken = () => {
  throw new Error('a mistake of the program')
}

describe.each(everyLink)('listeners, $frame by $kind', (link) => {
  test('that throw break nothing', async () => {
    const bench = new Bench({ ...link, onState: broken, onUnsolicited: broken })
    bench.connection.onTrace = broken
    const reads = [bench.read(1), bench.read(2)]
    bench.plc.script = (asked) => {
      asked.peer.send(bench.framing.request.write(asked.frame.head, 1, Buffer.from('news')))
      asked.reply()
    }
    await bench.settle()
    expect(reads.map(({ told }) => told)).toEqual([{ values: [1] }, { values: [2] }])
    bench.plc.script = ({ peer }) => peer.send(Buffer.from('rubbish'))
    const lost = bench.read(3)
    await bench.pass(10_000)
    expect([lost.told, bench.state]).toEqual(['BAD_FRAME unknown', 'connected'])
    bench.connection.close()
    await bench.settle()
    expect(bench.leftovers).toEqual({ timers: 0, connections: 0, unsettled: 0 })
  })

  test.each(['connecting', 'connected', 'waiting'] as const)('may close from inside (%s)', async (when) => {
    const bench: Bench = new Bench({
      ...link,
      onState: ({ name }) => {
        if (name === when) bench.connection.close()
      },
    })
    bench.plc.script = ({ peer }) => peer.send(Buffer.from('rubbish'))
    const calls = [bench.follow(bench.connection.connect()), bench.read(1), bench.read(2)]
    await bench.pass(10_000)
    expect([bench.state, calls.map(({ settled }) => settled)]).toEqual(['closed', [1, 1, 1]])
    expect(bench.leftovers).toEqual({ timers: 0, connections: 0, unsettled: 0 })
  })

  test('may ask from inside', async () => {
    const answers: unknown[] = []
    const ask = exchanges(link.frame)
    const bench: Bench = new Bench({
      ...link,
      onState: ({ name }) => {
        bench.connection.request(ask.read(7)).then(
          ({ values }) => answers.push(name, values),
          (error: { code: string }) => answers.push(name, error.code),
        )
      },
    })
    bench.follow(bench.connection.connect())
    await bench.settle()
    bench.connection.close()
    await bench.settle()
    // In the order in which they were asked.
    expect(answers).toEqual(['connecting', [7], 'connected', [7], 'closed', 'CLOSED'])
  })

  test.each(['sent', 'received'] as const)(
    'may close when they see a frame (%s): its outcome is unknown',
    async (seen) => {
      const bench = await Bench.connected(link)
      bench.connection.onTrace = ({ direction }) => {
        if (direction === seen) bench.connection.close()
      }
      const [write, waiting] = [bench.write(1, 5), bench.write(2, 5)]
      await bench.settle()
      expect([write.told, waiting.error?.code]).toEqual(['CLOSED unknown', 'CLOSED'])
      expect(waiting.error?.outcome).toBe('notSent')
      expect(bench.leftovers).toEqual({ timers: 0, connections: 0, unsettled: 0 })
    },
  )

  test('see every frame as it went over the wire', async () => {
    const bench = new Bench(link)
    const frames: TracedFrame[] = []
    bench.connection.onTrace = (frame) => frames.push(frame)
    bench.read(100)
    await bench.settle()
    expect(frames.map(({ direction }) => direction)).toEqual(['sent', 'received', 'sent', 'received'])
    const { bytesSent, bytesReceived } = bench.connection.statistics
    const bytes = (direction: string) =>
      frames.filter((frame) => frame.direction === direction).reduce((sum, frame) => sum + frame.bytes.length, 0)
    expect([bytes('sent'), bytes('received')]).toEqual([bytesSent, bytesReceived])
    expect(frames[3]?.bytes.subarray(-2)).toEqual(Buffer.of(100, 0))
    expect(frames[0]?.time).toBe(bench.clock.time())
    bench.connection.onTrace = undefined
    bench.read(100)
    await bench.settle()
    expect(frames).toHaveLength(4)
  })

  test('hear of what the PLC sends unasked, before, between and instead of answers', async () => {
    const bench = await Bench.connected(link)
    const news = (text: string) => bench.framing.request.write({ ...ownHead }, 9, Buffer.from(text))
    bench.plc.script = (asked) => {
      asked.peer.send(news('first'))
      asked.reply()
      asked.peer.send(news('second'))
    }
    const read = bench.read(1)
    await bench.settle()
    expect([read.told, bench.state]).toEqual([{ values: [1] }, 'connected'])
    // By datagrams without a serial number the port is changed after the answer, and what comes later goes nowhere.
    const lost = link.frame === '3E' && link.kind === 'datagram'
    expect(bench.unsolicited).toEqual(lost ? ['first'] : ['first', 'second'])
    expect(bench.connection.statistics).toMatchObject({ stale: 0, protocolErrors: 0 })
  })
})

test('what is aborted by a listener while the connection ends is not sent on the next one', async () => {
  const abort = new AbortController()
  const bench = await Bench.connected({ frame: '4E', onUnsolicited: () => abort.abort() })
  bench.plc.script = ({ frame, peer }) => {
    const bad = bench.framing.response.write(frame.head, frame.serial ?? 0, 0, Buffer.alloc(7))
    peer.send(Buffer.concat([bad, bench.framing.request.write(ownHead, 9, Buffer.from('news'))]))
  }
  const read = bench.read(1)
  const write = bench.write(2, 1, { signal: abort.signal })
  await bench.pass(10_000)
  expect([read.settled, write.settled, bench.plc.asked]).toEqual([1, 1, ['readWords 1']])
})

const ownHead = { network: 0, station: 0xff, moduleIo: 0x3ff, multidrop: 0, timer: 0 }

test('a connection is lost once, however much is wrong on it', async () => {
  const bench = await Bench.connected({ frame: '4E', inFlight: 2 })
  const bad: Buffer[] = []
  bench.plc.script = ({ frame, peer }) => {
    bad.push(bench.framing.response.write(frame.head, frame.serial ?? 0, 0, Buffer.alloc(7)))
    if (bad.length === 2) peer.send(Buffer.concat([...bad, Buffer.from('rubbish')]))
  }
  const reads = [bench.read(1), bench.read(2), bench.read(3)]
  await bench.settle()
  expect(reads.map(({ told }) => told)).toEqual(['TRAILING unknown', 'TRAILING unknown', 'pending'])
  expect(bench.states.map(({ name }) => name)).toEqual(['waiting'])
  expect(bench.connection.statistics).toMatchObject({ disconnects: 1, answered: 2, inFlight: 0, queued: 1 })
  bench.plc.script = (asked) => asked.reply()
  await bench.pass(50)
  expect(reads[2]?.told).toEqual({ values: [3] })
})

describe('a transport that was given up', () => {
  /** A transport in the hands of the test. */
  function manual() {
    const made: { handlers: TransportHandlers; sent: Buffer[]; closed: number }[] = []
    const openTransport = (): Transport => {
      const entry = { handlers: undefined as unknown as TransportHandlers, sent: [] as Buffer[], closed: 0 }
      made.push(entry)
      return {
        kind: 'stream',
        description: `made ${made.length}`,
        open: (handlers) => void Object.assign(entry, { handlers }),
        send: (bytes) => entry.sent.push(Buffer.from(bytes)),
        renewable: false,
        ready: true,
        renew() {},
        close: () => void entry.closed++,
      }
    }
    return { made, openTransport }
  }

  test('is not listened to any more, whatever it says', async () => {
    const { made, openTransport } = manual()
    const bench = new Bench({ openTransport, connectTimeout: 100 })
    const first = bench.follow(bench.connection.connect())
    await bench.pass(100)
    expect([first.told, made[0]?.closed]).toEqual(['CONNECT_FAILED notSent', 1])
    await bench.pass(250)
    expect([made.length, bench.state]).toEqual([2, 'connecting'])
    const [old, present] = made
    old?.handlers.opened()
    old?.handlers.received(Buffer.from('anything'))
    old?.handlers.closed(undefined)
    expect([bench.state, old?.sent, bench.connection.statistics.bytesReceived]).toEqual(['connecting', [], 0])
    present?.handlers.opened()
    expect(present?.sent).toHaveLength(1)
    bench.connection.close()
    const told = bench.states.length
    for (const { handlers } of made) {
      handlers.opened()
      handlers.received(Buffer.from('anything'))
      handlers.closed(undefined)
    }
    await bench.pass(60_000)
    expect([bench.state, made.length, bench.states.length]).toEqual(['closed', 2, told])
  })

  test('that cannot send loses the connection, not the program', async () => {
    const { made, openTransport } = manual()
    const failing = () => {
      const transport = openTransport()
      return { ...transport, send: broken }
    }
    const bench = new Bench({ openTransport: failing })
    const connecting = bench.follow(bench.connection.connect())
    made[0]?.handlers.opened()
    await bench.settle()
    expect([connecting.told, bench.state, made[0]?.closed]).toEqual(['DISCONNECTED unknown', 'waiting', 1])
  })
})

describe('the counters', () => {
  test('of a connection that works: every request and every answer, but not the first one that proves it', async () => {
    const bench = new Bench({ frame: '4E' })
    bench.plc.script = ({ reply }) => void bench.clock.timer(7, reply)
    for (const number of [1, 2, 3]) {
      bench.read(number)
      await bench.pass(7)
    }
    expect(bench.connection.statistics).toEqual({
      requests: 3,
      answered: 3,
      refused: 0,
      overloaded: 0,
      timeouts: 0,
      aborted: 0,
      protocolErrors: 0,
      stale: 0,
      unsolicited: 0,
      connects: 1,
      disconnects: 0,
      bytesSent: 19 + 3 * 27,
      bytesReceived: 15 + 18 + 3 * (15 + 2),
      queued: 0,
      inFlight: 0,
      roundTrip: { count: 3, last: 7, min: 7, mean: 7, p50: 7, p95: 7, p99: 7, max: 7 },
    })
  })

  test('of one that does not: connections that ended, and requests by how they ended', async () => {
    const bench = await Bench.connected({ frame: '4E' })
    bench.plc.script = silent
    bench.read(1)
    const abort = new AbortController()
    bench.read(2, { signal: abort.signal })
    abort.abort()
    await bench.pass(1000)
    bench.plc.script = (asked) => asked.peer.send(asked.refuse(0xc051))
    bench.read(3)
    await bench.settle()
    bench.plc.script = ({ peer }) => peer.reset()
    bench.read(4)
    await bench.pass(1000)
    expect(bench.connection.statistics).toMatchObject({
      requests: 4,
      answered: 1,
      refused: 1,
      timeouts: 1,
      aborted: 1,
      connects: 2,
      disconnects: 1,
    })
    expect(bench.connection.statistics.roundTrip?.count).toBe(1)
  })

  test('are all that is left of 10 000 requests', async () => {
    const bench = await Bench.connected({ frame: '4E' })
    bench.clock.advance(1)
    let answered = 0
    const ask = () =>
      bench.connection.request(bench.ask.read(1)).then(() => {
        answered += 1
      })
    for (let round = 0; round < 50; round++) {
      const asked = Array.from({ length: 200 }, ask)
      await bench.settle()
      await Promise.all(asked)
    }
    expect(answered).toBe(10_000)
    // One timer of the connection, one of the line.
    expect(bench.clock.pending).toBeLessThanOrEqual(2)
    expect(bench.connection.statistics).toMatchObject({ answered: 10_000, queued: 0, inFlight: 0 })
    bench.connection.close()
    await bench.settle()
    expect(bench.leftovers).toEqual({ timers: 0, connections: 0, unsettled: 0 })
  })
})
