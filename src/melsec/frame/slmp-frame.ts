// The 3E, 4E and station extension frames (SLMP reference manual 4.1, 4.2): one layout. 4E adds a serial number in its
// subheader, the station extension frame also a fixed 00H and the extension station number behind the multidrop number.
import { type DataCode, failAt, isSameDigit, putUint, uintAt } from '../../codec/codec'
import { RequestError } from '../../errors'
import type { Framing, Head, RequestFrame, ResponseFrame, Scanned } from '../../link/link'

import { type BodyLayout, bodies } from './body'
import { frameFacts, type SlmpFrameName, slmpFrameNames } from './frames'
import type { Route } from './route'

/** What stands in front of the body: the route, and what a request says beside. */
export type SlmpHead = Route & {
  /** Monitoring timer in units of 250 ms, 0 = wait for ever; an answer has none. */
  readonly timer: number
}

/** Framing of the SLMP set: also says what stands around the data of a command. */
export interface SlmpFraming extends Framing<SlmpHead> {
  readonly body: BodyLayout
}

interface Layout {
  readonly ascii: boolean
  /** Serial number in the subheader. */
  readonly serial: boolean
  /** Extension station number: the station extension frame. */
  readonly extension: boolean
}

/** First byte of the subheader in binary code; in ASCII code its two hexadecimal digits. The second byte is always 00. */
const SUBHEADER = {
  '3E': { request: 0x50, response: 0xd0 },
  '4E': { request: 0x54, response: 0xd4 },
  ext: { request: 0x68, response: 0xe8 },
} as const satisfies Readonly<Record<SlmpFrameName, object>>

/** network 1, station 1, module I/O 2, multidrop 1, data length 2 */
const ROUTE_AND_LENGTH = 7
/** fixed 00H 1, extension station number 2 */
const EXTENSION = 3

/**
 * Framing of 3E (no serial number, answers by order), 4E (serial number) or the station extension frame (serial number,
 * extension station number; binary code only).
 * @throws RequestError BAD_OPTION for the station extension frame in ASCII code
 * @example const framing = slmpFraming('4E', 'binary')
 */
export function slmpFraming(frame: SlmpFrameName, code: DataCode): SlmpFraming {
  if (!frameFacts[frame].codes.includes(code)) {
    throw new RequestError('BAD_OPTION', `The ${frameFacts[frame].title} frame has no ${code} code.`, 'code')
  }
  const layout: Layout = { ascii: code === 'ascii', serial: frameFacts[frame].serial, extension: frame === 'ext' }
  const { request, response } = SUBHEADER[frame]
  return {
    name: `${frame} ${code}`,
    body: bodies[frame],
    correlation: layout.serial ? 'serial' : 'order',
    request: {
      write: (head, serial, body) => write(layout, request, serial, head, head.timer, body),
      scan: (bytes) => scanRequest(layout, request, bytes),
    },
    response: {
      write: (head, serial, endCode, body) => write(layout, response, serial, head, endCode, body),
      scan: (bytes) => scanResponse(layout, response, bytes),
      isUnsolicited: (bytes) => startsWith(bytes, layout.ascii, request),
    },
    mismatch,
  }
}

function startsWith(bytes: Buffer, ascii: boolean, subheader: number): boolean {
  return bytes[0] === (ascii ? 0x30 + (subheader >> 4) : subheader)
}

/** `timerOrEndCode` is the two-byte field in front of the body: request and response differ in nothing else. */
function write(
  layout: Layout,
  subheader: number,
  serial: number,
  route: Route,
  timerOrEndCode: number,
  body: Uint8Array,
): Buffer {
  const { ascii } = layout
  const unit = ascii ? 2 : 1
  const frame = Buffer.allocUnsafe(headSize(layout) + 2 * unit + body.length)
  let at = putUint(frame, 0, subheader, 1, ascii)
  at = putUint(frame, at, 0, 1, ascii)
  if (layout.serial) {
    at = putUint(frame, at, serial, 2, ascii)
    at = putUint(frame, at, 0, 2, ascii)
  }
  at = putUint(frame, at, route.network, 1, ascii)
  at = putUint(frame, at, route.station, 1, ascii)
  at = putUint(frame, at, route.moduleIo, 2, ascii)
  at = putUint(frame, at, route.multidrop, 1, ascii)
  if (layout.extension) {
    at = putUint(frame, at, 0, 1, ascii)
    at = putUint(frame, at, route.extensionStation ?? 0, 2, ascii)
  } else if (route.extensionStation !== undefined) refuseExtension(route.extensionStation)
  at = putUint(frame, at, 2 * unit + body.length, 2, ascii)
  at = putUint(frame, at, timerOrEndCode, 2, ascii)
  frame.set(body, at)
  return frame
}

/** Left out, the request would go to another station. The options of a client refuse it before. */
function refuseExtension(station: number): never {
  const message = `Extension station ${station} needs the ${frameFacts.ext.title} frame.`
  throw new RequestError('BAD_OPTION', message, 'route.extensionStation')
}

/** Bytes up to and including the data length. */
function headSize(layout: Layout): number {
  return (layout.serial ? 6 : 2) * (layout.ascii ? 2 : 1) + routeSize(layout)
}

function routeSize(layout: Layout): number {
  return (ROUTE_AND_LENGTH + (layout.extension ? EXTENSION : 0)) * (layout.ascii ? 2 : 1)
}

interface Envelope {
  readonly used: number
  readonly serial: number | undefined
  readonly head: SlmpHead
  readonly timerOrEndCode: number
  readonly body: Buffer
}

function scanRequest(layout: Layout, subheader: number, bytes: Buffer): Scanned<RequestFrame<SlmpHead>> | undefined {
  const found = scan(layout, subheader, bytes)
  if (found === undefined) return undefined
  const { used, serial, head, timerOrEndCode, body } = found
  return { used, frame: { head: { ...head, timer: timerOrEndCode }, serial, body } }
}

function scanResponse(layout: Layout, subheader: number, bytes: Buffer): Scanned<ResponseFrame<SlmpHead>> | undefined {
  const found = scan(layout, subheader, bytes)
  if (found === undefined) return undefined
  const { used, serial, head, timerOrEndCode, body } = found
  return { used, frame: { head, serial, endCode: timerOrEndCode, body } }
}

/** The head has no timer: what stands in its place is `timerOrEndCode`. */
function scan(layout: Layout, subheader: number, bytes: Buffer): Envelope | undefined {
  const { ascii } = layout
  const unit = ascii ? 2 : 1
  checkSubheader(layout, subheader, bytes)
  const head = headSize(layout)
  if (bytes.length < head) return undefined
  const length = uintAt(bytes, head - 2 * unit, 2, ascii)
  if (length < 2 * unit)
    failAt('BAD_FRAME', head - 2 * unit, bytes, `data length ${length} is shorter than what must follow`)
  const used = head + length
  if (bytes.length < used) return undefined
  const routeAt = head - routeSize(layout)
  const found = {
    network: uintAt(bytes, routeAt, 1, ascii),
    station: uintAt(bytes, routeAt + unit, 1, ascii),
    moduleIo: uintAt(bytes, routeAt + 2 * unit, 2, ascii),
    multidrop: uintAt(bytes, routeAt + 4 * unit, 1, ascii),
    timer: 0,
  }
  return {
    used,
    serial: layout.serial ? uintAt(bytes, 2 * unit, 2, ascii) : undefined,
    head: layout.extension ? { ...found, extensionStation: extensionAt(bytes, routeAt + 5) } : found,
    timerOrEndCode: uintAt(bytes, head, 2, ascii),
    body: bytes.subarray(head + 2 * unit, used),
  }
}

/** Binary code only. */
function extensionAt(bytes: Buffer, at: number): number {
  if (bytes[at] !== 0) failAt('BAD_FRAME', at, bytes, 'the byte before the extension station number is fixed to 0')
  return uintAt(bytes, at + 1, 2, false)
}

/**
 * Compares as much of the subheader as has arrived: bytes that can never become a frame are found at once and not
 * only when enough of them have come.
 */
function checkSubheader(layout: Layout, subheader: number, bytes: Buffer): void {
  const expected = fixedBytes(layout, subheader)
  const serialEnd = layout.ascii ? 8 : 4
  for (let i = 0; i < expected.length && i < bytes.length; i++) {
    if (layout.serial && i >= expected.length / 3 && i < serialEnd) continue
    if (bytes[i] !== expected[i] && !(layout.ascii && isSameDigit(bytes[i], expected[i])))
      failAt('BAD_FRAME', i, bytes, 'not the subheader of this frame and data code')
  }
}

/** The subheader with 0 for the serial number. */
function fixedBytes(layout: Layout, subheader: number): Buffer {
  const known = FIXED.get(key(subheader, layout.ascii))
  if (known === undefined) throw new TypeError(`no subheader ${subheader}`)
  return known
}

function key(subheader: number, ascii: boolean): number {
  return subheader * 2 + (ascii ? 1 : 0)
}

const FIXED = new Map<number, Buffer>()
for (const frame of slmpFrameNames) {
  const { serial, codes } = frameFacts[frame]
  for (const subheader of Object.values(SUBHEADER[frame])) {
    for (const ascii of codes.map((code) => code === 'ascii')) {
      const fixed = Buffer.alloc((serial ? 6 : 2) * (ascii ? 2 : 1), ascii ? 0x30 : 0)
      putUint(fixed, 0, subheader, 1, ascii)
      FIXED.set(key(subheader, ascii), fixed)
    }
  }
}

/** The route fields are echoed (SLMP reference manual 4.2). */
function mismatch(asked: Route, answered: Head): string | undefined {
  // Each by its name: a loop over names looks every field up anew, with every answer.
  return (
    differs('network', asked.network, answered.network) ??
    differs('station', asked.station, answered.station) ??
    differs('moduleIo', asked.moduleIo, answered.moduleIo) ??
    differs('multidrop', asked.multidrop, answered.multidrop) ??
    differs('extensionStation', asked.extensionStation ?? 0, answered.extensionStation ?? 0)
  )
}

function differs(field: keyof Route, asked: number, found: number | undefined): string | undefined {
  return asked === found ? undefined : `${field} is ${found}, asked ${asked}`
}
