// Where the values of an item lie: the one description of it that reading, writing and explaining share.
import { RequestError } from '../../errors'
import { type DeviceInfo, deviceInfo, devicesOfGroup } from '../../melsec/device/device'
import { exclusionOf } from '../../melsec/profiles/profile'
import { formatType, type ValueType, wordsOf } from '../../value/value'
import type { ParsedItem } from '../item/item'
import { type Area, areaKey, areaOf, type CellKind, capacityOf, type Direction, isExtended, isModified } from './area'
import type { PlanProtocol } from './limit'

/**
 * Value `k` of an item is the bits `start + k * pitch + j * step`, `j` from 0 to `width - 1`, counted from cell 0 of the
 * area, lowest bit first.
 */
export interface Layout {
  readonly area: Area
  readonly start: number
  /** Bits of one value. */
  readonly width: number
  /** From one bit of a value to the next: 1, or one record of a long timer. */
  readonly step: number
  /** From one value to the next. */
  readonly pitch: number
  /** In the words that only the direct command shows (contacts and coils of long timers). */
  readonly directOnly: boolean
}

/** Bits of the third word of a long timer's record (SLMP reference manual 5.2, Read: LTN, LSTN). */
const RECORD_BIT = { coil: 32, contact: 33 } as const

/** Areas of whole devices, of which there are few: worked out once for all plans of a protocol. */
const ordinary = new WeakMap<PlanProtocol, Record<Direction, Map<string, Area>>>()

function ordinaryAreas(protocol: PlanProtocol, direction: Direction): Map<string, Area> {
  let found = ordinary.get(protocol)
  if (found === undefined) {
    found = { read: new Map(), write: new Map() }
    ordinary.set(protocol, found)
  }
  return found[direction]
}

/** Finds areas, and keeps them: those of networks, modules and modified addresses for one plan, because there is no end of them. */
export class Areas {
  readonly #ordinary: Map<string, Area>
  readonly #extended = new Map<string, Area>()
  readonly #capacities = new Map<Area, number>()

  constructor(
    readonly protocol: PlanProtocol,
    readonly direction: Direction,
  ) {
    this.#ordinary = ordinaryAreas(protocol, direction)
  }

  /** @throws RequestError when no command reaches the device. */
  find(kind: CellKind, address: ParsedItem['address']): Area {
    const isOrdinary = !isExtended(address)
    const known = isOrdinary ? this.#ordinary : this.#extended
    const key = isOrdinary ? `${kind} ${address.device}` : areaKey(kind, address)
    let area = known.get(key)
    if (area === undefined) {
      area = areaOf(this.protocol, this.direction, kind, address)
      known.set(key, area)
    }
    return area
  }

  /** Cells in a row that one request carries. */
  capacity(area: Area): number {
    let capacity = this.#capacities.get(area)
    if (capacity === undefined) {
      capacity = capacityOf(this.protocol, this.direction, area)
      this.#capacities.set(area, capacity)
    }
    return capacity
  }
}

function isText(type: ValueType): boolean {
  return type.length !== undefined
}

function bitsOf(item: ParsedItem): number {
  if (item.digits !== undefined) return 4 * item.digits
  return item.type.name === 'BOOL' ? 1 : 16 * wordsOf(item.type)
}

/** The long timer a contact or coil has to be read from, because no reading command takes it itself. */
function recordOf(info: DeviceInfo): DeviceInfo | undefined {
  if (info.unit !== 'bit' || info.notIn?.includes('readBits') !== true) return undefined
  return devicesOfGroup(info.group ?? '').find((sibling) => sibling.part === 'current value')
}

/**
 * How an item is read. Bits are read as the words they are in, from a multiple of 16 on: the ranges of bit devices are
 * multiples of 16, so that no word ends behind the last device.
 *
 * @param exact bits in bit units, so that nothing beside the item is read; `undefined` when there is no such way
 * @throws RequestError when no command reads it
 */
export function readLayout(areas: Areas, item: ParsedItem): Layout
export function readLayout(areas: Areas, item: ParsedItem, exact: true): Layout | undefined
export function readLayout(areas: Areas, item: ParsedItem, exact = false): Layout | undefined {
  const { address } = item
  const info = deviceInfo(address.device)
  refuseAbsent(areas, info)
  const record = recordOf(info)
  if (exact && (info.unit !== 'bit' || record !== undefined || isModified(address))) return undefined
  if (record !== undefined && info.part !== 'current value' && info.part !== undefined) {
    const area = areas.find('record', { ...address, device: record.name })
    return layoutIn(area, item, RECORD_BIT[info.part])
  }
  if (info.unit === 'doubleWord') return layoutIn(areas.find('record', address), item)
  // The number of long counters is not bound to multiples of 16, and Read Random does not take their contacts; over 1E
  // that of counters is not either.
  const noWords = info.longOnly === true || exclusionOf(areas.protocol.profile, 'readWords', info.name) !== undefined
  const inBits = exact || (info.unit === 'bit' && noWords)
  return layoutIn(areas.find(inBits ? 'bit' : 'word', address), item)
}

/**
 * How an item is written: bits one by one, because the word around them would write its other bits too. K4 and K8 on
 * a multiple of 16 are whole words.
 * @throws RequestError when no command writes it
 */
export function writeLayout(areas: Areas, item: ParsedItem): Layout {
  const { address } = item
  const info = deviceInfo(address.device)
  refuseAbsent(areas, info)
  if (info.unit === 'doubleWord') return layoutIn(areas.find('record', address), item)
  if (info.unit === 'word') return layoutIn(areas.find('word', address), item)
  const wholeWords = bitsOf(item) % 16 === 0 && address.number % 16 === 0 && info.group === undefined
  return layoutIn(areas.find(wholeWords && !isModified(address) ? 'word' : 'bit', address), item)
}

function refuseAbsent({ protocol: { profile } }: Areas, info: DeviceInfo): void {
  if (!profile.absentDevices.includes(info.name)) return
  throw new RequestError('UNSUPPORTED', `${profile.title} has no device ${info.name} (${info.title}).`, info.name)
}

function layoutIn(area: Area, item: ParsedItem, recordBit?: number): Layout {
  const { bitsPerCell, numbersPerCell, base, kind } = area
  const width = bitsOf(item)
  const step = recordBit === undefined ? 1 : bitsPerCell
  const offset = recordBit ?? item.bit ?? 0
  return {
    area,
    start: (item.address.number - base) * (bitsPerCell / numbersPerCell) + offset,
    width,
    step,
    pitch: kind === 'record' && recordBit === undefined ? bitsPerCell : width * step,
    directOnly: recordBit !== undefined,
  }
}

/** Values `first` to `first + count - 1` of an item: what one request reads or writes of it. */
export interface Piece {
  /** Place of the item in the plan. */
  readonly item: number
  /** 0 unless the item is larger than one request. */
  readonly part: number
  readonly first: number
  readonly count: number
  readonly layout: Layout
  /** Cells `from` to `to - 1`. */
  readonly from: number
  readonly to: number
}

export function pieceOf(layout: Layout, item: number, part: number, first: number, count: number): Piece {
  const low = layout.start + first * layout.pitch
  const high = low + (count - 1) * layout.pitch + (layout.width - 1) * layout.step
  const { bitsPerCell } = layout.area
  const from = Math.floor(low / bitsPerCell)
  return { item, part, first, count, layout, from, to: Math.floor(high / bitsPerCell) + 1 }
}

/**
 * The pieces of an item: one, or as few as the limits allow, cut between two values.
 * @throws RequestError LIMIT_EXCEEDED when not even one value fits into a request: it is never torn.
 */
export function piecesOf(areas: Areas, layout: Layout, item: ParsedItem, index: number): Piece[] {
  const capacity = areas.capacity(layout.area)
  const total = item.count ?? 1
  const pieces: Piece[] = []
  for (let first = 0; first < total; ) {
    const count = Math.min(total - first, valuesWithin(layout, first, capacity))
    if (count < 1) throw tooLong(item, layout, capacity)
    pieces.push(pieceOf(layout, index, pieces.length, first, count))
    first += count
  }
  return pieces
}

/** How many values from `first` on lie within so many cells. */
function valuesWithin({ area, start, width, step, pitch }: Layout, first: number, cells: number): number {
  const low = (start + first * pitch) % area.bitsPerCell
  const room = cells * area.bitsPerCell - low - ((width - 1) * step + 1)
  return room < 0 ? 0 : Math.floor(room / pitch) + 1
}

function tooLong(item: ParsedItem, { width }: Layout, capacity: number): RequestError {
  const remedy = isText(item.type) ? 'Use a shorter text, or read the words as an array.' : 'Use a shorter type.'
  return new RequestError(
    'LIMIT_EXCEEDED',
    `${item.text}: one ${formatType(item.type)} has ${Math.ceil(width / 16)} words, and one request carries ${capacity} here. ` +
      `A value is never put together from two requests, because it may change between them. ${remedy}`,
    item.text,
  )
}
