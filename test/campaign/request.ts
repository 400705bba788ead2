/** What the bytes of a request ask for, whatever frame and code they came in. */

/** Points that lie together. A bit device in words: 16 points each. */
export interface Access {
  readonly device: 'D' | 'M'
  readonly head: number
  readonly unit: 'bit' | 'word' | 'doubleWord'
  readonly points: number
}

export interface Request {
  readonly frame: '3E' | '4E' | 'ext' | '1E'
  readonly code: 'binary' | 'ascii'
  /** 3E, 4E, ext: command and subcommand; 1E: the subheader, and 0. */
  readonly command: number
  readonly subcommand: number
  readonly serial: number
  /** Network, station, module I/O, multidrop and, of ext, extension station: as they came, to be repeated. */
  readonly route: Buffer
  readonly kind: 'typeName' | 'selfTest' | 'read' | 'write'
  readonly accesses: readonly Access[]
  /** Of a write: for each access its points: words, double words, or 0 and 1. */
  readonly values: readonly (readonly number[])[]
  /** Of a self test: what is to be repeated, count included. */
  readonly echo: Buffer
}

export type Asked = Pick<Request, 'kind' | 'accesses' | 'values' | 'echo'>

export const NOTHING = Buffer.alloc(0)

/** Probes and self tests: no values that a call asked for. */
export function isAboutTheLine({ kind, accesses: [first] }: Request): boolean {
  return kind === 'typeName' || kind === 'selfTest' || (kind === 'read' && first?.device === 'D' && first.head === 0)
}
