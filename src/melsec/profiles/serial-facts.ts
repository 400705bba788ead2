// What a profile knows of a serial line beside what every port has.
import type { SerialChannels } from '../serial-channels'

/** A port that is a serial line. */
export interface SerialFacts {
  /** What requests can reach behind the line: `fx5` the CPU of the station only, `c24` what a C24 module relays to. */
  readonly reach: 'fx5' | 'c24'
  /** Stations a line can have: 0 to this one. */
  readonly lastStation: number
  /** Which channels a CPU has and what they tell. Absent where it is in no manual at hand. */
  readonly channels?: SerialChannels
  /** Where it is written. */
  readonly source: string
}
