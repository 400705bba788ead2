// Texts for people: from locales/, in the language of the runtime. What several nodes say stands in the connection's catalogue.
import type { NodeAPI } from 'node-red'
import { type Language, languages } from '../src/index'

/** Catalogue of the texts that every node shares; Node-RED names it after package and node. */
const SHARED = '@melsec-jw/plc/melsec-jw-connection'

/** A text of the shared catalogue in the language of the runtime. */
export type Texts = (key: string, values?: Readonly<Record<string, string | number>>) => string

export function sharedTexts(RED: NodeAPI): Texts {
  return (key, values) => RED._(`${SHARED}:${key}`, { ...values })
}

/** Language of the runtime, as far as this package has texts in it. */
export function languageOf(texts: Texts): Language {
  const code = texts('language')
  return languages.find((language) => language === code) ?? 'en-US'
}
