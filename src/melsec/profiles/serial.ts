/**
 * What PLCs are like on their serial lines. These profiles stand apart from those that users choose from (profiles.ts): the
 * client has no serial transport yet, so nothing may offer them.
 */
import type { SerialFrameName } from '../frame/serial-frames'
import { fx5Channels, type SerialChannels } from '../serial-channels'
import { fx3 } from './fx3'
import { fx5Over3c } from './fx5-over-3c'
import type { Profile } from './profile'

/** A family of PLCs by a serial line. */
export interface SerialProfile {
  readonly id: 'fx5-serial' | 'fx3-serial'
  readonly title: string
  readonly series: string
  /** The usual one first. */
  readonly frames: readonly SerialFrameName[]
  /** Digits of X and Y in ASCII code: by the message format, "(X,Y OCT)" or "(X,Y HEX)", or always octal. */
  readonly asciiXy: 'setting' | 'octal'
  /** What requests may say: in 3C and 4C as it is, in 1C less (over-1c.ts). Its own frames are not those of the line. */
  readonly set: Profile
  /** Where requests can go, as `serialRoute` takes it. */
  readonly reach: 'fx5' | 'c24'
  /** Which channels a CPU has and what they tell. Absent where it is in no manual at hand. */
  readonly channels?: SerialChannels
  readonly notes: readonly string[]
  readonly sources: Readonly<Record<'frames' | 'asciiXy' | 'reach', string>>
}

const manual = 'FX5 communication manual'

const fx5Serial: SerialProfile = {
  id: 'fx5-serial',
  title: 'MELSEC iQ-F serial',
  series: 'FX5S, FX5UJ, FX5U and FX5UC CPU modules by RS-485 or RS-232C',
  frames: ['4C', '3C', '1C'],
  asciiXy: 'setting',
  set: fx5Over3c,
  reach: 'fx5',
  channels: fx5Channels,
  notes: [
    'The serial port needs MC protocol as protocol format in GX Works3; speed, parity, sum check, station and message format are set there, too.',
    '1C frames: FX5U and FX5UC from firmware 1.110. Message formats with X and Y in hexadecimal digits: FX5U and FX5UC from 1.040.',
    'In 3C and 4C the wait before an answer is a parameter of the port; in 1C each request says it, and the parameter counts for nothing.',
    'One-pair wiring with an FX-485PC-IF needs a message wait of 70 to 150 ms; two pairs and RS-232C need none.',
  ],
  sources: {
    frames: `${manual} 18.4: 4C in formats 1, 4 and 5, 3C and 1C in formats 1 and 4`,
    asciiXy: `${manual} 43.2 and 44.4: message formats "Format 1 (X,Y OCT)" and the like`,
    reach: `${manual} 42.5: all but the station number is fixed`,
  },
}

const fx3Serial: SerialProfile = {
  id: 'fx3-serial',
  title: 'MELSEC FX3 serial',
  series: 'FX3S, FX3G, FX3GC, FX3U and FX3UC CPUs by computer link',
  frames: ['1C'],
  asciiXy: 'octal',
  set: fx3,
  reach: 'fx5',
  notes: [
    'Computer link is set up in GX Works2 (PLC system (2)) or in D8120: dedicated protocol, format 1 or 4.',
    'Special relays and registers M8000 to M8511 and D8000 to D8511 are also called SM8000 and SD8000 here, because the iQ-F calls them so.',
  ],
  sources: {
    frames: `${manual} 44: the 1C frame is compatible with computer link of FX3, and has the commands of this chapter only`,
    asciiXy:
      'background: FX series user’s manual, data communication edition, computer link 7.2: X040 to X077 are thirty-two inputs',
    reach:
      'background: FX series user’s manual, data communication edition, computer link: stations 0 to 15, PC number FF',
  },
}

export const serialProfiles: Readonly<Record<SerialProfile['id'], SerialProfile>> = {
  'fx5-serial': fx5Serial,
  'fx3-serial': fx3Serial,
}
