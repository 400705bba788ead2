import { describe, expect, test } from '@jest/globals'
import { ClosedError, RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import type { PlcSimulatorOptions } from '../../src/simulator/options'
import { createPlcSimulator, type RequestEvent, type WriteEvent } from '../../src/simulator/simulator'
import { manualClock } from '../support/manual-clock'
import { openHandles, record, settle } from '../transport/recorder'
import { join } from './support'
import { bench, done, open, type Protocol, readD, refused, until, withClient, word, writeD } from './wire'

const PROTOCOLS: readonly Protocol[] = ['tcp', 'udp']

describe.each(PROTOCOLS)('over %s', (protocol) => {
  test('answers 3E and 4E on the same port', () =>
    withClient(protocol, {}, async (plc, { transport, bytes }) => {
      plc.write('D5', 0x1234)
      transport.send(readD(5))
      expect(await bytes(13)).toEqual(word(0x1234))
      transport.send(readD(5, 0xbeef))
      expect((await bytes(13 + 17)).subarray(13)).toEqual(word(0x1234, 0xbeef))
    }))

  test.each([
    ['ASCII to a binary port', 'binary', Buffer.from('500000FF03FF000018000004010000D*0000000001')],
    ['binary to an ASCII port', 'ascii', readD(0)],
    ['neither', 'binary', Buffer.from('GET / HTTP/1.1\r\n\r\n')],
  ] as const)('%s is answered by silence, the connection lives and the error is logged', (_, code, wrong) =>
    withClient(protocol, { code }, async (plc, { transport, bytes, calls }) => {
      const right = code === 'binary' ? readD(0) : Buffer.from('500000FF03FF000018000004010000D*0000000001')
      transport.send(wrong)
      // Only bytes that came in another chunk than the wrong ones can be told from them.
      await until(() => plc.statistics.unreadable > 0)
      expect(calls).toEqual(['opened'])
      transport.send(right)
      const answer = code === 'binary' ? word(0) : Buffer.from('D00000FF03FF00000800000000')
      expect(await bytes(answer.length)).toEqual(answer)
      expect(plc.errors.entries.map(({ endCode }) => endCode)).toEqual([0xc06f])
    }),
  )

  test('a 4E request to a 3E PLC is answered by silence', () =>
    withClient(protocol, { profile: 'iq-f' }, async (plc, { transport, chunks }) => {
      transport.send(readD(0, 1))
      await until(() => plc.statistics.unreadable > 0)
      expect(chunks).toEqual([])
    }))

  test('several clients at once, each with its own monitor registration', async () => {
    const { plc, client, close } = await bench()
    const clients = await Promise.all(Array.from({ length: 8 }, () => client(protocol)))
    const entry = (n: number) => Buffer.from(`500000ffff03000c000000010800000100${hex(n)}0000a8`, 'hex')
    const execute = Buffer.from('500000ffff03000600000002080000', 'hex')
    for (let n = 0; n < 8; n++) plc.memory.setWord('D', n, 100 + n)
    await Promise.all(
      clients.map(async ({ transport, bytes }, n) => {
        transport.send(entry(n))
        await bytes(11)
        transport.send(execute)
        expect((await bytes(11 + 13)).subarray(11)).toEqual(word(100 + n))
      }),
    )
    expect(plc.connections).toHaveLength(8)
    const [first] = clients
    const late = await client(protocol)
    late.transport.send(execute)
    expect(await late.bytes(20)).toEqual(refused(0xc05d, undefined, '0208'))
    expect(first?.chunks).toHaveLength(2)
    await close()
  })
})

function hex(byte: number): string {
  return byte.toString(16).padStart(2, '0')
}

describe('TCP', () => {
  test('requests of one connection are answered in order, however they arrive', () =>
    withClient('tcp', {}, async (plc, { transport, bytes }) => {
      for (let n = 0; n < 20; n++) plc.memory.setWord('D', n, n)
      const all = Buffer.concat(Array.from({ length: 20 }, (_, n) => readD(n, n)))
      for (let at = 0; at < all.length; at += 7) transport.send(all.subarray(at, at + 7))
      expect(await bytes(20 * 17)).toEqual(Buffer.concat(Array.from({ length: 20 }, (_, n) => word(n, n))))
    }))

  test('a reset drops the connections and answers nothing', async () => {
    const { plc, client, close } = await bench({ resetAllowed: true, restartTime: 20 })
    const [first, second] = [await client('tcp'), await client('tcp')]
    first.transport.send(Buffer.from('500000ffff030008000000021000000100', 'hex'))
    expect(await first.bytes(11)).toEqual(done())
    const restarted = new Promise<void>((resolve) => plc.on('restart', () => resolve()))
    first.transport.send(Buffer.from('500000ffff030008000000061000000100', 'hex'))
    const errors = await Promise.all([first.closed, second.closed])
    expect(errors.map((error) => error?.code)).toEqual(['DISCONNECTED', 'DISCONNECTED'])
    expect(first.chunks).toHaveLength(1)
    await restarted
    const again = await client('tcp')
    again.transport.send(readD(0))
    expect(await again.bytes(13)).toEqual(word(0))
    expect(plc.cpu.state).toBe('RUN')
    await close()
  })

  test('more connections than entries are accepted and closed at once; a free entry is taken again', async () => {
    const { plc, client, close } = await bench({ maxConnections: 2 })
    const [first] = [await client('tcp'), await client('tcp')]
    const third = await client('tcp')
    expect(await third.closed).toBeUndefined()
    expect(third.calls).toEqual(['opened', 'closed'])
    const freed = new Promise<void>((resolve) => {
      plc.on('connection', ({ change }) => change === 'closed' && resolve())
    })
    first?.transport.close()
    await freed
    const fourth = await client('tcp')
    fourth.transport.send(readD(0))
    expect(await fourth.bytes(13)).toEqual(word(0))
    expect(plc.statistics).toMatchObject({ connections: 4, turnedAway: 1 })
    await close()
  })

  test('an iQ-F has 8 entries, the others 16', async () => {
    for (const [profile, entries] of [
      ['iq-f', 8],
      ['q', 16],
    ] as const) {
      const { plc, connect, asker } = join({ profile })
      const more = Array.from({ length: entries }, () => connect())
      expect([asker, ...more].filter(({ closed }) => closed)).toEqual([more.at(-1)])
      expect(plc.connections).toHaveLength(entries)
    }
  })

  test('an entry stays taken for entryRelease', () => {
    const { asker, clock, connect } = join({ maxConnections: 1, entryRelease: 500 })
    asker.close()
    expect(connect().closed).toBe(true)
    clock.advance(500)
    expect(connect().closed).toBe(false)
  })
})

describe('UDP', () => {
  test('iQ-F discards what comes before the last answer; the scan answers the first', async () => {
    const clock = manualClock()
    await withClient('udp', { profile: 'iq-f', scanTime: 10, clock }, async (plc, { transport, bytes, chunks }) => {
      plc.write('D1', 1)
      plc.write('D2', 2)
      transport.send(readD(1))
      transport.send(readD(2))
      await until(() => plc.statistics.discarded > 0)
      clock.advance(10)
      expect(await bytes(13)).toEqual(word(1))
      transport.send(readD(2))
      await until(() => plc.statistics.requests >= 3)
      clock.advance(10)
      expect((await bytes(26)).subarray(13)).toEqual(word(2))
      expect(chunks).toHaveLength(2)
    })
  })

  test('iQ-R holds 33 requests', () => {
    const clock = manualClock()
    const plc = createPlcSimulator({ clock, scanTime: 10 })
    const answers: Buffer[] = []
    const transport = plc.connect({ kind: 'datagram', delivery: 'synchronous' })()
    transport.open({ opened() {}, received: (bytes) => void answers.push(bytes), closed() {} })
    for (let serial = 0; serial < 40; serial++) transport.send(readD(0, serial))
    clock.advance(1000)
    expect(answers).toEqual(Array.from({ length: 33 }, (_, serial) => word(0, serial)))
    expect(plc.statistics.discarded).toBe(7)
  })
})

describe('scan time', () => {
  test('in RUN an answer waits for the END processing, in STOP it does not', () => {
    const { plc, clock, asker } = join({ scanTime: 10 })
    asker.send(readD(0, 1))
    clock.advance(9)
    expect(asker.received).toEqual([])
    clock.advance(1)
    expect(asker.received).toHaveLength(1)
    plc.cpu.switch = 'STOP'
    asker.send(readD(0, 2))
    expect(asker.received).toHaveLength(2)
  })

  test('requests of one connection are carried out one per scan', () => {
    const { plc, clock, asker } = join({ scanTime: 10 })
    for (const value of [1, 2, 3]) asker.send(writeD(0, value, value))
    const seen = [1, 2, 3].map(() => {
      clock.advance(10)
      return plc.memory.word('D', 0)
    })
    expect(seen).toEqual([1, 2, 3])
  })
})

describe('events', () => {
  test('write tells the programs what a client has written, request every request with its end code', () => {
    const { plc, asker } = join()
    const writes: WriteEvent[] = []
    const requests: RequestEvent[] = []
    plc.on('write', (event) => void writes.push(event))
    const end = plc.on('request', (event) => void requests.push(event))
    const head = { device: 'M', number: 0 } as const
    asker.ask(commands.writeBits, { head, values: [true] })
    asker.endCode(commands.writeBits, { head: { device: 'M', number: 12288 }, values: [true] })
    asker.ask(commands.readBits, { head, points: 1 })
    end()
    asker.ask(commands.readBits, { head, points: 1 })
    expect(writes).toMatchObject([
      { command: 'writeBits', message: { head, values: [true] }, connection: 1, frame: '4E' },
    ])
    expect(requests.map(({ command, endCode }) => [command, endCode])).toEqual([
      ['writeBits', 0],
      ['writeBits', 0x4031],
      ['readBits', 0],
    ])
  })

  test('connection tells who comes and goes', () => {
    const { plc, connect } = join()
    const changes: string[] = []
    plc.on('connection', ({ change, connection }) => void changes.push(`${connection.id} ${change}`))
    connect().close()
    expect(changes).toEqual(['2 opened', '2 closed'])
  })

  test('what a client has just written is there for the listener', () => {
    const { plc, asker } = join()
    const seen: unknown[] = []
    plc.on('write', () => void seen.push(plc.read('D0')))
    asker.ask(commands.writeWords, { head: { device: 'D', number: 0 }, values: [42] })
    expect(seen).toEqual([42])
  })
})

describe('remote control over sockets', () => {
  const stop = Buffer.from('500000ffff030008000000021000000100', 'hex')
  const run = Buffer.from('500000ffff03000a0000000110000001000000', 'hex')

  test.each([
    ['host', done()],
    ['connection', refused(0x408b, undefined, '0110')],
  ] as const)('remoteOwner %s: who may RUN again', async (remoteOwner, answer) => {
    const { client, close } = await bench({ remoteOwner })
    const [first, second] = [await client('tcp'), await client('udp')]
    first.transport.send(stop)
    await first.bytes(11)
    second.transport.send(run)
    expect(await second.bytes(answer.length)).toEqual(answer)
    await close()
  })
})

/** Sockets and timers once those of earlier tests are gone. */
async function quietHandles(): Promise<string[]> {
  for (let turn = 0; turn < 100 && openHandles().some((name) => /TCP|UDP/.test(name)); turn++) await settle()
  return openHandles()
}

describe('listening and closing', () => {
  test('close leaves no sockets and no timers, with clients connected and answers under way', async () => {
    const before = await quietHandles()
    const plc = createPlcSimulator({ scanTime: 60_000, restartTime: 60_000 })
    await plc.listen()
    const clients = [record(open(plc, 'tcp')), record(open(plc, 'udp'))]
    await Promise.all(clients.map(({ opened }) => opened))
    for (const { transport } of clients) transport.send(readD(0))
    await until(() => plc.statistics.requests >= 2)
    plc.faults.add({ kind: 'delay', ms: 60_000 })
    plc.restart()
    const closing = plc.close()
    expect(plc.close()).toBe(closing)
    await closing
    for (const { transport } of clients) transport.close()
    await settle()
    expect(await quietHandles()).toEqual(before)
    expect([plc.tcp, plc.udp]).toEqual([undefined, undefined])
  })

  test('close while listening starts', async () => {
    const before = await quietHandles()
    const plc = createPlcSimulator()
    const listening = plc.listen()
    await plc.close()
    await listening
    await settle()
    expect([plc.tcp, await quietHandles()]).toEqual([undefined, before])
  })

  test('a taken port is said so, and nothing listens then', async () => {
    const first = createPlcSimulator()
    await first.listen()
    const second = createPlcSimulator({ udp: { port: first.udp?.port ?? 0 } })
    await expect(second.listen()).rejects.toThrow(expect.objectContaining({ code: 'PORT_UNAVAILABLE' }))
    expect(second.tcp).toBeUndefined()
    await first.close()
    await second.listen()
    expect(second.udp?.port).toBeGreaterThan(0)
    await second.close()
  })

  test('TCP or UDP can be left out', async () => {
    const plc = createPlcSimulator({ tcp: false })
    await plc.listen()
    expect([plc.tcp, typeof plc.udp?.port]).toEqual([undefined, 'number'])
    await plc.close()
  })

  test('after close nobody can connect', async () => {
    const plc = createPlcSimulator()
    const openTransport = plc.connect({ delivery: 'synchronous' })
    await plc.close()
    const { calls } = record(openTransport())
    expect(calls).toEqual(['closed'])
    expect(() => plc.connect()).toThrow(ClosedError)
    await expect(plc.listen()).rejects.toBeInstanceOf(ClosedError)
  })
})

describe('options', () => {
  const wrong: readonly (readonly [string, PlcSimulatorOptions])[] = [
    ['frames', { profile: 'iq-f', frames: ['4E'] }],
    ['frames', { frames: [] }],
    ['maxConnections', { maxConnections: 0 }],
    ['scanTime', { scanTime: -1 }],
    ['restartTime', { restartTime: Number.NaN }],
    ['model.name', { model: { name: 'A model name that is too long', code: 1 } }],
    ['model.name', { model: { name: 'りんご', code: 1 } }],
    ['model.code', { model: { name: 'R08CPU', code: 0x10000 } }],
    ['maxConnexions', JSON.parse('{ "maxConnexions": 3 }')],
    ['code', JSON.parse('{ "code": "hex" }')],
    ['latch', JSON.parse('{ "latch": ["Q"] }')],
  ]
  test.each(wrong)('%s is refused', (field, options) => {
    expect(() => createPlcSimulator(options)).toThrow(expect.objectContaining({ code: 'BAD_OPTION', field }))
    expect(() => createPlcSimulator(options)).toThrow(RequestError)
  })

  test('the model answers what it was given', () => {
    const { asker } = join({ model: { name: 'R120CPU', code: 0x4804 } })
    expect(asker.ask(commands.readTypeName, {})).toEqual({ model: 'R120CPU         ', modelCode: 0x4804 })
  })
})
