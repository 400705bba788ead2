// What file commands carry and width alone cannot say. The subcommand decides: 0000 and 0004 have names in Shift-JIS
// and passwords of 4 characters, 0040 has names in UTF-16 and passwords with their length (SLMP reference manual 5.8).
import { badMessage, type Reader, type ValueCodec, type Writer } from '../../codec/codec'
import { checkLongPath, LONG_NAME, SHORT_NAME, type ShortName, shortNameOf } from './name'
import { fromShiftJis } from './shift-jis'

/** Names in UTF-16. Equals bit 6 of the subcommand. */
export const FORM_FILE_UTF16 = 0x40
/** LCPU, LJ72GF15-T2. Equals bit 2 of the subcommand; the layouts are those of 0000. */
export const FORM_FILE_0004 = 0x04
/** The bits of a subcommand that decide how the data of file commands look. */
export const FILE_BITS = FORM_FILE_UTF16 | FORM_FILE_0004

function isUtf16(form: number): boolean {
  return (form & FORM_FILE_UTF16) !== 0
}

/** The size of these is in the bytes themselves, or in the value. */
function known<T>(value: T | undefined): T {
  if (value === undefined) throw new TypeError('The size of names and passwords is known only with them')
  return value
}

function units(text: string): number[] {
  return Array.from({ length: text.length }, (_, i) => text.charCodeAt(i))
}

function readUtf16(reader: Reader): string {
  const length = reader.uint(2)
  return reader
    .words(length)
    .map((unit) => String.fromCharCode(unit))
    .join('')
}

function writeUtf16(writer: Writer, text: string): void {
  writer.uint(text.length, 2)
  writer.words(units(text))
}

/** Bytes in binary code, twice as many characters in ASCII code. */
function onWire(bytes: number, ascii: boolean): number {
  return ascii ? 2 * bytes : bytes
}

/** A number of a drive; which there are is in the profile. */
export const driveNumber: ValueCodec<number> = {
  name: 'drive',
  takes: 'the number of a drive, 0 to 65535',
  example: 4,
  write(writer, value) {
    if (!Number.isInteger(value) || value < 0 || value > 0xffff) badMessage('must be the number of a drive, 0 to 65535')
    writer.uint(value, 2)
  },
  read: (reader) => reader.uint(2),
  size: (ascii) => onWire(2, ascii),
}

function joined({ stem, extension }: ShortName): string {
  return extension === '' ? stem : `${stem}.${extension}`
}

/**
 * Name of a file. 0000 and 0004: bytes, then the name of at most 8 + 3 bytes in Shift-JIS. 0040: UTF-16 units, then
 * the path from the root in UTF-16, e.g. `LOG\\LINE.CSV`; a separator in front is allowed.
 */
export const fileName: ValueCodec<string> = {
  name: 'file name',
  takes: 'the name of a file',
  example: 'LOG.CSV',
  variable: true,
  write(writer, value) {
    if (isUtf16(writer.form)) {
      if (checkLongPath(value, 'file') === '') badMessage('must be the name of a file')
      writeUtf16(writer, value)
      return
    }
    const bytes = joined(shortNameOf(value))
    // Assumed: the length counts bytes. The manual says characters, and counts a full-width one as two of the eight.
    writer.uint(bytes.length, 2)
    writer.text(bytes)
  },
  read(reader) {
    if (isUtf16(reader.form)) return readUtf16(reader)
    return fromShiftJis(reader.text(reader.uint(2)))
  },
  size(ascii, form, value) {
    const text = known(value)
    if (isUtf16(form)) return onWire(2 + 2 * text.length, ascii)
    return onWire(2, ascii) + joined(shortNameOf(text)).length
  },
}

/** Path of a directory from the root, '' the root itself. 0000: there are no directories, 0000 stands here. */
export const directoryPath: ValueCodec<string> = {
  name: 'directory path',
  takes: "the path of a directory from the root, '' for the root",
  example: '',
  variable: true,
  write(writer, value) {
    const path = checkLongPath(value, 'directory')
    if (!isUtf16(writer.form) && path !== '') badMessage('drives of Q and L have no directories: leave it out')
    writeUtf16(writer, path)
  },
  read(reader) {
    if (isUtf16(reader.form)) return readUtf16(reader)
    if (reader.uint(2) !== 0) reader.fail('BAD_FIELD', 'the last field is fixed to 0')
    return ''
  },
  size: (ascii, form, value) => onWire(2 + (isUtf16(form) ? 2 * known(value).length : 0), ascii),
}

/** Characters of a password: 4, or from 1 to so many with subcommand 0040. */
const PASSWORD = { short: 4, long: 32 } as const
const NO_PASSWORD = ' '.repeat(PASSWORD.short)

function checkPassword(value: unknown): asserts value is string {
  if (typeof value !== 'string') badMessage('must be a text')
  if (!/^[\x20-\x7e]*$/.test(value)) badMessage('may hold only the characters 20H to 7EH (ASCII)')
}

function writeShortPassword(writer: Writer, value: string): void {
  if (value !== '' && value.length !== PASSWORD.short) {
    badMessage(`has ${value.length} characters, a file password of this PLC has ${PASSWORD.short}; '' is none`)
  }
  writer.text(value === '' ? NO_PASSWORD : value)
}

function readShortPassword(reader: Reader): string {
  const text = reader.text(PASSWORD.short)
  return text === NO_PASSWORD ? '' : text
}

/** Password of a file, '' for none. 0000 and 0004: 4 characters, none is 4 spaces. 0040: length and characters. */
export const filePassword: ValueCodec<string> = {
  name: 'file password',
  takes: "a text, '' for none",
  variable: true,
  secret: true,
  write(writer, value) {
    checkPassword(value)
    if (!isUtf16(writer.form)) {
      writeShortPassword(writer, value)
      return
    }
    if (value.length > PASSWORD.long)
      badMessage(`has ${value.length} characters, a file password has at most ${PASSWORD.long}`)
    writer.uint(value.length, 2)
    writer.text(value)
  },
  read: (reader) => (isUtf16(reader.form) ? reader.text(reader.uint(2)) : readShortPassword(reader)),
  size(ascii, form, value) {
    return isUtf16(form) ? onWire(2, ascii) + known(value).length : PASSWORD.short
  },
}

/** As `filePassword`, of commands that take none with 0040: there it is fixed, `0000` or four bytes 00. */
export const searchPassword: ValueCodec<string> = {
  name: 'file password',
  takes: "a text, '' for none",
  secret: true,
  write(writer, value) {
    checkPassword(value)
    if (!isUtf16(writer.form)) {
      writeShortPassword(writer, value)
      return
    }
    if (value !== '') badMessage('is not taken by this command on this PLC: leave it out')
    writer.text((writer.ascii ? '0' : '\0').repeat(PASSWORD.short))
  },
  read(reader) {
    if (!isUtf16(reader.form)) return readShortPassword(reader)
    if (reader.text(PASSWORD.short) !== (reader.ascii ? '0' : '\0').repeat(PASSWORD.short)) {
      reader.fail('BAD_FIELD', 'the field in place of the password is fixed to 0')
    }
    return ''
  },
  size: () => PASSWORD.short,
}

function last(form: number): number {
  return isUtf16(form) ? 0xffffffff : 0xffff
}

function writeFileNumber(writer: Writer, value: number): void {
  if (!Number.isInteger(value) || value < 0 || value > last(writer.form)) {
    badMessage(`is ${String(value)}, must be a whole number from 0 to ${last(writer.form)}`)
  }
  writer.uint(value, isUtf16(writer.form) ? 4 : 2)
}

/** Number of a file on its drive, from 1. 0000: 2 bytes. 0040: 4 bytes. */
export const fileNumber: ValueCodec<number> = {
  name: 'file number',
  takes: 'a file number, a whole number from 0',
  example: 1,
  write: writeFileNumber,
  read: (reader) => reader.uint(isUtf16(reader.form) ? 4 : 2),
  size: (ascii, form) => onWire(isUtf16(form) ? 4 : 2, ascii),
}

/** Where reading goes on, minus 1. Only 0040 has it: 0 without it, also where an answer without files ends early. */
export const lastFileNumber: ValueCodec<number> = {
  name: 'last file number',
  variable: true,
  write(writer, value) {
    if (isUtf16(writer.form)) writeFileNumber(writer, value)
    else if (value !== 0) badMessage('does not exist with subcommand 0000: it is 0')
  },
  read: (reader) => (isUtf16(reader.form) && reader.remaining > 0 ? reader.uint(4) : 0),
  size: (ascii, form) => (isUtf16(form) ? onWire(4, ascii) : 0),
}

function padded(text: string, length: number): string {
  return text.padEnd(length, ' ')
}

/**
 * Name in a list of files. 0000: 8 bytes and 3 bytes, filled up with spaces, without the period between them. 0040:
 * UTF-16 units, then the name. What is no text of the code is read as U+FFFD, which no name to be sent can hold.
 */
export const entryName: ValueCodec<string> = {
  name: 'name',
  variable: true,
  write(writer, value) {
    if (isUtf16(writer.form)) {
      if (typeof value !== 'string' || value === '' || value.length > LONG_NAME.path) badMessage('must be a name')
      writeUtf16(writer, value)
      return
    }
    const { stem, extension } = shortNameOf(value)
    writer.text(padded(stem, SHORT_NAME.stem) + padded(extension, SHORT_NAME.extension))
  },
  read(reader) {
    if (isUtf16(reader.form)) return readUtf16(reader)
    const part = (length: number) => fromShiftJis(reader.text(length).replace(/ +$/, ''))
    return joined({ stem: part(SHORT_NAME.stem), extension: part(SHORT_NAME.extension) })
  },
  size(ascii, form, value) {
    return isUtf16(form) ? onWire(2 + 2 * known(value).length, ascii) : SHORT_NAME.stem + SHORT_NAME.extension
  },
}
