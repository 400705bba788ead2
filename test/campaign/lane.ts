/** One client and one PLC, scene after scene. The scenes follow from the seed; how they end also from the machine. */
import { createSocket } from 'node:dgram'
import { type AddressInfo, createServer } from 'node:net'
import { createMelsecClient, type MelsecClientOptions, PlcError } from '../../src/index'
import { Random } from '../fuzz/random'
import { type Caller, callers, type Stage } from './callers'
import { Call, type CallParts, Cells, type Client, errorText, type Options } from './calls'
import { type Configuration, clientOptions, TIMEOUT } from './configurations'
import { type Fault, faults, weightOf } from './faults'
import { Journal } from './journal'
import { Ledger, type ViolationKind } from './ledger'
import { Plc } from './plc'

export interface Violation {
  readonly kind: ViolationKind
  readonly configuration: string
  /** Place in the lane's sequence, which the seed gives. */
  readonly scene: number
  readonly caller: string
  readonly call: string
  readonly detail: string
  /** What happened on the wire since a little before the call. */
  readonly story: readonly string[]
}

export interface LaneOptions {
  readonly configuration: Configuration
  readonly seed: number
  readonly exchanges: number
  /** Faults and callers to use; default all that fit. */
  readonly faults?: readonly Fault[]
  readonly callers?: readonly Caller[]
  /** Puts something between the campaign and the client. */
  readonly double?: (client: Client) => Client
  readonly onViolation: (violation: Violation) => void
  /** Scenes of other lanes that go on at the same time. */
  readonly gate: Gate
}

/** Lets so many scenes go on at once: with more the processor is what all of them wait for. */
export class Gate {
  #free: number
  readonly #waiting: (() => void)[] = []

  constructor(places: number) {
    this.#free = places
  }

  async pass<T>(work: () => Promise<T>): Promise<T> {
    if (this.#free > 0) this.#free -= 1
    else await new Promise<void>((resolve) => this.#waiting.push(resolve))
    try {
      return await work()
    } finally {
      const next = this.#waiting.shift()
      if (next === undefined) this.#free += 1
      else next()
    }
  }
}

/** What a lane counts. */
export interface Tally {
  exchanges: number
  readonly outcomes: Map<string, number>
  readonly faults: Map<string, number>
  readonly callers: Map<string, number>
}

/** ms after which a call counts as one that never ends; a busy machine is much faster. */
const NEVER = 15_000
/** ms of the story before a call. */
const BEFORE = 300

export class Lane implements Stage {
  readonly random = new Random()
  /** Of the clients: a start of a program does not begin where another one began. */
  readonly #clientRandom = new Random()
  readonly plc: Plc
  readonly tally: Tally = { exchanges: 0, outcomes: new Map(), faults: new Map(), callers: new Map() }
  readonly #options: LaneOptions
  readonly #journal = new Journal()
  readonly #ledger: Ledger
  readonly #parts: CallParts
  readonly #faults: readonly Fault[]
  readonly #callers: readonly Caller[]
  readonly #lasting = new Set<Call>()
  #client: Client | undefined
  #localPort: number | undefined
  #scene = 0
  #caller = ''

  constructor(options: LaneOptions) {
    const { configuration } = options
    this.#options = options
    this.#ledger = new Ledger((detail) => this.#report(undefined, 'a request that nobody made', detail))
    this.plc = new Plc(configuration, this.#ledger, this.#journal)
    this.#parts = {
      ledger: this.#ledger,
      journal: this.#journal,
      cells: new Cells(),
      random: this.random,
      violation: (call, kind, detail) => this.#report(call, kind, detail),
    }
    this.#faults = (options.faults ?? faults).flatMap((fault) => {
      return fault.on(configuration) ? Array.from({ length: weightOf(fault, configuration) }, () => fault) : []
    })
    this.#callers = options.callers ?? callers
  }

  get client(): Client {
    if (this.#client === undefined) throw new Error('the lane has not begun')
    return this.#client
  }

  async run(): Promise<Tally> {
    const { configuration, seed, exchanges, gate } = this.#options
    this.#clientRandom.restart(seed, 0)
    if (configuration.fixedPort) this.#localPort = await freePort(configuration.transport)
    await this.plc.listen()
    this.#client = this.#makeClient()
    try {
      for (; this.tally.exchanges < exchanges; this.#scene += 1) {
        this.random.restart(seed, this.#scene)
        // Most calls find a connection; the others find what the last scene left.
        if (!this.random.oneIn(4)) await this.#connected()
        await gate.pass(() => this.#play())
      }
      await this.#end()
    } finally {
      await this.plc.close()
    }
    for (const [name, count] of this.plc.used) add(this.tally.faults, name, count)
    return this.tally
  }

  async #play(): Promise<void> {
    const { random, plc } = this
    const caller = random.pick(this.#callers)
    this.#caller = caller.name
    add(this.tally.callers, caller.name)
    this.#armSome()
    this.#journal.add(`scene ${this.#scene}: ${caller.name}`)
    const played = caller.play(this).catch((error: unknown) => this.#report(undefined, 'no PlcError', errorText(error)))
    if (await isLate(played)) {
      for (const call of this.#lasting) this.#report(call, 'never settled', `it lasts ${NEVER} ms`)
      if (this.#lasting.size === 0) this.#report(undefined, 'never settled', 'something else than a call')
      this.#lasting.clear()
      this.#client = this.#makeClient()
    }
    plc.onReceived = undefined
    plc.onAnswered = undefined
    plc.disarm()
  }

  #armSome(): void {
    const { random } = this
    if (this.#faults.length === 0) return
    const count = random.pick([0, 0, 0, 1, 1, 1, 2])
    for (let i = 0; i < count; i += 1) {
      const { name, make } = random.pick(this.#faults)
      this.plc.arm({ name, skip: random.pick([0, 0, 1, 2]), probes: random.oneIn(4), run: make(random) })
    }
  }

  async #connected(): Promise<void> {
    for (let attempt = 0; attempt < 40; attempt += 1) {
      if (this.client.state.name === 'connected') return
      await this.client.connect({ timeout: 5 * TIMEOUT }).catch(() => this.sleep(5))
    }
  }

  async call(options: Options = {}): Promise<void> {
    const call = new Call(this.#parts)
    this.tally.exchanges += 1
    this.#lasting.add(call)
    await call.run(this.client, options, this.tally.exchanges, TIMEOUT)
    this.#lasting.delete(call)
    add(this.tally.outcomes, call.ended ?? 'none')
  }

  async badCall(): Promise<void> {
    const bad = [
      () => this.client.read('D5:NOTYPE'),
      () => this.client.read('Q1'),
      () => this.client.write('D5:WORD', 70_000),
      () => this.client.write('D5:WORD', 1, { timeout: -1 }),
    ]
    this.tally.exchanges += 1
    try {
      await this.random.pick(bad)()
      this.#report(undefined, 'done but not carried out', 'a call that cannot be')
    } catch (error) {
      if (!(error instanceof PlcError)) this.#report(undefined, 'no PlcError', errorText(error))
      else if (error.outcome !== 'notSent') this.#report(undefined, 'sent though told as notSent', errorText(error))
      add(this.tally.outcomes, error instanceof PlcError ? error.outcome : 'no PlcError')
    }
  }

  async renew(): Promise<void> {
    this.#journal.add('close()')
    const closed = this.client.close()
    this.#client = this.#makeClient()
    await closed
  }

  sleep(ms: number): Promise<void> {
    return new Promise((resolve) => setTimeout(resolve, ms))
  }

  /** Everything has ended: nothing may be left in the client. */
  async #end(): Promise<void> {
    this.plc.deaf = false
    await this.sleep(6 * TIMEOUT)
    await this.#connected()
    const { queued, inFlight } = this.client.statistics
    if (queued + inFlight > 0) this.#report(undefined, 'something is left', `${queued} queued, ${inFlight} in flight`)
    if (await isLate(this.client.close())) this.#report(undefined, 'never settled', 'close()')
  }

  #makeClient(): Client {
    const { configuration, double } = this.#options
    const options: MelsecClientOptions = {
      // Numbers and patterns begin anew with each client, as they do with each start of a program.
      ...clientOptions(configuration, () => this.#clientRandom.next() / 2 ** 32),
      port: this.plc.port,
      ...(this.#localPort === undefined ? {} : { localPort: this.#localPort }),
    }
    const client = createMelsecClient(options)
    client.on('state', ({ name, error }) => {
      this.#journal.add(`client is ${name}${error === undefined ? '' : `, ${errorText(error)}`}`)
    })
    return double === undefined ? client : double(client)
  }

  #report(call: Call | undefined, kind: ViolationKind, detail: string): void {
    this.#options.onViolation({
      kind,
      configuration: this.#options.configuration.name,
      scene: this.#scene,
      caller: this.#caller,
      call: call === undefined ? '' : String(call),
      detail,
      story: this.#journal.since((call?.startedAt ?? performance.now()) - BEFORE),
    })
  }
}

export function add(counts: Map<string, number>, name: string, count = 1): void {
  counts.set(name, (counts.get(name) ?? 0) + count)
}

async function isLate(promise: Promise<unknown>): Promise<boolean> {
  let timer: NodeJS.Timeout | undefined
  const late = new Promise<true>((resolve) => {
    timer = setTimeout(() => resolve(true), NEVER)
  })
  const isTrue = await Promise.race([promise.then(() => false), late])
  clearTimeout(timer)
  return isTrue
}

/** A port that nobody has at the moment. */
function freePort(transport: Configuration['transport']): Promise<number> {
  if (transport === 'udp') {
    const socket = createSocket('udp4')
    return new Promise((resolve) => {
      socket.bind(0, '0.0.0.0', () => {
        const { port } = socket.address()
        socket.close(() => resolve(port))
      })
    })
  }
  const server = createServer()
  return new Promise((resolve) => {
    server.listen(0, '0.0.0.0', () => {
      const { port } = server.address() as AddressInfo
      server.close(() => resolve(port))
    })
  })
}
