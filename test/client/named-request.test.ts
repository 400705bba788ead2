// Commands by name, with messages as JSON, through sockets.
import { afterEach, describe, expect, test } from '@jest/globals'
import type { MelsecClient } from '../../src/client/melsec/client'
import { createMelsecClient } from '../../src/client/melsec/melsec-client'
import type { MelsecOptions, NetworkPlc } from '../../src/client/melsec/options'
import { PlcError } from '../../src/errors'
import { createPlcSimulator, type PlcSimulator, type PlcSimulatorOptions } from '../../src/simulator/server'

const ended: (() => Promise<void>)[] = []
afterEach(async () => {
  for (const end of ended.splice(0)) await end()
})

async function pair(
  given: Partial<MelsecOptions & NetworkPlc> = {},
  plcGiven: PlcSimulatorOptions = {},
): Promise<{ plc: PlcSimulator; client: MelsecClient }> {
  const plc = createPlcSimulator({ profile: 'iq-r', ...plcGiven })
  await plc.listen()
  const { host, port } = (given.transport === 'udp' ? plc.udp : plc.tcp) ?? { host: '', port: 0 }
  const client = createMelsecClient({ host, port, profile: 'iq-r', ...given })
  ended.push(
    () => client.close(),
    () => plc.close(),
  )
  return { plc, client }
}

async function rejection(promise: Promise<unknown>): Promise<PlcError> {
  const error = await promise.then(
    () => undefined,
    (reason: unknown) => reason,
  )
  if (error instanceof PlcError) return error
  throw new Error(`no PlcError: ${String(error)}`)
}

const registering = (device: string) => ({ entryMonitorDevice: { words: [{ device }], doubleWords: [] } })

test.each(['binary', 'ascii'] as const)('a command by name gives the answer of request(), %s', async (code) => {
  const { plc, client } = await pair({ code }, { code })
  plc.write('D100', 7)
  expect(await client.requestByName('readWords', { head: 'D100', points: 2 })).toEqual({ values: [7, 0] })
  expect(await client.requestByName('0101')).toMatchObject({ modelCode: 0x4801 })
})

test('permissions are those of the command', async () => {
  const { plc, client } = await pair()
  const write = client.requestByName('writeWords', { head: 'D0', values: [1] })
  expect(await rejection(write)).toMatchObject({ code: 'NOT_PERMITTED', field: 'allowWrites', outcome: 'notSent' })
  const stop = client.requestByName('remoteStop')
  expect(await rejection(stop)).toMatchObject({ code: 'NOT_PERMITTED', field: 'allowControl', outcome: 'notSent' })
  expect(plc.read('D0')).toBe(0)
  // What would be sent can be explained all the same.
  expect(client.explainRequest('writeWords', { head: { device: 'D', number: 0 }, values: ['0x10'] })).toEqual({
    name: 'writeWords',
    title: 'Write (word units)',
    effect: 'write',
    message: { head: 'D0', values: [16] },
  })
})

describe('X and Y', () => {
  const head = { head: 'X10', points: 1 }

  test('are numbered as the client does it', async () => {
    const { plc, client } = await pair({ profile: 'iq-f' }, { profile: 'iq-f' })
    plc.write('X10', true)
    expect(await client.requestByName('readBits', head)).toEqual({ values: [true] })
    expect(client.explainRequest('readBits', { head: { device: 'X', number: 8 }, points: 1 }).message).toEqual(head)
    expect(client.notation).toEqual({ xyRadix: 8, wRadix: 16 })
  })

  test('are refused where nobody knows, unless it is said', async () => {
    const { client } = await pair({ profile: 'generic' })
    expect(await rejection(client.requestByName('readBits', head))).toMatchObject({
      code: 'BAD_ADDRESS',
      field: 'head',
      outcome: 'notSent',
    })
    expect(client.notation).toEqual({ wRadix: 16 })
    const { client: told } = await pair({ profile: 'generic', xyRadix: 16 })
    expect(await told.requestByName('readBits', head)).toEqual({ values: [false] })
  })
})

describe('Execute Monitor', () => {
  test('many at once get the values of their own registrations, beside a monitor', async () => {
    const { plc, client } = await pair()
    for (let i = 0; i < 8; i++) plc.write(`D${i}`, 100 + i)
    const monitor = client.monitor(['D7'])
    const asked = Array.from({ length: 7 }, (_, i) => client.requestByName('executeMonitor', registering(`D${i}`)))
    const [answers, [own]] = await Promise.all([Promise.all(asked), monitor.read()])
    expect(answers).toEqual([0, 1, 2, 3, 4, 5, 6].map((i) => ({ words: [100 + i], doubleWords: [] })))
    expect(own).toMatchObject({ ok: true, value: 107 })
    expect((await monitor.read())[0]).toMatchObject({ ok: true, value: 107 })
  })

  test('a registration that the PLC refuses is told, and the next one works', async () => {
    const { plc, client } = await pair()
    plc.faults.add({ kind: 'endCode', endCode: 0x4031, commands: ['entryMonitorDevice'], times: 1 })
    const refused = await rejection(client.requestByName('executeMonitor', registering('D0')))
    expect(refused).toMatchObject({ code: 'END_CODE', outcome: 'refused' })
    expect(await client.requestByName('executeMonitor', registering('D0'))).toEqual({ words: [0], doubleWords: [] })
  })

  test('needs the registration, and is refused over UDP', async () => {
    const { client } = await pair({ transport: 'udp' })
    expect(await rejection(client.requestByName('executeMonitor'))).toMatchObject({ field: 'entryMonitorDevice' })
    for (const bad of [null, 5, 'D0', [1]]) {
      expect((await rejection(client.requestByName('executeMonitor', bad))).outcome).toBe('notSent')
    }
    const overUdp = await rejection(client.requestByName('executeMonitor', registering('D0')))
    expect(overUdp).toMatchObject({ code: 'UNSUPPORTED', outcome: 'notSent' })
  })
})

test('over a 1E frame the commands it has are its own, and the others are refused', async () => {
  const { plc, client } = await pair({ profile: 'iq-f', frame: '1E' }, { profile: 'iq-f' })
  plc.write('D100', 7)
  expect(await client.requestByName('readWords', { head: 'D100', points: 1 })).toEqual({ values: [7] })
  expect(await client.requestByName('selfTest', { data: 'ABC0' })).toEqual({ data: 'ABC0' })
  expect(await client.requestByName('readTypeName')).toHaveProperty('modelCode')
  const random = { words: [{ device: 'D100' }], doubleWords: [] }
  expect(await rejection(client.requestByName('readRandom', random))).toMatchObject({
    code: 'UNSUPPORTED',
    outcome: 'notSent',
  })
  expect(() => client.explainRequest('readRandom', random)).toThrow(/1E/)
})

test('what is no name and no message is refused', async () => {
  const { plc, client } = await pair()
  for (const name of ['', 'nothing', '0401', 5, null, undefined, {}]) {
    const error = await rejection(client.requestByName(name as string, {}))
    expect(error).toMatchObject({ code: 'BAD_OPTION', field: 'command', outcome: 'notSent' })
  }
  for (const message of [null, 5, 'D0', [], { head: 'D0' }, { head: 'D0', points: 1, more: 1 }]) {
    const error = await rejection(client.requestByName('readWords', message))
    expect(error).toMatchObject({ code: 'BAD_MESSAGE', outcome: 'notSent' })
  }
  expect(plc.connections).toEqual([])
})
