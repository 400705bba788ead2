// A Sharp JW message in words, field by field.

import { hex } from '../basics/hex'
import { octal } from '../basics/octal'
import { field, hasSecret, type Message, type Shape } from '../codec/codec'
import {
  type AnnotatedRow,
  annotate,
  type Direction,
  Explainer,
  type FrameExplanation,
  type Leaf,
  notAFrame,
  plainText,
  showBytes,
} from '../codec/explanation'
import type { NamedCommand } from '../link/link'
import type { JwAddress } from './address'
import { jwCommands } from './commands/commands'
import { markerForms } from './commands/data-memory'
import { HEADER_LENGTH, headerBytes, ID, type JwHeader, relayIn } from './header'
import { timerAttributes } from './operand/timer'
import { explainResultCode } from './result-codes/explain'

/** What is known of a JW message. */
export interface ExplainJwOptions {
  /** Request or response; told by the first byte. */
  readonly direction?: Direction
  /** The frame of the request that this response answers: tells where the answer ends. */
  readonly request?: Buffer
  /** Where FFH stands in lists of relays and registers. Default `once`. */
  readonly marker?: keyof typeof markerForms
  /** What stands in front of the message, where it is neither nothing nor 40 bytes of which the first is 00. */
  readonly header?: JwHeader
}

/** Where the message begins in a frame: behind the header, where there is one. */
export function messageStartIn(bytes: Buffer, { header = 'none' }: Pick<ExplainJwOptions, 'header'>): number {
  const given = headerBytes(header)
  const [first] = bytes
  if (first === ID.request || first === ID.response) return 0
  if (given.length > 0 && first === given[0]) return given.length
  return first === 0 ? HEADER_LENGTH : 0
}

const { bytes: bytesOf, fixed, u8 } = field

/** Behind the ID and ATTR. */
const COMMAND_AT = 2

const requestHead = { id: fixed(ID.request, 1), attr: fixed(0, 1), command: u8() } as const satisfies Shape
const responseHead = {
  id: fixed(ID.response, 1),
  attr: fixed(0, 1),
  command: u8(),
  result: u8(),
} as const satisfies Shape

/**
 * Explains a message of the JW-255CM, also a broken one: then up to where it is wrong. Never throws for what is in the bytes.
 * @example formatExplanation(explainJwFrame(Buffer.from('4700240000080400', 'hex')))
 */
export function explainJwFrame(bytes: Buffer, options: ExplainJwOptions = {}): FrameExplanation {
  const header = messageStartIn(bytes, options)
  const id = bytes[header]
  if (id === undefined) return notAFrame(bytes, 'the message is missing')
  const direction = options.direction ?? (id === ID.response ? 'response' : 'request')
  const explainer = new Explainer(bytes, 'binary')
  if (header > 0) explainer.read({ header: bytesOf(header) }, () => headerText(bytes.subarray(0, header)))
  return direction === 'request'
    ? explainRequest(explainer, options, bytes.length)
    : explainResponse(explainer, options, bytes.length)
}

function headerText(header: Buffer): string {
  const relay = relayIn(header)
  if (relay === undefined) return `header of ${header.length} bytes`
  const { pda, psa, slot, station } = relay
  return `header of ${header.length} bytes: relay to station ${station} by the unit in slot ${slot}, PDA ${pda}, PSA ${psa}`
}

/** How its lists are read. */
function formOf({ marker = 'once' }: ExplainJwOptions): { readonly form: number } {
  return { form: markerForms[marker] }
}

function commandOf(code: unknown): NamedCommand | undefined {
  return Object.values<NamedCommand>(jwCommands).find((command) => command.code === code)
}

function describeJw({ name: path, field: of, value }: Leaf): string | undefined {
  const text = wordsOf(path.slice(path.lastIndexOf('.') + 1), value)
  return of.kind === 'echo' ? `${text ?? plainText(value)} (repeats the request)` : text
}

function wordsOf(name: string, value: unknown): string | undefined {
  if (isAddress(value)) return addressText(value)
  if (name === 'attributes' && Buffer.isBuffer(value)) return attributesText(value)
  if (typeof value !== 'number') return undefined
  switch (name) {
    case 'id':
      return value === ID.request ? 'request' : 'response'
    case 'command':
      return `${hex(value, 2)}H (${commandOf(value)?.title ?? 'no command that is known here'})`
    case 'result':
      return resultText(value)
    case 'file':
    case 'informationFile':
      return `file ${hex(value, 2)}H`
    case 'segment':
      return `${hex(value, 2)}H`
    case 'address':
    case 'informationAddress':
      return octalText(value)
    case 'number':
      return `${octal(value, 4)} octal`
    default:
      return undefined
  }
}

function resultText(code: number): string {
  if (code === 0) return '00H (carried out)'
  const meaning = explainResultCode(code)?.meaning ?? 'no text is known for this code'
  return `${hex(code, 2)}H (refused: ${meaning.replace(/\.$/, '')})`
}

/** What each timer or counter of the answer is: `08H DTMR (BCD)`. */
function attributesText(attributes: Buffer): string {
  const titles = Array.from(attributes, (attribute) => {
    const { title } = timerAttributes[attribute] ?? { title: 'not printed' }
    return `${hex(attribute, 2)}H ${title}`
  })
  return titles.join(', ')
}

function isAddress(value: unknown): value is JwAddress {
  return typeof value === 'object' && value !== null && 'file' in value
}

function octalText(address: number): string {
  return `${octal(address, 6)} octal`
}

/** As a JW numbers them: files in hexadecimal, the bytes of a file in octal. */
function addressText({ file, address, extended }: JwAddress): string {
  return `file ${hex(file, 2)}H, byte ${octalText(address)}${extended === true ? ' (extended)' : ''}`
}

function explainRequest(explainer: Explainer, options: ExplainJwOptions, total: number): FrameExplanation {
  // Also of a head that is wrong: what is not read may be the password.
  const asked = commandOf(explainer.ahead()[COMMAND_AT])
  const secret = asked !== undefined && hasSecret(asked.request)
  const head = explainer.read(requestHead, describeJw)
  const command = commandOf(head.command)
  const about = { frame: 'JW', code: 'binary', direction: 'request' } as const
  if (command === undefined) return unknown(explainer, { ...about, title: 'JW request' }, total, secret)
  explainer.read(command.request, describeJw, formOf(options), splitBytes)
  return end(explainer, { ...about, title: `JW request: ${command.title}`, command: command.name }, total, secret)
}

type About = Parameters<Explainer['end']>[0]

/** A message has no length, so what stands behind it may be the next one. */
function end(explainer: Explainer, about: About, total: number, secret = false): FrameExplanation {
  if (explainer.fault === undefined) explainer.limit(explainer.position)
  return explainer.end(about, total, secret)
}

function unknown(explainer: Explainer, about: About, total: number, secret = false): FrameExplanation {
  if (explainer.fault === undefined)
    explainer.take(explainer.remaining, { name: 'data', kind: 'bytes', text: 'data that is not known here' })
  return explainer.end(about, total, secret)
}

function explainResponse(explainer: Explainer, options: ExplainJwOptions, total: number): FrameExplanation {
  const asked = options.request === undefined ? undefined : requestIn(options.request, options)
  if (options.request !== undefined && asked === undefined) {
    explainer.notes.push('The frame given as request is no request that can be read.')
  }
  const head = explainer.read(responseHead, describeJw)
  const about = {
    frame: 'JW',
    code: 'binary',
    direction: 'response',
    ...(typeof head.result === 'number' ? { endCode: head.result } : {}),
  } as const
  const command = commandOf(head.command)
  if (asked !== undefined && typeof head.command === 'number' && command !== asked.command) {
    explainer.fail(
      explainer.position - 2,
      `this answers another command than the request (${asked.command.title})`,
      'command',
    )
  }
  const title = `JW response${command === undefined ? '' : `: ${command.title}`}`
  if (head.result !== 0)
    return end(explainer, { ...about, title: head.result === undefined ? title : `${title}, refused` }, total)
  if (asked === undefined) {
    explainer.notes.push('What the data means is in the request: give it to have it named.')
    return unknown(explainer, { ...about, title }, total)
  }
  explainer.read(
    asked.command.response,
    describeJw,
    { ...formOf(options), context: { shape: asked.command.request, message: asked.message } },
    splitBytes,
  )
  return end(explainer, { ...about, title, command: asked.command.name }, total)
}

function requestIn(
  frame: Buffer,
  options: ExplainJwOptions,
): { readonly command: NamedCommand; readonly message: Message } | undefined {
  const bytes = frame.subarray(messageStartIn(frame, options))
  const head = annotate(requestHead, bytes, { code: 'binary' })
  const command = commandOf(head.message.command)
  if (head.fault !== undefined || command === undefined) return undefined
  const { message, fault } = annotate(command.request, bytes.subarray(head.used), {
    code: 'binary',
    ...formOf(options),
  })
  return fault === undefined ? { command, message } : undefined
}

const TOGETHER = 16

/** Long data in rows of 16 bytes. */
function splitBytes(row: AnnotatedRow, bytes: Buffer): readonly AnnotatedRow[] {
  if (!['bytes', 'rest'].includes(row.kind) || bytes.length <= TOGETHER) return [row]
  const rows: AnnotatedRow[] = []
  for (let from = 0; from < bytes.length; from += TOGETHER) {
    const piece = Buffer.from(bytes.subarray(from, from + TOGETHER))
    const shown = showBytes(piece, 'binary')
    const name = `${row.name}.${from}..${from + piece.length - 1}`
    rows.push({
      ...row,
      offset: row.offset + from,
      length: piece.length,
      name,
      value: piece,
      bytes: shown,
      text: shown,
    })
  }
  return rows
}
