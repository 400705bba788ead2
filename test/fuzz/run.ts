/**
 * Reads random and damaged frames with everything that reads frames. What comes of them is a value or a ProtocolError
 * (EndCodeError for an answer that says so); anything else that is thrown is a bug, and so is memory or time without end.
 */

import { setFlagsFromString } from 'node:v8'
import { runInNewContext } from 'node:vm'
import { EndCodeError, ProtocolError, RequestError } from '../../src/errors'
import type { Head } from '../../src/link/link'
import { type Framing, Responder, Session } from '../../src/link/link'
import { createPlcSimulator, type PlcSimulator } from '../../src/simulator/server'
import type { Transport } from '../../src/transport/transport'
import { manualClock } from '../support/manual-clock'
import type { Sample } from './corpus'
import { Damage } from './damage'
import type { FrameKind, Spoken } from './frame-kinds'
import { Random } from './random'

export interface FuzzOptions {
  readonly seed: number
  /** Frames in each direction. */
  readonly frames: number
  /** One in so many is also explained in words, and one in so many requests is given to a simulated PLC. */
  readonly every: number
}

/** What became of the frames of one direction. */
export interface Tally {
  frames: number
  values: number
  endCodes: number
  protocolErrors: number
  incomplete: number
  /** ms of processor time that a single frame took at most, and its place: a busy machine makes no difference. */
  longest: number
  longestAt: number
  ms: number
  /** Most bytes a session or responder kept. */
  buffered: number
}

export interface FuzzResult {
  readonly kind: string
  /** Names of the commands whose messages were used. */
  readonly commands: readonly string[]
  /** Bytes the heap grew, garbage collected. */
  readonly grown: number
  readonly requests: Tally
  readonly answers: Tally
}

const KEPT_AT_MOST = 65_536

setFlagsFromString('--expose-gc')
const collect: unknown = runInNewContext('gc')

function heapUsed(): number {
  if (typeof collect === 'function') collect()
  const { heapUsed, external } = process.memoryUsage()
  return heapUsed + external
}

export function fuzz(kind: FrameKind, options: FuzzOptions): FuzzResult {
  // Millions of errors are made: without traces they are cheap.
  const { stackTraceLimit } = Error
  Error.stackTraceLimit = 0
  try {
    return kind.use((spoken) => {
      const before = heapUsed()
      const requests = new Requests(spoken, options).run(kind.name)
      const answers = new Answers(spoken, options).run(kind.name)
      const commands = [...new Set(spoken.samples.map(({ command }) => command))]
      return { kind: kind.name, commands, grown: heapUsed() - before, requests, answers }
    })
  } finally {
    Error.stackTraceLimit = stackTraceLimit
  }
}

abstract class Direction<H extends Head> {
  protected readonly random = new Random()
  protected readonly damage: Damage
  readonly tally: Tally = {
    frames: 0,
    values: 0,
    endCodes: 0,
    protocolErrors: 0,
    incomplete: 0,
    longest: 0,
    longestAt: 0,
    ms: 0,
    buffered: 0,
  }

  constructor(
    protected readonly spoken: Spoken<H>,
    protected readonly options: FuzzOptions,
  ) {
    this.damage = new Damage(this.random, spoken.code === 'ascii')
  }

  abstract readonly side: string
  /** One frame, through everything. */
  protected abstract step(): void

  run(name: string): Tally {
    const { seed, frames } = this.options
    const started = performance.now()
    for (let i = 0; i < frames; i++) {
      this.random.restart(seed, i)
      const before = process.cpuUsage()
      try {
        this.step()
      } catch (error) {
        const bytes = this.damage.bytes.subarray(0, 400).toString('hex')
        throw new Error(`${name} ${this.side} ${i} of seed ${seed}: ${bytes}: ${describe(error)}`, { cause: error })
      }
      this.#took(process.cpuUsage(before), i)
    }
    this.tally.frames = frames
    this.tally.ms = performance.now() - started
    return this.tally
  }

  #took({ user, system }: NodeJS.CpuUsage, place: number): void {
    const ms = (user + system) / 1000
    if (ms <= this.tally.longest) return
    this.tally.longest = ms
    this.tally.longestAt = place
  }

  /** A frame with damage to it, or to its body alone so that it comes as far as the decoder. */
  protected make(
    body: Uint8Array,
    other: Uint8Array,
    frame: (body: Uint8Array) => Buffer,
    foreign: () => Buffer,
  ): Buffer {
    const { random, damage } = this
    const how = random.below(16)
    if (how === 0) return damage.loadAny().bytes
    if (how === 1) return damage.load(foreign()).bytes
    if (how === 2) return damage.load(frame(body)).bytes
    if (how < 8) return damage.load(frame(body)).times(frame(other)).bytes
    const damaged = damage.load(body).times(other).bytes
    return damage.load(frame(damaged.subarray(0, 0xfff0))).bytes
  }

  /** Copies, because a session keeps its chunks; cut anywhere. */
  protected chunks(bytes: Buffer): Buffer[] {
    const { random } = this
    const copy = Buffer.from(bytes)
    if (copy.length < 2 || random.oneIn(2)) return [copy]
    const first = 1 + random.below(copy.length - 1)
    const second = first + random.below(copy.length - first)
    return [copy.subarray(0, first), copy.subarray(first, second), copy.subarray(second)].filter(
      ({ length }) => length > 0,
    )
  }

  /** Counts what `read` gives; what is no error of the peer goes on as it is. */
  protected count(read: () => unknown): void {
    const { tally } = this
    try {
      if (read() === undefined) tally.incomplete++
      else tally.values++
    } catch (error) {
      if (error instanceof ProtocolError) tally.protocolErrors++
      else if (error instanceof EndCodeError) tally.endCodes++
      else throw error
    }
  }

  protected kept(bytes: number): void {
    if (bytes > KEPT_AT_MOST) throw new Error(`${bytes} bytes are kept`)
    if (bytes > this.tally.buffered) this.tally.buffered = bytes
  }

  /** A request and another one. */
  protected pick(): readonly [Sample, Sample] {
    const { samples } = this.spoken
    return [this.random.pick(samples), this.random.pick(samples)]
  }
}

/** The PLC's side. */
class Requests<H extends Head> extends Direction<H> {
  readonly side = 'request'
  readonly #stream: Responder<H>
  readonly #datagrams: Responder<H>
  readonly #plc: Plc<H> | undefined

  constructor(spoken: Spoken<H>, options: FuzzOptions) {
    super(spoken, options)
    this.#stream = new Responder(spoken.framing, 'stream', spoken.requestLength)
    this.#datagrams = new Responder(spoken.framing, 'datagram', spoken.requestLength)
    this.#plc = spoken.plc && new Plc(spoken)
  }

  protected step(): void {
    const { framing, requestLength, readRequest, explain } = this.spoken
    const [one, other] = this.pick()
    const serial = this.random.below(0x10000)
    const bytes = this.make(
      one.exchange.body,
      other.exchange.body,
      (body) => framed((carried) => framing.request.write(headOf(this.spoken, one), serial, carried), body),
      () => framed((carried) => framing.response.write(headOf(this.spoken, one), serial, 0, carried), one.answer),
    )
    this.count(() => {
      const scanned = framing.request.scan(bytes, requestLength)
      return scanned && readRequest(scanned.frame)
    })
    const responder = this.random.oneIn(4) ? this.#datagrams : this.#stream
    const chunks = this.chunks(bytes)
    for (const chunk of chunks) {
      for (const frame of responder.receive(chunk)) this.#read(frame)
      this.kept(responder.buffered)
    }
    if (this.random.oneIn(this.options.every)) explain(bytes, undefined)
    if (this.random.oneIn(this.options.every)) this.#plc?.send(chunks)
  }

  #read(frame: Parameters<Spoken<H>['readRequest']>[0]): void {
    try {
      this.spoken.readRequest(frame)
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error
    }
  }
}

/** The client's side: each answer meets the request it belongs to. */
class Answers<H extends Head> extends Direction<H> {
  readonly side = 'answer'
  #now = 0
  #streams: Session
  #datagrams: Session

  constructor(spoken: Spoken<H>, options: FuzzOptions) {
    super(spoken, options)
    this.#streams = this.#session('stream')
    this.#datagrams = this.#session('datagram')
  }

  #session(kind: 'stream' | 'datagram'): Session {
    return new Session(this.spoken.framing, { kind, window: 1 })
  }

  protected step(): void {
    const { framing, requestLength, explain } = this.spoken
    const { random } = this
    const [one, other] = this.pick()
    const { exchange } = one
    const kind = random.oneIn(4) ? 'datagram' : 'stream'
    const session = kind === 'stream' ? this.#streams : this.#datagrams
    const job = { ...exchange, deadline: ++this.#now }
    session.submit(job, this.#now - 1)
    const sent = session.transmit()
    if (sent === undefined) throw new Error('the session sends nothing')
    const serial = framing.request.scan(sent, requestLength)?.frame.serial ?? 0
    const endCode = random.oneIn(8) ? random.pick(this.spoken.endCodes ?? [1, 0x5b, 0xc056, 0xffff]) : 0
    const bytes = this.make(
      one.answer,
      other.answer,
      (body) => framed((carried) => framing.response.write(headOf(this.spoken, one), serial, endCode, carried), body),
      () => sent,
    )
    this.count(() => {
      const scanned = framing.response.scan(bytes, exchange.responseLength)
      return scanned && exchange.decode(scanned.frame)
    })
    for (const chunk of this.chunks(bytes)) {
      session.receive(chunk, this.#now - 1)
      this.kept(session.buffered)
    }
    session.timeout(this.#now)
    if (this.#outcome(session, job, exchange)) this.#renew(kind, session)
    if (random.oneIn(this.options.every)) explain(bytes, random.oneIn(2) ? undefined : sent)
  }

  /** The job ends once. Says whether the session is at its end. */
  #outcome(session: Session, job: object, exchange: Sample['exchange']): boolean {
    let done = 0
    let dropped = false
    for (let event = session.poll(); event !== undefined; event = session.poll()) {
      if (event.kind === 'drop') dropped = true
      if (event.kind !== 'done' || event.job !== job) continue
      done++
      const { outcome } = event
      if (outcome.kind === 'answered') this.#decode(exchange, outcome.frame)
    }
    if (done !== 1) throw new Error(`the request ended ${done} times`)
    return dropped
  }

  #decode(exchange: Sample['exchange'], frame: Parameters<typeof exchange.decode>[0]): void {
    try {
      exchange.decode(frame)
    } catch (error) {
      if (!(error instanceof ProtocolError || error instanceof EndCodeError)) throw error
    }
  }

  #renew(kind: 'stream' | 'datagram', session: Session): void {
    session.disconnected()
    if (session.buffered + session.inFlight + session.queued > 0) throw new Error('an ended session keeps something')
    if (kind === 'stream') this.#streams = this.#session(kind)
    else this.#datagrams = this.#session(kind)
  }
}

/** Longer than a simulated PLC is away after a remote RESET. */
const AWAY = 60_000

/** A simulated PLC that lives on whatever comes, with every handler; what it answers are frames. */
class Plc<H extends Head> {
  readonly #clock = manualClock()
  readonly #plc: PlcSimulator
  readonly #scan: Framing<H>['response']['scan'] | undefined
  #transport: Transport | undefined
  #received: Buffer = Buffer.alloc(0)

  constructor({ plc, framing, code }: Spoken<H>) {
    this.#plc = createPlcSimulator({ ...plc, code, clock: this.#clock })
    // Where an answer of 1E ends, only its request tells.
    if (plc?.frames.includes('1E') === false) this.#scan = framing.response.scan
  }

  send(chunks: readonly Buffer[]): void {
    for (const chunk of chunks) {
      if (this.#transport === undefined) this.#connect()
      this.#transport?.send(chunk)
    }
    while (this.#scan !== undefined && this.#received.length > 0) {
      const scanned = this.#scan(this.#received, () => undefined)
      if (scanned === undefined) throw new Error('the simulated PLC sent half a frame')
      this.#received = this.#received.subarray(scanned.used)
    }
  }

  #connect(): void {
    this.#clock.advance(AWAY)
    const transport = this.#plc.connect({ delivery: 'synchronous' })()
    transport.open({
      opened: () => {
        this.#transport = transport
        this.#received = Buffer.alloc(0)
      },
      received: (bytes) => {
        this.#received = this.#scan === undefined ? bytes : Buffer.concat([this.#received, bytes])
      },
      closed: () => {
        this.#transport = undefined
      },
    })
    if (this.#transport === undefined) throw new Error('the simulated PLC does not come back')
  }
}

/** Serial frames in ASCII code carry characters only: there each byte becomes one. */
function framed(frame: (body: Uint8Array) => Buffer, body: Uint8Array): Buffer {
  try {
    return frame(body)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    return frame(body.map((byte) => 0x20 + (byte % 0x5f)))
  }
}

function describe(error: unknown): string {
  return error instanceof Error ? `${error.name}: ${error.message}` : String(error)
}

/** What stands in front of its body. */
function headOf<H extends Head>({ framing, requestLength }: Spoken<H>, { exchange }: Sample): H {
  const scanned = framing.request.scan(exchange.write(0), requestLength)
  if (scanned === undefined) throw new Error('a sample is no whole request')
  return scanned.frame.head
}
