import { type CommandDescription, commandNamed, commands, describeCommand, type FieldDescription } from '../entry/codec'
import { type MakeCommand, newCommand, perform } from './command'
import { jsonOption } from './connection-options'
import { exitCodes } from './exit-code'
import { json, table } from './output'

const examples = ['commands', 'commands readWords', 'commands 1617']

/** `melsec-jw commands` */
export const commandsCommand: MakeCommand = (run) =>
  newCommand('commands', 'the commands that request sends, and what their messages hold', examples)
    .argument('[command]', 'one of them, by its name or its code')
    .addOption(jsonOption())
    .action((name: string | undefined, options: { readonly json?: boolean }) =>
      perform(run, options, async () => {
        const found = name === undefined ? undefined : describeCommand(commandNamed(name))
        if (options.json === true) run.terminal.out(json(found ?? { commands: all() }))
        else run.terminal.out(found === undefined ? overview() : details(found))
        return exitCodes.ok.code
      }),
    )

function all(): readonly CommandDescription[] {
  return Object.values(commands).map((command) => describeCommand(command))
}

function overview(): string {
  const rows = all().map(({ name, code, effect, title, manual }) => [name, code, effect, title, manual])
  return table([['COMMAND', 'CODE', 'EFFECT', 'TITLE', 'MANUAL'], ...rows])
}

function details({
  name,
  title,
  code,
  effect,
  manual,
  to,
  context,
  request,
  response,
  example,
}: CommandDescription): string {
  const head = table([
    ['Command', name],
    ['Title', title],
    ['Code', code],
    ['Effect', effect],
    ['Manual', manual],
    ...(to === undefined ? [] : [['Goes to', 'the connected station only, whatever the route']]),
    ...(context === undefined ? [] : [['Also takes', `${context}: the message of that command, which is sent before`]]),
  ])
  return [
    head,
    ...section('Message:', request),
    ...section('Answer:', response),
    '',
    'Example:',
    `  melsec-jw request ${name} '${JSON.stringify(example)}'`,
  ].join('\n')
}

function section(title: string, fields: readonly FieldDescription[]): readonly string[] {
  return ['', title, fields.length === 0 ? '  no fields' : table(rowsOf(fields), '  ')]
}

function rowsOf(fields: readonly FieldDescription[], inside = ''): string[][] {
  return fields.flatMap(({ name, takes = '', optional, doc, item }) => [
    [`${inside}${name}`, optional === true ? `${takes} (may be left out)` : takes, ...(doc === undefined ? [] : [doc])],
    ...rowsOf(
      (item ?? []).filter((row) => row.takes !== undefined),
      `${inside}${name}[].`,
    ),
  ])
}
