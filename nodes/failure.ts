// What a node hands to done(): an error that Node-RED carries to Catch nodes without losing what the plant must know.

import { endCodeDigits } from '../src/basics/end-code-digits'
import { commands, jwCommands } from '../src/entry/codec'
import type { EndCodeAbout, EndCodeFamily, Language } from '../src/index'
import {
  ClosedError,
  ConnectionError,
  EndCodeError,
  explainEndCode,
  headOfError,
  isPortLocked,
  type Outcome,
  PlcError,
  ProtocolError,
  RequestError,
  TimeoutError,
  UnfinishedError,
} from '../src/index'
import { causesIn, messageWith } from './causes'
import { type FailureCode, shortText } from './failure-code'
import { languageOf, type Texts } from './texts'

/** What is known about a failure, as plain data: it survives being copied from message to message. */
export interface FailureDetails {
  readonly code: FailureCode
  readonly message: string
  readonly outcome: Outcome
  /** The number the PLC sent, e.g. 0xC056. */
  readonly endCode?: number
  /** Whose number it is: another family means something else by it. */
  readonly family?: EndCodeFamily
  /** What the end code is about, e.g. `item` or `state`. */
  readonly about?: EndCodeAbout
  /** Of a 1E frame with end code 5BH: the code behind it. */
  readonly abnormalCode?: number
  /** What the end code means and what to do, in the language of the runtime. */
  readonly meaning?: string
  readonly remedy?: string
  /** Manual's name of the command. */
  readonly command?: string
  /** Its name for programs, e.g. `readWords`. */
  readonly commandName?: string
  /** Station that reported the error. */
  readonly station?: string
  /** Item, option, or field of the message it is about. */
  readonly field?: string
  /** Ranked causes, most likely first. */
  readonly causes?: readonly string[]
  /** What the system said, e.g. `connect ECONNREFUSED 192.168.3.39:5007`. */
  readonly reason?: string
}

/** Anything else a node knows about its failure, e.g. which items were written. */
export type FailureExtra = Readonly<Record<string, unknown>>

/**
 * The error of a node. Of an error, Node-RED copies `message`, `code`, `stack` and `cause` into `msg.error` and drops
 * the rest, so `cause` carries all that is known: `msg.error.cause.outcome`, `msg.error.cause.endCode`, ...
 */
export class NodeFailure extends Error {
  readonly code: FailureCode
  readonly outcome: Outcome
  readonly endCode: number | undefined
  readonly causes: readonly string[]
  override readonly cause: FailureDetails & FailureExtra

  constructor(details: FailureDetails, extra: FailureExtra = {}) {
    super(details.message)
    this.name = 'PlcError'
    this.code = details.code
    this.outcome = details.outcome
    this.endCode = details.endCode
    this.causes = details.causes ?? []
    this.cause = { ...details, ...extra }
  }
}

/** A failure that a node found itself, before anything was sent. */
export function refusal(code: FailureCode, message: string, extra: FailureExtra = {}): NodeFailure {
  return new NodeFailure({ code, message, outcome: 'notSent' }, extra)
}

/** Whatever was thrown, as the error of a node. */
export function failureOf(thrown: unknown, texts: Texts, extra: FailureExtra = {}): NodeFailure {
  if (thrown instanceof NodeFailure) return thrown
  const failure = new NodeFailure(detailsOf(thrown, texts), extra)
  if (thrown instanceof Error && thrown.stack !== undefined) failure.stack = thrown.stack
  return failure
}

/** What is known about an error, as plain data. */
export function detailsOf(thrown: unknown, texts: Texts): FailureDetails {
  if (thrown instanceof NodeFailure) return thrown.cause
  if (!(thrown instanceof PlcError)) {
    // The outcome is unknown, because nobody knows how far it came.
    return {
      code: 'UNEXPECTED',
      message: thrown instanceof Error ? thrown.message : String(thrown),
      outcome: 'unknown',
    }
  }
  const { code, message, outcome } = thrown
  return { code, message, outcome, ...specific(thrown, texts), ...reasonOf(thrown) }
}

function specific(error: PlcError, texts: Texts): Partial<FailureDetails> {
  if (error instanceof EndCodeError) {
    const { endCode, family, about, abnormalCode, command, commandName, station } = error
    const explained = explanationOf(error, languageOf(texts))
    return {
      endCode,
      family,
      about,
      ...(abnormalCode === undefined ? {} : { abnormalCode }),
      ...present({ ...explained, command, commandName, station }),
      ...toldWith(refusedText(error, explained, texts), isPortLocked(error) ? [texts('error.portLocked')] : []),
    }
  }
  if (error instanceof RequestError || error instanceof ProtocolError) return present({ field: error.field })
  if (error instanceof UnfinishedError && error.cause instanceof PlcError) {
    // Why it failed; the message says what is in the PLC now.
    return { ...specific(error.cause, texts), message: error.message }
  }
  if (error instanceof TimeoutError || error instanceof ConnectionError) {
    const { causes } = error
    const message = begun(error, messageWith(error.message, causes, texts), texts)
    return causes.length === 0 ? { message } : { message, causes: causesIn(causes, texts) }
  }
  if (error instanceof ClosedError) return { message: begun(error, error.message, texts) }
  return {}
}

/** The library speaks English; where the runtime does not, the message begins with what the status says. */
function begun({ code }: PlcError, message: string, texts: Texts): string {
  return languageOf(texts) === 'en-US' ? message : `${shortText(code, texts)}: ${message}`
}

/** A message with its causes at its end, because a sidebar and a log show nothing else. */
function toldWith(message: string, causes: readonly string[]): Pick<FailureDetails, 'message' | 'causes'> {
  return causes.length === 0 ? { message } : { message: [message, ...causes].join(' '), causes }
}

interface Explanation {
  readonly meaning?: string
  readonly remedy?: string
}

/** Meaning and remedy in a language. None where the family of the error has no texts. */
function explanationOf(error: EndCodeError, language: Language): Explanation {
  const explained = explainEndCode(error, { language })
  if (explained === undefined) return {}
  const { meaning, cause, remedy } = explained
  return { meaning: cause === undefined ? meaning : `${meaning} ${cause}`, remedy }
}

/** The whole sentence where the runtime does not speak English: the library's own is. */
function refusedText(error: EndCodeError, { meaning, remedy }: Explanation, texts: Texts): string {
  const { command } = error
  if (languageOf(texts) === 'en-US' || meaning === undefined || command === undefined) return error.message
  const title = titleOf(error, texts) ?? command
  const key = error.carriedOut === false ? 'error.refused' : 'error.leftOpen'
  const text = texts(key, { command: title, code: codeText(error), meaning, remedy: remedy ?? '' })
  const head = headOfError(error)
  return head === undefined ? text : `${head}: ${text}`
}

/** The command in the language of the runtime; the sets of MELSEC share its names, as far as they have the command. */
function titleOf({ family, commandName = '' }: EndCodeError, texts: Texts): string | undefined {
  const [known, part] = family === 'jw' ? [jwCommands, 'jwCommand'] : [commands, 'command']
  return Object.hasOwn(known, commandName) ? texts(`${part}.${commandName}`) : undefined
}

function codeText({ family, endCode, abnormalCode }: EndCodeError): string {
  const codes = abnormalCode === undefined ? [endCode] : [endCode, abnormalCode]
  return codes.map((code) => `${endCodeDigits(code, family)}H`).join(', ')
}

function reasonOf(error: PlcError): { reason?: string } {
  return error.cause instanceof Error && error.cause.message !== error.message ? { reason: error.cause.message } : {}
}

function present<T extends Readonly<Record<string, string | undefined>>>(given: T): { [K in keyof T]?: string } {
  const entries = Object.entries(given).filter((entry): entry is [string, string] => entry[1] !== undefined)
  return Object.fromEntries(entries) as { [K in keyof T]?: string }
}
