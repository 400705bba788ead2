/** Node `melsec-jw-control`: remote control of the CPU and questions about the PLC itself. */
import type { NodeAPI } from 'node-red'
import {
  type ControlOptions,
  carryOut,
  controlFacts,
  controlNamed,
  optionsWith,
  usualOptions,
} from './control-commands'
import { InOrder } from './in-order'
import type { Migration, StoredSettings } from './migration'
import { registerUser, type Tools, type Work } from './node'
import { textIn, wordIn } from './stored'
import { evaluate } from './typed-input'

/** Flows made before there was `verify` go on as they did. */
const migrations: readonly Migration[] = [{ version: 2, up: (settings) => ({ verify: false, ...settings }) }]

/** Where the command comes from; `command`: chosen in the node. */
const sources = ['command', 'msg', 'flow', 'global', 'env', 'jsonata', 'str', 'json'] as const

function prepare(settings: StoredSettings, tools: Tools): Work {
  const { RED, node, connection, texts } = tools
  const type = wordIn(settings, 'commandType', sources, texts)
  const value = textIn(settings, 'command', texts)
  const usual = usualOptions(settings, texts)
  // One that the PLC does not have is seen at the deploy.
  const fixed = type === 'command' ? controlNamed(value, connection, texts) : undefined
  const found = async (message: Parameters<Work>[0]) =>
    fixed === undefined
      ? chosen(await evaluate(RED, node, message, { value, type }), usual, tools)
      : { name: fixed, options: usual }
  // A STOP does not wait until it is verified that the CPU runs.
  const inOrder = new InOrder(tools)
  return async (message) => {
    const { name, told } = await inOrder.act(found(message), async ({ name, options }) => {
      const told: { verified?: boolean } = await carryOut(connection, name, options, texts)
      return { name, told }
    })
    message.payload = { command: name, ...told }
    return { messages: [message], ...(told.verified === false ? { unverified: true } : {}) }
  }
}

/** `'stop'` or `{ command: 'run', force: true, clear: 'all', verify: true }`; what is left out is the node's. */
function chosen(
  given: unknown,
  usual: ControlOptions,
  { connection, texts }: Tools,
): { name: string; options: ControlOptions } {
  if (typeof given !== 'object' || given === null) {
    return { name: controlNamed(given, connection, texts), options: usual }
  }
  const { command, ...more } = given as Record<string, unknown>
  return { name: controlNamed(command, connection, texts), options: optionsWith(usual, more, texts) }
}

const editorSettings = { melsecJwControlCommands: { value: controlFacts, exportable: true } } as const

export = function register(RED: NodeAPI): void {
  registerUser(RED, { type: 'melsec-jw-control', migrations, changesPlc: true, prepare, editorSettings })
}
