/**
 * Requests and answers of 3E, 4E and the station extension frame, by hand from the SLMP reference manual: chapter 4
 * (frames), 5.2 (devices), 5.6 (type name), 5.9 (self test). The FX5 manual's chapters say the same of 3E.
 */
import { type Code, NotUnderstood, Reader, Writer } from './bytes'
import { type Access, type Asked, NOTHING, type Request } from './request'

export type SlmpFrame = '3E' | '4E' | 'ext'

/** Subheaders: of the request, of its answer. A serial number and 0000 follow in 4E and ext. */
const SUBHEADERS = { '3E': [0x50, 0xd0], '4E': [0x54, 0xd4], ext: [0x68, 0xe8] } as const

/** Bytes in front of the data length. */
const IN_FRONT = { '3E': 2 + 5, '4E': 6 + 5, ext: 6 + 5 + 3 } as const

/** Codes of devices: of one byte or of two, and by letters. */
const DEVICES = { 168: 'D', 144: 'M' } as const
const LETTERS: Readonly<Record<string, 'D' | 'M'>> = { D: 'D', M: 'M' }

/** Bytes of the whole request at the front, or `undefined` when its length is not there yet. */
export function slmpLength(frame: SlmpFrame, code: Code, bytes: Buffer): number | undefined {
  const unit = code === 'ascii' ? 2 : 1
  const front = IN_FRONT[frame] * unit
  if (bytes.length < front + 2 * unit) return undefined
  const length = new Reader(bytes.subarray(front), code).number(2)
  return front + 2 * unit + length
}

export function readSlmp(frame: SlmpFrame, code: Code, bytes: Buffer): Request {
  const reader = new Reader(bytes, code)
  const unit = code === 'ascii' ? 2 : 1
  const subheader = reader.number(1)
  if (subheader !== SUBHEADERS[frame][0] || reader.number(1) !== 0) throw new NotUnderstood('another subheader')
  const serial = frame === '3E' ? 0 : serialOf(reader)
  const route = reader.raw((frame === 'ext' ? 8 : 5) * unit)
  if (reader.number(2) !== reader.left) throw new NotUnderstood('the length is not that of the data')
  reader.number(2) // monitoring timer
  const command = reader.number(2)
  const subcommand = reader.number(2)
  if (frame === 'ext' && reader.raw(6).some((byte) => byte !== 0)) throw new NotUnderstood('six zeros are wanted')
  const asked = askedBy(command, subcommand, reader)
  if (reader.left > 0) throw new NotUnderstood(`${reader.left} bytes behind the request`)
  return { frame, code, command, subcommand, serial, route, ...asked }
}

function serialOf(reader: Reader): number {
  // The only number of ASCII code that could stand either way round: it is repeated as it came.
  const serial = reader.number(2)
  if (reader.number(2) !== 0) throw new NotUnderstood('0000 is wanted behind the serial number')
  return serial
}

function askedBy(command: number, subcommand: number, reader: Reader): Asked {
  const none = { accesses: [], values: [], echo: NOTHING }
  const bits = (subcommand & 1) === 1
  const long = (subcommand & 2) === 2
  if ((subcommand & ~3) !== 0) throw new NotUnderstood(`subcommand ${subcommand.toString(16)}`)
  switch (command) {
    case 0x0101:
      return { ...none, kind: 'typeName' }
    case 0x0619:
      return { ...none, kind: 'selfTest', echo: reader.rest() }
    case 0x0401: {
      const { device, head } = deviceOf(reader, long)
      return {
        ...none,
        kind: 'read',
        accesses: [{ device, head, unit: bits ? 'bit' : 'word', points: reader.number(2) }],
      }
    }
    case 0x1401: {
      const { device, head } = deviceOf(reader, long)
      const access: Access = { device, head, unit: bits ? 'bit' : 'word', points: reader.number(2) }
      return { ...none, kind: 'write', accesses: [access], values: [dataOf(reader, access)] }
    }
    case 0x0403: {
      const [words, doubles] = [reader.number(1), reader.number(1)]
      return {
        ...none,
        kind: 'read',
        accesses: [...singles(reader, long, words, 'word'), ...singles(reader, long, doubles, 'doubleWord')],
      }
    }
    case 0x0406:
    case 0x1406:
      return { ...none, ...blocksOf(reader, long, command === 0x1406) }
    case 0x1402:
      return { ...none, kind: 'write', ...(bits ? randomBits(reader, long) : randomWords(reader, long)) }
    default:
      throw new NotUnderstood(`command ${command.toString(16).padStart(4, '0')}`)
  }
}

/** ASCII: code, then number; binary: number, then code. The long form has one byte more of each, in ASCII two digits. */
function deviceOf(reader: Reader, long: boolean): Pick<Access, 'device' | 'head'> {
  if (reader.code === 'ascii') {
    const letters = reader.text(long ? 4 : 2).replace(/[* ]+$/, '')
    const device = LETTERS[letters]
    const digits = reader.text(long ? 8 : 6)
    if (device === undefined || !/^[ 0-9]*[0-9]$/.test(digits)) throw new NotUnderstood(`device ${letters}${digits}`)
    return { device, head: Number(digits) }
  }
  const head = reader.number(long ? 4 : 3)
  const code = reader.number(long ? 2 : 1)
  const device = DEVICES[code as keyof typeof DEVICES]
  if (device === undefined) throw new NotUnderstood(`device code ${code}`)
  return { device, head }
}

/** The data of a write: words, or a character or half a byte for each bit. */
function dataOf(reader: Reader, { unit, points }: Access): number[] {
  if (unit === 'word') return Array.from({ length: points }, () => reader.number(2))
  if (unit === 'doubleWord') return Array.from({ length: points }, () => reader.number(4))
  return bitsOf(reader, points)
}

/** Binary: the first of two points in the high half of the byte. */
export function bitsOf(reader: Reader, points: number): number[] {
  if (reader.code === 'ascii') return [...reader.text(points)].map(bitOf)
  const bytes = reader.raw(Math.ceil(points / 2))
  return Array.from({ length: points }, (_, i) => bitOf(String(((bytes[i >> 1] ?? 0) >> (i % 2 === 0 ? 4 : 0)) & 15)))
}

function bitOf(text: string): number {
  if (text !== '0' && text !== '1') throw new NotUnderstood(`a bit is ${text}`)
  return Number(text)
}

function singles(reader: Reader, long: boolean, count: number, unit: Access['unit']): Access[] {
  return Array.from({ length: count }, () => ({ ...deviceOf(reader, long), unit, points: 1 }))
}

function randomBits(reader: Reader, long: boolean): Pick<Asked, 'accesses' | 'values'> {
  const both = Array.from({ length: reader.number(1) }, () => {
    const access: Access = { ...deviceOf(reader, long), unit: 'bit', points: 1 }
    return [access, [bitOf(String(reader.number(long ? 2 : 1)))]] as const
  })
  return { accesses: both.map(([access]) => access), values: both.map(([, values]) => values) }
}

function randomWords(reader: Reader, long: boolean): Pick<Asked, 'accesses' | 'values'> {
  const [words, doubles] = [reader.number(1), reader.number(1)]
  const both = (['word', 'doubleWord'] as const).flatMap((unit) =>
    Array.from({ length: unit === 'word' ? words : doubles }, () => {
      const access: Access = { ...deviceOf(reader, long), unit, points: 1 }
      return [access, dataOf(reader, access)] as const
    }),
  )
  return { accesses: both.map(([access]) => access), values: both.map(([, values]) => values) }
}

/** Word blocks, then bit blocks of 16 bits a point; a write has the data of each block behind it. */
function blocksOf(reader: Reader, long: boolean, write: boolean): Pick<Asked, 'kind' | 'accesses' | 'values'> {
  const count = reader.number(1) + reader.number(1)
  const both = Array.from({ length: count }, () => {
    const access: Access = { ...deviceOf(reader, long), unit: 'word', points: reader.number(2) }
    return [access, write ? dataOf(reader, access) : []] as const
  })
  const accesses = both.map(([access]) => access)
  return write
    ? { kind: 'write', accesses, values: both.map(([, values]) => values) }
    : { kind: 'read', accesses, values: [] }
}

/** An answer before it is framed, so that faults can change a part of it. */
export interface SlmpAnswer {
  subheader: number
  serial: number
  route: Buffer
  endCode: number
  command: number
  data: Buffer
  /** Added to the data length. */
  lengthBy: number
}

export function slmpAnswer(request: Request, endCode: number, data: Buffer): SlmpAnswer {
  const { serial, route, command, frame } = request
  const [, subheader] = SUBHEADERS[frame as SlmpFrame]
  return { subheader, serial, route, endCode, command, data, lengthBy: 0 }
}

/** Who refused, and what: network, station, module I/O and multidrop number, command, subcommand (4.2, abnormal end). */
export function errorInformation({ frame, code, route, command, subcommand }: Request): Buffer {
  if (frame === 'ext') return route
  return new Writer(code).raw(route).number(command, 2).number(subcommand, 2).done()
}

export function writeSlmp(request: Request, answer: SlmpAnswer): Buffer {
  const { frame, code, subcommand } = request
  const body = new Writer(code).number(answer.endCode, 2)
  if (frame === 'ext') body.number(answer.command, 2).number(subcommand, 2).raw(Buffer.alloc(6))
  const bytes = body.raw(answer.data).done()
  const head = new Writer(code).number(answer.subheader, 1).number(0, 1)
  if (frame !== '3E') head.number(answer.serial, 2).number(0, 2)
  return head
    .raw(answer.route)
    .number(bytes.length + answer.lengthBy, 2)
    .raw(bytes)
    .done()
}

/** On-demand (5.11): the PLC sends a request of its own; assumed are the subheader of a request and its own route. */
export function onDemandFrame(request: Request, words: readonly number[]): Buffer {
  const { frame, code, route } = request
  const data = new Writer(code).number(0, 2).number(0x2101, 2).number(0, 2)
  if (frame === 'ext') data.raw(Buffer.alloc(6))
  for (const word of words) data.number(word, 2)
  const bytes = data.done()
  const head = new Writer(code).number(SUBHEADERS[frame as SlmpFrame][0], 1).number(0, 1)
  if (frame !== '3E') head.number(0, 2).number(0, 2)
  return head.raw(route).number(bytes.length, 2).raw(bytes).done()
}
