/**
 * Messages of declared commands as JSON, for everything that is typed: command line, nodes, configuration files.
 *
 * | field                                | in JSON                                                                   |
 * |--------------------------------------|---------------------------------------------------------------------------|
 * | number                               | number, or its hexadecimal or octal digits as text: `"0x1F"`, `"0o37"`    |
 * | words, double words                  | array of such numbers                                                     |
 * | bits                                 | array of `true` and `false`, or of 1 and 0                                |
 * | bytes                                | text of hexadecimal digits, or array of numbers; a Buffer too             |
 * | text                                 | text                                                                      |
 * | device                               | text as GX Works shows it (`"D100"`, `"U3\\G0"`), or the object it stands for |
 * | list                                 | array of objects                                                          |
 * | any other value                      | as it is                                                                  |
 */
import { encode, type JsonValues, jsonOfMessage, messageOfJson, type Shape, writerOf } from '../../codec/codec'
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
  const message = messageOfJson(command.request, json, { values: valuesIn(notation), title: command.title })
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
  return toJson(command.request, message, options)
}

/** The answer to a request as JSON: words as numbers, bytes as hexadecimal digits, without passwords. */
export function answerToJson(command: Command, answer: object, options: ToJsonOptions = {}): Record<string, unknown> {
  return toJson(command.response, answer, options)
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

function toJson(shape: Shape, message: object, options: ToJsonOptions): Record<string, unknown> {
  const { secrets = false } = options
  return jsonOfMessage(shape, message, { values: valuesIn(options), secrets })
}

/** Devices are the text an engineer types, or the object it stands for. */
function valuesIn(notation: Notation): JsonValues {
  return {
    read: (field, given, path) => (isDevice(field) ? deviceFromJson(given, path, notation) : given),
    show: (field, value) => (isDevice(field) ? deviceToJson(value, notation) : value),
  }
}
