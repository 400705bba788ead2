// One station of a simulated serial line: a whole PLC that answers to its number.
import { withoutSecrets } from '../codec/codec'
import type { RequestFrame } from '../link/link'
import type { SerialFrameName, SerialHead } from '../melsec/frame/serial-frames'
import type { SerialFraming } from '../melsec/frame/serial-framing'
import type { Profile, ProfileInfo } from '../melsec/profiles/profile'
import type { ChannelDevices } from '../melsec/serial-channels'
import type { Clock } from '../transport/clock'
import type { PlcValue, ValueFormat } from '../value/value'
import type { RequestEvent } from './connection'
import type { Cpu } from './cpu'
import { type Delivered, Delivery, type FaultSource, type HeldAnswers, NOTHING } from './delivery'
import type { ErrorLog } from './error-log'
import { Emitter } from './events'
import { Faults } from './faults'
import { fileClock } from './file-clock'
import type { HandlerCall } from './handler'
import type { FrameDamage } from './line-receiver'
import type { SimulatorSettings } from './options'
import { type Answer, Plc } from './plc'
import { PortPassword } from './port-lock'
import type { FaultSwitches, ProgramMemory, SimulatedCpu, SimulatedErrors } from './program'
import { Refusal } from './refusal'
import { Sequence, type Step } from './sequence'
import type { SimulatorEvents, WriteEvent } from './server'
import { readOf, StationPort, type StationRequest } from './station-port'
import type { Counters } from './statistics'
import { withWrongSum } from './wrong-sum'

/** What a station of a simulated line tells those who listen. */
export type StationEvents = Omit<SimulatorEvents, 'connection'>

/** A station of a simulated line: a simulated PLC that answers to its number. */
export interface SimulatedStation {
  /** Its number on the line. */
  readonly number: number
  /** The family it is of. */
  readonly profile: ProfileInfo
  /** Its time. */
  readonly clock: Clock
  /** Device memory as a program in the PLC sees it. */
  readonly memory: ProgramMemory
  /** State, switch, and who holds it remotely. */
  readonly cpu: SimulatedCpu
  /** What this station does wrong on purpose; what all stations do, the line has. */
  readonly faults: FaultSwitches
  /** What it refused. */
  readonly errors: SimulatedErrors
  /** As a reset or a power failure: for the given or usual time it answers nobody. */
  restart(ms?: number): void
  /** `memory.read`: `station.read('D100:REAL')` */
  read(item: string, format?: ValueFormat): PlcValue
  /** `memory.write`: `station.write('D100:REAL', 1.5)` */
  write(item: string, value: PlcValue, format?: ValueFormat): void
  /** Calls `listener` on every event; the returned function ends it. */
  on<E extends keyof StationEvents>(event: E, listener: (event: StationEvents[E]) => void): () => void
}

/** Who speaks at the line. */
export interface Host {
  readonly id: number
  readonly remote: string
}

/** What the stations of a line share. */
export interface SharedLine {
  readonly framings: ReadonlyMap<SerialFrameName, SerialFraming>
  readonly clock: Clock
  readonly faults: Faults
  readonly counters: Counters
  /** ms before an answer in 3C and 4C, a parameter of the ports; in 1C the request says it. */
  readonly messageWait: number
  readonly say: (bytes: Buffer) => void
  /** Ends the connection of a host. */
  readonly end: (connection: number, how: 'close' | 'reset') => void
  readonly noise: (bytes: Buffer, ms: number) => void
  /** The highest code that NAK has digits for. */
  readonly highestCode: (frame: SerialFrameName) => number
  /** Where the last character of an answer's sum check code is. */
  readonly sumAt: (answer: Buffer) => number | undefined
  readonly observe: (event: RequestEvent) => void
}

export interface StationParts {
  readonly number: number
  readonly settings: SimulatorSettings
  /** Of the serial channel the line is at: what it tells in special relays. */
  readonly channel: ChannelDevices | undefined
  readonly line: SharedLine
}

interface Work extends Delivered {
  readonly request: StationRequest
}

/** A host asks one request at a time: more than a few that wait are somebody who does not listen. */
const MOST_WAITING = 8
/** All hosts are one: a station cannot tell them apart. */
const OWNER = 'serial line'

export class Station implements SimulatedStation {
  readonly number: number
  readonly profile: Profile
  readonly clock: Clock
  readonly memory: ProgramMemory
  readonly cpu: Cpu
  readonly faults = new Faults()
  readonly errors: ErrorLog
  readonly port: StationPort
  readonly #parts: StationParts
  readonly #plc: Plc
  readonly #call: HandlerCall
  readonly #events = new Emitter<StationEvents>()
  readonly #held: HeldAnswers = []
  readonly #switches: FaultSource
  readonly #delivery: Delivery
  #sequence: Sequence<Work>
  #waiting = 0
  #down = false
  #cancel: (() => void) | undefined

  constructor(parts: StationParts) {
    const { number, settings, line } = parts
    const { profile, asciiXy, otherStations } = settings
    const { framings, clock } = line
    this.#parts = parts
    this.number = number
    this.profile = profile
    this.clock = clock
    this.port = new StationPort({ profile, framings: framesOf(profile, framings), asciiXy, otherStations })
    this.#plc = new Plc({
      ...settings,
      now: () => fileClock(clock.time()),
      changed: (change) => {
        if (change.state === 'RUN') this.#tellNoError()
        this.#events.emit('state', change)
      },
      cleared: (scope) => this.#events.emit('clear', { scope }),
      restart: () => this.restart(),
    })
    this.memory = this.#plc.memory
    this.cpu = this.#plc.cpu
    this.errors = this.#plc.errors
    const lock = new PortPassword(profile.password, settings).lockOf('stream')
    this.#call = this.#plc.callOf({ owner: OWNER, monitored: undefined, lock })
    this.#switches = bothOf(this.faults, line.faults)
    this.#delivery = new Delivery({
      faults: this.#switches,
      held: this.#held,
      joined: true,
      send: line.say,
      noise: line.noise,
      end: (how, { connection }) => line.end(connection, how),
    })
    this.#sequence = this.#newSequence()
    this.#tellMode()
  }

  read(item: string, format?: ValueFormat): PlcValue {
    return this.memory.read(item, format)
  }

  write(item: string, value: PlcValue, format?: ValueFormat): void {
    this.memory.write(item, value, format)
  }

  on<E extends keyof StationEvents>(event: E, listener: (event: StationEvents[E]) => void): () => void {
    return this.#events.on(event, listener)
  }

  restart(ms: number = this.#parts.settings.restartTime): void {
    if (this.#down) return
    this.#down = true
    this.initialise()
    this.#plc.down()
    this.#cancel = this.clock.timer(
      ms,
      () => {
        this.#down = false
        this.#plc.up()
        this.#tellMode()
        this.#events.emit('restart', { time: this.clock.time() })
      },
      { unref: true },
    )
  }

  close(): void {
    this.initialise()
    this.#sequence.close()
    this.#cancel?.()
    this.#events.emit('close', { time: this.clock.time() })
  }

  /** EOT or CL: what was asked is not answered any more; a write that is done stays done (42.3). */
  initialise(): void {
    this.#held.length = 0
    this.#sequence.close()
    this.#waiting = 0
    this.#sequence = this.#newSequence()
  }

  /** Undefined: not for it, or in a frame that it does not know. */
  understand(frame: SerialFrameName, request: RequestFrame<SerialHead>): StationRequest | undefined {
    return this.#down ? undefined : this.port.receive(frame, request)
  }

  /** What becomes of the request's characters on their way, if anything. */
  misheard(request: StationRequest, host: Host) {
    return this.#switches.take('misheard', this.#subject(request, host))
  }

  /** The global signal to all stations: nobody answers (44.6). */
  hearAll(request: StationRequest, host: Host): void {
    if (!(request.asked instanceof Refusal) && 'on' in request.asked) {
      this.#observe(request, host, this.#carryOut(request), false)
    }
  }

  hear(request: StationRequest, host: Host): void {
    const { counters, messageWait } = this.#parts.line
    const work: Work = { ...this.#subject(request, host), request, sending: false }
    counters.requests++
    if (this.#switches.take('silence', work) !== undefined) return
    if (this.#waiting >= MOST_WAITING) {
      counters.discarded++
      return
    }
    const scan = this.cpu.state === 'RUN' ? this.#parts.settings.scanTime : 0
    const wait = Math.max(scan, request.frame === '1C' ? request.wait : messageWait)
    this.#sequence.push(work, [{ act: () => this.#begin(work, host, wait) }])
  }

  /** A frame for this station arrived damaged. */
  hearDamaged(frame: SerialFrameName, head: SerialHead, damage: FrameDamage, host: Host): void {
    const endCode = this.port.damageCode(frame, damage)
    if (this.#down) return
    this.#log(endCode ?? 0, `damaged request: ${damage}`, host)
    const framing = this.#parts.line.framings.get(frame)
    if (endCode === undefined || framing === undefined) return
    this.#parts.line.counters.refusals++
    this.#parts.line.say(framing.response.write(head, 0, this.#sayable(frame, endCode), Buffer.alloc(0)))
  }

  /** Where NAK has two digits only, the last two of a longer code: what a PLC would do is in no manual. */
  #sayable(frame: SerialFrameName, endCode: number): number {
    const highest = this.#parts.line.highestCode(frame)
    return endCode <= highest ? endCode : endCode & highest || highest
  }

  #newSequence(): Sequence<Work> {
    const counted = (change: number) => {
      if (sequence === this.#sequence) this.#waiting += change
    }
    const sequence: Sequence<Work> = new Sequence(this.clock, counted)
    return sequence
  }

  #subject(request: StationRequest, { id, remote }: Host) {
    const { subcommand } = request
    return { command: readOf(request)?.name, subcommand, connection: id, remote, station: this.number }
  }

  #begin(work: Work, host: Host, wait: number): readonly Step[] {
    const after = this.#delivery.letGo()
    return [{ wait }, { act: () => this.#answer(work, host) }, ...after]
  }

  #answer(work: Work, host: Host): readonly Step[] {
    const answer = this.#forced(work) ?? this.#carryOut(work.request)
    this.#observe(work.request, host, answer, true)
    if (answer.kind === 'none') return NOTHING
    const { counters } = this.#parts.line
    counters.answers++
    if (answer.kind === 'refused') {
      counters.refusals++
      this.#log(answer.endCode, answer.message, host)
    }
    return this.#delivery.deliver(this.#frame(work, answer), work)
  }

  /** NAK of a fault switch. One that the frame has no digits for does not meet it. */
  #forced(work: Work): Answer | undefined {
    const forced = this.#switches.peek('endCode', work)
    if (forced === undefined || forced.endCode > this.#parts.line.highestCode(work.request.frame)) return undefined
    this.#switches.take('endCode', work)
    return { kind: 'refused', endCode: forced.endCode, message: 'fault switch' }
  }

  #carryOut({ frame, asked }: StationRequest): Answer {
    try {
      if (asked instanceof Refusal) throw asked
      if ('on' in asked) return this.#globalSignal(asked.on)
      return this.#plc.answerOnLine(asked, this.#call)
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      const { endCode, message } = this.port.refusalOf(frame, error)
      return { kind: 'refused', endCode, message }
    }
  }

  #globalSignal(on: boolean): Answer {
    const { channel } = this.#parts
    if (channel !== undefined) this.#plc.setRelay(channel.globalSignal, on)
    return { kind: 'data', body: Buffer.alloc(0) }
  }

  /** The channel is set to MC protocol. */
  #tellMode(): void {
    const { channel } = this.#parts
    if (channel !== undefined) this.#plc.setRelay(channel.mcProtocol, true)
  }

  #frame(work: Work, answer: Exclude<Answer, { kind: 'none' }>): Buffer {
    const { framings, sumAt } = this.#parts.line
    const { frame, request } = work.request
    const framing = framings.get(frame)
    if (framing === undefined) throw new TypeError(`an answer in ${frame}, which the line does not have`)
    const elsewhere = this.#switches.take('wrongRoute', work)
    const head =
      elsewhere === undefined
        ? request.head
        : {
            ...request.head,
            station: elsewhere.station,
            ...(request.head.network === undefined ? {} : { network: elsewhere.network }),
          }
    const isData = answer.kind === 'data'
    const body = isData ? answer.body : this.port.errorInformation(work.request)
    const bytes = framing.response.write(head, 0, isData ? 0 : this.#sayable(frame, answer.endCode), body)
    const at = sumAt(bytes)
    const wrong = at !== undefined && this.#switches.take('wrongSum', work) !== undefined
    return wrong ? withWrongSum(bytes, at) : bytes
  }

  #observe(request: StationRequest, host: Host, answer: Answer, answered: boolean): void {
    const read = readOf(request)
    const isRefused = request.asked instanceof Refusal
    const event: RequestEvent = {
      connection: host.id,
      remote: host.remote,
      station: this.number,
      frame: request.frame,
      command: read?.name,
      effect: read?.command.effect ?? (isRefused ? undefined : 'write'),
      message: read === undefined ? undefined : withoutSecrets(read.command.request, read.message),
      endCode: !answered || answer.kind === 'none' ? undefined : answer.kind === 'data' ? 0 : answer.endCode,
    }
    const { command } = event
    if (command !== undefined && event.effect === 'write' && event.endCode === 0) {
      const written: WriteEvent = { ...event, command }
      this.#events.emit('write', written)
    }
    this.#events.emit('request', event)
    this.#parts.line.observe(event)
  }

  /** A CPU that goes to RUN has forgotten the errors of its channels (18.8). */
  #tellNoError(): void {
    const { channel } = this.#parts
    if (channel === undefined) return
    this.#plc.setRelay(channel.error, false)
    this.#plc.setRegister(channel.errorCode, 0)
  }

  /** SM8500 and SD8500 of the channel tell, too. */
  #log(endCode: number, message: string, { remote }: Host): void {
    const { channel } = this.#parts
    if (channel !== undefined && endCode !== 0) {
      this.#plc.setRelay(channel.error, true)
      this.#plc.setRegister(channel.errorCode, endCode)
    }
    this.errors.add({ time: this.clock.time(), endCode, remote, message })
  }
}

/** The frames of a line that a family knows. */
function framesOf(
  { frames }: Profile,
  framings: ReadonlyMap<SerialFrameName, SerialFraming>,
): ReadonlyMap<SerialFrameName, SerialFraming> {
  const known: readonly string[] = frames
  return new Map([...framings].filter(([frame]) => known.includes(frame)))
}

/** The switches of a station come before those of its line. */
function bothOf(own: Faults, all: Faults): FaultSource {
  return {
    get none() {
      return own.none && all.none
    },
    take: (kind, subject) => own.take(kind, subject) ?? all.take(kind, subject),
    peek: (kind, subject) => own.peek(kind, subject) ?? all.peek(kind, subject),
  }
}
