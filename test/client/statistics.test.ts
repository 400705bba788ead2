import { describe, expect, test } from '@jest/globals'
import { Counters } from '../../src/client/connection/statistics'

describe('counters', () => {
  test('start at 0, count, and show what waits at the moment', () => {
    const counters = new Counters()
    expect(counters.read(2, 1)).toEqual({
      requests: 0,
      answered: 0,
      refused: 0,
      timeouts: 0,
      overloaded: 0,
      aborted: 0,
      protocolErrors: 0,
      stale: 0,
      unsolicited: 0,
      connects: 0,
      disconnects: 0,
      bytesSent: 0,
      bytesReceived: 0,
      queued: 2,
      inFlight: 1,
      roundTrip: undefined,
    })
    counters.counts.requests += 1
    counters.counts.bytesSent += 21
    counters.counts.bytesSent += 21
    expect(counters.read(0, 0)).toMatchObject({ requests: 1, bytesSent: 42, queued: 0, inFlight: 0 })
  })

  test('what was read does not change afterwards', () => {
    const counters = new Counters()
    const before = counters.read(0, 0)
    counters.counts.requests += 1
    counters.roundTrip(5)
    expect([before.requests, before.roundTrip]).toEqual([0, undefined])
  })
})

describe('round trips', () => {
  const read = (times: readonly number[]) => {
    const counters = new Counters()
    for (const ms of times) counters.roundTrip(ms)
    return counters.read(0, 0).roundTrip
  }

  test('one answer', () => {
    expect(read([7.5])).toEqual({ count: 1, last: 7.5, min: 7.5, mean: 7.5, p50: 7.5, p95: 7.5, p99: 7.5, max: 7.5 })
  })

  test('percentiles by nearest rank, whatever the order of arrival', () => {
    const hundred = Array.from({ length: 100 }, (_, i) => ((i * 37) % 100) + 1)
    expect(read(hundred)).toMatchObject({ count: 100, min: 1, mean: 50.5, p50: 50, p95: 95, p99: 99, max: 100 })
    expect(read([2, 1])).toMatchObject({ last: 1, p50: 1, p95: 2, p99: 2 })
    expect(read([3, 1, 2])).toMatchObject({ last: 2, p50: 2, p95: 3 })
    // Numbers are sorted as numbers.
    expect(read([10, 9, 100])).toMatchObject({ min: 9, p50: 10, max: 100 })
  })

  test('only the latest 1024 are kept', () => {
    const times = Array.from({ length: 5000 }, (_, i) => i)
    expect(read(times)).toMatchObject({ count: 1024, last: 4999, min: 5000 - 1024, max: 4999 })
  })
})
