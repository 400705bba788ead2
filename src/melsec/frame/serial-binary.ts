// Format 5 of the serial frames, binary code (FX5 communication manual 42.2, 42.3):
//   DLE STX | data bytes | frame ID, route | data | DLE ETX | sum
// Every 10H between DLE STX and DLE ETX is doubled; byte count and sum are taken before that. The sum is two characters.
// Requests and answers have the same start: the data of an answer begin with the response ID.
import { digitValue, failAt, putUint, sumOf, uintAt } from '../../codec/codec'
import { PlcError } from '../../errors'
import type { Framing, RequestFrame, ResponseFrame, Scanned } from '../../link/link'
import {
  controlCodes,
  LONGEST_SERIAL_FRAME,
  RESPONSE_ID,
  type SerialFrameFacts,
  type SerialHead,
} from './serial-frames'
import { putSerialHead, serialHeadAt, serialHeadSize } from './serial-head'

const { DLE, STX, ETX } = controlCodes
const COUNT = 2
/** Response ID and completion or error code. */
const RESPONSE_HEAD = 4

export function format5(facts: SerialFrameFacts, sumCheck: boolean): Pick<Framing<SerialHead>, 'request' | 'response'> {
  return {
    request: {
      write: (head, _serial, body) => write(facts, head, body, sumCheck),
      scan: (bytes) => scanRequest(facts, bytes, sumCheck),
      // On a shared line a station hears the answers of the others.
      noise: (bytes) => noiseIn(facts, bytes, sumCheck, (first) => first === RESPONSE_ID),
    },
    response: {
      write: (head, _serial, endCode, body) => write(facts, head, responseData(endCode, body), sumCheck),
      scan: (bytes) => scanResponse(facts, bytes, sumCheck),
      // Half-duplex converters give back what was sent.
      noise: (bytes) => noiseIn(facts, bytes, sumCheck, (first) => first !== RESPONSE_ID),
    },
  }
}

// --- writing

function responseData(endCode: number, body: Uint8Array): Buffer {
  const data = Buffer.allocUnsafe(RESPONSE_HEAD + body.length)
  putUint(data, putUint(data, 0, RESPONSE_ID, 2, false), endCode, 2, false)
  data.set(body, RESPONSE_HEAD)
  return data
}

function write(facts: SerialFrameFacts, head: SerialHead, data: Uint8Array, sumCheck: boolean): Buffer {
  const size = serialHeadSize(facts, false) + data.length
  const plain = Buffer.allocUnsafe(COUNT + size)
  plain.set(data, putSerialHead(facts, plain, putUint(plain, 0, size, 2, false), head, false))
  const doubled = plain.reduce((count, byte) => count + (byte === DLE ? 1 : 0), 0)
  const frame = Buffer.allocUnsafe(2 + plain.length + doubled + 2 + (sumCheck ? 2 : 0))
  let at = put(frame, 0, STX)
  for (const byte of plain) at = byte === DLE ? put(frame, at, DLE) : putUint(frame, at, byte, 1, false)
  at = put(frame, at, ETX)
  if (sumCheck) putUint(frame, at, sumOf(plain), 1, true)
  return frame
}

/** DLE and what it says. */
function put(frame: Buffer, at: number, code: number): number {
  frame[at] = DLE
  frame[at + 1] = code
  return at + 2
}

// --- reading

/** What stands between DLE STX and DLE ETX. */
interface Content {
  /** Without the added DLEs. */
  readonly plain: Buffer
  /** Offset behind DLE ETX. */
  readonly end: number
}

/** `undefined` when more bytes are needed. @throws ProtocolError when the bytes are no frame; the sum is not looked at */
function contentOf(facts: SerialFrameFacts, bytes: Buffer): Content | undefined {
  if (bytes.length > 0 && bytes[0] !== DLE) failAt('BAD_FRAME', 0, bytes, 'a format 5 frame starts with DLE STX')
  if (bytes.length > 1 && bytes[1] !== STX) failAt('BAD_FRAME', 1, bytes, 'a format 5 frame starts with DLE STX')
  const plain = Buffer.allocUnsafe(Math.min(Math.max(0, bytes.length - 2), COUNT + LONGEST_SERIAL_FRAME))
  let length = 0
  for (let at = 2; at < bytes.length; at++) {
    const byte = bytes[at] as number
    if (byte === DLE) {
      const next = bytes[++at]
      if (next === undefined) return undefined
      if (next === ETX) return { plain: checked(facts, plain.subarray(0, length)), end: at + 1 }
      if (next !== DLE) failAt('BAD_FRAME', at, bytes, 'DLE is followed by neither DLE nor ETX')
    }
    plain[length++] = byte
    if (length >= COUNT) checkCount(bytes, plain, length)
  }
  return undefined
}

/** As soon as more came than was announced it is no frame, so that a broken one does not take the next along. */
function checkCount(bytes: Buffer, plain: Buffer, length: number): void {
  const count = uintAt(plain, 0, COUNT, false)
  if (count > LONGEST_SERIAL_FRAME) failAt('BAD_FRAME', 2, bytes, `${count} data bytes announced, no frame has so many`)
  if (length > COUNT + count) failAt('BAD_FRAME', 2, bytes, `${count} data bytes announced, more found`)
}

function checked(facts: SerialFrameFacts, plain: Buffer): Buffer {
  if (plain.length < COUNT + serialHeadSize(facts, false)) {
    failAt('TRUNCATED', plain.length, plain, 'the access route is not complete')
  }
  const count = uintAt(plain, 0, COUNT, false)
  const found = plain.length - COUNT
  if (count !== found) failAt('BAD_FRAME', 0, plain, `${count} data bytes announced, ${found} found`)
  return plain
}

interface Envelope {
  readonly used: number
  readonly head: SerialHead
  readonly data: Buffer
}

function scan(facts: SerialFrameFacts, bytes: Buffer, sumCheck: boolean): Envelope | undefined {
  const content = contentOf(facts, bytes)
  if (content === undefined) return undefined
  const { plain, end } = content
  const used = end + (sumCheck ? 2 : 0)
  if (bytes.length < used) return undefined
  if (sumCheck && !isSum(bytes, end, sumOf(plain))) failAt('BAD_SUM', end, bytes, 'the sum check code does not match')
  return { used, head: serialHeadAt(facts, plain, COUNT, false), data: dataOf(facts, plain) }
}

function isSum(bytes: Buffer, at: number, sum: number): boolean {
  const [high = 0, low = 0] = bytes.subarray(at, at + 2)
  return digitValue(high) === sum >> 4 && digitValue(low) === (sum & 15)
}

function dataOf(facts: SerialFrameFacts, plain: Buffer): Buffer {
  return plain.subarray(COUNT + serialHeadSize(facts, false))
}

function scanRequest(
  facts: SerialFrameFacts,
  bytes: Buffer,
  sumCheck: boolean,
): Scanned<RequestFrame<SerialHead>> | undefined {
  const found = scan(facts, bytes, sumCheck)
  return found && { used: found.used, frame: { head: found.head, serial: undefined, body: found.data } }
}

function scanResponse(
  facts: SerialFrameFacts,
  bytes: Buffer,
  sumCheck: boolean,
): Scanned<ResponseFrame<SerialHead>> | undefined {
  const found = scan(facts, bytes, sumCheck)
  if (found === undefined) return undefined
  const { used, head, data } = found
  if (data.length < RESPONSE_HEAD) {
    failAt('TRUNCATED', data.length, data, 'response ID and completion code are missing')
  }
  if (uintAt(data, 0, 2, false) !== RESPONSE_ID) failAt('BAD_FRAME', 0, data, 'the response ID is FFFF')
  const endCode = uintAt(data, 2, 2, false)
  return { used, frame: { head, serial: undefined, endCode, body: data.subarray(RESPONSE_HEAD) } }
}

// --- noise

/** What stands in front of the first frame that may be of this side; a whole frame of the other side is noise too. */
function noiseIn(
  facts: SerialFrameFacts,
  bytes: Buffer,
  sumCheck: boolean,
  isOther: (firstWord: number) => boolean,
): number {
  let at = startFrom(bytes, 0)
  for (;;) {
    const length = otherAt(facts, bytes.subarray(at), sumCheck, isOther)
    if (length === 0) return at
    at = startFrom(bytes, at + length)
  }
}

/** Offset of the next DLE STX that may begin a frame, or of what may become one. */
function startFrom(bytes: Buffer, from: number): number {
  for (let at = bytes.indexOf(DLE, from); at >= 0; at = bytes.indexOf(DLE, at + 1)) {
    const [, second = STX, third = 0, fourth = DLE] = bytes.subarray(at, at + 4)
    // Behind DLE STX a single DLE is no content: there the frame begins.
    if (second === STX && (third !== DLE || fourth === DLE)) return at
  }
  return bytes.length
}

/** Length of the whole frame of the other side at the front; 0 when there is none. Its sum is nobody's business here. */
function otherAt(
  facts: SerialFrameFacts,
  bytes: Buffer,
  sumCheck: boolean,
  isOther: (firstWord: number) => boolean,
): number {
  try {
    const content = contentOf(facts, bytes)
    const data = content && dataOf(facts, content.plain)
    if (content === undefined || data === undefined || data.length < 2 || !isOther(uintAt(data, 0, 2, false))) return 0
    const length = content.end + (sumCheck ? 2 : 0)
    return length <= bytes.length ? length : 0
  } catch (error) {
    if (error instanceof PlcError) return 0
    throw error
  }
}
