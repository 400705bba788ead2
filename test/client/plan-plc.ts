// A PLC that is nothing but maps of words and bits, written from the manuals and without the planner's own ideas.
import { type ParsedItem, type RefusedItem, tryParseItem } from '../../src/client/item/item'
import type { ReadResult } from '../../src/client/item/item-value'
import type { SendExchange } from '../../src/client/plan/request'
import type { DataCode } from '../../src/codec/codec'
import type { Exchange } from '../../src/link/link'
import type { CommandName } from '../../src/melsec/commands/commands'
import { formatDevice } from '../../src/melsec/device/address'
import { type DeviceAddress, deviceInfo } from '../../src/melsec/device/device'
import { brokenLimit, type Measurable } from '../../src/melsec/device/limit'
import { ownStation } from '../../src/melsec/frame/route'
import { type SlmpHead, slmpFraming } from '../../src/melsec/frame/slmp-frame'
import type { ProfileId, ProfileOverrides } from '../../src/melsec/profiles/profile'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol, type SlmpCommandSet } from '../../src/melsec/protocol'

export function protocolOf(
  id: ProfileId,
  code: DataCode = 'binary',
  overrides?: ProfileOverrides,
): MelsecProtocol<SlmpHead> {
  return new MelsecProtocol({
    framing: slmpFraming('3E', code),
    head: { ...ownStation, timer: 16 },
    profile: resolveProfile(id, overrides),
    code,
    asciiXy: 'hexadecimal',
    asciiZr: 'decimal',
  })
}

/** Items as the client parses them for a profile. */
export function items(protocol: SlmpCommandSet, texts: readonly string[]): (ParsedItem | RefusedItem)[] {
  return texts.map((text) => tryParseItem(text, { xyRadix: protocol.profile.xyRadix }))
}

/** One request as the PLC saw it. */
export interface Seen {
  readonly name: CommandName
  readonly message: Readonly<Record<string, unknown>>
}

interface Point {
  readonly device: DeviceAddress
  readonly value?: number | boolean
}
interface Block {
  readonly head: DeviceAddress
  readonly points: number
  /** Of a block that is written. */
  readonly values?: readonly number[]
}

export class PlanPlc {
  readonly seen: Seen[] = []
  /** End code for an access to a device by a command, also in vain; 0: none. Bits and words are asked for one by one. */
  refuse: (device: string, command: CommandName) => number = () => 0
  readonly #words = new Map<string, number>()
  readonly #bits = new Map<string, boolean>()

  constructor(readonly protocol: SlmpCommandSet) {}

  get names(): CommandName[] {
    return this.seen.map(({ name }) => name)
  }

  /** Sends one request and reads its answer as the client does; writes show in the maps. */
  readonly send: SendExchange = async <T>(exchange: Exchange<T>): Promise<T> => {
    await Promise.resolve()
    const request = this.protocol.readRequest(exchange)
    if ('unknown' in request) throw new Error('the planner sent an unknown command')
    const { name, message, form } = request
    this.seen.push({ name, message })
    const { profile, code } = this.protocol
    // Lists and numbers only: every device command's message is measurable.
    const broken = brokenLimit(profile, name, form, code, message as Measurable)
    if (broken !== undefined) throw new Error(`${name} breaks the limit ${broken.limit.max}: ${broken.measured}`)
    const answer = this.#execute(name, message)
    if (typeof answer === 'number')
      return exchange.decode({ head: {}, serial: undefined, endCode: answer, body: Buffer.alloc(0) })
    return exchange.decode({
      head: {},
      serial: undefined,
      endCode: 0,
      body: this.protocol.writeResponse(request, answer),
    })
  }

  setWord(text: string, value: number): void {
    this.#words.set(text, value)
  }

  setBit(text: string, value: boolean): void {
    this.#bits.set(text, value)
  }

  /** Every device has a value from the start: words and bits that depend on the name and number only. */
  word(address: DeviceAddress): number {
    const text = nameOf(address)
    return this.#words.get(text) ?? hash(text) & 0xffff
  }

  bit(address: DeviceAddress): boolean {
    const text = nameOf(address)
    return this.#bits.get(text) ?? (hash(text) & 0x10) !== 0
  }

  /** Low and high word of a long timer, counter or index register. */
  doubleWord(address: DeviceAddress): [number, number] {
    const text = nameOf(address)
    return [
      this.#words.get(`${text} low`) ?? hash(`${text} low`) & 0xffff,
      this.#words.get(`${text} high`) ?? hash(`${text} high`) & 0xffff,
    ]
  }

  /** The device that is meant: index registers added, `@` followed. */
  resolve(address: DeviceAddress): DeviceAddress {
    const { index, indirect, extensionIndex: _, ...plain } = address
    const shift = index === undefined ? 0 : this.word({ device: 'Z', number: index.number }) % 100
    const shifted = { ...plain, number: plain.number + shift }
    if (indirect === undefined) return shifted
    return { device: 'R', number: this.word(shifted) % 1000 }
  }

  #execute(name: CommandName, message: Readonly<Record<string, unknown>>): Record<string, unknown> | number {
    let refusal = 0
    const touch = (address: DeviceAddress): DeviceAddress => {
      const real = this.resolve(address)
      refusal ||= this.refuse(nameOf(real), name)
      return real
    }
    const answer = this.#answer(name, message, touch)
    return refusal === 0 ? answer() : refusal
  }

  /** First finds every device (so that nothing is written when one is refused), then gives the answer. */
  #answer(
    name: CommandName,
    message: Readonly<Record<string, unknown>>,
    touch: (address: DeviceAddress) => DeviceAddress,
  ): () => Record<string, unknown> {
    const head = message.head as DeviceAddress
    const values = message.values as readonly number[] | undefined
    const lists = (key: string) => (message[key] ?? []) as readonly Point[]
    const blocks = (key: string) => (message[key] ?? []) as readonly Block[]
    switch (name) {
      case 'readBits': {
        const found = numbered(head, message.points as number, 1).map(touch)
        return () => ({ values: found.map((address) => this.bit(address)) })
      }
      case 'readWords': {
        const read = this.#reader(head, message.points as number, touch)
        return () => ({ values: read() })
      }
      case 'readRandom': {
        const words = lists('words').map(({ device }) => this.#reader(device, 1, touch))
        const doubles = lists('doubleWords').map(({ device }) => this.#reader(device, 2, touch))
        return () => ({
          words: words.map((read) => read()[0] ?? 0),
          doubleWords: doubles.map((read) => (read()[0] ?? 0) + (read()[1] ?? 0) * 0x10000),
        })
      }
      case 'readBlock': {
        const words = blocks('wordBlocks').map((block) => this.#reader(block.head, block.points, touch))
        const bits = blocks('bitBlocks').map((block) => this.#reader(block.head, block.points, touch))
        return () => ({ wordBlocks: words.map((read) => read()), bitBlocks: bits.map((read) => read()) })
      }
      case 'writeBits': {
        const found = numbered(head, values?.length ?? 0, 1).map(touch)
        return () => {
          found.forEach((address, i) => {
            this.setBit(nameOf(address), Boolean(values?.[i]))
          })
          return {}
        }
      }
      case 'writeWords': {
        const write = this.#writer(head, values ?? [], touch)
        return () => {
          write()
          return {}
        }
      }
      case 'writeRandomBits': {
        const found = lists('bits').map(({ device, value }) => ({ address: touch(device), value: value === true }))
        return () => {
          for (const { address, value } of found) this.setBit(nameOf(address), value)
          return {}
        }
      }
      case 'writeRandomWords': {
        const writes = [
          ...lists('words').map(({ device, value }) => this.#writer(device, [Number(value)], touch)),
          ...lists('doubleWords').map(({ device, value }) =>
            this.#writer(device, [Number(value) & 0xffff, Number(value) >>> 16], touch),
          ),
        ]
        return () => {
          for (const write of writes) write()
          return {}
        }
      }
      case 'writeBlock': {
        const writes = [...blocks('wordBlocks'), ...blocks('bitBlocks')].map((block) =>
          this.#writer(block.head, block.values ?? [], touch),
        )
        return () => {
          for (const write of writes) write()
          return {}
        }
      }
      default:
        throw new Error(`the planner sent ${name}`)
    }
  }

  /** Words from a head device on, as word units mean it. */
  #reader(head: DeviceAddress, points: number, touch: (address: DeviceAddress) => DeviceAddress): () => number[] {
    const { unit, name, wordsPerDevice = 2 } = deviceInfo(head.device)
    const first = touch(head)
    if (unit === 'doubleWord') {
      const found = numbered(first, Math.ceil(points / wordsPerDevice), 1).map(touch)
      if (points !== 2 && points % wordsPerDevice !== 0) throw new Error(`${name} is read by ${points} words`)
      return () => found.flatMap((address) => this.#record(address, wordsPerDevice)).slice(0, points)
    }
    if (unit === 'word') {
      const found = numbered(first, points, 1).map(touch)
      return () => found.map((address) => this.word(address))
    }
    const found = numbered(first, 16 * points, 1).map(touch)
    return () => Array.from({ length: points }, (_, word) => packed(found.slice(16 * word), (bit) => this.bit(bit)))
  }

  #record(address: DeviceAddress, words: number): number[] {
    const value = this.doubleWord(address)
    if (words === 2) return value
    const group = deviceInfo(address.device).group ?? ''
    const coil = this.#bitOf(`${group}C`, address) ? 1 : 0
    const contact = this.#bitOf(`${group}S`, address) ? 2 : 0
    // Bits 2 to 15 and the fourth word belong to the system: whatever they are must not show.
    return [...value, (hash(nameOf(address)) & 0xfffc) | coil | contact, hash(nameOf(address)) & 0xffff]
  }

  #bitOf(name: string, { number }: DeviceAddress): boolean {
    const text = `${name}${number}`
    return this.#bits.get(text) ?? (hash(text) & 0x10) !== 0
  }

  #writer(
    head: DeviceAddress,
    values: readonly number[],
    touch: (address: DeviceAddress) => DeviceAddress,
  ): () => void {
    const { unit } = deviceInfo(head.device)
    const first = touch(head)
    const found = numbered(first, unit === 'bit' ? 16 * values.length : values.length, 1).map(touch)
    return () => {
      values.forEach((value, i) => {
        if (unit === 'word') this.#words.set(nameOf({ ...first, number: first.number + i }), value)
        else if (unit === 'doubleWord') {
          const text = nameOf({ ...first, number: first.number + (i >> 1) })
          this.#words.set(`${text} ${i % 2 === 0 ? 'low' : 'high'}`, value)
        } else {
          found.slice(16 * i, 16 * i + 16).forEach((bit, at) => {
            this.setBit(nameOf(bit), ((value >> at) & 1) === 1)
          })
        }
      })
    }
  }
}

function packed(bits: readonly DeviceAddress[], isSet: (bit: DeviceAddress) => boolean): number {
  let word = 0
  for (let i = 0; i < 16; i++) {
    const bit = bits[i]
    if (bit !== undefined && isSet(bit)) word |= 1 << i
  }
  return word
}

function numbered(head: DeviceAddress, count: number, step: number): DeviceAddress[] {
  return Array.from({ length: count }, (_, i) => ({ ...head, number: head.number + i * step }))
}

export function nameOf(address: DeviceAddress): string {
  return formatDevice(address, { xyRadix: 16 })
}

function hash(text: string): number {
  let value = 0x811c9dc5
  for (let i = 0; i < text.length; i++) value = Math.imul(value ^ text.charCodeAt(i), 0x01000193)
  return (value ^ (value >>> 13)) >>> 0
}

/** The value of a result that must be good. */
export function goodValue(result: ReadResult | undefined): unknown {
  if (result?.ok === true) return result.value
  throw result?.error ?? new Error('no result')
}
