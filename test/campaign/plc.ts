/**
 * A PLC by hand: sockets, the frames of the manuals, and a ledger. It knows nothing of src. What goes wrong is said by the
 * fault that is armed for a request; without one it answers at once and rightly.
 */
import { createSocket, type Socket as Datagrams } from 'node:dgram'
import { type AddressInfo, createServer, type Server, type Socket } from 'node:net'
import {
  type Changes,
  frameOf,
  lengthOfRequest,
  readRequest,
  refusalAnswer,
  typeNameAnswer,
  valuesAnswer,
} from './answers'
import { type Configuration, models } from './configurations'
import type { Journal } from './journal'
import type { Ledger } from './ledger'
import { isAboutTheLine, NOTHING, type Request } from './request'

/** Where answers go to. */
export interface Peer {
  readonly name: string
  send(bytes: Buffer): void
  /** Of a connection: FIN. */
  end(): void
  /** Of a connection: RST. */
  reset(): void
  /** The PLC has forgotten it: what comes is not looked at, and nothing is sent any more. */
  forgotten: boolean
  /** Of a connection in the middle of an answer: what waits behind it. A stream has no other place for it. */
  behind: Buffer[] | undefined
}

/** One request that has arrived, and everything the PLC may do about it. */
export class Turn {
  constructor(
    readonly plc: Plc,
    readonly peer: Peer,
    readonly request: Request,
  ) {}

  /** Carries it out. @returns the answer */
  carryOut(changes: Changes = {}): Buffer {
    return frameOf(this.request, this.plc.answerOf(this.request), changes)
  }

  /** Does not carry it out. @returns the answer that says so */
  refuse(endCode: number, changes: Changes = {}): Buffer {
    this.plc.ledger.refused(this.request, endCode)
    return frameOf(this.request, refusalAnswer(this.request, endCode), changes)
  }

  /** A refusal that the PLC did not make. */
  strangersAnswer(endCode: number): Buffer {
    return frameOf(this.request, refusalAnswer(this.request, endCode))
  }

  /** Sends bytes after so many ms, one chunk after the other. */
  send(bytes: Buffer | (() => Buffer), delay = 0): void {
    this.plc.answer(this.peer, bytes, delay)
  }

  /** The first bytes of an answer on a connection, whose rest comes after so many ms, or never. */
  sendCut([first, rest]: readonly [Buffer, Buffer], ms?: number): void {
    this.plc.sendPart(this.peer, first, false)
    if (ms !== undefined) this.after(ms, () => this.plc.sendPart(this.peer, rest, true))
  }

  /** One byte after the other, eight in a millisecond or fewer. */
  trickle(bytes: Buffer): void {
    for (const [at, byte] of bytes.subarray(0, 8).entries()) {
      this.plc.sendPart(this.peer, Buffer.of(byte), at + 1 === bytes.length)
    }
    if (bytes.length > 8) this.after(1, () => this.trickle(bytes.subarray(8)))
  }

  after(ms: number, then: () => void): void {
    this.plc.after(ms, then)
  }
}

/** What is done about a request. */
export interface Armed {
  readonly name: string
  /** Requests that are left alone first. */
  skip: number
  /** Whether probes and self tests count. */
  readonly probes: boolean
  readonly run: (turn: Turn) => void
}

/** ms. */
const SCAN = 2

interface Due {
  readonly at: number
  readonly peer: Peer
  readonly bytes: Buffer | (() => Buffer)
}

export class Plc {
  readonly #configuration: Configuration
  readonly #journal: Journal
  #server: Server | undefined
  #datagrams: Datagrams | undefined
  readonly #connections = new Map<Socket, Peer>()
  readonly #peers = new Map<number, Peer>()
  readonly #timers = new Set<NodeJS.Timeout>()
  #port = 0
  #closed = false
  #armed: Armed[] = []
  #queue: Due[] = []
  /** Connections that are closed as soon as they are accepted. */
  closeNext = 0
  /** Ignores everything that comes, as a PLC that starts. */
  deaf = false
  /** What is sent together with the next answer. */
  held: { readonly peer: Peer; readonly bytes: Buffer; readonly joined: boolean } | undefined
  lastAnswer: Buffer = NOTHING
  /** Called when a request has arrived, and when an answer has gone. */
  onReceived: (() => void) | undefined
  onAnswered: (() => void) | undefined
  /** Faults that were used, by name. */
  readonly used = new Map<string, number>()

  constructor(
    configuration: Configuration,
    readonly ledger: Ledger,
    journal: Journal,
  ) {
    this.#configuration = configuration
    this.#journal = journal
  }

  get port(): number {
    return this.#port
  }

  /** A fault for a request that comes. */
  arm(armed: Armed): void {
    this.#armed.push(armed)
  }

  disarm(): void {
    this.#armed = []
    this.closeNext = 0
  }

  async listen(): Promise<void> {
    for (let attempt = 1; ; attempt += 1) {
      try {
        await (this.#configuration.transport === 'tcp' ? this.#listenTcp() : this.#listenUdp())
        return
      } catch (error) {
        // Somebody has taken the port while the PLC was away: only for a moment.
        if (attempt > 200) throw error
        await new Promise((resolve) => setTimeout(resolve, 10))
      }
    }
  }

  async close(): Promise<void> {
    this.#closed = true
    for (const timer of this.#timers) clearTimeout(timer)
    this.#timers.clear()
    await this.#stop()
  }

  /** Off, and on again after so many ms. What it was about to send is gone, and so are its connections. */
  reboot(ms: number): void {
    this.#journal.add('PLC: off')
    this.#queue = []
    this.held = undefined
    this.#stop().then(
      () =>
        this.after(ms, () => {
          this.listen().then(
            () => this.#journal.add('PLC: on again'),
            (error: unknown) => this.ledger.stranger(`the PLC does not come back: ${String(error)}`),
          )
        }),
      () => {},
    )
  }

  /** As a reboot that nobody told the peers of. */
  forgetAll(): void {
    this.#queue = []
    this.held = undefined
    for (const peer of this.#connections.values()) peer.forgotten = true
  }

  after(ms: number, then: () => void): void {
    if (this.#closed) return
    const timer = setTimeout(() => {
      this.#timers.delete(timer)
      then()
    }, ms)
    this.#timers.add(timer)
  }

  answerOf(request: Request) {
    if (request.kind === 'typeName') return typeNameAnswer(request, models[this.#configuration.profile])
    if (request.kind === 'selfTest') return { endCode: 0, data: request.echo }
    return valuesAnswer(request, this.ledger.carryOut(request))
  }

  /**
   * A PLC answers on one port in the order it was asked. Where only that order tells whose an answer is (a fixed local
   * port, no serial number), the campaign keeps to it too; elsewhere answers overtake each other.
   */
  answer(peer: Peer, bytes: Buffer | (() => Buffer), delay: number): void {
    const { transport, fixedPort, serial } = this.#configuration
    const inOrder = transport === 'udp' && fixedPort && !serial
    if (!inOrder) {
      if (delay > 0) this.after(delay, () => this.#send(peer, bytes))
      else this.#send(peer, bytes)
      return
    }
    // One request in each scan: what waits behind another is looked at after it was answered.
    const behind = this.#queue.at(-1)
    const now = performance.now()
    const at = behind === undefined ? now + delay : Math.max(behind.at, now) + SCAN + delay
    this.#queue.push({ at, peer, bytes })
    if (at > now) this.after(Math.ceil(at - now), () => this.#sendDue())
    else this.#sendDue()
  }

  #sendDue(): void {
    for (let first = this.#queue[0]; first !== undefined; first = this.#queue[0]) {
      const wait = first.at - performance.now()
      if (wait > 0) {
        this.after(Math.ceil(wait), () => this.#sendDue())
        return
      }
      this.#queue.shift()
      this.#send(first.peer, first.bytes)
    }
  }

  #send(peer: Peer, made: Buffer | (() => Buffer)): void {
    const bytes = typeof made === 'function' ? made() : made
    if (peer.forgotten) return
    const { held } = this
    this.held = undefined
    const joined = held?.joined === true && held.peer === peer
    this.#sendNow(peer, joined ? Buffer.concat([held.bytes, bytes]) : bytes)
    // Swapped: what was asked first is answered now.
    if (held !== undefined && !joined) this.#sendNow(held.peer, held.bytes)
    this.onAnswered?.()
  }

  /** A part of an answer. Until its last part everything else waits, and without one for ever. */
  sendPart(peer: Peer, bytes: Buffer, last: boolean): void {
    const behind = peer.behind ?? []
    peer.behind = undefined
    if (last) {
      this.#send(peer, bytes)
      for (const other of behind) this.#sendNow(peer, other)
      return
    }
    // What is held goes with a whole answer.
    this.#sendNow(peer, bytes)
    peer.behind = behind
    this.onAnswered?.()
  }

  #sendNow(peer: Peer, bytes: Buffer): void {
    if (peer.forgotten) return
    if (peer.behind !== undefined) {
      peer.behind.push(bytes)
      return
    }
    this.#journal.add(`PLC to ${peer.name}:`, bytes)
    peer.send(bytes)
  }

  #received(peer: Peer, bytes: Buffer): void {
    if (this.deaf || peer.forgotten) {
      this.#journal.add(`PLC does not hear ${peer.name}:`, bytes)
      return
    }
    this.#journal.add(`PLC from ${peer.name}:`, bytes)
    try {
      const { frame, code } = this.#configuration
      const request = readRequest(frame, code, Buffer.from(bytes))
      this.ledger.received(request)
      this.#take(new Turn(this, peer, request))
    } catch (error) {
      this.ledger.stranger(`${String(error)}: ${bytes.toString('hex')}`)
    }
    this.onReceived?.()
  }

  #take(turn: Turn): void {
    const about = isAboutTheLine(turn.request)
    const armed = this.#armed.find(({ probes }) => probes || !about)
    if (armed === undefined || armed.skip > 0) {
      if (armed !== undefined) armed.skip -= 1
      const answer = turn.carryOut()
      turn.send(answer)
      this.lastAnswer = answer
      return
    }
    this.#armed.splice(this.#armed.indexOf(armed), 1)
    this.used.set(armed.name, (this.used.get(armed.name) ?? 0) + 1)
    this.#journal.add(`PLC: ${armed.name}`)
    armed.run(turn)
  }

  #listenTcp(): Promise<void> {
    const server = createServer({ noDelay: true }, (socket) => this.#accepted(socket))
    return new Promise((resolve, reject) => {
      server.once('error', reject)
      server.listen(this.#port, '127.0.0.1', () => {
        server.off('error', reject)
        server.on('error', () => {})
        this.#server = server
        this.#port = (server.address() as AddressInfo).port
        resolve()
      })
    })
  }

  #accepted(socket: Socket): void {
    socket.on('error', () => {})
    if (this.closeNext > 0) {
      this.closeNext -= 1
      this.#journal.add(`PLC: accepted ${socket.remotePort} and closed it`)
      socket.end()
      socket.resume()
      socket.setTimeout(1000, () => socket.destroy())
      return
    }
    const peer = streamPeer(socket)
    this.#journal.add(`PLC: accepted ${peer.name}`)
    this.#connections.set(socket, peer)
    socket.on('close', () => {
      this.#journal.add(`PLC: ${peer.name} is closed`)
      peer.forgotten = true
      this.#connections.delete(socket)
    })
    let kept: Buffer = NOTHING
    socket.on('data', (chunk) => {
      kept = kept.length === 0 ? chunk : Buffer.concat([kept, chunk])
      kept = this.#requestsIn(peer, kept)
    })
  }

  #requestsIn(peer: Peer, bytes: Buffer): Buffer {
    const { frame, code } = this.#configuration
    let rest = bytes
    for (;;) {
      const length = lengthOfRequest(frame, code, rest)
      if (length === undefined || rest.length < length) return rest
      this.#received(peer, rest.subarray(0, length))
      rest = rest.subarray(length)
    }
  }

  #listenUdp(): Promise<void> {
    const datagrams = createSocket('udp4')
    return new Promise((resolve, reject) => {
      datagrams.once('error', (error) => {
        datagrams.close()
        reject(error)
      })
      datagrams.bind({ port: this.#port, address: '127.0.0.1', exclusive: true }, () => {
        datagrams.removeAllListeners('error')
        datagrams.on('error', () => {})
        datagrams.on('message', (bytes, from) => this.#received(this.#peerAt(datagrams, from.port), bytes))
        this.#datagrams = datagrams
        this.#port = datagrams.address().port
        resolve()
      })
    })
  }

  #peerAt(datagrams: Datagrams, port: number): Peer {
    const known = this.#peers.get(port)
    if (known !== undefined) return known
    const send = (bytes: Buffer) => {
      if (this.#datagrams === datagrams) datagrams.send(bytes, port, '127.0.0.1', () => {})
    }
    const peer: Peer = {
      name: `port ${port}`,
      send,
      end: () => {},
      reset: () => {},
      forgotten: false,
      behind: undefined,
    }
    this.#peers.set(port, peer)
    if (this.#peers.size > 1000) this.#peers.delete(this.#peers.keys().next().value ?? 0)
    return peer
  }

  /** From another program of this computer. */
  sendAsStranger(peer: Peer, bytes: Buffer): void {
    const port = Number(peer.name.replace(/\D/g, ''))
    const stranger = createSocket('udp4')
    stranger.on('error', () => {})
    stranger.send(bytes, port, '127.0.0.1', () => stranger.close())
  }

  async #stop(): Promise<void> {
    const [server, datagrams] = [this.#server, this.#datagrams]
    this.#server = undefined
    this.#datagrams = undefined
    this.#peers.clear()
    for (const socket of this.#connections.keys()) cutOff(socket)
    this.#connections.clear()
    await new Promise<void>((resolve) => (server === undefined ? resolve() : server.close(() => resolve())))
    await new Promise<void>((resolve) => (datagrams === undefined ? resolve() : datagrams.close(() => resolve())))
  }
}

/** RST; where a FIN is on its way already the system refuses it, and Node.js would keep the socket for ever. */
function cutOff(socket: Socket): void {
  if (socket.writableEnded) socket.destroy()
  else socket.resetAndDestroy()
}

function streamPeer(socket: Socket): Peer {
  return {
    name: `connection ${socket.remotePort}`,
    send: (bytes) => {
      if (socket.writable) socket.write(bytes)
    },
    end: () => {
      socket.end()
    },
    reset: () => cutOff(socket),
    forgotten: false,
    behind: undefined,
  }
}
