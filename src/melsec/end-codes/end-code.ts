// What an end code means and what to do, in four languages.
import type { EndCodeFamily } from '../../errors'
import type { EndCodeExplanation } from '../../link/link'
import type { EndCodeEntry } from './entry'
import { factsOf } from './facts'
import { isMelsecFamily, type MelsecEndCodeFamily } from './family'
import type { RemedyName } from './remedies'
import { type Language, languages, type Texts } from './texts'

export type { EndCodeExplanation } from '../../link/link'
export type { EndCodeEntry } from './entry'
export { type MelsecEndCodeFamily, melsecEndCodeFamilies } from './family'
export type { Language } from './texts'
export { languages } from './texts'

type Tables = typeof import('./tables')

let loaded: Tables | undefined

/** The texts are large and rarely needed: they are loaded with the first code somebody asks for. */
function tables(): Tables {
  loaded ??= require('./tables') as Tables
  return loaded
}

/** Every end code of a family with a text of its own, in no particular order; `to` is the last code of a range. */
export function endCodes(family: MelsecEndCodeFamily): readonly EndCodeEntry[] {
  return tables().endCodeEntries[family]
}

/** A code as an answer carries it. */
export interface Answered {
  readonly endCode: number
  readonly abnormalCode?: number | undefined
  readonly commandName?: string | undefined
}

function inLanguage(texts: Texts, language: Language): string {
  return texts[languages.indexOf(language)] ?? texts[0]
}

function remedyOf(remedy: Texts | RemedyName): Texts {
  return typeof remedy === 'string' ? tables().remedies[remedy] : remedy
}

function causeOf(code: number, command: string | undefined, language: Language): { cause?: string } {
  const hint = tables().endCodeHints.find(
    ({ code: about, commands }) => about === code && commands.some((name) => name === command),
  )
  return hint === undefined ? {} : { cause: inLanguage(hint.cause, language) }
}

/** With an abnormal code behind it, that is what tells why. */
export function explained(
  family: EndCodeFamily,
  { endCode, abnormalCode, commandName }: Answered,
  language: Language = 'en-US',
): EndCodeExplanation | undefined {
  if (!isMelsecFamily(family)) return undefined
  const refused = explainedCode(family, endCode, commandName, language)
  const reason = abnormalCode === undefined ? undefined : explainedCode(family, abnormalCode, commandName, language)
  if (refused === undefined || reason === undefined) return refused ?? reason
  const { about, remedy } = reason
  return { ...refused, meaning: `${refused.meaning} ${reason.meaning}`, about, remedy }
}

function explainedCode(
  family: MelsecEndCodeFamily,
  code: number,
  command: string | undefined,
  language: Language,
): EndCodeExplanation | undefined {
  const { entryByCode, endCodeGroups, placesOf } = tables()
  const entry = entryByCode[family].get(code)
  // The numbers of the modules have four digits.
  const groups = family === 'slmp' ? endCodeGroups : []
  const found = entry ?? groups.find(({ from, to }) => code >= from && code <= to)
  if (found === undefined) return undefined
  const places = entry === undefined ? [] : placesOf(family, code)
  return {
    family,
    meaning: inLanguage(found.meaning, language),
    ...causeOf(code, command, language),
    remedy: inLanguage(remedyOf(found.remedy), language),
    where: places.map(({ text }) => inLanguage(text, language)),
    // Of a range only that modules report codes of it is known.
    answer: places.length === 0 || places.some(({ answer }) => answer),
    about: factsOf[family].about(code),
    exact: entry !== undefined,
  }
}

/** Meaning and remedy as an error carries them, and as its message ends. */
export function refusalTexts(
  family: EndCodeFamily,
  answered: Answered,
): { readonly texts: { readonly meaning?: string; readonly remedy?: string }; readonly sentences: string } {
  const text = explained(family, answered)
  if (text === undefined) return { texts: {}, sentences: 'No text is known for this code.' }
  const meaning = text.cause === undefined ? text.meaning : `${text.meaning} ${text.cause}`
  return { texts: { meaning, remedy: text.remedy }, sentences: `${meaning} ${text.remedy}` }
}
