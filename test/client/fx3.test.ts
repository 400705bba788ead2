/**
 * FX3 by its Ethernet modules, played by hand from the bytes of their manuals: FX3U-ENET-ADP user's manual 7.6.3 and
 * FX3U-ENET user's manual 9.4.3 end the answer to 15H with 00H, the FX5 communication manual 39.4 does not.
 */
import { createSocket } from 'node:dgram'
import { once } from 'node:events'
import { createServer, type Socket } from 'node:net'
import { describe, expect, test } from '@jest/globals'
import { explainFrame } from '../../src/entry/codec'
import { createPlcSimulator } from '../../src/entry/simulator'
import { createMelsecClient, type MelsecClient, type MelsecOptions, type NetworkPlc } from '../../src/index'

type Code = 'binary' | 'ascii'
const CODES = ['binary', 'ascii'] as const
const TYPE_NAME = ['9500F3', '9500F300'] as const

const bytesOf = (code: Code, digits: string) => Buffer.from(digits, code === 'ascii' ? 'latin1' : 'hex')
const digitsOf = (code: Code, bytes: Buffer) =>
  code === 'ascii' ? bytes.toString('latin1') : bytes.toString('hex').toUpperCase()

interface Peer {
  readonly socket: Socket
  /** Sends these digits as one chunk; resolves when they have left. */
  send(digits: string): Promise<void>
}

type Answer = (digits: string, peer: Peer) => void

/** What the client finds: answers by hand to whole requests, which never are cut on loopback. */
async function withTcp(
  code: Code,
  answer: Answer,
  run: (client: MelsecClient, requests: readonly string[]) => Promise<void>,
  options: Partial<MelsecOptions & NetworkPlc> = {},
): Promise<void> {
  const requests: string[] = []
  const server = createServer((socket) => {
    socket.setNoDelay(true)
    socket.on('error', () => {})
    const send = (digits: string) =>
      new Promise<void>((resolve) => {
        socket.write(bytesOf(code, digits), () => resolve())
      })
    socket.on('data', (data) => {
      const digits = digitsOf(code, data)
      requests.push(digits)
      answer(digits, { socket, send })
    })
  }).listen(0, '127.0.0.1')
  await once(server, 'listening')
  const address = server.address()
  const port = typeof address === 'object' && address !== null ? address.port : 0
  const client = createMelsecClient({ host: '127.0.0.1', port, profile: 'fx3', code, allowWrites: true, ...options })
  try {
    await run(client, requests)
  } finally {
    await client.close()
    server.close()
  }
}

/** The beginning of the answer to 01H. */
const READ = '8100'

describe.each(CODES)('Read PC type name over TCP, %s', (code) => {
  test.each(TYPE_NAME)('the answer %s is taken', (typeName) =>
    withTcp(
      code,
      (digits, { send }) => send(digits.startsWith('15') ? typeName : `${READ}${code === 'ascii' ? '001A' : '1A00'}`),
      async (client, requests) => {
        expect(await client.read('D100')).toBe(26)
        expect((await client.identify()).modelCode).toBe(0xf3)
        expect(await client.read('D100')).toBe(26)
        expect(requests.map((digits) => digits.slice(0, 2))).toEqual(['15', '01', '15', '01'])
      },
    ),
  )

  test('a byte 00H that comes late, and in pieces, is no part of the next answer', () => {
    const late: string[] = []
    return withTcp(
      code,
      async (digits, { send }) => {
        // The next request has arrived: only now the rest of the answer before comes.
        for (const piece of late.splice(0)) {
          await send(piece)
          await new Promise<void>((resolve) => setImmediate(resolve))
        }
        if (digits.startsWith('15')) {
          await send('9500F3')
          late.push(...(code === 'ascii' ? ['0', '0'] : ['00']))
        } else await send(`${READ}${code === 'ascii' ? '001A' : '1A00'}`)
      },
      async (client) => {
        for (let i = 0; i < 3; i++) {
          expect((await client.identify()).modelCode).toBe(0xf3)
          expect(await client.read('D100')).toBe(26)
        }
        expect(client.statistics).toMatchObject({ connects: 1, disconnects: 0, protocolErrors: 0 })
      },
    )
  })

  test.each(['815B10', '815B1000'])('a refusal with its abnormal code: %s', (refusal) =>
    withTcp(
      code,
      (digits, { send }) => send(digits.startsWith('15') ? '9500F300' : refusal),
      async (client) => {
        for (let i = 0; i < 2; i++) {
          await expect(client.read('D0')).rejects.toMatchObject({ endCode: 0x5b, abnormalCode: 0x10 })
        }
        expect(client.statistics).toMatchObject({ connects: 1, disconnects: 0 })
      },
    ),
  )
})

describe.each(CODES)('Read PC type name over UDP, %s', (code) => {
  async function withUdp(typeName: string, run: (client: MelsecClient) => Promise<void>): Promise<void> {
    const socket = createSocket('udp4')
    socket.on('message', (data, { port, address }) => {
      const answer = digitsOf(code, data).startsWith('15') ? typeName : `${READ}${code === 'ascii' ? '001A' : '1A00'}`
      socket.send(bytesOf(code, answer), port, address)
    })
    socket.bind(0, '127.0.0.1')
    await once(socket, 'listening')
    const { port } = socket.address()
    const client = createMelsecClient({ host: '127.0.0.1', port, transport: 'udp', profile: 'fx3', code })
    try {
      await run(client)
    } finally {
      await client.close()
      socket.close()
    }
  }

  test.each(TYPE_NAME)('the answer %s is taken', (typeName) =>
    withUdp(typeName, async (client) => {
      expect(await client.read('D100')).toBe(26)
      expect(client.statistics).toMatchObject({ protocolErrors: 0 })
    }),
  )

  test('a datagram with anything else behind it is not believed', () =>
    withUdp(code === 'ascii' ? '9500F3000' : '9500F30000', async (client) => {
      await expect(client.identify()).rejects.toMatchObject({ code: 'TRAILING' })
      expect(client.statistics.protocolErrors).toBeGreaterThan(0)
    }))
})

/** FX3U-ENET-ADP user's manual p. 81 and 55, FX3U-ENET user's manual p. 9-26: Y20 (octal) is 10H, in ASCII code, too. */
describe('X and Y in ASCII code are hexadecimal digits', () => {
  test('the output that is meant is written', () =>
    withTcp(
      'ascii',
      (digits, { send }) => send(digits.startsWith('15') ? '9500F300' : '8200'),
      async (client, requests) => {
        await client.write('Y20', true)
        expect(requests.at(-1)).toBe('02FF000A' + '592000000010' + '0100' + '10')
      },
    ))

  test.each(['octal', 'hexadecimal'] as const)('there is no setting for it: %s', (asciiXy) => {
    const options = { host: '127.0.0.1', port: 1, profile: 'fx3', code: 'ascii', asciiXy } as const
    const refused = { code: 'BAD_OPTION', field: 'asciiXy', message: expect.stringContaining('always hexadecimal') }
    expect(() => createMelsecClient(options)).toThrow(expect.objectContaining(refused))
    expect(() => createPlcSimulator({ profile: 'fx3', code: 'ascii', asciiXy })).toThrow(
      expect.objectContaining(refused),
    )
    const frame = Buffer.from('02FF000A592000000010010010')
    const explain = () => explainFrame(frame, { frame: '1E', profile: 'fx3', asciiXy })
    expect(explain).toThrow(expect.objectContaining(refused))
  })

  test('the simulator and the explanation read Y20', async () => {
    const plc = createPlcSimulator({ profile: 'fx3', code: 'ascii', udp: false })
    await plc.listen()
    const client = createMelsecClient({
      host: '127.0.0.1',
      port: plc.tcp?.port ?? 0,
      profile: 'fx3',
      code: 'ascii',
      allowWrites: true,
    })
    const frames: string[] = []
    client.on('trace', ({ direction, bytes, text }) => {
      if (direction === 'sent') frames.push(`${bytes.toString('latin1')} ${text}`)
    })
    try {
      await client.write('Y20', true)
      expect([plc.read('Y20'), plc.read('Y10'), plc.read('Y40')]).toEqual([true, false, false])
      expect(frames.at(-1)).toMatch(/^02FF000A592000000010010010 [\s\S]*Y20/)
      expect(frames.at(-1)).not.toContain('asciiXy')
    } finally {
      await client.close()
      await plc.close()
    }
  })
})

test.each(['iq-r', 'q', 'l', 'remote-head', 'nz2gf-etb'] as const)(
  '%s has no setting for the digits either',
  (profile) => {
    const options = { host: '127.0.0.1', port: 1, profile, code: 'ascii', asciiXy: 'octal' } as const
    expect(() => createMelsecClient(options)).toThrow(expect.objectContaining({ field: 'asciiXy' }))
  },
)

test('a PLC nobody knows whose X and Y are octal may have the setting: it has to be said', async () => {
  const options = {
    host: '127.0.0.1',
    port: 1,
    profile: 'generic',
    code: 'ascii',
    xyRadix: 8,
    allowWrites: true,
  } as const
  const client = createMelsecClient(options)
  await expect(client.write('Y20', true)).rejects.toMatchObject({
    outcome: 'notSent',
    message: expect.stringContaining('asciiXy'),
  })
  await client.close()
})
