// A simulated PLC that listens: on TCP, on UDP and in memory.
import { badOption } from '../basics/option-checks'
import type { CommandName } from '../melsec/commands/commands'
import { bodies } from '../melsec/frame/body'
import type { Profile, ProfileInfo } from '../melsec/profiles/profile'
import { SlmpCommandSet } from '../melsec/protocol'
import type { Clock } from '../transport/clock'
import type { OpenTransport } from '../transport/transport'
import type { PlcValue, ValueFormat } from '../value/value'
import { ACompatiblePort } from './a-compatible-port'
import { type RequestEvent, type Shared, SimulatedConnection } from './connection'
import type { Cpu, StateChange } from './cpu'
import type { ErrorLog } from './error-log'
import { Emitter } from './events'
import { type FaultSubject, Faults } from './faults'
import { fileClock } from './file-clock'
import { type ConnectionEvent, type ConnectionInfo, type ConnectOptions, type Endpoint, Listening } from './listening'
import { chosen, type OnDemandData, type OnDemandOptions, onDemandBytes } from './on-demand'
import { type PlcSimulatorOptions, type SimulatorSettings, settingsOf } from './options'
import { Plc } from './plc'
import { PortPassword } from './port-lock'
import type {
  FaultSwitches,
  ProgramFiles,
  ProgramLabels,
  ProgramMemory,
  SimulatedCpu,
  SimulatedErrors,
} from './program'
import { NamedFiles } from './program-files'
import { newCounters, type SimulatorStatistics } from './statistics'

export type { OnDemandData, OnDemandOptions } from './on-demand'
export type { PlcSimulatorOptions } from './options'

/** A write that was carried out. */
export type WriteEvent = RequestEvent & {
  /** Name of the command. */
  readonly command: CommandName
}

/** What a simulated PLC tells those who listen. */
export interface SimulatorEvents {
  /** RUN, STOP or PAUSE. */
  state: StateChange
  /** Remote control has set devices to 0: those that are not latched, or all. Initial values are the program's to set. */
  clear: { readonly scope: 'unlatched' | 'all' }
  /** A client has written devices, labels, buffer memory or files. */
  write: WriteEvent
  /** Every request, with its end code. */
  request: RequestEvent
  /** A client has come or gone. */
  connection: ConnectionEvent
  /** Power is on again after a reset or `restart()`: devices that are not latched are 0. */
  restart: { readonly time: number }
  /** `close()` was called. */
  close: { readonly time: number }
}

/** A simulated PLC. Made by `createPlcSimulator()`. */
export interface PlcSimulator {
  /** The family it is of. */
  readonly profile: ProfileInfo
  /** Its time. */
  readonly clock: Clock
  /** Device memory as a program in the PLC sees it. */
  readonly memory: ProgramMemory
  /** Global labels as a program in the PLC sees them. */
  readonly labels: ProgramLabels
  /** Files as a program in the PLC sees them. */
  readonly files: ProgramFiles
  /** State, switch, and who holds it remotely. */
  readonly cpu: SimulatedCpu
  /** What it does wrong on purpose. */
  readonly faults: FaultSwitches
  /** The error LED of the port and what lit it. */
  readonly errors: SimulatedErrors
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
  /**
   * Transports to this PLC inside the same program, without sockets.
   * @example createMelsecClient({ ..., openTransport: plc.connect() })
   */
  connect(options?: ConnectOptions): OpenTransport
  /** As a reset or a power failure: everybody is disconnected, and nobody answered, for the given or usual time. */
  restart(ms?: number): void
  /** `memory.read`: `plc.read('D100:REAL')` */
  read(item: string, format?: ValueFormat): PlcValue
  /** `memory.addressOf`: the address of a word device for indirect specification, as ADRSET stores it. */
  addressOf(source: string): number
  /** `memory.adrset`: stores that address in two words; `plc.adrset('D100', 'D0')` makes `@D0` reach D100. */
  adrset(source: string, destination: string): void
  /** `memory.write`: `plc.write('D100:REAL', 1.5)` */
  write(item: string, value: PlcValue, format?: ValueFormat): void
  /**
   * Sends data unasked (On-demand, 2101), as a program in the PLC does, to every client or to the connections chosen: in
   * the frame of the client's last request. Who has asked nothing yet and who speaks 1E gets nothing; over UDP each port a
   * client has used in the last minute counts as one.
   * @returns to how many it was sent
   * @throws RequestError for data that no frame can carry and connections that are not there; then nothing was sent
   * @example plc.sendOnDemand([1, 2, 3])
   */
  sendOnDemand(data: OnDemandData, options?: OnDemandOptions): number
  /** Calls `listener` on every event; the returned function ends it. */
  on<E extends keyof SimulatorEvents>(event: E, listener: (event: SimulatorEvents[E]) => void): () => void
  /** Ends everything; no socket or timer is left when it resolves. */
  close(): Promise<void>
}

/**
 * A simulated PLC, answering by the same declarations and profiles the client asks by.
 * @throws RequestError BAD_OPTION
 * @example
 * const plc = createPlcSimulator({ profile: 'iq-f', tcp: { port: 5007 } })
 * await plc.listen()
 * plc.write('D100:REAL', 1.5)
 */
export function createPlcSimulator(options: PlcSimulatorOptions = {}): PlcSimulator {
  const settings = settingsOf(options)
  if (settings.frames.length === 0) badOption('profile', `${settings.profile.title}: use createLineSimulator().`)
  return new Simulator(settings)
}

class Simulator implements PlcSimulator {
  readonly profile: Profile
  readonly clock: Clock
  readonly memory: ProgramMemory
  readonly labels: ProgramLabels
  readonly files: ProgramFiles
  readonly cpu: Cpu
  readonly faults = new Faults()
  readonly errors: ErrorLog
  readonly #settings: SimulatorSettings
  readonly #shared: Shared
  readonly #plc: Plc
  readonly #events = new Emitter<SimulatorEvents>()
  readonly #counters = newCounters()
  readonly #listening: Listening<SimulatedConnection>
  #closing: Promise<void> | undefined

  constructor(settings: SimulatorSettings) {
    const { profile, clock, labels } = settings
    this.#settings = settings
    const now = () => fileClock(clock.time())
    this.profile = profile
    this.clock = clock
    this.#plc = new Plc({
      ...settings,
      now,
      changed: (change) => this.#events.emit('state', change),
      cleared: (scope) => this.#events.emit('clear', { scope }),
      restart: () => this.restart(),
    })
    this.memory = this.#plc.memory
    this.labels = labels
    this.files = new NamedFiles(profile, settings.drives, this.#plc.files, now)
    this.cpu = this.#plc.cpu
    this.errors = this.#plc.errors
    this.#shared = this.#share()
    this.#listening = new Listening<SimulatedConnection>({
      ...settings,
      counters: this.#counters,
      serve: (peer, kind, id, device) =>
        new SimulatedConnection(this.#shared, peer, kind, device ?? this.#ownerOf(peer.remote), id),
      refused: ({ id, remote }) => {
        const subject: FaultSubject = { command: undefined, subcommand: 0, connection: id, remote }
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

  listen(): Promise<void> {
    return this.#listening.listen()
  }

  connect(options: ConnectOptions = {}): OpenTransport {
    return this.#listening.connect(options)
  }

  restart(ms: number = this.#settings.restartTime): void {
    const isDown = this.#listening.goDown(ms, () => {
      this.#plc.up()
      this.#events.emit('restart', { time: this.clock.time() })
    })
    if (!isDown) return
    this.#shared.heldDatagrams.length = 0
    this.#plc.down()
  }

  read(item: string, format?: ValueFormat): PlcValue {
    return this.memory.read(item, format)
  }

  write(item: string, value: PlcValue, format?: ValueFormat): void {
    this.memory.write(item, value, format)
  }

  addressOf(source: string): number {
    return this.memory.addressOf(source)
  }

  adrset(source: string, destination: string): void {
    this.memory.adrset(source, destination)
  }

  sendOnDemand(data: OnDemandData, options: OnDemandOptions = {}): number {
    this.#listening.refuseClosed()
    const bytes = onDemandBytes(data, this.#settings.code)
    let told = 0
    for (const connection of chosen(this.#listening.connections, options)) if (connection.sendOnDemand(bytes)) told++
    return told
  }

  on<E extends keyof SimulatorEvents>(event: E, listener: (event: SimulatorEvents[E]) => void): () => void {
    return this.#events.on(event, listener)
  }

  close(): Promise<void> {
    if (this.#closing === undefined) {
      this.#closing = this.#listening.close()
      this.#events.emit('close', { time: this.clock.time() })
    }
    return this.#closing
  }

  #share(): Shared {
    const { profile, clock, code, frames, asciiXy, asciiZr, oddBits, scanTime } = this.#settings
    const given = { profile, code, asciiXy, asciiZr }
    const slmp = new SlmpCommandSet(given)
    const extended = new SlmpCommandSet({ ...given, body: bodies.ext })
    return {
      plc: this.#plc,
      ports: { slmp, extended, aCompatible: new ACompatiblePort({ profile, code, asciiXy, oddBits }) },
      frames,
      faults: this.faults,
      clock,
      scanTime,
      counters: this.#counters,
      heldDatagrams: [],
      datagramBuffer: { size: 1 + profile.inFlight.udpBuffer, used: 0 },
      observe: (event) => this.#observe(event),
      password: new PortPassword(profile.password, this.#settings),
    }
  }

  #observe(event: RequestEvent): void {
    const { command } = event
    if (command !== undefined && event.effect === 'write' && event.endCode === 0) {
      this.#events.emit('write', { ...event, command })
    }
    this.#events.emit('request', event)
  }

  /** Who asks, as remote control tells external devices apart. */
  #ownerOf(remote: string): string {
    return this.#settings.remoteOwner === 'host' ? remote.slice(0, remote.lastIndexOf(':')) : remote
  }
}
