// Where the values of an item lie: the one description of it that reading and writing share.
import { RequestError } from '../../errors'
import { FILE_REGISTERS, type JwAddress, type JwExtendedAddress, PAGE, pageOfRegisters } from '../../jw/address'
import { noDataIn } from '../../jw/check'
import type { JwModel } from '../../jw/commands/command'
import { jwAddressOf } from '../../jw/operand/place'
import { bytesOf, formatByteType } from '../../value/byte-type'
import type { ParsedJwItem } from './item'

/**
 * What one request can reach: a file of 64 KiB, the system memory, the timers. The file registers of a JW300 are its files 01 to
 * 80H, one for each 64 KiB; only for an item that crosses from one to the next they are one area, in extended addresses.
 */
export interface JwSpace {
  readonly in: 'file' | 'system' | 'timer'
  /** Of a file: its number in the basic form. */
  readonly file: number
  /** The file registers as a whole. */
  readonly isWhole: boolean
}

/** Bits of a cell: a byte, or of timers one number. */
export const CELL = 8

/** Value `k` of an item is the bits `start + k * width` on, so many as `width`; of timers both count numbers times 8. */
export interface JwLayout {
  readonly space: JwSpace
  readonly start: number
  readonly width: number
  readonly count: number
}

/** Values `first` to `first + count - 1` of an item: what one request reads or writes of it. */
export interface JwPiece {
  /** Place of the item in the plan. */
  readonly item: number
  /** 0 unless the item is larger than one request. */
  readonly part: number
  readonly first: number
  readonly count: number
  readonly layout: JwLayout
  /** Cells `from` to `to - 1`. */
  readonly from: number
  readonly to: number
}

/** Finds spaces, so that what is in one space is in the same object. */
export class JwSpaces {
  readonly #model: JwModel
  readonly #known = new Map<string, JwSpace>()

  constructor(model: JwModel) {
    this.#model = model
  }

  /** @throws RequestError UNSUPPORTED or OUT_OF_RANGE where the model has no such bytes */
  layoutOf({ text, place, type, count = 1 }: ParsedJwItem): JwLayout {
    if (place.in === 'timer') {
      return { space: this.#space('timer'), start: place.number * CELL, width: CELL, count }
    }
    const width = type.name === 'BOOL' ? 1 : CELL * bytesOf(type)
    const bit = place.bit ?? 0
    if (place.in === 'system') return { space: this.#space('system'), start: place.address * CELL + bit, width, count }
    const { file, address } = place
    const noData = noDataIn(file, this.#model)
    if (noData !== undefined) throw new RequestError('OUT_OF_RANGE', `${JSON.stringify(text)}: ${noData}.`, text)
    const last = address + Math.ceil((bit + width * count) / CELL) - 1
    if (file !== FILE_REGISTERS || last < PAGE) {
      return { space: this.#space('file', file), start: address * CELL + bit, width, count }
    }
    if (this.#model !== 'jw300') {
      const message = `${JSON.stringify(text)}: file 1 ends at byte 177777 on this model; only the file registers of a JW300 go on.`
      throw new RequestError('UNSUPPORTED', message, text)
    }
    const page = pageOfRegisters(address)
    const isCrossing = pageOfRegisters(last).file !== page.file
    const at = isCrossing ? address : page.address
    return { space: this.#space('file', page.file, isCrossing), start: at * CELL + bit, width, count }
  }

  #space(kind: JwSpace['in'], file = 0, isWhole = false): JwSpace {
    const key = isWhole ? 'registers' : `${kind} ${file}`
    const known = this.#known.get(key)
    if (known !== undefined) return known
    const space = { in: kind, file: isWhole ? FILE_REGISTERS : file, isWhole }
    this.#known.set(key, space)
    return space
  }
}

/** The address of a byte as a command with one address takes it. */
export function headIn({ file, isWhole }: JwSpace, address: number): JwAddress {
  return isWhole ? { file, address, extended: true } : { file, address }
}

/** The address of a byte as lists take it. */
export function extendedIn({ file, isWhole }: JwSpace, address: number): JwExtendedAddress {
  return isWhole ? { file, address, extended: true } : jwAddressOf({ in: 'file', file, address }, 'extended')
}

export function jwPieceOf(layout: JwLayout, item: number, part: number, first: number, count: number): JwPiece {
  const low = layout.start + first * layout.width
  const high = low + count * layout.width - 1
  return { item, part, first, count, layout, from: Math.floor(low / CELL), to: Math.floor(high / CELL) + 1 }
}

/**
 * The pieces of an item: one, or as few as the cells of a request allow, cut between two values.
 * @throws RequestError LIMIT_EXCEEDED when not even one value fits into a request: it is never torn
 */
export function jwPiecesOf(layout: JwLayout, item: ParsedJwItem, index: number, capacity: number): JwPiece[] {
  const pieces: JwPiece[] = []
  for (let first = 0; first < layout.count; ) {
    const low = (layout.start + first * layout.width) % CELL
    const count = Math.min(layout.count - first, Math.floor((capacity * CELL - low) / layout.width))
    if (count < 1) throw tooLong(item, layout, capacity)
    pieces.push(jwPieceOf(layout, index, pieces.length, first, count))
    first += count
  }
  return pieces
}

function tooLong({ text, type }: ParsedJwItem, { width }: JwLayout, capacity: number): RequestError {
  return new RequestError(
    'LIMIT_EXCEEDED',
    `${text}: one ${formatByteType(type)} has ${width / CELL} bytes, and one request carries ${capacity} here. ` +
      'A value is never put together from two requests, because it may change between them. Use a shorter type, or read the bytes as an array.',
    text,
  )
}
