import { hex } from '../../basics/hex'
import type { DataCode } from '../../codec/codec'
import { RequestError } from '../../errors'
import type { Command } from '../commands/command'
import type { CommandName } from '../commands/commands'
import { FILE_BITS } from '../file/codec'
import { exclusionOf, lackOf, type Profile } from '../profiles/profile'
import { accessProblem } from './access'
import { FORM_EXTENDED, FORM_LONG, formNeededBy, formProblem } from './codec'
import { deviceInfo } from './device'
import type { DeviceForm } from './device-form'
import type { FoundDevice } from './uses'

/** Subcommand bits of each form. */
export const FORM_BITS: Readonly<Record<DeviceForm, number>> = {
  short: 0,
  long: FORM_LONG,
  extendedShort: FORM_EXTENDED,
  extendedLong: FORM_EXTENDED | FORM_LONG,
}
const FORM_MASK = FORM_EXTENDED | FORM_LONG
const BIT_UNIT = 0x01

const FORM_OF_BITS: ReadonlyMap<number, DeviceForm> = new Map(
  Object.entries(FORM_BITS).map(([form, bits]) => [bits, form as DeviceForm]),
)

/** Subcommands of a command in a form on a family, the usual one first. */
function subcommandsOf(command: Command, form: DeviceForm, profile: Profile): readonly number[] {
  const override = profile.subcommands[command.name as CommandName]
  if (override !== undefined) return [override.value]
  if (command.unit !== 'none') return [FORM_BITS[form] | (command.unit === 'bit' ? BIT_UNIT : 0)]
  const { subcommands } = command
  if (subcommands === undefined) return [0]
  // A file pointer is told alike everywhere; and a family without the command still tells which one it lacks.
  const taken = profile.files.subcommands.filter((subcommand) => subcommands.includes(subcommand))
  return taken.length > 0 ? taken : subcommands
}

/**
 * Subcommand of a command in a form: bit 0 unit, bit 1 long form, bit 7 extension (SLMP reference manual 5.1); of file
 * commands as the profile has it, or the one that is wanted.
 * @throws RequestError UNSUPPORTED: this family does not have the wanted one.
 */
export function subcommandOf(command: Command, form: DeviceForm, profile: Profile, wanted?: number): number {
  const taken = subcommandsOf(command, form, profile)
  const [usual = 0] = taken
  if (wanted === undefined || taken.includes(wanted)) return wanted ?? usual
  const known = taken.map((subcommand) => hex(subcommand, 4)).join(' or ')
  throw new RequestError(
    'UNSUPPORTED',
    `${command.title} on ${profile.title} takes subcommand ${known}, not ${hex(wanted, 4)}.`,
    'subcommand',
  )
}

/** What the value codecs of a request and its answer go by. */
export function codecBits(command: Command, form: DeviceForm, subcommand: number): number {
  return FORM_BITS[form] | (command.subcommands === undefined ? 0 : subcommand & FILE_BITS)
}

/** Which of the declared commands a command and a subcommand number name; one rule for whoever reads requests. */
export function findCommand(
  list: Readonly<Record<string, Command>>,
  profile: Profile,
  code: number,
  subcommand: number,
): { readonly command: Command; readonly form: DeviceForm } | undefined {
  const device = readSubcommand(subcommand)
  for (const command of Object.values(list)) {
    if (command.code !== code) continue
    if (command.unit === 'none') {
      if (subcommandsOf(command, 'short', profile).includes(subcommand)) return { command, form: 'short' }
    } else if (device?.unit === command.unit) return { command, form: device.form }
  }
  return undefined
}

/** The unit and form a received subcommand says; `undefined` when no command has such a subcommand. */
export function readSubcommand(subcommand: number): { unit: 'bit' | 'word'; form: DeviceForm } | undefined {
  const form = FORM_OF_BITS.get(subcommand & FORM_MASK)
  if (form === undefined || (subcommand & ~(FORM_MASK | BIT_UNIT)) !== 0) return undefined
  return { unit: (subcommand & BIT_UNIT) === 0 ? 'word' : 'bit', form }
}

/**
 * The form this request is sent in: the profile's own, or the first of its forms that can say every address.
 * @throws RequestError when the profile, the command or the form cannot do what is asked.
 */
export function chooseForm(
  profile: Profile,
  command: Command,
  found: readonly FoundDevice[],
  code: DataCode,
  extraBits: number,
  wanted?: DeviceForm,
): DeviceForm {
  checkCommand(profile, command)
  for (const device of found) checkDevice(profile, command, device)
  if (wanted !== undefined && !profile.forms.includes(wanted)) {
    const forms = profile.forms.join(', ')
    throw new RequestError('UNSUPPORTED', `${profile.title} does not have the ${wanted} form, only ${forms}.`, 'form')
  }
  const form = wanted ?? (found.length === 0 ? profile.form : formFor(profile, found))
  for (const { address, path } of found) {
    const problem = formProblem(address, code === 'ascii', FORM_BITS[form] | extraBits)
    if (problem !== undefined) throw new RequestError(problem.code, problem.message, path)
  }
  return form
}

function formFor(profile: Profile, found: readonly FoundDevice[]): DeviceForm {
  let need = 0
  for (const { address } of found) need |= needOf(profile, address)
  const ordered: readonly DeviceForm[] = [profile.form, ...profile.forms]
  const form =
    ordered.find(
      (candidate) =>
        (FORM_BITS[candidate] & need) === need && (need & FORM_EXTENDED) === (FORM_BITS[candidate] & FORM_EXTENDED),
    ) ?? ordered.find((candidate) => (FORM_BITS[candidate] & need) === need)
  if (form !== undefined) return form
  const asked = found.map(({ address }) => `${address.device}${address.number}`).join(', ')
  throw new RequestError('UNSUPPORTED', `${profile.title} has no form that can address ${asked}.`)
}

function needOf(profile: Profile, address: FoundDevice['address']): number {
  const longOnly = deviceInfo(address.device).longOnly === true && !profile.shortDevices.includes(address.device)
  return formNeededBy(address) | (longOnly ? FORM_LONG : 0)
}

function checkCommand(profile: Profile, command: Command): void {
  const lack = lackOf(profile, command.name as CommandName)
  if (lack === undefined) return
  throw new RequestError(
    'UNSUPPORTED',
    `${profile.title} does not have ${command.title}: ${lack.reason} ${lack.instead}`,
    command.name,
  )
}

const EXTENSION_TITLES = {
  link: 'link direct devices (J1\\W10)',
  module: 'the buffer memory of modules (U3\\G100)',
  cpu: 'the buffer memory of CPUs (U3E0\\G100)',
} as const

function checkDevice(profile: Profile, command: Command, { address, use, path }: FoundDevice): void {
  const problem = accessProblem(address, use)
  if (problem !== undefined) throw new RequestError(problem.code, problem.message, path)
  if (profile.absentDevices.includes(address.device)) {
    throw new RequestError('UNSUPPORTED', `${profile.title} has no device ${address.device}.`, path)
  }
  if (address.extension !== undefined && !profile.extensions.includes(address.extension.kind)) {
    throw new RequestError(
      'UNSUPPORTED',
      `${profile.title} does not take ${EXTENSION_TITLES[address.extension.kind]}.`,
      path,
    )
  }
  for (const index of [address.index, address.extensionIndex]) {
    if (index === undefined || index.number <= profile.lastIndex[index.register]) continue
    throw new RequestError(
      'OUT_OF_RANGE',
      `${index.register}${index.number} cannot modify an address on ${profile.title}: ` +
        `${index.register}0 to ${index.register}${profile.lastIndex[index.register]} can.`,
      path,
    )
  }
  const exclusion = exclusionOf(profile, command.name as CommandName, address.device)
  if (exclusion !== undefined) {
    throw new RequestError(
      'UNSUPPORTED',
      `${command.title} does not take ${address.device} on ${profile.title}: ${exclusion.reason} ${exclusion.instead}`,
      path,
    )
  }
}
