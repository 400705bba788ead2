/** Listening on TCP, for the simulator. */
import { createServer, type Socket } from 'node:net'
import { realClock } from './clock'
import { checkPort, formatEndpoint, resolveAddress } from './endpoint'
import { listenFailure } from './failure'
import type { Listener, ListenOptions, ServerConnection } from './transport'

/** How long a client may keep its half open after this side ended the connection. */
const LINGER = 2_000
/** A client that sends requests and reads no answers is cut off at this many unread bytes. */
const MOST_UNREAD = 16 * 1024 * 1024

/**
 * Listens for TCP connections.
 * @throws RequestError BAD_OPTION; rejects with ConnectionError PORT_UNAVAILABLE when the port cannot be had
 * @example
 * const listener = await listenTcp({ port: 0 }, (peer) => {
 *   peer.onReceived = (chunk) => peer.send(chunk)
 * })
 */
export async function listenTcp(
  options: ListenOptions,
  onConnection: (peer: ServerConnection) => void,
): Promise<Listener> {
  const { host = '127.0.0.1', port = 0, onError } = options
  checkPort('port', port, 0)
  const failure = (error: unknown) => listenFailure('tcp', formatEndpoint(host, port), error)
  const address = await resolveAddress({ host, port }).catch((error: unknown) => {
    throw failure(error)
  })
  const sockets = new Set<Socket>()
  let connections = 0
  const server = createServer({ noDelay: true }, (socket) => {
    const peer = new TcpConnection(++connections, socket)
    sockets.add(socket)
    socket.on('close', () => {
      sockets.delete(socket)
      finish()
    })
    onConnection(peer)
  })
  // Node calls a server closed while the last of its sockets has not said so yet.
  let finished = () => {}
  let closing = false
  const closed = new Promise<void>((resolve) => {
    finished = resolve
  })
  const finish = () => {
    if (closing && !server.listening && sockets.size === 0) finished()
  }
  await new Promise<void>((resolve, reject) => {
    server.once('error', (error) => reject(failure(error)))
    server.listen({ host: address, port, exclusive: true }, resolve)
  })
  server.removeAllListeners('error')
  server.on('error', (error) => onError?.(failure(error)))

  const bound = server.address()
  return {
    address: bound !== null && typeof bound === 'object' ? bound.address : address,
    port: bound !== null && typeof bound === 'object' ? bound.port : port,
    close() {
      if (!closing) {
        closing = true
        server.close(finish)
        for (const socket of sockets) socket.destroy()
      }
      return closed
    },
  }
}

class TcpConnection implements ServerConnection {
  onReceived: (bytes: Buffer) => void = () => {}
  onClosed: () => void = () => {}
  readonly remote: string
  readonly #socket: Socket
  #ended = false

  constructor(
    readonly id: number,
    socket: Socket,
  ) {
    this.#socket = socket
    this.remote = formatEndpoint(socket.remoteAddress ?? 'unknown', socket.remotePort ?? 0)
    socket.on('data', (bytes) => {
      if (!this.#ended) this.onReceived(bytes)
    })
    // 'close' follows and tells the owner; a client that went away is nothing unusual to a server.
    socket.on('error', () => {})
    socket.on('close', () => {
      this.#ended = true
      this.onClosed()
    })
  }

  send(bytes: Uint8Array): void {
    if (this.#ended) return
    this.#socket.write(bytes)
    if (this.#socket.writableLength > MOST_UNREAD) this.reset()
  }

  close(): void {
    if (this.#ended) return
    this.#ended = true
    this.#socket.end()
    const cancel = realClock.timer(LINGER, () => this.#socket.destroy(), { unref: true })
    this.#socket.once('close', cancel)
  }

  reset(): void {
    this.#ended = true
    if (!this.#socket.destroyed) this.#socket.resetAndDestroy()
  }
}
