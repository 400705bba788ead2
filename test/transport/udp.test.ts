import { createSocket, Socket } from 'node:dgram'
import { once } from 'node:events'
import { afterEach, describe, expect, jest, test } from '@jest/globals'
import { ConnectionError, RequestError } from '../../src/errors'
import { type UdpOptions, udpTransport } from '../../src/transport/udp'
import { openSockets, record, settle } from './recorder'

const host = '127.0.0.1'
const cleanups: (() => unknown)[] = []

afterEach(async () => {
  for (const cleanup of cleanups.splice(0)) await cleanup()
})

interface Received {
  readonly text: string
  readonly port: number
}

/** A plain socket that notes what comes and answers when told. */
async function station(address = host) {
  const socket = createSocket(address.includes(':') ? 'udp6' : 'udp4')
  const received: Received[] = []
  socket.on('message', (bytes, from) => received.push({ text: bytes.toString(), port: from.port }))
  socket.bind(0, address)
  await once(socket, 'listening')
  let open = true
  const close = () => {
    if (open) socket.close()
    open = false
  }
  cleanups.push(close)
  return { socket, received, port: socket.address().port, close }
}

function echo(socket: Socket) {
  socket.on('message', (bytes, from) => socket.send(bytes, from.port, from.address))
}

function open(options: Omit<UdpOptions, 'host'> & { host?: string }) {
  const recorder = record(udpTransport({ host, ...options })())
  cleanups.push(() => recorder.transport.close())
  return recorder
}

function localPort(description: string): number {
  return Number(/:(\d+)\)$/.exec(description)?.[1])
}

async function closedPort(): Promise<number> {
  const { port, close } = await station()
  close()
  return port
}

describe('opening', () => {
  test('what a foreign sender sends between binding and connecting does not arrive', async () => {
    const plc = await station()
    echo(plc.socket)
    const foreign = await station()
    const connect = Socket.prototype.connect
    const told = jest.spyOn(Socket.prototype, 'connect').mockImplementation(function (this: Socket, ...args) {
      // On loopback it is in the queue of the socket as soon as it is sent.
      foreign.socket.send('foreign', this.address().port, host, () => connect.apply(this, args))
    })
    cleanups.push(() => told.mockRestore())
    const client = open({ port: plc.port })
    await client.opened
    client.transport.send(Buffer.from('own'))
    await client.bytes(3)
    expect(told).toHaveBeenCalledTimes(1)
    expect(client.chunks.map(String)).toEqual(['own'])
  })

  test('opens, sends, receives one call per datagram and tells both addresses', async () => {
    const { socket, port } = await station()
    echo(socket)
    const client = open({ port })
    expect(client.calls).toEqual([])
    await client.opened
    client.transport.send(Buffer.from('one'))
    client.transport.send(Buffer.from('two'))
    await client.bytes(6)
    expect(client.chunks.map(String)).toEqual(['one', 'two'])
    expect(client.calls).toEqual(['opened', 'received', 'received'])
    expect(client.transport.kind).toBe('datagram')
    expect(client.transport.description).toMatch(
      new RegExp(`^udp 127\\.0\\.0\\.1:${port} \\(local 127\\.0\\.0\\.1:\\d+\\)$`),
    )
  })

  test('works over IPv6', async () => {
    const { socket, port } = await station('::1')
    echo(socket)
    const client = open({ host: '::1', port })
    await client.opened
    client.transport.send(Buffer.from('six'))
    expect(String(await client.bytes(3))).toBe('six')
    expect(client.transport.description).toContain(`udp [::1]:${port} (local [::1]:`)
  })

  test('uses the local address and port it is given, and resolves a name once', async () => {
    const { socket, received, port } = await station()
    const fixed = await closedPort()
    let lookups = 0
    const resolve = async () => {
      lookups++
      return ['::1', host]
    }
    const client = open({ host: 'plc1', port, localAddress: '127.0.0.2', localPort: fixed, resolve })
    await client.opened
    client.transport.send(Buffer.from('x'))
    const [, from] = await once(socket, 'message')
    expect(`${from.address}:${from.port}`).toBe(`127.0.0.2:${fixed}`)
    expect(received).toHaveLength(1)
    expect(lookups).toBe(1)
  })

  test('a second open() of the same transport is refused', async () => {
    const { port } = await station()
    const client = open({ port })
    await client.opened
    expect(() => record(client.transport)).toThrow('make another transport')
  })

  test('options are checked before anything is tried', () => {
    expect(() => udpTransport({ host, port: 0 })).toThrow(RequestError)
    expect(() => udpTransport({ host, port: 1, localPort: 70_000 })).toThrow(
      expect.objectContaining({ code: 'BAD_OPTION', field: 'localPort' }),
    )
  })
})

describe('failing', () => {
  test('a port on which nothing listens ends it after the first send, once', async () => {
    const port = await closedPort()
    const client = open({ port })
    await client.opened
    client.transport.send(Buffer.from('anybody?'))
    const error = await client.closed
    expect(error).toBeInstanceOf(ConnectionError)
    expect(error).toMatchObject({ code: 'CONNECT_FAILED', outcome: 'unknown' })
    expect(error?.message).toContain(`udp 127.0.0.1:${port}: nothing receives UDP datagrams on this port`)
    await settle()
    expect(client.calls).toEqual(['opened', 'closed'])
    expect(() => client.transport.send(Buffer.from('x'))).toThrow(expect.objectContaining({ outcome: 'notSent' }))
    expect(() => client.transport.renew()).toThrow(ConnectionError)
  })

  test('where something answered before, a wrong port is not what is thought of', async () => {
    const { socket, port, close } = await station()
    echo(socket)
    const client = open({ port })
    await client.opened
    client.transport.send(Buffer.from('x'))
    await client.bytes(1)
    close()
    client.transport.send(Buffer.from('y'))
    const error = await client.closed
    expect(error?.causes[0]).toBe('the PLC is restarting, and does not listen yet')
    expect(error?.causes.join()).not.toContain('port number')
  })

  test('many sends to a port on which nothing listens end it once and never throw', async () => {
    const client = open({ port: await closedPort() })
    await client.opened
    for (let i = 0; i < 20; i++) client.transport.send(Buffer.from('anybody?'))
    await client.closed
    await settle()
    expect(client.calls).toEqual(['opened', 'closed'])
  })

  test('a local port that another program uses', async () => {
    const other = await station()
    const { port } = await station()
    const client = open({ port, localAddress: host, localPort: other.port })
    const error = await client.closed
    expect(error).toMatchObject({ code: 'PORT_UNAVAILABLE', outcome: 'notSent' })
    expect(error?.message).toContain(`udp local 127.0.0.1:${other.port} is already in use`)
    await settle()
    expect(client.calls).toEqual(['closed'])
  })

  test('a local address that is not of this computer', async () => {
    const client = open({ port: 5007, localAddress: '203.0.113.7' })
    expect(await client.closed).toMatchObject({ code: 'PORT_UNAVAILABLE' })
  })

  test('a name that cannot be resolved', async () => {
    const client = open({ host: 'plc1', port: 5007, resolve: async () => [] })
    const error = await client.closed
    expect(error).toMatchObject({ code: 'CONNECT_FAILED', outcome: 'notSent' })
    expect(error?.message).toContain('udp plc1:5007: the host name could not be resolved')
  })

  test('a datagram that is too large for the network is an error, not silence', async () => {
    const { port } = await station()
    const client = open({ port })
    await client.opened
    client.transport.send(Buffer.alloc(70_000))
    const error = await client.closed
    expect(error?.code).toBe('CONNECT_FAILED')
    expect(error?.message).toContain('EMSGSIZE')
  })

  test('send before opened is refused as not sent', async () => {
    const { port } = await station()
    const client = open({ port })
    expect(() => client.transport.send(Buffer.from('x'))).toThrow(
      expect.objectContaining({ code: 'DISCONNECTED', outcome: 'notSent' }),
    )
  })
})

describe('receiving', () => {
  test('datagrams of foreign senders are ignored: another port, another address', async () => {
    const { socket, port } = await station()
    const foreign = await station()
    const elsewhere = createSocket('udp4')
    cleanups.push(() => elsewhere.close())
    elsewhere.bind(port, '127.0.0.2')
    await once(elsewhere, 'listening')
    // Bound to every address, so that the foreign datagrams reach the computer's port for certain.
    const client = open({ port, localAddress: '0.0.0.0' })
    await client.opened
    const target = localPort(client.transport.description)
    const sent = (from: Socket) => new Promise<void>((resolve) => from.send('foreign', target, host, () => resolve()))
    await sent(foreign.socket)
    await sent(elsewhere)
    echo(socket)
    client.transport.send(Buffer.from('own'))
    await client.bytes(3)
    await settle()
    expect(client.chunks.map(String)).toEqual(['own'])
    expect(client.calls).toEqual(['opened', 'received'])
  })

  test('empty datagrams are dropped and harm nothing', async () => {
    const { socket, port } = await station()
    socket.on('message', (bytes, from) => {
      socket.send(Buffer.alloc(0), from.port, from.address)
      socket.send(bytes, from.port, from.address)
    })
    const client = open({ port })
    await client.opened
    client.transport.send(Buffer.from('full'))
    await client.bytes(4)
    expect(client.chunks.map(String)).toEqual(['full'])
  })

  test('after our own close nothing is called, also not for what was on its way', async () => {
    const { socket, port } = await station()
    echo(socket)
    const client = open({ port })
    await client.opened
    client.transport.send(Buffer.from('x'))
    await once(socket, 'message')
    client.transport.close()
    client.transport.close()
    await settle()
    expect(client.calls).toEqual(['opened'])

    const early = open({ port })
    early.transport.close()
    await settle()
    expect(early.calls).toEqual([])
  })
})

describe('renewing', () => {
  test('changes the local port, and answers to the old one do not arrive', async () => {
    const { socket, received, port } = await station()
    const client = open({ port })
    await client.opened
    client.transport.send(Buffer.from('slow'))
    await once(socket, 'message')
    const oldPort = received[0]?.port ?? 0

    await client.renew()
    client.transport.send(Buffer.from('next'))
    await once(socket, 'message')
    const newPort = received[1]?.port ?? 0
    expect(received[1]?.text).toBe('next')
    expect(newPort).not.toBe(oldPort)
    expect(localPort(client.transport.description)).toBe(newPort)

    await new Promise<void>((resolve) => socket.send('late answer', oldPort, host, () => resolve()))
    socket.send('right answer', newPort, host)
    await client.bytes(12)
    await settle()
    expect(client.chunks.map(String)).toEqual(['right answer'])
    expect(client.calls).toEqual(['opened', 'renewed', 'received'])
  })

  test('what has arrived and was not delivered before the renewal is lost', async () => {
    const { socket, port } = await station()
    const client = open({ port })
    await client.opened
    await new Promise<void>((resolve) => {
      socket.send('late answer', localPort(client.transport.description), host, () => {
        // In the receive queue of the old socket by now; the next turn of the event loop would deliver it.
        resolve(client.renew())
      })
    })
    echo(socket)
    client.transport.send(Buffer.from('own'))
    await client.bytes(3)
    expect(client.chunks.map(String)).toEqual(['own'])
  })

  test('until the new port is there nothing can be sent, and nothing is kept to be sent from it', async () => {
    const { socket, received, port } = await station()
    const client = open({ port })
    expect(client.transport.ready).toBe(false)
    await client.opened
    expect([client.transport.renewable, client.transport.ready]).toEqual([true, true])
    const renewed = client.renew()
    expect(client.transport.ready).toBe(false)
    expect(() => client.transport.send(Buffer.from('given up'))).toThrow(
      expect.objectContaining({ outcome: 'notSent' }),
    )
    await renewed
    expect(client.transport.ready).toBe(true)
    client.transport.send(Buffer.from('next'))
    await once(socket, 'message')
    expect(received.map(({ text }) => text)).toEqual(['next'])
    expect(client.calls).toEqual(['opened', 'renewed'])
  })

  test('a port is not used again within 256 renewals', async () => {
    const { port } = await station()
    const client = open({ port })
    await client.opened
    const ports = [localPort(client.transport.description)]
    for (let i = 0; i < 3000; i++) {
      await client.renew()
      ports.push(localPort(client.transport.description))
    }
    ports.forEach((used, index) => {
      expect(ports.slice(Math.max(0, index - 255), index)).not.toContain(used)
    })
    expect(new Set(client.calls)).toEqual(new Set(['opened', 'renewed']))
  })

  test('a fixed local port stays the same, and cannot be renewed', async () => {
    const { socket, received, port } = await station()
    const fixed = await closedPort()
    const client = open({ port, localPort: fixed })
    await client.opened
    expect(client.transport.renewable).toBe(false)
    expect(() => client.transport.renew()).toThrow('its local port cannot be changed')
    client.transport.send(Buffer.from('x'))
    await once(socket, 'message')
    expect(received).toEqual([{ text: 'x', port: fixed }])
  })
})

describe('the port of the next renewal', () => {
  /** Every socket that is connected from now on, in this order, and how many of them are not closed. */
  function sockets() {
    const all: Socket[] = []
    const open = new Set<Socket>()
    const connect = Socket.prototype.connect
    const spy = jest.spyOn(Socket.prototype, 'connect').mockImplementation(function (this: Socket, ...args) {
      all.push(this)
      open.add(this)
      this.once('close', () => open.delete(this))
      return connect.apply(this, args)
    })
    cleanups.push(() => spy.mockRestore())
    return { all, open }
  }

  /** A transport that was renewed once and has sent since: its next port is there. */
  async function renewedOnce() {
    const { all, open: notClosed } = sockets()
    const plc = await station()
    echo(plc.socket)
    const client = open({ port: plc.port })
    await client.opened
    await client.renew()
    client.transport.send(Buffer.from('1'))
    await client.bytes(1)
    await settle()
    return { plc, client, all, notClosed }
  }

  test('is opened behind what is sent, so that the renewal is over at once', async () => {
    const { plc, client, all } = await renewedOnce()
    expect(all).toHaveLength(3)
    const before = localPort(client.transport.description)
    client.transport.renew()
    expect(client.transport.ready).toBe(true)
    expect(client.calls).toEqual(['opened', 'renewed', 'received', 'renewed'])
    const after = localPort(client.transport.description)
    expect(after).not.toBe(before)
    client.transport.send(Buffer.from('2'))
    await client.bytes(2)
    expect(plc.received.map(({ port }) => port).slice(-2)).toEqual([before, after])
  })

  test('is not opened where nothing was ever renewed', async () => {
    const { all } = sockets()
    const plc = await station()
    echo(plc.socket)
    const client = open({ port: plc.port })
    await client.opened
    for (const text of ['1', '2', '3']) client.transport.send(Buffer.from(text))
    await client.bytes(3)
    await settle()
    expect(all).toHaveLength(1)
  })

  test('takes nothing before it is the one that is used, from whomever it comes', async () => {
    const { plc, client, all } = await renewedOnce()
    const next = all[2]?.address().port ?? 0
    const foreign = await station()
    for (const sender of [plc.socket, foreign.socket]) {
      await new Promise<void>((resolve) => sender.send('too early', next, host, () => resolve()))
    }
    await settle()
    client.transport.renew()
    expect(localPort(client.transport.description)).toBe(next)
    foreign.socket.send('foreign', next, host)
    client.transport.send(Buffer.from('2'))
    await client.bytes(2)
    await settle()
    expect(client.chunks.map(String)).toEqual(['1', '2'])
  })

  test('an answer to the port before it does not arrive', async () => {
    const { plc, client } = await renewedOnce()
    const old = localPort(client.transport.description)
    await new Promise<void>((resolve) => {
      plc.socket.send('late', old, host, () => {
        // In the receive queue of the old socket by now.
        client.transport.renew()
        resolve()
      })
    })
    client.transport.send(Buffer.from('2'))
    await client.bytes(2)
    await new Promise<void>((resolve) => plc.socket.send('later', old, host, () => resolve()))
    await settle()
    expect(client.chunks.map(String)).toEqual(['1', '2'])
  })

  test('what goes wrong with it disturbs nobody, and another is made', async () => {
    const { client, all } = await renewedOnce()
    all[2]?.emit('error', new Error('out of sockets'))
    client.transport.send(Buffer.from('2'))
    await client.bytes(2)
    await settle()
    expect(all).toHaveLength(4)
    client.transport.renew()
    expect(client.transport.ready).toBe(true)
    client.transport.send(Buffer.from('3'))
    await client.bytes(3)
    expect(client.chunks.map(String)).toEqual(['1', '2', '3'])
  })

  test('there are never more than two sockets, and none after the end', async () => {
    const { client, notClosed } = await renewedOnce()
    for (let round = 0; round < 50; round++) {
      await client.renew()
      client.transport.send(Buffer.from('x'))
      await client.bytes(round + 2)
      await settle()
      expect(notClosed.size).toBeLessThanOrEqual(2)
    }
    client.transport.close()
    await settle()
    expect(notClosed.size).toBe(0)
  })

  test('who closes while it is told that it can send leaves none', async () => {
    const { open: notClosed } = sockets()
    const plc = await station()
    echo(plc.socket)
    let renewals = 0
    const transport = udpTransport({ host, port: plc.port })()
    const client = record(transport, {
      onRenewed: () => {
        renewals += 1
        if (renewals === 2) transport.close()
      },
    })
    await client.opened
    await client.renew()
    transport.send(Buffer.from('1'))
    await client.bytes(1)
    await settle()
    transport.renew()
    expect(renewals).toBe(2)
    await settle()
    expect(notClosed.size).toBe(0)
  })
})

test('1000 transports opened, renewed and closed leave no handle', async () => {
  const { port, close } = await station()
  await settle()
  const before = openSockets()
  for (let i = 0; i < 1000; i++) {
    const client = record(udpTransport({ host, port })())
    if (i % 4 > 0) await client.opened
    if (i % 4 === 2) client.transport.renew()
    if (i % 4 === 3) await client.renew()
    if (i % 4 === 3) client.transport.send(Buffer.from('x'))
    client.transport.close()
  }
  await settle()
  expect(openSockets()).toEqual(before)
  close()
})
