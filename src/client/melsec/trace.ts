// What goes over the wire, for people: every chunk as it was sent or received, with its frames in words on demand.

import { hasSecret } from '../../codec/annotate'
import type { DataCode } from '../../codec/codec'
import { readerOf } from '../../codec/codec'
import { PlcError } from '../../errors'
import type { Framing } from '../../link/link'
import type { Command } from '../../melsec/commands/command'
import { knownCommands } from '../../melsec/commands/known'
import type { Notation } from '../../melsec/device/json'
import { explainFrame, type FrameExplanation, formatExplanation, maskSecrets } from '../../melsec/explain/frame'
import type { ExplainFrameOptions } from '../../melsec/explain/options'
import { frame3e, type Head3e } from '../../melsec/frame/slmp-frame'
import type { FrameName, Profile } from '../../melsec/profiles/profile'
import type { TracedFrame } from '../connection/connection'

/**
 * One send, or one chunk that was received. Secrets are asterisks in `bytes` and in the words.
 * @example client.on('trace', (entry) => console.log(entry.direction, entry.text))
 */
export interface TraceEntry {
  /** Milliseconds since 1970. */
  readonly time: number
  readonly direction: 'sent' | 'received'
  readonly bytes: Buffer
  /** The frames that are complete with these bytes, field by field; made when it is asked for. */
  readonly frames: readonly FrameExplanation[]
  /** The same as text of several lines. */
  readonly text: string
}

export interface TracerOptions extends Notation {
  readonly frame: FrameName
  readonly code: DataCode
  readonly profile: Profile
  readonly asciiXy?: 'octal' | 'hexadecimal' | undefined
  readonly asciiZr?: 'decimal' | 'hexadecimal' | undefined
  /** `datagram`: a frame never goes on in the next chunk. Default `stream`. */
  readonly kind?: 'stream' | 'datagram'
  /** Declarations to know instead of all of this package's. */
  readonly commands?: Readonly<Record<string, Command>>
}

/** A frame, or what is left of a chunk when it holds no whole one. */
interface Piece {
  readonly bytes: Buffer
  /** Frame of the request it answers. */
  readonly request?: Buffer
  /** Frame of the last Entry Monitor Device: what an Execute Monitor reads. */
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
  readonly #options: TracerOptions
  /** `undefined` for 1E, which is told apart by its requests. */
  readonly #framing: Framing<Head3e> | undefined
  readonly #commands: Readonly<Record<string, Command>>
  /** Codes of commands with a secret: other frames are not searched for it. */
  readonly #secretCodes: ReadonlySet<number>
  /** Whether an answer could hold one. */
  readonly #secretAnswers: boolean
  /** Frames of requests by serial number, or under 0 the last one. */
  readonly #requests = new Map<number, Buffer>()
  #registration: Buffer | undefined
  #received: Buffer = EMPTY

  constructor(options: TracerOptions) {
    this.#options = options
    this.#framing = options.frame === '1E' ? undefined : frame3e(options.frame, options.code)
    this.#commands = options.commands ?? knownCommands
    const secret = Object.values(this.#commands).filter(
      ({ request, response }) => hasSecret(request) || hasSecret(response),
    )
    this.#secretCodes = new Set(secret.map(({ code }) => code))
    this.#secretAnswers = secret.some(
      ({ response }) => hasSecret(response) || Object.values(response).some(({ kind }) => kind === 'echo'),
    )
  }

  /** The connection is gone: the rest of a frame does not come any more. */
  reset(): void {
    this.#received = EMPTY
    this.#requests.clear()
    this.#registration = undefined
  }

  entry({ time, direction, bytes }: TracedFrame): TraceEntry {
    const pieces = direction === 'sent' ? this.#sent(bytes) : this.#receivedPieces(bytes)
    const explain = () => pieces.map((piece) => this.#explain(piece))
    const secret = direction === 'sent' ? this.#isSecret(bytes) : this.#secretAnswers
    return new Entry(time, direction, secret ? masked(bytes, pieces, explain()) : bytes, explain)
  }

  #sent(bytes: Buffer): readonly Piece[] {
    const framing = this.#framing
    if (framing === undefined) return this.#sent1e(bytes)
    const scanned = attempt(() => framing.request.scan(bytes, () => undefined))
    if (scanned === undefined) return [{ bytes }]
    const { serial = 0, body } = scanned.frame
    this.#requests.delete(serial)
    this.#requests.set(serial, bytes)
    const [oldest] = this.#requests.keys()
    if (this.#requests.size > KEPT_REQUESTS && oldest !== undefined) this.#requests.delete(oldest)
    if (this.#isRegistration(body)) this.#registration = bytes
    return [{ bytes }]
  }

  /** One request at a time: what comes next is its answer. */
  #sent1e(bytes: Buffer): readonly Piece[] {
    this.#received = EMPTY
    this.#requests.set(0, bytes)
    return [{ bytes }]
  }

  /** 1E has no length: an answer is whole when its request says so. */
  #received1e(chunk: Buffer): readonly Piece[] {
    const bytes = this.#received.length === 0 ? chunk : Buffer.concat([this.#received, chunk])
    const request = this.#requests.get(0)
    const piece: Piece = { bytes, ...(request === undefined ? {} : { request }) }
    const isWhole = this.#explain(piece).fault === undefined
    this.#received = isWhole || this.#options.kind === 'datagram' || bytes.length > LONGEST_FRAME ? EMPTY : bytes
    return [this.#received === EMPTY ? piece : { ...piece, unfinished: true }]
  }

  #isSecret(frame: Buffer): boolean {
    const framing = this.#framing
    if (framing === undefined || this.#secretCodes.size === 0) return false
    const body = attempt(() => framing.request.scan(frame, () => undefined))?.frame.body
    const code = body && attempt(() => readerOf(this.#options.code, body).uint(2))
    return code === undefined || this.#secretCodes.has(code)
  }

  /** Whether the body is the request of a command that answers of another one refer to. */
  #isRegistration(body: Buffer): boolean {
    const code = attempt(() => readerOf(this.#options.code, body).uint(2))
    const list = Object.values(this.#commands)
    const registering = list.flatMap(({ context }) => (context === undefined ? [] : [this.#commands[context]?.code]))
    return code !== undefined && registering.includes(code)
  }

  #receivedPieces(chunk: Buffer): readonly Piece[] {
    const framing = this.#framing
    if (framing === undefined) return this.#received1e(chunk)
    const pieces: Piece[] = []
    let rest = this.#received.length === 0 ? chunk : Buffer.concat([this.#received, chunk])
    this.#received = EMPTY
    try {
      while (rest.length > 0) {
        const used = scanned(framing, rest)
        if (used === undefined) break
        pieces.push(this.#answer(framing, rest.subarray(0, used)))
        rest = rest.subarray(used)
      }
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      return [...pieces, { bytes: rest }]
    }
    if (rest.length === 0) return pieces
    if (this.#options.kind === 'datagram') return [...pieces, { bytes: rest }]
    if (rest.length <= LONGEST_FRAME) this.#received = Buffer.from(rest)
    return [...pieces, { bytes: rest, unfinished: true }]
  }

  #answer(framing: Framing<Head3e>, bytes: Buffer): Piece {
    const answer = attempt(() => framing.response.scan(bytes, () => undefined))
    // A frame that came unasked answers nothing: the request waits on.
    if (answer === undefined) return { bytes }
    const serial = answer.frame.serial ?? 0
    const request = this.#requests.get(serial)
    this.#requests.delete(serial)
    return {
      bytes,
      ...(request === undefined ? {} : { request }),
      ...(this.#registration === undefined ? {} : { registration: this.#registration }),
    }
  }

  #explain({ bytes, request, registration, unfinished }: Piece): FrameExplanation {
    const { profile, xyRadix, wRadix, asciiXy, asciiZr, code } = this.#options
    const options: ExplainFrameOptions = {
      ...(this.#framing === undefined ? { frame: '1E' } : {}),
      code,
      profile,
      commands: this.#commands,
      ...(xyRadix === undefined ? {} : { xyRadix }),
      ...(wRadix === undefined ? {} : { wRadix }),
      ...(asciiXy === undefined ? {} : { asciiXy }),
      ...(asciiZr === undefined ? {} : { asciiZr }),
      ...(request === undefined ? {} : { request }),
      ...(registration === undefined ? {} : { registration }),
    }
    const explanation = explainFrame(bytes, options)
    if (unfinished === undefined) return explanation
    return { ...explanation, notes: [...explanation.notes, 'The rest of this frame is in a later chunk.'] }
  }
}

/** Bytes of the frame at the front; `undefined` when it is not complete. @throws ProtocolError */
function scanned({ request, response }: Framing<Head3e>, bytes: Buffer): number | undefined {
  const side = response.isUnsolicited?.(bytes) === true ? request : response
  return side.scan(bytes, () => undefined)?.used
}

/** The chunk without its secrets. The pieces end with it, but the first may have begun in an earlier chunk. */
function masked(chunk: Buffer, pieces: readonly Piece[], explanations: readonly FrameExplanation[]): Buffer {
  const all = Buffer.concat(pieces.map(({ bytes }, i) => maskSecrets(bytes, explanations[i])))
  return all.subarray(all.length - chunk.length)
}

/** What a scan finds, or `undefined` when the bytes are nothing it knows: a trace shows them all the same. */
function attempt<T>(scan: () => T): T | undefined {
  try {
    return scan()
  } catch (error) {
    if (error instanceof PlcError) return undefined
    throw error
  }
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

/** The last entries of a trace, for looking back after something went wrong. */
export class TraceBuffer {
  #entries: TraceEntry[] = []

  /** @param size entries that are kept */
  constructor(readonly size: number) {}

  add(entry: TraceEntry): void {
    this.#entries.push(entry)
    if (this.#entries.length > this.size) this.#entries.shift()
  }

  /** Oldest first. */
  get entries(): readonly TraceEntry[] {
    return [...this.#entries]
  }
}
