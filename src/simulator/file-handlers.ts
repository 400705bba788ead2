// What the simulated PLC answers to file commands.
import { attributeNumber } from '../melsec/file/attribute'
import { FORM_FILE_UTF16 } from '../melsec/file/codec'
import { isShortName } from '../melsec/file/name'
import type { fileCommandNames } from '../melsec/profiles/files'
import type { DriveEntry } from './drive'
import type { SimulatedFiles } from './files'
import type { Handler } from './handler'

type FileCommand = (typeof fileCommandNames)[number]

const WRITE_MODE = 0x0100
const READ_ONLY = 0x01

function hasLongNames(subcommand: number): boolean {
  return (subcommand & FORM_FILE_UTF16) !== 0
}

/** What Read Directory/File counts: with 0000 the names it can say, with 0040 `.` and `..` too, but not in the root. */
function listed(files: SimulatedFiles, drive: number, path: string, subcommand: number): readonly DriveEntry[] {
  const found = files.list(drive, path)
  if (!hasLongNames(subcommand)) return found.filter(({ name }) => isShortName(name))
  if (path === '' || path === '\\') return found
  const own = files.find(drive, path)
  return [{ ...own, name: '.' }, { ...own, name: '..' }, ...found]
}

/** Bytes of files in one answer with 0040. "Because of the length of names it may be fewer files than asked for." */
const ROOM = 1920
/** Bytes of an entry beside its name. */
const BESIDE_NAME = 23

function fitting(entries: readonly DriveEntry[]): readonly DriveEntry[] {
  let bytes = 0
  const end = entries.findIndex(({ name }) => {
    bytes += BESIDE_NAME + 2 * name.length
    return bytes > ROOM
  })
  return end < 0 ? entries : entries.slice(0, end)
}

export const fileHandlers: { readonly [N in FileCommand]: Handler<N> } = {
  readDirectory({ drive, start, count, path }, { files }, subcommand) {
    const all = listed(files, drive, path, subcommand)
    const asked = all.slice(Math.max(start, 1) - 1).slice(0, count)
    const given = hasLongNames(subcommand) ? fitting(asked) : asked
    return {
      lastFileNumber: hasLongNames(subcommand) ? Math.max(start, 1) - 1 + given.length : 0,
      files: given.map((entry) => ({
        name: entry.name,
        attribute: attributeNumber(entry),
        modified: entry.modified,
        size: entry.size,
      })),
    }
  },
  searchFile({ drive, name }, { files }, subcommand) {
    const { name: found } = files.find(drive, name)
    const directory = name.slice(0, Math.max(name.lastIndexOf('\\'), 0))
    const all = listed(files, drive, directory, subcommand)
    return { fileNumber: 1 + all.findIndex((entry) => entry.name === found) }
  },
  newFile({ drive, name, size, password }, { files }) {
    files.create(drive, name, size, password)
    return {}
  },
  deleteFile({ drive, name, password }, { files }) {
    files.remove(drive, name, password)
    return {}
  },
  copyFile(message, { files }) {
    files.copy(
      { drive: message.sourceDrive, name: message.sourceName, password: message.sourcePassword },
      { drive: message.destinationDrive, name: message.destinationName, password: message.destinationPassword },
    )
    return {}
  },
  changeFileState({ drive, name, password, attribute }, { files }) {
    files.setReadOnly(drive, name, password, attribute === READ_ONLY)
    return {}
  },
  changeFileDate({ drive, name, date }, { files }) {
    files.setModified(drive, name, date)
    return {}
  },
  openFile: ({ drive, name, password, mode }, { files, caller }) => ({
    pointer: files.openFile(caller, drive, name, password, mode === WRITE_MODE ? 'write' : 'read'),
  }),
  readFile: ({ pointer, offset, byteCount }, { files, caller }) => ({
    data: files.read(caller, pointer, offset, byteCount),
  }),
  writeFile({ pointer, offset, data }, { files, caller }) {
    files.write(caller, pointer, offset, data)
    return { written: data.length }
  },
  closeFile({ pointer, closeType }, { files, caller }) {
    files.closeFile(caller, pointer, closeType !== 0)
    return {}
  },
}
