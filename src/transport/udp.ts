/** Datagrams to and from one UDP port of a PLC. */
import { createSocket, type Socket } from 'node:dgram'
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
 * `renew()` costs about 60 µs of CPU; nothing can be sent until the new socket is there.
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
  #socket: Socket | undefined
  /** The socket is connected. */
  #connected = false
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
    if (this.#socket === undefined || !this.#connected) return target
    // Asked for when needed: a system call saved for each renewal.
    const { address, port } = this.#socket.address()
    return `${target} (local ${formatEndpoint(address, port)})`
  }

  get renewable(): boolean {
    return !this.#options.localPort
  }

  get ready(): boolean {
    return this.#state === 'open' && this.#connected
  }

  open(handlers: TransportHandlers): void {
    if (this.#state !== 'new') throw new Error(`${this.description}: open() was called before, make another transport`)
    this.#state = 'opening'
    this.#handlers = handlers
    resolveAddress(this.#options).then(
      (address) => {
        if (this.#state !== 'opening') return
        this.#address = address
        this.#bind(PORT_TRIES)
      },
      (error: unknown) => this.#fail(error),
    )
  }

  send(bytes: Uint8Array): void {
    // After a failure `closed` comes within this turn of the event loop and tells what became of it.
    if (this.#state === 'failed') return
    if (this.#state !== 'open') throw notOpen(this.description)
    // What is kept here until the new port is open would leave from it although it had been given up meanwhile.
    if (!this.#connected) throw notOpen(this.description)
    this.#sent = true
    this.#post(bytes)
  }

  renew(): void {
    if (this.#state === 'failed') return
    if (this.#state !== 'open') throw notOpen(this.description)
    if (!this.renewable) throw notRenewable(this.description)
    this.#drop()
    this.#bind(PORT_TRIES)
  }

  close(): void {
    if (this.#state === 'done') return
    this.#state = 'done'
    this.#handlers = undefined
    this.#drop()
  }

  #bind(tries: number): void {
    const { port, localAddress, localPort = 0 } = this.#options
    const socket = createSocket({ type: isIPv6(this.#address) ? 'udp6' : 'udp4', lookup: literalLookup })
    this.#socket = socket
    // Stays attached for as long as the socket lives, so that a late error is never an unhandled one.
    socket.on('error', (error) => {
      if (socket === this.#socket) this.#fail(error)
    })
    socket.on('message', (bytes, from) => {
      // What came in between bind and connect can be from anybody.
      if (socket !== this.#socket || from.port !== port || from.address !== this.#peer) return
      this.#shared.answered = true
      if (bytes.length > 0) this.#handlers?.received(bytes)
    })
    socket.on('connect', () => {
      if (socket === this.#socket) this.#reached(socket)
    })
    socket.on('listening', () => {
      if (socket !== this.#socket) return
      if (localPort === 0 && !this.#shared.ports.take(socket.address().port)) {
        this.#drop()
        if (tries > 1) this.#bind(tries - 1)
        else this.#fail(Object.assign(new Error('no fresh local port'), { code: 'EADDRNOTAVAIL' }))
        return
      }
      socket.connect(port, this.#address)
    })
    socket.bind({ port: localPort, ...(localAddress === undefined ? {} : { address: localAddress }), exclusive: true })
  }

  #reached(socket: Socket): void {
    this.#connected = true
    this.#peer ??= socket.remoteAddress().address
    if (this.#state === 'opening') {
      this.#state = 'open'
      this.#handlers?.opened()
      return
    }
    this.#handlers?.renewed?.()
  }

  #post(bytes: Uint8Array): void {
    const socket = this.#socket
    socket?.send(bytes, (error) => {
      if (error !== null && socket === this.#socket) this.#fail(error)
    })
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

  /** Lets go of the socket; what it has received and not delivered is lost with it. */
  #drop(): void {
    this.#socket?.close()
    this.#socket = undefined
    this.#connected = false
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
