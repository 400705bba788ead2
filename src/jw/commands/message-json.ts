/**
 * Messages of the commands of a Sharp JW as JSON, as they are typed and shown. As those of MELSEC, but for addresses:
 *
 * | field     | in JSON                                                                                              |
 * |-----------|------------------------------------------------------------------------------------------------------|
 * | address   | the operand of a byte as text (`"09012"`, `"KO0403"`, `"F1:00001234"`), or the object it stands for   |
 * | number    | number, or its octal or hexadecimal digits as text: `"0o3777"`, `"0x1F"`                             |
 */
import {
  encode,
  type Field,
  type JsonValues,
  jsonOfMessage,
  type MessageInput,
  messageOfJson,
  type Shape,
  writerOf,
} from '../../codec/codec'
import { RequestError } from '../../errors'
import { FILE_REGISTERS, type JwAddress, PAGE } from '../address'
import { jwAddress, jwExtendedAddress } from '../address-codec'
import { jwKind } from '../operand/kind'
import type { JwOperandOptions } from '../operand/map'
import { formatJwOperand } from '../operand/notation'
import { parseJwOperand } from '../operand/parse'
import { jwAddressOf, placeOfJw } from '../operand/place'
import type { JwCommand } from './commands'

/**
 * The message of a request out of JSON, all of it checked.
 * @throws RequestError naming the field, what is wrong with it and what it takes
 * @example jwMessageFromJson(jwCommands.readDataMemory, { head: '09000', length: 4 })
 */
export function jwMessageFromJson<C extends JwCommand>(
  command: C,
  json: unknown,
  options: JwOperandOptions = {},
): MessageInput<C['request']> {
  const request: Shape = command.request
  const message = messageOfJson(request, json, { values: valuesIn(options), title: command.title })
  encode<Shape>(request, message, writerOf('binary'))
  return message as MessageInput<C['request']>
}

/** The message of a request as JSON that `jwMessageFromJson` makes the same message of, without passwords. */
export function jwMessageToJson<C extends JwCommand>(
  command: C,
  message: MessageInput<C['request']>,
): Record<string, unknown> {
  return jsonOfMessage(command.request, message, { values: valuesIn({}) })
}

/** The answer to a request as JSON: bytes as hexadecimal digits, addresses as operands. */
export function jwAnswerToJson(command: JwCommand, answer: object): Record<string, unknown> {
  return jsonOfMessage(command.response, answer, { values: valuesIn({}) })
}

function valuesIn(options: JwOperandOptions): JsonValues {
  return {
    read: (field, given, path) => (isAddress(field) ? addressFromJson(field, given, path, options) : given),
    show: (field, value) => (isAddress(field) ? jwAddressToJson(value) : value),
  }
}

function isAddress(field: Field): boolean {
  return field.kind === 'value' && (isExtended(field) || field.codec === jwAddress)
}

function isExtended(field: Field): boolean {
  return field.kind === 'value' && field.codec === jwExtendedAddress
}

/** @throws RequestError whose field is the path */
function addressFromJson(field: Field, given: unknown, path: string, options: JwOperandOptions): unknown {
  if (typeof given !== 'string') return given
  try {
    return addressOf(given, isExtended(field) ? 'extended' : 'basic', options)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    throw new RequestError(error.code, `${path}: ${error.message}`, path)
  }
}

function addressOf(text: string, form: 'basic' | 'extended', options: JwOperandOptions): JwAddress {
  const operand = parseJwOperand(text, options)
  const place = placeOfJw(operand, options)
  if (place.in !== 'file' || place.bit !== undefined) {
    const { title } = jwKind(operand.kind)
    const what = operand.bit === undefined ? `a ${title}` : 'a bit'
    throw new RequestError(
      'BAD_ADDRESS',
      `${JSON.stringify(text)} is ${what}; a command takes the byte of a file, e.g. 09012, KO0403 or F1:00001234.`,
    )
  }
  // The basic form of a byte behind 64 KiB names another file, which on a JW30H holds another byte.
  const isBehind = place.file === FILE_REGISTERS && place.address >= PAGE
  return jwAddressOf(place, isBehind ? 'extended' : form)
}

/**
 * The operand of a byte in a file, where an address is one.
 * @example jwAddressToJson({ file: 0, address: 0o4000 })   // 'F0:004000'
 */
export function jwAddressToJson(value: unknown): unknown {
  if (!isJwAddress(value)) return value
  const { file, address: number } = value
  return formatJwOperand({ kind: 'F', file, number })
}

function isJwAddress(value: unknown): value is JwAddress {
  return typeof value === 'object' && value !== null && 'file' in value && 'address' in value
}
