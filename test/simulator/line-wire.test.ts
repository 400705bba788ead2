/** A simulated line where programs meet it: behind a device server (TCP) and on a real pair of serial ports. */
import { once } from 'node:events'
import { connect, type Socket } from 'node:net'
import { afterEach, describe, expect, test } from '@jest/globals'
import { createLineSimulator, type LineSimulator, type LineSimulatorOptions } from '../../src/simulator/line'
import { serialTransport } from '../../src/transport/serial'
import { ttyPair } from '../support/tty-pair'
import { record } from '../transport/recorder'
import { controlText } from '../vectors/control-text'
import { aLine, shown } from './line-support'
import { until } from './wire'

const { request } = aLine({ messageFormat: 4 })
const ends: (() => unknown)[] = []

afterEach(async () => {
  for (const end of ends.splice(0).reverse()) await end()
})

async function lineOf(options: LineSimulatorOptions): Promise<LineSimulator> {
  const line = createLineSimulator({ messageFormat: 4, stations: { 0: {}, 1: {} }, ...options })
  ends.push(() => line.close())
  await line.listen()
  return line
}

async function socketTo({ tcp }: LineSimulator): Promise<{ readonly socket: Socket; readonly heard: () => string }> {
  const socket = connect({ host: tcp?.host ?? '', port: tcp?.port ?? 0 })
  ends.push(() => socket.destroy())
  await once(socket, 'connect')
  const chunks: Buffer[] = []
  socket.on('data', (bytes) => void chunks.push(bytes))
  return { socket, heard: () => shown(Buffer.concat(chunks)) }
}

describe('behind a device server', () => {
  test('several connections share the line, and all hear what it says', async () => {
    const line = await lineOf({})
    line.station(1).write('D0', 0x1234)
    const [one, other] = [await socketTo(line), await socketTo(line)]
    await until(() => line.hosts.length === 2)
    one.socket.write(request('1C', 1, 'WR0D000001'))
    const answer = '<STX>01FF1234<ETX>BA<CR><LF>'
    await until(() => one.heard() === answer && other.heard() === answer)
    other.socket.write(request('1C', 0, 'PC0'))
    const both = `${answer}<STX>00FFF3<ETX>68<CR><LF>`
    await until(() => one.heard() === both && other.heard() === both)
    one.socket.destroy()
    await until(() => line.hosts.length === 1)
    other.socket.write(request('1C', 1, 'PC0'))
    await until(() => other.heard() === `${both}<STX>01FFF3<ETX>69<CR><LF>`)
  })

  test('a request in pieces, of two connections even, is one on the line', async () => {
    const line = await lineOf({ timeout: 5000 })
    const [one, other] = [await socketTo(line), await socketTo(line)]
    const bytes = request('1C', 0, 'PC0')
    one.socket.write(bytes.subarray(0, 5))
    await until(() => line.statistics.bytesReceived === 5)
    other.socket.write(bytes.subarray(5))
    await until(() => one.heard() === '<STX>00FFF3<ETX>68<CR><LF>')
  })

  test('disconnect: the connection that asked ends within the answer', async () => {
    const line = await lineOf({})
    line.faults.add({ kind: 'disconnect', at: 3, times: 1 })
    const [one, other] = [await socketTo(line), await socketTo(line)]
    await until(() => line.hosts.length === 2)
    const closed = new Promise((resolve) => one.socket.on('close', resolve))
    one.socket.on('error', () => {})
    one.socket.write(request('1C', 0, 'PC0'))
    await closed
    await until(() => line.hosts.length === 1)
    await until(() => other.heard() === '<STX>00')
  })

  test('a port that is taken is said, and nothing is open', async () => {
    const line = await lineOf({})
    const second = createLineSimulator({ tcp: { port: line.tcp?.port ?? 0 } })
    await expect(second.listen()).rejects.toMatchObject({ code: 'PORT_UNAVAILABLE' })
    expect(second.tcp).toBeUndefined()
    await second.close()
  })
})

describe('on a pair of serial ports', () => {
  async function onTty(options: LineSimulatorOptions = {}) {
    const pair = await ttyPair()
    ends.push(() => pair.close())
    const line = await lineOf({ serial: { path: pair.near, baudRate: 115_200 }, ...options })
    const host = record(serialTransport({ path: pair.far, baudRate: 115_200 })())
    ends.push(() => host.transport.close())
    await host.opened
    const heard = () => shown(Buffer.concat(host.chunks))
    return { pair, line, host, heard }
  }

  test('the stations answer, and TCP is closed', async () => {
    const { line, host, heard } = await onTty()
    expect([line.isOpen, line.tcp, line.hosts.length]).toEqual([true, undefined, 1])
    line.station(1).write('D0', 0x1234)
    host.transport.send(request('1C', 1, 'WR0D000001'))
    await until(() => heard() === '<STX>01FF1234<ETX>BA<CR><LF>')
    host.transport.send(request('3C', 0, '14010000D*0000000001ABCD'))
    await until(() => heard().endsWith('<ACK>F90000FF00<CR><LF>'))
    expect([0, 1].map((station) => line.station(station).read('D0:WORD'))).toEqual([0xabcd, 0x1234])
  })

  test('noise, damage and silence are on the wire', async () => {
    const { line, host, heard } = await onTty()
    line.faults.add({ kind: 'garbage', bytes: 2, times: 1 })
    line.faults.add({ kind: 'wrongSum', times: 1 })
    host.transport.send(request('1C', 0, 'PC0'))
    await until(() => heard() === '<ff><00><STX>00FFF3<ETX>69<CR><LF>')
    host.transport.send(controlText('<ENQ>00FFPC100<CR><LF>'))
    await until(() => heard().endsWith('<NAK>00FF02<CR><LF>'))
  })

  test('characters take their time', async () => {
    const { line, host, heard } = await onTty({ pace: { baudRate: 9600 } })
    const bytes = request('1C', 0, 'WR0D000040')
    const begun = performance.now()
    host.transport.send(bytes)
    await until(() => heard().endsWith('<CR><LF>'))
    const characters = bytes.length + Buffer.concat(host.chunks).length
    expect(performance.now() - begun).toBeGreaterThan((characters * 10_000) / 9600 - 2)
    expect(line.statistics.bytesSent).toBe(characters - bytes.length)
  })

  test('a line whose cable is pulled has no host any more', async () => {
    const { pair, line } = await onTty()
    await pair.close()
    await until(() => line.hosts.length === 0)
    expect(line.isOpen).toBe(false)
  })

  test('a port that is not there is said', async () => {
    const line = createLineSimulator({ serial: { path: '/dev/no-such-port' } })
    await expect(line.listen()).rejects.toMatchObject({ code: 'PORT_UNAVAILABLE' })
    await line.close()
  })
})
