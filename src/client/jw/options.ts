import type { JwModel } from '../../jw/commands/command'
import type { JwHeader } from '../../jw/header'
import type { JwArea } from '../../jw/operand/area'
import type { Clock } from '../../transport/clock'
import type { OpenTransport } from '../../transport/transport'
import type { ValueFormat } from '../../value/format'
import type { ReconnectOptions } from '../connection/option-checks'

/** What carries the messages of a Sharp JW. */
export const jwTransportNames = ['tcp', 'udp'] as const
/** What carries the messages of a Sharp JW. */
export type JwTransportName = (typeof jwTransportNames)[number]

/**
 * How a new connection is proved, by a request that changes nothing. `writeMode`: Read write mode (E9H), which every model
 * answers in any mode, stopped or running. `read`: one byte of the data memory (24H of register 09000). `none`: the first request
 * of the program proves it.
 */
export const jwProbeKinds = ['writeMode', 'read', 'none'] as const
/** How a new connection is proved. */
export type JwProbeKind = (typeof jwProbeKinds)[number]

/** How to reach a Sharp JW and how to speak to it. Times in milliseconds. */
export interface JwClientOptions {
  /** Address or name of the unit; not needed with `openTransport`. */
  readonly host?: string
  /** Port of the unit, as its parameters say; no manual at hand names a usual one. */
  readonly port?: number
  /** Default `tcp`. */
  readonly transport?: JwTransportName
  /** Address of this computer to send from; default: the system chooses it. */
  readonly localAddress?: string
  /** Local port; default: any free one. For units whose parameters name the port of the partner. */
  readonly localPort?: number
  /** Family of the CPU; default `jw300`. `jw30h` (also JW20H and older) has no lists, no extended addresses, no parameters and no loopback. */
  readonly model?: JwModel
  /**
   * What stands in front of a message: `none` (default), as the JW300 manual prints messages; `zero40`, 40 bytes 00, as the manual
   * of the FL-net units does and as units on Ethernet probably want it; a relay; or bytes. `findJwHeader()` finds out.
   * In answers it is detected.
   */
  readonly header?: JwHeader
  /** Where FFH stands in lists of relays and registers: `once` before the first (default), as the manual draws it, or before `each`. */
  readonly marker?: 'once' | 'each'
  /**
   * Whether scattered items may share a request (27H, 31H, 37H of a JW300); default true. What is written so is read so first,
   * once, because the manual leaves the place of FFH open. `false`: only what lies in a row shares one.
   */
  readonly lists?: boolean
  /** Where operands lie that no source places, e.g. `assumedJwAreas`, or what your manual says. */
  readonly areas?: readonly JwArea[]
  /**
   * Bytes of data in one request at most, 1 to 1024. Default: 1024 over TCP, what a message of less than 1024 bytes holds over
   * UDP, 256 through a relay, as the manual of the FL-net units says.
   */
  readonly maxData?: number
  /** Default deadline of a call; 3000. */
  readonly timeout?: number
  /** Time for an attempt to connect; 5000. */
  readonly connectTimeout?: number
  /** Requests that may wait; 256. One more is refused with `QUEUE_FULL`; what changes the PLC has as much room again. */
  readonly queueLimit?: number
  /** Data memory, timers and buffers are written, and ring buffers read, only if this is true. */
  readonly allowWrites?: boolean
  /** Stop and release, write mode and clock are refused unless this is true. */
  readonly allowControl?: boolean
  /**
   * What changes how the PLC is set up is refused unless this is true: parameters of units, definitions of buffers, the
   * system memory, and the secret function.
   */
  readonly allowParameters?: boolean
  /** The request that proves a new connection; default `writeMode`. */
  readonly probe?: JwProbeKind
  /** Bytes that may be read in vain to merge near items into one request; 128. */
  readonly gap?: number
  /** Default word order, byte order and text encoding of items. */
  readonly format?: ValueFormat
  /** Pauses after failed attempts to connect: first 500, doubled up to longest 30000, with jitter. */
  readonly reconnect?: ReconnectOptions
  /** Pause between closing a connection and opening the next; 50. */
  readonly settleGap?: number
  /** Makes the transport instead of `transport`, `host` and `port`: for tests and the in-process simulator. */
  readonly openTransport?: OpenTransport
  /** Time, for tests. @internal */
  readonly clock?: Clock
  /** 0 to below 1, for the jitter: for tests. @internal */
  readonly random?: () => number
}

/** Names of the options, each once. */
export const JW_OPTION_NAMES = {
  host: true,
  port: true,
  transport: true,
  localAddress: true,
  localPort: true,
  model: true,
  header: true,
  marker: true,
  lists: true,
  areas: true,
  maxData: true,
  timeout: true,
  connectTimeout: true,
  queueLimit: true,
  allowWrites: true,
  allowControl: true,
  allowParameters: true,
  probe: true,
  gap: true,
  format: true,
  reconnect: true,
  settleGap: true,
  openTransport: true,
  clock: true,
  random: true,
} as const satisfies Record<keyof JwClientOptions, true>
