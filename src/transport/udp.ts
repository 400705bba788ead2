/** Datagrams to and from one UDP port of a PLC. */
import { createSocket, type RemoteInfo, type Socket } from 'node:dgram'
import { isIPv6 } from 'node:net'
import type { ConnectionError } from '../errors'
import {
  checkEndpoint,
  describeLocal,
  describeTarget,
  type EndpointOptions,
  formatEndpoint,
  literalLookup,
  resolveAddress,
} from './endpoint'
import { connectFailure, notOpen, notRenewable, type Place } from './failure'
import type { OpenTransport, Transport, TransportHandlers } from './transport'

export type UdpOptions = EndpointOptions

/** Local ports that are not taken again so soon: an answer to a request from one of them may still be on its way. */
const REMEMBERED_PORTS = 256
/** Chance of meeting a remembered port is under 1 % per try where the system has its usual 28 000 ports to choose from. */
const PORT_TRIES = 16

/**
 * Makes datagram transports to one port of a PLC.
 *
 * The socket is connected: datagrams of other senders do not arrive, and where the PLC's side answers that nothing
 * listens there, the transport ends with CONNECT_FAILED. Empty datagrams carry nothing and are dropped.
 * A new port costs some 20 µs of processor time. Once `renew()` was called, the next port is opened behind each datagram that is
 * sent, while its answer is awaited; so the next `renew()` is over at once.
 * @throws RequestError BAD_OPTION
 * @example
 * const transport = udpTransport({ host: '192.168.3.39', port: 5008 })()
 * transport.open({ opened() { transport.send(request) }, received(datagram) {}, closed(error) {} })
 */
export function udpTransport(options: UdpOptions): OpenTransport {
  checkEndpoint(options)
  // Shared by all transports made here, so that a reconnection does not take an old port again either.
  const shared = { ports: new RecentPorts(), answered: false }
  return () => new UdpTransport(options, shared)
}

/** Of all transports to one port of a PLC. */
interface Shared {
  readonly ports: RecentPorts
  answered: boolean
}

class UdpTransport implements Transport {
  readonly kind = 'datagram'
  readonly #options: UdpOptions
  readonly #shared: Shared
  /** `failed`: the reason is on its way to `closed`. */
  #state: 'new' | 'opening' | 'open' | 'failed' | 'done' = 'new'
  #handlers: TransportHandlers | undefined
  /** What is sent leaves from it, and nothing is received from another. */
  #current: LocalPort | undefined
  /** The one of the next renewal. */
  #spare: LocalPort | undefined
  #renews = false
  /** The address of the peer as the senders of datagrams are spelt; learnt from the first socket. */
  #peer: string | undefined
  #address: string
  #sent = false

  constructor(options: UdpOptions, shared: Shared) {
    this.#options = options
    this.#shared = shared
    this.#address = options.host
  }

  get description(): string {
    const target = `udp ${formatEndpoint(this.#address, this.#options.port)}`
    if (this.#current?.isConnected !== true) return target
    // Asked for when needed: a system call saved for each renewal.
    const { address, port } = this.#current.own
    return `${target} (local ${formatEndpoint(address, port)})`
  }

  get renewable(): boolean {
    return !this.#options.localPort
  }

  get ready(): boolean {
    return this.#state === 'open' && this.#current?.isConnected === true
  }

  open(handlers: TransportHandlers): void {
    if (this.#state !== 'new') throw new Error(`${this.description}: open() was called before, make another transport`)
    this.#state = 'opening'
    this.#handlers = handlers
    resolveAddress(this.#options).then(
      (address) => {
        if (this.#state !== 'opening') return
        this.#address = address
        this.#current = this.#newPort()
        this.#current.open()
      },
      (error: unknown) => this.#fail(error),
    )
  }

  send(bytes: Uint8Array): void {
    // After a failure `closed` comes within this turn of the event loop and tells what became of it.
    if (this.#state === 'failed') return
    // What is kept here until the new port is open would leave from it although it had been given up meanwhile.
    if (this.#current === undefined || !this.ready) throw notOpen(this.description)
    this.#sent = true
    this.#current.send(bytes)
    // Not before the first renewal: with serial numbers there is none.
    if (this.#renews && this.#spare === undefined) {
      this.#spare = this.#newPort()
      this.#spare.open()
    }
  }

  renew(): void {
    if (this.#state === 'failed') return
    if (this.#state !== 'open') throw notOpen(this.description)
    if (!this.renewable) throw notRenewable(this.description)
    this.#renews = true
    const [old, spare] = [this.#current, this.#spare]
    this.#spare = undefined
    this.#current = spare ?? this.#newPort()
    if (spare === undefined) this.#current.open()
    else if (spare.isConnected) this.#handlers?.renewed?.()
    // Behind what was just sent. What it has received and not delivered is lost with it.
    old?.close()
  }

  close(): void {
    if (this.#state === 'done') return
    this.#state = 'done'
    this.#handlers = undefined
    this.#drop()
  }

  #newPort(): LocalPort {
    return new LocalPort(this.#options, this.#address, this.#shared.ports, {
      connected: (port) => this.#connected(port),
      // What came in between bind and connect can be from anybody.
      received: (port, bytes, from) => {
        if (port !== this.#current || from.port !== this.#options.port || from.address !== this.#peer) return
        this.#shared.answered = true
        if (bytes.length > 0) this.#handlers?.received(bytes)
      },
      failed: (port, error) => {
        if (port === this.#current) this.#fail(error)
        // Nobody needs it yet. Whoever will makes another, and hears of what is wrong with that.
        else if (port === this.#spare) this.#spare = undefined
        port.close()
      },
    })
  }

  #connected(port: LocalPort): void {
    if (port !== this.#current) return
    this.#peer ??= port.peer
    if (this.#state === 'opening') {
      this.#state = 'open'
      this.#handlers?.opened()
      return
    }
    this.#handlers?.renewed?.()
  }

  /** Never calls `closed` from inside `renew` or `send`: their caller is not prepared for it. */
  #fail(cause: unknown): void {
    if (this.#state === 'failed' || this.#state === 'done') return
    this.#state = 'failed'
    const error = this.#failure(cause)
    this.#drop()
    process.nextTick(() => {
      const handlers = this.#handlers
      this.close()
      handlers?.closed(error)
    })
  }

  #failure(cause: unknown): ConnectionError {
    const place: Place = {
      protocol: 'udp',
      target: describeTarget(this.#options, this.#address),
      local: describeLocal(this.#options),
      answeredBefore: this.#shared.answered,
    }
    return connectFailure(place, cause, this.#sent ? 'unknown' : 'notSent')
  }

  /** Lets go of the sockets; what they have received and not delivered is lost with them. */
  #drop(): void {
    this.#current?.close()
    this.#spare?.close()
    this.#current = undefined
    this.#spare = undefined
  }
}

interface PortEvents {
  readonly connected: (port: LocalPort) => void
  readonly received: (port: LocalPort, bytes: Buffer, from: RemoteInfo) => void
  readonly failed: (port: LocalPort, error: Error) => void
}

/** A socket on a local port of its own, connected to the peer. Nothing is told once it is closed. */
class LocalPort {
  readonly #options: UdpOptions
  readonly #address: string
  readonly #ports: RecentPorts
  readonly #events: PortEvents
  #socket: Socket | undefined
  #isConnected = false

  constructor(options: UdpOptions, address: string, ports: RecentPorts, events: PortEvents) {
    this.#options = options
    this.#address = address
    this.#ports = ports
    this.#events = events
  }

  /** Its owner must know it before: what is wrong may be told from inside. */
  open(): void {
    this.#bind(PORT_TRIES)
  }

  get isConnected(): boolean {
    return this.#isConnected
  }

  /** Its own address, when it is connected. */
  get own(): { readonly address: string; readonly port: number } {
    return this.#socket?.address() ?? { address: '', port: 0 }
  }

  /** The address of the peer as the senders of datagrams are spelt. */
  get peer(): string | undefined {
    return this.#socket?.remoteAddress().address
  }

  send(bytes: Uint8Array): void {
    const socket = this.#socket
    socket?.send(bytes, (error) => {
      if (error !== null && socket === this.#socket) this.#events.failed(this, error)
    })
  }

  close(): void {
    const socket = this.#socket
    this.#socket = undefined
    this.#isConnected = false
    socket?.close()
  }

  #bind(tries: number): void {
    const { port, localAddress, localPort = 0 } = this.#options
    const socket = createSocket({ type: isIPv6(this.#address) ? 'udp6' : 'udp4', lookup: literalLookup })
    this.#socket = socket
    // Stays attached for as long as the socket lives, so that a late error is never an unhandled one.
    socket.on('error', (error) => {
      if (socket === this.#socket) this.#events.failed(this, error)
    })
    socket.on('message', (bytes, from) => {
      if (socket === this.#socket) this.#events.received(this, bytes, from)
    })
    socket.on('connect', () => {
      if (socket !== this.#socket) return
      this.#isConnected = true
      this.#events.connected(this)
    })
    socket.on('listening', () => {
      if (socket !== this.#socket) return
      if (localPort === 0 && !this.#ports.take(socket.address().port)) {
        socket.close()
        if (tries > 1) this.#bind(tries - 1)
        else this.#events.failed(this, Object.assign(new Error('no fresh local port'), { code: 'EADDRNOTAVAIL' }))
        return
      }
      socket.connect(port, this.#address)
    })
    socket.bind({ port: localPort, ...(localAddress === undefined ? {} : { address: localAddress }), exclusive: true })
  }
}

/** The local ports used last. */
class RecentPorts {
  readonly #ports = new Set<number>()

  /** Whether the port may be used; it is remembered then. */
  take(port: number): boolean {
    if (this.#ports.has(port)) return false
    this.#ports.add(port)
    for (const oldest of this.#ports) {
      if (this.#ports.size <= REMEMBERED_PORTS) break
      this.#ports.delete(oldest)
    }
    return true
  }
}
