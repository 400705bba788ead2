// Files of the CPU (SLMP reference manual 5.8): the procedures of the manual, so that a caller names a file and is done.
import { Readable } from 'node:stream'
import type { OptionNames } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { RequestError } from '../../errors'
import { commands } from '../../melsec/commands/commands'
import type { FileTime } from '../../melsec/file/time'
import type { Drive, Profile } from '../../melsec/profiles/profile'
import { type CallOptions, callOptionsOf } from '../connection/call'
import { type FileEntry, listDirectory, statOf } from './list'
import type { FileCalls, OpenFile } from './open-file'
import { type FilePath, type FilePlace, fileOf, filePlaceOf } from './place'
import { type FileProgress, readChunks } from './read'
import { contentOf, copyFile, type FileData, type WriteMode, writeFile } from './write'

export type { FileEntry } from './list'
export type { FilePath } from './place'
export type { FileProgress } from './read'
export type { FileData } from './write'

/** What every call about files may say. `timeout` counts for each of its requests anew: files can be long. */
export interface FileOptions extends CallOptions {
  /** Password of the file; '' for none. 4 characters on Q and L. */
  readonly password?: string
}

/** What a call that reads a file may say. */
export interface FileReadOptions extends FileOptions {
  /** Told after each request. What it throws is not listened to. */
  readonly onProgress?: (progress: FileProgress) => void
  /** Largest file that is read into memory, bytes; default 64 MiB. `readStream` has no such bound. */
  readonly limit?: number
}

/** What a call that writes a file may say. */
export interface FileWriteOptions extends FileOptions {
  /** Told after each request. What it throws is not listened to. */
  readonly onProgress?: (progress: FileProgress) => void
  /**
   * `new` (default): there must be no file of this name. `replace`: the new content goes to another file of the same
   * directory first, which takes the name when it is complete: a transfer that fails leaves the old file as it was.
   * `overwrite`: into the file itself, which must have the same size.
   */
  readonly mode?: WriteMode
  /** Bytes there will be: needed when the data are a stream or another iterable, because New File reserves them. */
  readonly size?: number
}

/** What a call that copies a file may say. */
export interface CopyOptions extends FileOptions {
  /** Password the copy gets; default: that of the source. */
  readonly destinationPassword?: string
}

/**
 * Files on the drives of the CPU. Reading needs no permission, everything else `allowWrites`. Nothing is ever repeated
 * by itself.
 *
 * Files of a project ($MELPRJ$) belong together: save and restore them as a whole, and never edit them. Deleting files
 * of a running system can stop it.
 */
export interface Files {
  /** Drives of the profile. A card must be in its slot all the same. */
  readonly drives: readonly Drive[]
  /**
   * Entries of a directory, without `.` and `..`.
   * @throws EndCodeError when there is no such drive or directory
   * @example await plc.files.list('4:/LOG')
   */
  list(directory: FilePath, options?: CallOptions): Promise<FileEntry[]>
  /** One file or directory; `undefined` when there is none. @example await plc.files.stat('4:/LOG/LINE.CSV') */
  stat(file: FilePath, options?: CallOptions): Promise<FileEntry | undefined>
  /** The content. The file is locked against changes meanwhile. @example const csv = await plc.files.read('2:/LOG.CSV') */
  read(file: FilePath, options?: FileReadOptions): Promise<Buffer>
  /** The same as a stream, for files of any size. Destroying it closes the file in the PLC. */
  readStream(file: FilePath, options?: Omit<FileReadOptions, 'limit'>): Readable
  /**
   * Makes or replaces a file. Resolves when the PLC has closed it.
   * @throws RequestError when the name is taken and `mode` does not say what then
   * @example await plc.files.write('4:/RECIPE.CSV', Buffer.from('1,2,3'), { mode: 'replace' })
   * @example await plc.files.write('2:/BIG.CSV', createReadStream('big.csv'), { size: (await stat('big.csv')).size })
   */
  write(file: FilePath, data: FileData, options?: FileWriteOptions): Promise<void>
  /** Copies within the PLC, also to another drive. The destination must not exist. */
  copy(from: FilePath, to: FilePath, options?: CopyOptions): Promise<void>
  /** Deletes a file. */
  remove(file: FilePath, options?: FileOptions): Promise<void>
  /** Makes a file read-only, or takes it off again. Needs `allowWrites`. */
  setAttribute(file: FilePath, attribute: 'readOnly' | 'readWrite', options?: FileOptions): Promise<void>
  /** Date of the last change, in the PLC's time zone; see `fileTimeOf` for a `Date`. */
  setDate(file: FilePath, date: FileTime, options?: CallOptions): Promise<void>
  /**
   * Closes every file that the PLC has locked for this computer: what a transfer leaves whose connection was lost. Also
   * files that other transfers have open: those of this client end with CLOSED. Call it when no other client of this
   * computer transfers files: its pointer would mean another file.
   */
  closeAll(options?: CallOptions): Promise<void>
}

/** What the client lends. */
export interface FileParts {
  readonly profile: Profile
  /** Why files cannot be opened over this connection, in words. */
  readonly unusable: string | undefined
  /** @throws RequestError NOT_PERMITTED */
  readonly permitWrite: (title: string) => void
  readonly calls: (options: CallOptions) => FileCalls
  /** What is open now. */
  readonly open: ReadonlySet<OpenFile>
  /** How often all files were closed at once. */
  readonly closings: { count: number }
}

/** Largest file that is read into memory without being asked for, bytes. */
const LARGEST = 64 * 1024 * 1024

/** Values of Change File State. */
const ATTRIBUTES = { readOnly: 0x01, readWrite: 0x20 } as const

/** Options that only calls about files have. */
type Own<Options> = OptionNames<Omit<Options, keyof CallOptions>>
const FILE_OPTIONS: Own<FileOptions> = { password: true }
const STREAM_OPTIONS: Own<Omit<FileReadOptions, 'limit'>> = { ...FILE_OPTIONS, onProgress: true }
const READ_OPTIONS: Own<FileReadOptions> = { ...STREAM_OPTIONS, limit: true }
const WRITE_OPTIONS: Own<FileWriteOptions> = { ...FILE_OPTIONS, onProgress: true, mode: true, size: true }
const COPY_OPTIONS: Own<CopyOptions> = { ...FILE_OPTIONS, destinationPassword: true }

/** What is the same for every call about one file. */
interface Begun {
  readonly calls: FileCalls
  readonly place: FilePlace
  readonly password: string
}

export class FileAccess implements Files {
  readonly #parts: FileParts

  constructor(parts: FileParts) {
    this.#parts = parts
  }

  get drives(): readonly Drive[] {
    return this.#parts.profile.files.drives
  }

  async list(directory: FilePath, options: CallOptions = {}): Promise<FileEntry[]> {
    const calls = this.#parts.calls(callOptionsOf(options))
    return listDirectory(calls, filePlaceOf(directory, this.#parts.profile))
  }

  async stat(file: FilePath, options: CallOptions = {}): Promise<FileEntry | undefined> {
    const calls = this.#parts.calls(callOptionsOf(options))
    return statOf(calls, fileOf(file, this.#parts.profile))
  }

  async read(file: FilePath, options: FileReadOptions = {}): Promise<Buffer> {
    const chunks: Buffer[] = []
    for await (const chunk of this.#chunks(file, options, READ_OPTIONS, LARGEST)) chunks.push(chunk)
    return Buffer.concat(chunks)
  }

  readStream(file: FilePath, options: Omit<FileReadOptions, 'limit'> = {}): Readable {
    return Readable.from(this.#chunks(file, options, STREAM_OPTIONS, Number.POSITIVE_INFINITY), { objectMode: false })
  }

  #chunks(
    file: FilePath,
    options: FileReadOptions,
    names: Readonly<Record<string, true>>,
    largest: number,
  ): AsyncGenerator<Buffer> {
    const { calls, place, password } = this.#begin(file, options, names)
    this.#checkUsable()
    const { limit = largest, onProgress } = options
    if (!(typeof limit === 'number' && limit >= 0)) {
      throw new RequestError('BAD_OPTION', `limit is ${shown(limit)}; it is a number of bytes.`, 'limit')
    }
    return readChunks(calls, place, { password, limit, onProgress: listenerOf(onProgress) })
  }

  async write(file: FilePath, data: FileData, options: FileWriteOptions = {}): Promise<void> {
    this.#parts.permitWrite('Writing a file')
    const { calls, place, password } = this.#begin(file, options, WRITE_OPTIONS)
    this.#checkUsable()
    const { mode = 'new', size, onProgress } = options
    const content = contentOf(data, size)
    await writeFile(calls, place, { password, content, onProgress: listenerOf(onProgress) }, mode)
  }

  async copy(from: FilePath, to: FilePath, options: CopyOptions = {}): Promise<void> {
    const { calls, place, password } = this.#begin(from, options, COPY_OPTIONS)
    const { destinationPassword = password } = options
    checkPassword(destinationPassword, 'destinationPassword')
    const destination = fileOf(to, this.#parts.profile)
    await copyFile(calls, { place, password }, { place: destination, password: destinationPassword })
  }

  async remove(file: FilePath, options: FileOptions = {}): Promise<void> {
    const { calls, place, password } = this.#begin(file, options, FILE_OPTIONS)
    await calls.send(commands.deleteFile, { password, drive: place.drive, name: place.path })
  }

  async setAttribute(file: FilePath, attribute: 'readOnly' | 'readWrite', options: FileOptions = {}): Promise<void> {
    const { calls, place, password } = this.#begin(file, options, FILE_OPTIONS)
    if (typeof attribute !== 'string' || !Object.hasOwn(ATTRIBUTES, attribute)) {
      const known = Object.keys(ATTRIBUTES).join(' or ')
      throw new RequestError('BAD_VALUE', `The attribute is ${shown(attribute)}; it is ${known}.`, 'attribute')
    }
    const message = { password, drive: place.drive, name: place.path, attribute: ATTRIBUTES[attribute] }
    await calls.send(commands.changeFileState, message)
  }

  async setDate(file: FilePath, date: FileTime, options: CallOptions = {}): Promise<void> {
    const { calls, place } = this.#begin(file, options, {})
    await calls.send(commands.changeFileDate, { drive: place.drive, name: place.path, date })
  }

  async closeAll(options: CallOptions = {}): Promise<void> {
    // What cannot be sent must not end the transfers, whose files would stay locked.
    const call = callOptionsOf(options)
    // The next file that is opened gets the pointer of one of these, and must not get what is written to it.
    this.#parts.closings.count++
    for (const file of this.#parts.open) file.leave()
    // With this close type the number of the pointer does not matter.
    await this.#parts.calls(call).send(commands.closeFile, { pointer: 0, closeType: 1 })
  }

  /** Before the client is closed: what is open would stay locked in the PLC. Undefined when nothing is. */
  release(): Promise<unknown> | undefined {
    const { open } = this.#parts
    // Whatever becomes of it, the connection ends now.
    return open.size === 0 ? undefined : Promise.allSettled([...open].map((file) => file.close()))
  }

  #begin(file: FilePath, options: FileOptions, names: Readonly<Record<string, true>>): Begun {
    const calls = this.#parts.calls(callOptionsOf(options, names))
    const { password = '' } = options
    checkPassword(password, 'password')
    return { calls, password, place: fileOf(file, this.#parts.profile) }
  }

  #checkUsable(): void {
    const { unusable } = this.#parts
    if (unusable !== undefined) throw new RequestError('UNSUPPORTED', unusable)
  }
}

/** The rest is checked where it is encoded. @throws RequestError BAD_OPTION, without the password in it */
function checkPassword(password: unknown, option: string): void {
  if (typeof password === 'string') return
  throw new RequestError('BAD_OPTION', `${option} is no text; '' is none.`, option)
}

type Listener = (progress: FileProgress) => void

/** @throws RequestError BAD_OPTION */
function listenerOf(listener: Listener | undefined): Listener {
  if (listener === undefined) return () => {}
  if (typeof listener === 'function') return listener
  throw new RequestError('BAD_OPTION', `onProgress is ${shown(listener)}; it is a function.`, 'onProgress')
}
