// What carries a client's bytes, from its settings.
import type { ClientProtocol } from '../../melsec/client-protocol'
import type { TransportName } from '../../melsec/profiles/profile'
import type { EndpointOptions } from '../../transport/endpoint'
import { tcpTransport } from '../../transport/tcp'
import type { OpenTransport } from '../../transport/transport'
import { udpTransport } from '../../transport/udp'
import { Line } from '../connection/line'
import { proofs } from './control'
import type { MelsecClientOptions, Settings } from './options'

const transports: Readonly<Record<TransportName, (endpoint: EndpointOptions) => OpenTransport>> = {
  tcp: tcpTransport,
  udp: udpTransport,
}

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
  return transports[transport]({ host, port, localAddress, localPort })
}
