/**
 * Requests of the SLMP set in 1E frames, for a client: the ones that 1E can say, said in its way. What it cannot say is
 * in the profile as lacking, so that the planner goes without it.
 */
import { decode, encode, type Message, readerOf, writerOf } from '../../codec/codec'
import { RequestError } from '../../errors'
import type { Exchange, FrameExplainer, Framing, HeadProtocol, NamedCommand } from '../../link/link'
import type { ClientProtocol, ProtocolOptions, ShownAs } from '../client-protocol'
import type { Command, RequestOf, ResponseOf } from '../commands/command'
import { type DeviceAddress, deviceInfo } from '../device/device'
import { explainer1e } from '../explain/explainer-1e'
import type { Head1e } from '../frame/frame-1e'
import { ownStation, type Route } from '../frame/route'
import { profileOver1e } from '../profiles/over-1e'
import { lackOf, type Profile } from '../profiles/profile'
import type { ExchangeOptions } from '../protocol'
import { aCompatibleCommands } from './commands'
import { isOver1e, over1e } from './names'
import { type ACompatibleOptions, aCompatibleProtocol } from './protocol'
import type { ACompatibleFamily } from './rules'
import { type DeviceWindow, windowOf } from './windows'

const NO_NAME = ''
const NAME_LENGTH = 16

/** A request of 1E and what of its answer is wanted. */
interface Said {
  readonly command: NamedCommand
  readonly message: Message
  readonly answer: (message: Message) => Message
}

const asItIs = (message: Message): Message => message
const nothing = (): Message => ({})

/**
 * 1E reaches the connected station only.
 * @throws RequestError BAD_OPTION when the PLC does not take 1E, or for another route
 */
export function protocolOver1e(options: ProtocolOptions): ClientProtocol {
  return new SlmpOver1e(options)
}

function familyOf({ aCompatible, title }: Profile): ACompatibleFamily {
  if (aCompatible !== undefined) return aCompatible
  throw new RequestError('BAD_OPTION', `${title} has no 1E frame here: use 3E.`, 'frame')
}

function refuseOtherStations(route: Route): void {
  for (const name of ['network', 'station', 'moduleIo', 'multidrop'] as const) {
    if (route[name] === ownStation[name]) continue
    throw new RequestError(
      'BAD_OPTION',
      `A 1E frame reaches the connected station only: leave out route.${name}.`,
      'route',
    )
  }
}

class SlmpOver1e implements ClientProtocol {
  readonly framing: Framing<Head1e>
  readonly profile: Profile
  readonly code: ACompatibleOptions['code']
  readonly #protocol: HeadProtocol<Head1e>
  readonly #family: ACompatibleFamily
  readonly #asciiXy: ProtocolOptions['asciiXy']

  constructor({ profile, route, code, asciiXy, timer }: ProtocolOptions) {
    refuseOtherStations(route)
    this.#family = familyOf(profile)
    this.#protocol = aCompatibleProtocol({ code, asciiXy, timer, family: this.#family })
    this.framing = this.#protocol.framing
    this.#asciiXy = asciiXy
    this.profile = profileOver1e(profile, this.#family)
    this.code = code
  }

  answerBytes(body: number): number {
    return this.framing.response.write({ command: 0, pc: 0, timer: 0 }, 0, 0, Buffer.alloc(body)).length
  }

  explainer(shownAs: ShownAs): FrameExplainer {
    return explainer1e({ code: this.code, profile: this.profile, asciiXy: this.#asciiXy, ...shownAs })
  }

  /** @throws RequestError when 1E cannot say it. */
  exchange<C extends Command>(
    command: C,
    message: RequestOf<C>,
    options: ExchangeOptions = {},
  ): Exchange<ResponseOf<C>> {
    const given: Message = message
    this.#check(command, options)
    const said = this.#said(command.name, given)
    const asked = this.#protocol.exchange(said.command, said.message)
    return {
      ...asked,
      effect: command.effect,
      message: given,
      decode: (frame) => answered(command, given, said.answer(asked.decode(frame))),
    }
  }

  /** @throws RequestError as `exchange` */
  check<C extends Command>(command: C, message: RequestOf<C>): void {
    this.exchange(command, message)
  }

  bodyBytes<C extends Command>(command: C, message: RequestOf<C>): number {
    const { body, answerBody } = this.exchange(command, message)
    return body.length + (answerBody() ?? 0)
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
      throw new RequestError('UNSUPPORTED', 'A 1E frame has no forms of the device specification.', 'form')
    }
  }

  #said(name: string, message: Message): Said {
    if (!isOver1e(name)) throw new RequestError('UNSUPPORTED', `A 1E frame has no command ${name}.`, name)
    const command: NamedCommand = aCompatibleCommands[over1e[name]]
    switch (name) {
      case 'readBits':
        return this.#evenBits(command, message)
      case 'writeBits':
        return this.#writtenBits(command, message)
      case 'writeRandomWords':
        return { command, message: { words: wordsOf(message) }, answer: nothing }
      case 'remoteRun':
        return { command, message: runOf(message), answer: nothing }
      case 'remoteStop':
        return { command, message: {}, answer: nothing }
      case 'readTypeName':
        return { command, message: {}, answer: ({ typeCode }) => typeName(typeCode) }
      case 'selfTest':
      case 'readWords':
      case 'writeWords':
      case 'writeRandomBits':
        return { command, message, answer: asItIs }
      default:
        return name satisfies never
    }
  }

  /** Whether a dummy follows an odd number of bits in ASCII code is not known: none is asked for then. */
  #avoidsOdd(count: number): boolean {
    return this.code === 'ascii' && this.#family.oddBits === undefined && count % 2 === 1
  }

  #evenBits(command: NamedCommand, message: Message): Said {
    const { head, points } = message
    const window = isAddress(head) ? windowOf(this.#family.windows, head) : undefined
    if (typeof points !== 'number' || !this.#avoidsOdd(points) || window === undefined || !isAddress(head)) {
      return { command, message, answer: asItIs }
    }
    const isLast = head.number + points >= endOf(window)
    const from = isLast ? { ...head, number: head.number - 1 } : head
    const skip = isLast ? 1 : 0
    return {
      command,
      message: { ...message, head: from, points: points + 1 },
      answer: ({ values }) => ({ values: Array.isArray(values) ? values.slice(skip, skip + points) : values }),
    }
  }

  /** One by one instead, which needs no dummy and writes the same. */
  #writtenBits(command: NamedCommand, message: Message): Said {
    const { head, values } = message
    if (!isAddress(head) || !Array.isArray(values) || !this.#avoidsOdd(values.length)) {
      return { command, message, answer: nothing }
    }
    const bits = Array.from(values, (value: unknown, i) => ({ device: { ...head, number: head.number + i }, value }))
    return { command: aCompatibleCommands.writeRandomBits, message: { bits }, answer: nothing }
  }
}

function endOf({ number, points }: DeviceWindow): number {
  return number + points
}

/** The answer as the command of the SLMP set declares it. */
function answered<C extends Command>(command: C, request: Message, answer: Message): ResponseOf<C> {
  const context = { shape: command.request, message: request }
  const writer = writerOf('binary')
  encode(command.response, answer, writer, context)
  return decode<C['response']>(command.response, readerOf('binary', writer.take()), context)
}

/** 1E tells no name. The code fits none of the SLMP set, so that nobody takes it for one of its models. */
function typeName(typeCode: unknown): Message {
  return { model: NO_NAME.padEnd(NAME_LENGTH), modelCode: typeCode }
}

function runOf({ mode, clearMode = 0 }: Message): Message {
  if (mode !== 1) {
    throw new RequestError('UNSUPPORTED', 'A 1E frame cannot force RUN: leave force out, or use a 3E frame.', 'mode')
  }
  if (clearMode !== 0) {
    throw new RequestError('UNSUPPORTED', 'RUN by a 1E frame clears no devices: leave clear at keep.', 'clearMode')
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

function isAddress(value: unknown): value is DeviceAddress {
  return typeof value === 'object' && value !== null && 'device' in value
}
