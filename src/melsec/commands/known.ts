import { commands } from './commands'
import { unsolicitedCommands } from './on-demand'

/** Every declaration of the SLMP set, whoever sends it: for those who explain frames. */
export const knownCommands = { ...commands, ...unsolicitedCommands } as const
