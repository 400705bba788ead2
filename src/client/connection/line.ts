// What carries bytes, for one PLC or several that share it: a transport at a time, the session on it, and who uses it.
// It is open as long as anybody uses it. It knows no protocol family, and nothing of the state of a PLC.
import type { PlcError } from '../../errors'
import {
  type AnswerFraming,
  type Echo,
  type Exchange,
  Fence,
  type JobEnd,
  type RecoveryOptions,
  type RequestFrame,
  type Sent,
  SerialNumbers,
  Session,
  type SessionEvent,
} from '../../link/link'
import type { Clock } from '../../transport/clock'
import type { OpenTransport, Transport } from '../../transport/transport'
import { Alarm, type AlarmOptions } from './alarm'
import type { Call } from './call'
import * as failure from './failure'

export interface LineOptions {
  readonly framing: AnswerFraming
  readonly openTransport: OpenTransport
  readonly clock: Clock
  /** Requests in flight at once, of all PLCs together. */
  readonly inFlight: number
  /** ms */
  readonly connectTimeout: number
  /**
   * How the line is brought to a known state, and its times, for framings that have a way to; without it the line is
   * dropped instead.
   */
  readonly recovery?: RecoveryOptions
  /** Default deadline of a call, ms: the proof of a fixed port is asked again several times within it. */
  readonly timeout: number
  /**
   * A request that changes nothing, and how its answer is known among all others: a self test with a pattern that was
   * not used before. For a fixed local port and a frame without serial number.
   */
  readonly proof: () => Echo
  /** 0 to below 1: where serial numbers begin. */
  readonly random: () => number
}

/** How a call ended on the line. */
export interface LineEnd {
  readonly job: Call
  readonly outcome: JobEnd
  readonly sentAt: number | undefined
}

/** One PLC's use of a line, from joining until it leaves or the line is lost. */
export interface LineUser {
  /** Bytes can be sent. */
  opened(): void
  /** Bytes went out: its own, or such as are nobody's. */
  sent(bytes: Buffer): void
  /** Bytes came that may be for it: something of it was in flight, or nobody else uses the line. */
  received(bytes: Buffer, now: number): void
  settled(end: LineEnd): void
  unsolicited(frame: RequestFrame): void
  /** An answer was thrown away. `isAlive`: it shows that this PLC answers. */
  stale(isAlive: boolean): void
  /** The line has ended. `ends`: what was on it of this PLC, and what was answered just before. `lost` follows. */
  ended(ends: readonly LineEnd[]): void
  /** The line is lost, for everybody. `undefined`: the peer closed it in an orderly way. */
  lost(error: PlcError | undefined): void
}

/** The most of the time of a line that is spent on PLCs that are not there, while others use it. */
const SHARE_OF_ABSENT = 1 / 10

/** ms between two attempts to open a line that can recover, whoever makes them: an adapter that was pulled out comes back when it likes. */
const BETWEEN_ATTEMPTS = 250

/** Pauses tell answers apart there, and a port is read beside the program: late by less than a pause is much. */
const OF_RECOVERY: AlarmOptions = { stalled: 10, reading: 50 }

/** ms before the end of a pause at which the time is looked at: who is late for that stood still while something may have come. */
const BEFORE = 10

/** ms that are none: something is not due yet. */
const JUST_BEFORE = 0.001

/** Characters of the longest answer of the manuals (960 words in ASCII code), where nobody knows it before. */
const LONGEST_ANSWER = 3872

/** How soon the proof of a fixed port is asked again, as a part of the deadline of a usual call: datagrams get lost. */
const PROOFS_PER_TIMEOUT = 8

/** One transport, and the session on it once it is open. */
interface Carrier {
  readonly transport: Transport
  session?: Session<Call>
  /** When opening has taken too long. */
  openBy: number | undefined
}

export class Line {
  readonly #options: LineOptions
  readonly #alarm: Alarm
  readonly #users = new Set<LineUser>()
  /** Those who were answered. */
  readonly #answered = new WeakSet<LineUser>()
  readonly #serials: SerialNumbers
  readonly #fence: Fence
  /** The only one of them, as on most lines. */
  #alone: LineUser | undefined
  #carrier: Carrier | undefined
  #peer = 'the PLC'
  /** Until then everything that came has been read. */
  #listened = 0
  /** Until then the time for PLCs that are not there is spent. */
  #absentUntil = 0
  /** Why it could not be opened last, and when. */
  #failed: { readonly error: PlcError; readonly at: number } | undefined
  /** Told when it is open. */
  readonly #waiting = new Set<() => void>()

  constructor(options: LineOptions) {
    const { clock, framing, proof, random, timeout } = options
    this.#options = options
    this.#alarm = new Alarm(clock, (stoodStill) => this.#timeout(stoodStill), options.recovery && OF_RECOVERY)
    this.#serials = new SerialNumbers(Math.floor(random() * 0x10000))
    this.#fence = new Fence(framing, {
      ask: proof,
      patience: Math.max(1, timeout / PROOFS_PER_TIMEOUT),
      onlyAtFirst: framing.correlation === 'serial',
    })
  }

  /** Whether bytes can be sent; no PLC need have answered yet. */
  get isOpen(): boolean {
    return this.#carrier?.session !== undefined
  }

  get peer(): string {
    return this.#carrier?.transport.description ?? this.#peer
  }

  get kind(): Transport['kind'] | undefined {
    return this.#carrier?.transport.kind
  }

  /** Whether silence and damaged answers cost a request and not the line. */
  get canRecover(): boolean {
    return this.#options.recovery !== undefined && this.framing.recovery !== undefined && this.kind !== 'datagram'
  }

  get framing(): AnswerFraming {
    return this.#options.framing
  }

  /** ms that a request with its answer may take on the line; 0 where nobody says how long its characters take. */
  timeOf(exchange: Exchange<unknown>, wait = 0): number {
    const { recovery } = this.#options
    if (recovery?.byteTime === undefined || !this.canRecover) return 0
    const { answerTime = 0, gap = 0 } = recovery
    return this.characterTimeOf(exchange) + wait + answerTime + gap
  }

  /** Of these, ms that its characters take. */
  characterTimeOf(exchange: Exchange<unknown>): number {
    const { byteTime = 0 } = this.#options.recovery ?? {}
    if (byteTime === 0) return 0
    const answer = exchange.answered ? (exchange.answerSize() ?? LONGEST_ANSWER) : 0
    return (exchange.write(0).length + answer) * byteTime
  }

  /**
   * The time, as far as the line has listened: behind a program that stood still answers may wait to be read, and a pause is
   * over only when it is known that nothing came in it.
   */
  #now(): number {
    const now = this.#options.clock.now()
    const isPausing = this.#carrier?.session?.pausesUntil(this.#listened) !== undefined
    const missed = isPausing ? this.#alarm.missed(now) : undefined
    this.#listened = missed === undefined ? now : Math.max(this.#listened, missed - JUST_BEFORE)
    return this.#listened
  }

  /** An answer was none: brings the line to a known state, before anything else is asked on it. */
  restore(): void {
    this.#carrier?.session?.restore(this.#now())
  }

  /**
   * A PLC has not answered since `sentAt`: how long it is not asked again, ms. As long as others use the line, all those
   * that are not there get a share of its time, one after the other. Who was there until now (`wasThere`) may have missed
   * one request only: it is asked again soon, unless that share is spent.
   */
  pauseOfAbsent(sentAt: number, wasThere: boolean): number {
    const { answerTime = 0, quiet = 0 } = this.#options.recovery ?? {}
    const now = this.#options.clock.now()
    if (this.#users.size < 2) return answerTime
    const spent = Math.max(0, this.#absentUntil - now)
    const pause = spent + (now - sentAt + quiet) / SHARE_OF_ABSENT
    this.#absentUntil = now + pause
    return wasThere && spent === 0 ? answerTime : pause
  }

  /** Requests of this user that are in flight, and that wait for their turn. */
  counts(user: LineUser): { readonly inFlight: number; readonly queued: number } {
    const session = this.#carrier?.session
    if (session === undefined) return { inFlight: 0, queued: 0 }
    if (this.#isAlone(user)) return { inFlight: session.inFlight, queued: session.queued }
    return session.counts((call) => call.plc === user)
  }

  /** Requests of this user that wait for their turn and change the PLC. */
  queuedChanges(user: LineUser): number {
    return this.#carrier?.session?.counts((call) => call.plc === user && call.priority === 'control').queued ?? 0
  }

  /** Whether the requests of one may wait for those of others, also for such as are silent. */
  get takesTurns(): boolean {
    return this.canRecover && this.#users.size > 1
  }

  /** Whether other PLCs answer on it. */
  othersAnswer(user: LineUser): boolean {
    return [...this.#users].some((other) => other !== user && this.#answered.has(other))
  }

  #userOf({ plc }: Call): LineUser | undefined {
    if (this.#alone === plc) return this.#alone
    for (const user of this.#users) if (user === plc) return user
    return undefined
  }

  #countUsers(): void {
    const [first] = this.#users
    this.#alone = this.#users.size === 1 ? first : undefined
  }

  #isAlone(user: LineUser): boolean {
    return this.#alone === user
  }

  /** Who waits because the line was lost is told when another has opened it. @returns what ends the waiting */
  whenOpen(run: () => void): () => void {
    this.#waiting.add(run)
    return () => this.#waiting.delete(run)
  }

  /**
   * Uses the line from now on: opens it, when it is not.
   * @throws what the transport throws when it cannot be made or opened, also what it threw just before
   */
  join(user: LineUser): void {
    if (this.#carrier === undefined) this.#refuseStorm()
    this.#users.add(user)
    this.#countUsers()
    if (this.#carrier === undefined) this.#open()
    else if (this.isOpen) user.opened()
  }

  /** Each of those who share it tries by itself. */
  #refuseStorm(): void {
    if (!this.canRecover || this.#failed === undefined) return
    if (this.#options.clock.now() - this.#failed.at < BETWEEN_ATTEMPTS) throw this.#failed.error
  }

  /** Uses it no more; the last one closes it. @returns what was on the line of this user */
  leave(user: LineUser): readonly LineEnd[] {
    if (!this.#users.has(user)) return []
    if (this.#isAlone(user)) {
      const { ends, others } = this.#end()
      for (const event of others) this.#take(event)
      this.#users.delete(user)
      this.#countUsers()
      return ends
    }
    this.#users.delete(user)
    this.#countUsers()
    const released = this.#carrier?.session?.release((call) => call.plc === user, this.#now()) ?? []
    this.flush()
    return released
  }

  #open(): void {
    const { clock, connectTimeout, openTransport } = this.#options
    const transport = openTransport()
    const carrier: Carrier = { transport, openBy: clock.now() + connectTimeout }
    this.#carrier = carrier
    transport.open({
      opened: () => this.#guard(carrier, () => this.#opened(carrier)),
      renewed: () => this.#guard(carrier, () => this.flush()),
      received: (bytes) => this.#guard(carrier, () => this.#received(carrier, bytes)),
      closed: (error) => this.#guard(carrier, () => this.#lose(error)),
    })
    this.#schedule()
  }

  /**
   * For what the transport calls. One that was given up may still have a callback under way, which is not listened to.
   * Anything that is thrown is a bug of this package; the machine beside us must not lose its program to it.
   */
  #guard(carrier: Carrier | undefined, run: () => void): void {
    if (carrier === undefined || this.#carrier !== carrier) return
    try {
      run()
    } catch (error) {
      this.fail(failure.asPlcError(error))
    }
  }

  #opened(carrier: Carrier): void {
    const { clock, framing, inFlight, recovery } = this.#options
    const { transport } = carrier
    carrier.openBy = undefined
    const given = { kind: transport.kind, window: inFlight, serials: this.#serials }
    const options = recovery === undefined ? given : { ...given, recovery }
    carrier.session = new Session<Call>(framing, options, this.#fenceFor(transport))
    carrier.session.restore(clock.now())
    this.#failed = undefined
    for (const user of [...this.#users]) if (this.#users.has(user)) user.opened()
    this.flush()
    const waiting = [...this.#waiting]
    this.#waiting.clear()
    for (const run of waiting) run()
  }

  /** Where a late answer can come to the port of the next request, also one of the program before. */
  #fenceFor({ kind, renewable }: Transport): Fence | undefined {
    return kind === 'stream' || renewable ? undefined : this.#fence
  }

  #received(carrier: Carrier, bytes: Buffer): void {
    const now = this.#options.clock.now()
    if (this.#alone !== undefined) this.#alone.received(bytes, now)
    else for (const user of this.#concerned()) user.received(bytes, now)
    if (this.#carrier !== carrier) return
    const listened = this.#now()
    carrier.session?.receive(bytes, listened, now)
    this.flush(listened)
  }

  /** Whom bytes from the line may be for, where several share it. */
  #concerned(): readonly LineUser[] {
    return [...this.#users].filter((user) => this.counts(user).inFlight > 0)
  }

  /** Sends it when its turn comes. `flush` afterwards. */
  submit(call: Call, now: number): void {
    this.#carrier?.session?.submit(call, Math.min(now, this.#now()))
  }

  /** Gives a call up. `flush` afterwards. @returns whether it had been sent; `undefined` when it is not known here */
  abandon(call: Call): boolean | undefined {
    return this.#carrier?.session?.abandon(call, this.#now())
  }

  /** Takes what the session has to say, then what it has to send, until it is quiet. */
  flush(at = Number.POSITIVE_INFINITY): void {
    const now = Math.min(at, this.#now())
    const carrier = this.#carrier
    const session = carrier?.session
    if (carrier === undefined || session === undefined) return
    for (let event = session.poll(); event !== undefined; event = session.poll()) {
      this.#take(event)
      if (this.#carrier !== carrier) return
    }
    while (carrier.transport.ready) {
      const next = session.next()
      if (next === undefined) break
      this.#send(carrier, next)
      if (this.#carrier !== carrier) return
    }
    this.#schedule(now)
  }

  #send(carrier: Carrier, { bytes, job }: Sent<Call>): void {
    job?.leaves(this.#options.clock)
    const user = job && this.#userOf(job)
    if (user !== undefined) user.sent(bytes)
    else for (const each of [...this.#users]) each.sent(bytes)
    if (this.#carrier === carrier) carrier.transport.send(bytes)
  }

  #take(event: SessionEvent<Call>): void {
    switch (event.kind) {
      case 'done': {
        const user = this.#userOf(event.job)
        if (user !== undefined && event.outcome.kind === 'answered') this.#answered.add(user)
        user?.settled(event)
        return
      }
      case 'unsolicited':
        for (const user of [...this.#users]) user.unsolicited(event.frame)
        return
      case 'stale':
        // Whose it is nobody knows where several share the line.
        for (const user of [...this.#users]) user.stale(this.#isAlone(user))
        return
      case 'stray':
        for (const user of [...this.#users]) user.stale(false)
        return
      case 'renew':
        this.#carrier?.transport.renew()
        return
      case 'drop':
        this.fail(event.error)
        return
      default:
        event satisfies never
    }
  }

  /** The line is of no use any more, for whoever uses it. */
  fail(error: PlcError): void {
    this.#lose(error)
  }

  #lose(error: PlcError | undefined): void {
    const users = [...this.#users]
    if (error !== undefined && !this.isOpen) this.#failed = { error, at: this.#options.clock.now() }
    const { ends, others } = this.#end()
    this.#users.clear()
    this.#countUsers()
    // First all of them get back what is theirs: whoever is told of the loss may close any of them.
    for (const user of users) user.ended(ends.filter(({ job }) => job.plc === user))
    for (const user of users) user.lost(error)
    for (const event of others)
      if (event.kind === 'unsolicited') for (const user of users) user.unsolicited(event.frame)
  }

  /** Ends what carries the bytes. @returns how every call ended that was on it, and what else there was to say */
  #end(): { readonly ends: readonly LineEnd[]; readonly others: readonly SessionEvent<Call>[] } {
    const carrier = this.#carrier
    this.#peer = this.peer
    this.#carrier = undefined
    this.#alarm.cancel()
    carrier?.transport.close()
    const session = carrier?.session
    session?.disconnected()
    const ends: LineEnd[] = []
    const others: SessionEvent<Call>[] = []
    for (let event = session?.poll(); event !== undefined; event = session?.poll()) {
      if (event.kind === 'done') ends.push(event)
      else if (event.kind !== 'drop' && event.kind !== 'renew') others.push(event)
    }
    return { ends, others }
  }

  #schedule(now = this.#now()): void {
    const carrier = this.#carrier
    const due = carrier?.openBy ?? carrier?.session?.nextTimeout(now)
    if (due !== undefined) this.#alarm.set(due)
    // Also while nobody waits: who asks later must know whether the line was listened to.
    const pause = carrier?.session?.pausesUntil(now)
    if (pause !== undefined) this.#alarm.set(now < pause - BEFORE ? pause - BEFORE : pause)
  }

  #timeout(stoodStill: boolean): void {
    const { clock, connectTimeout } = this.#options
    const carrier = this.#carrier
    this.#guard(carrier, () => {
      const now = clock.now()
      if (carrier?.openBy !== undefined && carrier.openBy <= now) {
        this.fail(failure.connectTimedOut(this.peer, connectTimeout))
        return
      }
      carrier?.session?.timeout(now, stoodStill ? this.#listened : now)
      this.flush(now)
      this.#schedule(now)
    })
  }
}
