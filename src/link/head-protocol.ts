// A protocol whose command number stands in the frame's head and whose requests carry no length: MELSEC 1E and
// Sharp JW. Frames, commands and device codes differ; how they go together is the same.
import {
  type Context,
  type DataCode,
  type Declaration,
  decode,
  encode,
  type MessageInput,
  type MessageOf,
  measure,
  type Named,
  readerOf,
  writerOf,
} from '../codec/codec'
import { type EndCodeError, ProtocolError } from '../errors'
import type { Exchange } from './exchange'
import type { Framing, RequestFrame, ResponseFrame } from './framing'

/** A command with its name. */
export type NamedCommand = Named<Declaration, string>

/** What makes one protocol of this kind different from another. */
export interface HeadProtocolParts<Head> {
  readonly framing: Framing<Head>
  readonly commands: Readonly<Record<string, NamedCommand>>
  readonly code: DataCode
  /** Device form of the value codecs. */
  readonly form: number
  readonly headOf: (command: NamedCommand) => Head
  readonly codeOf: (head: Head) => number
  /** The error for an end code other than 0. */
  readonly refusal: (command: NamedCommand, frame: ResponseFrame<Head>) => EndCodeError
}

export class HeadProtocol<Head> {
  readonly #parts: HeadProtocolParts<Head>

  constructor(parts: HeadProtocolParts<Head>) {
    this.#parts = parts
  }

  get framing(): Framing<Head> {
    return this.#parts.framing
  }

  /** A request ready to be sent. @throws RequestError when the message does not fit the command. */
  exchange<C extends NamedCommand>(
    command: C,
    message: MessageInput<C['request']>,
  ): Exchange<Head, MessageOf<C['response']>> {
    const { code, form } = this.#parts
    const writer = writerOf(code, form)
    encode<C['request']>(command.request, message, writer)
    const body = writer.take()
    // What was sent counts, not an object that the caller may change before the answer comes.
    const context: Context = { shape: command.request, message: decode(command.request, readerOf(code, body, form)) }
    return {
      title: command.title,
      effect: command.effect,
      message,
      head: this.#parts.headOf(command),
      body,
      answered: command.answered !== 'no',
      responseLength: (head) => {
        this.#checkCommand(command, head)
        return measure(command.response, { ascii: code === 'ascii', form, context })
      },
      decode: (frame) => this.#decode(command, context, frame),
    }
  }

  /** Without a length, an answer to another command would be waited for until it is as long as the right one. */
  #checkCommand(command: NamedCommand, head: Head): void {
    const answered = this.#parts.codeOf(head)
    if (answered === command.code) return
    const hex = (code: number) => code.toString(16).toUpperCase().padStart(2, '0')
    throw new ProtocolError(
      'ECHO_MISMATCH',
      `The answer is to command ${hex(answered)}H, asked was ${hex(command.code)}H.`,
    )
  }

  #decode<C extends NamedCommand>(command: C, context: Context, frame: ResponseFrame<Head>): MessageOf<C['response']> {
    if (frame.endCode !== 0) throw this.#parts.refusal(command, frame)
    const reader = readerOf(this.#parts.code, frame.body, this.#parts.form)
    const message = decode<C['response']>(command.response, reader, context)
    reader.end()
    return message
  }

  /** Length of a request's body, for the responder: the declaration tells where it ends. */
  requestLength(head: Head, soFar: Buffer): number | undefined {
    const reader = readerOf(this.#parts.code, soFar, this.#parts.form)
    try {
      decode(this.#commandOf(head).request, reader)
      return reader.position
    } catch (error) {
      if (error instanceof ProtocolError && error.code === 'TRUNCATED') return undefined
      throw error
    }
  }

  /** The PLC's side: which command with which message a frame is. */
  readRequest(frame: RequestFrame<Head>): { command: NamedCommand; message: Readonly<Record<string, unknown>> } {
    const command = this.#commandOf(frame.head)
    const reader = readerOf(this.#parts.code, frame.body, this.#parts.form)
    const message = decode(command.request, reader)
    reader.end()
    return { command, message }
  }

  /** The PLC's side: the data of the answer to `message`. */
  writeResponse(
    command: NamedCommand,
    message: Readonly<Record<string, unknown>>,
    response: Readonly<Record<string, unknown>>,
  ): Buffer {
    const writer = writerOf(this.#parts.code, this.#parts.form)
    encode(command.response, response, writer, { shape: command.request, message })
    return writer.take()
  }

  #commandOf(head: Head): NamedCommand {
    const code = this.#parts.codeOf(head)
    const command = Object.values(this.#parts.commands).find((entry) => entry.code === code)
    if (command === undefined)
      throw new ProtocolError('BAD_FIELD', `There is no command ${code.toString(16).toUpperCase()}H.`)
    return command
  }
}
