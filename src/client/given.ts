// What programs without types pass: looked at before anything is done with it.
import { effects } from '../codec/declaration'
import { RequestError } from '../errors'
import type { Command } from '../melsec/command'
import { FORM_BITS } from '../melsec/form'
import { show } from '../value/fault'
import { badAddress, type Item } from './item'

/** Also objects of another realm, as the sandbox of a Node-RED function node makes them. */
function isPlainObject(given: unknown): given is Readonly<Record<string, unknown>> {
  return Object.prototype.toString.call(given) === '[object Object]'
}

/** A value in a message about an option: short, and of whatever kind it is. */
export function shown(given: unknown): string {
  return typeof given === 'string' ? given.slice(0, 40) : show(given)
}

export function isItem(given: unknown): given is Item {
  return (
    typeof given === 'string' ||
    (typeof given === 'object' && given !== null && typeof (given as { address?: unknown }).address === 'string')
  )
}

export function isList<T>(given: readonly T[] | Readonly<Record<string, unknown>>): given is readonly T[] {
  return Array.isArray(given)
}

/** The elements of a list; a hole is an element too. @throws RequestError */
export function listOf<T>(given: readonly T[], what: string): readonly T[] {
  if (Array.isArray(given)) return Array.from<T>(given)
  throw new RequestError('BAD_ADDRESS', `A list of ${what} is an array, not ${shown(given)}.`)
}

/** The names of an object. @throws RequestError */
export function namesOf(given: object, what: string): readonly string[] {
  if (isPlainObject(given)) return Object.keys(given)
  throw new RequestError('BAD_ADDRESS', `${what}, not ${shown(given)}.`)
}

/**
 * As `namesOf`, where one item may stand instead: `{ address: 5 }` is meant as an item and not as a name for one.
 * @throws RequestError
 */
export function namesOfItems(given: object, what: string): readonly string[] {
  const names = namesOf(given, what)
  const { address }: { readonly address?: unknown } = given
  if (!names.includes('address') || (typeof address === 'object' && address !== null)) return names
  throw badAddress(address)
}

/**
 * A misspelt option would be the usual one, without anybody noticing.
 * @param prefix where the options stand: `''`, or e.g. `reconnect.`
 * @throws RequestError BAD_OPTION for a name that is not among them, and for what is no object
 */
export function checkNames(prefix: string, given: object, names: Readonly<Record<string, true>>): void {
  const list = Object.keys(names).join(', ')
  if (!isPlainObject(given)) {
    const what = prefix === '' ? 'Options are' : `${prefix.slice(0, -1)} is`
    throw new RequestError('BAD_OPTION', `${what} an object with ${list}; not ${shown(given)}.`)
  }
  for (const name of Object.keys(given)) {
    if (Object.hasOwn(names, name)) continue
    const field = `${prefix}${name}`
    throw new RequestError('BAD_OPTION', `There is no option ${field}: use ${list}.`, field)
  }
}

/** @throws RequestError BAD_OPTION when an option is there and no boolean */
export function checkBooleans<Options extends object>(
  given: Options,
  names: readonly (keyof Options & string)[],
): void {
  for (const name of names) {
    const value: unknown = given[name]
    if (value === undefined || typeof value === 'boolean') continue
    throw new RequestError('BAD_OPTION', `${name} is ${shown(value)}; it must be true or false.`, name)
  }
}

function isEffect(given: unknown): boolean {
  return effects.some((effect) => effect === given)
}

/** @throws RequestError BAD_MESSAGE or BAD_OPTION */
export function checkRequest(command: Command, message: unknown, form: unknown): void {
  if (!isPlainObject(command) || !isEffect(command.effect) || !isPlainObject(command.request)) {
    throw new RequestError('BAD_MESSAGE', 'request() takes a declared command, e.g. commands.readWords.', 'command')
  }
  if (command.sender === 'plc') {
    const message = `${command.title} is sent by the PLC and cannot be requested: listen with on('ondemand').`
    throw new RequestError('UNSUPPORTED', message, 'command')
  }
  if (!isPlainObject(message)) {
    throw new RequestError(
      'BAD_MESSAGE',
      `The message of ${command.title} is an object, not a value of type ${typeof message}.`,
    )
  }
  if (form === undefined || (typeof form === 'string' && Object.hasOwn(FORM_BITS, form))) return
  const forms = Object.keys(FORM_BITS).join(', ')
  throw new RequestError('BAD_OPTION', `form is ${shown(form)}; it must be one of ${forms}.`, 'form')
}
