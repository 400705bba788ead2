// A file while it is open in the PLC: it is locked there until it is closed, so it is closed whatever happens.
import { ClosedError, PlcError, ProtocolError, RequestError, UnfinishedError } from '../../errors'
import type { Command, RequestOf, ResponseOf } from '../../melsec/commands/command'
import { commands } from '../../melsec/commands/commands'
import type { FilePlace } from './place'

type FileCommand = Command<(typeof commands)[keyof typeof commands], string>

export interface FileSend {
  /** Number of the connection it belongs to. */
  readonly onlyOn?: number
  /** `always`: sent although the call was aborted; `onceSent`: its answer is waited for whatever happens meanwhile. */
  readonly unaborted?: 'always' | 'onceSent'
}

/** How one call sends its requests. */
export interface FileCalls {
  send<C extends FileCommand>(command: C, message: RequestOf<C>, options?: FileSend): Promise<ResponseOf<C>>
  /** Number of the connection that is up. */
  connection(): number
  /** Files that are open over this client: they are closed before it is. */
  readonly open: Set<OpenFile>
  /** How often all files were closed at once. */
  readonly closings: { count: number }
}

/** Bytes of one request (SLMP reference manual 5.8, Read File and Write File). Offsets are multiples of it: even, and of 4. */
const FILE_CHUNK = 1920

const MODES = { read: 0x0000, write: 0x0100 } as const

/** Runs `use` with the file open, and closes it. The first error counts; one of closing is told with it. */
export async function withOpenFile<T>(
  calls: FileCalls,
  place: FilePlace,
  mode: keyof typeof MODES,
  password: string,
  use: (file: OpenFile) => Promise<T>,
): Promise<T> {
  const file = await OpenFile.open(calls, place, mode, password)
  let result: T
  try {
    result = await use(file)
  } catch (error) {
    throw await alsoAfter(error, notClosed(place), () => file.close())
  }
  await file.close()
  return result
}

const LOCKED = 'it may be locked there until closeAll() or its restart'

/** What is wrong when closing fails. */
export function notClosed(place: FilePlace): string {
  return `${place.text} could not be closed, and may be locked in the PLC until closeAll() or its restart`
}

/** Also errors of another realm, as the sandbox of a Node-RED function node makes them. */
function hasMessage(error: unknown): error is { message: string } {
  return typeof error === 'object' && error !== null && 'message' in error && typeof error.message === 'string'
}

export function textOf(error: unknown): string {
  return hasMessage(error) ? error.message : String(error)
}

/** Says more in an error. @returns the error, or one in its place: those of an AbortSignal cannot be changed */
export function note(error: unknown, text: string): unknown {
  if (!(error instanceof PlcError)) return unfinished(error, text)
  error.message = `${error.message} ${text}`
  return error
}

/** The error of a call that has changed the PLC already. @param text what is there now */
export function unfinished(error: unknown, text: string): UnfinishedError {
  return new UnfinishedError(`${text} ${textOf(error)}`, error)
}

/** Whether nobody knows if the PLC has carried the request out. */
export function isUnknown(error: unknown): boolean {
  return !(error instanceof PlcError) || error.outcome === 'unknown'
}

/** Does what must follow an error. @returns the error; when that fails too, it says so */
export async function alsoAfter(error: unknown, what: string, run: () => Promise<void>): Promise<unknown> {
  try {
    await run()
    return error
  } catch (second) {
    const left = `${what}: ${textOf(second)}`
    // Nobody may take it for a call that has left nothing behind.
    return isUnknown(error) ? note(error, left) : unfinished(error, `${left} What failed first:`)
  }
}

export class OpenFile {
  readonly #calls: FileCalls
  readonly #place: FilePlace
  readonly #pointer: number
  /** The pointer means this file on this connection only. */
  readonly #connection: number
  #closing: Promise<unknown> | undefined

  private constructor(calls: FileCalls, place: FilePlace, pointer: number) {
    this.#calls = calls
    this.#place = place
    this.#pointer = pointer
    this.#connection = calls.connection()
  }

  static async open(calls: FileCalls, place: FilePlace, mode: keyof typeof MODES, password: string): Promise<OpenFile> {
    const { drive, path: name } = place
    const message = { password, mode: MODES[mode], drive, name }
    const { count } = calls.closings
    // Given up on the way it would be open and nobody knew its pointer.
    const { pointer } = await calls.send(commands.openFile, message, { unaborted: 'onceSent' }).catch((error) => {
      throw isUnknown(error) ? note(error, `If the PLC has opened ${place.text}, ${LOCKED}.`) : error
    })
    if (calls.closings.count !== count) {
      throw new ClosedError('CLOSED', `${place.text} was closed by closeAll() as soon as it was open.`)
    }
    const file = new OpenFile(calls, place, pointer)
    calls.open.add(file)
    return file
  }

  /** All of it, in chunks of at most 1920 bytes. @throws ProtocolError when the PLC sends less than its size */
  async *chunks(size: number): AsyncGenerator<Buffer> {
    for (let offset = 0; offset < size; offset += FILE_CHUNK) {
      const byteCount = Math.min(FILE_CHUNK, size - offset)
      const { data } = await this.#send(commands.readFile, { pointer: this.#pointer, offset, byteCount })
      if (data.length !== byteCount) {
        const found = `${data.length} bytes at ${offset} of ${this.#place.text}, not ${byteCount}`
        throw new ProtocolError('BAD_FIELD', `The PLC sent ${found}: the file is not what its directory says.`)
      }
      yield Buffer.from(data)
    }
  }

  /** Writes bytes at an offset; every offset but the last chunk's end is a multiple of 1920. */
  async write(offset: number, data: Uint8Array): Promise<void> {
    const { written } = await this.#send(commands.writeFile, { pointer: this.#pointer, offset, data })
    if (written === data.length) return
    const found = `${written} of ${data.length} bytes at ${offset} of ${this.#place.text}`
    throw new ProtocolError('BAD_FIELD', `The PLC says that it wrote ${found}.`)
  }

  /** Not aborted with the rest: an aborted transfer must not leave the file locked. */
  async close(): Promise<void> {
    const { open } = this.#calls
    this.#closing ??= this.#request(commands.closeFile, { pointer: this.#pointer }, { unaborted: 'always' })
    try {
      await this.#closing
    } finally {
      open.delete(this)
    }
  }

  /** The PLC closes it without being told which: from now on its pointer may mean another file. */
  leave(): void {
    this.#closing ??= Promise.resolve()
    this.#calls.open.delete(this)
  }

  #send<C extends FileCommand>(command: C, message: RequestOf<C>): Promise<ResponseOf<C>> {
    if (this.#closing === undefined) return this.#request(command, message)
    const text = `${command.title} was not sent: ${this.#place.text} has been closed: the client was, or closeAll() called.`
    return Promise.reject(new ClosedError('CLOSED', text))
  }

  #request<C extends FileCommand>(command: C, message: RequestOf<C>, options: FileSend = {}): Promise<ResponseOf<C>> {
    return this.#calls.send(command, message, { ...options, onlyOn: this.#connection })
  }
}

/** Cuts what is to be written into chunks of 1920 bytes. @throws RequestError BAD_VALUE for what is no bytes */
export async function* chunksOf(source: Iterable<Uint8Array> | AsyncIterable<Uint8Array>): AsyncGenerator<Buffer> {
  let rest: Buffer = Buffer.alloc(0)
  for await (const part of source) {
    if (!(part instanceof Uint8Array)) {
      throw new RequestError('BAD_VALUE', 'What is written to a file is bytes: Buffers or Uint8Arrays.', 'data')
    }
    rest = Buffer.concat([rest, part])
    for (; rest.length >= FILE_CHUNK; rest = rest.subarray(FILE_CHUNK)) yield rest.subarray(0, FILE_CHUNK)
  }
  if (rest.length > 0) yield rest
}
