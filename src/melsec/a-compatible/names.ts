// Commands of the SLMP set that frames with a set of their own have too, and the commands of 1E that say the same.
import type { CommandName } from '../commands/commands'
import type { ACompatibleCommandName } from './commands'

/** In 1E as in 1C. */
const said = [
  'readBits',
  'readWords',
  'writeBits',
  'writeWords',
  'writeRandomBits',
  'writeRandomWords',
  'remoteRun',
  'remoteStop',
  'readTypeName',
  'selfTest',
] as const satisfies readonly CommandName[]

/** A command of the SLMP set that 1E and 1C have too. */
export type SaidName = (typeof said)[number]

export function isSaid(name: string): name is SaidName {
  return said.some((one) => one === name)
}

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
} as const satisfies Readonly<Record<SaidName, ACompatibleCommandName>>

const slmpNames = new Map(said.map((name) => [over1e[name], name]))

/** The command of the SLMP set that says what one of 1E says. The parameter is the table's: it has to hold all of 1E. */
export function slmpNameOf(name: (typeof over1e)[SaidName]): SaidName {
  const found = slmpNames.get(name)
  if (found === undefined) throw new TypeError(`over1e has no ${name}`)
  return found
}
