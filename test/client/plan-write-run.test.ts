import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { type ParsedItem, parseItem } from '../../src/client/item/item'
import type { PlainValue } from '../../src/client/item/item-value'
import { planWrite } from '../../src/client/plan/write'
import { ClosedError, EndCodeError, ProtocolError, TimeoutError } from '../../src/errors'
import { jwCommands } from '../../src/jw/commands/commands'
import { resultFacts } from '../../src/jw/result-codes/facts'
import type { PlcValue } from '../../src/value/value'
import { expectedValue } from './plan-arbitrary'
import { PlanPlc, protocolOf } from './plan-plc'
import { bench, codes, type Entries, errorOf, RMW } from './plan-write-bench'

const DEVICE_NUMBER = 0x4031
const LOCKED = 0xc201

describe('what is written', () => {
  test('is what is read back, whatever the plan', async () => {
    const text = fc.oneof(
      fc
        .tuple(
          fc.constantFrom('D', 'W', 'R', 'U3\\G', 'J1\\W'),
          fc.nat(99),
          fc.constantFrom('', ':REAL', ':LINT', ':STRING(5)', ':INT[7]', '.3', '.0[20]'),
        )
        .map((parts) => parts.join('')),
      fc
        .tuple(fc.constantFrom('M', 'X', 'TS', 'LTS', 'LCC'), fc.nat(9), fc.constantFrom('', '[5]'))
        .map((parts) => parts.join('')),
      fc
        .tuple(fc.constantFrom('K4M', 'K3L', 'K8B'), fc.nat(9), fc.constantFrom('0', '6'))
        .map((parts) => parts.join('')),
      fc
        .tuple(fc.constantFrom('LTN', 'LCN', 'LZ'), fc.nat(9), fc.constantFrom('', '[3]'))
        .map((parts) => parts.join('')),
      fc.constantFrom('D300Z1', 'M300Z2', '@D350:REAL', 'D310Z1.7', '@D352.A'),
    )
    const given = fc.uniqueArray(fc.tuple(text, fc.nat(255)), {
      minLength: 1,
      maxLength: 30,
      selector: ([item]) => item,
    })
    await fc.assert(
      fc.asyncProperty(given, fc.constantFrom('binary' as const, 'ascii' as const), async (chosen, code) => {
        const protocol = protocolOf('iq-r', code)
        const plc = new PlanPlc(protocol)
        const parsed = chosen.map(([item]) => parseItem(item, { xyRadix: 16 }))
        const entries = parsed.map((item, i) => ({ item, value: valueFor(item, chosen[i]?.[1] ?? 0) }))
        const before = new PlanPlc(protocol)
        const plan = planWrite(entries, protocol, RMW)
        const results = await plan.run(plc.send)
        const written = parsed.filter((_, i) => results[i]?.ok)
        // Nothing but overlaps was refused.
        expect(results.every((result) => result.ok || result.error.code === 'BAD_VALUE')).toBe(true)
        for (const [i, item] of parsed.entries()) {
          if (results[i]?.ok !== true || writesElsewhere(item, written)) continue
          expect(expectedValue(plc, item)).toEqual(entries[i]?.value)
        }
        // Neighbours keep their values.
        expect(plc.word({ device: 'D', number: 150 })).toBe(before.word({ device: 'D', number: 150 }))
        expect(plc.bit({ device: 'M', number: 200 })).toBe(before.bit({ device: 'M', number: 200 }))
        expect(plan.describe().requests).toHaveLength(plc.seen.length)
      }),
      { numRuns: 120 },
    )
  })

  test.each<[string, PlainValue]>([
    ['D300Z1', -5],
    ['D300Z1:LREAL', 2.5],
    ['D300Z1[5]', [1, 2, 3, 4, 5]],
    ['D300Z1.3', true],
    ['D300Z1.A[40]', Array.from({ length: 40 }, (_, i) => i % 3 === 0)],
    ['M300Z2[9]', Array.from({ length: 9 }, (_, i) => i % 2 === 0)],
    ['K4M304Z2', 0x1234],
    ['LCN3Z1', 7],
    ['@D350:REAL', 1.5],
    ['@D352.A', true],
    ['J1Z0\\W5:DINT', 100000],
  ])('through index registers and @: %s', async (text, written) => {
    const { run, value } = bench([[text, written]], RMW)
    expect(codes(await run())).toEqual(['ok'])
    expect(value(text)).toEqual(written)
  })

  test('with bits of indexed words: the other bits of each word stay', async () => {
    const { run, value } = bench([['D300Z1.A[40]', new Array(40).fill(true)]], RMW)
    const [first = 0, , , last = 0] = value('D300Z1:WORD[4]') as number[]
    await run()
    expect(value('D300Z1:WORD[4]')).toEqual([first | 0xfc00, 0xffff, 0xffff, last | 0x0003])
  })

  test('with bits of words: the other bits stay, and one read and one write do for neighbours', async () => {
    const { run, plc, value, plan } = bench(
      [
        ['D5.0', true],
        ['D5.F', true],
        ['D5.3', false],
      ],
      RMW,
    )
    plc.setWord('D5', 0x00fe)
    expect(codes(await run())).toEqual(['ok', 'ok', 'ok'])
    expect(value('D5:WORD')).toBe(0x80f7)
    expect(plc.names).toEqual(['readWords', 'writeWords'])
    expect(plan.describe().requests.map(({ command }) => command)).toEqual(['readWords', 'writeWords'])
    expect(plan.describe().notes[0]).toContain('what the PLC program changes in it in between is lost')
  })

  test('with bits of scattered words: one Read Random and one Write Random', async () => {
    const { run, plc, value } = bench(
      [
        ['D5.0', true],
        ['D9.1', true],
        ['W0.2', true],
      ],
      RMW,
    )
    for (const device of ['D5', 'D9', 'W0']) plc.setWord(device, 0)
    expect(codes(await run())).toEqual(['ok', 'ok', 'ok'])
    expect([value('D5'), value('D9'), value('W0')]).toEqual([1, 2, 4])
    expect(plc.names).toEqual(['readRandom', 'writeRandomWords'])
  })

  test('is read just before, so that a change since the last run is not undone', async () => {
    const { run, plc, value } = bench([['D5.0', true]], RMW)
    plc.setWord('D5', 0)
    await run()
    plc.setWord('D5', 0x4000)
    await run()
    expect(value('D5')).toBe(0x4001)
  })
})

/** A value that fits the item, made from a number. */
function valueFor({ type, count, digits }: ParsedItem, seed: number): PlainValue {
  const one = (n: number): PlcValue => {
    if (type.name === 'BOOL') return n % 2 === 1
    if (type.name === 'STRING') return `a${n}`
    if (type.name === 'LINT') return BigInt(n) * -123456789012n
    if (digits === 3) return n
    return type.name === 'REAL' ? n / 4 : n * 99
  }
  return count === undefined ? one(seed) : Array.from({ length: count }, (_, i) => one(seed + i))
}

/** Whether another written item may have changed this one: index registers and `@` reach devices by other names. */
function writesElsewhere({ address }: ParsedItem, written: readonly ParsedItem[]): boolean {
  const modified = written.some((other) => other.address.index !== undefined || other.address.indirect === true)
  return (
    modified && (address.index !== undefined || address.indirect === true || ['D', 'M', 'R'].includes(address.device))
  )
}

describe('a refused merged write', () => {
  const entries: Entries = [
    ['D0', 10],
    ['D1', 11],
    ['D2', 12],
  ]

  test('is written one by one, in order, because it was not carried out', async () => {
    const { run, plc, value } = bench(entries)
    plc.refuse = (device) => (device === 'D1' ? DEVICE_NUMBER : 0)
    expect(codes(await run())).toEqual(['ok', DEVICE_NUMBER, 'ok'])
    expect([value('D0'), value('D2')]).toEqual([10, 12])
    expect(plc.names).toHaveLength(4)
    const heads = plc.seen.map(({ message }) => message.head)
    expect(heads).toEqual([0, 0, 1, 2].map((number) => ({ device: 'D', number })))
  })

  test('for a reason that is about no device is not tried again', async () => {
    const { run, plc } = bench(entries)
    plc.refuse = () => LOCKED
    const results = await run()
    expect(codes(results)).toEqual([LOCKED, LOCKED, LOCKED])
    // None of the items is to blame, so none is named.
    expect(errorOf(results[0]).message).toMatch(/^Write \(word units\) was refused/)
    expect(plc.seen).toHaveLength(1)
  })

  test('with an end code nobody knows is not tried again', async () => {
    const { run, plc } = bench(entries)
    plc.refuse = () => 0x7777
    expect(codes(await run())).toEqual([0x7777, 0x7777, 0x7777])
    expect(plc.seen).toHaveLength(1)
  })

  test('with an end code nobody knows ends the write: whether it was carried out nobody knows', async () => {
    const { run, plc } = bench([...entries, ['M0', true]])
    plc.refuse = () => 0x7777
    const results = await run()
    expect(codes(results)).toEqual([0x7777, 0x7777, 0x7777, 'ABORTED notSent'])
    expect(errorOf(results[0]).outcome).toBe('unknown')
    expect(plc.seen).toHaveLength(1)
  })

  test.each([0xc1a2, 0xc05e, 0x4042])(
    'that may have been carried out is not written again, nor is anything behind it: %i',
    async (endCode) => {
      const { run, plc } = bench([...entries, ['M0', true]])
      plc.refuse = () => endCode
      const results = await run()
      expect(codes(results)).toEqual([endCode, endCode, endCode, 'ABORTED notSent'])
      expect(errorOf(results[0]).outcome).toBe('unknown')
      expect(plc.seen).toHaveLength(1)
    },
  )

  // In MELSEC these numbers are about a device; of a JW only 02H and 11H are, and how far it wrote before it does not say.
  test.each([0x02, 0x06, 0x11, 0x12])('is not written again for what a JW means by %i', async (endCode) => {
    const { run } = bench(entries)
    const refusal = new EndCodeError(endCode, 'refused', {
      family: 'jw',
      ...resultFacts.refusal(jwCommands.writeDataMemory, endCode),
    })
    let sent = 0
    const send = (): Promise<never> => {
      sent++
      return Promise.reject(refusal)
    }
    expect(codes(await run(send))).toEqual([endCode, endCode, endCode])
    expect(sent).toBe(1)
  })

  test('does not keep the next request from being sent', async () => {
    const { run, plc } = bench([...entries, ['M0', true]])
    plc.refuse = (device) => (device.startsWith('D') ? LOCKED : 0)
    expect(codes(await run())).toEqual([LOCKED, LOCKED, LOCKED, 'ok'])
  })

  test('all or nothing: it is not written one by one, and nothing more is sent', async () => {
    const { run, plc } = bench([...entries, ['M0', true]], { allOrNothing: true })
    plc.refuse = (device) => (device === 'D1' ? DEVICE_NUMBER : 0)
    expect(codes(await run())).toEqual([DEVICE_NUMBER, DEVICE_NUMBER, DEVICE_NUMBER, 'ABORTED notSent'])
    expect(plc.seen).toHaveLength(1)
  })

  test('of bits of words is written one word after the other', async () => {
    const { run, plc, value } = bench(
      [
        ['D0.0', true],
        ['D9.0', true],
      ],
      RMW,
    )
    plc.setWord('D9', 0)
    plc.refuse = (device) => (device === 'D0' ? DEVICE_NUMBER : 0)
    expect(codes(await run())).toEqual([DEVICE_NUMBER, 'ok'])
    expect(value('D9')).toBe(1)
  })
})

describe('a write of unknown outcome', () => {
  const entries: Entries = [
    ['D0', 1],
    ['M0', true],
    ['D1', 2],
  ]

  test.each([
    new TimeoutError('no answer', 'unknown'),
    new TimeoutError('too late to send', 'notSent'),
    new ProtocolError('BAD_FRAME', 'rubbish'),
    new ClosedError('ABORTED', 'aborted', 'unknown'),
  ])('is never repeated, and nothing more is sent: %p', async (lost) => {
    const { run, plc } = bench(entries)
    let calls = 0
    const results = await run((exchange) => {
      calls++
      return calls === 2 ? Promise.reject(lost) : plc.send(exchange)
    })
    expect(calls).toBe(2)
    expect(results[0]).toEqual({ item: 'D0', ok: true })
    expect(errorOf(results[1])).toBe(lost)
    expect(errorOf(results[2])).toMatchObject({ code: 'ABORTED', outcome: 'notSent', cause: lost })
  })

  test('after a refusal, in the middle of writing one by one', async () => {
    const { run, plc } = bench([
      ['D0', 1],
      ['D1', 2],
      ['D2', 3],
    ])
    plc.refuse = (device) => (device === 'D2' ? DEVICE_NUMBER : 0)
    const lost = new TimeoutError('no answer', 'unknown')
    let calls = 0
    const results = await run((exchange) => {
      calls++
      return calls === 3 ? Promise.reject(lost) : plc.send(exchange)
    })
    expect(calls).toBe(3)
    expect(codes(results)).toEqual(['ok', 'TIMEOUT unknown', 'ABORTED notSent'])
  })

  test('does not happen when only the read before it failed: nothing was written', async () => {
    for (const lost of [
      new TimeoutError('no answer', 'unknown', ['cause']),
      new ProtocolError('BAD_FRAME', 'rubbish'),
      new ClosedError('CLOSED', 'closed', 'unknown'),
    ]) {
      const { run } = bench([['D0.0', true]], RMW)
      const [result] = await run(() => Promise.reject(lost))
      expect(errorOf(result).outcome).toBe('notSent')
      expect(errorOf(result).message).toContain('Nothing was written')
    }
  })

  test('of the write after the read it is', async () => {
    const { run, plc } = bench([['D0.0', true]], RMW)
    const lost = new TimeoutError('no answer', 'unknown')
    const [result] = await run((exchange) => (exchange.effect === 'write' ? Promise.reject(lost) : plc.send(exchange)))
    expect(errorOf(result)).toBe(lost)
  })

  test('in the middle of an array says how much was written', async () => {
    const { run, plc } = bench([['D0:INT[3000]', new Array(3000).fill(1)]])
    plc.refuse = (device) => (device === 'D2000' ? DEVICE_NUMBER : 0)
    const [result] = await run()
    expect(errorOf(result)).toMatchObject({ code: 'ABORTED', outcome: 'unknown' })
    expect(errorOf(result).message).toContain('the first 1920 values were written, the others not.')
    // The parts behind the refused one are not sent.
    expect(plc.seen).toHaveLength(3)
  })

  test('in the middle of an array says that nobody knows of more, when nobody does', async () => {
    const { run, plc } = bench([['D0:INT[3000]', new Array(3000).fill(1)]])
    let sent = 0
    const lost = new TimeoutError('no answer', 'unknown')
    const [result] = await run((exchange) => (sent++ < 2 ? plc.send(exchange) : Promise.reject(lost)))
    expect(errorOf(result)).toMatchObject({ code: 'ABORTED', outcome: 'unknown', cause: lost })
    expect(errorOf(result).message).toContain('the first 1920 values were written; whether more were is not known.')
  })

  test('at the start of an array: nothing of it was written', async () => {
    const { run, plc } = bench([
      ['D0:INT[3000]', new Array(3000).fill(1)],
      ['M0', true],
    ])
    plc.refuse = (device) => (device === 'D5' ? DEVICE_NUMBER : 0)
    expect(codes(await run())).toEqual([DEVICE_NUMBER, 'ok'])
    expect(plc.names).toEqual(['writeWords', 'writeBits'])
  })
})

test('requests are sent one after another', async () => {
  const { run, plc } = bench([
    ['D0', 1],
    ['M0', true],
    ['D9', 1],
  ])
  let waiting = 0
  await run(async (exchange) => {
    expect(++waiting).toBe(1)
    const answer = await plc.send(exchange)
    waiting--
    return answer
  })
})

test('what is no PlcError is a bug and comes out', async () => {
  await expect(bench([['D0', 1]]).run(() => Promise.reject(new TypeError('bug')))).rejects.toThrow('bug')
})

test('a plan can be run again', async () => {
  const { run, plc } = bench([['D0', 1]])
  expect(codes([...(await run()), ...(await run())])).toEqual(['ok', 'ok'])
  expect(plc.seen).toHaveLength(2)
})
