import { afterEach, describe, expect, jest, test } from '@jest/globals'
import fc from 'fast-check'
import { realClock } from '../../src/transport/clock'
import { manualClock } from '../support/manual-clock'

describe('the real clock', () => {
  afterEach(() => {
    jest.useRealTimers()
  })

  test('now() never goes back and time() is the time of day', () => {
    const first = realClock.now()
    expect(realClock.now()).toBeGreaterThanOrEqual(first)
    expect(Math.abs(realClock.time() - Date.now())).toBeLessThan(1000)
  })

  test('a timer never runs before its time by now()', async () => {
    for (let i = 0; i < 20; i++) {
      const start = realClock.now()
      await new Promise<void>((resolve) => realClock.timer(1.5, resolve))
      expect(realClock.now() - start).toBeGreaterThanOrEqual(1.5)
    }
  })

  test('a timer never runs from inside the call that makes it', async () => {
    const order: string[] = []
    await new Promise<void>((resolve) => {
      realClock.timer(-5, () => {
        order.push('ran')
        resolve()
      })
      order.push('made')
    })
    expect(order).toEqual(['made', 'ran'])
  })

  test('a cancelled timer does not run, and cancelling again is harmless', async () => {
    let ran = false
    const cancel = realClock.timer(1, () => {
      ran = true
    })
    cancel()
    await new Promise<void>((resolve) => realClock.timer(5, resolve))
    cancel()
    expect(ran).toBe(false)
  })

  test('a timer longer than 2^31 ms waits its full time', () => {
    jest.useFakeTimers()
    let ran = false
    realClock.timer(2 ** 31 + 5000, () => {
      ran = true
    })
    jest.advanceTimersByTime(2 ** 31 + 4000)
    expect(ran).toBe(false)
    jest.advanceTimersByTime(2000)
    expect(ran).toBe(true)
  })

  test('a timer longer than 2^31 ms can be cancelled after its first part', () => {
    jest.useFakeTimers()
    const cancel = realClock.timer(2 ** 31 + 5000, () => {
      throw new Error('ran')
    })
    jest.advanceTimersByTime(2 ** 31)
    cancel()
    expect(jest.getTimerCount()).toBe(0)
  })

  test('Infinity makes no timer, NaN is refused', () => {
    jest.useFakeTimers()
    realClock.timer(Number.POSITIVE_INFINITY, () => {})()
    expect(jest.getTimerCount()).toBe(0)
    expect(() => realClock.timer(Number.NaN, () => {})).toThrow(RangeError)
  })

  test('only an unref timer is not counted among what keeps the process alive', () => {
    const timeouts = () => process.getActiveResourcesInfo().filter((name) => name === 'Timeout').length
    const before = timeouts()
    const cancelUnref = realClock.timer(60_000, () => {}, { unref: true })
    expect(timeouts()).toBe(before)
    const cancel = realClock.timer(60_000, () => {})
    expect(timeouts()).toBe(before + 1)
    cancelUnref()
    cancel()
  })
})

describe('the manual clock', () => {
  test('stands still until it is advanced', () => {
    const clock = manualClock(10, 1000)
    expect([clock.now(), clock.time()]).toEqual([10, 1000])
    clock.advance(5)
    expect([clock.now(), clock.time()]).toEqual([15, 1005])
  })

  test('runs timers in order of time, then of creation, each at its own time', () => {
    const clock = manualClock()
    const log: [string, number][] = []
    clock.timer(30, () => log.push(['c', clock.now()]))
    clock.timer(10, () => log.push(['a', clock.now()]))
    clock.timer(10, () => log.push(['b', clock.now()]))
    clock.timer(31, () => log.push(['later', clock.now()]))
    clock.advance(30)
    expect(log).toEqual([
      ['a', 10],
      ['b', 10],
      ['c', 30],
    ])
    expect(clock.pending).toBe(1)
    expect(clock.untilNext).toBe(1)
  })

  test('runs timers that timers make, when they are due within the same advance', () => {
    const clock = manualClock()
    const log: number[] = []
    const tick = () => {
      log.push(clock.now())
      clock.timer(10, tick)
    }
    clock.timer(10, tick)
    clock.advance(35)
    expect(log).toEqual([10, 20, 30])
    expect(clock.now()).toBe(35)
  })

  test('a timer of 0 ms waits for an advance of 0 ms', () => {
    const clock = manualClock()
    let ran = false
    clock.timer(0, () => {
      ran = true
    })
    expect(ran).toBe(false)
    clock.advance(0)
    expect(ran).toBe(true)
  })

  test('a cancelled timer does not run, also when another timer cancels it at the same time', () => {
    const clock = manualClock()
    const log: string[] = []
    clock.timer(10, () => {
      log.push('first')
      cancelSecond()
    })
    const cancelSecond = clock.timer(10, () => log.push('second'))
    clock.advance(20)
    expect(log).toEqual(['first'])
    expect(clock.pending).toBe(0)
    expect(clock.untilNext).toBeUndefined()
  })

  test('setTime moves the time of day and no timer', () => {
    const clock = manualClock(0, 1000)
    let ran = false
    clock.timer(10, () => {
      ran = true
    })
    clock.setTime(5_000_000)
    expect(clock.time()).toBe(5_000_000)
    expect(clock.now()).toBe(0)
    expect(ran).toBe(false)
    clock.advance(10)
    expect(clock.time()).toBe(5_000_010)
    expect(ran).toBe(true)
  })

  test('advanceAsync lets promises run between timers', async () => {
    const clock = manualClock()
    const log: number[] = []
    const work = async () => {
      for (let i = 0; i < 3; i++) {
        await new Promise<void>((resolve) => clock.timer(10, resolve))
        log.push(clock.now())
      }
    }
    const done = work()
    await clock.advanceAsync(100)
    await done
    expect(log).toEqual([10, 20, 30])
    expect(clock.now()).toBe(100)
  })

  test('a timer that re-arms itself with 0 ms is reported instead of hanging', () => {
    const clock = manualClock()
    const spin = () => void clock.timer(0, spin)
    clock.timer(0, spin)
    expect(() => clock.advance(1)).toThrow('re-arms itself')
  })

  test('refuses to go back or nowhere', () => {
    const clock = manualClock()
    for (const ms of [-1, Number.NaN, Number.POSITIVE_INFINITY]) expect(() => clock.advance(ms)).toThrow(RangeError)
    expect(() => clock.timer(Number.NaN, () => {})).toThrow(RangeError)
    clock.timer(Number.POSITIVE_INFINITY, () => {})
    expect(clock.pending).toBe(0)
  })

  test('any cut of an advance into parts runs the same timers in the same order', () => {
    fc.assert(
      fc.property(
        fc.array(fc.nat(100), { maxLength: 20 }),
        fc.array(fc.nat(50), { minLength: 1, maxLength: 10 }),
        (delays, cuts) => {
          const run = (steps: number[]) => {
            const clock = manualClock()
            const log: string[] = []
            delays.forEach((delay, index) => void clock.timer(delay, () => log.push(`${index}@${clock.now()}`)))
            for (const step of steps) clock.advance(step)
            return log
          }
          expect(run(cuts)).toEqual(run([cuts.reduce((sum, cut) => sum + cut, 0)]))
        },
      ),
    )
  })
})
