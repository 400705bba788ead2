// Which device a command of 1E or 1C takes, how many points of it and from where on: one check over the rules of each frame.
import { RequestError } from '../../errors'
import { type DeviceAddress, type DeviceName, deviceInfo } from '../device/device'
import { type DeviceWindow, toFrame, windowOf } from './windows'

/** Most points of one request: in bit units bits, in word units words; words of a bit device hold 16 of it. */
export interface PointLimit<N extends string> {
  readonly command: N
  /** Of which devices. */
  readonly of: 'bit' | 'word'
  readonly max: number
}

/** What a frame says about devices beside its windows. `N`: the names of its commands. */
export interface DeviceRules<N extends string> {
  /** For people: `1E`. */
  readonly frame: string
  /** What to use instead of it for what it does not say. */
  readonly instead: string
  readonly limits: readonly PointLimit<N>[]
  /** Where the limits are written. */
  readonly source: string
  /** Commands in bit units. */
  readonly bitUnits: readonly N[]
  /** In word units a bit device starts at a multiple of this. */
  readonly headMultiple: number
  /** Commands that take counters of 32 bits, whose points are words: two of each. */
  readonly pairs: readonly N[]
  /** Why the other commands in word units do not take counters of 32 bits, and what to do, as sentences. */
  readonly noPairs: string
  /** Last numbers of devices that a command writes with fewer digits than their window goes. */
  readonly lastNumbers?: Readonly<Partial<Record<N, Readonly<Partial<Record<DeviceName, number>>>>>>
}

/** What is wrong with a request, and of which kind: the end code of a PLC depends on it. */
export interface DeviceProblem {
  readonly kind: 'device' | 'points' | 'head' | 'range'
  readonly message: string
}

/** Most points of a command for a device; `undefined`: it takes no devices of this kind. */
export function pointLimit<N extends string>(
  { limits }: DeviceRules<N>,
  command: N,
  device: DeviceName,
): number | undefined {
  const of = deviceInfo(device).unit === 'bit' ? 'bit' : 'word'
  return limits.find((limit) => limit.command === command && limit.of === of)?.max
}

/** The windows as far as the digits of a command go. */
export function windowsOf<N extends string>(
  { lastNumbers }: DeviceRules<N>,
  windows: readonly DeviceWindow[],
  command: N,
): readonly DeviceWindow[] {
  const last = lastNumbers?.[command]
  if (last === undefined) return windows
  return windows.map((window) => {
    const points = Math.min(window.points, (last[window.as] ?? Number.POSITIVE_INFINITY) - window.from + 1)
    return points === window.points ? window : { ...window, points }
  })
}

/** Why a command cannot be asked for `points` from `address` on; `undefined` when it can. */
export function deviceProblem<N extends string>(
  rules: DeviceRules<N>,
  all: readonly DeviceWindow[],
  command: N,
  address: DeviceAddress,
  points: number,
): DeviceProblem | undefined {
  const windows = windowsOf(rules, all, command)
  const window = windowOf(windows, address)
  if (window === undefined) return { kind: 'device', message: absent(rules, windows, address) }
  const info = deviceInfo(address.device)
  const bits = rules.bitUnits.includes(command)
  if (bits && info.unit !== 'bit') {
    return { kind: 'head', message: `${info.name} is no bit device: read and write it in word units.` }
  }
  const max = pointLimit(rules, command, address.device) ?? 0
  if (points > max) {
    return {
      kind: 'points',
      message: `${points} points of ${info.name}; one request takes at most ${max} (${rules.source}). Split it.`,
    }
  }
  return (
    (bits ? undefined : wordProblem(rules, command, address, window, points)) ??
    rangeProblem(window, address, points, bits)
  )
}

function wordProblem<N extends string>(
  { headMultiple, pairs, noPairs }: DeviceRules<N>,
  command: N,
  address: DeviceAddress,
  window: DeviceWindow,
  points: number,
): DeviceProblem | undefined {
  const { unit, name } = deviceInfo(address.device)
  if (unit === 'bit' && toFrame(window, address).number % headMultiple !== 0) {
    return {
      kind: 'head',
      message: `${name} ${address.number}: in word units a bit device starts at a multiple of ${headMultiple}. Use bit units.`,
    }
  }
  if (unit !== 'doubleWord') return undefined
  if (!pairs.includes(command)) return { kind: 'device', message: `${name} ${noPairs}` }
  if (points % 2 === 0) return undefined
  return { kind: 'points', message: `${name} has two words for each counter: ${points} points is no multiple of 2.` }
}

function rangeProblem(
  { number, points: length }: DeviceWindow,
  address: DeviceAddress,
  points: number,
  bits: boolean,
): DeviceProblem | undefined {
  const { unit, name } = deviceInfo(address.device)
  const devices = unit === 'bit' && !bits ? 16 * points : unit === 'doubleWord' ? points / 2 : points
  const last = number + length - 1
  if (address.number + devices - 1 <= last) return undefined
  return {
    kind: 'range',
    message: `${name} ends at ${textOf(name, last)} here, and ${devices} from ${textOf(name, address.number)} on go beyond it.`,
  }
}

function absent<N extends string>(
  { frame }: DeviceRules<N>,
  windows: readonly DeviceWindow[],
  { device, number }: DeviceAddress,
): string {
  const own = windows.filter((row) => row.device === device)
  const named = windows.find(
    (row) => row.as === device && row.device !== device && number >= row.from && number < row.from + row.points,
  )
  const what = textOf(device, number)
  if (named !== undefined) {
    return `In a ${frame} frame ${what} would reach ${textOf(named.device, named.number + number - named.from)}: write that if you mean it.`
  }
  if (own.length === 0) {
    const names = [...new Set(windows.map((row) => row.device))].join(', ')
    return `${device} cannot be addressed in a ${frame} frame: it has ${names}.`
  }
  const ranges = own.map((row) => `${textOf(device, row.number)} to ${textOf(device, row.number + row.points - 1)}`)
  return `${what} cannot be addressed in a ${frame} frame, only ${ranges.join(' and ')}.`
}

function textOf(device: DeviceName, number: number): string {
  const { octal, radix } = deviceInfo(device)
  return `${device}${number.toString(octal === true ? 8 : radix).toUpperCase()}`
}

/** @throws RequestError when `deviceProblem` finds something. */
export function checkDevice<N extends string>(
  rules: DeviceRules<N>,
  windows: readonly DeviceWindow[],
  command: N,
  address: DeviceAddress,
  points: number,
  path: string,
): void {
  const problem = deviceProblem(rules, windows, command, address, points)
  if (problem === undefined) return
  const code = problem.kind === 'points' ? 'LIMIT_EXCEEDED' : problem.kind === 'head' ? 'UNSUPPORTED' : 'OUT_OF_RANGE'
  throw new RequestError(code, problem.message, path)
}
