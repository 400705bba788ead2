import {
  type CommandDescription,
  commandNamed,
  commands,
  describeCommand,
  describeJwCommand,
  type FieldDescription,
  type JwCommandDescription,
  jwCommandNamed,
  jwCommands,
} from '../entry/codec'
import { type MakeCommand, newCommand, perform } from './command'
import { exitCodes } from './exit-code'
import { type Family, type FamilyOptions, familyOption } from './family'
import { jsonOption } from './option'
import { json, table } from './output'

const examples = ['commands', 'commands readWords', 'commands 1617', 'commands readDataMemory --family jw']

type Description = CommandDescription | JwCommandDescription

/** Where commands of a family are found and described. */
const LISTS: Readonly<Record<Family, { all(): readonly Description[]; named(name: string): Description }>> = {
  melsec: {
    all: () => Object.values(commands).map((command) => describeCommand(command)),
    named: (name) => describeCommand(commandNamed(name)),
  },
  jw: {
    all: () => Object.values(jwCommands).map((command) => describeJwCommand(command)),
    named: (name) => describeJwCommand(jwCommandNamed(name)),
  },
}

/** `melsec-jw commands` */
export const commandsCommand: MakeCommand = (run) =>
  newCommand('commands', 'the commands that request sends, and what their messages hold', examples)
    .argument('[command]', 'one of them, by its name or its code')
    .addOption(familyOption())
    .addOption(jsonOption())
    .action((name: string | undefined, options: FamilyOptions & { readonly json?: boolean }) =>
      perform(run, options, async () => {
        const list = LISTS[options.family]
        const found = name === undefined ? undefined : list.named(name)
        if (options.json === true) run.terminal.out(json(found ?? { commands: list.all() }))
        else run.terminal.out(found === undefined ? overview(list.all()) : details(found, options.family))
        return exitCodes.ok.code
      }),
    )

function overview(list: readonly Description[]): string {
  const rows = list.map(({ name, code, effect, title, manual }) => [name, code, effect, title, manual])
  return table([['COMMAND', 'CODE', 'EFFECT', 'TITLE', 'MANUAL'], ...rows])
}

function details(description: Description, family: Family): string {
  const { name, title, code, effect, manual, request, response, example } = description
  const head = table([
    ['Command', name],
    ['Title', title],
    ['Code', code],
    ['Effect', effect],
    ['Manual', manual],
    ...('confidence' in description ? jwRows(description) : melsecRows(description)),
  ])
  const option = family === 'jw' ? ' --family jw' : ''
  return [
    head,
    ...section('Message:', request),
    ...section('Answer:', response),
    '',
    'Example:',
    `  melsec-jw request ${name} '${JSON.stringify(example)}'${option}`,
  ].join('\n')
}

function melsecRows({ to, context }: CommandDescription): string[][] {
  return [
    ...(to === undefined ? [] : [['Goes to', 'the connected station only, whatever the route']]),
    ...(context === undefined ? [] : [['Also takes', `${context}: the message of that command, which is sent before`]]),
  ]
}

function jwRows({ confidence, open, models }: JwCommandDescription): string[][] {
  return [
    ['Confirmed', confidence],
    ...(open === undefined ? [] : [['Open', open]]),
    ...(models === undefined ? [] : [['Only', models.join(', ')]]),
  ]
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
