// A protocol whose command stands in the frame's head (MELSEC 1E, Sharp JW) or in front of the data of its requests (MELSEC
// 1C), and whose requests carry no length. Frames, commands and device codes differ; how they go together is the same.
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
  type Shape,
  saysItsLength,
  writerOf,
} from '../codec/codec'
import { type EndCodeError, ProtocolError } from '../errors'
import { type Exchange, framed } from './exchange'
import type { Framing, Head, RequestFrame, ResponseFrame } from './framing'

/** A command with its name. */
export type NamedCommand = Named<Declaration, string>

const DUMMY = '0'

/** What stands in front of the data of each request and says which command it is, where no head does. */
export interface Front {
  readonly shape: Shape
  /** The message of it for a command. */
  readonly messageOf: (command: NamedCommand) => Message
  /** The number of the command that such a message names. */
  readonly codeOf: (message: Message) => number | undefined
}

/** What makes one protocol of this kind different from another. */
export interface HeadProtocolParts<H extends Head> {
  readonly framing: Framing<H>
  readonly commands: Readonly<Record<string, NamedCommand>>
  readonly code: DataCode
  /** Device form of the value codecs. */
  readonly form: number
  readonly headOf: (command: NamedCommand) => H
  /** The number of the command in a head as its framing scans it. Absent: heads name none, so answers do not either. */
  readonly codeOf?: (head: Head) => number | undefined
  /** Where heads name no command. */
  readonly front?: Front
  /** Whether a success is answered. Default: as the declaration says. */
  readonly isAnswered?: (command: NamedCommand) => boolean
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
    const { code, form, prepare, front } = this.#parts
    const writer = writerOf(code, form)
    if (front !== undefined) encode(front.shape, front.messageOf(command), writer)
    if (prepare === undefined) encode<C['request']>(command.request, message, writer)
    else encode(command.request, prepare(command, message), writer)
    const data = writer.take()
    // What was sent counts, not an object that the caller may change before the answer comes.
    const sent = readerOf(code, data, form)
    if (front !== undefined) decode(front.shape, sent)
    const context: Context = { shape: command.request, message: decode(command.request, sent) }
    const body = this.#withDummies(data, command, context.message, 'request')
    const asked = {
      title: command.title,
      effect: command.effect,
      message,
      body,
      answered: this.#parts.isAnswered?.(command) ?? command.answered !== 'no',
      responseLength: (head: Head, soFar: Buffer) => {
        this.#checkCommand(command, head)
        const length = saysItsLength(command.response, command.request)
          ? this.#arrived(command, context, soFar)
          : measure(command.response, { ascii: code === 'ascii', form, context })
        return length === undefined ? undefined : length + this.#dummies(command, context.message, 'response')
      },
      decode: (frame: ResponseFrame) => this.#decode(command, context, frame),
    }
    return { ...asked, ...framed({ framing: this.#parts.framing, head: this.#parts.headOf(command) }, asked) }
  }

  /** Bytes of the bodies of a request and of a success, without writing or checking them. */
  bodyBytes(command: NamedCommand, message: Message): number {
    const { code, form, front } = this.#parts
    const known = { ascii: code === 'ascii', form }
    const context: Context = { shape: command.request, message }
    const dummies = this.#dummies(command, message, 'request') + this.#dummies(command, message, 'response')
    const inFront = front === undefined ? 0 : measure(front.shape, known)
    const request = measure(command.request, { ...known, message })
    return inFront + request + measure(command.response, { ...known, context }) + dummies
  }

  /** Length of an answer that says it itself: known when all of it has arrived. */
  #arrived(command: NamedCommand, context: Context, soFar: Buffer): number | undefined {
    const reader = readerOf(this.#parts.code, soFar, this.#parts.form)
    return unlessCut(() => {
      decode(command.response, reader, context)
      return reader.position
    })
  }

  /** Without a length, an answer to another command would be waited for until it is as long as the right one. */
  #checkCommand(command: NamedCommand, head: Head): void {
    const { codeOf } = this.#parts
    if (codeOf === undefined) return
    const answered = codeOf(head)
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
    return unlessCut(() => {
      const command = this.#commandOf(head, reader)
      const message = decode(command.request, reader)
      return reader.position + this.#dummies(command, message, 'request')
    })
  }

  /** The PLC's side: which command with which message a frame is. */
  readRequest(frame: RequestFrame): { command: NamedCommand; message: Message } {
    const reader = readerOf(this.#parts.code, frame.body, this.#parts.form)
    const command = this.#commandOf(frame.head, reader)
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

  /** Takes what stands in front from the reader of a request's body. */
  #commandOf(head: Head, reader: Reader): NamedCommand {
    const { codeOf, front, commands } = this.#parts
    const code = front === undefined ? codeOf?.(head) : front.codeOf(decode(front.shape, reader))
    const command = Object.values(commands).find((entry) => entry.code === code)
    if (command === undefined) throw new ProtocolError('BAD_FIELD', `There is no ${commandText(code)}.`)
    return command
  }
}

/** What `read` gives, `undefined` while bytes are missing. */
function unlessCut<T>(read: () => T): T | undefined {
  try {
    return read()
  } catch (error) {
    if (error instanceof ProtocolError && error.code === 'TRUNCATED') return undefined
    throw error
  }
}

function commandText(code: number | undefined): string {
  return `command ${code === undefined ? 'without a number' : `${hex(code, 2)}H`}`
}
