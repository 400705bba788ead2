/** Node `melsec-jw-read`: reads device values when a message arrives and passes the message on with them. */
import type { NodeAPI } from 'node-red'
import { type Item, nameResults, type ReadPlan } from '../src/index'
import { busyRuleIn } from './busy'
import { int64Forms } from './carried-value'
import { refusal } from './failure'
import type { NodeClient } from './family'
import type { Migration, StoredSettings } from './migration'
import { registerUser, type Tools, type UserType, type Work } from './node'
import { type NamedItems, namedItems } from './read-items'
import { answerOf, checkForm, type OutputSettings, outputForms, partialRules } from './read-output'
import { itemOf, nameOf, rowsIn, textIn, wordIn } from './stored'
import { timedMessages } from './timed'
import { evaluate } from './typed-input'

const TYPE = 'melsec-jw-read'

const migrations: readonly Migration[] = []

/** Where the addresses come from; `rows`: the list of the node. */
const sources = ['rows', 'msg', 'flow', 'global', 'env', 'jsonata', 'str', 'json'] as const

function prepare(settings: StoredSettings, tools: Tools): Work {
  const { RED, node, connection, texts } = tools
  const itemsFor = itemSource(settings, tools)
  const output = outputOf(settings, tools)
  const planFor = preparedPlans()
  return async (message) => {
    const { names, items } = await itemsFor(message)
    checkForm(output.form, items.length, texts)
    const results = nameResults(await planFor(connection.client, items).run({ caller: node.id }), names)
    return answerOf(output, { names, results }, message, { RED, texts })
  }
}

function outputOf(settings: StoredSettings, { texts }: Tools): OutputSettings {
  return {
    form: wordIn(settings, 'output', outputForms, texts),
    property: textIn(settings, 'property', texts) || 'payload',
    quality: settings.quality === true,
    partial: wordIn(settings, 'partial', partialRules, texts),
    int64: wordIn(settings, 'int64', int64Forms, texts),
  }
}

type ItemSource = (message: Parameters<Work>[0]) => NamedItems | Promise<NamedItems>

function itemSource(settings: StoredSettings, { RED, node, texts }: Tools): ItemSource {
  const type = wordIn(settings, 'addressesType', sources, texts)
  if (type === 'rows') {
    const rows = rowsIn(settings, texts)
    if (rows.length === 0) throw refusal('NOT_CONFIGURED', texts('error.noRows'), { field: 'items' })
    const fixed = { names: rows.map(nameOf), items: rows.map(itemOf) }
    return () => fixed
  }
  const input = { value: textIn(settings, 'addresses', texts), type }
  return async (message) => namedItems(await evaluate(RED, node, message, input), texts)
}

/** The plan of the last items, so that what is read again and again is parsed and packed once. */
function preparedPlans(): (client: NodeClient, items: readonly Item[]) => ReadPlan {
  let last: { client: NodeClient; key: string; items: readonly Item[]; plan: ReadPlan } | undefined
  return (client, items) => {
    if (last !== undefined && last.client === client && last.items === items) return last.plan
    const key = JSON.stringify(items)
    if (last?.client !== client || last.key !== key) last = { client, key, items, plan: client.plan(items) }
    return last.plan
  }
}

export = function register(RED: NodeAPI): void {
  const isTimed = timedMessages(RED, TYPE)
  const busy: UserType['busy'] = (settings, { texts }) => busyRuleIn(settings, isTimed, texts)
  registerUser(RED, { type: TYPE, migrations, changesPlc: false, busy, prepare })
}
