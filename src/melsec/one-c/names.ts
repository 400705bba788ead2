import type { SaidName } from '../a-compatible/names'
import type { OneCCommandName } from './commands'

/** Commands of the SLMP set and those of 1C that say the same: with few digits for the number of a device, and with more. */
export const over1c = {
  readBits: ['BR'],
  readWords: ['WR', 'QR'],
  writeBits: ['BW'],
  writeWords: ['WW', 'QW'],
  writeRandomBits: ['BT'],
  writeRandomWords: ['WT', 'QT'],
  remoteRun: ['RR'],
  remoteStop: ['RS'],
  readTypeName: ['PC'],
  selfTest: ['TT'],
} as const satisfies Readonly<Record<SaidName, readonly OneCCommandName[]>>
