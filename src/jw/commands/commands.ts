import { declare } from '../../codec/codec'
import { bufferCommands } from './buffer'
import { clockCommands } from './clock'
import { controlCommands } from './control'
import { dataMemoryCommands } from './data-memory'
import { parameterCommands } from './parameter'
import { secretCommands } from './secret'
import { systemCommands } from './system'

/**
 * Every command of the JW-255CM.
 * @experimental The shapes of the declarations may change in any version; the names of commands and what their messages hold do not.
 */
export const jwCommands = declare({
  ...parameterCommands,
  ...dataMemoryCommands,
  ...bufferCommands,
  ...systemCommands,
  ...clockCommands,
  ...controlCommands,
  ...secretCommands,
})

/**
 * Every command of the JW-255CM, by its name.
 * @experimental The shapes of the declarations may change in any version; the names of commands and what their messages hold do not.
 */
export type JwCommands = typeof jwCommands
/** Name of a command of a Sharp JW, e.g. `readDataMemory`. */
export type JwCommandName = keyof JwCommands
/** Any declared command of a Sharp JW. */
export type JwCommand = JwCommands[keyof JwCommands]
