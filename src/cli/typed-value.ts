// A value as it is typed on the command line, by the type of its item.
import { byteTypes, parseByteType, valueTypes } from '../entry/address'
import { type PlcValue, type ReadValue, RequestError } from '../index'

/** Type and count of an item: see `ItemExplanation`. */
export interface Wanted {
  readonly text: string
  readonly type: string
  readonly count?: number
}

/**
 * Whole numbers are decimal, or hexadecimal as `0x1F`, `H1F` or `16#1F`; `K100` is 100. Bits are ON, OFF, true, false, 1
 * or 0. An array is separated by commas.
 * @throws RequestError BAD_VALUE with the item, the text and what it must be.
 * @example typedValue({ text: 'D0:INT[3]', type: 'INT', count: 3 }, '1,2,-3')   // [1, 2, -3]
 */
export function typedValue(item: Wanted, text: string): ReadValue {
  const { type, count } = item
  if (count === undefined) return single(item, type, text)
  const parts = text.split(',')
  if (parts.length !== count) {
    throw new RequestError(
      'BAD_VALUE',
      `${item.text} takes ${count} values with commas between, not ${parts.length}.`,
      item.text,
    )
  }
  return parts.map((part) => single(item, type, part))
}

/** Of all types, those of one byte too. */
const types = { ...valueTypes, ...byteTypes }

function single(item: Wanted, type: string, text: string): PlcValue {
  const { kind } = types[parseByteType(type).name]
  switch (kind) {
    case 'text':
      return text
    case 'bit':
      return bit(item, text.trim())
    case 'real':
      return real(item, type, text.trim())
    case 'long':
      return whole(item, type, text.trim())
    case 'integer':
    case 'bcd':
      // Too large for a number is too large for the type: the library refuses it.
      return Number(whole(item, type, text.trim()))
    default:
      return kind satisfies never
  }
}

const BITS: ReadonlyMap<string, boolean> = new Map([
  ['on', true],
  ['true', true],
  ['1', true],
  ['off', false],
  ['false', false],
  ['0', false],
])

function bit(item: Wanted, text: string): boolean {
  return BITS.get(text.toLowerCase()) ?? bad(item, text, 'ON or OFF (true or false, 1 or 0)')
}

function real(item: Wanted, type: string, text: string): number {
  const value = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text) ? Number(text) : Number.NaN
  return Number.isFinite(value) ? value : bad(item, text, `a number (${type}), e.g. 71.5 or -1.5e3`)
}

function whole(item: Wanted, type: string, text: string): bigint {
  const [, decimal] = /^K?([+-]?\d+)$/i.exec(text) ?? []
  if (decimal !== undefined) return BigInt(decimal.replace(/^\+/, ''))
  const [, digits] = /^(?:0x|H|16#)([0-9a-f]+)$/i.exec(text) ?? []
  if (digits !== undefined) return BigInt(`0x${digits}`)
  return bad(item, text, `a whole number (${type}), e.g. 100, -5 or 0x1F`)
}

function bad(item: Wanted, text: string, wanted: string): never {
  throw new RequestError('BAD_VALUE', `${item.text} takes ${wanted}, not ${JSON.stringify(text)}.`, item.text)
}
