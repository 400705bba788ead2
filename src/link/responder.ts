// The PLC's side of one connection, sans-IO: the mirror of the session, used by the simulator.
import { PlcError } from '../errors'
import type { BodyLength, Framing, RequestFrame, Scanned } from './framing'

const EMPTY = Buffer.alloc(0)
/** Longer than any frame of any protocol here. */
const MAX_FRAME = 65_536

export class Responder<H> {
  readonly #framing: Framing<H>
  readonly #kind: 'stream' | 'datagram'
  readonly #bodyLength: BodyLength<H>
  #received: Buffer = EMPTY

  /** `bodyLength` is asked only by frames whose requests carry no length (1E, Sharp JW). */
  constructor(framing: Framing<H>, kind: 'stream' | 'datagram', bodyLength: BodyLength<H>) {
    this.#framing = framing
    this.#kind = kind
    this.#bodyLength = bodyLength
  }

  /** Bytes of an unfinished frame that are kept: never more than a frame can have. */
  get buffered(): number {
    return this.#received.length
  }

  /**
   * Takes a chunk and returns the requests that are complete with it.
   * Bytes that are no such frame are thrown away and nothing is answered: that is what a PLC does with a wrong data
   * code or frame (FX5 communication manual, C06F: "no response"). Where lines have noise the next frame is looked for
   * behind it; elsewhere all that has come is thrown away. One datagram is one frame.
   */
  receive(chunk: Buffer): RequestFrame<H>[] {
    return this.#kind === 'datagram' ? this.#receiveDatagram(chunk) : this.#receiveStream(chunk)
  }

  #receiveDatagram(datagram: Buffer): RequestFrame<H>[] {
    const scanned = this.#scan(datagram)
    return scanned?.used === datagram.length ? [scanned.frame] : []
  }

  #receiveStream(chunk: Buffer): RequestFrame<H>[] {
    const requests: RequestFrame<H>[] = []
    let rest = this.#received.length === 0 ? chunk : Buffer.concat([this.#received, chunk])
    for (rest = this.#withoutNoise(rest); rest.length > 0; rest = this.#withoutNoise(rest)) {
      const scanned = this.#scan(rest)
      if (scanned === undefined) break
      if (scanned !== null) requests.push(scanned.frame)
      rest = scanned === null ? this.#behindRubbish(rest) : rest.subarray(scanned.used)
    }
    // A frame that does not end must not fill the memory.
    this.#received = rest.length > MAX_FRAME ? EMPTY : rest
    return requests
  }

  #withoutNoise(bytes: Buffer): Buffer {
    return bytes.subarray(this.#framing.request.noise?.(bytes) ?? 0)
  }

  /** What may begin a frame and is none: its first byte is taken away, and noise is what follows up to the next start. */
  #behindRubbish(bytes: Buffer): Buffer {
    return this.#framing.request.noise === undefined ? EMPTY : bytes.subarray(1)
  }

  /** The request at the front; `undefined` when it is not complete, `null` when the bytes can never become one. */
  #scan(bytes: Buffer): Scanned<RequestFrame<H>> | undefined | null {
    try {
      return this.#framing.request.scan(bytes, this.#bodyLength)
    } catch (error) {
      if (error instanceof PlcError) return null
      throw error
    }
  }

  /** The frame that answers `request`. */
  answer(request: RequestFrame<H>, endCode: number, body: Uint8Array): Buffer {
    return this.#framing.response.write(request.head, request.serial ?? 0, endCode, body)
  }
}
