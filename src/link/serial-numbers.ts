// The serial numbers of one peer. They outlive a session: over UDP with a fixed local port the answer to a request of
// an earlier connection can still arrive on the next one, and must not meet a request with the same number there.

const SERIALS = 0x10000
/** Numbers of requests without an answer that are not used again soon: their answers may still be on the way. */
const RESTING = 256

export class SerialNumbers {
  #last: number
  #resting: number[] = []

  /** `first`: 0 to 65535, the first number that is given out. A random one tells two programs in a row apart. */
  constructor(first = 1) {
    this.#last = (first + SERIALS - 1) % SERIALS
  }

  /** The next number that is neither in use nor resting. */
  take(inUse: (serial: number) => boolean): number {
    do this.#last = (this.#last + 1) % SERIALS
    while (this.#resting.includes(this.#last) || inUse(this.#last))
    return this.#last
  }

  /** The request was given up, but its answer may still come. */
  rest(serial: number): void {
    this.#resting.push(serial)
    if (this.#resting.length > RESTING) this.#resting.shift()
  }

  /** The late answer has come: the number may be used again. */
  release(serial: number | undefined): void {
    const at = serial === undefined ? -1 : this.#resting.indexOf(serial)
    if (at >= 0) this.#resting.splice(at, 1)
  }
}
