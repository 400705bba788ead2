// What carries a client's bytes, and how late answers are kept apart on a port that stays.
import { jwCommands } from '../../jw/commands/commands'
import type { Echo, ResponseFrame } from '../../link/link'
import { tcpTransport } from '../../transport/tcp'
import type { OpenTransport } from '../../transport/transport'
import { udpTransport } from '../../transport/udp'
import { Line } from '../connection/line'
import type { JwClientOptions } from './options'
import type { JwProtocol } from './send-command'
import type { JwSettings } from './settings'

export function jwLine(settings: JwSettings, options: JwClientOptions, protocol: JwProtocol): Line {
  return new Line({
    ...settings,
    framing: protocol.framing,
    openTransport: options.openTransport ?? transportOf(settings, options),
    proof: loopbacks(protocol, settings.random),
  })
}

function transportOf(
  { transport }: JwSettings,
  { host = '', port = 0, localAddress, localPort }: JwClientOptions,
): OpenTransport {
  const endpoint = { host, port, localAddress, localPort }
  return transport === 'udp' ? udpTransport(endpoint) : tcpTransport(endpoint)
}

const PATTERN = 8

/**
 * Makes loopbacks (80H) whose bytes were not used before, also by the program that had this port before: a number that goes up,
 * behind four random bytes.
 */
export function loopbacks(protocol: JwProtocol, random: () => number): () => Echo {
  let count = 0
  return () => {
    count = (count + 1) % 0x1_0000_0000
    const pattern = Buffer.alloc(PATTERN)
    pattern.writeUInt32BE(Math.floor(random() * 0x1_0000_0000), 0)
    pattern.writeUInt32BE(count, 4)
    const { write, mismatch, responseLength } = protocol.exchange(jwCommands.loopback, { data: pattern })
    return {
      write,
      mismatch,
      responseLength,
      mayBeOwn: (datagram) => datagram.includes(pattern),
      read: (frame: ResponseFrame) => (frame.body.equals(pattern) ? 'own' : 'another'),
    }
  }
}
