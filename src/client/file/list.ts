// What is on a drive: Read Directory/File until there is no more.
import { ProtocolError } from '../../errors'
import type { ResponseOf } from '../../melsec/commands/command'
import { commands } from '../../melsec/commands/commands'
import { attributesOf } from '../../melsec/file/attribute'
import type { FileTime } from '../../melsec/file/time'
import type { FileCalls } from './open-file'
import { type FilePlace, inside } from './place'

/** A file or directory as the PLC lists it. */
export interface FileEntry {
  /** Name within its directory. */
  readonly name: string
  /** With its drive, `4:\LOG\LINE.CSV`: what the other calls take. */
  readonly path: string
  /** `system`: not to be touched, says the manual. */
  readonly kind: 'file' | 'directory' | 'system'
  /** Whether it may not be changed. */
  readonly readOnly: boolean
  /** bytes; 0 of a directory */
  readonly size: number
  /** Last edited, of a directory created; in the PLC's time zone. It may be no date when the PLC's clock was never set. */
  readonly modified: FileTime
  /** As the PLC sends it: 30H or 10H directory, 20H or 00H file, each + 1 read-only. */
  readonly attribute: number
}

type Answer = ResponseOf<typeof commands.readDirectory>
type ListedFile = Answer['files'][number]

/** Files of one request: the most there may be. */
const PAGE = 36
/** More than any drive holds. Ends the list of a PLC that goes on for ever. */
const MOST_REQUESTS = 10_000

export async function listDirectory(calls: FileCalls, { drive, path, text }: FilePlace): Promise<FileEntry[]> {
  const entries: FileEntry[] = []
  let start: number | undefined = 1
  for (let requests = 0; requests < MOST_REQUESTS; requests++) {
    const answer: Answer = await calls.send(commands.readDirectory, { drive, start, count: PAGE, path })
    const named = answer.files.filter(({ name }) => name !== '.' && name !== '..')
    entries.push(...named.map((file) => entryOf(inside(drive, path, file.name), file)))
    const next = nextStart(start, answer)
    if (next === undefined) return entries
    if (next <= start) break
    start = next
  }
  throw new ProtocolError('BAD_FIELD', `The PLC does not come to an end of the files in ${text}.`)
}

/**
 * 0000: the next number asked for, until fewer come than were asked for. 0040: from the last number on, until none come,
 * because long names make it fewer, too.
 */
function nextStart(start: number, { files, lastFileNumber }: Answer): number | undefined {
  if (files.length === 0) return undefined
  if (lastFileNumber !== 0) return lastFileNumber + 1
  return files.length < PAGE ? undefined : start + PAGE
}

function entryOf(place: FilePlace, { name, attribute, size, modified }: ListedFile): FileEntry {
  const { directory, readOnly, system } = attributesOf(attribute)
  const kind = directory ? 'directory' : 'file'
  return { name, path: place.text, kind: system ? 'system' : kind, readOnly, size, modified, attribute }
}

/** One entry of its directory. Names that differ only in their case are one; the very name goes first. */
export async function statOf(calls: FileCalls, { drive, directory, name }: FilePlace): Promise<FileEntry | undefined> {
  const entries = await listDirectory(calls, inside(drive, '', directory))
  const wanted = name.toUpperCase()
  return entries.find((entry) => entry.name === name) ?? entries.find((entry) => entry.name.toUpperCase() === wanted)
}
