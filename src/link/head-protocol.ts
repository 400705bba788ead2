// A protocol whose command number stands in the frame's head and whose requests carry no length: MELSEC 1E and
// Sharp JW. Frames, commands and device codes differ; how they go together is the same.
import { hex } from '../basics/hex'
import {
  type Context,
  type DataCode,
  type Declaration,
  decode,
  encode,
  type Message,
  type MessageInput,
  type MessageOf,
  measure,
  type Named,
  type Reader,
  readerOf,
  writerOf,
} from '../codec/codec'
import { type EndCodeError, ProtocolError } from '../errors'
import { type Exchange, framed } from './exchange'
import type { Framing, Head, RequestFrame, ResponseFrame } from './framing'

/** A command with its name. */
export type NamedCommand = Named<Declaration, string>

const DUMMY = '0'

/** What makes one protocol of this kind different from another. */
export interface HeadProtocolParts<H extends Head> {
  readonly framing: Framing<H>
  readonly commands: Readonly<Record<string, NamedCommand>>
  readonly code: DataCode
  /** Device form of the value codecs. */
  readonly form: number
  readonly headOf: (command: NamedCommand) => H
  /** Of a head as its framing scans it. */
  readonly codeOf: (head: Head) => number | undefined
  /** The message as it goes into the frame. @throws RequestError for what must not be sent. */
  readonly prepare?: (command: NamedCommand, message: Message) => Message
  /** Characters `0` behind a request, or behind the data of its answer, that stand for nothing. */
  readonly dummies?: (command: NamedCommand, request: Message, side: 'request' | 'response') => number
  /** The error for an end code other than 0. */
  readonly refusal: (command: NamedCommand, frame: ResponseFrame) => EndCodeError
}

export class HeadProtocol<H extends Head> {
  readonly #parts: HeadProtocolParts<H>

  constructor(parts: HeadProtocolParts<H>) {
    this.#parts = parts
  }

  get framing(): Framing<H> {
    return this.#parts.framing
  }

  /** A request ready to be sent. @throws RequestError when the message does not fit the command. */
  exchange<C extends NamedCommand>(
    command: C,
    message: MessageInput<C['request']>,
  ): Exchange<MessageOf<C['response']>> {
    const { code, form, prepare } = this.#parts
    const writer = writerOf(code, form)
    if (prepare === undefined) encode<C['request']>(command.request, message, writer)
    else encode(command.request, prepare(command, message), writer)
    const data = writer.take()
    // What was sent counts, not an object that the caller may change before the answer comes.
    const context: Context = { shape: command.request, message: decode(command.request, readerOf(code, data, form)) }
    const body = this.#withDummies(data, command, context.message, 'request')
    const asked = {
      title: command.title,
      effect: command.effect,
      message,
      body,
      answered: command.answered !== 'no',
      responseLength: (head: Head) => {
        this.#checkCommand(command, head)
        const length = measure(command.response, { ascii: code === 'ascii', form, context })
        return length + this.#dummies(command, context.message, 'response')
      },
      decode: (frame: ResponseFrame) => this.#decode(command, context, frame),
    }
    return { ...asked, ...framed({ framing: this.#parts.framing, head: this.#parts.headOf(command) }, asked) }
  }

  /** Without a length, an answer to another command would be waited for until it is as long as the right one. */
  #checkCommand(command: NamedCommand, head: Head): void {
    const answered = this.#parts.codeOf(head)
    if (answered === command.code) return
    throw new ProtocolError(
      'ECHO_MISMATCH',
      `The answer is to ${commandText(answered)}, asked was ${hex(command.code, 2)}H.`,
      { field: 'command' },
    )
  }

  #decode<C extends NamedCommand>(command: C, context: Context, frame: ResponseFrame): MessageOf<C['response']> {
    if (frame.endCode !== 0) throw this.#parts.refusal(command, frame)
    const reader = readerOf(this.#parts.code, frame.body, this.#parts.form)
    const message = decode<C['response']>(command.response, reader, context)
    this.#endOf(reader, this.#dummies(command, context.message, 'response'))
    return message
  }

  #dummies(command: NamedCommand, request: Message, side: 'request' | 'response'): number {
    return this.#parts.dummies?.(command, request, side) ?? 0
  }

  #withDummies(data: Buffer, command: NamedCommand, request: Message, side: 'request' | 'response'): Buffer {
    const count = this.#dummies(command, request, side)
    return count === 0 ? data : Buffer.concat([data, Buffer.from(DUMMY.repeat(count), 'latin1')])
  }

  #endOf(reader: Reader, dummies: number): void {
    if (reader.text(dummies) !== DUMMY.repeat(dummies)) reader.fail('BAD_FIELD', `the dummy character is no ${DUMMY}`)
    reader.end()
  }

  /** Length of a request's body, for the responder: the declaration tells where it ends. */
  requestLength(head: Head, soFar: Buffer): number | undefined {
    const reader = readerOf(this.#parts.code, soFar, this.#parts.form)
    try {
      const command = this.#commandOf(head)
      const message = decode(command.request, reader)
      return reader.position + this.#dummies(command, message, 'request')
    } catch (error) {
      if (error instanceof ProtocolError && error.code === 'TRUNCATED') return undefined
      throw error
    }
  }

  /** The PLC's side: which command with which message a frame is. */
  readRequest(frame: RequestFrame): { command: NamedCommand; message: Message } {
    const command = this.#commandOf(frame.head)
    const reader = readerOf(this.#parts.code, frame.body, this.#parts.form)
    const message = decode(command.request, reader)
    this.#endOf(reader, this.#dummies(command, message, 'request'))
    return { command, message }
  }

  /** The PLC's side: the data of the answer to `message`. */
  writeResponse(command: NamedCommand, message: Message, response: Message): Buffer {
    const writer = writerOf(this.#parts.code, this.#parts.form)
    encode(command.response, response, writer, { shape: command.request, message })
    return this.#withDummies(writer.take(), command, message, 'response')
  }

  #commandOf(head: Head): NamedCommand {
    const code = this.#parts.codeOf(head)
    const command = Object.values(this.#parts.commands).find((entry) => entry.code === code)
    if (command === undefined) throw new ProtocolError('BAD_FIELD', `There is no ${commandText(code)}.`)
    return command
  }
}

function commandText(code: number | undefined): string {
  return `command ${code === undefined ? 'without a number' : `${hex(code, 2)}H`}`
}
