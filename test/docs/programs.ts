/** Runs the programs of the documentation as they stand there, against simulated PLCs instead of the reader's. */
import { format } from 'node:util'
import * as address from '../../src/entry/address'
import * as codec from '../../src/entry/codec'
import * as simulation from '../../src/entry/simulator'
import {
  createJwSimulator,
  createLineSimulator,
  createPlcSimulator,
  type LineSimulator,
  type LineSimulatorOptions,
  type PlcSimulator,
  type PlcSimulatorOptions,
} from '../../src/entry/simulator'
import * as plc from '../../src/index'
import { type TtyPair, ttyPair } from '../support/tty-pair'
import type { Fence } from './markdown'

type Module = Readonly<Record<string, unknown>>

const IMPORT = /^import (\{[^}]*\}) from '([^']+)'$/gm

/** Where the reader's PLC would be. */
const READERS_PORT = 5010
/** And an FX3, which speaks 1E only. */
const READERS_FX3_PORT = 5551
/** And a Sharp JW. */
const READERS_JW_PORT = 4000
/** Two stations on a serial line, at a port of the computer and behind a device server. */
const READERS_SERIAL_PORT = '/dev/ttyUSB0'
const READERS_DEVICE_SERVER = '192.168.3.80:4001'

/** A simulated PLC, or a line of them. */
type Simulated = Pick<PlcSimulator, 'tcp' | 'close'> & Partial<Pick<PlcSimulator, 'udp'>>

/** Opens simulated PLCs and gives a program the package with its addresses led to them. */
export class Bench {
  readonly #simulators = new Map<Simulated, number | undefined>()
  #line: LineSimulator | undefined
  #pair: TtyPair | undefined

  async open(): Promise<void> {
    const simulator = createPlcSimulator({
      profile: 'iq-r',
      resetAllowed: true,
      bufferMemory: 0x4000,
      extensions: { modules: [{ unit: 3, points: 0x1000, model: 'Q62DA' }] },
      labels: { 'Line1.Speed': { type: 'REAL' }, 'Line1.Values': { type: 'INT', dimensions: [10] } },
    })
    await simulator.listen()
    fill(simulator)
    this.#simulators.set(simulator, READERS_PORT)
    const fx3 = createPlcSimulator({ profile: 'fx3' })
    await fx3.listen()
    this.#simulators.set(fx3, READERS_FX3_PORT)
    const jw = createJwSimulator({
      writeMode: 1,
      specifiedBuffers: { 1: { file: 1, address: 0o20000, length: 256 } },
      ringBuffers: { 0: { file: 1, address: 0o40000, length: 256 } },
    })
    await jw.listen()
    this.#simulators.set(jw, READERS_JW_PORT)
    this.#pair = await ttyPair()
    this.#line = createLineSimulator({
      messageFormat: 4,
      stations: { 1: {}, 2: {} },
      serial: { path: this.#pair.far },
      tcp: {},
    })
    await this.#line.listen()
  }

  async close(): Promise<void> {
    await Promise.all([...this.#simulators.keys(), this.#line].map((simulator) => simulator?.close()))
    await this.#pair?.close()
    this.#simulators.clear()
  }

  /** `192.168.3.39:5010`, as it is typed on a command line, led to the simulated PLC; any other text as it is. */
  addressOf(text: string): string {
    if (text === READERS_SERIAL_PORT && this.#pair !== undefined) return this.#pair.near
    const server = this.#line?.tcp
    if (text === READERS_DEVICE_SERVER && server !== undefined) return `${server.host}:${server.port}`
    const [, port] = /^192\.168\.3\.\d+:(\d+)$/.exec(text) ?? []
    if (port === undefined) return text
    const { host, port: here } = this.#ledHere({ host: '', port: Number(port) })
    return `${host}:${here}`
  }

  /** @returns what the program printed. */
  async run({ text }: Fence): Promise<string> {
    const printed: string[] = []
    const print = (...values: unknown[]) => void printed.push(format(...values))
    const body = text.replace(IMPORT, (_, names: string, name: string) => {
      return `const ${names.replaceAll(' as ', ': ')} = modules[${JSON.stringify(name)}]`
    })
    const modules = this.#entries()
    const AsyncFunction = Object.getPrototypeOf(async () => {}).constructor as FunctionConstructor
    const program = new AsyncFunction('modules', 'console', body)
    await program(modules, { log: print, error: print })
    return printed.join('\n')
  }

  #entries(): Readonly<Record<string, Module>> {
    const createMelsecClient = (options: plc.MelsecClientOptions) => plc.createMelsecClient(this.#ledHere(options))
    const simulator = (options: PlcSimulatorOptions = {}) => this.#simulator(options)
    const line = (options: LineSimulatorOptions = {}) => {
      const { tcp } = options
      const made = createLineSimulator({ ...options, tcp: tcp === false ? false : {} })
      this.#simulators.set(made, tcp === false ? undefined : tcp?.port)
      return made
    }
    return {
      '@melsec-jw/plc': { ...plc, createMelsecClient },
      '@melsec-jw/plc/address': address,
      '@melsec-jw/plc/codec': codec,
      '@melsec-jw/plc/simulator': { ...simulation, createPlcSimulator: simulator, createLineSimulator: line },
    }
  }

  /** The port the program asks for may be taken on the machine that runs the tests. */
  #simulator(options: PlcSimulatorOptions): PlcSimulator {
    const { tcp, udp } = options
    const simulator = createPlcSimulator({
      ...options,
      tcp: tcp === false ? false : {},
      udp: udp === false ? false : {},
    })
    this.#simulators.set(simulator, tcp === false ? undefined : tcp?.port)
    return simulator
  }

  #ledHere(options: plc.MelsecClientOptions): plc.MelsecClientOptions {
    if (options.openTransport !== undefined) return options
    const all = [...this.#simulators].reverse()
    const found = all.find(([simulator, port]) => port === options.port || simulator.tcp?.port === options.port)
    const endpoint = options.transport === 'udp' ? found?.[0].udp : found?.[0].tcp
    if (endpoint === undefined) throw new Error(`A program of the documentation asks for port ${options.port}.`)
    return { ...options, ...endpoint, serial: undefined, line: undefined }
  }
}

/** The demo plant at one moment: what the programs of the documentation read, standing still. */
function fill(simulator: PlcSimulator): void {
  simulator.write('D100:REAL', 71.5)
  simulator.write('D102:REAL', 38.25)
  simulator.write('D120:DINT', 1234)
  simulator.write('M10', true)
  simulator.write('D130:STRING(20)', 'Apple juice')
}
