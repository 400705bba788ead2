/** All lines of the serial campaign, a few at a time, and what they found. */
import { type SerialDouble, type SerialKind, type SerialTally, serialLane } from './serial-lane'

export interface SerialCampaignOptions {
  readonly seed: number
  readonly kinds: readonly SerialKind[]
  readonly requests: (kind: SerialKind) => number
  readonly faults: (name: string) => boolean
  readonly double?: SerialDouble
  readonly onEnd?: (tally: SerialTally) => void
}

/** More would wait for the processor only, and run into deadlines for it. */
const AT_ONCE = 6

export async function serialCampaign(options: SerialCampaignOptions): Promise<SerialTally[]> {
  const { seed, kinds, requests, faults, double, onEnd } = options
  const tallies: SerialTally[] = []
  const left = [...kinds.entries()]
  const next = async (): Promise<void> => {
    for (let one = left.shift(); one !== undefined; one = left.shift()) {
      const [at, kind] = one
      const given = { kind, seed: seed * 1000 + at, requests: requests(kind), faults }
      const tally = await serialLane(double === undefined ? given : { ...given, double })
      tallies.push(tally)
      onEnd?.(tally)
    }
  }
  await Promise.all(Array.from({ length: AT_ONCE }, next))
  return tallies
}

const SHOWN = 20

export function serialReport(tallies: readonly SerialTally[]): string {
  const counts = (map: Readonly<Record<string, number>>): string =>
    Object.entries(map)
      .sort(([, one], [, other]) => other - one)
      .map(([name, count]) => `${name} ${count}`)
      .join(', ')
  return tallies
    .map(({ kind, told, outcomes, truth, violations, story, ms }) => {
      const faults = Object.values(truth.struck).reduce((sum, count) => sum + count, 0)
      const rows = [
        `${kind.name}: ${told} calls, ${truth.requests} requests, ${(ms / 1000).toFixed(1)} s (${counts(outcomes)})`,
        `  ${faults} faults: ${counts(truth.struck) || 'none'}; ${truth.asleep} chunks lost asleep`,
        ...violations.slice(0, SHOWN).map(({ kind: what, detail }) => `  VIOLATION ${what}: ${detail}`),
        ...story.map((line) => `    ${line}`),
        `  violations: ${violations.length}`,
      ]
      return `${rows.join('\n')}\n`
    })
    .join('')
}
