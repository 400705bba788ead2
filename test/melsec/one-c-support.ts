/** The 1C command set, and a PLC that speaks it: words and bits by the names that they have in the frame. */
import type { Message } from '../../src/codec/codec'
import type { Exchange, HeadProtocol, NamedCommand, RequestFrame } from '../../src/link/link'
import { deviceInfo } from '../../src/melsec/device/device'
import type { SerialHead } from '../../src/melsec/frame/serial-frames'
import { type SerialFrameOptions, type SerialFraming, serialFraming } from '../../src/melsec/frame/serial-framing'
import { isOneC, oneCCommands } from '../../src/melsec/one-c/commands'

export const HEAD_1C: SerialHead = { station: 0, pc: 0xff }

export function framing1c(format: 1 | 4 = 1, options: Partial<SerialFrameOptions> = {}): SerialFraming {
  return serialFraming({ frame: '1C', format, ...options })
}

export function command(name: string): NamedCommand {
  if (!isOneC(name)) throw new Error(`no command ${name}`)
  return oneCCommands[name]
}

interface Address {
  readonly device: Parameters<typeof deviceInfo>[0]
  readonly number: number
}

/** Written from the manual, without the rules of src: it takes whatever the frame says. */
export class Plc1c {
  /** Name and message of each request. */
  readonly seen: { readonly name: string; readonly message: Message }[] = []
  readonly #words = new Map<string, number>()
  readonly #bits = new Map<string, boolean>()

  constructor(private readonly protocol: HeadProtocol<SerialHead>) {}

  bit({ device, number }: Address): boolean {
    return this.#bits.get(`${device}${number}`) ?? false
  }

  setBit({ device, number }: Address, on: boolean): void {
    this.#bits.set(`${device}${number}`, on)
  }

  word({ device, number }: Address): number {
    if (deviceInfo(device).unit !== 'bit') return this.#words.get(`${device}${number}`) ?? 0
    return Array.from({ length: 16 }, (_, i) => (this.bit({ device, number: number + i }) ? 1 << i : 0)).reduce(
      (a, b) => a | b,
    )
  }

  setWord({ device, number }: Address, word: number): void {
    if (deviceInfo(device).unit !== 'bit') this.#words.set(`${device}${number}`, word)
    else for (let i = 0; i < 16; i++) this.setBit({ device, number: number + i }, (word & (1 << i)) !== 0)
  }

  /** As a planner sends. */
  readonly send = <T>(exchange: Exchange<T>): Promise<T> => {
    const { framing } = this.protocol
    const request = framing.request.scan(exchange.write(0), (head, soFar) => this.protocol.requestLength(head, soFar))
    if (request === undefined) throw new Error('the request is not whole')
    const answer = framing.response.write(request.frame.head, 0, 0, this.answer(request.frame).body)
    const response = framing.response.scan(answer, exchange.responseLength)
    if (response === undefined) throw new Error('the answer is not whole')
    return Promise.resolve(exchange.decode(response.frame))
  }

  answer(frame: RequestFrame<SerialHead>): { readonly endCode: number; readonly body: Buffer } {
    const { command: asked, message } = this.protocol.readRequest(frame)
    this.seen.push({ name: asked.name, message })
    const response = this.#carriedOut(asked.name, message)
    return { endCode: 0, body: this.protocol.writeResponse(asked, message, response) }
  }

  #carriedOut(name: string, message: Message): Message {
    const head = message.head as Address
    const at = (i: number, step = 1): Address => ({ ...head, number: head.number + step * i })
    const step = head !== undefined && deviceInfo(head.device).unit === 'bit' ? 16 : 1
    switch (name) {
      case 'BR':
        return { values: Array.from({ length: Number(message.points) }, (_, i) => this.bit(at(i))) }
      case 'WR':
      case 'QR':
        return { values: Array.from({ length: Number(message.points) }, (_, i) => this.word(at(i, step))) }
      case 'BW':
        for (const [i, value] of (message.values as boolean[]).entries()) this.setBit(at(i), value)
        return {}
      case 'WW':
      case 'QW':
        for (const [i, value] of (message.values as number[]).entries()) this.setWord(at(i, step), value)
        return {}
      case 'BT':
        for (const { device, value } of message.bits as { device: Address; value: boolean }[])
          this.setBit(device, value)
        return {}
      case 'WT':
      case 'QT':
        for (const { device, value } of message.words as { device: Address; value: number }[])
          this.setWord(device, value)
        return {}
      case 'PC':
        return { typeCode: 0xf3 }
      case 'TT':
        return { data: message.data }
      default:
        return {}
    }
  }
}
