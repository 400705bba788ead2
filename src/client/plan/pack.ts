/**
 * Which requests read a set of pieces: fewest requests, then fewest bytes; on a serial line the fewest bytes (cheapest.ts).
 *
 * Chunks can be read by one Read (0401) each; their runs can share a Read Random (0403), which counts points, or a Read
 * Block (0406), which counts blocks and words. Three ways to distribute them are drawn up and the best one is taken.
 */
import type { CommandName } from '../../melsec/commands/commands'
import { blockLoad, groupOf, randomLoad } from './area'
import { cheapest } from './cheapest'
import { type Chunk, chunksOf, type Stretch } from './chunk'
import { type BodyBytes, type Draft, firstItem, inOrder, least, type PackOptions, sortedBy } from './draft'
import type { Areas, Piece } from './layout'
import {
  addSums,
  type Bound,
  boundsOf,
  fewestFor,
  firstFit,
  isWithin,
  type Load,
  type PlanProtocol,
  type Sums,
  sumsOf,
  weightOf,
} from './limit'
import { Prices } from './price'

/** The requests that read the pieces. Areas of different groups never share one. */
export function packed(areas: Areas, pieces: readonly Piece[], options: PackOptions, bytes: BodyBytes): Draft[] {
  const { lineCost } = areas.protocol
  if (lineCost !== undefined)
    return inOrder(cheapest(areas, pieces, options, new Prices(bytes, lineCost.read, areas.protocol.code)))
  const groups = new Map<string, Chunk[]>()
  for (const chunk of chunksOf(areas, pieces, options.gap)) {
    const group = groupOf(chunk.area)
    const chunks = groups.get(group)
    if (chunks === undefined) groups.set(group, [chunk])
    else chunks.push(chunk)
  }
  return inOrder(
    [...groups.values()].flatMap((chunks) => best(plansOf(areas.protocol, chunks, options.without), bytes)),
  )
}

function best(plans: readonly (readonly Draft[])[], bytes: BodyBytes): readonly Draft[] {
  const fewest = Math.min(...plans.map((plan) => plan.length))
  const short = plans.filter((plan) => plan.length === fewest)
  const [first = [], ...others] = short
  if (others.length === 0) return first
  const total = (plan: readonly Draft[]) => plan.reduce((sum, draft) => sum + bytes(draft), 0)
  return others.reduce((a, b) => (total(b) < total(a) ? b : a), first)
}

function plansOf(protocol: PlanProtocol, chunks: readonly Chunk[], without: PackOptions['without']): Draft[][] {
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

/** What runs come to in the bounds of one command: each is weighed once, however many plans it is in. */
class Scale {
  readonly #known = new Map<Stretch, Sums>()

  constructor(
    readonly bounds: readonly Bound[],
    readonly loadOf: (run: Stretch) => Load,
  ) {}

  of(run: Stretch): Sums {
    let sums = this.#known.get(run)
    if (sums === undefined) {
      sums = sumsOf(this.bounds, this.loadOf(run))
      this.#known.set(run, sums)
    }
    return sums
  }

  fits(run: Stretch): boolean {
    return isWithin(this.bounds, this.of(run))
  }

  ofAll(runs: readonly Stretch[]): number[] {
    const sums = this.bounds.map(() => 0)
    for (const run of runs) addSums(sums, this.of(run))
    return sums
  }
}

/** Whether Read Random can read all of a chunk. */
function scatters({ area, members }: Chunk, scale: Scale): boolean {
  if (area.ways.random === undefined) return false
  return members.every((run) => scale.fits(run) && run.members.every(({ layout }) => !layout.directOnly))
}

/**
 * The heaviest chunks get a Read each and the others share Read Randoms: as many of them as makes the fewest requests.
 * @returns the plans with the fewest and the most Reads among those with the fewest requests
 */
function byRandom(bounds: readonly Bound[], chunks: readonly Chunk[]): Draft[][] {
  const scale = new Scale(bounds, runLoad)
  const must: Chunk[] = []
  const may: { readonly chunk: Chunk; readonly sums: Sums; readonly weight: number }[] = []
  const always: Chunk[] = []
  for (const chunk of chunks) {
    if (chunk.area.ways.direct === undefined) must.push(chunk)
    else if (scatters(chunk, scale)) {
      const sums = scale.ofAll(chunk.members)
      may.push({ chunk, sums, weight: weightOf(sums, bounds) })
    } else always.push(chunk)
  }
  may.sort((a, b) => b.weight - a.weight)
  // requests[n]: how many there are when the n heaviest chunks are read directly
  const left = scale.ofAll(must.flatMap(({ members }) => members))
  const requests = [may.length + fewestFor(bounds, left)]
  for (let n = may.length - 1; n >= 0; n--) {
    addSums(left, may[n]?.sums ?? [])
    requests.push(n + fewestFor(bounds, left))
  }
  requests.reverse()
  const fewest = least(requests)
  const choices = new Set([requests.indexOf(fewest), requests.lastIndexOf(fewest)])
  const heaviest = may.map(({ chunk }) => chunk)
  return [...choices].map((n) => [
    ...[...always, ...heaviest.slice(0, n)].map(direct),
    ...distributed('random', parcelsOf([...must, ...heaviest.slice(n)]), scale),
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

/** As few requests as hold all parcels. One that turns out to hold one chunk only is a Read: that is what Read is for. */
function distributed(kind: 'random' | 'block', parcels: readonly Parcel[], scale: Scale): Draft[] {
  const size = new Map<Chunk, number>()
  for (const { chunk } of parcels) size.set(chunk, (size.get(chunk) ?? 0) + 1)
  return firstFit(parcels, ({ run }) => scale.of(run), scale.bounds).map((bin): Draft => {
    const chunk = bin[0]?.chunk
    if (chunk?.area.ways.direct !== undefined && bin.length === size.get(chunk)) {
      if (bin.every((parcel) => parcel.chunk === chunk)) return direct(chunk)
    }
    const runs = bin.map(({ run }) => run)
    return { kind, runs: sortedBy(runs, firstItem) }
  })
}

/** Blocks as large as the chunks, and blocks as small as the runs; what goes into no block is read as otherwise. */
function byBlock(protocol: PlanProtocol, chunks: readonly Chunk[], without: ReadonlySet<CommandName>): Draft[][] {
  const blocks = chunks.filter(({ area }) => area.ways.block !== undefined)
  const first = blocks[0]
  if (first === undefined) return []
  const scale = new Scale(boundsOf(protocol, 'readBlock', first.area.ways.form), ({ area, from, to }) =>
    blockLoad(area, to - from),
  )
  const others = chunks.filter(({ area }) => area.ways.block === undefined)
  const otherPlans = others.length === 0 ? [[]] : plansOf(protocol, others, new Set([...without, 'readBlock']))
  const whole = blocks.map((chunk): Parcel => ({ run: wholeOf(chunk), chunk }))
  // Chunks of one run each are as large as their runs.
  const sizes = blocks.every(({ members }) => members.length === 1) ? [whole] : [whole, parcelsOf(blocks)]
  return sizes.flatMap((parcels) => {
    const large = parcels.filter(({ run }) => !scale.fits(run)).map(({ run }): Draft => ({ kind: 'direct', run }))
    const fitting = parcels.filter(({ run }) => scale.fits(run))
    const drafts = [...large, ...distributed('block', fitting, scale)]
    return otherPlans.map((plan) => [...drafts, ...plan])
  })
}

function wholeOf({ area, from, to, members }: Chunk): Stretch {
  const [only] = members
  if (members.length === 1 && only !== undefined) return only
  return { area, from, to, members: members.flatMap((run) => run.members) }
}
