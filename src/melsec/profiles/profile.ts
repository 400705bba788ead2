// What a family of PLCs is like, as data: numbering, frames, forms, limits, what it lacks and how it refuses.

import type { DataCode } from '../../codec/codec'
import { RequestError } from '../../errors'
import type { ACompatibleFamily } from '../a-compatible/rules'
import type { CommandName } from '../commands/commands'
import type { AddressOptions } from '../device/address'
import type { DeviceName, ExtensionKind } from '../device/device'
import type { DeviceForm } from '../device/device-form'
import type { Notation } from '../device/json'
import type { LimitRule, LimitUnit } from '../device/limit-rule'
import type { FrameName } from '../frame/frames'
import type { SerialFacts } from './serial-facts'

/** Every profile's id, in the order people look for them. */
export const profileIds = [
  'iq-r',
  'iq-f',
  'fx5-enet',
  'q',
  'q-built-in',
  'q-e71',
  'l',
  'fx3',
  'fx5-serial',
  'fx3-serial',
  'iq-r-c24',
  'q-c24',
  'l-c24',
  'remote-head',
  'nz2gf-etb',
  'generic',
] as const

/** Id of a profile. */
export type ProfileId = (typeof profileIds)[number]
export type { FrameName } from '../frame/frames'
/** What a port is reached by. */
export const transportNames = ['tcp', 'udp', 'serial'] as const
/** What a port is reached by. */
export type TransportName = (typeof transportNames)[number]

/** A command this family does not have, or not on each of its ports. */
export interface Lack {
  /** Name of the command. */
  readonly command: CommandName
  /** End code the PLC answers to it. */
  readonly endCode: number
  /** Why, as a sentence. */
  readonly reason: string
  /** What to do instead. */
  readonly instead: string
  /** Where it is written. */
  readonly source: string
}

/** Devices that some commands do not take on this family, beside the restrictions of the SLMP manual. */
export interface DeviceExclusion {
  readonly commands: readonly CommandName[]
  readonly devices: readonly DeviceName[]
  readonly endCode: number
  readonly reason: string
  readonly instead: string
  /** It is printed of other ports only: sent when asked for, and never chosen by the planner. */
  readonly doubtful?: true
  readonly source: string
}

/** End codes of refusals that are about no limit. */
export interface Refusals {
  /** Device number outside the range. */
  readonly deviceNumber: number
  /** Device name this CPU does not have. */
  readonly deviceName: number
  /** The same in an extension specification (subcommands 008x). */
  readonly extendedDeviceName: number
  /** Bit units on a word device. */
  readonly bitUnitsOfWordDevice: number
  /** The module or network behind an extension is not there, or cannot be reached. */
  readonly extension: number
  /** Unknown command or subcommand. */
  readonly command: number
  /** Execute Monitor without Entry Monitor Device. */
  readonly monitorNotRegistered: number
  /** Request data longer or shorter than the request says. */
  readonly length: number
  /** Remote control refused: wrong CPU state for it (latch clear or reset while not in STOP). */
  readonly notInStop: number
  /** Remote control refused: another device stopped or paused the CPU, or reset is not permitted by parameter. */
  readonly remote: number
  /** Device that this command does not take. */
  readonly device: number
  /** Contact or coil of a timer or counter in Entry Monitor Device. */
  readonly monitoredContact: number
  /** Long timers and counters not in whole devices. */
  readonly wholeDevices: number
  /** Beyond the buffer memory of a module. */
  readonly bufferMemory: number
  /** A station that cannot be reached. */
  readonly station: number
  /** A module of this station that is no CPU. */
  readonly module: number
  readonly source: string
}

/** Requests it can take before it has answered. */
export interface InFlight {
  /** Requests in flight on one TCP connection. */
  readonly tcp: number
  /** Messages the receive buffer holds: over UDP with serial numbers 1 + (udpBuffer / connections in use), rounded down. */
  readonly udpBuffer: number
  /** The same figure of each port this profile stands for; `udpBuffer` is the lowest. Empty where there is no pipelining. */
  readonly ports: readonly { readonly port: string; readonly buffer: number }[]
  /** Where it is written. */
  readonly source: string
}

/** Where requests can go from the port. */
export interface Reach {
  /** `connected`: the connected station only; `networks`: other stations too, where the port is in a network with them. */
  readonly stations: 'connected' | 'networks'
  /** Module I/O numbers that mean the CPU of the connected station. */
  readonly ownModuleIo: readonly number[]
  /** Module I/O numbers of CPUs that are not the control CPU: they register no monitor (appendix 3). */
  readonly nonControlCpus: readonly number[]
  /** The port takes no other module I/O number. */
  readonly ownModuleIoOnly: boolean
  /** Where it is written. */
  readonly source: string
}

/** The remote password of the port: how one is refused. */
export interface PasswordFacts {
  readonly wrong: number
  /** The wrong one that leads to the lock-out. */
  readonly last: number
  /** No password is taken for a while, the right one neither. */
  readonly lockedOut: number
  /** Lock looks at the password; otherwise it locks with any. */
  readonly lockChecks: boolean
  readonly source: string
}

/** A usual CPU or module of the family: what a simulated one answers to Read Type Name. */
export interface UsualModel {
  readonly code: number
  /** Where the code is in no list of models. */
  readonly name?: string
}

/** Connections a port has at the same time. */
export interface Connections {
  /** So many; a further one is accepted and ended at once. */
  readonly most: number
  /** Where it is written. */
  readonly source: string
}

/** Last index register of each kind that can modify an address. */
export interface LastIndex {
  /** Number of the last Z; -1: none. */
  readonly Z: number
  /** Number of the last LZ; -1: none. */
  readonly LZ: number
  /** Where it is written. */
  readonly source: string
}

/** Where the CPU tells whether it runs: b0 to b3 of a register, 0 RUN, 2 STOP, 3 PAUSE. */
export interface StatusRegister {
  /** Always a special register. */
  readonly device: 'SD'
  /** Its number. */
  readonly number: number
  /** Where it is written. */
  readonly source: string
}

/** What a port takes as monitoring timer: the time the PLC gives a request. */
export interface MonitoringTimer {
  /** In ms, a multiple of 250. 0 is "wait for ever" on the PLC's side. */
  readonly default: number
  /** The PLC takes nothing but 0. */
  readonly zeroOnly: boolean
  /** Recommended for the own station, in ms. */
  readonly recommended?: { readonly from: number; readonly to: number }
  /** Where it is written. */
  readonly source: string
}

/** Remote control, as far as families differ. */
export interface RemoteFacts {
  /** Clear modes Remote RUN takes. */
  readonly clearModes: readonly (0 | 1 | 2)[]
  /** Conditions of a remote reset, for people. */
  readonly reset: string
  /** Absent: it is not known where, or the frame does not reach it; remote control cannot be verified then. */
  readonly status?: StatusRegister
  /** Where it is written. */
  readonly source: string
}

export interface DeviceRanges {
  /** Points per device; the numbers go from 0 to points - 1. A device that is not here is not checked. */
  readonly points: Readonly<Partial<Record<DeviceName, number>>>
  /** Points that a simulated PLC has beside them, where they are not known: it needs some memory. Never checked. */
  readonly simulated?: Readonly<Partial<Record<DeviceName, number>>>
  readonly source: string
}

/** A memory with files. */
export interface Drive {
  /** As file commands name it. */
  readonly number: number
  /** The manual's name. */
  readonly title: string
  /** It stands for another drive. */
  readonly same?: number
}

/** End codes of file commands. */
export interface FileRefusals {
  readonly drive: number
  readonly notFound: number
  readonly directory: number
  readonly name: number
  readonly exists: number
  readonly space: number
  readonly password: number
  readonly readOnly: number
  /** Locked by Open File. */
  readonly locked: number
  /** A kind of file that users cannot handle so. */
  readonly kind: number
  /** Beyond the end of the file. */
  readonly range: number
  readonly writeProtected: number
  /** No file is open under this file pointer number. */
  readonly pointer: number
  /** Not as things are: too many files open, or open for reading only. */
  readonly now: number
  readonly running: number
  /** The memory itself fails. */
  readonly failed: number
  readonly source: string
}

/** Files and how they are asked for. Without subcommands and drives on a family that has no file commands. */
export interface FileInfo {
  /** Subcommands of the file commands, the usual one first: 0000, 0004, or 0040 with long names and directories. */
  readonly subcommands: readonly number[]
  /** Drives with files. */
  readonly drives: readonly Drive[]
  /** Module I/O numbers that file commands may name; none: whatever the others may. */
  readonly moduleIo: readonly number[]
  /** Further ones, of which the manual says both: the PLC decides. */
  readonly doubtfulModuleIo: readonly number[]
  /** Parameter files, and programs that run, are changed in STOP only. */
  readonly stopToChange: boolean
  /** Where it is written. */
  readonly source: string
}

export interface FileFacts extends FileInfo {
  readonly refusals: FileRefusals
}

export interface Subcommand {
  readonly value: number
  readonly source: string
}

/** What a family of PLCs is like, for people and programs. Plain data; of each figure `source` says where it is from. */
export interface ProfileInfo {
  /** The name options take, e.g. `iq-f`. */
  readonly id: ProfileId
  /** The name of the family, e.g. `MELSEC iQ-F`. */
  readonly title: string
  /** CPUs and modules it stands for. */
  readonly series: string
  /** Profile of the same CPUs when nothing is known about the port: what a model code suggests. */
  readonly cpu: ProfileId
  /** How X and Y are numbered in the engineering tool: `X17` is octal on iQ-F, hexadecimal elsewhere. */
  readonly xyRadix: 8 | 16
  /** `false`: nobody knows, and numbers that would mean two devices are refused until the user says it. */
  readonly xyRadixKnown: boolean
  /** How W is numbered: hexadecimal on every PLC; SLMP inverters are said to number it in decimal. */
  readonly wRadix: 10 | 16
  /** Digits of X and Y in ASCII code: as the port is set ("ASCII (X,Y OCT)", "(X,Y HEX)"), or always the same. */
  readonly asciiXy: 'setting' | 'hexadecimal' | 'octal'
  /** Frames it takes, the usual one first. */
  readonly frames: readonly FrameName[]
  /** Default frame. */
  readonly frame: FrameName
  /** Data codes it takes. */
  readonly codes: readonly DataCode[]
  /** Default data code. */
  readonly code: DataCode
  /** Transports its port has. */
  readonly transports: readonly TransportName[]
  /** Device names this family does not have. */
  readonly absentDevices: readonly DeviceName[]
  /** Commands it does not have: refused before anything is sent. */
  readonly lacks: readonly Lack[]
  /** Not on every CPU or module of the family: sent when asked for, never chosen by the planner. */
  readonly doubtful: readonly Lack[]
  /** Requests it can take before it has answered. */
  readonly inFlight: InFlight
  /** Connections its port has at the same time. */
  readonly connections: Connections
  /** Where requests can go from the port. */
  readonly reach: Reach
  /** Index registers that can modify an address. */
  readonly lastIndex: LastIndex
  /** What it takes as monitoring timer. */
  readonly monitoringTimer: MonitoringTimer
  /** Remote control. */
  readonly remote: RemoteFacts
  /** Files and drives. */
  readonly files: FileInfo
  /** The port is a serial line. */
  readonly serial?: SerialFacts
  /** What people should know about ports, settings and oddities. */
  readonly notes: readonly string[]
}

/** Everything the rest of the package knows about a family of PLCs. Plain data. */
export interface Profile extends ProfileInfo {
  readonly forms: readonly DeviceForm[]
  /** Default form; a device without a short code takes the first form of `forms` that has it. */
  readonly form: 'short' | 'long'
  /** Devices with a one-byte code on this family only. */
  readonly shortDevices: readonly DeviceName[]
  /** Extensions of an address this family takes: `J1\\W10`, `U3\\G100`, `U3E0\\HG0`. */
  readonly extensions: readonly ExtensionKind[]
  readonly exclusions: readonly DeviceExclusion[]
  /** What the port of this family does not take in 1E frames, beside what no 1E frame says. */
  readonly exclusions1e?: readonly DeviceExclusion[]
  /** What 1E reaches and how it looks. Absent: the port takes no 1E frame. */
  readonly aCompatible?: ACompatibleFamily
  readonly limits: readonly LimitRule[]
  readonly ranges: DeviceRanges
  readonly refusals: Refusals
  readonly password: PasswordFacts
  readonly model: UsualModel
  /** Subcommands other than the computed ones. */
  readonly subcommands: Readonly<Partial<Record<CommandName, Subcommand>>>
  readonly files: FileFacts
  /** Where the single figures above come from. */
  readonly sources: Readonly<
    Record<'xyRadix' | 'wRadix' | 'asciiXy' | 'frames' | 'forms' | 'extensions' | 'absentDevices', string>
  >
}

/**
 * Own maxima. A number is for a command with a single limit; block commands and Write Random (word units) name the unit.
 * It holds in every form and code.
 */
export type LimitOverrides = Readonly<
  Partial<Record<CommandName, number | Readonly<Partial<Record<LimitUnit, number>>>>>
>

/** What a user may set differently. Each field is merged into the profile's, entry by entry. */
export interface ProfileOverrides {
  /** How X and Y are numbered. */
  readonly xyRadix?: 8 | 16
  /** How W is numbered. */
  readonly wRadix?: 10 | 16
  /** Default frame. */
  readonly frame?: FrameName
  /** Points or blocks that one request may carry, by command. */
  readonly limits?: LimitOverrides
  /** `true` or a reason: the PLC lacks the command; `false`: it has it (also takes it off the doubtful ones). */
  readonly lacks?: Readonly<Partial<Record<CommandName, boolean | string>>>
  /** Points of a device: numbers go from 0 to points - 1. */
  readonly ranges?: Readonly<Partial<Record<DeviceName, number>>>
  /** Subcommand of a command, when it is not the computed one. */
  readonly subcommands?: Readonly<Partial<Record<CommandName, number>>>
  /** Requests it can take before it has answered. */
  readonly inFlight?: { readonly tcp?: number; readonly udpBuffer?: number }
  /** ZR counts twice in Read Random and Entry Monitor Device: the High Performance model QCPU does so. */
  readonly zrCountsDouble?: boolean
}

/**
 * Digits of X and Y in ASCII code: what is given, where the port has the setting; else always the family's. A setting that
 * the PLC does not have would address other inputs and outputs without any error.
 *
 * @throws RequestError BAD_OPTION when the family has no such setting.
 */
export function asciiXyOf<T extends 'octal' | 'hexadecimal' | undefined>(
  { title, asciiXy }: Profile,
  given: T,
): T | 'hexadecimal' | 'octal' {
  if (asciiXy === 'setting') return given
  if (given === undefined) return asciiXy
  throw new RequestError(
    'BAD_OPTION',
    `${title} has no setting for the digits of X and Y in ASCII code: they are always ${asciiXy}. Leave asciiXy out.`,
    'asciiXy',
  )
}

/** How addresses are written: as given, else as the profile has it. */
export function addressOptionsOf(
  profile: Profile,
  { xyRadix = profile.xyRadix, wRadix = profile.wRadix }: Notation = {},
): AddressOptions {
  return { xyRadix, wRadix }
}

/** Why this family has not got the command, and what to do instead; undefined when it has it. */
export function lackOf(profile: Profile, command: string): Lack | undefined {
  return profile.lacks.find((lack) => lack.command === command)
}

/** Why the planner should not choose the command by itself; undefined when it may. */
export function doubtOf(profile: Profile, command: CommandName): Lack | undefined {
  return profile.doubtful.find((lack) => lack.command === command)
}

/** Why the command does not take the device on this family; undefined when nothing is known against it. */
export function exclusionOf(profile: Profile, command: string, device: DeviceName): DeviceExclusion | undefined {
  return profile.exclusions.find((one) => one.doubtful !== true && isAbout(one, command, device))
}

/** Why the planner should not choose the command for the device by itself; undefined when it may. */
export function doubtfulUse(profile: Profile, command: string, device: DeviceName): DeviceExclusion | undefined {
  return profile.exclusions.find((one) => one.doubtful === true && isAbout(one, command, device))
}

function isAbout({ commands, devices }: DeviceExclusion, command: string, device: DeviceName): boolean {
  return commands.some((name) => name === command) && devices.includes(device)
}

/**
 * How many requests may be in flight (SLMP reference manual 3.3). Pipelining needs the serial number of the 4E frame and
 * datagrams: over TCP an FX5U answers only the last of two requests that arrive together. Of the RJ71GN11-T2, which alone
 * takes the station extension frame, the manual does not say what it can hold: one.
 *
 * @throws RequestError BAD_OPTION when `connections` is not a whole number of at least 1.
 * @example inFlightBound(resolveProfile('iq-r'), 'udp', '4E') // 33
 */
export function inFlightBound(profile: Profile, transport: TransportName, frame: FrameName, connections = 1): number {
  if (!Number.isInteger(connections) || connections < 1) {
    throw new RequestError(
      'BAD_OPTION',
      `connections must be a whole number of at least 1, not ${connections}.`,
      'connections',
    )
  }
  if (frame !== '4E') return 1
  if (transport !== 'udp') return profile.inFlight.tcp
  return 1 + Math.floor(profile.inFlight.udpBuffer / connections)
}
