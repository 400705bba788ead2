/**
 * From the value people gave to the one that is written: access, limits, scaling backwards. Nothing is clamped, and what is refused is
 * refused before anything is sent, with the reason.
 */
import { show } from '../../basics/show'
import { RequestError, type RequestErrorCode } from '../../errors'
// Not by the public names of the room: tables are checked in browsers, too.
import { type ByteType, formatByteType } from '../../value/byte-type'
import type { PlcValue } from '../../value/type'
import type { TagValue } from './deadband'
import { engineeringOf, limitOf, rawOf } from './scaling'
import type { Tag } from './tag'
import { infoOf } from './type'

/** What is to be written, and what will be read of it. */
export interface RawWrite {
  /** For the PLC. */
  readonly raw: TagValue
  /** In the unit of the tag: with scaling the nearest value that the PLC can hold, else what was given. */
  readonly value: TagValue
}

/**
 * The value that is written to the PLC for one in the unit of a tag.
 *
 * A scaled value becomes the nearest that the type can hold, halves away from zero; `value` says which one that is. `min` and `max` hold for
 * what is given and for what the PLC would hold then.
 *
 * @param type of one value in the PLC, as the address says it; undefined of a label of which only the PLC knows it
 * @param count of an array; undefined for a single value
 * @throws RequestError NOT_PERMITTED for a tag that is only read; OUT_OF_RANGE beyond `min`, `max`, the limits of a clamped scaling or
 *   what the type can hold; BAD_VALUE for what is no value of it. `field` is the name of the tag.
 * @example rawValueOf({ name: 'level', address: 'D100', access: 'readWrite', scaling: { kind: 'linear', raw: [0, 4000], engineering: [0, 10] } },
 *   { name: 'INT' }, undefined, 3.085)   // { raw: 1234, value: 3.085 }
 */
export function rawValueOf(tag: Tag, type: ByteType | undefined, count: number | undefined, value: TagValue): RawWrite {
  const fail: Fail = (code, message) => {
    throw new RequestError(code, `${tag.name} (${tag.address}): ${message}`, tag.name)
  }
  if (tag.access !== 'readWrite') fail('NOT_PERMITTED', "it is only read: set access to 'readWrite' to write it.")
  if (type === undefined) return untyped(tag, value, fail)
  if (!isList(value)) {
    if (count !== undefined) fail('BAD_VALUE', `it takes an array of ${count} values, not ${show(value)}.`)
    return oneRaw(tag, type, value, fail)
  }
  if (count === undefined) return fail('BAD_VALUE', `it takes one value, not ${show(value)}.`)
  if (value.length !== count) fail('BAD_VALUE', `it takes ${count} values, not ${value.length}.`)
  const each = Array.from(value, (one, at) =>
    oneRaw(tag, type, one, (code, message) => fail(code, `element ${at}: ${message}`)),
  )
  return { raw: each.map(({ raw }) => raw), value: each.map((one) => one.value) }
}

function isLimited({ min, max, scaling }: Tag): boolean {
  return min !== undefined || max !== undefined || scaling !== undefined
}

/** What the PLC says of a label comes too late for limits. */
function untyped(tag: Tag, value: TagValue, fail: Fail): RawWrite {
  if (isLimited(tag)) fail('BAD_TYPE', 'give its type: with limits or a scaling it must be known before it is written.')
  return { raw: value, value }
}

type Fail = (code: RequestErrorCode, message: string) => never

function isList(value: TagValue): value is readonly PlcValue[] {
  return Array.isArray(value)
}

interface OneRaw {
  readonly raw: PlcValue
  readonly value: PlcValue
}

function oneRaw(tag: Tag, type: ByteType, value: PlcValue, fail: Fail): OneRaw {
  // Bits, texts and numbers without limits: what the type takes is for the value layer to say.
  if (!isLimited(tag)) return { raw: value, value }
  const number = numberIn(value, fail)
  checkLimits(tag, number, fail)
  const { scaling } = tag
  if (scaling === undefined) {
    if (typeof number === 'number' && infoOf(type).kind !== 'real' && !Number.isInteger(number)) {
      fail('BAD_VALUE', `${show(number)} is no whole number, as ${formatByteType(type)} takes.`)
    }
    checkRange(type, number, number, fail)
    return { raw: number, value: number }
  }
  const wanted = Number(number)
  if (typeof number === 'bigint' && BigInt(wanted) !== number) {
    fail('BAD_VALUE', `${show(number)} has more digits than a scaled value can: give a number.`)
  }
  return scaledRaw({ ...tag, scaling }, type, wanted, fail)
}

function numberIn(value: PlcValue, fail: Fail): number | bigint {
  if (typeof value === 'bigint' || (typeof value === 'number' && Number.isFinite(value))) return value
  return fail('BAD_VALUE', `it takes a finite number, not ${show(value)}.`)
}

function checkLimits({ min, max, unit }: Tag, value: number | bigint, fail: Fail, how = ''): void {
  const text = (limit: number) => (unit === undefined ? `${limit}` : `${limit} ${unit}`)
  if (min !== undefined && value < min) fail('OUT_OF_RANGE', `${value}${how} is below its minimum of ${text(min)}.`)
  if (max !== undefined && value > max) fail('OUT_OF_RANGE', `${value}${how} is above its maximum of ${text(max)}.`)
}

function scaledRaw(tag: Tag & Required<Pick<Tag, 'scaling'>>, type: ByteType, value: number, fail: Fail): OneRaw {
  const { scaling } = tag
  const limit = scaling.clamp === true ? limitOf(scaling, value) : undefined
  if (limit !== undefined) fail('OUT_OF_RANGE', `${value} is beyond ${limit}, where its scale ends.`)
  const exact = rawOf(scaling, value)
  if (exact === undefined) return fail('OUT_OF_RANGE', `${value} has no value in the PLC by its scaling.`)
  if (infoOf(type).kind === 'real') {
    checkRange(type, exact, value, fail)
    return { raw: exact, value }
  }
  const raw = nearest(exact)
  checkRange(type, raw, value, fail)
  const read = engineeringOf(scaling, raw)
  if (!read.ok) return fail('OUT_OF_RANGE', `${value} cannot be read back: ${read.reason}`)
  checkLimits(tag, read.value, fail, `, the nearest value to ${value} that the PLC can hold,`)
  return { raw: infoOf(type).kind === 'long' ? BigInt(raw) : raw, value: read.value }
}

/** Halves away from zero, and no -0. */
function nearest(value: number): number {
  const rounded = Math.sign(value) * Math.round(Math.abs(value))
  return rounded === 0 ? 0 : rounded
}

/** Whether the type can hold it. Single precision is rounded as every REAL is. */
function checkRange(type: ByteType, raw: number | bigint, value: number | bigint, fail: Fail): void {
  const { kind, min = 0, max = 0 } = infoOf(type)
  const scaled = raw === value ? '' : ` (${raw} in the PLC)`
  switch (kind) {
    case 'bit':
    case 'text':
      fail('BAD_VALUE', `${formatByteType(type)} has no limits and no scaling.`)
      break
    case 'real':
      if (typeof raw === 'bigint')
        fail('BAD_VALUE', `${formatByteType(type)} takes a number, not the BigInt ${show(raw)}.`)
      if (type.name === 'REAL' && !Number.isFinite(Math.fround(Number(raw)))) {
        fail('OUT_OF_RANGE', `${value}${scaled} is more than REAL can hold.`)
      }
      break
    default:
      if (raw < min || raw > max) {
        fail('OUT_OF_RANGE', `${value}${scaled} is not from ${min} to ${max}, as ${formatByteType(type)} is.`)
      }
  }
}
