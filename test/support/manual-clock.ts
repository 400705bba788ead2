/** A clock made of numbers. */
import type { Clock } from '../../src/transport/clock'

/** A clock that stands still until it is told to advance. */
export interface ManualClock extends Clock {
  /** Moves on by `ms` and runs the timers due on the way, in order of time and then of creation, each at its own time. */
  advance(ms: number): void
  /** As `advance`, and lets promises and I/O callbacks run before the first and after each timer. */
  advanceAsync(ms: number): Promise<void>
  /** Sets `time()` alone, as when somebody sets the computer's clock. */
  setTime(epochMs: number): void
  /** Timers waiting. */
  readonly pending: number
  /** Milliseconds until the next timer, undefined without one. */
  readonly untilNext: number | undefined
}

interface ManualTimer {
  readonly due: number
  readonly run: () => void
}

/** More timers than this in one advance is a timer that re-arms itself without letting time pass. */
const MOST_RUNS = 100_000

/**
 * Makes a clock of numbers.
 * @param start what `now()` says first, in ms
 * @param epoch what `time()` says first, in ms since 1970
 * @example
 * const clock = manualClock()
 * clock.timer(100, () => console.log(clock.now())) // 100
 * clock.advance(250)
 */
export function manualClock(start = 0, epoch = Date.UTC(2024, 0, 1)): ManualClock {
  let now = start
  let timeOffset = epoch - start
  const timers = new Set<ManualTimer>()

  const next = (): ManualTimer | undefined => {
    let first: ManualTimer | undefined
    for (const timer of timers) if (first === undefined || timer.due < first.due) first = timer
    return first
  }
  const runNext = (end: number): boolean => {
    const timer = next()
    if (timer === undefined || timer.due > end) return false
    timers.delete(timer)
    now = Math.max(now, timer.due)
    timer.run()
    return true
  }
  const endOf = (ms: number) => {
    if (!(ms >= 0 && ms < Number.POSITIVE_INFINITY)) throw new RangeError(`cannot advance a clock by ${ms} ms`)
    return now + ms
  }
  const tooMany = () => new Error(`more than ${MOST_RUNS} timers in one advance: a timer re-arms itself with 0 ms`)

  return {
    now: () => now,
    time: () => now + timeOffset,
    timer(ms, run) {
      const due = now + checkDuration(ms)
      if (due === Number.POSITIVE_INFINITY) return () => {}
      const timer = { due, run }
      timers.add(timer)
      return () => void timers.delete(timer)
    },
    advance(ms) {
      const end = endOf(ms)
      for (let runs = 0; runNext(end); runs++) if (runs >= MOST_RUNS) throw tooMany()
      now = end
    },
    async advanceAsync(ms) {
      const end = endOf(ms)
      await turn()
      for (let runs = 0; runNext(end); runs++) {
        if (runs >= MOST_RUNS) throw tooMany()
        await turn()
      }
      now = end
      await turn()
    },
    setTime(epochMs) {
      timeOffset = epochMs - now
    },
    get pending() {
      return timers.size
    },
    get untilNext() {
      const timer = next()
      return timer === undefined ? undefined : timer.due - now
    },
  }
}

function turn(): Promise<void> {
  return new Promise((resolve) => {
    setImmediate(resolve)
  })
}

function checkDuration(ms: number): number {
  if (Number.isNaN(ms)) throw new RangeError('a timer needs a number of milliseconds, not NaN')
  return Math.max(0, ms)
}
