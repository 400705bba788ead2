/** Node `melsec-jw-request`: any command of the manuals, and the buffer memory of modules by their names. */
import type { NodeAPI } from 'node-red'
import { type BufferMemory, extendUnits, type MelsecClient, type ModulePlace } from '../src/index'
import { refusal } from './failure'
import { InOrder } from './in-order'
import { type Input, inputIn } from './input'
import type { Migration, StoredSettings } from './migration'
import { requestFacts, requestsOf } from './named-requests'
import { registerUser, type Tools, type Work } from './node'
import { jsonOf, requestCheck } from './request-check'
import { textIn, wordIn } from './stored'
import { sharedTexts, type Texts } from './texts'

const migrations: readonly Migration[] = []

/** `command`: any of the manuals. `memory`: buffer memory of the connected module. `module`: of a MELSEC-Q module. */
const modes = ['command', 'memory', 'module'] as const
const accesses = ['read', 'write'] as const
/** Where the message comes from. */
const messageTypes = ['json', 'msg', 'flow', 'global', 'env', 'jsonata'] as const
const numberTypes = ['num', 'msg', 'flow', 'global', 'env', 'jsonata'] as const
const valueTypes = ['msg', 'json', 'flow', 'global', 'jsonata'] as const

function prepare(settings: StoredSettings, tools: Tools): Work {
  return wordIn(settings, 'mode', modes, tools.texts) === 'command'
    ? commandWork(settings, tools)
    : memoryWork(settings, tools)
}

function commandWork(settings: StoredSettings, tools: Tools): Work {
  const { connection, texts } = tools
  const { name, effect } = requestsOf(connection.plc).effect(textIn(settings, 'command', texts))
  const asked = messageSource(settings, tools)
  // A fixed message that the PLC cannot be asked is seen at the deploy.
  if (asked.fixed !== undefined) requestsOf(connection.plc).check(name, asked.fixed)
  const inOrder = new InOrder(tools)
  return async (message) => {
    message.payload = await inOrder.act(asked.of(message), async (json) =>
      requestsOf(connection.plcFor(effect)).send(name, json),
    )
    return { messages: [message] }
  }
}

interface MessageSource {
  readonly of: Input<unknown>
  readonly fixed?: unknown
}

function messageSource(settings: StoredSettings, tools: Tools): MessageSource {
  const { texts } = tools
  if (wordIn(settings, 'messageType', messageTypes, texts) !== 'json') {
    return { of: inputIn(settings, 'message', messageTypes, tools) }
  }
  const fixed = fixedMessage(textIn(settings, 'message', texts) || '{}', texts)
  return { of: async () => fixed, fixed }
}

function fixedMessage(text: string, texts: Texts): unknown {
  try {
    return jsonOf(text, texts)
  } catch {
    throw refusal('NOT_CONFIGURED', texts('error.notJson'), { field: 'message' })
  }
}

function memoryWork(settings: StoredSettings, tools: Tools): Work {
  const { connection, texts } = tools
  const of = memorySource(settings, texts)
  // A module that is not known, or not there, is seen at the deploy.
  of(connection.melsec('memory'))
  const address = inputIn(settings, 'address', numberTypes, tools)
  if (wordIn(settings, 'access', accesses, texts) === 'read') {
    const points = inputIn(settings, 'points', numberTypes, tools)
    return async (message) => {
      const [where, count] = await Promise.all([address(message), points(message)])
      const from = numberOf('address', where, texts)
      message.payload = await of(connection.melsec('memory')).read(from, numberOf('points', count, texts))
      return { messages: [message] }
    }
  }
  const values = inputIn(settings, 'values', valueTypes, tools)
  const inOrder = new InOrder(tools)
  return async (message) => {
    await inOrder.act(Promise.all([address(message), values(message)]), async ([where, given]) => {
      const from = numberOf('address', where, texts)
      connection.plcFor('write')
      await of(connection.melsec('memory')).write(from, wordsOf(given, texts))
    })
    return { messages: [message] }
  }
}

function memorySource(settings: StoredSettings, texts: Texts): (client: MelsecClient) => BufferMemory {
  if (wordIn(settings, 'mode', modes, texts) === 'memory') return ({ memory }) => memory
  const model = textIn(settings, 'model', texts)
  const place = placeIn(settings, texts)
  return (client) => client.module(model, place)
}

function placeIn(settings: StoredSettings, texts: Texts): ModulePlace {
  const text = textIn(settings, 'startIo', texts).trim()
  if (!/^[0-9a-f]{1,4}h?$/i.test(text)) {
    throw refusal('NOT_CONFIGURED', texts('error.notHex', { field: 'startIo', value: text }), { field: 'startIo' })
  }
  const slot0 = wordIn(settings, 'slot0', ['', '0', '1'], texts)
  return { startIo: Number.parseInt(text, 16), ...(slot0 === '' ? {} : { slot0: Number(slot0) }) }
}

/** A number, or one as text: environment variables are texts. An empty text is none. */
function numberOf(field: string, given: unknown, texts: Texts): number {
  const number = typeof given === 'string' && given.trim() !== '' ? Number(given) : given
  if (typeof number === 'number' && Number.isInteger(number)) return number
  throw refusal('BAD_INPUT', texts('error.notNumber', { field, value: String(given) }), { field })
}

/** One word, or an array of words; the library checks each. */
function wordsOf(given: unknown, texts: Texts): readonly number[] {
  const list: readonly unknown[] = Array.isArray(given) ? given : [given]
  if (list.length > 0 && list.every((word) => typeof word === 'number')) return list
  throw refusal('BAD_INPUT', texts('error.notWords'), { field: 'values' })
}

const editorSettings = {
  melsecJwRequestCommands: {
    value: requestFacts,
    exportable: true,
  },
  melsecJwRequestModules: {
    value: extendUnits.flatMap(({ models, slot0 }) => models.map((model) => ({ model, known: slot0 !== undefined }))),
    exportable: true,
  },
} as const

export = function register(RED: NodeAPI): void {
  registerUser(RED, { type: 'melsec-jw-request', migrations, changesPlc: true, prepare, editorSettings })
  requestCheck(RED, sharedTexts(RED))
}
