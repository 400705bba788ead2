// Whose request goes next: control and writes before reads before polls, PLCs and callers in turn, nothing before its
// time, and nobody starves. Time is an argument; nothing here knows what a request says.

/** What goes before what, the first one first. */
export const PRIORITIES = ['control', 'read', 'poll'] as const

/** `control`: writes and remote control. `poll`: reads that are repeated anyway. */
export type Priority = (typeof PRIORITIES)[number]

/** What the scheduler needs to know of a request. */
export interface Scheduled {
  /** Default `read`. */
  readonly priority?: Priority
  /** Which PLC it is for, where several share a line: they take turns. */
  readonly plc?: unknown
  /**
   * Who asks: requests of one caller to one PLC wait for one another, and callers take turns. Without it a request is a
   * caller of its own.
   */
  readonly caller?: unknown
  /** It does not go before this time: a pause that the line or the PLC needs. What is ready goes ahead of it. */
  readonly notBefore?: number
}

/** So many of higher priorities may go in front of one that waits; then it goes, the higher one first where it is several. */
const IN_A_ROW = 8

export class Scheduler<J extends Scheduled> {
  /** In the order of the priorities. `passed`: how many of higher ones went since one of this lane waits. */
  readonly #lanes = PRIORITIES.map(() => ({ queue: new Queue<J>(), passed: 0 }))
  /** The only one that waits, outside the queues: between the requests of most programs nothing does, and it goes at once. */
  #only: J | undefined
  #size = 0
  /** How many of them have a time before which they do not go. */
  #timed = 0

  get size(): number {
    return this.#size
  }

  add(job: J): void {
    if (this.#size === 0) this.#only = job
    else {
      this.#queueOnly()
      this.#queueOf(job)?.add(job)
    }
    this.#count(job, 1)
  }

  #queueOnly(): void {
    const only = this.#only
    this.#only = undefined
    if (only !== undefined) this.#queueOf(only)?.add(only)
  }

  /** The one whose turn it is; `undefined` when none may go yet. */
  peek(now: number): J | undefined {
    if (this.#size === 0) return undefined
    if (this.#only !== undefined) return mayGo(this.#only, now) ? this.#only : undefined
    return this.#lanes[this.#next(now)]?.queue.first(now)
  }

  /** Takes the one that `peek` shows. */
  take(now: number): J | undefined {
    const only = this.#only
    if (only !== undefined) return mayGo(only, now) ? this.#takeOnly(only) : undefined
    const rank = this.#next(now)
    const lane = this.#lanes[rank]
    const job = lane?.queue.take(now)
    if (lane === undefined || job === undefined) return undefined
    this.#count(job, -1)
    lane.passed = 0
    this.#passLower(rank, now)
    return job
  }

  #takeOnly(job: J): J {
    this.#only = undefined
    this.#count(job, -1)
    for (const lane of this.#lanes) lane.passed = 0
    return job
  }

  /** One of this rank goes in front of all that wait in lower lanes. */
  #passLower(rank: number, now: number): void {
    for (let at = rank + 1; at < this.#lanes.length; at++) {
      const lane = this.#lanes[at]
      if (lane !== undefined) lane.passed = this.#waits(lane.queue, now) ? lane.passed + 1 : 0
    }
  }

  /** When the first of those may go that may not yet; `undefined` when there is none. */
  due(now: number): number | undefined {
    if (this.#timed === 0) return undefined
    let due: number | undefined
    for (const { notBefore } of this) {
      if (notBefore !== undefined && notBefore > now && (due === undefined || notBefore < due)) due = notBefore
    }
    return due
  }

  /** @returns whether it was waiting */
  remove(job: J): boolean {
    const wasOnly = this.#only === job
    if (wasOnly) this.#only = undefined
    const wasThere = wasOnly || (this.#queueOf(job)?.remove(job) ?? false)
    if (wasThere) this.#count(job, -1)
    return wasThere
  }

  *[Symbol.iterator](): Generator<J> {
    if (this.#only !== undefined) yield this.#only
    for (const { queue } of this.#lanes) yield* queue
  }

  /** Everything that waits, in the order of the priorities; nothing waits then. */
  clear(): J[] {
    const all = [...this]
    for (const { queue } of this.#lanes) queue.clear()
    this.#only = undefined
    this.#size = 0
    this.#timed = 0
    return all
  }

  #count({ notBefore }: J, by: 1 | -1): void {
    this.#size += by
    if (notBefore !== undefined) this.#timed += by
  }

  #queueOf(job: J): Queue<J> | undefined {
    return this.#lanes[rankOf(job)]?.queue
  }

  /** Rank of the priority whose turn it is; -1 when nothing may go. */
  #next(now: number): number {
    let first = -1
    for (let rank = 0; rank < this.#lanes.length; rank++) {
      const lane = this.#lanes[rank]
      if (lane === undefined || !this.#waits(lane.queue, now)) continue
      if (first < 0) first = rank
      else if (lane.passed >= IN_A_ROW) return rank
    }
    return first
  }

  /** Whether anything in it may go. */
  #waits(queue: Queue<J>, now: number): boolean {
    return queue.size > 0 && (this.#timed === 0 || queue.first(now) !== undefined)
  }
}

/** A line of those who wait in turn: who was served goes to its end, however much they have asked for. */
interface Waiting<J> {
  readonly size: number
  /** The first one that may go. */
  first(now: number): J | undefined
  take(now: number): J | undefined
  add(job: J): void
  remove(job: J): boolean
  [Symbol.iterator](): Iterator<J>
}

/** PLCs in turn, and the callers of each. */
class Queue<J extends Scheduled> {
  #row = this.#plcs()

  #plcs(): InTurn<J> {
    return new InTurn<J>(plcOf, () => new InTurn<J>(callerOf, () => new InOrder<J>()))
  }

  get size(): number {
    return this.#row.size
  }

  first(now: number): J | undefined {
    return this.#row.first(now)
  }

  take(now: number): J | undefined {
    return this.#row.take(now)
  }

  add(job: J): void {
    this.#row.add(job)
  }

  remove(job: J): boolean {
    return this.#row.remove(job)
  }

  clear(): void {
    this.#row = this.#plcs()
  }

  [Symbol.iterator](): Iterator<J> {
    return this.#row[Symbol.iterator]()
  }
}

class InTurn<J extends Scheduled> implements Waiting<J> {
  /** In the order of their turns. */
  readonly #row = new Map<unknown, Waiting<J>>()
  readonly #nameOf: (job: J) => unknown
  readonly #make: () => Waiting<J>
  #size = 0

  constructor(nameOf: (job: J) => unknown, make: () => Waiting<J>) {
    this.#nameOf = nameOf
    this.#make = make
  }

  get size(): number {
    return this.#size
  }

  first(now: number): J | undefined {
    for (const waiting of this.#row.values()) {
      const job = waiting.first(now)
      if (job !== undefined) return job
    }
    return undefined
  }

  take(now: number): J | undefined {
    for (const [name, waiting] of this.#row) {
      const job = waiting.take(now)
      if (job === undefined) continue
      this.#row.delete(name)
      if (waiting.size > 0) this.#row.set(name, waiting)
      this.#size -= 1
      return job
    }
    return undefined
  }

  add(job: J): void {
    const name = this.#nameOf(job)
    const waiting = this.#row.get(name) ?? this.#make()
    waiting.add(job)
    this.#row.set(name, waiting)
    this.#size += 1
  }

  remove(job: J): boolean {
    const name = this.#nameOf(job)
    const waiting = this.#row.get(name)
    if (waiting?.remove(job) !== true) return false
    if (waiting.size === 0) this.#row.delete(name)
    this.#size -= 1
    return true
  }

  *[Symbol.iterator](): Generator<J> {
    for (const waiting of this.#row.values()) yield* waiting
  }
}

/** Of one caller: one after another, also when the first of them may not go yet. */
class InOrder<J extends Scheduled> implements Waiting<J> {
  readonly #jobs: J[] = []

  get size(): number {
    return this.#jobs.length
  }

  first(now: number): J | undefined {
    const [job] = this.#jobs
    return job !== undefined && mayGo(job, now) ? job : undefined
  }

  take(now: number): J | undefined {
    return this.first(now) === undefined ? undefined : this.#jobs.shift()
  }

  add(job: J): void {
    this.#jobs.push(job)
  }

  remove(job: J): boolean {
    const at = this.#jobs.indexOf(job)
    if (at < 0) return false
    this.#jobs.splice(at, 1)
    return true
  }

  [Symbol.iterator](): Iterator<J> {
    return this.#jobs[Symbol.iterator]()
  }
}

/** Where its priority stands among them. */
function rankOf({ priority = 'read' }: Scheduled): number {
  return PRIORITIES.indexOf(priority)
}

function mayGo({ notBefore = Number.NEGATIVE_INFINITY }: Scheduled, now: number): boolean {
  return notBefore <= now
}

function plcOf(job: Scheduled): unknown {
  return job.plc
}

function callerOf(job: Scheduled): unknown {
  return job.caller ?? job
}
