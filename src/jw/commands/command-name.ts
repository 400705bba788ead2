// The commands of a Sharp JW by what people call them, and what their messages take.
import { hex } from '../../basics/hex'
import { type Effect, exampleOf, type FieldDescription, describe as rowsOf, type Shape } from '../../codec/codec'
import { RequestError } from '../../errors'
import type { JwCommandConfidence, JwDeclaration, JwModel } from './command'
import { type JwCommand, type JwCommandName, jwCommands } from './commands'
import { jwAddressToJson } from './message-json'

const list = Object.values<JwCommand>(jwCommands)

/**
 * The command of a name (`readDataMemory`, in upper or lower case) or a code (`24`, COM of the manual).
 * @throws RequestError BAD_OPTION with the commands there are
 * @example jwCommandNamed('24H').title   // Read data memory
 */
export function jwCommandNamed(text: string): JwCommand {
  const wanted = String(text).trim()
  const named = list.find(({ name }) => name.toLowerCase() === wanted.toLowerCase())
  const code = /^(?:0x)?([0-9a-f]{2})h?$/i.exec(wanted)?.[1]
  const found = named ?? list.find((command) => code !== undefined && command.code === Number.parseInt(code, 16))
  if (found !== undefined) return found
  const shown = JSON.stringify(wanted.slice(0, 40))
  const names = list.map(({ name }) => name).join(', ')
  throw new RequestError('BAD_OPTION', `A Sharp JW has no command ${shown}. There are ${names}.`, 'command')
}

/** A command of a Sharp JW for people: what its message and its answer hold, and an example. */
export interface JwCommandDescription {
  /** Name of the command, e.g. `readDataMemory`. */
  readonly name: JwCommandName
  /** As the manual calls it. */
  readonly title: string
  /** Two hexadecimal digits: COM of the manual. */
  readonly code: string
  /** What it does to the PLC. */
  readonly effect: Effect
  /** Where it is described. */
  readonly manual: string
  /** What stands behind it. */
  readonly confidence: JwCommandConfidence
  /** What no source says. */
  readonly open?: string
  /** Who has it, when not all. */
  readonly models?: readonly JwModel[]
  /** Fields of its request. */
  readonly request: readonly FieldDescription[]
  /** Fields of its answer. */
  readonly response: readonly FieldDescription[]
  /** A message as JSON. */
  readonly example: Readonly<Record<string, unknown>>
}

/** @example describeJwCommand(jwCommands.readDataMemory).example   // { head: 'F0:004000', length: 1 } */
export function describeJwCommand(command: JwCommand): JwCommandDescription {
  const { name, title, code, effect, manual, confidence, open, models }: JwDeclaration & { name: JwCommandName } =
    command
  const { request, response }: { request: Shape; response: Shape } = command
  return {
    name,
    title,
    code: hex(code, 2),
    effect,
    manual,
    confidence,
    ...(open === undefined ? {} : { open }),
    ...(models === undefined ? {} : { models }),
    request: rowsOf(request).filter(isShown),
    response: rowsOf(response).filter(isShown),
    example: exampleOf(request, ({ codec }) => jwAddressToJson(codec.example ?? null)),
  }
}

function isShown({ takes }: FieldDescription): boolean {
  return takes !== undefined
}
