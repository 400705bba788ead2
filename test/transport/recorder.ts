/** Opens a transport and keeps what it says, so that tests can await and compare it. */
import { once } from 'node:events'
import { createServer, type Server, type Socket } from 'node:net'
import type { ConnectionError } from '../../src/errors'
import type { Transport } from '../../src/transport/transport'

export interface Recorder {
  readonly transport: Transport
  /** `opened`, `renewed`, `received`, `closed` in the order of the calls. */
  readonly calls: string[]
  readonly chunks: Buffer[]
  readonly opened: Promise<void>
  readonly closed: Promise<ConnectionError | undefined>
  /** Renews, and resolves when it is done. */
  renew(): Promise<void>
  /** Resolves when so many bytes have come in all. */
  bytes(count: number): Promise<Buffer>
}

export function record(
  transport: Transport,
  act: { onOpened?: () => void; onRenewed?: () => void; onReceived?: () => void } = {},
): Recorder {
  const calls: string[] = []
  const chunks: Buffer[] = []
  const renewals: (() => void)[] = []
  let received = 0
  const waiting: { count: number; resolve: (bytes: Buffer) => void }[] = []
  let opened = () => {}
  let closed: (error: ConnectionError | undefined) => void = () => {}
  const openedPromise = new Promise<void>((resolve) => {
    opened = resolve
  })
  const closedPromise = new Promise<ConnectionError | undefined>((resolve) => {
    closed = resolve
  })
  transport.open({
    opened() {
      calls.push('opened')
      opened()
      act.onOpened?.()
    },
    renewed() {
      calls.push('renewed')
      for (const resolve of renewals.splice(0)) resolve()
      act.onRenewed?.()
    },
    received(bytes) {
      calls.push('received')
      chunks.push(Buffer.from(bytes))
      received += bytes.length
      for (const entry of waiting) if (received >= entry.count) entry.resolve(Buffer.concat(chunks))
      act.onReceived?.()
    },
    closed(error) {
      calls.push('closed')
      closed(error)
    },
  })
  return {
    transport,
    calls,
    chunks,
    opened: openedPromise,
    closed: closedPromise,
    renew() {
      return new Promise((resolve) => {
        renewals.push(resolve)
        transport.renew()
      })
    },
    bytes(count) {
      if (received >= count) return Promise.resolve(Buffer.concat(chunks))
      return new Promise((resolve) => waiting.push({ count, resolve }))
    },
  }
}

/** Lets everything that is already due happen: several turns of the event loop. */
export async function settle(): Promise<void> {
  for (let turn = 0; turn < 5; turn++) await new Promise<void>((resolve) => setImmediate(resolve))
}

/** A plain server that does what a well-behaved one would not. Returns its port. */
export async function rawServer(
  onSocket: (socket: Socket) => void,
  options: { allowHalfOpen?: boolean; host?: string } = {},
): Promise<{ port: number; server: Server; close: () => Promise<void> }> {
  const sockets = new Set<Socket>()
  const server = createServer({ allowHalfOpen: options.allowHalfOpen ?? false }, (socket) => {
    sockets.add(socket)
    socket.on('error', () => {})
    onSocket(socket)
  })
  server.listen(0, options.host ?? '127.0.0.1')
  await once(server, 'listening')
  const address = server.address()
  if (address === null || typeof address === 'string') throw new Error('no port')
  return {
    port: address.port,
    server,
    async close() {
      for (const socket of sockets) socket.destroy()
      if (!server.listening) return
      server.close()
      await once(server, 'close')
    },
  }
}

/** A port nothing listens on: it was free a moment ago. */
export async function freePort(): Promise<number> {
  const { port, close } = await rawServer(() => {})
  await close()
  return port
}

/** Sockets and timers that keep the process busy. */
export function openHandles(): string[] {
  return process.getActiveResourcesInfo().filter((name) => /TCP|UDP|Timeout/.test(name))
}

/** As `openHandles`, for what sets no timers: those of the test runner come and go. */
export function openSockets(): string[] {
  return openHandles().filter((name) => name !== 'Timeout')
}
