// Texts for people: from locales/, in the language of the runtime. What several nodes say stands in the connection's catalogue.
import type { NodeAPI } from 'node-red'
import { type Language, languages } from '../src/index'

/** The node whose catalogue has the texts that every node shares. */
const SHARED = 'melsec-jw-connection'

/** A text of a catalogue in the language of the runtime. */
export type Texts = (key: string, values?: Readonly<Record<string, string | number>>) => string

export function sharedTexts(RED: NodeAPI): Texts {
  return textsOf(RED, SHARED)
}

/** The texts of one node; Node-RED names catalogues after package and node. */
export function textsOf(RED: NodeAPI, node: string): Texts {
  return (key, values) => RED._(`@melsec-jw/plc/${node}:${key}`, { ...values })
}

/** Language of the runtime, as far as this package has texts in it. */
export function languageOf(texts: Texts): Language {
  const code = texts('language')
  return languages.find((language) => language === code) ?? 'en-US'
}
