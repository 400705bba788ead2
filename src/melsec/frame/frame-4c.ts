// The 4C frame in format 5 (binary): FX5 communication manual 40.3 and 40.4.
//   DLE STX | data bytes | F8 | route | data | DLE ETX | sum
// Every 10H between DLE STX and DLE ETX is doubled; byte count and sum are taken before that. The sum is two ASCII
// characters. There is no serial number: answers come in order.
import { failAt, putUint, sumOf, uintAt } from '../../codec/codec'
import type { Framing, Head, RequestFrame, ResponseFrame, Scanned } from '../../link/link'

/** Access route of the 4C frame. On an FX5 only the station number varies. */
export type Head4c = {
  readonly station: number
  readonly network: number
  readonly pc: number
  readonly moduleIo: number
  readonly multidrop: number
  readonly selfStation: number
}

export interface Format5Options {
  /** Sum check code: a parameter of the PLC's port. Default true. */
  readonly sumCheck?: boolean
}

const DLE = 0x10
const STX = 0x02
const ETX = 0x03
const FRAME_ID = 0xf8
const RESPONSE_ID = 0xffff
/** frame ID 1, station 1, network 1, PC 1, module I/O 2, multidrop 1, self station 1 */
const ROUTE_END = 8

/** Framing of the 4C frame in format 5. */
export function frame4cFormat5(options: Format5Options = {}): Framing<Head4c> {
  const sumCheck = options.sumCheck ?? true
  return {
    name: '4C format 5',
    correlation: 'order',
    request: {
      write: (head, _serial, body) => write(head, body, sumCheck),
      scan: (bytes) => scanRequest(bytes, sumCheck),
    },
    response: {
      write: (head, _serial, endCode, body) => write(head, responseData(endCode, body), sumCheck),
      scan: (bytes) => scanResponse(bytes, sumCheck),
    },
    mismatch,
  }
}

function responseData(endCode: number, body: Uint8Array): Buffer {
  const data = Buffer.allocUnsafe(4 + body.length)
  putUint(data, putUint(data, 0, RESPONSE_ID, 2, false), endCode, 2, false)
  data.set(body, 4)
  return data
}

function write(head: Head4c, data: Uint8Array, sumCheck: boolean): Buffer {
  const plain = Buffer.allocUnsafe(2 + ROUTE_END + data.length)
  let at = putUint(plain, 0, ROUTE_END + data.length, 2, false)
  at = putUint(plain, at, FRAME_ID, 1, false)
  at = putUint(plain, at, head.station, 1, false)
  at = putUint(plain, at, head.network, 1, false)
  at = putUint(plain, at, head.pc, 1, false)
  at = putUint(plain, at, head.moduleIo, 2, false)
  at = putUint(plain, at, head.multidrop, 1, false)
  at = putUint(plain, at, head.selfStation, 1, false)
  plain.set(data, at)
  const sum = sumCheck ? sumCharacters(plain) : Buffer.alloc(0)
  return Buffer.concat([Buffer.of(DLE, STX), stuff(plain), Buffer.of(DLE, ETX), sum])
}

function sumCharacters(plain: Buffer): Buffer {
  const characters = Buffer.allocUnsafe(2)
  putUint(characters, 0, sumOf(plain), 1, true)
  return characters
}

function stuff(plain: Buffer): Buffer {
  const stuffed: number[] = []
  for (const byte of plain) {
    if (byte === DLE) stuffed.push(DLE)
    stuffed.push(byte)
  }
  return Buffer.from(stuffed)
}

interface Envelope {
  readonly used: number
  readonly head: Head4c
  readonly data: Buffer
}

function scan(bytes: Buffer, sumCheck: boolean): Envelope | undefined {
  if (bytes.length > 0 && bytes[0] !== DLE) failAt('BAD_FRAME', 0, bytes, 'a format 5 frame starts with DLE STX')
  if (bytes.length > 1 && bytes[1] !== STX) failAt('BAD_FRAME', 1, bytes, 'a format 5 frame starts with DLE STX')
  const content = unstuff(bytes)
  if (content === undefined) return undefined
  const { plain, end } = content
  const used = end + (sumCheck ? 2 : 0)
  if (bytes.length < used) return undefined
  if (sumCheck && uintAt(bytes, end, 1, true) !== sumOf(plain))
    failAt('BAD_SUM', end, bytes, 'the sum check code does not match')
  return { used, ...parse(plain) }
}

/** The bytes between DLE STX and DLE ETX without the added DLEs, and the offset behind DLE ETX. */
function unstuff(bytes: Buffer): { plain: Buffer; end: number } | undefined {
  const plain: number[] = []
  for (let at = 2; at < bytes.length; at++) {
    const byte = bytes[at] as number
    if (byte !== DLE) {
      plain.push(byte)
      continue
    }
    const next = bytes[++at]
    if (next === undefined) return undefined
    if (next === ETX) return { plain: Buffer.from(plain), end: at + 1 }
    if (next !== DLE) failAt('BAD_FRAME', at, bytes, 'DLE is followed by neither DLE nor ETX')
    plain.push(DLE)
  }
  return undefined
}

function parse(plain: Buffer): { head: Head4c; data: Buffer } {
  if (plain.length < 2 + ROUTE_END) failAt('TRUNCATED', plain.length, plain, 'the access route is not complete')
  const count = uintAt(plain, 0, 2, false)
  if (count !== plain.length - 2)
    failAt('BAD_FRAME', 0, plain, `${count} data bytes announced, ${plain.length - 2} found`)
  if (plain[2] !== FRAME_ID) failAt('BAD_FRAME', 2, plain, 'the frame ID of 4C is F8')
  const head = {
    station: uintAt(plain, 3, 1, false),
    network: uintAt(plain, 4, 1, false),
    pc: uintAt(plain, 5, 1, false),
    moduleIo: uintAt(plain, 6, 2, false),
    multidrop: uintAt(plain, 8, 1, false),
    selfStation: uintAt(plain, 9, 1, false),
  }
  return { head, data: plain.subarray(2 + ROUTE_END) }
}

function scanRequest(bytes: Buffer, sumCheck: boolean): Scanned<RequestFrame<Head4c>> | undefined {
  const found = scan(bytes, sumCheck)
  return found && { used: found.used, frame: { head: found.head, serial: undefined, body: found.data } }
}

function scanResponse(bytes: Buffer, sumCheck: boolean): Scanned<ResponseFrame<Head4c>> | undefined {
  const found = scan(bytes, sumCheck)
  if (found === undefined) return undefined
  const { used, head, data } = found
  if (data.length < 4) failAt('TRUNCATED', data.length, data, 'response ID and completion code are missing')
  if (uintAt(data, 0, 2, false) !== RESPONSE_ID) failAt('BAD_FRAME', 0, data, 'the response ID is FFFF')
  const endCode = uintAt(data, 2, 2, false)
  return { used, frame: { head, serial: undefined, endCode, body: data.subarray(4) } }
}

const ROUTE_FIELDS = [
  'station',
  'network',
  'pc',
  'moduleIo',
  'multidrop',
  'selfStation',
] as const satisfies readonly (keyof Head4c)[]

function mismatch(asked: Head4c, answered: Head): string | undefined {
  for (const field of ROUTE_FIELDS) {
    if (asked[field] !== answered[field]) return `${field} is ${answered[field]}, asked ${asked[field]}`
  }
  return undefined
}
