/** Plans for serial lines against every way there is. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { parseItem } from '../../src/client/item/item'
import type { PlanProtocol } from '../../src/client/plan/limit'
import { planRead } from '../../src/client/plan/read'
import { TimeoutError } from '../../src/errors'
import type { Exchange } from '../../src/link/link'
import { characterCost, leastReading } from './plan-search'
import { over1c, overSerial, smallFx5 } from './serial-protocols'

const GAP = 64

const parsed = (texts: readonly string[]) => texts.map((text) => parseItem(text, { xyRadix: 8 }))

/** The requests of a plan that is run once. */
async function requestsOf(texts: readonly string[], protocol: PlanProtocol, gap = GAP): Promise<Exchange<unknown>[]> {
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

/** Characters of a plan, without the DLEs that format 5 adds. */
async function priceOf(texts: readonly string[], protocol: PlanProtocol, gap = GAP): Promise<number> {
  const costOf = characterCost(protocol)
  return (await requestsOf(texts, protocol, gap)).reduce((sum, exchange) => sum + costOf(exchange), 0)
}

const number = fc.oneof(fc.nat(30), fc.nat(120), fc.nat(700))
const count = fc.constantFrom('', '', '', '[2]', '[5]', '[17]', '[33]')

const itemText: fc.Arbitrary<string> = fc.oneof(
  fc
    .tuple(fc.constantFrom('D', 'D', 'R'), number, fc.constantFrom('', ':DINT', ':LREAL'), count)
    .map((all) => all.join('')),
  fc.tuple(fc.constantFrom('M'), number, fc.constantFrom('', '', '[3]', '[20]')).map((all) => all.join('')),
  fc.tuple(fc.constantFrom('K4M', 'K8M'), number).map((all) => all.join('')),
)
const itemTexts = fc.array(itemText, { minLength: 1, maxLength: 7 })

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
      fc.asyncProperty(itemTexts, fc.constantFrom(GAP, 3, 0), async (texts, gap) => {
        const least = leastReading(parsed(texts), protocol, gap)
        // An item that no request holds is cut, which is not tried.
        fc.pre(Number.isFinite(least))
        expect(await priceOf(texts, protocol, gap)).toBe(least)
      }),
      { numRuns: 150 },
    )
  })
})

describe('where Read Random and Read Block are too small for what would go into them', () => {
  const small: Readonly<Record<string, PlanProtocol>> = {
    '3 points, 20 words': overSerial('4C', 5, true, smallFx5({ readRandom: 3, readBlock: 20 })),
    '2 points, 8 words': overSerial('3C', 1, true, smallFx5({ readRandom: 2, readBlock: 8 })),
    'and Read, too': overSerial('4C', 5, true, smallFx5({ readRandom: 4, readBlock: 10, readWords: 34 })),
  }

  test.each(Object.entries(small))('less than a request more is sent: %s', async (_name, protocol) => {
    const request = await priceOf(['D0'], protocol)
    await fc.assert(
      fc.asyncProperty(itemTexts, async (texts) => {
        const least = leastReading(parsed(texts), protocol, GAP)
        fc.pre(Number.isFinite(least))
        const price = await priceOf(texts, protocol)
        expect(price).toBeGreaterThanOrEqual(least)
        expect(price).toBeLessThan(least + request)
      }),
      { numRuns: 150 },
    )
  })
})
