/** Plans for a network against every way there is: how many requests they are. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { parseItem } from '../../src/client/item/item'
import { planRead } from '../../src/client/plan/read'
import type { ProfileOverrides } from '../../src/melsec/profiles/profile'
import { fx5Items } from './plan-arbitrary'
import { protocolOf } from './plan-plc'
import { leastReading, requestCost } from './plan-search'

const GAP = 64

/** Requests of the plan, and of the best distribution there is. An item that must be cut is not tried. */
function requestsFor(texts: readonly string[], overrides: ProfileOverrides) {
  const protocol = protocolOf('iq-f', 'binary', overrides)
  const items = texts.map((text) => parseItem(text, { xyRadix: 8 }))
  const least = leastReading(items, protocol, GAP, requestCost)
  fc.pre(Number.isFinite(least))
  return { planned: planRead(items, protocol, { gap: GAP }).describe().requests.length, least }
}

describe('a plan has', () => {
  test('the fewest requests that any distribution has', () => {
    fc.assert(
      fc.property(fx5Items, (texts) => {
        const { planned, least } = requestsFor(texts, {})
        expect(planned).toBe(least)
      }),
      { numRuns: 60 },
    )
  })

  test.each<[string, ProfileOverrides]>([
    ['2 points, 8 words', { limits: { readRandom: 2, readBlock: { points: 8, blocks: 2 } } }],
    ['4 points, no blocks', { lacks: { readBlock: true }, limits: { readRandom: 4, readWords: 34 } }],
  ])('no more than one above it where requests carry little: %s', (_name, overrides) => {
    fc.assert(
      fc.property(fx5Items, (texts) => {
        const { planned, least } = requestsFor(texts, overrides)
        expect(planned - least).toBeGreaterThanOrEqual(0)
        expect(planned - least).toBeLessThanOrEqual(1)
      }),
      { numRuns: 60 },
    )
  })
})
