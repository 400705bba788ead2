// Connecting: the first request that proves a connection, calls that wait for it, failing fast, back-off.
import { describe, expect, test } from '@jest/globals'
import { ConnectionError, RequestError, TimeoutError } from '../../src/errors'
import { Bench, CAUSES } from './bench'
import { silent } from './scripted-plc'

const kinds = ['stream', 'datagram'] as const

describe.each(kinds)('connecting by %s', (kind) => {
  test('nothing is connected before somebody asks', async () => {
    const bench = new Bench({ kind })
    await bench.pass(60_000)
    expect([bench.state, bench.plc.peers.length, bench.clock.pending]).toEqual(['idle', 0, 0])
  })

  test('connect resolves when the PLC has answered, not when it has accepted', async () => {
    const bench = new Bench({ kind })
    let answer = () => {}
    bench.plc.probe = (asked) => {
      answer = asked.reply
    }
    const connecting = bench.follow(bench.connection.connect())
    await bench.settle()
    expect([connecting.told, bench.state, bench.plc.probes]).toEqual(['pending', 'connecting', 1])
    answer()
    await bench.settle()
    expect([connecting.told, bench.state]).toEqual([undefined, 'connected'])
    expect(bench.states.map(({ name, attempt }) => [name, attempt])).toEqual([
      ['connecting', 1],
      ['connected', 0],
    ])
    await bench.connection.connect()
  })

  test('the round trip of a call is the time of its own request, however long connecting took', async () => {
    const bench = new Bench({ kind })
    const late: (() => void)[] = []
    bench.plc.probe = (asked) => late.push(asked.reply)
    bench.plc.script = (asked) => late.push(asked.reply)
    const calls = [1, 2].map((number) => bench.follow(bench.connection.roundTrip(bench.ask.read(number))))
    for (const wait of [700, 5, 9]) {
      await bench.pass(wait)
      late.shift()?.()
      await bench.settle()
    }
    expect(calls.map(({ told }) => told)).toEqual([5, 9])
  })

  test('calls made meanwhile wait, and are sent in their order, one at a time', async () => {
    const bench = new Bench({ kind })
    const reads = [100, 200, 300].map((number) => bench.read(number))
    expect([bench.connection.statistics.queued, bench.plc.asked]).toEqual([3, []])
    await bench.settle()
    expect(reads.map(({ told }) => told)).toEqual([{ values: [100] }, { values: [200] }, { values: [300] }])
    expect([bench.plc.asked, bench.plc.probes]).toEqual([['readWords 100', 'readWords 200', 'readWords 300'], 1])
  })

  test('a refusal of the first request proves the connection as well', async () => {
    const bench = new Bench({ kind })
    bench.plc.probe = (asked) => asked.peer.send(asked.refuse(0xc059))
    const connecting = bench.follow(bench.connection.connect())
    await bench.settle()
    expect([connecting.told, bench.state]).toEqual([undefined, 'connected'])
  })

  test('silence is told with its ranked causes, to connect and to every call that waited', async () => {
    const bench = new Bench({ kind, timeout: 1000 })
    bench.plc.probe = silent
    const connecting = bench.follow(bench.connection.connect())
    const read = bench.read(100, { timeout: 2000 })
    await bench.pass(1000)
    expect(connecting.error).toMatchObject({ code: 'SILENT', outcome: 'unknown', causes: CAUSES })
    expect(connecting.error?.message).toContain('1. the data code differs 2. the port is another service')
    expect(read.error).toMatchObject({ code: 'OFFLINE', outcome: 'notSent', causes: CAUSES, cause: connecting.error })
    expect(bench.connection.state).toMatchObject({ name: 'waiting', attempt: 1, error: connecting.error })
  })

  test('a call whose deadline comes first is told how far the connection is', async () => {
    const bench = new Bench({ kind, timeout: 1000 })
    bench.plc.probe = silent
    const [connecting, read] = [bench.follow(bench.connection.connect({ timeout: 10 })), bench.read(1, { timeout: 20 })]
    await bench.pass(20)
    for (const { error } of [connecting, read]) {
      expect(error).toBeInstanceOf(TimeoutError)
      expect(error).toMatchObject({ outcome: 'notSent', causes: CAUSES })
      expect(error?.message).toContain('has not answered Read Type Name (0101) yet. Most likely: the data code differs')
    }
    expect(bench.state).toBe('connecting')
  })

  test('rubbish instead of an answer is told as what it is', async () => {
    const bench = new Bench({ kind })
    bench.plc.probe = ({ peer }) => peer.send(Buffer.from('HTTP/1.1 400 Bad Request'))
    const connecting = bench.follow(bench.connection.connect())
    await bench.settle()
    expect(connecting.error).toMatchObject({ name: 'ProtocolError', code: 'BAD_FRAME' })
    expect(bench.connection.statistics).toMatchObject({ protocolErrors: 1, disconnects: 1 })
  })

  test('connecting can be aborted and goes on in the background', async () => {
    const bench = new Bench({ kind })
    const abort = new AbortController()
    const connecting = bench.follow(bench.connection.connect({ signal: abort.signal }))
    abort.abort()
    await bench.settle()
    expect([connecting.told, bench.state]).toEqual(['ABORTED notSent', 'connected'])
  })
})

describe('an attempt that fails', () => {
  test('tells connect its reason, and the calls that waited that nothing was sent', async () => {
    const bench = new Bench()
    bench.memory.refuse = true
    const [connecting, read] = [bench.follow(bench.connection.connect()), bench.read(100)]
    await bench.settle()
    expect(connecting.told).toBe('CONNECT_FAILED notSent')
    expect([read.told, read.error?.cause]).toEqual(['OFFLINE notSent', connecting.error])
    expect(read.error?.message).toContain('was not sent: there is no connection; it is being restored.')
    expect(bench.connection.statistics).toMatchObject({ connects: 1, disconnects: 0, requests: 1 })
  })

  test('to connect it is said in its own words: connecting sends nothing', async () => {
    const bench = new Bench()
    bench.memory.refuse = true
    bench.follow(bench.connection.connect())
    await bench.settle()
    const again = bench.follow(bench.connection.connect())
    await bench.settle()
    expect([again.told, again.error?.cause]).toEqual(['OFFLINE notSent', bench.connection.state.error])
    expect(again.error?.message).toMatch(/^Not connected: the connection is being restored\. /)
    bench.connection.close()
    const closed = bench.follow(bench.connection.connect())
    await bench.settle()
    expect(closed.error?.message).toBe('Not connected: the client is closed.')
  })

  test('accepted and closed at once: all entries of the PLC are taken', async () => {
    const bench = new Bench()
    bench.plc.onConnection = (peer) => peer.close()
    const [connecting, read] = [bench.follow(bench.connection.connect()), bench.read(100)]
    await bench.settle()
    expect(connecting.told).toBe('ENTRY_BUSY notSent')
    expect(connecting.error?.message).toContain('accepted the connection and closed it at once')
    expect(read.error).toMatchObject({ code: 'OFFLINE', cause: connecting.error })
  })

  test('closed later, after an answer, is no busy entry', async () => {
    const bench = await Bench.connected()
    bench.plc.peers[0]?.close()
    await bench.settle()
    expect(bench.connection.state.error).toMatchObject({ code: 'DISCONNECTED' })
  })

  test('an address that never answers is given up after connectTimeout', async () => {
    let closed = 0
    const deaf = {
      kind: 'stream',
      description: 'tcp 10.0.0.1:5007',
      renewable: false,
      ready: false,
      open() {},
      send() {},
      renew() {},
    } as const
    const bench = new Bench({ connectTimeout: 2000, openTransport: () => ({ ...deaf, close: () => void closed++ }) })
    const connecting = bench.follow(bench.connection.connect())
    const [brief, read] = [bench.read(1, { timeout: 500 }), bench.read(2, { timeout: 9000 })]
    await bench.pass(1999)
    expect([connecting.told, brief.told]).toEqual(['pending', 'TIMEOUT notSent'])
    expect(brief.error?.message).toContain('there is no connection to tcp 10.0.0.1:5007 yet')
    await bench.pass(1)
    expect([connecting.told, read.told, closed]).toEqual(['CONNECT_FAILED notSent', 'OFFLINE notSent', 1])
    expect(connecting.error?.message).toContain('tcp 10.0.0.1:5007 did not accept a connection within 2000 ms')
    expect(connecting.error).toMatchObject({
      causes: ['the PLC is off or its cable is unplugged', 'wrong IP address', 'a firewall drops the packets'],
    })
  })

  test('a transport that cannot even be made or opened is an error, not an exception', async () => {
    const unmade = new Bench({
      openTransport: () => {
        throw new ConnectionError('PORT_UNAVAILABLE', 'taken')
      },
    })
    const first = unmade.follow(unmade.connection.connect())
    await unmade.settle()
    expect([first.told, unmade.state]).toEqual(['PORT_UNAVAILABLE notSent', 'waiting'])

    const unopened = new Bench()
    const spent = unopened.memory.open()
    spent.close()
    const second = new Bench({ openTransport: () => spent })
    const failed = second.follow(second.connection.connect())
    await second.settle()
    expect([failed.told, second.state]).toEqual(['DISCONNECTED unknown', 'waiting'])
    expect(failed.error?.message).toContain('Unexpected failure')
  })
})

describe('while the connection is being restored', () => {
  test('every call fails at once with the reason and its causes', async () => {
    const bench = await Bench.connected()
    bench.memory.refuse = true
    bench.plc.peers[0]?.reset()
    await bench.settle()
    // The first attempt after a good connection: calls may wait for it.
    const waiting = bench.read(100)
    expect([bench.state, waiting.told]).toEqual(['waiting', 'pending'])
    await bench.pass(50)
    expect(waiting.told).toBe('OFFLINE notSent')
    const [read, connecting] = [bench.read(100), bench.follow(bench.connection.connect())]
    await bench.settle()
    for (const { error } of [read, connecting]) {
      expect(error).toMatchObject({ code: 'OFFLINE', outcome: 'notSent', cause: { code: 'CONNECT_FAILED' } })
    }
    expect(bench.connection.state).toMatchObject({ name: 'waiting', attempt: 1 })
    expect(bench.connection.state.nextAttempt).toBe(bench.clock.time() + 250)
    bench.memory.refuse = false
    await bench.pass(250)
    expect(bench.state).toBe('connected')
    const after = bench.read(100)
    await bench.settle()
    expect(after.told).toEqual({ values: [100] })
  })

  test.each(kinds)('a night without the PLC: a bounded number of attempts, nothing grows (%s)', async (kind) => {
    const bench = new Bench({ kind, supervisor: { first: 500, longest: 30_000, settleGap: 50, random: () => 0.5 } })
    const abort = new AbortController()
    bench.memory.refuse = true
    bench.follow(bench.connection.connect())
    const hour = 3_600_000
    for (let hours = 0; hours < 8; hours++) {
      const before = bench.connection.statistics.connects
      await bench.pass(hour)
      // One pause of at most 30 s each, and what comes before the pauses are that long.
      const attempts = bench.connection.statistics.connects - before
      expect(attempts).toBeGreaterThanOrEqual(hour / 30_000)
      expect(attempts).toBeLessThanOrEqual(hour / 15_000 + 8)
      const read = bench.read(1, { signal: abort.signal })
      await bench.settle()
      expect(read.told).toBe('OFFLINE notSent')
      expect(bench.leftovers).toEqual({ timers: 1, connections: 0, unsettled: 0 })
    }
    bench.memory.refuse = false
    await bench.pass(30_000)
    expect(bench.state).toBe('connected')
    bench.connection.close()
    await bench.settle()
    expect(bench.leftovers).toEqual({ timers: 0, connections: 0, unsettled: 0 })
  })

  test('a PLC that takes every connection and ends it at once is not stormed', async () => {
    const bench = new Bench()
    bench.follow(bench.connection.connect())
    bench.plc.probe = (asked) => {
      asked.reply()
      asked.peer.close()
    }
    await bench.pass(8 * 3_600_000)
    expect(bench.connection.statistics.connects).toBeLessThan((8 * 3600) / 15 + 10)
    expect(bench.leftovers).toEqual({ timers: 1, connections: 0, unsettled: 0 })
  })

  test('between its own close and the next connection there is the settle gap', async () => {
    const bench = await Bench.connected()
    bench.plc.script = ({ peer }) => peer.send(Buffer.from('rubbish'))
    bench.read(100)
    await bench.settle()
    expect([bench.state, bench.plc.open]).toEqual(['waiting', 0])
    await bench.pass(49)
    expect(bench.plc.peers).toHaveLength(1)
    await bench.pass(1)
    expect([bench.plc.peers.length, bench.state]).toEqual([2, 'connected'])
  })
})

describe('options of a call', () => {
  const wrong: readonly [string, unknown, string][] = [
    ['a text', { timeout: '3000' }, 'timeout is 3000; it must be a number of milliseconds'],
    ['NaN', { timeout: Number.NaN }, 'timeout is NaN'],
    ['0', { timeout: 0 }, 'more than 0'],
    ['a negative time', { timeout: -5 }, 'more than 0'],
    ['for ever', { timeout: Number.POSITIVE_INFINITY }, 'at most 86400000'],
    ['no signal', { signal: {} }, 'signal is no AbortSignal'],
    ['the controller for its signal', { signal: new AbortController() }, 'signal is no AbortSignal'],
    ['no object', 3000, 'The options of a call are an object'],
    ['null', null, 'The options of a call are an object'],
  ]
  test.each(wrong)('that are %s are refused, and nothing is sent', async (_what, options, says) => {
    const bench = await Bench.connected()
    const read = bench.read(100, options as { timeout: number })
    const connecting = new Bench()
    const connect = connecting.follow(connecting.connection.connect(options as { timeout: number }))
    await bench.settle()
    for (const { error } of [read, connect]) {
      expect(error).toBeInstanceOf(RequestError)
      expect(error).toMatchObject({ code: 'BAD_OPTION', outcome: 'notSent' })
      expect(error?.message).toContain(says)
    }
    expect([bench.plc.asked, bench.connection.statistics.requests, connecting.state]).toEqual([[], 0, 'idle'])
  })
})
