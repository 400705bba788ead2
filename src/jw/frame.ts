// The message of a JW-255CM: 47H ATTR COM TEXT, answered 45H ATTR COM RSLT TEXT. No length and no serial number.
// JW300 option unit manual, "Message form"; the header in front of it: see header.ts.
import { hex } from '../basics/hex'
import { failAt } from '../codec/codec'
import type { BodyLength, Framing, RequestFrame, ResponseFrame, Scanned } from '../link/link'
import { jwCommands } from './commands/commands'
import { answeringHeader, HEADER_LENGTH, headerBytes, ID, type JwHeader, type JwRelay, relayIn } from './header'

/** The command, and of a request that was received what stood in front of it: its answer gets the same. */
export type JwHead = {
  readonly command: number
  /** Bytes of the header. */
  readonly header?: number
} & Partial<JwRelay>

export interface JwFrameOptions {
  /** What stands in front of a request. Default `none`, as the manual prints it. */
  readonly header?: JwHeader
}

const ATTR = 0x00

/** Framing of the JW commands. On receive a header is detected: no message begins like one. */
export function jwFrame(options: JwFrameOptions = {}): Framing<JwHead> {
  const header = headerBytes(options.header)
  const detected = header.length === 0 ? HEADER_LENGTH : header.length
  const firsts = [0, header[0]]
  const startOf = (bytes: Buffer, id: number): number | undefined => {
    const start = bytes[0] !== id && firsts.includes(bytes[0]) ? detected : 0
    return messageStart(bytes, start, id)
  }
  return {
    name: 'JW-255CM',
    correlation: 'order',
    request: {
      write: (head, _serial, body) => Buffer.concat([header, Buffer.of(ID.request, ATTR, head.command), body]),
      scan: (bytes, bodyLength) => scanRequest(bytes, startOf(bytes, ID.request), bodyLength),
    },
    response: {
      write: (head, _serial, result, body) => {
        const front = head.header === undefined ? header : answeringHeader(head.header, head)
        return Buffer.concat([front, Buffer.of(ID.response, ATTR, head.command, result), body])
      },
      scan: (bytes, bodyLength) => scanResponse(bytes, startOf(bytes, ID.response), bodyLength),
    },
    mismatch: (asked, answered) =>
      asked.command === answered.command
        ? undefined
        : `it answers command ${hex(answered.command ?? 0, 2)}H, asked ${hex(asked.command, 2)}H`,
  }
}

/** `start`, once the ID byte there and the ATTR behind it are right; `undefined` when more bytes are needed. */
function messageStart(bytes: Buffer, start: number, id: number): number | undefined {
  if (bytes.length <= start) return undefined
  if (bytes[start] !== id) failAt('BAD_FRAME', start, bytes, `the message does not start with ${hex(id, 2)}H`)
  if (bytes.length > start + 1 && bytes[start + 1] !== ATTR) failAt('BAD_FRAME', start + 1, bytes, 'ATTR is 00H')
  return start
}

function scanRequest(
  bytes: Buffer,
  start: number | undefined,
  bodyLength: BodyLength<JwHead>,
): Scanned<RequestFrame<JwHead>> | undefined {
  if (start === undefined || bytes.length < start + 3) return undefined
  const command = bytes[start + 2] as number
  const head: JwHead = { command, header: start, ...relayIn(bytes.subarray(0, start)) }
  const text = start + 3
  const length = bodyLength(head, bytes.subarray(text))
  if (length === undefined || bytes.length < text + length) return undefined
  return { used: text + length, frame: { head, serial: undefined, body: bytes.subarray(text, text + length) } }
}

function scanResponse(
  bytes: Buffer,
  start: number | undefined,
  bodyLength: BodyLength<JwHead>,
): Scanned<ResponseFrame<JwHead>> | undefined {
  if (start === undefined || bytes.length < start + 4) return undefined
  const head = { command: bytes[start + 2] as number }
  const endCode = bytes[start + 3] as number
  const text = start + 4
  // A refusal is not followed by text (certain for the sibling unit JW-20FL5, assumed here).
  const length = endCode === 0 ? bodyLength(head, bytes.subarray(text)) : 0
  if (length === undefined || bytes.length < text + length) return undefined
  const frame = { head, serial: undefined, endCode, body: bytes.subarray(text, text + length) }
  return { used: text + length, frame, ...(mayHaveSurplus(head, endCode) ? { surplus: true } : {}) }
}

/** The manual does not say that nothing follows a refusal, and draws a cell behind the answer of 68H that it does not name. */
function mayHaveSurplus({ command }: JwHead, endCode: number): boolean {
  return endCode !== 0 || command === jwCommands.readSpecifiedBufferInformation.code
}
