// Why a PLC that can be reached says nothing: ranked causes, most likely first. A PLC never says which it is; these
// are the settings that make one silent (FX5 communication manual: wrong data code "no response"; needs of the field).
import type { DataCode } from '../../codec/codec'
import { type FrameFacts, frameFacts } from '../../melsec/frame/frames'
import { isConnectedStation, type RouteToStation, stationText } from '../../melsec/frame/route'
import type { FrameName, TransportName } from '../../melsec/profiles/profile'
import type { Silence } from '../connection/connection'
import { LONGER, type SerialLink, SLOW, serialCauses, serialChanges, UNKNOWN_REQUEST } from './serial-diagnosis'

export interface LinkSettings {
  readonly transport: TransportName
  readonly port: number | undefined
  readonly frame: FrameName
  /** Frames of the family, when it is known: another one is not proposed. */
  readonly frames?: readonly FrameName[]
  readonly code: DataCode
  readonly route: RouteToStation
  /** Local port, when the user fixed it. */
  readonly localPort?: number | undefined
  /** On a serial line: what both sides must have alike. */
  readonly link?: SerialLink | undefined
}

const OTHER_CODE = { binary: 'ASCII', ascii: 'binary' } as const
const THIS_CODE = { binary: 'binary code', ascii: 'ASCII code' } as const

/** Ranked causes of a silence, as sentences that say what to check. */
export function explainSilence(settings: LinkSettings, silence: Silence): readonly string[] {
  const { link } = settings
  if (silence.answeredBefore) return link === undefined ? afterItWorked() : serialChanges
  const causes = link === undefined ? fromTheStart(settings) : serialCauses(link, otherFrame(settings), silence)
  return silence.onlyAsked === undefined ? causes : [...causes, unknownProbe(silence.onlyAsked)]
}

function fromTheStart(settings: LinkSettings): readonly string[] {
  const { transport, port, frame, code, route, localPort } = settings
  const dataCode = `The PLC's port is set to ${OTHER_CODE[code]} code and this connection to ${THIS_CODE[code]}: compare "communication data code" in GX Works.`
  const peer =
    `UDP: the PLC sends its answer to the peer that is registered in its open settings; register this computer's address${localPort === undefined ? ' and set a fixed local port here' : ` and port ${localPort}`}, ` +
    'or choose an entry that answers anybody. A firewall on the way has the same effect.'
  const otherPort = `Port ${port} is open for something else (MELSOFT, socket, Modbus): use the port of an SLMP (MC protocol) entry.`
  const elsewhere = `Network ${route.network}, ${stationText(route).toLowerCase()} does not answer: check the route, or leave it at the own station.`
  const routed = !isConnectedStation(route)
  const frameCauses = otherFrame(settings)
  // 3E is known to all, binary is usual: who has neither chosen has a series whose default the PLC does not know (FX5 as iQ-R).
  const settingsOf =
    frame === '3E' || code === 'ascii' ? [dataCode, otherPort, ...frameCauses] : [...frameCauses, dataCode, otherPort]
  const common = [...settingsOf, SLOW]
  const ranked = transport === 'udp' ? [peer, ...common] : common
  return routed ? [elsewhere, ...ranked] : ranked
}

/** None where the family has no other. */
function otherFrame({ frame, frames }: LinkSettings): readonly string[] {
  const { title, instead, knownTo }: FrameFacts = frameFacts[frame]
  if (frames?.includes(instead) === false) return []
  return [`The PLC does not know the ${title} frame: try ${instead}${knownTo === undefined ? '' : ` (${knownTo})`}.`]
}

/** Nothing else was asked, so it may be that request alone that the device does not know. */
function unknownProbe(asked: string): string {
  return `The device does not know ${asked}, which is all that it was asked: set probe to read or none.`
}

function afterItWorked(): readonly string[] {
  return [
    'The PLC is off, restarting, or its cable or a switch on the way is interrupted.',
    LONGER,
    'The port settings of the PLC were changed (data code, entry, remote password) since it last answered.',
    UNKNOWN_REQUEST,
  ]
}
