// Whom a client tells what happened.
import { RequestError } from '../errors'
import { shown } from './given'

export class Listeners<Events extends object> {
  readonly #names: Readonly<Record<keyof Events, true>>
  readonly #changed: () => void
  #entries: { readonly event: keyof Events; readonly call: (value: never) => void }[] = []

  /** @param changed is called when a listener has come or gone */
  constructor(names: Readonly<Record<keyof Events, true>>, changed: () => void) {
    this.#names = names
    this.#changed = changed
  }

  /** @returns what ends it. @throws RequestError BAD_OPTION */
  on<E extends keyof Events>(event: E, listener: (value: Events[E]) => void): () => void {
    if (typeof event !== 'string' || !Object.hasOwn(this.#names, event) || typeof listener !== 'function') {
      const names = Object.keys(this.#names).join(', ')
      throw new RequestError('BAD_OPTION', `on() takes one of ${names}, and a function; not ${shown(event)}.`, 'event')
    }
    // An entry of its own, so that a function that listens twice ends once for each.
    const entry = { event, call: listener }
    this.#entries = [...this.#entries, entry]
    this.#changed()
    return () => {
      this.#entries = this.#entries.filter((other) => other !== entry)
      this.#changed()
    }
  }

  has(event: keyof Events): boolean {
    return this.#entries.some((entry) => entry.event === event)
  }

  tell<E extends keyof Events>(event: E, value: Events[E]): void {
    for (const entry of this.#entries) {
      // One that was ended by another one just before is not told any more.
      if (entry.event !== event || !this.#entries.includes(entry)) continue
      try {
        const call = entry.call as (value: Events[E]) => void
        call(value)
      } catch (error) {
        // A listener's mistake must not stop the connection beside a running machine; it must not go unseen either.
        // As text: an error of another realm (a sandbox) would be refused.
        const detail = error instanceof Error ? error.stack : undefined
        process.emitWarning(
          `A listener of the event ${String(event)} failed. ${String(error)}`,
          detail === undefined ? {} : { detail },
        )
      }
    }
  }
}
