// The content of a file, in the manual's order: open, which locks it, read, close.
import { ProtocolError, RequestError } from '../../errors'
import { tellListener } from '../connection/tell-listener'
import { statOf } from './list'
import { alsoAfter, type FileCalls, notClosed, OpenFile } from './open-file'
import type { FilePlace } from './place'

/** How far a transfer is, in bytes. */
export interface FileProgress {
  /** Bytes done so far. */
  readonly done: number
  /** Bytes there will be. */
  readonly total: number
}

export interface Reading {
  readonly password: string
  /** Largest file, bytes. */
  readonly limit: number
  readonly onProgress: (progress: FileProgress) => void
}

/** The content, in chunks. The file is closed when they end, fail, or are not asked for any more. */
export async function* readChunks(calls: FileCalls, place: FilePlace, reading: Reading): AsyncGenerator<Buffer> {
  const file = await OpenFile.open(calls, place, 'read', reading.password)
  let failed = false
  try {
    const total = await lockedSize(calls, place, reading.limit)
    let done = 0
    for await (const chunk of file.chunks(total)) {
      done += chunk.length
      tellListener(reading.onProgress, { done, total })
      yield chunk
    }
  } catch (error) {
    failed = true
    throw await alsoAfter(error, notClosed(place), () => file.close())
  } finally {
    if (!failed) await file.close()
  }
}

/** The size while nobody can change it: before the file was opened it may have been another. */
async function lockedSize(calls: FileCalls, place: FilePlace, limit: number): Promise<number> {
  const entry = await statOf(calls, place)
  if (entry === undefined || entry.kind === 'directory') {
    throw new ProtocolError('BAD_FIELD', `The PLC opened ${place.text}, but does not list it as a file.`)
  }
  if (entry.size <= limit) return entry.size
  const message = `${place.text} has ${entry.size} bytes, more than the limit of ${limit}. Raise limit, or use readStream().`
  throw new RequestError('LIMIT_EXCEEDED', message, 'limit')
}
