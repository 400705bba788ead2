// What a field of a message takes, in words: for documentation, editors and refusals. Read from the declaration.
import {
  boundsOf,
  type CountField,
  type Field,
  type IntegerField,
  isVisible,
  type Shape,
  type TextField,
} from './field'

const CHARSETS = {
  any: '',
  printable: ' of the characters 20H to 7EH',
  hexDigits: ' of the characters 0-9 and A-F',
  alphanumeric: ' of the characters 0-9, A-Z and a-z',
}

/**
 * What stands in a message for the field `name` of `shape`; `undefined` for what is filled in by itself.
 * @example takesOf(commands.readWords.request, 'points')   // a whole number from 1 to 65535
 */
export function takesOf(shape: Shape, name: string): string | undefined {
  const field = shape[name]
  return field === undefined || !isVisible(field) ? undefined : words(field, derivedCount(shape, name))
}

function words(field: Field, derived: CountField | undefined): string {
  switch (field.kind) {
    case 'u8':
    case 'u16':
    case 'u32':
      return wholeNumber(field)
    case 'words':
      return `an array of words (0 to 65535)${howMany(field.count, derived)}`
    case 'doubleWords':
      return `an array of double words (0 to 4294967295)${howMany(field.count, derived)}`
    case 'bits':
      return `an array of true and false${howMany(field.count, derived)}`
    case 'bytes':
      return `bytes as hexadecimal digits, or an array of numbers from 0 to 255${howMany(field.count, derived)}`
    case 'text':
      return textWords(field, derived)
    case 'rest':
      return `bytes as hexadecimal digits, or an array of numbers from 0 to 255, ${field.min} to ${field.max} elements`
    case 'list':
      return `an array of objects with ${namesOf(field.item)}${howMany(field.count, derived)}`
    case 'each':
      return `for each of ${field.of} ${words(field.item, undefined)}`
    case 'value':
      return field.codec.takes ?? field.codec.name
    default:
      // They are in no message.
      return field.kind
  }
}

function wholeNumber(field: IntegerField): string {
  const { oneOf, multipleOf } = field
  const [min, max] = boundsOf(field)
  if (oneOf !== undefined) return `one of ${oneOf.join(', ')}`
  const multiple = multipleOf === undefined ? '' : `, a multiple of ${multipleOf}`
  return `a whole number from ${min} to ${max}${multiple}`
}

function textWords({ count, charset = 'any' }: TextField, derived: CountField | undefined): string {
  return `a text${CHARSETS[charset]}${howMany(count, derived, 'characters')}`
}

/** The number of elements: derived from them, then it has bounds, or told by another field. */
function howMany(count: number | string, derived: CountField | undefined, unit = 'elements'): string {
  if (typeof count === 'number') return `, ${count} ${unit}`
  if (derived === undefined) return `, as many as ${count} says`
  const { min = 0, max = lastOf(derived.width), multipleOf } = derived
  return `, ${min} to ${max} ${unit}${multipleOf === undefined ? '' : `, a multiple of ${multipleOf}`}`
}

function derivedCount(shape: Shape, name: string): CountField | undefined {
  return Object.values(shape).find((field): field is CountField => field.kind === 'count' && field.of === name)
}

function lastOf(width: number): number {
  return 2 ** (8 * width) - 1
}

/** The names of the fields that are in a message. */
export function namesOf(shape: Shape): string {
  const names = Object.keys(shape).filter((name) => isVisible(shape[name] as Field))
  return names.length === 0 ? 'no fields' : names.join(', ')
}
