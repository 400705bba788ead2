/** Profiles of one kind of port, client against simulator: at the limits nothing is refused, behind them the end code. */
import { describe, expect, test } from '@jest/globals'
import { commands } from '../../src/entry/codec'
import type { EndCodeError } from '../../src/errors'
import type { CommandName, ProfileId } from '../../src/index'
import { failureOf, withLine } from './line'

const words = (count: number, step = 3, device = 'D') => Array.from({ length: count }, (_, n) => `${device}${n * step}`)

const READS: readonly CommandName[] = ['readRandom', 'readBlock', 'readWords']

/** Simulated without doubts about limits: what it refuses is what the profile prints. */
async function requestsFor(profile: ProfileId, items: readonly string[], code: 'binary' | 'ascii' = 'binary') {
  let sent: CommandName[] = []
  await withLine(`tcp 3E ${code} ${profile}`, { client: { gap: 0 } }, async ({ plc, client }) => {
    await client.connect()
    plc.on('request', ({ command }) => {
      if (command !== undefined) sent = [...sent, command]
    })
    const results = await client.read(items)
    expect(results.filter(({ ok }) => !ok)).toEqual([])
    expect(plc.errors.led).toBe(false)
  })
  return sent
}

describe('fx5-enet', () => {
  test.each([
    ['binary', 123, 1],
    ['binary', 124, 2],
    ['ascii', 96, 1],
    ['ascii', 97, 2],
  ] as const)('%s: %i scattered words are read by %i requests, and none is refused', async (code, count, requests) => {
    const sent = await requestsFor('fx5-enet', words(count), code)
    expect(sent.filter((name) => READS.includes(name))).toHaveLength(requests)
  })

  test.each([
    ['binary', 949],
    ['ascii', 480],
  ] as const)('%s: writes %i words at once, and more in parts, without a refusal', (code, max) =>
    withLine(`tcp 3E ${code} fx5-enet`, {}, async ({ plc, client }) => {
      const value = Array.from({ length: 2 * max + 1 }, (_, n) => n)
      await client.write(`D0[${value.length}]`, value)
      const last = value.length - 1
      expect([plc.read('D0'), plc.read(`D${max}`), plc.read(`D${last}`)]).toEqual([0, max, last])
      expect(plc.errors.led).toBe(false)
    }),
  )

  test('what is over a limit is not sent; sent past the checks it gets the end code', () =>
    withLine('tcp 3E binary fx5-enet', {}, async ({ plc, client, another }) => {
      const { requests } = plc.statistics
      const message = {
        words: words(124).map((_, number) => ({ device: { device: 'D', number } as const })),
        doubleWords: [],
      }
      expect(await failureOf(client.request(commands.readRandom, message))).toMatchObject({
        code: 'LIMIT_EXCEEDED',
        outcome: 'notSent',
      })
      expect(plc.statistics.requests).toBe(requests)
      const asCpu = another({ profile: 'iq-f' })
      const refused = (await failureOf(asCpu.request(commands.readRandom, message))) as EndCodeError
      expect(refused.endCode).toBe(0xc054)
      const written = { head: { device: 'D', number: 0 } as const, values: new Array<number>(950).fill(1) }
      expect(((await failureOf(asCpu.request(commands.writeWords, written))) as EndCodeError).endCode).toBe(0xc052)
    }))

  test.each(['clearError', 'unlock', 'entryMonitorDevice', 'readMemory', 'readRandomLabels'] as const)(
    'has no %s: refused before it is sent',
    (name) =>
      withLine('tcp 3E binary fx5-enet', {}, async ({ plc, client }) => {
        const messages = {
          clearError: () => client.request(commands.clearError, {}),
          unlock: () => client.request(commands.unlock, { password: 'secret' }),
          entryMonitorDevice: () => client.request(commands.entryMonitorDevice, { words: [], doubleWords: [] }),
          readMemory: () => client.request(commands.readMemory, { address: 0, points: 1 }),
          readRandomLabels: () =>
            client.request(commands.readRandomLabels, { abbreviations: [], labels: [{ name: 'a' }] }),
        }
        await client.connect()
        const { requests } = plc.statistics
        expect(await failureOf(messages[name]())).toMatchObject({ code: 'UNSUPPORTED', outcome: 'notSent' })
        expect(plc.statistics.requests).toBe(requests)
      }),
  )

  test('is modified by Z24, which a CPU module is not, and says who its CPU is', () =>
    withLine('tcp 3E binary fx5-enet', {}, async ({ client, another }) => {
      expect(await client.read(['D0Z24', 'D0Z23'])).toMatchObject([
        { error: { code: 'END_CODE' } },
        { error: { code: 'END_CODE' } },
      ])
      const cpu = another({ profile: 'iq-f' })
      expect(await failureOf(cpu.read('D0Z23'))).toMatchObject({ code: 'END_CODE' })
      expect(await failureOf(cpu.read('D0Z24'))).toMatchObject({ code: 'OUT_OF_RANGE', outcome: 'notSent' })
      expect(await client.identify()).toMatchObject({ modelCode: 0x4a21, series: 'iQ-F', profile: 'fx5-enet' })
      expect(await another({ profile: 'generic' }).identify()).toMatchObject({ profile: 'iq-f' })
    }))

  test('1E reaches it, too', () =>
    withLine('tcp 1E binary fx5-enet', {}, async ({ plc, client }) => {
      plc.write('D5', 7)
      expect(await client.read('D5')).toBe(7)
    }))

  // FX5 communication manual 39.2, notes on command 03H.
  test('in 1E frames it reads counters of 32 bits and does not write them', () =>
    withLine('tcp 1E binary fx5-enet', {}, async ({ plc, client }) => {
      plc.write('LCN3', 70_000)
      expect(await client.read('LCN3')).toBe(70_000)
      const before = plc.statistics.requests
      expect(await failureOf(client.write('LCN3', 5))).toMatchObject({ code: 'UNSUPPORTED', outcome: 'notSent' })
      expect(plc.statistics.requests).toBe(before)
      expect(plc.read('LCN3')).toBe(70_000)
    }))
})

describe('MELSEC-Q', () => {
  test.each([
    ['q', 96, 1],
    ['q', 97, 2],
    // Read Block takes 120 blocks, whatever device it is.
    ['q-e71', 97, 1],
    ['q-e71', 121, 2],
    ['q-built-in', 192, 1],
    ['q-built-in', 193, 2],
    ['l', 192, 1],
  ] as const)('%s: %i scattered ZR are read by %i requests', async (profile, count, requests) => {
    const sent = await requestsFor(profile, words(count, 100, 'ZR'))
    expect(sent.filter((name) => READS.includes(name))).toHaveLength(requests)
  })

  test('a monitor of too many ZR is refused before it is sent', () =>
    withLine('tcp 3E binary q-e71', {}, async ({ plc, client }) => {
      const message = words(97).map((_, number) => ({ device: { device: 'ZR', number } as const }))
      expect(
        await failureOf(client.request(commands.entryMonitorDevice, { words: message, doubleWords: [] })),
      ).toMatchObject({ code: 'LIMIT_EXCEEDED' })
      expect(plc.statistics.requests).toBe(0)
    }))

  test('bits of words of ZR are written within the limits of reading them first', () =>
    withLine('tcp 3E binary q', {}, async ({ plc, client }) => {
      const entries = words(100, 100, 'ZR').map((word) => ({ item: `${word}.3`, value: true }))
      const results = await client.writeEach(entries, { readModifyWrite: true })
      expect(results.flatMap((result) => (result.ok ? [] : [result.error.message]))).toEqual([])
      expect([plc.read('ZR0'), plc.read('ZR9900'), plc.errors.led]).toEqual([8, 8, false])
    }))

  test('a built-in port: connects without Read Type Name, reads, and is not asked for what it lacks', () =>
    withLine('tcp 3E binary q-built-in', {}, async ({ plc, client }) => {
      const asked: unknown[] = []
      plc.on('request', ({ command }) => asked.push(command))
      await client.connect()
      expect(await client.readValues(['D0', 'M0', 'W5'])).toEqual([0, false, 0])
      expect(await failureOf(client.identify())).toMatchObject({ code: 'UNSUPPORTED', outcome: 'notSent' })
      expect(await failureOf(client.read('U3\\G0'))).toMatchObject({ code: 'UNSUPPORTED', outcome: 'notSent' })
      expect(asked).not.toContain('readTypeName')
      expect(asked).not.toContain('readBlock')
      expect(plc.errors.led).toBe(false)
    }))
})

describe.each(['remote-head', 'nz2gf-etb'] as const)('%s', (profile) => {
  test('reads and writes, and says who it is', () =>
    withLine(`tcp 4E binary ${profile}`, {}, async ({ client }) => {
      await client.write('D0', 5)
      expect(await client.readValues(['D0', 'X0', 'W0'])).toEqual([5, false, 0])
      expect(await client.identify()).toMatchObject({ profile })
    }))

  test('what the damaged table leaves open is sent when asked for', () =>
    withLine(`tcp 4E binary ${profile}`, {}, async ({ plc, client }) => {
      await client.control.pause()
      expect(plc.cpu.state).toBe('PAUSE')
    }))
})
