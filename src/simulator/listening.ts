// Where a simulated PLC listens, on TCP, on UDP and in memory, and who is connected to it.
import { ClosedError } from '../errors'
import type { Clock } from '../transport/clock'
import { listenTcp } from '../transport/listen-tcp'
import { listenUdp } from '../transport/listen-udp'
import { listenMemory, type MemoryListener } from '../transport/memory'
import type { Listener, OpenTransport, ServerConnection } from '../transport/transport'
import type { Counters } from './statistics'

/** A port that listens. */
export interface PortOptions {
  /** 0 (default): any free port. */
  readonly port?: number
}

/** Where a port listens. */
export interface Endpoint {
  /** Address it listens on. */
  readonly host: string
  /** Number of the port. */
  readonly port: number
}

/** A client at the moment. */
export interface ConnectionInfo {
  /** Counting from 1. */
  readonly id: number
  /** TCP (`stream`) or UDP (`datagram`). */
  readonly kind: 'stream' | 'datagram'
  /** Address and port, or the name given to `connect()`. */
  readonly remote: string
  /** Milliseconds since 1970. */
  readonly since: number
  /** Requests so far. */
  readonly requests: number
}

/** A client has come or gone. */
export interface ConnectionEvent {
  /** What has become of it. */
  readonly change: 'opened' | 'closed' | 'turnedAway'
  /** Who it is. */
  readonly connection: ConnectionInfo
}

/** How a client is joined to the simulated PLC in memory. */
export interface ConnectOptions {
  /** As TCP (`stream`, default) or as UDP. */
  readonly kind?: 'stream' | 'datagram'
  /** How bytes of a stream are cut and joined on their way, both directions; as they are sent, by default. */
  readonly chunking?: (pending: readonly Buffer[], to: 'client' | 'server') => readonly Buffer[]
  /** As sockets (default), or before `send` returns. */
  readonly delivery?: 'microtask' | 'synchronous'
  /** Who this is in remote control. Default: every call of `connect()` is another device. */
  readonly device?: string
}

/** One client, as the PLC that is behind the ports serves it. */
export interface Served extends ConnectionInfo {
  /** After the connection has ended, or to end it. */
  end(how?: 'close' | 'reset'): void
}

export interface ListeningParts<C extends Served> {
  readonly host: string
  readonly tcp: PortOptions | false
  readonly udp: PortOptions | false
  readonly clock: Clock
  /** Connections (TCP, or streams in memory) at the same time. */
  readonly maxConnections: number
  /** ms for which an entry stays taken after its connection has ended. */
  readonly entryRelease: number
  readonly counters: Counters
  /** `device`: the name given to `connect()`; a socket has none. */
  readonly serve: (peer: ServerConnection, kind: C['kind'], id: number, device: string | undefined) => C
  /** Whether a fault ends a connection before it begins, and how. */
  readonly refused: (connection: C) => 'close' | 'reset' | undefined
  readonly changed: (event: ConnectionEvent) => void
}

export class Listening<C extends Served> {
  readonly #parts: ListeningParts<C>
  readonly #connections = new Map<ServerConnection, C>()
  readonly #memoryListeners = new Set<MemoryListener>()
  readonly #timers = new Set<() => void>()
  /** Entries that are not yet free again after their connections have ended. */
  #releasing = 0
  #connects = 0
  #down = false
  #closed = false
  #tcp: Listener | undefined
  #udp: Listener | undefined
  #listening: Promise<void> | undefined

  constructor(parts: ListeningParts<C>) {
    this.#parts = parts
  }

  get tcp(): Endpoint | undefined {
    return endpoint(this.#tcp)
  }

  get udp(): Endpoint | undefined {
    return endpoint(this.#udp)
  }

  get connections(): Iterable<C> {
    return this.#connections.values()
  }

  get infos(): readonly ConnectionInfo[] {
    return [...this.#connections.values()].map(info)
  }

  /** @throws ConnectionError PORT_UNAVAILABLE; then nothing listens. */
  listen(): Promise<void> {
    this.#listening ??= this.#listen()
    return this.#listening
  }

  connect(options: ConnectOptions): OpenTransport {
    const { kind = 'stream', device = `device ${++this.#connects}`, ...rest } = options
    this.refuseClosed()
    const listener = listenMemory({ kind, ...rest }, (peer) => this.#accept(peer, kind, device))
    this.#memoryListeners.add(listener)
    return listener.open
  }

  /** As a power failure: everybody is disconnected, and nobody answered, for so many ms. `false`: it is down already. */
  goDown(ms: number, up: () => void): boolean {
    if (this.#down || this.#closed) return false
    this.#down = true
    for (const connection of this.#connections.values()) connection.end('reset')
    this.#after(ms, () => {
      this.#down = false
      up()
    })
    return true
  }

  /** @throws ClosedError */
  refuseClosed(): void {
    if (this.#closed) throw new ClosedError('CLOSED', 'This simulator is closed: make another one.')
  }

  /** Ends everything; no socket or timer is left when it resolves. */
  async close(): Promise<void> {
    this.#closed = true
    for (const cancel of this.#timers) cancel()
    this.#timers.clear()
    for (const connection of this.#connections.values()) connection.end('close')
    for (const listener of this.#memoryListeners) listener.close()
    await this.#listening?.catch(() => {})
    await this.#closeListeners()
  }

  async #listen(): Promise<void> {
    this.refuseClosed()
    const { host, tcp, udp, clock } = this.#parts
    try {
      if (tcp !== false) this.#tcp = await listenTcp({ host, ...tcp }, (peer) => this.#accept(peer, 'stream'))
      if (udp !== false) this.#udp = await listenUdp({ host, clock, ...udp }, (peer) => this.#accept(peer, 'datagram'))
    } catch (error) {
      await this.#closeListeners()
      this.#listening = undefined
      throw error
    }
    if (this.#closed) await this.#closeListeners()
  }

  #accept(peer: ServerConnection, kind: C['kind'], device?: string): void {
    if (this.#down || this.#closed) {
      // A PLC that starts again has no connections to end in an orderly way; datagrams just get lost.
      peer.reset()
      return
    }
    const { counters, serve, changed } = this.#parts
    const connection = serve(peer, kind, ++counters.connections, device)
    const turnAway = kind === 'stream' ? this.#turnAway(connection) : undefined
    if (turnAway !== undefined) {
      counters.turnedAway++
      connection.end(turnAway)
      changed({ change: 'turnedAway', connection: info(connection) })
      return
    }
    this.#connections.set(peer, connection)
    peer.onClosed = () => this.#gone(peer, connection)
    changed({ change: 'opened', connection: info(connection) })
  }

  /** How a connection ends before it begins, if it does. */
  #turnAway(connection: C): 'close' | 'reset' | undefined {
    const refused = this.#parts.refused(connection)
    if (refused !== undefined) return refused
    let taken = this.#releasing
    for (const { kind } of this.#connections.values()) if (kind === 'stream') taken++
    return taken >= this.#parts.maxConnections ? 'close' : undefined
  }

  #gone(peer: ServerConnection, connection: C): void {
    const { entryRelease, changed } = this.#parts
    connection.end()
    this.#connections.delete(peer)
    if (connection.kind === 'stream' && entryRelease > 0 && !this.#down) {
      this.#releasing++
      this.#after(entryRelease, () => {
        this.#releasing--
      })
    }
    changed({ change: 'closed', connection: info(connection) })
  }

  #after(ms: number, run: () => void): void {
    const cancel = this.#parts.clock.timer(
      ms,
      () => {
        this.#timers.delete(cancel)
        run()
      },
      { unref: true },
    )
    this.#timers.add(cancel)
  }

  async #closeListeners(): Promise<void> {
    const listeners = [this.#tcp, this.#udp]
    this.#tcp = undefined
    this.#udp = undefined
    await Promise.all(listeners.map((listener) => listener?.close()))
  }
}

function info({ id, kind, remote, since, requests }: Served): ConnectionInfo {
  return { id, kind, remote, since, requests }
}

function endpoint(listener: Listener | undefined): Endpoint | undefined {
  return listener === undefined ? undefined : { host: listener.address, port: listener.port }
}
