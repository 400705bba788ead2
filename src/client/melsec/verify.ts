// Reads back whether a remote control command has the effect it was sent for: a CPU whose switch is at STOP completes
// Remote RUN normally and stays in STOP (SLMP reference manual 5.6).
import { hex } from '../../basics/hex'
import { PlcError, RequestError, VerifyError } from '../../errors'
import { commands } from '../../melsec/commands/commands'
import type { Profile, StatusRegister } from '../../melsec/profiles/profile'
import type { Clock } from '../../transport/clock'
import type { Deadline } from '../connection/deadline'
import type { SendCommand } from './send-command'

export type CpuStateName = 'RUN' | 'STOP' | 'PAUSE'

/** b0 to b3 of the status register. */
const STATES: readonly (string | undefined)[] = ['RUN', 'STEP-RUN', 'STOP', 'PAUSE', 'INITIALIZE']

/** b4 to b7: why it is not in RUN (special register list of the QCPU manuals, SD203). */
const CAUSES: readonly (string | undefined)[] = [
  'its RUN/STOP switch is at STOP',
  'a remote contact holds it',
  'a remote operation holds it, perhaps of another device',
  'an instruction of its program holds it',
  'it has an error',
]

/** The CPU changes its state at the end of a scan, and a program may take long to start: asked again, ever more rarely. */
const MOST_READS = 20
const FIRST_PAUSE = 20
const LONGEST_PAUSE = 500

/**
 * Where the CPU tells its state.
 * @throws RequestError UNSUPPORTED: nobody knows, or the frame does not reach it. Nothing was sent yet.
 */
export function statusOf(profile: Profile, command: string): StatusRegister {
  const { status } = profile.remote
  if (status !== undefined) return status
  throw new RequestError(
    'UNSUPPORTED',
    `${command} was not sent: it cannot be verified, because where ${profile.title} tells whether it runs is not known or not within reach. ` +
      'Leave verify out, and look at the CPU.',
    'verify',
  )
}

export interface Verification {
  readonly send: SendCommand
  readonly clock: Clock
  readonly status: StatusRegister
  readonly deadline: Deadline
  /** `Remote Run` and so on. */
  readonly command: string
  readonly wanted: CpuStateName
}

/** Resolves when the CPU is in the state. @throws VerifyError */
export async function verify(verification: Verification): Promise<void> {
  const { command, wanted, status, clock, deadline } = verification
  let word: number | undefined
  try {
    for (let reads = 0, pause = FIRST_PAUSE; reads < MOST_READS; reads++, pause = Math.min(2 * pause, LONGEST_PAUSE)) {
      if (reads > 0) await deadline.wait(after(clock, pause), command)
      word = await statusWord(verification)
      if (STATES[word & 0xf] === wanted) return
    }
  } catch (error) {
    if (!(error instanceof PlcError)) throw error
    if (word === undefined) throw unread(command, status, error)
  }
  throw notReached(command, wanted, status, word ?? 0)
}

async function statusWord({ send, status, deadline, command }: Verification): Promise<number> {
  const head = { device: status.device, number: status.number } as const
  const { values } = await send(commands.readWords, { head, points: 1 }, deadline.options(command))
  return values[0] ?? 0
}

function after(clock: Clock, ms: number): Promise<void> {
  return new Promise((resolve) => {
    clock.timer(ms, resolve)
  })
}

function unread(command: string, { device, number }: StatusRegister, cause: PlcError): VerifyError {
  const message = `${command} was carried out, but whether it has the effect is not known: ${device}${number} could not be read. ${cause.message}`
  return new VerifyError(message, undefined, cause)
}

function notReached(
  command: string,
  wanted: CpuStateName,
  { device, number }: StatusRegister,
  word: number,
): VerifyError {
  const state = STATES[word & 0xf]
  const cause = state === 'STOP' || state === 'PAUSE' ? CAUSES[(word >> 4) & 0xf] : undefined
  const shown = `${device}${number} = ${hex(word, 4)}H`
  const message =
    `${command} was carried out, but the CPU is ${state === undefined ? 'in an unknown state' : `in ${state}`}, not in ${wanted} (${shown})` +
    `${cause === undefined ? '.' : `: ${cause}.`} Look at the CPU before you send it again.`
  return new VerifyError(message, state)
}
