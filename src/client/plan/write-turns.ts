// Who may change the PLC while this client reads a word, changes a bit of it and writes it back: nobody else of this
// client, or one of the two changes would be lost. Other programs and the PLC itself are not kept away.
import type { Exchange } from '../../link/link'
import type { Deadline } from '../connection/deadline'
import { rejecting } from './rejecting'
import type { SendExchange } from './request'

/** One call: all its requests share one deadline. */
export interface OpenCall {
  readonly deadline: Deadline
  readonly send: SendExchange
  /** Nobody else of this client writes meanwhile. */
  alone<T>(use: (send: SendExchange) => Promise<T>): Promise<T>
}

export class WriteTurns {
  /** Ends when the last exclusive turn that was asked for has ended. */
  #exclusive: Promise<unknown> | undefined
  readonly #shared = new Set<Promise<unknown>>()

  /** A call whose writes take their turns. What `refusable` throws is what the request rejects with. */
  open(deadline: Deadline, refusable: SendExchange): OpenCall {
    const request: SendExchange = (exchange) => rejecting(() => refusable(exchange))
    const send = <T>(exchange: Exchange<T>): Promise<T> =>
      exchange.effect === 'write' ? this.shared(deadline, exchange.title, () => request(exchange)) : request(exchange)
    return { deadline, send, alone: (use) => this.exclusive(deadline, 'Writing', () => use(request)) }
  }

  /** Beside other shared ones, behind the exclusive ones that were asked for before. */
  async shared<T>(deadline: Deadline, title: string, use: () => Promise<T>): Promise<T> {
    const before = this.#exclusive
    const running = before === undefined ? use() : deadline.wait(before, title).then(use)
    // Also while it waits: what is asked for later stands behind it.
    this.#shared.add(running)
    try {
      return await running
    } finally {
      this.#shared.delete(running)
    }
  }

  /** Alone: behind all that were asked for before, and before all that are asked for later. */
  async exclusive<T>(deadline: Deadline, title: string, use: () => Promise<T>): Promise<T> {
    const before = [this.#exclusive, ...this.#shared].map((one) => Promise.resolve(one).catch(() => {}))
    let end = () => {}
    const own = new Promise<void>((resolve) => {
      end = resolve
    })
    const turn = Promise.all([...before, own])
    this.#exclusive = turn
    try {
      await deadline.wait(Promise.all(before), title)
      return await use()
    } finally {
      end()
      void turn.then(() => {
        if (this.#exclusive === turn) this.#exclusive = undefined
      })
    }
  }
}
