// What a result code means and what to do, in four languages.
import { type Language, languages, type Texts } from '../../basics/texts'
import type { EndCodeExplanation } from '../../link/link'
import { resultFacts } from './facts'

type Tables = typeof import('./texts')

let loaded: Tables | undefined

/** The texts are loaded with the first code somebody asks for. */
function tables(): Tables {
  loaded ??= require('./texts') as Tables
  return loaded
}

/**
 * What a result code of a Sharp JW means; `undefined` for a number that its manual does not have.
 * @example explainResultCode(0x10, { language: 'ja' })?.meaning
 */
export function explainResultCode(
  code: number,
  { language = 'en-US' }: { readonly language?: Language } = {},
): EndCodeExplanation | undefined {
  const { resultCodeTexts, remedies, place } = tables()
  const found = resultCodeTexts.find((entry) => entry.code === code)
  if (found === undefined) return undefined
  const inLanguage = (texts: Texts) => texts[languages.indexOf(language)] ?? texts[0]
  return {
    family: 'jw',
    meaning: inLanguage(found.meaning),
    remedy: inLanguage(remedies[found.remedy]),
    where: [inLanguage(place)],
    answer: true,
    about: resultFacts.about(code),
    exact: true,
  }
}
