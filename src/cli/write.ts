import {
  type DeviceExplanation,
  EndCodeError,
  type JwItemExplanation,
  type PlcError,
  type ReadValue,
  RequestError,
  type WriteEntry,
  type WriteResult,
} from '../index'
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
import { errorText, itemErrorText, json, planText, table, valueText } from './output'
import type { Explained, ItemClient, Plc } from './session'
import { refusalOf, type Terminal } from './terminal'
import { typedValue } from './typed-value'

const examples = [
  'write --plc 192.168.3.39:5010 --profile iq-r D110:REAL=650',
  'write --plc 192.168.3.39:5010 --profile iq-r M0=ON D200=0x1F --yes',
  "write --plc 192.168.3.39:5010 --profile iq-r 'D300:INT[3]=1,2,3' 'D130:STRING(20)=Apple juice'",
  "write --plc 192.168.3.39:5010 --profile iq-r Line1.Speed=12.5 'Line1.Values[0]:INT[3]=1,2,3'",
  'write --plc 192.168.3.60:4000 --family jw 09012:INT=650 004033=ON',
]

type WriteOptions = AnyConnectionOptions &
  FormatOptions & { readonly yes?: boolean; readonly readModifyWrite?: boolean; readonly plan?: boolean }

/** What was typed, understood as far as it is without the PLC. */
interface Typed {
  readonly item: string
  readonly text: string
  readonly explanation: Explained
  /** Missing: the type is the PLC's business. */
  readonly value?: ReadValue
}

interface Assignment {
  readonly item: string
  /** What it is, for people. */
  readonly what: string
  readonly type: string
  readonly value: ReadValue
}

/** `melsec-jw write` */
export const writeCommand: MakeCommand = (run) => {
  const command = newCommand('write', 'write devices of the PLC (asks before)', examples)
    .description(
      'Write devices of the PLC, after asking. Values are typed as the item says: numbers decimal or 0x1F, bits ON or ' +
        'OFF, texts as they are, arrays with commas between. All are checked before anything is written, and nothing ' +
        'more is written after the first failure. The types of labels are read from the PLC first.',
    )
    .argument('<item=value...>', 'what to write')
    .optionsGroup('Writing:')
    .option('-y, --yes', 'do not ask')
    .option('--plan', 'do not connect and write nothing: print the requests that would write it')
    .option('--read-modify-write', 'allow bits of words (D100.3): the word is read, changed and written back')
  addFormatOptions(addAnyConnectionOptions(command))
  return command.action((texts: readonly string[], options: WriteOptions) =>
    perform(run, options, () =>
      byFamily(command, options, {
        melsec: () => write(run.terminal, texts, options, melsecPlc(run.terminal, options)),
        jw: () => write(run.terminal, texts, options, jwPlc(run.terminal, options)),
      }),
    ),
  )
}

async function write(terminal: Terminal, texts: readonly string[], options: WriteOptions, plc: Plc): Promise<number> {
  const checking = plc.offline()
  const typed = texts.map((text) => typedOf(checking, text))
  if (options.plan === true) {
    const plan = checking.planWrite(typed.map(plannedEntry), how(options)).describe()
    terminal.out(planText(plan, options.json === true))
    return exitOfPlan(
      plan,
      typed.map(({ item }) => item),
    )
  }
  const assignments = typed.every(isComplete) ? typed.map(deviceAssignment) : undefined
  // Devices are understood before anybody is asked or connected. Of labels only the PLC knows the types.
  if (assignments !== undefined) await confirm(terminal, checking, assignments, options, plc.text)
  return plc.with('writing', async (client) => {
    const all = assignments ?? (await assignmentsOf(client, typed))
    if (assignments === undefined) await confirm(terminal, client, all, options, plc.text)
    const results = await client.writeEach(entriesOf(all), how(options))
    show(terminal, options, all, results)
    return exitOfResults(results)
  })
}

/** Of a label the type is not known yet, so its value is what was typed. How many elements it has is known. */
function plannedEntry({ item, text, explanation, value }: Typed): WriteEntry {
  return { item, value: value ?? (explanation.count === undefined ? text : text.split(',')) }
}

function how(options: WriteOptions) {
  return { allOrNothing: true, readModifyWrite: options.readModifyWrite === true }
}

/** @throws RequestError NOT_PERMITTED when it is not confirmed */
async function confirm(
  terminal: Terminal,
  client: ItemClient,
  assignments: readonly Assignment[],
  options: WriteOptions,
  peer: string,
): Promise<void> {
  const { notes } = client.planWrite(entriesOf(assignments), how(options)).describe()
  const refusal = await refusalOf(terminal, options.yes === true, questionOf(assignments, notes, peer))
  if (refusal !== undefined) throw new RequestError('NOT_PERMITTED', `Nothing was written. ${refusal}`, '--yes')
}

function typedOf(client: ItemClient, text: string): Typed {
  const at = text.indexOf('=')
  if (at < 0) {
    throw new RequestError('BAD_VALUE', `${JSON.stringify(text)} has no value: write ${text}=value, e.g. D100=5.`, text)
  }
  const item = text.slice(0, at).trim()
  const value = text.slice(at + 1)
  const explanation = client.explain(item)
  if ('label' in explanation) return { item, text: value, explanation }
  return { item, text: value, explanation, value: typedValue(explanation, value) }
}

function isComplete(
  typed: Typed,
): typed is Typed & { readonly explanation: DeviceExplanation | JwItemExplanation; readonly value: ReadValue } {
  return typed.value !== undefined
}

function deviceAssignment({
  item,
  explanation,
  value,
}: {
  item: string
  explanation: DeviceExplanation | JwItemExplanation
  value: ReadValue
}): Assignment {
  return { item, what: whatOf(explanation), type: explanation.type, value }
}

function whatOf(explanation: DeviceExplanation | JwItemExplanation): string {
  if ('place' in explanation) return explanation.place
  const { title, first, last } = explanation
  return first === last ? title : `${title} ${first} to ${last}`
}

/** With the types of the labels, as the PLC says them. */
async function assignmentsOf(client: ItemClient, typed: readonly Typed[]): Promise<Assignment[]> {
  const labels = typed.filter((one) => !isComplete(one)).map(({ item }) => item)
  const results = (await client.read(labels)).values()
  return typed.map((one): Assignment => {
    if (isComplete(one)) return deviceAssignment(one)
    const { item, text, explanation } = one
    const result = results.next().value
    if (result?.ok !== true) throw result?.error
    const { type = '' } = result
    const { count } = explanation
    const value = typedValue({ text: item, type, ...(count === undefined ? {} : { count }) }, text)
    return { item, what: 'label', type, value }
  })
}

function entriesOf(assignments: readonly Assignment[]): WriteEntry[] {
  return assignments.map(({ item, value }) => ({ item, value }))
}

function questionOf(assignments: readonly Assignment[], notes: readonly string[], peer: string): string {
  const rows = assignments.map(({ item, what, type, value }) => [item, what, type, `= ${valueText(value, type)}`])
  return [`Write to ${peer}:`, table(rows, '  '), ...notes].join('\n')
}

function show(
  terminal: Terminal,
  options: WriteOptions,
  assignments: readonly Assignment[],
  results: readonly WriteResult[],
): void {
  if (options.json === true) {
    terminal.out(json({ results: results.map((result) => resultData(results, result)) }))
  } else {
    const written = assignments.filter((_, i) => results[i]?.ok === true)
    if (written.length > 0) terminal.out(table(written.map(({ item, value }) => [item, `= ${valueText(value)}`])))
  }
  const told = new Set<PlcError>()
  for (const result of results) {
    if (result.ok) continue
    const { item, error } = result
    const together = sharing(results, result)
    if (together.length === 0) terminal.error(itemErrorText(item, error))
    else
      terminal.error(
        `${item}: not written: sent together with ${together.join(', ')}, and the PLC does not say which it refuses.`,
      )
    if (together.length > 0 && !told.has(error)) terminal.error(errorText(error))
    told.add(error)
  }
}

function resultData(results: readonly WriteResult[], result: WriteResult): unknown {
  if (result.ok) return result
  const together = sharing(results, result)
  return { ...result, error: result.error.toJSON(), ...(together.length === 0 ? {} : { together }) }
}

/** Items that were refused in the same request: one of them is to blame, and which one no end code says. */
function sharing(results: readonly WriteResult[], refused: WriteResult & { readonly ok: false }): readonly string[] {
  const { error } = refused
  if (!(error instanceof EndCodeError) || error.about === 'state' || error.about === 'transmission') return []
  const same = results.filter((result) => result !== refused && !result.ok && result.error === refused.error)
  return same.map(({ item }) => item)
}
