import { type ReadResult, RequestError } from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import {
  type AnyConnectionOptions,
  addAnyConnectionOptions,
  addFormatOptions,
  type FormatOptions,
  melsecPlc,
} from './connection-options'
import { exitOfPlan, exitOfResults } from './exit-code'
import { byFamily } from './family'
import { jwPlc } from './jw/connection'
import { itemErrorText, json, planText, table, valueText } from './output'
import type { Explained, ItemClient, Plc } from './session'
import type { Terminal } from './terminal'

const examples = [
  'read --plc 192.168.3.39:5010 --profile iq-r D100 M0 X1F',
  "read --plc 192.168.3.39:5010 --profile iq-r D100:REAL 'D200:DINT[10]' M0..M15 D50.F",
  "read --plc 192.168.3.39:5010 --profile iq-r Line1.Speed 'Line1.Values[2]' label:DD100",
  "read --plc 192.168.3.250:5010 --profile iq-f X17 'D130:STRING(20)' --json",
  "read --plc 192.168.3.60:4000 --family jw 09012 004033 '09000:INT[8]' TMR0012",
]

type ReadOptions = AnyConnectionOptions & FormatOptions & { readonly plan?: boolean }

/** `melsec-jw read` */
export const readCommand: MakeCommand = (run) => {
  const command = newCommand('read', 'read devices of the PLC', examples)
    .description(
      'Read devices of the PLC. An item is a device with a type, written as in GX Works: D100 (INT), M0 (BOOL), ' +
        'D100:REAL, D100.F (a bit of a word), D100:DINT[10] or D0..D9 (several), K4M0 (16 bits as a number), ' +
        'D130:STRING(20), U3\\G100, J1\\W10. Labels of an iQ-R are items too: Line1.Speed, label:DD100, and ' +
        'Line1.Values[0]:INT[10] for ten elements; the PLC says their types. With --family jw items are operands of a Sharp JW, ' +
        'octal: 09012 (BYTE), 004033 (BOOL), 09000:INT[8], TMR0012, F1:00001234.',
    )
    .argument('<items...>', 'what to read')
    .optionsGroup('Reading:')
    .option('--plan', 'do not connect: print the requests that would read it')
  addFormatOptions(addAnyConnectionOptions(command))
  return command.action((items: readonly string[], options: ReadOptions) =>
    perform(run, options, () =>
      byFamily(command, options, {
        melsec: () => read(run.terminal, items, options, melsecPlc(run.terminal, options)),
        jw: () => read(run.terminal, items, options, jwPlc(run.terminal, options)),
      }),
    ),
  )
}

async function read(terminal: Terminal, items: readonly string[], options: ReadOptions, plc: Plc): Promise<number> {
  const offline = plc.offline()
  const plan = offline.plan(items).describe()
  if (options.plan === true) {
    terminal.out(planText(plan, options.json === true))
    return exitOfPlan(plan, items)
  }
  const asked = async (client: ItemClient) => ({
    results: await client.read(items),
    explanations: items.map((item) => explanationOf(client, item)),
  })
  // Where every item is refused there is nothing to connect for.
  const { results, explanations } = await (plan.requests.length === 0 ? asked(offline) : plc.with('reading', asked))
  if (options.json === true) terminal.out(json({ results: results.map(resultData) }))
  else {
    const rows = results.flatMap((result, i) =>
      result.ok
        ? [
            [
              spelt(result.item, explanations[i]),
              valueText(result.value, result.type ?? explanations[i]?.type),
              ...tornText(result),
            ],
          ]
        : [],
    )
    if (rows.length > 0) terminal.out(table(rows))
  }
  for (const result of results) if (!result.ok) terminal.error(itemErrorText(result.item, result.error))
  return exitOfResults(results)
}

/** A count behind a comma in our spelling: `D100,10` is `D100[10]`. Everything else as it was typed. */
function spelt(item: string, explanation: Explained | undefined): string {
  return item.includes(',') && explanation !== undefined && !('label' in explanation) ? explanation.text : item
}

/** What an item is that could be read; how many digits a number is shown with depends on its type. */
function explanationOf(client: ItemClient, item: string): Explained | undefined {
  try {
    return client.explain(item)
  } catch (error) {
    // Its result says what is wrong with it.
    if (error instanceof RequestError) return undefined
    throw error
  }
}

function resultData(result: ReadResult): Readonly<Record<string, unknown>> {
  return result.ok ? { ...result } : { ...result, error: result.error.toJSON() }
}

function tornText(result: ReadResult): readonly string[] {
  return result.ok && result.torn === true ? ['(read by several requests: not of one moment)'] : []
}
