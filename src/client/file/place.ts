// Which file or directory a text means: the drive, and the path from its root.

import { shown } from '../../basics/show'
import { RequestError } from '../../errors'
import { SEPARATOR } from '../../melsec/file/name'
import type { Drive, Profile } from '../../melsec/profiles/profile'

/**
 * A file or directory of the PLC: the number of its drive and the path from the root. Both separators are taken.
 * @example '4:\\LOG\\LINE.CSV', '4:/LOG/LINE.CSV', { drive: 4, path: 'LOG/LINE.CSV' }
 */
export type FilePath =
  | string
  | {
      /** Number of the drive, as file commands name it. */
      readonly drive: number
      /** From the root, e.g. `LOG/LINE.CSV`. */
      readonly path: string
    }

/** A path that is understood. */
export interface FilePlace {
  readonly drive: number
  /** From the root, `LOG\LINE.CSV`; '' is the root. */
  readonly path: string
  /** Of `path`: the directory it is in, '' the root, and its last part. */
  readonly directory: string
  readonly name: string
  /** As people read it, `4:\LOG\LINE.CSV`. */
  readonly text: string
}

const TEXT = /^\s*([0-9]{1,5})\s*:(.*)$/s

/**
 * @throws RequestError BAD_ADDRESS when it is no path, OUT_OF_RANGE when the profile has no such drive, UNSUPPORTED when
 * it has no files at all
 */
export function filePlaceOf(given: FilePath, profile: Profile): FilePlace {
  const { drive, path } = partsOf(given)
  checkDrive(drive, profile)
  return placeAt(drive, path.replaceAll('/', SEPARATOR).replace(/^\\|\\$/g, ''))
}

/** @throws RequestError BAD_ADDRESS when it is the root: the commands about files need one */
export function fileOf(given: FilePath, profile: Profile): FilePlace {
  const place = filePlaceOf(given, profile)
  if (place.name !== '') return place
  throw new RequestError('BAD_ADDRESS', `${place.text} is the root of a drive: name a file, as in ${place.text}A.CSV.`)
}

function placeAt(drive: number, path: string): FilePlace {
  const end = path.lastIndexOf(SEPARATOR)
  return {
    drive,
    path,
    directory: path.slice(0, Math.max(0, end)),
    name: path.slice(end + 1),
    text: `${drive}:${SEPARATOR}${path}`,
  }
}

/** The place of another file in the same directory. */
export function beside({ drive, directory }: FilePlace, name: string): FilePlace {
  return inside(drive, directory, name)
}

/** The place of an entry of a directory. */
export function inside(drive: number, directory: string, name: string): FilePlace {
  return placeAt(drive, directory === '' ? name : `${directory}${SEPARATOR}${name}`)
}

function partsOf(given: unknown): { readonly drive: number; readonly path: string } {
  if (typeof given === 'string') {
    const [, drive, path] = TEXT.exec(given) ?? []
    if (drive !== undefined && path !== undefined) return { drive: Number(drive), path }
  } else if (typeof given === 'object' && given !== null && 'drive' in given && 'path' in given) {
    const { drive, path } = given
    if (typeof drive === 'number' && typeof path === 'string') return { drive, path }
  }
  const message = `${shown(given)} is no file of a PLC: write the number of its drive and its path, as in 4:/LOG/LINE.CSV.`
  throw new RequestError('BAD_ADDRESS', message)
}

function checkDrive(drive: number, { files, title }: Profile): void {
  if (files.drives.length === 0) {
    throw new RequestError('UNSUPPORTED', `The files of ${title} cannot be reached by SLMP.`)
  }
  if (files.drives.some(({ number }) => number === drive)) return
  const known = files.drives.map(describeDrive).join(', ')
  throw new RequestError('OUT_OF_RANGE', `${title} has no drive ${drive}; it has ${known}.`, 'drive')
}

function describeDrive({ number, title }: Drive): string {
  return `${number} (${title})`
}
