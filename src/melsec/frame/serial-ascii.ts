// Formats 1 and 4 of the serial frames (FX5 communication manual 42.2):
//   request             ENQ | frame ID, route | data | sum
//   answer with data    STX | frame ID, route | data | ETX | sum
//   answer without      ACK | frame ID, route
//   refusal             NAK | frame ID, route | error code
// Format 4 has CR LF behind each. Between the codes stand printable characters only, so the next code of any kind ends
// what was begun: a frame that lost its end does not take the next one along.
import { badMessage, digitValue, failAt, putUint, sumOf, uintAt } from '../../codec/codec'
import type { BodyLength, Framing, RequestFrame, ResponseFrame, Scanned } from '../../link/link'
import { controlCodes, LONGEST_SERIAL_FRAME, type SerialFrameFacts, type SerialHead } from './serial-frames'
import { putSerialHead, serialHeadAt, serialHeadSize } from './serial-head'

export interface AsciiLayout {
  readonly facts: SerialFrameFacts
  readonly crLf: boolean
  readonly sumCheck: boolean
  readonly etxInSum: boolean
  readonly sumOfAck: boolean
  readonly errorDigits: 2 | 4
}

const { STX, ETX, ENQ, ACK, NAK, CR, LF } = controlCodes
const EMPTY = Buffer.alloc(0)
const SUM = 2

export function asciiFraming(layout: AsciiLayout): Pick<Framing<SerialHead>, 'request' | 'response'> {
  return {
    request: {
      write: (head, _serial, body) => write(layout, { start: ENQ, sum: layout.sumCheck }, head, body),
      scan: (bytes, bodyLength) => scanRequest(layout, bytes, bodyLength),
      noise: (bytes) => noiseIn(bytes, isRequestStart),
    },
    response: {
      write: (head, _serial, endCode, body) => writeResponse(layout, head, endCode, body),
      scan: (bytes) => scanResponse(layout, bytes),
      noise: (bytes) => noiseIn(bytes, isResponseStart),
    },
  }
}

function isCharacter(byte: number): boolean {
  return byte >= 0x20 && byte <= 0x7e
}

const isRequestStart = (byte: number) => byte === ENQ
const isResponseStart = (byte: number) => byte === STX || byte === ACK || byte === NAK

/** A start code that no character follows starts nothing. The echo of a request has no start code of an answer. */
function noiseIn(bytes: Buffer, isStart: (byte: number) => boolean): number {
  for (let at = 0; at < bytes.length; at++) {
    if (!isStart(bytes[at] as number)) continue
    const next = bytes[at + 1]
    if (next === undefined || isCharacter(next)) return at
  }
  return bytes.length
}

// --- writing

/** What encloses the characters of a frame. */
interface Enclosure {
  readonly start: number
  readonly end?: number
  readonly sum: boolean
}

function writeResponse(layout: AsciiLayout, head: SerialHead, endCode: number, body: Uint8Array): Buffer {
  const { sumCheck, sumOfAck, errorDigits } = layout
  if (endCode === 0 && body.length > 0) return write(layout, { start: STX, end: ETX, sum: sumCheck }, head, body)
  const sum = sumCheck && sumOfAck
  if (endCode === 0) return write(layout, { start: ACK, sum }, head, EMPTY)
  if (errorDigits === 2 && endCode > 0xff) badMessage(`error code ${endCode} does not fit into ${errorDigits} digits`)
  const code = Buffer.allocUnsafe(errorDigits)
  putUint(code, 0, endCode, errorDigits === 2 ? 1 : 2, true)
  return write(layout, { start: NAK, sum }, head, code)
}

/** @throws RequestError BAD_MESSAGE for a byte of a body that would end its frame */
export function checkCharacters(body: Uint8Array): void {
  const other = body.find((byte) => !isCharacter(byte))
  if (other === undefined) return
  badMessage(`a serial frame in ASCII code carries printable characters only, not ${other}`)
}

function write(layout: AsciiLayout, { start, end, sum }: Enclosure, head: SerialHead, body: Uint8Array): Buffer {
  const { facts, crLf, etxInSum } = layout
  const size = 1 + serialHeadSize(facts, true) + body.length
  const frame = Buffer.allocUnsafe(size + (end === undefined ? 0 : 1) + (sum ? SUM : 0) + (crLf ? 2 : 0))
  frame[0] = start
  let at = putSerialHead(facts, frame, 1, head, true)
  checkCharacters(body)
  frame.set(body, at)
  at += body.length
  if (end !== undefined) frame[at++] = end
  if (sum) at = putUint(frame, at, sumOf(frame, 1, end !== undefined && etxInSum ? at : size), 1, true)
  if (crLf) frame.set([CR, LF], at)
  return frame
}

// --- reading

/** Offset of the first byte behind the start code that is no character; the length where all of them are. */
function endOfCharacters(bytes: Buffer): number {
  let at = 1
  while (at < bytes.length && isCharacter(bytes[at] as number)) at++
  if (at > LONGEST_SERIAL_FRAME) failAt('BAD_FRAME', at, bytes, 'a frame does not get so long')
  return at
}

function scanRequest(
  layout: AsciiLayout,
  bytes: Buffer,
  bodyLength: BodyLength<SerialHead>,
): Scanned<RequestFrame<SerialHead>> | undefined {
  if (bytes.length === 0) return undefined
  if (bytes[0] !== ENQ) failAt('BAD_FRAME', 0, bytes, 'a request starts with ENQ')
  const { facts, crLf, sumCheck } = layout
  const end = endOfCharacters(bytes)
  const dataAt = 1 + serialHeadSize(facts, true)
  const behind = sumCheck ? SUM : 0
  if (crLf) return scanLine(layout, bytes, end, dataAt + behind, () => requestOf(layout, bytes, end - behind))
  if (end < dataAt) return cut(bytes, end)
  const length = bodyLength(serialHeadAt(facts, bytes, 1, true), bytes.subarray(dataAt, end))
  if (length === undefined || end < dataAt + length + behind) return cut(bytes, end)
  const used = dataAt + length + behind
  checkEnd(bytes, used, end)
  return { used, frame: requestOf(layout, bytes, dataAt + length) }
}

function requestOf(layout: AsciiLayout, bytes: Buffer, bodyEnd: number): RequestFrame<SerialHead> {
  if (layout.sumCheck) checkSum(bytes, bodyEnd, bodyEnd)
  const { head, body } = contentOf(layout, bytes, bodyEnd)
  return { head, serial: undefined, body }
}

function contentOf({ facts }: AsciiLayout, bytes: Buffer, end: number): { head: SerialHead; body: Buffer } {
  return { head: serialHeadAt(facts, bytes, 1, true), body: bytes.subarray(1 + serialHeadSize(facts, true), end) }
}

/** Characters that end before the frame does: more may come, unless something else has come. */
function cut(bytes: Buffer, end: number): undefined {
  if (end < bytes.length) failAt('TRUNCATED', end, bytes, 'the frame ends before it is complete')
  return undefined
}

/** In format 1 nothing marks the end: characters that are left over show that something else is wrong. */
function checkEnd(bytes: Buffer, used: number, end: number): void {
  if (end > used) failAt('TRAILING', used, bytes, 'characters follow the frame (does the PLC add a sum check code?)')
}

/** A frame of format 4 that has no other end than CR LF behind its characters. */
function scanLine<F>(
  layout: AsciiLayout,
  bytes: Buffer,
  end: number,
  least: number,
  read: () => F,
): Scanned<F> | undefined {
  if (end === bytes.length) return undefined
  if (!hasEnd(layout, bytes, end)) return undefined
  if (end < least) failAt('TRUNCATED', end, bytes, 'the frame ends before it is complete')
  return { used: end + 2, frame: read() }
}

/** Whether CR LF is there, where the format has it. */
function hasEnd({ crLf }: AsciiLayout, bytes: Buffer, at: number): boolean {
  if (!crLf) return true
  if (bytes.length > at && bytes[at] !== CR) failAt('BAD_FRAME', at, bytes, 'CR LF is missing behind the frame')
  if (bytes.length > at + 1 && bytes[at + 1] !== LF) failAt('BAD_FRAME', at + 1, bytes, 'LF is missing behind CR')
  return bytes.length > at + 1
}

/** The sum stands at `at` and is that of the bytes from behind the start code to before `end`. */
function checkSum(bytes: Buffer, at: number, end: number): void {
  const [high = 0, low = 0] = bytes.subarray(at, at + SUM)
  if (digitValue(high) * 16 + digitValue(low) === sumOf(bytes, 1, end) && digitValue(low) >= 0) return
  failAt('BAD_SUM', at, bytes, 'the sum check code does not match')
}

function scanResponse(layout: AsciiLayout, bytes: Buffer): Scanned<ResponseFrame<SerialHead>> | undefined {
  const [start] = bytes
  if (start === undefined) return undefined
  if (!isResponseStart(start)) failAt('BAD_FRAME', 0, bytes, 'an answer starts with STX, ACK or NAK')
  const end = endOfCharacters(bytes)
  return start === STX ? scanData(layout, bytes, end) : scanShort(layout, bytes, end)
}

function scanData(layout: AsciiLayout, bytes: Buffer, end: number): Scanned<ResponseFrame<SerialHead>> | undefined {
  if (end === bytes.length) return undefined
  if (bytes[end] !== ETX) failAt('BAD_FRAME', end, bytes, 'ETX is missing behind the data')
  const used = end + 1 + (layout.sumCheck ? SUM : 0)
  if (bytes.length < used || !hasEnd(layout, bytes, used)) return undefined
  if (layout.sumCheck) checkSum(bytes, end + 1, layout.etxInSum ? end + 1 : end)
  if (end < 1 + serialHeadSize(layout.facts, true)) failAt('TRUNCATED', end, bytes, 'the access route is not complete')
  if (!layout.crLf && isCharacter(bytes[used] ?? 0)) checkEnd(bytes, used, used + 1)
  const { head, body } = contentOf(layout, bytes, end)
  return { used: layout.crLf ? used + 2 : used, frame: { head, serial: undefined, endCode: 0, body } }
}

/** ACK and NAK: always of the same length. */
function scanShort(layout: AsciiLayout, bytes: Buffer, end: number): Scanned<ResponseFrame<SerialHead>> | undefined {
  const { facts, crLf, sumCheck, sumOfAck, errorDigits } = layout
  const codeAt = 1 + serialHeadSize(facts, true)
  const codeEnd = codeAt + (bytes[0] === NAK ? errorDigits : 0)
  const used = codeEnd + (sumCheck && sumOfAck ? SUM : 0)
  if (end < used) return cut(bytes, end)
  checkEnd(bytes, used, end)
  if (!hasEnd(layout, bytes, used)) return undefined
  if (used > codeEnd) checkSum(bytes, codeEnd, codeEnd)
  const { head } = contentOf(layout, bytes, codeAt)
  const endCode = bytes[0] === NAK ? uintAt(bytes, codeAt, errorDigits === 2 ? 1 : 2, true) : 0
  if (bytes[0] === NAK && endCode === 0) failAt('BAD_FIELD', codeAt, bytes, 'NAK carries no error code')
  const frame = { head, serial: undefined, endCode, body: EMPTY }
  if (crLf) return { used: used + 2, frame }
  // Nothing marks its end: a NAK that was read as ACK, or data that were read as NAK, differ in what follows only.
  return used > codeEnd ? { used, frame } : { used, frame, endsWithSilence: true }
}
