/** The client over 1E frames against the simulated iQ-F: typed items, control, and what 1E cannot do. */
import { describe, expect, test } from '@jest/globals'
import { createMelsecClient } from '../../src/client/melsec/melsec-client'
import type { MelsecOptions, NetworkPlc } from '../../src/client/melsec/options'
import { RequestError } from '../../src/errors'
import type { MelsecClient, TraceEntry } from '../../src/index'
import { commands } from '../../src/melsec/commands/commands'
import { createPlcSimulator, type PlcSimulator } from '../../src/simulator/server'

const CODES = ['binary', 'ascii'] as const

interface Joined {
  readonly plc: PlcSimulator
  readonly client: MelsecClient
}

async function joined(
  code: 'binary' | 'ascii',
  run: (joined: Joined) => Promise<void>,
  options: Partial<MelsecOptions & NetworkPlc> = {},
): Promise<void> {
  const plc = createPlcSimulator({ profile: 'iq-f', code, frames: ['1E'] })
  await plc.listen()
  const port = plc[options.transport === 'udp' ? 'udp' : 'tcp']?.port ?? 0
  const client = createMelsecClient({
    host: '127.0.0.1',
    port,
    profile: 'iq-f',
    frame: '1E',
    code,
    asciiXy: 'octal',
    allowWrites: true,
    allowControl: true,
    ...options,
  })
  try {
    await run({ plc, client })
  } finally {
    await client.close()
    await plc.close()
  }
}

describe.each(CODES)('%s', (code) => {
  test('reads what the PLC holds', () =>
    joined(code, async ({ plc, client }) => {
      const values = {
        'D100:REAL': 1.5,
        'D7998:DINT': -70_000,
        R32767: -3,
        'D200:STRING(7)': 'over 1E',
        TN511: 511,
        CN199: 199,
        LCN0: 123_456_789,
        LCN55: -5,
        SD8000: 12,
        'D10.F': true,
      }
      const bits = ['X377', 'Y0', 'M7679', 'S4095', 'TS511', 'CS0', 'CS199', 'LCS0', 'LCS55', 'SM8000', 'SM8511']
      for (const [item, value] of Object.entries(values)) plc.write(item, value)
      for (const item of bits) plc.write(item, true)
      const read = await client.readValues([...Object.keys(values), ...bits, 'M7678', 'CS198', 'LCS54'])
      expect(read).toEqual([...Object.values(values), ...bits.map(() => true), false, false, false])
    }))

  test('reads arrays larger than a request, and K digits', () =>
    joined(code, async ({ plc, client }) => {
      for (let i = 0; i < 200; i++) plc.memory.setWord('D', i, i * 3)
      for (let i = 0; i < 700; i += 3) plc.memory.setBit('M', i, true)
      for (let i = 1; i < 200; i += 2) plc.memory.setBit('CS', i, true)
      const [d, m, cs, k] = await client.read(['D0[200]', 'M1[699]', 'CS0[199]', 'K4M3'])
      expect(d).toMatchObject({ ok: true, torn: true, value: Array.from({ length: 200 }, (_, i) => i * 3) })
      expect(m).toMatchObject({ ok: true, value: Array.from({ length: 699 }, (_, i) => (i + 1) % 3 === 0) })
      expect(cs).toMatchObject({ ok: true, value: Array.from({ length: 199 }, (_, i) => i % 2 === 1) })
      expect(k).toMatchObject({ ok: true, value: 0b1001001001001001 - 0x10000 })
    }))

  test('writes, and nothing beside', () =>
    joined(code, async ({ plc, client }) => {
      const written = {
        'D100:REAL': -2.25,
        'D103:LINT': 2n ** 40n,
        'R0:STRING(3)': 'abc',
        LCN7: 70_000,
        SD8010: 5,
        M5: true,
        Y17: true,
        CS199: true,
        LCS55: true,
        K4Y20: 0x1234,
        K1M100: 9,
        'M201[3]': [true, false, true],
        'D300[150]': Array.from({ length: 150 }, (_, i) => i - 75),
      }
      const results = await client.writeEach(written)
      expect(Object.values(results).filter(({ ok }) => !ok)).toEqual([])
      expect(await client.readValues(Object.keys(written))).toEqual(Object.values(written))
      expect(['M4', 'M6', 'M200', 'M204', 'M99', 'M104', 'Y16'].map((item) => plc.read(item))).toEqual(
        new Array(7).fill(false),
      )
      plc.write('D50', 0x00f0)
      plc.write('D60', 1)
      const masked = await client.writeEach({ 'D50.0': true, 'D60.F': true }, { readModifyWrite: true })
      expect(Object.values(masked)).toMatchObject([{ ok: true }, { ok: true }])
      expect([plc.read('D50'), plc.read('D60')]).toEqual([0xf1, 1 - 0x8000])
    }))

  test('runs, stops, tests and identifies', () =>
    joined(code, async ({ plc, client }) => {
      await client.control.stop()
      expect(plc.cpu.state).toBe('STOP')
      await client.control.run()
      expect(plc.cpu.state).toBe('RUN')
      expect((await client.selfTest()).roundTrip).toBeGreaterThanOrEqual(0)
      // One type code for several CPUs, and no name: models, but no profile.
      const identity = await client.identify()
      expect(identity).toEqual({ model: '', modelCode: 0xf3, models: expect.arrayContaining(['FX5U', 'FX3U']) })
    }))
})

describe.each(CODES)('FX3, %s', (code) => {
  const fx3 = async (run: (joined: Joined) => Promise<void>): Promise<void> => {
    const plc = createPlcSimulator({ profile: 'fx3', code })
    await plc.listen()
    const port = plc.tcp?.port ?? 0
    const client = createMelsecClient({
      host: '127.0.0.1',
      port,
      profile: 'fx3',
      code,
      allowWrites: true,
    })
    try {
      await run({ plc, client })
    } finally {
      await client.close()
      await plc.close()
    }
  }

  test('speaks 1E by itself, with its own names', () =>
    fx3(async ({ plc, client }) => {
      const items = [
        'D0',
        'D7999',
        'D8000',
        'M7679',
        'M8000',
        'M8511',
        'CS199',
        'CS200',
        'CS255',
        'X377',
        'LCN55',
        'M0[3]',
      ]
      for (const item of ['D8000', 'D7999']) plc.write(item.replace('D8', 'SD8'), 5)
      for (const item of ['M7679', 'SM8000', 'SM8511', 'CS199', 'LCS0', 'LCS55', 'X377', 'M2']) plc.write(item, true)
      plc.write('LCN55', -70_000)
      const expected = [0, 5, 5, true, true, true, true, true, true, true, -70_000, [false, false, true]]
      expect(await client.readValues(items)).toEqual(expected)
      expect(client.profile.frame).toBe('1E')
      const written = { D8013: 7, M8034: true, 'M101[3]': [true, true, true], CS200: false }
      expect(Object.values(await client.writeEach(written)).every(({ ok }) => ok)).toBe(true)
      expect(['SD8013', 'SM8034', 'M101', 'M103', 'M104', 'LCS0'].map((item) => plc.read(item))).toEqual([
        7,
        true,
        true,
        true,
        false,
        false,
      ])
    }))

  test('the 32-bit counters and the gap between M7679 and M8000 are told', () =>
    fx3(async ({ client }) => {
      await expect(client.read('CN200')).rejects.toMatchObject({ message: expect.stringContaining('LCN0') })
      await expect(client.read('M7700')).rejects.toMatchObject({ code: 'OUT_OF_RANGE', outcome: 'notSent' })
      await expect(client.read('M7990..M8010')).rejects.toMatchObject({ outcome: 'notSent' })
    }))

  test('an abnormal code has two bytes, and the connection lives', () =>
    fx3(async ({ plc, client }) => {
      await client.connect()
      plc.faults.add({ kind: 'endCode', endCode: 0x5b, times: 1 })
      await expect(client.read('D0')).rejects.toMatchObject({ endCode: 0x5b })
      expect(await client.read('D0')).toBe(0)
      expect(plc.statistics.connections).toBe(1)
    }))
})

describe('what 1E cannot do is refused before anything is sent', () => {
  const untouched = async (run: (client: MelsecClient) => Promise<unknown>): Promise<unknown> => {
    let error: unknown
    await joined('binary', async ({ plc, client }) => {
      await client.connect()
      const { requests } = plc.statistics
      error = await run(client).then(
        () => undefined,
        (reason: unknown) => reason,
      )
      expect(plc.statistics.requests).toBe(requests)
    })
    return error
  }

  test.each([
    ['W10', 'no device W'],
    ['L0', 'no device L'],
    ['TC0', 'no device TC'],
    ['CN200', 'LCN0'],
    ['M8000', 'SM8000'],
    ['SM400', 'SM8000 to SM8511'],
    ['X400', 'X0 to X377'],
    ['U3\\G100', ''],
    ['D0Z1', ''],
    ['D0:STRING(200)', 'one request carries 64'],
  ])('%s', async (item, text) => {
    const error = await untouched((client) => client.read(item))
    expect(error).toBeInstanceOf(RequestError)
    expect((error as RequestError).message).toContain(text)
  })

  test.each([
    ['pause', (client: MelsecClient) => client.control.pause()],
    ['latch clear', (client: MelsecClient) => client.control.latchClear()],
    ['reset', (client: MelsecClient) => client.control.reset()],
    ['forced RUN', (client: MelsecClient) => client.control.run({ force: true })],
    ['clear error', (client: MelsecClient) => client.clearError()],
    ['random read', (client: MelsecClient) => client.request(commands.readRandom, { words: [], doubleWords: [] })],
    ['a form', (client: MelsecClient) => client.request(commands.readTypeName, {}, { form: 'short' })],
    ['a long self test', (client: MelsecClient) => client.selfTest('A'.repeat(255))],
  ] as const)('%s', async (_what, run) => {
    expect(await untouched(run)).toBeInstanceOf(RequestError)
  })

  test('families without it, and other stations', () => {
    const open = (options: Partial<MelsecOptions & NetworkPlc>) => () =>
      createMelsecClient({ host: 'plc', port: 5007, frame: '1E', ...options })
    expect(open({ profile: 'iq-r' })).toThrow('no 1E frame')
    expect(open({ profile: 'iq-f', route: { network: 1, station: 3 } })).toThrow('connected station')
    expect(open({ profile: 'iq-f', inFlight: 2 })).toThrow('inFlight')
  })
})

test('a plan shows what goes out; monitors become reads', () =>
  joined('binary', async ({ client }) => {
    const plan = client.plan(['D0', 'D70', 'D5000', 'X0', 'LCS0'])
    const { requests } = plan.describe()
    expect(requests.map(({ command }) => command)).toEqual([
      'readWords',
      'readWords',
      'readWords',
      'readWords',
      'readBits',
    ])
    expect(requests[0]).toMatchObject({ requestBytes: 12, responseBytes: 4 })
    const entries = ['D0.1', 'D0.2', 'D1.0'].map((item) => ({ item, value: true }))
    const bits = client.planWrite(entries, { readModifyWrite: true })
    expect(bits.describe().requests.map(({ command }) => command)).toEqual(['readWords', 'writeWords'])
    const monitor = client.monitor(['D0'])
    expect(monitor.mode).toBe('read')
    expect(await monitor.read()).toMatchObject([{ ok: true, value: 0 }])
    expect(client.explain('D100:REAL')).toMatchObject({ first: 'D100', last: 'D101', requests: 1 })
  }))

test('over UDP', () =>
  joined(
    'binary',
    async ({ plc, client }) => {
      plc.write('D1', 77)
      expect(await client.read('D1')).toBe(77)
    },
    { transport: 'udp' },
  ))

test('an end code is an error of the item, and the rest is read', () =>
  joined('binary', async ({ plc, client }) => {
    plc.faults.add({ kind: 'endCode', commands: ['readWords'], endCode: 0x5b, times: 1 })
    await expect(client.read('D0')).rejects.toMatchObject({ endCode: 0x5b, outcome: 'refused' })
    expect(await client.read('D0')).toBe(0)
  }))

test.each(CODES)('a trace in words, %s', (code) =>
  joined(code, async ({ plc, client }) => {
    plc.write('D100', 5)
    const entries: TraceEntry[] = []
    client.on('trace', (entry) => entries.push(entry))
    plc.faults.add({ kind: 'split', commands: ['readWords'], at: 3, pause: 20, times: 1 })
    await client.read('D100')
    const texts = entries.slice(-3).map(({ text }) => text)
    expect(texts[0]).toContain('Batch read (word units), D100, 1 point')
    expect(texts[1]).toContain('in a later chunk')
    expect(texts[2]).toMatch(/values +D100: 5 /)
  }),
)
