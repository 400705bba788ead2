// A 4C frame in format 5 in words: the same data as in 3E, in an envelope of control codes with doubled DLEs.

import { hex } from '../../basics/hex'
import { field, type Shape, sumOf } from '../../codec/codec'
import {
  type AnnotatedRow,
  type Direction,
  Explainer,
  type FrameExplanation,
  type FrameFault,
  showBytes,
} from '../../codec/explanation'
import { serialFraming } from '../frame/serial-framing'
import {
  type ExplainSettings,
  explainRequestBody,
  explainResponseBody,
  type KnownRequest,
  readRequestBody,
} from './body'
import { describeHead, endCodeText } from './head'
import type { ExplainFrameOptions } from './options'

const { u16, u8 } = field

const DLE = 0x10
const STX = 0x02
const ETX = 0x03
/** In place of the command in an answer. */
const RESPONSE_ID = 0xffff

/** Between DLE STX and the data (FX5 communication manual 40.4); a test holds it against the framing. */
const headFields = {
  dataBytes: u16(),
  frameId: u8(),
  station: u8(),
  network: u8(),
  pc: u8(),
  moduleIo: u16(),
  multidrop: u8(),
  selfStation: u8(),
} as const satisfies Shape
const responseFields = { responseId: u16(), endCode: u16() } as const satisfies Shape

/** The content of the envelope. */
interface Content {
  /** Without the added DLEs. */
  readonly plain: Buffer
  /** Offset in the frame of each byte of `plain`, and of what follows the last. */
  readonly at: readonly number[]
  /** Behind DLE ETX; without it the frame is cut short or broken. */
  readonly end: number | undefined
  readonly fault?: FrameFault
}

export function explain4c(bytes: Buffer, settings: ExplainSettings, options: ExplainFrameOptions): FrameExplanation {
  const { plain, at, end, fault } = contentOf(bytes)
  const explainer = new Explainer(plain, 'binary')
  const inside = explainContent(explainer, settings, options, end !== undefined)
  const placed = (offset: number) => at[Math.min(offset, at.length - 1)] ?? 0
  const rows = inside.rows.map((row) => inFrame(row, bytes, placed))
  const closing = end === undefined ? undefined : closingRows(bytes, plain, end)
  const first = fault ?? (inside.fault && { ...inside.fault, offset: placed(inside.fault.offset) }) ?? closing?.fault
  const opening = bytes.subarray(0, Math.min(2, placed(0)))
  const unread = end === undefined ? bytes.subarray(placed(plain.length)) : Buffer.alloc(0)
  return {
    ...inside,
    rows: [
      ...rowOf(0, opening, 'start', 'DLE STX'),
      ...rows,
      ...(closing?.rows ?? []),
      ...rowOf(placed(plain.length), unread, 'not read', 'not read'),
    ],
    ...(first === undefined ? {} : { fault: first }),
    rest: closing === undefined ? 0 : bytes.length - closing.end,
  }
}

function rowOf(offset: number, bytes: Buffer, name: string, text: string): readonly AnnotatedRow[] {
  if (bytes.length === 0) return []
  const shown = showBytes(bytes, 'binary')
  return [{ offset, length: bytes.length, name, kind: 'bytes', value: shown, bytes: shown, text }]
}

/** A row of the content as it stands in the frame: with the DLEs that were added. */
function inFrame(row: AnnotatedRow, bytes: Buffer, placed: (offset: number) => number): AnnotatedRow {
  const offset = placed(row.offset)
  const length = placed(row.offset + row.length) - offset
  const shown =
    row.secret === true
      ? showBytes(Buffer.alloc(length), 'binary', true)
      : showBytes(bytes.subarray(offset, offset + length), 'binary')
  return { ...row, offset, length, bytes: shown }
}

function contentOf(bytes: Buffer): Content {
  if (bytes[0] !== DLE || (bytes.length > 1 && bytes[1] !== STX)) {
    const offset = bytes[0] === DLE ? 1 : 0
    return {
      plain: Buffer.alloc(0),
      at: [0],
      end: undefined,
      fault: { offset, message: 'a frame in format 5 starts with DLE STX (10 02)' },
    }
  }
  const plain: number[] = []
  const at: number[] = []
  for (let i = 2; i < bytes.length; i++) {
    const byte = bytes[i] as number
    const next = bytes[i + 1]
    if (byte === DLE && next === ETX) return { plain: Buffer.from(plain), at: [...at, i], end: i + 2 }
    if (byte === DLE && next !== DLE) {
      const message =
        next === undefined ? 'the frame ends without DLE ETX (10 03)' : 'DLE is followed by neither DLE nor ETX'
      return { plain: Buffer.from(plain), at: [...at, i], end: undefined, fault: { offset: i + 1, message } }
    }
    plain.push(byte)
    at.push(i)
    if (byte === DLE) i++
  }
  const fault = { offset: bytes.length, message: 'the frame ends without DLE ETX (10 03)' }
  return { plain: Buffer.from(plain), at: [...at, bytes.length], end: undefined, fault }
}

/** DLE ETX and the sum check code, where there is one. */
function closingRows(
  bytes: Buffer,
  plain: Buffer,
  end: number,
): { rows: readonly AnnotatedRow[]; end: number; fault?: FrameFault } {
  const rows = rowOf(end - 2, bytes.subarray(end - 2, end), 'end', 'DLE ETX')
  const sum = bytes.subarray(end, end + 2)
  // A parameter of the port says whether there is a sum; two characters behind the frame are one.
  if (sum.length === 0) return { rows, end }
  const expected = hex(sumOf(plain), 2)
  const found = sum.toString('latin1')
  const isRight = found.toUpperCase() === expected
  const text = isRight ? `"${found}" (right)` : `"${found.replace(/[^ -~]/g, '.')}" (should be "${expected}")`
  const fault = isRight ? {} : { fault: { offset: end, message: 'the sum check code does not match', name: 'sum' } }
  return { rows: [...rows, ...rowOf(end, sum, 'sum', text)], end: end + sum.length, ...fault }
}

function explainContent(
  explainer: Explainer,
  settings: ExplainSettings,
  options: ExplainFrameOptions,
  complete: boolean,
): FrameExplanation {
  const total = explainer.remaining
  const head = explainer.read(headFields, (leaf) => {
    if (leaf.name !== 'dataBytes') return describeHead(leaf)
    const right = Number(leaf.value) === total - 2
    return `${String(leaf.value)} (${right ? 'bytes that follow, without added DLEs' : `but ${total - 2} follow`})`
  })
  if (complete && typeof head.dataBytes === 'number' && head.dataBytes !== total - 2) {
    explainer.fail(0, `${head.dataBytes} data bytes announced, ${total - 2} found`, 'dataBytes')
  }
  const ahead = explainer.ahead()
  const answer = ahead.length >= 2 && ahead.readUInt16LE(0) === RESPONSE_ID
  const direction: Direction = options.direction ?? (answer ? 'response' : 'request')
  const about = { frame: '4C', code: 'binary', direction } as const
  const name = `4C ${direction}, format 5`
  if (direction === 'request') {
    const { command, title, secret } = explainRequestBody(explainer, settings)
    const known = command === undefined ? {} : { command: command.name }
    return explainer.end({ ...about, ...known, title: `${name}: ${title}` }, total, secret)
  }
  const asked = requestIn(options.request, settings)
  const registered = requestIn(options.registration, settings)
  if (options.request !== undefined && asked === undefined) {
    explainer.notes.push('The frame given as request is no request that can be read.')
  }
  const { endCode } = explainer.read(responseFields, (leaf) =>
    leaf.name === 'endCode' ? endCodeText('slmp', Number(leaf.value), asked?.command.name) : describeHead(leaf),
  )
  const known = asked === undefined ? {} : { command: asked.command.name }
  if (endCode !== 0) {
    const code = typeof endCode === 'number' ? { endCode } : {}
    return explainer.end(
      { ...about, ...known, ...code, title: `${name}: ${endCode === undefined ? 'cut short' : 'refused'}` },
      total,
    )
  }
  const { title, secret } = explainResponseBody(explainer, settings, asked, registered)
  return explainer.end({ ...about, ...known, endCode, title: title === '' ? name : `${name}: ${title}` }, total, secret)
}

function requestIn(bytes: Buffer | undefined, settings: ExplainSettings): KnownRequest | undefined {
  if (bytes === undefined) return undefined
  for (const sumCheck of [true, false]) {
    try {
      const scanned = serialFraming({ frame: '4C', format: 5, sumCheck }).request.scan(bytes, () => undefined)
      if (scanned !== undefined) return readRequestBody(scanned.frame.body, settings)
    } catch {
      // Not a frame of this kind: the caller says so.
    }
  }
  return undefined
}
