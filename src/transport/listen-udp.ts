/** Listening on UDP, for the simulator: every remote address and port counts as one connection. */
import { createSocket, type Socket } from 'node:dgram'
import { isIPv6 } from 'node:net'
import { RequestError } from '../errors'
import { type Clock, realClock } from './clock'
import { checkPort, formatEndpoint, literalLookup, resolveAddress } from './endpoint'
import { listenFailure } from './failure'
import type { Listener, ListenOptions, ServerConnection } from './transport'

export interface UdpListenOptions extends ListenOptions {
  /** Milliseconds without a datagram after which a client is forgotten. Default 60 000. */
  readonly idleTimeout?: number | undefined
  /** Clients remembered at once; the one silent for longest gives way to a new one. Default 1024. */
  readonly maxPeers?: number | undefined
  /** Default: the real one. */
  readonly clock?: Clock | undefined
}

const DEFAULT_IDLE_TIMEOUT = 60_000
const DEFAULT_MAX_PEERS = 1024

/**
 * Listens for datagrams. Empty ones carry nothing and are dropped.
 * @throws RequestError BAD_OPTION; rejects with ConnectionError PORT_UNAVAILABLE when the port cannot be had
 * @example
 * const listener = await listenUdp({ port: 0 }, (peer) => {
 *   peer.onReceived = (datagram) => peer.send(datagram)
 * })
 */
export async function listenUdp(
  options: UdpListenOptions,
  onConnection: (peer: ServerConnection) => void,
): Promise<Listener> {
  const { host = '127.0.0.1', port = 0, onError } = options
  checkPort('port', port, 0)
  const failure = (error: unknown) => listenFailure('udp', formatEndpoint(host, port), error)
  const address = await resolveAddress({ host, port }).catch((error: unknown) => {
    throw failure(error)
  })
  const socket = createSocket({ type: isIPv6(address) ? 'udp6' : 'udp4', lookup: literalLookup })
  const peers = new Peers(options, socket)
  await new Promise<void>((resolve, reject) => {
    socket.once('error', (error) => {
      socket.close()
      reject(failure(error))
    })
    socket.once('listening', resolve)
    socket.bind({ address, port, exclusive: true })
  })
  socket.removeAllListeners('error')
  // Windows reports a client that has gone as an error of the listening socket: nothing is wrong with that.
  socket.on('error', (error: NodeJS.ErrnoException) => {
    if (error.code !== 'ECONNRESET') onError?.(failure(error))
  })
  socket.on('message', (bytes, from) => {
    if (bytes.length > 0) peers.received(bytes, from.address, from.port, onConnection)
  })

  const closed = new Promise<void>((resolve) => {
    socket.once('close', resolve)
  })
  const bound = socket.address()
  let closing = false
  return {
    address: bound.address,
    port: bound.port,
    close() {
      if (!closing) {
        closing = true
        socket.close()
        peers.close()
      }
      return closed
    },
  }
}

/** The clients by address, the one silent for longest first. */
class Peers {
  readonly #socket: Socket
  readonly #clock: Clock
  readonly #idleTimeout: number
  readonly #maxPeers: number
  readonly #peers = new Map<string, UdpConnection>()
  #count = 0
  #cancelSweep: (() => void) | undefined

  constructor(options: UdpListenOptions, socket: Socket) {
    const { clock = realClock, idleTimeout = DEFAULT_IDLE_TIMEOUT, maxPeers = DEFAULT_MAX_PEERS } = options
    if (!(idleTimeout > 0)) {
      throw new RequestError('BAD_OPTION', `idleTimeout ${idleTimeout}: give more than 0 ms`, 'idleTimeout')
    }
    if (!(Number.isInteger(maxPeers) && maxPeers > 0)) {
      throw new RequestError('BAD_OPTION', `maxPeers ${maxPeers}: give a whole number above 0`, 'maxPeers')
    }
    this.#socket = socket
    this.#clock = clock
    this.#idleTimeout = idleTimeout
    this.#maxPeers = maxPeers
  }

  received(bytes: Buffer, address: string, port: number, onConnection: (peer: ServerConnection) => void): void {
    const key = formatEndpoint(address, port)
    let peer = this.#peers.get(key)
    if (peer === undefined) {
      peer = new UdpConnection(
        ++this.#count,
        key,
        (answer) => this.#socket.send(answer, port, address, ignore),
        () => this.#peers.delete(key),
      )
      this.#makeRoom()
      this.#peers.set(key, peer)
      this.#planSweep()
      onConnection(peer)
    } else {
      this.#peers.delete(key)
      this.#peers.set(key, peer)
    }
    peer.receive(bytes, this.#clock.now())
  }

  close(): void {
    this.#cancelSweep?.()
    for (const peer of [...this.#peers.values()]) peer.close()
  }

  #makeRoom(): void {
    for (const peer of this.#peers.values()) {
      if (this.#peers.size < this.#maxPeers) return
      peer.close()
    }
  }

  #planSweep(): void {
    if (this.#cancelSweep !== undefined) return
    const sweep = () => {
      this.#cancelSweep = undefined
      const oldest = this.#clock.now() - this.#idleTimeout
      for (const peer of this.#peers.values()) {
        if (peer.lastSeen > oldest) break
        peer.close()
      }
      if (this.#peers.size > 0) this.#planSweep()
    }
    this.#cancelSweep = this.#clock.timer(this.#idleTimeout, sweep, { unref: true })
  }
}

/** A datagram that cannot be delivered is lost, as the network would lose it. */
function ignore(): void {}

class UdpConnection implements ServerConnection {
  onReceived: (bytes: Buffer) => void = () => {}
  onClosed: () => void = () => {}
  lastSeen = 0
  readonly #post: (bytes: Uint8Array) => void
  readonly #forget: () => void
  #ended = false

  constructor(
    readonly id: number,
    readonly remote: string,
    post: (bytes: Uint8Array) => void,
    forget: () => void,
  ) {
    this.#post = post
    this.#forget = forget
  }

  receive(bytes: Buffer, now: number): void {
    this.lastSeen = now
    if (!this.#ended) this.onReceived(bytes)
  }

  send(bytes: Uint8Array): void {
    if (!this.#ended) this.#post(bytes)
  }

  close(): void {
    if (this.#ended) return
    this.#ended = true
    this.#forget()
    this.onClosed()
  }

  reset(): void {
    this.close()
  }
}
