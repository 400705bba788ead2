import { commands } from '../entry/codec'
import { type CommandName, explainEndCode, type Language, languages, RequestError } from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import { choice, jsonOption } from './connection-options'
import { endCodeOf, endCodeText } from './end-code'
import { exitCodes } from './exit-code'
import { json, table } from './output'
import type { Terminal } from './terminal'

const examples = [
  'explain C059',
  'explain 0xC056 --language ja',
  'explain C059 --command executeMonitor',
  'explain 7601 --language zh-CN',
]

interface ExplainOptions {
  readonly language: Language
  readonly command?: CommandName
  readonly json?: boolean
}

/** `melsec-jw explain` */
export const explainCommand: MakeCommand = (run) =>
  newCommand('explain', 'what an end code or error code of the PLC means, and what to do', examples)
    .argument('<end code>', 'hexadecimal digits, as the PLC and GX Works show it')
    .addOption(choice('--language <language>', 'language of the text', languages).default('en-US'))
    .addOption(
      choice(
        '--command <name>',
        'the command that got it',
        Object.values(commands).map(({ name }) => name),
      ),
    )
    .addOption(jsonOption())
    .action((text: string, options: ExplainOptions) =>
      perform(run, options, async () => {
        explain(run.terminal, text, options)
        return exitCodes.ok.code
      }),
    )

function explain(terminal: Terminal, text: string, { language, command, json: asJson }: ExplainOptions): void {
  const endCode = endCodeOf(text)
  const shown = endCodeText(endCode)
  const found = explainEndCode(endCode, { language, ...(command === undefined ? {} : { command }) })
  if (found === undefined) {
    throw new RequestError(
      'BAD_VALUE',
      `No text is known for end code ${shown}. Look it up in the manual of the module.`,
      'end code',
    )
  }
  if (asJson === true) {
    terminal.out(json({ endCode, ...found }))
    return
  }
  const { meaning, cause, remedy, where, answer, exact } = found
  terminal.out(
    table([
      [answer ? 'End code' : 'Error code', shown],
      // Whoever found the number in a register must not take it for the answer to a request, nor the other way round.
      ...where.map((text, index) => [index === 0 ? 'Where' : '', text]),
      ['Meaning', meaning],
      ...(cause === undefined ? [] : [['Cause', cause]]),
      ['Remedy', remedy],
      ...(exact ? [] : [['Note', 'Only the range of this code is known.']]),
    ]),
  )
}
