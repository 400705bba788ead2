import type { ClearMode, GlobalSignalOptions, MelsecClient, RunOptions } from '../index'
import { type Actions, act, actionHelp } from './action'
import { type MakeCommand, newCommand, perform } from './command'
import { type AnyConnectionOptions, addAnyConnectionOptions, melsecPlc } from './connection-options'
import { byFamily, onlyFor } from './family'
import { jwPlc } from './jw/connection'
import { addJwControlOptions, JW_ACTIONS, JW_EXTRAS, type JwControlOptions } from './jw/control'
import { choice } from './option'

const examples = [
  'control stop --plc 192.168.3.39:5010 --profile iq-r',
  'control run --plc 192.168.3.39:5010 --profile iq-r --yes --verify',
  'control run --plc 192.168.3.39:5010 --profile iq-r --force --clear all',
  'control stop --plc 192.168.3.60:4000 --family jw --verify',
  'control write-mode --mode data --plc 192.168.3.60:4000 --family jw',
]

interface ControlOptions extends AnyConnectionOptions, JwControlOptions {
  readonly yes?: boolean
  readonly force?: boolean
  readonly clear?: ClearMode
  readonly verify?: boolean
  readonly all?: boolean
}

/** Options that only some actions take. */
const EXTRAS = ['force', 'clear', 'verify', 'all'] as const satisfies readonly (keyof ControlOptions)[]

const CLEAR_MODES = ['keep', 'exceptLatched', 'all'] as const satisfies readonly ClearMode[]

/** What can be asked of the CPU. */
const ACTIONS: Actions<MelsecClient, ControlOptions> = {
  run: {
    title: 'Remote RUN',
    effect: 'the CPU executes its program: the machine may move',
    takes: ['force', 'clear', 'verify'],
    done: 'Carried out. With its switch at STOP the CPU stays in STOP.',
    verified: 'Carried out, and the CPU is in RUN.',
    run: async ({ control }, options) => done(control.run(given(options))),
  },
  stop: {
    title: 'Remote STOP',
    effect: 'the CPU stops its program, and its outputs go OFF',
    takes: ['verify'],
    done: 'Carried out.',
    verified: 'Carried out, and the CPU is in STOP.',
    run: async ({ control }, options) => done(control.stop(given(options))),
  },
  pause: {
    title: 'Remote PAUSE',
    effect: 'the CPU stops its program, and its outputs stay as they are',
    takes: ['force', 'verify'],
    done: 'Carried out.',
    verified: 'Carried out, and the CPU is in PAUSE.',
    run: async ({ control }, options) => done(control.pause(given(options))),
  },
  'latch-clear': {
    title: 'Remote latch clear',
    effect: 'the latched devices are cleared; the CPU must be in STOP',
    takes: [],
    done: 'Carried out.',
    run: async ({ control }) => done(control.latchClear()),
  },
  reset: {
    title: 'Remote RESET',
    effect: 'the CPU starts again; it must be in STOP, and its parameters must permit it',
    takes: [],
    done: 'Sent. A CPU that resets does not answer, and drops its connections.',
    run: async ({ control }) => done(control.reset()),
  },
  'global-on': {
    title: 'Global signal ON',
    effect: 'the global signal of the station goes on, with --all that of every station on the line (1C frames)',
    takes: ['all'],
    done: 'Sent. What is for all stations is answered by none.',
    run: async ({ control }, options) => done(control.globalSignal(true, globalSignal(options))),
  },
  'global-off': {
    title: 'Global signal OFF',
    effect: 'the global signal of the station goes off, with --all that of every station on the line (1C frames)',
    takes: ['all'],
    done: 'Sent. What is for all stations is answered by none.',
    run: async ({ control }, options) => done(control.globalSignal(false, globalSignal(options))),
  },
  'clear-error': {
    title: 'Clear error',
    effect: 'the error codes of the connected module are cleared and its error LED goes off',
    takes: [],
    done: 'Carried out.',
    run: async (client) => done(client.clearError()),
  },
  'self-test': {
    title: 'Self test',
    effect: 'characters are sent to the connected module and back; nothing changes',
    takes: [],
    harmless: true,
    done: 'What was sent came back.',
    run: async (client) => done(client.selfTest()),
  },
}

/** It finds nothing out. */
async function done(work: Promise<unknown>): Promise<undefined> {
  await work
  return undefined
}

/** The options that were given. */
function given({ force, clear, verify }: ControlOptions): RunOptions {
  return {
    ...(force === undefined ? {} : { force }),
    ...(clear === undefined ? {} : { clear }),
    ...(verify === undefined ? {} : { verify }),
  }
}

function globalSignal({ all }: ControlOptions): GlobalSignalOptions {
  return all === true ? { to: 'all' } : {}
}

const OTHER_STOP = 'A Sharp JW is stopped and released: control stop, control release.'

/** `melsec-jw control` */
export const controlCommand: MakeCommand = (run) => {
  const command = newCommand(
    'control',
    'remote RUN, STOP, PAUSE, latch clear, reset; stop and release of a Sharp JW (asks before); self test',
    examples,
  )
    .description('Remote control of the CPU, after asking. It is never repeated by itself.')
    .argument(
      '<action>',
      `one of ${Object.keys(ACTIONS).join(', ')}; with --family jw ${Object.keys(JW_ACTIONS).join(', ')}`,
    )
    .optionsGroup('Control:')
    .option('-y, --yes', 'do not ask')
    .option('--verify', 'run, stop, pause and release: read the state of the CPU back')
  onlyFor('melsec', OTHER_STOP, command, () =>
    command
      .option('--force', 'run and pause: also when another device has stopped or paused the CPU')
      .option('--all', 'global-on and global-off: every station on the line')
      .addOption(choice('--clear <what>', 'run: devices that are cleared before', CLEAR_MODES)),
  )
  onlyFor('jw', 'With a Sharp JW say --family jw.', command, addJwControlOptions)
  addAnyConnectionOptions(command).addHelpText(
    'after',
    `${actionHelp('Actions:', ACTIONS)}\n${actionHelp('Actions of a Sharp JW (--family jw):', JW_ACTIONS)}`,
  )
  return command.action((name: string, options: ControlOptions) =>
    perform(run, options, () =>
      byFamily(command, options, {
        melsec: () => act(run.terminal, name, ACTIONS, EXTRAS, options, melsecPlc(run.terminal, options)),
        jw: () => act(run.terminal, name, JW_ACTIONS, JW_EXTRAS, options, jwPlc(run.terminal, options)),
      }),
    ),
  )
}
