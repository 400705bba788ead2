import type { CommandName } from '../commands/commands'
import type { Lack } from './profile'

/** Every label command. */
export const labelCommandNames = [
  'readArrayLabels',
  'writeArrayLabels',
  'readRandomLabels',
  'writeRandomLabels',
] as const satisfies readonly CommandName[]

/** Of a family without access to labels. */
export function noLabels(source: string): readonly Lack[] {
  return labelCommandNames.map((command) => ({
    command,
    endCode: 0xc059,
    reason: 'Labels are reached by name on iQ-R only.',
    instead: 'Read and write the device that is assigned to the label.',
    source,
  }))
}
