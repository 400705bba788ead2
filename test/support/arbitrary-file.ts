/** Values of the file commands' codecs, as each form can say them. */
import fc from 'fast-check'
import {
  directoryPath,
  driveNumber,
  entryName,
  FORM_FILE_UTF16,
  fileName,
  fileNumber,
  filePassword,
  lastFileNumber,
  searchPassword,
} from '../../src/melsec/file/codec'
import { changedTime, isFileTime, modifiedTime } from '../../src/melsec/file/time'

export const fileCodecs: readonly object[] = [
  driveNumber,
  fileName,
  directoryPath,
  filePassword,
  searchPassword,
  fileNumber,
  lastFileNumber,
  entryName,
  changedTime,
  modifiedTime,
]

const time = fc
  .record({
    year: fc.integer({ min: 1980, max: 2107 }),
    month: fc.integer({ min: 1, max: 12 }),
    day: fc.integer({ min: 1, max: 31 }),
    hour: fc.nat(23),
    minute: fc.nat(59),
    second: fc.nat(29).map((half) => 2 * half),
  })
  .filter(isFileTime)

const letters = fc.constantFrom(...'ABCXYZabc0189_$-~#')
const word = (max: number) => fc.string({ unit: letters, minLength: 1, maxLength: max })
const named = (stem: fc.Arbitrary<string>, extension: fc.Arbitrary<string>) =>
  fc.oneof(
    stem,
    fc.tuple(stem, extension).map((parts) => parts.join('.')),
  )
/** Full-width characters take two of the eight bytes. */
const full = fc.string({ unit: fc.constantFrom('表', 'ソ', 'テ', '日', 'ｱ'), minLength: 1, maxLength: 4 })
const shortNames = named(fc.oneof(word(8), full), word(3))
const longNames = named(fc.oneof(word(60), full), word(3))
const path = fc
  .array(longNames, { minLength: 1, maxLength: 4 })
  .map((parts) => parts.join('\\'))
  .filter((text) => text.length <= 251)
const longPaths = fc.oneof(
  path,
  path.map((text) => `\\${text}`),
)
const none = fc.constant('')
const printable = (min: number, max: number) =>
  fc.string({ unit: fc.constantFrom(...'AZaz09 -~'), minLength: min, maxLength: max })
const shortPasswords = fc.oneof(
  none,
  printable(4, 4).filter((text) => text !== '    '),
)

export function fileValues(form: number): ReadonlyMap<object, fc.Arbitrary<unknown>> {
  const long = (form & FORM_FILE_UTF16) !== 0
  const number = long ? fc.nat(0xffffffff) : fc.nat(0xffff)
  return new Map<object, fc.Arbitrary<unknown>>([
    [driveNumber, fc.oneof(fc.nat(4), fc.nat(0xffff))],
    [fileName, long ? longPaths : shortNames],
    [directoryPath, long ? fc.oneof(none, longPaths) : none],
    [filePassword, long ? printable(0, 32) : shortPasswords],
    [searchPassword, long ? none : shortPasswords],
    [fileNumber, number],
    [lastFileNumber, long ? number : fc.constant(0)],
    [entryName, long ? fc.oneof(longNames, fc.constantFrom('.', '..')) : shortNames],
    [changedTime, time],
    [modifiedTime, time],
  ])
}
