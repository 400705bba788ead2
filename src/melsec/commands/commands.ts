import { controlCommands } from './control'
import { deviceCommands } from './device'
import { fileCommands } from './file'
import { labelCommands } from './label'
import { memoryCommands } from './memory'
import { passwordCommands } from './password'

/**
 * Every declared command of the SLMP set, by name: documentation, palette options and the simulator read this list.
 * @experimental The shapes of the declarations may change in any version; the names of commands and what their messages hold do not.
 */
export const commands = {
  ...deviceCommands,
  ...controlCommands,
  ...labelCommands,
  ...passwordCommands,
  ...memoryCommands,
  ...fileCommands,
} as const

/**
 * The declared commands by their names.
 * @experimental The shapes of the declarations may change in any version; the names of commands and what their messages hold do not.
 */
export type Commands = typeof commands
/** Name of a command of the SLMP set, e.g. `readWords`. */
export type CommandName = keyof Commands
