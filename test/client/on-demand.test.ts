/** On-demand at the client: what its events tell, and what is refused. */
import { describe, expect, jest, test } from '@jest/globals'
import { unsolicitedCommands } from '../../src/entry/codec'
import { createPlcSimulator } from '../../src/entry/simulator'
import {
  createMelsecClient,
  type MelsecClient,
  type MelsecOptions,
  type NetworkPlc,
  type OnDemand,
  type OpenTransport,
  ProtocolError,
  RequestError,
  type UnsolicitedFrame,
} from '../../src/index'
import { ownStation } from '../../src/melsec/frame/route'
import { slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { hex, ON_DEMAND_DATA, ON_DEMAND_WORDS, onDemandFrames, text } from '../melsec/on-demand-frames'
import { failureOf } from './line'

interface Told {
  readonly client: MelsecClient
  readonly onDemand: OnDemand[]
  readonly unsolicited: UnsolicitedFrame[]
  /** Bytes for the client, between whatever the PLC sends. */
  readonly inject: (bytes: Buffer) => void
}

/** A client that is connected to a simulated PLC in memory, and somebody who can send to it as the PLC does. */
async function connected(
  options: Partial<MelsecOptions & NetworkPlc>,
  run: (told: Told) => Promise<void>,
): Promise<void> {
  const plc = createPlcSimulator({ code: options.code ?? 'binary' })
  plc.write('D0', 5)
  const open = plc.connect()
  let inject: (bytes: Buffer) => void = () => {}
  const openTransport: OpenTransport = () => {
    const transport = open()
    return {
      kind: transport.kind,
      description: transport.description,
      open: (handlers) => {
        inject = (bytes) => handlers.received(bytes)
        transport.open(handlers)
      },
      send: (bytes) => transport.send(bytes),
      renew: () => transport.renew(),
      renewable: transport.renewable,
      get ready() {
        return transport.ready
      },
      close: () => transport.close(),
    }
  }
  const client = createMelsecClient({ host: 'plc', port: 1, profile: 'iq-r', ...options, openTransport })
  const onDemand: OnDemand[] = []
  const unsolicited: UnsolicitedFrame[] = []
  client.on('onDemand', (data) => onDemand.push(data))
  client.on('unsolicited', (frame) => unsolicited.push(frame))
  try {
    await client.connect()
    await run({ client, onDemand, unsolicited, inject: (bytes) => inject(bytes) })
  } finally {
    await client.close()
    await plc.close()
  }
}

describe.each(onDemandFrames)('On-demand in a $frame frame in $code code', ({ frame, code, bytes }) => {
  test('is told as data and words, with route and time, and answers nothing', () =>
    connected({ frame, code }, async ({ client, onDemand, unsolicited, inject }) => {
      const before = Date.now()
      const { bytesSent } = client.statistics
      const reading = client.read('D0')
      inject(bytes)
      expect(await reading).toBe(5)
      const asked = client.statistics.bytesSent
      inject(bytes)
      const [first, second, ...more] = onDemand
      expect(first).toEqual({
        route: ownStation,
        data: ON_DEMAND_DATA,
        words: ON_DEMAND_WORDS,
        timestamp: expect.any(Number),
      })
      expect(second?.data).toEqual(ON_DEMAND_DATA)
      expect(more).toEqual([])
      expect(first?.timestamp).toBeGreaterThanOrEqual(before)
      expect(unsolicited).toHaveLength(2)
      expect(unsolicited[0]).not.toHaveProperty('error')
      expect(asked).toBeGreaterThan(bytesSent)
      expect(client.statistics).toMatchObject({ bytesSent: asked, unsolicited: 2, stale: 0, protocolErrors: 0 })
    }))

  test('is told once when it arrives in two pieces, cut anywhere', () =>
    connected({ frame, code }, async ({ onDemand, inject }) => {
      for (let cut = 1; cut < bytes.length; cut++) {
        inject(Buffer.from(bytes.subarray(0, cut)))
        expect(onDemand).toHaveLength(cut - 1)
        inject(Buffer.from(bytes.subarray(cut)))
        expect(onDemand).toHaveLength(cut)
      }
    }))

  test('does not change with the bytes of the chunk', () =>
    connected({ frame, code }, async ({ onDemand, unsolicited, inject }) => {
      const chunk = Buffer.from(bytes)
      inject(chunk)
      chunk.fill(0xff)
      unsolicited[0]?.body.fill(0xff)
      expect(onDemand[0]?.data).toEqual(ON_DEMAND_DATA)
    }))

  test('in a trace is said to be one, and leaves the request named that waits for its answer', () =>
    connected({ frame, code }, async ({ client, inject }) => {
      const titles: string[] = []
      client.on('trace', ({ frames }) => titles.push(...frames.map(({ title }) => title)))
      const reading = client.read('D0')
      inject(bytes)
      await reading
      expect(titles).toHaveLength(3)
      expect(titles[1]).toMatch(new RegExp(`^${frame} request, .*: On-demand`))
      expect(titles[2]).toMatch(/response, .*: Read \(word units\), D0/)
    }))
})

test('an odd number of bytes is told as data without words', () =>
  connected({ frame: '3E' }, async ({ onDemand, unsolicited, inject }) => {
    inject(hex('5000 00 ff ff03 00 0900 0000 0121 0000 010203'))
    expect(onDemand).toMatchObject([{ data: Buffer.from([1, 2, 3]), words: undefined }])
    expect(unsolicited[0]).not.toHaveProperty('error')
  }))

test('the route is that of the frame', () =>
  connected({ frame: '3E' }, async ({ onDemand, inject }) => {
    inject(hex('5000 02 11 e003 1f 0600 0000 0121 0000'))
    const route = { network: 2, station: 0x11, moduleIo: 0x3e0, multidrop: 0x1f }
    expect(onDemand).toMatchObject([{ route, data: Buffer.alloc(0), words: [] }])
  }))

describe('what cannot be read', () => {
  const tooMuch = Buffer.concat([hex('5000 00 ff ff03 00 8707 0000 0121 0000'), Buffer.alloc(1921)])
  test.each([
    ['binary', 'another command', hex('5000 00 ff ff03 00 0c00 0000 0104 0000 640000 a8 0a00'), 'BAD_FIELD'],
    ['binary', 'another subcommand', hex('5000 00 ff ff03 00 0600 0000 0121 0100'), 'BAD_FIELD'],
    ['binary', 'too much data', tooMuch, 'BAD_FIELD'],
    ['binary', 'no whole command', hex('5000 00 ff ff03 00 0400 0000 0121'), 'TRUNCATED'],
    ['ascii', 'a wrong digit', text('5000 00 FF 03FF 00 0010 0000 2101 0000 00G1'), 'BAD_DIGIT'],
    ['ascii', 'half a word', text('5000 00 FF 03FF 00 000E 0000 2101 0000 00'), 'TRUNCATED'],
  ] as const)(
    'in %s code: %s is told with its bytes and the reason, and nothing else is lost',
    (code, _what, bytes, error) =>
      connected({ frame: '3E', code }, async ({ client, onDemand, unsolicited, inject }) => {
        const [good = Buffer.alloc(0)] = onDemandFrames.flatMap((one) =>
          one.frame === '3E' && one.code === code ? [one.bytes] : [],
        )
        const reading = client.read('D0')
        inject(Buffer.concat([bytes, good]))
        expect(await reading).toBe(5)
        expect(onDemand).toHaveLength(1)
        expect(unsolicited.map((frame) => frame.error?.code)).toEqual([error, undefined])
        expect(unsolicited[0]?.error).toBeInstanceOf(ProtocolError)
        expect(unsolicited[0]?.body).toEqual(bytes.subarray(code === 'ascii' ? 22 : 11))
        expect(client.statistics).toMatchObject({ unsolicited: 2, connects: 1, disconnects: 0 })
      }),
  )
})

test('a listener that throws takes nothing from the others', () =>
  connected({ frame: '4E' }, async ({ client, onDemand, unsolicited, inject }) => {
    const warned = jest.spyOn(process, 'emitWarning').mockReturnValue()
    client.on('unsolicited', () => {
      throw new Error('a mistake of the program')
    })
    inject(slmpFraming('4E', 'binary').request.write({ ...ownStation, timer: 0 }, 1, hex('01210000')))
    expect([onDemand.length, unsolicited.length]).toEqual([1, 1])
    expect(warned.mock.calls.map(([message]) => String(message))).toEqual([
      expect.stringMatching(/event unsolicited failed.*a mistake of the program/),
    ])
    warned.mockRestore()
  }))

describe('refused is', () => {
  const make = (options: Partial<MelsecOptions & NetworkPlc>) =>
    createMelsecClient({ host: '127.0.0.1', port: 5010, profile: 'iq-f', ...options })

  test('listening with the 1E frame, which has no On-demand', () => {
    const client = make({ frame: '1E' })
    const listen = () => client.on('onDemand', () => {})
    expect(listen).toThrow(expect.objectContaining({ code: 'UNSUPPORTED', field: 'frame' }))
    expect(listen).toThrow(RequestError)
    expect(() => client.on('unsolicited', () => {})).not.toThrow()
  })

  test.each(['3E', '4E'] as const)('listening over UDP with %s and without a port that the PLC can know', (frame) => {
    const wanted = { transport: 'udp', profile: 'iq-r', frame } as const
    for (const options of [wanted, { ...wanted, localPort: 0 }]) {
      const listen = () => make(options).on('onDemand', () => {})
      expect(listen).toThrow(expect.objectContaining({ code: 'BAD_OPTION', field: 'localPort' }))
      expect(listen).toThrow(/localPort/)
    }
    expect(() => make({ ...wanted, localPort: 5011 }).on('onDemand', () => {})).not.toThrow()
    expect(() => make({ profile: 'iq-r', frame }).on('onDemand', () => {})).not.toThrow()
  })

  test('asking for it', () =>
    connected({ frame: '4E' }, async ({ client }) => {
      const { requests } = client.statistics
      const asked = client.request(unsolicitedCommands.onDemand, { data: Buffer.alloc(2) })
      expect(await failureOf(asked)).toMatchObject({ code: 'UNSUPPORTED', outcome: 'notSent', field: 'command' })
      expect(client.statistics.requests).toBe(requests)
    }))
})
