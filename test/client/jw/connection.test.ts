/** A client of a Sharp JW and its connection: options, permissions, requests, headers, traces, and what goes wrong on the way. */
import { afterEach, describe, expect, test } from '@jest/globals'
import type { JwClient } from '../../../src/client/jw/client'
import { findJwHeader } from '../../../src/client/jw/find-header'
import { createJwClient } from '../../../src/client/jw/jw-client'
import type { JwClientOptions } from '../../../src/client/jw/options'
import { PlcError } from '../../../src/errors'
import { jwCommands } from '../../../src/jw/commands/commands'
import { listenTcp } from '../../../src/transport/listen-tcp'
import { listenUdp } from '../../../src/transport/listen-udp'
import type { ServerConnection } from '../../../src/transport/transport'
import { failureOf, until } from '../line'
import { inMemory, onSockets, SmallJw } from './small-jw'

let client: JwClient | undefined
afterEach(async () => {
  await client?.close()
})

const head = { file: 0, address: 0o4000 } as const

function codeOf(options: Readonly<Record<string, unknown>>): string {
  try {
    createJwClient(options as unknown as JwClientOptions)
    return 'made'
  } catch (error) {
    if (error instanceof PlcError) return `${error.code} ${String((error as { field?: string }).field)}`
    throw error
  }
}

describe('options', () => {
  const host = { host: '127.0.0.1', port: 10000 }

  test.each([
    ['no host', { port: 1 }, 'BAD_OPTION host'],
    ['no port', { host: 'plc' }, 'BAD_OPTION port'],
    ['a name that is none', { ...host, prot: 1 }, 'BAD_OPTION prot'],
    ['a transport that is none', { ...host, transport: 'serial' }, 'BAD_OPTION transport'],
    ['a header that is none', { ...host, header: 'zero' }, 'BAD_OPTION header'],
    ['a header that begins like a message', { ...host, header: Uint8Array.of(0x47) }, 'BAD_OPTION header'],
    ['a relay out of range', { ...host, header: { pda: 0, psa: 1, slot: 2, station: 1 } }, 'BAD_OPTION header.pda'],
    ['a model that is none', { ...host, model: 'jw50' }, 'BAD_OPTION model'],
    ['a marker that is none', { ...host, marker: 'twice' }, 'BAD_OPTION marker'],
    [
      'areas that are none',
      { ...host, areas: [{ first: '016000', last: '015000', file: 0, address: 0 }] },
      'BAD_OPTION areas',
    ],
    ['a permission that is no boolean', { ...host, allowParameters: 'yes' }, 'BAD_OPTION allowParameters'],
    ['a probe that is none', { ...host, probe: 'typeName' }, 'BAD_OPTION probe'],
    ['too much data', { ...host, maxData: 1025 }, 'BAD_OPTION maxData'],
    [
      'a fixed port whose late answers no loopback tells apart',
      { ...host, transport: 'udp', localPort: 5000, model: 'jw30h' },
      'BAD_OPTION localPort',
    ],
    [
      'a fixed port in front of a relay',
      { ...host, transport: 'udp', localPort: 5000, header: { pda: 1, psa: 2, slot: 3, station: 4 } },
      'BAD_OPTION localPort',
    ],
    ['what is enough', host, 'made'],
    [
      'everything',
      { ...host, transport: 'udp', header: 'zero40', marker: 'each', lists: false, areas: [], gap: 0, localPort: 5000 },
      'made',
    ],
  ])('%s', (_name, options, expected) => {
    expect(codeOf(options)).toBe(expected)
  })
})

describe('permissions', () => {
  const strict = { allowWrites: false, allowControl: false, allowParameters: false } as const

  test.each([
    ['allowWrites', (plc: JwClient) => plc.write('09000', 1)],
    ['allowWrites', (plc: JwClient) => plc.write('004000', true)],
    ['allowWrites', (plc: JwClient) => plc.buffers.ring.read(0)],
    ['allowControl', (plc: JwClient) => plc.control.stop()],
    ['allowControl', (plc: JwClient) => plc.control.setWriteMode('all')],
    ['allowControl', (plc: JwClient) => plc.clock.set(new Date())],
    ['allowParameters', (plc: JwClient) => plc.write('#0201', 1)],
    ['allowParameters', (plc: JwClient) => plc.secret.enable()],
    [
      'allowParameters',
      (plc: JwClient) =>
        plc.parameters.optionUnit({ rack: 0, unit: 1 }).write([{ address: 0, bytes: Uint8Array.of(1) }]),
    ],
    [
      'allowParameters',
      (plc: JwClient) => plc.request(jwCommands.writeSystemMemory, { segment: 8, address: 0, data: Uint8Array.of(1) }),
    ],
  ] as const)('%s: nothing is sent without it', async (option, act) => {
    const { client: made, plc } = inMemory(strict)
    client = made
    const error = await failureOf(act(made))
    expect(error).toMatchObject({ code: 'NOT_PERMITTED', outcome: 'notSent', field: option })
    expect(plc.asked).toEqual([])
  })
})

describe.each([
  ['tcp', 'none'],
  ['tcp', 'zero40'],
  ['udp', 'none'],
  ['udp', 'zero40'],
  ['udp', { pda: 1, psa: 2, slot: 3, station: 4 }],
  ['tcp', Uint8Array.of(1, 2, 3)],
] as const)('over %s with header %j', (transport, header) => {
  test('requests are answered, and the header is detected in answers', async () => {
    const plc = new SmallJw(transport === 'tcp' ? 'stream' : 'datagram', { header })
    plc.files.get(0)?.set([0x34, 0x12], 0o4000)
    await onSockets(transport, { header }, plc, async (made) => {
      const answer = await made.request(jwCommands.readDataMemory, { head, length: 2 })
      expect(Buffer.from(answer.data).toString('hex')).toBe('3412')
      expect(await made.read('09000:WORD')).toBe(0x1234)
      expect(made.statistics.answered).toBe(2)
    })
  })
})

describe('requests', () => {
  test('a refusal is an error with its text, and the connection lives', async () => {
    const { client: made, plc } = inMemory()
    client = made
    plc.refusals.set('readDataMemory', 0x0f)
    const error = await failureOf(made.request(jwCommands.readDataMemory, { head, length: 2 }))
    expect(error).toMatchObject({ code: 'END_CODE', endCode: 0x0f, family: 'jw', outcome: 'refused' })
    expect(made.state.name).toBe('connected')
  })

  test('what is no declared command or no message is refused before sending', async () => {
    const { client: made, plc } = inMemory()
    client = made
    const command = { ...jwCommands.readDataMemory }
    expect(await failureOf(made.request(command, { head, length: 2 }))).toMatchObject({ code: 'BAD_MESSAGE' })
    expect(await failureOf(made.request(jwCommands.readDataMemory, 5 as never))).toMatchObject({ code: 'BAD_MESSAGE' })
    expect(await failureOf(made.request(jwCommands.setMemorySize, { size: 3 }))).toMatchObject({ code: 'UNSUPPORTED' })
    expect(plc.asked).toEqual([])
  })

  test('go by their names and codes, with messages as JSON', async () => {
    const { client: made, plc } = inMemory()
    client = made
    plc.files.get(0)?.set([1, 2], 0o4000)
    const { data } = await made.requestByName('readDataMemory', { head: '09000', length: 2 })
    expect(data).toEqual(Buffer.of(1, 2))
    expect(await made.requestByName('E8H')).toEqual({ state: 0 })
    expect(made.explainRequest('setRelay', { address: 'KO0403', bit: 3, value: 1 })).toMatchObject({
      name: 'setRelay',
      effect: 'write',
      message: { bit: 3, value: 1 },
    })
    expect(() => made.explainRequest('setMemorySize', { size: 3 })).toThrow('JW300')
    expect(await failureOf(made.requestByName('readWords'))).toMatchObject({ code: 'BAD_OPTION' })
    expect(plc.asked).toEqual(['readDataMemory', 'readRunState'])
  })

  test('over UDP a message of 1024 bytes and more is refused before sending', async () => {
    const { client: made, plc } = inMemory({ transport: 'udp', header: 'zero40' }, new SmallJw('datagram'))
    client = made
    const whole = { head, length: 975 }
    expect(await failureOf(made.request(jwCommands.readDataMemory, whole))).toMatchObject({ code: 'LIMIT_EXCEEDED' })
    expect((await made.request(jwCommands.readDataMemory, { head, length: 974 })).data).toHaveLength(974)
    expect(plc.asked).toEqual(['readDataMemory'])
  })

  test('a loopback tells its round trip, and what comes back changed is no answer', async () => {
    const { client: made, plc } = inMemory()
    client = made
    expect((await made.selfTest(Buffer.from('hello'))).roundTrip).toBeGreaterThanOrEqual(0)
    plc.script = ({ peer, answer }) => {
      const bytes = answer()
      bytes[bytes.length - 1] = (bytes.at(-1) ?? 0) ^ 1
      peer.send(bytes)
    }
    expect(await failureOf(made.selfTest(Buffer.from('hello')))).toMatchObject({ code: 'ECHO_MISMATCH' })
  })
})

test('a byte that a JW30H does not have is not asked for in another file by a request either', () => {
  const { client: made } = inMemory({ model: 'jw30h' })
  client = made
  const explained = () => made.explainRequest('readDataMemory', { head: 'F1:00200000', length: 1 })
  expect(explained).toThrow(expect.objectContaining({ code: 'UNSUPPORTED', field: 'head' }))
  const { message } = made.explainRequest('readDataMemory', { head: 'F2:000000', length: 1 })
  expect(message.head).toBe('F2:000000')
})

describe('the probe', () => {
  test.each([
    ['writeMode', 1, []],
    ['read', 0, ['readDataMemory']],
    ['none', 0, []],
  ] as const)('%s', async (probe, probes, asked) => {
    const { client: made, plc } = inMemory({ probe })
    client = made
    await made.connect()
    expect([plc.probes, plc.asked]).toEqual([probes, asked])
  })
})

describe('findJwHeader', () => {
  test.each([
    ['header', 'zero40', 1],
    ['none', 'none', 2],
  ] as const)('of a unit that understands messages with %s', async (understands, expected, attempts) => {
    const plc = new SmallJw('stream', {}, understands)
    await onSockets('tcp', {}, plc, async (_client, port) => {
      const found = await findJwHeader({ host: '127.0.0.1', port, timeout: 200, connectTimeout: 1000 })
      expect(found.header).toBe(expected)
      expect(found.tried).toHaveLength(attempts)
      expect(plc.asked).toEqual([])
    })
  })

  test('of a unit that answers another header by a result code of no command', async () => {
    // What it takes for the command is the third byte of the header.
    const answer = (peer: ServerConnection) => (bytes: Buffer) =>
      peer.send(Buffer.from(bytes[0] === 0 ? [0x45, 0, 0, 1] : [0x45, 0, 0xe9, 0, 2]))
    const listener = await listenTcp({ port: 0 }, (peer) => {
      peer.onReceived = answer(peer)
      peer.onClosed = () => {}
    })
    const unit = { host: '127.0.0.1', port: listener.port, timeout: 200, connectTimeout: 1000 }
    const { header, tried } = await findJwHeader(unit)
    expect(header).toBe('none')
    expect(tried[0]).toMatchObject({ header: 'zero40', error: { code: 'ECHO_MISMATCH' } })
    await listener.close()
  })

  test('says so when a unit answers to none', async () => {
    const plc = new SmallJw('stream')
    plc.probe = () => {}
    await onSockets('tcp', {}, plc, async (_client, port) => {
      const finding = findJwHeader({ host: '127.0.0.1', port, timeout: 100, connectTimeout: 1000 }, [
        Uint8Array.of(0, 1),
      ])
      expect(await failureOf(finding)).toMatchObject({ code: 'SILENT' })
    })
  })

  test('does not take an option that it has itself', async () => {
    expect(await failureOf(findJwHeader({ host: 'x', port: 1, header: 'none' } as never))).toMatchObject({
      code: 'BAD_OPTION',
      field: 'header',
    })
  })
})

describe('traces', () => {
  test('say what goes over the wire, and never show a password', async () => {
    const { client: made } = inMemory({ header: 'zero40' })
    client = made
    const entries: { direction: string; text: string; hex: string }[] = []
    made.on('trace', ({ direction, text, bytes }) => entries.push({ direction, text, hex: bytes.toString('latin1') }))
    await made.secret.release('a1B2')
    const [, , request, answer] = entries
    expect(request?.text).toContain('Release secret/register password')
    expect(`${request?.text} ${request?.hex}`).not.toContain('a1B2')
    expect(answer).toMatchObject({ direction: 'received' })
    expect(answer?.text).toContain('carried out')
  })

  test('find the message behind any header', async () => {
    const header = Uint8Array.of(9, 9, 9)
    const { client: made } = inMemory({ header }, new SmallJw('stream', { header }))
    client = made
    const texts: string[] = []
    made.on('trace', ({ text }) => texts.push(text))
    await made.secret.release('a1B2')
    expect(texts.join('\n')).toContain('Release secret/register password')
    expect(texts.join('\n')).not.toContain('a1B2')
  })
})

describe('failures', () => {
  test('silence names the header first, and a write of unknown outcome is not repeated', async () => {
    const { client: made, plc } = inMemory({ timeout: 100 })
    client = made
    await made.connect()
    plc.script = () => {}
    const error = await failureOf(made.write('09000', 1))
    expect(error).toMatchObject({ code: 'TIMEOUT', outcome: 'unknown' })
    expect(plc.asked).toEqual(['writeDataMemory'])
    const silent = inMemory({ timeout: 100, connectTimeout: 100 })
    silent.plc.probe = () => {}
    const cause = await failureOf(silent.client.connect())
    expect(cause).toMatchObject({ code: 'SILENT' })
    expect((cause as { causes?: string[] }).causes?.[0]).toContain('zero40')
    await silent.client.close()
  })

  test('an answer that comes late over TCP ends the connection, and is never taken for the next one', async () => {
    const { client: made, plc } = inMemory({ timeout: 60 })
    client = made
    await made.connect()
    const late: (() => void)[] = []
    plc.script = ({ peer, answer }) => late.push(() => peer.send(answer()))
    expect(await failureOf(made.read('09000'))).toMatchObject({ code: 'TIMEOUT' })
    for (const send of late) send()
    plc.script = (asked) => asked.reply()
    plc.files.get(0)?.set([7], 0o4000)
    await until(() => made.state.name === 'connected')
    expect(await made.read('09000', { timeout: 5000 })).toBe(7)
  })

  test('an answer that comes twice over UDP is never taken for the next one', async () => {
    const plc = new SmallJw('datagram')
    await onSockets('udp', {}, plc, async (made) => {
      plc.files.get(0)?.set([1, 2, 3, 4], 0o4000)
      plc.script = (asked) => {
        const bytes = asked.answer()
        asked.peer.send(bytes)
        asked.peer.send(bytes)
      }
      for (let value = 5; value < 25; value++) {
        plc.files.get(0)?.set([value], 0o4000)
        expect(await made.read('09000')).toBe(value)
      }
    })
  })

  test('over UDP with a fixed port a loopback stands between two requests', async () => {
    const plc = new SmallJw('datagram')
    const { port, close } = await freeUdpPort()
    await close()
    await onSockets('udp', { localPort: port }, plc, async (made) => {
      plc.script = (asked) => {
        const bytes = asked.answer()
        asked.peer.send(bytes)
        asked.peer.send(bytes)
      }
      for (let value = 5; value < 15; value++) {
        plc.files.get(0)?.set([value], 0o4000)
        expect(await made.read('09000')).toBe(value)
      }
      expect(plc.proofs).toBeGreaterThanOrEqual(10)
    })
  })

  test('an answer to another address breaks the protocol', async () => {
    const { client: made, plc } = inMemory()
    client = made
    plc.script = ({ peer, answer }) => {
      const bytes = answer()
      bytes[5] = (bytes[5] ?? 0) ^ 1
      peer.send(bytes)
    }
    expect(await failureOf(made.read('09000'))).toMatchObject({ code: 'ECHO_MISMATCH' })
  })

  test('a cut connection leaves a write unknown', async () => {
    const { client: made, plc } = inMemory()
    client = made
    plc.script = ({ peer }) => peer.reset()
    expect(await failureOf(made.write('09000', 1))).toMatchObject({ outcome: 'unknown' })
    expect(plc.asked).toEqual(['writeDataMemory'])
  })
})

async function freeUdpPort(): Promise<{ port: number; close: () => Promise<void> }> {
  const listener = await listenUdp({ port: 0 }, () => {})
  return { port: listener.port, close: () => listener.close() }
}
