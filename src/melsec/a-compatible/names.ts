// Commands of the SLMP set and the commands of 1E that say the same.
import type { CommandName } from '../commands/commands'
import type { ACompatibleCommandName } from './commands'

export const over1e = {
  readBits: 'readBits',
  readWords: 'readWords',
  writeBits: 'writeBits',
  writeWords: 'writeWords',
  writeRandomBits: 'writeRandomBits',
  writeRandomWords: 'writeRandomWords',
  remoteRun: 'remoteRun',
  remoteStop: 'remoteStop',
  readTypeName: 'readPcType',
  selfTest: 'loopback',
} as const satisfies Readonly<Partial<Record<CommandName, ACompatibleCommandName>>>

/** A command of the SLMP set that 1E has too. */
export type Over1eName = keyof typeof over1e

export function isOver1e(name: string): name is Over1eName {
  return Object.hasOwn(over1e, name)
}

const slmpNames = new Map(
  Object.keys(over1e)
    .filter(isOver1e)
    .map((name) => [over1e[name], name]),
)

/** The command of the SLMP set that says what one of 1E says. The parameter is the table's: it has to hold all of 1E. */
export function slmpNameOf(name: (typeof over1e)[Over1eName]): Over1eName {
  const found = slmpNames.get(name)
  if (found === undefined) throw new TypeError(`over1e has no ${name}`)
  return found
}
