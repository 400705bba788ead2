// The serial port of a station: which requests there are in each frame, and in which codes it refuses them.
import { PlcError } from '../errors'
import type { RequestFrame } from '../link/link'
import { type SerialFrameName, type SerialHead, serialRouteFields } from '../melsec/frame/serial-frames'
import type { SerialFraming } from '../melsec/frame/serial-framing'
import type { Profile } from '../melsec/profiles/profile'
import { type ReceivedRequest, SlmpCommandSet } from '../melsec/protocol'
import type { FrameDamage } from './line-receiver'
import { type GlobalSignal, nak1c, OneCPort } from './one-c-port'
import type { LineAsked } from './plc'
import { Refusal, requestErrors } from './refusal'
import { requestIn, slmpRequest } from './request'

/** A request to a station as it was understood. */
export interface StationRequest {
  readonly frame: SerialFrameName
  readonly request: RequestFrame<SerialHead>
  /** As sent; 0 in 1C. */
  readonly command: number
  readonly subcommand: number
  readonly asked: LineAsked | GlobalSignal | Refusal
  /** 1C: ms before the answer at the earliest. */
  readonly wait: number
}

/** 47.2, of 3C and 4C. */
const NAK = { header: 0x7f21, end: 0x7f23, sum: 0x7f24, timeOut: 0x7f40, content: 0x7164 } as const

/** End codes of the Ethernet ports that 47.2 does not list, and what says the same. */
const SAME: ReadonlyMap<number, number> = new Map([
  [requestErrors.asciiConversion, NAK.header],
  [requestErrors.content, NAK.content],
  [requestErrors.bitData, NAK.content],
])

/** 1C has no code for a message that broke off: its NAK list (47.2) knows none, so nothing is answered. */
const DAMAGE_1C: Readonly<Record<FrameDamage, number | undefined>> = {
  sum: nak1c.sum,
  header: nak1c.protocol,
  end: nak1c.protocol,
  timeOut: undefined,
}

export interface StationPortParts {
  readonly profile: Profile
  readonly framings: ReadonlyMap<SerialFrameName, SerialFraming>
  readonly asciiXy: 'octal' | 'hexadecimal'
  readonly otherStations: 'refuse' | 'silence'
}

export class StationPort {
  readonly #parts: StationPortParts
  readonly #oneC: OneCPort | undefined
  readonly #sets: ReadonlyMap<SerialFrameName, SlmpCommandSet>

  constructor(parts: StationPortParts) {
    const { profile, framings, asciiXy } = parts
    this.#parts = parts
    const oneC = framings.get('1C')
    this.#oneC = oneC === undefined ? undefined : new OneCPort(profile, oneC, asciiXy)
    this.#sets = new Map(
      [...framings]
        .filter(([frame]) => frame !== '1C')
        .map(([frame, { code, body }]) => [
          frame,
          new SlmpCommandSet({ profile, code, body, asciiXy, asciiZr: 'decimal' }),
        ]),
    )
  }

  /** Length of a body, where frames carry none; `unknown`: nobody can tell. */
  lengthOf(frame: SerialFrameName, head: SerialHead, soFar: Buffer): number | 'unknown' | undefined {
    try {
      if (frame === '1C') return this.#oneC?.requestLength(head, soFar)
      return this.#sets.get(frame)?.requestLength(soFar)
    } catch (error) {
      if (error instanceof PlcError) return 'unknown'
      throw error
    }
  }

  /** `undefined` for what is not for this station, and for frames that it does not know. */
  receive(frame: SerialFrameName, request: RequestFrame<SerialHead>): StationRequest | undefined {
    const set = this.#sets.get(frame)
    if (set !== undefined) return this.#receiveSet(set, frame, request)
    return frame === '1C' && this.#oneC !== undefined ? this.#receive1c(this.#oneC, request) : undefined
  }

  #receiveSet(
    protocol: SlmpCommandSet,
    frame: SerialFrameName,
    request: RequestFrame<SerialHead>,
  ): StationRequest | undefined {
    const { request: read, ...codes } = slmpRequest(protocol, request)
    const known = { frame, request, ...codes, wait: 0 }
    if (isConnected(request.head))
      return { ...known, asked: read instanceof Refusal ? read : { request: read, protocol } }
    if (this.#parts.otherStations === 'silence') return undefined
    return { ...known, asked: new Refusal(this.#parts.profile.refusals.station, 'the route leads to another module') }
  }

  #receive1c(port: OneCPort, request: RequestFrame<SerialHead>): StationRequest {
    const known = { frame: '1C', request, command: 0, subcommand: 0, wait: port.waitOf(request.body) } as const
    try {
      const read = port.read(request)
      // 47.2: there is no station with this PC No.
      if (!isConnected(request.head)) {
        return { ...known, asked: new Refusal(nak1c.pc, `there is no PC No. ${request.head.pc}`) }
      }
      if (!('respond' in read)) return { ...known, asked: read }
      return { ...known, asked: { request: requestIn(read), respond: read.respond } }
    } catch (error) {
      if (error instanceof Refusal) return { ...known, asked: error }
      throw error
    }
  }

  /** The code behind NAK for a damaged frame; `undefined`: silence. */
  damageCode(frame: SerialFrameName, damage: FrameDamage): number | undefined {
    return frame === '1C' ? DAMAGE_1C[damage] : NAK[damage]
  }

  /** A refusal in the codes of the frame. */
  refusalOf(frame: SerialFrameName, refusal: Refusal): Refusal {
    if (frame === '1C') return this.#oneC?.refusalOf(refusal) ?? refusal
    const same = SAME.get(refusal.endCode)
    return same === undefined ? refusal : new Refusal(same, refusal.message)
  }

  /** What stands behind an error code: something in format 5 only, where the line is set so. */
  errorInformation({ frame, request: { head }, command, subcommand }: StationRequest): Buffer {
    const { network = 0, pc: station, moduleIo = 0x3ff, multidrop = 0 } = head
    const set = this.#sets.get(frame)
    return set?.writeErrorInformation({ network, station, moduleIo, multidrop, command, subcommand }) ?? Buffer.alloc(0)
  }
}

/** Whether a route ends at the station that its number names. */
function isConnected({ station: _, ...rest }: SerialHead): boolean {
  return Object.entries(rest).every(([field, value]) => value === ownOf(field))
}

function ownOf(field: string): number | undefined {
  return Object.entries(serialRouteFields).find(([name]) => name === field)?.[1].own
}

/** The command of a request that could be read. */
export function readOf({ asked }: StationRequest): ReceivedRequest | undefined {
  return asked instanceof Refusal || 'on' in asked ? undefined : asked.request
}
