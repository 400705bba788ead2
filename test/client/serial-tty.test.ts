// Two programs over a real pair of serial ports: one asks two stations, the other is both of them.
import { afterEach, describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { Connection, type ConnectionOptions } from '../../src/client/connection/connection'
import { Line } from '../../src/client/connection/line'
import { proofs } from '../../src/client/melsec/control'
import { PlcError } from '../../src/errors'
import { Responder } from '../../src/link/link'
import { commands } from '../../src/melsec/commands/commands'
import { serialRoute } from '../../src/melsec/frame/serial-frames'
import { type SerialFrameOptions, serialFraming } from '../../src/melsec/frame/serial-framing'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import { realClock } from '../../src/transport/clock'
import { lineTime, serialSettings, serialTransport } from '../../src/transport/serial'
import type { Transport } from '../../src/transport/transport'

import { type TtyPair, ttyPair } from '../support/tty-pair'
import { until } from './line'

const port = { baudRate: 115_200, dataLength: 8, parity: 'none' } as const
const ends: (() => unknown)[] = []
afterEach(async () => {
  for (const end of ends.splice(0)) await end()
})

/** Random numbers that are the same in every run. */
function numbers(seed: number): () => number {
  const sample = fc.sample(fc.integer({ min: 0, max: 0xffff }), { seed, numRuns: 5000 })
  let at = 0
  return () => (sample[at++ % sample.length] ?? 0) / 0x1_0000
}

interface Noise {
  /** Share of the answers that the line damages. */
  readonly answers: number
  /** Share of the requests. */
  readonly requests: number
  /** ms that a call may take, that an answer may need to begin, and that may be between two bytes: without noise nothing waits for them. */
  readonly timeout: number
  readonly answerTime: number
  readonly betweenBytes: number
  /** The line gives back what is sent, as a converter with two wires does. */
  readonly echoes?: true
}

/** Stations 1 and 2, each with its words; writes are counted by what they write. */
class Stations {
  readonly words = new Map<number, Uint16Array>([1, 2].map((station) => [station, new Uint16Array(256)]))
  readonly written = new Map<number, number>()
  readonly #transport: Transport
  readonly #responder
  readonly #protocol
  readonly #random = numbers(7)

  constructor(
    options: SerialFrameOptions,
    path: string,
    readonly noise: Noise,
    opened: () => void,
  ) {
    const framing = serialFraming(options)
    this.#protocol = protocolOf(options, 0)
    const protocol = this.#protocol
    this.#responder = new Responder(framing, 'stream', (_head, soFar) => protocol.requestLength(soFar))
    this.#transport = serialTransport({ path, ...port })()
    this.#transport.open({ opened, received: (bytes) => this.#received(bytes), closed: () => {} })
    ends.push(() => this.#transport.close())
  }

  #received(bytes: Buffer): void {
    if (this.noise.echoes === true) this.#transport.send(this.#damaged(Buffer.from(bytes), this.noise.requests))
    for (const frame of this.#responder.receive(this.#damaged(bytes, this.noise.requests))) {
      const station = frame.head.station ?? 0
      const words = this.words.get(station)
      const request = this.#protocol.readRequest(frame)
      if (words === undefined || 'unknown' in request) continue
      const { head, points, values } = request.message as { head: { number: number }; points: number; values: number[] }
      if (request.name === 'writeWords') {
        words.set(values, head.number)
        for (const value of values) this.written.set(value, (this.written.get(value) ?? 0) + 1)
      }
      const response =
        request.name === 'readTypeName'
          ? { model: 'FX5U'.padEnd(16), modelCode: 0x4a21 }
          : request.name === 'readWords'
            ? { values: [...words.subarray(head.number, head.number + points)] }
            : {}
      const answer = this.#responder.answer(frame, 0, this.#protocol.writeResponse(request, response))
      this.#transport.send(this.#damaged(answer, this.noise.answers))
    }
  }

  /** One byte is another one, is lost, or comes twice; or noise stands in front. */
  #damaged(bytes: Buffer, share: number): Buffer {
    if (this.#random() >= share || bytes.length === 0) return bytes
    const at = Math.floor(this.#random() * bytes.length)
    const byte = bytes.readUInt8(at)
    const [before, behind] = [bytes.subarray(0, at), bytes.subarray(at + 1)]
    const kind = Math.floor(this.#random() * 4)
    if (kind === 0) return Buffer.concat([before, Buffer.of(byte ^ (1 << Math.floor(this.#random() * 7))), behind])
    if (kind === 1) return Buffer.concat([before, behind])
    if (kind === 2) return Buffer.concat([before, Buffer.of(byte, byte), behind])
    return Buffer.concat([Buffer.of(0x00, 0x7f), bytes])
  }
}

function protocolOf(options: SerialFrameOptions, station: number) {
  const framing = serialFraming(options)
  const head = serialRoute(options.frame, { station })
  return new MelsecProtocol({ framing, head, profile: resolveProfile('iq-f'), code: framing.code, asciiXy: 'octal' })
}

async function started(options: SerialFrameOptions, noise: Noise) {
  const pair: TtyPair = await ttyPair()
  ends.push(() => pair.close())
  const stations = await new Promise<Stations>((resolve) => {
    const made: Stations = new Stations(options, pair.far, noise, () => resolve(made))
  })
  const protocols = [1, 2].map((station) => protocolOf(options, station))
  const [first] = protocols
  if (first === undefined) throw new Error('no station')
  const line = new Line({
    framing: first.framing,
    openTransport: serialTransport({ path: pair.near, ...port }),
    clock: realClock,
    inFlight: 1,
    connectTimeout: 2000,
    timeout: 2000,
    random: Math.random,
    proof: proofs(first, Math.random),
    recovery: {
      quiet: 5,
      betweenBytes: noise.betweenBytes,
      answerTime: noise.answerTime,
      byteTime: lineTime(1, serialSettings({ path: pair.near, ...port })),
      echo: noise.echoes === true ? 'always' : 'never',
    },
  })
  const connections = protocols.map((protocol) => {
    const settings: ConnectionOptions = {
      clock: realClock,
      supervisor: { first: 20, longest: 100, settleGap: 5, random: Math.random },
      queueLimit: 256,
      connectTimeout: 2000,
      timeout: 2000,
      probes: [{ name: 'Read Type Name (0101)', exchange: () => protocol.exchange(commands.readTypeName, {}) }],
      explainSilence: () => [],
      onState: () => {},
      onUnsolicited: () => {},
    }
    const connection = new Connection(line, settings)
    ends.unshift(() => connection.close())
    return { connection, protocol }
  })
  return { stations, connections }
}

const D = (number: number) => ({ device: 'D', number }) as const

const serial = [
  { frame: '3C', format: 1 },
  { frame: '3C', format: 4 },
  { frame: '4C', format: 4 },
  { frame: '4C', format: 5 },
] as const satisfies readonly SerialFrameOptions[]

const QUIET: Noise = { answers: 0, requests: 0, timeout: 10_000, answerTime: 1000, betweenBytes: 2000 }
const NOISY: Noise = { answers: 0.05, requests: 0.05, timeout: 1000, answerTime: 40, betweenBytes: 20 }

describe.each(serial)('$frame format $format over a pair of ports', (options) => {
  test.each([
    ['without noise', QUIET, 200],
    ['with noise', NOISY, 30],
    // The echo of a request is as good as its frame: in format 1 nothing else marks its end.
    ...(options.format === 1 ? [['with noise, on two wires', { ...NOISY, echoes: true }, 30] as const] : []),
  ] as const)(
    '%s: no wrong value, no doubled write, and every lost one is told',
    async (_name, noise, count) => {
      const { stations, connections } = await started(options, noise)
      const random = numbers(3)
      // In format 1 each write takes its time, see `endsWithSilence`.
      const rounds = options.format === 1 ? Math.min(count, 50) : count
      let told = 0
      for (let i = 0; i < rounds; i++) {
        const number = Math.floor(random() * 200)
        const value = i + 1
        await Promise.all(
          connections.map(async ({ connection, protocol }, at) => {
            const unique = value * 2 + at
            const write = protocol.exchange(commands.writeWords, { head: D(number), values: [unique] })
            const outcome = await connection.request(write, { timeout: noise.timeout }).catch((error: unknown) => {
              if (error instanceof PlcError) return error
              throw error
            })
            const times = stations.written.get(unique) ?? 0
            if (outcome instanceof PlcError) {
              told += 1
              // One that was silent is looked for: nothing is sent until it is there.
              await until(() => ['idle', 'connected'].includes(connection.state.name))
              expect(times).toBeLessThanOrEqual(outcome.outcome === 'unknown' ? 1 : 0)
              return
            }
            expect(times).toBe(1)
            const read = protocol.exchange(commands.readWords, { head: D(number), points: 1 })
            const answer = await connection.request(read, { timeout: noise.timeout }).catch(() => undefined)
            if (answer === undefined) told += 1
            else expect(answer.values).toEqual([unique])
          }),
        )
      }
      expect(told > 0).toBe(noise.answers > 0)
      // Of two calls in each round, some went well: otherwise the test would mean nothing.
      expect(told).toBeLessThan(2 * rounds - 10)
    },
    120_000,
  )
})
