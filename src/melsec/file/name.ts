// Which names files can have (SLMP reference manual 5.8, File name length and File name).
import { badMessage } from '../../codec/codec'
import { RequestError } from '../../errors'
import { toShiftJis } from './shift-jis'

/** Bytes of name and extension with subcommands 0000 and 0004; 12 with the period. */
export const SHORT_NAME = { stem: 8, extension: 3 } as const
/** Characters with subcommand 0040: of a name, and of a name with its path. */
export const LONG_NAME = { name: 64, path: 252 } as const

/** Between directories. */
export const SEPARATOR = '\\'

// Background: the SLMP manual leaves them to the manuals of the modules; no file system of a CPU takes them.
const FORBIDDEN = /["*/:<>?|\p{Cc}\p{Surrogate}]/u

function checkCharacters(text: string): void {
  const [found] = FORBIDDEN.exec(text) ?? []
  if (found === undefined) return
  const remedy = found === '/' || found === ':' ? 'write the path from the root as DIR\\FILE.CSV' : 'leave it out'
  badMessage(
    `${JSON.stringify(text)} has the character ${JSON.stringify(found)}, which no file name can have: ${remedy}`,
  )
}

/** Name and extension as they are sent: Shift-JIS, each byte one character. */
export interface ShortName {
  readonly stem: string
  readonly extension: string
}

/**
 * The parts of a name of at most 8 and 3 bytes.
 * @throws RequestError BAD_MESSAGE
 */
export function shortNameOf(given: unknown): ShortName {
  if (typeof given !== 'string' || given === '') badMessage('must be the name of a file')
  checkCharacters(given)
  if (given.includes(SEPARATOR)) badMessage(`${JSON.stringify(given)} is a path: drives of Q and L have no directories`)
  const bytes = toShiftJis(given)
  if (bytes === undefined) badMessage(`${JSON.stringify(given)} has characters that do not exist in Shift-JIS`)
  // The period is a byte of its own in Shift-JIS: 2EH is never the second byte of a character.
  const period = bytes.lastIndexOf('.')
  const stem = period < 0 ? bytes : bytes.slice(0, period)
  const extension = period < 0 ? '' : bytes.slice(period + 1)
  const fits =
    stem.length >= 1 &&
    stem.length <= SHORT_NAME.stem &&
    extension.length <= SHORT_NAME.extension &&
    !stem.includes('.')
  if (!fits || bytes.endsWith('.') || /^ | $/.test(stem) || /^ | $/.test(extension)) {
    badMessage(
      `${JSON.stringify(given)} is no file name of this PLC: 1 to 8 characters, a period and an extension of up to 3 ` +
        '(full-width characters count twice), without spaces around them',
    )
  }
  return { stem, extension }
}

/** Whether subcommands 0000 and 0004 can say the name. */
export function isShortName(name: string): boolean {
  try {
    shortNameOf(name)
    return true
  } catch (error) {
    if (error instanceof RequestError) return false
    throw error
  }
}

/**
 * Checks a path from the root; one separator in front is allowed. `what` is for the message.
 * @throws RequestError BAD_MESSAGE
 */
export function checkLongPath(given: unknown, what: 'file' | 'directory'): string {
  if (typeof given !== 'string') badMessage(`must be the name of a ${what}`)
  const path = given.startsWith(SEPARATOR) ? given.slice(1) : given
  if (path === '' && what === 'directory') return given
  checkCharacters(path)
  const names = path.split(SEPARATOR)
  if (names.some((name) => name === '' || name === '.' || name === '..')) {
    badMessage(
      `${JSON.stringify(given)} must be a path from the root, each part the name of a directory or of the ${what}`,
    )
  }
  const long = names.find((name) => name.length > LONG_NAME.name)
  if (long !== undefined)
    badMessage(`the name ${JSON.stringify(long)} has ${long.length} characters, at most ${LONG_NAME.name}`)
  if (path.length > LONG_NAME.path) badMessage(`has ${path.length} characters with its path, at most ${LONG_NAME.path}`)
  return given
}
