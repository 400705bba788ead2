/** What is under way between the two sides of an in-memory connection, in the order in which it was sent. */

export type Side = 'client' | 'server'

export interface DeliveryOptions {
  /**
   * `microtask` (default): soon, after the current code has run, as with a socket.
   * `synchronous`: before `open` or `send` returns; only what the handlers themselves send waits for its turn.
   * `manual`: when `deliver()` is called.
   */
  readonly delivery?: 'microtask' | 'synchronous' | 'manual' | undefined
  /**
   * Changes how bytes arrive: given what is under way to one side, returns what it receives instead.
   * A stream's bytes may be split and joined but must stay the same bytes; datagrams may also be dropped, doubled,
   * reordered and altered.
   */
  readonly chunking?: ((pending: readonly Buffer[], to: Side) => readonly Buffer[]) | undefined
}

export interface Receiver {
  readonly side: Side
  take(bytes: Buffer): void
}

interface Chunk {
  readonly to: Receiver
  readonly bytes: Buffer
}

type Delivery = Chunk | { readonly to: undefined; readonly happen: () => void }

/** More than this in one go are two sides that answer each other for ever. */
const MOST_DELIVERIES = 1_000_000

export class DeliveryQueue {
  readonly #kind: 'stream' | 'datagram'
  readonly #options: DeliveryOptions
  /** As sent, over both directions. */
  #queue: Delivery[] = []
  /** Taken from the head of the queue, as `chunking` wants it received. */
  #chunked: Chunk[] = []
  #delivering = false
  #planned = false

  constructor(kind: 'stream' | 'datagram', options: DeliveryOptions) {
    this.#kind = kind
    this.#options = options
  }

  get pending(): number {
    return this.#queue.length + this.#chunked.length
  }

  /** Bytes for the other end, copied, because the receiver owns what it gets. */
  carry(to: Receiver, bytes: Uint8Array): void {
    this.#enqueue({ to, bytes: Buffer.from(bytes) })
  }

  /** Something that happens at the other end, after everything sent before. */
  later(happen: () => void): void {
    this.#enqueue({ to: undefined, happen })
  }

  /** Loses what is under way, as a reset does. */
  lose(to: Receiver): void {
    this.#queue = this.#queue.filter((delivery) => delivery.to !== to)
    this.#chunked = this.#chunked.filter((chunk) => chunk.to !== to)
  }

  /** Delivers at most `count`, returns how many it were; 0 when called from inside a delivery. */
  deliver(count = Number.POSITIVE_INFINITY): number {
    if (this.#delivering) return 0
    this.#delivering = true
    let done = 0
    try {
      while (done < count && this.#deliverNext()) {
        if (++done >= MOST_DELIVERIES) throw new Error(`${done} deliveries in one go: two sides answer each other`)
      }
    } finally {
      this.#delivering = false
    }
    return done
  }

  #enqueue(delivery: Delivery): void {
    this.#queue.push(delivery)
    const { delivery: mode = 'microtask' } = this.#options
    if (mode === 'synchronous') this.deliver()
    if (mode !== 'microtask' || this.#planned) return
    this.#planned = true
    queueMicrotask(() => {
      this.#planned = false
      this.deliver()
    })
  }

  #deliverNext(): boolean {
    // A chunking that drops everything leaves nothing to deliver, so this may take several rounds.
    while (this.#chunked.length === 0) {
      const next = this.#queue[0]
      if (next === undefined) return false
      if (next.to !== undefined) {
        this.#chunk(next.to)
        continue
      }
      this.#queue.shift()
      next.happen()
      return true
    }
    const chunk = this.#chunked.shift()
    chunk?.to.take(chunk.bytes)
    return true
  }

  /** Moves the bytes at the head of the queue that go to one receiver through `chunking`. */
  #chunk(to: Receiver): void {
    const pending: Buffer[] = []
    for (let next = this.#queue[0]; next !== undefined && next.to === to; next = this.#queue[0]) {
      pending.push(next.bytes)
      this.#queue.shift()
    }
    const chunks = this.#options.chunking?.(pending, to.side) ?? pending
    if (this.#kind === 'stream' && !Buffer.concat(chunks).equals(Buffer.concat(pending))) {
      throw new Error('chunking must not change the bytes of a stream')
    }
    for (const bytes of chunks) this.#chunked.push({ to, bytes })
  }
}
