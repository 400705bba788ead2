// Requests of declared commands by name, with messages as they are typed: JSON.

import type { OptionNames } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { RequestError } from '../../errors'
import type { Command, RequestOf } from '../../melsec/commands/command'
import { commandNamed } from '../../melsec/commands/command-name'
import type { CommandName } from '../../melsec/commands/commands'
import { messageFromJson, messageToJson } from '../../melsec/commands/message-json'
import type { Notation } from '../../melsec/device/json'
import type { ExchangeOptions } from '../../melsec/protocol'

export const FORM_OPTION: OptionNames<Pick<ExchangeOptions, 'form'>> = { form: true }
export const EXCHANGE_OPTIONS: OptionNames<ExchangeOptions> = { ...FORM_OPTION, subcommand: true, context: true }

/** A command with its message. */
export interface NamedRequest {
  readonly command: Command
  readonly message: RequestOf<Command>
  /** What the PLC must be told before, on the same connection: the registration of Execute Monitor. */
  readonly before?: { readonly command: Command; readonly message: RequestOf<Command> }
}

/** What a request is going to be: nothing of it was sent. */
export interface RequestExplanation {
  /** Name of the command, e.g. `readWords`. */
  readonly name: CommandName
  /** The manual's name, English edition. */
  readonly title: string
  /** `write` needs `allowWrites`, `control` needs `allowControl`. */
  readonly effect: Command['effect']
  /** As JSON, addresses as texts, without passwords. */
  readonly message: Readonly<Record<string, unknown>>
}

/**
 * @param name name or code of the command
 * @param json its message; of Execute Monitor also `entryMonitorDevice`, the message of the registration it reads
 * @throws RequestError
 */
export function namedRequest(name: string, json: unknown, notation: Notation): NamedRequest {
  if (typeof name !== 'string') {
    throw new RequestError('BAD_OPTION', `A command is its name, such as readWords, not ${shown(name)}.`, 'command')
  }
  const command: Command = commandNamed(name)
  const { context } = command
  if (context === undefined) return { command, message: messageFromJson(command, json, notation) }
  const { [context]: registration, ...rest } = Object(json) as Record<string, unknown>
  if (registration === undefined) {
    throw new RequestError(
      'BAD_MESSAGE',
      `${context}: is missing; ${command.title} reads what a registration names, so it takes the message of ${context} too.`,
      context,
    )
  }
  const registering: Command = commandNamed(context)
  return {
    command,
    message: messageFromJson(command, rest, notation),
    before: {
      command: registering,
      message: inside(context, () => messageFromJson(registering, registration, notation)),
    },
  }
}

/** @throws RequestError whose field is a path from the outer message on */
function inside<T>(name: string, work: () => T): T {
  try {
    return work()
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    const field = error.field === undefined ? name : `${name}.${error.field}`
    throw new RequestError(error.code, `${name}.${error.message}`, field)
  }
}

export function explainRequest({ command, message, before }: NamedRequest, notation: Notation): RequestExplanation {
  const json = messageToJson(command, message, notation)
  return {
    name: commandNamed(command.name).name,
    title: command.title,
    effect: command.effect,
    message:
      before === undefined
        ? json
        : { [before.command.name]: messageToJson(before.command, before.message, notation), ...json },
  }
}
