// Stations on one line without connections, in frames without a serial number: what is damaged is asked again where that
// is safe, and a silent or noisy station costs the others nothing but its time.
import { describe, expect, test } from '@jest/globals'
import { Connection, type ConnectionOptions } from '../../src/client/connection/connection'
import { Line } from '../../src/client/connection/line'
import { proofs } from '../../src/client/melsec/control'
import { type Framing, Responder } from '../../src/link/link'
import { commands } from '../../src/melsec/commands/commands'
import type { SerialHead } from '../../src/melsec/frame/serial-frames'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import { listenMemory } from '../../src/transport/memory'
import type { ServerConnection } from '../../src/transport/transport'
import { manualClock } from '../support/manual-clock'
import { Tracked } from './bench'

const DLE = 0x10
const format5 = serialFraming({ frame: '4C', format: 5 })
const framing: Framing<SerialHead> = {
  ...format5,
  recovery: Buffer.of(0x04),
  response: {
    ...format5.response,
    noise: (bytes) => (bytes.indexOf(DLE) < 0 ? bytes.length : bytes.indexOf(DLE)),
  },
}
const protocolOf = (station: number) =>
  new MelsecProtocol({
    framing,
    head: { station, network: 0, pc: 0xff, moduleIo: 0x3ff, multidrop: 0, selfStation: 0 },
    profile: resolveProfile('q'),
    code: 'binary',
  })

/** What a station does with an answer of its own before it goes over the line; `undefined`: it says nothing. */
type Damage = (answer: Buffer) => Buffer | undefined

const wrongSum: Damage = (answer) =>
  Buffer.concat([answer.subarray(0, -1), Buffer.of(answer.at(-1) === 0x30 ? 0x31 : 0x30)])
const half: Damage = (answer) => answer.subarray(0, 9)
const noisy: Damage = (answer) => Buffer.concat([Buffer.of(0x00, 0xff, 0x7f), answer])
const whole: Damage = (answer) => answer
/** As an answer to another request of station 1 that comes very late: nothing is wrong with its frame. */
const late: Damage = () => {
  const head = { station: 1, network: 0, pc: 0xff, moduleIo: 0x3ff, multidrop: 0, selfStation: 0 }
  return framing.response.write(head, 0, 0, Buffer.of(1, 0, 2, 0))
}

class Stations {
  readonly clock = manualClock()
  /** Requests as they arrive, e.g. `1 writeWords`. */
  readonly asked: string[] = []
  /** What becomes of the next answers, one after another. */
  readonly damages: Damage[] = []
  /** Stations that say nothing at all. */
  readonly dead = new Set<number>()
  /** The codes a station answers instead, one after another. */
  readonly codes: number[] = []
  readonly memory
  readonly line: Line
  readonly #protocol = protocolOf(0)

  constructor() {
    this.memory = listenMemory({ kind: 'stream', delivery: 'manual' }, (peer) => this.#accept(peer))
    this.line = new Line({
      framing,
      openTransport: () => this.memory.open(),
      clock: this.clock,
      inFlight: 1,
      connectTimeout: 1000,
      timeout: 1000,
      random: () => 0,
      proof: proofs(this.#protocol, () => 0.5),
      recovery: { quiet: 20, betweenBytes: 5 },
    })
  }

  #accept(peer: ServerConnection): void {
    const responder = new Responder(framing, 'stream', () => undefined)
    peer.onReceived = (bytes) => {
      // EOT is no frame: a station takes it as the end of whatever it was asked.
      for (const frame of responder.receive(bytes[0] === 0x04 ? bytes.subarray(1) : bytes)) {
        const request = this.#protocol.readRequest(frame)
        if ('unknown' in request) throw new Error('a request that nobody knows')
        if (request.name !== 'readTypeName') this.asked.push(`${frame.head.station} ${request.name}`)
        if (this.dead.has(frame.head.station)) return
        const code = request.name === 'readTypeName' ? 0 : (this.codes.shift() ?? 0)
        const response =
          request.name === 'readTypeName'
            ? { model: 'Q03UDVCPU'.padEnd(16), modelCode: 0x366 }
            : request.name === 'readWords'
              ? { values: [frame.head.station] }
              : {}
        const body = code === 0 ? this.#protocol.writeResponse(request, response) : Buffer.alloc(0)
        const damage = request.name === 'readTypeName' ? whole : (this.damages.shift() ?? whole)
        const answer = damage(responder.answer(frame, code, body))
        if (answer !== undefined) peer.send(answer)
      }
    }
  }

  station(number: number) {
    const protocol = protocolOf(number)
    const options: ConnectionOptions = {
      clock: this.clock,
      supervisor: { first: 500, longest: 30_000, settleGap: 50, random: () => 0 },
      queueLimit: 256,
      connectTimeout: 1000,
      timeout: 1000,
      probes: [{ name: 'Read Type Name (0101)', exchange: () => protocol.exchange(commands.readTypeName, {}) }],
      explainSilence: () => [],
      onState: () => {},
      onUnsolicited: () => {},
    }
    const connection = new Connection(this.line, options)
    const head = { device: 'D', number: 0 } as const
    return {
      connection,
      read: () => new Tracked(connection.request(protocol.exchange(commands.readWords, { head, points: 1 }))),
      write: () => new Tracked(connection.request(protocol.exchange(commands.writeWords, { head, values: [1] }))),
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
}

/** Two stations that have answered. */
async function two() {
  const stations = new Stations()
  const [first, second] = [stations.station(1), stations.station(2)]
  const connecting = [first, second].map(({ connection }) => new Tracked(connection.connect()))
  await stations.pass(10_000)
  expect(connecting.map(({ told }) => told)).toEqual([undefined, undefined])
  return { stations, first, second }
}

describe('a damaged answer', () => {
  test.each([
    ['a wrong sum', wrongSum],
    ['half of it', half],
    ['one of another size', late],
  ])('(%s) of a read is asked for once more', async (_name, damage) => {
    const { stations, first } = await two()
    stations.damages.push(damage)
    const read = first.read()
    await stations.pass(100)
    expect([read.told, stations.asked]).toEqual([{ values: [1] }, ['1 readWords', '1 readWords']])
    expect(first.connection.state.name).toBe('connected')
  })

  test('twice in a row is told, and costs the other station nothing', async () => {
    const { stations, first, second } = await two()
    // The stations take turns, also when one is asked once more.
    stations.damages.push(wrongSum, whole, wrongSum)
    const read = first.read()
    const other = second.read()
    await stations.pass(200)
    expect([read.told, other.told]).toEqual(['BAD_SUM unknown', { values: [2] }])
    expect([first.connection.state.name, second.connection.state.name]).toEqual(['connected', 'connected'])
  })

  test('of a write is never asked for again: it may have been carried out', async () => {
    const { stations, first } = await two()
    stations.damages.push(wrongSum)
    const write = first.write()
    await stations.pass(200)
    expect([write.told, stations.asked]).toEqual(['BAD_SUM unknown', ['1 writeWords']])
  })

  test('of another size is no answer to a write: the station stays, and the line is brought to a known state first', async () => {
    const { stations, first, second } = await two()
    stations.damages.push(late)
    const write = first.write()
    const other = second.read()
    await stations.pass(15)
    expect([write.told, other.told]).toEqual(['TRAILING unknown', 'pending'])
    await stations.pass(100)
    expect([other.told, first.connection.state.name]).toEqual([{ values: [2] }, 'connected'])
    expect(first.connection.statistics).toMatchObject({ protocolErrors: 1, disconnects: 0 })
  })

  test('noise in front of an answer costs nothing', async () => {
    const { stations, first } = await two()
    stations.damages.push(noisy)
    const write = first.write()
    await stations.pass(1)
    expect([write.told, stations.asked]).toEqual([{}, ['1 writeWords']])
  })
})

describe('a damaged request', () => {
  test('is sent once more, also a write, because the PLC says that it was not taken', async () => {
    const { stations, first } = await two()
    stations.codes.push(0x7f24)
    const write = first.write()
    await stations.pass(10)
    expect([write.told, stations.asked]).toEqual([{}, ['1 writeWords', '1 writeWords']])
    expect(first.connection.statistics).toMatchObject({ requests: 1, answered: 1, refused: 0 })
  })

  test('that is damaged again is told', async () => {
    const { stations, first } = await two()
    stations.codes.push(0x7f24, 0x7f24)
    const write = first.write()
    await stations.pass(10)
    expect([write.told, stations.asked.length]).toEqual(['END_CODE refused', 2])
  })

  test('any other refusal is told at once', async () => {
    const { stations, first } = await two()
    stations.codes.push(0x7e43)
    const write = first.write()
    await stations.pass(10)
    expect([write.told, stations.asked.length]).toEqual(['END_CODE refused', 1])
  })
})

test('a silent station is asked no more than its attempts; the others go on, on the same line', async () => {
  const { stations, first, second } = await two()
  stations.dead.add(2)
  const lost = [second.read(), second.read()]
  await stations.pass(2500)
  expect(lost.map(({ told }) => told)).toEqual(['TIMEOUT unknown', expect.stringMatching(/^TIMEOUT|^OVERLOADED/)])
  stations.asked.length = 0
  for (let i = 0; i < 20; i++) {
    const read = first.read()
    await stations.pass(2000)
    expect(read.told).toEqual({ values: [1] })
  }
  expect([first.connection.generation, first.connection.statistics.disconnects]).toEqual([1, 0])
})
