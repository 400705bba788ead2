// Which units share a request. The order in which they were given is kept: a relay that says "the data are there" must not be
// written before the data.

import { CELL } from './layout'
import type { JwLimits } from './limits'
import type { JwWriteUnit } from './write-unit'

/** Units of one request. */
export interface JwBatch {
  /**
   * `row`: bytes in a row; `registers`: scattered bytes; `relays`: relays anywhere, one or more; `timer`; `masked`: bits of
   * the system memory, whose byte is read and written back.
   */
  readonly kind: 'row' | 'registers' | 'relays' | 'timer' | 'masked'
  readonly units: readonly JwWriteUnit[]
}

interface Way {
  readonly requests: number
  /** Lists so far: of as few requests those with the fewest lists are taken. */
  readonly lists: number
  readonly batch: JwBatch | undefined
  readonly from: number
}

/** The fewest requests that keep the order. */
export function jwBatches(units: readonly JwWriteUnit[], limits: JwLimits, lists: boolean): JwBatch[] {
  const best: (Way | undefined)[] = [{ requests: 0, lists: 0, batch: undefined, from: 0 }]
  units.forEach((_unit, from) => {
    const before = best[from]
    if (before === undefined) return
    for (const batch of batchesFrom(units, from, limits, lists)) {
      const to = from + batch.units.length
      const isList = batch.kind === 'registers' || (batch.kind === 'relays' && batch.units.length > 1)
      const way = { requests: before.requests + 1, lists: before.lists + Number(isList), batch, from }
      if (isBetter(way, best[to])) best[to] = way
    }
  })
  const found: JwBatch[] = []
  for (let at = units.length; at > 0; ) {
    const way = best[at]
    if (way?.batch === undefined) throw new Error('a unit that no request writes')
    found.push(way.batch)
    at = way.from
  }
  return found.reverse()
}

function isBetter(way: Way, known: Way | undefined): boolean {
  if (known === undefined || way.requests !== known.requests)
    return known === undefined || way.requests < known.requests
  return way.lists < known.lists
}

/** A unit in a request of its own. */
export function jwAlone(unit: JwWriteUnit): JwBatch {
  const { content, space } = unit
  if (content.kind === 'timer') return { kind: 'timer', units: [unit] }
  if (content.kind === 'bytes') return { kind: 'row', units: [unit] }
  return { kind: space.in === 'system' ? 'masked' : 'relays', units: [unit] }
}

/** Every request that begins with a unit. */
function batchesFrom(units: readonly JwWriteUnit[], from: number, limits: JwLimits, lists: boolean): JwBatch[] {
  const [first] = units.slice(from, from + 1)
  if (first === undefined) return []
  const single = jwAlone(first)
  if (first.isPart || single.kind === 'timer' || single.kind === 'masked') return [single]
  return single.kind === 'relays' ? relays(units, from, limits, lists) : bytes(units, from, limits, lists)
}

function relays(units: readonly JwWriteUnit[], from: number, limits: JwLimits, lists: boolean): JwBatch[] {
  const found: JwBatch[] = []
  let bits = 0
  for (let to = from; to < units.length; to++) {
    const unit = units[to]
    if (unit === undefined || (to > from && (unit.isPart || jwAlone(unit).kind !== 'relays'))) break
    bits += unit.count
    if (to > from && (!lists || bits > limits.setRelays)) break
    found.push({ kind: 'relays', units: units.slice(from, to + 1) })
  }
  return found
}

function bytes(units: readonly JwWriteUnit[], from: number, limits: JwLimits, lists: boolean): JwBatch[] {
  const found: JwBatch[] = []
  const [first] = units.slice(from, from + 1)
  if (first === undefined) return found
  const { space } = first
  const rowMost = space.in === 'system' ? limits.writeSystem : limits.writeBytes
  const listMost = space.in === 'file' && lists ? limits.writeRegisters : 0
  let size = 0
  let low = Number.POSITIVE_INFINITY
  let high = Number.NEGATIVE_INFINITY
  let isInSpace = true
  for (let to = from; to < units.length; to++) {
    const unit = units[to]
    if (unit === undefined || (to > from && (unit.isPart || unit.content.kind !== 'bytes'))) break
    if (unit.space.in !== space.in) break
    isInSpace &&= unit.space === space
    size += unit.to - unit.from
    low = Math.min(low, unit.from)
    high = Math.max(high, unit.to)
    const mayBeRow = isInSpace && size <= rowMost
    if (!mayBeRow && size > listMost && to > from) break
    const own = units.slice(from, to + 1)
    if (to === from || (mayBeRow && high - low === size)) found.push({ kind: 'row', units: own })
    else if (size <= listMost) found.push({ kind: 'registers', units: own })
  }
  return found
}

/** Bits of a unit that are set or reset, by their place in the space. */
export function bitsOfUnit({
  content,
}: JwWriteUnit): readonly { readonly address: number; readonly bit: number; readonly value: number }[] {
  if (content.kind !== 'bits') return []
  return content.bits.map((isSet, i) => {
    const at = content.at + i
    return { address: Math.floor(at / CELL), bit: at % CELL, value: Number(isSet) }
  })
}
