/** A client's session and a PLC's responder with a wire between them and the time as a number. */

import { PlcError, TimeoutError } from '../../src/errors'
import type { Head } from '../../src/link/link'
import {
  type BodyLength,
  type Exchange,
  type Framing,
  type Job,
  type RequestFrame,
  Responder,
  Session,
} from '../../src/link/link'
import { eventsOf } from './support'

export type Wire = 'whole' | 'byte by byte' | 'datagrams'

export interface Answer {
  readonly endCode: number
  readonly body: Buffer
}

/** What a PLC does with a request. */
export interface Plc<H extends Head> {
  readonly bodyLength: BodyLength<H>
  answer(frame: RequestFrame<H>): Answer
}

const TIMEOUT = 1000

export class Line<H extends Head> {
  readonly sent: Buffer[] = []
  readonly received: Buffer[] = []
  /** Code of the error that ended the connection. */
  dropped: string | undefined
  damage = (answer: Buffer): Buffer => answer
  damageRequest = (request: Buffer): Buffer => request
  readonly #session: Session
  readonly #responder: Responder<H>
  #now = 0

  constructor(
    framing: Framing<H>,
    private readonly plc: Plc<H>,
    private readonly wire: Wire,
  ) {
    const kind = wire === 'datagrams' ? 'datagram' : 'stream'
    this.#session = new Session(framing, { kind, window: 1 })
    this.#responder = new Responder(framing, kind, plc.bodyLength)
  }

  /** Sends a request and waits for its answer; throws what came of it instead. */
  ask<T>(exchange: Exchange<T>): T {
    const job: Job = { ...exchange, deadline: this.#now + TIMEOUT }
    this.#session.submit(job, this.#now)
    for (let bytes = this.#session.transmit(); bytes !== undefined; bytes = this.#session.transmit()) {
      this.sent.push(bytes)
      for (const chunk of this.#chunks(this.damageRequest(bytes))) this.#toPlc(chunk)
    }
    this.#now = this.#session.nextTimeout(this.#now) ?? this.#now + 1
    this.#session.timeout(this.#now)
    return this.#outcome(exchange, job)
  }

  /** The error a request ends with. */
  fails<T>(exchange: Exchange<T>): PlcError {
    try {
      this.ask(exchange)
    } catch (error) {
      if (error instanceof PlcError) return error
      throw error
    }
    throw new Error('the request did not fail')
  }

  #toPlc(chunk: Buffer): void {
    for (const request of this.#responder.receive(chunk)) {
      const { endCode, body } = this.plc.answer(request)
      const answer = this.damage(this.#responder.answer(request, endCode, body))
      this.received.push(answer)
      for (const piece of this.#chunks(answer)) this.#session.receive(piece, this.#now)
    }
  }

  #chunks(bytes: Buffer): Buffer[] {
    return this.wire === 'byte by byte' ? [...bytes].map((byte) => Buffer.of(byte)) : [bytes]
  }

  #outcome<T>(exchange: Exchange<T>, job: Job): T {
    const events = eventsOf(this.#session)
    for (const event of events) if (event.kind === 'drop') this.dropped = event.error.code
    const [done, ...more] = events.filter((event) => event.kind === 'done')
    if (done?.kind !== 'done' || done.job !== job || more.length > 0) throw new Error('a request must end once')
    switch (done.outcome.kind) {
      case 'answered':
        return exchange.decode(done.outcome.frame)
      case 'failed':
        throw done.outcome.error
      default:
        throw new TimeoutError('no answer', 'sent' in done.outcome && done.outcome.sent ? 'unknown' : 'notSent')
    }
  }
}
