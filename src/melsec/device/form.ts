import { hex } from '../../basics/hex'
import type { DataCode } from '../../codec/codec'
import { RequestError } from '../../errors'
import type { Command } from '../commands/command'
import { FILE_BITS } from '../file/codec'
import { exclusionOf, lackOf, type Profile, type Subcommand } from '../profiles/profile'
import { type AccessProblem, accessProblem } from './access'
import { FORM_EXTENDED, FORM_LONG, formNeededBy, formProblem } from './codec'
import { deviceInfo } from './device'
import type { DeviceForm } from './device-form'
import { type FoundDevice, pathOf } from './uses'

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
  const overrides: Readonly<Record<string, Subcommand | undefined>> = profile.subcommands
  const override = overrides[command.name]
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
export function findCommand<C extends Command>(
  list: Readonly<Record<string, C>>,
  profile: Profile,
  code: number,
  subcommand: number,
): { readonly command: C; readonly form: DeviceForm } | undefined {
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

/** Why there is no form to send a request in. */
export interface FormProblem extends AccessProblem {
  readonly field?: string
}

/**
 * The form this request is sent in: the profile's own, or the first of its forms that can say every address.
 * @throws RequestError when the profile, the command or the form cannot do what is asked.
 */
export function chooseForm(...asked: Parameters<typeof formOrProblem>): DeviceForm {
  const found = formOrProblem(...asked)
  if (typeof found === 'string') return found
  throw new RequestError(found.code, found.message, found.field)
}

/** As `chooseForm`, with the problem as data, for those who look for what can be sent. */
export function formOrProblem(
  profile: Profile,
  command: Command,
  found: readonly FoundDevice[],
  code: DataCode,
  extraBits: number,
  wanted?: DeviceForm,
): DeviceForm | FormProblem {
  const lack = commandProblem(profile, command)
  if (lack !== undefined) return lack
  for (const device of found) {
    const problem = deviceProblem(profile, command, device)
    if (problem !== undefined) return { ...problem, field: pathOf(device) }
  }
  if (wanted !== undefined && !profile.forms.includes(wanted)) {
    const forms = profile.forms.join(', ')
    return unsupported(`${profile.title} does not have the ${wanted} form, only ${forms}.`, 'form')
  }
  const form = wanted ?? (found.length === 0 ? profile.form : formFor(profile, found))
  if (form === undefined) {
    const asked = found.map(({ address }) => `${address.device}${address.number}`).join(', ')
    return unsupported(`${profile.title} has no form that can address ${asked}.`)
  }
  for (const device of found) {
    const problem = formProblem(device.address, code === 'ascii', FORM_BITS[form] | extraBits)
    if (problem !== undefined) return { ...problem, field: pathOf(device) }
  }
  return form
}

function unsupported(message: string, field?: string): FormProblem {
  return { code: 'UNSUPPORTED', message, ...(field === undefined ? {} : { field }) }
}

function formFor(profile: Profile, found: readonly FoundDevice[]): DeviceForm | undefined {
  let need = 0
  for (const { address } of found) need |= needOf(profile, address)
  const ordered: readonly DeviceForm[] = [profile.form, ...profile.forms]
  return (
    ordered.find(
      (candidate) =>
        (FORM_BITS[candidate] & need) === need && (need & FORM_EXTENDED) === (FORM_BITS[candidate] & FORM_EXTENDED),
    ) ?? ordered.find((candidate) => (FORM_BITS[candidate] & need) === need)
  )
}

function needOf(profile: Profile, address: FoundDevice['address']): number {
  const longOnly = deviceInfo(address.device).longOnly === true && !profile.shortDevices.includes(address.device)
  return formNeededBy(address) | (longOnly ? FORM_LONG : 0)
}

function commandProblem(profile: Profile, command: Command): FormProblem | undefined {
  const lack = lackOf(profile, command.name)
  if (lack === undefined) return undefined
  return unsupported(`${profile.title} does not have ${command.title}: ${lack.reason} ${lack.instead}`, command.name)
}

const EXTENSION_TITLES = {
  link: 'link direct devices (J1\\W10)',
  module: 'the buffer memory of modules (U3\\G100)',
  cpu: 'the buffer memory of CPUs (U3E0\\G100)',
} as const

function deviceProblem(profile: Profile, command: Command, { address, use }: FoundDevice): AccessProblem | undefined {
  const problem = accessProblem(address, use)
  if (problem !== undefined) return problem
  if (profile.absentDevices.includes(address.device)) {
    return unsupported(`${profile.title} has no device ${address.device}.`)
  }
  if (address.extension !== undefined && !profile.extensions.includes(address.extension.kind)) {
    return unsupported(`${profile.title} does not take ${EXTENSION_TITLES[address.extension.kind]}.`)
  }
  const index = indexProblem(profile, address.index) ?? indexProblem(profile, address.extensionIndex)
  if (index !== undefined) return index
  const exclusion = exclusionOf(profile, command.name, address.device)
  if (exclusion === undefined) return undefined
  return unsupported(
    `${command.title} does not take ${address.device} on ${profile.title}: ${exclusion.reason} ${exclusion.instead}`,
  )
}

function indexProblem(profile: Profile, index: FoundDevice['address']['index']): AccessProblem | undefined {
  if (index === undefined || index.number <= profile.lastIndex[index.register]) return undefined
  return {
    code: 'OUT_OF_RANGE',
    message:
      `${index.register}${index.number} cannot modify an address on ${profile.title}: ` +
      `${index.register}0 to ${index.register}${profile.lastIndex[index.register]} can.`,
  }
}
