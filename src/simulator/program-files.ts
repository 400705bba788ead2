// Files of the simulated PLC as a program in it sees them: no locks, no passwords.
import { RequestError } from '../errors'
import type { FileTime } from '../melsec/file/time'
import type { Profile } from '../melsec/profiles/profile'
import { type DrivePath, pathOf } from './drive'
import type { MountedDrive } from './drives'
import type { OpenFile, SimulatedFiles } from './files'
import type { ProgramFiles } from './program'

/** Files by drive and name. */
export class NamedFiles implements ProgramFiles {
  readonly #profile: Profile
  readonly #drives: ReadonlyMap<number, MountedDrive>
  readonly #files: SimulatedFiles
  readonly #now: () => FileTime

  constructor(profile: Profile, drives: ReadonlyMap<number, MountedDrive>, files: SimulatedFiles, now: () => FileTime) {
    this.#profile = profile
    this.#drives = drives
    this.#files = files
    this.#now = now
  }

  get open(): readonly OpenFile[] {
    return this.#files.open
  }

  read(drive: number, name: string): Buffer | undefined {
    const { mounted, path } = this.#at(drive, name)
    const found = mounted.drive.find(path)
    return found === undefined || found.directory ? undefined : mounted.drive.read(path, 0, found.size)
  }

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
