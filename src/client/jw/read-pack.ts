/**
 * Which requests read some pieces: as few as there can be, and of as few those with the fewest lists.
 *
 * A row takes pieces that follow one another, and the further it goes the better. So for each space the least bytes that are left
 * to lists are known for each number of rows, and with them how many requests all spaces need together.
 */
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

/** The requests for some pieces, as the first of their items were given. */
export function jwPacked(pieces: readonly JwPiece[], options: JwPackOptions): JwDraft[] {
  const { rows, scattered } = options.lists ? shared(pieces, options) : { rows: alone(pieces, options), scattered: [] }
  const drafts: JwDraft[] = [
    ...rows.map((run) => ({ kind: 'row', run }) as const),
    ...binned(scattered, options.limits.readRegisters).map((own) => listOf(own)),
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

/** Cells in a row that one request reads. */
export function jwCapacity(limits: JwLimits, space: JwSpace): number {
  if (space.in === 'timer') return limits.readTimers
  return space.in === 'system' ? limits.readSystem : limits.readBytes
}

function bySpace(pieces: readonly JwPiece[]): Map<JwSpace, JwPiece[]> {
  const found = new Map<JwSpace, JwPiece[]>()
  for (const piece of pieces) {
    const own = found.get(piece.layout.space)
    if (own === undefined) found.set(piece.layout.space, [piece])
    else own.push(piece)
  }
  for (const own of found.values()) own.sort((a, b) => a.from - b.from || a.to - b.to)
  return found
}

/** All in rows. */
function alone(pieces: readonly JwPiece[], options: JwPackOptions): JwRun[] {
  return [...bySpace(pieces)].flatMap(([space, own]) => {
    const rows: JwRun[] = []
    for (let at = 0; at < own.length; ) {
      const end = reach(space, own, at, options)
      rows.push(runOf(space, own.slice(at, end)))
      at = end
    }
    return rows
  })
}

/** How far a row goes that begins with a piece: the index behind its last one. */
function reach(space: JwSpace, sorted: readonly JwPiece[], at: number, { limits, gap }: JwPackOptions): number {
  const inVain = space.in === 'timer' ? Math.floor(gap / TIMER_BYTES) : gap
  const capacity = jwCapacity(limits, space)
  const from = sorted[at]?.from ?? 0
  let to = sorted[at]?.to ?? 0
  let end = at + 1
  for (let piece = sorted[end]; piece !== undefined; piece = sorted[end]) {
    const longer = Math.max(to, piece.to)
    if (piece.from - to > inVain || longer - from > capacity) break
    to = longer
    end++
  }
  return end
}

function runOf(space: JwSpace, pieces: readonly JwPiece[]): JwRun {
  const from = Math.min(...pieces.map((piece) => piece.from))
  return { space, from, to: Math.max(...pieces.map((piece) => piece.to)), pieces }
}

/** Pieces that are looked at together: the time that it takes grows with their square. */
const BLOCK = 512

/** What stands for a number of bytes that cannot be. */
const NEVER = 0xffff_ffff

/** For some pieces of one space in their order, and each number of rows: the least bytes that are left to lists. */
class Block {
  readonly #space: JwSpace
  readonly #sorted: readonly JwPiece[]
  /** Behind the last piece of a row that begins with a piece. */
  readonly #ends: readonly number[]
  /** Behind all that comes before a piece. */
  readonly #before: readonly number[]
  readonly #most: number
  /** By piece and rows: the least bytes from this piece on. */
  readonly #bytes: Uint32Array

  constructor(space: JwSpace, sorted: readonly JwPiece[], options: JwPackOptions) {
    this.#space = space
    this.#sorted = sorted
    this.#ends = sorted.map((_, at) => reach(space, sorted, at, options))
    let behind = 0
    this.#before = sorted.map(({ to }) => {
      const before = behind
      behind = Math.max(behind, to)
      return before
    })
    this.#most = this.#fewestRows()
    this.#bytes = new Uint32Array((sorted.length + 1) * (this.#most + 1)).fill(NEVER)
    this.#bytes[this.#at(sorted.length, 0)] = 0
    for (let at = sorted.length - 1; at >= 0; at--) {
      for (let rows = 0; rows <= this.#most; rows++) {
        this.#bytes[this.#at(at, rows)] = Math.min(this.#inRow(at, rows), this.#inList(at, rows, options))
      }
    }
  }

  #at(piece: number, rows: number): number {
    return piece * (this.#most + 1) + rows
  }

  #least(piece: number, rows: number): number {
    return this.#bytes[this.#at(piece, rows)] ?? NEVER
  }

  #fewestRows(): number {
    let rows = 0
    for (let at = 0; at < this.#sorted.length; at = this.#ends[at] ?? this.#sorted.length) rows++
    return rows
  }

  #inRow(at: number, rows: number): number {
    return rows === 0 ? NEVER : this.#least(this.#ends[at] ?? 0, rows - 1)
  }

  #inList(at: number, rows: number, { limits }: JwPackOptions): number {
    const piece = this.#sorted[at]
    const after = this.#least(at + 1, rows)
    if (piece === undefined || after === NEVER || this.#space.in !== 'file') return NEVER
    if (piece.to - piece.from > limits.readRegisters) return NEVER
    // Of pieces that lie over one another a list has each byte once.
    return after + Math.max(0, piece.to - Math.max(piece.from, this.#before[at] ?? 0))
  }

  /** By the number of rows. */
  get leastBytes(): readonly number[] {
    return Array.from({ length: this.#most + 1 }, (_, rows) => this.#least(0, rows))
  }

  /** What is in so many rows, and what is left. */
  take(rows: number, into: { readonly rows: JwRun[]; readonly left: JwPiece[] }): void {
    let left = rows
    for (let at = 0; at < this.#sorted.length; ) {
      const piece = this.#sorted[at]
      if (piece === undefined) return
      if (this.#inRow(at, left) === this.#least(at, left)) {
        const end = this.#ends[at] ?? at + 1
        into.rows.push(runOf(this.#space, this.#sorted.slice(at, end)))
        left--
        at = end
      } else {
        into.left.push(piece)
        at++
      }
    }
  }
}

function blocksOf(pieces: readonly JwPiece[], options: JwPackOptions): Block[] {
  return [...bySpace(pieces)].flatMap(([space, sorted]) => {
    const blocks: Block[] = []
    for (let at = 0; at < sorted.length; ) {
      let end = at
      while (end < sorted.length && end - at < BLOCK) end = reach(space, sorted, end, options)
      blocks.push(new Block(space, sorted.slice(at, end), options))
      at = end
    }
    return blocks
  })
}

/** So many rows of some blocks together. */
interface Sum {
  readonly bytes: number
  readonly rows: number
  /** Rows of the last block, and what the ones before it have. */
  readonly own: number
  readonly before: Sum | undefined
}

/** Rows, and pieces that share lists. */
function shared(pieces: readonly JwPiece[], options: JwPackOptions) {
  const capacity = options.limits.readRegisters
  const blocks = blocksOf(pieces, options)
  let sums: Sum[] = [{ bytes: 0, rows: 0, own: 0, before: undefined }]
  const choices = blocks.map(({ leastBytes }) => leastBytes)
  const most = upperBound(choices, capacity)
  for (const leastBytes of choices) sums = added(sums, leastBytes, most)
  const ranked = sums
    .map((sum) => ({ sum, least: sum.rows + Math.ceil(sum.bytes / capacity) }))
    .sort((a, b) => a.least - b.least || b.sum.rows - a.sum.rows)
  let best: ReturnType<typeof taken> | undefined
  let fewest = Number.POSITIVE_INFINITY
  for (const { sum, least } of ranked) {
    if (least >= fewest) break
    const found = taken(blocks, sum)
    const requests = found.rows.length + binned(found.scattered, capacity).length
    if (requests >= fewest) continue
    fewest = requests
    best = found
  }
  if (best === undefined) throw new Error('pieces that no request reads')
  return best
}

/** Requests that are enough for sure: all in rows, or as much as can be in lists, each but the last more than half full on average. */
function upperBound(choices: readonly (readonly number[])[], capacity: number): number {
  const rows = choices.reduce((sum, leastBytes) => sum + leastBytes.length - 1, 0)
  let fewest = 0
  let bytes = 0
  for (const leastBytes of choices) {
    const own = leastBytes.findIndex((least) => least !== NEVER)
    fewest += own
    bytes += leastBytes[own] ?? 0
  }
  return Math.min(rows, fewest + Math.floor((2 * bytes) / capacity) + 1)
}

function added(sums: readonly Sum[], leastBytes: readonly number[], most: number): Sum[] {
  const found: (Sum | undefined)[] = []
  for (const before of sums) {
    leastBytes.forEach((more, own) => {
      const rows = before.rows + own
      const bytes = before.bytes + more
      if (rows <= most && more !== NEVER && bytes < (found[rows]?.bytes ?? NEVER))
        found[rows] = { bytes, rows, own, before }
    })
  }
  return found.filter((sum) => sum !== undefined)
}

function taken(blocks: readonly Block[], sum: Sum): { readonly rows: JwRun[]; readonly scattered: JwPiece[] } {
  const rows: JwRun[] = []
  const left: JwPiece[] = []
  let at: Sum | undefined = sum
  for (const block of [...blocks].reverse()) {
    block.take(at?.own ?? 0, { rows, left })
    at = at?.before
  }
  return { rows, scattered: left }
}

/** Pieces that share a list, for each list: the largest first. What lies over one another stays together where it can. */
function binned(pieces: readonly JwPiece[], capacity: number): JwPiece[][] {
  const lists: { pieces: JwPiece[]; bytes: number }[] = []
  const groups = runsOf(pieces, 0).flatMap((run) =>
    run.to - run.from <= capacity ? [run] : run.pieces.map((piece) => runOf(run.space, [piece])),
  )
  for (const { pieces: own, from, to } of groups.sort((a, b) => b.to - b.from - (a.to - a.from))) {
    const list = lists.find(({ bytes }) => bytes + to - from <= capacity)
    if (list === undefined) lists.push({ pieces: [...own], bytes: to - from })
    else {
      list.pieces.push(...own)
      list.bytes += to - from
    }
  }
  return lists.map((list) => list.pieces)
}

/** Without anything that is read in vain. @param beside 1: what lies beside one another is one run, too */
function runsOf(pieces: readonly JwPiece[], beside: 0 | 1): JwRun[] {
  return [...bySpace(pieces)].flatMap(([space, own]) => {
    const found: { space: JwSpace; from: number; to: number; pieces: JwPiece[] }[] = []
    for (const piece of own) {
      const last = found.at(-1)
      if (last !== undefined && piece.from < last.to + beside) {
        last.to = Math.max(last.to, piece.to)
        last.pieces.push(piece)
      } else found.push({ space, from: piece.from, to: piece.to, pieces: [piece] })
    }
    return found
  })
}

/** A list of one row is a row: so the manual shows it. */
function listOf(pieces: readonly JwPiece[]): JwDraft {
  const runs = runsOf(pieces, 1)
  const [only] = runs
  return runs.length === 1 && only !== undefined ? { kind: 'row', run: only } : { kind: 'list', runs }
}
