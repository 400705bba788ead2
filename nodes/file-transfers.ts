// The transfers of one file node: one after another, told in its status, and over when the node is.
import type { FileProgress } from '../src/index'
import { refusal } from './failure'
import type { Display } from './status'
import type { Texts } from './texts'

/** Messages that wait while a file is transferred; each may hold the content of a file. */
const MOST_WAITING = 100

/** A deploy waits so long for a file that is being written, in ms; what the connection grants is longer. */
const PATIENCE = 3000

/** What a call of the client takes for one transfer. */
export interface TransferOptions {
  readonly signal: AbortSignal
  readonly onProgress: (progress: FileProgress) => void
}

export class Transfers {
  #last: Promise<unknown> = Promise.resolve()
  #waiting = 0
  /** What is to be given up between two of its requests. */
  readonly #over = { reading: false, writing: false }

  constructor(
    private readonly display: Display,
    private readonly texts: Texts,
  ) {}

  /**
   * Does it when all that came before is done: two messages must not meet in one file.
   * @throws NodeFailure QUEUE_FULL, or CLOSED when the node was closed before its turn; nothing is sent then
   */
  inTurn<T>(work: () => Promise<T>): Promise<T> {
    if (this.#waiting >= MOST_WAITING) {
      return Promise.reject(refusal('QUEUE_FULL', this.texts('error.filesWaiting', { count: MOST_WAITING })))
    }
    this.#waiting += 1
    const turn = this.#last.then(() => {
      this.#waiting -= 1
      if (this.#over.reading) throw refusal('CLOSED', this.texts('error.closed'))
      return work()
    })
    this.#last = turn.catch(() => undefined)
    return turn
  }

  /** For one call. */
  options(what: 'reading' | 'writing'): TransferOptions {
    const over = new AbortController()
    return {
      signal: over.signal,
      onProgress: ({ done, total }) => {
        if (done >= total) return
        this.display.transferring(what, 10 * Math.floor((10 * done) / total))
        // Between two requests only: giving up one that was sent can cost the connection, and leave the file locked.
        if (this.#over[what]) over.abort()
      },
    }
  }

  /** The node closes. Nobody waits for what is being read; what is being written may be as good as done. */
  close(): void {
    this.#over.reading = true
    const late = AbortSignal.timeout(PATIENCE)
    late.addEventListener(
      'abort',
      () => {
        this.#over.writing = true
      },
      { once: true },
    )
  }
}
