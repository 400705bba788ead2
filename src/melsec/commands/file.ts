import { declare, field } from '../../codec/codec'
import {
  directoryPath,
  driveNumber,
  entryName,
  fileName,
  fileNumber,
  filePassword,
  lastFileNumber,
  searchPassword,
} from '../file/codec'
import { changedTime, modifiedTime } from '../file/time'

const { bytes, countOf, fixed, fixedText, list, optional, spare, u16, u32, value } = field
const manual = 'SLMP reference manual 5.8'

/** 0000 Q and L, 0040 iQ-R and its remote head; 0004 LCPU and the head module LJ72GF15-T2, with the layouts of 0000. */
const named = [0x0000, 0x0040] as const
const withPassword = [0x0000, 0x0004, 0x0040] as const
/** On every family. */
const withPointer = [0x0000] as const

const drive = value(driveNumber, 'drive number')
const name = value(fileName, 'with its extension; subcommand 0040: path from the root')
const password = optional(filePassword, '', "'' for none")
const pointer = u16({ doc: 'file pointer number, from Open File' })
const offset = u32({ multipleOf: 2, doc: 'bytes from the start of the file' })
/** Bytes of one Read File or Write File. */
const bounds = { max: 1920 } as const

/** Files on the drives of a CPU. */
export const fileCommands = declare({
  readDirectory: {
    title: 'Read Directory/File',
    code: 0x1810,
    unit: 'none',
    subcommands: named,
    effect: 'read',
    manual,
    request: {
      fixed: fixedText('0000', 0x30303030, 4, 'characters 0 in binary code, too'),
      drive,
      start: value(fileNumber, 'file number to begin with, from 1'),
      count: u16({ min: 1, max: 36, doc: 'files' }),
      path: optional(directoryPath, '', "subcommand 0040: directory from the root, '' the root"),
    },
    response: {
      // "Until the number becomes -1 (0FFFH)" in the procedure of 0040, 0 where the field is described.
      fileCount: countOf('files', 2, { noneToo: 0xffff }),
      lastFileNumber: value(lastFileNumber, 'subcommand 0040: go on with this + 1'),
      files: list('fileCount', {
        name: value(entryName),
        attribute: u16({
          doc: '00, 20 file; 01, 21 read-only file; 10, 30 directory; 11, 31 read-only directory (hex)',
        }),
        spare1: spare(7),
        spare2: spare(2),
        modified: value(modifiedTime, 'last edited; of a directory, created'),
        spare3: spare(2),
        size: u32({ doc: 'bytes; 0 of a directory' }),
      }),
    },
  },
  searchFile: {
    title: 'Search Directory/File',
    code: 0x1811,
    unit: 'none',
    subcommands: named,
    effect: 'read',
    manual,
    request: { password: optional(searchPassword, '', "'' for none"), drive, fixed: fixed(0, 2), name },
    response: { fileNumber: value(fileNumber) },
  },
  newFile: {
    title: 'New File',
    code: 0x1820,
    unit: 'none',
    subcommands: named,
    effect: 'write',
    manual,
    request: { password: optional(searchPassword, '', "'' for none"), drive, size: u32({ doc: 'bytes' }), name },
    response: {},
  },
  deleteFile: {
    title: 'Delete File',
    code: 0x1822,
    unit: 'none',
    subcommands: withPassword,
    effect: 'write',
    manual,
    request: { password, drive, name },
    response: {},
  },
  copyFile: {
    title: 'Copy File',
    code: 0x1824,
    unit: 'none',
    subcommands: withPassword,
    effect: 'write',
    manual,
    request: {
      fixed1: fixed(0, 4),
      fixed2: fixed(0, 4),
      destinationPassword: password,
      destinationDrive: drive,
      destinationName: name,
      sourcePassword: password,
      sourceDrive: drive,
      sourceName: name,
    },
    response: {},
  },
  changeFileState: {
    title: 'Change File State',
    code: 0x1825,
    unit: 'none',
    subcommands: withPassword,
    effect: 'write',
    manual,
    request: {
      password,
      drive,
      attribute: u16({ oneOf: [0x01, 0x20], doc: '1 read-only; 32 (20H) read and write' }),
      name,
    },
    response: {},
  },
  changeFileDate: {
    title: 'Change File Date',
    code: 0x1826,
    unit: 'none',
    subcommands: named,
    effect: 'write',
    manual,
    request: { fixed: fixedText('0000', 0, 4), drive, date: value(changedTime), name },
    response: {},
  },
  // Opening and closing lock and release the file and change nothing in it: whoever may read must be able to open.
  openFile: {
    title: 'Open File',
    code: 0x1827,
    unit: 'none',
    subcommands: withPassword,
    effect: 'lock',
    manual,
    request: {
      password,
      mode: u16({ oneOf: [0x0000, 0x0100], doc: '0 locked for reading; 256 (0100H) locked for writing' }),
      drive,
      name,
    },
    response: { pointer },
  },
  readFile: {
    title: 'Read File',
    code: 0x1828,
    unit: 'none',
    subcommands: withPointer,
    effect: 'read',
    manual,
    request: { pointer, offset, byteCount: u16({ ...bounds, doc: 'bytes' }) },
    response: { readCount: countOf('data', 2, bounds), data: bytes('readCount') },
  },
  writeFile: {
    title: 'Write File',
    code: 0x1829,
    unit: 'none',
    subcommands: withPointer,
    effect: 'write',
    manual,
    request: { pointer, offset, byteCount: countOf('data', 2, bounds), data: bytes('byteCount') },
    response: { written: u16({ ...bounds, doc: 'bytes' }) },
  },
  closeFile: {
    title: 'Close File',
    code: 0x182a,
    unit: 'none',
    subcommands: withPointer,
    effect: 'lock',
    manual,
    request: {
      pointer,
      closeType: u16({ max: 2, default: 0, doc: '0 this file; 1 and 2 all files this external device has locked' }),
    },
    response: {},
  },
})
