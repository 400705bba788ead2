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
  /** In the order of the priorities. */
  readonly #lanes = PRIORITIES.map(() => ({ queue: new Queue<J>(), inARow: 0 }))
  #size = 0

  get size(): number {
    return this.#size
  }

  add(job: J): void {
    this.#queueOf(job)?.add(job)
    this.#size += 1
  }

  /** The one whose turn it is. */
  peek(): J | undefined {
    return this.#lanes[this.#next()]?.queue.first
  }

  /** Takes the one that `peek` shows. */
  take(): J | undefined {
    const rank = this.#next()
    const lane = this.#lanes[rank]
    if (lane === undefined) return undefined
    const job = lane.queue.take()
    this.#size -= 1
    for (let higher = 0; higher < rank; higher++) {
      const passed = this.#lanes[higher]
      if (passed !== undefined) passed.inARow = 0
    }
    // `inARow` counts how many of the priority went while a lower one waited.
    if (this.#lowerWaits(rank)) lane.inARow += 1
    return job
  }

  /** @returns whether it was waiting */
  remove(job: J): boolean {
    const wasThere = this.#queueOf(job)?.remove(job) ?? false
    if (wasThere) this.#size -= 1
    return wasThere
  }

  *[Symbol.iterator](): Generator<J> {
    for (const { queue } of this.#lanes) yield* queue
  }

  /** Everything that waits, in the order of the priorities; nothing waits then. */
  clear(): J[] {
    const all = [...this]
    for (const { queue } of this.#lanes) queue.clear()
    this.#size = 0
    return all
  }

  #queueOf({ priority = 'read' }: J): Queue<J> | undefined {
    return this.#lanes[PRIORITIES.indexOf(priority)]?.queue
  }

  /** Rank of the priority whose turn it is; -1 when nothing waits. */
  #next(): number {
    if (this.#size === 0) return -1
    return this.#lanes.findIndex(
      ({ queue, inARow }, rank) => queue.size > 0 && (inARow < IN_A_ROW || !this.#lowerWaits(rank)),
    )
  }

  #lowerWaits(rank: number): boolean {
    let waiting = this.#size
    for (let at = 0; at <= rank; at++) waiting -= this.#lanes[at]?.queue.size ?? 0
    return waiting > 0
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
