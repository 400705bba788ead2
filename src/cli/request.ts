import {
  answerToJson,
  commandNamed,
  describeCommand,
  describeJwCommand,
  type FieldDescription,
  jwAnswerToJson,
  jwCommandNamed,
  jwMessageFromJson,
  jwMessageToJson,
} from '../entry/codec'
import { type Effect, type JwClient, type MelsecClient, RequestError } from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import { type AnyConnectionOptions, addAnyConnectionOptions, melsecPlc } from './connection-options'
import { exitCodes } from './exit-code'
import { byFamily } from './family'
import { areasOf, jwPlc } from './jw/connection'
import { json } from './output'
import type { Need, Plc } from './session'
import { refusalOf, type Terminal } from './terminal'

const examples = [
  'request readTypeName --plc 192.168.3.39:5010 --profile iq-r',
  `request readWords '{"head":"D100","points":2}' --plc 192.168.3.39:5010 --profile iq-r`,
  `request writeRandomBits '{"bits":[{"device":"M0","value":true}]}' --plc 192.168.3.39:5010 --profile iq-r`,
  `request readDataMemory '{"head":"09000","length":4}' --plc 192.168.3.60:4000 --family jw`,
]

type RequestOptions = AnyConnectionOptions & { readonly yes?: boolean }

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
  addAnyConnectionOptions(command)
  return command.action((name: string, message: string, options: RequestOptions) =>
    perform(run, options, () =>
      byFamily(command, options, {
        melsec: () => request(run.terminal, melsecRequest(name, melsecPlc(run.terminal, options)), message, options),
        jw: () => request(run.terminal, jwRequest(name, options, jwPlc(run.terminal, options)), message, options),
      }),
    ),
  )
}

/** What is going to be sent: nothing of it was. */
interface Prepared {
  readonly title: string
  readonly effect: Effect
  /** As JSON, without passwords. */
  readonly message: Readonly<Record<string, unknown>>
  /** @throws RequestError what is refused before anything is sent */
  check(): Promise<void>
  /** @returns the answer as JSON */
  send(): Promise<Readonly<Record<string, unknown>>>
}

/** A declared command of any family. */
interface Sendable {
  /** Of the PLC. */
  readonly peer: string
  readonly fields: readonly FieldDescription[]
  /** @throws RequestError */
  prepare(message: unknown): Prepared
}

/** What sending a command of an effect needs. */
const NEEDS: Readonly<Partial<Record<Effect, Need>>> = { write: 'writing', control: 'control', configure: 'parameters' }

function melsecRequest(name: string, plc: Plc<MelsecClient>): Sendable {
  const command = commandNamed(name)
  return {
    peer: plc.text,
    fields: describeCommand(command).request,
    prepare: (message) => {
      const { title, effect, message: shown } = plc.offline().explainRequest(command.name, message)
      const sending = (client: MelsecClient) => client.requestByName(command.name, message)
      return {
        title,
        effect,
        message: shown,
        check: async () => {},
        send: () =>
          plc.with(NEEDS[effect] ?? 'reading', async (client) =>
            answerToJson(command, await sending(client), client.notation),
          ),
      }
    },
  }
}

function jwRequest(name: string, options: RequestOptions, plc: Plc<JwClient>): Sendable {
  const command = jwCommandNamed(name)
  const { title, effect }: { title: string; effect: Effect } = command
  const need = NEEDS[effect] ?? 'reading'
  return {
    peer: plc.text,
    fields: describeJwCommand(command).request,
    prepare: (json) => {
      const message = jwMessageFromJson(command, json, { areas: areasOf(options) })
      const sending = (client: JwClient) => client.request(command, message)
      return {
        title,
        effect,
        message: jwMessageToJson(command, message),
        check: () => plc.unsent(need, sending),
        send: () => plc.with(need, async (client) => jwAnswerToJson(command, await sending(client))),
      }
    },
  }
}

async function request(terminal: Terminal, to: Sendable, text: string, options: RequestOptions): Promise<number> {
  const piped = text === '-'
  const message = parsed(piped ? await terminal.input() : text)
  if (!piped) refuseSecrets(to.fields, message)
  const prepared = to.prepare(message)
  const { title, effect, message: shown } = prepared
  await prepared.check()
  if (NEEDS[effect] !== undefined) {
    const question = `${title} to ${to.peer}: ${JSON.stringify(shown)}`
    const refusal = await refusalOf(terminal, options.yes === true, question)
    if (refusal !== undefined) throw new RequestError('NOT_PERMITTED', `Nothing was sent. ${refusal}`, '--yes')
  }
  terminal.out(json(await prepared.send()))
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
