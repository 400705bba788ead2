// Targets and drives of file commands against the profile, before anything is sent.
import { hex } from '../codec/annotate'
import { RequestError } from '../errors'
import type { Command } from './command'
import { driveNumber } from './file-codec'
import type { Profile } from './profile'

/**
 * Refuses a file command that this family cannot carry out: its module, or its drive.
 * @param moduleIo of the route, where the frame has one
 * @throws RequestError UNSUPPORTED naming the field and what there is.
 */
export function checkFileCommand(
  profile: Profile,
  command: Command,
  message: Readonly<Record<string, unknown>>,
  moduleIo: number | undefined,
): void {
  if (command.subcommands === undefined) return
  checkModuleIo(profile, command, moduleIo)
  checkDrives(profile, command, message)
}

/** SLMP reference manual 4.1, Request destination module I/O No. */
function checkModuleIo(profile: Profile, { title }: Command, moduleIo: number | undefined): void {
  const taken = profile.files.moduleIo
  if (moduleIo === undefined || taken.length === 0 || taken.includes(moduleIo)) return
  throw new RequestError(
    'UNSUPPORTED',
    `${title} cannot go to module I/O ${hex(moduleIo, 4)} on ${profile.title}: file commands take ${taken.map((number) => hex(number, 4)).join(', ')}.`,
    'moduleIo',
  )
}

/**
 * Refuses a drive that this family does not have (SLMP reference manual 5.8, Drive number).
 * @throws RequestError UNSUPPORTED naming the field and the drives there are.
 */
function checkDrives(profile: Profile, command: Command, message: Readonly<Record<string, unknown>>): void {
  if (profile.files.drives.length === 0) return
  for (const [name, field] of Object.entries(command.request)) {
    if (field.kind !== 'value' || field.codec !== driveNumber) continue
    const drive = message[name]
    // What is no number at all is the encoder's to refuse.
    if (!Number.isInteger(drive) || profile.files.drives.some(({ number }) => number === drive)) continue
    const drives = profile.files.drives.map(({ number, title }) => `${number} (${title})`).join(', ')
    throw new RequestError(
      'UNSUPPORTED',
      `${profile.title} has no drive ${String(drive)}; its drives: ${drives}.`,
      name,
    )
  }
}
