import { createWriteStream } from 'node:fs'
import { access, rename, rm, stat } from 'node:fs/promises'
import { join } from 'node:path'
import { pipeline } from 'node:stream/promises'
import { RequestError } from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import { peerText, refuseUnsent, withClient } from './connection-options'
import { exitCodes } from './exit-code'
import {
  aboutFiles,
  addFileOptions,
  FILE_ARGUMENT,
  type FileOptions,
  filePasswordOf,
  nameOf,
  progressOn,
} from './file-options'
import { json } from './output'
import type { Terminal } from './terminal'

const examples = [
  'get --plc 192.168.3.39:5010 --profile iq-r 4:/LOG/LINE.CSV',
  'get --plc 192.168.3.39:5010 --profile iq-r 2:/BIG.CSV backup/big.csv --force',
]

type GetOptions = FileOptions & { readonly force?: boolean }

/** `melsec-jw get` */
export const getCommand: MakeCommand = (run) => {
  const command = newCommand('get', 'copy a file of the PLC to this computer', examples)
    .argument('<file>', FILE_ARGUMENT)
    .argument('[local]', 'file or directory of this computer; default: the same name here')
    .optionsGroup('File:')
    .option('--force', 'replace a file of this computer')
  return addFileOptions(command).action((file: string, local: string | undefined, options: GetOptions) =>
    perform(run, options, () => aboutFiles(options, () => get(run.terminal, file, local, options))),
  )
}

async function get(terminal: Terminal, file: string, given: string | undefined, options: GetOptions): Promise<number> {
  const local = await targetOf(given ?? '.', nameOf(file))
  if (options.force !== true && (await exists(local))) {
    throw new RequestError('BAD_OPTION', `${local} exists: say --force to replace it. Nothing was sent.`, 'local')
  }
  await refuseUnsent(options, {}, ({ files }) => files.read(file))
  const password = await filePasswordOf(terminal, options)
  return withClient(terminal, options, {}, async (client) => {
    let size = 0
    const tell = progressOn(terminal)
    const onProgress: typeof tell = (progress) => {
      size = progress.done
      tell(progress)
    }
    // Complete or not there: half a file must not be taken for the whole.
    const part = `${local}.part`
    try {
      await pipeline(client.files.readStream(file, { ...password, onProgress }), createWriteStream(part))
      await rename(part, local)
    } catch (error) {
      await rm(part, { force: true })
      throw localFault(error) ?? error
    }
    if (options.json === true) terminal.out(json({ plc: peerText(options), file, local, size }))
    else terminal.out(`${file} -> ${local}: ${size} bytes`)
    return exitCodes.ok.code
  })
}

/** A directory takes the file under its own name. */
async function targetOf(local: string, name: string): Promise<string> {
  const isDirectory = await stat(local).then(
    (found) => found.isDirectory(),
    () => false,
  )
  return isDirectory ? join(local, name) : local
}

function exists(path: string): Promise<boolean> {
  return access(path).then(
    () => true,
    () => false,
  )
}

/** What this computer's file system refuses is the caller's to mend. */
export function localFault(error: unknown): RequestError | undefined {
  if (typeof error !== 'object' || error === null || !('syscall' in error && 'path' in error)) return undefined
  return new RequestError('BAD_OPTION', 'message' in error ? String(error.message) : String(error), 'local')
}
