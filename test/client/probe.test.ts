// What proves a connection, and devices that do not know the usual request: they say nothing, or close. Played by hand.
import { createSocket } from 'node:dgram'
import { once } from 'node:events'
import { createServer } from 'node:net'
import { describe, expect, test } from '@jest/globals'
import { createMelsecClient, type MelsecClient, type MelsecOptions, type NetworkPlc } from '../../src/index'
import { failureOf } from './line'

/** `close`, `silence`, or bytes in hexadecimal digits. */
type Reaction = string
/** By command in hexadecimal digits, as it stands in a 3E frame. */
type Device = Readonly<Record<string, Reaction>>

const READ = 'd00000ffff0300040000001a00'
const WRITTEN = 'd00000ffff030002000000'
const REFUSED = 'd00000ffff03000b0059c000ffff03000101' + '0000'

const commandOf = (frame: Buffer) => frame.readUInt16LE(11).toString(16).padStart(4, '0')

async function withDevice(
  device: Device,
  run: (client: MelsecClient, asked: readonly string[]) => Promise<void>,
  options: Partial<MelsecOptions & NetworkPlc> = {},
): Promise<void> {
  const asked: string[] = []
  const server = createServer((socket) => {
    socket.on('error', () => {})
    socket.on('data', (frame) => {
      const command = commandOf(frame)
      asked.push(command)
      const reaction = device[command] ?? device.other ?? 'silence'
      if (reaction === 'close') socket.end()
      else if (reaction !== 'silence') socket.write(Buffer.from(reaction, 'hex'))
    })
  }).listen(0, '127.0.0.1')
  await once(server, 'listening')
  const address = server.address()
  const port = typeof address === 'object' && address !== null ? address.port : 0
  const times = { timeout: 1000, settleGap: 1, reconnect: { first: 1, longest: 5 } }
  const client = createMelsecClient({ host: '127.0.0.1', port, allowWrites: true, ...times, ...options })
  try {
    await run(client, asked)
  } finally {
    await client.close()
    server.close()
  }
}

describe.each(['close', 'silence'])('Read Type Name is met with %s', (reaction) => {
  const device = { '0401': READ, '1401': WRITTEN, other: reaction }

  test('by default the first call gets its value all the same, and later connections do not ask again', () =>
    withDevice(device, async (client, asked) => {
      expect(await client.read('D100')).toBe(26)
      expect(asked).toEqual(['0101', '0401', '0401'])
      expect(await client.read('D100')).toBe(26)
      expect(client.state.name).toBe('connected')
      expect(asked.filter((command) => command === '0101')).toHaveLength(1)
    }))

  test('connect() succeeds, and a write is sent once', () =>
    withDevice(device, async (client, asked) => {
      await client.connect()
      await client.write('D100', 5)
      expect(asked).toEqual(['0101', '0401', '1401'])
    }))

  test('read: it is not asked for', () =>
    withDevice(
      device,
      async (client, asked) => {
        await client.write('D100', 5)
        expect(asked).toEqual(['0401', '1401'])
      },
      { probe: 'read' },
    ))

  test('none: the first request proves the connection, and is sent once', () =>
    withDevice(
      device,
      async (client, asked) => {
        await client.write('D100', 5)
        expect(await client.read('D100')).toBe(26)
        expect(asked).toEqual(['1401', '0401'])
      },
      { probe: 'none' },
    ))

  test('typeName: the message says what was asked and what helps', () =>
    withDevice(
      device,
      async (client, asked) => {
        const error = await failureOf(client.connect())
        expect(error.code).toBe(reaction === 'close' ? 'ENTRY_BUSY' : 'SILENT')
        expect(error.message).toContain('Read Type Name (0101)')
        expect(error.message).toContain('set probe to read or none')
        expect(new Set(asked)).toEqual(new Set(['0101']))
        expect(await failureOf(client.write('D100', 1))).toMatchObject({ outcome: 'notSent' })
      },
      { probe: 'typeName' },
    ))
})

describe.each([
  ['close', 'ENTRY_BUSY'],
  ['silence', 'SILENT'],
])('everything is met with %s', (reaction, code) => {
  test('by default nothing of the program is sent, and the message names what was asked', () =>
    withDevice({ other: reaction }, async (client, asked) => {
      const error = await failureOf(client.connect())
      expect(error).toMatchObject({ code })
      expect(error.message).toContain('Read Type Name (0101) and Read (word units) (0401)')
      expect(await failureOf(client.write('D100', 1))).toMatchObject({ code: 'OFFLINE', outcome: 'notSent' })
      expect(asked).not.toContain('1401')
    }))

  test('none: a write is sent once and unknown, and the next one fails at once', () =>
    withDevice(
      { other: reaction },
      async (client, asked) => {
        const error = await failureOf(client.write('D100', 1))
        expect(error.outcome).toBe('unknown')
        await failureOf(client.read('D0'))
        expect(asked.filter((command) => command === '1401')).toHaveLength(1)
      },
      { probe: 'none', reconnect: { first: 60_000, longest: 60_000 } },
    ))
})

test('a refusal of the type name is an answer', () =>
  withDevice({ '0101': REFUSED, '0401': READ }, async (client, asked) => {
    expect(await client.read('D100')).toBe(26)
    expect(asked).toEqual(['0101', '0401'])
  }))

test('an answer to the type name that cannot be one is as good as none', () =>
  withDevice({ '0101': WRITTEN, '0401': READ }, async (client, asked) => {
    expect(await client.read('D100')).toBe(26)
    expect(asked).toEqual(['0101', '0401', '0401'])
  }))

test.each(['auto', 'none'] as const)('over UDP a device that says nothing to the type name: %s', async (probe) => {
  const socket = createSocket('udp4')
  const asked: string[] = []
  socket.on('message', (frame, { port, address }) => {
    asked.push(commandOf(frame))
    if (asked.at(-1) === '0401') socket.send(Buffer.from(READ, 'hex'), port, address)
  })
  socket.bind(0, '127.0.0.1')
  await once(socket, 'listening')
  const { port } = socket.address()
  const client = createMelsecClient({ host: '127.0.0.1', port, transport: 'udp', timeout: 1000, probe })
  try {
    expect(await client.read('D100')).toBe(26)
    expect(asked).toEqual(probe === 'auto' ? ['0101', '0401', '0401'] : ['0401'])
  } finally {
    await client.close()
    socket.close()
  }
})

test('a PLC that is known not to have the type name is not asked for it', () => {
  const options = { host: '127.0.0.1', port: 1, profile: 'q-built-in', probe: 'typeName' } as const
  expect(() => createMelsecClient(options)).toThrow(expect.objectContaining({ code: 'BAD_OPTION', field: 'probe' }))
})
