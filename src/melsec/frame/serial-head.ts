// Frame ID and route, as they stand behind the start code of a serial frame.
import { failAt, putUint, uintAt } from '../../codec/codec'
import { type SerialFrameFacts, type SerialHead, serialRouteFields } from './serial-frames'

/** Bytes of frame ID and route. */
export function serialHeadSize({ frameId, route }: SerialFrameFacts, ascii: boolean): number {
  const widths = route.map((field) => serialRouteFields[field].width)
  return widths.reduce<number>((sum, width) => sum + width, frameId === undefined ? 0 : 1) * (ascii ? 2 : 1)
}

/** @returns the offset behind it */
export function putSerialHead(
  { frameId, route }: SerialFrameFacts,
  bytes: Buffer,
  start: number,
  head: SerialHead,
  ascii: boolean,
): number {
  let at = frameId === undefined ? start : putUint(bytes, start, frameId, 1, ascii)
  for (const field of route) {
    const { width, own } = serialRouteFields[field]
    at = putUint(bytes, at, head[field] ?? own, width, ascii)
  }
  return at
}

/** The caller has checked that the bytes are there. @throws ProtocolError BAD_FRAME for another frame ID, BAD_DIGIT */
export function serialHeadAt(
  { frameId, route }: SerialFrameFacts,
  bytes: Buffer,
  start: number,
  ascii: boolean,
): SerialHead {
  const unit = ascii ? 2 : 1
  let at = start
  if (frameId !== undefined) {
    const found = uintAt(bytes, at, 1, ascii)
    if (found !== frameId) failAt('BAD_FRAME', at, bytes, `the frame ID is not ${frameId.toString(16).toUpperCase()}`)
    at += unit
  }
  const head: { -readonly [F in keyof SerialHead]: SerialHead[F] } = { station: 0, pc: 0 }
  for (const field of route) {
    const { width } = serialRouteFields[field]
    head[field] = uintAt(bytes, at, width, ascii)
    at += width * unit
  }
  return head
}
