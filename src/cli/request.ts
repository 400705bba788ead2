import { answerToJson, commandNamed, describeCommand, type FieldDescription } from '../entry/codec'
import { createMelsecClient, RequestError, type RequestExplanation } from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import { addConnectionOptions, type ConnectionOptions, clientOptions, peerText, withClient } from './connection-options'
import { exitCodes } from './exit-code'
import { json } from './output'
import { refusalOf, type Terminal } from './terminal'

const examples = [
  'request readTypeName --plc 192.168.3.39:5010 --profile iq-r',
  `request readWords '{"head":"D100","points":2}' --plc 192.168.3.39:5010 --profile iq-r`,
  `request writeRandomBits '{"bits":[{"device":"M0","value":true}]}' --plc 192.168.3.39:5010 --profile iq-r`,
]

type RequestOptions = ConnectionOptions & { readonly yes?: boolean }

/** `melsec-jw request` */
export const requestCommand: MakeCommand = (run) => {
  const command = newCommand('request', 'send any command of the manuals, its message as JSON', examples)
    .description(
      'Send any declared command, by its name or its code, with its message as JSON; the answer is printed as JSON. ' +
        '"melsec-jw commands readWords" tells what a message holds. What writes or controls is asked about before.',
    )
    .argument('<command>', 'name of the command (readWords), or its code (1617) when it alone has it')
    .argument('[message]', 'its message as JSON; - reads it from the standard input', '{}')
    .optionsGroup('Writing and controlling:')
    .option('-y, --yes', 'do not ask')
  addConnectionOptions(command)
  return command.action((name: string, message: string, options: RequestOptions) =>
    perform(run, options, () => request(run.terminal, name, message, options)),
  )
}

async function request(terminal: Terminal, name: string, text: string, options: RequestOptions): Promise<number> {
  const command = commandNamed(name)
  const { request } = describeCommand(command)
  const piped = text === '-'
  const message = parsed(piped ? await terminal.input() : text)
  if (!piped) refuseSecrets(request, message)
  const explanation = createMelsecClient(clientOptions(options)).explainRequest(command.name, message)
  const { effect } = explanation
  if (effect === 'write' || effect === 'control') {
    const refusal = await refusalOf(terminal, options.yes === true, questionOf(explanation, options))
    if (refusal !== undefined) throw new RequestError('NOT_PERMITTED', `Nothing was sent. ${refusal}`, '--yes')
  }
  const allow = { allowWrites: effect === 'write', allowControl: effect === 'control' }
  const answer = await withClient(terminal, options, allow, async (client) =>
    answerToJson(command, await client.requestByName(command.name, message), client.notation),
  )
  terminal.out(json(answer))
  return exitCodes.ok.code
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text)
  } catch {
    // Not the text, nor what JSON.parse shows of it: there may be a password in it.
    throw new RequestError(
      'BAD_MESSAGE',
      'The message is no JSON. In a shell put it in single quotes, e.g. \'{"head":"D100","points":2}\'.',
      'message',
    )
  }
}

/** Everybody on the computer sees the arguments of a program. */
function refuseSecrets(fields: readonly FieldDescription[], message: unknown): void {
  const secret = fields.find(({ name, secret }) => secret === true && Object.hasOwn(Object(message), name))
  if (secret === undefined) return
  throw new RequestError(
    'BAD_OPTION',
    `${secret.name}: a password must not be an argument, because everybody on the computer sees those. ` +
      'Give - as the message, and the message by the standard input.',
    secret.name,
  )
}

function questionOf({ title, message }: RequestExplanation, options: RequestOptions): string {
  return `${title} to ${peerText(options)}: ${JSON.stringify(message)}`
}
