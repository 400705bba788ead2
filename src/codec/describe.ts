import { hasSecret } from './annotate'
import type { Count, Field, Shape } from './field'
import { takesOf } from './takes'

/** One row of a command's documentation: read from the same data the codec runs on. */
export interface FieldDescription {
  /** Name of the field in a message. */
  readonly name: string
  /** Kind of the field, of a value codec its name. */
  readonly kind: string
  /** What stands in a message for it, in words; absent for what is filled in by itself. */
  readonly takes?: string
  /** May be left out of a message that is encoded. */
  readonly optional?: true
  /** A password: never shown. */
  readonly secret?: true
  /** e.g. `1..960` */
  readonly range?: string
  /** Only multiples of this number. */
  readonly multipleOf?: number
  /** The only numbers that may stand here. */
  readonly oneOf?: readonly number[]
  /** What is written when a message leaves the field out. */
  readonly default?: unknown
  /** What says how many values there are: a number, or the name of another field. */
  readonly count?: Count
  /** Of a fixed field: the number that always stands there. */
  readonly value?: number
  /** Of a count: the field whose values it counts. */
  readonly of?: string
  /** What it means. */
  readonly doc?: string
  /** Of a list: the fields of each element; of what repeats a list of the request: those that are repeated. */
  readonly item?: readonly FieldDescription[]
}

/** Rows for documentation, palette options and the frame decoder. */
export function describe(shape: Shape): FieldDescription[] {
  return Object.entries(shape).map(([name, field]) => ({
    name,
    kind: field.kind === 'value' ? field.codec.name : field.kind,
    ...takenBy(shape, name, field),
    ...rangeOf(field),
    ...rulesOf(field),
    ...('count' in field ? { count: field.count } : {}),
    ...(field.kind === 'fixed' ? { value: field.value } : {}),
    ...('of' in field ? { of: field.of } : {}),
    ...('doc' in field && field.doc !== undefined ? { doc: field.doc } : {}),
    ...(field.kind === 'list' || field.kind === 'repeat' ? { item: describe(field.item) } : {}),
  }))
}

function takenBy(shape: Shape, name: string, field: Field): Pick<FieldDescription, 'takes' | 'optional' | 'secret'> {
  const takes = takesOf(shape, name)
  return {
    ...(takes === undefined ? {} : { takes }),
    ...('default' in field && field.default !== undefined ? { optional: true } : {}),
    ...(hasSecret({ [name]: field }) ? { secret: true } : {}),
  }
}

function rangeOf(field: Field): { range?: string } {
  if (!('min' in field) && !('max' in field)) return {}
  const { min, max } = field as { min?: number; max?: number }
  return { range: `${min ?? 0}..${max ?? ''}` }
}

function rulesOf(field: Field): Pick<FieldDescription, 'multipleOf' | 'oneOf' | 'default'> {
  return {
    ...('multipleOf' in field && field.multipleOf !== undefined ? { multipleOf: field.multipleOf } : {}),
    ...('oneOf' in field && field.oneOf !== undefined ? { oneOf: field.oneOf } : {}),
    ...('default' in field && typeof field.default === 'number' ? { default: field.default } : {}),
  }
}
