/** Node `melsec-jw-write`: writes values when a message arrives, and passes the message on when the PLC has taken them. */
import type { NodeAPI } from 'node-red'
import { type Item, nameResults } from '../src/index'
import { refusal } from './failure'
import type { NodeClient } from './family'
import { InOrder } from './in-order'
import type { Migration, StoredSettings } from './migration'
import { registerUser, type Tools, type Work } from './node'
import { type ItemRow, itemOf, nameOf, rowsIn, textIn, wordIn } from './stored'
import { evaluate } from './typed-input'
import { readBackFailure, writeFailure } from './write-result'
import { entriesByName, entryByTopic, type NamedEntry, typedNumber, writable } from './write-values'
import { fittingEntries, withHint } from './written-value'

const migrations: readonly Migration[] = []

/** Where the values come from; `rows`: each row of the node has its own. `topic`: `msg.payload`, for the address in `msg.topic`. */
const sources = ['rows', 'topic', 'msg', 'flow', 'global', 'jsonata', 'json'] as const
/** What the value of a row is. */
const valueTypes = ['num', 'str', 'bool', 'json', 'msg', 'flow', 'global', 'jsonata'] as const

function prepare(settings: StoredSettings, tools: Tools): Work {
  const { connection, texts } = tools
  const entriesFor = entrySource(settings, tools)
  const readBack = settings.readBack === true
  const readModifyWrite = settings.readModifyWrite === true
  const convert = settings.convert === true
  const found = async (message: Parameters<Work>[0]) =>
    fittingEntries(connection.clientFor('write'), await entriesFor(message), convert)
  const act = async (entries: readonly NamedEntry[]): Promise<void> => {
    const client = connection.clientFor('write')
    const written = await client.writeEach(entries, { readModifyWrite, allOrNothing: true })
    const results = nameResults(
      written,
      entries.map(({ name }) => name),
    )
    const failure = writeFailure(entries, results, texts)
    if (failure !== undefined) throw convert ? failure : withHint(failure, client, entries, texts)
    if (readBack) await check(client, entries, tools)
  }
  // Whole: a message may take several requests, and what is read back must not be what the next one wrote.
  const inOrder = new InOrder(tools, true)
  return async (message) => {
    await inOrder.act(found(message), act)
    return { messages: [message] }
  }
}

async function check(client: NodeClient, entries: readonly NamedEntry[], { texts }: Tools): Promise<void> {
  const results = nameResults(
    await client.read(entries.map((entry) => readBackItem(client, entry))),
    entries.map(({ name }) => name),
  )
  // Of a label the PLC says the type.
  const types = results.map((result, index) => (result.ok && result.type) || typeOf(client, entries[index]))
  const failure = readBackFailure(entries, results, types, texts)
  if (failure !== undefined) throw failure
}

/** A list that was written to a label says itself how many elements it has; reading must be told. */
function readBackItem(client: NodeClient, { item, value }: NamedEntry): Item {
  const explanation = client.explain(item)
  if (!('label' in explanation) || !Array.isArray(value) || explanation.count !== undefined) return item
  const given = typeof item === 'string' ? { address: item } : item
  return { ...given, count: value.length }
}

function typeOf(client: NodeClient, entry: NamedEntry | undefined): string {
  return entry === undefined ? '' : (client.explain(entry.item).type ?? '')
}

type EntrySource = (message: Parameters<Work>[0]) => Promise<NamedEntry[]>

function entrySource(settings: StoredSettings, tools: Tools): EntrySource {
  const { RED, node, texts } = tools
  const type = wordIn(settings, 'valuesType', sources, texts)
  const rows = rowsIn(settings, texts)
  if (type === 'rows') {
    if (rows.length === 0) throw refusal('NOT_CONFIGURED', texts('error.noRows'), { field: 'items' })
    const values = rows.map((row) => rowValue(row, row.stored, tools))
    return (message) =>
      Promise.all(
        rows.map(async (row, index) => {
          const value = await values[index]?.(message)
          return { name: nameOf(row), item: itemOf(row), value: writable(nameOf(row), value, texts) }
        }),
      )
  }
  if (type === 'topic') return async ({ topic, payload }) => [entryByTopic(topic, payload, rows, texts)]
  const input = { value: textIn(settings, 'values', texts), type }
  return async (message) => entriesByName(await evaluate(RED, node, message, input), rows, texts)
}

function rowValue(
  row: ItemRow,
  stored: StoredSettings,
  { RED, node, texts }: Tools,
): (message: Parameters<Work>[0]) => Promise<unknown> {
  const type = wordIn(stored, 'valueType', valueTypes, texts)
  const value = textIn(stored, 'value', texts)
  if (type === 'num') {
    const number = typedNumber(value)
    if (Number.isNaN(number)) {
      throw refusal('NOT_CONFIGURED', texts('error.notTypedNumber', { name: nameOf(row), value }), { field: 'items' })
    }
    return async () => number
  }
  return (message) => evaluate(RED, node, message, { value, type })
}

export = function register(RED: NodeAPI): void {
  registerUser(RED, { type: 'melsec-jw-write', migrations, changesPlc: true, prepare })
}
