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

const examples = ['rm --plc 192.168.3.39:5010 --profile iq-r 4:/LOG/OLD.CSV', 'rm --profile q 2:A.CSV 2:B.CSV --yes']

/** `melsec-jw rm` */
export const rmCommand: MakeCommand = (run) => {
  const command = newCommand('rm', 'delete files of the PLC (asks before)', examples)
    .description(
      'Delete files of the PLC, after asking. Deleting a file of a running system can stop it. The first failure ends it.',
    )
    .argument('<file...>', FILE_ARGUMENT)
  return addChangeOptions(command).action((files: readonly string[], options: ChangeOptions) =>
    perform(run, options, () => aboutFiles(options, () => remove(run.terminal, files, options))),
  )
}

async function remove(terminal: Terminal, files: readonly string[], options: ChangeOptions): Promise<number> {
  for (const file of files) await refuseUnsent(options, { allowWrites: true }, (client) => client.files.remove(file))
  await confirmChange(terminal, options, `Delete ${files.join(', ')}.`)
  const password = await filePasswordOf(terminal, options)
  return withClient(terminal, options, { allowWrites: true }, async (client) => {
    for (const file of files) {
      await client.files.remove(file, password)
      if (options.json !== true) terminal.out(`${file} deleted`)
    }
    if (options.json === true) terminal.out(json({ plc: peerText(options), deleted: files }))
    return exitCodes.ok.code
  })
}
