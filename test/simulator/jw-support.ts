/** A client's protocol joined to a simulated Sharp JW, in memory or by sockets. */
import type { MessageInput, MessageOf } from '../../src/codec/codec'
import { EndCodeError } from '../../src/errors'
import { jwCommands } from '../../src/jw/commands/commands'
import { type JwProtocolOptions, jwProtocol } from '../../src/jw/protocol'
import type { NamedCommand, ResponseFrame } from '../../src/link/link'
import type { ConnectOptions } from '../../src/simulator/listening'
import { createJwSimulator, type JwSimulator, type JwSimulatorOptions } from '../../src/simulator/simulator'
import type { OpenTransport } from '../../src/transport/transport'
import { type ManualClock, manualClock } from '../support/manual-clock'

/** Asks one request at a time over one connection in memory; everything happens before `ask` returns. */
export class JwAsker {
  readonly protocol
  readonly received: Buffer[] = []
  closed = false
  readonly send: (bytes: Uint8Array) => void

  constructor(plc: JwSimulator, options: JwProtocolOptions = {}, connect: ConnectOptions = {}) {
    this.protocol = jwProtocol({ ...options, model: options.model ?? plc.model })
    const transport = plc.connect({ delivery: 'synchronous', ...connect })()
    transport.open({
      opened: () => {},
      received: (bytes) => this.received.push(Buffer.from(bytes)),
      closed: () => {
        this.closed = true
      },
    })
    this.send = (bytes) => transport.send(bytes)
  }

  /** The answer; throws what the client would throw; undefined when there is none. */
  ask<C extends NamedCommand>(command: C, message: MessageInput<C['request']>): MessageOf<C['response']> | undefined {
    const exchange = this.protocol.exchange(command, message)
    const bytes = this.raw(exchange.write(0))
    if (bytes.length === 0) return undefined
    const scanned = this.protocol.framing.response.scan(bytes, exchange.responseLength)
    if (scanned === undefined || scanned.used !== bytes.length) throw new Error(`odd answer ${bytes.toString('hex')}`)
    return exchange.decode(scanned.frame as ResponseFrame)
  }

  /** As `ask`, for the result code: 0 when it went well. */
  code<C extends NamedCommand>(command: C, message: MessageInput<C['request']>): number | undefined {
    try {
      return this.ask(command, message) === undefined ? undefined : 0
    } catch (error) {
      if (error instanceof EndCodeError) return error.endCode
      throw error
    }
  }

  /** What comes back for any bytes. */
  raw(bytes: Uint8Array): Buffer {
    this.received.length = 0
    this.send(bytes)
    return Buffer.concat(this.received)
  }

  /** The same in hexadecimal. */
  hex(text: string): string {
    return this.raw(Buffer.from(text.replaceAll(' ', ''), 'hex'))
      .toString('hex')
      .toUpperCase()
  }
}

export interface JwJoined {
  readonly plc: JwSimulator
  readonly asker: JwAsker
  readonly clock: ManualClock
}

/** A simulated JW that may be written, and somebody who asks it. */
export function joinJw(options: JwSimulatorOptions = {}, protocol: JwProtocolOptions = {}): JwJoined {
  const clock = manualClock()
  const plc = createJwSimulator({ writeMode: 2, clock, ...options })
  return { plc, asker: new JwAsker(plc, protocol), clock }
}

/** Sends bytes by a transport and waits for so many back. */
export async function exchanged(open: OpenTransport, bytes: Uint8Array, count: number): Promise<Buffer> {
  const transport = open()
  const chunks: Buffer[] = []
  try {
    return await new Promise<Buffer>((resolve, reject) => {
      transport.open({
        opened: () => transport.send(bytes),
        received: (chunk) => {
          chunks.push(Buffer.from(chunk))
          const all = Buffer.concat(chunks)
          if (all.length >= count) resolve(all)
        },
        closed: () => reject(new Error('closed')),
      })
    })
  } finally {
    transport.close()
  }
}

export { jwCommands }
