// One client of a simulated JW: its messages in order, and the answers through the fault switches onto the wire.
import { type Effect, type Message, withoutSecrets } from '../../codec/codec'
import type { JwCommandName } from '../../jw/commands/commands'
import type { JwHead } from '../../jw/frame'
import { HEADER_LENGTH } from '../../jw/header'
import { type RequestFrame, Responder } from '../../link/link'
import type { Clock } from '../../transport/clock'
import type { ServerConnection } from '../../transport/transport'
import { type Delivered, Delivery, type HeldAnswers } from '../delivery'
import type { JwFaultAction } from '../fault-kinds'
import type { Faults } from '../faults'
import type { Served } from '../listening'
import { Refusal } from '../refusal'
import { Sequence, type Step } from '../sequence'
import type { Counters } from '../statistics'
import type { JwSettings } from './options'
import type { JwPlc, JwReceived } from './plc'
import { takenFrames } from './taken-frames'

/** A request to a simulated JW and what became of it, for programs and logs. */
export interface JwRequestEvent {
  /** Number of the connection, counting from 1. */
  readonly connection: number
  /** The client, e.g. `127.0.0.1:50231`. */
  readonly remote: string
  /** Bytes in front of the message. */
  readonly header: number
  /** Name of the command; undefined when it is none that is declared, or its text is wrong. */
  readonly command: JwCommandName | undefined
  /** What the command does; undefined when it is none that is declared. */
  readonly effect: Effect | undefined
  /** The request as decoded; passwords are asterisks. */
  readonly message: Message | undefined
  /** Result code: 0 success; undefined when there is no answer. */
  readonly endCode: number | undefined
}

/** What the connections of one simulated JW share. */
export interface JwShared {
  readonly plc: JwPlc
  readonly settings: JwSettings
  readonly faults: Faults<JwCommandName, JwFaultAction>
  readonly counters: Counters
  readonly heldDatagrams: HeldAnswers
  readonly observe: (event: JwRequestEvent) => void
}

interface Work extends Delivered<JwCommandName> {
  readonly frame: RequestFrame<JwHead>
  readonly received: JwReceived | Refusal
}

export class JwConnection implements Served {
  /** Milliseconds since 1970. */
  readonly since: number
  readonly #shared: JwShared
  readonly #peer: ServerConnection
  readonly #clock: Clock
  readonly #responder: Responder<JwHead>
  readonly #sequence: Sequence<Work>
  readonly #held: HeldAnswers
  readonly #delivery: Delivery<JwCommandName>
  readonly #noises = new Set<() => void>()
  #requests = 0

  constructor(
    shared: JwShared,
    peer: ServerConnection,
    readonly kind: 'stream' | 'datagram',
    /** Number within this PLC, counting from 1. */
    readonly id: number,
  ) {
    const { settings, plc, counters } = shared
    this.#shared = shared
    this.#peer = peer
    this.#clock = settings.clock
    this.since = this.#clock.time()
    const framing = takenFrames(settings.header, () => counters.unreadable++)
    // A datagram is one message: what is too short or too long for its command is one all the same.
    this.#responder = new Responder(framing, kind, (head, soFar) =>
      kind === 'datagram' ? soFar.length : plc.lengthOf(head, soFar),
    )
    this.#sequence = new Sequence(this.#clock, () => {})
    this.#held = kind === 'datagram' ? shared.heldDatagrams : []
    this.#delivery = new Delivery<JwCommandName>({
      faults: shared.faults,
      held: this.#held,
      joined: kind === 'stream',
      send: (bytes) => this.#send(bytes),
      end: (how) => this.end(how),
      noise: (bytes, ms) => this.#noise(bytes, ms),
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
    this.#sequence.close()
    for (const cancel of this.#noises) cancel()
    this.#noises.clear()
    if (this.kind === 'stream') this.#held.length = 0
    if (how === 'close') this.#peer.close()
    if (how === 'reset') this.#peer.reset()
  }

  #receive(bytes: Buffer): void {
    this.#shared.counters.bytesReceived += bytes.length
    for (const frame of this.#responder.receive(bytes)) this.#arrive(frame)
  }

  #arrive(frame: RequestFrame<JwHead>): void {
    const { faults, counters, plc, settings } = this.#shared
    const received = plc.receive(frame)
    const command = received instanceof Refusal ? undefined : received.command.name
    const work = { frame, received, command, subcommand: 0, connection: this.id, remote: this.remote, sending: false }
    this.#requests++
    counters.requests++
    counters.discarded += this.#sequence.drop((older) => !older.sending && faults.take('coalesce', older) !== undefined)
    if (faults.take('silence', work) !== undefined) return
    const scan = plc.cpu.running ? settings.scanTime : 0
    const wait = Math.max(scan, faults.peek('coalesce', work)?.window ?? 0)
    this.#sequence.push(work, [{ act: () => this.#begin(work, wait) }])
  }

  #begin(work: Work, wait: number): readonly Step[] {
    const after = this.#delivery.letGo()
    return [{ wait }, { act: () => this.#answer(work) }, ...after]
  }

  #answer(work: Work): readonly Step[] {
    const { faults, plc, counters } = this.#shared
    const forced = faults.take('endCode', work)
    const answer = forced === undefined ? this.#carryOut(plc, work) : new Refusal(forced.endCode, 'fault switch')
    this.#observe(work, answer)
    counters.answers++
    if (!(answer instanceof Refusal)) return this.#delivery.deliver(this.#frame(work, 0, answer), work)
    counters.refusals++
    // Nothing stands behind a result code.
    return this.#delivery.deliver(this.#frame(work, answer.endCode, NO_TEXT), work)
  }

  #carryOut(plc: JwPlc, { received }: Work): Buffer | Refusal {
    return received instanceof Refusal ? received : plc.answer(received)
  }

  #frame(work: Work, endCode: number, text: Buffer): Buffer {
    const { frame } = work
    const isOther = this.#shared.faults.take('otherHeader', work) !== undefined
    if (!isOther) return this.#responder.answer(frame, endCode, text)
    const { command, header = 0 } = frame.head
    const head = { command, header: header === 0 ? HEADER_LENGTH : 0 }
    return this.#responder.answer({ ...frame, head }, endCode, text)
  }

  #observe({ frame, received }: Work, answer: Buffer | Refusal): void {
    const read = received instanceof Refusal ? undefined : received
    this.#shared.observe({
      connection: this.id,
      remote: this.remote,
      header: frame.head.header ?? 0,
      command: read?.command.name,
      effect: read?.command.effect,
      message: read === undefined ? undefined : withoutSecrets(read.command.request, read.message),
      endCode: answer instanceof Refusal ? answer.endCode : 0,
    })
  }

  #noise(bytes: Buffer, ms: number): void {
    const cancel = this.#clock.timer(ms, () => {
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

const NO_TEXT = Buffer.alloc(0)
