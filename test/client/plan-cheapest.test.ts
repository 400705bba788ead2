/** Plans for serial lines against every way there is. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { type ParsedItem, parseItem } from '../../src/client/item/item'
import type { PlainValue } from '../../src/client/item/item-value'
import { createMelsecClient } from '../../src/client/melsec/melsec-client'
import type { PlanProtocol } from '../../src/client/plan/limit'
import { type DeviceRead, planRead } from '../../src/client/plan/read'
import { planWrite } from '../../src/client/plan/write'
import { TimeoutError } from '../../src/errors'
import type { Exchange } from '../../src/link/link'
import { profiles } from '../../src/melsec/profiles/profiles'
import { expectedValue, fx5Items, itemText, modifiedText } from './plan-arbitrary'
import { goodValue, PlanPlc } from './plan-plc'
import { characterCost, leastReading, leastWriting } from './plan-search'
import { over1c, overSerial, smallFx5 } from './serial-protocols'

const GAP = 64

const parsed = (texts: readonly string[]) => texts.map((text) => parseItem(text, { xyRadix: 8 }))

/** The requests of a plan that is run once, and nobody answers. */
async function readsOf(texts: readonly string[], protocol: PlanProtocol, gap: number): Promise<Exchange<unknown>[]> {
  const plan = planRead(parsed(texts), protocol, { gap })
  expect(texts.filter((_, i) => plan.errorOf(i) !== undefined)).toEqual([])
  const seen: Exchange<unknown>[] = []
  const silence = async (exchange: Exchange<unknown>): Promise<never> => {
    seen.push(exchange)
    throw new TimeoutError('nobody answers', 'unknown')
  }
  await plan.run(silence, () => 0)
  return seen
}

/** The requests of a plan that is run once, and each is taken. */
async function writesOf(items: readonly ParsedItem[], protocol: PlanProtocol): Promise<Exchange<unknown>[]> {
  const plan = planWrite(
    items.map((item) => ({ item, value: valueFor(item, 0) })),
    protocol,
  )
  const seen: Exchange<unknown>[] = []
  const results = await plan.run(async (exchange) => {
    seen.push(exchange)
    return exchange.decode({ head: {}, serial: undefined, endCode: 0, body: Buffer.alloc(0) })
  })
  expect(results.filter(({ ok }) => !ok)).toEqual([])
  return seen
}

/** Characters of requests and answers, without the DLEs that format 5 adds. */
function charactersOf(exchanges: readonly Exchange<unknown>[], protocol: PlanProtocol): number {
  const costOf = characterCost(protocol)
  return exchanges.reduce((sum, exchange) => sum + costOf(exchange), 0)
}

async function readPrice(texts: readonly string[], protocol: PlanProtocol, gap = GAP): Promise<number> {
  return charactersOf(await readsOf(texts, protocol, gap), protocol)
}

function valueFor({ type, count }: ParsedItem, seed: number): PlainValue {
  const one = (i: number) => (type.name === 'BOOL' ? (seed + i) % 2 === 1 : seed + i)
  if (count === undefined) return one(0)
  return Array.from({ length: count }, (_, i) => one(i)) as PlainValue
}

const frames: Readonly<Record<string, PlanProtocol>> = {
  '1C format 1': over1c(),
  '1C format 4 without sum': over1c(4, false),
  '3C format 1': overSerial('3C', 1),
  '4C format 4': overSerial('4C', 4),
  '4C format 5': overSerial('4C', 5),
  '4C format 5 without sum': overSerial('4C', 5, false),
}

describe('reading costs the fewest characters that any distribution over requests does', () => {
  test.each(Object.entries(frames))('%s', async (_name, protocol) => {
    await fc.assert(
      fc.asyncProperty(fx5Items, fc.constantFrom(GAP, 3, 0), async (texts, gap) => {
        const least = leastReading(parsed(texts), protocol, gap)
        // An item that no request holds is cut, which is not tried.
        fc.pre(Number.isFinite(least))
        expect(await readPrice(texts, protocol, gap)).toBe(least)
      }),
      { numRuns: 100 },
    )
  })
})

test('a request ends before it is full where the widest gap is then between two requests', () => {
  const plan = planRead(parsed(['D0[15]', 'D16[15]', 'D38[15]', 'D54[45]']), over1c(), { gap: GAP })
  expect(plan.describe().requests.map(({ text }) => text)).toEqual([
    'Batch read (word units): D0 to D30, 31 points',
    'Batch read (word units): D38 to D98, 61 points',
  ])
})

describe('a wait of each request counts as the characters that the line could carry meanwhile', () => {
  test('in a plan', async () => {
    const turnRound = 31
    const protocol = over1c(1, true, turnRound)
    const characters = characterCost(protocol)
    const costOf = (exchange: Exchange<unknown>) => characters(exchange) + turnRound
    await fc.assert(
      fc.asyncProperty(fx5Items, async (texts) => {
        const least = leastReading(parsed(texts), protocol, GAP, costOf)
        fc.pre(Number.isFinite(least))
        const reads = await readsOf(texts, protocol, GAP)
        expect(reads.reduce((sum, read) => sum + costOf(read), 0)).toBe(least)
      }),
      { numRuns: 50 },
    )
  })

  test('of a client whose converter needs the PLC to wait, or a pause between requests', () => {
    const requests = (messageWait: number, gap: number) => {
      const serial = { path: 'never opened', gap } as const
      const client = createMelsecClient({ serial, profile: 'fx5-serial', frame: '1C', messageWait })
      return client.plan(['D0', 'D12']).describe().requests.length
    }
    expect([requests(0, 0), requests(70, 0), requests(0, 70)]).toEqual([2, 1, 1])
  })
})

describe('where Read Random and Read Block are too small for what would go into them', () => {
  const small: Readonly<Record<string, PlanProtocol>> = {
    '3 points, 20 words': overSerial('4C', 5, true, smallFx5({ readRandom: 3, readBlock: 20 })),
    '2 points, 8 words': overSerial('3C', 1, true, smallFx5({ readRandom: 2, readBlock: 8 })),
    'and Read, too': overSerial('4C', 5, true, smallFx5({ readRandom: 4, readBlock: 10, readWords: 34 })),
  }

  test.each(Object.entries(small))('less than a request more is sent: %s', async (_name, protocol) => {
    const request = await readPrice(['D0'], protocol)
    await fc.assert(
      fc.asyncProperty(fx5Items, async (texts) => {
        const least = leastReading(parsed(texts), protocol, GAP)
        fc.pre(Number.isFinite(least))
        const price = await readPrice(texts, protocol)
        expect(price).toBeGreaterThanOrEqual(least)
        expect(price).toBeLessThan(least + request)
      }),
      { numRuns: 100 },
    )
  })
})

describe('values', () => {
  test.each([
    ['binary', overSerial('4C', 5, true, profiles['iq-r-c24'])],
    ['ascii', overSerial('3C', 1, true, profiles['iq-r-c24'])],
  ])('are those of the devices, whatever the plan: %s', async (_name, protocol) => {
    const texts = fc.array(fc.oneof(itemText, itemText, modifiedText), { minLength: 1, maxLength: 40 })
    await fc.assert(
      fc.asyncProperty(texts, fc.nat(100), async (given, gap) => {
        const plc = new PlanPlc(protocol)
        const items = given.map((text) => parseItem(text, { xyRadix: 16 }))
        const plan = planRead(items, protocol, { gap })
        const results = await plan.run(plc.send, () => 5)
        expect(results.map(goodValue)).toEqual(items.map((item) => expectedValue(plc, item)))
        // Never more characters than the items alone.
        const characters = (one: DeviceRead) =>
          one
            .describe()
            .requests.reduce((sum, { requestBytes = 0, responseBytes = 0 }) => sum + requestBytes + responseBytes, 0)
        const alone = items.map((item) => characters(planRead([item], protocol, { gap })))
        // A count or a length may be 10H, which format 5 sends twice.
        expect(characters(plan)).toBeLessThanOrEqual(alone.reduce((sum, one) => sum + one) + 8)
      }),
      { numRuns: 100 },
    )
  })
})

/** Items near one another that share nothing, in any order: the least of them says where the next may begin. */
const apart = fc
  .array(
    fc.tuple(fc.constantFrom('D', 'D', 'D:DINT', 'D[3]', 'D[12]', 'M', 'M[16]', 'M[5]', 'K4M'), fc.nat(3), fc.nat(99)),
    {
      minLength: 1,
      maxLength: 8,
    },
  )
  .map((kinds) => {
    const next = { D: 0, M: 0 }
    const texts = kinds.map(([kind, gap, order]) => {
      const [, digits = '', device = 'D', tail = ''] = /^(K\d)?(\w)(.*)$/.exec(kind) ?? []
      const isBit = device === 'M'
      const from = next[isBit ? 'M' : 'D'] + (isBit ? 16 * Math.floor(gap / 2) : gap)
      const at = digits === '' ? from : Math.ceil(from / 16) * 16
      const item = parseItem(`${digits}${device}${at}${tail}`, { xyRadix: 8 })
      next[isBit ? 'M' : 'D'] = at + (digits === '' ? 1 : 16) * (item.count ?? 1) * (item.type.name === 'DINT' ? 2 : 1)
      return { item, order }
    })
    return texts.sort((a, b) => a.order - b.order).map(({ item }) => item)
  })

describe('writing costs the fewest characters that any requests in this order do', () => {
  test.each(Object.entries(frames))('%s', async (_name, protocol) => {
    await fc.assert(
      fc.asyncProperty(apart, async (items) => {
        const price = charactersOf(await writesOf(items, protocol), protocol)
        expect(price).toBe(leastWriting(items, protocol))
      }),
      { numRuns: 100 },
    )
  })

  test('and writes what was given and nothing beside it', async () => {
    const protocol = overSerial('4C', 5)
    await fc.assert(
      fc.asyncProperty(apart, fc.nat(999), async (items, seed) => {
        const [plc, before] = [new PlanPlc(protocol), new PlanPlc(protocol)]
        const entries = items.map((item, i) => ({ item, value: valueFor(item, seed + i) }))
        await planWrite(entries, protocol).run(plc.send)
        for (const { item, value } of entries) expect(expectedValue(plc, item)).toEqual(value)
        const written = new Set(items.flatMap(devicesOf))
        const others = Array.from({ length: 300 }, (_, n) => n)
        const words = others.filter((n) => !written.has(`D${n}`)).map((n) => ({ device: 'D', number: n }) as const)
        const bits = others.filter((n) => !written.has(`M${n}`)).map((n) => ({ device: 'M', number: n }) as const)
        expect(words.map((at) => plc.word(at))).toEqual(words.map((at) => before.word(at)))
        expect(bits.map((at) => plc.bit(at))).toEqual(bits.map((at) => before.bit(at)))
      }),
      { numRuns: 100 },
    )
  })
})

function devicesOf({ address: { device, number: first }, type, digits, count: many = 1 }: ParsedItem): string[] {
  const size = (digits === undefined ? 1 : 4 * digits) * (type.name === 'DINT' ? 2 : 1) * many
  return Array.from({ length: size }, (_, i) => `${device}${first + i}`)
}
