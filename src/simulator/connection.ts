// One client of the simulated PLC: its requests in order, and its answers through the fault switches onto the wire.

import { type Effect, type Message, withoutSecrets } from '../codec/codec'
import { type Framing, Responder } from '../link/link'
import type { CommandName } from '../melsec/commands/commands'
import { bodies } from '../melsec/frame/body'
import type { EthernetFrameName, FrameName } from '../melsec/frame/frames'
import { ownStation, type Route } from '../melsec/frame/route'
import { writeOnDemand } from '../melsec/on-demand'
import type { Clock } from '../transport/clock'
import type { ServerConnection } from '../transport/transport'
import { type AnyHead, anyFrame } from './any-frame'
import { routeRefusal } from './check'
import { type Delivered, Delivery, type HeldAnswers, NOTHING } from './delivery'
import type { Faults } from './faults'
import type { HandlerCall } from './handler'
import { unaskedHead } from './on-demand'
import type { Answer, Plc } from './plc'
import type { PortPassword } from './port-lock'
import { Refusal, requestErrors } from './refusal'
import { type Ports, type Received, receive, slmpOf } from './request'
import { Sequence, type Step } from './sequence'
import type { Counters } from './statistics'

/** A request and what became of it, for programs and logs. */
export interface RequestEvent {
  /** Number of the connection, counting from 1. */
  readonly connection: number
  /** The client, e.g. `127.0.0.1:50231`. */
  readonly remote: string
  /** Of a simulated line: the station. */
  readonly station?: number
  /** Frame it came in. */
  readonly frame: FrameName
  /** Name of the command; undefined when it is none that is declared, or its data are wrong. */
  readonly command: CommandName | undefined
  /** What the command does; undefined when it is none that is declared. */
  readonly effect: Effect | undefined
  /** The request as decoded; passwords are asterisks. */
  readonly message: Message | undefined
  /** 0 success; undefined when there is no answer. */
  readonly endCode: number | undefined
}

/** What the connections of one simulated PLC share. */
export interface Shared {
  readonly plc: Plc
  readonly ports: Ports
  readonly frames: readonly EthernetFrameName[]
  readonly faults: Faults
  readonly clock: Clock
  /** ms from a request to the END processing that answers it, in RUN. */
  readonly scanTime: number
  readonly counters: Counters
  readonly heldDatagrams: HeldAnswers
  /** Receive buffer of the UDP port: requests it holds, the one that is being answered among them. */
  readonly datagramBuffer: { readonly size: number; used: number }
  readonly observe: (event: RequestEvent) => void
  readonly password: PortPassword
}

interface Work extends Delivered {
  readonly received: Received
}

export class SimulatedConnection {
  /** Milliseconds since 1970. */
  readonly since: number
  readonly #shared: Shared
  readonly #peer: ServerConnection
  readonly #call: HandlerCall
  readonly #responder: Responder<AnyHead>
  readonly #sequence: Sequence<Work>
  readonly #held: HeldAnswers
  readonly #delivery: Delivery
  readonly #noises = new Set<() => void>()
  #requests = 0
  readonly #framing: Framing<AnyHead>
  /** Of the last request. */
  #spoken: EthernetFrameName | undefined
  /** An answer is going out in pieces: what is unasked comes behind it. */
  #inPieces = false
  #unasked: Buffer[] = []
  #unaskedSerial = 0
  #ended = false

  constructor(
    shared: Shared,
    peer: ServerConnection,
    readonly kind: 'stream' | 'datagram',
    owner: string,
    /** Number within this PLC, counting from 1. */
    readonly id: number,
  ) {
    this.#shared = shared
    this.#peer = peer
    this.#call = shared.plc.callOf({ owner, monitored: undefined, lock: shared.password.lockOf(kind) })
    this.since = shared.clock.time()
    const { slmp, aCompatible } = shared.ports
    this.#framing = anyFrame(shared.frames, slmp.code, (bytes) => this.#unreadable(bytes), aCompatible.lengthOf)
    this.#responder = new Responder(this.#framing, kind, () => undefined)
    const { datagramBuffer } = shared
    this.#sequence = new Sequence(shared.clock, (change) => {
      if (kind === 'datagram') datagramBuffer.used += change
    })
    this.#held = kind === 'datagram' ? shared.heldDatagrams : []
    this.#delivery = new Delivery({
      faults: shared.faults,
      held: this.#held,
      joined: kind === 'stream',
      send: (bytes) => this.#send(bytes),
      end: (how) => this.end(how),
      noise: (bytes, ms) => this.#noise(bytes, ms),
      inPieces: (going) => {
        if (going) this.#inPieces = true
        else this.#sent()
      },
    })
    peer.onReceived = (bytes) => this.#receive(bytes)
  }

  get remote(): string {
    return this.#peer.remote
  }

  /** Requests so far. */
  get requests(): number {
    return this.#requests
  }

  /** After the connection has ended, or to end it. */
  end(how?: 'close' | 'reset'): void {
    this.#ended = true
    this.#sequence.close()
    for (const cancel of this.#noises) cancel()
    this.#noises.clear()
    this.#shared.plc.files.disconnected(this.#call.caller)
    if (this.kind === 'stream') this.#held.length = 0
    if (how === 'close') this.#peer.close()
    if (how === 'reset') this.#peer.reset()
  }

  /**
   * Sends On-demand in the frame of the last request.
   * @returns `false` while that is not known, where the frame cannot carry it (1E), and when the connection has ended
   */
  sendOnDemand(data: Uint8Array): boolean {
    const head = this.#spoken === undefined ? undefined : unaskedHead(this.#spoken)
    if (head === undefined || this.#ended) return false
    const { reserved } = bodies[head.frame]
    const body = writeOnDemand(this.#shared.ports.slmp.code, data, reserved)
    const bytes = this.#framing.request.write(head, this.#unaskedSerial++ & 0xffff, body)
    this.#shared.counters.onDemands++
    if (this.#inPieces) this.#unasked.push(bytes)
    else this.#send(bytes)
    return true
  }

  #receive(bytes: Buffer): void {
    this.#shared.counters.bytesReceived += bytes.length
    for (const frame of this.#responder.receive(bytes)) this.#arrive(receive(this.#shared.ports, frame))
  }

  /** Another frame or data code: only the PLC's own error log tells (FX5 communication manual 47.4, C06F). */
  #unreadable(bytes: Buffer): void {
    this.#shared.counters.unreadable++
    const shown = bytes.subarray(0, 16).toString('hex').toUpperCase()
    this.#log(requestErrors.dataCode, `bytes of another frame or data code: ${shown}`)
  }

  #log(endCode: number, message: string): void {
    this.#shared.plc.errors.add({ time: this.#shared.clock.time(), endCode, remote: this.remote, message })
  }

  #arrive(received: Received): void {
    const { faults, counters, plc } = this.#shared
    const { request, subcommand } = received
    const command = request instanceof Refusal ? undefined : request.name
    const work: Work = { received, command, subcommand, connection: this.id, remote: this.remote, sending: false }
    this.#spoken = received.frame.head.frame
    this.#requests++
    counters.requests++
    counters.discarded += this.#sequence.drop((older) => !older.sending && faults.take('coalesce', older) !== undefined)
    if (faults.take('silence', work) !== undefined) return
    // SLMP reference manual 3.3, FX5 communication manual 6.5: what comes while the buffer is full is thrown away.
    const { used, size } = this.#shared.datagramBuffer
    if (this.kind === 'datagram' && used >= size) {
      counters.discarded++
      return
    }
    const scan = plc.cpu.state === 'RUN' ? this.#shared.scanTime : 0
    const wait = Math.max(scan, faults.peek('coalesce', work)?.window ?? 0)
    this.#sequence.push(work, [{ act: () => this.#begin(work, wait) }])
  }

  #begin(work: Work, wait: number): readonly Step[] {
    const after = this.#delivery.letGo()
    return [{ wait }, { act: () => this.#answer(work) }, ...after]
  }

  #answer(work: Work): readonly Step[] {
    const { faults, plc, ports, counters } = this.#shared
    const { received } = work
    const forced = faults.take('endCode', work)
    const answer: Answer =
      forced === undefined
        ? plc.answer(ports, received, this.#call)
        : { kind: 'refused', endCode: forced.endCode, message: 'fault switch' }
    this.#observe(received, answer)
    if (answer.kind === 'none') return NOTHING
    if (answer.kind === 'data') return this.#deliver(this.#frame(work, 0, answer.body), work)
    counters.refusals++
    this.#log(answer.endCode, answer.message)
    return this.#deliver(this.#frame(work, answer.endCode, this.#errorInformation(work, answer)), work)
  }

  #observe({ frame, request }: Received, answer: Answer): void {
    const read = request instanceof Refusal ? undefined : request
    this.#shared.observe({
      connection: this.id,
      remote: this.remote,
      frame: frame.head.frame,
      command: read?.name,
      effect: read?.command.effect,
      message: read === undefined ? undefined : withoutSecrets(read.command.request, read.message),
      endCode: answer.kind === 'none' ? undefined : answer.kind === 'data' ? 0 : answer.endCode,
    })
  }

  /** The station that refuses is this one, whichever was asked. */
  #errorInformation(work: Work, { endCode, abnormal }: Answer & { kind: 'refused' }): Buffer {
    const { ports, plc, faults } = this.#shared
    const { frame, command, subcommand } = work.received
    if (frame.head.frame === '1E') return ports.aCompatible.errorBody(frame.head.head.command, endCode, abnormal)
    const { timer: _timer, ...route } = frame.head.head
    const station = routeRefusal(plc.profile, route) === undefined ? route : own(route)
    const body = slmpOf(ports, frame.head.frame).writeErrorInformation({ ...station, command, subcommand })
    const short = faults.take('shortError', work)
    return short === undefined ? body : body.subarray(0, short.bytes)
  }

  #frame(work: Work, endCode: number, body: Buffer): Buffer {
    const { faults } = this.#shared
    let { frame } = work.received
    if (frame.serial !== undefined) {
      const wrong = faults.take('wrongSerial', work)
      if (wrong !== undefined) frame = { ...frame, serial: (frame.serial + wrong.add) & 0xffff }
    }
    const elsewhere = frame.head.frame === '1E' ? undefined : faults.take('wrongRoute', work)
    if (elsewhere !== undefined && frame.head.frame !== '1E') {
      const { head } = frame.head
      frame = { ...frame, head: { ...frame.head, head: { ...head, ...elsewhere } } }
    }
    return this.#responder.answer(frame, endCode, body)
  }

  #deliver(answer: Buffer, work: Work): readonly Step[] {
    this.#shared.counters.answers++
    return this.#delivery.deliver(answer, work)
  }

  #sent(): void {
    this.#inPieces = false
    for (const bytes of this.#unasked.splice(0)) this.#send(bytes)
  }

  #noise(bytes: Buffer, ms: number): void {
    const cancel = this.#shared.clock.timer(ms, () => {
      this.#noises.delete(cancel)
      this.#send(bytes)
    })
    this.#noises.add(cancel)
  }

  #send(bytes: Buffer): void {
    if (bytes.length === 0) return
    this.#shared.counters.bytesSent += bytes.length
    this.#peer.send(bytes)
  }
}

/** This station in the fields of the frame that asked. */
function own({ extensionStation }: Route): Route {
  return extensionStation === undefined ? ownStation : { ...ownStation, extensionStation: 0 }
}
