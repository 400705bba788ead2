// Targets of commands, and drives of file commands, against the profile, before anything is sent.

import { hex } from '../basics/hex'
import type { Message } from '../codec/codec'
import { RequestError } from '../errors'
import type { Command } from './commands/command'
import { driveNumber } from './file/codec'
import type { Profile } from './profiles/profile'

/**
 * Refuses what this family cannot carry out: at this module, or on this drive.
 * @param moduleIo of the route, where the frame has one
 * @throws RequestError UNSUPPORTED naming the field and what there is.
 */
export function checkTarget(profile: Profile, command: Command, message: Message, moduleIo: number | undefined): void {
  if (command.controlCpuOnly === true) checkControlCpu(profile, command, moduleIo)
  if (command.subcommands === undefined) return
  checkModuleIo(profile, command, moduleIo)
  checkDrives(profile, command, message)
}

function checkControlCpu({ reach }: Profile, { title }: Command, moduleIo: number | undefined): void {
  if (moduleIo === undefined || !reach.nonControlCpus.includes(moduleIo)) return
  throw new RequestError(
    'UNSUPPORTED',
    `${title} cannot go to module I/O ${hex(moduleIo, 4)}: only the control CPU registers a monitor. Read instead; the control CPU itself has 03FF.`,
    'moduleIo',
  )
}

/** SLMP reference manual 4.1, Request destination module I/O No. */
function checkModuleIo({ files, title: family }: Profile, { title }: Command, moduleIo: number | undefined): void {
  const taken = files.moduleIo
  if (moduleIo === undefined || taken.length === 0) return
  if (taken.includes(moduleIo) || files.doubtfulModuleIo.includes(moduleIo)) return
  throw new RequestError(
    'UNSUPPORTED',
    `${title} cannot go to module I/O ${hex(moduleIo, 4)} on ${family}: file commands take ${taken.map((number) => hex(number, 4)).join(', ')}.`,
    'moduleIo',
  )
}

/**
 * Refuses a drive that this family does not have (SLMP reference manual 5.8, Drive number).
 * @throws RequestError UNSUPPORTED naming the field and the drives there are.
 */
function checkDrives(profile: Profile, command: Command, message: Message): void {
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
