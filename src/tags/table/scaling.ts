/**
 * Scaling and its inverse.
 *
 * Both directions are one formula, `(a * (x1 - x) + b * (x - x0)) / (x1 - x0)`, which gives both ends exactly. The limits are
 * decimals that people wrote, so they are made whole numbers first: with whole numbers in the PLC there is one rounding, at the
 * division, and 123 of 0..1000 as 0..100 is 12.3 and not 12.299999999999999.
 */
import { show } from '../../basics/show'
import type { Scaling } from './tag'

/** A value for people, or why there is none. */
export type ScaledValue =
  | {
      /** Whether there is a value. */
      readonly ok: true
      /** In the unit of the tag. */
      readonly value: number
      /** It was beyond the limits, and is the limit now. */
      readonly clamped: boolean
    }
  | {
      /** Whether there is a value. */
      readonly ok: false
      /** Why there is none. */
      readonly reason: string
    }

interface Line {
  readonly from: readonly [number, number]
  readonly to: readonly [number, number]
  /** What `from` and `to` were multiplied by. */
  readonly fromUnit: number
  readonly toUnit: number
}

/** Beyond it whole numbers have gaps. */
const EXACT = Number.MAX_SAFE_INTEGER

/** The power of ten that makes both whole, 1 when none does without loss. */
function unitOf([a, b]: readonly [number, number]): number {
  for (let unit = 1; unit <= 1e9; unit *= 10) {
    const whole = [a, b].every((limit) => {
      const product = Math.round(limit * unit)
      return Math.abs(product) <= EXACT && product / unit === limit
    })
    if (whole) return unit
  }
  return 1
}

function times([a, b]: readonly [number, number], unit: number): readonly [number, number] {
  return unit === 1 ? [a, b] : [Math.round(a * unit), Math.round(b * unit)]
}

function lineOf(from: readonly [number, number], to: readonly [number, number]): Line {
  const fromUnit = unitOf(from)
  const toUnit = unitOf(to)
  return { from: times(from, fromUnit), to: times(to, toUnit), fromUnit, toUnit }
}

/** Where a point lies on the line; exact at both ends. */
function along({ from: [x0, x1], to: [y0, y1], fromUnit, toUnit }: Line, point: number): number {
  const product = point * fromUnit
  // 12.3 * 10 is 123: what people wrote in as many digits as the limits is whole here, too.
  const whole = Math.round(product)
  const x = whole / fromUnit === point ? whole : product
  if (x === x0) return y0 / toUnit
  if (x === x1) return y1 / toUnit
  const sum = y0 * (x1 - x) + y1 * (x - x0)
  const scale = (x1 - x0) * toUnit
  // There is no -0 for people.
  if (Number.isFinite(sum)) return sum / scale + 0
  // The products are too large: the part of the way first.
  const part = (x - x0) / (x1 - x0)
  return (y0 * (1 - part) + y1 * part) / toUnit
}

const UNIT = [0, 1] as const
const lines = new WeakMap<Scaling, { readonly there: Line; readonly back: Line }>()

/** Made once for each scaling: values come by the thousand. */
function linesOf(scaling: Scaling): { readonly there: Line; readonly back: Line } {
  const known = lines.get(scaling)
  if (known !== undefined) return known
  const { kind, raw, engineering } = scaling
  const made =
    kind === 'linear'
      ? { there: lineOf(raw, engineering), back: lineOf(engineering, raw) }
      : { there: lineOf(raw, UNIT), back: lineOf(engineering, UNIT) }
  lines.set(scaling, made)
  return made
}

/**
 * What people read for a number in the PLC.
 *
 * NaN and infinity in the PLC have no value, nor has what becomes too large for a number; of a square root nothing below
 * `raw[0]`, unless `clamp` makes it the limit. A BigInt beyond 9007199254740991 is rounded to the nearest number, as the value is one.
 *
 * @example engineeringOf({ kind: 'linear', raw: [0, 4000], engineering: [0, 10] }, 1234)   // { ok: true, value: 3.085, clamped: false }
 */
export function engineeringOf(scaling: Scaling, raw: number | bigint): ScaledValue {
  const number = Number(raw)
  if (!Number.isFinite(number)) return { ok: false, reason: `${show(raw)} in the PLC is no number that can be scaled.` }
  const { there } = linesOf(scaling)
  const value = scaling.kind === 'linear' ? along(there, number) : rooted(scaling, along(there, number))
  if (value === undefined) {
    const [low] = scaling.raw
    return { ok: false, reason: `${show(raw)} in the PLC is beyond ${low}, where the square root begins.` }
  }
  if (!Number.isFinite(value)) return { ok: false, reason: `${show(raw)} in the PLC is too large to be scaled.` }
  const limit = scaling.clamp === true ? limitOf(scaling, value) : undefined
  return limit === undefined ? { ok: true, value, clamped: false } : { ok: true, value: limit, clamped: true }
}

/** Of a part of the raw range the square root, in the engineering range. Below 0 it has none; clamped, it is beyond the low end. */
function rooted({ engineering: [low, high], clamp }: Scaling, part: number): number | undefined {
  if (part < 0) return clamp === true ? low - (high - low) : undefined
  return part === 0 ? low : part === 1 ? high : low + Math.sqrt(part) * (high - low)
}

/** The engineering limit that a value is beyond. */
export function limitOf({ engineering: [a, b] }: Scaling, value: number): number | undefined {
  const low = Math.min(a, b)
  const high = Math.max(a, b)
  if (value < low) return low
  return value > high ? high : undefined
}

/**
 * The number in the PLC for a value people gave, not rounded to a whole one; undefined where there is none: the low side of a
 * square root, and what becomes too large. Clamping has no part in it: see `rawValueOf` for what is refused.
 *
 * @example rawOf({ kind: 'linear', raw: [0, 4000], engineering: [0, 10] }, 3.085)   // 1234
 */
export function rawOf(scaling: Scaling, value: number): number | undefined {
  const { back } = linesOf(scaling)
  const at = along(back, value)
  const raw = scaling.kind === 'linear' ? at : squared(scaling, at)
  return raw !== undefined && Number.isFinite(raw) ? raw : undefined
}

function squared({ raw: [low, high] }: Scaling, part: number): number | undefined {
  if (part < 0) return undefined
  return part === 1 ? high : low + part * part * (high - low)
}
