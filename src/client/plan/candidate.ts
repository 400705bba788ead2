// The ways to read units of a cluster by one request, or by one entry of a list.
import { type Area, blockLoad, randomLoad } from './area'
import type { Cluster, Span, Unit } from './cluster'
import type { PackOptions } from './draft'
import type { Areas } from './layout'
import { type Bound, boundsOf, isWithin, type Load, type Sums, sumsOf } from './limit'
import type { Prices } from './price'

/** The commands whose requests hold runs of several places: Read Random and Read Block. */
export const LISTS = ['random', 'block'] as const
export type List = (typeof LISTS)[number]

/** A run as an entry of Read Random or a block of Read Block. */
export interface Entry {
  readonly price: number
  readonly sums: Sums
}

/** Units `from` to `to - 1` of a cluster, read together. */
export interface Candidate {
  readonly cluster: Cluster
  readonly from: number
  readonly to: number
  /** Price of a Read; infinite where there is none. */
  readonly direct: number
  /** The Read is in bit units. */
  readonly inBits: boolean
  readonly random: Entry | undefined
  readonly block: Entry | undefined
}

/** Of areas of one form. */
export type ListBounds = Readonly<Record<List, readonly Bound[]>>

/** Up to so many candidates rows may end anywhere. */
const MOST_CANDIDATES = 1 << 16

/** How long the widest row is that costs less in bit units: words are four characters, sixteen bits as many as they are. */
const WIDEST_IN_BITS = 2

/** Finds the candidates of clusters whose areas are of one form. */
export class Candidates {
  readonly #areas: Areas
  readonly #without: PackOptions['without']
  readonly #prices: Prices
  readonly #bounds: ListBounds

  constructor(areas: Areas, without: PackOptions['without'], prices: Prices, [first]: readonly Cluster[]) {
    const form = first?.[0]?.area.ways.form ?? 'short'
    this.#areas = areas
    this.#without = without
    this.#prices = prices
    this.#bounds = {
      random: boundsOf(areas.protocol, 'readRandom', form),
      block: boundsOf(areas.protocol, 'readBlock', form),
    }
  }

  get bounds(): ListBounds {
    return this.#bounds
  }

  /** By their first unit. A row begins where one before it may end. */
  of(cluster: Cluster): Candidate[] {
    const [first] = cluster
    if (first === undefined) return []
    const starts = new Set([0])
    const candidates: Candidate[] = []
    const ends = this.#endsIn(cluster, first)
    for (let from = 0; from < cluster.length; from++) {
      if (!starts.has(from)) continue
      for (const candidate of this.#from(cluster, from, ends)) {
        starts.add(candidate.to)
        candidates.push(candidate)
      }
    }
    return candidates
  }

  /**
   * A row that ends where it could go on is of use only where the cells between cost more than what the next row pays for being
   * one of its own: less than that in an entry of a list, or in bit units. Where one request does not hold the cluster, a
   * row may have to end elsewhere to leave room: everywhere is tried, unless that is too much.
   */
  #endsIn(cluster: Cluster, first: Unit): boolean[] {
    const { area, inBits } = first
    const capacity = this.#areas.capacity(area)
    const hull = (cluster.at(-1)?.to ?? 0) - first.from
    if (hull > capacity && cluster.length * Math.min(cluster.length, capacity) <= MOST_CANDIDATES) {
      return cluster.map(() => true)
    }
    const values = (cells: number) => this.#prices.values(area, cells)
    const savings = LISTS.filter((list) => this.#has(list, first)).map(
      (list) => this.#prices.list(list, area).run(1) - values(1),
    )
    const read = inBits === undefined ? Number.POSITIVE_INFINITY : inBits.head - values(WIDEST_IN_BITS)
    const enough = Math.min(read, ...savings)
    return cluster.map(({ to }, i) => {
      const gap = (cluster[i + 1]?.from ?? to) - to
      return gap > 0 && values(gap) > enough
    })
  }

  #has(list: List, { area, scatters }: Unit): boolean {
    if (list === 'random') return scatters
    return area.ways.block !== undefined && !this.#without.has('readBlock')
  }

  /** The rows that begin with a unit. */
  *#from(cluster: Cluster, from: number, ends: readonly boolean[]): Generator<Candidate> {
    const row = new Row(cluster, from)
    const capacity = this.#areas.capacity(row.area)
    for (let to = from + 1; to <= cluster.length; to++) {
      row.add(cluster[to - 1])
      const next = cluster[to]
      const isFull = next !== undefined && next.to - row.from > capacity
      const isStretch = row.isStretch && next !== undefined && next.from > row.to
      if (isFull || isStretch || next === undefined || ends[to - 1] === true) yield this.#candidate(row, to)
      if (isFull) return
    }
  }

  #candidate(row: Row, to: number): Candidate {
    const { cluster, first, from, area } = row
    const words = row.head + this.#prices.values(area, row.to - from)
    const bits = this.#bitPrice(row)
    const hasBlock = this.#has('block', first)
    return {
      cluster,
      from: row.unit,
      to,
      direct: Math.min(words, bits),
      inBits: bits < words,
      random: row.scatters && row.isStretch ? this.#entry('random', row) : undefined,
      block: hasBlock ? this.#entry('block', row) : undefined,
    }
  }

  #bitPrice({ bits, cells }: Row): number {
    if (bits === undefined || cells > WIDEST_IN_BITS) return Number.POSITIVE_INFINITY
    const { area, from, to, head } = bits
    return to - from > this.#areas.capacity(area)
      ? Number.POSITIVE_INFINITY
      : head + this.#prices.values(area, to - from)
  }

  #entry(list: List, { area, cells }: Row): Entry | undefined {
    const load: Load = list === 'random' ? randomLoad(area, cells) : blockLoad(area, cells)
    const sums = sumsOf(this.#bounds[list], load)
    return isWithin(this.#bounds[list], sums) ? { price: this.#prices.list(list, area).run(cells), sums } : undefined
  }
}

/** Units in a row, one after another. */
class Row {
  readonly area: Area
  readonly first: Unit
  readonly from: number
  to: number
  head = 0
  isStretch = true
  scatters = true
  bits: Omit<Span, 'pieces'> | undefined

  constructor(
    readonly cluster: Cluster,
    /** Its first unit. */
    readonly unit: number,
  ) {
    const first = cluster[unit]
    if (first === undefined) throw new Error('a row of nothing')
    this.first = first
    this.area = first.area
    this.from = first.from
    this.to = first.from
    this.bits = first.inBits
  }

  get cells(): number {
    return this.to - this.from
  }

  add(unit: Unit | undefined): void {
    if (unit === undefined) return
    this.isStretch &&= unit.from <= this.to
    this.scatters &&= unit.scatters
    this.head = Math.max(this.head, unit.head)
    this.to = unit.to
    this.bits = together(this.bits, unit.inBits)
  }
}

function together(a: Omit<Span, 'pieces'> | undefined, b: Span | undefined): Omit<Span, 'pieces'> | undefined {
  if (a === undefined || b === undefined) return undefined
  const { area } = a
  return { area, from: Math.min(a.from, b.from), to: Math.max(a.to, b.to), head: Math.max(a.head, b.head) }
}
