// How long this peer takes for an answer: the smoothed round trip and its deviation, smoothed as TCP does (RFC 6298).

const SMOOTHING = 1 / 8
const DEVIATION_SMOOTHING = 1 / 4
const DEVIATIONS = 2

/** It outlives a session: the peer is the same after a reconnection. */
export class RoundTrips {
  #mean: number | undefined
  #deviation = 0

  /** ms from sending to the answer */
  add(roundTrip: number): void {
    if (this.#mean === undefined) {
      this.#mean = roundTrip
      return
    }
    this.#deviation += DEVIATION_SMOOTHING * (Math.abs(this.#mean - roundTrip) - this.#deviation)
    this.#mean += SMOOTHING * (roundTrip - this.#mean)
  }

  /** About how long an answer takes, ms; `undefined` before the first one. */
  get usual(): number | undefined {
    return this.#mean
  }

  /** How long an answer takes at most, but for rare ones, ms; 0 before the first one. */
  get long(): number {
    return this.#mean === undefined ? 0 : this.#mean + DEVIATIONS * this.#deviation
  }
}
