// Buffer memory by Memory (0613, 1613) and Extend Unit (0601, 1601): words at addresses of a module.
import { RequestError } from '../../errors'
import { commands } from '../../melsec/commands/commands'
import { byteAddressOf, type ExtendUnit } from '../../melsec/extend-unit'
import type { CallOptions } from '../connection/call'
import type { NumberArray } from '../item/item-value'
import { isTyped } from '../item/plain-values'
import type { SendCommand } from './send-command'

/** Words of a buffer memory, 0 to 65535 each. */
export interface BufferMemory {
  /**
   * Reads words from a buffer memory address on, in one request: they are of one moment.
   * @throws RequestError for more than one request can carry
   */
  read(address: number, points: number, options?: CallOptions): Promise<number[]>
  /** Writes words, in one request. Needs `allowWrites`. */
  write(address: number, values: readonly number[] | NumberArray, options?: CallOptions): Promise<void>
}

/** The connected module's own. */
export function memoryOf(send: SendCommand): BufferMemory {
  return {
    read: async (address, points, options) => {
      return [...(await send(commands.readMemory, { address, points }, options)).values]
    },
    write: async (address, values, options) => {
      await send(commands.writeMemory, { address, values: wordsGiven(values) }, options)
    },
  }
}

/** A MELSEC-Q module's. */
export function moduleOf(send: SendCommand, unit: ExtendUnit): BufferMemory {
  const { moduleNumber } = unit
  return {
    read: async (address, points, options) => {
      const message = { address: byteAddressOf(unit, address), byteCount: 2 * points, moduleNumber }
      return wordsOf((await send(commands.readExtendUnit, message, options)).data)
    },
    write: async (address, values, options) => {
      const message = { address: byteAddressOf(unit, address), moduleNumber, data: bytesOf(wordsGiven(values)) }
      await send(commands.writeExtendUnit, message, options)
    },
  }
}

function wordsOf(bytes: Uint8Array): number[] {
  return Array.from({ length: bytes.length / 2 }, (_, i) => (bytes[2 * i] ?? 0) | ((bytes[2 * i + 1] ?? 0) << 8))
}

/** Their elements are checked as those of any array: what is no word is refused. */
function wordsGiven(values: readonly number[] | NumberArray): readonly number[] {
  return isTyped(values) ? Array.from<number | bigint, number>(values, Number) : values
}

/** Low byte first, in ASCII code too. @throws RequestError BAD_VALUE */
function bytesOf(values: readonly number[]): Uint8Array {
  if (!Array.isArray(values)) throw new RequestError('BAD_VALUE', 'values must be an array of words.', 'values')
  const bytes = new Uint8Array(2 * values.length)
  for (let i = 0; i < values.length; i++) {
    const word: unknown = values[i]
    if (typeof word !== 'number' || !Number.isInteger(word) || word < 0 || word > 0xffff) {
      throw new RequestError('BAD_VALUE', `Word ${i} is ${String(word)}; a word is 0 to 65535.`, 'values')
    }
    bytes[2 * i] = word & 0xff
    bytes[2 * i + 1] = word >> 8
  }
  return bytes
}
