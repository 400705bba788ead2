import { controlCommands } from './control'
import { deviceCommands } from './device'
import { fileCommands } from './file'
import { labelCommands } from './label'
import { memoryCommands } from './memory'
import { passwordCommands } from './password'

/** Every declared command of the SLMP set, by name: documentation, palette options and the simulator read this list. */
export const commands = {
  ...deviceCommands,
  ...controlCommands,
  ...labelCommands,
  ...passwordCommands,
  ...memoryCommands,
  ...fileCommands,
} as const

export type Commands = typeof commands
export type CommandName = keyof Commands
