// Buffer memory of the simulated port and of MELSEC-Q modules, as Memory and Extend Unit reach it.
import { RequestError } from '../errors'
import { byteAddressOf, type ExtendUnit, extendUnitOf } from '../melsec/extend-unit'
import type { Profile } from '../melsec/profiles/profile'
import type { DeviceMemory, ExtensionMemory } from './memory'
import { Refusal } from './refusal'

/** The connected module's own buffer memory. */
export class OwnBuffer {
  readonly #words: Uint16Array
  readonly #endCode: number

  constructor(profile: Profile, points: number) {
    this.#words = new Uint16Array(points)
    this.#endCode = profile.refusals.bufferMemory
  }

  read(address: number, points: number): number[] {
    this.#check(address, points)
    return [...this.#words.subarray(address, address + points)]
  }

  write(address: number, values: ArrayLike<number>): void {
    this.#check(address, values.length)
    this.#words.set(values, address)
  }

  clear(): void {
    this.#words.fill(0)
  }

  #check(address: number, points: number): void {
    if (address + points <= this.#words.length) return
    throw new Refusal(this.#endCode, `buffer memory ${address} to ${address + points - 1} of ${this.#words.length}`)
  }
}

interface Unit extends ExtendUnit {
  readonly unit: number
}

/** Modules that Extend Unit finds by their module No.: the same memory that `U3\G` shows. */
export class ExtendUnits {
  readonly #profile: Profile
  readonly #units: readonly Unit[]

  /** @throws RequestError BAD_OPTION */
  constructor(profile: Profile, { modules = [] }: ExtensionMemory) {
    this.#profile = profile
    this.#units = modules.flatMap(({ unit, model, slot0 }) => {
      if (model === undefined) return []
      return [{ ...extendUnitOf(model, { startIo: 16 * unit, ...(slot0 === undefined ? {} : { slot0 }) }), unit }]
    })
    const numbers = this.#units.map(({ moduleNumber }) => moduleNumber)
    if (new Set(numbers).size < numbers.length) {
      throw new RequestError('BAD_OPTION', 'Two modules have the same module No. for Extend Unit.', 'extensions')
    }
  }

  read(memory: DeviceMemory, moduleNumber: number, address: number, byteCount: number): Uint8Array {
    const { head, points } = this.#place(moduleNumber, address, byteCount)
    const bytes = new Uint8Array(byteCount)
    memory.readWords(head, points).forEach((word, i) => {
      bytes[2 * i] = word & 0xff
      bytes[2 * i + 1] = word >> 8
    })
    return bytes
  }

  write(memory: DeviceMemory, moduleNumber: number, address: number, data: Uint8Array): void {
    const { head, points } = this.#place(moduleNumber, address, data.length)
    const words = Array.from({ length: points }, (_, i) => (data[2 * i] ?? 0) | ((data[2 * i + 1] ?? 0) << 8))
    memory.writeWords(head, words)
  }

  #place(moduleNumber: number, address: number, byteCount: number) {
    const found = this.#units.find((unit) => unit.moduleNumber === moduleNumber)
    if (found === undefined) {
      throw new Refusal(this.#profile.refusals.extension, `Extend Unit: there is no module with No. ${moduleNumber}`)
    }
    const offset = address - byteAddressOf(found, 0)
    if (offset < 0) throw new Refusal(this.#profile.refusals.bufferMemory, 'in front of the buffer memory')
    const head = { device: 'G', number: offset / 2, extension: { kind: 'module', unit: found.unit } } as const
    return { head, points: byteCount / 2 }
  }
}
