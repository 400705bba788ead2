// Which units share a request. The order in which they were given is kept: a bit that says "the data are there" must not
// be written before the data.
import { lackOf } from '../../melsec/profiles/profile'
import { type Area, directLoad, groupOf, limitedUnit, randomCommandOf, randomLoad, withTally } from './area'
import { added, boundsOf, fits, type Load, type PlanProtocol } from './limit'
import type { WriteUnit } from './write-unit'

/** Units of one request. */
export interface Batch {
  /**
   * `direct`: cells in a row by one Write; `random`: Write Random; `block`: Write Block; `masked`: words read, changed and
   * written back.
   */
  readonly kind: 'direct' | 'random' | 'block' | 'masked'
  readonly units: readonly WriteUnit[]
  /** Of `direct`: bits in a row that are written as words of this area. */
  readonly words?: Area
}

/** A batch that may still grow. */
interface OpenBatch {
  readonly units: WriteUnit[]
  /** Cells in a row so far, when they are. */
  row: { readonly from: number; readonly to: number } | undefined
  /** Points of Write Random so far, when it can take them. */
  load: Load | undefined
}

/** Whether two units may stand in one request at all. */
export function mayShare(a: WriteUnit, b: WriteUnit): boolean {
  return !a.isPart && !b.isPart && a.content.kind === b.content.kind && groupOf(a.area) === groupOf(b.area)
}

/** Each unit joins the request before it, as long as that can carry it; else the next request begins. */
export function batchesOf(protocol: PlanProtocol, units: readonly WriteUnit[]): Batch[] {
  const batches: OpenBatch[] = []
  for (const unit of units) {
    const last = batches.at(-1)
    if (last === undefined || !joined(protocol, last, unit)) batches.push(opened(protocol, unit))
  }
  return batches.map(closed)
}

/** A unit in a request of its own. */
export function alone(protocol: PlanProtocol, unit: WriteUnit): Batch {
  return closed(opened(protocol, unit))
}

function opened(protocol: PlanProtocol, unit: WriteUnit): OpenBatch {
  const { area, from, to } = unit
  const load = loadOf(unit)
  return {
    units: [unit],
    row: rowFits(protocol, area, to - from) ? { from, to } : undefined,
    load: randomFits(protocol, unit, load) ? load : undefined,
  }
}

function joined(protocol: PlanProtocol, batch: OpenBatch, unit: WriteUnit): boolean {
  const [first] = batch.units
  if (first === undefined || !mayShare(first, unit)) return false
  const row = first.area === unit.area ? rowWith(protocol, batch, unit) : undefined
  const load = loadWith(protocol, batch, unit)
  if (row === undefined && load === undefined) return false
  batch.units.push(unit)
  batch.row = row
  batch.load = load
  return true
}

function rowWith(protocol: PlanProtocol, { row }: OpenBatch, { area, from, to, content }: WriteUnit): OpenBatch['row'] {
  if (row === undefined) return undefined
  if (content.kind === 'masked') return maskedRow(protocol, area, row, { from, to })
  const grown = from === row.to ? { from: row.from, to } : to === row.from ? { from, to: row.to } : undefined
  return grown !== undefined && rowFits(protocol, area, grown.to - grown.from) ? grown : undefined
}

/** Words that are read and written back, where no Read Random takes scattered ones: those of the row, and the next. */
function maskedRow(
  protocol: PlanProtocol,
  area: Area,
  row: NonNullable<OpenBatch['row']>,
  { from, to }: NonNullable<OpenBatch['row']>,
): OpenBatch['row'] {
  if (lackOf(protocol.profile, 'readRandom') === undefined || from < row.from || from > row.to) return undefined
  const grown = { from: row.from, to: Math.max(row.to, to) }
  const cells = grown.to - grown.from
  const isRead = fits(boundsOf(protocol, 'readWords', area.ways.form, limitedUnit(area)), directLoad(area, cells))
  return isRead && rowFits(protocol, area, cells) ? grown : undefined
}

export function rowFits(protocol: PlanProtocol, area: Area, cells: number): boolean {
  const { direct, form } = area.ways
  return direct !== undefined && fits(boundsOf(protocol, direct, form, limitedUnit(area)), directLoad(area, cells))
}

function loadWith(protocol: PlanProtocol, { load, units }: OpenBatch, unit: WriteUnit): Load | undefined {
  if (load === undefined) return undefined
  const own = unit.content.kind === 'masked' ? newCells(units, unit) : loadOf(unit)
  const sum = added(load, own)
  return randomFits(protocol, unit, sum) ? sum : undefined
}

export function randomFits(protocol: PlanProtocol, { area, content }: WriteUnit, load: Load): boolean {
  const { random, form } = area.ways
  if (random === undefined) return false
  // The words of a masked unit are read first, so they must fit into a Read Random too, where there is one.
  if (content.kind === 'masked') {
    if (lackOf(protocol.profile, 'readRandom') !== undefined) return false
    if (!fits(boundsOf(protocol, 'readRandom', form), load)) return false
  }
  return fits(boundsOf(protocol, randomCommandOf(area, 'write'), form), load)
}

export function loadOf({ area, from, to, content }: WriteUnit): Load {
  return content.kind === 'masked' ? withTally(area, { words: to - from }, to - from) : randomLoad(area, to - from)
}

/** Bits of a word that is read and written back already cost nothing more. */
function newCells(units: readonly WriteUnit[], { area, from, to }: WriteUnit): Load {
  let words = 0
  for (let cell = from; cell < to; cell++) {
    if (!units.some((unit) => unit.area === area && unit.from <= cell && cell < unit.to)) words++
  }
  return withTally(area, { words }, words)
}

function closed({ units, row, load }: OpenBatch): Batch {
  const [first] = units
  if (first?.content.kind === 'masked') return { kind: 'masked', units }
  // A device of two words is one double word to Write Random: the way every family has.
  const isRecord = first?.area.kind === 'record'
  return { kind: row === undefined || (isRecord && load !== undefined) ? 'random' : 'direct', units }
}
