import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import type { ParsedItem } from '../../src/client/item/item'
import type { ReadResult } from '../../src/client/item/item-value'
import { type DeviceRead, planRead } from '../../src/client/plan/read'
import type { SendExchange } from '../../src/client/plan/request'
import { ConnectionError, EndCodeError, TimeoutError } from '../../src/errors'
import { jwCommands } from '../../src/jw/commands/commands'
import { resultFacts } from '../../src/jw/result-codes/facts'
import { expectedValue, itemText, modifiedText } from './plan-arbitrary'
import { goodValue, items, PlanPlc, protocolOf } from './plan-plc'

const DEVICE_NUMBER = 0x4031
const NOT_SUPPORTED = 0xc059
/** Remote password not unlocked: about no device. */
const LOCKED = 0xc201

interface Bench {
  readonly plc: PlanPlc
  readonly plan: DeviceRead
  run(send?: SendExchange): Promise<ReadResult[]>
  /** Requests since the last call. */
  requests(): number
}

function bench(texts: readonly string[], gap = 64, profile: 'iq-r' | 'iq-f' | 'q' = 'iq-r'): Bench {
  const protocol = protocolOf(profile)
  const plc = new PlanPlc(protocol)
  const plan = planRead(items(protocol, texts), protocol, { gap })
  let counted = 0
  return {
    plc,
    plan,
    run: (send = plc.send) => plan.run(send, () => 1000),
    requests: () => {
      const since = plc.seen.length - counted
      counted = plc.seen.length
      return since
    },
  }
}

function range(count: number, text: (i: number) => string): string[] {
  return Array.from({ length: count }, (_, i) => text(i))
}

function codes(results: readonly ReadResult[]): (string | number)[] {
  return results.map((result) => {
    if (result.ok) return 'ok'
    return result.error instanceof EndCodeError ? result.error.endCode : result.error.code
  })
}

describe('values', () => {
  test('are those of the devices, whatever the plan', async () => {
    const texts = fc.array(fc.oneof(itemText, itemText, modifiedText), { minLength: 1, maxLength: 40 })
    await fc.assert(
      fc.asyncProperty(
        texts,
        fc.nat(100),
        fc.constantFrom('binary' as const, 'ascii' as const),
        async (given, gap, code) => {
          const protocol = protocolOf('iq-r', code)
          const plc = new PlanPlc(protocol)
          const parsed = items(protocol, given).filter((item): item is ParsedItem => !('error' in item))
          expect(parsed).toHaveLength(given.length)
          const plan = planRead(parsed, protocol, { gap })
          const results = await plan.run(plc.send, () => 5)
          expect(results.map(goodValue)).toEqual(parsed.map((item) => expectedValue(plc, item)))
          expect(results.every(({ timestamp }) => timestamp === 5)).toBe(true)
          // Never more requests than the items alone, and the same ones again the next time.
          const requests = plc.seen.length
          const apart = parsed.map((item) => planRead([item], protocol, { gap }).describe().requests.length)
          expect(requests).toBeLessThanOrEqual(apart.reduce((sum, one) => sum + one))
          expect(requests).toBe(plan.describe().requests.length)
          await plan.run(plc.send, () => 6)
          expect(plc.seen.slice(requests).map(({ message }) => message)).toEqual(
            plc.seen.slice(0, requests).map(({ message }) => message),
          )
        },
      ),
      { numRuns: 100 },
    )
  })

  test.each(['iq-f', 'q', 'l', 'generic'] as const)('are right on %s too', async (profile) => {
    const text = fc.constantFrom(
      'D5',
      'D6:REAL',
      'M3',
      'X7',
      'W1F',
      'TS5',
      'TN5',
      'CC1',
      'K3M5',
      'D0.3',
      'R500:LREAL',
      'U3\\G5',
    )
    await fc.assert(
      fc.asyncProperty(fc.array(text, { minLength: 1, maxLength: 12 }), async (given) => {
        const protocol = protocolOf(profile)
        const plc = new PlanPlc(protocol)
        const parsed = items(protocol, given).filter((item): item is ParsedItem => !('error' in item))
        const results = await planRead(parsed, protocol, { gap: 64 }).run(plc.send, () => 0)
        expect(results.map(goodValue)).toEqual(parsed.map((item) => expectedValue(plc, item)))
      }),
      { numRuns: 50 },
    )
  })

  test('come in the order of the items, also of the same item twice', async () => {
    const { run, plc } = bench(['D1', 'M1', 'D0', 'D1'])
    plc.setWord('D0', 10)
    plc.setWord('D1', 11)
    plc.setBit('M1', true)
    expect((await run()).map(goodValue)).toEqual([11, true, 10, 11])
  })

  test('of text, BCD, other word orders', async () => {
    const protocol = protocolOf('iq-r')
    const plc = new PlanPlc(protocol)
    for (const [i, word] of [0x3231, 0x4241, 0x1234, 0x0001, 0x0002].entries()) plc.setWord(`D${i}`, word)
    const parsed = items(protocol, ['D0:STRING(4)', 'D2:BCD16', 'D3:UDINT'])
    const swapped = { ...parsed[2], format: { wordOrder: 'high-first' } } as ParsedItem
    const results = await planRead([...parsed, swapped], protocol, { gap: 64 }).run(plc.send, () => 0)
    expect(results.map(goodValue)).toEqual(['12AB', 1234, 0x20001, 0x10002])
  })

  test('of an array larger than one request are marked as torn', async () => {
    const { run, plc } = bench(['D0:INT[1000]', 'D5'])
    const [array, single] = await run()
    expect(array).toMatchObject({ ok: true, torn: true })
    expect(goodValue(array)).toHaveLength(1000)
    expect((goodValue(array) as number[])[999]).toBe((plc.word({ device: 'D', number: 999 }) << 16) >> 16)
    expect(single).not.toHaveProperty('torn')
  })

  test('of an array of 960 words are not torn', async () => {
    const [result] = await bench(['D0:INT[960]']).run()
    expect(result).not.toHaveProperty('torn')
  })
})

describe('a refused item does not take the others down', () => {
  test('one of a hundred in a row', async () => {
    const { plc, run, requests, plan } = bench(range(100, (i) => `D${i}`))
    plc.refuse = (device) => (device === 'D37' ? DEVICE_NUMBER : 0)
    const expected = range(100, (i) => (i === 37 ? 'bad' : 'ok')).map((code) => (code === 'bad' ? DEVICE_NUMBER : code))
    expect(codes(await run())).toEqual(expected)
    // Halving: about twice the logarithm, not one request for each item.
    expect(requests()).toBeLessThanOrEqual(16)
    expect(codes(await run())).toEqual(expected)
    expect(requests()).toBeLessThanOrEqual(3)
    expect(plan.describe().notes).toEqual([expect.stringMatching(/^D37 is read apart from the others\. .*4031/)])
  })

  test('one of a hundred scattered ones', async () => {
    const { plc, run, requests } = bench(range(90, (i) => `D${100 * i}`))
    plc.refuse = (device) => (device === 'D4200' ? DEVICE_NUMBER : 0)
    expect(codes(await run()).filter((code) => code === 'ok')).toHaveLength(89)
    requests()
    expect(codes(await run())[42]).toBe(DEVICE_NUMBER)
    expect(requests()).toBe(2)
  })

  test('what lies between items and cannot be read is left out', async () => {
    const { plc, run, requests, plan } = bench(['D0', 'D50'])
    plc.refuse = (device) => (device === 'D25' ? DEVICE_NUMBER : 0)
    expect(codes(await run())).toEqual(['ok', 'ok'])
    expect(requests()).toBe(3)
    expect(codes(await run())).toEqual(['ok', 'ok'])
    expect(requests()).toBe(1)
    expect(plan.describe().requests.map(({ text }) => text)).toEqual(['Read Random: 2 words, 0 double words'])
  })

  test('a bit whose word ends behind the last device is read in bit units', async () => {
    const { plc, run, plan } = bench(['M8', 'D0'])
    plc.refuse = (device) => (device === 'M10' ? DEVICE_NUMBER : 0)
    plc.setBit('M8', true)
    expect((await run()).map((result) => (result.ok ? 'ok' : result.error.message))).toEqual(['ok', 'ok'])
    expect((await run()).map(goodValue)[0]).toBe(true)
    expect(plan.describe().requests.map(({ command }) => command)).toContain('readBits')
  })

  test('several bad ones are asked for together later, and found again when they can be read', async () => {
    const bad = ['D9000', 'D9001', 'D9002', 'D9003']
    const { plc, run, requests } = bench(['D0', ...bad])
    plc.refuse = (device) => (bad.includes(device) ? DEVICE_NUMBER : 0)
    expect(codes(await run())).toEqual(['ok', ...bad.map(() => DEVICE_NUMBER)])
    requests()
    for (let i = 0; i < 3; i++) expect(codes(await run())).toEqual(['ok', ...bad.map(() => DEVICE_NUMBER)])
    expect(requests()).toBe(6)
    plc.refuse = () => 0
    expect(codes(await run())).toEqual(['ok', 'ok', 'ok', 'ok', 'ok'])
  })

  test('of several bad ones, one that can be read again is found after a while', async () => {
    const bad = ['D9000', 'D9001', 'D9002', 'D9003']
    const { plc, run } = bench(['D0', ...bad])
    plc.refuse = (device) => (bad.includes(device) ? DEVICE_NUMBER : 0)
    await run()
    plc.refuse = (device) => (device === 'D9001' ? DEVICE_NUMBER : 0)
    let runs = 0
    while (codes(await run()).filter((code) => code === 'ok').length < 4 && runs < 100) runs++
    expect(runs).toBeLessThan(40)
    expect(codes(await run())).toEqual(['ok', 'ok', DEVICE_NUMBER, 'ok', 'ok'])
  })

  test('an extended address that is not there harms no ordinary one', async () => {
    const { plc, run, requests } = bench(['D0', 'U3\\G0', 'U3\\G1', 'U4\\G0'])
    plc.refuse = (device) => (device.startsWith('U3') ? 0x4043 : 0)
    expect(codes(await run())).toEqual(['ok', 0x4043, 0x4043, 'ok'])
    requests()
    expect(codes(await run())).toEqual(['ok', 0x4043, 0x4043, 'ok'])
    expect(requests()).toBe(3)
  })

  test('exactly those that touch a refused device, for any items and devices', async () => {
    const text = fc.oneof(
      fc
        .tuple(fc.constantFrom('D', 'R'), fc.nat(60), fc.constantFrom('', ':REAL', ':INT[5]', '.3'))
        .map((parts) => parts.join('')),
      fc.tuple(fc.constantFrom('M', 'L', 'K2M'), fc.nat(60), fc.constantFrom('', '[3]')).map((parts) => parts.join('')),
    )
    const refused = fc.uniqueArray(
      fc.tuple(fc.constantFrom('D', 'R', 'M', 'L'), fc.nat(70)).map((parts) => parts.join('')),
      { maxLength: 6 },
    )
    await fc.assert(
      fc.asyncProperty(fc.array(text, { minLength: 1, maxLength: 25 }), refused, async (given, bad) => {
        const protocol = protocolOf('q')
        const plc = new PlanPlc(protocol)
        const plan = planRead(items(protocol, given), protocol, { gap: 64 })
        const touched = await Promise.all(given.map((item) => touches(item, bad)))
        plc.refuse = (device) => (bad.includes(device) ? DEVICE_NUMBER : 0)
        for (let run = 0; run < 4; run++) {
          const found = codes(await plan.run(plc.send, () => 0))
          expect(found).toEqual(touched.map((touching) => (touching ? DEVICE_NUMBER : 'ok')))
        }
      }),
      { numRuns: 150 },
    )
  })
})

/** Whether reading exactly the devices of an item touches a refused one. */
async function touches(text: string, bad: readonly string[]): Promise<boolean> {
  const protocol = protocolOf('q')
  const [item] = items(protocol, [text])
  if (item === undefined || 'error' in item) throw new Error(text)
  const plc = new PlanPlc(protocol)
  const seen = new Set<string>()
  plc.word = ({ device, number }) => {
    seen.add(`${device}${number}`)
    return 0
  }
  plc.bit = ({ device, number }) => {
    seen.add(`${device}${number}`)
    return false
  }
  expectedValue(plc, item)
  return bad.some((device) => seen.has(device))
}

describe('a refused command', () => {
  test('is not used again, and the plan says so', async () => {
    const { plc, run, requests, plan } = bench(['D0', 'D1000', 'M0'])
    plc.refuse = (_, command) => (command === 'readRandom' ? NOT_SUPPORTED : 0)
    expect(codes(await run())).toEqual(['ok', 'ok', 'ok'])
    expect(requests()).toBeLessThanOrEqual(4)
    expect(codes(await run())).toEqual(['ok', 'ok', 'ok'])
    expect(plc.names.slice(-requests())).not.toContain('readRandom')
    expect(plan.describe().notes).toEqual([
      expect.stringMatching(/^Read Random is not used, because the PLC refused it/),
    ])
  })

  test('for what nothing else reads is that item’s error', async () => {
    const { plc, run } = bench(['D0', 'LZ1'])
    plc.refuse = (_, command) => (command === 'readRandom' ? NOT_SUPPORTED : 0)
    expect(codes(await run())).toEqual(['ok', NOT_SUPPORTED])
  })

  test('because it asks for too much is asked for in smaller ones', async () => {
    const { plc, run, requests } = bench(range(90, (i) => `D${100 * i}`))
    // A CPU that takes fewer points than the manual says.
    const most = 30
    const send: SendExchange = async (exchange) => {
      const { words } = exchange.message as { words?: readonly unknown[] }
      plc.refuse = () => ((words?.length ?? 0) > most ? 0xc054 : 0)
      return plc.send(exchange)
    }
    expect(new Set(codes(await run(send)))).toEqual(new Set(['ok']))
    await run(send)
    requests()
    expect(new Set(codes(await run(send)))).toEqual(new Set(['ok']))
    expect(requests()).toBe(4)
  })

  test('because the PLC is not ready does not lead to a storm of requests', async () => {
    const { plc, run, requests } = bench(range(200, (i) => `D${i}`))
    plc.refuse = () => LOCKED
    const found = codes(await run())
    expect(new Set(found)).toEqual(new Set([LOCKED]))
    expect(requests()).toBe(1)
    plc.refuse = () => 0
    expect(new Set(codes(await run()))).toEqual(new Set(['ok']))
    expect(requests()).toBe(1)
  })
})

describe('an error of another family', () => {
  // 06H and 12H are about a device in MELSEC; of a JW they say that the PLC is not stopped, and that the memory is a ROM.
  test.each([0x06, 0x12])('%i of a JW is not divided and not asked again', async (endCode) => {
    const { plan } = bench(range(16, (i) => `D${i * 1000}`))
    const { readDataMemory } = jwCommands
    const refusal = new EndCodeError(endCode, 'refused', {
      family: 'jw',
      ...resultFacts.refusal(readDataMemory, endCode),
    })
    let sent = 0
    const send = (): Promise<never> => {
      sent++
      return Promise.reject(refusal)
    }
    expect(new Set(codes(await plan.run(send, () => 1000)))).toEqual(new Set([endCode]))
    expect(sent).toBe(1)
  })
})

describe('without an answer', () => {
  test('nothing is repeated: the items of the request get the error, the others their values', async () => {
    const { plc, run, requests } = bench(['D0', 'D1', 'U3\\G0'])
    const lost = new TimeoutError('no answer', 'unknown')
    let calls = 0
    const results = await run((exchange) => {
      calls++
      return calls === 1 ? Promise.reject(lost) : plc.send(exchange)
    })
    expect(codes(results)).toEqual(['TIMEOUT', 'TIMEOUT', 'ok'])
    expect(requests()).toBe(1)
    expect(codes(await run())).toEqual(['ok', 'ok', 'ok'])
  })

  test('while a refused request is divided, the rest of it is not asked for', async () => {
    const { plc, run, requests } = bench(range(64, (i) => `D${i}`))
    plc.refuse = (device) => (device === 'D60' ? DEVICE_NUMBER : 0)
    let calls = 0
    const gone = new ConnectionError('DISCONNECTED', 'gone', 'unknown')
    const results = await run((exchange) => {
      calls++
      return calls > 3 ? Promise.reject(gone) : plc.send(exchange)
    })
    expect(calls).toBe(4)
    expect(codes(results).slice(0, 32)).toEqual(range(32, () => 'ok'))
    expect(codes(results).slice(32)).toEqual(range(32, () => 'DISCONNECTED'))
    requests()
    // Nothing was learnt from it: the next run starts with the plan as it was.
    plc.refuse = () => 0
    await run()
    expect(requests()).toBe(1)
  })

  test('every request is handed over before the first has answered', async () => {
    const { plc, run } = bench(['D0:INT[2000]'])
    let waiting = 0
    let most = 0
    await run(async (exchange) => {
      most = Math.max(most, ++waiting)
      const answer = await plc.send(exchange)
      waiting--
      return answer
    })
    expect(most).toBe(3)
  })

  test('a large plan does not flood the queue', async () => {
    const { plc, run } = bench(range(60, (i) => `ZR${i * 2000}:INT[900]`))
    let waiting = 0
    let most = 0
    const results = await run(async (exchange) => {
      most = Math.max(most, ++waiting)
      const answer = await plc.send(exchange)
      waiting--
      return answer
    })
    expect(most).toBeLessThanOrEqual(32)
    expect(new Set(codes(results))).toEqual(new Set(['ok']))
  })

  test('what is no PlcError is a bug and comes out, after the other requests have ended', async () => {
    const { plc, run, requests } = bench(['D0', 'U3\\G0'])
    let calls = 0
    const running = run((exchange) => {
      calls++
      return calls === 1 ? Promise.reject(new TypeError('bug')) : plc.send(exchange)
    })
    await expect(running).rejects.toThrow('bug')
    expect(requests()).toBe(1)
  })
})

test('a value that is none of its type fails alone', async () => {
  const { plc, run } = bench(['D0:BCD16', 'D1', 'D2:BCD16[2]', 'D4'])
  plc.setWord('D0', 0x12fa)
  plc.setWord('D2', 0x1234)
  plc.setWord('D3', 0x000a)
  expect(codes(await run())).toEqual(['BAD_FIELD', 'ok', 'BAD_FIELD', 'ok'])
})

test('two runs at once of a plan with a refused item do not spoil each other', async () => {
  const { plc, run, requests } = bench(range(20, (i) => `D${i}`))
  plc.refuse = (device) => (device === 'D7' ? DEVICE_NUMBER : 0)
  const [one = [], two = []] = await Promise.all([run(), run()])
  expect(codes(one)).toEqual(codes(two))
  expect(codes(one).filter((code) => code === 'ok')).toHaveLength(19)
  requests()
  await run()
  expect(requests()).toBeLessThanOrEqual(3)
})

test('items that cannot be asked for keep their error and their place', async () => {
  const { run } = bench(['NONSENSE', 'D0', 'D0:STRING(4000)'])
  expect(codes(await run())).toEqual(['BAD_ADDRESS', 'ok', 'LIMIT_EXCEEDED'])
})
