/**
 * What a call says is what a PLC received and did, whatever goes wrong on the way: late, lost, doubled and cut answers, resets.
 * The PLC keeps a ledger: each write is a number of its own, and each value read says how many writes came before it.
 */
import { describe, expect, test } from '@jest/globals'
import { PlcError } from '../../../src/errors'
import type { ServerConnection } from '../../../src/transport/transport'
import { until } from '../line'
import { type AskedJw, onSockets, SmallJw } from './small-jw'

/** The same numbers each time: what fails can be looked at. */
function randomOf(seed: number): () => number {
  let state = seed
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0
    return state / 0x1_0000_0000
  }
}

class Faulty {
  readonly plc: SmallJw
  readonly ledger: number[] = []
  #late: (() => void)[] = []

  constructor(
    kind: 'stream' | 'datagram',
    readonly random: () => number,
  ) {
    this.plc = new SmallJw(kind)
    this.plc.script = (asked) => this.#act(asked)
    this.plc.proof = (asked) => {
      if (this.random() < 0.9) asked.reply()
    }
  }

  #act(asked: AskedJw): void {
    this.#sendLate()
    const { data, head } = asked.message as { data?: Uint8Array; head?: { address: number } }
    if (asked.name === 'writeDataMemory' && data !== undefined && head?.address === 0o4000) {
      this.ledger.push((data[0] ?? 0) | ((data[1] ?? 0) << 8))
    }
    const bytes = asked.answer()
    const kind = Math.floor(this.random() * 12)
    const { peer } = asked
    if (kind === 0) return
    if (kind === 1) this.#later(peer, bytes)
    else if (kind === 2) {
      peer.send(bytes)
      peer.send(bytes)
    } else if (kind === 3) {
      peer.send(bytes)
      this.#later(peer, bytes)
    } else if (kind === 4 && this.plc.kind === 'stream') {
      peer.send(bytes.subarray(0, 3))
      peer.send(bytes.subarray(3))
    } else if (kind === 5 && this.plc.kind === 'stream') peer.reset()
    else if (kind === 6) peer.send(bytes.subarray(0, bytes.length - 1))
    else peer.send(bytes)
  }

  #later(peer: ServerConnection, bytes: Buffer): void {
    this.#late.push(() => peer.send(bytes))
  }

  #sendLate(): void {
    const late = this.#late
    this.#late = []
    for (const send of late) send()
  }
}

describe.each([
  ['tcp', {}, 'stream'],
  ['udp', {}, 'datagram'],
  ['udp', { header: 'zero40' }, 'datagram'],
] as const)('over %s %j', (transport, options, kind) => {
  test.each([1, 2, 3])('no value is wrong, and no write lost or doubled; seed %i', async (seed) => {
    const random = randomOf(seed)
    const faulty = new Faulty(kind, random)
    const { plc, ledger } = faulty
    await onSockets(transport, { ...options, timeout: 60, connectTimeout: 500 }, plc, async (client) => {
      for (let number = 1; number <= 60; number++) {
        await until(() => client.state.name === 'connected' || client.state.name === 'idle')
        const isWrite = random() < 0.5
        const before = ledger.at(-1) ?? 0
        try {
          if (isWrite) await client.write('09000:UINT', number)
          else expect(await client.read('09000:UINT')).toBe(before)
          if (isWrite) expect(ledger.filter((one) => one === number)).toHaveLength(1)
        } catch (error) {
          if (!(error instanceof PlcError)) throw error
          const times = ledger.filter((one) => one === number).length
          expect(times).toBeLessThanOrEqual(error.outcome === 'notSent' || error.outcome === 'refused' ? 0 : 1)
        }
      }
      expect(new Set(ledger).size).toBe(ledger.length)
      expect(client.statistics.answered).toBeGreaterThan(10)
    })
  })
})
