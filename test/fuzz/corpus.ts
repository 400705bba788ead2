/** Right requests with right answers, of every declared command in every form: what the damage starts from. */

import fc from 'fast-check'
import type { DataCode, Message, Shape } from '../../src/codec/codec'
import { RequestError } from '../../src/errors'
import type { Exchange, Head, HeadProtocol, NamedCommand } from '../../src/link/link'
import type { Command } from '../../src/melsec/commands/command'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import type { DeviceForm } from '../../src/melsec/device/device-form'
import { FORM_BITS, subcommandOf } from '../../src/melsec/device/form'
import type { MelsecProtocol } from '../../src/melsec/protocol'
import { arbitrary } from '../support/arbitrary'

export interface Sample {
  readonly command: string
  readonly exchange: Exchange<unknown>
  /** Body of a right answer. */
  readonly answer: Buffer
}

const FORMS: readonly DeviceForm[] = ['short', 'long', 'extendedShort', 'extendedLong']
/** Messages that are made of a command in a form, and how many of them are kept: not every device goes with it. */
const MADE = 24
const KEPT = 3

/** Made once for all frames that have the same messages: making them takes most of the time. */
const made = new WeakMap<Shape, Map<string, readonly Message[]>>()

function messagesOf(shape: Shape, ascii: boolean, form: number): readonly Message[] {
  const lists = made.get(shape) ?? new Map<string, readonly Message[]>()
  made.set(shape, lists)
  const key = `${ascii} ${form}`
  const list = lists.get(key) ?? fc.sample(arbitrary(shape, { ascii, form }), { numRuns: MADE, seed: 1 })
  lists.set(key, list)
  return list
}

function answerTo(response: Shape, asked: Shape, message: Message, ascii: boolean, form: number): Message {
  const wanted = { ascii, form, context: { shape: asked, message } }
  const [made] = fc.sample(arbitrary(response, wanted), { numRuns: 1, seed: 2 })
  if (made === undefined) throw new Error('no answer was made')
  return made
}

/** Those of `make` that the protocol sends: what it refuses before sending is no frame. */
function* sendable<T>(messages: readonly Message[], make: (message: Message) => T): Generator<T> {
  let kept = 0
  for (const message of messages) {
    try {
      yield make(message)
      if (++kept === KEPT) return
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
    }
  }
}

/** The SLMP set. */
export function samplesOf<H extends Head>(protocol: MelsecProtocol<H>): Sample[] {
  return Object.values<Command>(commands).flatMap((command) =>
    (command.unit === 'none' ? FORMS.slice(0, 1) : FORMS).flatMap((form) => samplesIn(protocol, command, form)),
  )
}

function samplesIn<H extends Head>(protocol: MelsecProtocol<H>, command: Command, form: DeviceForm): Sample[] {
  const ascii = protocol.code === 'ascii'
  const bits = FORM_BITS[form]
  const registered: Command | undefined =
    command.context === undefined ? undefined : commands[command.context as CommandName]
  const contexts = registered === undefined ? undefined : messagesOf(registered.request, ascii, bits)
  const messages = contexts ?? messagesOf(command.request, ascii, bits)
  const name = command.name as CommandName
  return [
    ...sendable(messages, (given): Sample => {
      const message = registered === undefined ? given : {}
      const options = registered === undefined ? { form } : { context: given }
      const exchange = protocol.exchange<Command>(command, message, options)
      const asked = registered === undefined ? { ...exchange.message } : given
      const answer = answerTo(command.response, (registered ?? command).request, asked, ascii, bits)
      const subcommand = subcommandOf(command, form, protocol.profile)
      const received = { command, name, form, subcommand, message: asked }
      return { command: command.name, exchange, answer: protocol.writeResponse(received, answer, asked) }
    }),
  ]
}

/** The same message with device numbers that every device has: 1E takes few others. */
function nearby(message: Message): Message {
  const entries = Object.entries(message).map(([name, part]): [string, unknown] => [
    name,
    name === 'number' && typeof part === 'number' ? (part % 8) * 16 : nearbyIn(part),
  ])
  return Object.fromEntries(entries)
}

function nearbyIn(part: unknown): unknown {
  if (Array.isArray(part)) return part.map(nearbyIn)
  return typeof part === 'object' && part !== null && !ArrayBuffer.isView(part) ? nearby({ ...part }) : part
}

/** A set whose command number is in the head: 1E, Sharp JW. */
export function samplesOfHead<H extends Head>(
  protocol: HeadProtocol<H>,
  list: Readonly<Record<string, NamedCommand>>,
  code: DataCode,
): Sample[] {
  const ascii = code === 'ascii'
  return Object.values(list).flatMap((command) => [
    ...sendable(messagesOf(command.request, ascii, 0), (given): Sample => {
      const exchange = protocol.exchange(command, nearby(given))
      const asked = { ...exchange.message }
      const answer = protocol.writeResponse(
        command,
        asked,
        answerTo(command.response, command.request, asked, ascii, 0),
      )
      return { command: command.name, exchange, answer }
    }),
  ])
}
