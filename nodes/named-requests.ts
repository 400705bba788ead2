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
import type { Effect } from '../src/index'
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
      const { areas } = client.options
      const options = areas === undefined ? {} : { areas }
      return {
        effect: jwCommandNamed,
        check: (name, json) => {
          jwMessageFromJson(jwCommandNamed(name), json, options)
        },
        send: async (name, json) => {
          const command = jwCommandNamed(name)
          return jwAnswerToJson(command, await client.request(command, jwMessageFromJson(command, json, options)))
        },
      }
    },
  })
}

/** What the editor knows of the commands of each family. */
export const requestFacts = {
  melsec: Object.values(commands).map((command) => describeCommand(command)),
  jw: Object.values(jwCommands).map((command) => describeJwCommand(command)),
} satisfies Readonly<Record<FamilyName, readonly object[]>>
