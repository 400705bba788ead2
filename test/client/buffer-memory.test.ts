// Buffer memory of the connected module and of MELSEC-Q modules, over loopback TCP in both codes.
import { afterEach, describe, expect, test } from '@jest/globals'
import type { MelsecClient } from '../../src/client/melsec/client'
import { createMelsecClient } from '../../src/client/melsec/melsec-client'
import type { MelsecOptions, NetworkPlc } from '../../src/client/melsec/options'
import { PlcError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import { createPlcSimulator, type PlcSimulator, type PlcSimulatorOptions } from '../../src/simulator/server'

const ended: (() => Promise<void>)[] = []
afterEach(async () => {
  for (const end of ended.splice(0)) await end()
})

const memory = {
  bufferMemory: 1024,
  extensions: { modules: [{ unit: 3, points: 1024, model: 'Q62DA' }] },
} as const

async function pair(
  given: Partial<MelsecOptions & NetworkPlc> = {},
  plcGiven: PlcSimulatorOptions = {},
): Promise<{ plc: PlcSimulator; client: MelsecClient }> {
  const plc = createPlcSimulator({ profile: 'q', ...memory, ...plcGiven })
  await plc.listen()
  const { host, port } = plc.tcp ?? { host: '', port: 0 }
  const client = createMelsecClient({ host, port, profile: 'q', allowWrites: true, ...given })
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

describe.each(['binary', 'ascii'] as const)('in %s code', (code) => {
  test('what was written is read back, word by word', async () => {
    const { client } = await pair({ code }, { code })
    await client.memory.write(1020, [1, 0x8000, 0xfffe, 0x1234])
    expect(await client.memory.read(1019, 5)).toEqual([0, 1, 0x8000, 0xfffe, 0x1234])
    const most = Array.from({ length: 480 }, (_, i) => i * 100)
    await client.memory.write(0, most)
    expect(await client.memory.read(0, 480)).toEqual(most)
  })

  test('a module is named, and shows the memory of U3\\G', async () => {
    const { client } = await pair({ code }, { code })
    const module = client.module('Q62DA', { startIo: 0x30 })
    await client.write('U3\\G1:UINT[2]', [0x1234, 0xfedc])
    expect(await module.read(1, 2)).toEqual([0x1234, 0xfedc])
    await module.write(0x18, [1000])
    expect(await client.read('U3\\G24')).toBe(1000)
    const most = Array.from({ length: 960 }, (_, i) => 0xffff - i)
    await module.write(64, most)
    expect(await module.read(64, 960)).toEqual(most)
  })
})

describe('refused before anything is sent', () => {
  const cases: readonly [what: string, call: (client: MelsecClient) => Promise<unknown>][] = [
    ['too many words', (client) => client.memory.read(0, 481)],
    ['no words', (client) => client.memory.read(0, 0)],
    ['a fraction', (client) => client.memory.read(0.5, 1)],
    ['a negative address', (client) => client.memory.read(-1, 1)],
    ['too many values', (client) => client.memory.write(0, new Array<number>(481).fill(0))],
    ['no values', (client) => client.memory.write(0, [])],
    ['a value that is no word', (client) => client.memory.write(0, [-1])],
    ['too many words of a module', (client) => client.module('Q62DA', { startIo: 0 }).read(0, 961)],
    ['half a word of a module', (client) => client.module('Q62DA', { startIo: 0 }).read(0, 1.25)],
    [
      'an odd number of bytes',
      (client) => client.request(commands.readExtendUnit, { address: 0x1008, byteCount: 3, moduleNumber: 3 }),
    ],
    [
      'an odd number of data',
      (client) =>
        client.request(commands.writeExtendUnit, { address: 0x1008, moduleNumber: 3, data: new Uint8Array([1, 2, 3]) }),
    ],
    [
      'an address within a word',
      (client) => client.request(commands.readExtendUnit, { address: 0x1009, byteCount: 2, moduleNumber: 3 }),
    ],
    ['no word of a module', (client) => client.module('Q62DA', { startIo: 0 }).write(0, [])],
    ['a word too large for a module', (client) => client.module('Q62DA', { startIo: 0 }).write(0, [65536])],
    ['a hole', (client) => client.module('Q62DA', { startIo: 0 }).write(0, new Array<number>(1))],
  ]
  test.each(cases)('%s', async (_what, call) => {
    const { client, plc } = await pair()
    expect(await rejection(call(client))).toMatchObject({ outcome: 'notSent' })
    expect(plc.statistics.requests).toBe(0)
  })

  test('writing without permission', async () => {
    const { client, plc } = await pair({ allowWrites: false })
    expect(await rejection(client.memory.write(0, [1]))).toMatchObject({ code: 'NOT_PERMITTED' })
    const module = client.module('Q62DA', { startIo: 0x30 })
    expect(await rejection(module.write(0, [1]))).toMatchObject({ code: 'NOT_PERMITTED' })
    expect(plc.statistics.requests).toBe(0)
  })

  test('an iQ-F has neither', async () => {
    const { client } = await pair({ profile: 'iq-f' }, { profile: 'iq-f' })
    for (const call of [client.memory.read(0, 1), client.module('Q62DA', { startIo: 0 }).read(0, 1)]) {
      expect(await rejection(call)).toMatchObject({ code: 'UNSUPPORTED', outcome: 'notSent' })
    }
  })
})

test('a module that is not there, and what is beyond its memory, is refused by the PLC', async () => {
  const { client } = await pair()
  const elsewhere = client.module('Q62DA', { startIo: 0x40 })
  expect(await rejection(elsewhere.read(0, 1))).toMatchObject({ code: 'END_CODE', outcome: 'refused' })
  const module = client.module('Q62DA', { startIo: 0x30 })
  expect(await rejection(module.read(1023, 2))).toMatchObject({ code: 'END_CODE', endCode: 0x4041 })
  expect(await rejection(client.memory.read(1023, 2))).toMatchObject({ code: 'END_CODE', endCode: 0x4041 })
})

test('two modules with the same module No. are refused by the simulator', () => {
  const modules = [
    { unit: 3, points: 16, model: 'Q64TCTTBW' },
    { unit: 4, points: 16, model: 'Q62DA' },
  ]
  expect(() => createPlcSimulator({ profile: 'q', extensions: { modules } })).toThrow('same module No.')
})
