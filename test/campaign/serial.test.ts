/**
 * Clients and stations as two programs over a real pair of serial ports. `npm run campaign -- --serial` takes ten thousand requests
 * on every kind of line and another seed; here there are few, so that the tests stay quick.
 */
import { beforeAll, describe, expect, test } from '@jest/globals'
import { build } from '../cli/cli'
import { serialCampaign, serialReport } from './serial-campaign'
import { ignoresTheSum, repeatsAfterSilence, takesLateAnswers } from './serial-doubles'
import { otherSerialKinds, serialKinds } from './serial-kinds'
import { serialFaults } from './serial-lane'

const { CAMPAIGN_SERIAL, CAMPAIGN_EXCHANGES, CAMPAIGN_SEED, CAMPAIGN_KIND = '', CAMPAIGN_FAULT = '' } = process.env
const isWhole = CAMPAIGN_SERIAL !== undefined
const seed = isWhole ? Number(CAMPAIGN_SEED) : 1
const all = [...serialKinds, ...otherSerialKinds]
const some = all.filter(({ baudRate, pace }) => baudRate === 115_200 && !pace)

function listOf(names: readonly string[]): string {
  return names.map((name) => `  ${name}`).join('\n')
}

beforeAll(build, 120_000)

test('no wrong value, no doubled write, and every lost one is told: on a serial line', async () => {
  const found = await serialCampaign({
    seed,
    kinds: (isWhole ? all : some).filter(({ name }) => name.includes(CAMPAIGN_KIND)),
    requests: ({ pace }) => (isWhole ? Math.ceil(Number(CAMPAIGN_EXCHANGES) / (pace ? 10 : 1)) : 60),
    faults: (name) => name.includes(CAMPAIGN_FAULT),
    onEnd: (tally) => {
      if (isWhole) process.stderr.write(serialReport([tally]))
    },
  })
  if (!isWhole && found.some(({ violations }) => violations.length > 0)) process.stderr.write(serialReport(found))
  expect(found.flatMap(({ violations }) => violations)).toEqual([])
  // It is of use only when calls come to every kind of end, and the faults have struck.
  const noisy = found.filter(({ kind }) => kind.noise)
  const struck = new Set(noisy.flatMap(({ truth }) => Object.keys(truth.struck)))
  const ends = new Set(noisy.flatMap(({ outcomes }) => Object.keys(outcomes)))
  if (CAMPAIGN_FAULT !== '' || CAMPAIGN_KIND !== '') return
  expect([...ends]).toEqual(expect.arrayContaining(['read done', 'write done', 'write unknown']))
  if (isWhole) expect([...struck].sort()).toEqual([...serialFaults].sort())
  else expect(struck.size).toBeGreaterThan(serialFaults.length / 2)
}, 7_200_000)

test('lists serial lines', () => {
  const text = `Lines (--kind):\n${listOf(all.map(({ name }) => name))}\nFaults (--fault):\n${listOf(serialFaults)}\n`
  if (isWhole) process.stdout.write(text)
  expect(new Set(all.map(({ name }) => name)).size).toBe(all.length)
})

describe('finds a client that', () => {
  const broken = [
    { double: repeatsAfterSilence, fault: 'drop', violation: 'carried out twice' },
    { double: takesLateAnswers, fault: 'late', violation: 'wrong value' },
    { double: ignoresTheSum, fault: 'damaged', violation: 'wrong value' },
  ] as const
  test.each(broken.map((one) => [one.double.name, one] as const))(
    '%s',
    async (_name, { double, fault, violation }) => {
      const found = await serialCampaign({
        seed: 3,
        kinds: all.filter(({ name }) => name === '3C format 4 115200 noise'),
        requests: () => double.requests,
        faults: (name) => name === fault,
        double,
      })
      expect(found.flatMap(({ violations }) => violations.map((one) => one.kind))).toContain(violation)
    },
    60_000,
  )
})
