// Messages as JSON, whatever their family: what is typed to messages, and messages to what is shown.
import { RequestError } from '../errors'
import { hasSecret } from './annotate'
import { type Field, isVisible, type Shape } from './field'
import { namesOf, takesOf } from './takes'

/** Fields with a value codec in JSON: what is none of the family's own is as it is. */
export interface JsonValues {
  /** @param path of the field, for refusals. @throws RequestError */
  read(field: Field, given: unknown, path: string): unknown
  show(field: Field, value: unknown): unknown
}

/** How a message is read. */
interface Place {
  readonly values: JsonValues
  /** Of the command. */
  readonly title: string
}
type Path = readonly (string | number)[]

/**
 * The message of a shape out of JSON: names, kinds, and what each field takes; ranges are checked when it is encoded.
 * @throws RequestError naming the field, what is wrong with it and what it takes
 */
export function messageOfJson(shape: Shape, json: unknown, place: Place): Record<string, unknown> {
  return bagFromJson(shape, json, [], place)
}

/** What `messageOfJson` makes the same message of. `secrets`: passwords too; without it they are left out. */
export function jsonOfMessage(
  shape: Shape,
  message: object,
  options: { readonly values: JsonValues; readonly secrets?: boolean },
): Record<string, unknown> {
  return bagToJson(shape, message, options)
}

function bagFromJson(shape: Shape, given: unknown, path: Path, place: Place): Record<string, unknown> {
  if (!isObject(given)) {
    // Who types a password here has forgotten the name of its field.
    const what = hasSecret(shape) ? 'is none' : `is ${shown(given)}`
    refuse(
      path,
      `${what}; ${path.length === 0 ? `the message of ${place.title}` : 'it'} is an object with ${namesOf(shape)}`,
    )
  }
  for (const name of Object.keys(given)) checkName(shape, name, path)
  const fields = Object.entries(shape).filter(([name, field]) => isWanted(field, given[name]))
  return Object.fromEntries(
    fields.map(([name, field]) => [name, fromJson(shape, name, field, given[name], [...path, name], place)]),
  )
}

/** A field that may be left out and is, is not asked for. */
function isWanted(field: Field, given: unknown): boolean {
  if (!isVisible(field)) return false
  return given !== undefined || !('default' in field) || field.default === undefined
}

function checkName(shape: Shape, name: string, path: Path): void {
  const field = Object.hasOwn(shape, name) ? shape[name] : undefined
  if (field !== undefined && isVisible(field)) return
  const reason = field === undefined ? 'is not a field of this message' : 'is filled in by itself: leave it out'
  refuse([...path, name], `${reason}; it has ${namesOf(shape)}`)
}

function fromJson(shape: Shape, name: string, field: Field, given: unknown, path: Path, place: Place): unknown {
  const expected = (): never => {
    // A password that is of a wrong kind is one all the same.
    const what = given === undefined ? 'is missing' : hasSecret({ [name]: field }) ? 'is wrong' : `is ${shown(given)}`
    refuse(path, `${what}; it takes ${takesOf(shape, name)}`)
  }
  switch (field.kind) {
    case 'u8':
    case 'u16':
    case 'u32':
      return numberFromJson(given) ?? expected()
    case 'words':
    case 'doubleWords':
      return elements(given, expected, path, numberFromJson, takesOf(shape, name))
    case 'bits':
      return elements(given, expected, path, bitFromJson, takesOf(shape, name))
    case 'bytes':
    case 'rest':
      return bytesFromJson(given, expected, path, takesOf(shape, name))
    case 'text':
      return typeof given === 'string' ? given : expected()
    case 'list':
      return Array.isArray(given)
        ? Array.from(given, (element: unknown, i) => bagFromJson(field.item, element, [...path, i], place))
        : expected()
    case 'value':
      if (given === undefined || given === null) return expected()
      return place.values.read(field, given, path.join('.'))
    default:
      // Only in answers, or filled in by themselves.
      return expected()
  }
}

function elements<T>(
  given: unknown,
  expected: () => never,
  path: Path,
  one: (given: unknown) => T | undefined,
  takes = '',
): T[] {
  const list = Array.isArray(given) || isNumbers(given) ? Array.from<unknown>(given) : expected()
  return list.map((element, i) => {
    const found = one(element)
    return found === undefined ? refuse([...path, i], `is ${shown(element)}; ${path.at(-1)} takes ${takes}`) : found
  })
}

/** A typed array of a program; a DataView has no elements. */
function isNumbers(given: unknown): given is ArrayLike<number> {
  return ArrayBuffer.isView(given) && 'length' in given
}

/** JSON has no hexadecimal and no octal numbers, and the manuals write addresses and numbers of modules in them. */
function numberFromJson(given: unknown): number | undefined {
  if (typeof given === 'string') return /^(0x[0-9a-f]{1,8}|0o[0-7]{1,11})$/i.test(given) ? Number(given) : undefined
  return typeof given === 'number' && Number.isInteger(given) ? given : undefined
}

function bitFromJson(given: unknown): boolean | undefined {
  if (typeof given === 'boolean') return given
  return given === 1 || given === 0 ? given === 1 : undefined
}

function bytesFromJson(given: unknown, expected: () => never, path: Path, takes: string | undefined): Uint8Array {
  if (typeof given !== 'string') return Uint8Array.from(elements(given, expected, path, byteFromJson, takes))
  const digits = given.replaceAll(' ', '')
  return /^([0-9a-f]{2})*$/i.test(digits) ? Buffer.from(digits, 'hex') : expected()
}

function byteFromJson(given: unknown): number | undefined {
  const number = numberFromJson(given)
  return number !== undefined && number >= 0 && number <= 0xff ? number : undefined
}

type ToJson = Parameters<typeof jsonOfMessage>[2]

function bagToJson(shape: Shape, message: object, options: ToJson): Record<string, unknown> {
  const given: Readonly<Record<string, unknown>> = { ...message }
  const fields = Object.entries(shape).filter(([name, field]) => {
    if (!isVisible(field) || given[name] === undefined) return false
    return options.secrets === true || field.kind === 'list' || !hasSecret({ [name]: field })
  })
  return Object.fromEntries(fields.map(([name, field]) => [name, toJson(field, given[name], options)]))
}

function toJson(field: Field, value: unknown, options: ToJson): unknown {
  if (field.kind === 'bytes' || field.kind === 'rest')
    return value instanceof Uint8Array ? Buffer.from(value).toString('hex') : value
  if (field.kind === 'list') {
    return Array.isArray(value) ? value.map((element: object) => bagToJson(field.item, element, options)) : value
  }
  if (field.kind === 'each') {
    return Array.isArray(value) ? value.map((part: unknown) => toJson(field.item, part, options)) : value
  }
  const shownValue = field.kind === 'value' ? options.values.show(field, value) : value
  return isNumbers(shownValue) ? Array.from(shownValue) : shownValue
}

function isObject(given: unknown): given is Readonly<Record<string, unknown>> {
  // Also objects of another realm, as the sandbox of a Node-RED function node makes them.
  return Object.prototype.toString.call(given) === '[object Object]'
}

function refuse(path: Path, reason: string): never {
  const field = path.join('.')
  if (field === '') throw new RequestError('BAD_MESSAGE', `The message ${reason}.`)
  throw new RequestError('BAD_MESSAGE', `${field}: ${reason}.`, field)
}

function shown(given: unknown): string {
  if (given === undefined) return 'missing'
  if (typeof given === 'string') return JSON.stringify(given.slice(0, 40))
  if (typeof given === 'object' && given !== null) return Array.isArray(given) ? 'an array' : 'an object'
  return typeof given === 'function' ? 'a function' : String(given)
}
