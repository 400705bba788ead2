// What programs without types pass: looked at before anything is done with it.

import { isPlainObject } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { effects } from '../../codec/codec'
import { RequestError } from '../../errors'
import type { Command } from '../../melsec/commands/command'
import { FORM_BITS } from '../../melsec/device/form'
import { badAddress, type Item } from './parts'

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

function isEffect(given: unknown): boolean {
  return effects.some((effect) => effect === given)
}

/** @throws RequestError BAD_MESSAGE or BAD_OPTION */
export function checkRequest(command: Command, message: unknown, form: unknown): void {
  if (!isPlainObject(command) || !isEffect(command.effect) || !isPlainObject(command.request)) {
    throw new RequestError('BAD_MESSAGE', 'request() takes a declared command, e.g. commands.readWords.', 'command')
  }
  if (command.sender === 'plc') {
    const message = `${command.title} is sent by the PLC and cannot be requested: listen with on('onDemand').`
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
