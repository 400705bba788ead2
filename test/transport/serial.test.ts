// A serial port: a real pair of ttys.
import { spawnSync } from 'node:child_process'
import { afterEach, describe, expect, test } from '@jest/globals'
import { ConnectionError, RequestError } from '../../src/errors'
import { lineTime, type SerialOptions, serialSettings, serialTransport } from '../../src/transport/serial'
import type { Transport } from '../../src/transport/transport'
import { root } from '../support/root'
import { type TtyPair, ttyPair } from '../support/tty-pair'

const open: { pair?: TtyPair; transports: Transport[] } = { transports: [] }

afterEach(async () => {
  for (const transport of open.transports) transport.close()
  open.transports = []
  await open.pair?.close()
  delete open.pair
})

async function pairOf(): Promise<TtyPair> {
  open.pair = await ttyPair()
  return open.pair
}

/** Everything that arrives at a port, and what becomes of it. */
class Port {
  received = Buffer.alloc(0)
  readonly transport: Transport
  #wanted: { readonly length: number; readonly resolve: () => void } | undefined

  private constructor(options: SerialOptions, settled: (error: ConnectionError | undefined) => void) {
    this.transport = serialTransport(options)()
    open.transports.push(this.transport)
    this.transport.open({
      opened: () => settled(undefined),
      received: (bytes) => {
        this.received = Buffer.concat([this.received, bytes])
        if (this.#wanted !== undefined && this.received.length >= this.#wanted.length) this.#wanted.resolve()
      },
      closed: (error) => {
        settled(error)
        this.closed(error)
      },
    })
  }

  closed: (error: ConnectionError | undefined) => void = () => {}

  static async open(options: SerialOptions): Promise<Port> {
    let port: Port | undefined
    const error = await new Promise<ConnectionError | undefined>((resolve) => {
      port = new Port(options, resolve)
    })
    if (error !== undefined) throw error
    if (port === undefined) throw new Error('no port')
    return port
  }

  /** Resolves when so many bytes have come. */
  async has(length: number): Promise<Buffer> {
    if (this.received.length < length) {
      await new Promise<void>((resolve) => {
        this.#wanted = { length, resolve }
      })
    }
    return this.received
  }
}

const settings = { baudRate: 115_200, dataLength: 8, parity: 'even' } as const

describe('a pair of ports', () => {
  test('carries every byte both ways', async () => {
    const { near, far } = await pairOf()
    const [one, other] = [await Port.open({ path: near, ...settings }), await Port.open({ path: far, ...settings })]
    const all = Buffer.from(Array.from({ length: 1024 }, (_, i) => i & 0xff))
    one.transport.send(all)
    expect(await other.has(1024)).toEqual(all)
    other.transport.send(all.subarray(0, 300))
    expect(await one.has(300)).toEqual(all.subarray(0, 300))
    expect(one.transport.description).toBe(`serial ${near} (115200 8E1)`)
  })

  test('a port that another program has open is told as such', async () => {
    const { near } = await pairOf()
    await Port.open({ path: near, ...settings })
    await expect(Port.open({ path: near, ...settings })).rejects.toMatchObject({
      code: 'PORT_UNAVAILABLE',
      outcome: 'notSent',
      message: expect.stringContaining('another program has it open'),
    })
  })

  test('a port can be opened again at once after it was closed', async () => {
    const { near, far } = await pairOf()
    const first = await Port.open({ path: near, ...settings })
    // Closing takes the system a moment, which the next one waits.
    first.transport.close()
    expect(() => first.transport.send(Buffer.of(1))).toThrow(ConnectionError)
    const other = await Port.open({ path: far, ...settings })
    const second = await Port.open({ path: near, ...settings })
    second.transport.send(Buffer.from('hello'))
    expect(String(await other.has(5))).toBe('hello')
  })

  test('an adapter that is unplugged ends the connection: what was sent is unknown', async () => {
    const pair = await pairOf()
    const port = await Port.open({ path: pair.near, ...settings })
    const gone = new Promise<ConnectionError | undefined>((resolve) => {
      port.closed = resolve
    })
    port.transport.send(Buffer.of(5))
    await pair.close()
    expect(await gone).toMatchObject({ code: 'DISCONNECTED', outcome: 'unknown' })
  })
})

describe('opening', () => {
  test('a port that does not exist says so', async () => {
    await expect(Port.open({ path: '/dev/tty-that-is-not-there' })).rejects.toMatchObject({
      code: 'PORT_UNAVAILABLE',
      message: expect.stringContaining('there is no such port'),
    })
  })

  test('without the package says how to install it', () => {
    const program = `
      const Module = require('node:module')
      const resolve = Module._resolveFilename
      Module._resolveFilename = function (name, ...rest) {
        if (name === 'serialport') throw Object.assign(new Error("Cannot find module 'serialport'"), { code: 'MODULE_NOT_FOUND' })
        return resolve.call(this, name, ...rest)
      }
      const { serialTransport } = require('./dist/src/transport/serial.js')
      serialTransport({ path: 'COM1' })().open({ opened() {}, received() {}, closed(error) { console.log(error.code, error.message) } })`
    const { stdout, stderr } = spawnSync(process.execPath, ['-e', program], { cwd: root, encoding: 'utf8' })
    expect(stderr).toBe('')
    expect(stdout).toMatch(/^PORT_UNAVAILABLE .*npm install serialport\n$/)
  })
})

describe('options', () => {
  test('are those of an FX5 where nothing is said', () => {
    expect(serialSettings({ path: 'COM3' })).toEqual({
      path: 'COM3',
      baudRate: 9600,
      dataLength: 7,
      parity: 'odd',
      stopBits: 1,
      rts: 'on',
    })
  })

  test.each([
    [{ path: '' }, 'path'],
    [{ path: 'COM3', baudRate: 9601 }, 'baudRate'],
    [{ path: 'COM3', dataLength: 9 }, 'dataLength'],
    [{ path: 'COM3', parity: 'mark' }, 'parity'],
    [{ path: 'COM3', stopBits: 3 }, 'stopBits'],
    [{ path: 'COM3', rts: true }, 'rts'],
  ])('%j is refused by its name', (options, field) => {
    expect(() => serialTransport(options as SerialOptions)).toThrow(RequestError)
    expect(() => serialTransport(options as SerialOptions)).toThrow(expect.objectContaining({ field }))
  })

  test.each([
    [{ baudRate: 9600, dataLength: 7, parity: 'odd', stopBits: 1 }, 960, 1000],
    [{ baudRate: 9600, dataLength: 8, parity: 'none', stopBits: 1 }, 960, 1000],
    [{ baudRate: 300, dataLength: 8, parity: 'even', stopBits: 2 }, 25, 1000],
  ] as const)('%j: %i characters take %i ms', (options, characters, ms) => {
    expect(lineTime(characters, serialSettings({ path: 'COM3', ...options }))).toBeCloseTo(ms)
  })
})
