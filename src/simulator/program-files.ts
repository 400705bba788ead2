// Files of the simulated PLC as a program in it sees them: no locks, no passwords.
import { RequestError } from '../errors'
import type { FileTime } from '../melsec/file/time'
import type { Profile } from '../melsec/profiles/profile'
import { type DrivePath, pathOf } from './drive'
import type { MountedDrive } from './drives'
import type { Files, OpenFile } from './files'

/** Files of the simulated PLC, for the program that simulates it. Names do not distinguish capital letters. */
export class ProgramFiles {
  readonly #profile: Profile
  readonly #drives: ReadonlyMap<number, MountedDrive>
  readonly #files: Files
  readonly #now: () => FileTime

  constructor(profile: Profile, drives: ReadonlyMap<number, MountedDrive>, files: Files, now: () => FileTime) {
    this.#profile = profile
    this.#drives = drives
    this.#files = files
    this.#now = now
  }

  /** Files that clients have open, and so locked. */
  get open(): readonly OpenFile[] {
    return this.#files.open
  }

  /**
   * Content of a file; undefined when there is none of this name.
   * @throws RequestError OUT_OF_RANGE no such drive, BAD_VALUE no file name
   * @example plc.files.read(4, 'LINE.CSV')?.toString()
   */
  read(drive: number, name: string): Buffer | undefined {
    const { mounted, path } = this.#at(drive, name)
    const found = mounted.drive.find(path)
    return found === undefined || found.directory ? undefined : mounted.drive.read(path, 0, found.size)
  }

  /**
   * Makes a file, or replaces the one there is, whoever has it open. Text is written in UTF-8.
   * @throws RequestError OUT_OF_RANGE no such drive or no room, BAD_VALUE no file name or no such directory
   * @example plc.files.write(4, 'LINE.CSV', 'Product,Minutes\r\nA,15\r\n')
   */
  write(drive: number, name: string, data: string | Uint8Array): void {
    const { mounted, path } = this.#at(drive, name)
    const bytes = Buffer.from(data)
    const found = mounted.drive.find(path)
    if (found?.directory === true || mounted.drive.list(path.slice(0, -1)) === undefined) {
      throw new RequestError('BAD_VALUE', `${name} cannot be a file: a directory is there, or one is missing.`)
    }
    if (mounted.drive.used() - (found?.size ?? 0) + bytes.length > mounted.capacity) {
      throw new RequestError('OUT_OF_RANGE', `${name}: ${bytes.length} bytes do not fit on drive ${drive}.`)
    }
    if (found !== undefined) mounted.drive.remove(path)
    mounted.drive.create(path, bytes.length, this.#now())
    mounted.drive.write(path, 0, bytes)
  }

  #at(drive: number, name: string): { readonly mounted: MountedDrive; readonly path: DrivePath } {
    const own = this.#profile.files.drives.find(({ number }) => number === drive)?.same ?? drive
    const mounted = this.#drives.get(own)
    if (mounted === undefined) {
      throw new RequestError('OUT_OF_RANGE', `The simulated ${this.#profile.title} has no drive ${drive}.`)
    }
    const path = pathOf(name)
    if (path === undefined) throw new RequestError('BAD_VALUE', `${JSON.stringify(name)} is no file name.`)
    return { mounted, path }
  }
}
