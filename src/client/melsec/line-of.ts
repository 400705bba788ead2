// What carries a client's bytes, from its settings.
import type { ClientProtocol } from '../../melsec/client-protocol'
import { tcpTransport } from '../../transport/tcp'
import type { OpenTransport } from '../../transport/transport'
import { udpTransport } from '../../transport/udp'
import { Line } from '../connection/line'
import { proofs } from './control'
import type { MelsecClientOptions, Settings } from './options'

export function lineOf(settings: Settings, options: MelsecClientOptions, protocol: ClientProtocol): Line {
  return new Line({
    ...settings,
    framing: protocol.framing,
    openTransport: options.openTransport ?? transportOf(settings, options),
    proof: proofs(protocol, settings.random),
  })
}

function transportOf(
  { transport }: Settings,
  { host, port, localAddress, localPort }: MelsecClientOptions,
): OpenTransport {
  const endpoint = { host, port, localAddress, localPort }
  return transport === 'udp' ? udpTransport(endpoint) : tcpTransport(endpoint)
}
