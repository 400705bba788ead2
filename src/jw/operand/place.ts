/**
 * Where an operand lies, as the message commands say it, and what lies behind it.
 *
 * Bits of a file and of the system memory are counted from bit 0 of byte 0 on, so that what lies beside what is a difference.
 */

import { octal } from '../../basics/octal'
import { RequestError } from '../../errors'
import { FILE_REGISTERS, type JwAddress, type JwExtendedAddress, pageOfRegisters, registersOfPage } from '../address'
import { assumedJwAreas, type JwArea } from './area'
import { type JwKindName, jwKind, lastByteOf } from './kind'
import {
  BITS,
  bitsOf,
  isWhole,
  type JwOperandOptions,
  KNOWN_ROWS,
  overlaps,
  positionIn,
  type Row,
  rowOf,
  rowWith,
  withoutKo,
} from './map'
import { formatJwOperand, type JwOperand } from './notation'

/** Where an operand lies. */
export type JwPlace =
  | JwFilePlace
  | {
      /** In the system memory. */
      readonly in: 'system'
      /** Of a byte. */
      readonly address: number
      /** One bit of it, 0 to 7. */
      readonly bit?: number
    }
  | {
      /** A timer, counter or MD. */
      readonly in: 'timer'
      /** TMR of the commands. */
      readonly number: number
    }

/** A byte of a file (SEG, ADR of the commands); `bit`: one bit of it, 0 to 7 (BLOC). */
export interface JwFilePlace {
  /** In a file. */
  readonly in: 'file'
  /** File number. */
  readonly file: number
  /** Of a byte. */
  readonly address: number
  /** One bit of it, 0 to 7. */
  readonly bit?: number
}

/**
 * Where an operand lies.
 * @throws RequestError OUT_OF_RANGE when no source and no area of the options says it
 * @example placeOfJw({ kind: 'relay', number: 0o4033 }) // { in: 'file', file: 0, address: 0o403, bit: 3 }
 */
export function placeOfJw(operand: JwOperand, options: JwOperandOptions = {}): JwPlace {
  const { kind, number, bit } = operand
  if (jwKind(kind).unit === 'timer') return { in: 'timer', number }
  const ofBit = bit === undefined ? {} : { bit }
  if (kind === '#') return { in: 'system', address: number, ...ofBit }
  if (kind === 'F') return { in: 'file', file: operand.file ?? 0, address: number, ...ofBit }
  const looked = withoutKo(operand)
  const row = rowWith(looked.kind, looked.number, options)
  if (row === undefined) throw nowhere(operand)
  const at = positionIn(row, looked.number)
  const place = { in: 'file', file: row.file, address: Math.floor(at / BITS) } as const
  return bitsOf(kind) === 1 ? { ...place, bit: at % BITS } : { ...place, ...ofBit }
}

/** What is said of an operand that no source places. */
function nowhere(operand: JwOperand): RequestError {
  const text = formatJwOperand(operand)
  const { kind, number } = withoutKo(operand)
  const known = rangesOf(kind, operand.kind)
  const places = known === '' ? '' : ` Known are ${known}.`
  const guess = assumedJwAreas.find((area) =>
    overlaps(rowOf(area), { kind, first: number, last: number, file: 0, start: 0 }),
  )
  const assumed = guess === undefined ? '' : ` ${assumption(guess)}`
  const message = `${JSON.stringify(text)}: no source says where in the files of the PLC this ${jwKind(operand.kind).title} lies.${places}${assumed} When you know its place, give it in the option areas, or name the byte itself, e.g. F0:016012.`
  return new RequestError('OUT_OF_RANGE', message)
}

/** The numbers that sources place, as operands of a kind: relays may be shown as the bytes that they are in. */
function rangesOf(kind: JwKindName, shownAs: JwKindName): string {
  const joined: { first: number; last: number }[] = []
  for (const { first, last } of KNOWN_ROWS.filter((row) => row.kind === kind)) {
    const before = joined.at(-1)
    if (before !== undefined && before.last + 1 === first) before.last = last
    else joined.push({ first, last })
  }
  const step = shownAs === 'KO' ? BITS : 1
  const shown = (number: number) => formatJwOperand({ kind: shownAs, number: Math.floor(number / step) })
  return joined.map(({ first, last }) => `${shown(first)} to ${shown(last)}`).join(', ')
}

function assumption({ first, last, file, address, source }: JwArea): string {
  return `It is assumed, and not confirmed, that ${first} to ${last} begin at byte ${octal(address, 6)} of file ${file} (${source}); the option takes that as assumedJwAreas.`
}

/** Steps to the last operand that lies in one piece with this one: bits of a bit, bytes of a byte, numbers of a timer. */
export function stepsBehind(operand: JwOperand, options: JwOperandOptions = {}): number {
  const { kind, number, bit } = operand
  const left = (last: number) => (bit === undefined ? last - number : (last - number) * BITS + (BITS - 1 - bit))
  if (jwKind(kind).unit === 'timer' || kind === '#') return left(jwKind(kind).last)
  if (kind === 'F') return left(lastByteOf(operand.file ?? 0))
  const looked = withoutKo(operand)
  let row = rowWith(looked.kind, looked.number, options)
  if (row === undefined) throw nowhere(operand)
  // Areas that follow one another in numbers and in the file are one piece.
  for (let next = nextOf(row, options); next !== undefined; next = nextOf(row, options)) row = next
  if (kind === 'KO') return left(Math.floor((row.last + 1) / BITS) - 1)
  return left(row.last)
}

function nextOf(row: Row, options: JwOperandOptions): Row | undefined {
  const next = rowWith(row.kind, row.last + 1, options)
  if (next === undefined || next.file !== row.file) return undefined
  return positionIn(next, row.last + 1) === positionIn(row, row.last) + bitsOf(row.kind) ? next : undefined
}

/**
 * The operand so many steps on: the next bit of a bit, the next byte of a byte, the next number of a timer.
 * @throws RequestError OUT_OF_RANGE behind the last that lies in one piece with it
 * @example advanceJw({ kind: 'register', number: 0o777 }, 1) // 19000
 */
export function advanceJw(operand: JwOperand, steps: number, options: JwOperandOptions = {}): JwOperand {
  const left = stepsBehind(operand, options)
  if (!isWhole(steps, left)) {
    const last = formatJwOperand(onward(operand, left))
    const message = `${JSON.stringify(formatJwOperand(operand))}: ${steps} further on is not in one piece with it, ${last} is the last.`
    throw new RequestError('OUT_OF_RANGE', message)
  }
  return onward(operand, steps)
}

function onward(operand: JwOperand, steps: number): JwOperand {
  const { number, bit } = operand
  if (bit === undefined) return { ...operand, number: number + steps }
  const at = number * BITS + bit + steps
  return { ...operand, number: Math.floor(at / BITS), bit: at % BITS }
}

/**
 * How far one place lies behind another: in bits, of timers in numbers; negative: before it. `undefined` when they are not in
 * one file, so that no command reaches both at once.
 */
export function offsetOfJw(from: JwPlace, to: JwPlace): number | undefined {
  if (from.in === 'timer' || to.in === 'timer') {
    return from.in === 'timer' && to.in === 'timer' ? to.number - from.number : undefined
  }
  if (from.in !== to.in || (from.in === 'file' && to.in === 'file' && from.file !== to.file)) return undefined
  return (to.address - from.address) * BITS + (to.bit ?? 0) - (from.bit ?? 0)
}

/**
 * The address of a byte in a file as commands carry it. `basic`: 64 KiB of each file; the file registers of a JW300 from
 * 00200000 on are its files 02 to 80H. `extended`: file 0 and the file registers of a JW300, of which its files 02 to 80H are the
 * pages. The manual prints this table for parameters ("file registers", as in indirect addressing).
 * @example jwAddressOf({ in: 'file', file: 1, address: 0o200000 }, 'basic') // { file: 2, address: 0 }
 */
export function jwAddressOf(place: JwFilePlace, form: 'extended'): JwExtendedAddress
export function jwAddressOf(place: JwFilePlace, form: 'basic' | 'extended'): JwAddress
export function jwAddressOf({ file, address }: JwFilePlace, form: 'basic' | 'extended'): JwAddress {
  if (form === 'basic') return file === FILE_REGISTERS ? pageOfRegisters(address) : { file, address }
  return file === 0 ? { file, address, extended: true } : registersOfPage(file, address)
}
