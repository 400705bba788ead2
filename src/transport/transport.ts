/**
 * What carries bytes: the client's side (`Transport`) and the simulator's side (`ServerConnection`, `Listener`).
 * Bytes only: no protocol is known here.
 */
import type { ConnectionError } from '../errors'

/** What a transport tells its owner. Never called from inside `open()`, except by a synchronous in-memory pair. */
export interface TransportHandlers {
  /** Once: bytes may be sent. A datagram transport is open when its socket is; it cannot know whether a peer exists. */
  opened(): void
  /** After `renew()`: bytes may be sent again. Only who renews needs it. */
  renewed?(): void
  /**
   * A chunk of the stream, or exactly one datagram. The bytes are lent until this returns, because a transport may read the
   * next ones into the same memory: who keeps any copies them.
   */
  received(bytes: Buffer): void
  /**
   * At most once, and nothing is called after it. `undefined`: the peer closed the connection in an orderly way (FIN).
   * Otherwise the reason; its `outcome` is `notSent` as long as nothing had been given to `send`.
   * Not called after the owner's own `close()`.
   */
  closed(error: ConnectionError | undefined): void
}

/** One connection attempt and the connection it becomes. It is not reused: the next attempt is another transport. */
export interface Transport {
  /** A stream is cut and joined anywhere; a datagram arrives whole, or not at all. */
  readonly kind: 'stream' | 'datagram'
  /**
   * Whether `renew()` moves to a new local port, so that nothing late can arrive. Not on a stream (close it instead),
   * and not where the user fixed the local port.
   */
  readonly renewable: boolean
  /** Whether bytes may be sent now: not before `opened`, and not between `renew()` and `renewed`. */
  readonly ready: boolean
  /** Starts the attempt. May be called once. */
  open(handlers: TransportHandlers): void
  /**
   * Sends a piece of the stream, or one datagram. Only between `opened` and `closed`/`close()`; outside it throws a
   * `ConnectionError` with outcome `notSent`, because silently dropped bytes would look like sent ones.
   * The bytes are not copied: do not change them afterwards. Nor does a transport change them: a request is sent again from the same bytes.
   */
  send(bytes: Uint8Array): void
  /**
   * Makes sure that late answers to earlier requests cannot arrive any more, by moving to a new local port. Nothing can
   * be sent until `renewed` is called, perhaps before this returns: what waits belongs to its owner, who may still give
   * it up. Throws where the transport is not `renewable`.
   */
  renew(): void
  /** Ends it at once. No handler is called afterwards. May be called at any time and again. */
  close(): void
  /** For messages and logs, e.g. `tcp 192.168.3.39:5007 (local 192.168.3.2:50231)`. */
  readonly description: string
}

/** Makes the transport for one connection attempt. */
export type OpenTransport = () => Transport

/** One client, seen from the listening side. For datagrams: one remote address and port. */
export interface ServerConnection {
  /** Unique within its listener, counting from 1. */
  readonly id: number
  /** Address and port of the client, e.g. `127.0.0.1:50231`. */
  readonly remote: string
  /** Sends to the client; ignored once the connection is gone, as a PLC's late answer would be. */
  send(bytes: Uint8Array): void
  /** Orderly end (FIN after what was sent). Datagram: forgets the client; its next datagram is a new connection. */
  close(): void
  /** Abrupt end (RST), which loses what was not yet delivered. Datagram: as `close`. */
  reset(): void
  /** To be set inside `onConnection`. Not called after `close` or `reset`. The buffer belongs to the receiver. */
  onReceived: (bytes: Buffer) => void
  /** To be set inside `onConnection`. Called exactly once, however the connection ended, also by this side. */
  onClosed: () => void
}

export interface ListenOptions {
  /** Address or name to listen on. Default 127.0.0.1, so that nothing is offered to a network unasked. */
  readonly host?: string | undefined
  /** 0 (default): any free port; read it from `Listener.port`. */
  readonly port?: number | undefined
  /** Called when the listening socket itself fails later on. Connections tell their own end by `onClosed`. */
  readonly onError?: ((error: ConnectionError) => void) | undefined
}

export interface Listener {
  readonly address: string
  readonly port: number
  /** Stops listening and ends all connections. The same promise for every call. */
  close(): Promise<void>
}
