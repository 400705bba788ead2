// Commands of the manuals by their names, with messages as they are typed: JSON. Each family has its own.
import {
  commandNamed,
  commands,
  describeCommand,
  describeJwCommand,
  jwAnswerToJson,
  jwCommandNamed,
  jwCommands,
  jwMessageFromJson,
} from '../src/entry/codec'
import { type Effect, type JwModel, RequestError } from '../src/index'
import { type AnyPlc, type FamilyName, forFamily } from './family'

interface NamedRequests {
  /** What the command does to the PLC. @throws RequestError when there is none of this name */
  readonly effect: (name: string) => { readonly name: string; readonly effect: Effect }
  /** @throws RequestError for a message that it does not take */
  readonly check: (name: string, json: unknown) => void
  readonly send: (name: string, json: unknown) => Promise<object>
}

/** The commands of the family of a PLC. */
export function requestsOf(plc: AnyPlc): NamedRequests {
  return forFamily<NamedRequests>(plc, {
    melsec: (client) => ({
      effect: commandNamed,
      check: (name, json) => {
        client.explainRequest(name, json)
      },
      send: (name, json) => client.requestByName(name, json),
    }),
    jw: (client) => {
      const { areas, model = 'jw300' } = client.options
      const options = areas === undefined ? {} : { areas }
      return {
        effect: jwCommandNamed,
        check: (name, json) => {
          checkModel(name, model)
          jwMessageFromJson(jwCommandNamed(name), json, options)
        },
        send: async (name, json) => {
          const command = jwCommandNamed(name)
          const answer: object = await client.request(command, jwMessageFromJson(command, json, options))
          return { ...jwAnswerToJson(command, answer), ...bytesIn(answer) }
        },
      }
    },
  })
}

/** @throws RequestError for a command that only other models have */
function checkModel(name: string, model: JwModel): void {
  const { title, code, models = [model] } = describeJwCommand(jwCommandNamed(name))
  if (models.includes(model)) return
  throw new RequestError(
    'UNSUPPORTED',
    `${title} (${code}H) does not exist on ${model.toUpperCase()}, only on ${models.join(', ').toUpperCase()}.`,
  )
}

/** Bytes of an answer are a Buffer in a message, as those of MELSEC are. */
function bytesIn(answer: object): object {
  const entries = Object.entries(answer).filter(([, value]) => value instanceof Uint8Array)
  return Object.fromEntries(entries.map(([name, value]) => [name, Buffer.from(value)]))
}

/** What the editor knows of the commands of each family. */
export const requestFacts = {
  melsec: Object.values(commands).map((command) => describeCommand(command)),
  jw: Object.values(jwCommands).map((command) => describeJwCommand(command)),
} satisfies Readonly<Record<FamilyName, readonly object[]>>
