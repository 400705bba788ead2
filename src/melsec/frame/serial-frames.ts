// The serial frames of the MC protocol (FX5 communication manual 42.2 to 42.5) as data: what stands in each, and in which
// format it is sent.
import { hex } from '../../basics/hex'
import type { DataCode } from '../../codec/codec'
import { RequestError } from '../../errors'

/** Control codes of the serial frames by their names (42.3). CL is the form feed of ASCII. */
export const controlCodes = {
  STX: 0x02,
  ETX: 0x03,
  EOT: 0x04,
  ENQ: 0x05,
  ACK: 0x06,
  LF: 0x0a,
  CL: 0x0c,
  CR: 0x0d,
  DLE: 0x10,
  NAK: 0x15,
} as const

export type ControlCode = keyof typeof controlCodes

/** The route of a serial frame. A field that its frame does not have is absent. */
export type SerialHead = {
  /** Of the line: 0 to 15 on FX5, to 31 on C24 modules; FFH is every station, for the global signal of 1C only. */
  readonly station: number
  readonly pc: number
  readonly network?: number
  readonly moduleIo?: number
  readonly multidrop?: number
  readonly selfStation?: number
}

export type SerialRouteField = keyof SerialHead

interface RouteFieldFacts {
  readonly title: string
  /** Bytes in binary code; twice as many characters in ASCII code. */
  readonly width: 1 | 2
  /** The connected CPU. On FX5 it is fixed, but for the station number (42.5). */
  readonly own: number
  /** What reaches further through a C24 module. */
  readonly last: number
  /** The last one of FX5, where it has a choice. */
  readonly lastOfFx5?: number
}

export const serialRouteFields: Readonly<Record<SerialRouteField, RouteFieldFacts>> = {
  station: { title: 'Station', width: 1, own: 0, last: 31, lastOfFx5: 15 },
  network: { title: 'Network', width: 1, own: 0, last: 0xff },
  pc: { title: 'PC number', width: 1, own: 0xff, last: 0xff },
  moduleIo: { title: 'Module I/O', width: 2, own: 0x3ff, last: 0xffff },
  multidrop: { title: 'Multidrop station', width: 1, own: 0, last: 31 },
  selfStation: { title: 'Self station', width: 1, own: 0, last: 31 },
}

export interface SerialFrameFacts {
  /** 1C has none. */
  readonly frameId?: number
  /** In the order of the frame. */
  readonly route: readonly SerialRouteField[]
  readonly formats: readonly SerialFormat[]
  /** Digits of the error code behind NAK. */
  readonly errorDigits: 2 | 4
}

/** Format of a serial frame: 1 and 4 in ASCII code, 5 (4C only) in binary code. Formats 2 and 3 do not exist on FX5. */
export type SerialFormat = 1 | 4 | 5

export const serialFrameFacts = {
  '1C': { route: ['station', 'pc'], formats: [1, 4], errorDigits: 2 },
  '3C': { frameId: 0xf9, route: ['station', 'network', 'pc', 'selfStation'], formats: [1, 4], errorDigits: 4 },
  '4C': {
    frameId: 0xf8,
    route: ['station', 'network', 'pc', 'moduleIo', 'multidrop', 'selfStation'],
    formats: [1, 4, 5],
    errorDigits: 4,
  },
} as const satisfies Readonly<Record<string, SerialFrameFacts>>

/** Name of a serial frame. */
export type SerialFrameName = keyof typeof serialFrameFacts
/** Names of the serial frames. */
export const serialFrameNames = ['1C', '3C', '4C'] as const satisfies readonly SerialFrameName[]

/** Facts of a frame whatever frame it is. */
export function factsOfSerial(frame: SerialFrameName): SerialFrameFacts {
  return serialFrameFacts[frame]
}

export function isSerialFrame(name: string): name is SerialFrameName {
  return serialFrameNames.some((one) => one === name)
}

/** @throws RequestError BAD_OPTION when the frame does not have the format */
export function checkFormat(frame: SerialFrameName, format: SerialFormat): void {
  const { formats } = factsOfSerial(frame)
  if (formats.includes(format)) return
  throw new RequestError('BAD_OPTION', `The ${frame} frame has formats ${formats.join(', ')}, not ${format}.`, 'format')
}

export const serialFormatCodes: Readonly<Record<SerialFormat, DataCode>> = { 1: 'ascii', 4: 'ascii', 5: 'binary' }

/** Bytes of a frame without added DLEs; the longest message of the manual has half of it. */
export const LONGEST_SERIAL_FRAME = 16_384

/** The first word of the data of every answer in format 5; no command has this number. */
export const RESPONSE_ID = 0xffff

/** The global signal (GW of 1C) to all stations. What the manual says of an answer to it: nothing. */
export const allStations: SerialHead = { station: 0xff, pc: 0xff }

/**
 * The head of a frame from the parts that differ from the connected CPU.
 * @param reach `fx5`: the module is an FX5 CPU, where all but the station is fixed; `c24`: a C24 module that relays
 * @throws RequestError OUT_OF_RANGE
 * @example serialRoute('3C', { station: 2 }, 'fx5') // { station: 2, network: 0, pc: 255, selfStation: 0 }
 */
export function serialRoute(
  frame: SerialFrameName,
  given: Partial<SerialHead> = {},
  reach: 'fx5' | 'c24' = 'fx5',
): SerialHead {
  const { route } = factsOfSerial(frame)
  for (const [name, value] of Object.entries(given)) {
    const field = route.find((one) => one === name)
    if (field !== undefined) checkField(field, value, reach)
    else if (value !== undefined) refuse(name, `The ${frame} frame has no ${name}: it has ${route.join(', ')}.`)
  }
  const { station = serialRouteFields.station.own, pc = serialRouteFields.pc.own, ...rest } = given
  const others = route.filter((name) => name !== 'station' && name !== 'pc')
  const filled = others.map((name) => [name, rest[name] ?? serialRouteFields[name].own])
  return { station, pc, ...Object.fromEntries(filled) }
}

function checkField(field: SerialRouteField, value: number, reach: 'fx5' | 'c24'): void {
  const { title, own, last, lastOfFx5 } = serialRouteFields[field]
  const isFixed = reach === 'fx5' && lastOfFx5 === undefined
  const most = reach === 'fx5' ? (lastOfFx5 ?? own) : last
  if (isFixed ? value === own : Number.isInteger(value) && value >= 0 && value <= most) return
  if (isFixed) refuse(field, `${title} ${value} is not reached through an FX5: it is always ${shown(field, own)}.`)
  const all =
    field === 'station' && value === allStations.station ? ' All stations are for the global signal only.' : ''
  refuse(field, `${title} ${value} does not exist: 0 to ${most}.${all}`)
}

function shown(field: SerialRouteField, value: number): string {
  return `${value} (${hex(value, 2 * serialRouteFields[field].width)}H)`
}

function refuse(field: string, message: string): never {
  throw new RequestError('OUT_OF_RANGE', message, `route.${field}`)
}
