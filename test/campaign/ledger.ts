/**
 * What the PLC holds, what it received, refused and carried out, and what calls said became of them.
 *
 * Every value carries its address: ten bits say which cell it belongs to, six bits count the writes to it. So a value of
 * another cell, an old value, and a write that nobody asked for are all seen. A cell is a word of D, or 16 points of M.
 */
import type { Access, Request } from './request'

export type Outcome = 'notSent' | 'refused' | 'unknown'

export const violationKinds = [
  'wrong value',
  'stale value',
  'value without a request',
  'carried out twice',
  'carried out though told as notSent',
  'carried out though told as refused',
  'sent though told as notSent',
  'done but not carried out',
  'refused but the PLC did not refuse it',
  'another end code',
  'a request that nobody made',
  'no PlcError',
  'never settled',
  'settled late',
  'something is left',
] as const
export type ViolationKind = (typeof violationKinds)[number]

const VERSIONS = 64
/** Cells of D; those of M follow. */
const D_CELLS = 912
export const CELLS = 1024
const BITS = 16
/** Values of a cell that a call may still be about: it lasts no longer than some writes. */
const KEPT_VALUES = 12
/** Cells of writes that are known by their value: those of the last hundreds of calls, so of the last seconds. */
const KEPT_WRITES = 2000

/** Cells that lie together, and where. */
export interface Span {
  readonly device: 'D' | 'M'
  readonly cell: number
  readonly cells: number
}

/** D0 is left to the client, which may read it to see whether the PLC is there. */
const FIRST = 2

/** Regions of cells: hot ones are used again and again, cold ones in turn, so that a cell names its call. */
export const regions = {
  D: { cold: { from: FIRST, to: 896 }, hot: { from: 896, to: D_CELLS } },
  M: { cold: { from: D_CELLS, to: 1016 }, hot: { from: 1016, to: CELLS } },
} as const

/** Number of the first device of a cell. */
export function headOf({ device, cell }: Span): number {
  return device === 'D' ? cell : (cell - D_CELLS) * BITS
}

export function deviceName(cell: number): string {
  return cell < D_CELLS ? `D${cell}` : `M${(cell - D_CELLS) * BITS}`
}

/** What the ledger knows of one cell of one call. */
export interface Watch {
  readonly cell: number
  /** Of a write. */
  readonly value: number | undefined
  readonly since: number
  received: number
  done: number
  refusals: number[]
  /** What the call said became of it. */
  told: Outcome | 'done' | undefined
  /** Tells a violation, with the story of the call. */
  readonly report: (kind: ViolationKind, detail: string) => void
}

export class Ledger {
  readonly #values = new Uint16Array(CELLS).map((_, cell) => cell * VERSIONS)
  readonly #versions = new Uint8Array(CELLS)
  /** Values and since when, oldest first; nothing is kept of a cell that was never written. */
  readonly #past = new Map<number, { readonly value: number; readonly since: number }[]>()
  readonly #writes = new Map<number, Watch>()
  readonly #reads = new Map<number, Watch>()
  #now = 0

  constructor(readonly stranger: (detail: string) => void) {}

  /** Moves on with everything that happens. */
  get now(): number {
    return this.#now
  }

  /** A value for a cell that no write has carried lately. */
  fresh(cell: number): number {
    const version = ((this.#versions[cell] ?? 0) + 1) % VERSIONS
    this.#versions[cell] = version
    return cell * VERSIONS + version
  }

  watchWrite(cell: number, value: number, report: Watch['report']): Watch {
    const watch = this.#watch(cell, value, report)
    this.#writes.delete(value)
    this.#writes.set(value, watch)
    const [oldest] = this.#writes.keys()
    if (this.#writes.size > KEPT_WRITES && oldest !== undefined) this.#writes.delete(oldest)
    return watch
  }

  /** `alone`: no other call reads this cell, so its requests are counted. */
  watchRead(cell: number, alone: boolean, report: Watch['report']): Watch {
    const watch = this.#watch(cell, undefined, report)
    if (alone) this.#reads.set(cell, watch)
    return watch
  }

  #watch(cell: number, value: number | undefined, report: Watch['report']): Watch {
    this.#now += 1
    return { cell, value, since: this.#now, received: 0, done: 0, refusals: [], told: undefined, report }
  }

  received(request: Request): void {
    this.#now += 1
    for (const watch of this.#watchesOf(request)) {
      watch.received += 1
      if (watch.told === 'notSent') watch.report('sent though told as notSent', `${nameOf(watch)} came afterwards`)
    }
  }

  refused(request: Request, endCode: number): void {
    this.#now += 1
    for (const watch of this.#watchesOf(request)) watch.refusals.push(endCode)
  }

  /** @returns what a read gives, for each access its points. */
  carryOut(request: Request): number[][] {
    this.#now += 1
    if (request.kind === 'read') return request.accesses.map((access) => this.#read(access))
    const touched = new Set<number>()
    for (const [at, access] of request.accesses.entries()) this.#write(access, request.values[at] ?? [], touched)
    for (const cell of touched) this.#written(cell)
    return []
  }

  /** Holds a value that a call gave against the values the cell had since the call began. */
  check(watch: Watch, value: number | undefined): void {
    const { cell, report } = watch
    const past = this.#past.get(cell) ?? [{ value: cell * VERSIONS, since: 0 }]
    const at = past.findIndex((entry, i) => entry.value === value && (past[i + 1]?.since ?? Infinity) > watch.since)
    if (at >= 0) return
    const has = `${deviceName(cell)} holds ${past.at(-1)?.value}, the call gave ${value}`
    if (past.some((entry) => entry.value === value)) report('stale value', has)
    else report('wrong value', `${has}, ${value === undefined ? 'nothing' : `a value of ${deviceName(value >> 6)}`}`)
  }

  /** What a call says became of a cell it wrote or read. Of a cell that others read, too, only the value is looked at. */
  tell(watch: Watch, told: Outcome | 'done', endCode: number | undefined): void {
    watch.told = told
    if (watch.value === undefined && this.#reads.get(watch.cell) !== watch) return
    const { done, received, refusals, report, value } = watch
    const name = nameOf(watch)
    if (told === 'done' && value !== undefined && done === 0) report('done but not carried out', name)
    if (told === 'done' && value === undefined && received === 0) report('value without a request', name)
    if (told === 'notSent' && done > 0) report('carried out though told as notSent', name)
    // A write of several values that was refused whole is sent again in parts; what is left of it was not carried out.
    else if (told === 'notSent' && received > refusals.length) report('sent though told as notSent', name)
    if (told !== 'refused') return
    if (done > 0) report('carried out though told as refused', name)
    if (refusals.length === 0) report('refused but the PLC did not refuse it', name)
    else if (endCode === undefined || !refusals.includes(endCode)) report('another end code', `${name}: ${endCode}`)
  }

  /** The call has its value: who reads the cell next is nothing to it. */
  forget(watch: Watch): void {
    if (this.#reads.get(watch.cell) === watch) this.#reads.delete(watch.cell)
  }

  #watchesOf(request: Request): Watch[] {
    if (request.kind === 'read') {
      return request.accesses.flatMap((access) => cellsOf(access).flatMap((cell) => this.#reads.get(cell) ?? []))
    }
    if (request.kind !== 'write') return []
    const written = new Map<number, number>()
    const bits = new Map<number, number>()
    request.accesses.forEach((access, at) => {
      for (const [cell, value] of this.#valuesOf(access, request.values[at] ?? [], bits)) written.set(cell, value)
    })
    return [...written].flatMap(([cell, value]) => (value >> 6 === cell ? (this.#writes.get(value) ?? []) : []))
  }

  /** The cells an access writes, with what they hold then. `bits`: cells of M as far as they are put together. */
  #valuesOf(access: Access, values: readonly number[], bits: Map<number, number>): (readonly [number, number])[] {
    if (access.unit === 'word') return cellsOf(access).map((cell, i) => [cell, values[i] ?? 0])
    if (access.unit === 'doubleWord') {
      return cellsOf(access).map((cell, i) => [cell, ((values[i >> 1] ?? 0) >>> (i % 2 === 0 ? 0 : 16)) & 0xffff])
    }
    const touched = new Set<number>()
    values.forEach((bit, i) => {
      const cell = D_CELLS + Math.floor((access.head + i) / BITS)
      const mask = 1 << ((access.head + i) % BITS)
      const before = bits.get(cell) ?? this.#values[cell] ?? 0
      bits.set(cell, bit === 0 ? before & ~mask : before | mask)
      touched.add(cell)
    })
    return [...touched].map((cell) => [cell, bits.get(cell) ?? 0])
  }

  #read(access: Access): number[] {
    const cells = cellsOf(access)
    if (access.unit === 'doubleWord') {
      return Array.from({ length: access.points }, (_, i) => {
        const [low = 0, high = 0] = cells.slice(2 * i, 2 * i + 2).map((cell) => this.#values[cell] ?? 0)
        return low + high * 0x10000
      })
    }
    if (access.unit === 'word') return cells.map((cell) => this.#values[cell] ?? 0)
    return Array.from({ length: access.points }, (_, i) => {
      const place = access.head + i
      return ((this.#values[D_CELLS + Math.floor(place / BITS)] ?? 0) >> (place % BITS)) & 1
    })
  }

  #write(access: Access, values: readonly number[], touched: Set<number>): void {
    for (const [cell, value] of this.#valuesOf(access, values, new Map())) {
      this.#values[cell] = value
      touched.add(cell)
    }
  }

  #written(cell: number): void {
    const value = this.#values[cell] ?? 0
    const past = this.#past.get(cell) ?? [{ value: cell * VERSIONS, since: 0 }]
    past.push({ value, since: this.#now })
    if (past.length > KEPT_VALUES) past.shift()
    this.#past.set(cell, past)
    const watch = value >> 6 === cell ? this.#writes.get(value) : undefined
    if (watch === undefined) {
      this.stranger(`${value} was written to ${deviceName(cell)}`)
      return
    }
    watch.done += 1
    if (watch.done > 1) watch.report('carried out twice', nameOf(watch))
    if (watch.told === 'notSent') watch.report('carried out though told as notSent', nameOf(watch))
    if (watch.told === 'refused') watch.report('carried out though told as refused', nameOf(watch))
  }
}

function nameOf({ cell, value, since }: Watch): string {
  return `${value === undefined ? 'reading' : `writing ${value} to`} ${deviceName(cell)}, asked for at ${since}`
}

/** @throws RangeError for what no call asks for */
function cellsOf({ device, head, unit, points }: Access): number[] {
  const first = device === 'D' ? head : D_CELLS + Math.floor(head / BITS)
  const last = device === 'D' ? head + points * (unit === 'doubleWord' ? 2 : 1) - 1 : lastOfM(head, unit, points)
  const end = device === 'D' ? D_CELLS : CELLS
  if (last >= end || (device === 'M' && unit !== 'bit' && head % BITS !== 0)) {
    throw new RangeError(`${device}${head}, ${points} points in ${unit}s`)
  }
  return Array.from({ length: last - first + 1 }, (_, i) => first + i)
}

function lastOfM(head: number, unit: Access['unit'], points: number): number {
  const bits = unit === 'bit' ? points : points * BITS * (unit === 'doubleWord' ? 2 : 1)
  return D_CELLS + Math.floor((head + bits - 1) / BITS)
}
