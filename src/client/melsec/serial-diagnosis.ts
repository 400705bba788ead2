// Why a PLC on a serial line says nothing: ranked causes, most likely first. Nothing on such a line says what is wrong: a PLC is
// silent to whatever it does not take for a request (FX5 communication manual 18, 42; needs of the field).
import type { SerialFormat } from '../../melsec/frame/serial-frames'
import type { SerialSettings } from '../../transport/serial'
import type { Silence } from '../connection/connection'

/** What both sides must have alike. */
export interface SerialLink {
  readonly station: number
  readonly format: SerialFormat
  readonly sumCheck: boolean
  readonly port: SerialSettings
  /** The line is behind a device server. */
  readonly isRemote: boolean
}

export const SLOW = 'The PLC is busy or the line slow: raise the timeout.'
export const LONGER = 'The PLC needed longer than the timeout: raise it, or ask for less at once.'
export const UNKNOWN_REQUEST = 'The device answers other requests, but does not know this one and says nothing to it.'

const PROTOCOL =
  "The PLC's port does not speak MC protocol: choose it as the protocol of this channel in GX Works, write the parameters, and switch the PLC off and on."
const WIRES =
  'The wires: SDA and SDB of one side belong to RDA and RDB of the other (RS-485), TXD to RXD (RS-232C); A and B may be exchanged, or ground or terminating resistor missing.'
const CONVERTER =
  'The converter does not let go of the line after it has sent, or gives our own characters back: choose RTS "while sending", or a converter that switches by itself.'
/** A PLC counts as silent after the answer time of the line already: a longer timeout alone changes nothing. */
const SERIAL_SLOW = 'The PLC is busy or the line slow: raise the answer time of the line (answerTime), or the timeout.'
const SERIAL_LONGER =
  'The PLC began to answer later than the answer time of the line (answerTime) or the timeout allows: raise it.'
const OFF = 'The PLC is off, restarting, or its cable is interrupted.'
const SERVER = 'The device server is not in raw TCP mode, or its serial settings are not those of the PLC.'

/** @param otherFrame the cause that says which frame to try; none where the family has no other */
export function serialCauses(
  link: SerialLink,
  otherFrame: readonly string[],
  { heard, othersAnswer }: Silence,
): readonly string[] {
  const server = link.isRemote ? [SERVER] : []
  const [station, speed, characters] = [stationOf(link), speedOf(link), charactersOf(link)]
  const framing = [formatOf(link), sumOf(link), ...otherFrame]
  // Others speak as this line does: what differs is a matter of this PLC.
  if (othersAnswer === true) return [station, OFF, PROTOCOL, speed, characters, ...framing, WIRES, SERIAL_SLOW]
  // Something came that is no answer: the wires are right.
  if (heard === true) return [...server, speed, characters, CONVERTER, ...framing, PROTOCOL, station, SERIAL_SLOW]
  return [...server, PROTOCOL, speed, characters, station, ...framing, WIRES, CONVERTER, OFF, SERIAL_SLOW]
}

function stationOf({ station }: SerialLink): string {
  return `No PLC on the line has station number ${station}: compare it with the station number in the parameters of the PLC.`
}

function speedOf({ port }: SerialLink): string {
  return `The baud rate of the PLC's port is another one: here it is ${port.baudRate} bps.`
}

function charactersOf({ port: { dataLength, parity, stopBits } }: SerialLink): string {
  const short = `${dataLength}${parity.charAt(0).toUpperCase()}${stopBits}`
  return `Data length, parity bit or stop bit of the PLC's port are others: here they are ${short}.`
}

function formatOf({ format }: SerialLink): string {
  return `The message format of the PLC's port is another one: here it is format ${format}.`
}

function sumOf({ sumCheck }: SerialLink): string {
  return sumCheck
    ? "The PLC's port has no sum check code, and this line adds one."
    : "The PLC's port has a sum check code, and this line adds none."
}

/** What may have changed since it answered. */
export const serialChanges: readonly string[] = [
  OFF,
  SERIAL_LONGER,
  'Another program or device sends on this line at the same time.',
  "The settings of the PLC's port were changed since it last answered.",
  UNKNOWN_REQUEST,
]
