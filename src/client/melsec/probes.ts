// The requests that prove a connection, by the option `probe`.
import { RequestError } from '../../errors'
import type { ClientProtocol } from '../../melsec/client-protocol'
import { commands } from '../../melsec/commands/commands'
import { lackOf, type Profile } from '../../melsec/profiles/profile'
import type { Probe } from '../connection/connection-options'

/**
 * `typeName`: Read Type Name. `read`: a Read of D0. `auto`: the type name, and where that gets no answer the Read.
 * `none`: nothing is asked; the first request of the program proves the connection.
 */
export const probeKinds = ['auto', 'typeName', 'read', 'none'] as const
/** How a new connection is proved. */
export type ProbeKind = (typeof probeKinds)[number]

type Asked = 'readTypeName' | 'readWords'

const ORDER = {
  auto: ['readTypeName', 'readWords'],
  typeName: ['readTypeName'],
  read: ['readWords'],
  none: [],
} as const satisfies Readonly<Record<ProbeKind, readonly Asked[]>>

/** @throws RequestError BAD_OPTION when the PLC is known not to have the only request that is wanted. */
export function checkProbe(profile: Profile, kind: ProbeKind): ProbeKind {
  const lack = kind === 'typeName' ? lackOf(profile, 'readTypeName') : undefined
  if (lack === undefined) return kind
  const message = `${profile.title} does not have ${commands.readTypeName.title}: ${lack.reason} Set probe to auto or read.`
  throw new RequestError('BAD_OPTION', message, 'probe')
}

export function probesOf(protocol: ClientProtocol, kind: ProbeKind): readonly Probe[] {
  const exchanges = {
    readTypeName: () => protocol.exchange(commands.readTypeName, {}),
    readWords: () => protocol.exchange(commands.readWords, { head: { device: 'D', number: 0 }, points: 1 }),
  } as const satisfies Readonly<Record<Asked, Probe['exchange']>>
  return ORDER[kind]
    .filter((name) => lackOf(protocol.profile, name) === undefined)
    .map((name) => ({ name: protocol.nameOf(commands[name]), exchange: exchanges[name] }))
}
