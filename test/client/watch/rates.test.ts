/** Two rates that fall together are read by no more requests than each of them alone. */
import { expect, test } from '@jest/globals'
import fc from 'fast-check'
import { createMelsecClient, type Item, type MelsecClient } from '../../../src/index'

const device = fc.constantFrom('D', 'W', 'M', 'B', 'ZR', 'TN', 'X')
const items = fc.array(
  fc.oneof(
    {
      arbitrary: fc.tuple(device, fc.integer({ min: 0, max: 3000 })).map(([name, number]) => address(name, number)),
      weight: 4,
    },
    {
      arbitrary: fc
        .tuple(fc.integer({ min: 0, max: 9000 }), fc.integer({ min: 1, max: 1200 }))
        .map(([d, n]) => `D${d}[${n}]`),
      weight: 1,
    },
  ),
  { maxLength: 120 },
)

function address(name: string, number: number): string {
  return `${name}${name === 'W' || name === 'B' || name === 'X' ? `0${number.toString(16).toUpperCase()}` : number}`
}

function requestsOf(client: MelsecClient, list: readonly Item[]): number {
  return client.plan(list).describe().requests.length
}

test.each(['iq-r', 'iq-f', 'q', 'l', 'fx5-enet'] as const)('%s', async (profile) => {
  const client = createMelsecClient({
    host: 'plc',
    port: 1,
    profile,
    ...(profile === 'iq-f' ? { xyRadix: 16 as const } : {}),
  })
  fc.assert(
    fc.property(items, items, (fast, slow) => {
      const together = requestsOf(client, [...new Set([...fast, ...slow])])
      expect(together).toBeLessThanOrEqual(requestsOf(client, fast) + requestsOf(client, slow))
    }),
    { numRuns: 300 },
  )
  await client.close()
})
