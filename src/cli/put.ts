import { createReadStream } from 'node:fs'
import { stat } from 'node:fs/promises'
import { basename } from 'node:path'
import { RequestError } from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import { peerText, refuseUnsent, withClient } from './connection-options'
import { exitCodes } from './exit-code'
import {
  aboutFiles,
  addChangeOptions,
  type ChangeOptions,
  confirmChange,
  FILE_ARGUMENT,
  filePasswordOf,
  progressOn,
} from './file-options'
import { localFault } from './get'
import { choice } from './option'
import { json } from './output'
import type { Terminal } from './terminal'

const MODES = ['new', 'replace', 'overwrite'] as const

const examples = [
  'put --plc 192.168.3.39:5010 --profile iq-r recipe.csv 4:/RECIPE.CSV',
  'put --plc 192.168.3.39:5010 --profile iq-r recipe.csv 4:/ --mode replace --yes',
]

type PutOptions = ChangeOptions & { readonly mode: (typeof MODES)[number] }

/** `melsec-jw put` */
export const putCommand: MakeCommand = (run) => {
  const command = newCommand('put', 'copy a file of this computer to the PLC (asks before)', examples)
    .argument('<local>', 'file of this computer')
    .argument('<file>', `${FILE_ARGUMENT}; a directory that ends with / takes it under its own name`)
    .optionsGroup('File:')
    .addOption(
      choice(
        '--mode <mode>',
        'new: there is none of this name; replace: the old file stays until the new one is complete; overwrite: into ' +
          'the old file, which has the same size',
        MODES,
      ).default('new'),
    )
  return addChangeOptions(command).action((local: string, file: string, options: PutOptions) =>
    perform(run, options, () => aboutFiles(options, () => put(run.terminal, local, file, options))),
  )
}

async function put(terminal: Terminal, local: string, given: string, options: PutOptions): Promise<number> {
  const file = /[:\\/]$/.test(given.trim()) ? `${given.trim()}${basename(local)}` : given
  const size = await sizeOf(local)
  const { mode } = options
  await refuseUnsent(options, { allowWrites: true }, ({ files }) => files.write(file, [], { size, mode }))
  await confirmChange(terminal, options, `${local} (${size} bytes) -> ${file}, ${mode}.`)
  const password = await filePasswordOf(terminal, options)
  return withClient(terminal, options, { allowWrites: true }, async (client) => {
    const how = { ...password, size, mode, onProgress: progressOn(terminal) }
    await client.files.write(file, createReadStream(local), how).catch((error: unknown) => {
      throw localFault(error) ?? error
    })
    if (options.json === true) terminal.out(json({ plc: peerText(options), local, file, size }))
    else terminal.out(`${local} -> ${file}: ${size} bytes`)
    return exitCodes.ok.code
  })
}

async function sizeOf(local: string): Promise<number> {
  const found = await stat(local).catch((error: NodeJS.ErrnoException) => {
    if (error.code !== 'ENOENT') throw localFault(error) ?? error
    throw new RequestError('BAD_OPTION', `There is no ${local} on this computer: check its name and folder.`, 'local')
  })
  if (found.isFile()) return found.size
  throw new RequestError('BAD_OPTION', `${local} is no file.`, 'local')
}
