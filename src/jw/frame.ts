// The message of a JW-255CM: 47H ATTR COM TEXT, answered 45H ATTR COM RSLT TEXT. No length and no serial number.
// JW300 option unit manual, "Message form"; the 40-byte header is assumed from the FL-net units (see docs).
import { failAt } from '../codec/codec'
import type { BodyLength, Framing, RequestFrame, ResponseFrame, Scanned } from '../link/link'

export type JwHead = {
  readonly command: number
}

export interface JwFrameOptions {
  /** What stands in front of a request: nothing (as the manual prints it) or 40 zero bytes. Default `none`. */
  readonly header?: 'none' | 'zero40'
}

const REQUEST = 0x47
const RESPONSE = 0x45
const ATTR = 0x00
const HEADER = 40

/** Framing of the JW commands. On receive a header is detected: every known one starts with 00. */
export function jwFrame(options: JwFrameOptions = {}): Framing<JwHead> {
  const header = Buffer.alloc(options.header === 'zero40' ? HEADER : 0)
  return {
    name: 'JW-255CM',
    correlation: 'order',
    request: {
      write: (head, _serial, body) => Buffer.concat([header, Buffer.of(REQUEST, ATTR, head.command), body]),
      scan: scanRequest,
    },
    response: {
      write: (head, _serial, result, body) =>
        Buffer.concat([header, Buffer.of(RESPONSE, ATTR, head.command, result), body]),
      scan: scanResponse,
    },
    mismatch: (asked, answered) =>
      asked.command === answered.command ? undefined : `it answers command ${answered.command}, asked ${asked.command}`,
  }
}

/** Offset of the message's ID byte; `undefined` when more bytes are needed. */
function messageStart(bytes: Buffer, id: number): number | undefined {
  const start = bytes[0] === 0 ? HEADER : 0
  if (bytes.length <= start) return undefined
  if (bytes[start] !== id)
    failAt('BAD_FRAME', start, bytes, `the message does not start with ${id.toString(16).toUpperCase()}H`)
  if (bytes.length > start + 1 && bytes[start + 1] !== ATTR) failAt('BAD_FRAME', start + 1, bytes, 'ATTR is 00H')
  return start
}

function scanRequest(bytes: Buffer, bodyLength: BodyLength<JwHead>): Scanned<RequestFrame<JwHead>> | undefined {
  const start = messageStart(bytes, REQUEST)
  if (start === undefined || bytes.length < start + 3) return undefined
  const head = { command: bytes[start + 2] as number }
  const text = start + 3
  const length = bodyLength(head, bytes.subarray(text))
  if (length === undefined || bytes.length < text + length) return undefined
  return { used: text + length, frame: { head, serial: undefined, body: bytes.subarray(text, text + length) } }
}

function scanResponse(bytes: Buffer, bodyLength: BodyLength<JwHead>): Scanned<ResponseFrame<JwHead>> | undefined {
  const start = messageStart(bytes, RESPONSE)
  if (start === undefined || bytes.length < start + 4) return undefined
  const head = { command: bytes[start + 2] as number }
  const endCode = bytes[start + 3] as number
  const text = start + 4
  // A refusal is not followed by text (certain for the sibling unit JW-20FL5, assumed here).
  const length = endCode === 0 ? bodyLength(head, bytes.subarray(text)) : 0
  if (length === undefined || bytes.length < text + length) return undefined
  return { used: text + length, frame: { head, serial: undefined, endCode, body: bytes.subarray(text, text + length) } }
}
