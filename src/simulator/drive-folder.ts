// A drive of the simulated PLC that is a folder of this computer. No name, link or special file leads out of it: every
// part of a path is looked up in the list of its directory, and only plain files and directories are there at all.
import * as fs from 'node:fs'
import { join } from 'node:path'
import { RequestError } from '../errors'
import type { FileTime } from '../melsec/file/time'
import { type DriveEntry, type DrivePath, type DriveStore, isPlainName } from './drive'
import { fileClock, msOf } from './file-clock'

/** Directories and files that are looked at to tell how much room is left. */
const LOOKED_AT = 10_000
/** Never follow a link that was put there in between. Windows has no such flag. */
const NO_FOLLOW = fs.constants.O_NOFOLLOW ?? 0
const OWNER_WRITES = 0o200

interface Found {
  /** In the host's file system. */
  readonly path: string
  readonly stat: fs.Stats
  readonly name: string
}

export class FolderDrive implements DriveStore {
  readonly #root: string

  /** @throws RequestError BAD_OPTION: there is no such folder. */
  constructor(folder: string) {
    try {
      this.#root = fs.realpathSync(folder)
      if (!fs.statSync(this.#root).isDirectory()) throw new TypeError('it is no folder')
    } catch (error) {
      const reason = error instanceof Error ? error.message : String(error)
      throw new RequestError('BAD_OPTION', `The folder ${folder} cannot be a drive: ${reason}.`, 'drives')
    }
  }

  list(path: DrivePath): readonly DriveEntry[] | undefined {
    const found = this.#at(path)
    if (found === undefined || !found.stat.isDirectory()) return undefined
    return namesIn(found.path)
      .flatMap((name) => inside(found.path, name) ?? [])
      .map(entryOf)
  }

  find(path: DrivePath): DriveEntry | undefined {
    const found = this.#at(path)
    return found === undefined ? undefined : entryOf(found)
  }

  used(): number {
    let left = LOOKED_AT
    const sum = (directory: string): number =>
      namesIn(directory).reduce((total, name) => {
        // A folder with more than that counts as full.
        if (left-- <= 0) return Number.POSITIVE_INFINITY
        const found = inside(directory, name)
        if (found === undefined) return total
        return total + (found.stat.isDirectory() ? sum(found.path) : found.stat.size)
      }, 0)
    return sum(this.#root)
  }

  read(path: DrivePath, offset: number, length: number): Buffer {
    return this.#opened(path, fs.constants.O_RDONLY, (file) => {
      const data = Buffer.alloc(length)
      return data.subarray(0, fs.readSync(file, data, 0, length, offset))
    })
  }

  write(path: DrivePath, offset: number, data: Uint8Array): void {
    this.#opened(path, fs.constants.O_WRONLY, (file) => {
      for (let at = 0; at < data.length; ) at += fs.writeSync(file, data, at, data.length - at, offset + at)
    })
  }

  create(path: DrivePath, size: number, modified: FileTime): void {
    const name = path.at(-1) ?? ''
    const directory = this.#must(path.slice(0, -1)).path
    if (!isPlainName(name)) throw new TypeError(`${name} cannot be a file here`)
    // Exclusive: not through a link, and never over something that is there.
    const file = fs.openSync(join(directory, name), 'wx')
    try {
      fs.ftruncateSync(file, size)
    } finally {
      fs.closeSync(file)
    }
    this.setModified(path, modified)
  }

  remove(path: DrivePath): void {
    fs.unlinkSync(this.#must(path).path)
  }

  setReadOnly(path: DrivePath, readOnly: boolean): void {
    const { path: host, stat } = this.#must(path)
    fs.chmodSync(host, readOnly ? stat.mode & ~0o222 : stat.mode | OWNER_WRITES)
  }

  setModified(path: DrivePath, modified: FileTime): void {
    const seconds = msOf(modified) / 1000
    fs.utimesSync(this.#must(path).path, seconds, seconds)
  }

  #opened<T>(path: DrivePath, flags: number, use: (file: number) => T): T {
    const file = fs.openSync(this.#must(path).path, flags | NO_FOLLOW)
    try {
      return use(file)
    } finally {
      fs.closeSync(file)
    }
  }

  #at(path: DrivePath): Found | undefined {
    let found: Found | undefined = { path: this.#root, stat: fs.statSync(this.#root), name: '' }
    for (const name of path) {
      if (found === undefined || !found.stat.isDirectory()) return undefined
      const directory: string = found.path
      const spelt = namesIn(directory).find((known) => known.toUpperCase() === name.toUpperCase())
      found = spelt === undefined ? undefined : inside(directory, spelt)
    }
    return found
  }

  #must(path: DrivePath): Found {
    const found = this.#at(path)
    if (found === undefined) throw new TypeError(`${path.join('\\')} is not there`)
    return found
  }
}

/** In an order that stays. */
function namesIn(directory: string): string[] {
  try {
    return fs.readdirSync(directory).filter(isPlainName).sort()
  } catch {
    // Gone, or not ours to read.
    return []
  }
}

/** A plain file or directory; links and everything else are not there. */
function inside(directory: string, name: string): Found | undefined {
  const path = join(directory, name)
  try {
    const stat = fs.lstatSync(path)
    return stat.isFile() || stat.isDirectory() ? { path, stat, name } : undefined
  } catch {
    return undefined
  }
}

function entryOf({ name, stat }: Found): DriveEntry {
  const directory = stat.isDirectory()
  return {
    name,
    directory,
    // What is larger than its field can say is shown as large as that: it cannot be read to its end anyway.
    size: directory ? 0 : Math.min(stat.size, 0xffffffff),
    modified: fileClock(stat.mtimeMs),
    readOnly: (stat.mode & OWNER_WRITES) === 0,
  }
}
