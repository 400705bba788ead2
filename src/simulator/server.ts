// A simulated PLC that listens: on TCP, on UDP and in memory.
import { badOption } from '../basics/option-checks'
import { ClosedError } from '../errors'
import type { CommandName } from '../melsec/commands/commands'
import { bodies } from '../melsec/frame/body'
import type { Profile, ProfileInfo } from '../melsec/profiles/profile'
import { SlmpCommandSet } from '../melsec/protocol'
import type { Clock } from '../transport/clock'
import { listenTcp } from '../transport/listen-tcp'
import { listenUdp } from '../transport/listen-udp'
import { listenMemory, type MemoryListener } from '../transport/memory'
import type { Listener, OpenTransport, ServerConnection } from '../transport/transport'
import type { PlcValue, ValueFormat } from '../value/value'
import { ACompatiblePort } from './a-compatible-port'
import { type RequestEvent, type Shared, SimulatedConnection } from './connection'
import type { Cpu, StateChange } from './cpu'
import type { ErrorLog } from './error-log'
import { Emitter } from './events'
import { type FaultSubject, Faults } from './faults'
import { fileClock } from './file-clock'
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

/** Where a port listens. */
export interface Endpoint {
  /** Address it listens on. */
  readonly host: string
  /** Number of the port. */
  readonly port: number
}

/** A client at the moment. */
export interface ConnectionInfo {
  /** Counting from 1. */
  readonly id: number
  /** TCP (`stream`) or UDP (`datagram`). */
  readonly kind: 'stream' | 'datagram'
  /** Address and port, or the name given to `connect()`. */
  readonly remote: string
  /** Milliseconds since 1970. */
  readonly since: number
  /** Requests so far. */
  readonly requests: number
}

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
  connection: { readonly change: 'opened' | 'closed' | 'turnedAway'; readonly connection: ConnectionInfo }
  /** Power is on again after a reset or `restart()`: devices that are not latched are 0. */
  restart: { readonly time: number }
  /** `close()` was called. */
  close: { readonly time: number }
}

/** How a client is joined to the simulated PLC in memory. */
export interface ConnectOptions {
  /** As TCP (`stream`, default) or as UDP. */
  readonly kind?: 'stream' | 'datagram'
  /** How bytes of a stream are cut and joined on their way, both directions; as they are sent, by default. */
  readonly chunking?: (pending: readonly Buffer[], to: 'client' | 'server') => readonly Buffer[]
  /** As sockets (default), or before `send` returns. */
  readonly delivery?: 'microtask' | 'synchronous'
  /** Who this is in remote control. Default: every call of `connect()` is another device. */
  readonly device?: string
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
  readonly #connections = new Map<ServerConnection, SimulatedConnection>()
  readonly #memoryListeners = new Set<MemoryListener>()
  readonly #timers = new Set<() => void>()
  /** Entries that are not yet free again after their connections have ended. */
  #releasing = 0
  #connects = 0
  #down = false
  #closed = false
  #tcp: Listener | undefined
  #udp: Listener | undefined
  #listening: Promise<void> | undefined
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
  }

  get tcp(): Endpoint | undefined {
    return endpoint(this.#tcp)
  }

  get udp(): Endpoint | undefined {
    return endpoint(this.#udp)
  }

  get connections(): readonly ConnectionInfo[] {
    return [...this.#connections.values()].map(info)
  }

  get statistics(): SimulatorStatistics {
    return { ...this.#counters }
  }

  listen(): Promise<void> {
    this.#listening ??= this.#listen()
    return this.#listening
  }

  connect(options: ConnectOptions = {}): OpenTransport {
    const { kind = 'stream', device = `device ${++this.#connects}`, ...rest } = options
    this.#refuseClosed()
    const listener = listenMemory({ kind, ...rest }, (peer) => this.#accept(peer, kind, device))
    this.#memoryListeners.add(listener)
    return listener.open
  }

  restart(ms: number = this.#settings.restartTime): void {
    if (this.#down || this.#closed) return
    this.#down = true
    for (const connection of this.#connections.values()) connection.end('reset')
    this.#shared.heldDatagrams.length = 0
    this.#plc.down()
    this.#after(ms, () => {
      this.#down = false
      this.#plc.up()
      this.#events.emit('restart', { time: this.clock.time() })
    })
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
    this.#refuseClosed()
    const bytes = onDemandBytes(data, this.#settings.code)
    let told = 0
    for (const connection of chosen(this.#connections.values(), options)) if (connection.sendOnDemand(bytes)) told++
    return told
  }

  on<E extends keyof SimulatorEvents>(event: E, listener: (event: SimulatorEvents[E]) => void): () => void {
    return this.#events.on(event, listener)
  }

  close(): Promise<void> {
    if (this.#closing === undefined) {
      this.#closed = true
      this.#closing = this.#close()
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

  async #listen(): Promise<void> {
    this.#refuseClosed()
    const { host, tcp, udp, clock } = this.#settings
    try {
      if (tcp !== false) this.#tcp = await listenTcp({ host, ...tcp }, (peer) => this.#acceptSocket(peer, 'stream'))
      if (udp !== false)
        this.#udp = await listenUdp({ host, clock, ...udp }, (peer) => this.#acceptSocket(peer, 'datagram'))
    } catch (error) {
      await this.#closeListeners()
      this.#listening = undefined
      throw error
    }
    if (this.#closed) await this.#closeListeners()
  }

  #acceptSocket(peer: ServerConnection, kind: 'stream' | 'datagram'): void {
    const { remote } = peer
    this.#accept(peer, kind, this.#settings.remoteOwner === 'host' ? remote.slice(0, remote.lastIndexOf(':')) : remote)
  }

  #accept(peer: ServerConnection, kind: 'stream' | 'datagram', owner: string): void {
    if (this.#down || this.#closed) {
      // A PLC that starts again has no connections to end in an orderly way; datagrams just get lost.
      peer.reset()
      return
    }
    const connection = new SimulatedConnection(this.#shared, peer, kind, owner, ++this.#counters.connections)
    const turnAway = kind === 'stream' ? this.#turnAway(connection) : undefined
    if (turnAway !== undefined) {
      this.#counters.turnedAway++
      connection.end(turnAway)
      this.#events.emit('connection', { change: 'turnedAway', connection: info(connection) })
      return
    }
    this.#connections.set(peer, connection)
    peer.onClosed = () => this.#gone(peer, connection)
    this.#events.emit('connection', { change: 'opened', connection: info(connection) })
  }

  /** How a connection ends before it begins, if it does. */
  #turnAway(connection: SimulatedConnection): 'close' | 'reset' | undefined {
    const subject: FaultSubject = {
      command: undefined,
      subcommand: 0,
      connection: connection.id,
      remote: connection.remote,
    }
    const fault = this.faults.take('closeOnAccept', subject)
    if (fault !== undefined) return fault.how
    let taken = this.#releasing
    for (const { kind } of this.#connections.values()) if (kind === 'stream') taken++
    return taken >= this.#settings.maxConnections ? 'close' : undefined
  }

  #gone(peer: ServerConnection, connection: SimulatedConnection): void {
    connection.end()
    this.#connections.delete(peer)
    if (connection.kind === 'stream' && this.#settings.entryRelease > 0 && !this.#down) {
      this.#releasing++
      this.#after(this.#settings.entryRelease, () => {
        this.#releasing--
      })
    }
    this.#events.emit('connection', { change: 'closed', connection: info(connection) })
  }

  #after(ms: number, run: () => void): void {
    const cancel = this.clock.timer(
      ms,
      () => {
        this.#timers.delete(cancel)
        run()
      },
      { unref: true },
    )
    this.#timers.add(cancel)
  }

  async #close(): Promise<void> {
    for (const cancel of this.#timers) cancel()
    this.#timers.clear()
    for (const connection of this.#connections.values()) connection.end('close')
    for (const listener of this.#memoryListeners) listener.close()
    await this.#listening?.catch(() => {})
    await this.#closeListeners()
  }

  async #closeListeners(): Promise<void> {
    const listeners = [this.#tcp, this.#udp]
    this.#tcp = undefined
    this.#udp = undefined
    await Promise.all(listeners.map((listener) => listener?.close()))
  }

  #refuseClosed(): void {
    if (this.#closed) throw new ClosedError('CLOSED', 'This simulator is closed: make another one.')
  }
}

function info({ id, kind, remote, since, requests }: SimulatedConnection): ConnectionInfo {
  return { id, kind, remote, since, requests }
}

function endpoint(listener: Listener | undefined): Endpoint | undefined {
  return listener === undefined ? undefined : { host: listener.address, port: listener.port }
}
