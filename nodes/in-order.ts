// What changes the PLC is done in the order of the messages, however long it takes to find out what each of them means.
import { refusal } from './failure'
import type { Tools } from './node'
import type { Texts } from './texts'

/** Messages of one node that may wait: as many as requests of a client, unless it is told otherwise. */
const MOST_WAITING = 256

/** What has waited so long in the node belongs to another moment, ms; longer where the timeout is. */
const LONGEST_WAIT = 10_000

/** The messages of one node. */
export class InOrder {
  #last: Promise<unknown> = Promise.resolve()
  #waiting = 0
  readonly #texts: Texts
  readonly #longest: number

  /** @param whole the next one begins when the one before is done, not when it is under way */
  constructor(
    { connection, texts }: Tools,
    private readonly whole = false,
  ) {
    this.#texts = texts
    this.#longest = Math.max(LONGEST_WAIT, connection.options?.timeout ?? 0)
  }

  /**
   * @param found what the message means; it is found out at once, because flows change their messages and variables
   * @param act does it, when it is its turn; it asks the client before it waits for anything
   * @throws NodeFailure QUEUE_FULL or OVERLOADED; nothing is sent then
   */
  async act<T, R>(found: Promise<T>, act: (found: T) => Promise<R>): Promise<R> {
    found.catch(() => undefined)
    if (this.#waiting >= MOST_WAITING) {
      throw refusal('QUEUE_FULL', this.#texts('error.messagesWaiting', { count: MOST_WAITING }))
    }
    const late = AbortSignal.timeout(this.#longest)
    this.#waiting += 1
    const turn = this.#last.then(async () => {
      const given = await found.finally(() => {
        this.#waiting -= 1
      })
      if (late.aborted)
        throw refusal('OVERLOADED', this.#texts('error.waitedTooLong', { seconds: this.#longest / 1000 }))
      const result = act(given)
      if (this.whole) await result.catch(() => undefined)
      // Not the result itself, which the next one would wait for.
      return { result }
    })
    this.#last = turn.catch(() => undefined)
    return (await turn).result
  }
}
