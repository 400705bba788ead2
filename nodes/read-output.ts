// The messages of a read node: the values in the form the user chose, and what becomes of items that failed.
import type { NodeAPI, NodeMessage, NodeMessageInFlow } from 'node-red'
import type { ReadResult } from '../src/index'
import { carried, type Int64Form } from './carried-value'
import { detailsOf, type FailureDetails, failureOf, refusal } from './failure'
import type { Answer } from './node'
import type { Texts } from './texts'

/** One value, an object by name, an array in the order of the items, or a message for each item. */
export const outputForms = ['object', 'value', 'array', 'messages'] as const
export type OutputForm = (typeof outputForms)[number]

/** When an item fails: an error and no message, or a message with what was read. */
export const partialRules = ['error', 'send'] as const
export type PartialRule = (typeof partialRules)[number]

export interface OutputSettings {
  readonly form: OutputForm
  /** Property of the message that the values go to, e.g. `payload`. */
  readonly property: string
  /** Each value with its quality and timestamp; failures are in the message then, and none is an error. */
  readonly quality: boolean
  readonly partial: PartialRule
  /** What LINT and ULINT are in the message. */
  readonly int64: Int64Form
}

/** A value with its quality. */
export interface QualifiedValue {
  /** `null` when it could not be read: an old value is never passed off as a new one. */
  readonly value: unknown
  readonly quality: 'good' | 'bad'
  /** Milliseconds since 1970 when it was received, or when the failure was known. */
  readonly timestamp: number
  /** An array read by more than one request: its values may be of different moments. */
  readonly torn?: true
  readonly error?: FailureDetails
}

/** An entry of `msg.errors`. */
export type ItemError = FailureDetails & { readonly name: string; readonly item: string }

export interface Readings {
  readonly names: readonly string[]
  readonly results: readonly ReadResult[]
}

export interface OutputTools {
  readonly RED: NodeAPI
  readonly texts: Texts
}

/**
 * The messages for what was read.
 * @throws NodeFailure when items failed and the settings do not let the message say so; `cause.errors` lists them.
 */
export function answerOf(
  settings: OutputSettings,
  readings: Readings,
  message: NodeMessageInFlow,
  tools: OutputTools,
): Answer {
  const errors = errorsOf(readings, tools.texts)
  const all = readings.results.length
  const partly = errors.length === 0 ? {} : { partly: { failed: errors.length, all } }
  const first = readings.results.find((result) => !result.ok)
  if (settings.quality) {
    // A message full of bad values is no half success: the status says why nothing could be read.
    const nothing =
      first !== undefined && !first.ok && errors.length === all ? { nothing: failureOf(first.error, tools.texts) } : {}
    return { messages: messagesOf(settings, readings, message, errors, tools), ...partly, ...nothing }
  }
  const sendsRest = settings.partial === 'send' && errors.length < all
  if (first !== undefined && !first.ok && !sendsRest) {
    throw failureOf(first.error, tools.texts, { errors })
  }
  return { messages: messagesOf(settings, readings, message, errors, tools), ...partly }
}

/** @throws NodeFailure when there is more than one item and the output is one value. */
export function checkForm(form: OutputForm, count: number, texts: Texts): void {
  if (form === 'value' && count !== 1) throw refusal('NOT_CONFIGURED', texts('error.oneValue', { count }))
}

function errorsOf({ names, results }: Readings, texts: Texts): ItemError[] {
  return results.flatMap((result, index) =>
    result.ok ? [] : [{ name: names[index] ?? result.item, item: result.item, ...detailsOf(result.error, texts) }],
  )
}

function messagesOf(
  settings: OutputSettings,
  readings: Readings,
  message: NodeMessageInFlow,
  errors: readonly ItemError[],
  tools: OutputTools,
): NodeMessage[] {
  const { form, quality, int64 } = settings
  const plain = (result: ReadResult) => (result.ok ? carried(result.value, int64) : null)
  const value = (result: ReadResult) => (quality ? qualified(result, plain(result), tools.texts) : plain(result))
  if (form === 'messages') return separate(settings, readings, message, errors, tools, value)
  const { names, results } = readings
  const shown = { object: () => byName(names, results, quality, value), array: () => results.map(value) }
  const content = form === 'value' ? results.map(value)[0] : shown[form]()
  return [filled(settings, tools.RED, message, { content, errors, torn: tornOf(readings) })]
}

function byName(
  names: readonly string[],
  results: readonly ReadResult[],
  quality: boolean,
  value: (result: ReadResult) => unknown,
): Record<string, unknown> {
  // A name that could not be read is missing rather than null, unless its quality says why.
  const entries = results.flatMap((result, index) =>
    result.ok || quality ? [[names[index] ?? result.item, value(result)]] : [],
  )
  return Object.fromEntries(entries)
}

/** One message for each item, in the form that Join puts together again. */
function separate(
  settings: OutputSettings,
  readings: Readings,
  message: NodeMessageInFlow,
  errors: readonly ItemError[],
  { RED }: OutputTools,
  value: (result: ReadResult) => unknown,
): NodeMessage[] {
  const { names, results } = readings
  const { quality } = settings
  const sent = results.flatMap((result, index) => (result.ok || quality ? [{ result, index }] : []))
  return sent.map(({ result, index }, position) => {
    const name = names[index] ?? result.item
    const own = RED.util.cloneMessage(message)
    own.topic = name
    own.parts = {
      id: message._msgid,
      type: 'object',
      key: name,
      index: position,
      count: sent.length,
      ...(message.parts === undefined ? {} : { parts: message.parts }),
    } as NonNullable<NodeMessageInFlow['parts']>
    return filled(settings, RED, own, {
      content: value(result),
      errors: quality ? errors.filter((error) => error.name === name) : errors,
      torn: result.ok && result.torn ? [name] : [],
    })
  })
}

interface Content {
  readonly content: unknown
  readonly errors: readonly ItemError[]
  readonly torn: readonly string[]
}

/** The received message with the values in it, and with nothing left over from an earlier read. */
function filled(
  { property, quality, partial }: OutputSettings,
  RED: NodeAPI,
  message: NodeMessage,
  { content, errors, torn }: Content,
): NodeMessage {
  RED.util.setMessageProperty(message, property, content, true)
  // There whenever there may be some, so that nobody takes the errors of another node for these.
  if (quality || partial === 'send') message.errors = errors
  if (torn.length > 0) message.torn = torn
  else delete message.torn
  return message
}

/** Names of arrays that took more than one request: their values may be of different moments. */
function tornOf({ names, results }: Readings): string[] {
  return results.flatMap((result, index) => (result.ok && result.torn ? [names[index] ?? result.item] : []))
}

function qualified(result: ReadResult, value: unknown, texts: Texts): QualifiedValue {
  const { timestamp } = result
  if (!result.ok) return { value: null, quality: 'bad', timestamp, error: detailsOf(result.error, texts) }
  return { value, quality: 'good', timestamp, ...(result.torn ? { torn: true } : {}) }
}
