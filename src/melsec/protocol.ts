// The SLMP command set in a frame: encodes requests and reads answers, and the same from the PLC's side.
// The frames differ in their head, and in what stands around the data (BodyLayout): one class serves all of them.
import { hex } from '../basics/hex'
import {
  type Context,
  type DataCode,
  decode,
  encode,
  type Message,
  measure,
  type Reader,
  readerOf,
  writerOf,
} from '../codec/codec'
import { EndCodeError, ProtocolError, RequestError } from '../errors'
import {
  answerBytes,
  type Exchange,
  endedWith,
  type Framing,
  framed,
  type Head,
  type OfFrame,
  type RequestFrame,
  type ResponseFrame,
} from '../link/link'
import type { Command, RequestOf, ResponseOf } from './commands/command'
import { type CommandName, commands } from './commands/commands'
import { FORM_XY_OCTAL, FORM_ZR_HEX } from './device/codec'
import type { DeviceForm } from './device/device-form'
import { chooseForm, codecBits, FORM_BITS, findCommand, subcommandOf } from './device/form'
import { checkLimits } from './device/limit'
import { devicesOf } from './device/uses'
import { refusalTexts } from './end-codes/end-code'
import { factsOf } from './end-codes/facts'
import { type BodyLayout, commandFields, type ErrorInformation, plainBody } from './frame/body'
import { describeRoute } from './frame/route'
import { type LineCost, lineCostOf } from './line-cost'
import type { Profile } from './profiles/profile'
import { checkTarget } from './target'

export interface CommandSetOptions {
  /** What stands around the data in a body; default as in 3E and 4E. */
  readonly body?: BodyLayout
  /** Module I/O number of the route, for commands that do not take every one. */
  readonly moduleIo?: number
  readonly profile: Profile
  readonly code: DataCode
  /**
   * Digits of X and Y in ASCII code, a setting of the port of some families ("ASCII (X,Y OCT)" or "(X,Y HEX)"), see
   * `asciiXyOf`; without it their X and Y are refused in ASCII code, because the wrong choice would address other inputs
   * and outputs without any error.
   */
  readonly asciiXy?: 'octal' | 'hexadecimal' | undefined
  /**
   * Digits of ZR in ASCII code. The SLMP manual prints hexadecimal, GX Works and the FX5 manual decimal, and no
   * answer tells which the PLC took; so ZR is refused in ASCII code until this says it.
   */
  readonly asciiZr?: 'decimal' | 'hexadecimal' | undefined
}

export interface MelsecProtocolOptions<H extends Head> extends Omit<CommandSetOptions, 'body'> {
  /** `body`: what stands around the data; default as in 3E and 4E. */
  readonly framing: Framing<H> & {
    readonly body?: BodyLayout
    /** @throws RequestError for a body that the frame cannot carry */
    checkBody?(body: Uint8Array): void
  }
  /** Head of every request: route and monitoring timer. */
  readonly head: H
  /** Head of what is for the connected station only (`to` of the declaration); default `head`, where that is the route. */
  readonly connectedHead?: H
  /** On a serial line: waits of each request, as bytes that the line could carry. */
  readonly turnRound?: number
}

/** What a call may say beside the message. */
export interface ExchangeOptions {
  /** Use this form of the device specification instead of the computed one. */
  readonly form?: DeviceForm
  /** File commands: use this subcommand instead of the profile's usual one, e.g. 0x0004. */
  readonly subcommand?: number
  /** The request a response refers to, when it is another's: the registration, for Execute Monitor. */
  readonly context?: Message
}

/** A request as the PLC's side reads it. */
export interface ReceivedRequest {
  readonly command: Command
  readonly name: CommandName
  readonly form: DeviceForm
  readonly subcommand: number
  readonly message: Message
}

/** A request that names a command or subcommand nobody declared. */
export interface UnknownRequest {
  readonly unknown: { readonly command: number; readonly subcommand: number }
}

/** Devices whose digits in ASCII code depend on a setting that was not given. */
interface UnknownDigits {
  readonly of: readonly string[]
  readonly option: 'asciiXy' | 'asciiZr'
  readonly message: string
}

function unknownDigits(options: CommandSetOptions): UnknownDigits[] {
  const { code, profile, asciiXy, asciiZr } = options
  const unknown: UnknownDigits[] = []
  if (code !== 'ascii') return unknown
  if (profile.asciiXy === 'setting' && profile.xyRadix === 8 && asciiXy === undefined) {
    const message =
      `${profile.title} takes octal or hexadecimal digits, depending on its communication data code ` +
      '"ASCII (X,Y OCT)" or "ASCII (X,Y HEX)". Set the option asciiXy to octal or hexadecimal as in the PLC.'
    unknown.push({ of: ['X', 'Y'], option: 'asciiXy', message })
  }
  if (asciiZr === undefined) {
    const message =
      'the manuals disagree whether its number is sent in decimal or hexadecimal digits, and the wrong one would ' +
      'address another register. Set the option asciiZr (try it on a register whose value you know), use R, or binary code.'
    unknown.push({ of: ['ZR'], option: 'asciiZr', message })
  }
  return unknown
}

/** A request without its frame. */
interface Asked<T> extends Omit<Exchange<T>, OfFrame> {}

/** The commands as bodies, without frames: from both sides. */
export class SlmpCommandSet {
  readonly profile: Profile
  readonly code: DataCode
  /** Bytes in front of the data of a request: command, subcommand, fixed values. */
  readonly dataAt: number
  readonly #moduleIo: number | undefined
  /** Form bits that are settings of the port and not part of the subcommand. */
  readonly #digitBits: number
  readonly #unknownDigits: readonly UnknownDigits[]
  readonly #layout: BodyLayout

  constructor(options: CommandSetOptions) {
    this.#layout = options.body ?? plainBody
    this.dataAt = measure({ ...commandFields, ...this.#layout.reserved }, { ascii: options.code === 'ascii', form: 0 })
    this.profile = options.profile
    this.code = options.code
    this.#moduleIo = options.moduleIo
    this.#digitBits =
      (options.asciiXy === 'octal' ? FORM_XY_OCTAL : 0) | (options.asciiZr === 'hexadecimal' ? FORM_ZR_HEX : 0)
    this.#unknownDigits = unknownDigits(options)
  }

  /**
   * The body of a request. Everything that cannot be sent is refused here.
   * @throws RequestError with what is wrong, where, and what to do.
   */
  protected asked<C extends Command>(
    command: C,
    message: RequestOf<C>,
    options: ExchangeOptions,
  ): Asked<ResponseOf<C>> {
    const bag: Message = message
    const form = this.#formOf(command, bag, options)
    checkLimits(this.profile, command.name, form, this.code, bag)
    const subcommand = subcommandOf(command, form, this.profile, options.subcommand)
    const bits = codecBits(command, form, subcommand) | this.#digitBits
    const writer = writerOf(this.code, bits)
    writer.uint(command.code, 2)
    writer.uint(subcommand, 2)
    encode(this.#layout.reserved, {}, writer)
    encode(command.request, bag, writer)
    const body = writer.take()
    // What was sent counts, not an object that the caller may change before the answer comes.
    const sent: Message = decode(command.request, readerOf(this.code, body.subarray(this.dataAt), bits))
    checkTarget(this.profile, command, sent, this.#moduleIo)
    const context = this.#contextOf(command, sent, options)
    return {
      title: command.title,
      effect: command.effect,
      message: sent,
      body,
      answered: command.answered !== 'no',
      responseLength: () => measure(command.response, { ascii: this.code === 'ascii', form: bits, context }),
      decode: (frame) => this.#decode(command, subcommand, bits, context, frame),
    }
  }

  /**
   * Refuses what `exchange` would refuse, as far as addresses and limits go, without making the request.
   * @throws RequestError as `exchange`
   */
  check<C extends Command>(command: C, message: RequestOf<C>): void {
    const form = this.#formOf(command, message, {})
    checkLimits(this.profile, command.name, form, this.code, message)
    checkTarget(this.profile, command, message, this.#moduleIo)
  }

  /** Bytes of the bodies of a request in this form and of a success, without writing them. */
  bodyBytes<C extends Command>(command: C, message: RequestOf<C>, form: DeviceForm): number {
    const bits = codecBits(command, form, subcommandOf(command, form, this.profile)) | this.#digitBits
    const known = { ascii: this.code === 'ascii', form: bits }
    const context = { shape: command.request, message }
    return (
      this.dataAt + measure(command.request, { ...known, message }) + measure(command.response, { ...known, context })
    )
  }

  #formOf(command: Command, message: Message, options: ExchangeOptions): DeviceForm {
    const found = devicesOf(command, message)
    if (this.#unknownDigits.length > 0) this.#refuseUnknownDigits(found.map(({ address }) => address.device))
    return chooseForm(this.profile, command, found, this.code, this.#digitBits, options.form)
  }

  #refuseUnknownDigits(devices: readonly string[]): void {
    for (const { of, message, option } of this.#unknownDigits) {
      const device = devices.find((name) => of.includes(name))
      if (device !== undefined) throw new RequestError('BAD_OPTION', `${device} in ASCII code: ${message}`, option)
    }
  }

  #contextOf(command: Command, message: Message, options: ExchangeOptions): Context {
    if (command.context === undefined) return { shape: command.request, message }
    if (options.context === undefined) {
      throw new RequestError(
        'BAD_MESSAGE',
        `${command.title} needs the message of ${command.context} it refers to (option context).`,
        'context',
      )
    }
    const asked = commandOf(command.context)
    const bits = FORM_BITS[this.#formOf(asked, options.context, {})] | this.#digitBits
    const writer = writerOf(this.code, bits)
    encode(asked.request, options.context, writer)
    return { shape: asked.request, message: decode(asked.request, readerOf(this.code, writer.take(), bits)) }
  }

  #decode<C extends Command>(
    command: C,
    subcommand: number,
    form: number,
    context: Context,
    frame: ResponseFrame,
  ): ResponseOf<C> {
    if (frame.endCode !== 0) throw this.#refusal(command, subcommand, frame)
    const reader = readerOf(this.code, frame.body, form)
    // Where silence is the success there is no answer that could repeat anything.
    const isSilence = command.answered === 'no' && frame.body.length === 0
    if (this.#layout.echoed && !isSilence) this.#checkEcho(command, subcommand, reader)
    const message = decode<C['response']>(command.response, reader, context)
    reader.end()
    return message
  }

  /** Command, subcommand and fixed values in front of the data of an answer (SLMP reference manual 4.2). */
  #checkEcho(command: Command, subcommand: number, reader: Reader): void {
    const found = decode(commandFields, reader)
    if (found.command !== command.code || found.subcommand !== subcommand) {
      throw new ProtocolError(
        'ECHO_MISMATCH',
        `The answer is about ${codes(found)}, not ${codes({ command: command.code, subcommand })}.`,
        { field: found.command === command.code ? 'subcommand' : 'command' },
      )
    }
    decode(this.#layout.reserved, reader)
  }

  #refusal(command: Command, subcommand: number, frame: ResponseFrame): EndCodeError {
    const information = this.#errorInformation(frame.body)
    // Devices that shorten the error information still say in an echo which request they refuse.
    if (information === undefined && this.#layout.echoed && frame.body.length >= this.dataAt) {
      this.#checkEcho(command, subcommand, readerOf(this.code, frame.body))
    }
    if (information !== undefined && (information.command !== command.code || information.subcommand !== subcommand)) {
      throw new ProtocolError(
        'ECHO_MISMATCH',
        `The answer with end code ${hex(frame.endCode, 4)} is about ${codes(information)}, not ${codes({ command: command.code, subcommand })}.`,
        { field: information.command === command.code ? 'subcommand' : 'command' },
      )
    }
    const { endCode } = frame
    const station = information === undefined ? undefined : describeRoute(information)
    const facts = factsOf.slmp.refusal(command, endCode)
    const { texts, sentences } = refusalTexts('slmp', { endCode, commandName: command.name })
    const reporter = station === undefined ? '' : ` (Reported by ${station}.)`
    return new EndCodeError(
      endCode,
      `${command.title} ${endedWith(facts, `end code ${hex(endCode, 4)}`)}: ${sentences}${reporter}`,
      {
        family: 'slmp',
        ...facts,
        ...(station === undefined ? {} : { station }),
        ...texts,
      },
    )
  }

  /** The error information, when the answer holds all of it: serial frames have none, and devices exist that shorten it. */
  #errorInformation(body: Buffer): ErrorInformation | undefined {
    const { errorInformation } = this.#layout
    if (errorInformation === undefined) return undefined
    if (body.length < measure(errorInformation, { ascii: this.code === 'ascii', form: 0 })) return undefined
    return decode(errorInformation, readerOf(this.code, body))
  }

  /**
   * The PLC's side: which command with which message a body is.
   * @throws ProtocolError when the message does not fit the command (a CPU answers an end code to it).
   */
  readRequest(frame: Pick<RequestFrame, 'body'>): ReceivedRequest | UnknownRequest {
    const read = this.#read(frame.body)
    if ('unknown' in read) return read
    const { request, reader } = read
    reader.end()
    return request
  }

  /**
   * The PLC's side, where frames carry no length (format 1 of 3C and 4C): how long the body of a request is.
   * `undefined` when more bytes are needed.
   * @throws ProtocolError when the bytes are no request that is known: nobody can tell where it ends.
   */
  requestLength(soFar: Buffer): number | undefined {
    try {
      const read = this.#read(soFar)
      if ('reader' in read) return this.dataAt + read.reader.position
      throw new ProtocolError('BAD_FIELD', `There is no ${codes(read.unknown)}.`)
    } catch (error) {
      if (error instanceof ProtocolError && error.code === 'TRUNCATED') return undefined
      throw error
    }
  }

  /** A request at the front of the bytes, and where its reader has come to. */
  #read(body: Buffer): { readonly request: ReceivedRequest; readonly reader: Reader } | UnknownRequest {
    const head = readerOf(this.code, body)
    const code = head.uint(2)
    const subcommand = head.uint(2)
    decode(this.#layout.reserved, head)
    const known = findCommand(commands, this.profile, code, subcommand)
    if (known === undefined) return { unknown: { command: code, subcommand } }
    const { command, form } = known
    const bits = codecBits(command, form, subcommand) | this.#digitBits
    const reader = readerOf(this.code, body.subarray(head.position), bits)
    const message = decode(command.request, reader)
    return { request: { command, form, name: command.name, subcommand, message }, reader }
  }

  /** The PLC's side: the data of the answer. `context` is the request, or for Execute Monitor the registration. */
  writeResponse<C extends Command>(
    request: ReceivedRequest & { command: C },
    response: Message,
    context: Message = request.message,
  ): Buffer {
    const { command, form, subcommand } = request
    const writer = writerOf(this.code, codecBits(command, form, subcommand) | this.#digitBits)
    if (this.#layout.echoed) {
      encode(commandFields, { command: command.code, subcommand }, writer)
      encode(this.#layout.reserved, {}, writer)
    }
    const { request: shape } = command.context === undefined ? command : commandOf(command.context)
    encode(command.response, response, writer, { shape, message: context })
    return writer.take()
  }

  /** The PLC's side: what stands behind an end code other than 0. */
  writeErrorInformation(information: ErrorInformation): Buffer {
    const writer = writerOf(this.code)
    const { errorInformation } = this.#layout
    if (errorInformation !== undefined) encode(errorInformation, information, writer)
    return writer.take()
  }
}

/** The command set in a frame: what a client sends and reads. */
export class MelsecProtocol<H extends Head> extends SlmpCommandSet {
  readonly framing: MelsecProtocolOptions<H>['framing']
  readonly lineCost: LineCost | undefined
  readonly #head: H
  readonly #connectedHead: H

  constructor({ framing, head, connectedHead = head, turnRound = 0, ...options }: MelsecProtocolOptions<H>) {
    super(framing.body === undefined ? options : { ...options, body: framing.body })
    this.framing = framing
    this.lineCost = lineCostOf({ framing, head }, turnRound)
    this.#head = head
    this.#connectedHead = connectedHead
  }

  /**
   * A request ready to be sent. Everything that cannot be sent is refused here.
   * @throws RequestError with what is wrong, where, and what to do.
   */
  exchange<C extends Command>(
    command: C,
    message: RequestOf<C>,
    options: ExchangeOptions = {},
  ): Exchange<ResponseOf<C>> {
    const asked = this.asked(command, message, options)
    this.framing.checkBody?.(asked.body)
    const head = command.to === 'connected' ? this.#connectedHead : this.#head
    return { ...asked, ...framed({ framing: this.framing, head }, asked) }
  }

  /** Bytes of the frame of an answer with this body. */
  answerBytes(body: number): number {
    return answerBytes({ framing: this.framing, head: this.#head }, body)
  }
}

function codes({ command, subcommand }: { readonly command: number; readonly subcommand: number }): string {
  return `command ${hex(command, 4)}, subcommand ${hex(subcommand, 4)}`
}

/** The command whose message another one refers to. @throws TypeError when none is declared under this name */
function commandOf(context: string): Command {
  const found: Command | undefined = Object.values<Command>(commands).find(({ name }) => name === context)
  if (found === undefined) throw new TypeError(`There is no command ${context} to refer to`)
  return found
}
