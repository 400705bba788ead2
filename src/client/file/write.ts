// Making and replacing files, in the manual's order: look, make with its size, open, write, close.

import { shown } from '../../basics/show'
import { RequestError } from '../../errors'
import { commands } from '../../melsec/commands/commands'
import { isNeverInPlace, isProjectFile } from '../../melsec/file/project-file'
import { tellListener } from '../connection/tell-listener'
import { type FileEntry, listDirectory, statOf } from './list'
import {
  chunksOf,
  type FileCalls,
  type FileSend,
  isUnknown,
  note,
  type OpenFile,
  textOf,
  unfinished,
  withOpenFile,
} from './open-file'
import { type FilePlace, inside } from './place'
import type { FileProgress } from './read'

/** What a write does about a file that is there: refuses, replaces it as a whole, or writes into it. */
export type WriteMode = 'new' | 'replace' | 'overwrite'

/** What is written: bytes, or a stream or another iterable of bytes. */
export type FileData = Uint8Array | Iterable<Uint8Array> | AsyncIterable<Uint8Array>

/** What is written, and how many bytes that will be. */
export interface Content {
  readonly source: Iterable<Uint8Array> | AsyncIterable<Uint8Array>
  readonly size: number
}

export interface Writing {
  readonly password: string
  readonly content: Content
  readonly onProgress: (progress: FileProgress) => void
}

/** A file and the password that opens it. */
export interface ProtectedFile {
  readonly place: FilePlace
  readonly password: string
}

/** Temporary names that are tried. */
const TEMPORARY_NAMES = 100
/** Field of New File. */
const LARGEST = 0xffffffff

/** @throws RequestError BAD_VALUE for what is no bytes, BAD_OPTION for a size that is missing or wrong */
export function contentOf(data: FileData, size: number | undefined): Content {
  if (data instanceof Uint8Array) {
    if (size !== undefined && size !== data.length) {
      throw new RequestError('BAD_OPTION', `size is ${shown(size)}, but the data have ${data.length} bytes.`, 'size')
    }
    // Its own copy: the transfer takes long, and the caller may use the array for something else meanwhile.
    return { source: [Uint8Array.from(data)], size: data.length }
  }
  if (typeof data !== 'object' || data === null || !(Symbol.iterator in data || Symbol.asyncIterator in data)) {
    const message = `The data of a file are a Buffer, a Uint8Array, or a stream of them, not ${shown(data)}.`
    throw new RequestError('BAD_VALUE', message, 'data')
  }
  if (typeof size === 'number' && Number.isInteger(size) && size >= 0 && size <= LARGEST) return { source: data, size }
  const message = 'A stream needs size, its number of bytes: the PLC reserves the place of a file before it is written.'
  throw new RequestError('BAD_OPTION', message, 'size')
}

export async function writeFile(calls: FileCalls, place: FilePlace, writing: Writing, mode: WriteMode): Promise<void> {
  if (mode !== 'new' && mode !== 'replace' && mode !== 'overwrite') {
    throw new RequestError('BAD_OPTION', `mode is ${shown(mode)}; it is new, replace or overwrite.`, 'mode')
  }
  if (mode === 'overwrite' && isNeverInPlace(place.name)) {
    const message = `${place.text} is a program or FB file: it is never written in its place. Use 'replace'.`
    throw new RequestError('BAD_OPTION', message, 'mode')
  }
  const old = await statOf(calls, place)
  if (old !== undefined && old.kind !== 'file') {
    const what = old.kind === 'directory' ? 'directory' : 'file of the system'
    throw new RequestError('BAD_ADDRESS', `${old.path} is a ${what}: it is not written.`)
  }
  if (mode === 'overwrite') return overwrite(calls, place, writing, old)
  if (old === undefined)
    return isProjectFile(place.name) ? byWayOfAnother(calls, place, writing) : create(calls, place, writing)
  if (mode === 'replace') return byWayOfAnother(calls, place, writing, old)
  const message = `${old.path} exists. Set mode to 'replace' to put the new file in its place, or 'overwrite' to write into it.`
  throw new RequestError('BAD_OPTION', message, 'mode')
}

async function overwrite(
  calls: FileCalls,
  place: FilePlace,
  writing: Writing,
  old: FileEntry | undefined,
): Promise<void> {
  const { size } = writing.content
  if (old?.size !== size) {
    const found = old === undefined ? 'does not exist' : `has ${old.size} bytes, the data ${size}`
    const message = `${place.text} ${found}: only a file of the same size can be overwritten. Use 'new' or 'replace'.`
    throw new RequestError('BAD_OPTION', message, 'mode')
  }
  let done = 0
  const onProgress: Writing['onProgress'] = (progress) => {
    done = progress.done
    writing.onProgress(progress)
  }
  try {
    await withOpenFile(calls, place, 'write', writing.password, (file) => fill(file, place, { ...writing, onProgress }))
  } catch (error) {
    if (done > 0) throw unfinished(error, `${place.text}: ${done} of its ${size} bytes are overwritten.`)
    throw isUnknown(error) ? note(error, `It was about ${place.text}.`) : error
  }
}

/** Makes a file that does not exist. One that stays unfinished is removed again. */
async function create(calls: FileCalls, place: FilePlace, writing: Writing): Promise<void> {
  const { password, content } = writing
  const message = { password, drive: place.drive, size: content.size, name: place.path }
  // Given up on the way nobody knew whether there is a file to be removed.
  await calls.send(commands.newFile, message, { unaborted: 'onceSent' }).catch((error) => {
    throw isUnknown(error) ? note(error, `${place.text} may be there, unfinished.`) : error
  })
  try {
    await withOpenFile(calls, place, 'write', password, (file) => fill(file, place, writing))
  } catch (error) {
    throw await without(calls, { place, password }, error, `${place.text} is unfinished`)
  }
}

/** Removes what a failed transfer has made. @returns its error; when that fails too, one that says what is left */
async function without(calls: FileCalls, file: ProtectedFile, error: unknown, state: string): Promise<unknown> {
  try {
    await remove(calls, file, { unaborted: 'always' })
    return error
  } catch (second) {
    const why = `could not be removed (${textOf(second)})`
    return unfinished(error, `${state}. ${file.place.text} ${why}. What failed first:`)
  }
}

async function fill(file: OpenFile, place: FilePlace, { content, onProgress }: Writing): Promise<void> {
  const { source, size: total } = content
  let done = 0
  for await (const chunk of chunksOf(source)) {
    if (done + chunk.length > total) throw otherSize(place, `more than ${total}`, total)
    await file.write(done, chunk)
    done += chunk.length
    tellListener(onProgress, { done, total })
  }
  if (done !== total) throw otherSize(place, `${done}`, total)
}

function otherSize(place: FilePlace, found: string, size: number): RequestError {
  const message = `The data for ${place.text} were ${found} bytes, but size says ${size}.`
  return new RequestError('BAD_VALUE', message, 'size')
}

/**
 * Another file of the directory takes the content and is copied to the name when it is complete. So a file that is
 * replaced lives until then, and a file of a project, which New File refuses, can be made (SLMP reference manual 5.8,
 * Procedure).
 */
async function byWayOfAnother(calls: FileCalls, place: FilePlace, writing: Writing, old?: FileEntry): Promise<void> {
  const { password } = writing
  // The password is the copy's: with subcommand 0040 New File takes none.
  const temporary = { place: await temporaryBeside(calls, place), password: '' }
  await create(calls, temporary.place, { ...writing, password: '' })
  const target = { place, password }
  const kept = `the new content is in ${temporary.place.text}`
  if (old !== undefined) {
    await remove(calls, target, { unaborted: 'onceSent' }).catch(async (error) => {
      if (isUnknown(error)) throw unfinished(error, `Whether ${old.path} is still there is not known; ${kept}.`)
      throw await without(calls, temporary, error, `${old.path} is as it was`)
    })
  }
  // With the old file gone there is no way but on: it is not aborted any more.
  await copyFile(calls, temporary, target, { unaborted: old === undefined ? 'onceSent' : 'always' }).catch(
    async (error) => {
      if (old !== undefined) throw unfinished(error, `The old ${place.text} is removed; ${kept}, to be copied.`)
      if (isUnknown(error)) throw unfinished(error, `Whether ${place.text} was made is not known; ${kept}.`)
      throw await without(calls, temporary, error, `${place.text} was not made`)
    },
  )
  await remove(calls, temporary, { unaborted: 'always' }).catch((error) => {
    throw unfinished(error, `${place.text} is written; only ${temporary.place.text} is still there, or may be.`)
  })
}

async function temporaryBeside(calls: FileCalls, { drive, directory, text }: FilePlace): Promise<FilePlace> {
  const taken = await listDirectory(calls, inside(drive, '', directory))
  for (let number = 0; number < TEMPORARY_NAMES; number++) {
    const name = `MJW${String(number).padStart(2, '0')}.TMP`
    if (!taken.some((entry) => entry.name.toUpperCase() === name)) return inside(drive, directory, name)
  }
  const message = `${text} was not written: MJW00.TMP to MJW99.TMP are there, left by transfers that failed. Look at them and remove them.`
  throw new RequestError('BAD_ADDRESS', message)
}

export async function copyFile(
  calls: FileCalls,
  from: ProtectedFile,
  to: ProtectedFile,
  options: FileSend = {},
): Promise<void> {
  const message = {
    destinationPassword: to.password,
    destinationDrive: to.place.drive,
    destinationName: to.place.path,
    sourcePassword: from.password,
    sourceDrive: from.place.drive,
    sourceName: from.place.path,
  }
  await calls.send(commands.copyFile, message, options)
}

async function remove(calls: FileCalls, { place, password }: ProtectedFile, options: FileSend): Promise<void> {
  await calls.send(commands.deleteFile, { password, drive: place.drive, name: place.path }, options)
}
