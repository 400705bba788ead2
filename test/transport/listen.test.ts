import { once } from 'node:events'
import { connect } from 'node:net'
import { afterEach, describe, expect, test } from '@jest/globals'
import { ConnectionError, RequestError } from '../../src/errors'
import { listenTcp } from '../../src/transport/listen-tcp'
import { listenUdp, type UdpListenOptions } from '../../src/transport/listen-udp'
import { tcpTransport } from '../../src/transport/tcp'
import type { Listener, ListenOptions, ServerConnection } from '../../src/transport/transport'
import { udpTransport } from '../../src/transport/udp'
import { manualClock } from '../support/manual-clock'
import { openSockets, record, settle } from './recorder'

const host = '127.0.0.1'
const cleanups: (() => unknown)[] = []

afterEach(async () => {
  for (const cleanup of cleanups.splice(0)) await cleanup()
})

/** A server that notes what happens to it, and echoes. */
async function echoServer(
  listen: (options: UdpListenOptions, onConnection: (peer: ServerConnection) => void) => Promise<Listener>,
  options: UdpListenOptions = {},
) {
  const peers: ServerConnection[] = []
  const log: string[] = []
  let wake = () => {}
  const listener = await listen(options, (peer) => {
    peers.push(peer)
    log.push(`${peer.id} connected`)
    wake()
    peer.onReceived = (bytes) => {
      log.push(`${peer.id} received ${bytes}`)
      peer.send(bytes)
    }
    peer.onClosed = () => {
      log.push(`${peer.id} closed`)
      wake()
    }
  })
  cleanups.push(() => listener.close())
  const until = async (condition: () => boolean) => {
    while (!condition()) {
      await new Promise<void>((resolve) => {
        wake = resolve
      })
    }
  }
  return { listener, peers, log, until }
}

const kinds = [
  { kind: 'tcp', listen: listenTcp, transport: tcpTransport },
  { kind: 'udp', listen: listenUdp, transport: udpTransport },
] as const

describe.each(kinds)('listening on $kind', ({ kind, listen, transport }) => {
  function client(listener: Listener) {
    const recorder = record(transport({ host: listener.address, port: listener.port })())
    cleanups.push(() => recorder.transport.close())
    return recorder
  }

  test('gives each client its own connection, and its answers to it alone', async () => {
    const { listener, peers } = await echoServer(listen)
    const first = client(listener)
    const second = client(listener)
    await Promise.all([first.opened, second.opened])
    first.transport.send(Buffer.from('one'))
    expect(String(await first.bytes(3))).toBe('one')
    second.transport.send(Buffer.from('two'))
    expect(String(await second.bytes(3))).toBe('two')
    expect(peers.map((peer) => peer.id).sort()).toEqual([1, 2])
    expect(new Set(peers.map((peer) => peer.remote)).size).toBe(2)
    for (const peer of peers) expect(peer.remote).toMatch(/^127\.0\.0\.1:\d+$/)
  })

  test('listens on 127.0.0.1 unless told otherwise, also on IPv6', async () => {
    const { listener } = await echoServer(listen)
    expect(listener.address).toBe(host)
    const six = await echoServer(listen, { host: '::1' })
    const recorder = client(six.listener)
    await recorder.opened
    recorder.transport.send(Buffer.from('six'))
    expect(String(await recorder.bytes(3))).toBe('six')
    expect(six.peers[0]?.remote).toMatch(/^\[::1\]:\d+$/)
  })

  test('a taken port, an address of another computer and an unknown name are PORT_UNAVAILABLE', async () => {
    const { listener } = await echoServer(listen)
    const taken = await listen({ port: listener.port }, () => {}).catch((error: unknown) => error)
    expect(taken).toBeInstanceOf(ConnectionError)
    expect(taken).toMatchObject({ code: 'PORT_UNAVAILABLE' })
    expect(String(taken)).toContain(`${kind} 127.0.0.1:${listener.port} is already in use`)
    await expect(listen({ host: '203.0.113.7' }, () => {})).rejects.toMatchObject({ code: 'PORT_UNAVAILABLE' })
    await expect(listen({ port: 70_000 }, () => {})).rejects.toBeInstanceOf(RequestError)
  })

  test('close() ends every connection, tells each once, frees the port and leaves no handle', async () => {
    await settle()
    const before = openSockets()
    const { listener, log } = await echoServer(listen)
    const clients = [client(listener), client(listener)]
    for (const recorder of clients) {
      await recorder.opened
      recorder.transport.send(Buffer.from('x'))
      await recorder.bytes(1)
    }
    const closing = listener.close()
    expect(listener.close()).toBe(closing)
    await closing
    await settle()
    expect(log.filter((line) => line.endsWith('closed')).sort()).toEqual(['1 closed', '2 closed'])
    for (const recorder of clients) recorder.transport.close()
    const again = await listen({ port: listener.port }, () => {})
    await again.close()
    await settle()
    expect(openSockets()).toEqual(before)
  })

  test('after its own close() a connection receives and sends nothing and is told once', async () => {
    const { listener, peers, log, until } = await echoServer(listen)
    const recorder = client(listener)
    await recorder.opened
    recorder.transport.send(Buffer.from('a'))
    await recorder.bytes(1)
    const [peer] = peers
    peer?.close()
    peer?.close()
    peer?.send(Buffer.from('lost'))
    await until(() => log.includes('1 closed'))
    peer?.reset()
    await settle()
    expect(log.filter((line) => line === '1 closed')).toHaveLength(1)
    expect(recorder.chunks.map(String)).toEqual(['a'])
  })
})

describe('TCP', () => {
  async function connected(options: ListenOptions = {}) {
    const server = await echoServer(listenTcp, options)
    const recorder = record(tcpTransport({ host, port: server.listener.port })())
    cleanups.push(() => recorder.transport.close())
    await recorder.opened
    await server.until(() => server.peers.length > 0)
    const [peer] = server.peers
    if (peer === undefined) throw new Error('no peer')
    return { ...server, recorder, peer }
  }

  test('close() sends what is left and then FIN', async () => {
    const { recorder, peer } = await connected()
    const last = Buffer.alloc(500_000, 'z')
    peer.send(last)
    peer.close()
    expect(await recorder.closed).toBeUndefined()
    expect(Buffer.concat(recorder.chunks).equals(last)).toBe(true)
  })

  test('reset() sends RST and no FIN, every time', async () => {
    for (let i = 0; i < 30; i++) {
      const { recorder, peer } = await connected()
      if (i % 2 === 1) {
        recorder.transport.send(Buffer.from('x'))
        await recorder.bytes(1)
      }
      peer.reset()
      expect(await recorder.closed).toMatchObject({ code: 'DISCONNECTED' })
    }
  })

  test('a connection can be closed while it is accepted', async () => {
    const log: string[] = []
    const listener = await listenTcp({}, (peer) => {
      peer.onClosed = () => log.push('closed')
      peer.close()
    })
    cleanups.push(() => listener.close())
    const recorder = record(tcpTransport({ host, port: listener.port })())
    expect(await recorder.closed).toBeUndefined()
    expect(recorder.calls).toEqual(['opened', 'closed'])
    await listener.close()
    expect(log).toEqual(['closed'])
  })

  test('a client that ends or resets is told once, without an unhandled error', async () => {
    const { listener, log, until } = await echoServer(listenTcp)
    const ending = connect(listener.port, host)
    await once(ending, 'connect')
    ending.end()
    await until(() => log.includes('1 closed'))
    const resetting = connect(listener.port, host)
    await once(resetting, 'connect')
    resetting.write('x')
    await once(resetting, 'data')
    resetting.resetAndDestroy()
    await until(() => log.includes('2 closed'))
    await settle()
    expect(log.filter((line) => line.endsWith('closed'))).toEqual(['1 closed', '2 closed'])
  })

  test('a client that keeps its half open is cut off after the server has closed', async () => {
    const { listener, log, peers, until } = await echoServer(listenTcp)
    const stubborn = connect({ port: listener.port, host, allowHalfOpen: true })
    cleanups.push(() => stubborn.destroy())
    stubborn.resume()
    await until(() => peers.length > 0)
    peers[0]?.close()
    await until(() => log.includes('1 closed'))
    expect(stubborn.destroyed).toBe(false)
  })
})

describe('UDP', () => {
  async function sender(listener: Listener) {
    const recorder = record(udpTransport({ host, port: listener.port })())
    cleanups.push(() => recorder.transport.close())
    await recorder.opened
    let expected = 0
    return {
      ...recorder,
      async exchange(text: string) {
        recorder.transport.send(Buffer.from(text))
        expected += text.length
        await recorder.bytes(expected)
      },
    }
  }

  test('forgets a client that was silent for the idle timeout, and no other', async () => {
    const clock = manualClock()
    const { listener, log } = await echoServer(listenUdp, { clock, idleTimeout: 1000 })
    const quiet = await sender(listener)
    const busy = await sender(listener)
    await quiet.exchange('q')
    await busy.exchange('b')
    clock.advance(900)
    await busy.exchange('b')
    clock.advance(100)
    expect(log.filter((line) => line.endsWith('closed'))).toEqual(['1 closed'])
    clock.advance(900)
    await quiet.exchange('q')
    expect(log.at(-2)).toBe('3 connected')
    clock.advance(10_000)
    expect(log.filter((line) => line.endsWith('closed'))).toEqual(['1 closed', '2 closed', '3 closed'])
    expect(clock.pending).toBe(0)
  })

  test('keeps at most maxPeers clients: the one silent for longest gives way', async () => {
    const { listener, log } = await echoServer(listenUdp, { maxPeers: 2 })
    const [a, b, c] = [await sender(listener), await sender(listener), await sender(listener)]
    await a.exchange('a')
    await b.exchange('b')
    await a.exchange('a')
    await c.exchange('c')
    expect(log.filter((line) => line.endsWith('closed'))).toEqual(['2 closed'])
  })

  test('a client that was closed by the server is a new connection when it sends again', async () => {
    const { listener, log, peers } = await echoServer(listenUdp)
    const client = await sender(listener)
    await client.exchange('a')
    peers[0]?.close()
    await client.exchange('b')
    expect(log).toEqual(['1 connected', '1 received a', '1 closed', '2 connected', '2 received b'])
  })

  test('empty datagrams make no connection', async () => {
    const { listener, log } = await echoServer(listenUdp)
    const client = await sender(listener)
    client.transport.send(Buffer.alloc(0))
    await client.exchange('full')
    expect(log).toEqual(['1 connected', '1 received full'])
  })

  test('an answer to a client that has gone harms nothing', async () => {
    const { listener, peers } = await echoServer(listenUdp)
    const gone = await sender(listener)
    await gone.exchange('x')
    gone.transport.close()
    peers[0]?.send(Buffer.from('too late'))
    await settle()
    const other = await sender(listener)
    await other.exchange('y')
    expect(other.chunks.map(String)).toEqual(['y'])
  })

  test('limits are checked', async () => {
    await expect(listenUdp({ idleTimeout: 0 }, () => {})).rejects.toMatchObject({ field: 'idleTimeout' })
    await expect(listenUdp({ maxPeers: 0.5 }, () => {})).rejects.toMatchObject({ field: 'maxPeers' })
  })
})
