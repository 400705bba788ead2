// Drives of file commands against the profile, before anything is sent.
import { RequestError } from '../errors'
import type { Command } from './command'
import { driveNumber } from './file-codec'
import type { Profile } from './profile'

/**
 * Refuses a drive that this family does not have (SLMP reference manual 5.8, Drive number).
 * @throws RequestError UNSUPPORTED naming the field and the drives there are.
 */
export function checkDrives(profile: Profile, command: Command, message: Readonly<Record<string, unknown>>): void {
  if (command.subcommands === undefined || profile.files.drives.length === 0) return
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
