// What carries a client's bytes, from its settings.
import type { ClientProtocol } from '../../melsec/client-protocol'
import { tcpTransport } from '../../transport/tcp'
import type { OpenTransport } from '../../transport/transport'
import { udpTransport } from '../../transport/udp'
import { Line } from '../connection/line'
import { proofs } from './control'
import type { MelsecClientOptions } from './options'
import type { Settings } from './settings'

export function lineOf(settings: Settings, options: MelsecClientOptions, protocol: ClientProtocol): Line {
  if (settings.serialLine !== undefined) return settings.serialLine.line
  return new Line({
    ...settings,
    framing: protocol.framing,
    openTransport: options.openTransport ?? transportOf(settings, options),
    proof: proofs(protocol, settings.random),
  })
}

/** Of an Ethernet port: the settings have both. */
function transportOf(
  { transport }: Settings,
  { host = '', port = 0, localAddress, localPort }: MelsecClientOptions,
): OpenTransport {
  const endpoint = { host, port, localAddress, localPort }
  return transport === 'udp' ? udpTransport(endpoint) : tcpTransport(endpoint)
}
