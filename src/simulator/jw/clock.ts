// The clock of a simulated JW: local time, set apart from that of the computer, and stopped when somebody says so.

/** ms since 1970, as if local time were UTC. */
type LocalTime = number

export interface ClockDate {
  /** Of the century. */
  readonly year: number
  readonly month: number
  readonly day: number
  /** 0 Sunday to 6 Saturday. */
  readonly dayOfWeek: number
}

export interface ClockTime {
  readonly hour: number
  readonly minute: number
  readonly second: number
}

const CONTROL = { stop: 1, belowSecond: 2, toMinute: 8 } as const
const MINUTE = 60_000
const WEEK = 7
const CENTURY = 2000

export class PlcClock {
  readonly #time: () => number
  /** What is added to the time of the computer. */
  #offset = 0
  /** What it shows while it is stopped. */
  #stoppedAt: LocalTime | undefined
  /** Days of the week by which it was set off the calendar. */
  #weekShift = 0

  /** @param time ms since 1970 */
  constructor(time: () => number) {
    this.#time = time
  }

  get date(): ClockDate {
    const now = new Date(this.#now)
    return {
      year: now.getUTCFullYear() % 100,
      month: now.getUTCMonth() + 1,
      day: now.getUTCDate(),
      dayOfWeek: (now.getUTCDay() + this.#weekShift) % WEEK,
    }
  }

  get time(): ClockTime {
    const now = new Date(this.#now)
    return { hour: now.getUTCHours(), minute: now.getUTCMinutes(), second: now.getUTCSeconds() }
  }

  /** `false`: there is no such day. */
  setDate({ year, month, day, dayOfWeek }: ClockDate): boolean {
    const date = new Date(Date.UTC(CENTURY + year, month - 1, day))
    if (date.getUTCMonth() !== month - 1 || date.getUTCDate() !== day) return false
    const DAY = 24 * 60 * MINUTE
    this.#set(date.getTime() + (this.#now % DAY))
    this.#weekShift = (dayOfWeek - date.getUTCDay() + WEEK) % WEEK
    return true
  }

  setTime({ hour, minute, second }: ClockTime, control: number): void {
    const day = new Date(this.#now)
    this.#set(day.setUTCHours(hour, minute, second, day.getUTCMilliseconds()))
    this.correct(control)
  }

  /** 0000A0RS: A to the nearer whole minute, R to the whole second, S stops it; without S it runs. */
  correct(control: number): void {
    const now = this.#now
    if ((control & CONTROL.toMinute) !== 0) this.#set(Math.floor(now / MINUTE + 0.5) * MINUTE)
    else if ((control & CONTROL.belowSecond) !== 0) this.#set(Math.floor(now / 1000) * 1000)
    this.#run((control & CONTROL.stop) === 0)
  }

  get #now(): LocalTime {
    return this.#stoppedAt ?? this.#computer + this.#offset
  }

  get #computer(): LocalTime {
    const ms = this.#time()
    return ms - new Date(ms).getTimezoneOffset() * MINUTE
  }

  #set(to: LocalTime): void {
    if (this.#stoppedAt === undefined) this.#offset = to - this.#computer
    else this.#stoppedAt = to
  }

  #run(on: boolean): void {
    const now = this.#now
    this.#stoppedAt = on ? undefined : now
    if (on) this.#offset = now - this.#computer
  }
}
