/** On-demand from the simulated PLC to clients, over sockets and in memory. */
import { describe, expect, test } from '@jest/globals'
import { createPlcSimulator, type OnDemandData, type PlcSimulator } from '../../src/entry/simulator'
import { ClosedError, createMelsecClient, type MelsecClient, type OnDemand, RequestError } from '../../src/index'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { nextState, until, withLine } from '../client/line'
import { hex, ON_DEMAND_DATA, ON_DEMAND_WORDS, onDemandFrames, text } from '../melsec/on-demand-frames'
import { bench, readD, word } from './wire'

/** What a client is told, in order. */
function listen(client: MelsecClient): OnDemand[] {
  const told: OnDemand[] = []
  client.on('onDemand', (data) => told.push(data))
  return told
}

const wordsOf = (told: readonly OnDemand[]) => told.map(({ words }) => words)

/** A port of this computer that was free a moment ago. */
async function freeUdpPort(): Promise<number> {
  const plc = createPlcSimulator({ tcp: false })
  await plc.listen()
  const { port = 0 } = plc.udp ?? {}
  await plc.close()
  return port
}

const LINES = ['3E binary', '3E ascii', '4E binary', '4E ascii', 'ext binary']

describe.each(LINES)('over TCP, %s', (line) => {
  test('the client is told what was sent, between its own requests and while it asks nothing', () =>
    withLine(`tcp ${line} iq-r`, {}, async ({ plc, client }) => {
      const told = listen(client)
      await client.connect()
      plc.write('D0', 7)
      for (let i = 0; i < 20; i++) {
        const reading = client.read('D0')
        expect(plc.sendOnDemand([i, 0xffff - i])).toBe(1)
        expect(await reading).toBe(7)
      }
      expect(plc.sendOnDemand(Buffer.from('ABCD'))).toBe(1)
      await until(() => told.length === 21)
      expect(wordsOf(told)).toEqual([...Array.from({ length: 20 }, (_, i) => [i, 0xffff - i]), [0x4241, 0x4443]])
      expect(told[20]?.data).toEqual(Buffer.from('ABCD'))
      expect(plc.statistics.onDemands).toBe(21)
      expect(client.statistics).toMatchObject({ unsolicited: 21, connects: 1, stale: 0, protocolErrors: 0 })
    }))
})

describe.each(LINES)('over UDP, %s', (line) => {
  test('the client is told at its fixed local port', async () => {
    const localPort = await freeUdpPort()
    await withLine(`udp ${line} iq-r`, { client: { localPort } }, async ({ plc, client }) => {
      const told = listen(client)
      await client.connect()
      plc.write('D0', 7)
      expect(await client.read('D0')).toBe(7)
      // With 3E the port is opened anew behind the answer, and a datagram in that moment is lost: as with a real PLC.
      await until(() => {
        if (told.length === 0) expect(plc.sendOnDemand(ON_DEMAND_WORDS)).toBe(1)
        return told.length > 0
      })
      expect(told[0]).toMatchObject({ data: ON_DEMAND_DATA, words: ON_DEMAND_WORDS })
      expect(plc.connections.map(({ remote }) => remote)).toEqual([`127.0.0.1:${localPort}`])
    })
  })
})

describe('the bytes', () => {
  test.each(onDemandFrames)(
    'in a $frame frame in $code code are those of the manual',
    async ({ frame, code, bytes }) => {
      const joined = await bench({ code, profile: 'iq-r' })
      try {
        const client = await joined.client('tcp')
        const serial = frame === '4E' ? 5 : undefined
        client.transport.send(code === 'ascii' ? asciiRead(serial) : readD(0, serial))
        const answer = (code === 'ascii' ? 2 : 1) * word(0, serial).length
        await client.bytes(answer)
        joined.plc.sendOnDemand(ON_DEMAND_WORDS)
        const received = (await client.bytes(answer + bytes.length)).subarray(answer)
        expect(withoutSerial(received, frame, code)).toEqual(withoutSerial(bytes, frame, code))
      } finally {
        await joined.close()
      }
    },
  )

  function asciiRead(serial: number | undefined): Buffer {
    const head = serial === undefined ? '5000' : '5400 0005 0000'
    return text(`${head} 00 FF 03FF 00 0018 0000 0401 0000 D* 000000 0001`)
  }

  function withoutSerial(bytes: Buffer, frame: string, code: string): Buffer {
    if (frame === '3E') return bytes
    const copy = Buffer.from(bytes)
    return code === 'ascii' ? copy.fill('0', 4, 8) : copy.fill(0, 2, 4)
  }
})

describe('who gets it', () => {
  test('every client in its own frame, or those that were chosen', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ plc, client, another }) => {
      const other = another({ frame: '3E' })
      const [told, otherTold] = [listen(client), listen(other)]
      await client.connect()
      await other.connect()
      const frames: string[] = []
      for (const one of [client, other])
        one.on('trace', (entry) => frames.push(...entry.frames.map(({ frame = '' }) => frame)))
      expect(plc.sendOnDemand([1])).toBe(2)
      const [, second] = plc.connections
      expect(plc.sendOnDemand([2], { connections: [second?.id ?? 0] })).toBe(1)
      expect(plc.sendOnDemand([3], { connections: [] })).toBe(0)
      await until(() => told.length + otherTold.length === 3)
      expect([wordsOf(told), wordsOf(otherTold)]).toEqual([[[1]], [[1], [2]]])
      expect(frames.sort()).toEqual(['3E', '3E', '4E'])
    }))

  test('nobody who has asked nothing yet, so that no frame is guessed', async () => {
    const joined = await bench()
    try {
      const client = await joined.client('tcp')
      await until(() => joined.plc.connections.length === 1)
      expect(joined.plc.sendOnDemand([1])).toBe(0)
      client.transport.send(readD(0))
      await client.bytes(word(0).length)
      expect(joined.plc.sendOnDemand([1])).toBe(1)
    } finally {
      await joined.close()
    }
  })

  test('nobody who speaks 1E', () =>
    withLine('tcp 1E binary iq-f', {}, async ({ plc, client }) => {
      await client.connect()
      expect(plc.connections).toHaveLength(1)
      expect(plc.sendOnDemand([1])).toBe(0)
    }))

  test('a client that has come back after a power failure', () =>
    withLine('tcp 3E binary iq-r', { plc: { restartTime: 0 } }, async ({ plc, client }) => {
      const told = listen(client)
      await client.connect()
      plc.restart()
      expect(plc.sendOnDemand([1])).toBe(0)
      await nextState(client, 'waiting')
      await nextState(client, 'connected')
      expect(plc.sendOnDemand([2])).toBe(1)
      await until(() => told.length > 0)
      expect(wordsOf(told)).toEqual([[2]])
    }))
})

describe('in time', () => {
  test('it comes between a request and its answer', () =>
    withLine('tcp 3E binary iq-r', { plc: { scanTime: 20 } }, async ({ plc, client }) => {
      await client.connect()
      const order: string[] = []
      client.on('onDemand', () => order.push('on-demand'))
      const { requests } = plc.statistics
      const reading = client.read('D0').then(() => order.push('answer'))
      await until(() => plc.statistics.requests > requests)
      plc.sendOnDemand([1])
      await reading
      expect(order).toEqual(['on-demand', 'answer'])
    }))

  test.each([
    ['split', { kind: 'split', at: 5, pause: 30 }],
    ['dribble', { kind: 'dribble', size: 1, pause: 2 }],
  ] as const)('it never comes within an answer that arrives in pieces (%s)', (_name, fault) =>
    withLine('tcp 3E binary iq-r', {}, async ({ plc, client }) => {
      const told = listen(client)
      await client.connect()
      plc.write('D0', 9)
      plc.faults.add({ ...fault, times: 1 })
      const { bytesReceived } = client.statistics
      const reading = client.read('D0')
      await until(() => client.statistics.bytesReceived > bytesReceived)
      expect(plc.sendOnDemand([1])).toBe(1)
      expect(plc.sendOnDemand([2])).toBe(1)
      expect(await reading).toBe(9)
      await until(() => told.length === 2)
      expect(wordsOf(told)).toEqual([[1], [2]])
      expect(client.statistics).toMatchObject({ protocolErrors: 0, connects: 1 })
    }),
  )
})

describe('data', () => {
  test('at the limit: 960 words, 1920 bytes', () =>
    withLine('tcp 3E ascii iq-r', {}, async ({ plc, client }) => {
      const told = listen(client)
      await client.connect()
      const words = Array.from({ length: 960 }, (_, i) => i * 68)
      plc.sendOnDemand(words)
      plc.sendOnDemand(Buffer.alloc(1920, 0x5a))
      plc.sendOnDemand([])
      await until(() => told.length === 3)
      expect(wordsOf(told)).toEqual([words, Array(960).fill(0x5a5a), []])
    }))

  test.each<[string, unknown]>([
    ['too many words', Array(961).fill(0)],
    ['too many bytes', Buffer.alloc(1921)],
    ['a word above 65535', [65536]],
    ['a negative word', [-1]],
    ['half a word', [1.5]],
    ['a text as a word', ['1']],
    ['holes', Array(2)],
    ['a BigInt', [1n]],
    ['a text', 'AB'],
    ['a number', 5],
    ['nothing', undefined],
    ['null', null],
    ['an object', {}],
    ['words of another kind', new Uint16Array(2)],
  ])('%s is refused, and nobody gets anything', (_what, data) =>
    withLine('tcp 3E binary iq-r', {}, async ({ plc, client }) => {
      await client.connect()
      expect(() => plc.sendOnDemand(data as OnDemandData)).toThrow(RequestError)
      expect(plc.statistics.onDemands).toBe(0)
    }),
  )

  test('an odd number of bytes needs binary code', async () => {
    const refused = createPlcSimulator({ code: 'ascii' })
    expect(() => refused.sendOnDemand(Buffer.alloc(3))).toThrow(/whole words/)
    await refused.close()
    await withLine('tcp 3E binary iq-r', {}, async ({ plc, client }) => {
      const told = listen(client)
      await client.connect()
      plc.sendOnDemand(Buffer.from([1, 2, 3]))
      await until(() => told.length === 1)
      expect(told[0]).toMatchObject({ data: Buffer.from([1, 2, 3]), words: undefined })
    })
  })

  test("are those of the call, whatever becomes of the caller's bytes", async () => {
    await inMemory(async (plc, told) => {
      const data = Buffer.from([1, 0])
      plc.sendOnDemand(data)
      data.fill(0xff)
      await until(() => told.length === 1)
      expect(wordsOf(told)).toEqual([[1]])
    })
  })
})

test('a connection that is not there is refused, and nobody gets anything', () =>
  inMemory(async (plc) => {
    const [there] = plc.connections
    const send = () => plc.sendOnDemand([1], { connections: [there?.id ?? 0, 77] })
    expect(send).toThrow(expect.objectContaining({ code: 'BAD_OPTION', field: 'connections' }))
    expect(send).toThrow(`There is no connection 77; there are ${there?.id}.`)
    expect(plc.statistics.onDemands).toBe(0)
  }))

test('a client that sends it to the PLC is refused: there it is no command', async () => {
  const joined = await bench({ profile: 'iq-r' })
  try {
    const client = await joined.client('tcp')
    client.transport.send(hex('5000 00 ff ff03 00 0800 1000 0121 0000 0100'))
    const answer = await client.bytes(11)
    expect(answer.subarray(0, 2).toString('hex')).toBe('d000')
    expect(answer.readUInt16LE(9)).toBe(resolveProfile(joined.plc.profile).refusals.command)
  } finally {
    await joined.close()
  }
})

test('a simulator that was closed sends nothing', async () => {
  const plc = createPlcSimulator()
  await plc.close()
  expect(() => plc.sendOnDemand([1])).toThrow(ClosedError)
})

/** A client joined to a simulated PLC in memory. */
async function inMemory(
  run: (plc: PlcSimulator, told: OnDemand[], client: MelsecClient) => Promise<void>,
): Promise<void> {
  const plc = createPlcSimulator({ profile: 'iq-r' })
  const client = createMelsecClient({
    host: 'plc',
    port: 1,
    profile: 'iq-r',
    openTransport: plc.connect(),
  })
  try {
    const told = listen(client)
    await client.connect()
    await run(plc, told, client)
  } finally {
    await client.close()
    await plc.close()
  }
}
