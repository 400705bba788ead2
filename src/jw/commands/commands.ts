import { declare } from '../../codec/codec'
import { bufferCommands } from './buffer'
import { clockCommands } from './clock'
import { controlCommands } from './control'
import { dataMemoryCommands } from './data-memory'
import { parameterCommands } from './parameter'
import { secretCommands } from './secret'
import { systemCommands } from './system'

/** Every command of the JW-255CM. */
export const jwCommands = declare({
  ...parameterCommands,
  ...dataMemoryCommands,
  ...bufferCommands,
  ...systemCommands,
  ...clockCommands,
  ...controlCommands,
  ...secretCommands,
})

export type JwCommands = typeof jwCommands
