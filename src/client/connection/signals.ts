/**
 * Who is to be told when a signal is aborted. One listener per signal, however many calls share it: Node.js warns of a
 * leak from the eleventh listener on, and one read of many items makes more calls than that.
 */
export class Signals {
  readonly #watched = new Map<AbortSignal, Set<() => void>>()

  /** @returns what ends it; harmless afterwards. */
  watch(signal: AbortSignal, onAbort: () => void): () => void {
    const told = this.#watched.get(signal) ?? this.#listen(signal)
    told.add(onAbort)
    return () => {
      told.delete(onAbort)
      if (told.size > 0 || this.#watched.get(signal) !== told) return
      this.#watched.delete(signal)
      signal.removeEventListener('abort', this.#aborted)
    }
  }

  #listen(signal: AbortSignal): Set<() => void> {
    const told = new Set<() => void>()
    this.#watched.set(signal, told)
    signal.addEventListener('abort', this.#aborted, { once: true })
    return told
  }

  readonly #aborted = (event: Event): void => {
    for (const [signal, told] of this.#watched) {
      if (signal !== event.target) continue
      this.#watched.delete(signal)
      for (const onAbort of [...told]) onAbort()
    }
  }
}
