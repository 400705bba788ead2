import type { DataCode } from '../../codec/codec'
import type { Route } from '../../melsec/frame/route'
import type { FrameName, ProfileId, ProfileInfo, ProfileOverrides, TransportName } from '../../melsec/profiles/profile'
import type { Clock } from '../../transport/clock'
import type { OpenTransport } from '../../transport/transport'
import type { ValueFormat } from '../../value/value'
import type { ProbeKind } from './probes'
import type { MelsecLine } from './serial-line'
import type { SerialLineFormat, SerialPortOptions } from './serial-options'

/** A PLC by a network: its own port, or the line of a serial device server. */
export interface NetworkPlc {
  /** Address or name of the PLC, or of the device server. */
  readonly host: string
  /** Port of an SLMP (MC protocol) entry of the PLC, or of the device server. */
  readonly port: number
  /** Of a device server: how long characters take on its line. */
  readonly serial?: (SerialPortOptions & { readonly path?: undefined }) | undefined
  /** Another way. */
  readonly line?: undefined
}

/** A PLC by a serial port of this computer, alone on its line. */
export interface SerialPlc {
  /** The serial port. */
  readonly serial: SerialPortOptions & { readonly path: string }
  /** Another way. */
  readonly host?: undefined
  /** Another way. */
  readonly port?: undefined
  /** Another way. */
  readonly line?: undefined
}

/** A PLC on a line that others share: the line says frame, format and sum check. */
export interface PlcOnLine {
  /** What `createMelsecLine()` gives. */
  readonly line: MelsecLine
  /** Of the line. */
  readonly host?: undefined
  /** Of the line. */
  readonly port?: undefined
  /** Of the line. */
  readonly serial?: undefined
}

/** How to reach a MELSEC PLC and how to speak to it. Times in milliseconds. */
export type MelsecClientOptions = MelsecOptions & (NetworkPlc | SerialPlc | PlcOnLine)

/** How to speak to a MELSEC PLC, whatever way there is to it. Times in milliseconds. */
export interface MelsecOptions extends Omit<SerialLineFormat, 'frame'> {
  /** Default `tcp`; `serial` with `serial.path` or `line`. */
  readonly transport?: TransportName
  /** Address of this computer to send from; default: the system chooses it. */
  readonly localAddress?: string
  /** Local port; default: any free one. */
  readonly localPort?: number
  /** Family of the PLC; default `generic`. It decides numbering, limits, forms and what is refused. */
  readonly profile?: ProfileId | ProfileInfo
  /** Own values for fields of the profile. */
  readonly profileOverrides?: ProfileOverrides
  /** Default: the profile's. */
  readonly frame?: FrameName
  /** Data code of the PLC's port; default `binary`. Of serial frames the format says it. */
  readonly code?: DataCode
  /** Digits of X and Y in ASCII code, as the port of an iQ-F is set; needed for its X and Y in ASCII code. Others have no such setting. */
  readonly asciiXy?: 'octal' | 'hexadecimal'
  /** Digits of ZR in ASCII code; needed for ZR in ASCII code, because the manuals disagree. */
  readonly asciiZr?: 'decimal' | 'hexadecimal'
  /**
   * Labels in ASCII code: which word of a value of two or four words comes first. The manual does not say it clearly, so
   * such labels are refused in ASCII code without it (try it on a label whose value you know).
   */
  readonly asciiWordOrder?: 'low-first' | 'high-first'
  /** How X and Y are numbered in addresses: 8 octal, 16 hexadecimal. Default: the profile's. */
  readonly xyRadix?: 8 | 16
  /**
   * How W is numbered in addresses: 16 hexadecimal, 10 decimal, as SLMP inverters (FR-E800) are said to do. Default: the
   * profile's, which is 16. Decimal in binary code only: nobody says which digits ASCII code takes then.
   */
  readonly wRadix?: 10 | 16
  /**
   * Station to speak to; default: the connected station. Stations above 120 need frame `ext`. On a serial line `station` is
   * that of the line (0), and what is behind it says `network`, `pc`, `moduleIo` and `multidrop`.
   */
  readonly route?: RouteOptions
  /** 1C: time before the PLC answers at the earliest, 0 (default) to 150 in steps of 10; some converters need 70 or more. */
  readonly messageWait?: number
  /** Time the PLC gives the request, a multiple of 250 up to 16383750; 0 = for ever. Default: the profile's. */
  readonly monitoringTimer?: number
  /** Default deadline of a call; 3000. */
  readonly timeout?: number
  /** Time for an attempt to connect; 5000. */
  readonly connectTimeout?: number
  /** Requests in flight at once; 1. More only with 4E over UDP, up to the profile's bound. */
  readonly inFlight?: number
  /** Requests that may wait; 256. One more is refused with `QUEUE_FULL`; what changes the PLC has as much room again. */
  readonly queueLimit?: number
  /** Write commands are refused unless this is true. */
  readonly allowWrites?: boolean
  /** Remote control commands are refused unless this is true. */
  readonly allowControl?: boolean
  /**
   * Remote password of the PLC (Q and L 4, iQ-R and iQ-F 6 to 32 characters): unlocks it on every connection, locks it at
   * `close()`. It is never shown. A wrong one is sent once; see `setPassword()`.
   */
  readonly password?: string
  /**
   * The request that proves a new connection: `typeName` Read Type Name, `read` a Read of D0, `auto` (default) the type
   * name, and the Read where that gets no answer. `none`: the first request of the program proves it, and is sent once.
   */
  readonly probe?: ProbeKind
  /** Words that may be read in vain to merge near items into one request; 64. */
  readonly gap?: number
  /** Default word order, byte order and text encoding of items. */
  readonly format?: ValueFormat
  /** Pauses after failed attempts to connect: first 500, doubled up to longest 30000, with jitter. */
  readonly reconnect?: { readonly first?: number; readonly longest?: number }
  /** Pause between closing a connection and opening the next; 50. */
  readonly settleGap?: number
  /** Makes the transport instead of `transport`, `host` and `port`: for tests and the in-process simulator. */
  readonly openTransport?: OpenTransport
  /** Time, for tests. @internal */
  readonly clock?: Clock
  /** 0 to below 1, for the jitter: for tests. @internal */
  readonly random?: () => number
}

/** The parts of a route; `pc` and `selfStation` stand in serial frames only. */
export type RouteOptions = Partial<Route> & {
  /** PC number; 255 (default): the connected station. */
  readonly pc?: number
  /** Self station number: 0 (default) but on a line with several computers. */
  readonly selfStation?: number
}

/** Names of the options, each once. */
export const OPTION_NAMES = {
  host: true,
  port: true,
  serial: true,
  line: true,
  messageFormat: true,
  sumCheck: true,
  serialFrame: true,
  messageWait: true,
  transport: true,
  localAddress: true,
  localPort: true,
  profile: true,
  profileOverrides: true,
  frame: true,
  code: true,
  asciiXy: true,
  asciiZr: true,
  asciiWordOrder: true,
  xyRadix: true,
  wRadix: true,
  route: true,
  monitoringTimer: true,
  timeout: true,
  connectTimeout: true,
  inFlight: true,
  queueLimit: true,
  allowWrites: true,
  allowControl: true,
  password: true,
  probe: true,
  gap: true,
  format: true,
  reconnect: true,
  settleGap: true,
  openTransport: true,
  clock: true,
  random: true,
} as const satisfies Record<keyof MelsecClientOptions, true>
