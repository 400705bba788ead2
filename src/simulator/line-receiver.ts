/**
 * What the stations of a serial line hear, sans-IO: requests among noise. Unlike the responder of Ethernet ports it tells
 * what was damaged, because a station answers that with NAK; and in format 1, where frames carry no length, what cannot be
 * measured ends when no more characters come (FX5 communication manual 42.2, 42.3).
 */
import { uintAt } from '../codec/codec'
import { PlcError } from '../errors'
import type { RequestFrame, Scanned } from '../link/link'
import {
  controlCodes,
  factsOfSerial,
  type SerialFormat,
  type SerialFrameName,
  type SerialHead,
  serialRouteFields,
} from '../melsec/frame/serial-frames'
import type { SerialFraming } from '../melsec/frame/serial-framing'
import { serialHeadAt, serialHeadSize } from '../melsec/frame/serial-head'

/** How a frame is damaged: what the codes of NAK tell apart. */
export type FrameDamage = 'sum' | 'header' | 'end' | 'timeOut'

export type Heard =
  | {
      readonly kind: 'request'
      readonly frame: SerialFrameName
      readonly request: RequestFrame<SerialHead>
      /** As it came. */
      readonly bytes: Buffer
    }
  | {
      readonly kind: 'damaged'
      readonly frame: SerialFrameName
      /** The connected CPU of the station. */
      readonly head: SerialHead
      readonly damage: FrameDamage
    }
  /** EOT or CL: whatever was asked is off. */
  | { readonly kind: 'initialise' }

export interface LineReceiverParts {
  readonly format: SerialFormat
  readonly sumCheck: boolean
  /** Frames that the line knows; the others are noise. */
  readonly framings: ReadonlyMap<SerialFrameName, SerialFraming>
  /** Length of a body, where frames carry none; `unknown`: nobody can tell. */
  readonly lengthOf: (frame: SerialFrameName, head: SerialHead, soFar: Buffer) => number | 'unknown' | undefined
}

const { STX, ENQ, EOT, CL, CR, LF, DLE } = controlCodes
const EMPTY = Buffer.alloc(0)
const SUM = 2
const isCharacter = (byte: number | undefined) => byte !== undefined && byte >= 0x20 && byte <= 0x7e
const isStart = (byte: number | undefined) => byte === ENQ || byte === EOT || byte === CL

type Damaged = Heard & { kind: 'damaged' }

export class LineReceiver {
  readonly #parts: LineReceiverParts
  #received: Buffer = EMPTY
  /** A frame that is none any more, until the line is quiet: nothing tells where it ends. */
  #broken: Damaged | undefined

  constructor(parts: LineReceiverParts) {
    this.#parts = parts
  }

  /** Whether something has begun that silence ends. */
  get pending(): boolean {
    return this.#received.length > 0 || this.#broken !== undefined
  }

  /** Bytes of an unfinished frame that are kept: never more than a frame can have. */
  get buffered(): number {
    return this.#received.length
  }

  receive(chunk: Buffer): Heard[] {
    this.#received = this.#received.length === 0 ? chunk : Buffer.concat([this.#received, chunk])
    const heard: Heard[] = []
    for (let left = -1; this.#received.length > 0 && left !== this.#received.length; ) {
      left = this.#received.length
      const found = this.#parts.format === 5 ? this.#takeBinary() : this.#takeAscii()
      if (found === undefined) continue
      // Who asks anew waits for no answer to what went before.
      this.#broken = undefined
      heard.push(found)
    }
    return heard
  }

  /** No character has come for the reception time-out: what has begun ends here. */
  pause(): Heard[] {
    const broken = this.#broken ?? this.#unfinished()
    this.forget()
    return broken === undefined ? [] : [broken]
  }

  forget(): void {
    this.#received = EMPTY
    this.#broken = undefined
  }

  #drop(bytes: number): void {
    this.#received = this.#received.subarray(bytes)
  }

  // --- formats 1 and 4

  #takeAscii(): Heard | undefined {
    const at = this.#received.findIndex(isStart)
    this.#drop(at < 0 ? this.#received.length : at)
    const [code, second] = this.#received
    if (code === undefined) return undefined
    if (code !== ENQ) return this.#initialise()
    if (second !== undefined && !isCharacter(second)) this.#drop(1)
    if (this.#received.length < 3 || this.#received[0] !== ENQ) return undefined
    const frame = this.#frameOf()
    const framing = frame === undefined ? undefined : this.#parts.framings.get(frame)
    if (frame === undefined || framing === undefined) {
      this.#drop(1)
      return undefined
    }
    return this.#scan(frame, framing, this.#received)
  }

  /** Format 4: with CR LF behind it. */
  #initialise(): Heard | undefined {
    const [, cr, lf] = this.#received
    if (this.#parts.format === 4) {
      if ((cr !== undefined && cr !== CR) || (lf !== undefined && lf !== LF)) this.#drop(1)
      if (lf !== LF || cr !== CR) return undefined
      this.#drop(2)
    }
    this.#drop(1)
    return { kind: 'initialise' }
  }

  /** By the frame ID: no station has its number. */
  #frameOf(): SerialFrameName | undefined {
    const first = this.#received.toString('latin1', 1, 3)
    if (first === 'F8') return '4C'
    return first === 'F9' ? '3C' : '1C'
  }

  #scan(frame: SerialFrameName, framing: SerialFraming, bytes: Buffer): Heard | undefined {
    try {
      return this.#whole(
        frame,
        bytes,
        framing.request.scan(bytes, (head, soFar) => this.#lengthOf(frame, head, soFar)),
      )
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      return this.#unreadable(frame, framing, bytes, error)
    }
  }

  #lengthOf(frame: SerialFrameName, head: SerialHead, soFar: Buffer): number | undefined {
    const length = this.#parts.lengthOf(frame, head, soFar)
    return length === 'unknown' ? undefined : length
  }

  #whole(
    frame: SerialFrameName,
    bytes: Buffer,
    scanned: Scanned<RequestFrame<SerialHead>> | undefined,
  ): Heard | undefined {
    if (scanned === undefined) return undefined
    this.#drop(scanned.used)
    return { kind: 'request', frame, request: scanned.frame, bytes: bytes.subarray(0, scanned.used) }
  }

  #unreadable(frame: SerialFrameName, framing: SerialFraming, bytes: Buffer, error: PlcError): Heard | undefined {
    const at = 'offset' in error && typeof error.offset === 'number' ? error.offset : bytes.length
    if (error.code === 'BAD_SUM') {
      const damaged = this.#damaged(frame, bytes, 'sum')
      this.#drop(at + SUM)
      return damaged
    }
    // In format 1 characters behind a frame may tell that one was doubled: the sum knows better than its end.
    const cut = error.code === 'TRAILING' ? this.#sumOf(frame, framing, bytes.subarray(0, at)) : undefined
    // Another start code: who began the frame has given it up.
    const given = error.code !== 'TRAILING' && isStart(bytes[at])
    this.#broken = given ? undefined : this.#damaged(frame, bytes, cut ?? damageOf(error))
    this.#drop(given ? at : 1)
    return undefined
  }

  #sumOf(frame: SerialFrameName, framing: SerialFraming, bytes: Buffer): 'sum' | undefined {
    try {
      framing.request.scan(bytes, (head, soFar) => this.#lengthOf(frame, head, soFar))
      return undefined
    } catch (error) {
      if (error instanceof PlcError) return error.code === 'BAD_SUM' ? 'sum' : undefined
      throw error
    }
  }

  // --- format 5

  #takeBinary(): Heard | undefined {
    const framing = this.#parts.framings.get('4C')
    if (framing === undefined) {
      this.#drop(this.#received.length)
      return undefined
    }
    this.#drop(framing.request.noise?.(this.#received) ?? 0)
    if (this.#received.length === 0) return undefined
    const bytes = this.#received
    try {
      return this.#whole(
        '4C',
        bytes,
        framing.request.scan(bytes, () => undefined),
      )
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      const damaged = this.#damaged('4C', bytes, error.code === 'BAD_SUM' ? 'sum' : damageOf(error))
      if (error.code !== 'BAD_SUM') {
        this.#broken ??= damaged
        this.#drop(1)
        return undefined
      }
      this.#drop(endOfBinary(bytes))
      return damaged
    }
  }

  // --- the end of what has no end

  #unfinished(): Heard | undefined {
    const bytes = this.#received
    if (this.#parts.format === 5) return bytes.length === 0 ? undefined : this.#damaged('4C', bytes, 'timeOut')
    if (bytes[0] !== ENQ || bytes.length < 3) return undefined
    const frame = this.#frameOf()
    const framing = frame === undefined ? undefined : this.#parts.framings.get(frame)
    if (frame === undefined || framing === undefined) return undefined
    return this.#unmeasured(frame, framing, bytes) ?? this.#damaged(frame, bytes, 'timeOut')
  }

  /** A body that nobody can measure is what has come. */
  #unmeasured(frame: SerialFrameName, framing: SerialFraming, bytes: Buffer): Heard | undefined {
    const { format, sumCheck, lengthOf } = this.#parts
    if (format !== 1) return undefined
    const facts = factsOfSerial(frame)
    const dataAt = 1 + serialHeadSize(facts, true)
    try {
      if (lengthOf(frame, serialHeadAt(facts, bytes, 1, true), bytes.subarray(dataAt)) !== 'unknown') return undefined
      const length = bytes.length - dataAt - (sumCheck ? SUM : 0)
      if (length < 0) return undefined
      return this.#whole(
        frame,
        bytes,
        framing.request.scan(bytes, () => length),
      )
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      return this.#damaged(frame, bytes, error.code === 'BAD_SUM' ? 'sum' : damageOf(error))
    }
  }

  /** Undefined where not even the station can be read. */
  #damaged(frame: SerialFrameName, bytes: Buffer, damage: FrameDamage): Damaged | undefined {
    const head = this.#parts.format === 5 ? stationOfBinary(bytes) : headOfAscii(frame, bytes)
    return head === undefined ? undefined : { kind: 'damaged', frame, head, damage }
  }
}

function damageOf({ code }: PlcError): FrameDamage {
  return code === 'BAD_DIGIT' ? 'header' : 'end'
}

/** The connected CPU of a station. */
function headOf(frame: SerialFrameName, station: number): SerialHead {
  const fields = factsOfSerial(frame).route.map((field) => [field, serialRouteFields[field].own])
  return { ...Object.fromEntries(fields), station, pc: serialRouteFields.pc.own }
}

/** Of a damaged frame nothing but the station is believed, and that only because its number is an own one. */
function headOfAscii(frame: SerialFrameName, bytes: Buffer): SerialHead | undefined {
  const stationAt = factsOfSerial(frame).frameId === undefined ? 1 : 3
  if (bytes.length < stationAt + 2) return undefined
  try {
    return headOf(frame, uintAt(bytes, stationAt, 1, true))
  } catch (error) {
    if (error instanceof PlcError) return undefined
    throw error
  }
}

/** Behind DLE STX: byte count, frame ID and station, each DLE twice. */
function stationOfBinary(bytes: Buffer): SerialHead | undefined {
  const plain: number[] = []
  for (let at = 2; at < bytes.length && plain.length < 4; at++) {
    if (bytes[at] === DLE) at++
    plain.push(bytes[at] ?? -1)
  }
  const [, , frameId, station] = plain
  return bytes[1] === STX && frameId === factsOfSerial('4C').frameId && station !== undefined && station >= 0
    ? headOf('4C', station)
    : undefined
}

/** Behind the sum check code of a frame whose form is right. */
function endOfBinary(bytes: Buffer): number {
  for (let at = 2; at < bytes.length; at++) {
    if (bytes[at] !== DLE) continue
    if (bytes[++at] === controlCodes.ETX) return at + 1 + SUM
  }
  return bytes.length
}
