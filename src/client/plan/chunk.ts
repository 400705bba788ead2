// Pieces that lie near one another become chunks (one Read each) and runs (what scattered reading asks for).
import type { DeviceName } from '../../melsec/device/device'
import type { Area } from './area'
import type { Areas, Piece } from './layout'

/** Cells `from` to `to - 1` of an area, and what was joined to them. */
interface Joined<T> {
  readonly area: Area
  readonly from: number
  readonly to: number
  readonly members: readonly T[]
}

/** Cells in a row, every one of them asked for. */
export type Stretch = Joined<Piece>

/** Runs near enough to one another for one Read, which reads the cells between them in vain. */
export type Chunk = Joined<Stretch>

/** Reading them asks a module, which takes time there and may have an effect: only what is wanted is read. */
const IN_MODULES: readonly DeviceName[] = ['G', 'HG', 'DX', 'DY']

/**
 * Cells that may be read in vain between two runs.
 * @param gap words
 */
export function gapIn({ info, ways, kind, bitsPerCell }: Area, gap: number): number {
  if (ways.direct === undefined || IN_MODULES.includes(info.name)) return 0
  // In bit units a byte of the answer holds two bits, so four bits cost as much as a word.
  return kind === 'bit' ? 4 * gap : Math.floor((16 * gap) / bitsPerCell)
}

/** Sorted by address within each area. No chunk has more cells than one Read carries; no piece is cut. */
export function chunksOf(areas: Areas, pieces: readonly Piece[], gap: number): Chunk[] {
  const byArea = new Map<Area, Piece[]>()
  for (const piece of pieces) {
    const { area } = piece.layout
    const found = byArea.get(area)
    if (found === undefined) byArea.set(area, [piece])
    else found.push(piece)
  }
  return [...byArea].flatMap(([area, found]) => {
    found.sort((a, b) => a.from - b.from || a.to - b.to)
    const capacity = areas.capacity(area)
    return joined(area, joined(area, found, 0, capacity), gapIn(area, gap), capacity)
  })
}

/** Joins spans, sorted by their start, that are not further apart than `gap` and fit into `capacity` cells together. */
function joined<T extends { readonly from: number; readonly to: number }>(
  area: Area,
  spans: readonly T[],
  gap: number,
  capacity: number,
): Joined<T>[] {
  const found: { area: Area; from: number; to: number; members: T[] }[] = []
  for (const span of spans) {
    const last = found.at(-1)
    const to = last === undefined ? 0 : Math.max(last.to, span.to)
    if (last !== undefined && span.from - last.to <= gap && to - last.from <= capacity) {
      last.to = to
      last.members.push(span)
    } else found.push({ area, from: span.from, to: span.to, members: [span] })
  }
  return found
}
