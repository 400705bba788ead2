// A frame in words: what the explainers of every protocol build, and how it is printed.
import { type AnnotatedRow, type AnnotateOptions, annotate, type FrameFault, MASK, showBytes } from './annotate'
import type { DataCode } from './data-code'
import type { Message, Shape } from './field'

export {
  type AnnotatedRow,
  type Annotation,
  annotate,
  type FrameFault,
  type Leaf,
  plainText,
  showBytes,
} from './annotate'

/** Which way a frame goes: to the PLC or from it. */
export type Direction = 'request' | 'response'

/** A frame explained field by field, as plain data. */
export interface FrameExplanation {
  /** One line, e.g. `4E request, binary code: Read (word units), D100, 10 points`. */
  readonly title: string
  /** e.g. `4E`; absent when the bytes are no frame that could be told. */
  readonly frame?: string
  /** Data code; absent when it could not be told. */
  readonly code?: DataCode
  /** Request or response; absent when it could not be told. */
  readonly direction?: Direction
  /** Serial number, where the frame has one. */
  readonly serial?: number
  /** Name of the command's declaration, when it is known. */
  readonly command?: string
  /** Of a response; 0 is success. */
  readonly endCode?: number
  /** Every byte of the frame exactly once, in order; behind a fault what could not be read. */
  readonly rows: readonly AnnotatedRow[]
  /** Where the frame is wrong and why; absent when it is right. */
  readonly fault?: FrameFault
  /** What a reader should know besides. */
  readonly notes: readonly string[]
  /** Bytes behind the frame that are not in `rows`. */
  readonly rest: number
}

type Describe = NonNullable<AnnotateOptions['describe']>

/** Makes a row with its bytes into several; `message` is what was read. */
export type Refine = (row: AnnotatedRow, bytes: Buffer, message: Message) => readonly AnnotatedRow[]

/** What a frame is said to be, beside its rows. */
export type About = Omit<FrameExplanation, 'rows' | 'fault' | 'notes' | 'rest'>

/** Reads a frame piece by piece and keeps the rows. After a fault nothing more is read. */
export class Explainer {
  readonly #rows: AnnotatedRow[] = []
  readonly notes: string[] = []
  #bytes: Buffer
  #position = 0
  #fault: FrameFault | undefined

  constructor(
    bytes: Buffer,
    readonly code: DataCode,
  ) {
    this.#bytes = bytes
  }

  /** Offset of what is read next. */
  get position(): number {
    return this.#position
  }

  /** Bytes that can still be read. */
  get remaining(): number {
    return this.#bytes.length - this.#position
  }

  get fault(): FrameFault | undefined {
    return this.#fault
  }

  /** Bytes of one byte of the message: two characters in ASCII code. */
  get unit(): 1 | 2 {
    return this.code === 'ascii' ? 2 : 1
  }

  /** The bytes that can still be read, to look at. */
  ahead(): Buffer {
    return this.#bytes.subarray(this.#position)
  }

  /** Nothing behind `end` belongs to the frame. */
  limit(end: number): void {
    this.#bytes = this.#bytes.subarray(0, end)
  }

  /**
   * Reads a message of `shape` at the present position.
   * @returns the message, as far as it could be read; see `fault`.
   */
  read(
    shape: Shape,
    describe: Describe,
    options: Pick<AnnotateOptions, 'form' | 'context'> = {},
    refine: Refine = (row) => [row],
  ): Message {
    if (this.#fault !== undefined) return {}
    const base = this.#position
    const found = annotate(shape, this.#bytes.subarray(base), { ...options, code: this.code, base, describe })
    for (const row of found.rows) {
      this.#rows.push(...refine(row, this.#bytes.subarray(row.offset, row.offset + row.length), found.message))
    }
    this.notes.push(...found.notes)
    this.#position = base + found.used
    this.#fault = found.fault
    return found.message
  }

  /** Says what is wrong; the first thing that is wrong counts. */
  fail(offset: number, message: string, name?: string): void {
    this.#fault ??= { offset, message, ...(name === undefined ? {} : { name }) }
  }

  /** The frame says that more bytes belong to it than there are. */
  cutShort(missing: number, announced: number): void {
    const message = `the frame is cut short: ${missing} of the ${announced} bytes it announces are missing`
    if (this.#fault === undefined) this.fail(this.#bytes.length, message)
    else this.notes.push(`${message[0]?.toUpperCase()}${message.slice(1)}.`)
  }

  /** Takes the next `length` bytes as one row. */
  take(length: number, row: Pick<AnnotatedRow, 'name' | 'kind' | 'text'>, secret = false): void {
    if (length === 0) return
    const bytes = this.#bytes.subarray(this.#position, this.#position + length)
    const shown = showBytes(bytes, this.code, secret)
    const offset = this.#position
    this.#rows.push({ offset, length, value: shown, bytes: shown, ...row, ...(secret ? { secret } : {}) })
    this.#position += length
  }

  /** Ends the frame: what is left of it was not read, because of a fault or because it should not be there. */
  end(about: About, total: number, secret = false): FrameExplanation {
    if (this.remaining > 0) {
      this.fail(this.#position, `${this.remaining} byte(s) left over`)
      this.take(this.remaining, { name: 'not read', kind: 'bytes', text: 'not read' }, secret)
    }
    return {
      ...about,
      rows: this.#rows,
      ...(this.#fault === undefined ? {} : { fault: this.#fault }),
      notes: this.notes,
      rest: total - this.#bytes.length,
    }
  }
}

/** The explanation of bytes that nothing can be told of. */
export function notAFrame(bytes: Buffer, reason: string, notes: readonly string[] = []): FrameExplanation {
  const explainer = new Explainer(bytes, 'binary')
  explainer.fail(0, reason)
  explainer.notes.push(...notes)
  return explainer.end({ title: 'Not a frame that is known here' }, bytes.length)
}

const BYTES_PER_LINE = { binary: 16, ascii: 32 } as const

/**
 * The explanation as aligned text: a line with the title, one per row (offset, bytes, field, meaning), then what is
 * wrong and the notes.
 * @example console.log(formatExplanation(explainFrame(bytes)))
 */
export function formatExplanation(explanation: FrameExplanation): string {
  const { title, rows, fault, notes, rest, code = 'binary' } = explanation
  const shown = rows.filter((row) => row.length > 0)
  const pieces = shown.map((row) => piecesOf(row.bytes, code))
  const bytesWidth = Math.max(0, ...pieces.flat().map((piece) => piece.length))
  const nameWidth = Math.max(0, ...shown.map(({ name }) => name.length))
  const offsetWidth = Math.max(4, ...shown.map(({ offset }) => String(offset).length))
  const lines = shown.flatMap((row, i) =>
    (pieces[i] ?? []).map((piece, part) => {
      const start = part === 0 ? String(row.offset) : ''
      const head = `  ${start.padStart(offsetWidth)}  ${piece.padEnd(bytesWidth)}`
      return part === 0 ? `${head}  ${row.name.padEnd(nameWidth)}  ${row.text}`.trimEnd() : head.trimEnd()
    }),
  )
  const wrong = fault === undefined ? [] : [`  Wrong at ${placeOf(fault)}: ${fault.message}.`]
  const behind = rest > 0 ? [`  ${rest} byte(s) follow this frame.`] : []
  return [title, ...lines, ...wrong, ...notes.map((note) => `  Note: ${note}`), ...behind].join('\n')
}

function placeOf({ offset, name }: FrameFault): string {
  return name === undefined ? `byte ${offset}` : `byte ${offset} (${name})`
}

function piecesOf(shown: string, code: DataCode): readonly string[] {
  const size = code === 'ascii' ? BYTES_PER_LINE.ascii : BYTES_PER_LINE.binary * 3
  const pieces: string[] = []
  for (let at = 0; at < shown.length; at += size) pieces.push(shown.slice(at, at + size).trimEnd())
  return pieces
}

/** The bytes of a frame without its secrets: asterisks in their place, everything else as it is. */
export function maskSecrets(bytes: Buffer, explanation: FrameExplanation | undefined): Buffer {
  const secrets = explanation?.rows.filter((row) => row.secret === true) ?? []
  if (secrets.length === 0) return bytes
  const masked = Buffer.from(bytes)
  for (const { offset, length } of secrets) masked.fill(MASK[0] ?? '*', offset, offset + length)
  return masked
}
