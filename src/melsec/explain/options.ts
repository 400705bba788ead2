// What whoever shows a frame says about it.
import type { DataCode } from '../../codec/codec'
import type { Direction } from '../../codec/explanation'
import type { Command } from '../commands/command'
import type { FrameName } from '../frame/frames'
import type { ProfileId, ProfileInfo } from '../profiles/profile'
import type { ExplainSettings } from './body'

/** What is known of the frame; what is left out is found out as far as the bytes tell it. */
export interface ExplainFrameOptions {
  /** `4C`: format 5. 1E and 4C must be said; 3E, 4E and the station extension frame are told by their subheaders. */
  readonly frame?: FrameName | '4C'
  /** Data code; told by the bytes where they tell it. */
  readonly code?: DataCode
  /** Request or response; told by the subheader where there is one. */
  readonly direction?: Direction
  /** Family of the PLC; default `generic`. */
  readonly profile?: ProfileId | ProfileInfo
  /** How X and Y are written; default: the profile's. */
  readonly xyRadix?: 8 | 16
  /** How W is written; default: the profile's. */
  readonly wRadix?: 10 | 16
  /** Digits of X and Y in ASCII code, where the port has the setting; default: as the profile numbers them. */
  readonly asciiXy?: 'octal' | 'hexadecimal'
  /** Digits of ZR in ASCII code; default decimal. */
  readonly asciiZr?: 'decimal' | 'hexadecimal'
  /** The frame of the request that this response answers: names its values. */
  readonly request?: Buffer
  /** The frame of the Entry Monitor Device before it, when the response is one to Execute Monitor. */
  readonly registration?: Buffer
  /** Declarations to know instead of all of this package's. */
  readonly commands?: Readonly<Record<string, Command>>
}

/** Everything but the data code. */
export type Known = Omit<ExplainSettings, 'code'>
