// An example of a message, made from its shape: for documentation and editors.
import { type BulkField, type Field, type IntegerField, isVisible, type Shape } from './field'

/** How the values of value codecs are shown, where that is not as they are. */
export type ShowValue = (field: Extract<Field, { kind: 'value' }>, path: readonly string[]) => unknown

/**
 * A message that fits the shape as far as the shape tells: each number the lowest that may be, one element in each list,
 * without the fields that may be left out.
 */
export function exampleOf(shape: Shape, showValue: ShowValue, path: readonly string[] = []): Record<string, unknown> {
  const fields = Object.entries(shape).filter(([, field]) => isVisible(field) && !mayBeMissing(field))
  return Object.fromEntries(
    fields.map(([name, field]) => [name, exampleValue(shape, [...path, name], field, showValue)]),
  )
}

function mayBeMissing(field: Field): boolean {
  return 'default' in field && field.default !== undefined
}

function exampleValue(shape: Shape, path: readonly string[], field: Field, showValue: ShowValue): unknown {
  switch (field.kind) {
    case 'u8':
    case 'u16':
    case 'u32':
      return lowest(field)
    case 'value':
      return showValue(field, path)
    case 'text':
      // Never a password that somebody might send: a wrong one is counted by the PLC.
      if (field.secret === true) return ''
      return 'A'.repeat(elements(shape, path, field.count))
    case 'list':
      return Array.from({ length: elements(shape, path, field.count) }, () => exampleOf(field.item, showValue, path))
    case 'words':
    case 'doubleWords':
    case 'bits':
    case 'bytes':
      return bulk(field, elements(shape, path, field.count))
    case 'rest':
      return '00'.repeat(Math.max(field.min, 1))
    default:
      return undefined
  }
}

function lowest({ min = 0, oneOf, multipleOf = 1 }: IntegerField): number {
  return oneOf?.[0] ?? Math.ceil(min / multipleOf) * multipleOf
}

function bulk({ kind }: BulkField, length: number): unknown {
  if (kind === 'bytes') return '00'.repeat(length)
  return Array.from({ length }, () => (kind === 'bits' ? false : 0))
}

/** As few as may be, but one to show what an element is. */
function elements(shape: Shape, path: readonly string[], count: number | string): number {
  if (typeof count === 'number') return count
  const name = path.at(-1)
  const derived = Object.values(shape).find((field) => field.kind === 'count' && field.of === name)
  if (derived?.kind === 'count') return Math.max(derived.min ?? 0, 1)
  const counted = shape[count]
  return counted !== undefined && 'min' in counted ? Math.max(counted.min ?? 0, 1) : 1
}
