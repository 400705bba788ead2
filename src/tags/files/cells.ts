/** Rows and cells of a text with delimiters, and back (RFC 4180; GX Works writes tabs, and quotes every cell). */

import { show } from '../../basics/show'

/** What stands between two cells. */
export const delimiters = ['\t', ';', ','] as const
/** See {@link delimiters}. */
export type CellDelimiter = (typeof delimiters)[number]

/** One row of a file. */
export interface CellRow {
  /** The line of the file where it begins, from 1. A cell may go over several lines. */
  readonly line: number
  readonly cells: readonly string[]
  /** What is wrong with its quotes. */
  readonly fault?: string
}

/** The rows of a text; those without any character are left out. */
export function rowsOf(text: string, delimiter: CellDelimiter): CellRow[] {
  const rows: CellRow[] = []
  let at = 0
  let line = 1
  while (at < text.length) {
    const begin = line
    const cells: string[] = []
    let fault: string | undefined
    for (;;) {
      const cell = text[at] === '"' ? quoted(text, at) : plain(text, at, delimiter)
      const loose = text[at] === '"' ? plain(text, cell.end, delimiter) : { value: '', end: cell.end }
      if (cell.fault !== undefined) fault ??= cell.fault
      if (loose.value !== '')
        fault ??= `behind the quotes of cell ${cells.length + 1} stands ${JSON.stringify(loose.value)}`
      cells.push(cell.value)
      line += newLines(cell.value)
      at = loose.end
      if (text[at] !== delimiter) break
      at++
    }
    if (text[at] === '\r' && text[at + 1] === '\n') at += 2
    else if (at < text.length) at++
    line++
    if (cells.some((cell) => cell !== '') || fault !== undefined) {
      rows.push({ line: begin, cells, ...(fault === undefined ? {} : { fault }) })
    }
  }
  return rows
}

function newLines(text: string): number {
  return text.match(/\r\n|\r|\n/g)?.length ?? 0
}

interface Cell {
  readonly value: string
  readonly end: number
  readonly fault?: string
}

function plain(text: string, from: number, delimiter: CellDelimiter): Cell {
  let end = from
  while (end < text.length && text[end] !== delimiter && text[end] !== '\n' && text[end] !== '\r') end++
  return { value: text.slice(from, end), end }
}

function quoted(text: string, from: number): Cell {
  let value = ''
  let at = from + 1
  for (;;) {
    const quote = text.indexOf('"', at)
    if (quote < 0) return { value: value + text.slice(at), end: text.length, fault: 'a quotation mark is not closed' }
    value += text.slice(at, quote)
    if (text[quote + 1] !== '"') return { value, end: quote + 1 }
    value += '"'
    at = quote + 2
  }
}

/** Says that a row is longer than its heading. */
export function tooManyCells(first: string): string {
  return `The row has more cells than the heading, the first of them ${show(first)}: is a text with the delimiter in it not quoted?`
}

/** Rows as text; with `all` every cell is quoted, else those that need it. Lines end as Windows has it. */
export function textOfRows(rows: readonly (readonly string[])[], delimiter: CellDelimiter, all = false): string {
  const needs = new RegExp(`[${delimiter === '\t' ? '\\t' : delimiter}"\\r\\n]|^\\s|\\s$`)
  const cell = (text: string) => (all || needs.test(text) ? `"${text.replaceAll('"', '""')}"` : text)
  return rows.map((row) => `${row.map(cell).join(delimiter)}\r\n`).join('')
}

/** Signs with which a spreadsheet begins a formula; the full-width ones do in Japanese and Chinese editions. */
const FORMULA = /^'*[=+\-@\t\r＝＋－＠]/

/** A text that no spreadsheet takes for a formula. A number is none. */
export function guarded(text: string): string {
  return FORMULA.test(text) ? `'${text}` : text
}

/** The text that was guarded. */
export function unguarded(cell: string): string {
  return cell.startsWith("'") && FORMULA.test(cell.slice(1)) ? cell.slice(1) : cell
}
