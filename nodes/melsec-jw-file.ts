/** Node `melsec-jw-file`: files on the drives of the CPU. */
import type { NodeAPI, NodeMessageInFlow } from 'node-red'
import { encodings, type FilePath, type MelsecClient, textOfBytes } from '../src/index'
import { refusal } from './failure'
import { resolverOf } from './fields'
import { contentOf, fileDateOf, filePathOf } from './file-given'
import { fileList } from './file-list'
import { type TransferOptions, Transfers } from './file-transfers'
import { type Input, inputIn } from './input'
import type { Migration, StoredSettings } from './migration'
import { registerUser, type Tools, type Work } from './node'
import type { Display } from './status'
import { textIn, wordIn } from './stored'
import { sharedTexts, type Texts } from './texts'

const migrations: readonly Migration[] = []

const pathTypes = ['str', 'msg', 'flow', 'global', 'env', 'jsonata'] as const
const dataTypes = ['msg', 'str', 'flow', 'global', 'env', 'jsonata'] as const
/** `date`: now. */
const dateTypes = ['date', 'msg', 'flow', 'global', 'json', 'jsonata'] as const
const outputs = ['buffer', 'text'] as const
const modes = ['new', 'replace', 'overwrite'] as const
const attributes = ['readOnly', 'readWrite'] as const
const textEncodings = ['utf8', ...encodings.filter((each) => each !== 'utf8')] as const

/** What an action is made of. */
interface Parts {
  readonly settings: StoredSettings
  readonly tools: Tools
  readonly file: Input<FilePath>
  readonly password: { readonly password?: string }
  /** @throws NodeFailure when there is no connection */
  readonly reader: () => MelsecClient
  /** @throws NodeFailure NOT_PERMITTED as well */
  readonly writer: () => MelsecClient
  readonly transfer: (what: 'reading' | 'writing') => TransferOptions
}

/** Takes what it needs out of the message at once; what it gives is done when it is the message's turn. */
type Take = (message: NodeMessageInFlow) => Promise<() => Promise<void>>

interface Action {
  readonly changesPlc: boolean
  /** @throws NodeFailure when its settings are wrong */
  readonly prepare: (parts: Parts) => Take
}

const actions = {
  list: {
    changesPlc: false,
    prepare:
      ({ file, reader }) =>
      async (message) => {
        const directory = await file(message)
        return async () => {
          message.payload = await reader().files.list(directory)
        }
      },
  },
  stat: {
    changesPlc: false,
    prepare:
      ({ file, reader }) =>
      async (message) => {
        const path = await file(message)
        return async () => {
          message.payload = (await reader().files.stat(path)) ?? null
        }
      },
  },
  read: { changesPlc: false, prepare: reading },
  write: { changesPlc: true, prepare: writing },
  copy: {
    changesPlc: true,
    prepare: ({ settings, tools, file, writer, password }) => {
      const to = pathIn(settings, 'to', tools)
      return async (message) => {
        const [from, destination] = await Promise.all([file(message), to(message)])
        return () => writer().files.copy(from, destination, password)
      }
    },
  },
  remove: {
    changesPlc: true,
    prepare:
      ({ file, writer, password }) =>
      async (message) => {
        const path = await file(message)
        return () => writer().files.remove(path, password)
      },
  },
  setAttribute: {
    changesPlc: true,
    prepare: ({ settings, tools, file, writer, password }) => {
      const attribute = wordIn(settings, 'attribute', attributes, tools.texts)
      return async (message) => {
        const path = await file(message)
        return () => writer().files.setAttribute(path, attribute, password)
      }
    },
  },
  setDate: {
    changesPlc: true,
    prepare: ({ settings, tools, file, writer }) => {
      const date = inputIn(settings, 'date', dateTypes, tools)
      return async (message) => {
        const [path, given] = await Promise.all([file(message), date(message)])
        const time = fileDateOf(given, tools.texts)
        return () => writer().files.setDate(path, time)
      }
    },
  },
  closeAll: {
    changesPlc: true,
    prepare:
      ({ reader }) =>
      async () =>
      () =>
        reader().files.closeAll(),
  },
} as const satisfies Record<string, Action>

type ActionName = keyof typeof actions
const actionNames = Object.keys(actions) as [ActionName, ...ActionName[]]

function reading({ settings, tools, file, reader, password, transfer }: Parts): Take {
  const { texts } = tools
  const encoding = wordIn(settings, 'encoding', textEncodings, texts)
  const asText = wordIn(settings, 'output', outputs, texts) === 'text'
  const limit = limitIn(settings, texts)
  return async (message) => {
    const path = await file(message)
    return async () => {
      const bytes = await reader().files.read(path, { ...password, ...limit, ...transfer('reading') })
      message.payload = asText ? textOfBytes(bytes, encoding) : bytes
    }
  }
}

function writing({ settings, tools, file, writer, password, transfer }: Parts): Take {
  const { texts } = tools
  const encoding = wordIn(settings, 'encoding', textEncodings, texts)
  const mode = wordIn(settings, 'mode', modes, texts)
  const data = inputIn(settings, 'data', dataTypes, tools)
  return async (message) => {
    const [path, given] = await Promise.all([file(message), data(message)])
    const content = contentOf(given, encoding, texts)
    return () => writer().files.write(path, content, { ...password, mode, ...transfer('writing') })
  }
}

function prepare(settings: StoredSettings, tools: Tools, display: Display): Work {
  const { RED, node, texts, connection } = tools
  // Of a PLC without files this is seen at the deploy.
  connection.melsec('files')
  const transfers = new Transfers(display, texts)
  node.on('close', () => transfers.close())
  const take = actionIn(settings, texts).prepare({
    settings,
    tools,
    file: pathIn(settings, 'file', tools),
    password: passwordOf(RED, tools),
    reader: () => connection.melsec('files'),
    writer: () => {
      connection.plcFor('write')
      return connection.melsec('files')
    },
    transfer: (what) => transfers.options(what),
  })
  return async (message) => {
    // Taken now, because flows change their messages and variables; done in the order in which the messages came.
    const taken = take(message)
    taken.catch(() => undefined)
    await transfers.inTurn(async () => (await taken)())
    return { messages: [message] }
  }
}

function actionIn(settings: StoredSettings, texts: Texts): Action {
  return actions[wordIn(settings, 'action', actionNames, texts)]
}

function pathIn(settings: StoredSettings, field: string, tools: Tools): Input<FilePath> {
  const input = inputIn(settings, field, pathTypes, tools)
  return async (message) => filePathOf(await input(message), field, tools.texts)
}

/** Bytes; without it the library's own. */
function limitIn(settings: StoredSettings, texts: Texts): { readonly limit?: number } {
  const value = textIn(settings, 'limit', texts).trim()
  if (value === '') return {}
  if (/^[0-9]{1,10}$/.test(value)) return { limit: Number(value) }
  throw refusal('NOT_CONFIGURED', texts('error.notNumber', { field: 'limit', value }), { field: 'limit' })
}

/** The password of the file, which Node-RED keeps apart from the flow. Without one the file has none. */
function passwordOf(RED: NodeAPI, { node, texts }: Tools): { readonly password?: string } {
  const { password } = (node.credentials ?? {}) as { readonly password?: unknown }
  if (typeof password !== 'string' || password === '') return {}
  return { password: resolverOf(RED, node, texts)(password) }
}

export = function register(RED: NodeAPI): void {
  const texts = sharedTexts(RED)
  registerUser(RED, {
    type: 'melsec-jw-file',
    migrations,
    changesPlc: (settings) => actionIn(settings, texts).changesPlc,
    // A file that is read is open in the PLC, and locked until it is closed.
    putsInOrder: true,
    prepare,
    credentials: { password: { type: 'password' } },
  })
  fileList(RED, texts)
}
