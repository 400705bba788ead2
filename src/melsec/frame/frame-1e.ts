// The 1E frame (FX5 communication manual 37.2): no serial number and no length, so an answer ends where its request
// says it ends.
import { type DataCode, failAt, putUint, uintAt } from '../../codec/codec'
import type { BodyLength, Framing, RequestFrame, ResponseFrame, Scanned } from '../../link/link'
import { aCompatibleCommands } from '../a-compatible/commands'

export type Head1e = {
  /** The command is the subheader. */
  readonly command: number
  /** PC number, FFH = the connected station. An answer has none. */
  readonly pc: number
  /** Monitoring timer in units of 250 ms. An answer has none. */
  readonly timer: number
}

const ANSWER = 0x80
/** End code that is followed by an abnormal code. */
export const WITH_ABNORMAL_CODE = 0x5b

/** The answers that FX3 modules end with a byte 00H, and the FX5 manual prints without. */
export function mayEndWithZero(command: number, endCode: number): boolean {
  return endCode === 0 ? command === aCompatibleCommands.readPcType.code : endCode === WITH_ABNORMAL_CODE
}

/** That byte: no answer begins with it, so it is told from the next one also when it comes late. */
export const zeroBehind: Readonly<Record<DataCode, Buffer>> = { binary: Buffer.of(0), ascii: Buffer.from('00') }

/** Framing of 1E in either data code. */
export function frame1e(code: DataCode): Framing<Head1e> {
  const ascii = code === 'ascii'
  return {
    name: `1E ${code}`,
    correlation: 'order',
    request: {
      write: (head, _serial, body) => writeRequest(ascii, head, body),
      scan: (bytes, bodyLength) => scanRequest(ascii, bytes, bodyLength),
    },
    response: {
      write: (head, _serial, endCode, body) => writeResponse(ascii, head, endCode, body),
      scan: (bytes, bodyLength) => scanResponse(ascii, bytes, bodyLength),
    },
    mismatch: (asked, answered) =>
      asked.command === answered.command ? undefined : `it answers command ${answered.command}, asked ${asked.command}`,
  }
}

function writeRequest(ascii: boolean, head: Head1e, body: Uint8Array): Buffer {
  const size = ascii ? 8 : 4
  const frame = Buffer.allocUnsafe(size + body.length)
  let at = putUint(frame, 0, head.command, 1, ascii)
  at = putUint(frame, at, head.pc, 1, ascii)
  at = putUint(frame, at, head.timer, 2, ascii)
  frame.set(body, at)
  return frame
}

function writeResponse(ascii: boolean, head: Head1e, endCode: number, body: Uint8Array): Buffer {
  const size = ascii ? 4 : 2
  const frame = Buffer.allocUnsafe(size + body.length)
  const at = putUint(frame, 0, head.command | ANSWER, 1, ascii)
  putUint(frame, at, endCode, 1, ascii)
  frame.set(body, size)
  return frame
}

function scanRequest(
  ascii: boolean,
  bytes: Buffer,
  bodyLength: BodyLength<Head1e>,
): Scanned<RequestFrame<Head1e>> | undefined {
  const unit = ascii ? 2 : 1
  if (bytes.length < 4 * unit) return undefined
  const head = {
    command: uintAt(bytes, 0, 1, ascii),
    pc: uintAt(bytes, unit, 1, ascii),
    timer: uintAt(bytes, 2 * unit, 2, ascii),
  }
  if (head.command >= ANSWER) failAt('BAD_FRAME', 0, bytes, 'the subheader is not one of a request')
  const length = bodyLength(head, bytes.subarray(4 * unit))
  const used = 4 * unit + (length ?? 0)
  if (length === undefined || bytes.length < used) return undefined
  return { used, frame: { head, serial: undefined, body: bytes.subarray(4 * unit, used) } }
}

function scanResponse(
  ascii: boolean,
  bytes: Buffer,
  bodyLength: BodyLength<Head1e>,
): Scanned<ResponseFrame<Head1e>> | undefined {
  const unit = ascii ? 2 : 1
  if (bytes.length < unit) return undefined
  const subheader = uintAt(bytes, 0, 1, ascii)
  if (subheader < ANSWER) failAt('BAD_FRAME', 0, bytes, 'the subheader is not one of an answer')
  if (bytes.length < 2 * unit) return undefined
  const endCode = uintAt(bytes, unit, 1, ascii)
  const head = { command: subheader - ANSWER, pc: 0, timer: 0 }
  const length = answerLength(endCode, unit, () => bodyLength(head, bytes.subarray(2 * unit)))
  const used = 2 * unit + (length ?? 0)
  if (length === undefined || bytes.length < used) return undefined
  const frame = { head, serial: undefined, endCode, body: bytes.subarray(2 * unit, used) }
  return mayEndWithZero(head.command, endCode)
    ? { used, frame, mayFollow: zeroBehind[ascii ? 'ascii' : 'binary'] }
    : { used, frame }
}

/** `abnormal`: bytes of the abnormal code. */
function answerLength(endCode: number, abnormal: number, ofData: () => number | undefined): number | undefined {
  if (endCode === 0) return ofData()
  return endCode === WITH_ABNORMAL_CODE ? abnormal : 0
}
