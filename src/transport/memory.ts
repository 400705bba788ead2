/** Clients and a server joined in memory, for tests and for a simulator inside the same program. */
import { ConnectionError } from '../errors'
import { type DeliveryOptions, DeliveryQueue, type Receiver } from './delivery'
import { notOpen, notRenewable } from './failure'
import type { OpenTransport, ServerConnection, Transport, TransportHandlers } from './transport'

export interface MemoryOptions extends DeliveryOptions {
  /** Default `stream`. */
  readonly kind?: 'stream' | 'datagram' | undefined
}

/** A server in memory, to which any number of clients can connect. */
export interface MemoryListener {
  /** Makes a client transport, as `tcpTransport(options)` does. */
  readonly open: OpenTransport
  /** While true, nothing listens: connections and datagrams fail with CONNECT_FAILED. */
  refuse: boolean
  /** How much is under way. */
  readonly pending: number
  /**
   * Delivers what is under way and what comes of it, or the next `count` deliveries only.
   * Returns how many there were; 0 when called from inside a delivery.
   */
  deliver(count?: number): number
  /** Ends all connections and refuses new ones. */
  close(): void
}

/**
 * Listens in memory.
 * @example
 * const memory = listenMemory({ delivery: 'manual' }, (peer) => {
 *   peer.onReceived = (chunk) => peer.send(chunk)
 * })
 * const transport = memory.open()
 * transport.open(handlers)
 * memory.deliver()
 */
export function listenMemory(options: MemoryOptions, onConnection: (peer: ServerConnection) => void): MemoryListener {
  return new Network(options, onConnection)
}

class Network implements MemoryListener {
  refuse = false
  readonly kind: 'stream' | 'datagram'
  readonly queue: DeliveryQueue
  readonly peers = new Set<MemoryPeer>()
  readonly onConnection: (peer: ServerConnection) => void
  #connections = 0
  #ports = 0

  constructor(options: MemoryOptions, onConnection: (peer: ServerConnection) => void) {
    this.kind = options.kind ?? 'stream'
    this.queue = new DeliveryQueue(this.kind, options)
    this.onConnection = onConnection
  }

  readonly open = (): Transport => new MemoryTransport(this)

  get pending(): number {
    return this.queue.pending
  }

  deliver(count?: number): number {
    return this.queue.deliver(count)
  }

  close(): void {
    this.refuse = true
    for (const peer of this.peers) peer.close()
  }

  nextId(): number {
    return ++this.#connections
  }

  nextPort(): number {
    return ++this.#ports
  }
}

/** What joins a client to its server connection: a connection, or one local port of a datagram client. */
class Line {
  readonly port: number
  readonly toClient: Receiver
  readonly toServer: Receiver
  peer: MemoryPeer | undefined

  constructor(
    readonly network: Network,
    readonly client: MemoryTransport,
  ) {
    this.port = network.nextPort()
    this.toClient = { side: 'client', take: (bytes) => client.take(bytes, this) }
    this.toServer = { side: 'server', take: (bytes) => this.#arrive(bytes) }
  }

  accept(): void {
    this.peer = new MemoryPeer(this)
    this.network.onConnection(this.peer)
  }

  /** The client has gone; behind what it sent before, which the server still receives. */
  leave(): void {
    this.network.queue.later(() => this.peer?.end(() => {}))
  }

  #arrive(bytes: Buffer): void {
    if (this.network.kind === 'datagram') {
      if (this.network.refuse) {
        this.client.finish('CONNECT_FAILED', this)
        return
      }
      // The first datagram from a port makes its connection.
      if (this.peer === undefined) this.accept()
    }
    this.peer?.take(bytes)
  }
}

class MemoryPeer implements ServerConnection {
  onReceived: (bytes: Buffer) => void = () => {}
  onClosed: () => void = () => {}
  readonly id: number
  readonly remote: string
  readonly #line: Line
  #ended = false

  constructor(line: Line) {
    this.#line = line
    this.id = line.network.nextId()
    this.remote = `memory:${line.port}`
    line.network.peers.add(this)
  }

  take(bytes: Buffer): void {
    if (!this.#ended) this.onReceived(bytes)
  }

  send(bytes: Uint8Array): void {
    if (!this.#ended) this.#line.network.queue.carry(this.#line.toClient, bytes)
  }

  close(): void {
    this.end(() => this.#line.client.finish(undefined, this.#line))
  }

  reset(): void {
    const { client, network, toClient } = this.#line
    if (!this.#ended && network.kind === 'stream') network.queue.lose(toClient)
    this.end(() => client.finish('DISCONNECTED', this.#line))
  }

  end(tellClient: () => void): void {
    if (this.#ended) return
    this.#ended = true
    const { network } = this.#line
    this.#line.peer = undefined
    network.peers.delete(this)
    network.queue.later(() => {
      if (network.kind === 'stream') tellClient()
      this.onClosed()
    })
  }
}

const ENDINGS = { CONNECT_FAILED: 'nothing listens', DISCONNECTED: 'the peer reset the connection' }

class MemoryTransport implements Transport {
  readonly kind: 'stream' | 'datagram'
  readonly #network: Network
  #state: 'new' | 'opening' | 'open' | 'done' = 'new'
  #handlers: TransportHandlers | undefined
  #line: Line | undefined
  #sent = false

  constructor(network: Network) {
    this.#network = network
    this.kind = network.kind
  }

  get description(): string {
    return this.#line === undefined ? 'memory' : `memory (local ${this.#line.port})`
  }

  get renewable(): boolean {
    return this.kind === 'datagram'
  }

  get ready(): boolean {
    return this.#state === 'open'
  }

  open(handlers: TransportHandlers): void {
    if (this.#state !== 'new') throw new Error(`${this.description}: open() was called before, make another transport`)
    this.#state = 'opening'
    this.#handlers = handlers
    const line = new Line(this.#network, this)
    this.#line = line
    this.#network.queue.later(() => this.#reach(line))
  }

  send(bytes: Uint8Array): void {
    if (this.#state !== 'open' || this.#line === undefined) throw notOpen(this.description)
    this.#sent = true
    this.#network.queue.carry(this.#line.toServer, bytes)
  }

  renew(): void {
    if (!this.renewable) throw notRenewable(this.description)
    if (this.#state !== 'open') throw notOpen(this.description)
    this.#line?.leave()
    this.#line = new Line(this.#network, this)
    this.#handlers?.renewed?.()
  }

  close(): void {
    const line = this.#line
    this.#state = 'done'
    this.#handlers = undefined
    this.#line = undefined
    line?.leave()
  }

  take(bytes: Buffer, line: Line): void {
    if (line === this.#line && this.#state === 'open') this.#handlers?.received(bytes)
  }

  finish(ending: keyof typeof ENDINGS | undefined, line: Line): void {
    if (line !== this.#line) return
    const error =
      ending &&
      new ConnectionError(ending, `${this.description}: ${ENDINGS[ending]}`, this.#sent ? 'unknown' : 'notSent')
    const handlers = this.#handlers
    this.close()
    handlers?.closed(error)
  }

  #reach(line: Line): void {
    if (this.#state !== 'opening') return
    if (this.kind === 'stream' && this.#network.refuse) {
      this.finish('CONNECT_FAILED', line)
      return
    }
    // Before the server's side acts: a connection that it accepts and closes at once has been open.
    this.#network.queue.later(() => {
      if (this.#state !== 'opening') return
      this.#state = 'open'
      this.#handlers?.opened()
    })
    if (this.kind === 'stream') line.accept()
  }
}
