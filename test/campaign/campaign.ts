/** All lanes at once, and what they found. */
import { setFlagsFromString } from 'node:v8'
import { runInNewContext } from 'node:vm'
import { callers } from './callers'
import { type Configuration, configurations } from './configurations'
import { type Fault, faults } from './faults'
import { add, Gate, Lane, type LaneOptions, type Tally, type Violation } from './lane'
import { type ViolationKind, violationKinds } from './ledger'

export interface CampaignOptions {
  readonly seed: number
  /** Calls, spread over all configurations. */
  readonly exchanges: number
  readonly configurations?: readonly Configuration[]
  readonly faults?: readonly Fault[]
  readonly double?: NonNullable<LaneOptions['double']>
  /** Told every second or so. */
  readonly onProgress?: (exchanges: number, violations: number) => void
}

export interface CampaignResult {
  readonly tally: Tally
  readonly byConfiguration: ReadonlyMap<string, Tally>
  readonly byKind: ReadonlyMap<ViolationKind, number>
  /** The first of them, with their stories. */
  readonly violations: readonly Violation[]
  /** Bytes the heap grew, garbage collected, from a first part of the campaign to its end. */
  readonly grown: number
  /** Sockets and timers that are left. */
  readonly left: readonly string[]
  readonly ms: number
}

const KEPT_VIOLATIONS = 30
/** More would wait for the processor only, and run into deadlines for it. */
const SCENES_AT_ONCE = 5

setFlagsFromString('--expose-gc')
const collect: unknown = runInNewContext('gc')

function heapUsed(): number {
  if (typeof collect === 'function') collect()
  const { heapUsed: used, external } = process.memoryUsage()
  return used + external
}

export async function campaign(options: CampaignOptions): Promise<CampaignResult> {
  // Most calls end in an error: without traces they are cheap.
  const { stackTraceLimit } = Error
  Error.stackTraceLimit = 0
  try {
    return await run(options)
  } finally {
    Error.stackTraceLimit = stackTraceLimit
  }
}

async function run(options: CampaignOptions): Promise<CampaignResult> {
  const { seed, exchanges, configurations: chosen = configurations, onProgress } = options
  const started = performance.now()
  const before = handles()
  const byKind = new Map<ViolationKind, number>()
  const violations: Violation[] = []
  const onViolation = (violation: Violation): void => {
    byKind.set(violation.kind, (byKind.get(violation.kind) ?? 0) + 1)
    if (violations.length < KEPT_VIOLATIONS) violations.push(violation)
  }
  const gate = new Gate(SCENES_AT_ONCE)
  const share = Math.ceil(exchanges / chosen.length)
  const lanes = chosen.map((configuration) => {
    const { faults: some, double } = options
    return new Lane({
      configuration,
      seed: seedOf(seed, configuration.name),
      exchanges: share,
      onViolation,
      gate,
      ...(some === undefined ? {} : { faults: some }),
      ...(double === undefined ? {} : { double }),
    })
  })
  const soFar = (): number => lanes.reduce((sum, { tally }) => sum + tally.exchanges, 0)
  let baseline: number | undefined
  const watch = setInterval(() => {
    // Everything that is used once is loaded by then.
    if (soFar() > exchanges / 4) baseline ??= heapUsed()
    onProgress?.(soFar(), violations.length)
  }, 1000)
  const tallies = await Promise.all(lanes.map((lane) => lane.run()))
  clearInterval(watch)
  const left = await handlesLeft(before)
  const ended = heapUsed()
  return {
    tally: together(tallies),
    byConfiguration: new Map(tallies.map((tally, i) => [chosen[i]?.name ?? '', tally])),
    byKind,
    violations,
    grown: baseline === undefined ? 0 : ended - baseline,
    left,
    ms: performance.now() - started,
  }
}

/** The same for a configuration whatever others run beside it. */
function seedOf(seed: number, name: string): number {
  let hash = seed
  for (const letter of name) hash = Math.imul(hash ^ letter.charCodeAt(0), 0x01000193) >>> 0
  return hash
}

function together(tallies: readonly Tally[]): Tally {
  const all: Tally = { exchanges: 0, outcomes: new Map(), faults: new Map(), callers: new Map() }
  for (const tally of tallies) {
    all.exchanges += tally.exchanges
    for (const what of ['outcomes', 'faults', 'callers'] as const) {
      for (const [name, count] of tally[what]) add(all[what], name, count)
    }
  }
  return all
}

function handles(): Map<string, number> {
  const counts = new Map<string, number>()
  for (const name of process.getActiveResourcesInfo()) {
    if (/TCP|UDP|Timeout|Immediate/.test(name)) add(counts, name)
  }
  return counts
}

/** Sockets and timers that were not there before. They may take a moment to go. */
async function handlesLeft(before: ReadonlyMap<string, number>): Promise<string[]> {
  for (let attempt = 0; ; attempt += 1) {
    const more = [...handles()].filter(([name, count]) => count > (before.get(name) ?? 0))
    if (more.length === 0 || attempt === 100) return more.map(([name, count]) => `${count} ${name}`)
    await new Promise((resolve) => setTimeout(resolve, 50))
  }
}

export function report({ tally, byConfiguration, byKind, violations, grown, left, ms }: CampaignResult): string {
  const counts = (map: ReadonlyMap<string, number>): string =>
    [...map]
      .sort(([, one], [, other]) => other - one)
      .map(([name, count]) => `${name} ${count}`)
      .join(', ')
  const lines = [
    ...violations.map(violationText),
    `${tally.exchanges} exchanges in ${(ms / 1000).toFixed(1)} s, ${Math.round(tally.exchanges / (ms / 1000))}/s`,
    ...[...byConfiguration].map(([name, { exchanges, outcomes }]) => `  ${name}: ${exchanges} (${counts(outcomes)})`),
    `ended: ${counts(tally.outcomes)}`,
    `faults (${tally.faults.size} kinds): ${counts(tally.faults)}`,
    `callers (${tally.callers.size} kinds): ${counts(tally.callers)}`,
    `heap ${(grown / 2 ** 20).toFixed(1)} MB more; left: ${left.join(', ') || 'nothing'}`,
    `violations: ${
      violationKinds
        .map((kind) => `${kind} ${byKind.get(kind) ?? 0}`)
        .filter((text) => !text.endsWith(' 0'))
        .join(', ') || 'none'
    }`,
  ]
  return `${lines.join('\n')}\n`
}

function violationText({ kind, configuration, scene, caller, call, detail, story }: Violation): string {
  const lines = story.map((line) => `    ${line}`).join('\n')
  return `VIOLATION ${kind}: ${configuration}, scene ${scene} (${caller})\n  ${call}\n  ${detail}\n${lines}\n`
}

export function listing(): string {
  const names = (list: readonly { readonly name: string }[]): string => list.map(({ name }) => `  ${name}`).join('\n')
  return `Configurations (--kind):\n${names(configurations)}\nFaults (--fault):\n${names(faults)}\nCallers:\n${names(callers)}\n`
}
