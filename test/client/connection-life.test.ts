// The life of a connection: lost, silent, reset, renewed, closed; and what becomes of the calls on it.
import { describe, expect, test } from '@jest/globals'
import { Bench } from './bench'
import { replying, type Script, silent } from './scripted-plc'

const frames = ['3E', '4E'] as const
const kinds = ['stream', 'datagram'] as const
const everyLink = frames.flatMap((frame) => kinds.map((kind) => ({ frame, kind })))

describe.each(frames)('a connection that the PLC ends, %s', (frame) => {
  test('what was in flight is unknown and never sent again; what waited is sent on the next one', async () => {
    const bench = await Bench.connected({ frame })
    bench.plc.script = (asked) => {
      asked.answer()
      asked.peer.reset()
    }
    const [write, read, second] = [bench.write(100, 7), bench.read(200), bench.write(300, 8)]
    bench.plc.onConnection = () => {
      bench.plc.script = (asked) => asked.reply()
    }
    await bench.settle()
    expect([write.told, read.told, second.told]).toEqual(['DISCONNECTED unknown', 'pending', 'pending'])
    expect(write.error?.message).toContain('whether the PLC carried it out is not known')
    await bench.pass(60_000)
    expect([read.told, second.told]).toEqual([{ values: [200] }, {}])
    expect(bench.plc.asked).toEqual(['writeWords 100', 'writeWords 300', 'readWords 200'])
  })

  test('what waited keeps its deadline over the reconnection', async () => {
    const bench = await Bench.connected({ frame })
    bench.plc.script = ({ peer }) => peer.close()
    const [inFlight, brief] = [bench.read(1), bench.read(2, { timeout: 40 })]
    await bench.pass(40)
    expect([inFlight.told, brief.told]).toEqual(['DISCONNECTED unknown', 'TIMEOUT notSent'])
    expect(brief.error?.message).toContain('there is no connection to the PLC yet. The PLC closed the connection')
    await bench.pass(10_000)
    expect(bench.plc.asked).toEqual(['readWords 1'])
  })

  test('is made again in the background, without any call', async () => {
    const bench = await Bench.connected({ frame })
    bench.plc.peers[0]?.close()
    await bench.pass(50)
    expect([bench.state, bench.plc.peers.length]).toEqual(['connected', 2])
    expect(bench.states.map(({ name }) => name)).toEqual(['waiting', 'connecting', 'connected'])
    expect(bench.connection.generation).toBe(2)
  })
})

describe('a PLC that falls silent', () => {
  test('4E: a missing answer costs nothing else; two in a row, without any in between, cost the connection', async () => {
    const bench = await Bench.connected({ frame: '4E' })
    bench.plc.script = ({ device, reply }) => device === 200 && reply()
    for (const number of [100, 200, 300, 200, 400]) {
      const read = bench.read(number)
      await bench.pass(1000)
      expect(read.told).toEqual(number === 200 ? { values: [200] } : 'TIMEOUT unknown')
    }
    expect([bench.state, bench.plc.peers.length]).toEqual(['connected', 1])
    const last = bench.read(500, { timeout: 900 })
    const waiting = bench.read(200, { timeout: 5000 })
    bench.plc.onConnection = () => {
      bench.plc.script = (asked) => asked.reply()
    }
    await bench.pass(900)
    expect(last.told).toBe('TIMEOUT unknown')
    expect(bench.connection.state.error).toMatchObject({ code: 'SILENT', outcome: 'unknown' })
    await bench.pass(50)
    expect([bench.state, bench.plc.peers.length, waiting.told]).toEqual(['connected', 2, { values: [200] }])
  })

  test('4E: late answers show that it is alive too, and are never taken for the next ones', async () => {
    const bench = await Bench.connected({ frame: '4E', timeout: 100 })
    bench.plc.script = ({ reply }) => void bench.clock.timer(150, reply)
    for (let number = 1; number <= 10; number++) {
      const read = bench.read(number)
      await bench.pass(150)
      expect(read.told).toBe('TIMEOUT unknown')
    }
    expect([bench.state, bench.plc.peers.length]).toEqual(['connected', 1])
    expect(bench.connection.statistics).toMatchObject({ stale: 10, timeouts: 10, answered: 0, disconnects: 0 })
  })

  test('3E on a stream: one missing answer costs the connection, for a late one could not be told', async () => {
    const bench = await Bench.connected({ frame: '3E' })
    let late = () => {}
    bench.plc.script = ({ reply }) => {
      late = reply
    }
    const [lost, waiting] = [bench.read(100), bench.read(200, { timeout: 5000 })]
    await bench.pass(1000)
    expect([lost.told, waiting.told]).toEqual(['TIMEOUT unknown', 'pending'])
    expect(bench.connection.state.error).toMatchObject({ code: 'DISCONNECTED' })
    expect(bench.connection.state.error?.message).toContain('a late answer could not be told from the next one')
    bench.plc.script = (asked) => asked.reply()
    late()
    await bench.pass(50)
    expect(waiting.told).toEqual({ values: [200] })
    expect(bench.connection.statistics).toMatchObject({ protocolErrors: 0, disconnects: 1, connects: 2 })
  })
})

describe('3E by datagrams', () => {
  test('leaves from a new port after every answer and every timeout: nothing late can arrive', async () => {
    const bench = await Bench.connected({ frame: '3E', kind: 'datagram' })
    bench.renewed = 0
    const replies: (() => void)[] = []
    bench.plc.script = ({ reply }) => {
      reply()
      replies.push(reply)
    }
    for (const number of [1, 2, 3]) {
      const read = bench.read(number)
      await bench.settle()
      // The answer comes twice, and all those before it once more.
      for (const reply of replies) reply()
      await bench.settle()
      expect(read.told).toEqual({ values: [number] })
    }
    expect(bench.renewed).toBe(3)
    bench.plc.script = ({ reply }) => void replies.push(reply)
    const lost = bench.read(4)
    await bench.pass(1000)
    expect([lost.told, bench.renewed, bench.state]).toEqual(['TIMEOUT unknown', 4, 'connected'])
    for (const reply of replies) reply()
    bench.plc.script = (asked) => asked.reply()
    const next = bench.read(5)
    await bench.settle()
    expect(next.told).toEqual({ values: [5] })
    expect(bench.connection.statistics).toMatchObject({ stale: 0, protocolErrors: 0, connects: 1 })
  })

  describe('from a fixed port, where a late answer can come to the next request', () => {
    const fixed = { frame: '3E', kind: 'datagram', fixedPort: true } as const

    test('nothing is sent before a self test has come back; what comes before it is thrown away, however late', async () => {
      const bench = await Bench.connected(fixed)
      const late: (() => void)[] = []
      const echoes: (() => void)[] = []
      bench.plc.script = ({ reply }) => void late.push(reply)
      const [lost, waiting] = [bench.read(100), bench.read(200, { timeout: 10_000 })]
      await bench.settle()
      // The proof of the first request has come back; from here on the PLC is slow.
      bench.plc.proof = ({ reply }) => void echoes.push(reply)
      await bench.pass(1000)
      expect([lost.told, bench.state, bench.plc.asked]).toEqual(['TIMEOUT unknown', 'connected', ['readWords 100']])
      bench.plc.script = replying
      await bench.pass(5000)
      // In order: first the late answer, then what was asked behind it.
      late[0]?.()
      await bench.settle()
      expect([waiting.told, bench.plc.asked]).toEqual(['pending', ['readWords 100']])
      // Only the latest proves it: what was asked before it could still be refused.
      for (const echo of echoes.slice(0, -1)) echo()
      await bench.settle()
      expect([waiting.told, bench.plc.asked]).toEqual(['pending', ['readWords 100']])
      echoes.at(-1)?.()
      await bench.settle()
      expect(waiting.told).toEqual({ values: [200] })
      expect(bench.connection.statistics).toMatchObject({ stale: echoes.length, protocolErrors: 0, connects: 1 })
    })

    test('every answer twice, and echoes again and again, are told from the answer to the request', async () => {
      const bench = await Bench.connected(fixed)
      const replies: (() => void)[] = []
      const twice: Script = ({ reply }) => {
        for (const earlier of replies) earlier()
        reply()
        reply()
        replies.push(reply)
      }
      // Only echoes may come behind a fence that stands: an older answer would have come before the echo.
      const echoes: (() => void)[] = []
      bench.plc.proof = ({ reply }) => {
        for (const earlier of replies.splice(0)) earlier()
        reply()
        reply()
        echoes.push(reply)
      }
      bench.plc.script = (asked) => {
        for (const echo of echoes) echo()
        twice(asked)
      }
      for (const number of [1, 2, 3, 4, 5]) {
        const read = bench.read(number)
        await bench.settle()
        expect(read.told).toEqual({ values: [number] })
      }
      expect(bench.connection.statistics).toMatchObject({ protocolErrors: 0, connects: 1, timeouts: 0 })
    })

    test('a self test that was lost is asked again, with another pattern', async () => {
      const bench = await Bench.connected(fixed)
      const patterns: string[] = []
      bench.plc.proof = ({ frame, reply }) => {
        patterns.push(frame.body.subarray(-16).toString('latin1'))
        if (patterns.length === 2) reply()
      }
      const read = bench.read(7)
      await bench.pass(250)
      expect(read.told).toEqual({ values: [7] })
      expect(patterns).toHaveLength(2)
      expect(patterns[0]).not.toBe(patterns[1])
    })

    test('a request whose proof does not come back ends as not sent, and the PLC never sees it', async () => {
      const bench = await Bench.connected(fixed)
      bench.plc.proof = silent
      const write = bench.follow(bench.connection.request(bench.ask.write(1, 77)))
      await bench.pass(1000)
      expect(write.told).toBe('TIMEOUT notSent')
      expect(bench.plc.asked).toEqual([])
      expect(bench.plc.words[1]).toBe(1)
    })

    test('a PLC that answers the self test with an end code is not believed', async () => {
      const bench = await Bench.connected(fixed)
      bench.plc.proof = ({ peer, refuse }) => peer.send(refuse(0xc059))
      const read = bench.read(1)
      await bench.pass(1000)
      expect([read.told, bench.plc.asked]).toEqual(['TIMEOUT notSent', []])
    })

    test('a request that is given up while its proof is under way is never sent', async () => {
      const bench = await Bench.connected(fixed)
      let echo = () => {}
      bench.plc.proof = ({ reply }) => {
        echo = reply
      }
      const abort = new AbortController()
      const write = bench.follow(bench.connection.request(bench.ask.write(1, 77), { signal: abort.signal }))
      await bench.settle()
      abort.abort()
      echo()
      await bench.settle()
      expect([write.told, bench.plc.asked]).toEqual(['ABORTED notSent', []])
      // It stands for the next one all the same.
      const read = bench.read(2)
      await bench.settle()
      expect([read.told, bench.plc.asked]).toEqual([{ values: [2] }, ['readWords 2']])
    })
  })

  test('4E on a fixed port needs no rest: the numbers tell, also over a reconnection', async () => {
    const bench = await Bench.connected({ frame: '4E', kind: 'datagram', fixedPort: true })
    bench.plc.script = silent
    const lost = [bench.read(1), bench.read(2)]
    await bench.pass(1000)
    expect([lost[0]?.told, bench.renewed]).toEqual(['TIMEOUT unknown', 0])
  })
})

describe.each(everyLink)('a command that is not answered when it succeeds, $frame by $kind', (link) => {
  test('succeeds by silence, and the connection is made anew', async () => {
    const bench = await Bench.connected(link)
    bench.plc.script = silent
    const reset = bench.follow(bench.connection.request(bench.ask.reset()))
    const waiting = bench.read(100, { timeout: 5000 })
    await bench.pass(999)
    expect(reset.told).toBe('pending')
    bench.plc.script = (asked) => asked.reply()
    await bench.pass(1)
    expect([reset.told, bench.state, bench.connection.statistics.timeouts]).toEqual([{}, 'waiting', 0])
    await bench.pass(50)
    expect([bench.plc.asked, waiting.told]).toEqual([['remoteReset', 'readWords 100'], { values: [100] }])
  })

  test('a refusal is a refusal, and an answer is an answer', async () => {
    const bench = await Bench.connected(link)
    bench.plc.script = (asked) => asked.peer.send(asked.refuse(0x4013))
    const refused = bench.follow(bench.connection.request(bench.ask.reset()))
    await bench.settle()
    expect(refused.error).toMatchObject({ endCode: 0x4013, outcome: 'refused' })
    bench.plc.script = (asked) => asked.reply()
    const answered = bench.follow(bench.connection.request(bench.ask.reset()))
    await bench.settle()
    expect([answered.told, bench.state]).toEqual([{}, 'connected'])
  })

  test('rubbish is no success', async () => {
    const bench = await Bench.connected(link)
    bench.plc.script = ({ peer }) => peer.send(Buffer.from('rubbish'))
    const reset = bench.follow(bench.connection.request(bench.ask.reset()))
    await bench.settle()
    expect(reset.told).toBe('BAD_FRAME unknown')
  })

  test('close in flight is no success', async () => {
    const bench = await Bench.connected(link)
    bench.plc.script = silent
    const reset = bench.follow(bench.connection.request(bench.ask.reset()))
    await bench.settle()
    bench.connection.close()
    await bench.settle()
    expect(reset.told).toBe('CLOSED unknown')
  })
})

describe.each(frames)('a command that is not answered, %s', (frame) => {
  test.each(['close', 'reset'] as const)(
    'succeeds by a lost connection (%s), which is what a reset does',
    async (how) => {
      const bench = await Bench.connected({ frame })
      bench.plc.script = ({ peer }) => peer[how]()
      const reset = bench.follow(bench.connection.request(bench.ask.reset()))
      const write = bench.write(1, 1)
      await bench.pass(1000)
      expect([reset.told, write.told]).toEqual([{}, 'DISCONNECTED unknown'])
      expect(bench.plc.asked).toEqual(['remoteReset', 'writeWords 1'])
    },
  )
})

test.each(frames)('a reset that was not even sent is no success, %s', async (frame) => {
  const bench = await Bench.connected({ frame })
  bench.plc.script = ({ peer }) => peer.close()
  const [read, reset] = [bench.read(1), bench.follow(bench.connection.request(bench.ask.reset()))]
  await bench.settle()
  expect([read.told, reset.told]).toEqual(['DISCONNECTED unknown', 'pending'])
  bench.plc.script = (asked) => asked.reply()
  await bench.pass(50)
  expect([bench.plc.asked, reset.told]).toEqual([['readWords 1', 'remoteReset'], {}])
})

test('a reset by datagram to a port where nothing listens is no success', async () => {
  const bench = await Bench.connected({ kind: 'datagram' })
  bench.memory.refuse = true
  const reset = bench.follow(bench.connection.request(bench.ask.reset()))
  await bench.settle()
  expect(reset.told).toBe('DISCONNECTED unknown')
  expect(bench.plc.asked).toEqual([])
})

describe.each(everyLink)('close, $frame by $kind', (link) => {
  test('settles everything once and leaves nothing behind', async () => {
    const bench = await Bench.connected(link)
    bench.plc.script = silent
    const calls = [bench.write(1, 1), bench.read(2), bench.write(3, 1)]
    await bench.settle()
    bench.connection.close()
    bench.connection.close()
    await bench.settle()
    expect(calls.map(({ told }) => told)).toEqual(['CLOSED unknown', 'CLOSED notSent', 'CLOSED notSent'])
    expect(calls[0]?.error?.message).toBe('Write (word units) was in flight when the client was closed.')
    expect(bench.states.map(({ name }) => name)).toEqual(['closed'])
    const after = [bench.read(4), bench.follow(bench.connection.connect())]
    await bench.pass(60_000)
    expect(after.map(({ told }) => told)).toEqual(['CLOSED notSent', 'CLOSED notSent'])
    expect(bench.leftovers).toEqual({ timers: 0, connections: 0, unsettled: 0 })
    expect([bench.states.length, bench.connection.statistics]).toEqual([
      1,
      expect.objectContaining({ inFlight: 0, queued: 0 }),
    ])
  })

  test('while connecting ends the attempt', async () => {
    const bench = new Bench(link)
    const calls = [bench.follow(bench.connection.connect()), bench.read(1)]
    bench.connection.close()
    await bench.pass(60_000)
    expect(calls.map(({ told }) => told)).toEqual(['CLOSED notSent', 'CLOSED notSent'])
    expect([bench.leftovers.timers, bench.plc.open, bench.plc.probes]).toEqual([0, 0, 0])
  })

  test('while waiting for the next attempt ends the waiting', async () => {
    const bench = await Bench.connected(link)
    bench.plc.script = ({ peer }) => peer.send(Buffer.from('rubbish'))
    bench.read(1)
    await bench.settle()
    expect(bench.state).toBe('waiting')
    const held = bench.read(2)
    bench.connection.close()
    await bench.pass(60_000)
    expect([held.told, bench.connection.statistics.connects]).toEqual(['CLOSED notSent', 1])
    expect(bench.leftovers).toEqual({ timers: 0, connections: 0, unsettled: 0 })
  })
})
