// When to connect, when to wait, when to fail fast: a pure state machine, time and chance are arguments.
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { Supervisor } from '../../src/client/connection/supervisor'
import { ConnectionError } from '../../src/errors'

const reason = new ConnectionError('CONNECT_FAILED', 'no route')
const options = { first: 500, longest: 30_000, settleGap: 50, random: () => 0 }

function supervisor(given: Partial<typeof options> = {}) {
  return new Supervisor({ ...options, ...given })
}

/** A supervisor whose connection has lived for `ms` since 0. */
function connectedFor(ms: number, given: Partial<typeof options> = {}) {
  const found = supervisor(given)
  found.want()
  found.connected(0)
  found.lost(reason, ms)
  return found
}

describe('the first connection', () => {
  test('is not made before somebody wants it, and once only', () => {
    const found = supervisor()
    expect([found.name, found.attempt, found.hopeful, found.timeout(1e9)]).toEqual(['idle', 0, true, false])
    expect([found.want(), found.want()]).toEqual([true, false])
    expect([found.name, found.attempt, found.hopeful]).toEqual(['connecting', 1, true])
    found.connected(10)
    expect([found.name, found.attempt, found.error, found.want()]).toEqual(['connected', 0, undefined, false])
  })

  test('failing leaves no hope: requests fail at once until there is a connection', () => {
    const found = supervisor()
    found.want()
    found.lost(reason, 1000)
    expect([found.name, found.error, found.hopeful]).toEqual(['waiting', reason, false])
    expect(found.timeout(found.nextAttempt as number)).toBe(true)
    expect([found.name, found.attempt, found.hopeful, found.error]).toEqual(['connecting', 2, false, reason])
    found.connected(5000)
    expect([found.hopeful, found.error, found.attempt]).toEqual([false, undefined, 0])
  })
})

describe('the pauses', () => {
  /** The pauses between attempts that all fail. */
  function pauses(count: number, given: Partial<typeof options> = {}): number[] {
    const found = supervisor(given)
    found.want()
    const waited: number[] = []
    for (let now = 0; waited.length < count; ) {
      found.lost(reason, now)
      const next = found.nextAttempt as number
      waited.push(next - now)
      expect(found.timeout(next - 0.01)).toBe(false)
      expect(found.timeout(next)).toBe(true)
      now = next
    }
    return waited
  }

  test('are doubled up to the longest, with at most half of them left to chance', () => {
    expect(pauses(9)).toEqual([250, 500, 1000, 2000, 4000, 8000, 15_000, 15_000, 15_000])
    expect(pauses(9, { random: () => 1 })).toEqual([500, 1000, 2000, 4000, 8000, 16_000, 30_000, 30_000, 30_000])
  })

  test('are within their bounds whatever chance says, for ever', () => {
    fc.assert(
      fc.property(fc.infiniteStream(fc.double({ min: 0, max: 0.999, noNaN: true })), (chance) => {
        for (const pause of pauses(60, { random: () => chance.next().value ?? 0 })) {
          expect(pause).toBeGreaterThanOrEqual(250)
          expect(pause).toBeLessThanOrEqual(30_000)
        }
      }),
      { numRuns: 50 },
    )
  })

  test('are never shorter than the settle gap, nor than what the loss demands', () => {
    expect(pauses(1, { settleGap: 400 })).toEqual([400])
    const found = connectedFor(60_000)
    expect(found.nextAttempt).toBe(60_050)
    const demanding = supervisor()
    demanding.want()
    demanding.connected(0)
    demanding.lost(reason, 60_000, 3000)
    expect([demanding.nextAttempt, demanding.hopeful]).toEqual([63_000, true])
  })
})

describe('a connection that was lost', () => {
  test('after it had lived for a while is made again after the settle gap, and requests wait for it', () => {
    const found = connectedFor(5000)
    expect([found.name, found.attempt, found.nextAttempt, found.hopeful]).toEqual(['waiting', 0, 5050, true])
    expect([found.timeout(5050), found.hopeful]).toEqual([true, true])
    found.lost(reason, 5060)
    expect(found.hopeful).toBe(false)
  })

  test('right after it was made is made again after the first pause, and requests fail fast', () => {
    const found = connectedFor(4999)
    expect([found.attempt, found.nextAttempt, found.hopeful]).toEqual([1, 5249, false])
  })

  /** The pauses of connections that are made and lost at once. */
  function flapping(count: number, useful: boolean): number[] {
    const found = supervisor()
    found.want()
    let now = 0
    return Array.from({ length: count }, () => {
      found.connected(now)
      if (useful) found.proved()
      found.lost(reason, now)
      const pause = (found.nextAttempt as number) - now
      now += pause
      found.timeout(now)
      return pause
    })
  }

  test('again and again with nothing to show for it is tried less and less often', () => {
    expect(flapping(8, false)).toEqual([250, 500, 1000, 2000, 4000, 8000, 15_000, 15_000])
  })

  test('again and again, but having answered requests, keeps the first pause, and requests wait for it', () => {
    expect(flapping(4, true)).toEqual([250, 250, 250, 250])
    const found = supervisor()
    found.want()
    found.connected(0)
    found.proved()
    found.lost(reason, 1)
    expect([found.attempt, found.hopeful, found.nextAttempt]).toEqual([0, true, 251])
    expect([found.timeout(251), found.hopeful]).toEqual([true, true])
    found.lost(reason, 252)
    expect(found.hopeful).toBe(false)
  })
})

test('closed is the end', () => {
  const found = connectedFor(60_000)
  found.close()
  expect([found.name, found.nextAttempt, found.timeout(1e9), found.want()]).toEqual(['closed', undefined, false, false])
  found.lost(reason, 1e9)
  expect([found.name, found.nextAttempt, found.hopeful]).toEqual(['closed', undefined, false])
})
