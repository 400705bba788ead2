// What encloses the data of a serial frame, in words: control codes, sum check code, added DLEs. The framing throws at the
// first thing that is wrong; here as much as can be read is shown.
import { hex } from '../../basics/hex'
import { sumOf } from '../../codec/codec'
import { type AnnotatedRow, type FrameFault, showBytes } from '../../codec/explanation'
import { type ControlCode, controlCodes, type SerialFormat, type SerialFrameFacts } from '../frame/serial-frames'
import { serialHeadSize } from '../frame/serial-head'

const { DLE, STX, ETX, EOT, ENQ, ACK, CL, CR, LF, NAK } = controlCodes
const SUM = 2

/** What the start code says; format 5 has one for all. */
export type SerialKind = 'request' | 'data' | 'ack' | 'nak'

const KINDS: ReadonlyMap<number | undefined, SerialKind> = new Map([
  [ENQ, 'request'],
  [STX, 'data'],
  [ACK, 'ack'],
  [NAK, 'nak'],
])

/** A frame without what encloses its data. */
export interface SerialContent {
  readonly format: SerialFormat
  readonly kind: SerialKind | undefined
  /** Without added DLEs. */
  readonly plain: Buffer
  /** Offset in the frame of a byte of `plain`, and of what follows the last. */
  placed(offset: number): number
  readonly opening: readonly AnnotatedRow[]
  readonly closing: readonly AnnotatedRow[]
  /** The frame has its end. */
  readonly isWhole: boolean
  /** Bytes of the frame that were found, what closes it included. */
  readonly end: number
  readonly fault?: FrameFault | undefined
}

/** A row of bytes that no declaration names. */
export function rowOf(
  offset: number,
  bytes: Buffer,
  name: string,
  text: string,
  shown = showBytes(bytes, 'binary'),
): readonly AnnotatedRow[] {
  if (bytes.length === 0) return []
  return [{ offset, length: bytes.length, name, kind: 'bytes', value: shown, bytes: shown, text }]
}

/** Control codes by their names, e.g. `CR LF`. */
function namesOf(bytes: Buffer): ControlCode[] {
  const names = Object.entries(controlCodes) as [ControlCode, number][]
  return [...bytes].flatMap((byte) => names.filter(([, code]) => code === byte).map(([name]) => name))
}

function codesRow(bytes: Buffer, offset: number, length: number, name: string): readonly AnnotatedRow[] {
  const codes = bytes.subarray(offset, offset + length)
  const names = namesOf(codes)
  return rowOf(offset, codes, name, names.join(' '), names.map((one) => `<${one}>`).join(''))
}

export function isCharacter(byte: number | undefined): boolean {
  return byte !== undefined && byte >= 0x20 && byte <= 0x7e
}

// --- formats 1 and 4

export interface AsciiEnvelope {
  readonly facts: SerialFrameFacts
  readonly format: SerialFormat | undefined
  /** `undefined`: as the bytes say, which those of a request do not. */
  readonly sumCheck: boolean | undefined
}

/** What begins with a control code of formats 1 and 4. */
export function isAsciiStart(bytes: Buffer): boolean {
  return KINDS.has(bytes[0]) || isInitialising(bytes)
}

/** EOT or CL: they stand alone. */
export function isInitialising([first, second]: Buffer): boolean {
  return (first === EOT || first === CL) && (second === undefined || second === CR || KINDS.has(second))
}

export function openAscii(bytes: Buffer, envelope: AsciiEnvelope): SerialContent {
  const kind = KINDS.get(bytes[0])
  if (kind === undefined) return isInitialising(bytes) ? openInitialising(bytes) : notOpened(bytes)
  let charactersEnd = 1
  while (isCharacter(bytes[charactersEnd])) charactersEnd++
  const opening = codesRow(bytes, 0, 1, 'start')
  const parts = { request: requestEnd, data: dataEnd, ack: shortEnd, nak: shortEnd }[kind](
    bytes,
    charactersEnd,
    envelope,
  )
  const { bodyEnd, end, rows, fault, isWhole = true } = parts
  const crLf = bytes[end] === CR && bytes[end + 1] === LF
  const missing =
    envelope.format === 4 && !crLf ? { offset: end, message: 'CR LF is missing behind the frame' } : undefined
  return {
    format: crLf ? 4 : (envelope.format ?? 1),
    kind,
    plain: bytes.subarray(1, bodyEnd),
    placed: (offset) => offset + 1,
    opening,
    closing: [...rows, ...(crLf ? codesRow(bytes, end, 2, 'end of line') : [])],
    isWhole,
    end: crLf ? end + 2 : end,
    fault: fault ?? missing,
  }
}

/** Where the data end, where the frame ends but for CR LF, and what stands between. */
interface Ending {
  readonly bodyEnd: number
  readonly end: number
  readonly rows: readonly AnnotatedRow[]
  readonly fault?: FrameFault | undefined
  /** Default true. */
  readonly isWhole?: boolean
}

function requestEnd(bytes: Buffer, end: number, { sumCheck }: AsciiEnvelope): Ending {
  if (sumCheck !== true) return { bodyEnd: end, end, rows: [] }
  const bodyEnd = Math.max(1, end - SUM)
  return { bodyEnd, end, ...sumOfFrame(bytes, bodyEnd, end, [[bodyEnd, '']]) }
}

function dataEnd(bytes: Buffer, bodyEnd: number, { sumCheck }: AsciiEnvelope): Ending {
  if (bytes[bodyEnd] !== ETX) {
    const fault = { offset: bodyEnd, message: 'the frame ends without ETX' }
    return { bodyEnd, end: bodyEnd, rows: [], isWhole: false, fault }
  }
  const etx = codesRow(bytes, bodyEnd, 1, 'end')
  const at = bodyEnd + 1
  let end = at
  while (sumCheck !== false && end < at + SUM && isCharacter(bytes[end])) end++
  if (end === at && sumCheck !== true) return { bodyEnd, end, rows: etx }
  const { rows, fault } = sumOfFrame(bytes, at, end, [
    [at, ''],
    [bodyEnd, ', without ETX'],
  ])
  return { bodyEnd, end, rows: [...etx, ...rows], fault }
}

/** ACK and NAK have no sum, but for PLCs that the manual does not show. */
function shortEnd(bytes: Buffer, end: number, { facts }: AsciiEnvelope): Ending {
  const bodyEnd = 1 + serialHeadSize(facts, true) + (bytes[0] === NAK ? facts.errorDigits : 0)
  const isSummed = end === bodyEnd + SUM && sumAt(bytes, bodyEnd, end) === sumOf(bytes, 1, bodyEnd)
  return isSummed
    ? { bodyEnd, end, ...sumOfFrame(bytes, bodyEnd, end, [[bodyEnd, '']]) }
    : { bodyEnd: end, end, rows: [] }
}

function sumAt(bytes: Buffer, from: number, to: number): number | undefined {
  const text = bytes.toString('latin1', from, to)
  return /^[0-9a-f]{2}$/i.test(text) ? Number.parseInt(text, 16) : undefined
}

/** Whether the last two characters of a request are the sum of those in front of them. */
export function endsWithSum(bytes: Buffer): boolean {
  let end = 1
  while (isCharacter(bytes[end])) end++
  return end > 1 + SUM && sumAt(bytes, end - SUM, end) === sumOf(bytes, 1, end - SUM)
}

/** The row of a sum. `ranges`: where what it is taken of may end, and how that is said. */
function sumOfFrame(
  bytes: Buffer,
  from: number,
  to: number,
  ranges: readonly (readonly [number, string])[],
): Pick<Ending, 'rows' | 'fault'> {
  const found = sumAt(bytes, from, to)
  const right = ranges.find(([end]) => sumOf(bytes, 1, end) === found)
  return sumRow(bytes.subarray(from, to), from, sumOf(bytes, 1, ranges[0]?.[0]), right?.[1])
}

/** `right`: how it is said that it is right; `undefined` when it is not. */
function sumRow(
  sum: Buffer,
  offset: number,
  expected: number,
  right: string | undefined,
): Pick<Ending, 'rows' | 'fault'> {
  const found = showBytes(sum, 'ascii')
  const text = right === undefined ? `"${found}" (should be "${hex(expected, 2)}")` : `"${found}" (right${right})`
  const message = sum.length < SUM ? 'the sum check code is missing' : 'the sum check code does not match'
  const fault = right === undefined ? { fault: { offset, message, name: 'sum' } } : {}
  return { rows: rowOf(offset, sum, 'sum', text, found), ...fault }
}

function openInitialising(bytes: Buffer): SerialContent {
  const crLf = bytes[1] === CR && bytes[2] === LF
  return {
    ...notOpened(bytes),
    format: crLf ? 4 : 1,
    opening: codesRow(bytes, 0, 1, 'initialise'),
    closing: crLf ? codesRow(bytes, 1, 2, 'end of line') : [],
    isWhole: true,
    end: crLf ? 3 : 1,
    fault: undefined,
  }
}

function notOpened(bytes: Buffer): SerialContent {
  return {
    format: 1,
    kind: undefined,
    plain: Buffer.alloc(0),
    placed: () => 0,
    opening: [],
    closing: [],
    isWhole: false,
    end: bytes.length,
    fault: { offset: 0, message: 'a frame in format 1 or 4 starts with ENQ, STX, ACK or NAK (05, 02, 06, 15)' },
  }
}

// --- format 5

export function openFormat5(bytes: Buffer, sumCheck: boolean | undefined): SerialContent {
  const { plain, at, end, fault } = withoutDles(bytes)
  const placed = (offset: number) => at[Math.min(offset, at.length - 1)] ?? 0
  const closing = end === undefined ? { rows: [], end: bytes.length } : closingOf(bytes, plain, end, sumCheck)
  return {
    format: 5,
    kind: undefined,
    plain,
    placed,
    opening: rowOf(0, bytes.subarray(0, Math.min(2, placed(0))), 'start', 'DLE STX'),
    closing: closing.rows,
    isWhole: end !== undefined,
    end: closing.end,
    fault: fault ?? closing.fault,
  }
}

interface WithoutDles {
  readonly plain: Buffer
  /** Offset in the frame of each byte of `plain`, and of what follows the last. */
  readonly at: readonly number[]
  /** Behind DLE ETX; without it the frame is cut short or broken. */
  readonly end?: number
  readonly fault?: FrameFault
}

function withoutDles(bytes: Buffer): WithoutDles {
  if (bytes[0] !== DLE || (bytes.length > 1 && bytes[1] !== STX)) {
    const fault = { offset: bytes[0] === DLE ? 1 : 0, message: 'a frame in format 5 starts with DLE STX (10 02)' }
    return { plain: Buffer.alloc(0), at: [0], fault }
  }
  const plain: number[] = []
  const at: number[] = []
  for (let i = 2; i < bytes.length; i++) {
    const byte = bytes[i] as number
    const next = bytes[i + 1]
    if (byte === DLE && next === ETX) return { plain: Buffer.from(plain), at: [...at, i], end: i + 2 }
    if (byte === DLE && next !== DLE) {
      const message = next === undefined ? WITHOUT_END : 'DLE is followed by neither DLE nor ETX'
      return { plain: Buffer.from(plain), at: [...at, i], fault: { offset: i + 1, message } }
    }
    plain.push(byte)
    at.push(i)
    if (byte === DLE) i++
  }
  const fault = { offset: bytes.length, message: WITHOUT_END }
  return { plain: Buffer.from(plain), at: [...at, bytes.length], fault }
}

const WITHOUT_END = 'the frame ends without DLE ETX (10 03)'

/** DLE ETX and the sum check code, where there is one: two bytes behind the frame that begin no other are one. */
function closingOf(
  bytes: Buffer,
  plain: Buffer,
  end: number,
  sumCheck: boolean | undefined,
): Pick<Ending, 'rows' | 'end' | 'fault'> {
  const etx = rowOf(end - 2, bytes.subarray(end - 2, end), 'end', 'DLE ETX')
  const sum = bytes.subarray(end, end + SUM)
  const isNext = sum[0] === DLE
  if (sumCheck === false || (sumCheck === undefined && (sum.length === 0 || isNext))) return { rows: etx, end }
  const expected = sumOf(plain)
  const right = sumAt(sum, 0, SUM) === expected ? '' : undefined
  const { rows, fault } = sumRow(sum, end, expected, right)
  const inHex = rows.map((row) => ({ ...row, bytes: showBytes(sum, 'binary') }))
  return { rows: [...etx, ...inHex], end: end + sum.length, fault }
}
