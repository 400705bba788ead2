// The requests that prove a connection, by the option `probe`.
import { hex } from '../../basics/hex'
import type { JwCommand } from '../../jw/commands/commands'
import { jwCommands } from '../../jw/commands/commands'
import type { Probe } from '../connection/connection-options'
import type { JwProbeKind } from './options'
import type { JwProtocol } from './send-command'

/** Register 09000, which every model has. */
const FIRST_REGISTER = { file: 0, address: 0o4000 } as const

export function jwProbes(protocol: JwProtocol, kind: JwProbeKind): readonly Probe[] {
  if (kind === 'none') return []
  if (kind === 'read') {
    const message = { head: FIRST_REGISTER, length: 1 }
    const exchange = () => protocol.exchange(jwCommands.readDataMemory, message)
    return [{ name: nameOf(jwCommands.readDataMemory), exchange }]
  }
  return [{ name: nameOf(jwCommands.readWriteMode), exchange: () => protocol.exchange(jwCommands.readWriteMode, {}) }]
}

/** With its number, as people find it in the manual: `Read write mode (E9H)`. */
function nameOf({ title, code }: JwCommand): string {
  return `${title} (${hex(code, 2)}H)`
}
