// The PLC's side of one connection, sans-IO: the mirror of the session, used by the simulator.
import { PlcError } from '../errors'
import type { BodyLength, Framing, RequestFrame } from './framing'

const EMPTY = Buffer.alloc(0)

export class Responder<Head> {
  readonly #framing: Framing<Head>
  readonly #kind: 'stream' | 'datagram'
  readonly #bodyLength: BodyLength<Head>
  #received: Buffer = EMPTY

  /** `bodyLength` is asked only by frames whose requests carry no length (1E, Sharp JW). */
  constructor(framing: Framing<Head>, kind: 'stream' | 'datagram', bodyLength: BodyLength<Head>) {
    this.#framing = framing
    this.#kind = kind
    this.#bodyLength = bodyLength
  }

  /**
   * Takes a chunk and returns the requests that are complete with it.
   * Bytes that are no such frame are thrown away and nothing is answered: that is what a PLC does with a wrong data
   * code or frame (FX5 communication manual, C06F: "no response").
   */
  receive(chunk: Buffer): RequestFrame<Head>[] {
    const requests: RequestFrame<Head>[] = []
    let rest = this.#received.length === 0 ? chunk : Buffer.concat([this.#received, chunk])
    try {
      while (rest.length > 0) {
        const scanned = this.#framing.request.scan(rest, this.#bodyLength)
        if (scanned === undefined) break
        requests.push(scanned.frame)
        rest = rest.subarray(scanned.used)
      }
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      rest = EMPTY
    }
    this.#received = this.#kind === 'datagram' ? EMPTY : rest
    return requests
  }

  /** The frame that answers `request`. */
  answer(request: RequestFrame<Head>, endCode: number, body: Uint8Array): Buffer {
    return this.#framing.response.write(request.head, request.serial ?? 0, endCode, body)
  }
}
