// The 1C frame on a serial port: its requests in the terms of the handlers, their answers and refusals in its own (FX5
// communication manual 44 and 47.2).
import { decode, type Message, readerOf } from '../codec/codec'
import { PlcError, ProtocolError } from '../errors'
import type { HeadProtocol, NamedCommand, RequestFrame } from '../link/link'
import type { DeviceProblem } from '../melsec/a-compatible/device-rules'
import { isSaid, type SaidName } from '../melsec/a-compatible/names'
import type { SerialHead } from '../melsec/frame/serial-frames'
import type { SerialFraming } from '../melsec/frame/serial-framing'
import { isOneC, type OneCCommandName } from '../melsec/one-c/commands'
import { frontShape } from '../melsec/one-c/front'
import { over1c } from '../melsec/one-c/names'
import { oneCProtocol } from '../melsec/one-c/protocol'
import { oneCRules } from '../melsec/one-c/rules'
import type { Profile } from '../melsec/profiles/profile'
import { type Translated, translated } from './other-set'
import { Refusal } from './refusal'

/** Codes behind NAK (47.2). */
export const nak1c = { sum: 0x02, protocol: 0x03, characters: 0x06, data: 0x07, pc: 0x10, remote: 0x18 } as const

const END_CODES: Readonly<Record<DeviceProblem['kind'], number>> = {
  device: nak1c.characters,
  points: nak1c.characters,
  range: nak1c.characters,
  head: nak1c.characters,
}

/** Characters of command and message wait in front of the data. */
const FRONT = 3

const saidBy = new Map<OneCCommandName, SaidName>(
  Object.entries(over1c).flatMap(([said, names]) =>
    isSaid(said) ? names.map((name): readonly [OneCCommandName, SaidName] => [name, said]) : [],
  ),
)

/** The global signal: no command of the SLMP set says it. */
export interface GlobalSignal {
  readonly name: 'GW'
  readonly on: boolean
}

export class OneCPort {
  readonly #profile: Profile
  readonly #protocol: HeadProtocol<SerialHead>

  constructor(profile: Profile, framing: SerialFraming, asciiXy: 'octal' | 'hexadecimal') {
    this.#profile = profile
    this.#protocol = oneCProtocol({ framing, head: { station: 0, pc: 0xff }, asciiXy })
  }

  /** Length of a request's body; `undefined` when more is needed. @throws ProtocolError when nobody can tell */
  requestLength(head: SerialHead, soFar: Buffer): number | undefined {
    return this.#protocol.requestLength(head, soFar)
  }

  /** ms before the answer at the earliest; 0 where the request does not say it. */
  waitOf(body: Buffer): number {
    try {
      return decode(frontShape, readerOf('ascii', body)).messageWait
    } catch (error) {
      if (error instanceof PlcError) return 0
      throw error
    }
  }

  /** @throws Refusal with a code of NAK */
  read(frame: RequestFrame<SerialHead>): Translated | GlobalSignal {
    const { command, message } = this.#request(frame)
    const { name } = command
    if (!isOneC(name)) throw new TypeError(`1C has no ${name}`)
    if (name === 'GW') return { name, on: message.on === true }
    const said = saidBy.get(name)
    if (said === undefined) throw new TypeError(`the handlers have nothing for ${name}`)
    return {
      name: said,
      message: translated({ rules: oneCRules, endCodes: END_CODES, exclusions: [] }, name, said, message),
      respond: (response) => {
        const asked = name === 'PC' ? { typeCode: this.#profile.aCompatible?.typeCode ?? 0 } : response
        return this.#protocol.writeResponse(command, message, asked)
      },
    }
  }

  #request(frame: RequestFrame<SerialHead>): { readonly command: NamedCommand; readonly message: Message } {
    try {
      return this.#protocol.readRequest(frame)
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      throw new Refusal(this.#codeOf(error, frame), error.message)
    }
  }

  /** An unknown command cannot be measured either; what is wrong in a known one is a device or the data written. */
  #codeOf(error: PlcError, frame: RequestFrame<SerialHead>): number {
    if (!this.#isKnown(frame)) return nak1c.protocol
    if (error.code !== 'BAD_DIGIT') return nak1c.characters
    const field = error instanceof ProtocolError ? (error.field ?? '') : ''
    return /values|value$/.test(field) ? nak1c.data : nak1c.characters
  }

  #isKnown({ head, body }: RequestFrame<SerialHead>): boolean {
    try {
      // With nothing behind its front a request that is known asks for more, or is whole.
      this.#protocol.requestLength(head, body.subarray(0, FRONT))
      return true
    } catch (error) {
      if (error instanceof PlcError) return false
      throw error
    }
  }

  /** The refusal of a handler, whose end codes are those of the SLMP set, in 1C. */
  refusalOf(refusal: Refusal): Refusal {
    const { remote, notInStop } = this.#profile.refusals
    if (refusal.endCode <= 0xff) return refusal
    const isRemote = refusal.endCode === remote || refusal.endCode === notInStop
    return new Refusal(isRemote ? nak1c.remote : nak1c.characters, refusal.message)
  }
}
