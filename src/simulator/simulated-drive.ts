// What a program says the drives of a simulated PLC hold.
import type { FileTime } from '../melsec/file/time'

/** A file of a simulated drive. */
export interface SimulatedFile {
  /** Text is written in UTF-8. */
  readonly data: string | Uint8Array
  /** Whether it may not be changed. Default false. */
  readonly readOnly?: boolean
  /** Default: none. */
  readonly password?: string
  /** Default: when the simulator was made. */
  readonly modified?: FileTime
}

/** A memory with files. Either in this program's memory, with `files`, or a `folder` of this computer. */
export interface SimulatedDrive {
  /** By path, e.g. `LINE.CSV` or `LOG\\LINE.CSV`; only the content, or more. Default: a few, to look at. */
  readonly files?: Readonly<Record<string, string | Uint8Array | SimulatedFile>>
  /** Clients can read and change what is in it, and nothing else: no name and no link leads out of it. */
  readonly folder?: string
  /** Bytes that fit. Default 4 MiB. */
  readonly capacity?: number
  /** System protection of the CPU, or the LOCK switch of a card. Default false. */
  readonly writeProtected?: boolean
}

/** By drive number; `false`: there is none, e.g. no card. Drives that are not named have a few files to look at. */
export type SimulatedDrives = Readonly<Record<number, SimulatedDrive | false>>
