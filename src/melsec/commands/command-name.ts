// Declared commands by what people call them, and what their messages take.
import { hex } from '../../basics/hex'
import { exampleOf, type FieldDescription, describe as rowsOf, type Shape } from '../../codec/codec'
import { RequestError } from '../../errors'
import type { DeviceAddress } from '../device/device'
import { deviceToJson } from '../device/json'
import { isDevice } from '../device-field'
import type { Command } from './command'
import { type CommandName, commands } from './commands'

/**
 * The command of a name (`readWords`, in upper or lower case) or a code (`0401`, when one command alone has it).
 * @throws RequestError BAD_OPTION with the commands there are
 * @example commandNamed('1617').title   // Clear Error
 */
export function commandNamed(text: string): Command & { readonly name: CommandName } {
  const wanted = String(text).trim()
  const list = Object.values(commands)
  const named = list.find(({ name }) => name.toLowerCase() === wanted.toLowerCase())
  if (named !== undefined) return named
  const code = /^(?:0x)?([0-9a-f]{4})h?$/i.exec(wanted)?.[1]
  const coded = code === undefined ? [] : list.filter((command) => command.code === Number.parseInt(code, 16))
  const [first, ...more] = coded
  if (first !== undefined && more.length === 0) return first
  const names = (first === undefined ? list : coded).map(({ name }) => name).join(', ')
  const shown = JSON.stringify(wanted.slice(0, 40))
  throw new RequestError(
    'BAD_OPTION',
    first === undefined ? `There is no command ${shown}. There are ${names}.` : `${shown} is ${names}: say which.`,
    'command',
  )
}

/** @example nameOfCommand(commands.readTypeName)   // Read Type Name (0101) */
export function nameOfCommand({ title, code }: Pick<Command, 'title' | 'code'>): string {
  return `${title} (${hex(code, 4)})`
}

/** A command for people: what its message and its answer hold, and an example. */
export interface CommandDescription {
  /** Name of the command, e.g. `readWords`. */
  readonly name: CommandName
  /** The manual's name, English edition. */
  readonly title: string
  /** Four hexadecimal digits. */
  readonly code: string
  /** What it does to the PLC. */
  readonly effect: Command['effect']
  /** Where it is described. */
  readonly manual: string
  /** `connected`: it goes to the connected station, whatever the route. */
  readonly to?: 'connected'
  /** The command whose message must be given too: the registration of Execute Monitor. */
  readonly context?: string
  /** Fields of its request. */
  readonly request: readonly FieldDescription[]
  /** Fields of its answer. */
  readonly response: readonly FieldDescription[]
  /** A message as JSON. */
  readonly example: Readonly<Record<string, unknown>>
}

/** @example describeCommand(commands.readWords).example   // { head: 'D100', points: 1 } */
export function describeCommand({ name, title, code, effect, manual, ...command }: Command): CommandDescription {
  const { context, request, response, to } = command
  const asked: Command | undefined = Object.values<Command>(commands).find((other) => other.name === context)
  const example = exampleMessage(command.unit, request)
  return {
    name: commandNamed(name).name,
    title,
    code: hex(code, 4),
    effect,
    manual,
    ...(to === undefined ? {} : { to }),
    ...(context === undefined ? {} : { context }),
    request: rowsOf(request).filter(isShown),
    response: rowsOf(response).filter(isShown),
    example: asked === undefined ? example : { [asked.name]: exampleMessage(asked.unit, asked.request), ...example },
  }
}

function isShown({ takes }: FieldDescription): boolean {
  return takes !== undefined
}

function exampleMessage(unit: Command['unit'], request: Shape): Readonly<Record<string, unknown>> {
  return exampleOf(request, (field, path) => {
    const { example } = field.codec
    if (!isDevice(field)) return example ?? null
    const bits: DeviceAddress = { device: 'M', number: 100 }
    return deviceToJson(unit === 'bit' || path.some((name) => name.startsWith('bit')) ? bits : example, {})
  })
}
