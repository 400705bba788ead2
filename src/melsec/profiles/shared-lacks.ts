// Commands that several families lack, or of which nobody knows whether they have them.
import type { CommandName } from '../commands/commands'
import type { Lack } from './profile'

const memory = ['readMemory', 'writeMemory'] as const satisfies readonly CommandName[]
const extendUnit = ['readExtendUnit', 'writeExtendUnit'] as const satisfies readonly CommandName[]

function lack(command: CommandName, reason: string, instead: string, source: string): Lack {
  return { command, endCode: 0xc059, reason, instead, source }
}

/** Of a family without these commands. */
export function noMemoryCommands(source: string): readonly Lack[] {
  const instead = 'Use module access devices, e.g. U1\\G100.'
  return [...memory, ...extendUnit].map((command) =>
    lack(command, 'It has no access to buffer memory by Memory and Extend Unit.', instead, source),
  )
}

/** Which CPUs and modules have them: the manual's table of commands and targets is damaged in the edition at hand. */
export const doubtfulMemoryCommands: readonly Lack[] = [
  ...memory.map((command) =>
    lack(
      command,
      'Only modules with buffer memory of their own have it, not the built-in port of a CPU.',
      'Use module access devices, e.g. U3\\G100.',
      'SLMP reference manual 5.4; table of commands and targets (2.1) damaged',
    ),
  ),
  ...extendUnit.map((command) =>
    lack(
      command,
      'It is for MELSEC-Q modules, and not on every port.',
      'Use module access devices, e.g. U3\\G100.',
      'SLMP reference manual 5.5; table of commands and targets (2.1) damaged',
    ),
  ),
]

/** Beside the NZ2GF-ETB. */
export const doubtfulClearError: Lack = {
  command: 'clearError',
  endCode: 0xc059,
  reason: 'The SLMP manual lists Clear Error for the NZ2GF-ETB only; Ethernet modules know it from the MC protocol.',
  instead: 'Clear the error in GX Works or by the CPU program (SM50).',
  source: 'table of commands and devices of the SLMP reference manual, marked as damaged in the edition at hand',
}
