// Pieces of one area so near to one another that one Read may read several of them in vain of what lies between.
import type { Area } from './area'
import { gapIn, type Stretch } from './chunk'
import type { PackOptions } from './draft'
import type { Areas, Piece } from './layout'
import type { Prices } from './price'

/** Cells in a row, and what is wanted of them. */
export interface Span {
  readonly area: Area
  readonly from: number
  readonly to: number
  readonly pieces: readonly Piece[]
  /** Price of a Read without the values. */
  readonly head: number
}

/** A piece, and those that lie within it: they cost nothing more. */
export interface Unit extends Span {
  /** Whether Read Random can read it. */
  readonly scatters: boolean
  /** The same in bit units, with nothing beside it. */
  readonly inBits: Span | undefined
}

/** By address; none lies within another. */
export type Cluster = readonly Unit[]

export function clustersOf(areas: Areas, pieces: readonly Piece[], options: PackOptions, prices: Prices): Cluster[] {
  const byArea = new Map<Area, Piece[]>()
  for (const piece of pieces) {
    const found = byArea.get(piece.layout.area)
    if (found === undefined) byArea.set(piece.layout.area, [piece])
    else found.push(piece)
  }
  return [...byArea].flatMap(([area, found]) => {
    const units = nested(found).map((own) => unitOf(areas, area, own, options, prices))
    return near(units, gapIn(area, options.gap), prices)
  })
}

/** The pieces that no other one holds, each with those that it holds. */
function nested(pieces: Piece[]): Piece[][] {
  pieces.sort((a, b) => a.from - b.from || b.to - a.to)
  const found: Piece[][] = []
  let end = Number.NEGATIVE_INFINITY
  for (const piece of pieces) {
    if (piece.to <= end) found.at(-1)?.push(piece)
    else {
      found.push([piece])
      end = piece.to
    }
  }
  return found
}

function unitOf(areas: Areas, area: Area, pieces: readonly Piece[], options: PackOptions, prices: Prices): Unit {
  const { ways } = area
  // Without Read Random, what only it can read is asked for all the same: the PLC says no, not this program.
  const mayScatter = ways.direct === undefined || !options.without.has('readRandom')
  return {
    ...spanOf(area, pieces, prices),
    scatters: ways.random !== undefined && mayScatter && !pieces.some(({ layout }) => layout.directOnly),
    inBits: exactly(areas, area, pieces, options, prices),
  }
}

function spanOf(area: Area, pieces: readonly Piece[], prices: Prices): Span {
  let from = Number.POSITIVE_INFINITY
  let to = Number.NEGATIVE_INFINITY
  for (const piece of pieces) {
    from = Math.min(from, piece.from)
    to = Math.max(to, piece.to)
  }
  const isRead = area.ways.direct !== undefined
  return { area, from, to, pieces, head: isRead ? headOf(area, from, to, prices) : Number.POSITIVE_INFINITY }
}

function headOf(area: Area, from: number, to: number, prices: Prices): number {
  const first = prices.direct(area, from)
  return to - from === 1 ? first : Math.max(first, prices.direct(area, to - 1))
}

function exactly(
  areas: Areas,
  { kind, info }: Area,
  pieces: readonly Piece[],
  { exact }: PackOptions,
  prices: Prices,
): Span | undefined {
  if (kind !== 'word' || info.unit !== 'bit') return undefined
  const found = pieces.map(exact).filter((piece) => piece !== undefined)
  const [first] = found
  if (first === undefined || found.length < pieces.length) return undefined
  const span = spanOf(first.layout.area, found, prices)
  return span.to - span.from <= areas.capacity(span.area) ? span : undefined
}

/** Cut where cells in vain would cost more than another request, or are not allowed. */
function near(units: readonly Unit[], gap: number, prices: Prices): Unit[][] {
  const found: Unit[][] = []
  let end = Number.NEGATIVE_INFINITY
  for (const unit of units) {
    const last = found.at(-1)
    const between = unit.from - end
    const isNear = between <= 0 || (between <= gap && prices.values(unit.area, between) <= unit.head + ONE_VALUE)
    if (last !== undefined && isNear) last.push(unit)
    else found.push([unit])
    end = unit.to
  }
  return found
}

/** A Read has one value at least, and heads differ by two characters at most. */
const ONE_VALUE = 8

/** Units `from` to `to - 1` as one run. */
export function runOf(cluster: Cluster, from: number, to: number, inBits: boolean): Stretch {
  const units = cluster.slice(from, to)
  const spans = inBits ? units.map((unit) => unit.inBits).filter((span) => span !== undefined) : units
  const [first] = spans
  if (first === undefined) throw new Error('a run of nothing')
  return {
    area: first.area,
    from: Math.min(...spans.map((span) => span.from)),
    to: Math.max(...spans.map((span) => span.to)),
    members: spans.flatMap(({ pieces }) => pieces),
  }
}
