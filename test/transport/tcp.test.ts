import { once } from 'node:events'
import type { Socket } from 'node:net'
import { afterEach, describe, expect, test } from '@jest/globals'
import { ConnectionError, RequestError } from '../../src/errors'
import { type TcpOptions, tcpTransport } from '../../src/transport/tcp'
import { freePort, openHandles, rawServer, record, settle } from './recorder'

const host = '127.0.0.1'
const cleanups: (() => unknown)[] = []

afterEach(async () => {
  for (const cleanup of cleanups.splice(0)) await cleanup()
})

async function serve(onSocket: (socket: Socket) => void = () => {}, options: Parameters<typeof rawServer>[1] = {}) {
  const server = await rawServer(onSocket, options)
  cleanups.push(server.close)
  return server
}

function open(options: Omit<TcpOptions, 'host'> & { host?: string }, act?: Parameters<typeof record>[1]) {
  const recorder = record(tcpTransport({ host, ...options })(), act)
  cleanups.push(() => recorder.transport.close())
  return recorder
}

async function failure(options: Omit<TcpOptions, 'host'> & { host?: string }): Promise<ConnectionError> {
  const recorder = open(options)
  const error = await recorder.closed
  await settle()
  expect(recorder.calls).toEqual(['closed'])
  expect(error).toBeInstanceOf(ConnectionError)
  if (error === undefined) throw new Error('no error')
  return error
}

describe('opening', () => {
  test('opens once, sends, receives and tells both addresses', async () => {
    const { port } = await serve((socket) => socket.pipe(socket))
    const client = open({ port })
    expect(client.calls).toEqual([])
    await client.opened
    client.transport.send(Buffer.from('hello'))
    expect(await client.bytes(5)).toEqual(Buffer.from('hello'))
    expect(client.calls).toEqual(['opened', 'received'])
    expect(client.transport.kind).toBe('stream')
    expect(client.transport.description).toMatch(
      new RegExp(`^tcp 127\\.0\\.0\\.1:${port} \\(local 127\\.0\\.0\\.1:\\d+\\)$`),
    )
  })

  test('works over IPv6', async () => {
    const { port } = await serve((socket) => socket.pipe(socket), { host: '::1' })
    const client = open({ host: '::1', port })
    await client.opened
    client.transport.send(Buffer.from('six'))
    expect(await client.bytes(3)).toEqual(Buffer.from('six'))
    expect(client.transport.description).toContain(`tcp [::1]:${port} (local [::1]:`)
  })

  test('uses the local address and port it is given', async () => {
    const localPort = await freePort()
    const remotes: unknown[] = []
    const { port } = await serve((socket) => remotes.push(`${socket.remoteAddress}:${socket.remotePort}`))
    const client = open({ port, localAddress: '127.0.0.2', localPort })
    await client.opened
    await settle()
    expect(remotes).toEqual([`127.0.0.2:${localPort}`])
  })

  test('prefers the IPv4 address of a name and connects once only', async () => {
    let connections = 0
    const { port } = await serve(() => connections++)
    const client = open({ host: 'plc1', port, resolve: async () => ['::1', host, '127.0.0.2'] })
    await client.opened
    await settle()
    expect(connections).toBe(1)
    expect(client.transport.description).toContain(`tcp ${host}:${port}`)
  })

  test('a second open() of the same transport is refused', async () => {
    const { port } = await serve()
    const client = open({ port })
    await client.opened
    expect(() => record(client.transport)).toThrow('make another transport')
  })
})

describe('failing to open', () => {
  test('a refused connection says where and what to look at', async () => {
    const port = await freePort()
    const error = await failure({ port })
    expect(error.code).toBe('CONNECT_FAILED')
    expect(error.outcome).toBe('notSent')
    expect(error.message).toContain(`tcp 127.0.0.1:${port}: the connection was refused`)
    expect(error.message).toContain('ECONNREFUSED')
    expect(error.causes[0]).toContain('port number')
  })

  test('where something answered before, a wrong port is not what is thought of', async () => {
    const server = await serve((socket) => socket.pipe(socket))
    const transports = tcpTransport({ host, port: server.port })
    const first = record(transports())
    await first.opened
    first.transport.send(Buffer.from('x'))
    await first.bytes(1)
    first.transport.close()
    await server.close()
    const error = await record(transports()).closed
    expect(error?.message).toContain('ECONNREFUSED')
    expect(error?.causes[0]).toBe('the PLC is restarting, and does not take connections yet')
    expect(error?.causes.join()).not.toContain('port number')
  })

  test('a name that cannot be resolved', async () => {
    const notFound = Object.assign(new Error('getaddrinfo ENOTFOUND plc1'), { code: 'ENOTFOUND' })
    const error = await failure({ host: 'plc1', port: 5007, resolve: () => Promise.reject(notFound) })
    expect(error.code).toBe('CONNECT_FAILED')
    expect(error.message).toContain('tcp plc1:5007: the host name could not be resolved')
    expect(error.cause).toBe(notFound)
  })

  test('a name without addresses, or with none that fits the local address', async () => {
    expect((await failure({ host: 'plc1', port: 5007, resolve: async () => [] })).message).toContain('ENOTFOUND')
    const options = { host: 'plc1', port: 5007, localAddress: '127.0.0.1', resolve: async () => ['::1'] }
    expect((await failure(options)).message).toContain('ENOTFOUND')
  })

  test('a local port on which another program listens', async () => {
    const other = await serve()
    const { port } = await serve()
    const error = await failure({ port, localPort: other.port })
    expect(error.code).toBe('PORT_UNAVAILABLE')
    expect(error.outcome).toBe('notSent')
    expect(error.message).toContain(`tcp 127.0.0.1:${port}: tcp local port ${other.port} is already in use`)
  })

  test('a local port that already has a connection to the same PLC port', async () => {
    const { port } = await serve()
    const localPort = await freePort()
    await open({ port, localPort }).opened
    const error = await failure({ port, localPort })
    expect(error.code).toBe('PORT_UNAVAILABLE')
    expect(error.message).toContain(`local port ${localPort} still holds an earlier connection`)
  })

  test('a local address that is not of this computer', async () => {
    const { port } = await serve()
    const error = await failure({ port, localAddress: '203.0.113.7' })
    expect(error.code).toBe('PORT_UNAVAILABLE')
    expect(error.message).toContain('203.0.113.7 is not an address of this computer')
  })

  test('no connection within connectTimeout, which includes the name', async () => {
    const error = await failure({ host: 'plc1', port: 5007, connectTimeout: 5, resolve: () => new Promise(() => {}) })
    expect(error.code).toBe('CONNECT_FAILED')
    expect(error.message).toContain('within 5 ms')
  })

  test('a resolver that answers after connectTimeout opens nothing', async () => {
    let connections = 0
    const { port } = await serve(() => connections++)
    let answer: (addresses: string[]) => void = () => {}
    const resolve = () =>
      new Promise<string[]>((done) => {
        answer = done
      })
    await failure({ host: 'plc1', port, connectTimeout: 5, resolve })
    answer([host])
    await settle()
    expect(connections).toBe(0)
  })

  test.each([
    [{ host: '', port: 1 }, 'host'],
    [{ host: ' ', port: 1 }, 'host'],
    [{ host, port: 0 }, 'port'],
    [{ host, port: 65536 }, 'port'],
    [{ host, port: 1.5 }, 'port'],
    [{ host, port: Number.NaN }, 'port'],
    [{ host, port: 1, localPort: -1 }, 'localPort'],
    [{ host, port: 1, localAddress: 'eth0' }, 'localAddress'],
    [{ host, port: 1, localAddress: '::1' }, 'localAddress'],
    [{ host, port: 1, connectTimeout: 0 }, 'connectTimeout'],
    [{ host, port: 1, keepAlive: 10 }, 'keepAlive'],
  ])('options %j are refused before anything is tried, naming %s', (options, field) => {
    expect(() => tcpTransport(options)).toThrow(RequestError)
    expect(() => tcpTransport(options)).toThrow(expect.objectContaining({ code: 'BAD_OPTION', field }))
  })
})

describe('ending', () => {
  test('accepted, then closed at once by the peer: opened, then closed without error, each once', async () => {
    const { port } = await serve((socket) => socket.end())
    const client = open({ port })
    expect(await client.closed).toBeUndefined()
    await settle()
    expect(client.calls).toEqual(['opened', 'closed'])
  })

  test('what came before the FIN is received before closed', async () => {
    const { port } = await serve((socket) => socket.end('last words'))
    const client = open({ port })
    expect(await client.closed).toBeUndefined()
    expect(Buffer.concat(client.chunks).toString()).toBe('last words')
    expect(client.calls.at(-1)).toBe('closed')
  })

  test('a peer that closes only its half gets the other half closed too', async () => {
    let peerSawEnd: Promise<unknown> = Promise.resolve()
    const { port } = await serve(
      (socket) => {
        peerSawEnd = once(socket, 'end')
        socket.resume()
        socket.end()
      },
      { allowHalfOpen: true },
    )
    const client = open({ port })
    expect(await client.closed).toBeUndefined()
    await peerSawEnd
  })

  test('a reset is an error, with outcome notSent before and unknown after a send', async () => {
    const sockets: Socket[] = []
    const { port } = await serve((socket) => {
      sockets.push(socket)
      socket.on('data', () => socket.resetAndDestroy())
    })
    const silent = open({ port })
    await silent.opened
    await settle()
    sockets[0]?.resetAndDestroy()
    const first = await silent.closed
    expect(first).toMatchObject({ code: 'DISCONNECTED', outcome: 'notSent' })
    expect(first?.message).toContain(`tcp 127.0.0.1:${port}: the peer reset the connection`)

    const busy = open({ port })
    await busy.opened
    busy.transport.send(Buffer.from('request'))
    expect(await busy.closed).toMatchObject({ code: 'DISCONNECTED', outcome: 'unknown' })
    await settle()
    expect(busy.calls).toEqual(['opened', 'closed'])
  })

  test('a reset in the middle of a stream ends it once, also while sends go on', async () => {
    const { port } = await serve((socket) => {
      socket.write(Buffer.alloc(100_000))
      socket.once('data', () => socket.resetAndDestroy())
    })
    const client = open({ port })
    await client.opened
    for (let i = 0; i < 50; i++) client.transport.send(Buffer.alloc(10_000))
    expect(await client.closed).toMatchObject({ code: 'DISCONNECTED', outcome: 'unknown' })
    await settle()
    expect(client.calls.filter((call) => call === 'closed')).toHaveLength(1)
    expect(client.calls.at(-1)).toBe('closed')
  })

  test('after our own close no handler is called, and the peer sees the end', async () => {
    let ended: Promise<unknown> = Promise.resolve()
    const { port } = await serve((socket) => {
      ended = once(socket, 'end')
      socket.resume()
    })
    const client = open({ port })
    await client.opened
    await settle()
    client.transport.close()
    client.transport.close()
    await ended
    await settle()
    expect(client.calls).toEqual(['opened'])
  })

  test('closing before, while and right after opening calls nothing more', async () => {
    const { port } = await serve((socket) => socket.end('data'))
    const unopened = tcpTransport({ host, port })()
    unopened.close()

    const early = open({ port })
    early.transport.close()

    const connecting = open({ port })
    await Promise.resolve()
    await Promise.resolve()
    connecting.transport.close()

    const inHandler = record(tcpTransport({ host, port })(), { onOpened: () => inHandler.transport.close() })
    await inHandler.opened
    await settle()
    expect([early.calls, connecting.calls, inHandler.calls]).toEqual([[], [], ['opened']])
  })

  test('closing inside received() stops what would come next', async () => {
    const { port } = await serve((socket) => {
      socket.write('a')
      setImmediate(() => socket.end('b'))
    })
    const client = record(tcpTransport({ host, port })(), { onReceived: () => client.transport.close() })
    await client.bytes(1)
    await settle()
    expect(client.calls).toEqual(['opened', 'received'])
  })

  test('send outside of open is refused as not sent', async () => {
    const { port } = await serve()
    const client = open({ port })
    const notSent = expect.objectContaining({ code: 'DISCONNECTED', outcome: 'notSent' })
    expect(() => client.transport.send(Buffer.from('x'))).toThrow(notSent)
    await client.opened
    client.transport.close()
    expect(() => client.transport.send(Buffer.from('x'))).toThrow(notSent)
  })

  test('a stream cannot be renewed', async () => {
    const { port } = await serve()
    const client = open({ port })
    await client.opened
    expect(client.transport.renewable).toBe(false)
    expect(() => client.transport.renew()).toThrow('its local port cannot be changed')
  })

  test('a fixed local port can be used again right after our own close, because that resets', async () => {
    const endings: string[] = []
    const { port } = await serve((socket) => {
      socket.on('error', (error: NodeJS.ErrnoException) => endings.push(error.code ?? ''))
      socket.on('end', () => endings.push('end'))
      socket.pipe(socket)
    })
    const localPort = await freePort()
    for (let i = 0; i < 5; i++) {
      const client = open({ port, localPort })
      await client.opened
      client.transport.send(Buffer.from('x'))
      await client.bytes(1)
      client.transport.close()
    }
    await settle()
    expect(endings.length).toBeGreaterThan(0)
    expect(new Set(endings)).toEqual(new Set(['ECONNRESET']))
  })
})

describe('carrying', () => {
  test('a megabyte in each direction arrives whole and in order, in chunks that keep their content', async () => {
    const { port } = await serve((socket) => socket.pipe(socket))
    const client = open({ port })
    await client.opened
    const data = Buffer.alloc(1 << 20, 0)
    for (let i = 0; i < data.length; i += 4) data.writeUInt32LE(i, i)
    client.transport.send(data.subarray(0, 300_000))
    client.transport.send(data.subarray(300_000))
    expect((await client.bytes(data.length)).equals(data)).toBe(true)
    expect(client.chunks.length).toBeGreaterThan(1)
  })
})

test('1000 connections opened and closed in every way leave no handle and no listener', async () => {
  await settle()
  const before = openHandles()
  const server = await rawServer((socket) => {
    socket.resume()
    if ((socket.remotePort ?? 0) % 2 === 0) socket.end()
  })
  const refusedPort = await freePort()
  for (let i = 0; i < 1000; i++) {
    const port = i % 5 === 4 ? refusedPort : server.port
    const client = record(tcpTransport({ host, port, connectTimeout: 60_000 })())
    if (i % 5 === 0) client.transport.close()
    else await Promise.race([client.opened, client.closed])
    client.transport.close()
  }
  await server.close()
  await settle()
  expect(openHandles()).toEqual(before)
})
