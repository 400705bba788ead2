import type { Declaration } from '../../codec/codec'

/** Families of CPUs that understand different commands: JW300; JW20H, JW30H and the older ones. */
export const jwModels = ['jw300', 'jw30h'] as const
/** Family of CPUs. */
export type JwModel = (typeof jwModels)[number]

/**
 * What stands behind a command. `printed`: a manual shows such a message byte by byte; `derived`: its layout is printed;
 * `assumed`: the layout leaves something open, see `open`.
 */
export type JwCommandConfidence = 'printed' | 'derived' | 'assumed'

/** Bytes that must lie within an area: from the address or number `first` on, as many as `size` says or has. */
export interface Extent {
  readonly first: string
  readonly size: string
  /** Behind the last byte; default: the end of the file of the address. */
  readonly end?: number
}

/** A command of the JW-255CM. The code is the COM byte of the frame. */
export interface JwDeclaration extends Declaration {
  readonly confidence: JwCommandConfidence
  /** What no source says, and what is done here. */
  readonly open?: string
  /** Who has it; default: all. */
  readonly models?: readonly JwModel[]
  readonly extent?: Extent
}

/** Where a command is described. */
export function section(code: string): string {
  return `JW300 option unit manual, COM=${code}H`
}
