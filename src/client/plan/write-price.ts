// What writing costs on a serial line, in bytes on the line.
import type { Command, RequestOf } from '../../melsec/commands/command'
import { commands } from '../../melsec/commands/commands'
import type { DeviceAddress } from '../../melsec/device/device'
import { type Area, addressAt, wordsPerCell } from './area'
import type { PlanProtocol } from './limit'
import { valueBytes } from './price'

/** What one entry of Write Random adds to its request: 1C has longer ones for large numbers, and then for all of a request. */
export interface EntryPrice {
  readonly bit: number
  readonly word: number
  readonly doubleWord: number
}

export const noEntry: EntryPrice = { bit: 0, word: 0, doubleWord: 0 }

export class WritePrices {
  readonly #protocol: PlanProtocol
  readonly #request: number

  /** @param request bytes of a request and its answer around their bodies */
  constructor(protocol: PlanProtocol, request: number) {
    this.#protocol = protocol
    this.#request = request
  }

  /** A Write that begins or ends at this cell, without its values. */
  direct(area: Area, cell: number): number {
    const head = addressAt(area, cell)
    const bytes =
      area.kind === 'bit'
        ? this.#bytes(area, commands.writeBits, { head, values: [false] })
        : this.#bytes(area, commands.writeWords, { head, values: new Array<number>(wordsPerCell(area)).fill(0) })
    return bytes - this.values(area, 1)
  }

  values(area: Area, cells: number): number {
    return valueBytes(this.#protocol.code, area, cells)
  }

  /** A Write Random with nothing in it. */
  random(area: Area): number {
    const device = addressAt(area, 0)
    return 2 * this.#randomBytes(area, [device]) - this.#randomBytes(area, [device, device])
  }

  entry(area: Area, cell: number, request: number): EntryPrice {
    const device = addressAt(area, cell)
    const one = this.#randomBytes(area, [device]) - request
    if (area.kind === 'bit') return { ...noEntry, bit: one }
    const doubleWords = [{ device, value: 0 }]
    const pair = this.#bytes(area, commands.writeRandomWords, { words: [], doubleWords }) - request
    return { ...noEntry, word: one, doubleWord: pair }
  }

  /** A Write Block with nothing in it, and what each block adds beside its values. */
  block(area: Area): { readonly request: number; readonly block: number } {
    const block = { head: addressAt(area, 0), values: [0] }
    const bytes = (wordBlocks: readonly (typeof block)[]) =>
      this.#bytes(area, commands.writeBlock, { wordBlocks, bitBlocks: [] })
    const one = bytes([block])
    const second = bytes([block, block]) - one
    return { request: one - second, block: second - this.values(area, 1) }
  }

  #randomBytes(area: Area, devices: readonly DeviceAddress[]): number {
    if (area.kind === 'bit') {
      const bits = devices.map((device) => ({ device, value: false }))
      return this.#bytes(area, commands.writeRandomBits, { bits })
    }
    const entries = devices.map((device) => ({ device, value: 0 }))
    return area.ways.random === 'doubleWords'
      ? this.#bytes(area, commands.writeRandomWords, { words: [], doubleWords: entries })
      : this.#bytes(area, commands.writeRandomWords, { words: entries, doubleWords: [] })
  }

  #bytes<C extends Command>(area: Area, command: C, message: RequestOf<C>): number {
    return this.#request + this.#protocol.bodyBytes(command, message, area.ways.form)
  }
}
