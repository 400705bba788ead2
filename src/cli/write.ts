import {
  createMelsecClient,
  type ItemExplanation,
  type MelsecClient,
  type ReadValue,
  RequestError,
  type WriteEntry,
  type WriteResult,
} from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import {
  addConnectionOptions,
  addFormatOptions,
  type ConnectionOptions,
  clientOptions,
  type FormatOptions,
  peerText,
  withClient,
} from './connection-options'
import { exitOfResults } from './exit-code'
import { errorData, itemErrorText, json, table, valueText } from './output'
import { refusalOf, type Terminal } from './terminal'
import { typedValue } from './typed-value'

const examples = [
  'write --plc 192.168.3.39:5010 --profile iq-r D110:REAL=650',
  'write --plc 192.168.3.39:5010 --profile iq-r M0=ON D200=0x1F --yes',
  "write --plc 192.168.3.39:5010 --profile iq-r 'D300:INT[3]=1,2,3' 'D130:STRING(20)=Apple juice'",
]

type WriteOptions = ConnectionOptions & FormatOptions & { readonly yes?: boolean; readonly readModifyWrite?: boolean }

interface Assignment {
  readonly item: string
  readonly explanation: ItemExplanation
  readonly value: ReadValue
}

/** `melsec-jw write` */
export const writeCommand: MakeCommand = (run) => {
  const command = newCommand('write', 'write devices of the PLC (asks before)', examples)
    .description(
      'Write devices of the PLC, after asking. Values are typed as the item says: numbers decimal or 0x1F, bits ON or ' +
        'OFF, texts as they are, arrays with commas between. All are checked before anything is sent, and nothing ' +
        'more is sent after the first failure.',
    )
    .argument('<item=value...>', 'what to write')
    .optionsGroup('Writing:')
    .option('-y, --yes', 'do not ask')
    .option('--read-modify-write', 'allow bits of words (D100.3): the word is read, changed and written back')
  addFormatOptions(addConnectionOptions(command))
  return command.action((texts: readonly string[], options: WriteOptions) =>
    perform(run, options, () => write(run.terminal, texts, options)),
  )
}

async function write(terminal: Terminal, texts: readonly string[], options: WriteOptions): Promise<number> {
  const how = { allOrNothing: true, readModifyWrite: options.readModifyWrite === true }
  const checking = createMelsecClient(clientOptions(options))
  const assignments = texts.map((text) => assignmentOf(checking, text))
  const { notes } = checking.planWrite(entriesOf(assignments), how).describe()
  const refusal = await refusalOf(terminal, options.yes === true, questionOf(assignments, notes, options))
  if (refusal !== undefined) throw new RequestError('NOT_PERMITTED', `Nothing was written. ${refusal}`, '--yes')
  const results = await withClient(terminal, options, { allowWrites: true }, (client) =>
    client.write(entriesOf(assignments), how),
  )
  show(terminal, options, assignments, results)
  return exitOfResults(results)
}

/** Everything is understood before anybody is asked or connected. */
function assignmentOf(client: MelsecClient, text: string): Assignment {
  const at = text.indexOf('=')
  if (at < 0) {
    throw new RequestError('BAD_VALUE', `${JSON.stringify(text)} has no value: write ${text}=value, e.g. D100=5.`, text)
  }
  const item = text.slice(0, at).trim()
  const explanation = client.explain(item)
  return { item, explanation, value: typedValue(explanation, text.slice(at + 1)) }
}

function entriesOf(assignments: readonly Assignment[]): WriteEntry[] {
  return assignments.map(({ item, value }) => ({ item, value }))
}

function questionOf(assignments: readonly Assignment[], notes: readonly string[], options: WriteOptions): string {
  const rows = assignments.map(({ item, explanation: { title, type, first, last }, value }) => [
    item,
    first === last ? title : `${title} ${first} to ${last}`,
    type,
    `= ${valueText(value, type)}`,
  ])
  return [`Write to ${peerText(options)}:`, table(rows, '  '), ...notes].join('\n')
}

function show(
  terminal: Terminal,
  options: WriteOptions,
  assignments: readonly Assignment[],
  results: readonly WriteResult[],
): void {
  if (options.json === true) {
    terminal.out(
      json({ results: results.map((result) => (result.ok ? result : { ...result, error: errorData(result.error) })) }),
    )
  } else {
    const written = assignments.filter((_, i) => results[i]?.ok === true)
    if (written.length > 0) terminal.out(table(written.map(({ item, value }) => [item, `= ${valueText(value)}`])))
  }
  for (const result of results) if (!result.ok) terminal.error(itemErrorText(result.item, result.error))
}
