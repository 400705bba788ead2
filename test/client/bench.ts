/** A connection to a scripted PLC in memory, with a clock made of numbers: nothing happens unless the test says so. */

import { Connection, type ConnectionOptions, type ConnectionState } from '../../src/client/connection/connection'
import { Line, type LineOptions } from '../../src/client/connection/line'
import type { PlcError } from '../../src/errors'
import type { RequestFrame } from '../../src/link/link'
import { slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { listenMemory } from '../../src/transport/memory'
import type { OpenTransport, Transport } from '../../src/transport/transport'
import { manualClock } from '../support/manual-clock'
import { exchanges, type Frame, ScriptedPlc } from './scripted-plc'

export type Kind = 'stream' | 'datagram'

export interface BenchOptions extends Partial<ConnectionOptions>, Partial<LineOptions> {
  readonly kind?: Kind
  readonly frame?: Frame
  /** As with a local port that the user fixed: it cannot be renewed. */
  readonly fixedPort?: boolean
}

export interface Station {
  readonly ask: ReturnType<typeof exchanges>
  readonly connection: Connection
  readonly states: readonly ConnectionState[]
}

export const CAUSES = ['the data code differs', 'the port is another service']

export class Bench {
  readonly clock = manualClock()
  readonly framing
  readonly plc: ScriptedPlc
  readonly memory
  readonly line: Line
  readonly frame: Frame
  readonly settings: ConnectionOptions
  readonly connection: Connection
  readonly ask
  readonly states: ConnectionState[] = []
  readonly unsolicited: string[] = []
  /** Calls of `renew` by the connection. */
  renewed = 0
  readonly #tracked: Tracked<unknown>[] = []

  constructor({ kind = 'stream', frame = '3E', fixedPort = false, ...options }: BenchOptions = {}) {
    this.framing = slmpFraming(frame, 'binary')
    this.plc = new ScriptedPlc(frame, kind)
    this.memory = listenMemory({ kind, delivery: 'manual' }, this.plc.accept)
    this.ask = exchanges(frame)
    const settings = {
      framing: this.framing,
      openTransport: this.#openTransport(fixedPort),
      clock: this.clock,
      supervisor: { first: 500, longest: 30_000, settleGap: 50, random: () => 0 },
      random: () => 0,
      inFlight: 1,
      queueLimit: 256,
      connectTimeout: 5000,
      timeout: 1000,
      probes: [{ name: 'Read Type Name (0101)', exchange: this.ask.probe }],
      proof: this.ask.proof,
      explainSilence: () => CAUSES,
      onState: (state: ConnectionState) => this.states.push(state),
      onUnsolicited: ({ body }: RequestFrame) => this.unsolicited.push(String(body)),
      ...options,
    }
    this.frame = frame
    this.settings = settings
    this.line = new Line(settings)
    this.connection = new Connection(this.line, settings)
  }

  /** Another PLC on the same line: a station behind the connected one. */
  station(station: number, options: Partial<ConnectionOptions> = {}): Station {
    const ask = exchanges(this.frame, { network: 1, station, moduleIo: 0x3ff, multidrop: 0 })
    const states: ConnectionState[] = []
    const connection = new Connection(this.line, {
      ...this.settings,
      probes: [{ name: 'Read Type Name (0101)', exchange: ask.probe }],
      onState: (state) => states.push(state),
      ...options,
    })
    return { ask, connection, states }
  }

  #openTransport(fixedPort: boolean): OpenTransport {
    return () => {
      const transport = this.memory.open()
      const renew = (): void => {
        this.renewed += 1
        transport.renew()
      }
      return new Proxy<Transport>(transport, {
        get: (target, name) => {
          if (name === 'renew') return renew
          if (name === 'renewable') return target.renewable && !fixedPort
          const value: unknown = Reflect.get(target, name)
          return typeof value === 'function' ? value.bind(target) : value
        },
      })
    }
  }

  /** A connection on which the PLC has answered, that is old enough to count as a good one. */
  static async connected(options: BenchOptions = {}): Promise<Bench> {
    const bench = new Bench(options)
    bench.follow(bench.connection.connect())
    await bench.settle()
    if (bench.connection.state.name !== 'connected') throw new Error('the bench has no connection')
    await bench.pass(10_000)
    bench.states.length = 0
    return bench
  }

  /** Delivers everything under way and lets promises run, until nothing more comes of it. */
  async settle(): Promise<void> {
    do await new Promise<void>((resolve) => setImmediate(resolve))
    while (this.memory.deliver() > 0)
  }

  /** Lets time pass, with deliveries after each timer. */
  async pass(ms: number): Promise<void> {
    const end = this.clock.now() + ms
    await this.settle()
    for (
      let next = this.clock.untilNext;
      next !== undefined && this.clock.now() + next <= end;
      next = this.clock.untilNext
    ) {
      this.clock.advance(next)
      await this.settle()
    }
    this.clock.advance(end - this.clock.now())
  }

  follow<T>(promise: Promise<T>): Tracked<T> {
    const tracked = new Tracked(promise)
    this.#tracked.push(tracked)
    return tracked
  }

  read(number: number, options?: Parameters<Connection['request']>[1]) {
    return this.follow(this.connection.request(this.ask.read(number), options))
  }

  write(number: number, value: number, options?: Parameters<Connection['request']>[1]) {
    return this.follow(this.connection.request(this.ask.write(number, value), options))
  }

  get state(): string {
    return this.connection.state.name
  }

  /** What is left when all is over: timers, connections, calls that nobody settled. */
  get leftovers() {
    return {
      timers: this.clock.pending,
      connections: this.plc.open,
      unsettled: this.#tracked.filter(({ settled }) => settled !== 1).length,
    }
  }
}

/** What became of a promise. */
export class Tracked<T> {
  settled = 0
  value: T | undefined
  error: PlcError | undefined

  constructor(promise: Promise<T>) {
    promise.then(
      (value) => {
        this.settled += 1
        this.value = value
      },
      (error: PlcError) => {
        this.settled += 1
        this.error = error
      },
    )
  }

  /** In short: the value, or code and outcome of the error. */
  get told(): unknown {
    if (this.settled === 0) return 'pending'
    return this.error === undefined ? this.value : `${this.error.code} ${this.error.outcome}`
  }
}
