// What an end code means and what to do, in four languages.
import { EndCodeError, type EndCodeFamily, endCodeFamilies, RequestError } from '../../errors'
import type { EndCodeExplanation } from '../../link/link'
import type { CommandName } from '../commands/commands'
import type { EndCodeEntry } from './entry'
import { factsOf } from './facts'
import { isMelsecFamily, type MelsecEndCodeFamily, melsecEndCodeFamilies } from './family'
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

/** How an end code is explained. */
export interface ExplainOptions {
  /** Default `en-US`. */
  readonly language?: Language
}

/** Of a number alone, what an error knows by itself. */
export interface ExplainCodeOptions extends ExplainOptions {
  /** Whose number it is; the same one means something else in another family. */
  readonly family: EndCodeFamily
  /** The command that got the code; it may tell the cause. */
  readonly command?: CommandName
}

/** A code as an answer carries it. */
interface Answered {
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

/**
 * What an end code means, of an error or of a number whose family is given. `undefined` for a code nobody has a text for,
 * as all of Sharp JW: pass the number on.
 *
 * @throws RequestError BAD_OPTION without a family that exists
 * @example explainEndCode(error, { language: 'ja' })?.remedy
 * @example explainEndCode(0xc056, { family: 'slmp' })?.remedy // 'Check device name and number against the device settings of the CPU in GX Works.'
 * @example explainEndCode(0xc059, { family: 'slmp', command: 'executeMonitor' })?.cause
 */
export function explainEndCode(error: EndCodeError, options?: ExplainOptions): EndCodeExplanation | undefined
export function explainEndCode(code: number, options: ExplainCodeOptions): EndCodeExplanation | undefined
export function explainEndCode(
  given: EndCodeError | number,
  options: ExplainOptions & Partial<ExplainCodeOptions> = {},
): EndCodeExplanation | undefined {
  const { language, family, command } = options
  if (given instanceof EndCodeError) return explained(given.family, given, language)
  if (family === undefined || !endCodeFamilies.includes(family)) {
    const families = endCodeFamilies.join(', ')
    throw new RequestError('BAD_OPTION', `family must say whose number it is: ${families}.`, 'family')
  }
  return explained(family, { endCode: given, commandName: command }, language)
}

/**
 * Everything a number may mean, one explanation for each family that has a text for it: for whoever does not know where it
 * is from.
 * @example meaningsOfEndCode(0x10).map(({ family, meaning }) => `${family}: ${meaning}`)
 */
export function meaningsOfEndCode(
  code: number,
  options: Omit<ExplainCodeOptions, 'family'> = {},
): readonly EndCodeExplanation[] {
  const { language, command } = options
  const all = melsecEndCodeFamilies.map((family) =>
    explained(family, { endCode: code, commandName: command }, language),
  )
  return all.filter((one) => one !== undefined)
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
