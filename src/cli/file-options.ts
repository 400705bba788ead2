// What the commands about files have in common.
import { type Command, Option } from 'commander'
import { type FilePath, type FileProgress, RequestError } from '../index'
import { addConnectionOptions, type ConnectionOptions, peerText } from './connection-options'
import { onlyOf } from './family'
import { refusalOf, type Terminal } from './terminal'

/** Password of a file: not an argument, because the arguments of a program are seen by everybody on the computer. */
const PASSWORD = 'MELSEC_JW_FILE_PASSWORD'

export type FileOptions = ConnectionOptions & { readonly filePassword?: boolean }
export type ChangeOptions = FileOptions & { readonly yes?: boolean }

/** Why a Sharp JW has none of the commands about files. */
const NO_FILES = {
  what: 'files on drives',
  instead: 'What it calls files are parts of its memory: read F2:012345 --family jw.',
}

/** Does what is about files. @throws RequestError UNSUPPORTED */
export function aboutFiles<T>(options: FileOptions, work: () => Promise<T>): Promise<T> {
  return onlyOf('melsec', NO_FILES, options, work)
}

/** How a file of the PLC is written, for the help. */
export const FILE_ARGUMENT = 'drive and path in the PLC, e.g. 4:/LOG/LINE.CSV'

export function addFileOptions(command: Command): Command {
  return addConnectionOptions(
    command
      .optionsGroup('File:')
      .addOption(new Option('--file-password', `ask for the password of the file; without it ${PASSWORD}, if set`)),
  )
}

/** As `addFileOptions`, for commands that ask before they change something. */
export function addChangeOptions(command: Command): Command {
  return addFileOptions(command.optionsGroup('File:').option('-y, --yes', 'do not ask'))
}

/** The password of the file, as an option of the client's calls. @throws RequestError BAD_OPTION */
export async function filePasswordOf(
  terminal: Terminal,
  options: FileOptions,
): Promise<{ readonly password?: string }> {
  if (options.filePassword !== true) {
    const password = process.env[PASSWORD]
    return password ? { password } : {}
  }
  if (!terminal.interactive) {
    const message = `This is no terminal to ask on. Set ${PASSWORD} instead.`
    throw new RequestError('BAD_OPTION', message, '--file-password')
  }
  return { password: await terminal.ask('Password of the file: ', { hidden: true }) }
}

/** @throws RequestError NOT_PERMITTED when nobody says yes */
export async function confirmChange(terminal: Terminal, options: ChangeOptions, what: string): Promise<void> {
  const refusal = await refusalOf(terminal, options.yes === true, `${what} (${peerText(options)})`)
  if (refusal !== undefined) throw new RequestError('NOT_PERMITTED', `Nothing was sent. ${refusal}`, '--yes')
}

/** Tells every tenth part of a transfer to somebody who waits. */
export function progressOn(terminal: Terminal): (progress: FileProgress) => void {
  let told = 0
  return ({ done, total }) => {
    const tenths = total === 0 ? 10 : Math.floor((10 * done) / total)
    if (!terminal.interactive || tenths <= told) return
    told = tenths
    terminal.error(`${tenths * 10} %`)
  }
}

/** The last part of a path in the PLC. @throws RequestError when there is none */
export function nameOf(file: FilePath & string): string {
  const name = file
    .slice(file.indexOf(':') + 1)
    .split(/[\\/]/)
    .at(-1)
  if (name) return name
  throw new RequestError('BAD_ADDRESS', `${JSON.stringify(file)} names no file: it is ${FILE_ARGUMENT}.`, 'file')
}
