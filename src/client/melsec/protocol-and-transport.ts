// What a client is made of, from its settings.

import { protocolOver1e } from '../../melsec/a-compatible/slmp-over-1e'
import { ownStation } from '../../melsec/frame/route'
import { frame3e, type Head3e } from '../../melsec/frame/slmp-frame'
import { type ClientProtocol, MelsecProtocol } from '../../melsec/protocol'
import { tcpTransport } from '../../transport/tcp'
import type { OpenTransport } from '../../transport/transport'
import { udpTransport } from '../../transport/udp'
import type { MelsecClientOptions, Settings } from './options'

export function protocolOf(
  { frame, code, profile, route, timer, asciiXy }: Settings,
  { asciiZr }: MelsecClientOptions,
): ClientProtocol<Head3e> {
  if (frame === '1E') return protocolOver1e({ profile, code, asciiXy, timer, route })
  return new MelsecProtocol({
    framing: frame3e(frame, code),
    head: { route, timer },
    connectedHead: { route: ownStation, timer },
    moduleIo: route.moduleIo,
    profile,
    code,
    asciiXy,
    asciiZr,
  })
}

export function transportOf(
  { transport }: Settings,
  { host, port, localAddress, localPort }: MelsecClientOptions,
): OpenTransport {
  const endpoint = { host, port, localAddress, localPort }
  return transport === 'udp' ? udpTransport(endpoint) : tcpTransport(endpoint)
}
