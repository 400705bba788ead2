/**
 * Which requests read a set of pieces with the fewest bytes on a serial line, then with the fewest requests.
 *
 * Whether there are Read Randoms and Read Blocks at all is tried both ways. Then each cluster is cut into the cheapest rows
 * for itself: that is the least there is as long as one request of each list holds what goes into it. Where it takes several,
 * each entry bears its share of their price, too: no plan can cost less than with these shares, so that what is lost is what
 * the last request of each list is not full of.
 */
import { groupOf } from './area'
import { type Candidate, Candidates, LISTS, type List, type ListBounds } from './candidate'
import { type Cluster, clustersOf, runOf } from './cluster'
import { type Draft, firstItem, type PackOptions, sortedBy } from './draft'
import type { Areas, Piece } from './layout'
import { addSums, firstFit, type Sums, weightOf } from './limit'
import type { Prices } from './price'

/** Lists that may be used, and what each unit of their bounds costs beside the entries. */
type Tariff = Readonly<Partial<Record<List, Sums>>>

/** How a row is read. */
interface Read {
  readonly candidate: Candidate
  readonly way: 'direct' | List
}

/** Rows in requests, and what they cost. */
interface Choice {
  readonly price: number
  readonly requests: readonly { readonly way: 'direct' | List; readonly rows: readonly Candidate[] }[]
  /** Tariffs that may do better. */
  readonly next: readonly Tariff[]
}

/** The cheapest requests; areas of different groups never share one. */
export function cheapest(areas: Areas, pieces: readonly Piece[], options: PackOptions, prices: Prices): Draft[] {
  const groups = new Map<string, Cluster[]>()
  for (const cluster of clustersOf(areas, pieces, options, prices)) {
    const area = cluster[0]?.area
    if (area === undefined) continue
    const group = groupOf(area)
    const found = groups.get(group)
    if (found === undefined) groups.set(group, [cluster])
    else found.push(cluster)
  }
  return [...groups.values()].flatMap((clusters) => {
    const candidates = new Candidates(areas, options.without, prices, clusters)
    return draftsOf(new Group(clusters, candidates, prices).cheapest())
  })
}

function draftsOf({ requests }: Choice): Draft[] {
  return requests.map(({ way, rows }): Draft => {
    const runs = rows.map(({ cluster, from, to, inBits }) => runOf(cluster, from, to, way === 'direct' && inBits))
    const [run] = runs
    if (way === 'direct' && run !== undefined) return { kind: 'direct', run }
    return { kind: way === 'block' ? 'block' : 'random', runs: sortedBy(runs, firstItem) }
  })
}

/** Clusters that may share requests. */
class Group {
  /** Of each cluster. */
  readonly #candidates: readonly (readonly Candidate[])[]
  readonly #bounds: ListBounds
  /** Price of a request of each list with nothing in it; 0 where nothing could be. */
  readonly #requests: Readonly<Record<List, number>>

  constructor(clusters: readonly Cluster[], candidates: Candidates, prices: Prices) {
    this.#candidates = clusters.map((cluster) => candidates.of(cluster))
    this.#bounds = candidates.bounds
    const priceOf = (list: List) => {
      const holder = this.#candidates.flat().find((candidate) => candidate[list] !== undefined)
      const area = holder?.cluster[0]?.area
      return area === undefined ? 0 : prices.list(list, area).request
    }
    this.#requests = { random: priceOf('random'), block: priceOf('block') }
  }

  cheapest(): Choice {
    let best: Choice | undefined
    const tariffs = this.#tariffs()
    for (const tariff of tariffs) {
      const choice = this.#choice(tariff)
      if (choice === undefined) continue
      tariffs.push(...choice.next)
      if (best === undefined || isBetter(choice, best)) best = choice
    }
    if (best === undefined) throw new Error('pieces that no request reads')
    return best
  }

  /** With and without each list that could be used; nothing is added to the entries yet. */
  #tariffs(): Tariff[] {
    const found: Tariff[] = [{}]
    for (const list of LISTS) {
      if (this.#requests[list] === 0) continue
      const nothing = this.#bounds[list].map(() => 0)
      found.push(...found.map((tariff) => ({ ...tariff, [list]: nothing })))
    }
    return found
  }

  #choice(tariff: Tariff): Choice | undefined {
    const reads: Read[] = []
    for (const candidates of this.#candidates) {
      const found = cheapestRows(candidates, tariff)
      if (found === undefined) return undefined
      reads.push(...found)
    }
    const filled = new Filled(this.#requests)
    for (const { candidate, way } of reads) if (way === 'direct') filled.addDirect(candidate)
    const next: Tariff[] = []
    for (const list of LISTS) {
      const rows = reads.filter(({ way }) => way === list).map(({ candidate }) => candidate)
      const bins = firstFit(rows, (row) => row[list]?.sums ?? [], this.#bounds[list])
      for (const bin of bins) filled.addList(list, bin)
      if (bins.length > 1) next.push(...this.#shared(tariff, list, rows))
    }
    return { price: filled.price, requests: filled.requests, next }
  }

  /** Each entry bears its share of the requests that the fullest bound makes necessary; once, or it would not end. */
  #shared(tariff: Tariff, list: List, rows: readonly Candidate[]): Tariff[] {
    if (tariff[list]?.some((share) => share > 0) !== false) return []
    const bounds = this.#bounds[list]
    const sums = bounds.map(() => 0)
    for (const row of rows) addSums(sums, row[list]?.sums ?? [])
    const fullest = weightOf(sums, bounds)
    const shares = bounds.map(({ max }, i) => ((sums[i] ?? 0) / max === fullest ? this.#requests[list] / max : 0))
    return [{ ...tariff, [list]: shares }]
  }
}

/** Requests as they are filled. */
class Filled {
  price = 0
  readonly requests: Choice['requests'][number][] = []

  constructor(readonly lists: Readonly<Record<List, number>>) {}

  addDirect(row: Candidate): void {
    this.price += row.direct
    this.requests.push({ way: 'direct', rows: [row] })
  }

  /** One request, or, where that costs no more, a Read for its only row or for each of its rows. */
  addList(list: List, rows: readonly Candidate[]): void {
    const price = rows.reduce((sum, row) => sum + (row[list]?.price ?? 0), this.lists[list])
    const apart = rows.reduce((sum, { direct }) => sum + direct, 0)
    if (apart < price || (apart === price && rows.length === 1)) {
      for (const row of rows) this.addDirect(row)
    } else {
      this.price += price
      this.requests.push({ way: list, rows })
    }
  }
}

function isBetter(a: Choice, b: Choice): boolean {
  return a.price < b.price || (a.price === b.price && a.requests.length < b.requests.length)
}

/** The cheapest way through a cluster; `undefined` when there is none. */
function cheapestRows(candidates: readonly Candidate[], tariff: Tariff): Read[] | undefined {
  const best: ({ readonly price: number; readonly read: Read | undefined } | undefined)[] = [
    { price: 0, read: undefined },
  ]
  for (const candidate of candidates) {
    const before = best[candidate.from]
    if (before === undefined) continue
    const { way, price } = cheapestWay(candidate, tariff)
    const total = before.price + price
    const known = best[candidate.to]
    if (total < (known?.price ?? Number.POSITIVE_INFINITY)) {
      best[candidate.to] = { price: total, read: { candidate, way } }
    }
  }
  const reads: Read[] = []
  for (let at = candidates.at(-1)?.cluster.length ?? 0; at > 0; ) {
    const read = best[at]?.read
    if (read === undefined) return undefined
    reads.push(read)
    at = read.candidate.from
  }
  return reads.reverse()
}

function cheapestWay(candidate: Candidate, tariff: Tariff): { readonly way: Read['way']; readonly price: number } {
  let way: Read['way'] = 'direct'
  let price = candidate.direct
  for (const list of LISTS) {
    const entry = candidate[list]
    const shares = tariff[list]
    if (entry === undefined || shares === undefined) continue
    const own = entry.sums.reduce((sum, load, i) => sum + load * (shares[i] ?? 0), entry.price)
    if (own < price) {
      price = own
      way = list
    }
  }
  return { way, price }
}
