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
} from './file-options'
import { json } from './output'
import type { Terminal } from './terminal'

const examples = ['cp --plc 192.168.3.39:5010 --profile iq-r 4:/LOG/LINE.CSV 2:/LINE.CSV']

/** `melsec-jw cp` */
export const cpCommand: MakeCommand = (run) => {
  const command = newCommand('cp', 'copy a file within the PLC (asks before)', examples)
    .argument('<from>', FILE_ARGUMENT)
    .argument('<to>', 'drive and path of the copy, which must not exist')
  return addChangeOptions(command).action((from: string, to: string, options: ChangeOptions) =>
    perform(run, options, () => aboutFiles(options, () => copy(run.terminal, from, to, options))),
  )
}

async function copy(terminal: Terminal, from: string, to: string, options: ChangeOptions): Promise<number> {
  await refuseUnsent(options, { allowWrites: true }, ({ files }) => files.copy(from, to))
  await confirmChange(terminal, options, `Copy ${from} to ${to}.`)
  const password = await filePasswordOf(terminal, options)
  return withClient(terminal, options, { allowWrites: true }, async (client) => {
    await client.files.copy(from, to, password)
    if (options.json === true) terminal.out(json({ plc: peerText(options), from, to }))
    else terminal.out(`${from} -> ${to}`)
    return exitCodes.ok.code
  })
}
