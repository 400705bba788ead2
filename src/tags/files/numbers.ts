/** Numbers in cells: with a decimal point or a decimal comma, as the spreadsheet of whoever saved the file has it. */
import { show } from '../../basics/show'
import type { CellDelimiter } from './cells'

/** The sign in front of the decimals. */
export type DecimalSign = '.' | ','

/** A number with one sign that may be either: decimals, or a separator of thousands. */
const OPEN = /^[-+]?[1-9]\d{0,2}([.,])\d{3}$/
const DECIMAL = /^[-+]?\d*([.,])\d+(?:[eE][-+]?\d+)?$/

/**
 * The decimal sign of all the numbers of a file. What can be nothing but a decimal sign decides, e.g. the comma of `0,5`; without one the
 * delimiter does: a spreadsheet with decimal commas writes semicolons between cells.
 */
export function decimalSignOf(cells: Iterable<string>, delimiter: CellDelimiter): DecimalSign {
  const seen = { '.': 0, ',': 0 }
  for (const cell of cells) {
    const [, sign] = OPEN.test(cell) ? [] : (DECIMAL.exec(cell) ?? [])
    if (sign === '.' || sign === ',') seen[sign]++
  }
  if (seen[','] > 0 && seen['.'] === 0) return ','
  if (seen['.'] > 0 && seen[','] === 0) return '.'
  return delimiter === ';' ? ',' : '.'
}

/**
 * The number of a cell.
 * @throws RangeError saying what is wrong, without a full stop
 */
export function numberOfCell(cell: string, sign: DecimalSign): number {
  const text = cell.trim()
  const other = sign === ',' ? '.' : ','
  if (text.includes(other)) {
    throw new RangeError(
      `${show(cell)} has a ${NAMES[other]}, but the decimal sign of this file is the ${NAMES[sign]}; thousands are not separated`,
    )
  }
  const plain = text.replace(sign, '.')
  const number = /^[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?$/.test(plain) ? Number(plain) : Number.NaN
  if (Number.isFinite(number)) return number
  throw new RangeError(`${show(cell)} is no number`)
}

const NAMES = { '.': 'point', ',': 'comma' } as const

/** The shortest text that is this number. */
export function cellOfNumber(number: number, sign: DecimalSign): string {
  return String(number).replace('.', sign)
}
