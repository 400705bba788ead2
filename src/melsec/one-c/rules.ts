// What one 1C request carries, as data (FX5 communication manual 44.3 and 44.4).
import type { DeviceRules, PointLimit } from '../a-compatible/device-rules'
import type { OneCCommandName } from './commands'

export const oneCLimitSource = 'FX5 communication manual 44.3 and 44.4'

/** Of bit and of word devices in a command. */
function wordLimits(command: OneCCommandName, bit: number, word: number): PointLimit<OneCCommandName>[] {
  return [
    { command, of: 'bit', max: bit },
    { command, of: 'word', max: word },
  ]
}

export const oneCLimits: readonly PointLimit<OneCCommandName>[] = [
  { command: 'BR', of: 'bit', max: 256 },
  ...wordLimits('WR', 32, 64),
  ...wordLimits('QR', 32, 64),
  { command: 'BW', of: 'bit', max: 160 },
  ...wordLimits('WW', 10, 64),
  ...wordLimits('QW', 10, 64),
  { command: 'BT', of: 'bit', max: 20 },
  ...wordLimits('WT', 10, 10),
  ...wordLimits('QT', 10, 10),
]

/** R goes to R9999 in commands that do not begin with Q (44.4, table of devices). */
const fourDigits = { R: 9999 } as const

export const oneCRules: DeviceRules<OneCCommandName> = {
  frame: '1C',
  instead: '3C or 4C',
  limits: oneCLimits,
  source: oneCLimitSource,
  bitUnits: ['BR', 'BW', 'BT'],
  // 44.4: eight, not sixteen as in 1E
  headMultiple: 8,
  // 44.4 (so background, FX series user’s manual, data communication edition, computer link 7.2): one point of CN200 to
  // CN255 is two words; nobody prints which of them stands first.
  pairs: [],
  noPairs:
    'is a counter of 32 bits: the manual does not print in which order its two words stand in a 1C frame. Use a 3C or 4C frame if the PLC takes it.',
  lastNumbers: { WR: fourDigits, WW: fourDigits, WT: fourDigits },
}
