/** Numbers from a seed: fast, and the same again for the same seed and place. */
export class Random {
  #state = 1

  /** Begins again at `place` of the sequence `seed` stands for, so that one frame can be made again by itself. */
  restart(seed: number, place: number): void {
    let state = (Math.imul(seed, 0x9e3779b1) ^ Math.imul(place + 1, 0x85ebca77)) >>> 0
    state = Math.imul(state ^ (state >>> 16), 0x7feb352d)
    state = Math.imul(state ^ (state >>> 15), 0x846ca68b)
    this.#state = (state ^ (state >>> 16)) >>> 0 || 1
  }

  /** 0 to 4294967295. */
  next(): number {
    let x = this.#state
    x ^= x << 13
    x ^= x >>> 17
    x ^= x << 5
    this.#state = x >>> 0
    return this.#state
  }

  /** 0 to `end` - 1. */
  below(end: number): number {
    return end <= 1 ? 0 : this.next() % end
  }

  oneIn(times: number): boolean {
    return this.below(times) === 0
  }

  pick<T>(list: readonly T[]): T {
    const picked = list[this.below(list.length)]
    if (picked === undefined) throw new Error('nothing to pick from')
    return picked
  }
}
