// A simulated Sharp JW that listens: on TCP, on UDP and in memory.
import { RequestError } from '../../errors'
import type { JwModel } from '../../jw/commands/command'
import { type JwCommandName, jwCommands } from '../../jw/commands/commands'
import type { Clock } from '../../transport/clock'
import type { OpenTransport } from '../../transport/transport'
import type { PlcValue, ValueFormat } from '../../value/value'
import { Emitter } from '../events'
import { absentFaults, type JwFaultAction } from '../fault-kinds'
import { type FaultSubject, Faults } from '../faults'
import { type ConnectionEvent, type ConnectionInfo, type ConnectOptions, type Endpoint, Listening } from '../listening'
import type { FaultSwitches } from '../program'
import { Refusal } from '../refusal'
import { newCounters, type SimulatorStatistics } from '../statistics'
import { JwConnection, type JwRequestEvent, type JwShared } from './connection'
import type { JwStateChange, SimulatedJwCpu } from './cpu'
import { type JwSettings, type JwSimulatorOptions, jwSettingsOf } from './options'
import { JwPlc } from './plc'
import { type JwProgramMemory, OperandMemory } from './program-memory'
import type { OptionUnitState } from './units'

/** A write to a simulated JW that was carried out. */
export type JwWriteEvent = JwRequestEvent & {
  /** Name of the command. */
  readonly command: JwCommandName
}

/** What a simulated JW tells those who listen. */
export interface JwSimulatorEvents {
  /** It runs, or stands still. */
  state: JwStateChange
  /** A client has written data memory, set a timer, or moved a pointer of a buffer. */
  write: JwWriteEvent
  /** Every request, with its result code. */
  request: JwRequestEvent
  /** A client has come or gone. */
  connection: ConnectionEvent
  /** Power is on again after `restart()`. */
  restart: { readonly time: number }
  /** `close()` was called. */
  close: { readonly time: number }
}

/** Ring buffers as the program of the PLC uses them: the other side of 29H and 39H. */
export interface ProgramRingBuffers {
  /** Bytes that wait to be read. @throws RequestError OUT_OF_RANGE when it is not defined */
  waiting(buffer: number): number
  /** Puts bytes in, all or none. @throws RequestError OUT_OF_RANGE when there is no room for them */
  put(buffer: number, data: Uint8Array): void
  /** Takes so many bytes out, or as many as there are. @throws RequestError OUT_OF_RANGE when it is not defined */
  take(buffer: number, most: number): Buffer
}

/** A simulated Sharp JW. Made by `createJwSimulator()`. */
export interface JwSimulator {
  /** Family of the CPU. */
  readonly model: JwModel
  /** Its time. */
  readonly clock: Clock
  /** Memory as a program in the PLC sees it. */
  readonly memory: JwProgramMemory
  /** Run state, blocks and write mode. */
  readonly cpu: SimulatedJwCpu
  /** Ring buffers as a program in the PLC sees them. */
  readonly ringBuffers: ProgramRingBuffers
  /** Whether the secret function is enabled and not released, and whether a password is registered. */
  readonly secret: { readonly enabled: boolean; readonly hasPassword: boolean }
  /** What it does wrong on purpose. */
  readonly faults: FaultSwitches<JwCommandName, JwFaultAction>
  /** Where TCP listens; undefined before `listen()`, after `close()`, and without TCP. */
  readonly tcp: Endpoint | undefined
  /** Where UDP listens. */
  readonly udp: Endpoint | undefined
  /** Clients at the moment. */
  readonly connections: readonly ConnectionInfo[]
  /** What was counted since it was made. */
  readonly statistics: SimulatorStatistics
  /** @throws ConnectionError PORT_UNAVAILABLE; then nothing listens. */
  listen(): Promise<void>
  /** Transports to this PLC inside the same program, without sockets. */
  connect(options?: ConnectOptions): OpenTransport
  /** As a power failure: everybody is disconnected, and nobody answered, for the given or usual time. Memory is kept. */
  restart(ms?: number): void
  /** `memory.read`: `plc.read('09012:INT')` */
  read(item: string, format?: ValueFormat): PlcValue
  /** `memory.write`: `plc.write('09012:INT', 5)` */
  write(item: string, value: PlcValue, format?: ValueFormat): void
  /** Parameters and state of an option unit. @throws RequestError BAD_OPTION for a rack or unit above 7 */
  optionUnit(rack: number, unit: number): OptionUnitState
  /** Calls `listener` on every event; the returned function ends it. */
  on<E extends keyof JwSimulatorEvents>(event: E, listener: (event: JwSimulatorEvents[E]) => void): () => void
  /** Ends everything; no socket or timer is left when it resolves. */
  close(): Promise<void>
}

/**
 * A simulated Sharp JW300 with JW-255CM, answering by the same declarations the client asks by.
 * @throws RequestError BAD_OPTION
 * @example
 * const plc = createJwSimulator({ tcp: { port: 5008 }, writeMode: 1 })
 * await plc.listen()
 * plc.write('09012', 5)
 */
export function createJwSimulator(options: JwSimulatorOptions = {}): JwSimulator {
  return new Simulator(jwSettingsOf(options))
}

class Simulator implements JwSimulator {
  readonly model: JwModel
  readonly clock: Clock
  readonly memory: JwProgramMemory
  readonly cpu: SimulatedJwCpu
  readonly ringBuffers: ProgramRingBuffers
  readonly faults = new Faults<JwCommandName, JwFaultAction>({
    commands: Object.keys(jwCommands),
    absent: absentFaults.jw,
    highestCode: 0xff,
  })
  readonly #plc: JwPlc
  readonly #settings: JwSettings
  readonly #shared: JwShared
  readonly #listening: Listening<JwConnection>
  readonly #events = new Emitter<JwSimulatorEvents>()
  readonly #counters = newCounters()
  #closing: Promise<void> | undefined

  constructor(settings: JwSettings) {
    this.model = settings.model
    this.clock = settings.clock
    this.#settings = settings
    this.#plc = new JwPlc(settings, (change) => this.#events.emit('state', change))
    this.memory = new OperandMemory(this.#plc.parts, settings)
    this.cpu = this.#plc.cpu
    this.ringBuffers = programSide(this.#plc)
    this.#shared = {
      plc: this.#plc,
      settings,
      faults: this.faults,
      counters: this.#counters,
      heldDatagrams: [],
      observe: (event) => this.#observe(event),
    }
    this.#listening = new Listening<JwConnection>({
      ...settings,
      counters: this.#counters,
      serve: (peer, kind, id) => new JwConnection(this.#shared, peer, kind, id),
      refused: ({ id, remote }) => {
        const subject: FaultSubject<JwCommandName> = { command: undefined, subcommand: 0, connection: id, remote }
        return this.faults.take('closeOnAccept', subject)?.how
      },
      changed: (event) => this.#events.emit('connection', event),
    })
  }

  get tcp(): Endpoint | undefined {
    return this.#listening.tcp
  }

  get udp(): Endpoint | undefined {
    return this.#listening.udp
  }

  get connections(): readonly ConnectionInfo[] {
    return this.#listening.infos
  }

  get statistics(): SimulatorStatistics {
    return { ...this.#counters }
  }

  get secret(): JwSimulator['secret'] {
    const { enabled, hasPassword } = this.#plc.parts.secret
    return { enabled, hasPassword }
  }

  listen(): Promise<void> {
    return this.#listening.listen()
  }

  connect(options: ConnectOptions = {}): OpenTransport {
    return this.#listening.connect(options)
  }

  restart(ms: number = this.#settings.restartTime): void {
    const isDown = this.#listening.goDown(ms, () => {
      this.#plc.cpu.powerOn()
      this.#events.emit('restart', { time: this.clock.time() })
    })
    if (isDown) this.#shared.heldDatagrams.length = 0
  }

  read(item: string, format?: ValueFormat): PlcValue {
    return this.memory.read(item, format)
  }

  write(item: string, value: PlcValue, format?: ValueFormat): void {
    this.memory.write(item, value, format)
  }

  optionUnit(rack: number, unit: number): OptionUnitState {
    return this.#plc.parts.optionUnits.stateOf(rack, unit)
  }

  on<E extends keyof JwSimulatorEvents>(event: E, listener: (event: JwSimulatorEvents[E]) => void): () => void {
    return this.#events.on(event, listener)
  }

  close(): Promise<void> {
    if (this.#closing === undefined) {
      this.#closing = this.#listening.close()
      this.#events.emit('close', { time: this.clock.time() })
    }
    return this.#closing
  }

  #observe(event: JwRequestEvent): void {
    const { command } = event
    if (command !== undefined && event.effect === 'write' && event.endCode === 0) {
      this.#events.emit('write', { ...event, command })
    }
    this.#events.emit('request', event)
  }
}

function programSide({ parts: { ringBuffers } }: JwPlc): ProgramRingBuffers {
  return {
    waiting: (buffer) => allowed(() => ringBuffers.waiting(buffer)),
    put: (buffer, data) => void allowed(() => ringBuffers.put(buffer, data)),
    take: (buffer, most) => allowed(() => ringBuffers.take(buffer, most).data),
  }
}

function allowed<T>(run: () => T): T {
  try {
    return run()
  } catch (error) {
    if (!(error instanceof Refusal)) throw error
    throw new RequestError('OUT_OF_RANGE', `The simulated JW refuses: ${error.message}.`)
  }
}
