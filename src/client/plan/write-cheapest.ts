/**
 * Which units share a request on a serial line: the fewest characters, then the fewest requests. The order in which they were
 * given is kept, and nothing is written that was not given.
 */
import { RequestError } from '../../errors'
import { type Area, addressAt, isExtended } from './area'
import type { Areas } from './layout'
import { added, boundsOf, fits, type Load, type PlanProtocol } from './limit'
import { type Batch, batchesOf, loadOf, mayShare, randomFits, rowFits } from './write-batch'
import { type EntryPrice, noEntry, WritePrices } from './write-price'
import type { WriteUnit } from './write-unit'

/** A request, and what it costs. */
interface Priced {
  readonly batch: Omit<Batch, 'units'>
  readonly price: number
}

/** A way to the units so far. */
interface Way {
  readonly price: number
  readonly requests: number
  /** The last request, and where it begins. */
  readonly last: Batch | undefined
  readonly from: number
}

/** @param request bytes of a request and its answer around their bodies */
export function cheapestBatches(areas: Areas, units: readonly WriteUnit[], request: number): Batch[] {
  const finder = new Finder(areas, request)
  const best: (Way | undefined)[] = [{ price: 0, requests: 0, last: undefined, from: 0 }]
  units.forEach((unit, from) => {
    const before = best[from]
    if (before === undefined) return
    const offer = (to: number, batch: Batch, own: number) => {
      const way: Way = { price: before.price + own, requests: before.requests + 1, last: batch, from }
      if (isBetter(way, best[to])) best[to] = way
    }
    if (unit.content.kind === 'masked') {
      const [batch] = batchesOf(areas.protocol, units.slice(from))
      if (batch !== undefined) offer(from + batch.units.length, batch, request)
    } else
      finder.each(units, from, (to, { batch, price }) => offer(to, { ...batch, units: units.slice(from, to) }, price))
  })
  return batchesTo(best, units.length)
}

function isBetter(way: Way, known: Way | undefined): boolean {
  if (known === undefined) return true
  return way.price < known.price || (way.price === known.price && way.requests < known.requests)
}

function batchesTo(best: readonly (Way | undefined)[], end: number): Batch[] {
  const batches: Batch[] = []
  for (let at = end; at > 0; ) {
    const way = best[at]
    if (way?.last === undefined) throw new Error('a unit that no request writes')
    batches.push(way.last)
    at = way.from
  }
  return batches.reverse()
}

/** Cells in a row, wherever they came in the order. */
interface Run {
  readonly area: Area
  readonly from: number
  readonly to: number
}

/** Units of one request so far. */
interface Growing {
  readonly first: WriteUnit
  runs: readonly Run[]
  cells: number
  /** Price of a Write without the values, whatever of it is the longest. */
  head: number
  /** Of one area, as few as a Write carries, even if they are no row yet. */
  mayBeRow: boolean
  load: Load | undefined
  entry: EntryPrice
  mayBeBlocks: boolean
}

class Finder {
  readonly #areas: Areas
  readonly #protocol: PlanProtocol
  readonly #prices: WritePrices
  readonly #known = new Map<Area, { readonly random: number; readonly block: ReturnType<WritePrices['block']> }>()

  constructor(areas: Areas, request: number) {
    this.#areas = areas
    this.#protocol = areas.protocol
    this.#prices = new WritePrices(areas.protocol, request)
  }

  /** Every request that begins with a unit. */
  each(units: readonly WriteUnit[], from: number, use: (to: number, priced: Priced) => void): void {
    const [first] = units.slice(from, from + 1)
    if (first === undefined) return
    const growing = this.#opened(first)
    for (let to = from; to < units.length; to++) {
      const unit = units[to]
      if (unit === undefined || (to > from && !mayShare(first, unit))) return
      if (!this.#add(growing, unit)) return
      const priced = this.#cheapest(growing)
      if (priced !== undefined) use(to + 1, priced)
    }
  }

  #opened(first: WriteUnit): Growing {
    const { ways } = first.area
    return {
      first,
      runs: [],
      cells: 0,
      head: 0,
      mayBeRow: ways.direct !== undefined,
      load: ways.random === undefined ? undefined : {},
      entry: noEntry,
      mayBeBlocks: true,
    }
  }

  /** Whether any command may still take all of them. */
  #add(growing: Growing, unit: WriteUnit): boolean {
    const { area, from, to } = unit
    growing.runs = withRun(growing.runs, { area, from, to })
    growing.cells += to - from
    growing.mayBeRow &&= area === growing.first.area && rowFits(this.#protocol, area, growing.cells)
    if (growing.mayBeRow) {
      growing.head = Math.max(growing.head, this.#prices.direct(area, from), this.#prices.direct(area, to - 1))
    }
    const load = growing.load && added(growing.load, loadOf(unit))
    growing.load = load && randomFits(this.#protocol, unit, load) ? load : undefined
    if (growing.load !== undefined) growing.entry = longest(growing.entry, this.#entries(unit))
    growing.mayBeBlocks &&= this.#fitsBlock(area, growing.runs)
    return growing.mayBeRow || growing.load !== undefined || growing.mayBeBlocks
  }

  #fitsBlock(area: Area, runs: readonly Run[]): boolean {
    return area.ways.block !== undefined && fits(boundsOf(this.#protocol, 'writeBlock', area.ways.form), blocksOf(runs))
  }

  /** Its first and its last address: the longer of them counts. */
  #entries({ area, from, to }: WriteUnit): EntryPrice {
    const request = this.#requests(area).random
    const first = this.#prices.entry(area, from, request)
    return to - from === 1 ? first : longest(first, this.#prices.entry(area, to - 1, request))
  }

  /** Of requests with nothing in them. */
  #requests(area: Area) {
    let found = this.#known.get(area)
    if (found === undefined) {
      const { random, block } = area.ways
      found = {
        random: random === undefined ? 0 : this.#prices.random(area),
        block: block === undefined ? { request: 0, block: 0 } : this.#prices.block(area),
      }
      this.#known.set(area, found)
    }
    return found
  }

  #cheapest(growing: Growing): Priced | undefined {
    const ways = [this.#direct(growing), this.#random(growing), this.#block(growing)].filter((way) => way !== undefined)
    return ways.reduce<Priced | undefined>((a, b) => (a === undefined || b.price < a.price ? b : a), undefined)
  }

  #direct({ first, runs, head, cells, mayBeRow, load }: Growing): Priced | undefined {
    const [run, ...others] = runs
    // A device of two words is one double word to Write Random: the way every family has.
    const isRecord = first.area.kind === 'record' && load !== undefined
    if (run === undefined || others.length > 0 || !mayBeRow || isRecord) return undefined
    const price = head + this.#prices.values(first.area, cells)
    const inWords = this.#inWords(run)
    return inWords !== undefined && inWords.price < price ? inWords : { batch: { kind: 'direct' }, price }
  }

  /** Sixteen bits from a multiple of sixteen on are a word, and nothing but these bits is in it. */
  #inWords({ area, from, to }: Run): Priced | undefined {
    const { kind, info } = area
    const isWhole = from % 16 === 0 && to % 16 === 0
    if (kind !== 'bit' || !isWhole || info.group !== undefined || isExtended(area.template)) return undefined
    const words = this.#wordArea(area, from)
    const cells = (to - from) / 16
    if (words === undefined || !rowFits(this.#protocol, words, cells)) return undefined
    const head = Math.max(this.#prices.direct(words, from / 16), this.#prices.direct(words, to / 16 - 1))
    return { batch: { kind: 'direct', words }, price: head + this.#prices.values(words, cells) }
  }

  #wordArea(area: Area, cell: number): Area | undefined {
    try {
      return this.#areas.find('word', addressAt(area, cell))
    } catch (error) {
      if (error instanceof RequestError) return undefined
      throw error
    }
  }

  #random({ first, load, entry }: Growing): Priced | undefined {
    if (load === undefined) return undefined
    const { bits = 0, words = 0, doubleWords = 0 } = load
    const entries = bits * entry.bit + words * entry.word + doubleWords * entry.doubleWord
    return { batch: { kind: 'random' }, price: this.#requests(first.area).random + entries }
  }

  #block({ first, runs, mayBeBlocks }: Growing): Priced | undefined {
    if (!mayBeBlocks) return undefined
    const { request, block } = this.#requests(first.area).block
    const price = runs.reduce((sum, run) => sum + block + this.#prices.values(run.area, run.to - run.from), request)
    return { batch: { kind: 'block' }, price }
  }
}

function longest(a: EntryPrice, b: EntryPrice): EntryPrice {
  return {
    bit: Math.max(a.bit, b.bit),
    word: Math.max(a.word, b.word),
    doubleWord: Math.max(a.doubleWord, b.doubleWord),
  }
}

/** Runs of neighbours become one. */
function withRun(runs: readonly Run[], run: Run): readonly Run[] {
  const isBeside = (other: Run) => other.area === run.area && (other.to === run.from || run.to === other.from)
  const beside = runs.filter(isBeside)
  if (beside.length === 0) return [...runs, run]
  const from = Math.min(run.from, ...beside.map((other) => other.from))
  const to = Math.max(run.to, ...beside.map((other) => other.to))
  return [...runs.filter((other) => !isBeside(other)), { area: run.area, from, to }]
}

function blocksOf(runs: readonly Run[]): Load {
  const load: Record<string, number> = {}
  for (const { area, from, to } of runs) {
    const list = area.ways.block ?? 'wordBlocks'
    load[list] = (load[list] ?? 0) + 1
    load[`${list}.values`] = (load[`${list}.values`] ?? 0) + to - from
  }
  return load
}
