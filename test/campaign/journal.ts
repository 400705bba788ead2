/** The last things that happened between one client and its PLC: the story of a violation. */
const KEPT = 120

interface Entry {
  readonly time: number
  readonly text: string
  readonly bytes: Uint8Array | undefined
}

export class Journal {
  #entries: Entry[] = []

  add(text: string, bytes?: Uint8Array): void {
    this.#entries.push({ time: performance.now(), text, bytes })
    if (this.#entries.length > 2 * KEPT) this.#entries = this.#entries.slice(-KEPT)
  }

  /** What happened since, oldest first. */
  since(time: number): string[] {
    const entries = this.#entries.filter((entry) => entry.time >= time)
    return entries.slice(-KEPT).map(({ time: at, text, bytes }) => {
      const hex = bytes === undefined ? '' : ` ${Buffer.from(bytes.subarray(0, 120)).toString('hex')}`
      return `${at.toFixed(1)} ${text}${hex}`
    })
  }
}
