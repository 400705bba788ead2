// Options as programs without types pass them: looked at before anything is done with them.
import { RequestError } from '../errors'
import { shown } from './show'

/** Names of options, each once: the type sees to it that none is missing. */
export type OptionNames<Options> = Readonly<Record<keyof Options, true>>

/** Also objects of another realm, as the sandbox of a Node-RED function node makes them. */
export function isPlainObject(given: unknown): given is Readonly<Record<string, unknown>> {
  return Object.prototype.toString.call(given) === '[object Object]'
}

/** @throws RequestError BAD_OPTION, always */
export function badOption(field: string, message: string): never {
  throw new RequestError('BAD_OPTION', message, field)
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
    badOption(field, `There is no option ${field}: use ${list}.`)
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
    badOption(name, `${name} is ${shown(value)}; it must be true or false.`)
  }
}

/** @throws RequestError BAD_OPTION when it is no whole number of the range */
export function wholeNumber(field: string, value: number, min: number, max = Number.MAX_SAFE_INTEGER): number {
  if (Number.isInteger(value) && value >= min && value <= max) return value
  const range = max === Number.MAX_SAFE_INTEGER ? `of at least ${min}` : `from ${min} to ${max}`
  return badOption(field, `${field} is ${shown(value)}; it must be a whole number ${range}.`)
}

/** @throws RequestError BAD_OPTION when it is none of the values */
export function oneOf<const T>(field: string, value: T, values: readonly T[]): T {
  if (values.includes(value)) return value
  return badOption(field, `${field} is ${shown(value)}; it must be ${values.map(String).join(' or ')}.`)
}
