/** What a tag is: plain data, as it stands in a program, in JSON and in a row of a table. It knows no family of PLCs. */
import type { ValueFormat } from '../../value/format'

/** From the numbers in the PLC to those people read, and back: see `engineeringOf` and `rawOf`. */
export interface Scaling {
  /** `linear`: a straight line. `squareRoot`: of a flow that is measured as a difference of pressure. */
  readonly kind: 'linear' | 'squareRoot'
  /** Two different numbers in the PLC, e.g. `[0, 4000]`. */
  readonly raw: readonly [low: number, high: number]
  /** What people read at these two, e.g. `[0, 10]`. */
  readonly engineering: readonly [low: number, high: number]
  /** Values beyond the engineering limits are shown as the limit, and said to be. A write beyond them is refused. */
  readonly clamp?: boolean
}

/**
 * How far a number must be from the one that was told last to be told again; of an array each of its numbers. What is no number is told with any
 * difference.
 */
export interface Deadband {
  /** `absolute`: in the unit of the value. `percent`: of a range. */
  readonly kind: 'absolute' | 'percent'
  /** From 0, percent to 100; a change must be greater than it. */
  readonly value: number
  /** The range of percent, the lower end first. Of a tag left out: it is that of its scaling, else from `min` to `max`. */
  readonly of?: readonly [low: number, high: number]
}

/** What may be done with a tag. */
export type TagAccess = 'read' | 'readWrite'

/** All of a tag but its name. */
export interface TagFields {
  /** Address or label, as an item has it: `D100`, `D100:REAL[10]`, `Line1.Speed`. */
  readonly address: string
  /** e.g. `REAL`, when it is not in the address. */
  readonly type?: string
  /** Number of values of an array, when it is not in the address. */
  readonly count?: number
  /** What it is, for people. */
  readonly description?: string
  /** Unit of the value, e.g. `°C`. */
  readonly unit?: string
  /** Without it the value is the number in the PLC. */
  readonly scaling?: Scaling
  /** Without it every change is told. */
  readonly deadband?: Deadband
  /** Name of the rate at which it is watched. */
  readonly scanClass?: string
  /** Without it `read`: what nobody allowed cannot be written. */
  readonly access?: TagAccess
  /** Smallest value that may be written, in the unit of the tag. */
  readonly min?: number
  /** Largest value that may be written. */
  readonly max?: number
  /** Word order, encoding and so on, where the PLC program does it otherwise. */
  readonly format?: ValueFormat
}

/** One row of a table. */
export interface Tag extends TagFields {
  /** Unique in its table. */
  readonly name: string
}

/** The part of a tag that says what to read: an item. */
export type TagItem = Pick<TagFields, 'address' | 'type' | 'count'> & ValueFormat

/**
 * The item of a tag, for whatever reads and writes items.
 * @example itemOfTag({ name: 'level', address: 'D100', type: 'REAL', unit: 'm' })   // { address: 'D100', type: 'REAL' }
 */
export function itemOfTag({ address, type, count, format }: Tag): TagItem {
  return {
    address,
    ...(type === undefined ? {} : { type }),
    ...(count === undefined ? {} : { count }),
    ...format,
  }
}

/** The fields of a tag, in the order of tables. */
export const tagFields = [
  'name',
  'address',
  'type',
  'count',
  'description',
  'unit',
  'scaling',
  'deadband',
  'scanClass',
  'access',
  'min',
  'max',
  'format',
] as const satisfies readonly (keyof Tag)[]

/** A field of a tag. */
export type TagField = (typeof tagFields)[number]

/** Kinds of scaling. */
export const scalingKinds = ['linear', 'squareRoot'] as const satisfies readonly Scaling['kind'][]
/** Kinds of deadband. */
export const deadbandKinds = ['absolute', 'percent'] as const satisfies readonly Deadband['kind'][]
/** Kinds of access. */
export const tagAccesses = ['read', 'readWrite'] as const satisfies readonly TagAccess[]
