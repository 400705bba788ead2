import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import type { Side } from '../../src/transport/delivery'
import { listenMemory, type MemoryOptions } from '../../src/transport/memory'
import type { ServerConnection } from '../../src/transport/transport'
import { joinAll, splitEvery } from '../support/chunking'
import { record } from './recorder'

/** A server in memory that echoes and notes what happens to it. */
function echo(options: MemoryOptions = {}) {
  const peers: ServerConnection[] = []
  const log: string[] = []
  const memory = listenMemory({ delivery: 'manual', ...options }, (peer) => {
    peers.push(peer)
    log.push(`${peer.id} connected`)
    peer.onReceived = (bytes) => {
      log.push(`${peer.id} received ${bytes}`)
      peer.send(bytes)
    }
    peer.onClosed = () => log.push(`${peer.id} closed`)
  })
  return { memory, peers, log }
}

const kinds = ['stream', 'datagram'] as const

describe.each(kinds)('a %s in memory', (kind) => {
  test('opens, carries both ways and tells its kind', () => {
    const { memory, log } = echo({ kind })
    const client = record(memory.open())
    expect(client.calls).toEqual([])
    memory.deliver()
    client.transport.send(Buffer.from('a'))
    client.transport.send(Buffer.from('b'))
    expect(client.chunks).toEqual([])
    memory.deliver()
    expect(client.chunks.map(String)).toEqual(['a', 'b'])
    expect(log).toEqual(['1 connected', '1 received a', '1 received b'])
    expect(client.transport.kind).toBe(kind)
    expect(client.transport.description).toBe('memory (local 1)')
  })

  test('delivers one by one when told so', () => {
    const { memory } = echo({ kind })
    const client = record(memory.open())
    memory.deliver()
    client.transport.send(Buffer.from('a'))
    client.transport.send(Buffer.from('b'))
    expect(memory.pending).toBe(2)
    expect(memory.deliver(1)).toBe(1)
    expect(client.chunks).toEqual([])
    expect(memory.deliver()).toBe(3)
    expect(memory.pending).toBe(0)
  })

  test('what is sent is a copy: the sender may change its bytes', () => {
    const { memory } = echo({ kind })
    const client = record(memory.open())
    memory.deliver()
    const bytes = Buffer.from('before')
    client.transport.send(bytes)
    bytes.fill('x')
    memory.deliver()
    expect(client.chunks.map(String)).toEqual(['before'])
  })

  test('synchronous delivery has happened when open and send return', () => {
    const { memory } = echo({ kind, delivery: 'synchronous' })
    const client = record(memory.open())
    expect(client.calls).toEqual(['opened'])
    client.transport.send(Buffer.from('a'))
    expect(client.chunks.map(String)).toEqual(['a'])
  })

  test('microtask delivery happens after the current code', async () => {
    const { memory } = echo({ kind, delivery: 'microtask' })
    const client = record(memory.open())
    expect(client.calls).toEqual([])
    await client.opened
    client.transport.send(Buffer.from('a'))
    expect(client.chunks).toEqual([])
    expect(String(await client.bytes(1))).toBe('a')
  })

  test('after our own close nothing is called; the server receives what came before and is told once', () => {
    const { memory, log } = echo({ kind })
    const client = record(memory.open())
    memory.deliver()
    client.transport.send(Buffer.from('a'))
    client.transport.close()
    client.transport.close()
    memory.deliver()
    expect(client.calls).toEqual(['opened'])
    expect(log).toEqual(['1 connected', '1 received a', '1 closed'])
  })

  test('send outside of open is refused as not sent', () => {
    const { memory } = echo({ kind })
    const client = record(memory.open())
    const notSent = expect.objectContaining({ code: 'DISCONNECTED', outcome: 'notSent' })
    expect(() => client.transport.send(Buffer.from('x'))).toThrow(notSent)
    memory.deliver()
    client.transport.close()
    expect(() => client.transport.send(Buffer.from('x'))).toThrow(notSent)
    expect(() => record(client.transport)).toThrow('make another transport')
  })

  test('a listener that refuses fails with CONNECT_FAILED', () => {
    const { memory, log } = echo({ kind })
    memory.refuse = true
    const errors: unknown[] = []
    const transport = memory.open()
    transport.open({ opened: () => transport.send(Buffer.from('x')), received() {}, closed: (e) => errors.push(e) })
    memory.deliver()
    expect(errors).toEqual([
      expect.objectContaining({ code: 'CONNECT_FAILED', outcome: kind === 'stream' ? 'notSent' : 'unknown' }),
    ])
    expect(log).toEqual([])
  })

  test('closing the listener tells every connection once', () => {
    const { memory, log } = echo({ kind })
    for (const client of [record(memory.open()), record(memory.open())]) {
      memory.deliver()
      client.transport.send(Buffer.from('x'))
    }
    memory.deliver()
    memory.close()
    memory.close()
    memory.deliver()
    expect(log.filter((line) => line.endsWith('closed'))).toEqual(['1 closed', '2 closed'])
  })
})

describe('a stream', () => {
  test('closed by the server while it is accepted: opened, then closed without error', async () => {
    const memory = listenMemory({ delivery: 'manual' }, (peer) => peer.close())
    const client = record(memory.open())
    memory.deliver()
    expect(client.calls).toEqual(['opened', 'closed'])
    expect(await client.closed).toBeUndefined()
  })

  test('closed by the server delivers what was sent before; reset loses it and is an error', async () => {
    const { memory, peers } = echo()
    const closed = record(memory.open())
    const reset = record(memory.open())
    memory.deliver()
    for (const peer of peers) peer.send(Buffer.from('last words'))
    peers[0]?.close()
    peers[1]?.reset()
    memory.deliver()
    expect(closed.calls).toEqual(['opened', 'received', 'closed'])
    expect(await closed.closed).toBeUndefined()
    expect(reset.calls).toEqual(['opened', 'closed'])
    expect(await reset.closed).toMatchObject({ code: 'DISCONNECTED', outcome: 'notSent' })
  })

  test('cannot be renewed', () => {
    const { memory } = echo()
    const client = record(memory.open())
    memory.deliver()
    expect(client.transport.renewable).toBe(false)
    expect(() => client.transport.renew()).toThrow('its local port cannot be changed')
  })

  test('chunking splits and joins what is under way, for each side', () => {
    const seen: [Side, string[]][] = []
    const split = splitEvery(2)
    const { memory, log } = echo({
      chunking(pending, to) {
        seen.push([to, pending.map(String)])
        return to === 'server' ? joinAll(pending) : split(pending)
      },
    })
    const client = record(memory.open())
    memory.deliver()
    client.transport.send(Buffer.from('abc'))
    client.transport.send(Buffer.from('de'))
    memory.deliver()
    expect(log).toEqual(['1 connected', '1 received abcde'])
    expect(client.chunks.map(String)).toEqual(['ab', 'cd', 'e'])
    expect(seen).toEqual([
      ['server', ['abc', 'de']],
      ['client', ['abcde']],
    ])
  })

  test('chunking that changes the bytes is refused', () => {
    const { memory } = echo({ chunking: () => [Buffer.from('x')] })
    const client = record(memory.open())
    memory.deliver()
    client.transport.send(Buffer.from('abc'))
    expect(() => memory.deliver()).toThrow('must not change the bytes')
  })

  test('any sends in any chunking arrive as the same bytes in order', () => {
    fc.assert(
      fc.property(
        fc.array(fc.uint8Array({ maxLength: 20 }), { maxLength: 10 }),
        fc.integer({ min: 1, max: 9 }),
        (sends, size) => {
          const { memory } = echo({ chunking: splitEvery(size) })
          const client = record(memory.open())
          memory.deliver()
          for (const bytes of sends) client.transport.send(bytes)
          memory.deliver()
          expect(Buffer.concat(client.chunks)).toEqual(Buffer.concat(sends))
        },
      ),
    )
  })
})

describe('datagrams', () => {
  test('renewing moves to a new connection, and answers to the old one do not arrive', () => {
    const late: (() => void)[] = []
    const memory = listenMemory({ kind: 'datagram', delivery: 'manual' }, (peer) => {
      peer.onReceived = (bytes) => late.push(() => peer.send(bytes))
    })
    const client = record(memory.open())
    memory.deliver()
    client.transport.send(Buffer.from('slow'))
    memory.deliver()
    client.transport.renew()
    expect(client.calls).toEqual(['opened', 'renewed'])
    client.transport.send(Buffer.from('next'))
    memory.deliver()
    for (const answer of late) answer()
    memory.deliver()
    expect(client.chunks.map(String)).toEqual(['next'])
    expect(client.transport.description).toBe('memory (local 2)')
  })

  test('an answer that was under way when the port was renewed is lost', () => {
    const { memory } = echo({ kind: 'datagram' })
    const client = record(memory.open())
    memory.deliver()
    client.transport.send(Buffer.from('a'))
    memory.deliver(1)
    client.transport.renew()
    memory.deliver()
    expect(client.chunks).toEqual([])
  })

  test('renewing for ever keeps one connection at the server', () => {
    const { memory, log } = echo({ kind: 'datagram' })
    const client = record(memory.open())
    memory.deliver()
    for (let i = 0; i < 100; i++) {
      client.transport.send(Buffer.from('x'))
      memory.deliver()
      client.transport.renew()
    }
    memory.deliver()
    expect(log.filter((line) => line.endsWith('closed'))).toHaveLength(100)
  })

  test('chunking may drop, double and reorder', () => {
    const { memory, log } = echo({
      kind: 'datagram',
      chunking: (pending, to) => (to === 'client' ? [] : [...pending, ...pending].reverse()),
    })
    const client = record(memory.open())
    memory.deliver()
    client.transport.send(Buffer.from('a'))
    client.transport.send(Buffer.from('b'))
    memory.deliver()
    expect(log.slice(1)).toEqual(['1 received b', '1 received a', '1 received b', '1 received a'])
    expect(client.chunks).toEqual([])
  })

  test('a connection that the server closed is a new one at the next datagram', () => {
    const { memory, peers, log } = echo({ kind: 'datagram' })
    const client = record(memory.open())
    memory.deliver()
    client.transport.send(Buffer.from('a'))
    memory.deliver()
    peers[0]?.close()
    memory.deliver()
    client.transport.send(Buffer.from('b'))
    memory.deliver()
    expect(log).toEqual(['1 connected', '1 received a', '1 closed', '2 connected', '2 received b'])
    expect(client.calls).toEqual(['opened', 'received', 'received'])
  })
})
