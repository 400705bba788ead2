/**
 * A client against a PLC by hand, with faults. `npm run campaign` takes a million exchanges and another seed; here there
 * are few and always the same scenes, so that the tests stay quick. How a scene ends depends on the machine, too: what
 * is held against the ledger is true however it ends.
 */
import { describe, expect, test } from '@jest/globals'
import { callers } from './callers'
import type { Client } from './calls'
import { campaign, listing, report } from './campaign'
import { configurations } from './configurations'
import {
  deniesWrites,
  givesOldValues,
  hidesFailures,
  makesValuesUp,
  mixesUpValues,
  repeatsWrites,
  throwsAnything,
} from './doubles'
import { faults } from './faults'
import type { ViolationKind } from './ledger'

const { CAMPAIGN_EXCHANGES, CAMPAIGN_SEED, CAMPAIGN_KIND = '', CAMPAIGN_FAULT = '' } = process.env
const exchanges = Number(CAMPAIGN_EXCHANGES ?? 3000)
const seed = Number(CAMPAIGN_SEED ?? 1)
/** Ledgers, journals and prepared plans of all lanes grow to their bounds; what leaks grows on. */
const MOST_GROWN = 96 * 2 ** 20

test('holds what the client says against what the PLC received and did', async () => {
  const found = await campaign({
    seed,
    exchanges,
    configurations: configurations.filter(({ name }) => name.includes(CAMPAIGN_KIND)),
    faults: faults.filter(({ name }) => name.includes(CAMPAIGN_FAULT)),
    onProgress: (done, violations) => {
      if (CAMPAIGN_EXCHANGES !== undefined) process.stderr.write(`\r${done} exchanges, ${violations} violations `)
    },
  })
  const text = report(found)
  if (CAMPAIGN_EXCHANGES !== undefined || found.byKind.size > 0) process.stdout.write(`\n${text}`)
  expect(Object.fromEntries(found.byKind)).toEqual({})
  expect(found.left).toEqual([])
  expect(found.grown).toBeLessThan(MOST_GROWN)
  // It is of use only when calls come to every kind of end.
  for (const outcome of ['done', 'notSent', 'unknown']) {
    expect(found.tally.outcomes.get(outcome) ?? 0).toBeGreaterThan(exchanges / 50)
  }
}, 7_200_000)

test('lists what there is', () => {
  const text = listing()
  if (CAMPAIGN_EXCHANGES !== undefined) process.stdout.write(text)
  for (const { name } of [...configurations, ...faults, ...callers]) expect(text).toContain(name)
  expect(new Set(faults.map(({ name }) => name)).size).toBe(faults.length)
})

/** Each breaks its word in one way, and the campaign has a name for it. An old value needs the same item again. */
const broken: readonly (readonly [string, (client: Client) => Client, ViolationKind, number])[] = [
  ['mixes up values', mixesUpValues, 'wrong value', 500],
  ['gives old values', givesOldValues, 'stale value', 2000],
  ['makes values up', makesValuesUp, 'value without a request', 500],
  ['denies writes', deniesWrites, 'carried out though told as notSent', 2000],
  ['repeats writes', repeatsWrites, 'carried out twice', 500],
  ['hides failures', hidesFailures, 'done but not carried out', 500],
  ['throws anything', throwsAnything, 'no PlcError', 500],
]

describe('finds a client that', () => {
  const chosen = configurations.filter(({ name }) => name === 'TCP 4E binary iq-r' || name === 'UDP 3E ascii iq-r')

  test.each(broken)('%s', async (_what, double, kind, calls) => {
    const found = await campaign({ seed: 3, exchanges: calls, configurations: chosen, double })
    expect(found.byKind.get(kind) ?? 0).toBeGreaterThan(0)
    const first = found.violations.find((violation) => violation.kind === kind)
    expect(first?.story.some((line) => line.includes('call '))).toBe(true)
  })
})
