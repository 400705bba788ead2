// A simulated serial line with several stations: on a serial port of this computer, behind a device server (TCP), in memory.
import { ClosedError, type ConnectionError, RequestError } from '../errors'
import type { RequestFrame } from '../link/link'
import { allStations, factsOfSerial, type SerialFrameName, type SerialHead } from '../melsec/frame/serial-frames'
import type { Profile } from '../melsec/profiles/profile'
import { type ChannelDevices, fx5Channels } from '../melsec/serial-channels'
import type { Clock } from '../transport/clock'
import { listenTcp } from '../transport/listen-tcp'
import { listenMemory, type MemoryListener } from '../transport/memory'
import { serialTransport } from '../transport/serial'
import type { Listener, OpenTransport, ServerConnection, Transport } from '../transport/transport'
import type { RequestEvent } from './connection'
import { damaged } from './damage'
import { Emitter } from './events'
import { Faults } from './faults'
import { type LineSettings, type LineSimulatorOptions, lineSettingsOf, type StationSettings } from './line-options'
import { type Heard, LineReceiver } from './line-receiver'
import type { ConnectOptions, Endpoint } from './listening'
import type { FaultSwitches } from './program'
import { type Host, type SharedLine, type SimulatedStation, Station } from './station'
import { newCounters, type SimulatorStatistics } from './statistics'
import { Wire } from './wire'
import { sumAt } from './wrong-sum'

export type { LineFrameDetails, LineSimulatorOptions, LineSpeed, LineStationOptions } from './line-options'
export type { SimulatedStation, StationEvents } from './station'

/** Somebody at a simulated line. */
export interface LineHost {
  /** Counting from 1. */
  readonly id: number
  /** Address and port, the serial port, or the name given to `connect()`. */
  readonly remote: string
}

/** What a simulated line tells those who listen. */
export interface LineEvents {
  /** Every request to any station, with its end code. */
  request: RequestEvent
  /** A host has come or gone. */
  host: { readonly change: 'opened' | 'closed'; readonly host: LineHost }
  /** `close()` was called. */
  close: { readonly time: number }
}

/** A simulated serial line. Made by `createLineSimulator()`. */
export interface LineSimulator {
  /** The stations by their numbers. */
  readonly stations: ReadonlyMap<number, SimulatedStation>
  /** What all stations do wrong on purpose. */
  readonly faults: FaultSwitches
  /** Where TCP listens; undefined before `listen()`, after `close()`, and without TCP. */
  readonly tcp: Endpoint | undefined
  /** Whether the serial port is open. */
  readonly isOpen: boolean
  /** Who is at the line at the moment. */
  readonly hosts: readonly LineHost[]
  /** What was counted since it was made. */
  readonly statistics: SimulatorStatistics
  /** Its time. */
  readonly clock: Clock
  /** A station by its number. @throws RequestError OUT_OF_RANGE when there is none */
  station(number: number): SimulatedStation
  /** @throws ConnectionError PORT_UNAVAILABLE; then nothing is open. */
  listen(): Promise<void>
  /**
   * Transports to this line inside the same program, without sockets. Each is one more host.
   * @example createMelsecClient({ ..., openTransport: line.connect() })
   */
  connect(options?: Omit<ConnectOptions, 'kind' | 'device'>): OpenTransport
  /** Bytes on the line that nobody sent, as noise is: every host hears them. */
  noise(bytes: Uint8Array): void
  /** Calls `listener` on every event; the returned function ends it. */
  on<E extends keyof LineEvents>(event: E, listener: (event: LineEvents[E]) => void): () => void
  /** Ends everything; no socket, port or timer is left when it resolves. */
  close(): Promise<void>
}

/**
 * A simulated serial line with several PLCs, which speak MC protocol in 1C, 3C and 4C frames.
 * @throws RequestError BAD_OPTION
 * @example
 * const line = createLineSimulator({ stations: { 0: {}, 1: {} }, messageFormat: 4, tcp: { port: 4001 } })
 * await line.listen()
 * line.station(1).write('D100:REAL', 1.5)
 */
export function createLineSimulator(options: LineSimulatorOptions = {}): LineSimulator {
  return new Line(lineSettingsOf(options))
}

class Line implements LineSimulator {
  readonly stations: ReadonlyMap<number, Station>
  readonly faults = new Faults()
  readonly clock: Clock
  readonly #settings: LineSettings
  readonly #receiver: LineReceiver
  readonly #wire: Wire
  readonly #events = new Emitter<LineEvents>()
  readonly #counters = newCounters()
  readonly #hosts = new Map<number, Host & { readonly peer: Pick<ServerConnection, 'send' | 'close' | 'reset'> }>()
  readonly #memoryListeners = new Set<MemoryListener>()
  readonly #timers = new Set<() => void>()
  /** Who spoke last: the line itself does not tell. */
  #speaker: Host = { id: 0, remote: 'the line' }
  #tcp: Listener | undefined
  #port: Transport | undefined
  #listening: Promise<void> | undefined
  #closing: Promise<void> | undefined
  #closed = false

  constructor(settings: LineSettings) {
    const { clock, format, framings, sumCheck, character, timeout, echo } = settings
    this.#settings = settings
    this.clock = clock
    this.#receiver = this.#newReceiver()
    this.#wire = new Wire({
      clock,
      character,
      timeout,
      echo,
      toHosts: (bytes) => this.#toHosts(bytes),
      toStations: (bytes) => this.#toStations(bytes),
      quiet: () => this.#hear(this.#receiver.pause()),
    })
    const line: SharedLine = {
      framings,
      clock,
      faults: this.faults,
      counters: this.#counters,
      messageWait: settings.messageWait,
      say: (bytes) => this.#wire.say(bytes),
      end: (connection, how) => this.#hosts.get(connection)?.peer[how](),
      noise: (bytes, ms) => this.#after(ms, () => this.#wire.say(bytes)),
      highestCode: (frame) =>
        (settings.errorDigits ?? factsOfSerial(frame).errorDigits) === 2 && format !== 5 ? 0xff : 0xffff,
      sumAt: (answer) => sumAt(answer, { format, sumCheck, sumOfAck: settings.sumOfAck }),
      observe: (event) => this.#events.emit('request', event),
    }
    this.stations = new Map([...settings.stations].map(([number, one]) => [number, stationOf(number, one, line)]))
  }

  get tcp(): Endpoint | undefined {
    return this.#tcp === undefined ? undefined : { host: this.#tcp.address, port: this.#tcp.port }
  }

  get isOpen(): boolean {
    return this.#port?.ready ?? false
  }

  get hosts(): readonly LineHost[] {
    return [...this.#hosts.values()].map(({ id, remote }) => ({ id, remote }))
  }

  get statistics(): SimulatorStatistics {
    return { ...this.#counters }
  }

  station(number: number): SimulatedStation {
    const found = this.stations.get(number)
    if (found !== undefined) return found
    const known = [...this.stations.keys()].join(', ')
    throw new RequestError('OUT_OF_RANGE', `There is no station ${number} on this line: it has ${known}.`, 'station')
  }

  listen(): Promise<void> {
    this.#listening ??= this.#listen()
    return this.#listening
  }

  connect(options: Omit<ConnectOptions, 'kind' | 'device'> = {}): OpenTransport {
    this.#refuseClosed()
    const listener = listenMemory(options, (peer) => this.#accept(peer))
    this.#memoryListeners.add(listener)
    return listener.open
  }

  noise(bytes: Uint8Array): void {
    this.#refuseClosed()
    this.#wire.say(Buffer.from(bytes))
  }

  on<E extends keyof LineEvents>(event: E, listener: (event: LineEvents[E]) => void): () => void {
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

  // --- bytes

  #toHosts(bytes: Buffer): void {
    this.#counters.bytesSent += bytes.length
    // Each gets bytes of its own: who receives them may keep them.
    for (const { peer } of [...this.#hosts.values()]) peer.send(Buffer.from(bytes))
  }

  #toStations(bytes: Buffer): boolean {
    this.#hear(this.#receiver.receive(bytes))
    return this.#receiver.pending
  }

  #newReceiver(): LineReceiver {
    const { format, sumCheck, framings } = this.#settings
    return new LineReceiver({
      format,
      sumCheck,
      framings,
      // Nobody answers for a station that is not there, so nobody measures what it is asked either.
      lengthOf: (frame, head, soFar) => {
        const station = this.#measuring(head)
        return station === undefined ? 'unknown' : station.port.lengthOf(frame, head, soFar)
      },
    })
  }

  #measuring({ station }: SerialHead): Station | undefined {
    if (station !== allStations.station) return this.stations.get(station)
    const [first] = this.stations.values()
    return first
  }

  #hear(heard: readonly Heard[]): void {
    for (const one of heard) {
      if (one.kind === 'initialise') this.#initialise()
      else if (one.kind === 'damaged') this.#hearDamaged(one)
      else this.#hearRequest(one, true)
    }
  }

  #initialise(): void {
    this.#wire.hush()
    for (const station of this.stations.values()) station.initialise()
  }

  #hearDamaged({ frame, head, damage }: Heard & { kind: 'damaged' }): void {
    this.#counters.unreadable++
    this.stations.get(head.station)?.hearDamaged(frame, head, damage, this.#speaker)
  }

  #hearRequest({ frame, request, bytes }: Heard & { kind: 'request' }, mayBeMisheard: boolean): void {
    const host = this.#speaker
    if (request.head.station === allStations.station) {
      this.#hearAll(frame, request)
      return
    }
    const station = this.stations.get(request.head.station)
    const understood = station?.understand(frame, request)
    if (station === undefined || understood === undefined) return
    const misheard = mayBeMisheard ? station.misheard(understood, host) : undefined
    if (misheard === undefined) station.hear(understood, host)
    else this.#hearAgain(damaged(bytes, misheard))
  }

  /** What stations make of a request that was damaged on its way. */
  #hearAgain(bytes: Buffer): void {
    const receiver = this.#newReceiver()
    for (const one of [...receiver.receive(bytes), ...receiver.pause()]) {
      if (one.kind === 'damaged') this.#hearDamaged(one)
      if (one.kind === 'request') this.#hearRequest(one, false)
    }
  }

  #hearAll(frame: SerialFrameName, request: RequestFrame<SerialHead>): void {
    for (const station of this.stations.values()) {
      const understood = station.understand(frame, request)
      if (understood !== undefined) station.hearAll(understood, this.#speaker)
    }
  }

  // --- hosts

  async #listen(): Promise<void> {
    this.#refuseClosed()
    const { host, tcp, serial } = this.#settings
    try {
      if (tcp !== false) this.#tcp = await listenTcp({ host, ...tcp }, (peer) => this.#accept(peer))
      if (serial !== undefined) await this.#open(serialTransport(serial)())
    } catch (error) {
      await this.#closeListeners()
      this.#listening = undefined
      throw error
    }
    if (this.#closed) await this.#closeListeners()
  }

  #accept(peer: ServerConnection): void {
    if (this.#closed) {
      peer.reset()
      return
    }
    const host = this.#join(peer.remote, peer)
    peer.onReceived = (bytes) => this.#received(bytes, host)
    peer.onClosed = () => this.#gone(host)
  }

  /** Opens the serial port: a host that is always there. */
  #open(port: Transport): Promise<void> {
    this.#port = port
    return new Promise((resolve, reject) => {
      let host: Host | undefined
      port.open({
        opened: () => {
          host = this.#join(port.description, {
            send: (bytes) => {
              if (port.ready) port.send(bytes)
            },
            // A serial port has no connection that a fault could end.
            close() {},
            reset() {},
          })
          resolve()
        },
        received: (bytes) => {
          // Lent by the transport, and kept here.
          if (host !== undefined) this.#received(Buffer.from(bytes), host)
        },
        closed: (error: ConnectionError | undefined) => {
          if (host === undefined) reject(error)
          else this.#gone(host)
        },
      })
    })
  }

  #join(remote: string, peer: Pick<ServerConnection, 'send' | 'close' | 'reset'>): Host {
    const host = { id: ++this.#counters.connections, remote }
    this.#hosts.set(host.id, { ...host, peer })
    this.#events.emit('host', { change: 'opened', host })
    return host
  }

  #gone(host: Host): void {
    if (!this.#hosts.delete(host.id)) return
    this.#events.emit('host', { change: 'closed', host })
  }

  #received(bytes: Buffer, host: Host): void {
    this.#counters.bytesReceived += bytes.length
    this.#speaker = host
    const lost = this.#wire.hear(bytes)
    this.#counters.discarded += lost
  }

  #after(ms: number, run: () => void): void {
    const cancel = this.clock.timer(ms, () => {
      this.#timers.delete(cancel)
      run()
    })
    this.#timers.add(cancel)
  }

  async #close(): Promise<void> {
    for (const cancel of this.#timers) cancel()
    this.#timers.clear()
    this.#wire.close()
    for (const station of this.stations.values()) station.close()
    for (const listener of this.#memoryListeners) listener.close()
    await this.#listening?.catch(() => {})
    await this.#closeListeners()
  }

  async #closeListeners(): Promise<void> {
    const [listener, port] = [this.#tcp, this.#port]
    this.#tcp = undefined
    this.#port = undefined
    port?.close()
    await listener?.close()
  }

  #refuseClosed(): void {
    if (this.#closed) throw new ClosedError('CLOSED', 'This line is closed: make another one.')
  }
}

function stationOf(number: number, { settings, channel }: StationSettings, line: SharedLine): Station {
  return new Station({ number, settings, channel: channelOf(settings.profile, channel), line })
}

/** Where a family is told of its channels; FX3 has them under names of its own, for two channels. */
function channelOf({ serial, aCompatible }: Profile, channel: StationSettings['channel']): ChannelDevices | undefined {
  if (serial?.channels !== undefined) return serial.channels.devices[channel]
  if (aCompatible?.calledAsInFrame !== true || channel > 2) return undefined
  return fx5Channels.fx3.channels[channel === 1 ? 1 : 2]
}
