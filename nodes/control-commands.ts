// What a control node can do with a PLC of each family.
import type { ClearMode, Control, Effect, JwClient, JwWriteModeName, MelsecClient } from '../src/index'
import { jwWriteModes } from '../src/index'
import type { PlcConnection } from './connection'
import { refusal } from './failure'
import { forFamily } from './family'
import type { StoredSettings } from './migration'
import { textIn, wordIn } from './stored'
import type { Texts } from './texts'

const clearModes = ['keep', 'exceptLatched', 'all'] as const satisfies readonly ClearMode[]
const writeModes = ['data', 'all', 'none'] as const satisfies readonly JwWriteModeName[]

/** What a command may be told; each takes what it knows. */
export interface ControlOptions {
  readonly force: boolean
  readonly clear: ClearMode
  readonly verify: boolean
  /** Block of the program. */
  readonly block?: number
  /** What may be written from now on. */
  readonly writeMode: JwWriteModeName
  /** What the clock is set to; missing: the time of this computer. */
  readonly time?: Date
}

interface Command<C> {
  /** What it does to the PLC, so the connection may have to allow it. */
  readonly effect: Effect
  /** @returns what to tell in the payload, besides the command's name */
  readonly run: (client: C, options: ControlOptions, texts: Texts) => Promise<object>
}

type Commands<C> = Readonly<Record<string, Command<C>>>

export const melsecControls = {
  identify: { effect: 'read', run: async (client) => ({ ...(await client.identify()) }) },
  selfTest: { effect: 'diagnose', run: async (client) => ({ ...(await client.selfTest()) }) },
  clearError: { effect: 'control', run: (client) => nothing(client.clearError()) },
  run: {
    effect: 'control',
    run: async ({ control }, { force, clear, ...options }) => {
      const { verify, told } = verification(control, options)
      await control.run({ force, clear, verify })
      return { force, clear, ...told }
    },
  },
  stop: {
    effect: 'control',
    run: async ({ control }, options) => {
      const { verify, told } = verification(control, options)
      await control.stop({ verify })
      return told
    },
  },
  pause: {
    effect: 'control',
    run: async ({ control }, { force, ...options }) => {
      const { verify, told } = verification(control, options)
      await control.pause({ force, verify })
      return { force, ...told }
    },
  },
  latchClear: { effect: 'control', run: (client) => nothing(client.control.latchClear()) },
  reset: { effect: 'control', run: (client) => nothing(client.control.reset()) },
} as const satisfies Commands<MelsecClient>

export const jwControls = {
  identify: { effect: 'read', run: async (client) => ({ ...(await client.info()) }) },
  selfTest: { effect: 'diagnose', run: async (client) => ({ ...(await client.selfTest()) }) },
  runState: { effect: 'read', run: async ({ control }) => ({ state: await control.runState() }) },
  stop: {
    effect: 'control',
    run: async ({ control }, { verify }) => {
      await control.stop({ verify })
      return verify ? { verified: true } : {}
    },
  },
  release: {
    effect: 'control',
    run: async ({ control }, { verify }) => {
      await control.release({ verify })
      return verify ? { verified: true } : {}
    },
  },
  blockState: {
    effect: 'read',
    run: async ({ control }, options, texts) => {
      const block = blockOf(options, texts)
      return { block, state: await control.blockState(block) }
    },
  },
  stopBlock: {
    effect: 'control',
    run: async ({ control }, options, texts) => {
      const block = blockOf(options, texts)
      await control.stopBlock(block)
      return { block }
    },
  },
  releaseBlock: {
    effect: 'control',
    run: async ({ control }, options, texts) => {
      const block = blockOf(options, texts)
      await control.releaseBlock(block)
      return { block }
    },
  },
  writeMode: { effect: 'read', run: async ({ control }) => ({ writeMode: await control.writeMode() }) },
  setWriteMode: {
    effect: 'control',
    run: async ({ control }, { writeMode }) => ({ writeMode, before: await control.setWriteMode(writeMode) }),
  },
  readClock: { effect: 'read', run: async ({ clock }) => ({ time: await clock.read() }) },
  setClock: {
    effect: 'control',
    run: async ({ clock }, { time = new Date() }) => {
      await clock.set(time)
      return { time: time.toISOString() }
    },
  },
  adjustClock: { effect: 'control', run: ({ clock }) => nothing(clock.adjust({ round: true })) },
} as const satisfies Commands<JwClient>

/**
 * A STOP is not refused because nobody can see its effect: where the state of the CPU cannot be read, the command is
 * carried out and told as not verified. Nothing but a state that was read back is told as verified.
 */
function verification({ verifiable }: Control, { verify }: Pick<ControlOptions, 'verify'>) {
  return { verify: verify && verifiable, told: verify ? { verified: verifiable } : {} }
}

async function nothing(command: Promise<void>): Promise<object> {
  await command
  return {}
}

function blockOf({ block }: ControlOptions, texts: Texts): number {
  if (block === undefined) throw refusal('BAD_INPUT', texts('error.badBlock', { given: '' }), { field: 'block' })
  return block
}

/** What the editor knows of a command. */
function factsOf<C>(commands: Commands<C>): { readonly name: string; readonly effect: Effect }[] {
  return Object.entries(commands).map(([name, { effect }]) => ({ name, effect }))
}

export const controlFacts = { melsec: factsOf(melsecControls), jw: factsOf(jwControls) }

/** @throws NodeFailure BAD_INPUT naming the commands that a PLC of this family has */
export function controlNamed(given: unknown, connection: PlcConnection, texts: Texts): string {
  const names = controlFacts[connection.plc.family].map(({ name }) => name)
  if (typeof given === 'string' && names.includes(given)) return given
  throw refusal('BAD_INPUT', texts('error.badCommand', { given: String(given), choices: names.join(', ') }))
}

/** @throws NodeFailure NOT_PERMITTED, and whatever the client throws */
export function carryOut(
  connection: PlcConnection,
  name: string,
  options: ControlOptions,
  texts: Texts,
): Promise<object> {
  const run = <C>(client: C, commands: Commands<C>) => {
    const command = commands[controlNamed(name, connection, texts)]
    if (command === undefined) throw new Error(`no command ${name}`)
    connection.plcFor(command.effect)
    return command.run(client, options, texts)
  }
  return forFamily(connection.plc, {
    melsec: (client) => run<MelsecClient>(client, melsecControls),
    jw: (client) => run<JwClient>(client, jwControls),
  })
}

/** What the node says where a message does not. @throws NodeFailure */
export function usualOptions(settings: StoredSettings, texts: Texts): ControlOptions {
  const block = textIn(settings, 'block', texts).trim()
  return {
    force: settings.force === true,
    clear: wordIn(settings, 'clear', clearModes, texts),
    verify: settings.verify === true,
    writeMode: wordIn(settings, 'writeMode', writeModes, texts),
    ...(block === '' ? {} : { block: blockNumber(block, texts) }),
  }
}

/** @param given what stands in the message. @throws NodeFailure BAD_INPUT */
export function optionsWith(
  usual: ControlOptions,
  given: Readonly<Record<string, unknown>>,
  texts: Texts,
): ControlOptions {
  const { force = usual.force, clear = usual.clear, verify = usual.verify, writeMode = usual.writeMode } = given
  if (typeof force !== 'boolean') throw refusal('BAD_INPUT', texts('error.badForce'))
  if (typeof verify !== 'boolean') throw refusal('BAD_INPUT', texts('error.badVerify'))
  const { block = usual.block, time } = given
  return {
    force,
    verify,
    clear: oneOf(clear, clearModes, 'error.badClear', texts),
    writeMode: oneOf(writeMode, jwWriteModes, 'error.badWriteMode', texts),
    ...(block === undefined ? {} : { block: blockNumber(block, texts) }),
    ...(time === undefined ? {} : { time: timeOf(time, texts) }),
  }
}

function oneOf<T extends string>(given: unknown, choices: readonly T[], key: string, texts: Texts): T {
  const chosen = choices.find((choice) => choice === given)
  if (chosen === undefined) throw refusal('BAD_INPUT', texts(key, { choices: choices.join(', ') }))
  return chosen
}

/** A number, or its octal digits as a text, as the manual writes blocks. */
function blockNumber(given: unknown, texts: Texts): number {
  if (typeof given === 'number') return given
  if (typeof given === 'string' && /^[0-7]{1,3}$/.test(given)) return Number.parseInt(given, 8)
  throw refusal('BAD_INPUT', texts('error.badBlock', { given: String(given) }), { field: 'block' })
}

/** A date, or what a date is made of in JSON. */
function timeOf(given: unknown, texts: Texts): Date {
  const time = new Date(typeof given === 'number' || typeof given === 'string' ? given : Number(given))
  if (typeof given !== 'boolean' && given !== null && !Number.isNaN(time.getTime())) return time
  throw refusal('BAD_INPUT', texts('error.badTime', { given: String(given) }), { field: 'time' })
}
