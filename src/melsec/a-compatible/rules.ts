// What the PLCs that take 1E frames have in common and where they differ, as data (FX5 communication manual 39.1 and 39.2).
import type { ACompatibleCommandName } from './commands'
import type { DeviceRules, PointLimit } from './device-rules'
import { type DeviceWindow, fx3Windows, fx5Windows } from './windows'

/** What differs between the PLCs that take 1E. */
export interface ACompatibleFamily {
  readonly title: string
  readonly windows: readonly DeviceWindow[]
  /**
   * Bits of an odd number of points in ASCII code: as many characters, or one more, a `0`.
   * Absent: the manual is silent. Then it has to be set, or odd numbers are refused.
   */
  readonly oddBits?: OddBits
  /** Whether the answers that may end with a byte 00H (frame-1e.ts) do. A client takes both, a simulator sends it. */
  readonly zeroBehind: boolean
  /** Users of the family call M8000, D8000 and C200 what the device table has under other names. */
  readonly calledAsInFrame: boolean
  /** What Read PC Type Name answers. */
  readonly typeCode: number
  readonly source: string
}

/** Whether a dummy character follows an odd number of bits in 1E frames in ASCII code. */
export type OddBits = 'exact' | 'padded'

/** FX5 CPU modules and Ethernet modules. */
export const fx5Over1e: ACompatibleFamily = {
  title: 'MELSEC iQ-F',
  windows: fx5Windows,
  zeroBehind: false,
  calledAsInFrame: false,
  typeCode: 0xf3,
  source: 'FX5 communication manual 37.2 and 39; the length of the abnormal code is not printed',
}

/** FX3U-ENET-ADP and FX3U-ENET. */
export const fx3Over1e: ACompatibleFamily = {
  title: 'MELSEC FX3',
  windows: fx3Windows,
  oddBits: 'padded',
  zeroBehind: true,
  calledAsInFrame: true,
  typeCode: 0xf3,
  source:
    'background: FX3U-ENET-ADP user’s manual 7.3 (5BH is followed by 10H to 18H and 00H), 7.5 (dummy 30H) and 7.6.3 ' +
    '(type code and 00H; so FX3U-ENET user’s manual 9.4.3); FX5 communication manual 39.4: F3H of FX5 and FX3U alike',
}

export const aCompatibleLimitSource = 'FX5 communication manual 39.1 and 39.2'

export const aCompatibleLimits: readonly PointLimit<ACompatibleCommandName>[] = [
  { command: 'readBits', of: 'bit', max: 256 },
  { command: 'readWords', of: 'bit', max: 32 },
  { command: 'readWords', of: 'word', max: 64 },
  { command: 'writeBits', of: 'bit', max: 160 },
  { command: 'writeWords', of: 'bit', max: 10 },
  { command: 'writeWords', of: 'word', max: 64 },
  { command: 'writeRandomBits', of: 'bit', max: 80 },
  { command: 'writeRandomWords', of: 'bit', max: 10 },
  { command: 'writeRandomWords', of: 'word', max: 10 },
]

export const aCompatibleRules: DeviceRules<ACompatibleCommandName> = {
  frame: '1E',
  instead: '3E or 4E',
  limits: aCompatibleLimits,
  source: aCompatibleLimitSource,
  bitUnits: ['readBits', 'writeBits', 'writeRandomBits'],
  // 39.1, footnote *1
  headMultiple: 16,
  pairs: ['readWords', 'writeWords'],
  noPairs: 'cannot be written at random: write it with Batch write (writeWords).',
}
