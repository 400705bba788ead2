// A Sharp JW message in words, field by field.

import { hex } from '../basics/hex'
import { field, type Message, type Shape } from '../codec/codec'
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
import { type JwAddress, jwAddress } from './address'
import { jwCommands } from './commands'

/** What is known of a JW message. */
export interface ExplainJwOptions {
  /** Request or response; told by the first byte. */
  readonly direction?: Direction
  /** The frame of the request that this response answers: tells where the answer ends. */
  readonly request?: Buffer
}

const { bytes: bytesOf, fixed, u8 } = field

/** First byte of a message (JW300 option unit manual, "Message form"); a test holds it against the framing. */
const ID = { request: 0x47, response: 0x45 } as const
/** In front of a message with a header stand 40 bytes of which the first is 00. */
const HEADER = 40

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
  const header = bytes[0] === 0 ? HEADER : 0
  const id = bytes[header]
  if (id === undefined) return notAFrame(bytes, 'the message is missing')
  const direction = options.direction ?? (id === ID.response ? 'response' : 'request')
  const explainer = new Explainer(bytes, 'binary')
  if (header > 0) explainer.read({ header: bytesOf(HEADER) }, () => 'header of 40 bytes')
  return direction === 'request'
    ? explainRequest(explainer, bytes.length)
    : explainResponse(explainer, options, bytes.length)
}

function commandOf(code: unknown): NamedCommand | undefined {
  return Object.values<NamedCommand>(jwCommands).find((command) => command.code === code)
}

function describeJw({ name, field: of, value }: Leaf): string | undefined {
  const number = Number(value)
  if (of.kind === 'value' && of.codec === jwAddress) return addressText(value as JwAddress)
  switch (name) {
    case 'id':
      return number === ID.request ? 'request' : 'response'
    case 'command':
      return `${hex(number, 2)}H (${commandOf(number)?.title ?? 'no command that is known here'})`
    case 'result':
      return `${hex(number, 2)}H (${number === 0 ? 'carried out' : 'refused'})`
    default:
      return of.kind === 'echo'
        ? `${isAddress(value) ? addressText(value) : plainText(value)} (repeats the request)`
        : undefined
  }
}

function isAddress(value: unknown): value is JwAddress {
  return typeof value === 'object' && value !== null && 'file' in value
}

/** As a JW numbers them: files in hexadecimal, the bytes of a file in octal. */
function addressText({ file, address, extended }: JwAddress): string {
  return `file ${hex(file, 2)}H, byte ${address.toString(8).padStart(6, '0')} octal${extended === true ? ' (extended)' : ''}`
}

function explainRequest(explainer: Explainer, total: number): FrameExplanation {
  const head = explainer.read(requestHead, describeJw)
  const command = commandOf(head.command)
  const about = { frame: 'JW', code: 'binary', direction: 'request' } as const
  if (command === undefined) return unknown(explainer, { ...about, title: 'JW request' }, total)
  explainer.read(command.request, describeJw, {}, splitBytes)
  return end(explainer, { ...about, title: `JW request: ${command.title}`, command: command.name }, total)
}

type About = Parameters<Explainer['end']>[0]

/** A message has no length, so what stands behind it may be the next one. */
function end(explainer: Explainer, about: About, total: number): FrameExplanation {
  if (explainer.fault === undefined) explainer.limit(explainer.position)
  return explainer.end(about, total)
}

function unknown(explainer: Explainer, about: About, total: number): FrameExplanation {
  if (explainer.fault === undefined)
    explainer.take(explainer.remaining, { name: 'data', kind: 'bytes', text: 'data that is not known here' })
  return explainer.end(about, total)
}

function explainResponse(explainer: Explainer, options: ExplainJwOptions, total: number): FrameExplanation {
  const asked = options.request === undefined ? undefined : requestIn(options.request)
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
    { context: { shape: asked.command.request, message: asked.message } },
    splitBytes,
  )
  return end(explainer, { ...about, title, command: asked.command.name }, total)
}

function requestIn(frame: Buffer): { readonly command: NamedCommand; readonly message: Message } | undefined {
  const bytes = frame.subarray(frame[0] === 0 ? HEADER : 0)
  const head = annotate(requestHead, bytes, { code: 'binary' })
  const command = commandOf(head.message.command)
  if (head.fault !== undefined || command === undefined) return undefined
  const { message, fault } = annotate(command.request, bytes.subarray(head.used), { code: 'binary' })
  return fault === undefined ? { command, message } : undefined
}

const TOGETHER = 16

/** Long data in rows of 16 bytes. */
function splitBytes(row: AnnotatedRow, bytes: Buffer): readonly AnnotatedRow[] {
  if (row.kind !== 'bytes' || bytes.length <= TOGETHER) return [row]
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
