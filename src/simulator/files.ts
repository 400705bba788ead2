// Files of the simulated PLC: what the file commands do, in which order they must come, and what is refused
// (SLMP reference manual 5.8).

import { isNeverInPlace, isProjectFile } from '../melsec/file/project-file'
import type { FileTime } from '../melsec/file/time'
import { isFileTime } from '../melsec/file/time'
import type { Profile } from '../melsec/profiles/profile'
import type { CpuState } from './cpu'
import { type DriveEntry, type DrivePath, keyOf, pathOf } from './drive'
import type { MountedDrive } from './drives'
import { Refusal, requestErrors } from './refusal'

/** Who asks: locks are his. */
export interface FileOwner {
  readonly owner: string
}

/** A file that Open File has locked. */
export interface OpenFile {
  /** Its file pointer number. */
  readonly pointer: number
  /** External device. */
  readonly owner: string
  /** What it was opened for. */
  readonly mode: 'read' | 'write'
  /** Number of the drive. */
  readonly drive: number
  /** e.g. `LOG\\LINE.CSV` */
  readonly name: string
}

interface Opened extends OpenFile {
  readonly path: DrivePath
  /** The connection it was opened on. */
  readonly session: FileOwner
}

export interface FilesParts {
  readonly profile: Profile
  readonly drives: ReadonlyMap<number, MountedDrive>
  readonly cpu: () => CpuState
  /** The clock of the PLC. */
  readonly now: () => FileTime
  readonly maxOpenFiles: number
  /** Whether a connection that ends leaves its files locked, as the manual says. */
  readonly fileLocks: 'kept' | 'released'
}

/** A file that was asked for. */
interface Place {
  readonly number: number
  readonly mounted: MountedDrive
  readonly path: DrivePath
  /** For messages. */
  readonly text: string
}

export class SimulatedFiles {
  readonly #parts: FilesParts
  #open: readonly Opened[] = []

  constructor(parts: FilesParts) {
    this.#parts = parts
  }

  get open(): readonly OpenFile[] {
    return this.#open.map(({ pointer, owner, mode, drive, name }) => ({ pointer, owner, mode, drive, name }))
  }

  /** Restarting the module releases every lock. */
  down(): void {
    this.#open = []
  }

  /** A connection has ended. */
  disconnected(session: FileOwner): void {
    if (this.#parts.fileLocks === 'released') this.#close((file) => file.session === session)
  }

  /** What is in a directory, `.` and `..` not among it; path '' is the root. */
  list(drive: number, path: string): readonly DriveEntry[] {
    const { refusals } = this.#parts.profile.files
    const { mounted } = this.#drive(drive)
    const root = path === '' || path === '\\'
    const names = root ? [] : pathOf(path)
    const found = names === undefined ? undefined : this.#guarded(() => mounted.drive.list(names))
    return found ?? refuse(refusals.directory, `there is no directory ${path}`)
  }

  /** The file or directory of a name. */
  find(drive: number, name: string): DriveEntry {
    return this.#there(this.#place(drive, name))
  }

  create(drive: number, name: string, size: number, password: string): void {
    const { refusals } = this.#parts.profile.files
    const place = this.#place(drive, name)
    if (isProjectFile(name)) refuse(refusals.kind, `${place.text} is part of a project: copy it to this name instead`)
    this.#makeRoom(place, size)
    this.#guarded(() => place.mounted.drive.create(place.path, size, this.#parts.now()))
    setPassword(place, password)
  }

  remove(drive: number, name: string, password: string): void {
    const place = this.#changed(drive, name, password)
    this.#checkStopped(place, /\.(QPG|QPA|QBT)$/i)
    this.#checkWritable(place)
    this.#guarded(() => place.mounted.drive.remove(place.path))
    setPassword(place, '')
  }

  copy(source: CopySide, destination: CopySide): void {
    const from = this.#place(source.drive, source.name)
    const { size } = this.#file(from, source.password)
    this.#checkStopped(from)
    if (this.#open.some((file) => file.mode === 'write' && isAt(file, from))) this.#refuseLocked(from)
    const to = this.#place(destination.drive, destination.name)
    this.#checkStopped(to)
    this.#makeRoom(to, size)
    this.#guarded(() => {
      const data = from.mounted.drive.read(from.path, 0, size)
      to.mounted.drive.create(to.path, size, this.#parts.now())
      to.mounted.drive.write(to.path, 0, data)
    })
    setPassword(to, destination.password)
  }

  setReadOnly(drive: number, name: string, password: string, readOnly: boolean): void {
    const place = this.#changed(drive, name, password)
    this.#checkStopped(place)
    this.#guarded(() => place.mounted.drive.setReadOnly(place.path, readOnly))
  }

  setModified(drive: number, name: string, modified: FileTime): void {
    if (!isFileTime(modified)) refuse(requestErrors.content, 'Change File Date: there is no such date')
    const place = this.#place(drive, name)
    this.#there(place)
    this.#checkUnprotected(place)
    this.#checkStopped(place)
    this.#guarded(() => place.mounted.drive.setModified(place.path, modified))
  }

  openFile(session: FileOwner, drive: number, name: string, password: string, mode: 'read' | 'write'): number {
    const place = this.#place(drive, name)
    this.#file(place, password)
    if (mode === 'write') {
      this.#checkUnprotected(place)
      this.#checkWritable(place)
    }
    // Many may read; whoever writes is alone.
    const others = this.#open.filter((file) => isAt(file, place))
    if (others.length > 0 && (mode === 'write' || others.some((file) => file.mode === 'write')))
      this.#refuseLocked(place)
    if (this.#open.length >= this.#parts.maxOpenFiles) this.#refuseNow(`${this.#open.length} files are open`)
    const pointer = this.#freePointer()
    const { number, path, text } = place
    const opened = { pointer, owner: session.owner, session, mode, drive: number, name: text, path }
    this.#open = [...this.#open, opened]
    return pointer
  }

  read({ owner }: FileOwner, pointer: number, offset: number, count: number): Buffer {
    const { path, mounted, size } = this.#opened(owner, pointer)
    this.#checkRange(offset, count, size)
    return this.#guarded(() => mounted.drive.read(path, offset, count))
  }

  write({ owner }: FileOwner, pointer: number, offset: number, data: Uint8Array): void {
    const opened = this.#opened(owner, pointer)
    const { mounted, number, path, size, mode, text } = opened
    if (mode !== 'write') this.#refuseNow(`file pointer ${pointer} was opened for reading`)
    this.#checkUnprotected(opened)
    if (isNeverInPlace(text)) refuse(this.#parts.profile.files.refusals.kind, `${text} is never written in its place`)
    this.#checkStopped(opened)
    // 5.8 Write File, offset address: multiples of 4 in program memory.
    if (number === 0 && offset % 4 !== 0) refuse(requestErrors.content, 'Write File: offset is no multiple of 4')
    this.#checkRange(offset, data.length, size)
    this.#guarded(() => {
      mounted.drive.write(path, offset, data)
      mounted.drive.setModified(path, this.#parts.now())
    })
  }

  /** `all`: every file of this external device, whichever pointer was said. */
  closeFile({ owner }: FileOwner, pointer: number, all: boolean): void {
    if (all) {
      this.#close((file) => file.owner === owner)
      return
    }
    this.#opened(owner, pointer)
    this.#close((file) => file.pointer === pointer)
  }

  #close(which: (file: Opened) => boolean): void {
    this.#open = this.#open.filter((file) => !which(file))
  }

  #freePointer(): number {
    let pointer = 0
    while (this.#open.some((file) => file.pointer === pointer)) pointer++
    return pointer
  }

  #drive(number: number): { readonly number: number; readonly mounted: MountedDrive } {
    const { drives, refusals } = this.#parts.profile.files
    const own = drives.find((drive) => drive.number === number)?.same ?? number
    const mounted = this.#parts.drives.get(own)
    return mounted === undefined ? refuse(refusals.drive, `there is no drive ${number}`) : { number: own, mounted }
  }

  #place(drive: number, name: string): Place {
    const { refusals } = this.#parts.profile.files
    const path = pathOf(name)
    if (path === undefined) refuse(refusals.name, `${JSON.stringify(name)} is no file name`)
    return { ...this.#drive(drive), path, text: path.join('\\') }
  }

  #there({ mounted, path, text }: Place): DriveEntry {
    const found = this.#guarded(() => mounted.drive.find(path))
    return found ?? refuse(this.#parts.profile.files.refusals.notFound, `there is no file ${text}`)
  }

  /** A file, no directory, whose password was said. */
  #file(place: Place, password: string): DriveEntry {
    const { refusals } = this.#parts.profile.files
    const found = this.#there(place)
    if (found.directory) refuse(refusals.notFound, `${place.text} is a directory`)
    const own = place.mounted.passwords.get(keyOf(place.path)) ?? ''
    if (own !== '' && own !== password) refuse(refusals.password, `wrong or no password for ${place.text}`)
    return found
  }

  /** A file that is about to be deleted or changed as a whole: nobody has it open. */
  #changed(drive: number, name: string, password: string): Place {
    const place = this.#place(drive, name)
    this.#file(place, password)
    this.#checkUnprotected(place)
    if (this.#open.some((file) => isAt(file, place))) this.#refuseLocked(place)
    return place
  }

  #makeRoom(place: Place, size: number): void {
    const { refusals } = this.#parts.profile.files
    const { mounted, path, text } = place
    this.#checkUnprotected(place)
    const directory = this.#guarded(() => mounted.drive.list(path.slice(0, -1)))
    if (directory === undefined) refuse(refusals.directory, `there is no directory for ${text}`)
    if (this.#guarded(() => mounted.drive.find(path)) !== undefined) refuse(refusals.exists, `${text} is there already`)
    const used = this.#guarded(() => mounted.drive.used())
    if (used + size > mounted.capacity) refuse(refusals.space, `${size} bytes for ${text} do not fit`)
  }

  #opened(owner: string, pointer: number): Place & { readonly size: number; readonly mode: OpenFile['mode'] } {
    const { refusals } = this.#parts.profile.files
    const file = this.#open.find((opened) => opened.pointer === pointer)
    if (file === undefined) refuse(refusals.pointer, `no file is open under file pointer ${pointer}`)
    if (file.owner !== owner) refuse(refusals.locked, `file pointer ${pointer} belongs to ${file.owner}`)
    const place = { ...this.#drive(file.drive), path: file.path, text: file.name }
    return { ...place, mode: file.mode, size: this.#there(place).size }
  }

  #checkRange(offset: number, count: number, size: number): void {
    if (offset + count <= size) return
    refuse(this.#parts.profile.files.refusals.range, `${count} bytes from ${offset} of a file of ${size} bytes`)
  }

  #checkUnprotected({ number, mounted }: Place): void {
    const { refusals } = this.#parts.profile.files
    if (mounted.writeProtected) refuse(refusals.writeProtected, `drive ${number} is write-protected`)
  }

  #checkWritable(place: Place): void {
    if (!this.#there(place).readOnly) return
    refuse(this.#parts.profile.files.refusals.readOnly, `${place.text} is read-only`)
  }

  /**
   * 5.8, Precautions of each command: Q and L in RUN keep parameter files and the programs in program memory; Delete
   * File (`kept`) keeps programs and boot files everywhere. Which extensions these are: background.
   */
  #checkStopped({ number, path, text }: Place, kept = number === 0 ? /\.(QPA|QPG)$/i : /\.QPA$/i): void {
    const { stopToChange, refusals } = this.#parts.profile.files
    if (!stopToChange || this.#parts.cpu() !== 'RUN' || !kept.test(path.at(-1) ?? '')) return
    refuse(refusals.running, `${text} can be changed in STOP only`)
  }

  #refuseLocked({ text }: Place): never {
    return refuse(this.#parts.profile.files.refusals.locked, `${text} is open`)
  }

  #refuseNow(why: string): never {
    return refuse(this.#parts.profile.files.refusals.now, why)
  }

  /** What the host's file system does not allow is a fault of the memory to whoever asks. */
  #guarded<T>(use: () => T): T {
    try {
      return use()
    } catch (error) {
      if (error instanceof Refusal) throw error
      const reason = error instanceof Error ? error.message : String(error)
      return refuse(this.#parts.profile.files.refusals.failed, `the drive fails: ${reason}`)
    }
  }
}

/** One side of a copy. */
export interface CopySide {
  readonly drive: number
  readonly name: string
  readonly password: string
}

function isAt(file: Opened, { number, path }: Place): boolean {
  return file.drive === number && keyOf(file.path) === keyOf(path)
}

function setPassword({ mounted, path }: Place, password: string): void {
  if (password === '') mounted.passwords.delete(keyOf(path))
  else mounted.passwords.set(keyOf(path), password)
}

function refuse(endCode: number, message: string): never {
  throw new Refusal(endCode, message)
}
