// What is left of a profile when its PLC is spoken to in frames with a command set of their own: fewer commands and devices,
// and smaller requests.

import type { PointLimit } from '../a-compatible/device-rules'
import { isSaid, type SaidName } from '../a-compatible/names'
import type { DeviceWindow } from '../a-compatible/windows'
import { type CommandName, commands } from '../commands/commands'
import { type DeviceName, devices } from '../device/device'
import type { DeviceForm } from '../device/device-form'
import type { LimitRule, Weights } from '../device/limit-rule'
import type { DeviceExclusion, Lack, Profile } from './profile'

/** LCS and LCN have a long form only in the SLMP set; these frames have no forms, so both names of one mean the same. */
const forms: readonly DeviceForm[] = ['short', 'long']

/** What a frame leaves of a profile. */
export interface OtherFrame {
  /** For people: `1E`. */
  readonly frame: string
  /** What to use instead of it, as a sentence. */
  readonly instead: string
  readonly windows: readonly DeviceWindow[]
  /** By the names of the SLMP set. */
  readonly limits: readonly PointLimit<SaidName>[]
  readonly exclusions: readonly DeviceExclusion[]
  /** How it refuses a command that it does not have, and too many points. */
  readonly endCodes: { readonly command: number; readonly points: number }
  readonly source: string
}

/** Not at load: the list of commands and the profiles know each other. */
function lacks({ frame, instead, endCodes, source }: OtherFrame): readonly Lack[] {
  const lacking: readonly CommandName[] = Object.values(commands)
    .map(({ name }) => name)
    .filter((name) => !isSaid(name))
  const reason = `A ${frame} frame has no such command.`
  return lacking.map((command) => ({ command, endCode: endCodes.command, reason, instead, source }))
}

/** Words of double words count twice: they go out as two words. */
const randomWords: Weights = { words: 1, doubleWords: 2 }

function ruleOf({ command, of, max }: PointLimit<SaidName>, { endCodes, source }: OtherFrame): LimitRule[] {
  // The only command with a list of both kinds of devices has the same limit for them.
  if (command === 'writeRandomWords' && of === 'bit') return []
  const random = command === 'writeRandomWords' ? { sum: randomWords } : { of }
  return [{ commands: [command], forms, ...random, max, unit: 'points', endCode: endCodes.points, source }]
}

const wordCommands: readonly CommandName[] = ['readWords', 'writeWords', 'writeRandomWords']

/** Counters in words: those of 16 bits end, and those of 32 bits begin, in the middle of a word of 16. */
export function contactsInWords(endCode: number, source: string): readonly DeviceExclusion[] {
  const instead = 'Use bit units, or Write.'
  const rest = { commands: wordCommands, endCode, instead, source }
  return [
    { ...rest, devices: ['CS'], reason: 'Counters end at 199, in the middle of a word.' },
    { ...rest, devices: ['LCS'], reason: 'They do not start at a multiple of 16.' },
  ]
}

/** The profile of the same PLC in this frame: everything about commands, devices and what requests carry. */
export function narrowed(profile: Profile, other: OtherFrame): Profile {
  const { windows, limits, exclusions, source } = other
  const reached = new Set<DeviceName>(windows.map(({ device }) => device))
  return {
    ...profile,
    forms,
    form: 'short',
    shortDevices: [],
    extensions: [],
    absentDevices: devices.map(({ name }) => name).filter((name) => !reached.has(name)),
    lacks: lacks(other),
    doubtful: [],
    exclusions,
    limits: limits.flatMap((limit) => ruleOf(limit, other)),
    // SD203 is outside what these frames reach, so the state cannot be read back.
    remote: { clearModes: [0], reset: profile.remote.reset, source: profile.remote.source },
    subcommands: {},
    sources: { ...profile.sources, forms: source, extensions: source, absentDevices: source },
  }
}
