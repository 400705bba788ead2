// What a simulated PLC is made of: options, their defaults and their checks.
import { badOption, oneOf, wholeNumber } from '../basics/option-checks'
import type { DataCode } from '../codec/codec'
import type { OddBits } from '../melsec/a-compatible/rules'
import { type DeviceName, findDevice } from '../melsec/device/device'
import { type EthernetFrameName, frameFacts, isEthernetFrame } from '../melsec/frame/frames'
import { modelOf } from '../melsec/model-code'
import {
  asciiXyOf,
  type Profile,
  type ProfileId,
  type ProfileInfo,
  type ProfileOverrides,
} from '../melsec/profiles/profile'
import { resolveProfile } from '../melsec/profiles/profiles'
import { passwordProblem } from '../melsec/remote-password'
import { type Clock, realClock } from '../transport/clock'
import { drivesOf, type MountedDrive } from './drives'
import { fileClock } from './file-clock'
import type { FilesParts } from './files'
import type { HandlerCall } from './handler'
import { LabelTable, type SimulatedLabels } from './labels'
import type { PortOptions } from './listening'
import type { ExtensionMemory } from './memory'
import type { SimulatedDrives } from './simulated-drive'

/** What a simulated PLC is like. All of it can be left out. */
export interface PlcSimulatorOptions {
  /** Default `iq-r`. */
  readonly profile?: ProfileId | ProfileInfo
  /** What differs from the profile. */
  readonly profileOverrides?: ProfileOverrides
  /** Communication data code of the port. The other one is answered by silence. Default `binary`. */
  readonly code?: DataCode
  /** Frames the port takes, told apart by their subheaders. Default: all of the profile that the code has. */
  readonly frames?: readonly EthernetFrameName[]
  /** ASCII code: the port's setting, where the family has one. Default `octal` on iQ-F. */
  readonly asciiXy?: 'octal' | 'hexadecimal'
  /** ASCII code: digits of ZR. Default `decimal`. */
  readonly asciiZr?: 'decimal' | 'hexadecimal'
  /** 1E in ASCII code: whether a dummy character follows an odd number of bits. Default FX3 `padded`, iQ-F `exact`: the manual has none. */
  readonly oddBits?: OddBits
  /** Address to listen on. Default 127.0.0.1, so that nothing is offered to a network unasked. */
  readonly host?: string
  /** `false`: no TCP. Default: any free port. */
  readonly tcp?: PortOptions | false
  /** `false`: no UDP. Default: any free port. */
  readonly udp?: PortOptions | false
  /** What Read Type Name answers. Default: a usual CPU of the family. `name` has at most 16 ASCII characters. */
  readonly model?: { readonly name: string; readonly code: number }
  /**
   * Connections (TCP, or streams in memory) at the same time; a further one is accepted and ended at once, as a PLC
   * does whose entries are all taken. Default: the profile's.
   */
  readonly maxConnections?: number
  /** ms for which an entry stays taken after its connection has ended. Default 0. */
  readonly entryRelease?: number
  /** Requests for other stations: an end code, or nothing. Default `refuse`. */
  readonly otherStations?: 'refuse' | 'silence'
  /** CPU parameter "Remote Reset". Default false, as in a new project of GX Works. */
  readonly resetAllowed?: boolean
  /** ms during which a PLC that starts again answers nobody. Default 1000. */
  readonly restartTime?: number
  /** ms from a request to its answer while the CPU is in RUN (END processing). Default 0: at once. */
  readonly scanTime?: number
  /** Who counts as the same external device in remote control: all clients of one computer, or one connection. Default `host`. */
  readonly remoteOwner?: 'host' | 'connection'
  /** Devices that keep their values when the PLC starts again. Default L, R and ZR. */
  readonly latch?: readonly DeviceName[]
  /** Buffer memory and link direct devices. Default: none. */
  readonly extensions?: ExtensionMemory
  /** Words of the port's own buffer memory, for Memory (0613, 1613). Default 0: it has none. */
  readonly bufferMemory?: number
  /** Global labels that are open to external devices. Default: none. */
  readonly labels?: SimulatedLabels
  /** Drives with files, by their numbers. Default: those of the family, with a few files to look at. */
  readonly drives?: SimulatedDrives
  /** Files that clients may have open at the same time. Default 16. */
  readonly maxOpenFiles?: number
  /**
   * A connection that ends with files open: `kept` (default, as the manual says) leaves them locked until the same
   * external device closes them or the PLC starts again, `released` closes them.
   */
  readonly fileLocks?: 'kept' | 'released'
  /**
   * Remote password: every connection is locked until it is unlocked, after its end, and over UDP after 10 minutes
   * without traffic. Default: none.
   */
  readonly password?: string
  /** Wrong passwords in a row after which the port locks out. Default 10. */
  readonly passwordAttempts?: number
  /** ms for which the port takes no password then. Default 60000. */
  readonly lockOutTime?: number
  /** Time, for tests. @internal */
  readonly clock?: Clock
}

/** The options with every default filled in. */
export interface SimulatorSettings {
  readonly profile: Profile
  readonly code: DataCode
  readonly frames: readonly EthernetFrameName[]
  readonly asciiXy: 'octal' | 'hexadecimal'
  readonly asciiZr: 'decimal' | 'hexadecimal'
  readonly oddBits: OddBits
  readonly host: string
  readonly tcp: PortOptions | false
  readonly udp: PortOptions | false
  readonly model: HandlerCall['model']
  readonly maxConnections: number
  readonly entryRelease: number
  readonly otherStations: 'refuse' | 'silence'
  readonly resetAllowed: boolean
  readonly restartTime: number
  readonly scanTime: number
  readonly remoteOwner: 'host' | 'connection'
  readonly latch: readonly DeviceName[]
  readonly extensions: ExtensionMemory
  readonly bufferMemory: number
  readonly labels: LabelTable
  readonly drives: ReadonlyMap<number, MountedDrive>
  readonly maxOpenFiles: number
  readonly fileLocks: FilesParts['fileLocks']
  readonly password: string | undefined
  readonly passwordAttempts: number
  readonly lockOutTime: number
  readonly clock: Clock
}

const MODEL_LENGTH = 16

/** @throws RequestError BAD_OPTION */
export function settingsOf(options: PlcSimulatorOptions): SimulatorSettings {
  const profile = resolveProfile(options.profile ?? 'iq-r', options.profileOverrides)
  const code = oneOf('code', options.code ?? 'binary', profile.codes)
  const settings: SimulatorSettings = {
    profile,
    code,
    frames: framesOf(profile, code, options.frames),
    asciiXy: digitsOf(profile, options.asciiXy),
    asciiZr: oneOf('asciiZr', options.asciiZr ?? 'decimal', ['decimal', 'hexadecimal']),
    oddBits: oneOf('oddBits', options.oddBits ?? profile.aCompatible?.oddBits ?? 'exact', ['exact', 'padded']),
    host: options.host ?? '127.0.0.1',
    tcp: options.tcp ?? {},
    udp: options.udp ?? {},
    model: modelFor(profile, options.model),
    maxConnections: wholeNumber('maxConnections', options.maxConnections ?? profile.connections.most, 1),
    entryRelease: milliseconds('entryRelease', options.entryRelease ?? 0),
    otherStations: oneOf('otherStations', options.otherStations ?? 'refuse', ['refuse', 'silence']),
    resetAllowed: options.resetAllowed ?? false,
    restartTime: milliseconds('restartTime', options.restartTime ?? 1000),
    scanTime: milliseconds('scanTime', options.scanTime ?? 0),
    remoteOwner: oneOf('remoteOwner', options.remoteOwner ?? 'host', ['host', 'connection']),
    latch: latchOf(options.latch ?? ['L', 'R', 'ZR']),
    extensions: options.extensions ?? {},
    bufferMemory: wholeNumber('bufferMemory', options.bufferMemory ?? 0, 0, 0x1000000),
    labels: new LabelTable(options.labels ?? {}),
    drives: drivesOf(profile, options.drives ?? {}, fileClock((options.clock ?? realClock).time())),
    maxOpenFiles: wholeNumber('maxOpenFiles', options.maxOpenFiles ?? 16, 1, 0x10000),
    fileLocks: oneOf('fileLocks', options.fileLocks ?? 'kept', ['kept', 'released']),
    password: passwordOf(profile, options.password),
    passwordAttempts: wholeNumber('passwordAttempts', options.passwordAttempts ?? 10, 1),
    lockOutTime: milliseconds('lockOutTime', options.lockOutTime ?? 60_000),
    clock: options.clock ?? realClock,
  }
  for (const name of Object.keys(options)) {
    if (name in settings || name === 'profileOverrides') continue
    badOption(name, `A simulator has no option ${name}: it has ${Object.keys(settings).join(', ')}, profileOverrides.`)
  }
  return settings
}

function digitsOf(profile: Profile, given: PlcSimulatorOptions['asciiXy']): SimulatorSettings['asciiXy'] {
  const asciiXy = given === undefined ? undefined : oneOf('asciiXy', given, ['octal', 'hexadecimal'])
  return asciiXyOf(profile, asciiXy) ?? (profile.xyRadix === 8 ? 'octal' : 'hexadecimal')
}

function framesOf(
  profile: Profile,
  code: DataCode,
  frames?: readonly EthernetFrameName[],
): readonly EthernetFrameName[] {
  const possible = profile.frames.filter(isEthernetFrame).filter((frame) => frameFacts[frame].codes.includes(code))
  if (frames?.length === 0) badOption('frames', 'A port takes at least one frame.')
  return frames === undefined ? possible : frames.map((frame) => oneOf('frames', frame, possible))
}

function modelFor({ model }: Profile, given: PlcSimulatorOptions['model']): HandlerCall['model'] {
  const code = given?.code ?? model.code
  const name = given?.name ?? modelOf(code)?.models[0] ?? model.name ?? ''
  if (!/^[\x20-\x7e]+$/.test(name) || name.length > MODEL_LENGTH) {
    badOption('model.name', `A model name has 1 to ${MODEL_LENGTH} ASCII characters, unlike ${JSON.stringify(name)}.`)
  }
  return { model: name.padEnd(MODEL_LENGTH), modelCode: wholeNumber('model.code', code, 0, 0xffff) }
}

function latchOf(names: readonly DeviceName[]): readonly DeviceName[] {
  for (const name of names)
    if (findDevice(name) === undefined) badOption('latch', `There is no device ${String(name)}.`)
  return names
}

function passwordOf(profile: Profile, password: string | undefined): string | undefined {
  const problem = password === undefined ? undefined : passwordProblem(profile, password)
  return problem === undefined ? password : badOption('password', `password: ${problem}.`)
}

function milliseconds(field: string, value: number): number {
  if (Number.isFinite(value) && value >= 0) return value
  return badOption(field, `${field} is a number of milliseconds from 0, not ${String(value)}.`)
}
