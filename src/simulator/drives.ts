// The drives of a simulated PLC: what a program says they hold, and what they hold when it says nothing.
import { badOption } from '../basics/option-checks'
import { type FileTime, isFileTime } from '../melsec/file/time'
import type { Profile } from '../melsec/profiles/profile'
import { type DrivePath, type DriveStore, keyOf, MemoryDrive, pathOf } from './drive'
import { FolderDrive } from './drive-folder'
import type { SimulatedDrive, SimulatedDrives, SimulatedFile } from './simulated-drive'
import { usualFiles } from './usual-files'

/** A drive as the file commands find it. */
export interface MountedDrive {
  readonly drive: DriveStore
  readonly capacity: number
  readonly writeProtected: boolean
  /** Passwords of files, by the key of their path. */
  readonly passwords: Map<string, string>
}

const CAPACITY = 4 * 1024 * 1024

/** @throws RequestError BAD_OPTION */
export function drivesOf(profile: Profile, given: SimulatedDrives, now: FileTime): ReadonlyMap<number, MountedDrive> {
  const known = profile.files.drives
  for (const number of Object.keys(given)) {
    if (known.some((drive) => String(drive.number) === number)) continue
    const list = known.map((drive) => drive.number).join(', ')
    badOption(
      `drives.${number}`,
      `${profile.title} has no drive ${number}${list === '' ? '' : `; its drives are ${list}`}.`,
    )
  }
  const own = known.filter(({ number, same }) => {
    if (same === undefined) return true
    if (given[number] !== undefined) badOption(`drives.${number}`, `Drive ${number} is drive ${same}: give that one.`)
    return false
  })
  return new Map(
    own.flatMap(({ number }) => {
      const drive = given[number]
      return drive === false ? [] : [[number, mounted(profile, number, drive ?? {}, now)] as const]
    }),
  )
}

function mounted(profile: Profile, number: number, given: SimulatedDrive, now: FileTime): MountedDrive {
  const field = `drives.${number}`
  if (typeof given !== 'object' || given === null)
    badOption(field, `${field} is an object with files or folder, or false.`)
  const { files, folder, capacity = CAPACITY, writeProtected = false } = given
  for (const name of Object.keys(given)) {
    if (['files', 'folder', 'capacity', 'writeProtected'].includes(name)) continue
    badOption(`${field}.${name}`, `A drive has no ${name}: it has files, folder, capacity, writeProtected.`)
  }
  if (!Number.isInteger(capacity) || capacity < 0)
    badOption(`${field}.capacity`, `${field}.capacity is a number of bytes.`)
  if (folder !== undefined && files !== undefined) badOption(field, `${field} is a folder or has files, not both.`)
  const passwords = new Map<string, string>()
  if (folder !== undefined) {
    if (typeof folder !== 'string') badOption(`${field}.folder`, `${field}.folder is the path of a folder.`)
    return { drive: new FolderDrive(folder), capacity, writeProtected, passwords }
  }
  const drive = new MemoryDrive(now)
  for (const [name, file] of Object.entries(files ?? usualFiles(profile, number))) {
    addFile(drive, passwords, `${field}.files`, name, file, now)
  }
  if (drive.used() > capacity)
    badOption(field, `The files of ${field} take ${drive.used()} bytes, more than its capacity.`)
  return { drive, capacity, writeProtected, passwords }
}

function addFile(
  drive: MemoryDrive,
  passwords: Map<string, string>,
  field: string,
  name: string,
  given: string | Uint8Array | SimulatedFile,
  now: FileTime,
): void {
  const path: DrivePath =
    pathOf(name) ?? badOption(field, `${JSON.stringify(name)} is no file name, e.g. LOG\\LINE.CSV.`)
  const file: SimulatedFile = typeof given === 'string' || given instanceof Uint8Array ? { data: given } : given
  const { data, readOnly = false, password = '', modified = now } = file
  if (typeof data !== 'string' && !(data instanceof Uint8Array)) badOption(field, `${name}: data is a text or bytes.`)
  if (!isFileTime(modified)) badOption(field, `${name}: modified is no date a file can have.`)
  const bytes = Buffer.from(data)
  if (drive.find(path) !== undefined) badOption(field, `${name} is there twice.`)
  drive.makeDirectories(path.slice(0, -1), now)
  if (drive.list(path.slice(0, -1)) === undefined) badOption(field, `${name}: a part of its path is a file.`)
  drive.create(path, bytes.length, modified)
  drive.write(path, 0, bytes)
  drive.setReadOnly(path, readOnly)
  if (password !== '') passwords.set(keyOf(path), password)
}
