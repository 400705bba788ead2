/** What a simulated PLC has counted since it was made. */
export interface SimulatorStatistics {
  /** Accepted, also those ended at once. */
  readonly connections: number
  /** Ended at once because every entry was taken, or by a fault switch. */
  readonly turnedAway: number
  /** Requests that could be read. */
  readonly requests: number
  /** Answers made; a fault switch may have lost them afterwards. */
  readonly answers: number
  /** Answers with an end code other than 0. */
  readonly refusals: number
  /** Bytes that were no frame of this port: answered by silence. */
  readonly unreadable: number
  /** Requests thrown away: UDP receive buffer full, or the fault `coalesce`. */
  readonly discarded: number
  /** On-demand frames sent, one for each client. */
  readonly onDemands: number
  /** Bytes that came from clients. */
  readonly bytesReceived: number
  /** Bytes that went to clients. */
  readonly bytesSent: number
}

export type Counters = { -readonly [K in keyof SimulatorStatistics]: SimulatorStatistics[K] }

export function newCounters(): Counters {
  return {
    connections: 0,
    turnedAway: 0,
    requests: 0,
    answers: 0,
    refusals: 0,
    unreadable: 0,
    discarded: 0,
    onDemands: 0,
    bytesReceived: 0,
    bytesSent: 0,
  }
}
