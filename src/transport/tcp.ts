/** A TCP connection to a PLC. */
import { connect, type Socket } from 'node:net'
import { type ConnectionError, RequestError } from '../errors'
import { realClock } from './clock'
import {
  checkEndpoint,
  describeLocal,
  describeTarget,
  type EndpointOptions,
  formatEndpoint,
  resolveAddress,
} from './endpoint'
import { connectFailure, connectTimedOut, lostConnection, notOpen, notRenewable, type Place } from './failure'
import type { OpenTransport, Transport, TransportHandlers } from './transport'

export interface TcpOptions extends EndpointOptions {
  /** Milliseconds for name and connection together. Default: as long as the system tries (a minute or two). */
  readonly connectTimeout?: number | undefined
  /**
   * Milliseconds of silence after which the system starts to ask whether the peer still exists; `false`: never.
   * An unplugged cable sends nothing, so only this finds it on an idle connection. Default 10 000; 1000 or more.
   */
  readonly keepAlive?: number | false | undefined
}

const DEFAULT_KEEP_ALIVE = 10_000
/** Room for several of the largest frames; more arrives as further chunks. */
const READ_BUFFER_SIZE = 16_384

/**
 * Makes TCP connections to one port of a PLC.
 *
 * With a fixed `localPort`, `close()` resets the connection (RST) instead of ending it (FIN): after a FIN the system
 * holds the pair of ports for minutes (TIME_WAIT), and the next connection from the same port would fail that long.
 * @throws RequestError BAD_OPTION
 * @example
 * const open = tcpTransport({ host: '192.168.3.39', port: 5007 })
 * const transport = open()
 * transport.open({ opened() { transport.send(request) }, received(chunk) {}, closed(error) {} })
 */
export function tcpTransport(options: TcpOptions): OpenTransport {
  checkEndpoint(options)
  checkMilliseconds('connectTimeout', options.connectTimeout, 1)
  if (options.keepAlive !== false) checkMilliseconds('keepAlive', options.keepAlive, 1000)
  const history = { answered: false }
  return () => new TcpTransport(options, history)
}

class TcpTransport implements Transport {
  readonly kind = 'stream'
  readonly renewable = false
  readonly #options: TcpOptions
  readonly #history: { answered: boolean }
  #state: 'new' | 'opening' | 'open' | 'done' = 'new'
  #handlers: TransportHandlers | undefined
  #socket: Socket | undefined
  #address: string
  #local = ''
  #sent = false
  #cancelTimeout = () => {}

  /** `history`: of all transports to this port. */
  constructor(options: TcpOptions, history: { answered: boolean }) {
    this.#options = options
    this.#history = history
    this.#address = options.host
  }

  get description(): string {
    return `tcp ${formatEndpoint(this.#address, this.#options.port)}${this.#local}`
  }

  get ready(): boolean {
    return this.#state === 'open'
  }

  open(handlers: TransportHandlers): void {
    if (this.#state !== 'new') throw new Error(`${this.description}: open() was called before, make another transport`)
    this.#state = 'opening'
    this.#handlers = handlers
    const limit = this.#options.connectTimeout
    if (limit !== undefined) {
      this.#cancelTimeout = realClock.timer(limit, () => this.#finish(connectTimedOut(this.#place(), limit)))
    }
    resolveAddress(this.#options).then(
      (address) => this.#connect(address),
      (error: unknown) => this.#finish(this.#failure(error)),
    )
  }

  send(bytes: Uint8Array): void {
    if (this.#state !== 'open' || this.#socket === undefined) throw notOpen(this.description)
    this.#sent = true
    this.#socket.write(bytes)
  }

  renew(): void {
    throw notRenewable(this.description)
  }

  close(): void {
    const wasOpen = this.#state === 'open'
    if (this.#state === 'done') return
    this.#end()
    if (this.#socket === undefined) return
    if (wasOpen && this.#options.localPort) this.#socket.resetAndDestroy()
    else this.#socket.destroy()
  }

  #connect(address: string): void {
    if (this.#state !== 'opening') return
    this.#address = address
    const { port, localAddress, localPort, keepAlive = DEFAULT_KEEP_ALIVE } = this.#options
    // Reading into one buffer and lending what came costs less than Node's fresh 64 KB each time, or a copy.
    const buffer = Buffer.allocUnsafeSlow(READ_BUFFER_SIZE)
    // Most chunks are as long as the one before: the same view serves again.
    let lent = buffer
    const socket = connect({
      host: address,
      port,
      localAddress,
      localPort,
      autoSelectFamily: false,
      noDelay: true,
      keepAlive: keepAlive !== false,
      keepAliveInitialDelay: keepAlive === false ? 0 : keepAlive,
      onread: {
        buffer,
        callback: (length) => {
          this.#history.answered = true
          if (this.#state !== 'open') return true
          if (lent.length !== length) lent = buffer.subarray(0, length)
          this.#handlers?.received(lent)
          return true
        },
      },
    })
    this.#socket = socket
    socket.on('connect', () => this.#connected(socket))
    // The peer closed its half. A PLC has closed the connection then, so this half is closed too.
    socket.on('end', () => this.#finish(undefined))
    // Stays attached for as long as the socket lives, so that a late error is never an unhandled one.
    socket.on('error', (error) => this.#finish(this.#failure(error)))
    socket.on('close', () => this.#finish(this.#failure(new Error('the socket closed'))))
  }

  #connected(socket: Socket): void {
    if (this.#state !== 'opening') return
    this.#state = 'open'
    this.#cancelTimeout()
    if (socket.localAddress !== undefined && socket.localPort !== undefined) {
      this.#local = ` (local ${formatEndpoint(socket.localAddress, socket.localPort)})`
    }
    this.#handlers?.opened()
  }

  #finish(error: ConnectionError | undefined): void {
    if (this.#state === 'done') return
    const handlers = this.#handlers
    this.#end()
    this.#socket?.destroy()
    handlers?.closed(error)
  }

  #end(): void {
    this.#state = 'done'
    this.#handlers = undefined
    this.#cancelTimeout()
  }

  #failure(cause: unknown): ConnectionError {
    const outcome = this.#sent ? 'unknown' : 'notSent'
    return this.#state === 'open'
      ? lostConnection(this.#place(), cause, outcome)
      : connectFailure(this.#place(), cause, outcome)
  }

  #place(): Place {
    return {
      protocol: 'tcp',
      target: describeTarget(this.#options, this.#address),
      local: describeLocal(this.#options),
      answeredBefore: this.#history.answered,
    }
  }
}

function checkMilliseconds(field: string, value: number | undefined, min: number): void {
  if (value === undefined || (Number.isFinite(value) && value >= min)) return
  throw new RequestError('BAD_OPTION', `${field} ${String(value)}: give ${min} or more milliseconds`, field)
}
