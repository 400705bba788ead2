/**
 * The 1E frame on a port: its requests in the terms of the handlers, their answers in its own. What the FX5 manual does
 * not say about refusals is background: the troubleshooting chapter of the FX3U-ENET-ADP user's manual.
 */
import { type DataCode, type Message, writerOf } from '../codec/codec'
import { PlcError } from '../errors'
import type { HeadProtocol, NamedCommand, RequestFrame } from '../link/link'
import { type ACompatibleCommandName, aCompatibleCommands } from '../melsec/a-compatible/commands'
import type { DeviceProblem } from '../melsec/a-compatible/device-rules'
import { slmpNameOf } from '../melsec/a-compatible/names'
import { aCompatibleProtocol } from '../melsec/a-compatible/protocol'
import { type ACompatibleFamily, aCompatibleRules, fx5Over1e, type OddBits } from '../melsec/a-compatible/rules'
import { type Head1e, mayEndWithZero, zeroBehind } from '../melsec/frame/frame-1e'
import type { Profile } from '../melsec/profiles/profile'
import { type Translated, translated } from './other-set'
import { Refusal } from './refusal'

/** End codes of 1E. */
const END = { command: 0x50, asciiConversion: 0x54, device: 0x56, points: 0x57, head: 0x58, cpu: 0x5b } as const
/** Abnormal codes behind end code 5B. */
const ABNORMAL = { pc: 0x10, remote: 0x18 } as const

const END_CODES: Readonly<Record<DeviceProblem['kind'], number>> = {
  device: END.device,
  points: END.points,
  range: END.points,
  head: END.head,
}

const CONNECTED_STATION = 0xff

export interface ACompatiblePortOptions {
  readonly profile: Profile
  readonly code: DataCode
  readonly asciiXy: 'octal' | 'hexadecimal'
  readonly oddBits: OddBits
}

export class ACompatiblePort {
  readonly #code: DataCode
  readonly #profile: Profile
  readonly #family: ACompatibleFamily
  readonly #protocol: HeadProtocol<Head1e>

  constructor({ profile, code, asciiXy, oddBits }: ACompatiblePortOptions) {
    this.#code = code
    this.#profile = profile
    this.#family = profile.aCompatible ?? fx5Over1e
    this.#protocol = aCompatibleProtocol({ code, asciiXy, oddBits, family: this.#family })
  }

  /** Where a request ends. One that cannot be read ends with what has arrived: nothing else tells its end. */
  readonly lengthOf = (head: Head1e, soFar: Buffer): number | undefined => {
    try {
      return this.#protocol.requestLength(head, soFar)
    } catch (error) {
      if (error instanceof PlcError) return soFar.length
      throw error
    }
  }

  /** @throws Refusal with an end code of 1E */
  read(frame: RequestFrame<Head1e>): Translated {
    const { command, name, message } = this.#request(frame)
    if (frame.head.pc !== CONNECTED_STATION) {
      throw new Refusal(END.cpu, `there is no station with PC No. ${frame.head.pc}`, ABNORMAL.pc)
    }
    return {
      name: slmpNameOf(name),
      message: translated(
        { rules: aCompatibleRules, endCodes: END_CODES, exclusions: this.#profile.exclusions1e ?? [] },
        name,
        slmpNameOf(name),
        message,
      ),
      respond: (response) => {
        const asked = name === 'readPcType' ? { typeCode: this.#family.typeCode } : response
        return this.#complete(command.code, 0, this.#protocol.writeResponse(command, message, asked))
      },
    }
  }

  /** With the byte 00H behind it, where this family sends one. */
  #complete(command: number, endCode: number, body: Buffer): Buffer {
    const hasZero = this.#family.zeroBehind && mayEndWithZero(command, endCode)
    return hasZero ? Buffer.concat([body, zeroBehind[this.#code]]) : body
  }

  #request(frame: RequestFrame<Head1e>): {
    readonly command: NamedCommand
    readonly name: ACompatibleCommandName
    readonly message: Message
  } {
    const known = Object.values(aCompatibleCommands).find(({ code }) => code === frame.head.command)
    if (known === undefined) throw new Refusal(END.command, `there is no command ${frame.head.command} in 1E`)
    try {
      return { ...this.#protocol.readRequest(frame), name: known.name }
    } catch (error) {
      if (!(error instanceof PlcError)) throw error
      throw new Refusal(this.#endCodeOf(error, frame.body), error.message)
    }
  }

  /** The device stands in front of everything else that can be wrong but the points of a random write. */
  #endCodeOf(error: PlcError, body: Buffer): number {
    if (error.code === 'BAD_DIGIT') return END.asciiConversion
    if (error.code !== 'BAD_FIELD') return END.points
    return body.length > 0 && /device code/.test(error.message) ? END.device : END.points
  }

  /** The refusal of a handler, whose end codes are those of the SLMP set, in 1E. */
  refusalOf(refusal: Refusal): Refusal {
    const { endCode, message, abnormal } = refusal
    const { deviceName, deviceNumber, remote, notInStop } = this.#profile.refusals
    const isRemote = endCode === remote || endCode === notInStop
    if (isRemote && abnormal === undefined) return new Refusal(END.cpu, message, ABNORMAL.remote)
    if (endCode <= 0xff) return refusal
    if (endCode === deviceNumber) return new Refusal(END.points, message)
    return endCode === deviceName ? new Refusal(END.device, message) : new Refusal(END.cpu, message, ABNORMAL.pc)
  }

  /** What stands behind an end code. */
  errorBody(command: number, endCode: number, abnormal: number = ABNORMAL.pc): Buffer {
    const writer = writerOf(this.#code)
    if (endCode === END.cpu) writer.uint(abnormal, 1)
    return this.#complete(command, endCode, writer.take())
  }
}
