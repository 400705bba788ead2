// Listeners of a simulator's programs, typed by name.

type Listeners<Events> = { [E in keyof Events]?: Set<(event: Events[E]) => void> }

export class Emitter<Events> {
  readonly #listeners: Listeners<Events> = {}

  /** Calls `listener` on every event of the name; the returned function ends it. */
  on<E extends keyof Events>(name: E, listener: (event: Events[E]) => void): () => void {
    // Each subscription is its own, also of a function that is subscribed twice.
    const call = (event: Events[E]) => listener(event)
    const listeners = this.#listeners[name] ?? new Set()
    this.#listeners[name] = listeners
    listeners.add(call)
    return () => void listeners.delete(call)
  }

  emit<E extends keyof Events>(name: E, event: Events[E]): void {
    for (const listener of [...(this.#listeners[name] ?? [])]) listener(event)
  }
}
