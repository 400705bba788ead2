// Requests of declared commands by name, with messages as they are typed: JSON.
import { shown } from '../../basics/show'
import type { Effect } from '../../codec/codec'
import { RequestError } from '../../errors'
import { jwCommandNamed } from '../../jw/commands/command-name'
import type { JwCommand, JwCommandName } from '../../jw/commands/commands'
import { jwMessageFromJson, jwMessageToJson } from '../../jw/commands/message-json'
import type { JwOperandOptions } from '../../jw/operand/map'
import type { JwRequestOf } from './send-command'

/** What a request is going to be: nothing of it was sent. */
export interface JwRequestExplanation {
  /** Name of the command, e.g. `readDataMemory`. */
  readonly name: JwCommandName
  /** As the manual calls it. */
  readonly title: string
  /** `write` needs `allowWrites`, `control` `allowControl`, `configure` `allowParameters`. */
  readonly effect: Effect
  /** As JSON, addresses as operands, without passwords. */
  readonly message: Readonly<Record<string, unknown>>
}

/** A command with its message. */
export interface NamedJwRequest {
  readonly command: JwCommand
  readonly message: JwRequestOf<JwCommand>
}

/** @throws RequestError */
export function namedJwRequest(name: string, json: unknown, options: JwOperandOptions): NamedJwRequest {
  if (typeof name !== 'string') {
    throw new RequestError(
      'BAD_OPTION',
      `A command is its name, such as readDataMemory, not ${shown(name)}.`,
      'command',
    )
  }
  const command = jwCommandNamed(name)
  return { command, message: jwMessageFromJson(command, json, options) }
}

export function explainJwRequest({ command, message }: NamedJwRequest): JwRequestExplanation {
  const { name, title, effect } = command
  return { name, title, effect, message: jwMessageToJson(command, message) }
}
