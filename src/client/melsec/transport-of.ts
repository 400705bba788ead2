// What carries a client's bytes, from its settings.
import { tcpTransport } from '../../transport/tcp'
import type { OpenTransport } from '../../transport/transport'
import { udpTransport } from '../../transport/udp'
import type { MelsecClientOptions, Settings } from './options'

export function transportOf(
  { transport }: Settings,
  { host, port, localAddress, localPort }: MelsecClientOptions,
): OpenTransport {
  const endpoint = { host, port, localAddress, localPort }
  return transport === 'udp' ? udpTransport(endpoint) : tcpTransport(endpoint)
}
