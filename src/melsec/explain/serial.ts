// A serial frame in words: 1C, 3C and 4C in formats 1, 4 and 5.
import { field, type Shape, uintAt } from '../../codec/codec'
import {
  type AnnotatedRow,
  type Direction,
  Explainer,
  type FrameExplanation,
  type Leaf,
  showBytes,
} from '../../codec/explanation'
import { serialBody } from '../frame/body'
import {
  allStations,
  factsOfSerial,
  RESPONSE_ID,
  type SerialFormat,
  type SerialFrameName,
  serialFormatCodes,
  serialFrameFacts,
  serialRouteFields,
} from '../frame/serial-frames'
import { serialHeadSize } from '../frame/serial-head'
import type { ExplainSettings } from './body'
import { describeHead, endCodeText } from './head'
import { oneCWords } from './one-c'
import type { ExplainFrameOptions, Known } from './options'
import { type BodyWords, type MakeWords, type SaidBody, slmpWords } from './serial-body'
import {
  endsWithSum,
  isAsciiStart,
  isInitialising,
  openAscii,
  openFormat5,
  rowOf,
  type SerialContent,
} from './serial-envelope'

const { u16, u8 } = field

const START_OF_FORMAT_5 = Buffer.of(0x10, 0x02)

/** Which serial frame the bytes begin like; no other frame of MELSEC begins with these control codes. */
export function serialFrameOf(bytes: Buffer): SerialFrameName | undefined {
  if (bytes.length > 1 && bytes.subarray(0, 2).equals(START_OF_FORMAT_5)) return '4C'
  if (!isAsciiStart(bytes)) return undefined
  if (isInitialising(bytes)) return '1C'
  const text = bytes.toString('latin1', 1, 3)
  if (!/^[0-9a-f]{2}$/i.test(text)) return undefined
  const id = Number.parseInt(text, 16)
  return id === serialFrameFacts['3C'].frameId ? '3C' : id === serialFrameFacts['4C'].frameId ? '4C' : '1C'
}

const NOTHING: SaidBody = { title: '', secret: false }

const WORDS: Readonly<Record<SerialFrameName, MakeWords>> = { '1C': oneCWords, '3C': slmpWords, '4C': slmpWords }

/** What is known of a frame before it is opened. */
interface Serial {
  readonly frame: SerialFrameName
  readonly known: Known
  readonly options: ExplainFrameOptions
}

export function explainSerial(
  bytes: Buffer,
  frame: SerialFrameName,
  known: Known,
  options: ExplainFrameOptions,
): FrameExplanation {
  const serial = { frame, known, options }
  const { sumCheck } = options
  const isRequest = formatOf(bytes, serial) !== 5 && isAsciiStart(bytes) && bytes[0] === 0x05
  if (!isRequest || sumCheck !== undefined) return explainOpened(bytes, serial, sumCheck)
  // Nothing in a request tells whether its last two characters are a sum: the one that makes sense is taken.
  if (endsWithSum(bytes)) return explainOpened(bytes, serial, true)
  const without = explainOpened(bytes, serial, false)
  if (without.fault === undefined) return without
  const summed = explainOpened(bytes, serial, true)
  return summed.fault?.name === 'sum' ? summed : without
}

/** Format 1 stands for both formats in ASCII code. */
function formatOf(bytes: Buffer, { frame, options }: Serial): SerialFormat {
  if (options.format !== undefined) return options.format
  if (frame !== '4C' || options.code === 'ascii') return 1
  return options.code === undefined && isAsciiStart(bytes) ? 1 : 5
}

function open(bytes: Buffer, serial: Serial, sumCheck: boolean | undefined): SerialContent {
  const { format } = serial.options
  if (formatOf(bytes, serial) === 5) return openFormat5(bytes, sumCheck)
  return openAscii(bytes, { facts: factsOfSerial(serial.frame), format, sumCheck })
}

function explainOpened(bytes: Buffer, serial: Serial, sumCheck: boolean | undefined): FrameExplanation {
  const content = open(bytes, serial, sumCheck)
  if (content.kind === undefined && content.format !== 5 && content.isWhole) return explainInitialising(bytes, content)
  const code = serialFormatCodes[content.format]
  const settings: ExplainSettings = { ...serial.known, code, body: serialBody }
  const words = WORDS[serial.frame](settings, {
    request: bodyIn(serial.options.request, serial),
    registration: bodyIn(serial.options.registration, serial),
  })
  const inside = explainContent(new Explainer(content.plain, code), content, serial, words)
  const { placed, isWhole, end } = content
  const unread = isWhole ? Buffer.alloc(0) : bytes.subarray(placed(content.plain.length), end)
  const fault =
    (isWhole ? undefined : content.fault) ??
    (inside.fault && { ...inside.fault, offset: placed(inside.fault.offset) }) ??
    content.fault
  return {
    ...inside,
    rows: [
      ...content.opening,
      ...inside.rows.map((row) => inFrame(row, bytes, content)),
      ...content.closing,
      ...rowOf(placed(content.plain.length), unread, 'not read', 'not read'),
    ],
    ...(fault === undefined ? {} : { fault }),
    rest: bytes.length - end,
  }
}

/** A row of the content as it stands in the frame: with the DLEs that were added. */
function inFrame(row: AnnotatedRow, bytes: Buffer, { placed, format }: SerialContent): AnnotatedRow {
  const offset = placed(row.offset)
  const length = placed(row.offset + row.length) - offset
  const code = serialFormatCodes[format]
  const isSecret = row.secret === true
  const shown = showBytes(isSecret ? Buffer.alloc(length) : bytes.subarray(offset, offset + length), code, isSecret)
  return { ...row, offset, length, bytes: shown }
}

function explainInitialising(bytes: Buffer, { opening, closing, format, end }: SerialContent): FrameExplanation {
  const [row] = opening
  const title = `${row?.text ?? ''}, format ${format}: the PLC gives up what it was asked and answers nothing`
  const rest = bytes.length - end
  return { title, code: 'ascii', direction: 'request', rows: [...opening, ...closing], notes: [], rest }
}

/** The body of a request; the data of its command say where a sum begins, so it may stand behind them. */
function bodyIn(bytes: Buffer | undefined, serial: Serial): Buffer | undefined {
  if (bytes === undefined) return undefined
  const { plain, format } = open(bytes, serial, format5Sum(serial))
  return plain.subarray(headSizeIn(serial.frame, format))
}

const format5Sum = ({ options }: Serial) => (options.format === 5 ? options.sumCheck : undefined)

function headSizeIn(frame: SerialFrameName, format: SerialFormat): number {
  return serialHeadSize(factsOfSerial(frame), format !== 5) + (format === 5 ? 2 : 0)
}

/** Between the start code and the data; a test holds it against the framing. */
function headShape(frame: SerialFrameName, format: SerialFormat): Shape {
  const { frameId, route } = factsOfSerial(frame)
  const fields = route.map((name) => [name, serialRouteFields[name].width === 1 ? u8() : u16()] as const)
  return {
    ...(format === 5 ? { dataBytes: u16() } : {}),
    ...(frameId === undefined ? {} : { frameId: u8() }),
    ...Object.fromEntries(fields),
  }
}

function describeSerialHead({ name, value, field }: Leaf): string | undefined {
  if (name === 'station') return value === allStations.station ? '255 (FFH: all stations)' : `${String(value)}`
  if (name === 'frameId') {
    const found = Object.entries(serialFrameFacts).find(([, facts]) => 'frameId' in facts && facts.frameId === value)
    return `${Number(value).toString(16).toUpperCase()}H (${found === undefined ? 'no frame' : `${found[0]} frame`})`
  }
  return describeHead({ name, value, field })
}

function explainContent(
  explainer: Explainer,
  content: SerialContent,
  { frame, options }: Serial,
  words: BodyWords,
): FrameExplanation {
  const { format, kind, isWhole, plain } = content
  const total = plain.length
  const head = explainer.read(headShape(frame, format), (leaf) =>
    leaf.name === 'dataBytes' ? dataBytesText(Number(leaf.value), total - 2) : describeSerialHead(leaf),
  )
  if (isWhole && typeof head.dataBytes === 'number' && head.dataBytes !== total - 2) {
    explainer.fail(0, `${head.dataBytes} data bytes announced, ${total - 2} found`, 'dataBytes')
  }
  const { frameId } = factsOfSerial(frame)
  if (typeof head.frameId === 'number' && head.frameId !== frameId) {
    explainer.fail(format === 5 ? 2 : 0, `this is no ${frame} frame`, 'frameId')
  }
  const direction = options.direction ?? directionOf(kind, explainer)
  const about = { frame, code: serialFormatCodes[format], direction } as const
  const name = `${frame} ${direction}, format ${format}`
  if (direction === 'request') {
    const { command, title, secret } = words.request(explainer)
    return explainer.end({ ...about, ...named(command), title: `${name}: ${title}` }, total, secret)
  }
  if (options.request !== undefined && words.asked === undefined) {
    explainer.notes.push('The frame given as request is no request that can be read.')
  }
  const endCode = kind === 'data' || kind === 'ack' ? 0 : readEndCode(explainer, frame, format, words)
  if (endCode !== 0) {
    const code = endCode === undefined ? {} : { endCode }
    const title = `${name}: ${endCode === undefined ? 'cut short' : 'refused'}`
    return explainer.end({ ...about, ...named(words.asked?.name), ...code, title }, total)
  }
  // An ACK carries nothing.
  const isEmpty = kind === 'ack' && words.asked === undefined
  const { title, command = words.asked?.name, secret }: SaidBody = isEmpty ? NOTHING : words.response(explainer)
  const what = title === '' && kind === 'ack' ? 'carried out' : title
  return explainer.end(
    { ...about, ...named(command), endCode, title: what === '' ? name : `${name}: ${what}` },
    total,
    secret,
  )
}

function named(command: string | undefined): { readonly command?: string } {
  return command === undefined ? {} : { command }
}

function dataBytesText(announced: number, present: number): string {
  const right = announced === present
  return `${announced} (${right ? 'bytes that follow, without added DLEs' : `but ${present} follow`})`
}

/** In format 5 the data of an answer tell it. */
function directionOf(kind: SerialContent['kind'], explainer: Explainer): Direction {
  if (kind !== undefined) return kind === 'request' ? 'request' : 'response'
  const ahead = explainer.ahead()
  return ahead.length >= 2 && uintAt(ahead, 0, 2, false) === RESPONSE_ID ? 'response' : 'request'
}

/** The code behind NAK, or in format 5 behind the response ID. */
function readEndCode(
  explainer: Explainer,
  frame: SerialFrameName,
  format: SerialFormat,
  { family, asked }: BodyWords,
): number | undefined {
  const digits =
    explainer.remaining === 2 || explainer.remaining === 4 ? explainer.remaining : factsOfSerial(frame).errorDigits
  const width = format === 5 || digits === 4 ? u16() : u8()
  const shape: Shape = { ...(format === 5 ? { responseId: u16() } : {}), endCode: width }
  const { endCode } = explainer.read(shape, (leaf) =>
    leaf.name === 'endCode' ? endCodeText(family, Number(leaf.value), asked?.name) : describeHead(leaf),
  )
  if (endCode === 0 && format !== 5) explainer.fail(explainer.position - digits, 'NAK carries no error code', 'endCode')
  return typeof endCode === 'number' ? endCode : undefined
}
