// What an end code means and what to do, in four languages.
import type { CommandName } from './commands/commands'
import { aCompatibleEndCodes } from './end-codes/a-compatible'
import { cpuEndCodes } from './end-codes/cpu'
import { cpuFileEndCodes } from './end-codes/cpu-file'
import { cpuRouteEndCodes } from './end-codes/cpu-route'
import { type EndCodeEntry, type Language, languages, type Texts } from './end-codes/entry'
import { ethernetEndCodes } from './end-codes/ethernet'
import { ethernetFunctionEndCodes } from './end-codes/ethernet-function'
import { endCodeGroups } from './end-codes/groups'
import { endCodeHints } from './end-codes/hints'
import { type RemedyName, remedies } from './end-codes/remedies'
import { routeAndPasswordEndCodes } from './end-codes/route-and-password'
import { serialEndCodes } from './end-codes/serial'
import { slmpEndCodes } from './end-codes/slmp'

export type { EndCodeEntry, Language } from './end-codes/entry'
export { languages } from './end-codes/entry'

/** Every end code with a text of its own, in no particular order. */
export const endCodes: readonly EndCodeEntry[] = [
  ...slmpEndCodes,
  ...routeAndPasswordEndCodes,
  ...cpuEndCodes,
  ...cpuRouteEndCodes,
  ...cpuFileEndCodes,
  ...aCompatibleEndCodes,
  ...serialEndCodes,
  ...ethernetEndCodes,
  ...ethernetFunctionEndCodes,
]

export interface EndCodeExplanation {
  /** One or more whole sentences. */
  readonly meaning: string
  /** What it most likely is for this command, when that is known. */
  readonly cause?: string
  /** What to do: one or more whole sentences. */
  readonly remedy: string
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

const byCode: ReadonlyMap<number, EndCodeEntry> = new Map(endCodes.map((entry) => [entry.code, entry]))

function inLanguage(texts: Texts, language: Language): string {
  return texts[languages.indexOf(language)] ?? texts[0]
}

function remedyOf(remedy: Texts | RemedyName): Texts {
  return typeof remedy === 'string' ? remedies[remedy] : remedy
}

function causeOf(code: number, command: CommandName | undefined, language: Language): { cause?: string } {
  const hint = endCodeHints.find(({ code: about, commands }) => about === code && command && commands.includes(command))
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
  const entry = byCode.get(code)
  const found = entry ?? endCodeGroups.find(({ from, to }) => code >= from && code <= to)
  if (found === undefined) return undefined
  return {
    meaning: inLanguage(found.meaning, language),
    ...causeOf(code, command, language),
    remedy: inLanguage(remedyOf(found.remedy), language),
    aboutDevice: entry?.aboutDevice ?? false,
    exact: entry !== undefined,
  }
}
