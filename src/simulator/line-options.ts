// What a simulated serial line is made of: options, their defaults and their checks.
import {
  badOption,
  checkBooleans,
  checkNames,
  isPlainObject,
  type OptionNames,
  oneOf,
  wholeNumber,
} from '../basics/option-checks'
import {
  factsOfSerial,
  type SerialFormat,
  type SerialFrameName,
  serialFormatCodes,
} from '../melsec/frame/serial-frames'
import { type SerialFrameOptions, type SerialFraming, serialFraming } from '../melsec/frame/serial-framing'
import type { Profile, ProfileId, ProfileInfo } from '../melsec/profiles/profile'
import { resolveProfile } from '../melsec/profiles/profiles'
import { type Clock, realClock } from '../transport/clock'
import { lineTime, type SerialOptions, type SerialSettings, serialSettings } from '../transport/serial'
import type { PortOptions } from './listening'
import { type PlcSimulatorOptions, type SimulatorSettings, settingsOf } from './options'

/** What a station of a simulated line is like. All of it can be left out. */
export interface LineStationOptions
  extends Pick<
    PlcSimulatorOptions,
    | 'profile'
    | 'profileOverrides'
    | 'model'
    | 'otherStations'
    | 'resetAllowed'
    | 'restartTime'
    | 'scanTime'
    | 'latch'
    | 'extensions'
  > {
  /** Serial channel of the CPU that the line is at: 1 to 4. Default 1. */
  readonly channel?: 1 | 2 | 3 | 4
}

/** What the manual leaves open (FX5 communication manual 42). */
export type LineFrameDetails = Partial<
  Pick<SerialFrameOptions, 'etxInSum' | 'sumOfAck' | 'errorDigits' | 'errorInformation'>
>

/** How fast characters go. */
export type LineSpeed = Omit<SerialOptions, 'path' | 'rts'>

/** What a simulated serial line is like. All of it can be left out. */
export interface LineSimulatorOptions {
  /** The stations by their numbers. Default: station 0. */
  readonly stations?: Readonly<Record<number, LineStationOptions>>
  /** Family of the stations that do not say it. Default `fx5-serial`. */
  readonly profile?: ProfileId | ProfileInfo
  /** Message format of the ports, alike on the whole line: 1 (default), 4, or 5 (4C only, binary code). */
  readonly messageFormat?: SerialFormat
  /** Sum check code. Default true. */
  readonly sumCheck?: boolean
  /** What the manual leaves open, as the client has it. */
  readonly serialFrame?: LineFrameDetails
  /** Frames the ports take, told apart by their frame IDs. Default: all that the format has; each station those of its family. */
  readonly frames?: readonly SerialFrameName[]
  /** Formats 1 and 4: "(X,Y OCT)" or "(X,Y HEX)", where the family has the setting. Default `octal`. */
  readonly asciiXy?: 'octal' | 'hexadecimal'
  /** A serial port of this computer at which the line is. Default: none. */
  readonly serial?: SerialOptions
  /** The line behind a device server: all connections hear what the stations say. Default: any free port, with `serial` none. */
  readonly tcp?: PortOptions | false
  /** Address to listen on. Default 127.0.0.1, so that nothing is offered to the network unasked. */
  readonly host?: string
  /** Characters take the time of the line: of `serial`, or as given. Default false: none. */
  readonly pace?: boolean | LineSpeed
  /** Whoever sends hears its own characters, as on one pair of RS-485. Default false. */
  readonly echo?: boolean
  /** 3C and 4C: ms before an answer, 0 to 150 in steps of 10. In 1C each request says it. Default 0. */
  readonly messageWait?: number
  /** ms without a character after which a message that has begun is broken off. Default 100: computers pause longer than PLCs. */
  readonly timeout?: number
  /** Time, for tests. @internal */
  readonly clock?: Clock
}

/** The options with every default filled in. */
export interface LineSettings {
  readonly format: SerialFormat
  readonly sumCheck: boolean
  readonly sumOfAck: boolean
  readonly errorDigits: 2 | 4 | undefined
  readonly framings: ReadonlyMap<SerialFrameName, SerialFraming>
  readonly stations: ReadonlyMap<number, StationSettings>
  readonly serial: SerialOptions | undefined
  readonly tcp: PortOptions | false
  readonly host: string
  /** ms that a character takes; 0: none. */
  readonly character: number
  readonly echo: boolean
  readonly messageWait: number
  readonly timeout: number
  readonly clock: Clock
}

export interface StationSettings {
  readonly settings: SimulatorSettings
  readonly channel: 1 | 2 | 3 | 4
}

const names: OptionNames<LineSimulatorOptions> = {
  stations: true,
  profile: true,
  messageFormat: true,
  sumCheck: true,
  serialFrame: true,
  frames: true,
  asciiXy: true,
  serial: true,
  tcp: true,
  host: true,
  pace: true,
  echo: true,
  messageWait: true,
  timeout: true,
  clock: true,
}

const stationNames: OptionNames<LineStationOptions> = {
  profile: true,
  profileOverrides: true,
  model: true,
  otherStations: true,
  resetAllowed: true,
  restartTime: true,
  scanTime: true,
  latch: true,
  extensions: true,
  channel: true,
}

const detailNames: OptionNames<LineFrameDetails> = {
  etxInSum: true,
  sumOfAck: true,
  errorDigits: true,
  errorInformation: true,
}

const CHANNELS = [1, 2, 3, 4] as const
const FORMATS = [1, 4, 5] as const
const LONGEST_WAIT = 150
const WAIT_STEP = 10

/** @throws RequestError BAD_OPTION */
export function lineSettingsOf(options: LineSimulatorOptions): LineSettings {
  checkNames('', options, names)
  checkBooleans(options, ['sumCheck', 'echo'])
  const { sumCheck = true, serialFrame = {}, echo = false, host = '127.0.0.1', serial, clock = realClock } = options
  checkNames('serialFrame.', serialFrame, detailNames)
  oneOf('serialFrame.errorDigits', serialFrame.errorDigits, [undefined, 2, 4])
  const format = oneOf('messageFormat', options.messageFormat ?? 1, FORMATS)
  const tcp = options.tcp ?? (serial === undefined ? {} : false)
  if (serial !== undefined) checkSpeed('serial', format, serialSettings(serial))
  return {
    format,
    sumCheck,
    sumOfAck: serialFrame.sumOfAck ?? false,
    errorDigits: serialFrame.errorDigits,
    framings: framingsOf(options, format),
    stations: stationsOf(options, format),
    serial,
    tcp,
    host,
    character: characterOf(options, format),
    echo,
    messageWait: waitOf(options.messageWait ?? 0),
    timeout: wholeNumber('timeout', options.timeout ?? 100, 1, 32_767),
    clock,
  }
}

function framingsOf(
  { frames, sumCheck = true, serialFrame = {} }: LineSimulatorOptions,
  format: SerialFormat,
): ReadonlyMap<SerialFrameName, SerialFraming> {
  const possible = framesOfFormat(format)
  if (frames?.length === 0) badOption('frames', 'A line takes at least one frame.')
  const chosen = frames === undefined ? possible : frames.map((frame) => oneOf('frames', frame, possible))
  return new Map(chosen.map((frame) => [frame, serialFraming({ ...serialFrame, sumCheck, frame, format })]))
}

function framesOfFormat(format: SerialFormat): readonly SerialFrameName[] {
  return (['1C', '3C', '4C'] as const).filter((frame) => factsOfSerial(frame).formats.includes(format))
}

function stationsOf(options: LineSimulatorOptions, format: SerialFormat): ReadonlyMap<number, StationSettings> {
  const given = options.stations ?? { 0: {} }
  if (!isPlainObject(given)) badOption('stations', 'stations is an object with a station for each number.')
  const stations = Object.entries(given).map(([key, station]): [number, StationSettings] => {
    const number = /^\d+$/.test(key) ? Number(key) : Number.NaN
    return [number, stationOf(options, format, number, station, key)]
  })
  if (stations.length === 0) badOption('stations', 'A line has at least one station.')
  return new Map(stations)
}

function stationOf(
  { profile = 'fx5-serial', asciiXy, clock }: LineSimulatorOptions,
  format: SerialFormat,
  number: number,
  station: LineStationOptions,
  key: string,
): StationSettings {
  checkNames(`stations.${key}.`, station, stationNames)
  const { channel = 1, ...own } = station
  const settings = settingsOf({
    profile,
    ...own,
    code: serialFormatCodes[format],
    ...(asciiXy === undefined || !hasSetting(own.profile ?? profile) ? {} : { asciiXy }),
    ...(clock === undefined ? {} : { clock }),
    tcp: false,
    udp: false,
  })
  const field = `stations.${key}`
  wholeNumber(field, number, 0, lastStation(settings.profile, field))
  return { settings, channel: oneOf(`${field}.channel`, channel, CHANNELS) }
}

/** "(X,Y OCT)" and the like are formats of FX5 only. */
function hasSetting(profile: ProfileId | ProfileInfo): boolean {
  return resolveProfile(profile).asciiXy === 'setting'
}

function lastStation({ title, serial }: Profile, field: string): number {
  return serial?.lastStation ?? badOption(`${field}.profile`, `${title} has no serial line.`)
}

/** @throws RequestError BAD_OPTION for a wait that the parameter of a port cannot say */
function waitOf(wait: number): number {
  if (wait % WAIT_STEP === 0) return wholeNumber('messageWait', wait, 0, LONGEST_WAIT)
  return badOption('messageWait', `messageWait is ${wait}; it must be a multiple of ${WAIT_STEP}.`)
}

function characterOf({ pace = false, serial }: LineSimulatorOptions, format: SerialFormat): number {
  if (pace === false) return 0
  const given = pace === true ? (serial ?? {}) : pace
  const usual = format === 5 ? { dataLength: 8 as const } : {}
  const settings = serialSettings({ ...usual, ...given, path: 'pace' })
  checkSpeed('pace', format, settings)
  return lineTime(1, settings)
}

function checkSpeed(field: string, format: SerialFormat, { dataLength }: SerialSettings): void {
  if (format !== 5 || dataLength === 8) return
  badOption(`${field}.dataLength`, 'Format 5 needs 8 data bits: bytes of any value are sent.')
}
