import { commands } from '../entry/codec'
import {
  type CommandName,
  type EndCodeExplanation,
  type EndCodeFamily,
  endCodeFamilies,
  explainEndCode,
  type Language,
  languages,
  meaningsOfEndCode,
  RequestError,
} from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import { endCodeOf, endCodeText } from './end-code'
import { exitCodes } from './exit-code'
import { choice, jsonOption } from './option'
import { json, table } from './output'
import type { Terminal } from './terminal'

const examples = [
  'explain C059',
  'explain 0xC056 --language ja',
  'explain C059 --command executeMonitor',
  'explain 7601 --language zh-CN',
  'explain 10 --family 1E',
]

interface ExplainOptions {
  readonly language: Language
  readonly family?: EndCodeFamily
  readonly command?: CommandName
  readonly json?: boolean
}

/** `melsec-jw explain` */
export const explainCommand: MakeCommand = (run) =>
  newCommand('explain', 'what an end code or error code of the PLC means, and what to do', examples)
    .argument('<end code>', 'hexadecimal digits, as the PLC and GX Works show it')
    .addOption(
      choice(
        '--family <family>',
        'whose number it is: slmp (four digits, 3E, 4E, 3C and 4C frames and registers), 1E, 1C or jw (Sharp JW; two digits); default all that have it',
        endCodeFamilies,
      ),
    )
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

function explain(terminal: Terminal, text: string, options: ExplainOptions): void {
  const endCode = endCodeOf(text)
  const found = explanationsOf(endCode, options)
  const shown = endCodeText(endCode)
  if (found.length === 0) {
    throw new RequestError(
      'BAD_VALUE',
      `No text is known for end code ${shown}. Look it up in the manual of the module.`,
      'end code',
    )
  }
  if (options.json === true) {
    terminal.out(json({ endCode, meanings: found }))
    return
  }
  if (found.length > 1) terminal.out(`${shown} means something else in each of these frames: say --family.`)
  terminal.out(found.map((one) => explanationText(endCode, one)).join('\n\n'))
}

/** All there are, unless the user knows where the number is from. */
function explanationsOf(endCode: number, { family, language, command }: ExplainOptions): readonly EndCodeExplanation[] {
  const options = { language, ...(command === undefined ? {} : { command }) }
  if (family === undefined) return meaningsOfEndCode(endCode, options)
  const found = explainEndCode(endCode, { family, ...options })
  return found === undefined ? [] : [found]
}

function explanationText(endCode: number, explanation: EndCodeExplanation): string {
  const { family, meaning, cause, remedy, where, answer, exact } = explanation
  return table([
    [answer ? 'End code' : 'Error code', endCodeText(endCode, family)],
    // Whoever found the number in a register must not take it for the answer to a request, nor the other way round.
    ...where.map((text, index) => [index === 0 ? 'Where' : '', text]),
    ['Meaning', meaning],
    ...(cause === undefined ? [] : [['Cause', cause]]),
    ['Remedy', remedy],
    ...(exact ? [] : [['Note', 'Only the range of this code is known.']]),
  ])
}
