// What goes over the wire, for people: every chunk as it was sent or received, with its frames in words on demand.
import { type FrameExplanation, formatExplanation, maskSecrets } from '../../codec/explanation'
import { PlcError } from '../../errors'
import type { FrameExplainer, SentFrame } from '../../link/link'
import type { TracedFrame } from './connection-options'

/**
 * One send, or one chunk that was received. Secrets are asterisks in `bytes` and in the words.
 * @example client.on('trace', (entry) => console.log(entry.direction, entry.text))
 */
export interface TraceEntry {
  /** Milliseconds since 1970. */
  readonly time: number
  /** Seen from this side. */
  readonly direction: 'sent' | 'received'
  /** As they went over the wire, secrets aside. */
  readonly bytes: Buffer
  /** The frames that are complete with these bytes, field by field; made when it is asked for. */
  readonly frames: readonly FrameExplanation[]
  /** The same as text of several lines. */
  readonly text: string
}

/** A frame, or what is left of a chunk when it holds no whole one. */
interface Piece {
  readonly bytes: Buffer
  /** Frame of the request it answers. */
  readonly request?: Buffer
  /** Frame of the last registration. */
  readonly registration?: Buffer
  /** The frame goes on in a later chunk. */
  readonly unfinished?: true
}

/** Requests whose answers may still come. */
const KEPT_REQUESTS = 256
/** Bytes of an unfinished frame that are kept; as the session does it. */
const LONGEST_FRAME = 65_536

const EMPTY = Buffer.alloc(0)

/** Makes the entries of one client's trace: puts chunks together to frames, and answers to their requests. */
export class Tracer {
  readonly #explainer: FrameExplainer
  readonly #kind: 'stream' | 'datagram'
  /** Frames of requests by serial number, or under 0 the last one. */
  readonly #requests = new Map<number, Buffer>()
  #registration: Buffer | undefined
  #received: Buffer = EMPTY

  /** @param kind `datagram`: a frame never goes on in the next chunk */
  constructor(explainer: FrameExplainer, kind: 'stream' | 'datagram') {
    this.#explainer = explainer
    this.#kind = kind
  }

  /** The connection is gone: the rest of a frame does not come any more. */
  reset(): void {
    this.#received = EMPTY
    this.#requests.clear()
    this.#registration = undefined
  }

  entry({ time, direction, bytes }: TracedFrame): TraceEntry {
    const sent = direction === 'sent' ? this.#explainer.sent(bytes) : undefined
    const pieces = direction === 'sent' ? this.#sent(bytes, sent) : this.#receivedPieces(bytes)
    const explain = () => pieces.map((piece) => this.#explain(piece))
    const secret = direction === 'sent' ? (sent?.isSecret ?? true) : this.#explainer.hasSecretAnswers
    // A copy: a listener may do with it what it likes, and a request is sent again from the same bytes.
    return new Entry(time, direction, secret ? masked(bytes, pieces, explain()) : Buffer.from(bytes), explain)
  }

  #sent(bytes: Buffer, sent: SentFrame | undefined): readonly Piece[] {
    if (this.#explainer.endsWithRequest) this.#received = EMPTY
    if (sent === undefined) return [{ bytes }]
    this.#requests.delete(sent.serial)
    this.#requests.set(sent.serial, bytes)
    const [oldest] = this.#requests.keys()
    if (this.#requests.size > KEPT_REQUESTS && oldest !== undefined) this.#requests.delete(oldest)
    if (sent.isRegistration) this.#registration = bytes
    return [{ bytes }]
  }

  #receivedPieces(chunk: Buffer): readonly Piece[] {
    const pieces: Piece[] = []
    // A copy: it is explained later, when the memory of the chunk holds something else.
    let rest = Buffer.concat([this.#received, chunk])
    this.#received = EMPTY
    try {
      while (rest.length > 0) {
        const found = this.#explainer.received(rest, this.#requests.get(0))
        if (found === undefined) break
        pieces.push(this.#answer(rest.subarray(0, found.used), found.serial))
        rest = rest.subarray(found.used)
      }
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      return [...pieces, { bytes: rest }]
    }
    if (rest.length === 0) return pieces
    return [...pieces, this.#unfinished(rest)]
  }

  /** What is no whole frame, or not yet. */
  #unfinished(bytes: Buffer): Piece {
    // Where an answer ends with its request, that says what has come of it so far.
    const piece = this.#explainer.endsWithRequest ? this.#answer(bytes, 0) : { bytes }
    if (this.#kind === 'datagram') return piece
    if (bytes.length <= LONGEST_FRAME) this.#received = bytes
    return { ...piece, unfinished: true }
  }

  #answer(bytes: Buffer, serial: number | undefined): Piece {
    // A frame that came unasked answers nothing: the request waits on.
    if (serial === undefined) return { bytes }
    const request = this.#requests.get(serial)
    if (!this.#explainer.endsWithRequest) this.#requests.delete(serial)
    return {
      bytes,
      ...(request === undefined ? {} : { request }),
      ...(this.#registration === undefined ? {} : { registration: this.#registration }),
    }
  }

  #explain({ bytes, unfinished, ...known }: Piece): FrameExplanation {
    const explanation = this.#explainer.explain(bytes, known)
    if (unfinished === undefined) return explanation
    return { ...explanation, notes: [...explanation.notes, 'The rest of this frame is in a later chunk.'] }
  }
}

/** The chunk without its secrets. The pieces end with it, but the first may have begun in an earlier chunk. */
function masked(chunk: Buffer, pieces: readonly Piece[], explanations: readonly FrameExplanation[]): Buffer {
  const all = Buffer.concat(pieces.map(({ bytes }, i) => maskSecrets(bytes, explanations[i])))
  return all.subarray(all.length - chunk.length)
}

class Entry implements TraceEntry {
  #explain: (() => readonly FrameExplanation[]) | undefined
  #frames: readonly FrameExplanation[] = []

  constructor(
    readonly time: number,
    readonly direction: 'sent' | 'received',
    readonly bytes: Buffer,
    explain: () => readonly FrameExplanation[],
  ) {
    this.#explain = explain
  }

  get frames(): readonly FrameExplanation[] {
    if (this.#explain !== undefined) {
      this.#frames = this.#explain()
      this.#explain = undefined
    }
    return this.#frames
  }

  get text(): string {
    return this.frames.map(formatExplanation).join('\n')
  }
}
