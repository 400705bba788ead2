import { createMelsecClient, type FileEntry, formatFileTime, isFileTime, RequestError } from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import {
  addConnectionOptions,
  type ConnectionOptions,
  clientOptions,
  peerText,
  refuseUnsent,
  withClient,
} from './connection-options'
import { exitCodes } from './exit-code'
import { aboutFiles } from './file-options'
import { json, table } from './output'
import type { Terminal } from './terminal'

const examples = [
  'ls --plc 192.168.3.39:5010 --profile iq-r',
  'ls --plc 192.168.3.39:5010 --profile iq-r 4:/LOG',
  'ls --plc 192.168.3.39:5010 --profile q 0: --json',
]

/** `melsec-jw ls` */
export const lsCommand: MakeCommand = (run) => {
  const command = newCommand('ls', 'list the files of a drive or directory of the PLC', examples).argument(
    '[directory]',
    'drive and directory, e.g. 4:/LOG; without it the drives are listed, and nothing is sent',
  )
  return addConnectionOptions(command).action((directory: string | undefined, options: ConnectionOptions) =>
    perform(run, options, () =>
      aboutFiles(options, () =>
        directory === undefined ? drives(run.terminal, options) : list(run.terminal, directory, options),
      ),
    ),
  )
}

async function drives(terminal: Terminal, options: ConnectionOptions): Promise<number> {
  const { files, profile } = createMelsecClient(clientOptions(options))
  if (files.drives.length === 0) {
    throw new RequestError('UNSUPPORTED', `The files of ${profile.title} cannot be reached by SLMP.`, 'profile')
  }
  if (options.json === true) terminal.out(json({ profile: profile.id, drives: files.drives }))
  else terminal.out(table(files.drives.map(({ number, title }) => [`${number}:`, title])))
  return exitCodes.ok.code
}

async function list(terminal: Terminal, directory: string, options: ConnectionOptions): Promise<number> {
  await refuseUnsent(options, {}, ({ files }) => files.list(directory))
  return withClient(terminal, options, {}, async (client) => {
    const entries = await client.files.list(directory)
    if (options.json === true) terminal.out(json({ plc: peerText(options), directory, entries }))
    else if (entries.length === 0) terminal.error('There are no files.')
    else terminal.out(table(entries.map(rowOf)))
    return exitCodes.ok.code
  })
}

const KINDS = { file: '-', directory: 'd', system: 's' } as const satisfies Record<FileEntry['kind'], string>

function rowOf({ kind, readOnly, size, modified, name }: FileEntry): string[] {
  const flags = `${KINDS[kind]}r${readOnly ? '-' : 'w'}`
  return [flags, String(size).padStart(10), isFileTime(modified) ? formatFileTime(modified) : 'no date', name]
}
