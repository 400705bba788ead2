// Whose request goes next: control and writes before reads before polls, callers in turn, and nobody starves.
// Time is an argument; nothing here knows what a request says.

/** What goes before what, the first one first. */
export const PRIORITIES = ['control', 'read', 'poll'] as const

/** `control`: writes and remote control. `poll`: reads that are repeated anyway. */
export type Priority = (typeof PRIORITIES)[number]

/** What the scheduler needs to know of a request. */
export interface Scheduled {
  /** Default `read`. */
  readonly priority?: Priority
  /**
   * Who asks: requests of one caller wait for one another, and callers take turns. Without it a request is a caller of
   * its own.
   */
  readonly caller?: unknown
}

/** So many of a higher priority may go in a row while others wait; then one of those goes. */
const IN_A_ROW = 8

export class Scheduler<J extends Scheduled> {
  readonly #queues = new Map(PRIORITIES.map((priority) => [priority, new Queue<J>()]))
  /** How many of the priority went while a lower one waited. */
  readonly #inARow = new Map<Priority, number>()

  get size(): number {
    let size = 0
    for (const queue of this.#queues.values()) size += queue.size
    return size
  }

  add(job: J): void {
    this.#queues.get(job.priority ?? 'read')?.add(job)
  }

  /** The one whose turn it is. */
  peek(): J | undefined {
    const priority = this.#next()
    return priority && this.#queues.get(priority)?.first
  }

  /** Takes the one that `peek` shows. */
  take(): J | undefined {
    const priority = this.#next()
    if (priority === undefined) return undefined
    const job = this.#queues.get(priority)?.take()
    const before = PRIORITIES.slice(0, PRIORITIES.indexOf(priority))
    for (const higher of before) this.#inARow.set(higher, 0)
    if (this.#lowerWaits(priority)) this.#inARow.set(priority, (this.#inARow.get(priority) ?? 0) + 1)
    return job
  }

  /** @returns whether it was waiting */
  remove(job: J): boolean {
    return this.#queues.get(job.priority ?? 'read')?.remove(job) ?? false
  }

  *[Symbol.iterator](): Generator<J> {
    for (const queue of this.#queues.values()) yield* queue
  }

  /** Everything that waits, in the order of the priorities; nothing waits then. */
  clear(): J[] {
    const all = [...this]
    for (const queue of this.#queues.values()) queue.clear()
    return all
  }

  #next(): Priority | undefined {
    return PRIORITIES.find((priority) => {
      if ((this.#queues.get(priority)?.size ?? 0) === 0) return false
      return (this.#inARow.get(priority) ?? 0) < IN_A_ROW || !this.#lowerWaits(priority)
    })
  }

  #lowerWaits(priority: Priority): boolean {
    const lower = PRIORITIES.slice(PRIORITIES.indexOf(priority) + 1)
    return lower.some((each) => (this.#queues.get(each)?.size ?? 0) > 0)
  }
}

/** Callers in turn: who was served goes to the end of the row, however much it has asked for. */
class Queue<J extends Scheduled> {
  /** By callers, in the order of their turns; a request without a caller is one of its own. */
  readonly #row = new Map<unknown, J[]>()
  #size = 0

  get size(): number {
    return this.#size
  }

  get first(): J | undefined {
    for (const jobs of this.#row.values()) return jobs[0]
    return undefined
  }

  add(job: J): void {
    const jobs = this.#row.get(callerOf(job))
    if (jobs === undefined) this.#row.set(callerOf(job), [job])
    else jobs.push(job)
    this.#size += 1
  }

  take(): J | undefined {
    for (const [caller, jobs] of this.#row) {
      const job = jobs.shift()
      this.#row.delete(caller)
      if (jobs.length > 0) this.#row.set(caller, jobs)
      this.#size -= 1
      return job
    }
    return undefined
  }

  remove(job: J): boolean {
    const jobs = this.#row.get(callerOf(job)) ?? []
    const at = jobs.indexOf(job)
    if (at < 0) return false
    jobs.splice(at, 1)
    if (jobs.length === 0) this.#row.delete(callerOf(job))
    this.#size -= 1
    return true
  }

  clear(): void {
    this.#row.clear()
    this.#size = 0
  }

  *[Symbol.iterator](): Generator<J> {
    for (const jobs of this.#row.values()) yield* jobs
  }
}

function callerOf(job: Scheduled): unknown {
  return job.caller ?? job
}
