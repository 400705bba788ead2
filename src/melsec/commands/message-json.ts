/**
 * Messages of declared commands as JSON, for everything that is typed: command line, nodes, configuration files.
 *
 * | field                                | in JSON                                                                   |
 * |--------------------------------------|---------------------------------------------------------------------------|
 * | number                               | number, or its hexadecimal digits as text: `"0x1F"`                       |
 * | words, double words                  | array of such numbers                                                     |
 * | bits                                 | array of `true` and `false`, or of 1 and 0                                |
 * | bytes                                | text of hexadecimal digits, or array of numbers; a Buffer too             |
 * | text                                 | text                                                                      |
 * | device                               | text as GX Works shows it (`"D100"`, `"U3\\G0"`), or the object it stands for |
 * | list                                 | array of objects                                                          |
 * | any other value                      | as it is                                                                  |
 */
import { encode, type Field, hasSecret, isVisible, namesOf, type Shape, takesOf, writerOf } from '../../codec/codec'
import { RequestError } from '../../errors'
import { FORM_EXTENDED, FORM_LONG } from '../device/codec'
import { deviceFromJson, deviceToJson, type Notation } from '../device/json'
import { isDevice } from '../device-field'
import type { Command, RequestOf } from './command'

/** How a message is written as JSON. */
export interface ToJsonOptions extends Notation {
  /** Passwords too. Without it fields that hold one are left out. */
  readonly secrets?: boolean
}

/** Everything an address can say, in one form: what does not fit it fits none. */
const ANY_FORM = FORM_LONG | FORM_EXTENDED

/**
 * The message of a request out of JSON. All of it is checked: names, kinds, ranges, number of elements.
 * What only a family of PLCs limits is checked when it is sent.
 * @throws RequestError naming the field, what is wrong with it and what it takes
 * @example messageFromJson(commands.readWords, { head: 'D100', points: 2 }, { xyRadix: 16 })
 */
export function messageFromJson<C extends Command>(command: C, json: unknown, notation: Notation = {}): RequestOf<C> {
  const message = bagFromJson(command.request, json, [], { notation, title: command.title })
  checkMessage(command, message)
  return message as RequestOf<C>
}

/**
 * The message of a request as JSON that `messageFromJson` makes the same message of.
 * @example messageToJson(commands.readWords, { head: { device: 'D', number: 100 }, points: 2 }, { xyRadix: 16 })
 */
export function messageToJson<C extends Command>(
  command: C,
  message: RequestOf<C>,
  options: ToJsonOptions = {},
): Record<string, unknown> {
  return bagToJson(command.request, message, options)
}

/** The answer to a request as JSON: words as numbers, bytes as hexadecimal digits, without passwords. */
export function answerToJson(command: Command, answer: object, options: ToJsonOptions = {}): Record<string, unknown> {
  return bagToJson(command.response, { ...answer }, options)
}

/** What one of the command's forms can say can be sent to some PLC. */
function checkMessage({ request, subcommands = [ANY_FORM] }: Command, message: Record<string, unknown>): void {
  let problem: unknown
  for (const form of subcommands) {
    try {
      encode<Shape>(request, message, writerOf('binary', form))
      return
    } catch (error) {
      problem ??= error
    }
  }
  throw problem
}

interface Place {
  readonly notation: Notation
  /** Of the command. */
  readonly title: string
}
type Path = readonly (string | number)[]

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
      return bytesFromJson(given, expected, path, takesOf(shape, name))
    case 'text':
      return typeof given === 'string' ? given : expected()
    case 'list':
      return Array.isArray(given)
        ? Array.from(given, (element: unknown, i) => bagFromJson(field.item, element, [...path, i], place))
        : expected()
    case 'value':
      if (given === undefined || given === null) return expected()
      return isDevice(field) ? deviceFromJson(given, path.join('.'), place.notation) : given
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

/** JSON has no hexadecimal numbers, and the manuals write addresses and numbers of modules in them. */
function numberFromJson(given: unknown): number | undefined {
  if (typeof given === 'string') return /^0x[0-9a-f]{1,8}$/i.test(given) ? Number.parseInt(given, 16) : undefined
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

function bagToJson(shape: Shape, message: object, options: ToJsonOptions): Record<string, unknown> {
  const given: Readonly<Record<string, unknown>> = { ...message }
  const fields = Object.entries(shape).filter(([name, field]) => {
    if (!isVisible(field) || given[name] === undefined) return false
    return options.secrets === true || field.kind === 'list' || !hasSecret({ [name]: field })
  })
  return Object.fromEntries(fields.map(([name, field]) => [name, toJson(field, given[name], options)]))
}

function toJson(field: Field, value: unknown, options: ToJsonOptions): unknown {
  if (field.kind === 'bytes') return value instanceof Uint8Array ? Buffer.from(value).toString('hex') : value
  if (field.kind === 'list') {
    return Array.isArray(value) ? value.map((element: object) => bagToJson(field.item, element, options)) : value
  }
  if (field.kind === 'each') {
    return Array.isArray(value) ? value.map((part: unknown) => toJson(field.item, part, options)) : value
  }
  if (isDevice(field)) return deviceToJson(value, options)
  return isNumbers(value) ? Array.from(value) : value
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
