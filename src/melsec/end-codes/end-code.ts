// What an end code means and what to do, in four languages.
import type { CommandName } from '../commands/commands'
import type { EndCodeEntry } from './entry'
import type { RemedyName } from './remedies'
import { type Language, languages, type Texts } from './texts'

export type { EndCodeEntry } from './entry'
export type { Language } from './texts'
export { languages } from './texts'

type Tables = typeof import('./tables')

let loaded: Tables | undefined

/** The texts are large and rarely needed: they are loaded with the first code somebody asks for. */
function tables(): Tables {
  loaded ??= require('./tables') as Tables
  return loaded
}

/** Every end code with a text of its own, in no particular order; `to` is the last code of a range. */
export function endCodes(): readonly EndCodeEntry[] {
  return tables().endCodeEntries
}

export interface EndCodeExplanation {
  /** One or more whole sentences. */
  readonly meaning: string
  /** What it most likely is for this command, when that is known. */
  readonly cause?: string
  /** What to do: one or more whole sentences. */
  readonly remedy: string
  /** What kind of code it is and where it is found, a sentence each; empty when only its range is known. */
  readonly where: readonly string[]
  /** `false`: no answer to a request carries it; a register or history of the PLC holds it. */
  readonly answer: boolean
  /** It is about the device or address of one item; the other items of a merged request may be asked for again. */
  readonly aboutDevice: boolean
  /** `false`: only the module that reported it is known, from the range the code is in. */
  readonly exact: boolean
}

export interface ExplainOptions {
  /** Default `en-US`. */
  readonly language?: Language
  /** The command that got the code; it may tell the cause. */
  readonly command?: CommandName
}

function inLanguage(texts: Texts, language: Language): string {
  return texts[languages.indexOf(language)] ?? texts[0]
}

function remedyOf(remedy: Texts | RemedyName): Texts {
  return typeof remedy === 'string' ? tables().remedies[remedy] : remedy
}

function causeOf(code: number, command: CommandName | undefined, language: Language): { cause?: string } {
  const hint = tables().endCodeHints.find(
    ({ code: about, commands }) => about === code && command && commands.includes(command),
  )
  return hint === undefined ? {} : { cause: inLanguage(hint.cause, language) }
}

/**
 * What an end code means. `undefined` for a code nobody has a text for: pass the number on.
 *
 * @example explainEndCode(0xc056)?.remedy // 'Check device name and number against the device settings of the CPU in GX Works.'
 * @example explainEndCode(0xc059, { language: 'ja', command: 'executeMonitor' })?.cause
 */
export function explainEndCode(code: number, options: ExplainOptions = {}): EndCodeExplanation | undefined {
  const { language = 'en-US', command } = options
  const { entryByCode, endCodeGroups, placesOf } = tables()
  const entry = entryByCode.get(code)
  const found = entry ?? endCodeGroups.find(({ from, to }) => code >= from && code <= to)
  if (found === undefined) return undefined
  const places = entry === undefined ? [] : placesOf(code)
  return {
    meaning: inLanguage(found.meaning, language),
    ...causeOf(code, command, language),
    remedy: inLanguage(remedyOf(found.remedy), language),
    where: places.map(({ text }) => inLanguage(text, language)),
    // Of a range only that modules report codes of it is known.
    answer: places.length === 0 || places.some(({ answer }) => answer),
    aboutDevice: entry?.aboutDevice ?? false,
    exact: entry !== undefined,
  }
}
