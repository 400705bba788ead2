// Which devices a 1E frame reaches, under which name, and how much one request carries, as data
// (FX5 communication manual 39.1 and 39.2).
import { RequestError } from '../../errors'
import { type DeviceAddress, type DeviceName, deviceInfo } from '../device/device'
import type { ACompatibleCommandName } from './commands'

/** Devices in a row that a 1E frame reaches: `points` from `device` `number` on are `as` `from` on in the frame. */
export interface ACompatibleWindow {
  readonly device: DeviceName
  readonly number: number
  readonly points: number
  readonly as: DeviceName
  readonly from: number
}

function plain(device: DeviceName, points: number, number = 0): ACompatibleWindow {
  return { device, number, points, as: device, from: number }
}

const ordinary: readonly ACompatibleWindow[] = [
  plain('X', 0o400),
  plain('Y', 0o400),
  plain('M', 7680),
  plain('S', 4096),
  plain('D', 8000),
  plain('R', 32768),
  plain('TS', 512),
  plain('TN', 512),
  plain('CS', 200),
  plain('CN', 200),
]

const renamed: readonly ACompatibleWindow[] = [
  { device: 'SM', number: 8000, points: 512, as: 'M', from: 8000 },
  { device: 'SD', number: 8000, points: 512, as: 'D', from: 8000 },
  { device: 'LCS', number: 0, points: 56, as: 'CS', from: 200 },
  { device: 'LCN', number: 0, points: 56, as: 'CN', from: 200 },
]

/** FX5: M8000 is a special relay in the frame and may be an internal relay in the PLC, so only SM8000 is taken. */
export const fx5Windows: readonly ACompatibleWindow[] = [...ordinary, ...renamed]

/** FX3: special relays and registers are called M8000 and D8000; SM8000 and SD8000 mean the same. */
const fx3Windows: readonly ACompatibleWindow[] = [
  ...ordinary,
  plain('M', 512, 8000),
  plain('D', 512, 8000),
  plain('CS', 56, 200),
  ...renamed,
]

/** What differs between the PLCs that take 1E. */
export interface ACompatibleFamily {
  readonly title: string
  readonly windows: readonly ACompatibleWindow[]
  /**
   * Bits of an odd number of points in ASCII code: as many characters, or one more, a `0`.
   * Absent: the manual is silent. Then it has to be set, or odd numbers are refused.
   */
  readonly oddBits?: OddBits
  /** Whether the answers that may end with a byte 00H (frame-1e.ts) do. A client takes both, a simulator sends it. */
  readonly zeroBehind: boolean
  /** Users of the family call M8000, D8000 and C200 what the device table has under other names. */
  readonly calledAsInFrame: boolean
  /** What Read PC Type Name answers. */
  readonly typeCode: number
  readonly source: string
}

/** Whether a dummy character follows an odd number of bits in 1E frames in ASCII code. */
export type OddBits = 'exact' | 'padded'

/** FX5 CPU modules and Ethernet modules. */
export const fx5Over1e: ACompatibleFamily = {
  title: 'MELSEC iQ-F',
  windows: fx5Windows,
  zeroBehind: false,
  calledAsInFrame: false,
  typeCode: 0xf3,
  source: 'FX5 communication manual 37.2 and 39; the length of the abnormal code is not printed',
}

/** FX3U-ENET-ADP and FX3U-ENET. */
export const fx3Over1e: ACompatibleFamily = {
  title: 'MELSEC FX3',
  windows: fx3Windows,
  oddBits: 'padded',
  zeroBehind: true,
  calledAsInFrame: true,
  typeCode: 0xf3,
  source:
    'background: FX3U-ENET-ADP user’s manual 7.3 (5BH is followed by 10H to 18H and 00H), 7.5 (dummy 30H) and 7.6.3 ' +
    '(type code and 00H; so FX3U-ENET user’s manual 9.4.3); FX5 communication manual 39.4: F3H of FX5 and FX3U alike',
}

/** Most points of one request: in bit units bits, in word units words; words of a bit device hold 16 of it. */
export interface ACompatibleLimit {
  readonly command: ACompatibleCommandName
  /** Of which devices. */
  readonly of: 'bit' | 'word'
  readonly max: number
}

export const aCompatibleLimitSource = 'FX5 communication manual 39.1 and 39.2'

export const aCompatibleLimits: readonly ACompatibleLimit[] = [
  { command: 'readBits', of: 'bit', max: 256 },
  { command: 'readWords', of: 'bit', max: 32 },
  { command: 'readWords', of: 'word', max: 64 },
  { command: 'writeBits', of: 'bit', max: 160 },
  { command: 'writeWords', of: 'bit', max: 10 },
  { command: 'writeWords', of: 'word', max: 64 },
  { command: 'writeRandomBits', of: 'bit', max: 80 },
  { command: 'writeRandomWords', of: 'bit', max: 10 },
  { command: 'writeRandomWords', of: 'word', max: 10 },
]

/** In word units a bit device starts at a multiple of this (39.1, footnote *1). */
const HEAD_MULTIPLE = 16

/** Commands in bit units. */
const BIT_UNITS: readonly ACompatibleCommandName[] = ['readBits', 'writeBits', 'writeRandomBits']

/** What is wrong with a request, and of which kind: the end code of a PLC depends on it. */
export interface ACompatibleProblem {
  readonly kind: 'device' | 'points' | 'head' | 'range'
  readonly message: string
}

/** Most points of a command for a device; `undefined`: it takes no devices of this kind. */
export function aCompatibleLimit(command: ACompatibleCommandName, device: DeviceName): number | undefined {
  const of = deviceInfo(device).unit === 'bit' ? 'bit' : 'word'
  return aCompatibleLimits.find((limit) => limit.command === command && limit.of === of)?.max
}

/** The window an address is in. */
export function windowOf(
  windows: readonly ACompatibleWindow[],
  { device, number }: DeviceAddress,
): ACompatibleWindow | undefined {
  return windows.find((row) => row.device === device && number >= row.number && number < row.number + row.points)
}

/** Address in the frame of a device that `windowOf` has found. */
export function toFrame({ number, as, from }: ACompatibleWindow, address: DeviceAddress): DeviceAddress {
  return { device: as, number: from + address.number - number }
}

/** The device of the PLC behind an address in a frame; `undefined` when there is none. */
export function fromFrame(
  windows: readonly ACompatibleWindow[],
  { device, number }: DeviceAddress,
): DeviceAddress | undefined {
  const row = windows.find((entry) => entry.as === device && number >= entry.from && number < entry.from + entry.points)
  return row === undefined ? undefined : { device: row.device, number: row.number + number - row.from }
}

/**
 * What an FX3 user calls M8000, D8000 or CS200 under the names the device table has for it: SM8000, SD8000, LCS0. Not
 * CN200: it has 32 bits here, and who writes it means one word.
 */
export function namedAsFx5(address: DeviceAddress): DeviceAddress {
  if (windowOf(fx5Windows, address) !== undefined || address.device === 'CN') return address
  const { device, number, ...rest } = address
  const named = fromFrame(fx5Windows, { device, number })
  return named === undefined ? address : { ...rest, ...named }
}

/**
 * What to write for a counter of 32 bits by its number in GX Works2, `C220`; `undefined` for anything else.
 * @example longCounterHint('C220')   // C200 to C255 are counters of 32 bits: write LCN20 (current value) or LCS20 (contact).
 */
export function longCounterHint(text: string): string | undefined {
  const [, digits] = /^\s*C[NC]?0*(\d+)(?!\d)/i.exec(text) ?? []
  if (digits === undefined) return undefined
  const named = (device: 'CN' | 'CS') => fromFrame(renamed, { device, number: Number(digits) })
  const [value, contact] = [named('CN'), named('CS')]
  if (value === undefined || contact === undefined) return undefined
  const names = `${value.device}${value.number} (current value) or ${contact.device}${contact.number} (contact)`
  return `C200 to C255 are counters of 32 bits: write ${names}.`
}

/** Why a command cannot be asked for `points` from `address` on; `undefined` when it can. */
export function aCompatibleProblem(
  windows: readonly ACompatibleWindow[],
  command: ACompatibleCommandName,
  address: DeviceAddress,
  points: number,
): ACompatibleProblem | undefined {
  const window = windowOf(windows, address)
  if (window === undefined) return { kind: 'device', message: absent(windows, address) }
  const info = deviceInfo(address.device)
  const bits = BIT_UNITS.includes(command)
  if (bits && info.unit !== 'bit') {
    return { kind: 'head', message: `${info.name} is no bit device: read and write it in word units.` }
  }
  const max = aCompatibleLimit(command, address.device) ?? 0
  if (points > max) {
    return {
      kind: 'points',
      message: `${points} points of ${info.name}; one request takes at most ${max} (${aCompatibleLimitSource}). Split it.`,
    }
  }
  return (
    (bits ? undefined : wordProblem(command, address, window, points)) ?? rangeProblem(window, address, points, bits)
  )
}

function wordProblem(
  command: ACompatibleCommandName,
  address: DeviceAddress,
  window: ACompatibleWindow,
  points: number,
): ACompatibleProblem | undefined {
  const { unit, name } = deviceInfo(address.device)
  if (unit === 'bit' && toFrame(window, address).number % HEAD_MULTIPLE !== 0) {
    return {
      kind: 'head',
      message: `${name} ${address.number}: in word units a bit device starts at a multiple of ${HEAD_MULTIPLE}. Use bit units.`,
    }
  }
  if (unit !== 'doubleWord') return undefined
  if (command === 'writeRandomWords') {
    return { kind: 'device', message: `${name} cannot be written at random: write it with Batch write (writeWords).` }
  }
  if (points % 2 === 0) return undefined
  return { kind: 'points', message: `${name} has two words for each counter: ${points} points is no multiple of 2.` }
}

function rangeProblem(
  { number, points: length }: ACompatibleWindow,
  address: DeviceAddress,
  points: number,
  bits: boolean,
): ACompatibleProblem | undefined {
  const { unit, name } = deviceInfo(address.device)
  const devices = unit === 'bit' && !bits ? 16 * points : unit === 'doubleWord' ? points / 2 : points
  const last = number + length - 1
  if (address.number + devices - 1 <= last) return undefined
  return {
    kind: 'range',
    message: `${name} ends at ${textOf(name, last)} here, and ${devices} from ${textOf(name, address.number)} on go beyond it.`,
  }
}

function absent(windows: readonly ACompatibleWindow[], { device, number }: DeviceAddress): string {
  const own = windows.filter((row) => row.device === device)
  const named = windows.find(
    (row) => row.as === device && row.device !== device && number >= row.from && number < row.from + row.points,
  )
  const what = textOf(device, number)
  if (named !== undefined) {
    return `In a 1E frame ${what} would reach ${textOf(named.device, named.number + number - named.from)}: write that if you mean it.`
  }
  if (own.length === 0) {
    const names = [...new Set(windows.map((row) => row.device))].join(', ')
    return `${device} cannot be addressed in a 1E frame: it has ${names}.`
  }
  const ranges = own.map((row) => `${textOf(device, row.number)} to ${textOf(device, row.number + row.points - 1)}`)
  return `${what} cannot be addressed in a 1E frame, only ${ranges.join(' and ')}.`
}

function textOf(device: DeviceName, number: number): string {
  const { octal, radix } = deviceInfo(device)
  return `${device}${number.toString(octal === true ? 8 : radix).toUpperCase()}`
}

/** @throws RequestError when `aCompatibleProblem` finds something. */
export function checkACompatible(
  windows: readonly ACompatibleWindow[],
  command: ACompatibleCommandName,
  address: DeviceAddress,
  points: number,
  path: string,
): void {
  const problem = aCompatibleProblem(windows, command, address, points)
  if (problem === undefined) return
  const code = problem.kind === 'points' ? 'LIMIT_EXCEEDED' : problem.kind === 'head' ? 'UNSUPPORTED' : 'OUT_OF_RANGE'
  throw new RequestError(code, problem.message, path)
}
