import { type ClearMode, type GlobalSignalOptions, type MelsecClient, RequestError, type RunOptions } from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import { addConnectionOptions, type ConnectionOptions, peerText, refuseUnsent, withClient } from './connection-options'
import { exitCodes } from './exit-code'
import { choice } from './option'
import { json } from './output'
import { refusalOf, type Terminal } from './terminal'

const examples = [
  'control stop --plc 192.168.3.39:5010 --profile iq-r',
  'control run --plc 192.168.3.39:5010 --profile iq-r --yes --verify',
  'control run --plc 192.168.3.39:5010 --profile iq-r --force --clear all',
]

interface ControlOptions extends ConnectionOptions {
  readonly yes?: boolean
  readonly force?: boolean
  readonly clear?: ClearMode
  readonly verify?: boolean
  readonly all?: boolean
}

const EXTRAS = ['force', 'clear', 'verify', 'all'] as const
type Extra = (typeof EXTRAS)[number]

interface Action {
  readonly title: string
  /** What it does to the plant. */
  readonly effect: string
  readonly takes: readonly Extra[]
  /** It changes nothing in the CPU: nobody is asked. */
  readonly harmless?: true
  readonly done: string
  /** The same with --verify. */
  readonly verified?: string
  run(client: MelsecClient, options: ControlOptions): Promise<void>
}

const CLEAR_MODES = ['keep', 'exceptLatched', 'all'] as const satisfies readonly ClearMode[]

/** What can be asked of the CPU. */
const ACTIONS: Readonly<Record<string, Action>> = {
  run: {
    title: 'Remote RUN',
    effect: 'the CPU executes its program: the machine may move',
    takes: ['force', 'clear', 'verify'],
    done: 'Carried out. With its switch at STOP the CPU stays in STOP.',
    verified: 'Carried out, and the CPU is in RUN.',
    run: ({ control }, options) => control.run(given(options)),
  },
  stop: {
    title: 'Remote STOP',
    effect: 'the CPU stops its program, and its outputs go OFF',
    takes: ['verify'],
    done: 'Carried out.',
    verified: 'Carried out, and the CPU is in STOP.',
    run: ({ control }, options) => control.stop(given(options)),
  },
  pause: {
    title: 'Remote PAUSE',
    effect: 'the CPU stops its program, and its outputs stay as they are',
    takes: ['force', 'verify'],
    done: 'Carried out.',
    verified: 'Carried out, and the CPU is in PAUSE.',
    run: ({ control }, options) => control.pause(given(options)),
  },
  'latch-clear': {
    title: 'Remote latch clear',
    effect: 'the latched devices are cleared; the CPU must be in STOP',
    takes: [],
    done: 'Carried out.',
    run: ({ control }) => control.latchClear(),
  },
  reset: {
    title: 'Remote RESET',
    effect: 'the CPU starts again; it must be in STOP, and its parameters must permit it',
    takes: [],
    done: 'Sent. A CPU that resets does not answer, and drops its connections.',
    run: ({ control }) => control.reset(),
  },
  'global-on': {
    title: 'Global signal ON',
    effect: 'the global signal of the station goes on, with --all that of every station on the line (1C frames)',
    takes: ['all'],
    done: 'Sent. What is for all stations is answered by none.',
    run: ({ control }, options) => control.globalSignal(true, globalSignal(options)),
  },
  'global-off': {
    title: 'Global signal OFF',
    effect: 'the global signal of the station goes off, with --all that of every station on the line (1C frames)',
    takes: ['all'],
    done: 'Sent. What is for all stations is answered by none.',
    run: ({ control }, options) => control.globalSignal(false, globalSignal(options)),
  },
  'clear-error': {
    title: 'Clear error',
    effect: 'the error codes of the connected module are cleared and its error LED goes off',
    takes: [],
    done: 'Carried out.',
    run: (client) => client.clearError(),
  },
  'self-test': {
    title: 'Self test',
    effect: 'characters are sent to the connected module and back; nothing changes',
    takes: [],
    harmless: true,
    done: 'What was sent came back.',
    run: async (client) => {
      await client.selfTest()
    },
  },
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

/** `melsec-jw control` */
export const controlCommand: MakeCommand = (run) => {
  const list = Object.entries(ACTIONS).map(([name, { title, effect }]) => `  ${name.padEnd(12)} ${title}: ${effect}`)
  const command = newCommand(
    'control',
    'remote RUN, STOP, PAUSE, latch clear, reset (asks before), self test',
    examples,
  )
    .description('Remote control of the CPU, after asking. It is never repeated by itself.')
    .argument('<action>', `one of ${Object.keys(ACTIONS).join(', ')}`)
    .optionsGroup('Control:')
    .option('-y, --yes', 'do not ask')
    .option('--force', 'run and pause: also when another device has stopped or paused the CPU')
    .option('--verify', 'run, stop and pause: read the state of the CPU back')
    .option('--all', 'global-on and global-off: every station on the line')
    .addOption(choice('--clear <what>', 'run: devices that are cleared before', CLEAR_MODES))
  addConnectionOptions(command).addHelpText('after', `\nActions:\n${list.join('\n')}`)
  return command.action((name: string, options: ControlOptions) =>
    perform(run, options, () => control(run.terminal, name, options)),
  )
}

async function control(terminal: Terminal, name: string, options: ControlOptions): Promise<number> {
  const action = actionOf(name, options)
  await refuseUnsent(options, { allowControl: true }, (client) => action.run(client, options))
  const question = `${action.title} of ${peerText(options)}: ${action.effect}.`
  const refusal = await refusalOf(terminal, options.yes === true || action.harmless === true, question)
  if (refusal !== undefined) throw new RequestError('NOT_PERMITTED', `Nothing was sent. ${refusal}`, '--yes')
  await withClient(terminal, options, { allowControl: true }, (client) => action.run(client, options))
  if (options.json === true) terminal.out(json({ plc: peerText(options), action: name, ok: true }))
  else terminal.out(`${action.title}: ${options.verify === true ? (action.verified ?? action.done) : action.done}`)
  return exitCodes.ok.code
}

function actionOf(name: string, options: ControlOptions): Action {
  const action = Object.hasOwn(ACTIONS, name) ? ACTIONS[name] : undefined
  if (action === undefined) {
    throw new RequestError(
      'BAD_OPTION',
      `There is no ${JSON.stringify(name)}: choose ${Object.keys(ACTIONS).join(', ')}.`,
      'action',
    )
  }
  for (const option of EXTRAS) {
    if (options[option] !== undefined && !action.takes.includes(option)) {
      throw new RequestError('BAD_OPTION', `${action.title} takes no --${option}.`, option)
    }
  }
  return action
}
