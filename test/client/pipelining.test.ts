/** Several requests under way at once: 4E over UDP, where every answer has its number. */
import { describe, expect, test } from '@jest/globals'
import type { PlcError } from '../../src/index'
import { ample, brief, failureOf, nextState, until, withLine } from './line'

const texts = ['udp 4E binary iq-r', 'udp 4E ascii q']

describe.each(texts)('%s', (text) => {
  test('eight are under way at once, no more, and each caller gets its own answer', () =>
    withLine(text, { client: { inFlight: 8 } }, async ({ plc, client }) => {
      for (let i = 0; i < 200; i++) plc.memory.setWord('D', i, i)
      await client.connect()
      plc.faults.add({ kind: 'delay', ms: 2, times: 20 })
      let most = 0
      plc.on('request', () => {
        most = Math.max(most, client.statistics.inFlight)
      })
      const values = await Promise.all(Array.from({ length: 200 }, (_, i) => client.read(`D${i}`)))
      expect(values).toEqual(Array.from({ length: 200 }, (_, i) => i))
      expect(most).toBe(8)
      expect(plc.statistics.discarded).toBe(0)
    }))

  test('lost, late, doubled and foreign answers harm nobody else', () =>
    withLine(text, { client: { inFlight: 8, timeout: 200 } }, async ({ plc, client }) => {
      for (let i = 0; i < 100; i++) plc.memory.setWord('D', i, i)
      await client.connect()
      for (const fault of [
        { kind: 'drop' },
        { kind: 'silence' },
        { kind: 'late' },
        { kind: 'duplicate', copies: 3 },
        { kind: 'wrongSerial', add: 0x1000 },
        { kind: 'wrongRoute' },
        { kind: 'cut', at: 9 },
        { kind: 'garbage', place: 'instead' },
        { kind: 'merge' },
        { kind: 'delay', ms: 10 },
      ] as const) {
        await nextState(client, 'connected')
        let struck = 0
        // One in ten of those that are under way together.
        const active = plc.faults.add({ ...fault, when: () => struck++ % 10 === 4 })
        const results = await Promise.all(Array.from({ length: 40 }, async (_, i) => (await client.read([`D${i}`]))[0]))
        active.remove()
        const values = results.map((result) => result && brief(result))
        for (const [i, value] of values.entries()) {
          if (typeof value === 'number') expect([fault, i, value]).toEqual([fault, i, i])
        }
        const right = values.filter((value) => typeof value === 'number').length
        if (fault.kind === 'duplicate' || fault.kind === 'delay') expect([fault, right]).toEqual([fault, 40])
        plc.faults.clear()
        // What the PLC still holds back comes with the answer to this one.
        await client.read(['SM0'])
      }
      await nextState(client, 'connected')
      expect(await client.read('D7', ample)).toBe(7)
    }))

  test('writes under way at once are each applied once, in any order', () =>
    withLine(text, { client: { inFlight: 8, timeout: 250 } }, async ({ plc, client }) => {
      await client.connect()
      const applied = new Map<number, number>()
      plc.on('write', ({ message }) => {
        const [value] = (message?.values ?? []) as number[]
        applied.set(value ?? -1, (applied.get(value ?? -1) ?? 0) + 1)
      })
      let answers = 0
      plc.faults.add({ kind: 'drop', when: () => answers++ % 9 === 5 })
      const outcomes = await Promise.all(
        Array.from({ length: 60 }, (_, i) =>
          client.write(`D${i}`, i).then(
            () => 'done',
            (error: PlcError) => error.outcome,
          ),
        ),
      )
      for (const [i, outcome] of outcomes.entries()) {
        const times = applied.get(i) ?? 0
        if (outcome === 'done') expect([i, times]).toEqual([i, 1])
        else expect([i, times <= (outcome === 'unknown' ? 1 : 0)]).toEqual([i, true])
      }
      expect(outcomes.filter((outcome) => outcome === 'done').length).toBeGreaterThan(20)
    }))

  test('a plan of many requests fills the pipeline', () =>
    withLine(text, { client: { inFlight: 8, gap: 0 } }, async ({ plc, client }) => {
      await client.connect()
      let most = 0
      plc.on('request', () => {
        most = Math.max(most, client.statistics.inFlight)
      })
      plc.faults.add({ kind: 'delay', ms: 1 })
      const results = await client.read(Array.from({ length: 12 }, (_, i) => `D${i * 1000}[900]`))
      expect(results.every(({ ok }) => ok)).toBe(true)
      expect(most).toBe(8)
    }))

  test('an aborted request and a closed client settle what is under way', () =>
    withLine(text, { client: { inFlight: 4 } }, async ({ plc, client }) => {
      await client.connect()
      const { requests } = plc.statistics
      plc.faults.add({ kind: 'silence' })
      const controller = new AbortController()
      const aborted = failureOf(client.read('D0', { signal: controller.signal }))
      const others = Array.from({ length: 6 }, (_, i) => failureOf(client.write(`D${i}`, 1)))
      await until(() => plc.statistics.requests === requests + 4)
      controller.abort()
      expect(await aborted).toMatchObject({ code: 'ABORTED', outcome: 'unknown' })
      await until(() => plc.statistics.requests === requests + 5)
      await client.close()
      const outcomes = (await Promise.all(others)).map(({ code, outcome }) => `${code} ${outcome}`)
      expect(outcomes).toEqual([...Array(4).fill('CLOSED unknown'), ...Array(2).fill('CLOSED notSent')])
    }))
})

test('more in flight than the receive buffer of the PLC holds is refused before anything is sent', () =>
  withLine('udp 4E binary iq-r', {}, async ({ another }) => {
    expect(() => another({ inFlight: 34 })).toThrow(/takes 33/)
    expect(() => another({ inFlight: 8, frame: '3E' })).toThrow(/takes 1/)
    expect(() => another({ inFlight: 8, transport: 'tcp' })).toThrow(/takes 1/)
  }))

test('what two clients together send too much, the PLC throws away: timeouts, never wrong values', () =>
  withLine('udp 4E binary iq-r', { client: { inFlight: 33, timeout: 500 } }, async ({ plc, client, another }) => {
    for (let i = 0; i < 100; i++) plc.memory.setWord('D', i, i)
    const clients = [client, another(), another()]
    await Promise.all(clients.map((one) => one.connect()))
    plc.faults.add({ kind: 'delay', ms: 1 })
    const results = await Promise.all(
      clients.flatMap((one) =>
        Array.from({ length: 100 }, async (_, i) => [i, (await one.read([`D${i}`]))[0]] as const),
      ),
    )
    for (const [i, result] of results) {
      if (result?.ok === true) expect(result.value).toBe(i)
      else expect(['TIMEOUT', 'OVERLOADED', 'DISCONNECTED', 'OFFLINE', 'SILENT']).toContain(result?.error.code)
    }
    expect(plc.statistics.discarded).toBeGreaterThan(0)
  }))
