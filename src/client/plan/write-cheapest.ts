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
  /** The last request, and the units it holds. */
  readonly last: Omit<Batch, 'units'> | undefined
  readonly from: number
  readonly to: number
}

/** @param request bytes of a request and its answer around their bodies */
export function cheapestBatches(areas: Areas, units: readonly WriteUnit[], request: number): Batch[] {
  const finder = new Finder(areas, request)
  const best: (Way | undefined)[] = [{ price: 0, requests: 0, last: undefined, from: 0, to: 0 }]
  units.forEach((unit, from) => {
    const before = best[from]
    if (before === undefined) return
    const offer = (to: number, { batch, price }: Priced) => {
      const way: Way = { price: before.price + price, requests: before.requests + 1, last: batch, from, to }
      if (isBetter(way, best[to])) best[to] = way
    }
    if (unit.content.kind === 'masked') {
      const [batch] = batchesOf(areas.protocol, units.slice(from))
      if (batch !== undefined) offer(from + batch.units.length, { batch: { kind: 'masked' }, price: request })
    } else finder.each(units, from, offer)
  })
  return batchesTo(best, units)
}

function isBetter(way: Way, known: Way | undefined): boolean {
  if (known === undefined) return true
  return way.price < known.price || (way.price === known.price && way.requests < known.requests)
}

function batchesTo(best: readonly (Way | undefined)[], units: readonly WriteUnit[]): Batch[] {
  const batches: Batch[] = []
  for (let at = units.length; at > 0; ) {
    const way = best[at]
    if (way?.last === undefined) throw new Error('a unit that no request writes')
    batches.push({ ...way.last, units: units.slice(way.from, way.to) })
    at = way.from
  }
  return batches.reverse()
}

/** Units of one request so far. */
interface Growing {
  readonly first: WriteUnit
  readonly runs: Runs
  /** Price of a Write without the values, whatever of it is the longest. */
  head: number
  values: number
  /** Of one area, as few as a Write carries, even if they are no row yet. */
  mayBeRow: boolean
  load: Load | undefined
  entry: EntryPrice
  mayBeBlocks: boolean
}

/** What a unit costs in any request. */
interface UnitPrice {
  readonly head: number
  readonly values: number
  readonly entry: EntryPrice
  readonly load: Load
}

class Finder {
  readonly #areas: Areas
  readonly #protocol: PlanProtocol
  readonly #prices: WritePrices
  readonly #known = new Map<Area, { readonly random: number; readonly block: ReturnType<WritePrices['block']> }>()
  readonly #units = new Map<WriteUnit, UnitPrice>()

  constructor(areas: Areas, request: number) {
    this.#areas = areas
    this.#protocol = areas.protocol
    this.#prices = new WritePrices(areas.protocol, request)
  }

  /** Every request that begins with a unit. */
  each(units: readonly WriteUnit[], from: number, use: (to: number, priced: Priced) => void): void {
    const first = units[from]
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
      runs: new Runs(),
      head: 0,
      values: 0,
      mayBeRow: ways.direct !== undefined,
      load: ways.random === undefined ? undefined : {},
      entry: noEntry,
      mayBeBlocks: true,
    }
  }

  /** Whether any command may still take all of them. */
  #add(growing: Growing, unit: WriteUnit): boolean {
    const { area } = unit
    const { head, values, entry, load } = this.#priceOf(unit)
    const { runs } = growing
    runs.add(unit)
    growing.head = Math.max(growing.head, head)
    growing.values += values
    growing.entry = longest(growing.entry, entry)
    growing.mayBeRow &&= area === growing.first.area && rowFits(this.#protocol, area, runs.cells)
    const sum = growing.load && added(growing.load, load)
    growing.load = sum && randomFits(this.#protocol, unit, sum) ? sum : undefined
    growing.mayBeBlocks &&=
      area.ways.block !== undefined && fits(boundsOf(this.#protocol, 'writeBlock', area.ways.form), runs.blocks)
    return growing.mayBeRow || growing.load !== undefined || growing.mayBeBlocks
  }

  #priceOf(unit: WriteUnit): UnitPrice {
    let price = this.#units.get(unit)
    if (price === undefined) {
      const { area, from, to } = unit
      const { direct, random } = area.ways
      // The first and the last address: the longer of them counts.
      const ends = to - from === 1 ? [from] : [from, to - 1]
      price = {
        head: direct === undefined ? 0 : Math.max(...ends.map((cell) => this.#prices.direct(area, cell))),
        values: this.#prices.values(area, to - from),
        entry: random === undefined ? noEntry : ends.map((cell) => this.#entry(area, cell)).reduce(longest),
        load: loadOf(unit),
      }
      this.#units.set(unit, price)
    }
    return price
  }

  #entry(area: Area, cell: number): EntryPrice {
    return this.#prices.entry(area, cell, this.#requests(area).random)
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

  #direct({ first, runs, head, mayBeRow, load }: Growing): Priced | undefined {
    const { only } = runs
    // A device of two words is one double word to Write Random: the way every family has.
    const isRecord = first.area.kind === 'record' && load !== undefined
    if (only === undefined || !mayBeRow || isRecord) return undefined
    const price = head + this.#prices.values(first.area, runs.cells)
    const inWords = this.#inWords(first.area, only)
    return inWords !== undefined && inWords.price < price ? inWords : { batch: { kind: 'direct' }, price }
  }

  /** Sixteen bits from a multiple of sixteen on are a word, and nothing but these bits is in it. */
  #inWords(area: Area, { from, to }: Row): Priced | undefined {
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

  #block({ first, runs, values, mayBeBlocks }: Growing): Priced | undefined {
    if (!mayBeBlocks) return undefined
    const { request, block } = this.#requests(first.area).block
    return { batch: { kind: 'block' }, price: request + runs.count * block + values }
  }
}

function longest(a: EntryPrice, b: EntryPrice): EntryPrice {
  return {
    bit: Math.max(a.bit, b.bit),
    word: Math.max(a.word, b.word),
    doubleWord: Math.max(a.doubleWord, b.doubleWord),
  }
}

/** Cells `from` to `to - 1`. */
interface Row {
  readonly from: number
  readonly to: number
}

/** Rows of cells, wherever they came in the order: those that touch become one. */
class Runs {
  count = 0
  cells = 0
  /** Blocks and their values, as limits count them. */
  readonly blocks: Record<string, number> = {}
  /** The other end of each row. Ends that are inside by now stay: nothing comes there again, because nothing is written twice. */
  readonly #ends = new Map<Area, { readonly byFrom: Map<number, number>; readonly byTo: Map<number, number> }>()
  #last: Row = { from: 0, to: 0 }

  /** The only row there is. */
  get only(): Row | undefined {
    return this.count === 1 ? this.#last : undefined
  }

  add({ area, from, to }: Row & { readonly area: Area }): void {
    const { byFrom, byTo } = this.#endsOf(area)
    const [start, end] = [byTo.get(from) ?? from, byFrom.get(to) ?? to]
    const more = 1 - (start < from ? 1 : 0) - (end > to ? 1 : 0)
    byFrom.set(start, end)
    byTo.set(end, start)
    this.#last = { from: start, to: end }
    this.count += more
    this.cells += to - from
    const list = area.ways.block
    if (list === undefined) return
    this.blocks[list] = (this.blocks[list] ?? 0) + more
    this.blocks[`${list}.values`] = (this.blocks[`${list}.values`] ?? 0) + to - from
  }

  #endsOf(area: Area) {
    let ends = this.#ends.get(area)
    if (ends === undefined) {
      ends = { byFrom: new Map(), byTo: new Map() }
      this.#ends.set(area, ends)
    }
    return ends
  }
}
