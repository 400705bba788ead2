/** The map of what lies where, made of areas: those of the user, and what is known beside them. */

import { octal } from '../../basics/octal'
import { isPlainObject } from '../../basics/option-checks'
import { show } from '../../basics/show'
import { RequestError } from '../../errors'
import { LAST_FILE } from '../address'
import { type JwArea, jwAreas } from './area'
import { type JwKindName, jwKind, lastByteOf } from './kind'
import { type JwOperand, readOperand } from './notation'

/** What is known of the PLC beside what sources confirm. */
export interface JwOperandOptions {
  /**
   * Where operands lie that no source places, e.g. `[{ first: '016000', last: '017777', file: 0, address: 0o20000 }]`, or
   * `assumedJwAreas`. They go before what is known.
   */
  readonly areas?: readonly JwArea[]
}

/** An area, with its ends as numbers. */
export interface Row {
  readonly kind: JwKindName
  readonly first: number
  readonly last: number
  readonly file: number
  /** Bit of the file where the first begins. */
  readonly start: number
}

/** Bits of a byte. */
export const BITS = 8

/** Bits that one number of a kind takes. Relays and contacts are in areas of whole bytes. */
export function bitsOf(kind: JwKindName): number {
  return jwKind(kind).unit === 'bit' ? 1 : BITS
}

/** @throws RequestError BAD_OPTION */
export function rowOf(area: JwArea): Row {
  const bad = (why: string): never => {
    const given = isPlainObject(area) ? `${show(area.first)} to ${show(area.last)}` : show(area)
    throw new RequestError('BAD_OPTION', `areas: ${given}: ${why}`, 'areas')
  }
  if (!isPlainObject(area)) bad('an area is an object with first, last, file and address.')
  const first = withoutKo(endOf(area.first, bad))
  const end = endOf(area.last, bad)
  const last = withoutKo(end)
  if (first.kind !== last.kind || last.number < first.number)
    return bad('both ends are operands of one kind, the lower one first.')
  const { kind, number } = first
  if (!isWhole(area.file, LAST_FILE)) bad('file is a number from 0 to 0x80.')
  if (!isWhole(area.address, lastByteOf(area.file))) bad(`address is a byte of the file, as a number, e.g. 0o20000.`)
  if (bitsOf(kind) === 1 && number % BITS !== 0) bad('the first bit of an area is the first of a byte, e.g. 016000.')
  // As `KO` it ends with the last relay of its last byte.
  const lastNumber = end.kind === 'KO' ? last.number + BITS - 1 : last.number
  const row = { kind, first: number, last: lastNumber, file: area.file, start: area.address * BITS }
  if (bitsOf(kind) === 1 && (lastNumber + 1) % BITS !== 0)
    bad('the last bit of an area is the last of a byte, e.g. 016777.')
  const behind = row.start + (row.last - row.first + 1) * bitsOf(kind)
  if (behind > (lastByteOf(area.file) + 1) * BITS)
    bad(`it ends behind byte ${octal(lastByteOf(area.file))} of the file.`)
  return row
}

function endOf(text: string, bad: (why: string) => never): JwOperand {
  try {
    const operand = readOperand(text)
    if (operand.bit === undefined && PLACED.includes(operand.kind)) return operand
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    return bad(error.message)
  }
  return bad('its ends are relays, KO, registers, b, E or T-C.')
}

/** Kinds that lie in files by a map; the others say by themselves where they are. */
const PLACED: readonly JwKindName[] = ['relay', 'KO', 'register', 'b', 'E', 'T-C']

/** A whole number from 0 to the last. */
export function isWhole(value: unknown, last: number): value is number {
  return typeof value === 'number' && Number.isInteger(value) && value >= 0 && value <= last
}

/** The bytes of relays lie where the relays lie: they are looked up by them. */
export function withoutKo(operand: JwOperand): JwOperand {
  const { kind, number, bit } = operand
  if (kind !== 'KO') return operand
  return { kind: 'relay', number: number * BITS + (bit ?? 0) }
}

/** @throws RequestError BAD_OPTION for areas that are none, or that place one operand twice */
function checkedRows(areas: readonly JwArea[]): readonly Row[] {
  if (!Array.isArray(areas))
    throw new RequestError('BAD_OPTION', `areas is a list of areas, not ${show(areas)}.`, 'areas')
  const rows = areas.map(rowOf)
  rows.forEach((row, index) => {
    const other = areas[rows.slice(0, index).findIndex((before) => overlaps(before, row))]
    const area = areas[index]
    if (other === undefined || area === undefined) return
    const message = `areas: ${area.first} to ${area.last} and ${other.first} to ${other.last} place the same operands twice: give each once.`
    throw new RequestError('BAD_OPTION', message, 'areas')
  })
  return rows
}

/** Whether two rows have an operand in common. */
export function overlaps(a: Row, b: Row): boolean {
  return a.kind === b.kind && a.first <= b.last && b.first <= a.last
}

/** What is left of a row beside another one. */
function without(row: Row, taken: Row): Row[] {
  if (!overlaps(row, taken)) return [row]
  const before = { ...row, last: taken.first - 1 }
  const behind = { ...row, first: taken.last + 1, start: positionIn(row, taken.last + 1) }
  return [before, behind].filter(({ first, last }) => first <= last)
}

/** What sources confirm. */
export const KNOWN_ROWS = jwAreas.map(rowOf)
const rowsOfLists = new WeakMap<readonly JwArea[], readonly Row[]>()

/** The map: the user's areas, and what is known beside them. No operand is in two rows. */
function rowsOf({ areas = NO_AREAS }: JwOperandOptions): readonly Row[] {
  const known = typeof areas === 'object' ? rowsOfLists.get(areas) : undefined
  if (known !== undefined) return known
  const given = checkedRows(areas)
  const left = given.reduce<readonly Row[]>((rows, taken) => rows.flatMap((row) => without(row, taken)), KNOWN_ROWS)
  const rows = [...given, ...left]
  rowsOfLists.set(areas, rows)
  return rows
}

const NO_AREAS: readonly JwArea[] = []

/** The row that an operand is in; `undefined`: nobody says where it lies. */
export function rowWith(kind: JwKindName, number: number, options: JwOperandOptions): Row | undefined {
  return rowsOf(options).find((row) => row.kind === kind && number >= row.first && number <= row.last)
}

/** Bit of the file where a number of an area begins. */
export function positionIn(row: Row, number: number): number {
  return row.start + (number - row.first) * bitsOf(row.kind)
}
