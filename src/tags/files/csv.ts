/** Our own CSV files: columns by header, in any order, as people keep them in a spreadsheet. */
import { show } from '../../basics/show'
import { RequestError } from '../../errors'
import type { Tag } from '../table/tag'
import { type CellDelimiter, type CellRow, guarded, textOfRows, tooManyCells, unguarded } from './cells'
import { type ColumnName, cellsOfTag, columnNamed, columnNames, columnOf, rowOfCells, type TagCells } from './columns'
import { cellOfNumber, type DecimalSign, decimalSignOf, numberOfCell } from './numbers'
import type { Draft, Drafts, TagMessage } from './result'

/** Whether a row names the columns of such a file. */
export function isCsvHeader(cells: readonly string[]): boolean {
  const found = cells.map(columnNamed)
  return found.includes('name') && found.includes('address')
}

/**
 * @param rows from the heading on
 * @throws RequestError BAD_VALUE when two columns have the same header
 */
export function draftsOfCsv(rows: readonly CellRow[], delimiter: CellDelimiter): Drafts {
  const [head, ...body] = rows
  const names = (head?.cells ?? []).map(columnNamed)
  const twice = names.find((name, at) => name !== undefined && names.indexOf(name) !== at)
  if (twice !== undefined) {
    throw new RequestError('BAD_VALUE', `Two columns of the file mean ${columnOf(twice).header}: leave one out.`)
  }
  const sign = decimalSignOf(numbersIn(body, names), delimiter)
  const drafts = body.map((row): Draft => ({ line: row.line, row: rowOf(row, names, sign) }))
  return { drafts, notes: unknownColumns(head, body, names) }
}

function* numbersIn(rows: readonly CellRow[], names: readonly (ColumnName | undefined)[]): Iterable<string> {
  for (const { cells } of rows) {
    for (const [at, name] of names.entries()) {
      if (name === undefined) continue
      if (columnOf(name).kind === 'number') yield unguarded(cells[at] ?? '').trim()
      else if (name === 'deadband')
        yield unguarded(cells[at] ?? '')
          .replace(/[%％]\s*$/, '')
          .trim()
    }
  }
}

function unknownColumns(
  head: CellRow | undefined,
  rows: readonly CellRow[],
  names: readonly (ColumnName | undefined)[],
): TagMessage[] {
  const line = head?.line ?? 1
  return (head?.cells ?? []).flatMap((header, at): TagMessage[] => {
    const filled = names[at] === undefined ? rows.filter(({ cells }) => (cells[at] ?? '') !== '').length : 0
    if (filled === 0) return []
    const message = `The column ${show(header)} is not known: ${filled} ${filled === 1 ? 'cell is' : 'cells are'} not kept.`
    return [{ line, about: 'note', message }]
  })
}

function rowOf(row: CellRow, names: readonly (ColumnName | undefined)[], sign: DecimalSign): Draft['row'] {
  if (row.fault !== undefined) return `The row cannot be read: ${row.fault}.`
  const beyond = row.cells.slice(names.length).find((cell) => cell !== '')
  if (beyond !== undefined) return tooManyCells(beyond)
  const faults: string[] = []
  const attempt = <T>(what: string, run: () => T): T | undefined => {
    try {
      return run()
    } catch (error) {
      if (!(error instanceof RangeError)) throw error
      faults.push(`${what}: ${error.message}.`)
      return undefined
    }
  }
  const cells: TagCells = {}
  for (const [at, name] of names.entries()) {
    const text = unguarded(row.cells[at] ?? '')
    if (name === undefined || text === '') continue
    const value = attempt(columnOf(name).header, () => cellValue(name, text, sign))
    if (value !== undefined) cells[name] = value
  }
  const tag = attempt(columnOf('deadband').header, () => rowOfCells(cells, (text) => numberOfCell(text, sign)))
  return faults.length > 0 ? faults.join(' ') : (tag ?? {})
}

const FLAGS: Readonly<Record<string, boolean>> = {
  true: true,
  yes: true,
  '1': true,
  false: false,
  no: false,
  '0': false,
}

function cellValue(name: ColumnName, text: string, sign: DecimalSign): string | number | boolean {
  switch (columnOf(name).kind) {
    case 'number':
      return numberOfCell(text, sign)
    case 'flag': {
      const flag = text.trim().toLowerCase()
      if (Object.hasOwn(FLAGS, flag)) return FLAGS[flag] === true
      throw new RangeError(`${show(text)} is not true or false`)
    }
    default:
      return text
  }
}

/** How a CSV file is written. */
export interface CsvOptions {
  /** What stands between two cells; `,` by default. With `;` numbers have a decimal comma, as the spreadsheets that expect it do. */
  readonly delimiter?: CellDelimiter
}

/** The text of a file with a heading and a row for each tag. Columns that no tag needs are left out, but for the first ones. */
export function csvOfTags(tags: readonly Tag[], { delimiter = ',' }: CsvOptions = {}): string {
  const sign = delimiter === ';' ? ',' : '.'
  const rows = tags.map(cellsOfTag)
  const first = columnNames.indexOf('unit')
  const used = columnNames.filter((name, at) => at <= first || rows.some((cells) => cells[name] !== undefined))
  const body = rows.map((cells) => used.map((name) => cellText(name, cells[name], sign)))
  return textOfRows([used.map((name) => columnOf(name).header), ...body], delimiter)
}

function cellText(name: ColumnName, value: string | number | boolean | undefined, sign: DecimalSign): string {
  if (value === undefined) return ''
  if (typeof value === 'number') return cellOfNumber(value, sign)
  if (name === 'deadband') return String(value).replace('.', sign)
  return guarded(String(value))
}
