// The form end code texts are kept in: plain data, each text in all four languages side by side.
import type { CommandName } from '../commands/commands'
import type { RemedyName } from './remedies'

export type Language = 'en-US' | 'ja' | 'zh-CN' | 'zh-TW'

/** The languages, in the order of {@link Texts}. */
export const languages: readonly Language[] = ['en-US', 'ja', 'zh-CN', 'zh-TW']

/** One text in every language: whole sentences, so that they can stand side by side. */
export type Texts = readonly [enUS: string, ja: string, zhCN: string, zhTW: string]

export interface EndCodeEntry {
  readonly code: number
  readonly meaning: Texts
  /** What to do: an own text, or one that many codes share. */
  readonly remedy: Texts | RemedyName
  /** It is about a device or address of one item: the other items of a merged request may well be readable. */
  readonly aboutDevice?: true
  readonly source: string
}

/** An entry on one line, for codes with a shared remedy and source. */
export type EndCodeRow = readonly [code: number, remedy: RemedyName, ...meaning: Texts]

export function entriesOf(rows: readonly EndCodeRow[], source: string): readonly EndCodeEntry[] {
  return rows.map(([code, remedy, ...meaning]) => ({ code, meaning, remedy, source }))
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
export const BACKGROUND = 'background: error code lists of Q, L and iQ-R CPU and Ethernet modules'
