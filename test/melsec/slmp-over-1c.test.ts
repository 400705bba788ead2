/** The SLMP command set said in 1C frames: what the planner makes of it stays within what 1C takes. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { parseItem } from '../../src/client/item/item'
import { planRead } from '../../src/client/plan/read'
import { planWrite } from '../../src/client/plan/write'
import { RequestError } from '../../src/errors'
import { pointLimit } from '../../src/melsec/a-compatible/device-rules'
import { fx5Windows } from '../../src/melsec/a-compatible/windows'
import { commands } from '../../src/melsec/commands/commands'
import { type DeviceName, deviceInfo } from '../../src/melsec/device/device'
import { isOneC, oneCCommands } from '../../src/melsec/one-c/commands'
import { oneCRules } from '../../src/melsec/one-c/rules'
import { protocolOver1c } from '../../src/melsec/one-c/slmp-over-1c'
import { profiles } from '../../src/melsec/profiles/profiles'
import { RMW } from '../client/plan-write-bench'
import { framing1c, HEAD_1C, Plc1c } from './one-c-support'

function over1c(id: 'fx5-serial' | 'fx3-serial' = 'fx5-serial', asciiXy?: 'octal' | 'hexadecimal') {
  return protocolOver1c({
    profile: profiles[id],
    framing: framing1c(),
    head: HEAD_1C,
    asciiXy: asciiXy ?? 'octal',
  })
}

const at = (device: DeviceName, number: number) => ({ device, number })
const item = (text: string) => parseItem(text, { xyRadix: 8 })

function refused(run: () => unknown): RequestError {
  try {
    run()
  } catch (error) {
    if (error instanceof RequestError) return error
    throw error
  }
  throw new Error('it was not refused')
}

/** Names of the requests, and whether each is within the limits of its command. */
function expectWithinLimits(plc: Plc1c): void {
  for (const { name, message } of plc.seen) {
    if (!isOneC(name)) throw new Error(name)
    const list = message.bits ?? message.words
    const first = (Array.isArray(list) ? list[0]?.device : message.head) as { device: DeviceName; number: number }
    const count = Number(message.points ?? (Array.isArray(list) ? list : (message.values as unknown[])).length)
    expect(count).toBeLessThanOrEqual(pointLimit(oneCRules, name, first.device) ?? 0)
    const isBit = deviceInfo(first.device).unit === 'bit'
    if (!oneCRules.bitUnits.includes(name) && isBit) expect(first.number % 8).toBe(0)
  }
}

describe('a plan', () => {
  test('is made of what 1C takes, with the fewest characters', async () => {
    const protocol = over1c()
    const plc = new Plc1c(protocol.own)
    for (let i = 0; i < 200; i++) plc.setWord(at('D', i), i)
    plc.setWord(at('R', 20_000), 77)
    plc.setBit(at('M', 8000), true)
    plc.setBit(at('CS', 203), true)
    const texts = ['D0[200]', 'R20000', 'SM8000', 'LCS3', 'M0[300]']
    const results = await planRead(texts.map(item), protocol, { gap: 64 }).run(plc.send, () => 0)
    expect(results.map((result) => (result.ok ? result.value : result.error.message))).toEqual([
      Array.from({ length: 200 }, (_, i) => i),
      77,
      true,
      true,
      new Array(300).fill(false),
    ])
    expectWithinLimits(plc)
    const names = plc.seen.map(({ name }) => name).sort()
    // 200 words of D in four requests of 64, R20000 with six digits, M0 to M299 in one of 19 words, single bits as such.
    expect(names).toEqual(['BR', 'BR', 'QR', 'WR', 'WR', 'WR', 'WR', 'WR'])
  })

  test('reads what was written, whatever the plan, and no request is too long', async () => {
    const text = fc.oneof(
      fc.tuple(fc.constantFrom('D', 'R', 'TN'), fc.nat(300), fc.constantFrom('', ':DINT', '[5]', ':STRING(5)', '.3')),
      fc.tuple(fc.constantFrom('R', 'SD800'), fc.nat(9), fc.constantFrom('', '[3]')),
      fc.tuple(fc.constantFrom('R999', 'R3000'), fc.nat(9), fc.constantFrom('', '[4]')),
      fc.tuple(fc.constantFrom('M', 'S', 'TS', 'CS', 'LCS'), fc.nat(40), fc.constantFrom('', '[12]')),
      fc.tuple(fc.constantFrom('X', 'Y'), fc.constantFrom(0, 7, 10, 17, 20, 100), fc.constantFrom('', '[9]')),
      fc.tuple(fc.constantFrom('K4M', 'K2Y', 'K8S'), fc.constantFrom(0, 10, 20), fc.constant('')),
    )
    const given = fc.uniqueArray(
      text.map((parts) => parts.join('')),
      { minLength: 1, maxLength: 40 },
    )
    await fc.assert(
      fc.asyncProperty(given, fc.nat(0xff), async (texts, seed) => {
        const protocol = over1c()
        const plc = new Plc1c(protocol.own)
        const parsed = texts.map(item)
        const before = await planRead(parsed, protocol, { gap: 64 }).run(plc.send, () => 0)
        expectWithinLimits(plc)
        expect(before.every(({ ok }) => ok)).toBe(true)
        // One item each, so that no write covers another.
        for (const [i, one] of parsed.entries()) {
          const old = before[i]
          if (old?.ok !== true) continue
          const value = changed(old.value, seed + i)
          const [written] = await planWrite([{ item: one, value }], protocol, RMW).run(plc.send)
          if (written?.ok !== true) continue
          const [read] = await planRead([one], protocol, { gap: 0 }).run(plc.send, () => 0)
          expect(read).toMatchObject({ ok: true, value })
        }
        expectWithinLimits(plc)
      }),
      { numRuns: 60 },
    )
  })

  test('sets bits of the same word and of the next together, as there is no random read', async () => {
    const protocol = over1c()
    const plc = new Plc1c(protocol.own)
    plc.setWord(at('D', 0), 0x8000)
    plc.setWord(at('D', 1), 0xffff)
    const bits = ['D0.1', 'D0.2', 'D1.3', 'D0.F', 'D5.1'].map((text) => ({ item: item(text), value: text !== 'D1.3' }))
    const results = await planWrite(bits, protocol, RMW).run(plc.send)
    expect(results.every(({ ok }) => ok)).toBe(true)
    expect(plc.seen.map(({ name }) => name)).toEqual(['WR', 'WW', 'WR', 'WW'])
    expect([0, 1, 5].map((number) => plc.word(at('D', number)))).toEqual([0x8006, 0xfff7, 0x0002])
  })

  test('refuses before anything is sent what 1C does not say', async () => {
    const protocol = over1c()
    for (const [text, reason] of [
      ['LCN0', 'in which order its two words stand'],
      ['W0', 'has no device W'],
      ['SM0', 'SM0'],
      ['D8000', 'SD8000'],
      ['M7680', 'M7680'],
      ['U1\\G0', 'buffer memory'],
    ] as const) {
      const plc = new Plc1c(protocol.own)
      const [result] = await planRead([item(text)], protocol, { gap: 0 }).run(plc.send, () => 0)
      const message = result?.ok === false ? result.error.message : 'nothing'
      expect([text, message]).toEqual([text, expect.stringContaining(reason)])
      expect(plc.seen).toEqual([])
    }
  })
})

function changed(value: unknown, seed: number): never {
  if (Array.isArray(value)) return value.map((one, i) => changed(one, seed + i)) as never
  if (typeof value === 'boolean') return (seed % 2 === 0) as never
  return (typeof value === 'number' ? seed : `t${seed % 10}`) as never
}

describe('requests', () => {
  test('are said by the command of 1C with the fewest characters', () => {
    const body = (run: () => { readonly body: Buffer }) => run().body.toString('latin1')
    const mc = over1c()
    expect(body(() => mc.exchange(commands.readWords, { head: at('R', 9999), points: 1 }))).toBe('WR0R999901')
    expect(body(() => mc.exchange(commands.readWords, { head: at('R', 9999), points: 2 }))).toBe('QR0R00999902')
    expect(body(() => mc.exchange(commands.writeWords, { head: at('R', 10_000), values: [1] }))).toBe(
      'QW0R010000010001',
    )
    const words = [
      { device: at('D', 0), value: 1 },
      { device: at('R', 10_000), value: 2 },
    ]
    expect(body(() => mc.exchange(commands.writeRandomWords, { words, doubleWords: [] }))).toBe(
      'QT002D0000000001R0100000002',
    )
    const doubleWords = [{ device: at('D', 0), value: 0x12345678 }]
    expect(body(() => mc.exchange(commands.writeRandomWords, { words: [], doubleWords }))).toBe(
      'WT002D00005678D00011234',
    )
    expect(body(() => mc.exchange(commands.remoteRun, { mode: 1 }))).toBe('RR0')
    expect(body(() => mc.exchange(commands.selfTest, { data: 'ABCDE' }))).toBe('TT005ABCDE')
    expect(refused(() => mc.exchange(commands.readWords, { head: at('R', 10_000), points: 65 })).message).toContain(
      'at most 64',
    )
  })

  test('that 1C does not have are refused', () => {
    const mc = over1c()
    for (const run of [
      () => mc.exchange(commands.readRandom, { words: [], doubleWords: [] }),
      () => mc.exchange(commands.remotePause, { mode: 1 }),
      () => mc.exchange(commands.remoteRun, { mode: 3 }),
      () => mc.exchange(commands.readBits, { head: at('M', 0), points: 1 }, { form: 'long' }),
    ]) {
      expect(refused(run).code).toBe('UNSUPPORTED')
    }
  })

  test('of the type name read the code alone; the global signal is reached by its own command', async () => {
    const mc = over1c()
    const plc = new Plc1c(mc.own)
    expect(await plc.send(mc.exchange(commands.readTypeName, {}))).toEqual({ model: ' '.repeat(16), modelCode: 0xf3 })
    expect(await plc.send(mc.own.exchange(oneCCommands.GW, { on: true }))).toEqual({})
    expect(plc.seen.map(({ name }) => name)).toEqual(['PC', 'GW'])
  })

  test('are measured as they are sent and answered', () => {
    const mc = over1c()
    const message = { head: at('D', 0), points: 3 }
    expect(mc.bodyBytes(commands.readWords, message)).toBe('WR0D000003'.length + 12)
    // STX, station, PC number, ETX and sum check code stand around it.
    expect(mc.answerBytes(12)).toBe(12 + 1 + 4 + 1 + 2)
  })
})

describe('a trace', () => {
  test.each(['octal', 'hexadecimal'] as const)('puts frames into words, with X and Y in %s digits', (asciiXy) => {
    const mc = over1c('fx5-serial', asciiXy)
    const explainer = mc.explainer({})
    const sent = mc.exchange(commands.readBits, { head: at('Y', 0o100), points: 2 }).write(0)
    expect(sent.toString('latin1')).toContain(asciiXy === 'octal' ? 'Y0100' : 'Y0040')
    expect(explainer.explain(sent, {}).title).toContain('Y100, 2 points')
    const answer = mc.framing.response.write(HEAD_1C, 0, 0, Buffer.from('10'))
    expect(explainer.received(answer, sent)).toMatchObject({ used: answer.length })
    expect(explainer.received(answer.subarray(0, -1), sent)).toBeUndefined()
    expect(
      explainer
        .explain(answer, { request: sent })
        .rows.map(({ text }) => text)
        .join(' '),
    ).toContain('Y100')
  })
})

describe('FX3', () => {
  test('calls special relays M8000 too, and X and Y are octal always', () => {
    const fx3 = protocolOver1c({
      profile: profiles['fx3-serial'],
      framing: framing1c(),
      head: HEAD_1C,
    })
    const body = (device: DeviceName, number: number) =>
      fx3.exchange(commands.readBits, { head: at(device, number), points: 1 }).body.toString('latin1')
    expect(body('M', 8000)).toBe('BR0M800001')
    expect(body('SM', 8000)).toBe('BR0M800001')
    expect(body('X', 0o377)).toBe('BR0X037701')
    expect(refused(() => over1c('fx3-serial', 'hexadecimal'))).toMatchObject({ code: 'BAD_OPTION', field: 'asciiXy' })
  })
})

test('every device of the windows has a name in the frame that 1C can write', () => {
  for (const { as } of fx5Windows) expect(['X', 'Y', 'M', 'S', 'TS', 'TN', 'CS', 'CN', 'D', 'R']).toContain(as)
})
