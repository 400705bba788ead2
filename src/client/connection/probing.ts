// Which request proves the next connection. A PLC that does not know the usual one meets it with silence, or closes.
import { ConnectionError, type PlcError, ProtocolError } from '../../errors'
import type { Probe } from './connection-options'

/** A probe and how long it may take. */
export interface NextProbe {
  readonly probe: Probe
  /** Whether another one follows at once when it gets no answer: then it may take half the time only. */
  readonly hasNext: boolean
}

export class Probing {
  readonly #probes: readonly Probe[]
  #at = 0
  #unanswered: readonly string[] = []

  constructor(probes: readonly Probe[]) {
    this.#probes = probes
  }

  /** For the next connection; `undefined`: the first request of the program proves it. */
  get next(): NextProbe | undefined {
    const probe = this.#probes[this.#at]
    return probe && { probe, hasNext: this.#at < this.#probes.length - 1 }
  }

  /** Names of the probes that got no answer in a row, before the present one. */
  get unanswered(): readonly string[] {
    return this.#unanswered
  }

  /** The probe was answered: it is the one for the next connections, too. */
  answered(): void {
    this.#unanswered = []
  }

  /** A connection was lost before its probe was answered. @returns whether the next one is to be tried at once */
  lost(reason: PlcError): boolean {
    const current = this.next
    if (current === undefined || !isUnanswered(reason)) return false
    this.#at = current.hasNext ? this.#at + 1 : 0
    this.#unanswered = current.hasNext ? [...this.#unanswered, current.probe.name] : []
    return current.hasNext
  }
}

/** Silence, closing, or bytes that are no such answer: what a device does that does not know the request. */
function isUnanswered(reason: PlcError): boolean {
  if (reason instanceof ProtocolError) return true
  return reason instanceof ConnectionError && ['SILENT', 'DISCONNECTED', 'ENTRY_BUSY'].includes(reason.code)
}
