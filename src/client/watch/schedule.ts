/**
 * When what is watched is read. Time is an argument, in milliseconds that never jump back; nothing here reads anything.
 *
 * The instants of all rates lie on one grid: those of 100 ms and of 1000 ms fall together each second, so that they can be
 * read together. An instant that finds the scan before it under way is skipped and counted: nothing drifts, nothing piles up.
 */

interface Row {
  readonly every: number
  /** When it is read next. */
  due: number
  /** Not at an instant of its own, but as soon as can be. */
  atOnce: boolean
  /** Its scan is under way. */
  busy: boolean
  /** Instants that were skipped and not told yet. */
  late: number
}

/** One that is to be read now. */
export interface Turn<G> {
  readonly group: G
  /** Instants that were skipped before this one. */
  readonly late: number
}

export class Schedule<G> {
  readonly #epoch: number
  readonly #rows = new Map<G, Row>()

  /** @param epoch where the grid begins */
  constructor(epoch: number) {
    this.#epoch = epoch
  }

  get size(): number {
    return this.#rows.size
  }

  /** Read at once, and from then on at each instant of its rate; the first of them is at least half a period away. */
  add(group: G, every: number, now: number): void {
    this.#rows.set(group, { every, due: now, atOnce: true, busy: false, late: 0 })
  }

  remove(group: G): void {
    this.#rows.delete(group)
  }

  /** When the next one is due; `Infinity` when none is, before one that is under way has ended. */
  get next(): number {
    let next = Number.POSITIVE_INFINITY
    for (const { busy, due } of this.#rows.values()) if (!busy && due < next) next = due
    return next
  }

  /** Those whose time has come. They are under way until `done`. */
  take(now: number): Turn<G>[] {
    const turns: Turn<G>[] = []
    for (const [group, row] of this.#rows) {
      if (row.busy || row.due > now) continue
      // Of several instants that have passed, as after a time in which the program stood still, the last one is kept.
      row.late += Math.max(0, this.#instants(row, now) - 1)
      turns.push({ group, late: row.late })
      row.late = 0
      row.busy = true
      row.due = row.atOnce ? this.#away(row.every, now) : this.#following(row.every, now)
      row.atOnce = false
    }
    return turns
  }

  /** Its scan has ended: instants that passed meanwhile are skipped. */
  done(group: G, now: number): void {
    const row = this.#rows.get(group)
    if (row === undefined) return
    row.busy = false
    row.late += this.#skip(row, now)
  }

  /** Everything is due at once. @returns instants that passed of each until now: nobody was to read then */
  hurry(now: number): Map<G, number> {
    const passed = new Map<G, number>()
    for (const [group, row] of this.#rows) {
      if (row.busy) continue
      passed.set(group, this.#skip(row, now))
      row.due = now
      row.atOnce = true
    }
    return passed
  }

  #skip(row: Row, now: number): number {
    const passed = this.#instants(row, now)
    if (passed > 0) row.due = this.#following(row.every, now)
    return passed
  }

  /** Instants from the one that is due until now. */
  #instants({ every, due }: Row, now: number): number {
    return due > now ? 0 : this.#index(every, now) - this.#index(every, due) + 1
  }

  #following(every: number, now: number): number {
    return this.#at(every, this.#index(every, now) + 1)
  }

  /** The first instant that is at least half a period away. */
  #away(every: number, now: number): number {
    const next = this.#following(every, now)
    return next - now < every / 2 ? this.#following(every, next) : next
  }

  /** Of the last instant that is not later. */
  #index(every: number, now: number): number {
    const index = Math.floor((now - this.#epoch) / every)
    // What a division rounds must not make an instant later than the time it was made of.
    return this.#at(every, index + 1) <= now ? index + 1 : index
  }

  #at(every: number, index: number): number {
    return this.#epoch + index * every
  }
}
