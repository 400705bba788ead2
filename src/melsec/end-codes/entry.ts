// The form end code texts are kept in: plain data, each text in all four languages side by side.
import type { CommandName } from '../commands/commands'
import type { RemedyName } from './remedies'
import type { Texts } from './texts'

/** An end code and its texts. */
export interface EndCodeEntry {
  /** The number, or the first of a range. */
  readonly code: number
  /** Last code of a range, where the manual has one text for all of it. */
  readonly to?: number
  /** What it means: whole sentences in each language. */
  readonly meaning: Texts
  /** What to do: an own text, or one that many codes share. */
  readonly remedy: Texts | RemedyName
  /** Where it is written. */
  readonly source: string
}

/** An entry on one line, for codes with a shared remedy and source. */
export type EndCodeRow = readonly [code: number, remedy: RemedyName, ...meaning: Texts]

export function entriesOf(rows: readonly EndCodeRow[], source: string): readonly EndCodeEntry[] {
  return rows.map(([code, remedy, ...meaning]) => ({ code, meaning, remedy, source }))
}

/** Texts of one pattern, for codes that differ in a noun: `{}` stands for it. */
export function filled(pattern: Texts, [enUS, ja, zhCN, zhTW]: Texts): Texts {
  const [p0, p1, p2, p3] = pattern
  return [p0.replace('{}', enUS), p1.replace('{}', ja), p2.replace('{}', zhCN), p3.replace('{}', zhTW)]
}

/** What stands behind codes nobody has a text for. */
export interface EndCodeGroup {
  readonly from: number
  readonly to: number
  readonly meaning: Texts
  readonly remedy: Texts | RemedyName
  readonly source: string
}

/** What a code most likely means when one of these commands got it. */
export interface EndCodeHint {
  readonly code: number
  readonly commands: readonly CommandName[]
  readonly cause: Texts
  readonly source: string
}

export const FX5_SLMP = 'FX5 communication manual 47.4'
export const FX5_ETHERNET = 'FX5 communication manual 47.1'
export const FX5_SERIAL = 'FX5 communication manual 47.2'
export const FX5_MODBUS = 'FX5 communication manual 47.3'
export const FX5_EVENTS = 'FX5 communication manual 47.1 and 48'
export const BACKGROUND = 'background: error code lists of Q, L and iQ-R CPU and Ethernet modules'
