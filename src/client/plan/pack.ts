/**
 * Which requests read a set of pieces: fewest requests, then fewest bytes.
 *
 * Chunks can be read by one Read (0401) each; their runs can share a Read Random (0403), which counts points, or a Read
 * Block (0406), which counts blocks and words. Three ways to distribute them are drawn up and the best one is taken.
 */
import type { CommandName } from '../../melsec/commands/commands'
import { groupOf, randomLoad } from './area'
import { type Chunk, chunksOf, type Stretch } from './chunk'
import type { Areas, Piece } from './layout'
import { added, type Bound, boundsOf, fewestFor, firstFit, fits, type Load, type PlanProtocol, weightOf } from './limit'

/** One request to be: the cells it asks for. */
export type Draft =
  | { readonly kind: 'direct'; readonly run: Stretch }
  | { readonly kind: 'random'; readonly runs: readonly Stretch[] }
  | { readonly kind: 'block'; readonly runs: readonly Stretch[] }

export interface PackOptions {
  /** Words that may be read in vain to merge near items. */
  readonly gap: number
  /** Commands the PLC has refused: not used again. */
  readonly without: ReadonlySet<CommandName>
}

/** Bytes of a draft, request and response together. */
export type Cost = (draft: Draft) => number

/** The requests that read the pieces. Areas of different groups never share one. */
export function packed(areas: Areas, pieces: readonly Piece[], options: PackOptions, cost: Cost): Draft[] {
  const groups = new Map<string, Chunk[]>()
  for (const chunk of chunksOf(areas, pieces, options.gap)) {
    const group = groupOf(chunk.area)
    groups.set(group, [...(groups.get(group) ?? []), chunk])
  }
  const drafts = [...groups.values()].flatMap((chunks) => best(plansOf(areas.protocol, chunks, options), cost))
  const first = (draft: Draft) => Math.min(...(draft.kind === 'direct' ? [draft.run] : draft.runs).map(firstItem))
  return drafts.sort((a, b) => first(a) - first(b))
}

function firstItem({ members }: Stretch): number {
  return members.reduce((least, { item }) => Math.min(least, item), Number.POSITIVE_INFINITY)
}

function best(plans: readonly (readonly Draft[])[], cost: Cost): readonly Draft[] {
  const fewest = Math.min(...plans.map((plan) => plan.length))
  const short = plans.filter((plan) => plan.length === fewest)
  const [first = [], ...others] = short
  if (others.length === 0) return first
  const total = (plan: readonly Draft[]) => plan.reduce((sum, draft) => sum + cost(draft), 0)
  return others.reduce((a, b) => (total(b) < total(a) ? b : a), first)
}

function plansOf(protocol: PlanProtocol, chunks: readonly Chunk[], { without }: PackOptions): Draft[][] {
  const [first, ...others] = chunks
  if (first === undefined) return [[]]
  if (others.length === 0 && first.area.ways.direct !== undefined) return [[direct(first)]]
  const { form } = first.area.ways
  const random = without.has('readRandom') ? [] : byRandom(boundsOf(protocol, 'readRandom', form), chunks)
  const plans = [...random]
  if (chunks.every(({ area }) => area.ways.direct !== undefined)) plans.push(chunks.map(direct))
  if (!without.has('readBlock')) {
    plans.push(...byBlock(protocol, chunks, without))
  }
  // Without Read Random, what only it can read is asked for all the same: the PLC says no, not this program.
  return plans.length > 0 ? plans : byRandom(boundsOf(protocol, 'readRandom', form), chunks)
}

function direct(chunk: Chunk): Draft {
  return { kind: 'direct', run: wholeOf(chunk) }
}

function runLoad({ area, from, to }: Stretch): Load {
  return randomLoad(area, to - from)
}

/** Whether Read Random can read all of a chunk. */
function scatters({ area, members }: Chunk, bounds: readonly Bound[]): boolean {
  if (area.ways.random === undefined) return false
  return members.every((run) => fits(bounds, runLoad(run)) && run.members.every(({ layout }) => !layout.directOnly))
}

/**
 * The heaviest chunks get a Read each and the others share Read Randoms: as many of them as makes the fewest requests.
 * @returns the plans with the fewest and the most Reads among those with the fewest requests
 */
function byRandom(bounds: readonly Bound[], chunks: readonly Chunk[]): Draft[][] {
  const loads = new Map(chunks.map((chunk) => [chunk, chunk.members.map(runLoad).reduce(added, {})]))
  const loadOf = (chunk: Chunk): Load => loads.get(chunk) ?? {}
  const must: Chunk[] = []
  const may: Chunk[] = []
  const always: Chunk[] = []
  for (const chunk of chunks) {
    const { direct: read } = chunk.area.ways
    ;(read === undefined ? must : scatters(chunk, bounds) ? may : always).push(chunk)
  }
  may.sort((a, b) => weightOf(loadOf(b), bounds) - weightOf(loadOf(a), bounds))
  const counts = [must.map(loadOf).reduce(added, {})]
  for (const chunk of [...may].reverse()) counts.push(added(counts.at(-1) ?? {}, loadOf(chunk)))
  counts.reverse()
  // counts[n]: what is left for Read Random when the n heaviest chunks are read directly
  const requests = counts.map((load, n) => n + fewestFor(bounds, load))
  const fewest = Math.min(...requests)
  const choices = new Set([requests.indexOf(fewest), requests.lastIndexOf(fewest)])
  return [...choices].map((n) => [
    ...[...always, ...may.slice(0, n)].map(direct),
    ...scattered(bounds, [...must, ...may.slice(n)]),
  ])
}

/** A run on its way into a request, and the chunk it is part of. */
interface Parcel {
  readonly run: Stretch
  readonly chunk: Chunk
}

function parcelsOf(chunks: readonly Chunk[]): Parcel[] {
  return chunks.flatMap((chunk) => chunk.members.map((run): Parcel => ({ run, chunk })))
}

function scattered(bounds: readonly Bound[], chunks: readonly Chunk[]): Draft[] {
  return distributed('random', parcelsOf(chunks), runLoad, bounds)
}

/** As few requests as hold all parcels. One that turns out to hold one chunk only is a Read: that is what Read is for. */
function distributed(
  kind: 'random' | 'block',
  parcels: readonly Parcel[],
  loadOf: (run: Stretch) => Load,
  bounds: readonly Bound[],
): Draft[] {
  const size = new Map<Chunk, number>()
  for (const { chunk } of parcels) size.set(chunk, (size.get(chunk) ?? 0) + 1)
  return firstFit(parcels, ({ run }) => loadOf(run), bounds).map((bin): Draft => {
    const chunk = bin[0]?.chunk
    if (chunk?.area.ways.direct !== undefined && bin.length === size.get(chunk)) {
      if (bin.every((parcel) => parcel.chunk === chunk)) return direct(chunk)
    }
    return { kind, runs: bin.map(({ run }) => run).sort((a, b) => firstItem(a) - firstItem(b)) }
  })
}

/** Blocks as large as the chunks, and blocks as small as the runs; what goes into no block is read as otherwise. */
function byBlock(protocol: PlanProtocol, chunks: readonly Chunk[], without: ReadonlySet<CommandName>): Draft[][] {
  const blocks = chunks.filter(({ area }) => area.ways.block !== undefined)
  const first = blocks[0]
  if (first === undefined) return []
  const bounds = boundsOf(protocol, 'readBlock', first.area.ways.form)
  const others = chunks.filter(({ area }) => area.ways.block === undefined)
  const otherPlans =
    others.length === 0 ? [[]] : plansOf(protocol, others, { gap: 0, without: new Set([...without, 'readBlock']) })
  const whole = blocks.map((chunk): Parcel => ({ run: wholeOf(chunk), chunk }))
  return [whole, parcelsOf(blocks)].flatMap((parcels) => {
    const isLarge = ({ run }: Parcel) => !fits(bounds, blockLoad(run))
    const large = parcels.filter(isLarge).map(({ run }): Draft => ({ kind: 'direct', run }))
    const fitting = parcels.filter((parcel) => !isLarge(parcel))
    const drafts = [...large, ...distributed('block', fitting, blockLoad, bounds)]
    return otherPlans.map((plan) => [...drafts, ...plan])
  })
}

function wholeOf({ area, from, to, members }: Chunk): Stretch {
  return { area, from, to, members: members.flatMap((run) => run.members) }
}

function blockLoad({ area, from, to }: Stretch): Load {
  const list = area.ways.block ?? 'wordBlocks'
  return { [list]: 1, [`${list}.points`]: to - from }
}
