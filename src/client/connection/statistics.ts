// What a client counts. Plain numbers for dashboards; nothing here costs anything that grows.

/** Round-trip times in ms of the last answers. */
export interface RoundTrip {
  /** Answers it is about, up to 1024. */
  readonly count: number
  /** Of the last answer. */
  readonly last: number
  /** The shortest. */
  readonly min: number
  /** The mean. */
  readonly mean: number
  /** Half of them took no longer. */
  readonly p50: number
  /** 95 of 100 took no longer. */
  readonly p95: number
  /** 99 of 100 took no longer. */
  readonly p99: number
  /** The longest. */
  readonly max: number
}

/** Counters since the client was made. */
export interface Statistics {
  /** Requests of the program. The first request on each connection, which only proves it, counts nowhere but in bytes. */
  readonly requests: number
  /** Requests that were answered, also with an end code. */
  readonly answered: number
  /** Answers with an end code other than 0. */
  readonly refused: number
  /** Requests without an answer before their deadline, sent or not. */
  readonly timeouts: number
  /** Requests that waited until an answer could not come in time any more, and were not sent: more is asked than the PLC answers. */
  readonly overloaded: number
  /** Calls ended by their signal. */
  readonly aborted: number
  /** Times that the PLC sent what the protocol does not allow. */
  readonly protocolErrors: number
  /** Answers to requests that had been given up, and what came before the self test that proves a fixed port. */
  readonly stale: number
  /** Frames that the PLC sent unasked, whether they could be read or not. */
  readonly unsolicited: number
  /** Attempts to connect. */
  readonly connects: number
  /** Connections that ended otherwise than by `close()`. */
  readonly disconnects: number
  /** Bytes given to the transport. */
  readonly bytesSent: number
  /** Bytes that came from the transport. */
  readonly bytesReceived: number
  /** Requests that wait now. */
  readonly queued: number
  /** Requests under way now. */
  readonly inFlight: number
  /** Undefined until the first answer. */
  readonly roundTrip: RoundTrip | undefined
}

export type Counter = Exclude<keyof Statistics, 'roundTrip' | 'queued' | 'inFlight'>

const KEPT = 1024

export class Counters {
  /** Added to by whoever sees something happen. */
  readonly counts: Record<Counter, number> = {
    requests: 0,
    answered: 0,
    refused: 0,
    timeouts: 0,
    overloaded: 0,
    aborted: 0,
    protocolErrors: 0,
    stale: 0,
    unsolicited: 0,
    connects: 0,
    disconnects: 0,
    bytesSent: 0,
    bytesReceived: 0,
  }
  readonly #times = new Float64Array(KEPT)
  #timed = 0

  roundTrip(ms: number): void {
    this.#times[this.#timed % KEPT] = ms
    this.#timed += 1
  }

  read(queued: number, inFlight: number): Statistics {
    return { ...this.counts, queued, inFlight, roundTrip: this.#readRoundTrip() }
  }

  #readRoundTrip(): RoundTrip | undefined {
    if (this.#timed === 0) return undefined
    const count = Math.min(this.#timed, KEPT)
    const sorted = this.#times.slice(0, count).sort()
    // Nearest rank: the smallest time that at least this share of the answers did not exceed.
    const at = (share: number) => sorted[Math.max(0, Math.ceil(share * count) - 1)] as number
    return {
      count,
      last: this.#times[(this.#timed - 1) % KEPT] as number,
      min: at(0),
      mean: sorted.reduce((sum, ms) => sum + ms, 0) / count,
      p50: at(0.5),
      p95: at(0.95),
      p99: at(0.99),
      max: at(1),
    }
  }
}
