// What is left of a profile when its PLC is spoken to in 1E frames: fewer commands and devices, and smaller requests.
import { isOver1e, slmpNameOf } from '../a-compatible/names'
import { type ACompatibleFamily, aCompatibleLimitSource, aCompatibleLimits } from '../a-compatible/rules'
import { type CommandName, commands } from '../commands/commands'
import { devices } from '../device/device'
import type { DeviceForm } from '../device/device-form'
import type { LimitRule, Weights } from '../device/limit-rule'
import type { DeviceExclusion, Lack, Profile } from './profile'

/** LCS and LCN have a long form only in the SLMP set; 1E has no forms, so both names of one mean the same here. */
const forms: readonly DeviceForm[] = ['short', 'long']
/** Too many points, or a device behind the last one. */
const TOO_MANY = 0x57
const NO_DEVICE = 0x56
const NO_COMMAND = 0x50
const source = aCompatibleLimitSource

/** Not at load: the list of commands and the profiles know each other. */
function lacking(): readonly CommandName[] {
  return Object.values(commands)
    .map(({ name }) => name)
    .filter((name) => !isOver1e(name))
}

function lackOf(command: CommandName): Lack {
  return {
    command,
    endCode: NO_COMMAND,
    reason: 'A 1E frame has no such command.',
    instead: 'Use a 3E frame if the PLC takes it.',
    source,
  }
}

/** Words of double words count twice: they go out as two words. */
const randomWords: Weights = { words: 1, doubleWords: 2 }

function ruleOf({ command, of, max }: (typeof aCompatibleLimits)[number]): LimitRule[] {
  // The only command of 1E with a list of both kinds of devices has the same limit for them.
  if (command === 'writeRandomWords' && of === 'bit') return []
  const random = command === 'writeRandomWords' ? { sum: randomWords } : { of }
  return [{ commands: [slmpNameOf(command)], forms, ...random, max, unit: 'points', endCode: TOO_MANY, source }]
}

function exclusion(commands: readonly CommandName[], device: 'CS' | 'LCS' | 'LCN', reason: string): DeviceExclusion {
  return { commands, devices: [device], endCode: NO_DEVICE, reason, instead: 'Use bit units, or Write.', source }
}

const exclusions: readonly DeviceExclusion[] = [
  exclusion(['readWords', 'writeWords', 'writeRandomWords'], 'CS', 'Counters end at 199, in the middle of a word.'),
  exclusion(['readWords', 'writeWords', 'writeRandomWords'], 'LCS', 'They do not start at a multiple of 16.'),
  exclusion(['writeRandomWords'], 'LCN', 'Test does not write counters of 32 bits.'),
]

/** The profile of the same PLC over 1E. */
export function profileOver1e(profile: Profile, { windows }: ACompatibleFamily): Profile {
  const reached = new Set(windows.map(({ device }) => device))
  return {
    ...profile,
    title: profile.frames.length > 1 ? `${profile.title} in a 1E frame` : profile.title,
    frames: ['1E'],
    frame: '1E',
    forms,
    form: 'short',
    shortDevices: [],
    extensions: [],
    absentDevices: devices.map(({ name }) => name).filter((name) => !reached.has(name)),
    lacks: lacking().map(lackOf),
    doubtful: [],
    exclusions: [...exclusions, ...(profile.exclusions1e ?? [])],
    limits: aCompatibleLimits.flatMap(ruleOf),
    // SD203 is outside what a 1E frame reaches, so the state cannot be read back.
    remote: { clearModes: [0], reset: profile.remote.reset, source: profile.remote.source },
    subcommands: {},
    sources: { ...profile.sources, forms: source, extensions: source, absentDevices: source },
  }
}
