// The cells of one device: what is read and written, in bits, words and double words.
import type { DeviceInfo } from '../melsec/device/device'

/** A run of cells: one per device number. Bits 0 or 1, words 0..65535, double words 0..4294967295. */
export interface Region {
  readonly info: DeviceInfo
  readonly cells: Uint8Array | Uint16Array | Uint32Array
  /** Keeps its values when the PLC starts again. */
  readonly latched: boolean
  /** Of a long timer: what its third word shows (SLMP reference manual 5.2, Read). */
  readonly coil?: Region | undefined
  readonly contact?: Region | undefined
}

/** A device in a region. */
export interface Place {
  readonly region: Region
  readonly start: number
}

export function makeCells(info: DeviceInfo, points: number): Region['cells'] {
  if (info.unit === 'bit') return new Uint8Array(points)
  return info.unit === 'word' ? new Uint16Array(points) : new Uint32Array(points)
}

/** Devices that `words` words take: a word holds 16 bit devices, and a long timer fills several words. */
export function devicesOfWords({ info }: Region, words: number): number {
  if (info.unit === 'bit') return 16 * words
  return info.unit === 'word' ? words : Math.ceil(words / (info.wordsPerDevice ?? 2))
}

/** Devices that one double word takes. */
export function devicesOfDoubleWord({ info }: Region): number {
  if (info.unit === 'bit') return 32
  return info.unit === 'word' ? 2 : 1
}

export function readWord({ region, start }: Place, index: number): number {
  const { info, cells } = region
  if (info.unit === 'bit') return readBitWord(cells, start + 16 * index)
  if (info.unit === 'word') return cells[start + index] ?? 0
  const size = info.wordsPerDevice ?? 2
  const at = start + Math.floor(index / size)
  const part = index % size
  if (part < 2) return ((cells[at] ?? 0) >>> (16 * part)) & 0xffff
  // The third word of a long timer: b0 coil, b1 contact. The fourth is the system's.
  return part === 2 ? (region.coil?.cells[at] ?? 0) | ((region.contact?.cells[at] ?? 0) << 1) : 0
}

/** Only what may be written in words: the third and fourth word of a long timer cannot. */
export function writeWord({ region, start }: Place, index: number, value: number): void {
  const { info, cells } = region
  if (info.unit === 'bit') {
    writeBitWord(cells, start + 16 * index, value)
    return
  }
  if (info.unit === 'word') {
    cells[start + index] = value
    return
  }
  const size = info.wordsPerDevice ?? 2
  const at = start + Math.floor(index / size)
  const part = index % size
  const old = cells[at] ?? 0
  if (part === 0) cells[at] = (old & 0xffff0000) | value
  if (part === 1) cells[at] = (old & 0xffff) | (value << 16)
}

export function readDoubleWord(place: Place): number {
  const { region, start } = place
  if (region.info.unit === 'doubleWord') return region.cells[start] ?? 0
  return (readWord(place, 0) | (readWord(place, 1) << 16)) >>> 0
}

export function writeDoubleWord(place: Place, value: number): void {
  if (place.region.info.unit === 'doubleWord') {
    place.region.cells[place.start] = value
    return
  }
  writeWord(place, 0, value & 0xffff)
  writeWord(place, 1, value >>> 16)
}

/** The word of 16 bit devices, from any head number: bit 0 is the head device. */
function readBitWord(cells: Region['cells'], start: number): number {
  let word = 0
  for (let bit = 0; bit < 16; bit++) word |= (cells[start + bit] ?? 0) << bit
  return word
}

function writeBitWord(cells: Region['cells'], start: number, value: number): void {
  for (let bit = 0; bit < 16; bit++) cells[start + bit] = (value >>> bit) & 1
}
