// The families of PLCs that the command line speaks to: which options each has for itself, and who does the work.
import type { Command, Option } from 'commander'
import { RequestError } from '../index'
import { choice } from './option'

export const families = ['melsec', 'jw'] as const
export type Family = (typeof families)[number]

/** As commander gives it. */
export interface FamilyOptions {
  readonly family: Family
}

const TITLES: Readonly<Record<Family, string>> = { melsec: 'MELSEC', jw: 'Sharp JW' }

/** `usual`: what a command speaks to that is not told. */
export const familyOption = (usual: Family = 'melsec') =>
  choice('--family <family>', 'whose PLC: melsec, or jw (Sharp JW)', families).default(usual)

interface Owner {
  readonly family: Family
  /** What to do with a PLC of the other family. */
  readonly instead: string
}

const owners = new WeakMap<Option, Owner>()

/** What `add` adds is of one family alone. `instead`: what to do with a PLC of the other one. */
export function onlyFor(
  family: Family,
  instead: string,
  command: Command,
  add: (command: Command) => unknown,
): Command {
  const before = new Set(command.options)
  add(command)
  for (const option of command.options) if (!before.has(option)) owners.set(option, { family, instead })
  return command
}

/** @throws RequestError BAD_OPTION for an option that was given and the family does not have */
function refuseOthers(command: Command, family: Family): void {
  for (const option of command.options) {
    const owner = owners.get(option)
    if (owner === undefined || owner.family === family) continue
    if (command.getOptionValueSource(option.attributeName()) !== 'cli') continue
    const name = option.long ?? option.name()
    throw new RequestError(
      'BAD_OPTION',
      `${name} is of ${TITLES[owner.family]} only. ${owner.instead}`,
      option.attributeName(),
    )
  }
}

/** Lets the family do the work, once it is sure that it has all options that were given. */
export function byFamily<T>(
  command: Command,
  { family }: FamilyOptions,
  work: Readonly<Record<Family, () => Promise<T>>>,
): Promise<T> {
  refuseOthers(command, family)
  return work[family]()
}

/** What a family lacks, and what to do. */
export interface Lack {
  readonly what: string
  readonly instead: string
}

/** The work of a command that one family alone has. @throws RequestError UNSUPPORTED for a PLC of the other one */
export async function onlyOf<T>(
  family: Family,
  { what, instead }: Lack,
  options: FamilyOptions,
  work: () => Promise<T>,
): Promise<T> {
  if (options.family === family) return work()
  throw new RequestError('UNSUPPORTED', `A ${TITLES[options.family]} has no ${what}. ${instead}`, 'family')
}
