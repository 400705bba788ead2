// What happens one after the other on one connection: answers are given in the order of the requests, also when one of
// them takes its time.
import type { Clock } from '../transport/clock'

export type Step =
  | { readonly wait: number }
  /** The steps it returns come before the ones that follow. */
  | { readonly act: () => readonly Step[] }

interface Job<Subject> {
  readonly subject: Subject
  readonly steps: Step[]
}

export class Sequence<Subject> {
  readonly #clock: Clock
  readonly #counted: (change: number) => void
  #jobs: Job<Subject>[] = []
  #running = false
  #closed = false
  #cancel: (() => void) | undefined

  /** `counted` is told how the number of unfinished jobs changes. */
  constructor(clock: Clock, counted: (change: number) => void) {
    this.#clock = clock
    this.#counted = counted
  }

  push(subject: Subject, steps: readonly Step[]): void {
    if (this.#closed) return
    this.#jobs.push({ subject, steps: [...steps] })
    this.#counted(1)
    this.#run()
  }

  /** Forgets unfinished jobs, also the one that waits at the moment. Returns how many. */
  drop(which: (subject: Subject) => boolean): number {
    const first = this.#jobs[0]
    const kept = this.#jobs.filter(({ subject }) => !which(subject))
    const dropped = this.#jobs.length - kept.length
    this.#jobs = kept
    this.#counted(-dropped)
    if (dropped > 0 && kept[0] !== first) this.#endWait()
    this.#run()
    return dropped
  }

  close(): void {
    this.#closed = true
    this.#counted(-this.#jobs.length)
    this.#jobs = []
    this.#endWait()
  }

  #endWait(): void {
    this.#cancel?.()
    this.#cancel = undefined
  }

  #run(): void {
    if (this.#running || this.#cancel !== undefined) return
    this.#running = true
    try {
      while (this.#next()) {}
    } finally {
      this.#running = false
    }
  }

  /** Whether to go on at once. */
  #next(): boolean {
    const job = this.#jobs[0]
    if (job === undefined) return false
    const step = job.steps.shift()
    if (step === undefined) {
      this.#jobs.shift()
      this.#counted(-1)
      return true
    }
    if ('act' in step) {
      job.steps.unshift(...step.act())
      return true
    }
    if (step.wait <= 0) return true
    this.#cancel = this.#clock.timer(step.wait, () => {
      this.#cancel = undefined
      this.#run()
    })
    return false
  }
}
