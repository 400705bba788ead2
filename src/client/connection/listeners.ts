// Whom a client tells what happened.

import { shown } from '../../basics/show'
import { RequestError } from '../../errors'

type Listener<Events, E extends keyof Events> = (value: Events[E]) => void

/** One subscription: a function that listens twice has two. */
interface Entry<Events> {
  readonly event: keyof Events
  readonly listener: (value: never) => void
  readonly once: boolean
}

export class Listeners<Events extends object> {
  readonly #names: Readonly<Record<keyof Events, true>>
  readonly #changed: () => void
  #entries: readonly Entry<Events>[] = []

  /** @param changed is called when a listener has come or gone */
  constructor(names: Readonly<Record<keyof Events, true>>, changed: () => void) {
    this.#names = names
    this.#changed = changed
  }

  /** @returns what ends it. @throws RequestError BAD_OPTION */
  on<E extends keyof Events>(event: E, listener: Listener<Events, E>): () => void {
    return this.#add({ event, listener, once: false }, 'on')
  }

  /** Tells one event and no more. @returns what ends it before. @throws RequestError BAD_OPTION */
  once<E extends keyof Events>(event: E, listener: Listener<Events, E>): () => void {
    return this.#add({ event, listener, once: true }, 'once')
  }

  /** Ends what `on` or `once` began with this function, the last one first. @throws RequestError BAD_OPTION */
  off<E extends keyof Events>(event: E, listener: Listener<Events, E>): void {
    this.#check(event, listener, 'off')
    const entry = this.#entries.filter((other) => other.event === event && other.listener === listener).at(-1)
    if (entry !== undefined) this.#remove(entry)
  }

  #add(entry: Entry<Events>, method: string): () => void {
    this.#check(entry.event, entry.listener, method)
    this.#entries = [...this.#entries, entry]
    this.#changed()
    return () => this.#remove(entry)
  }

  #check(event: unknown, listener: unknown, method: string): void {
    if (typeof event === 'string' && Object.hasOwn(this.#names, event) && typeof listener === 'function') return
    const names = Object.keys(this.#names).join(', ')
    const message = `${method}() takes one of ${names}, and a function; not ${shown(event)}.`
    throw new RequestError('BAD_OPTION', message, 'event')
  }

  #remove(entry: Entry<Events>): void {
    if (!this.#entries.includes(entry)) return
    this.#entries = this.#entries.filter((other) => other !== entry)
    this.#changed()
  }

  has(event: keyof Events): boolean {
    return this.#entries.some((entry) => entry.event === event)
  }

  tell<E extends keyof Events>(event: E, value: Events[E]): void {
    for (const entry of this.#entries) {
      // One that was ended by another one just before is not told any more.
      if (entry.event !== event || !this.#entries.includes(entry)) continue
      if (entry.once) this.#remove(entry)
      try {
        const call = entry.listener as Listener<Events, E>
        call(value)
      } catch (error) {
        listenerFailed(`A listener of the event ${String(event)}`, error)
      }
    }
  }
}

/** A listener's mistake must not stop the connection beside a running machine; it must not go unseen either. */
export function listenerFailed(what: string, error: unknown): void {
  // As text: an error of another realm (a sandbox) would be refused.
  const detail = error instanceof Error ? error.stack : undefined
  process.emitWarning(`${what} failed. ${String(error)}`, detail === undefined ? {} : { detail })
}
