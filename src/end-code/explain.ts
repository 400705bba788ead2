// What an end code means and what to do, whichever family it is of.
import type { Language } from '../basics/texts'
import { EndCodeError, type EndCodeFamily, endCodeFamilies, RequestError } from '../errors'
import { explainResultCode } from '../jw/result-codes/explain'
import type { EndCodeExplanation } from '../link/link'
import type { CommandName } from '../melsec/commands/commands'
import { type Answered, explained } from '../melsec/end-codes/end-code'

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

/**
 * What an end code means, of an error or of a number whose family is given. `undefined` for a code nobody has a text for:
 * pass the number on.
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
  if (given instanceof EndCodeError) return textsOf(given.family, given, language)
  if (family === undefined || !endCodeFamilies.includes(family)) {
    const families = endCodeFamilies.join(', ')
    throw new RequestError('BAD_OPTION', `family must say whose number it is: ${families}.`, 'family')
  }
  return textsOf(family, { endCode: given, commandName: command }, language)
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
  const all = endCodeFamilies.map((family) => textsOf(family, { endCode: code, commandName: command }, language))
  return all.filter((one) => one !== undefined)
}

function textsOf(
  family: EndCodeFamily,
  answered: Answered,
  language: Language = 'en-US',
): EndCodeExplanation | undefined {
  return family === 'jw' ? explainResultCode(answered.endCode, { language }) : explained(family, answered, language)
}
