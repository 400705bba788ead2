/** What a transport tells is lent: its memory holds something else as soon as the client has looked at it. */
import { describe, expect, test } from '@jest/globals'
import { createPlcSimulator } from '../../src/entry/simulator'
import { createMelsecClient, type OpenTransport, type TraceEntry } from '../../src/index'
import { ON_DEMAND_WORDS, onDemandFrames } from '../melsec/on-demand-frames'
import { failureOf, until } from './line'

interface Lending {
  readonly open: OpenTransport
  /** Bytes for the client, as if they had come. */
  readonly lend: (bytes: Buffer) => void
}

/** Lends every chunk in pieces of so many bytes, all in the same memory, and spoils it as soon as it is given back. */
function lending(open: OpenTransport, size: number): Lending {
  const memory = Buffer.alloc(4096)
  let lend: (bytes: Buffer) => void = () => {}
  const openLending: OpenTransport = () => {
    const transport = open()
    const openInner = transport.open.bind(transport)
    transport.open = (handlers) => {
      lend = (bytes) => {
        for (let at = 0; at < bytes.length; at += size) {
          const piece = bytes.subarray(at, at + size)
          memory.set(piece)
          handlers.received(memory.subarray(0, piece.length))
          memory.fill(0x5a)
        }
      }
      openInner({ ...handlers, received: lend })
    }
    return transport
  }
  return { open: openLending, lend: (bytes) => lend(bytes) }
}

/** A client and a simulated PLC in memory, with a lending transport between them. */
function line({ frame, code }: Pick<(typeof onDemandFrames)[number], 'frame' | 'code'>, size: number) {
  const plc = createPlcSimulator({ profile: 'iq-r', code })
  const { open, lend } = lending(plc.connect(), size)
  const client = createMelsecClient({ host: 'plc', port: 1, profile: 'iq-r', frame, code, openTransport: open })
  const close = async () => {
    await client.close()
    await plc.close()
  }
  return { plc, client, lend, close }
}

const WHOLE = 4096

describe.each(onDemandFrames)('$frame $code', ({ frame, code, bytes }) => {
  test.each([1, 7, WHOLE])('values are those of the PLC, in pieces of %i byte(s)', async (size) => {
    const { plc, client, close } = line({ frame, code }, size)
    const words = Array.from({ length: 9 }, (_, i) => 1000 * i - 4000)
    const bits = Array.from({ length: 9 }, (_, i) => i % 3 === 0)
    for (const [i, word] of words.entries()) plc.write(`D${i}:INT`, word)
    for (const [i, bit] of bits.entries()) plc.write(`M${i}`, bit)
    plc.write('D20:STRING(9)', 'Furnace 1')
    expect(await client.readValues(['D0:INT[9]', 'M0[9]', 'D20:STRING(9)'])).toEqual([words, bits, 'Furnace 1'])
    expect(await client.read('M0[9]')).toEqual(bits)
    expect((await client.identify()).model).toBe('R08CPU')
    await close()
  })

  test.each([1, 7, WHOLE])('a trace that is looked at later shows what came, in pieces of %i byte(s)', async (size) => {
    const { plc, client, close } = line({ frame, code }, size)
    plc.write('D0', 0x1234)
    await client.connect()
    const entries: TraceEntry[] = []
    client.on('trace', (entry) => entries.push(entry))
    expect(await client.read('D0')).toBe(0x1234)
    await close()
    const received = entries.filter(({ direction }) => direction === 'received')
    expect(received.map(({ text }) => text).join('\n')).toContain('D0: 4660')
    const all = Buffer.concat(received.map((entry) => entry.bytes))
    expect(all.subarray(code === 'ascii' ? -4 : -2)).toEqual(Buffer.from(code === 'ascii' ? '1234' : '4\x12'))
  })

  test.each([1, 7, WHOLE])('On-demand is kept, in pieces of %i byte(s)', async (size) => {
    const { client, lend, close } = line({ frame, code }, size)
    const told: unknown[] = []
    client.on('onDemand', ({ words }) => told.push(words))
    await client.connect()
    lend(bytes)
    await until(() => told.length > 0)
    expect(told).toEqual([ON_DEMAND_WORDS])
    await close()
  })
})

test('an error holds the bytes that came', async () => {
  const { plc, client, lend, close } = line({ frame: '3E', code: 'binary' }, WHOLE)
  await client.connect()
  plc.faults.add({ kind: 'silence' })
  const reading = failureOf(client.read('D0'))
  await until(() => client.statistics.inFlight > 0)
  lend(Buffer.from('garbage'))
  expect(await reading).toMatchObject({ code: 'BAD_FRAME', bytes: Buffer.from('garbage') })
  await close()
})
