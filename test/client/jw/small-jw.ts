/**
 * A small Sharp JW for the tests of the client: made of the mirror of the client's protocol, with a script for what it does
 * with each request. It knows nothing of plans.
 */

import type { JwClient } from '../../../src/client/jw/client'
import { createJwClient } from '../../../src/client/jw/jw-client'
import type { JwClientOptions } from '../../../src/client/jw/options'
import type { JwAddress } from '../../../src/jw/address'
import { pageOfRegisters } from '../../../src/jw/address'
import type { JwHead } from '../../../src/jw/frame'
import { type JwProtocolOptions, jwProtocol } from '../../../src/jw/protocol'
import type { HeadProtocol, RequestFrame } from '../../../src/link/link'
import { Responder } from '../../../src/link/link'
import { listenTcp } from '../../../src/transport/listen-tcp'
import { listenUdp } from '../../../src/transport/listen-udp'
import { listenMemory } from '../../../src/transport/memory'
import type { ServerConnection } from '../../../src/transport/transport'

/** A request as the script sees it. */
export interface AskedJw {
  readonly name: string
  readonly message: Message
  readonly peer: ServerConnection
  /** The right answer; what it asks for is carried out when it is called. */
  answer(): Buffer
  refuse(code: number): Buffer
  /** Sends the right answer. */
  reply(): void
}

type Message = Readonly<Record<string, unknown>>
type Handler = (message: Message) => Message | number

export class SmallJw {
  /** Files in the basic form; others do not exist (08H). */
  readonly files = new Map<number, Uint8Array>([0, 1, 2, 3].map((file) => [file, new Uint8Array(0x10000)]))
  readonly timers = new Map<number, { word: number; attribute: number }>()
  readonly system = new Uint8Array(0x480)
  readonly parameters = new Uint8Array(0x800)
  readonly specialIo = new Uint8Array(0x80)
  readonly rings = new Map<number, number[]>()
  readonly specified = new Uint8Array(0x10000)
  state = 0
  mode = 2
  secret = 0
  readonly blocks = new Map<number, number>()
  date = { year: 4, month: 8, day: 18, dayOfWeek: 3 }
  time = { hour: 13, minute: 30, second: 0 }
  /** Names of the requests that arrived; the probe is left out. */
  readonly asked: string[] = []
  readonly messages: Message[] = []
  probes = 0
  proofs = 0
  connections = 0
  /** Result codes by the name of the command. */
  readonly refusals = new Map<string, number>()
  script: (asked: AskedJw) => void = (asked) => asked.reply()
  probe: (asked: AskedJw) => void = (asked) => asked.reply()
  proof: (asked: AskedJw) => void = (asked) => asked.reply()
  readonly #protocol: HeadProtocol<JwHead>

  constructor(
    readonly kind: 'stream' | 'datagram' = 'stream',
    options: JwProtocolOptions = {},
    /** Whether it understands messages with a header, without, or both. */
    readonly understands: 'header' | 'none' | 'both' = 'both',
  ) {
    this.#protocol = jwProtocol(options)
  }

  readonly accept = (peer: ServerConnection): void => {
    this.connections += 1
    let isFirst = this.kind === 'stream' || this.probes === 0
    const responder = new Responder(this.#protocol.framing, this.kind, (head, soFar) =>
      this.#protocol.requestLength(head, soFar),
    )
    peer.onReceived = (bytes) => {
      const hasHeader = bytes[0] === 0
      if (this.understands === (hasHeader ? 'none' : 'header')) return
      for (const frame of responder.receive(bytes)) {
        this.#received(responder, frame, peer, isFirst)
        isFirst = false
      }
    }
    peer.onClosed = () => {}
  }

  #received(responder: Responder<JwHead>, frame: RequestFrame<JwHead>, peer: ServerConnection, isFirst: boolean): void {
    const { command, message } = this.#protocol.readRequest(frame)
    const answer = () => {
      const refusal = this.refusals.get(command.name)
      const response = refusal ?? this.#handlers[command.name]?.(message) ?? 0x01
      if (typeof response === 'number') return responder.answer(frame, response, Buffer.alloc(0))
      return responder.answer(frame, 0, this.#protocol.writeResponse(command, message, response))
    }
    const refuse = (code: number) => responder.answer(frame, code, Buffer.alloc(0))
    const asked = { name: command.name, message, peer, answer, refuse, reply: () => peer.send(answer()) }
    if (command.name === 'readWriteMode' && isFirst) {
      this.probes += 1
      this.probe(asked)
      return
    }
    if (command.name === 'loopback' && this.kind === 'datagram') {
      this.proofs += 1
      this.proof(asked)
      return
    }
    this.asked.push(command.name)
    this.messages.push(message)
    this.script(asked)
  }

  /** A byte of a file. */
  byte(file: number, address: number): number {
    return this.files.get(file)?.[address] ?? -1
  }

  /** Where an address is; `undefined`: it does not exist. */
  #at(given: unknown, length = 1): { readonly bytes: Uint8Array; readonly from: number } | undefined {
    const address = given as JwAddress
    const basic = address.extended === true && address.file === 1 ? pageOfRegisters(address.address) : address
    const bytes = this.files.get(basic.file)
    return bytes === undefined || basic.address + length > bytes.length ? undefined : { bytes, from: basic.address }
  }

  #bytesAt(address: JwAddress, length: number): Uint8Array | undefined {
    if (address.extended !== true) {
      const found = this.#at(address, length)
      return found?.bytes.subarray(found.from, found.from + length)
    }
    const out = new Uint8Array(length)
    for (let i = 0; i < length; i++) {
      const found = this.#at({ ...address, address: address.address + i })
      if (found === undefined) return undefined
      out[i] = found.bytes[found.from] ?? 0
    }
    return out
  }

  #write(address: JwAddress, data: Uint8Array): Message | number {
    if (this.#bytesAt(address, data.length) === undefined) return 0x08
    data.forEach((value, i) => {
      const found = this.#at({ ...address, address: address.address + i })
      if (found !== undefined) found.bytes[found.from] = value
    })
    return {}
  }

  #setBit(given: unknown, bit: number, value: number): boolean {
    const found = this.#at(given)
    if (found === undefined) return false
    const byte = found.bytes[found.from] ?? 0
    found.bytes[found.from] = value === 1 ? byte | (1 << bit) : byte & ~(1 << bit)
    return true
  }

  readonly #handlers: Readonly<Record<string, Handler>> = {
    readWriteMode: () => ({ mode: this.mode }),
    setWriteMode: ({ mode }) => {
      this.mode = Number(mode)
      return {}
    },
    readRunState: () => ({ state: this.state }),
    setRunState: ({ state }) => {
      this.state = Number(state)
      return {}
    },
    readBlockState: ({ block }) => ({ state: this.blocks.get(Number(block)) ?? 0 }),
    setBlockState: ({ block, state }) => {
      this.blocks.set(Number(block), Number(state))
      return {}
    },
    loopback: () => ({}),
    readMemorySize: () => ({ size: 7 }),
    readDate: () => this.date,
    readTime: () => this.time,
    setDate: (date) => {
      this.date = { ...this.date, ...date }
      return {}
    },
    setTime: ({ hour, minute, second }) => {
      this.time = { hour: Number(hour), minute: Number(minute), second: Number(second) }
      return {}
    },
    correctTime: () => ({}),
    readSecretState: () => ({ state: this.secret }),
    setSecretFunction: () => {
      this.secret = 1
      return {}
    },
    secretPassword: () => ({}),
    readDataMemory: ({ head, length }) => {
      const data = this.#bytesAt(head as JwAddress, Number(length))
      return data === undefined ? 0x08 : { data }
    },
    writeDataMemory: ({ head, data }) => this.#write(head as JwAddress, data as Uint8Array),
    fillDataMemory: ({ head, length, value }) =>
      this.#write(head as JwAddress, new Uint8Array(Number(length)).fill(Number(value))),
    monitorRegisters: ({ items }) => {
      const found = (items as { address: JwAddress }[]).map(({ address }) => this.#bytesAt(address, 1)?.[0])
      return found.includes(undefined) ? 0x08 : { values: found }
    },
    monitorRelay: ({ address, bit }) => {
      const byte = this.#bytesAt(address as JwAddress, 1)?.[0]
      return byte === undefined ? 0x08 : { value: (byte >> Number(bit)) & 1 }
    },
    writeRegisters: ({ items }) => {
      const list = items as { address: JwAddress; value: number }[]
      if (list.some(({ address }) => this.#at(address) === undefined)) return 0x08
      for (const { address, value } of list) this.#write(address, Uint8Array.of(value))
      return {}
    },
    setRelay: ({ address, bit, value }) => (this.#setBit(address, Number(bit), Number(value)) ? {} : 0x08),
    setRelays: ({ items }) => {
      const list = items as { address: JwAddress; bit: number; value: number }[]
      if (list.some(({ address }) => this.#at(address) === undefined)) return 0x08
      for (const { address, bit, value } of list) this.#setBit(address, bit, value)
      return {}
    },
    monitorTimersCounters: ({ number, points }) => {
      const found = Array.from({ length: Number(points) }, (_, i) => this.timers.get(Number(number) + i))
      return {
        words: found.map((timer) => timer?.word ?? 0),
        attributes: Uint8Array.from(found, (timer) => timer?.attribute ?? 0),
      }
    },
    setTimerCounter: ({ number, value }) => {
      const timer = this.timers.get(Number(number))
      if (timer === undefined) return 0x02
      this.timers.set(Number(number), { ...timer, word: value === 1 ? 0 : timer.word })
      return {}
    },
    readSystemMemory: ({ address, length }) => ({
      data: this.system.slice(Number(address), Number(address) + Number(length)),
    }),
    writeSystemMemory: ({ address, data }) => {
      this.system.set(data as Uint8Array, Number(address))
      return {}
    },
    readOptionParameters: ({ address, length }) => ({
      data: this.parameters.slice(Number(address), Number(address) + Number(length)),
    }),
    writeOptionParameters: ({ address, data }) => {
      const isSwitch = Number(address) === 0x7ff
      if (!isSwitch && this.parameters[0x7ff] === 1) return 0x07
      this.parameters.set(data as Uint8Array, Number(address))
      if (isSwitch && this.parameters[0x7ff] === 1) this.parameters[0x7fe] = 0x5a
      return {}
    },
    readSpecialIoParameters: ({ address, length }) => ({
      data: this.specialIo.slice(Number(address), Number(address) + Number(length)),
    }),
    writeSpecialIoParameters: ({ address, data }) => {
      this.specialIo.set(data as Uint8Array, Number(address))
      return {}
    },
    readSpecifiedBuffer: ({ offset, length }) => ({
      data: this.specified.slice(Number(offset), Number(offset) + Number(length)),
    }),
    writeSpecifiedBuffer: ({ offset, data }) => {
      this.specified.set(data as Uint8Array, Number(offset))
      return {}
    },
    readRingBuffer: ({ buffer, length }) => {
      const ring = this.rings.get(Number(buffer))
      if (ring === undefined) return 0x40
      const data = Uint8Array.from(ring.splice(0, Number(length)))
      return { pointer: 7, more: ring.length > 0 ? 1 : 0, data }
    },
    writeRingBuffer: ({ buffer, data }) => {
      const ring = this.rings.get(Number(buffer))
      if (ring === undefined) return 0x40
      ring.push(...(data as Uint8Array))
      return { pointer: 0, written: (data as Uint8Array).length, free: 100 }
    },
    readSpecifiedBufferInformation: () => ({
      definition: 1,
      informationFile: 0,
      informationAddress: 0,
      file: 1,
      address: 0x2000,
      length: 1024,
    }),
    writeSpecifiedBufferInformation: () => ({}),
  }
}

/** Everything is allowed, and time is ample for a busy computer. */
export const free = {
  timeout: 5000,
  allowWrites: true,
  allowControl: true,
  allowParameters: true,
  reconnect: { first: 1, longest: 20 },
  settleGap: 1,
} as const

/** A client joined to a small PLC in memory; what is sent arrives at once. */
export function inMemory(options: JwClientOptions = {}, plc = new SmallJw()): { client: JwClient; plc: SmallJw } {
  const memory = listenMemory({ kind: plc.kind }, plc.accept)
  const client = createJwClient({ ...free, openTransport: memory.open, ...options })
  return { client, plc }
}

/** Runs with a client and a small PLC on real sockets of this computer, and ends both. */
export async function onSockets(
  transport: 'tcp' | 'udp',
  options: Partial<JwClientOptions>,
  plc: SmallJw,
  run: (client: JwClient, port: number) => Promise<void>,
): Promise<void> {
  const listen = transport === 'tcp' ? listenTcp : listenUdp
  const listener = await listen({ port: 0 }, plc.accept)
  const client = createJwClient({ host: '127.0.0.1', port: listener.port, transport, ...free, ...options })
  try {
    await run(client, listener.port)
  } finally {
    await client.close()
    await listener.close()
  }
}
