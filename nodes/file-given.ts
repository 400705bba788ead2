// What a file node takes out of a message or a setting: a path, the content of a file, a date.
import { bytesOfText, type Encoding, type FilePath, type FileTime, fileTimeOf } from '../src/index'
import { refusal } from './failure'
import { kindOf } from './kind'
import type { Texts } from './texts'

/**
 * A path as the library takes it, which looks at what it says.
 * @param field the setting it is from
 * @throws NodeFailure BAD_INPUT
 */
export function filePathOf(given: unknown, field: string, texts: Texts): FilePath {
  if (typeof given === 'string' && given.trim() !== '') return given
  if (isPlace(given)) return { drive: given.drive, path: given.path }
  const kind = given === '' ? '""' : kindOf(given)
  throw refusal('BAD_INPUT', texts('error.notFile', { kind }), { field })
}

function isPlace(given: unknown): given is Exclude<FilePath, string> {
  if (typeof given !== 'object' || given === null || !('drive' in given && 'path' in given)) return false
  return typeof given.drive === 'number' && typeof given.path === 'string'
}

/**
 * The content of a file: bytes as they are, text in the encoding.
 * @throws NodeFailure BAD_INPUT, RequestError BAD_VALUE for characters that the encoding does not have
 */
export function contentOf(given: unknown, encoding: Encoding, texts: Texts): Uint8Array {
  if (typeof given === 'string') return bytesOfText(given, encoding)
  if (isBytes(given)) return Buffer.from(given.buffer, given.byteOffset, given.byteLength)
  throw refusal('BAD_INPUT', texts('error.notContent', { kind: kindOf(given) }), { field: 'data' })
}

// A function node has its own Uint8Array and its own Date, which `instanceof` does not know.
function isBytes(given: unknown): given is Uint8Array {
  return ArrayBuffer.isView(given) && tagOf(given) === '[object Uint8Array]'
}

function isDate(given: unknown): given is Date {
  return tagOf(given) === '[object Date]'
}

function tagOf(given: unknown): string {
  return Object.prototype.toString.call(given)
}

/**
 * A date in the PLC's time zone: a Date or milliseconds since 1970 in the time zone of this computer, or its parts.
 * @throws NodeFailure BAD_INPUT, RequestError OUT_OF_RANGE for a date that files cannot have
 */
export function fileDateOf(given: unknown, texts: Texts): FileTime {
  if (typeof given === 'number' || isDate(given)) return fileTimeOf(new Date(Number(given)))
  if (isParts(given)) return given
  throw refusal('BAD_INPUT', texts('error.notFileDate', { kind: kindOf(given) }), { field: 'date' })
}

const PARTS = ['year', 'month', 'day', 'hour', 'minute', 'second'] as const satisfies readonly (keyof FileTime)[]

function isParts(given: unknown): given is FileTime {
  if (typeof given !== 'object' || given === null) return false
  const parts: Readonly<Record<string, unknown>> = { ...given }
  return PARTS.every((part) => typeof parts[part] === 'number')
}
