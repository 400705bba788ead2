// A client with the station extension frame, over real sockets: against the simulator, and against answers that are wrong.
import { describe, expect, test } from '@jest/globals'
import { createMelsecClient, type MelsecClientOptions } from '../../src/index'
import { Responder } from '../../src/link/link'
import { type SlmpHead, slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import { listenTcp } from '../../src/transport/listen-tcp'
import { listenUdp } from '../../src/transport/listen-udp'
import type { ServerConnection } from '../../src/transport/transport'
import { failureOf, nextState, withLine } from './line'

const TRANSPORTS = ['tcp', 'udp'] as const
type Transport = (typeof TRANSPORTS)[number]

describe.each(TRANSPORTS)('the simulated PLC over %s', (transport) => {
  const line = `${transport} ext binary iq-r`

  test('answers in the frame it is asked in, beside clients with 4E', () =>
    withLine(line, {}, async ({ plc, client, another }) => {
      const frames: string[] = []
      plc.on('request', ({ frame }) => frames.push(frame))
      const other = another({ frame: '4E' })
      await client.write({ 'D0:DINT': -5, M7: true })
      expect(await other.readValues(['D0:DINT', 'M7'])).toEqual([-5, true])
      await other.write('D0:DINT', 70_000)
      expect(await client.readValues(['D0:DINT', 'M7'])).toEqual([70_000, true])
      expect(new Set(frames)).toEqual(new Set(['ext', '4E']))
      expect(client.statistics).toMatchObject({ connects: 1, protocolErrors: 0, stale: 0 })
    }))

  test('is its own station by the extension field too', () =>
    withLine(line, { client: { route: { station: 124, extensionStation: 65_535 } } }, async ({ plc, client }) => {
      plc.write('D5', 77)
      expect(await client.read('D5')).toBe(77)
    }))

  test('refuses other stations, and says that it was itself', () =>
    withLine(line, { client: { route: { network: 1, station: 300 } } }, async ({ client }) => {
      const error = await failureOf(client.read('D0'))
      expect(error).toMatchObject({
        code: 'END_CODE',
        outcome: 'refused',
        station: 'network 0, station 255, module I/O 03FF, multidrop 0',
      })
    }))

  test('refuses what it cannot do with the end code of the command', () =>
    withLine(line, { plc: { profileOverrides: { ranges: { D: 10 } } } }, async ({ client }) => {
      const error = await failureOf(client.read('D10'))
      expect(error).toMatchObject({ code: 'END_CODE', endCode: 0x4031, command: 'Read (word units)' })
      expect(await client.read('D9')).toBe(0)
    }))

  test('unlocks by its remote password, whichever station is asked', () => {
    const password = 'ext-frame-1'
    return withLine(line, { plc: { password }, client: { password } }, async ({ client, another }) => {
      expect(await client.read('D0')).toBe(0)
      const elsewhere = another({ route: { network: 1, station: 300 } })
      expect(await failureOf(elsewhere.read('D0'))).toMatchObject({ code: 'END_CODE', endCode: expect.any(Number) })
    })
  })

  test('registers a monitor', () =>
    withLine(line, {}, async ({ plc, client }) => {
      const monitor = client.monitor(['D0', 'M3'])
      expect(monitor.mode).toBe('monitor')
      plc.write('D0', 3)
      expect((await monitor.read()).map((result) => result.ok && result.value)).toEqual([3, false])
      plc.write('M3', true)
      expect((await monitor.read()).map((result) => result.ok && result.value)).toEqual([3, true])
    }))

  test('is silent to it where the port does not take the frame, and the causes say so', () =>
    withLine(line, { plc: { frames: ['4E', '3E'] }, client: { timeout: 100 } }, async ({ client }) => {
      const cause =
        'The PLC does not know the station extension frame: try 4E (only an RJ71GN11-T2 knows and relays it).'
      expect(await failureOf(client.connect())).toMatchObject({ causes: expect.arrayContaining([cause]) })
    }))
})

// --- a PLC that is station 300 of network 1, and answers what the test says

const profile = resolveProfile('iq-r')
const framing = slmpFraming('ext', 'binary')
const route = { network: 1, station: 300 }

interface Asked {
  readonly head: SlmpHead
  readonly serial: number
  readonly body: Buffer
}

/** Body of the answer: the command with the fixed values, and this. */
const echoing = ({ body }: Asked, data = '') => Buffer.concat([body.subarray(0, 10), Buffer.from(data, 'hex')])
const answering = (asked: Asked, data = '') => framing.response.write(asked.head, asked.serial, 0, echoing(asked, data))

async function withStation(
  transport: Transport,
  script: (asked: Asked) => readonly Buffer[],
  run: (options: MelsecClientOptions) => Promise<void>,
): Promise<void> {
  const kind = transport === 'tcp' ? 'stream' : 'datagram'
  const head = { network: 0, station: 255, moduleIo: 0x3ff, multidrop: 0, timer: 0 }
  const protocol = new MelsecProtocol({ framing, head, profile, code: 'binary' })
  const accept = (peer: ServerConnection) => {
    const responder = new Responder(framing, kind, () => undefined)
    peer.onReceived = (bytes) => {
      for (const { head: asked, serial = 0, body } of responder.receive(bytes)) {
        const request = protocol.readRequest({ body })
        const isProbe = 'name' in request && request.name === 'readTypeName'
        const given = { head: asked, serial, body }
        // R04CPU, padded to 16 characters, 4800H
        const model = `${Buffer.from('R04CPU          ').toString('hex')}0048`
        for (const answer of isProbe ? [answering(given, model)] : script(given)) peer.send(answer)
      }
    }
  }
  const listener = await (transport === 'tcp' ? listenTcp({ port: 0 }, accept) : listenUdp({ port: 0 }, accept))
  try {
    await run({ host: '127.0.0.1', port: listener.port, transport, profile: 'iq-r', frame: 'ext', route })
  } finally {
    await listener.close()
  }
}

async function withClient(
  transport: Transport,
  script: (asked: Asked) => readonly Buffer[],
  run: (client: ReturnType<typeof createMelsecClient>) => Promise<void>,
): Promise<void> {
  await withStation(transport, script, async (options) => {
    const client = createMelsecClient({ ...options, timeout: 5000, reconnect: { first: 1 }, settleGap: 1 })
    try {
      await run(client)
    } finally {
      await client.close()
    }
  })
}

describe.each(TRANSPORTS)('station 300 over %s', (transport) => {
  test('is asked by station 124 with its number in the extension field, and believed', () => {
    const asked: SlmpHead[] = []
    const script = (request: Asked) => {
      asked.push(request.head)
      return [answering(request, '3930')]
    }
    return withClient(transport, script, async (client) => {
      expect(await client.read('D100')).toBe(12345)
      const head = { network: 1, station: 124, moduleIo: 0x3ff, multidrop: 0, extensionStation: 300 }
      expect(asked).toMatchObject([head])
    })
  })

  const wrong: readonly (readonly [string, (asked: Asked) => Buffer, string])[] = [
    [
      'another extension station',
      ({ head, ...rest }) => answering({ ...rest, head: { ...head, extensionStation: 301 } }, '3930'),
      'extensionStation is 301, asked 300',
    ],
    [
      'another command',
      ({ body, ...rest }) =>
        answering({ ...rest, body: Buffer.concat([Buffer.of(1, 0x14), body.subarray(2)]) }, '3930'),
      'about command 1401',
    ],
    [
      'another subcommand',
      ({ body, ...rest }) =>
        answering({ ...rest, body: Buffer.concat([body.subarray(0, 2), Buffer.of(1, 0), body.subarray(4)]) }, '3930'),
      'subcommand 0001',
    ],
  ]
  test.each(wrong)('%s in the answer is a breach of the protocol, not a value', (_what, answer, says) => {
    let first = true
    const script = (asked: Asked) => {
      const answers = [first ? answer(asked) : answering(asked, '3930')]
      first = false
      return answers
    }
    return withClient(transport, script, async (client) => {
      const error = await failureOf(client.read('D100'))
      expect(error).toMatchObject({ code: 'ECHO_MISMATCH', message: expect.stringContaining(says) })
      // And the next one is believed again, on a new connection.
      await nextState(client, 'connected')
      expect(await client.read('D100')).toBe(12345)
    })
  })

  test('that refuses is told with the station that failed', () => {
    const script = ({ head, serial, body }: Asked) => {
      const station = Buffer.from('027ce0030000feff', 'hex')
      return [framing.response.write(head, serial, 0xc051, Buffer.concat([body.subarray(0, 10), station]))]
    }
    return withClient(transport, script, async (client) => {
      const error = await failureOf(client.read('D100'))
      expect(error).toMatchObject({
        code: 'END_CODE',
        endCode: 0xc051,
        station: 'network 2, station 65534, module I/O 03E0, multidrop 0',
      })
      expect(client.state.name).toBe('connected')
    })
  })

  test('that answers late, twice and with other serial numbers is not taken for another', () => {
    const script = (asked: Asked) => {
      const stale = { ...asked, serial: (asked.serial + 0x8000) & 0xffff }
      return [answering(stale, 'ffff'), answering(asked, '3930'), answering(asked, '0000')]
    }
    return withClient(transport, script, async (client) => {
      for (let i = 0; i < 3; i++) expect(await client.read('D100')).toBe(12345)
      expect(client.statistics).toMatchObject({ connects: 1, protocolErrors: 0 })
    })
  })

  test('that sends a frame unasked in the place of an answer is listened to', () => {
    const onDemand = Buffer.from('01210000000000000000' + '0102', 'hex')
    const script = (asked: Asked) => [framing.request.write(asked.head, 0x99, onDemand), answering(asked, '3930')]
    return withClient(transport, script, async (client) => {
      const told: string[] = []
      client.on('unsolicited', ({ route: { station, extensionStation } }) =>
        told.push(`${station} ${extensionStation}`),
      )
      expect(await client.read('D100')).toBe(12345)
      expect(told).toEqual(['124 300'])
    })
  })
})
