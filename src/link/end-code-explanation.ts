import type { EndCodeAbout, EndCodeFamily } from '../errors'

/** What an end code means, in one language. */
export interface EndCodeExplanation {
  /** Whose number it is. */
  readonly family: EndCodeFamily
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
  /** What it is about when an answer carries it, as `EndCodeError.about`. */
  readonly about: EndCodeAbout
  /** `false`: only the module that reported it is known, from the range the code is in. */
  readonly exact: boolean
}
