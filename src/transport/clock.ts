/** Time as a parameter: the real one here, one made of numbers in tests. */

export interface TimerOptions {
  /** The timer does not keep the process alive. Default: it does. */
  readonly unref?: boolean | undefined
}

/** Time: the real one, or one that a test turns. */
export interface Clock {
  /** Monotonic milliseconds: for deadlines and durations. Never jumps, has no meaning by itself. */
  now(): number
  /** Milliseconds since 1970: for time stamps that people read. Jumps when somebody sets the computer's clock. */
  time(): number
  /**
   * Runs `run` once when at least `ms` have passed by `now()`, never from inside this call.
   * Returns what cancels it (harmless afterwards). `Infinity` never runs; less than 0 counts as 0.
   */
  timer(ms: number, run: () => void, options?: TimerOptions): () => void
}

/** `setTimeout` fires at once for anything longer. */
const LONGEST_TIMEOUT = 2 ** 31 - 1

export const realClock: Clock = {
  now: () => performance.now(),
  time: () => Date.now(),
  timer(ms, run, options) {
    const due = performance.now() + checkDuration(ms)
    if (due === Number.POSITIVE_INFINITY) return () => {}
    let handle: NodeJS.Timeout
    const arm = (left: number) => {
      handle = setTimeout(fire, Math.min(Math.ceil(left), LONGEST_TIMEOUT))
      if (options?.unref) handle.unref()
    }
    // Node counts timers in whole milliseconds of its own and can be a fraction early by performance.now(); a deadline
    // checked with now() would then not have passed yet.
    const fire = () => {
      const left = due - performance.now()
      if (left > 0) arm(left)
      else run()
    }
    arm(Math.max(0, ms))
    return () => clearTimeout(handle)
  },
}

function checkDuration(ms: number): number {
  if (Number.isNaN(ms)) throw new RangeError('a timer needs a number of milliseconds, not NaN')
  return Math.max(0, ms)
}
