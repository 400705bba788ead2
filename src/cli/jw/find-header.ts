// Which header a Sharp JW wants in front of messages: found by asking, and only when somebody says so.
import { findJwHeader, type JwHeader } from '../../index'
import { type MakeCommand, newCommand, perform } from '../command'
import { exitCodes } from '../exit-code'
import { onlyOf } from '../family'
import { errorText, json, table } from '../output'
import type { Terminal } from '../terminal'
import {
  addJwConnectionOptions,
  headerOf,
  headerText,
  type JwConnectionOptions,
  jwClientOptions,
  jwText,
} from './connection'

const examples = [
  'find-header --plc 192.168.3.60:4000',
  'find-header --plc 192.168.3.60:4000 --try none --try relay:1,2,3,4',
]

const NO_HEADER = {
  what: 'header to be found',
  instead: 'Its frame is told with --frame; identify tells whether it answers.',
}

interface FindOptions extends JwConnectionOptions {
  readonly try?: readonly JwHeader[]
}

/** `melsec-jw find-header` */
export const findHeaderCommand: MakeCommand = (run) => {
  const command = newCommand('find-header', 'find the header that a Sharp JW wants in front of messages', examples)
    .description(
      'Reads the write mode of a Sharp JW with one header after the other, each on a connection of its own, until it answers. It changes ' +
        'nothing in the PLC. It asks for zero40 and none, or for what --try says.',
    )
    .optionsGroup('Headers:')
    .option(
      '--try <header>',
      'a header as of --header; may be repeated; default zero40, then none',
      (text: string, before: readonly JwHeader[] = []) => [...before, headerOf(text)],
    )
  addJwConnectionOptions(command, { header: false })
  return command.action((options: FindOptions) =>
    perform(run, options, () => onlyOf('jw', NO_HEADER, options, () => find(run.terminal, options))),
  )
}

async function find(terminal: Terminal, options: FindOptions): Promise<number> {
  const { header, tried } = await findJwHeader(jwClientOptions(options), options.try)
  if (options.json === true) {
    const rows = tried.map(({ error, header }) => ({
      header: headerText(header),
      ...(error === undefined ? {} : { error: error.toJSON() }),
    }))
    terminal.out(json({ plc: jwText(options), header: headerText(header), tried: rows }))
    return exitCodes.ok.code
  }
  const rows = tried.map(({ header: one, error }) => [
    headerText(one),
    error === undefined ? 'answered' : (errorText(error).split('\n')[0] ?? ''),
  ])
  terminal.out(table(rows))
  terminal.out(`Say --header ${headerText(header)}.`)
  return exitCodes.ok.code
}
