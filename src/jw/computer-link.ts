// The computer link over serial lines: the communication port of a CU, and a JW-21CM as CL2 (JW300 hardware manual 7-33 to 7-35,
// JW-32CUM1 manual 7-15). Only the frame is known:
//   command    : AD AD ? RI  content  SC SC CR
//   response   : AD AD # RI  content  SC SC CR
//   error      : AD AD % RI  EC EC    SC SC CR
// Of the commands one is printed (MRL with the number of a relay), of the data of answers none, nor how long a frame gets, speed,
// parity or time-outs. So the content is raw characters here, and no client sends it. Assumed: RI comes before EC (read from a
// figure), and no content holds a colon.
import { octal } from '../basics/octal'
import { badMessage, digitValue, failAt, putUint, sumOf, uintAt } from '../codec/codec'
import type { Framing, Head, RequestFrame, ResponseFrame, Scanned } from '../link/link'

/** What stands in front of the content. */
export type ComputerLinkHead = {
  /** 0 to 31, on the wire two octal digits. One page prints 01 to 37, another 00 to 37. */
  readonly station: number
  /** RI, 0 to 15: how long the PLC waits with its answer, see `responseTimes`. */
  readonly responseTime: number
}

export interface ComputerLinkOptions {
  /** `false`: commands carry `@@` in place of the sum, and the unit does not check them. Answers carry a sum always. Default true. */
  readonly sumCheck?: boolean
}

/** ms that the PLC waits by RI, and besides for one scan. */
export const responseTimes = [0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 200, 300, 400, 500, 600] as const

const START = 0x3a // :
const CR = 0x0d
const UNCHECKED = 0x40 // @
const KINDS = { command: 0x3f, response: 0x23, error: 0x25 } as const // ? # %
const LAST_STATION = 0o37
const LAST_CODE = 0xff
/** Start, station, kind, RI: the content follows. */
const CONTENT = 5
const SUM = 2
/** No length is printed. 1024 bytes as digits, which is the most of a command over Ethernet, fit in twice. */
const LONGEST = 4096
/** No control code is printed that would bring the PLC to a known state. */
const NOTHING = Buffer.alloc(0)

/**
 * Framing of the computer link; the body of a frame is its content.
 * @example computerLinkFrame().request.write({ station: 1, responseTime: 4 }, 0, Buffer.from('MRL002000'))   // :01?4MRL0020001F
 */
export function computerLinkFrame(options: ComputerLinkOptions = {}): Framing<ComputerLinkHead> {
  const { sumCheck = true } = options
  return {
    name: 'JW computer link',
    correlation: 'order',
    recovery: NOTHING,
    request: {
      write: (head, _serial, content) => write('command', head, content, sumCheck),
      scan: scanRequest,
      noise: (bytes) => noiseIn(bytes, [KINDS.command]),
    },
    response: {
      write: (head, _serial, endCode, content) =>
        endCode === 0 ? write('response', head, content, true) : write('error', head, codeDigits(endCode), true),
      scan: scanResponse,
      noise: (bytes) => noiseIn(bytes, [KINDS.response, KINDS.error]),
    },
    mismatch,
  }
}

function mismatch(asked: ComputerLinkHead, { station }: Head): string | undefined {
  return station === asked.station ? undefined : `station is ${station}, asked ${asked.station}`
}

// --- writing

function write(kind: keyof typeof KINDS, head: ComputerLinkHead, content: Uint8Array, sumCheck: boolean): Buffer {
  const { station, responseTime } = head
  checkWhole('station', station, LAST_STATION)
  checkWhole('responseTime', responseTime, responseTimes.length - 1)
  const end = CONTENT + content.length
  const size = end + SUM + 1
  if (size > LONGEST) badMessage(`a frame of the computer link has at most ${LONGEST} characters here, not ${size}`)
  const other = content.find((byte) => !isContent(byte))
  if (other !== undefined) badMessage(`the content holds printable characters other than a colon, not ${other}`)
  const frame = Buffer.alloc(size)
  frame[0] = START
  frame.write(octal(station, 2), 1, 'latin1')
  frame[3] = KINDS[kind]
  frame.write(responseTime.toString(16).toUpperCase(), 4, 'latin1')
  frame.set(content, CONTENT)
  if (sumCheck) putUint(frame, end, checkOf(frame, end), 1, true)
  else frame.fill(UNCHECKED, end, end + SUM)
  frame[end + SUM] = CR
  return frame
}

function codeDigits(endCode: number): Buffer {
  checkWhole('error code', endCode, LAST_CODE)
  const digits = Buffer.alloc(SUM)
  putUint(digits, 0, endCode, 1, true)
  return digits
}

function checkWhole(name: string, value: number, last: number): void {
  if (Number.isInteger(value) && value >= 0 && value <= last) return
  badMessage(`${name} is ${value}, must be 0 to ${last}`)
}

function isContent(byte: number): boolean {
  return byte >= 0x20 && byte <= 0x7e && byte !== START
}

/** Two's complement of the sum from the station to the end of the content. */
function checkOf(frame: Buffer, end: number): number {
  return -sumOf(frame, 1, end) & 0xff
}

// --- reading

/** A whole frame, as far as it is common to all kinds. */
interface Line {
  readonly used: number
  readonly kind: number
  readonly head: ComputerLinkHead
  readonly content: Buffer
  /** Offset of the sum. */
  readonly end: number
}

/** `undefined` while the frame may still be coming. */
function lineIn(bytes: Buffer): Line | undefined {
  if (bytes.length === 0) return undefined
  if (bytes[0] !== START) failAt('BAD_FRAME', 0, bytes, 'a frame starts with a colon')
  let at = 1
  while (at < bytes.length && isContent(bytes[at] as number)) at++
  if (at > LONGEST) failAt('BAD_FRAME', at, bytes, 'a frame does not get so long')
  if (at === bytes.length) return undefined
  if (bytes[at] !== CR) failAt('BAD_FRAME', at, bytes, 'CR is missing behind the frame')
  const end = at - SUM
  if (end < CONTENT) failAt('TRUNCATED', at, bytes, 'the frame ends before it is complete')
  const head = { station: stationAt(bytes), responseTime: digitAt(bytes, 4) }
  return { used: at + 1, kind: bytes[3] as number, head, content: bytes.subarray(CONTENT, end), end }
}

function stationAt(bytes: Buffer): number {
  const station = digitAt(bytes, 1) * 8 + digitAt(bytes, 2)
  if (digitAt(bytes, 1) > 3 || digitAt(bytes, 2) > 7) failAt('BAD_FIELD', 1, bytes, 'a station is 00 to 37 octal')
  return station
}

function digitAt(bytes: Buffer, at: number): number {
  const value = digitValue(bytes[at] as number)
  return value >= 0 ? value : failAt('BAD_DIGIT', at, bytes, 'not a digit')
}

function checkSum(bytes: Buffer, end: number): void {
  const found = digitValue(bytes[end] as number) * 16 + digitValue(bytes[end + 1] as number)
  if (found === checkOf(bytes, end) && digitValue(bytes[end + 1] as number) >= 0) return
  failAt('BAD_SUM', end, bytes, 'the sum check code does not match')
}

function scanRequest(bytes: Buffer): Scanned<RequestFrame<ComputerLinkHead>> | undefined {
  const line = lineIn(bytes)
  if (line === undefined) return undefined
  const { used, kind, head, content, end } = line
  if (kind !== KINDS.command) failAt('BAD_FRAME', 3, bytes, 'a command has a question mark behind its station')
  if (bytes[end] !== UNCHECKED || bytes[end + 1] !== UNCHECKED) checkSum(bytes, end)
  return { used, frame: { head, serial: undefined, body: content } }
}

function scanResponse(bytes: Buffer): Scanned<ResponseFrame<ComputerLinkHead>> | undefined {
  const line = lineIn(bytes)
  if (line === undefined) return undefined
  const { used, kind, head, content, end } = line
  if (kind !== KINDS.response && kind !== KINDS.error)
    failAt('BAD_FRAME', 3, bytes, 'an answer has # or % behind its station')
  checkSum(bytes, end)
  if (kind === KINDS.response) return { used, frame: { head, serial: undefined, endCode: 0, body: content } }
  if (content.length !== SUM) failAt('BAD_FRAME', CONTENT, bytes, 'an error has a code of two digits')
  const endCode = uintAt(bytes, CONTENT, 1, true)
  // 0 would be success everywhere else.
  if (endCode === 0) failAt('BAD_FIELD', CONTENT, bytes, 'an error has the code 00')
  return { used, frame: { head, serial: undefined, endCode, body: Buffer.alloc(0) } }
}

/** Up to where a frame of one of the kinds begins, or may begin. So the echo of a command is noise to who waits for its answer. */
function noiseIn(bytes: Buffer, kinds: readonly number[]): number {
  for (let at = bytes.indexOf(START); at >= 0; at = bytes.indexOf(START, at + 1)) {
    const [, high, low, kind] = bytes.subarray(at, at + 4)
    const isStation = [high, low].every((digit) => digit === undefined || (digit >= 0x30 && digit <= 0x37))
    if (isStation && (kind === undefined || kinds.includes(kind))) return at
  }
  return bytes.length
}
