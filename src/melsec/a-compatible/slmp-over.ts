/**
 * Requests of the SLMP set in frames that have a set of their own (1E, 1C), for a client: the ones that the frame can say,
 * said in its way. What it cannot say is in the profile as lacking, so that the planner goes without it.
 */
import { type DataCode, decode, encode, type Message, readerOf, writerOf } from '../../codec/codec'
import { RequestError } from '../../errors'
import {
  answerBytes,
  type Exchange,
  type FrameExplainer,
  type Framing,
  type Head,
  type HeadProtocol,
  type NamedCommand,
} from '../../link/link'
import type { ClientProtocol, ShownAs } from '../client-protocol'
import type { Command, RequestOf, ResponseOf } from '../commands/command'
import { deviceInfo } from '../device/device'
import { type LineCost, lineCostOf } from '../line-cost'
import { lackOf, type Profile } from '../profiles/profile'
import type { ExchangeOptions } from '../protocol'
import { isAddress } from './frame-names'
import { isSaid, type SaidName } from './names'

const NO_NAME = ''
const NAME_LENGTH = 16

/** A request of the frame's own set and what of its answer is wanted. */
export interface Said {
  readonly command: NamedCommand
  readonly message: Message
  readonly answer: (message: Message) => Message
}

/** A frame with a set of its own, as a client speaks it. */
export interface OtherSet<H extends Head> {
  /** For people: `1E`. */
  readonly frame: string
  /** Another frame that says more. */
  readonly instead: string
  readonly protocol: HeadProtocol<H>
  /** Narrowed to what the frame says. */
  readonly profile: Profile
  readonly code: DataCode
  /** Of an answer, whatever it says: heads are of one length. */
  readonly anyHead: H
  /** On a serial line: waits of each request, as bytes that the line could carry. */
  readonly turnRound?: number
  readonly said: (name: SaidName, message: Message) => Said
  /** How the frame calls the command, with its number or name. */
  readonly nameOf: (name: SaidName) => string
  readonly explainer: (shownAs: ShownAs) => FrameExplainer
  readonly globalSignal?: NonNullable<ClientProtocol['globalSignal']>
}

export const asItIs = (message: Message): Message => message
export const nothing = (): Message => ({})

export class SlmpOver<H extends Head> implements ClientProtocol {
  readonly framing: Framing<H>
  readonly profile: Profile
  readonly code: DataCode
  readonly lineCost: LineCost | undefined
  readonly globalSignal?: NonNullable<ClientProtocol['globalSignal']>
  /** The frame's own commands, also those that the SLMP set does not have. */
  readonly own: HeadProtocol<H>
  readonly #set: OtherSet<H>

  constructor(set: OtherSet<H>) {
    this.#set = set
    this.own = set.protocol
    this.framing = set.protocol.framing
    this.profile = set.profile
    this.code = set.code
    this.lineCost = lineCostOf({ framing: this.framing, head: set.anyHead }, set.turnRound)
    if (set.globalSignal !== undefined) this.globalSignal = set.globalSignal
  }

  answerBytes(body: number): number {
    return answerBytes({ framing: this.framing, head: this.#set.anyHead }, body)
  }

  nameOf({ name, title }: Command): string {
    return isSaid(name) ? this.#set.nameOf(name) : title
  }

  explainer(shownAs: ShownAs): FrameExplainer {
    return this.#set.explainer(shownAs)
  }

  /** @throws RequestError when the frame cannot say it. */
  exchange<C extends Command>(
    command: C,
    message: RequestOf<C>,
    options: ExchangeOptions = {},
  ): Exchange<ResponseOf<C>> {
    const given: Message = message
    this.#check(command, options)
    const { said, protocol } = this.#set
    const { command: own, message: asked, answer } = said(this.#nameOf(command), given)
    const exchange = protocol.exchange(own, asked)
    return {
      ...exchange,
      effect: command.effect,
      message: given,
      decode: (received) => answered(command, given, answer(exchange.decode(received))),
    }
  }

  /** @throws RequestError as `exchange` */
  check<C extends Command>(command: C, message: RequestOf<C>): void {
    this.exchange(command, message)
  }

  bodyBytes<C extends Command>(command: C, message: RequestOf<C>): number {
    const { said, protocol } = this.#set
    const { command: own, message: asked } = said(this.#nameOf(command), message)
    return protocol.bodyBytes(own, asked)
  }

  #nameOf({ name }: Command): SaidName {
    if (isSaid(name)) return name
    throw new RequestError('UNSUPPORTED', `A ${this.#set.frame} frame has no command ${name}.`, name)
  }

  #check(command: Command, options: ExchangeOptions): void {
    const lack = lackOf(this.profile, command.name)
    if (lack !== undefined) {
      throw new RequestError(
        'UNSUPPORTED',
        `${this.profile.title} does not have ${command.title}: ${lack.reason} ${lack.instead}`,
        command.name,
      )
    }
    if (options.form !== undefined) {
      const message = `A ${this.#set.frame} frame has no forms of the device specification.`
      throw new RequestError('UNSUPPORTED', message, 'form')
    }
  }
}

/** What the sets of 1E and 1C say alike, but for the names of their commands. */
export function saidAlike(
  { frame, instead }: Pick<OtherSet<Head>, 'frame' | 'instead'>,
  name: SaidName,
  message: Message,
): Omit<Said, 'command'> {
  switch (name) {
    case 'writeRandomWords':
      return { message: { words: wordsOf(message) }, answer: nothing }
    case 'remoteRun':
      return { message: runOf(frame, instead, message), answer: nothing }
    case 'remoteStop':
      return { message: {}, answer: nothing }
    case 'readTypeName':
      return { message: {}, answer: ({ typeCode }) => typeName(typeCode) }
    case 'selfTest':
    case 'readBits':
    case 'readWords':
    case 'writeBits':
    case 'writeWords':
    case 'writeRandomBits':
      return { message, answer: asItIs }
    default:
      return name satisfies never
  }
}

/** The answer as the command of the SLMP set declares it. */
function answered<C extends Command>(command: C, request: Message, answer: Message): ResponseOf<C> {
  const context = { shape: command.request, message: request }
  const writer = writerOf('binary')
  encode(command.response, answer, writer, context)
  return decode<C['response']>(command.response, readerOf('binary', writer.take()), context)
}

/** The frames tell no name. The code fits none of the SLMP set, so that nobody takes it for one of its models. */
function typeName(typeCode: unknown): Message {
  return { model: NO_NAME.padEnd(NAME_LENGTH), modelCode: typeCode }
}

function runOf(frame: string, instead: string, { mode, clearMode = 0 }: Message): Message {
  if (mode !== 1) {
    const message = `A ${frame} frame cannot force RUN: leave force out, or use a ${instead} frame.`
    throw new RequestError('UNSUPPORTED', message, 'mode')
  }
  if (clearMode !== 0) {
    const message = `RUN by a ${frame} frame clears no devices: leave clear at keep.`
    throw new RequestError('UNSUPPORTED', message, 'clearMode')
  }
  return {}
}

/** Double words as two words each: one request is carried out in one step all the same. */
function wordsOf({ words, doubleWords }: Message): readonly Message[] {
  const single = Array.isArray(words) ? (words as readonly Message[]) : []
  const pairs = Array.isArray(doubleWords) ? (doubleWords as readonly Message[]) : []
  return [...single, ...pairs.flatMap(halves)]
}

function halves({ device, value }: Message): Message[] {
  if (!isAddress(device) || typeof value !== 'number') return [{ device, value }]
  const next = deviceInfo(device.device).unit === 'bit' ? 16 : 1
  return [
    { device, value: value & 0xffff },
    { device: { ...device, number: device.number + next }, value: value >>> 16 },
  ]
}
