import type { ValueCodec } from '../codec/codec'
import { RequestError } from '../errors'

/**
 * Where a byte lives in a Sharp JW: a segment (the file number) and a byte address in it.
 * `extended`: the six-byte form that only the JW300 knows (JW300 manual, "Address specification").
 */
export interface JwAddress {
  /** File number: basic 00-80H; extended 0 or 1. */
  readonly segment: number
  /** Byte address: basic 0-FFFFH; extended segment 0 0-FFFFH, segment 1 0-7FFFFFH. */
  readonly address: number
  readonly extended?: true
}

const EXTENDED = 0xff
const LAST = { basicSegment: 0x80, basic: 0xffff, extended: [0xffff, 0x7fffff] } as const

/** Basic: SEG ADRL ADRH. Extended: FF SEG ADRLL ADRLH ADRHL ADRHH. The first byte tells which. */
export const jwAddress: ValueCodec<JwAddress> = {
  name: 'address',
  write(writer, value) {
    if (value.extended !== undefined && value.extended !== true) {
      throw new RequestError('BAD_MESSAGE', `extended is true or left out, not ${String(value.extended)}`)
    }
    const last = lastAddress(value)
    if (last === undefined) throw outOfRange('segment', value.segment)
    if (!Number.isInteger(value.address) || value.address < 0 || value.address > last)
      throw outOfRange('address', value.address)
    if (value.extended !== true) {
      writer.uint(value.segment, 1)
      writer.uint(value.address, 2)
      return
    }
    writer.uint(EXTENDED, 1)
    writer.uint(value.segment, 1)
    writer.uint(value.address, 4)
  },
  read(reader) {
    const first = reader.uint(1)
    const value: JwAddress =
      first === EXTENDED
        ? { segment: reader.uint(1), address: reader.uint(4), extended: true }
        : { segment: first, address: reader.uint(2) }
    const last = lastAddress(value)
    if (last === undefined || value.address > last) reader.fail('BAD_FIELD', 'an address that does not exist')
    return value
  },
  size: (ascii, _form, value) => (value?.extended === true ? 6 : 3) * (ascii ? 2 : 1),
}

/** Last byte address of the segment, `undefined` when there is no such segment. */
function lastAddress({ segment, extended }: JwAddress): number | undefined {
  if (extended === true) return LAST.extended[segment]
  return Number.isInteger(segment) && segment >= 0 && segment <= LAST.basicSegment ? LAST.basic : undefined
}

function outOfRange(what: string, found: number): RequestError {
  return new RequestError('OUT_OF_RANGE', `${what} ${found} does not exist in a Sharp JW address`)
}
