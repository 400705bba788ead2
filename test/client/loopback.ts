/** A connection to a scripted PLC over real sockets of this computer. */

import { Connection, type ConnectionState, type Silence } from '../../src/client/connection/connection'
import { Line } from '../../src/client/connection/line'
import { explainSilence } from '../../src/client/melsec/diagnosis'
import { ownStation } from '../../src/melsec/frame/route'
import { slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { realClock } from '../../src/transport/clock'
import { listenTcp } from '../../src/transport/listen-tcp'
import { listenUdp } from '../../src/transport/listen-udp'
import { tcpTransport } from '../../src/transport/tcp'
import type { Listener } from '../../src/transport/transport'
import { udpTransport } from '../../src/transport/udp'
import { exchanges, type Frame, ScriptedPlc } from './scripted-plc'

export interface LoopbackOptions {
  /** Default true: `start` resolves when the PLC has answered. */
  readonly connect?: boolean
  readonly inFlight?: number
  /** ms; default 5000, so that a busy computer does not make a difference */
  readonly timeout?: number
  readonly plcFrame?: Frame
  readonly plcCode?: 'binary' | 'ascii'
}

type Transport = 'tcp' | 'udp'

export class Loopback {
  readonly ask
  readonly framing
  readonly connection: Connection
  #waiting: { readonly name: string; readonly resolve: () => void }[] = []

  private constructor(
    private readonly transport: Transport,
    private readonly frame: Frame,
    private readonly options: LoopbackOptions,
    readonly plc: ScriptedPlc,
    private listener: Listener,
  ) {
    this.ask = exchanges(frame)
    this.framing = slmpFraming(frame, 'binary')
    this.connection = this.#connection()
  }

  static async start(transport: Transport, frame: Frame, options: LoopbackOptions = {}): Promise<Loopback> {
    const { plcFrame = frame, plcCode = 'binary', connect = true } = options
    const plc = new ScriptedPlc(plcFrame, transport === 'tcp' ? 'stream' : 'datagram', plcCode)
    const started = new Loopback(transport, frame, options, plc, await listen(transport, plc, 0))
    if (connect) await started.connection.connect()
    return started
  }

  #connection(): Connection {
    const { transport, frame, framing } = this
    const { timeout = 5000, inFlight = 1 } = this.options
    const { port } = this.listener
    const endpoint = { host: '127.0.0.1', port }
    const settings = { transport, port, frame, code: 'binary', route: ownStation } as const
    const options = {
      framing,
      openTransport: transport === 'tcp' ? tcpTransport(endpoint) : udpTransport(endpoint),
      clock: realClock,
      supervisor: { first: 20, longest: 100, settleGap: 10, random: Math.random },
      inFlight,
      queueLimit: 256,
      connectTimeout: 5000,
      timeout,
      probes: [{ name: 'Read Type Name (0101)', exchange: this.ask.probe }],
      proof: this.ask.proof,
      explainSilence: (silence: Silence) => explainSilence(settings, silence),
      onState: (state: ConnectionState) => this.#told(state),
      onUnsolicited: () => {},
      random: Math.random,
    }
    return new Connection(new Line(options), options)
  }

  readonly read = (number: number, options: { timeout?: number } = {}) =>
    this.connection.request(this.ask.read(number), options)

  #told({ name }: ConnectionState): void {
    const reached = this.#waiting.filter((entry) => entry.name === name)
    this.#waiting = this.#waiting.filter((entry) => entry.name !== name)
    for (const { resolve } of reached) resolve()
  }

  /** Resolves when the connection is, or comes to be, in this state. */
  reached(name: ConnectionState['name']): Promise<void> {
    if (this.connection.state.name === name) return Promise.resolve()
    return new Promise((resolve) => this.#waiting.push({ name, resolve }))
  }

  /** Another client of the same PLC. */
  another(): { readonly connection: Connection } {
    return { connection: this.#connection() }
  }

  /** Resolves when no client is connected any more. */
  async closedByClient(): Promise<void> {
    while (this.plc.open > 0) await new Promise<void>((resolve) => setImmediate(resolve))
  }

  async powerOff(): Promise<void> {
    for (const peer of this.plc.peers) peer.reset()
    await this.listener.close()
  }

  async powerOn(): Promise<void> {
    this.listener = await listen(this.transport, this.plc, this.listener.port)
  }

  async end(): Promise<void> {
    this.connection.close()
    await this.listener.close()
  }
}

function listen(transport: Transport, plc: ScriptedPlc, port: number): Promise<Listener> {
  return transport === 'tcp' ? listenTcp({ port }, plc.accept) : listenUdp({ port }, plc.accept)
}
