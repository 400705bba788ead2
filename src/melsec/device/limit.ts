// How much one request may carry, as data: per command, form of the device specification and data code.
// The client checks and splits with it, the simulator answers its end code, the documentation prints it.
import { type DataCode, encode, type Shape, writerOf } from '../../codec/codec'
import { RequestError } from '../../errors'
import { type CommandName, commands } from '../commands/commands'
import type { Profile } from '../profiles/profile'
import type { DeviceName } from './device'
import type { DeviceForm } from './device-form'
import type { LimitedUnit, LimitRule, LimitUnit, Weights } from './limit-rule'

/** One limit: the weighted sum of the fields in `sum` is at least `min` and at most `max`. */
export interface Limit {
  readonly command: CommandName
  readonly form: DeviceForm
  readonly code: DataCode
  /** It is about devices of this unit only. */
  readonly of?: LimitedUnit
  readonly sum: Weights
  readonly max: number
  readonly min: number
  readonly unit: LimitUnit
  /** End code a CPU of this family answers when the limit is broken. */
  readonly endCode: number
  /** Manual section, or where else the figure comes from. */
  readonly source: string
}

/** The fields that hold the points of a request, each point counted once. */
export const pointFields: Readonly<Partial<Record<CommandName, Weights>>> = {
  readBits: { points: 1 },
  readWords: { points: 1 },
  writeBits: { values: 1 },
  writeWords: { values: 1 },
  readRandom: { words: 1, doubleWords: 1 },
  entryMonitorDevice: { words: 1, doubleWords: 1 },
  writeRandomBits: { bits: 1 },
  writeRandomWords: { words: 1, doubleWords: 1 },
  readBlock: { 'wordBlocks.points': 1, 'bitBlocks.points': 1 },
  writeBlock: { 'wordBlocks.values': 1, 'bitBlocks.values': 1 },
}

const TALLY = 'points of '

/** Name in a sum for the points of one device, whatever field they stand in. */
export function tallyOf(device: DeviceName): string {
  return `${TALLY}${device}`
}

function factorOf(rule: LimitRule, form: DeviceForm, code: DataCode): number {
  const extended = form === 'extendedShort' || form === 'extendedLong'
  return (code === 'ascii' ? (rule.asciiFactor ?? 1) : 1) * (extended ? (rule.extendedFactor ?? 1) : 1)
}

function limitOf(rule: LimitRule, command: CommandName, form: DeviceForm, code: DataCode): Limit {
  const points = rule.sum ?? (rule.unit === 'bytes' ? {} : pointFields[command])
  if (points === undefined) throw new Error(`limit rule for ${command} without a sum`)
  const sum = { ...points, ...Object.fromEntries((rule.twice ?? []).map((device) => [tallyOf(device), 1])) }
  // "Counts n times, at most max" is the same as "at most max / n", and the figure a user can check against.
  const max = Math.floor(rule.max / factorOf(rule, form, code))
  const { min = 1, unit, endCode, source, of } = rule
  return { command, form, code, ...(of === undefined ? {} : { of }), sum, max, min, unit, endCode, source }
}

function sameSum(a: Limit, b: Limit): boolean {
  const fields = Object.keys(a.sum)
  return fields.length === Object.keys(b.sum).length && fields.every((field) => a.sum[field] === b.sum[field])
}

/** Of two limits on the same sum only the lower one matters; the first of two equal ones is kept. */
function withoutHigher(limits: readonly Limit[]): readonly Limit[] {
  return limits.filter((limit, index) =>
    limits.every(
      (other, at) =>
        at === index || !sameSum(limit, other) || limit.max < other.max || (limit.max === other.max && index < at),
    ),
  )
}

const memo = new WeakMap<Profile, Map<string, readonly Limit[]>>()

/**
 * The limits of one command; all of them hold at the same time (`readBlock`: blocks and points).
 * Empty for a command without any. The same frozen-by-convention array each time, so it may be called per request.
 *
 * @param command its name; one that is not declared has no limits
 * @param of the unit of the devices; without it the limits of both are given, of which the lower one counts
 * @example limitsOf(resolveProfile('iq-f'), 'readWords', 'short', 'ascii')[0].max // 480
 */
export function limitsOf(
  profile: Profile,
  command: string,
  form: DeviceForm,
  code: DataCode,
  of?: LimitedUnit,
): readonly Limit[] {
  const known = memo.get(profile) ?? new Map<string, readonly Limit[]>()
  memo.set(profile, known)
  const key = `${command} ${form} ${code} ${of ?? ''}`
  let limits = known.get(key)
  if (limits === undefined) {
    const concerns = (rule: LimitRule) => of === undefined || rule.of === undefined || rule.of === of
    const rules = profile.limits.filter(
      (rule) => rule.forms.includes(form) && concerns(rule) && rule.codes?.includes(code) !== false,
    )
    limits = withoutHigher(
      rules.flatMap((rule) => {
        const name = rule.commands.find((listed) => listed === command)
        return name === undefined ? [] : [limitOf(rule, name, form, code)]
      }),
    )
    known.set(key, limits)
  }
  return limits
}

/** A message of a command, as far as limits look at it. */
export type Measurable = Readonly<Record<string, unknown>>

function sizeOf(value: unknown): number | undefined {
  if (typeof value === 'number') return value
  if (typeof value === 'string') return value.length
  return isArrayLike(value) ? value.length : undefined
}

function isArrayLike(value: unknown): value is ArrayLike<unknown> {
  return Array.isArray(value) || (ArrayBuffer.isView(value) && 'length' in value)
}

function isMeasurable(value: unknown): value is Measurable {
  return typeof value === 'object' && value !== null
}

/** Addresses of a device in the lists of a message. */
function tallied(message: Measurable, name: string): number {
  const lists = Object.values(message).filter((value): value is unknown[] => Array.isArray(value))
  return lists.flat().filter((item) => isMeasurable(item) && isMeasurable(item.device) && item.device.device === name)
    .length
}

function sizeAt(message: Measurable, path: string): number | undefined {
  if (path.startsWith(TALLY)) return tallied(message, path.slice(TALLY.length))
  const dot = path.indexOf('.')
  if (dot < 0) return sizeOf(message[path])
  const value = message[path.slice(0, dot)]
  const inner = path.slice(dot + 1)
  if (!Array.isArray(value)) return undefined
  let sum = 0
  for (const item of value as unknown[]) {
    const size = isMeasurable(item) ? sizeOf(item[inner]) : undefined
    if (size === undefined) return undefined
    sum += size
  }
  return sum
}

/**
 * The weighted sum that `limit` bounds.
 *
 * @throws RequestError BAD_MESSAGE when a field of the sum is missing or has no size.
 */
export function measureLimit(limit: Limit, message: Measurable): number {
  if (limit.unit === 'bytes') return requestBytes(limit.command, limit.code, message)
  let sum = 0
  for (const path in limit.sum) {
    // A number where characters belong is no count of them: told as one, a password typed as a number would be shown.
    if (limit.unit === 'characters' && typeof message[path] !== 'string') {
      throw new RequestError('BAD_MESSAGE', `${limit.command}: "${path}" must be a text.`, path)
    }
    const size = sizeAt(message, path)
    if (size === undefined || !Number.isFinite(size)) {
      throw new RequestError('BAD_MESSAGE', `${limit.command}: "${path}" must be a number, a text or a list.`, path)
    }
    sum += (limit.sum[path] ?? 0) * size
  }
  return sum
}

/**
 * Bytes of request data, command and subcommand included.
 * @throws RequestError BAD_MESSAGE when the message does not fit the command.
 */
export function requestBytes(name: CommandName, code: DataCode, message: Measurable): number {
  const writer = writerOf(code)
  writer.uint(commands[name].code, 2)
  writer.uint(0, 2)
  encode<Shape>(commands[name].request, message, writer)
  return writer.take().length
}

/** The first limit the message breaks, with what was measured; undefined when it fits. For the simulator's end codes. */
export function brokenLimit(
  profile: Profile,
  command: string,
  form: DeviceForm,
  code: DataCode,
  message: Measurable,
): { readonly limit: Limit; readonly measured: number } | undefined {
  for (const limit of limitsOf(profile, command, form, code)) {
    const measured = measureLimit(limit, message)
    if (measured < limit.min || measured > limit.max) return { limit, measured }
  }
  return undefined
}

function formula(limit: Limit): string {
  if (limit.unit === 'bytes') return 'command, subcommand and data'
  return Object.entries(limit.sum)
    .map(([path, weight]) => (path.startsWith(TALLY) ? `${path} again` : weight === 1 ? path : `${weight} x ${path}`))
    .join(' + ')
}

const unitText: Readonly<Record<LimitUnit, string>> = {
  points: 'points',
  blocks: 'blocks',
  weightedPoints: 'weighted points',
  bytes: 'bytes',
  characters: 'characters',
}

/**
 * Refuses a message that one request cannot carry.
 *
 * @throws RequestError LIMIT_EXCEEDED (too much), OUT_OF_RANGE (nothing at all), BAD_MESSAGE (not measurable).
 */
export function checkLimits(
  profile: Profile,
  command: string,
  form: DeviceForm,
  code: DataCode,
  message: Measurable,
): void {
  const broken = brokenLimit(profile, command, form, code, message)
  if (broken === undefined) return
  const { limit, measured } = broken
  const unit = unitText[limit.unit]
  if (limit.unit === 'characters') {
    const range = limit.min === limit.max ? `exactly ${limit.min}` : `${limit.min} to ${limit.max}`
    throw new RequestError(
      measured < limit.min ? 'OUT_OF_RANGE' : 'LIMIT_EXCEEDED',
      `${command}: ${formula(limit)} has ${measured} characters; ${profile.title} takes ${range} (${limit.source}).`,
      formula(limit),
    )
  }
  if (measured < limit.min) {
    throw new RequestError(
      'OUT_OF_RANGE',
      `${command}: the request has no ${unit} (${formula(limit)} = ${measured}); give at least ${limit.min}.`,
      command,
    )
  }
  throw new RequestError(
    'LIMIT_EXCEEDED',
    `${command}: ${measured} ${unit} in one request (${formula(limit)}), at most ${limit.max} for ${profile.title} in ${code} code` +
      ` with the ${formText[form]} device specification (${limit.source}). Split the request, or use read() and write(), which split by themselves.`,
    command,
  )
}

const formText: Readonly<Record<DeviceForm, string>> = {
  short: 'short',
  long: 'long',
  extendedShort: 'extended short',
  extendedLong: 'extended long',
}
