/** Whole answers of the PLC, and what can be wrong with them. */
import { type Code, Writer } from './bytes'
import { oneELength, readOneE, writeOneE } from './one-e'
import { NOTHING, type Request } from './request'
import { errorInformation, readSlmp, type SlmpAnswer, slmpAnswer, slmpLength, writeSlmp } from './slmp'

/** What an answer says when nothing is changed in it. */
export interface Answer {
  readonly endCode: number
  readonly data: Buffer
}

/** Fields of an answer that a fault changes. */
export interface Changes {
  readonly serial?: (serial: number) => number
  readonly route?: (route: Buffer) => Buffer
  readonly command?: (command: number) => number
  readonly subheader?: (subheader: number) => number
  readonly data?: (data: Buffer) => Buffer
  readonly lengthBy?: number
}

/** Models: Read Type Name answers 16 characters and a code; 1E a code. */
export interface Model {
  readonly name: string
  readonly code: number
  /** 1E: `F3`, as the FX5 manual prints it, or `F300`, as those of FX3. */
  readonly oneE: string
}

export function valuesAnswer(request: Request, values: readonly (readonly number[])[]): Answer {
  const writer = new Writer(request.code)
  request.accesses.forEach(({ unit }, at) => {
    const points = values[at] ?? []
    if (unit === 'bit') writer.raw(bitData(request.code, points))
    else for (const point of points) writer.number(point, unit === 'word' ? 2 : 4)
  })
  return { endCode: 0, data: request.kind === 'read' ? writer.done() : NOTHING }
}

function bitData(code: Code, bits: readonly number[]): Buffer {
  if (code === 'ascii') return Buffer.from(bits.join(''), 'latin1')
  const bytes = Buffer.alloc(Math.ceil(bits.length / 2))
  bits.forEach((bit, i) => {
    bytes[i >> 1] = (bytes[i >> 1] ?? 0) | (bit << (i % 2 === 0 ? 4 : 0))
  })
  return bytes
}

export function typeNameAnswer({ frame, code }: Request, model: Model): Answer {
  const writer = new Writer(code)
  if (frame !== '1E') return { endCode: 0, data: writer.text(model.name.padEnd(16)).number(model.code, 2).done() }
  for (let i = 0; i < model.oneE.length; i += 2) writer.number(Number.parseInt(model.oneE.slice(i, i + 2), 16), 1)
  return { endCode: 0, data: writer.done() }
}

/** A refusal. 1E has one byte, and for 5BH the reason behind it. */
export function refusalAnswer(request: Request, endCode: number): Answer {
  if (request.frame !== '1E') return { endCode, data: errorInformation(request) }
  return { endCode, data: endCode === 0x5b ? new Writer(request.code).number(0x10, 1).done() : NOTHING }
}

export function frameOf(request: Request, { endCode, data }: Answer, changes: Changes = {}): Buffer {
  const changed = changes.data?.(data) ?? data
  if (request.frame === '1E') {
    return writeOneE(request, changes.command?.(request.command) ?? request.command, endCode, changed)
  }
  const answer: SlmpAnswer = slmpAnswer(request, endCode, changed)
  answer.serial = changes.serial?.(answer.serial) ?? answer.serial
  answer.route = changes.route?.(answer.route) ?? answer.route
  answer.command = changes.command?.(answer.command) ?? answer.command
  answer.subheader = changes.subheader?.(answer.subheader) ?? answer.subheader
  answer.lengthBy = changes.lengthBy ?? 0
  return writeSlmp(request, answer)
}

export function lengthOfRequest(frame: Request['frame'], code: Code, bytes: Buffer): number | undefined {
  return frame === '1E' ? oneELength(code, bytes) : slmpLength(frame, code, bytes)
}

export function readRequest(frame: Request['frame'], code: Code, bytes: Buffer): Request {
  return frame === '1E' ? readOneE(code, bytes) : readSlmp(frame, code, bytes)
}
