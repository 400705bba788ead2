// Remote control of the CPU and the commands about the PLC itself: thin, named calls over the declarations.

import { hex } from '../../basics/hex'
import type { OptionNames } from '../../basics/option-checks'
import { badOption, checkBooleans, oneOf } from '../../basics/option-checks'
import { shown } from '../../basics/show'
import { ProtocolError, RequestError } from '../../errors'
import type { Echo, Exchange, ResponseFrame } from '../../link/link'
import { pcTypeCodes } from '../../melsec/a-compatible/type-code'
import type { ClientProtocol } from '../../melsec/client-protocol'
import type { Command, ResponseOf } from '../../melsec/commands/command'
import { commands } from '../../melsec/commands/commands'
import { decimalWNote, modelOf } from '../../melsec/model-code'
import type { Profile, ProfileId } from '../../melsec/profiles/profile'
import type { Clock } from '../../transport/clock'
import { type CallOptions, callOptionsOf } from '../connection/call'
import { Deadline } from '../connection/deadline'
import type { SendCommand } from './send-command'
import { type CpuStateName, statusOf, verify } from './verify'

/** What Remote Run may clear. */
export type ClearMode = 'keep' | 'exceptLatched' | 'all'
const CLEAR_MODES = { keep: 0, exceptLatched: 1, all: 2 } as const satisfies Record<ClearMode, number>

/** Of RUN, STOP and PAUSE. */
export interface StopOptions extends CallOptions {
  /**
   * Reads the state of the CPU back (SD203) until it is reached, within the timeout of the call. Default false: the call
   * ends when the PLC has taken the command.
   */
  readonly verify?: boolean
}

/** What `control.run()` may say. */
export interface RunOptions extends StopOptions {
  /** Also when another device stopped or paused the CPU: for when that device is broken. Default false. */
  readonly force?: boolean
  /** Devices cleared before it runs; initial values of the parameters are set after. Default `keep`. */
  readonly clear?: ClearMode
}

/** What `control.pause()` may say. */
export interface PauseOptions extends StopOptions {
  /** Also when another device has stopped or paused the CPU. */
  readonly force?: boolean
}

/** What `control.latchClear()` may say. */
export interface LatchClearOptions extends CallOptions {
  /** The field some manuals print as 0 (FX5); default 1. */
  readonly value?: 0 | 1
}

/** What `control.globalSignal()` may say. */
export interface GlobalSignalOptions extends CallOptions {
  /** Whose it is; default `station`: the client's own. */
  readonly to?: 'station' | 'all'
}

const STOP_OPTIONS: OptionNames<Omit<StopOptions, keyof CallOptions>> = { verify: true }
const RUN_OPTIONS: OptionNames<Omit<RunOptions, keyof CallOptions>> = { force: true, clear: true, verify: true }
const PAUSE_OPTIONS: OptionNames<Omit<PauseOptions, keyof CallOptions>> = { force: true, verify: true }
const GLOBAL_SIGNAL_OPTIONS: OptionNames<Omit<GlobalSignalOptions, keyof CallOptions>> = { to: true }
const LATCH_CLEAR_OPTIONS: OptionNames<Omit<LatchClearOptions, keyof CallOptions>> = { value: true }

/**
 * Remote control (SLMP reference manual 5.6). Every call needs `allowControl` and is never repeated.
 * The PLC forgets the remote state when it is powered off or reset.
 */
export interface Control {
  /** Whether `verify` can be asked for here: where the CPU tells its state is known and within reach. */
  readonly verifiable: boolean
  /**
   * Remote RUN. With the switch of the CPU at STOP it completes normally, but the CPU stays in STOP.
   * @throws EndCodeError when another device stopped it and `force` is not given.
   * @throws VerifyError with `verify`, when the CPU does not run afterwards.
   * @throws RequestError UNSUPPORTED with `verify` where the state cannot be read (1E, FX3, generic); nothing is sent.
   * @example await plc.control.run({ verify: true })
   */
  run(options?: RunOptions): Promise<void>
  /** Remote STOP. `verify` as of `run`. */
  stop(options?: StopOptions): Promise<void>
  /** Remote PAUSE: the program stops, outputs are held. `verify` as of `run`. */
  pause(options?: PauseOptions): Promise<void>
  /** Clears the latched devices; the CPU must be in STOP. */
  latchClear(options?: LatchClearOptions): Promise<void>
  /** Resets the CPU, which must be in STOP and permit it by parameter. Silence and a lost connection are its success. */
  reset(options?: CallOptions): Promise<void>
  /**
   * The global signal of a serial channel (SM8680 of an FX5's channel 1, M8126 of an FX3), on or off: of this station, or of
   * all stations of the line at once. 1C frames only (FX5 communication manual 44.6). Nobody answers what is for all, so that
   * it ends when it is sent, and nobody knows who has heard it.
   * @throws RequestError UNSUPPORTED in other frames; nothing is sent.
   * @example await plc.control.globalSignal(true, { to: 'all' })
   */
  globalSignal(on: boolean, options?: GlobalSignalOptions): Promise<void>
}

/** Who the PLC says it is. */
export interface Identity {
  /** Name as the PLC sends it, without padding. */
  readonly model: string
  /** The number that says which model it is. */
  readonly modelCode: number
  /** CPUs that have this code: more certain than the name. Empty when the code is in neither manual. */
  readonly models: readonly string[]
  /** Series of the models, e.g. `iQ-R`. */
  readonly series?: string
  /** The profile that fits. A port cannot be told from the code: where the client's own profile is for such a CPU, it stays. */
  readonly profile?: ProfileId
  /** What may make an address mean another device here than in the device's own manual. */
  readonly warning?: IdentityWarning
}

/** What does not fit between the PLC that answered and the options of the client. */
export interface IdentityWarning {
  /** `W_RADIX`: it is said to number W in decimal, and this client writes W in hexadecimal (`wRadix`). */
  readonly code: 'W_RADIX'
  /** What it is and what to do, in English. */
  readonly message: string
}

/** What remote control is made of. */
export interface ControlParts {
  readonly send: SendCommand
  /** Sends what is no command of the SLMP set. */
  readonly sendExchange: (exchange: Exchange<unknown>, call: CallOptions) => Promise<unknown>
  readonly protocol: Pick<ClientProtocol, 'globalSignal'>
  /** Of the frame that is spoken: 1E reaches less. */
  readonly profile: Profile
  readonly clock: Clock
  /** ms of a call that says none. */
  readonly timeout: number
}

export function controlOf(parts: ControlParts): Control {
  const { send, profile } = parts
  const mode = (force: boolean | undefined) => (force === true ? 3 : 1)
  /** The command and the reading share one deadline; what cannot be verified is not sent. */
  const verified = async (
    wanted: CpuStateName,
    { title }: Command,
    wants: boolean | undefined,
    call: CallOptions,
    act: (options: CallOptions) => Promise<unknown>,
  ): Promise<void> => {
    if (wants !== true) {
      await act(call)
      return
    }
    const status = statusOf(profile, title)
    const deadline = new Deadline(parts.clock, call, parts.timeout)
    await act(deadline.options(title))
    await verify({ send, clock: parts.clock, status, deadline, command: title, wanted })
  }
  return {
    verifiable: profile.remote.status !== undefined,
    run: async (options = {}) => {
      const call = callOptionsOf(options, RUN_OPTIONS)
      checkBooleans(options, ['force', 'verify'])
      const { force, verify, clear = 'keep' } = options
      if (typeof clear !== 'string' || !Object.hasOwn(CLEAR_MODES, clear)) {
        const modes = Object.keys(CLEAR_MODES).join(', ')
        throw new RequestError('BAD_OPTION', `clear is ${shown(clear)}; it must be one of ${modes}.`, 'clear')
      }
      const clearMode = CLEAR_MODES[clear]
      if (!profile.remote.clearModes.includes(clearMode)) {
        throw new RequestError(
          'UNSUPPORTED',
          `${profile.title} cannot clear devices with Remote Run: leave clear at keep.`,
          'clear',
        )
      }
      const message = { mode: mode(force), clearMode } as const
      await verified('RUN', commands.remoteRun, verify, call, (rest) => send(commands.remoteRun, message, rest))
    },
    stop: async (options = {}) => {
      const call = callOptionsOf(options, STOP_OPTIONS)
      checkBooleans(options, ['verify'])
      await verified('STOP', commands.remoteStop, options.verify, call, (rest) => send(commands.remoteStop, {}, rest))
    },
    pause: async (options = {}) => {
      const call = callOptionsOf(options, PAUSE_OPTIONS)
      checkBooleans(options, ['force', 'verify'])
      const { force, verify } = options
      const message = { mode: mode(force) } as const
      await verified('PAUSE', commands.remotePause, verify, call, (rest) => send(commands.remotePause, message, rest))
    },
    latchClear: async (options = {}) => {
      const call = callOptionsOf(options, LATCH_CLEAR_OPTIONS)
      const { value } = options
      await send(commands.remoteLatchClear, value === undefined ? {} : { fixed: value }, call)
    },
    reset: async (call = {}) => {
      await send(commands.remoteReset, {}, call)
    },
    globalSignal: async (on, options = {}) => {
      const call = callOptionsOf(options, GLOBAL_SIGNAL_OPTIONS)
      if (typeof on !== 'boolean') badOption('on', `on is ${shown(on)}; it must be true or false.`)
      const to = oneOf('to', options.to ?? 'station', ['station', 'all'])
      const { globalSignal } = parts.protocol
      if (globalSignal === undefined) {
        const message = 'Only 1C frames have the global signal: use frame 1C on a serial line of an FX5 or FX3.'
        throw new RequestError('UNSUPPORTED', message, 'frame')
      }
      await parts.sendExchange(globalSignal(on, to), call)
    },
  }
}

/** @param wRadix how this client writes W */
export async function identify(
  send: SendCommand,
  own: Profile,
  wRadix: 10 | 16,
  options?: CallOptions,
): Promise<Identity> {
  const { model: padded, modelCode } = await send(commands.readTypeName, {}, options)
  const model = padded.trimEnd()
  const known = modelOf(modelCode)
  const warned = wRadix === 10 ? undefined : decimalWNote(model)
  return {
    model,
    modelCode,
    // 1E has type codes of its own, one for several series: no profile follows from them.
    models: known?.models ?? pcTypeCodes.get(modelCode) ?? [],
    ...(known?.series === undefined ? {} : { series: known.series }),
    ...(known === undefined ? {} : { profile: own.cpu === known.profile ? own.id : known.profile }),
    ...(warned === undefined ? {} : { warning: { code: 'W_RADIX', message: warned } }),
  }
}

const LOOPBACK = '0123456789ABCDEF'

/**
 * Self Test: what does not come back as it was sent is an answer that breaks the protocol, and ends the connection.
 * Its decoder throws ProtocolError ECHO_MISMATCH then.
 */
export function selfTestOf(
  protocol: Pick<ClientProtocol, 'exchange'>,
  data = LOOPBACK,
): Exchange<ResponseOf<typeof commands.selfTest>> {
  const asked = protocol.exchange(commands.selfTest, { data })
  return {
    ...asked,
    decode(frame) {
      const echoed = asked.decode(frame)
      if (echoed.data === data) return echoed
      throw new ProtocolError('ECHO_MISMATCH', `Self Test: the PLC returned "${echoed.data}" instead of "${data}".`)
    },
  }
}

/**
 * Makes self tests whose pattern was not used before, also by the program that had this port before: a number that goes
 * up, behind eight random digits.
 */
export function proofs(protocol: Pick<ClientProtocol, 'exchange'>, random: () => number): () => Echo {
  let count = 0
  return () => {
    count = (count + 1) % 0x1_0000_0000
    const pattern = [Math.floor(random() * 0x1_0000_0000), count].map(digits).join('')
    const { write, mismatch, responseLength, decode } = protocol.exchange(commands.selfTest, { data: pattern })
    const read = (frame: ResponseFrame) => (decode(frame).data === pattern ? 'own' : 'another')
    // As characters, or in ASCII code of 1E frames as two digits for each.
    const forms = [Buffer.from(pattern), Buffer.from(Buffer.from(pattern).toString('hex'))]
    const mayBeOwn = (datagram: Buffer) => forms.some((form) => datagram.includes(form))
    return { write, mismatch, responseLength, mayBeOwn, read }
  }
}

function digits(value: number): string {
  return hex(value, 8)
}
