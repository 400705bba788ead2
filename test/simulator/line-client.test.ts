/** A client and a simulated line, in memory, by TCP and by a real pair of serial ports. */
import { afterEach, describe, expect, test } from '@jest/globals'
import { createLineSimulator, createPlcSimulator, type LineSimulatorOptions } from '../../src/entry/simulator'
import {
  createMelsecClient,
  createMelsecLine,
  EndCodeError,
  type MelsecClientOptions,
  type ProfileId,
} from '../../src/index'
import { ttyPair } from '../support/tty-pair'
import { frameFormats } from './line-support'

const ends: (() => unknown)[] = []

afterEach(async () => {
  for (const end of ends.splice(0).reverse()) await end()
})

function clientOf(options: MelsecClientOptions) {
  const client = createMelsecClient({
    profile: 'fx5-serial',
    asciiXy: 'octal',
    allowWrites: true,
    allowControl: true,
    ...options,
  })
  ends.push(() => client.close())
  return client
}

async function lineOf(options: LineSimulatorOptions) {
  const line = createLineSimulator(options)
  ends.push(() => line.close())
  await line.listen()
  return line
}

const MEMORY = { host: 'in memory', port: 1 } as const

describe.each(frameFormats)('$frame, format $messageFormat', ({ frame, messageFormat }) => {
  test.each([true, false])('sum check %s: values, errors and remote control', async (sumCheck) => {
    const line = await lineOf({ messageFormat, sumCheck, tcp: false, stations: { 2: {} } })
    const client = clientOf({
      ...MEMORY,
      frame,
      messageFormat,
      sumCheck,
      route: { station: 2 },
      openTransport: line.connect(),
    })
    const plc = line.station(2)
    plc.write('D0', 4096)
    plc.write('X17', true)
    expect(await client.read('D0')).toBe(4096)
    expect(await client.read('X17')).toBe(true)
    await client.write({ 'D100:REAL': 1.5, 'D200:STRING(10)': 'ABC', M8: true, D4112: 16 })
    expect(['D100:REAL', 'D200:STRING(10)', 'M8', 'D4112'].map((item) => plc.read(item))).toEqual([
      1.5,
      'ABC',
      true,
      16,
    ])
    expect(await client.readValues(['D100:REAL', 'D4112', 'M8'])).toEqual([1.5, 16, true])
    await client.control.stop()
    expect(plc.cpu.state).toBe('STOP')
    await client.control.run()
    expect(plc.cpu.state).toBe('RUN')
    plc.faults.add({ kind: 'endCode', endCode: frame === '1C' ? 0x06 : 0x7143 })
    await expect(client.read('D0')).rejects.toThrow(EndCodeError)
  })

  test('what is damaged once is read once more, and a write that did not arrive is written once', async () => {
    const line = await lineOf({ messageFormat, tcp: false })
    const client = clientOf({ ...MEMORY, frame, messageFormat, openTransport: line.connect() })
    line.station(0).write('D0', 77)
    await client.connect()
    const writes: unknown[] = []
    line.station(0).on('write', ({ message }) => writes.push(message?.values))
    const { faults } = line
    const wrongSum = faults.add({ kind: 'wrongSum', times: 1 })
    expect(await client.read('D0')).toBe(77)
    const changed = faults.add({ kind: 'damaged', at: 10, mask: 2, times: 1 })
    expect(await client.read('D0')).toBe(77)
    const misheard = faults.add({ kind: 'misheard', at: 12, mask: 2, times: 1, commands: ['writeWords'] })
    await client.write('D1', 5)
    expect([wrongSum, changed, misheard].map(({ struck }) => struck)).toEqual([1, 1, 1])
    expect([line.station(0).read('D1'), writes.length]).toEqual([5, 1])
  })
})

test.each([
  ['fx3-serial', '1C', 1],
  ['iq-r-c24', '3C', 4],
  ['q-c24', '4C', 5],
  ['l-c24', '4C', 1],
] as const)('a station of %s', async (profile: ProfileId, frame, messageFormat) => {
  const line = await lineOf({ profile, messageFormat, tcp: false })
  const client = createMelsecClient({
    ...MEMORY,
    profile,
    frame,
    messageFormat,
    allowWrites: true,
    openTransport: line.connect(),
  })
  ends.push(() => client.close())
  await client.write('D10', 7)
  line.station(0).write('X17', true)
  expect([await client.read('D10'), line.station(0).read('D10'), await client.read('X17')]).toEqual([7, 7, true])
})

test('several clients on a line behind a device server, one of whose stations is silent', async () => {
  const line = await lineOf({ messageFormat: 4, stations: { 0: {}, 1: {}, 2: {} } })
  line.station(1).faults.add({ kind: 'silence' })
  for (const [number, station] of line.stations) station.write('D0', 100 + number)
  const { host, port } = line.tcp ?? { host: '', port: 0 }
  const shared = createMelsecLine({ host, port, frame: '3C', messageFormat: 4 })
  const clients = [0, 1, 2].map((station) =>
    clientOf({ line: shared, route: { station }, timeout: station === 1 ? 300 : 10_000 }),
  )
  const values = await Promise.allSettled(clients.map((client) => client.read('D0')))
  expect(values.map((result) => (result.status === 'fulfilled' ? result.value : 'silent'))).toEqual([
    100,
    'silent',
    102,
  ])
})

test('on a real pair of serial ports', async () => {
  const pair = await ttyPair()
  ends.push(() => pair.close())
  const line = await lineOf({ messageFormat: 4, serial: { path: pair.near, baudRate: 115_200 }, echo: true })
  const client = clientOf({ serial: { path: pair.far, baudRate: 115_200 }, frame: '3C', messageFormat: 4 })
  await client.write('D0', 1234)
  expect([await client.read('D0'), line.station(0).read('D0')]).toEqual([1234, 1234])
})

test('a PLC at Ethernet is none of a serial line', () => {
  expect(() => createPlcSimulator({ profile: 'fx5-serial', code: 'ascii' })).toThrow(/createLineSimulator/)
})
