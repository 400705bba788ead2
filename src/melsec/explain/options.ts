// What whoever shows a frame says about it.
import type { DataCode } from '../../codec/codec'
import type { Direction } from '../../codec/explanation'
import type { Command } from '../commands/command'
import type { FrameName } from '../frame/frames'
import type { SerialFormat, SerialFrameName } from '../frame/serial-frames'
import type { ProfileId, ProfileInfo } from '../profiles/profile'
import type { ExplainSettings } from './body'

/** What is known of the frame; what is left out is found out as far as the bytes tell it. */
export interface ExplainFrameOptions {
  /** 1E must be said; the others are told by their subheaders and control codes. */
  readonly frame?: FrameName | SerialFrameName
  /** Of 1C, 3C and 4C; told by the bytes. With 1 and 4 it matters that CR LF is behind a frame, or not. */
  readonly format?: SerialFormat
  /** Of 1C, 3C and 4C; told by the bytes as far as they tell it: a request whose sum is wrong does not. */
  readonly sumCheck?: boolean
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
