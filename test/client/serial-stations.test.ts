// Sixteen stations on a slow line, of which three are silent: they cost the others a tenth of the line at most. Characters
// take their time, by a clock made of numbers.
import { describe, expect, test } from '@jest/globals'
import { Connection, type ConnectionOptions, type ConnectionState } from '../../src/client/connection/connection'
import { Deadline } from '../../src/client/connection/deadline'
import { Line } from '../../src/client/connection/line'
import { proofs } from '../../src/client/melsec/control'
import { type RecoveryOptions, Responder } from '../../src/link/link'
import { commands } from '../../src/melsec/commands/commands'
import { serialRoute } from '../../src/melsec/frame/serial-frames'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import { listenMemory } from '../../src/transport/memory'
import type { ServerConnection } from '../../src/transport/transport'
import { manualClock } from '../support/manual-clock'
import { Tracked } from './bench'

const FRAME = { frame: '3C', format: 4 } as const
const framing = serialFraming(FRAME)
/** 9600 bits per second, 10 bits a character. */
const BYTE_TIME = 10_000 / 9600
const ANSWER_TIME = 100
const SCAN = 5
/** Characters of a Read. */
const REQUEST = 1 + 10 + 20 + 2 + 2
/** What an adapter hands over at once. */
const CHUNK = 16

const protocolOf = (station: number) =>
  new MelsecProtocol({
    framing,
    head: serialRoute(FRAME.frame, { station }),
    profile: resolveProfile('q'),
    code: framing.code,
  })

class Stations {
  readonly clock = manualClock()
  readonly dead = new Set<number>()
  /** When which station was asked, and when the line was free for the next request. */
  readonly asked: { readonly station: number; readonly at: number }[] = []
  readonly opened: number[] = []
  readonly memory
  readonly line: Line
  readonly connections: Connection[] = []
  readonly #protocol = protocolOf(0)
  #busyUntil = 0
  #peer: ServerConnection | undefined

  constructor(recovery: Partial<RecoveryOptions> = {}) {
    this.memory = listenMemory({ kind: 'stream', delivery: 'manual' }, (peer) => this.#accept(peer))
    this.line = new Line({
      framing,
      openTransport: () => {
        this.opened.push(this.clock.now())
        return this.memory.open()
      },
      clock: this.clock,
      inFlight: 1,
      connectTimeout: 3000,
      timeout: 3000,
      random: () => 0,
      proof: proofs(this.#protocol, () => 0.5),
      recovery: { quiet: 20, betweenBytes: 30, answerTime: ANSWER_TIME, byteTime: BYTE_TIME, ...recovery },
    })
  }

  #accept(peer: ServerConnection): void {
    const responder = new Responder(framing, 'stream', () => undefined)
    this.#peer = peer
    peer.onReceived = (bytes) => {
      const sent = Math.max(this.clock.now(), this.#busyUntil) + bytes.length * BYTE_TIME
      this.#busyUntil = sent
      for (const frame of responder.receive(bytes)) {
        const { station } = frame.head
        this.asked.push({ station, at: this.clock.now() })
        if (this.dead.has(station)) continue
        const request = this.#protocol.readRequest(frame)
        if ('unknown' in request) throw new Error('a request that nobody knows')
        const { points = 0 } = request.message as { points?: number }
        const response =
          request.name === 'readTypeName'
            ? { model: 'FX5U'.padEnd(16), modelCode: 0x4a21 }
            : request.name === 'readWords'
              ? { values: Array.from({ length: points }, () => station) }
              : {}
        this.#answer(peer, responder.answer(frame, 0, this.#protocol.writeResponse(request, response)), sent + SCAN)
      }
    }
  }

  unplug(): void {
    this.#peer?.reset()
  }

  /** The characters come one after another, as an adapter hands them over. */
  #answer(peer: ServerConnection, answer: Buffer, from: number): void {
    this.#busyUntil = from + answer.length * BYTE_TIME
    for (let at = 0; at < answer.length; at += CHUNK) {
      const chunk = answer.subarray(at, at + CHUNK)
      const arrived = from + (at + chunk.length) * BYTE_TIME
      this.clock.timer(arrived - this.clock.now(), () => peer.send(chunk))
    }
  }

  station(number: number, options: Partial<ConnectionOptions> = {}) {
    const protocol = protocolOf(number)
    const states: ConnectionState[] = []
    const connection = new Connection(this.line, {
      clock: this.clock,
      supervisor: { first: 500, longest: 30_000, settleGap: 50, random: () => 0.5 },
      queueLimit: 256,
      connectTimeout: 3000,
      timeout: 3000,
      probes: [
        { name: 'Read Type Name (0101)', exchange: () => protocol.exchange(commands.readTypeName, {}) },
        { name: 'Read (0401)', exchange: () => protocol.exchange(commands.readWords, { head: D0, points: 1 }) },
      ],
      explainSilence: () => [],
      onState: (state) => states.push(state),
      onUnsolicited: () => {},
      ...options,
    })
    this.connections.push(connection)
    return {
      connection,
      states,
      read: (points = 1, timeout?: number) => {
        const exchange = protocol.exchange(commands.readWords, { head: D0, points })
        return new Tracked(connection.request(exchange, timeout === undefined ? {} : { timeout }))
      },
      readWithin: (deadline: Deadline, points: number) => {
        const exchange = protocol.exchange(commands.readWords, { head: D0, points })
        return new Tracked(connection.request(exchange, deadline.ofRequest(exchange.title)))
      },
      reset: () => new Tracked(connection.request(protocol.exchange(commands.remoteReset, {}))),
      write: () => new Tracked(connection.request(protocol.exchange(commands.writeWords, { head: D0, values: [1] }))),
      /** Asks again and again. @returns how many answers there were so far */
      poll: () => {
        const count = { answered: 0 }
        const again = (): void => {
          const exchange = protocol.exchange(commands.readWords, { head: D0, points: 10 })
          connection.request(exchange).then(
            () => {
              count.answered += 1
              again()
            },
            () => {
              if (connection.state.name !== 'closed') this.clock.timer(100, again)
            },
          )
        }
        again()
        return count
      },
    }
  }

  async pass(ms: number): Promise<void> {
    const settle = async () => {
      do await new Promise<void>((resolve) => setImmediate(resolve))
      while (this.memory.deliver() > 0)
    }
    const end = this.clock.now() + ms
    await settle()
    for (
      let next = this.clock.untilNext;
      next !== undefined && this.clock.now() + next <= end;
      next = this.clock.untilNext
    ) {
      this.clock.advance(next)
      await settle()
    }
    this.clock.advance(end - this.clock.now())
  }

  close(): void {
    for (const connection of this.connections) connection.close()
  }
}

const D0 = { device: 'D', number: 0 } as const
const ALIVE = Array.from({ length: 13 }, (_, i) => i)
const SILENT = [13, 14, 15]

/** Answers to thirteen stations in half a minute, after the first round. */
async function answersIn(silent: readonly number[]): Promise<{ answered: number; probes: number }> {
  const stations = new Stations()
  for (const number of silent) stations.dead.add(number)
  const alive = ALIVE.map((number) => stations.station(number).poll())
  for (const number of silent) stations.station(number).poll()
  await stations.pass(5000)
  const before = alive.reduce((sum, { answered }) => sum + answered, 0)
  stations.asked.length = 0
  await stations.pass(30_000)
  const answered = alive.reduce((sum, one) => sum + one.answered, 0) - before
  const probes = stations.asked.filter(({ station }) => silent.includes(station)).length
  stations.close()
  return { answered, probes }
}

test('three silent stations of sixteen leave the others nine tenths of their pace at least', async () => {
  const all = await answersIn([])
  const others = await answersIn(SILENT)
  expect(all.answered).toBeGreaterThan(250)
  expect(others.answered).toBeGreaterThanOrEqual(0.9 * all.answered)
  // They are still looked for.
  expect(others.probes).toBeGreaterThan(3)
})

/** Two stations that have answered. */
async function two(recovery: Partial<RecoveryOptions> = {}, options: Partial<ConnectionOptions> = {}) {
  const stations = new Stations(recovery)
  const [first, second] = [stations.station(1, options), stations.station(2, options)]
  const connecting = [first, second].map(({ connection }) => new Tracked(connection.connect()))
  await stations.pass(10_000)
  expect(connecting.map(({ told }) => told)).toEqual([undefined, undefined])
  stations.asked.length = 0
  return { stations, first, second }
}

describe('a silent station', () => {
  test('costs its answer time once: one call is unknown, what waits behind it is not sent', async () => {
    const { stations, first, second } = await two()
    stations.dead.add(2)
    const [write, ...waiting] = [second.write(), second.write(), second.read()]
    const other = first.read()
    await stations.pass(ANSWER_TIME + 300)
    expect([write?.told, ...waiting.map(({ told }) => told)]).toEqual([
      'TIMEOUT unknown',
      'OFFLINE notSent',
      'OFFLINE notSent',
    ])
    expect(write?.error?.message).toContain('within the answer time of the line')
    expect(other.told).toEqual({ values: [1] })
    expect(second.read().told).toBe('pending')
    expect(stations.asked.filter(({ station }) => station === 2)).toHaveLength(1)
    expect([first.connection.state.name, second.connection.state.name]).toEqual(['connected', 'waiting'])
    stations.close()
  })

  test('is looked for with pauses that grow, one request each time, and found when it is there again', async () => {
    const { stations, second } = await two()
    stations.dead.add(2)
    second.read()
    await stations.pass(60_000)
    const times = stations.asked.map(({ at }) => at)
    const pauses = times.slice(1).map((at, i) => at - (times[i] ?? 0))
    expect(pauses.length).toBeGreaterThan(4)
    expect(pauses.length).toBeLessThan(10)
    expect(pauses.at(-1)).toBeGreaterThan(10_000)
    stations.dead.clear()
    // Its supervisor asks every 15 to 30 s by now.
    await stations.pass(30_000)
    const read = second.read()
    await stations.pass(500)
    expect([second.connection.state.name, second.connection.generation, read.told]).toEqual([
      'connected',
      2,
      { values: [2] },
    ])
    stations.close()
  })

  test('that missed one request only is asked again soon; when that is silent, too, it waits for its share of the line', async () => {
    const { stations, second } = await two()
    const missed = async (): Promise<number> => {
      stations.dead.add(2)
      const read = second.read()
      await stations.pass(REQUEST * BYTE_TIME + ANSWER_TIME + 1)
      expect(read.told).toBe('TIMEOUT unknown')
      stations.dead.clear()
      const lostAt = stations.clock.now()
      for (let i = 0; i < 50 && second.connection.state.name !== 'connected'; i++) await stations.pass(100)
      expect(second.connection.state.name).toBe('connected')
      return stations.clock.now() - lostAt
    }
    expect(await missed()).toBeLessThan(700)
    expect(await missed()).toBeGreaterThan(1500)
    stations.close()
  })

  test('that was never there is tried with each probe once, then with one at a time', async () => {
    const stations = new Stations()
    stations.dead.add(2)
    const { connection } = stations.station(2)
    new Tracked(connection.connect())
    await stations.pass(400)
    expect(stations.asked).toHaveLength(2)
    await stations.pass(600)
    expect(stations.asked).toHaveLength(3)
    stations.close()
  })

  test('costs one that is there its turn only: it is not taken for silent before it was asked', async () => {
    const stations = new Stations({ answerTime: 500 })
    const gone = Array.from({ length: 12 }, (_, i) => i + 1)
    for (const number of gone) {
      stations.dead.add(number)
      new Tracked(stations.station(number).connection.connect())
    }
    const { connection, states, read } = stations.station(13)
    const connecting = new Tracked(connection.connect())
    const early = read()
    await stations.pass(4000)
    expect([stations.asked.some(({ station }) => station === 13), early.error?.outcome]).toEqual([false, 'notSent'])
    expect(early.error?.message).toContain('its turn on the line has not come')
    expect(early.error?.message).not.toMatch(/Most likely|has not answered/)
    await stations.pass(6000)
    expect([connecting.settled, connecting.error]).toEqual([1, undefined])
    expect(states.map(({ name }) => name)).toEqual(['connecting', 'connected'])
    stations.close()
  })

  test('with an explicit timeout that is over before its answer time is not counted as absent', async () => {
    const { stations, second } = await two()
    stations.dead.add(2)
    const read = second.read(1, 60)
    await stations.pass(90)
    expect([read.told, second.connection.state.name]).toEqual(['TIMEOUT unknown', 'connected'])
    stations.close()
  })

  test('the message wait of a station counts beside the answer time', async () => {
    const { stations, second } = await two({ answerTime: 40 }, { messageWait: 150 })
    stations.dead.add(2)
    const read = second.read()
    const request = REQUEST * BYTE_TIME
    await stations.pass(request + 150 + 30)
    expect(read.told).toBe('pending')
    await stations.pass(20)
    expect(read.told).toBe('TIMEOUT unknown')
    stations.close()
  })
})

describe('a large read on a slow line', () => {
  test('does not time out by default: the deadline counts its characters', async () => {
    const { stations, first } = await two()
    const read = first.read(960)
    await stations.pass(5000)
    expect(read.told).toMatchObject({ values: { length: 960 } })
    stations.close()
  })

  test('with an explicit timeout ends with it', async () => {
    const { stations, first } = await two()
    const read = first.read(960, 3000)
    await stations.pass(5000)
    expect(read.told).toBe('TIMEOUT unknown')
    stations.close()
  })

  test('several of one call count together', async () => {
    const { stations, first } = await two()
    const deadline = new Deadline(stations.clock, {}, 3000)
    const reads = Array.from({ length: 4 }, () => first.readWithin(deadline, 960))
    await stations.pass(20_000)
    expect(reads.map(({ settled, error }) => [settled, error])).toEqual(Array.from({ length: 4 }, () => [1, undefined]))
    stations.close()
  })
})

test('a small read is not refused as too late because the ones before it were large', async () => {
  const { stations, first, second } = await two()
  for (let i = 0; i < 5; i++) {
    first.read(960)
    await stations.pass(5000)
  }
  const others = Array.from({ length: 5 }, () => second.read())
  const small = Array.from({ length: 5 }, () => first.read(1, 1000))
  await stations.pass(1500)
  expect([...others, ...small].map(({ error }) => error)).toEqual(Array.from({ length: 10 }, () => undefined))
  stations.close()
})

test('a request that is not answered has succeeded after the answer time, and the station stays', async () => {
  const { stations, second } = await two()
  stations.dead.add(2)
  const reset = second.reset()
  await stations.pass(200)
  expect([reset.told, second.connection.state.name]).toEqual([{}, 'connected'])
  stations.close()
})

test('the pause between an answer and the next request is kept, between stations, too', async () => {
  const gap = 40
  const { stations, first, second } = await two({ gap })
  first.read()
  second.read()
  second.read()
  await stations.pass(1000)
  const answer = (1 + 10 + 4 + 1 + 2 + 2) * BYTE_TIME
  const exchange = REQUEST * BYTE_TIME + SCAN + answer
  const pauses = stations.asked.slice(1).map(({ at }, i) => at - (stations.asked[i]?.at ?? 0) - exchange)
  expect(pauses).toHaveLength(2)
  for (const pause of pauses) expect(pause).toBeCloseTo(gap, 0)
  stations.close()
})

describe('a line that is lost, as when an adapter is pulled out', () => {
  test('ends each call once, is tried at a bounded rate, and is there for all with the first that opens it', async () => {
    const stations = new Stations()
    const all = Array.from({ length: 16 }, (_, i) => stations.station(i))
    for (const { connection } of all) new Tracked(connection.connect())
    await stations.pass(5000)
    expect([stations.opened.length, ...all.map(({ connection }) => connection.state.name)]).toEqual([
      1,
      ...all.map(() => 'connected'),
    ])
    const calls = all.map(({ write }) => write())
    await stations.pass(20)
    stations.memory.refuse = true
    stations.unplug()
    await stations.pass(3000)
    expect(calls.map(({ settled }) => settled)).toEqual(calls.map(() => 1))
    expect(calls.filter(({ told }) => told !== 'OFFLINE notSent').map(({ told }) => told)).toEqual([
      'DISCONNECTED unknown',
    ])
    await stations.pass(120_000)
    const times = stations.opened.slice(1)
    for (const [at, time] of times.slice(1).entries()) expect(time - (times[at] ?? 0)).toBeGreaterThanOrEqual(250)
    expect(times.length).toBeLessThan(200)
    stations.memory.refuse = false
    const before = stations.opened.length
    for (let i = 0; i < 30 && all.some(({ connection }) => connection.state.name !== 'connected'); i++)
      await stations.pass(1000)
    expect([stations.opened.length - before, all.map(({ connection }) => connection.generation)]).toEqual([
      1,
      all.map(() => 2),
    ])
    const reads = all.map(({ read }) => read())
    await stations.pass(3000)
    expect(reads.map(({ told }) => told)).toEqual(all.map((_, station) => ({ values: [station] })))
    stations.close()
    expect([stations.line.isOpen, stations.clock.pending]).toEqual([false, 0])
  })
})
