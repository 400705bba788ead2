// What a simulated Sharp JW is made of: options, their defaults and their checks.
import {
  badOption,
  checkBooleans,
  checkNames,
  isPlainObject,
  type OptionNames,
  oneOf,
  wholeNumber,
} from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { LAST_FILE, PAGE } from '../../jw/address'
import { type JwModel, jwModels } from '../../jw/commands/command'
import { headerBytes, type JwHeader } from '../../jw/header'
import type { JwArea } from '../../jw/operand/area'
import { startSwitch } from '../../jw/parameters/parameter-area'
import { type Clock, realClock } from '../../transport/clock'
import type { PortOptions } from '../listening'
import type { SimulatedBuffer, SimulatedRingBuffer } from './buffers'
import type { JwWriteMode } from './cpu'
import type { SimulatedTimers } from './timers'
import type { SimulatedOptionUnit } from './units'

/** What a simulated Sharp JW is like. All of it can be left out. */
export interface JwSimulatorOptions {
  /** Family of the CPU: what it lacks is refused. Default `jw300`. */
  readonly model?: JwModel
  /**
   * What stands in front of messages. `any` (default): nothing, 40 bytes 00H or a relay, told apart by their bytes. One
   * header: that one alone, and what comes with another is answered by silence. Answers get what the request has.
   */
  readonly header?: JwHeader | 'any'
  /** Where FFH stands in lists of relays and registers: once before the first (default) or before each. */
  readonly marker?: 'once' | 'each'
  /** Address to listen on. Default 127.0.0.1, so that nothing is offered to a network unasked. */
  readonly host?: string
  /** `false`: no TCP. Default: any free port. */
  readonly tcp?: PortOptions | false
  /** `false`: no UDP. Default: any free port. */
  readonly udp?: PortOptions | false
  /**
   * Connections (TCP, or streams in memory) at the same time; a further one is accepted and ended at once. No manual
   * prints how many there may be. Default 8.
   */
  readonly maxConnections?: number
  /** ms for which an entry stays taken after its connection has ended. Default 0. */
  readonly entryRelease?: number
  /** ms during which a PLC that starts again answers nobody. Default 1000. */
  readonly restartTime?: number
  /** ms from a request to its answer while the PLC runs. Default 0: at once. */
  readonly scanTime?: number
  /**
   * Bytes of the files, by their numbers: `{ 0: 65536, 1: 65536 }`. Files of a JW300 from 1 on are the pages of its file
   * registers. Default: 65536 each, of a JW300 the files 00 to 80H, else 00 to 07H and 10H to 2CH.
   */
  readonly files?: Readonly<Record<number, number>>
  /** Where operands lie that no source places, for `read` and `write` of the program. Default: none. */
  readonly areas?: readonly JwArea[]
  /** Timers, counters and MD. Default: none. */
  readonly timers?: SimulatedTimers
  /** What may be written at power on: 0 nothing, 1 data memory, 2 all memory. No manual prints it. Default 0. */
  readonly writeMode?: JwWriteMode
  /** Size of the program memory in K words: 32, 64, 128 or 256. Default 64. */
  readonly memorySize?: 32 | 64 | 128 | 256
  /** `false`: a model without a clock. Default true. */
  readonly hasClock?: boolean
  /** Password of the secret function, four letters or digits; with it the function is enabled. Default: none is registered. */
  readonly password?: string
  /** Specified buffers (DB) by number, 0 to 31. Default: none. */
  readonly specifiedBuffers?: Readonly<Record<number, SimulatedBuffer>>
  /** Ring buffers (RB) by number, 0 to 15. Default: none. */
  readonly ringBuffers?: Readonly<Record<number, SimulatedRingBuffer>>
  /** Option units whose parameters are checked. Parameters of any others are kept as they are written. */
  readonly optionUnits?: readonly SimulatedOptionUnit[]
  /** Result code of a write to parameters while the start switch is 1: 7 (default) or 16 are likely, the manual prints none. */
  readonly startSwitchRefusal?: number
  /** Time, for tests. @internal */
  readonly clock?: Clock
}

/** The options with every default filled in. */
export interface JwSettings extends Required<Omit<JwSimulatorOptions, 'files' | 'password'>> {
  readonly files: ReadonlyMap<number, number>
  readonly password: string | undefined
}

const names: OptionNames<JwSimulatorOptions> = {
  model: true,
  header: true,
  marker: true,
  host: true,
  tcp: true,
  udp: true,
  maxConnections: true,
  entryRelease: true,
  restartTime: true,
  scanTime: true,
  files: true,
  areas: true,
  timers: true,
  writeMode: true,
  memorySize: true,
  hasClock: true,
  password: true,
  specifiedBuffers: true,
  ringBuffers: true,
  optionUnits: true,
  startSwitchRefusal: true,
  clock: true,
}

/** Numbers of buffers. */
const LAST = { specified: 0x1f, ring: 0x0f } as const

/** @throws RequestError BAD_OPTION */
export function jwSettingsOf(options: JwSimulatorOptions): JwSettings {
  checkNames('', options, names)
  checkBooleans(options, ['hasClock'])
  const model = oneOf('model', options.model ?? 'jw300', jwModels)
  return {
    model,
    header: headerOf(options.header ?? 'any'),
    marker: oneOf('marker', options.marker ?? 'once', ['once', 'each']),
    host: options.host ?? '127.0.0.1',
    tcp: options.tcp ?? {},
    udp: options.udp ?? {},
    maxConnections: wholeNumber('maxConnections', options.maxConnections ?? 8, 1),
    entryRelease: milliseconds('entryRelease', options.entryRelease ?? 0),
    restartTime: milliseconds('restartTime', options.restartTime ?? 1000),
    scanTime: milliseconds('scanTime', options.scanTime ?? 0),
    files: filesOf(model, options.files),
    areas: options.areas ?? [],
    timers: options.timers ?? {},
    writeMode: oneOf('writeMode', options.writeMode ?? 0, [0, 1, 2]),
    memorySize: oneOf('memorySize', options.memorySize ?? 64, [32, 64, 128, 256]),
    hasClock: options.hasClock ?? true,
    password: passwordOf(options.password),
    specifiedBuffers: buffersOf('specifiedBuffers', options.specifiedBuffers, LAST.specified),
    ringBuffers: buffersOf('ringBuffers', options.ringBuffers, LAST.ring),
    optionUnits: options.optionUnits ?? [],
    startSwitchRefusal: wholeNumber(
      'startSwitchRefusal',
      options.startSwitchRefusal ?? startSwitch.likelyRefusals[0],
      1,
      0xff,
    ),
    clock: options.clock ?? realClock,
  }
}

function headerOf(header: JwHeader | 'any'): JwHeader | 'any' {
  if (header !== 'any') headerBytes(header)
  return header
}

function filesOf(model: JwModel, given: JwSimulatorOptions['files']): ReadonlyMap<number, number> {
  if (given === undefined) return new Map(usualFiles(model).map((file) => [file, PAGE]))
  return new Map(
    numbered('files', given, LAST_FILE).map(([file, size, field]) => [file, wholeNumber(field, size, 1, PAGE)]),
  )
}

/** Of JW20H and JW30H: data segments of 24H (JW-20FL5 manual, 9-29). */
function usualFiles(model: JwModel): number[] {
  const all = Array.from({ length: LAST_FILE + 1 }, (_, file) => file)
  return model === 'jw300' ? all : all.filter((file) => file <= 0x07 || (file >= 0x10 && file <= 0x2c))
}

function buffersOf<B extends SimulatedRingBuffer>(
  name: string,
  given: Readonly<Record<number, B>> = {},
  last: number,
): Readonly<Record<number, B>> {
  for (const [, buffer, field] of numbered(name, given, last)) {
    const { file, address, length, definition = 'indirect', ...rest } = buffer
    checkNames(`${field}.`, rest, name === 'ringBuffers' ? { direction: true } : {})
    wholeNumber(`${field}.file`, file, 0, LAST_FILE)
    wholeNumber(`${field}.address`, address, 0, PAGE - 1)
    wholeNumber(`${field}.length`, length, 1, PAGE - 1)
    oneOf(`${field}.definition`, definition, ['direct', 'indirect'])
    oneOf(`${field}.direction`, buffer.direction ?? 'read', ['read', 'write'])
  }
  return given
}

/** The entries of an object by number, with what messages call them. */
export function numbered<T>(
  name: string,
  given: Readonly<Record<number, T>>,
  last: number,
): readonly (readonly [number: number, value: T, field: string])[] {
  if (!isPlainObject(given)) badOption(name, `${name} is an object by number, not ${shown(given)}.`)
  return Object.entries<T>(given).map(([key, value]) => {
    const field = `${name}.${key}`
    return [wholeNumber(field, /^\d+$/.test(key) ? Number(key) : Number.NaN, 0, last), value, field]
  })
}

function passwordOf(password: string | undefined): string | undefined {
  if (password === undefined || (typeof password === 'string' && /^[0-9A-Za-z]{4}$/.test(password))) return password
  return badOption('password', 'password has four letters or digits.')
}

function milliseconds(field: string, value: number): number {
  if (Number.isFinite(value) && value >= 0) return value
  return badOption(field, `${field} is a number of milliseconds from 0, not ${shown(value)}.`)
}
