// The program's side of the device memory: what a simulated process or a test reads and writes, by address and type.
import { RequestError } from '../errors'
import { type ParsedDevice, parseDevice } from '../melsec/device/address'
import { type DeviceAddress, type DeviceName, deviceInfo } from '../melsec/device/device'
import { addressOptionsOf, type Profile } from '../melsec/profiles/profile'
import {
  bitOf,
  decodeValue,
  encodeValue,
  formatType,
  type PlcValue,
  parseType,
  type ValueFormat,
  type ValueOf,
  type ValueType,
  wordsOf,
} from '../value/value'
import type { DeviceMemory } from './memory'
import type { ProgramMemory } from './program'
import { Refusal } from './refusal'

/** What lies at an address: a value of a type in one or more devices. */
interface Target extends ParsedDevice {
  readonly type: ValueType
}

/** Device memory by address and type. */
export class TypedMemory implements ProgramMemory {
  readonly #memory: DeviceMemory
  readonly #profile: Profile
  readonly #parsed = new Map<string, Target>()

  constructor(memory: DeviceMemory, profile: Profile) {
    this.#memory = memory
    this.#profile = profile
  }

  word(device: DeviceName, number: number): number {
    return this.#inRange(() => this.#memory.readWords({ device, number }, 1)[0] ?? 0)
  }

  setWord(device: DeviceName, number: number, value: number): void {
    const words = encodeValue({ name: 'WORD' }, value)
    this.#inRange(() => this.#memory.writeWords({ device, number }, words))
  }

  bit(device: DeviceName, number: number): boolean {
    const address = bitAddress({ device, number })
    return this.#inRange(() => this.#memory.readBits(address, 1)[0] === true)
  }

  setBit(device: DeviceName, number: number, value: boolean): void {
    const address = bitAddress({ device, number })
    if (typeof value !== 'boolean') throw badBit(value)
    this.#inRange(() => this.#memory.writeBits(address, [value]))
  }

  get<T extends string>(address: string, type: T, format?: ValueFormat): ValueOf<T>
  get(address: string, type?: string, format?: ValueFormat): PlcValue
  get(address: string, type?: string, format?: ValueFormat): PlcValue {
    const target = this.#target(address, type)
    return this.#inRange(() => this.#read(target, format))
  }

  set(address: string, type: string, value: PlcValue, format?: ValueFormat): void {
    const target = this.#target(address, type)
    this.#inRange(() => this.#write(target, value, format))
  }

  read(item: string, format?: ValueFormat): PlcValue {
    const [address, type] = split(item)
    return this.get(address, type, format)
  }

  write(item: string, value: PlcValue, format?: ValueFormat): void {
    const [address, type] = split(item)
    const target = this.#target(address, type)
    this.#inRange(() => this.#write(target, value, format))
  }

  addressOf(source: string): number {
    const { address } = this.#wordDevice(source)
    return this.#inRange(() => this.#memory.addressOf(address))
  }

  adrset(source: string, destination: string): void {
    const stored = this.addressOf(source)
    const { address } = this.#wordDevice(destination)
    this.#inRange(() => this.#memory.writeDoubleWord(address, stored))
  }

  clear(scope: 'unlatched' | 'all' = 'all'): void {
    this.#memory.clear(scope)
  }

  #read({ address, bit, digits, type }: Target, format: ValueFormat | undefined): PlcValue {
    if (bit !== undefined) return bitOf(this.#memory.readWords(address, 1)[0] ?? 0, bit)
    if (type.name === 'BOOL') return this.#memory.readBits(address, 1)[0] === true
    return decodeValue(type, this.#words(address, digits, wordsOf(type)), 0, format)
  }

  #write({ address, bit, digits, type }: Target, value: PlcValue, format: ValueFormat | undefined): void {
    if (type.name === 'BOOL') {
      if (typeof value !== 'boolean') throw badBit(value)
      if (bit === undefined) this.#memory.writeBits(address, [value])
      else this.#writeBitOfWord(address, bit, value)
      return
    }
    const words = encodeValue(type, value, format)
    if (digits !== undefined) this.#writeDigits(address, digits, words)
    else if (deviceInfo(address.device).unit === 'doubleWord') this.#writeDoubleWords(address, words)
    else this.#memory.writeWords(address, words)
  }

  #words(address: DeviceAddress, digits: number | undefined, count: number): number[] {
    if (digits !== undefined) {
      const words = new Array<number>(count).fill(0)
      this.#memory.readBits(address, 4 * digits).forEach((on, i) => {
        if (on) words[i >> 4] = (words[i >> 4] ?? 0) | (1 << (i & 15))
      })
      return words
    }
    if (deviceInfo(address.device).unit !== 'doubleWord') return this.#memory.readWords(address, count)
    return Array.from({ length: count / 2 }, (_, i) =>
      this.#memory.readDoubleWord({ ...address, number: address.number + i }),
    ).flatMap((value) => [value & 0xffff, value >>> 16])
  }

  #writeDoubleWords(address: DeviceAddress, words: readonly number[]): void {
    for (let i = words.length / 2 - 1; i >= 0; i--) {
      const value = ((words[2 * i] ?? 0) | ((words[2 * i + 1] ?? 0) << 16)) >>> 0
      this.#memory.writeDoubleWord({ ...address, number: address.number + i }, value)
    }
  }

  #writeBitOfWord(address: DeviceAddress, bit: number, on: boolean): void {
    const word = this.#memory.readWords(address, 1)[0] ?? 0
    this.#memory.writeWords(address, [on ? word | (1 << bit) : word & ~(1 << bit)])
  }

  #writeDigits(address: DeviceAddress, digits: number, words: readonly number[]): void {
    const bits = words.flatMap((word) => Array.from({ length: 16 }, (_, i) => ((word >>> i) & 1) === 1))
    if (bits.slice(4 * digits).includes(true)) {
      throw new RequestError('BAD_VALUE', `The value needs more than the ${4 * digits} bits of K${digits}.`)
    }
    this.#memory.writeBits(address, bits.slice(0, 4 * digits))
  }

  #wordDevice(text: string): ParsedDevice {
    const parsed = parseDevice(text, addressOptionsOf(this.#profile))
    const { address, bit, digits } = parsed
    const modified = address.extension ?? address.index ?? address.indirect ?? bit ?? digits
    if (modified === undefined && deviceInfo(address.device).unit === 'word') return parsed
    throw new RequestError('BAD_ADDRESS', `${text}: ADRSET takes a word device as it is, e.g. D100.`, 'address')
  }

  #target(text: string, type: string | undefined): Target {
    const key = type === undefined ? text : `${text}:${type}`
    const known = this.#parsed.get(key)
    if (known !== undefined) return known
    const parsed = parseDevice(text, addressOptionsOf(this.#profile))
    const target = { ...parsed, type: type === undefined ? usualType(parsed) : parseType(type) }
    checkTarget(text, target)
    this.#parsed.set(key, target)
    return target
  }

  #inRange<T>(run: () => T): T {
    try {
      return run()
    } catch (error) {
      if (!(error instanceof Refusal)) throw error
      throw new RequestError('OUT_OF_RANGE', `The simulated ${this.#profile.title} refuses: ${error.message}.`)
    }
  }
}

function split(item: string): readonly [address: string, type: string | undefined] {
  const colon = item.indexOf(':')
  return colon < 0 ? [item, undefined] : [item.slice(0, colon), item.slice(colon + 1)]
}

function usualType({ address, bit, digits }: ParsedDevice): ValueType {
  const { unit } = deviceInfo(address.device)
  if (digits !== undefined) return { name: digits > 4 ? 'DINT' : 'INT' }
  if (bit !== undefined || unit === 'bit') return { name: 'BOOL' }
  return { name: unit === 'doubleWord' ? 'DINT' : 'INT' }
}

/** What would read or write something else than is meant. */
function checkTarget(text: string, { address, bit, digits, type }: Target): void {
  const { unit, name } = deviceInfo(address.device)
  const isBit = bit !== undefined || (unit === 'bit' && digits === undefined)
  if (type.name === 'BOOL') {
    if (isBit) return
    throw new RequestError('BAD_TYPE', `${text} is no bit: BOOL takes a bit device or the bit of a word, as ${text}.0.`)
  }
  if (bit !== undefined) throw new RequestError('BAD_TYPE', `${text} is one bit, not ${formatType(type)}.`)
  const words = wordsOf(type)
  if (digits !== undefined && words !== (digits > 4 ? 2 : 1)) {
    throw new RequestError('BAD_TYPE', `${text} has ${4 * digits} bits, ${formatType(type)} has ${16 * words}.`)
  }
  if (unit === 'doubleWord' && words % 2 !== 0) {
    throw new RequestError('BAD_TYPE', `${name} has 32 bits: ${formatType(type)} does not fit it.`)
  }
}

function bitAddress(address: DeviceAddress): DeviceAddress {
  if (deviceInfo(address.device).unit === 'bit') return address
  throw new RequestError('BAD_TYPE', `${address.device} is no bit device: use get('${address.device}100.0').`)
}

function badBit(value: unknown): RequestError {
  return new RequestError('BAD_VALUE', `A bit is true or false, not ${String(value)}.`)
}
