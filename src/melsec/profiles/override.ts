// Merges what a user sets differently into a profile. Nothing is dropped: what cannot be is refused.
import { badOption, wholeNumber } from '../../basics/option-checks'
import { type CommandName, commands } from '../commands/commands'
import { type DeviceName, findDevice } from '../device/device'
import type { LimitRule, LimitUnit } from '../device/limit-rule'
import type { Lack, LimitOverrides, Profile, ProfileOverrides } from './profile'

const SOURCE = 'set by the user'
const ZR_COUNTED: readonly CommandName[] = ['readRandom', 'entryMonitorDevice']

function isCommandName(name: string): name is CommandName {
  return Object.hasOwn(commands, name)
}

function byCommand<V>(field: string, values: Readonly<Partial<Record<CommandName, V>>>): [CommandName, V][] {
  return Object.entries<V>(values).map(([name, value]) => {
    if (!isCommandName(name))
      badOption(`${field}.${name}`, `There is no command ${name}. Commands: ${Object.keys(commands).join(', ')}.`)
    return [name, value]
  })
}

function unitsOf(rules: readonly LimitRule[], command: CommandName): readonly LimitUnit[] {
  return [...new Set(rules.filter((rule) => rule.commands.includes(command)).map((rule) => rule.unit))]
}

/** The maxima by unit; a bare number stands for the only unit the command has. */
function maximaOf(
  units: readonly LimitUnit[],
  command: CommandName,
  given: number | Readonly<Partial<Record<LimitUnit, number>>>,
): ReadonlyMap<LimitUnit, number> {
  const field = `profile.limits.${command}`
  const [only] = units
  if (only === undefined) badOption(field, `${command} has no limit that could be set.`)
  if (typeof given === 'number' && units.length > 1) {
    const example = units.map((unit) => `${unit}: ${given}`).join(', ')
    badOption(field, `${command} has several limits; name the one you mean, e.g. { ${example} }.`)
  }
  const maxima = new Map<LimitUnit, number>()
  for (const [name, max] of Object.entries(typeof given === 'number' ? { [only]: given } : given)) {
    const unit = units.find((known) => known === name)
    if (unit === undefined)
      badOption(`${field}.${name}`, `${command} has no limit in ${name}; it has: ${units.join(', ')}.`)
    maxima.set(unit, wholeNumber(`${field}.${name}`, max, 1, Number.MAX_SAFE_INTEGER))
  }
  return maxima
}

/** Replaces the maximum of one unit of one command in every form and code. */
function replaced(
  rules: readonly LimitRule[],
  command: CommandName,
  unit: LimitUnit,
  max: number,
): readonly LimitRule[] {
  return rules.flatMap((rule) => {
    if (rule.unit !== unit || !rule.commands.includes(command)) return [rule]
    const { asciiFactor, extendedFactor, ...plain } = rule
    const own = { ...plain, commands: [command], max, source: SOURCE }
    const others = rule.commands.filter((other) => other !== command)
    return others.length === 0 ? [own] : [{ ...rule, commands: others }, own]
  })
}

function withLimits(profile: Profile, overrides: LimitOverrides): Profile {
  let limits = profile.limits
  for (const [command, given] of byCommand('profile.limits', overrides)) {
    for (const [unit, max] of maximaOf(unitsOf(limits, command), command, given)) {
      limits = replaced(limits, command, unit, max)
    }
  }
  return { ...profile, limits }
}

function withLacks(profile: Profile, overrides: NonNullable<ProfileOverrides['lacks']>): Profile {
  let { lacks, doubtful } = profile
  for (const [command, given] of byCommand('profile.lacks', overrides)) {
    const known = [...lacks, ...doubtful].find((lack) => lack.command === command)
    lacks = lacks.filter((lack) => lack.command !== command)
    doubtful = doubtful.filter((lack) => lack.command !== command)
    if (given !== false) lacks = [...lacks, lackSet(profile, command, given, known)]
  }
  return { ...profile, lacks, doubtful }
}

function lackSet(profile: Profile, command: CommandName, given: true | string, known: Lack | undefined): Lack {
  return {
    command,
    endCode: known?.endCode ?? profile.refusals.command,
    reason: typeof given === 'string' ? given : (known?.reason ?? 'It is marked as lacking in the settings.'),
    instead: known?.instead ?? 'Use another command, or change the setting.',
    source: SOURCE,
  }
}

function withRanges(profile: Profile, overrides: Readonly<Partial<Record<DeviceName, number>>>): Profile {
  for (const [name, points] of Object.entries(overrides)) {
    if (findDevice(name) === undefined) badOption(`profile.ranges.${name}`, `There is no device ${name}.`)
    wholeNumber(`profile.ranges.${name}`, points, 0, Number.MAX_SAFE_INTEGER)
  }
  const { points, source } = profile.ranges
  const ranges = { ...profile.ranges, points: { ...points, ...overrides }, source: `${source}; ${SOURCE}` }
  return { ...profile, ranges }
}

function withSubcommands(profile: Profile, overrides: NonNullable<ProfileOverrides['subcommands']>): Profile {
  const own = byCommand('profile.subcommands', overrides).map(([command, given]) => {
    const value = wholeNumber(`profile.subcommands.${command}`, given, 0, 0xffff)
    return [command, { value, source: SOURCE }] as const
  })
  return { ...profile, subcommands: { ...profile.subcommands, ...Object.fromEntries(own) } }
}

function withInFlight(profile: Profile, overrides: NonNullable<ProfileOverrides['inFlight']>): Profile {
  const { tcp = profile.inFlight.tcp, udpBuffer = profile.inFlight.udpBuffer } = overrides
  wholeNumber('profile.inFlight.tcp', tcp, 1, Number.MAX_SAFE_INTEGER)
  wholeNumber('profile.inFlight.udpBuffer', udpBuffer, 0, Number.MAX_SAFE_INTEGER)
  return { ...profile, inFlight: { tcp, udpBuffer, ports: [], source: SOURCE } }
}

/** SLMP reference manual 5.2, Read Random, footnote *1. */
function withZrCountsDouble(profile: Profile, double: boolean): Profile {
  if (typeof double !== 'boolean') badOption('profile.zrCountsDouble', 'profile.zrCountsDouble is true or false.')
  const limits = profile.limits.map((rule) => {
    if (rule.unit !== 'points' || !rule.commands.some((name) => ZR_COUNTED.includes(name))) return rule
    const { twice, ...plain } = rule
    return double ? { ...plain, twice: ['ZR' as const], source: SOURCE } : { ...plain, source: SOURCE }
  })
  return { ...profile, limits }
}

function withXyRadix(profile: Profile, xyRadix: 8 | 16): Profile {
  if (xyRadix === 8 || xyRadix === 16) return { ...profile, xyRadix, xyRadixKnown: true }
  return badOption('profile.xyRadix', `profile.xyRadix is 8 (octal) or 16 (hexadecimal), not ${String(xyRadix)}.`)
}

function withWRadix(profile: Profile, wRadix: 10 | 16): Profile {
  if (wRadix === 10 || wRadix === 16) return { ...profile, wRadix }
  return badOption('profile.wRadix', `profile.wRadix is 10 (decimal) or 16 (hexadecimal), not ${String(wRadix)}.`)
}

function withFrame(profile: Profile, frame: Profile['frame']): Profile {
  if (profile.frames.includes(frame)) return { ...profile, frame }
  return badOption(
    'profile.frame',
    `${profile.title} has no ${String(frame)} frame. Use ${profile.frames.join(' or ')}.`,
  )
}

const FIELDS = {
  xyRadix: true,
  wRadix: true,
  frame: true,
  limits: true,
  lacks: true,
  ranges: true,
  subcommands: true,
  inFlight: true,
  zrCountsDouble: true,
} as const satisfies Readonly<Record<keyof ProfileOverrides, true>>

/** @throws RequestError BAD_OPTION: a field, command, device or unit that does not exist, or a value that cannot be. */
export function withOverrides(profile: Profile, overrides: ProfileOverrides): Profile {
  for (const name of Object.keys(overrides)) {
    if (Object.hasOwn(FIELDS, name)) continue
    badOption(
      `profile.${name}`,
      `A profile has no ${name} that could be set. Fields: ${Object.keys(FIELDS).join(', ')}.`,
    )
  }
  const { xyRadix, wRadix, frame, limits, lacks, ranges, subcommands, inFlight, zrCountsDouble } = overrides
  let merged = profile
  if (xyRadix !== undefined) merged = withXyRadix(merged, xyRadix)
  if (wRadix !== undefined) merged = withWRadix(merged, wRadix)
  if (frame !== undefined) merged = withFrame(merged, frame)
  if (limits !== undefined) merged = withLimits(merged, limits)
  if (lacks !== undefined) merged = withLacks(merged, lacks)
  if (ranges !== undefined) merged = withRanges(merged, ranges)
  if (subcommands !== undefined) merged = withSubcommands(merged, subcommands)
  if (inFlight !== undefined) merged = withInFlight(merged, inFlight)
  if (zrCountsDouble !== undefined) merged = withZrCountsDouble(merged, zrCountsDouble)
  return merged
}
