// Stop and release of the PLC and of blocks of its program, and what may be written: thin, named calls over the declarations.
import { checkBooleans, type OptionNames, oneOf, wholeNumber } from '../../basics/option-checks'
import { PlcError, VerifyError } from '../../errors'
import { jwCommands } from '../../jw/commands/commands'
import type { Clock } from '../../transport/clock'
import { type CallOptions, callOptionsOf } from '../connection/call'
import { Deadline } from '../connection/deadline'
import type { SendJwCommand } from './send-command'

/** Whether the PLC runs, and who stopped it: `stopped` by this unit, `stoppedElsewhere` by another unit. */
export type JwRunState = (typeof RUN_STATES)[number]
const RUN_STATES = ['running', 'stopped', 'stoppedElsewhere'] as const

/** What may be written: nothing, the data memory, or all memory. */
export type JwWriteModeName = (typeof jwWriteModes)[number]
/** What may be written: nothing, the data memory, or all memory. */
export const jwWriteModes = ['none', 'data', 'all'] as const

/** Of stop and release. */
export interface JwStopOptions extends CallOptions {
  /** Reads the state back until it is reached, within the timeout of the call. Default false. */
  readonly verify?: boolean
}

const STOP_OPTIONS: OptionNames<Omit<JwStopOptions, keyof CallOptions>> = { verify: true }

/** Run state, stop and release, write mode. What changes the PLC needs `allowControl` and is never repeated. */
export interface JwControl {
  /** Whether the PLC runs (E8H). */
  runState(options?: CallOptions): Promise<JwRunState>
  /**
   * Stops the PLC (F8H). @throws VerifyError with `verify`, when it runs afterwards.
   * @example await plc.control.stop({ verify: true })
   */
  stop(options?: JwStopOptions): Promise<void>
  /** Releases the stop of this unit (F8H). A PLC that another unit has stopped stays stopped. `verify` as of `stop`. */
  release(options?: JwStopOptions): Promise<void>
  /** Whether a block of the program runs (E4H). @param block 0 to 0o777 */
  blockState(block: number, options?: CallOptions): Promise<'running' | 'stopped'>
  /** Stops a block of the program (F4H). */
  stopBlock(block: number, options?: CallOptions): Promise<void>
  /** Releases a block of the program (F4H). */
  releaseBlock(block: number, options?: CallOptions): Promise<void>
  /** What may be written (E9H). No manual at hand says which mode a PLC has after power is turned on. */
  writeMode(options?: CallOptions): Promise<JwWriteModeName>
  /**
   * Sets the write mode (F9H), when it is another one: it is read first. The client never does it by itself.
   * @returns the mode it had
   */
  setWriteMode(mode: JwWriteModeName, options?: CallOptions): Promise<JwWriteModeName>
}

/** What the functions here are made of. */
export interface JwCallParts {
  readonly send: SendJwCommand
  readonly clock: Clock
  /** ms of a call that says none. */
  readonly timeout: number
  /** @throws RequestError NOT_PERMITTED: before a call of several requests sends the first */
  readonly permit: (effect: 'control' | 'configure', title: string) => void
}

/** All requests of one call share its deadline. */
export function sharing(parts: JwCallParts, options: CallOptions): SendJwCommand {
  return within(new Deadline(parts.clock, options, parts.timeout), parts)
}

/** All requests end before the deadline. */
export function within(deadline: Deadline, { send }: Pick<JwCallParts, 'send'>): SendJwCommand {
  return async (command, message) => send(command, message, deadline.options(command.title))
}

const LAST_BLOCK = 0x1ff
const BLOCK_STATES = ['running', 'stopped'] as const

export function jwControl(parts: JwCallParts): JwControl {
  const { send } = parts
  const runState = async (how: SendJwCommand): Promise<JwRunState> => {
    const { state } = await how(jwCommands.readRunState, {})
    return RUN_STATES[state] ?? 'stoppedElsewhere'
  }
  const setRunState = async (state: 0 | 1, options: JwStopOptions): Promise<void> => {
    const call = callOptionsOf(options, STOP_OPTIONS)
    checkBooleans(options, ['verify'])
    if (options.verify !== true) {
      await send(jwCommands.setRunState, { state }, call)
      return
    }
    const deadline = new Deadline(parts.clock, call, parts.timeout)
    const how = within(deadline, parts)
    await how(jwCommands.setRunState, { state })
    await reached(parts.clock, deadline, () => runState(how), state === 0)
  }
  const setBlock = async (block: number, state: 0 | 1, options: CallOptions): Promise<void> => {
    wholeNumber('block', block, 0, LAST_BLOCK)
    await send(jwCommands.setBlockState, { block, state }, options)
  }
  return {
    runState: async (options = {}) => runState(sharing(parts, callOptionsOf(options))),
    stop: async (options = {}) => setRunState(1, options),
    release: async (options = {}) => setRunState(0, options),
    blockState: async (block, options = {}) => {
      wholeNumber('block', block, 0, LAST_BLOCK)
      const { state } = await send(jwCommands.readBlockState, { block }, options)
      return BLOCK_STATES[state] ?? 'stopped'
    },
    stopBlock: async (block, options = {}) => setBlock(block, 1, options),
    releaseBlock: async (block, options = {}) => setBlock(block, 0, options),
    writeMode: async (options = {}) => modeOf((await send(jwCommands.readWriteMode, {}, options)).mode),
    setWriteMode: async (wanted, options = {}) => {
      oneOf('mode', wanted, jwWriteModes)
      parts.permit('control', jwCommands.setWriteMode.title)
      const how = sharing(parts, callOptionsOf(options))
      const before = modeOf((await how(jwCommands.readWriteMode, {})).mode)
      if (before !== wanted) await how(jwCommands.setWriteMode, { mode: jwWriteModes.indexOf(wanted) })
      return before
    },
  }
}

function modeOf(mode: number): JwWriteModeName {
  return jwWriteModes[mode] ?? 'none'
}

const MOST_READS = 20
const PAUSE = 50

/** @throws VerifyError when the state is not reached in time */
async function reached(
  clock: Clock,
  deadline: Deadline,
  read: () => Promise<JwRunState>,
  isRunWanted: boolean,
): Promise<void> {
  const what = isRunWanted ? 'The release' : 'The stop'
  let state: JwRunState | undefined
  try {
    for (let reads = 0; reads < MOST_READS; reads++) {
      if (reads > 0) await deadline.wait(new Promise<void>((resolve) => clock.timer(PAUSE, resolve)), what)
      state = await read()
      if ((state === 'running') === isRunWanted) return
    }
  } catch (error) {
    if (!(error instanceof PlcError)) throw error
    const message = `${what} was carried out, but whether it has the effect is not known: the run state could not be read. ${error.message}`
    if (state === undefined) throw new VerifyError(message, undefined, error)
  }
  const why = state === 'stoppedElsewhere' ? ': another unit has stopped it' : ''
  throw new VerifyError(
    `${what} was carried out, but the PLC is ${state === 'running' ? 'running' : 'stopped'}${why}. Look at the PLC before you send it again.`,
    state,
  )
}
