// A real serial port that goes and comes again under the same path, as with a USB adapter that is pulled out.
import { mkdtemp, rm } from 'node:fs/promises'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { afterEach, expect, test } from '@jest/globals'
import { createMelsecClient, createMelsecLine, PlcError } from '../../src/index'
import { Responder } from '../../src/link/link'
import { serialRoute } from '../../src/melsec/frame/serial-frames'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import { serialTransport } from '../../src/transport/serial'
import { type TtyPair, ttyPair } from '../support/tty-pair'
import { nextState, until } from './line'

const FRAME = { frame: '3C', format: 4 } as const
const PORT = { baudRate: 115_200, dataLength: 8, parity: 'none' } as const
const ends: (() => unknown)[] = []
afterEach(async () => {
  for (const end of ends.splice(0)) await end()
})

/** Every station on the far port, whose words are its number; those that are asked to write say nothing. */
function stationsOn(path: string): Promise<void> {
  const framing = serialFraming(FRAME)
  const profile = resolveProfile('q')
  const protocol = new MelsecProtocol({ framing, head: serialRoute('3C'), profile, code: framing.code })
  const responder = new Responder(framing, 'stream', () => undefined)
  const transport = serialTransport({ path, ...PORT })()
  ends.unshift(() => transport.close())
  return new Promise((opened) => {
    transport.open({
      opened,
      closed: () => {},
      received: (bytes) => {
        for (const frame of responder.receive(Buffer.from(bytes))) {
          const request = protocol.readRequest(frame)
          if ('unknown' in request || request.name === 'writeWords') continue
          const { points = 0 } = request.message as { points?: number }
          const response =
            request.name === 'readTypeName'
              ? { model: 'FX5U'.padEnd(16), modelCode: 0x4a21 }
              : { values: Array.from({ length: points }, () => frame.head.station) }
          transport.send(responder.answer(frame, 0, protocol.writeResponse(request, response)))
        }
      },
    })
  })
}

test('an adapter that is pulled out ends each call once; plugged in again, all stations are there again by themselves', async () => {
  const folder = await mkdtemp(join(tmpdir(), 'melsec-jw-'))
  ends.push(() => rm(folder, { recursive: true }))
  const link = join(folder, 'ttyUSB0')
  const plugged = async (): Promise<TtyPair> => {
    const pair = await ttyPair(link)
    ends.unshift(() => pair.close())
    await stationsOn(pair.far)
    return pair
  }
  const pair = await plugged()
  const line = createMelsecLine({ serial: { path: link, ...PORT }, frame: '3C', messageFormat: 4 })
  const clients = [1, 2, 3].map((station) =>
    createMelsecClient({
      line,
      profile: 'fx5-serial',
      asciiXy: 'octal',
      route: { station },
      allowWrites: true,
      reconnect: { first: 50, longest: 300 },
    }),
  )
  ends.unshift(() => Promise.all(clients.map((client) => client.close())))
  expect(line.isOpen).toBe(false)
  expect(await Promise.all(clients.map((client) => client.read('D0')))).toEqual([1, 2, 3])
  expect(line.isOpen).toBe(true)

  const settled: unknown[] = []
  const sentBefore = clients.map(({ statistics }) => statistics.bytesSent)
  const writes = clients.map((client) =>
    client.write('D0', 7, { timeout: 1000 }).then(
      () => settled.push('done'),
      (error: unknown) => settled.push(error instanceof PlcError ? `${error.code} ${error.outcome}` : error),
    ),
  )
  await until(() => clients.some(({ statistics }, at) => statistics.bytesSent > (sentBefore[at] ?? 0)), 'one was sent')
  await pair.close()
  await Promise.all(writes)
  expect(settled).toHaveLength(3)
  // The system tells of it at once, or, when it happens while the port is read, at the next attempt to send.
  expect(settled.filter((told) => told === 'DISCONNECTED unknown' || told === 'TIMEOUT unknown')).toHaveLength(1)
  expect(settled.filter((told) => told === 'OFFLINE notSent' || told === 'TIMEOUT notSent')).toHaveLength(2)
  await until(() => clients.every(({ state }) => state.name !== 'connected') && !line.isOpen, 'the loss is noticed')

  await plugged()
  await Promise.all(clients.map((client) => nextState(client, 'connected')))
  expect(await Promise.all(clients.map((client) => client.read('D0')))).toEqual([1, 2, 3])
  expect(settled).toHaveLength(3)
  for (const client of clients.slice(1)) await client.close()
  expect(line.isOpen).toBe(true)
  await clients[0]?.close()
  expect(line.isOpen).toBe(false)
}, 60_000)
