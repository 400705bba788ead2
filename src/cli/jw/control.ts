// What can be asked of the CPU of a Sharp JW.
import { type Command, InvalidArgumentError, Option } from 'commander'
import { octal } from '../../basics/octal'
import { type JwClient, type JwRunState, jwWriteModes, RequestError } from '../../index'
import type { ActionOptions, Actions, Found } from '../action'
import { choice } from '../option'

type WriteMode = (typeof jwWriteModes)[number]

/** As commander gives them. */
export interface JwControlOptions extends ActionOptions {
  readonly block?: number
  readonly mode?: WriteMode
}

/** Options that only some actions take. */
export const JW_EXTRAS = ['block', 'mode', 'verify'] as const satisfies readonly (keyof JwControlOptions)[]

export function addJwControlOptions(command: Command): Command {
  return command
    .addOption(
      new Option('--block <number>', 'state, stop and release: one block of the program, 0 to 777 octal').argParser(
        blockOf,
      ),
    )
    .addOption(choice('--mode <mode>', 'write-mode: what may be written', jwWriteModes))
}

function blockOf(text: string): number {
  if (/^[0-7]{1,3}$/.test(text)) return Number.parseInt(text, 8)
  throw new InvalidArgumentError('It is an octal number from 0 to 777.')
}

export const STATES: Readonly<Record<JwRunState, string>> = {
  running: 'it runs',
  stopped: 'it is stopped by this unit',
  stoppedElsewhere: 'it is stopped by another unit, which has to release it',
}

/** What may be written in each mode. */
export const MODES: Readonly<Record<WriteMode, string>> = {
  none: 'nothing may be written',
  data: 'the data memory may be written',
  all: 'all memory may be written',
}

export const JW_ACTIONS: Actions<JwClient, JwControlOptions> = {
  state: {
    title: 'Run state',
    effect: 'says whether the PLC, or with --block one block of its program, runs',
    takes: ['block'],
    harmless: true,
    done: '',
    run: stateOf,
  },
  stop: {
    title: 'Stop',
    effect: 'the PLC, or with --block one block of its program, stops',
    asks: ({ block }) =>
      block === undefined ? 'it stops its program' : `block ${octal(block, 3)} of its program stops`,
    takes: ['block', 'verify'],
    done: 'Carried out.',
    verified: 'Carried out, and the PLC is stopped.',
    run: (client, options) => setState(client, options, 'stop'),
  },
  release: {
    title: 'Release',
    effect: 'the stop of this unit ends, for the PLC or with --block for one block: the machine may move',
    asks: ({ block }) =>
      block === undefined
        ? 'it executes its program again, unless another unit has stopped it too: the machine may move'
        : `block ${octal(block, 3)} of its program runs again: the machine may move`,
    takes: ['block', 'verify'],
    done: 'Carried out. A PLC that another unit has stopped stays stopped.',
    verified: 'Carried out, and the PLC runs.',
    run: (client, options) => setState(client, options, 'release'),
  },
  'write-mode': {
    title: 'Write mode',
    effect: 'says what may be written, and with --mode sets it when it is another one',
    asks: ({ mode = 'none' }) => `it is set to ${mode}, ${MODES[mode]}`,
    takes: ['mode'],
    harmless: ({ mode }) => mode === undefined,
    done: '',
    run: writeMode,
  },
  'self-test': {
    title: 'Self test',
    effect: 'characters are sent to the PLC and back; nothing changes',
    takes: [],
    harmless: true,
    done: 'What was sent came back.',
    run: async (client) => {
      await client.selfTest()
      return undefined
    },
  },
}

async function stateOf({ control }: JwClient, { block }: JwControlOptions): Promise<Found> {
  if (block === undefined) {
    const state = await control.runState()
    return { text: STATES[state], data: { state } }
  }
  const state = await control.blockState(block)
  return { text: `block ${octal(block, 3)} is ${state}`, data: { block, state } }
}

async function setState(
  { control }: JwClient,
  { block, verify }: JwControlOptions,
  what: 'stop' | 'release',
): Promise<Found | undefined> {
  if (block === undefined) {
    await control[what](verify === undefined ? {} : { verify })
    return undefined
  }
  if (verify === true) {
    throw new RequestError(
      'BAD_OPTION',
      '--verify is of the whole PLC: look at a block with control state --block.',
      'verify',
    )
  }
  await (what === 'stop' ? control.stopBlock(block) : control.releaseBlock(block))
  return { text: `Carried out, for block ${octal(block, 3)}.`, data: { block } }
}

async function writeMode({ control }: JwClient, { mode }: JwControlOptions): Promise<Found> {
  if (mode === undefined) {
    const found = await control.writeMode()
    return { text: MODES[found], data: { mode: found } }
  }
  const before = await control.setWriteMode(mode)
  const text = before === mode ? `It was ${mode} already` : `Carried out; it was ${before}`
  return { text: `${text}: ${MODES[mode]}.`, data: { mode, before } }
}
