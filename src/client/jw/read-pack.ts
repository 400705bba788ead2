// Which requests read some pieces: as few as there can be, with as little read in vain.
import type { JwPiece, JwSpace } from './layout'
import type { JwLimits } from './limits'
import type { JwDraft, JwRun } from './read-request'

export interface JwPackOptions {
  readonly limits: JwLimits
  /** Bytes that may be read in vain between two pieces to read them by one request. */
  readonly gap: number
  /** Whether scattered pieces may share a request. */
  readonly lists: boolean
}

/** Bytes of an answer that one number takes: its word and its attribute. */
const TIMER_BYTES = 3

/**
 * The requests for some pieces, as the first of their items were given.
 *
 * Pieces that are near one another become one row. Of several rows those with the fewest bytes share a list: each that joins
 * one saves a request.
 */
export function jwPacked(pieces: readonly JwPiece[], options: JwPackOptions): JwDraft[] {
  const rows = rowsOf(pieces, options)
  const { readRegisters } = options.limits
  const mayShare = options.lists && readRegisters > 1
  const lists = mayShare ? listsOf(rows, readRegisters) : []
  const shared = new Set(lists.flat())
  const drafts: JwDraft[] = [
    ...rows.filter((row) => !shared.has(row)).map((run) => ({ kind: 'row', run }) as const),
    ...lists.map((runs) => ({ kind: 'list', runs: runs.flatMap(tight) }) as const),
  ]
  return drafts
    .map((draft) => ({ draft, first: firstItem(draft) }))
    .sort((a, b) => a.first - b.first)
    .map(({ draft }) => draft)
}

function firstItem(draft: JwDraft): number {
  const runs = draft.kind === 'row' ? [draft.run] : draft.runs
  return Math.min(...runs.map(({ pieces }) => Math.min(...pieces.map(({ item }) => item))))
}

function rowsOf(pieces: readonly JwPiece[], { limits, gap }: JwPackOptions): JwRun[] {
  const bySpace = new Map<JwSpace, JwPiece[]>()
  for (const piece of pieces) {
    const found = bySpace.get(piece.layout.space)
    if (found === undefined) bySpace.set(piece.layout.space, [piece])
    else found.push(piece)
  }
  return [...bySpace].flatMap(([space, own]) => {
    const inVain = space.in === 'timer' ? Math.floor(gap / TIMER_BYTES) : gap
    return joined(space, own, inVain, jwCapacity(limits, space))
  })
}

/** Cells in a row that one request reads. */
export function jwCapacity(limits: JwLimits, space: JwSpace): number {
  if (space.in === 'timer') return limits.readTimers
  return space.in === 'system' ? limits.readSystem : limits.readBytes
}

function joined(space: JwSpace, pieces: readonly JwPiece[], gap: number, capacity: number): JwRun[] {
  const sorted = [...pieces].sort((a, b) => a.from - b.from || a.to - b.to)
  const found: { space: JwSpace; from: number; to: number; pieces: JwPiece[] }[] = []
  for (const piece of sorted) {
    const last = found.at(-1)
    const to = last === undefined ? 0 : Math.max(last.to, piece.to)
    if (last !== undefined && piece.from - last.to <= gap && to - last.from <= capacity) {
      last.to = to
      last.pieces.push(piece)
    } else found.push({ space, from: piece.from, to: piece.to, pieces: [piece] })
  }
  return found
}

/** The rows of a row without what it would read in vain. */
function tight({ space, pieces }: JwRun): JwRun[] {
  return joined(space, pieces, 0, Number.POSITIVE_INFINITY)
}

function wanted(row: JwRun): number {
  return tight(row).reduce((sum, { from, to }) => sum + to - from, 0)
}

/** Rows that share a list, for each list: those with the fewest bytes first, so that most of them have room. */
function listsOf(rows: readonly JwRun[], capacity: number): JwRun[][] {
  const small = rows
    .filter(({ space }) => space.in === 'file')
    .map((row) => ({ row, bytes: wanted(row) }))
    .filter(({ bytes }) => bytes <= capacity)
    .sort((a, b) => a.bytes - b.bytes)
  const lists: { rows: JwRun[]; bytes: number }[] = []
  for (const { row, bytes } of small) {
    const last = lists.find((list) => list.bytes + bytes <= capacity)
    if (last === undefined) lists.push({ rows: [row], bytes })
    else {
      last.rows.push(row)
      last.bytes += bytes
    }
  }
  return lists.filter((list) => list.rows.length > 1).map((list) => list.rows)
}
