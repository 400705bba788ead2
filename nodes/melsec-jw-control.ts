/** Node `melsec-jw-control`: remote control of the CPU and questions about the PLC itself. */
import type { NodeAPI } from 'node-red'
import type { ClearMode, Control, MelsecClient } from '../src/index'
import type { PlcConnection } from './connection'
import { refusal } from './failure'
import { InOrder } from './in-order'
import type { Migration, StoredSettings } from './migration'
import { registerUser, type Tools, type Work } from './node'
import { textIn, wordIn } from './stored'
import type { Texts } from './texts'
import { evaluate } from './typed-input'

/** Flows made before there was `verify` go on as they did. */
const migrations: readonly Migration[] = [{ version: 2, up: (settings) => ({ verify: false, ...settings }) }]

const clearModes = ['keep', 'exceptLatched', 'all'] as const satisfies readonly ClearMode[]

interface Options {
  readonly force: boolean
  readonly clear: ClearMode
  readonly verify: boolean
}

interface Command {
  /** It changes what the CPU does, so the connection has to allow it. */
  readonly controls: boolean
  /** @returns what to tell in the payload, besides the command's name */
  readonly run: (client: MelsecClient, options: Options) => Promise<object>
}

const commands = {
  identify: { controls: false, run: async (client) => ({ ...(await client.identify()) }) },
  selfTest: { controls: false, run: async (client) => ({ ...(await client.selfTest()) }) },
  clearError: { controls: true, run: (client) => nothing(client.clearError()) },
  run: {
    controls: true,
    run: async ({ control }, { force, clear, ...options }) => {
      const { verify, told } = verification(control, options)
      await control.run({ force, clear, verify })
      return { force, clear, ...told }
    },
  },
  stop: {
    controls: true,
    run: async ({ control }, options) => {
      const { verify, told } = verification(control, options)
      await control.stop({ verify })
      return told
    },
  },
  pause: {
    controls: true,
    run: async ({ control }, { force, ...options }) => {
      const { verify, told } = verification(control, options)
      await control.pause({ force, verify })
      return { force, ...told }
    },
  },
  latchClear: { controls: true, run: (client) => nothing(client.control.latchClear()) },
  reset: { controls: true, run: (client) => nothing(client.control.reset()) },
} as const satisfies Record<string, Command>

type CommandName = keyof typeof commands

/**
 * A STOP is not refused because nobody can see its effect: where the state of the CPU cannot be read, the command is
 * carried out and told as not verified. Nothing but a state that was read back is told as verified.
 */
function verification({ verifiable }: Control, { verify }: Pick<Options, 'verify'>) {
  return { verify: verify && verifiable, told: verify ? { verified: verifiable } : {} }
}

async function nothing(command: Promise<void>): Promise<object> {
  await command
  return {}
}

/** Where the command comes from; `command`: chosen in the node. */
const sources = ['command', 'msg', 'flow', 'global', 'env', 'jsonata', 'str', 'json'] as const

function prepare(settings: StoredSettings, tools: Tools): Work {
  const { RED, node, connection, texts } = tools
  const type = wordIn(settings, 'commandType', sources, texts)
  const value = textIn(settings, 'command', texts)
  const usual: Options = {
    force: settings.force === true,
    clear: wordIn(settings, 'clear', clearModes, texts),
    verify: settings.verify === true,
  }
  const fixed = type === 'command' ? commandNamed(value, texts) : undefined
  const found = async (message: Parameters<Work>[0]) =>
    fixed === undefined
      ? chosen(await evaluate(RED, node, message, { value, type }), usual, texts)
      : { name: fixed, options: usual }
  // A STOP does not wait until it is verified that the CPU runs.
  const inOrder = new InOrder(tools)
  return async (message) => {
    const { name, told } = await inOrder.act(found(message), async ({ name, options }) => {
      const told: { verified?: boolean } = await carryOut(connection, name, options)
      return { name, told }
    })
    message.payload = { command: name, ...told }
    return { messages: [message], ...(told.verified === false ? { unverified: true } : {}) }
  }
}

function carryOut(connection: PlcConnection, name: CommandName, options: Options): Promise<object> {
  const command: Command = commands[name]
  return command.run(command.controls ? connection.clientFor('control') : connection.client, options)
}

/** `'stop'` or `{ command: 'run', force: true, clear: 'all', verify: true }`; what is left out is the node's. */
function chosen(given: unknown, usual: Options, texts: Texts): { name: CommandName; options: Options } {
  if (typeof given !== 'object' || given === null) return { name: commandNamed(given, texts), options: usual }
  const { command, force = usual.force, clear = usual.clear, verify = usual.verify } = given as Record<string, unknown>
  if (typeof force !== 'boolean') throw refusal('BAD_INPUT', texts('error.badForce'))
  if (typeof verify !== 'boolean') throw refusal('BAD_INPUT', texts('error.badVerify'))
  const clearMode = clearModes.find((mode) => mode === clear)
  if (clearMode === undefined) throw refusal('BAD_INPUT', texts('error.badClear', { choices: clearModes.join(', ') }))
  return { name: commandNamed(command, texts), options: { force, clear: clearMode, verify } }
}

function commandNamed(given: unknown, texts: Texts): CommandName {
  if (typeof given === 'string' && isCommand(given)) return given
  throw refusal(
    'BAD_INPUT',
    texts('error.badCommand', { given: String(given), choices: Object.keys(commands).join(', ') }),
  )
}

function isCommand(name: string): name is CommandName {
  return Object.hasOwn(commands, name)
}

export = function register(RED: NodeAPI): void {
  registerUser(RED, { type: 'melsec-jw-control', migrations, changesPlc: true, prepare })
}
