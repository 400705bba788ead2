// What fails again and again is tried rarely: pauses that grow up to a longest one, and end with the first success.

export interface DemotionRules {
  /** Failures in a row. */
  readonly after: number
  /** First pause, ms. Doubled each time. */
  readonly first: number
  readonly longest: number
}

export class Demotion {
  readonly #rules: DemotionRules
  #failures = 0
  #pause = 0
  #next = 0

  constructor(rules: DemotionRules) {
    this.#rules = rules
  }

  get isFailing(): boolean {
    return this.#failures > 0
  }

  get isDemoted(): boolean {
    return this.#failures >= this.#rules.after
  }

  /** While it is demoted: when it is tried again. */
  get next(): number {
    return this.#next
  }

  /** @returns whether it is demoted from now on */
  failed(now: number): boolean {
    const was = this.isDemoted
    this.#failures += 1
    if (!this.isDemoted) return false
    this.#pause = was
      ? Math.min(2 * this.#pause, this.#rules.longest)
      : Math.min(this.#rules.first, this.#rules.longest)
    this.#next = now + this.#pause
    return !was
  }

  /** @returns whether it was demoted until now */
  worked(): boolean {
    const was = this.isDemoted
    this.#failures = 0
    return was
  }
}
