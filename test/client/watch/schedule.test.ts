/** When what is watched is read: hours, stalls and jumps, with time as numbers. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { Schedule } from '../../../src/client/watch/schedule'

const HOUR = 3_600_000

interface Scan {
  readonly group: string
  readonly at: number
  readonly late: number
}

/** Lets time pass in a program that is woken when it asked for it, or later; each scan takes some time. */
function run(
  schedule: Schedule<string>,
  {
    from,
    to,
    lag = () => 0,
    takes = () => 1,
  }: { from: number; to: number; lag?: () => number; takes?: (group: string) => number },
): Scan[] {
  const scans: Scan[] = []
  const ends: { group: string; at: number }[] = []
  let now = from
  for (;;) {
    const end = ends.reduce((first, { at }) => Math.min(first, at), Number.POSITIVE_INFINITY)
    now = Math.max(now, Math.min(end, schedule.next + lag()))
    if (now > to) {
      for (const { group, at } of ends) schedule.done(group, at)
      return scans
    }
    for (const ended of ends.filter(({ at }) => at <= now)) {
      ends.splice(ends.indexOf(ended), 1)
      schedule.done(ended.group, now)
    }
    for (const { group, late } of schedule.take(now)) {
      scans.push({ group, at: now, late })
      ends.push({ group, at: now + takes(group) })
    }
  }
}

const total = (scans: readonly Scan[]) => scans.reduce((sum, { late }) => sum + late, 0)

describe('a rate', () => {
  test('is read at once, and then at its instants: after ten hours nothing has drifted', () => {
    const schedule = new Schedule<string>(0)
    schedule.add('a', 100, 0)
    const scans = run(schedule, { from: 0, to: 10 * HOUR, takes: () => 37 })
    expect(scans).toHaveLength(360_001)
    expect(scans.every(({ at, late }, i) => at === i * 100 && late === 0)).toBe(true)
  })

  test('that begins between two instants has its first one at least half a period later', () => {
    const at = (begin: number) => {
      const schedule = new Schedule<string>(0)
      schedule.add('a', 100, begin)
      return run(schedule, { from: begin, to: 400 }).map((scan) => scan.at)
    }
    expect(at(130)).toEqual([130, 200, 300, 400])
    expect(at(170)).toEqual([170, 300, 400])
  })

  test('skips and counts the instants that pass while its scan is under way', () => {
    const schedule = new Schedule<string>(0)
    schedule.add('a', 100, 0)
    const scans = run(schedule, { from: 0, to: 1000, takes: () => 250 })
    expect(scans).toEqual([
      { group: 'a', at: 0, late: 0 },
      { group: 'a', at: 300, late: 2 },
      { group: 'a', at: 600, late: 2 },
      { group: 'a', at: 900, late: 2 },
    ])
  })

  test('goes on at its instants after the program stood still, and counts those that passed', () => {
    const schedule = new Schedule<string>(0)
    schedule.add('a', 100, 0)
    run(schedule, { from: 0, to: 1000 })
    // Nobody looks for more than two seconds.
    expect(schedule.take(3250)).toEqual([{ group: 'a', late: 21 }])
    schedule.done('a', 3260)
    expect(schedule.next).toBe(3300)
    expect(schedule.take(3300)).toEqual([{ group: 'a', late: 0 }])
  })

  test('counts the instants of a night in which the computer slept, and reads once', () => {
    const schedule = new Schedule<string>(0)
    schedule.add('a', 100, 0)
    run(schedule, { from: 0, to: 1000 })
    expect(schedule.take(8 * HOUR + 1050)).toEqual([{ group: 'a', late: 288_000 - 1 }])
    schedule.done('a', 8 * HOUR + 1060)
    expect(schedule.next).toBe(8 * HOUR + 1100)
  })

  test('has as many scans and skipped ones as instants, whatever the lags and the scans take', () => {
    const ms = fc.integer({ min: 0, max: 700 })
    const program = fc.record({ every: fc.integer({ min: 1, max: 500 }), lags: fc.array(ms), takes: fc.array(ms) })
    fc.assert(
      fc.property(program, ({ every, lags, takes }) => {
        const schedule = new Schedule<string>(0)
        schedule.add('a', every, 0)
        const next = (list: number[]) => () => list.shift() ?? 0
        const scans = run(schedule, { from: 0, to: 20 * every, lag: next([...lags]), takes: next([...takes]) })
        for (const [i, { at, late }] of scans.entries()) {
          // Each scan is of the last instant before it, and no other scan is.
          const before = scans[i - 1]
          // The first one is at no instant, but at once.
          if (before === undefined || i === 1) continue
          expect(Math.floor(at / every) - Math.floor(before.at / every)).toBe(late + 1)
        }
      }),
    )
  })
})

describe('several rates', () => {
  test('fall together, however late they began: that is the fewest instants there can be', () => {
    const schedule = new Schedule<string>(0)
    for (const [i, every] of [100, 200, 500, 1000].entries()) schedule.add(`${every}`, every, 13 * i)
    const scans = run(schedule, { from: 0, to: HOUR }).filter(({ at }) => at >= 2000)
    const instants = new Set(scans.map(({ at }) => at))
    expect(instants.size).toBe((HOUR - 2000) / 100 + 1)
    for (const at of [2000, HOUR]) expect(scans.filter((scan) => scan.at === at)).toHaveLength(4)
  })

  test('do not wait for one that is slow', () => {
    const schedule = new Schedule<string>(0)
    schedule.add('fast', 100, 0)
    schedule.add('slow', 1000, 0)
    const scans = run(schedule, { from: 0, to: HOUR, takes: (group) => (group === 'slow' ? 1500 : 20) })
    expect(total(scans.filter(({ group }) => group === 'fast'))).toBe(0)
    expect(scans.filter(({ group }) => group === 'fast')).toHaveLength(36_001)
    expect(scans.filter(({ group }) => group === 'slow')).toHaveLength(1801)
  })

  test('that are to be read at once tell what passed of each, which nobody was to read', () => {
    const schedule = new Schedule<string>(0)
    schedule.add('a', 100, 0)
    schedule.add('b', 1000, 0)
    run(schedule, { from: 0, to: 500 })
    expect(schedule.hurry(1950)).toEqual(
      new Map([
        ['a', 14],
        ['b', 1],
      ]),
    )
    expect(schedule.take(1950)).toEqual([
      { group: 'a', late: 0 },
      { group: 'b', late: 0 },
    ])
    schedule.done('a', 1955)
    expect(schedule.next).toBe(2000)
  })

  test('that ended are not read any more', () => {
    const schedule = new Schedule<string>(0)
    schedule.add('a', 100, 0)
    schedule.take(0)
    schedule.remove('a')
    schedule.done('a', 5)
    expect([schedule.next, schedule.take(1000)]).toEqual([Number.POSITIVE_INFINITY, []])
  })
})
