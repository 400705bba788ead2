/** Labels and device comments of GX Works, row by row. */
import { show } from '../../basics/show'
import { RequestError } from '../../errors'
import { type CellRow, tooManyCells } from './cells'
import { type GxColumn, type GxHeading, headingOf } from './gx-headers'
import { gxTypeOf, storedType } from './gx-type'
import type { Draft, Drafts, TagFileKind, TagMessage } from './result'

type GxKind = Exclude<TagFileKind, 'csv' | 'json'>
type Cell = (column: GxColumn) => string

/** @param rows from the heading on */
export function draftsOfGx(rows: readonly CellRow[], kind: GxKind): Drafts {
  const [head, ...body] = rows
  if (head === undefined) return { drafts: [], notes: [] }
  const heading = headingOf(head.cells)
  const drafts = body.map(({ line, cells, fault }): Draft => {
    if (fault !== undefined) return { line, row: `The row cannot be read: ${fault}.` }
    const beyond = cells.slice(head.cells.length).find((cell) => cell !== '')
    if (beyond !== undefined) return { line, row: tooManyCells(beyond) }
    const cell: Cell = (column) => (cells[heading.columns[column] ?? -1] ?? '').trim()
    const comment = commentAt(cells, heading)
    const description = comment === undefined ? {} : { description: textOf(cells[comment]) }
    return { line, row: rowOf(kind, cell, heading, description) }
  })
  return { drafts, notes: notKept(head, body, heading) }
}

function textOf(cell: string | undefined): string {
  return (cell ?? '').trim()
}

/** The place of the first comment with a text. */
function commentAt(cells: readonly string[], { comments }: GxHeading): number | undefined {
  return comments.find((at) => textOf(cells[at]) !== '')
}

type Described = { readonly description?: string }

function rowOf(kind: GxKind, cell: Cell, heading: GxHeading, described: Described): Draft['row'] {
  if (kind === 'deviceComments') return commentRow(cell, described)
  try {
    return labelRow(kind, cell, heading, described)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    return `${cell('label')}: ${error.message}`
  }
}

function commentRow(cell: Cell, described: Described): Draft['row'] {
  const device = cell('device')
  if (device === '') return 'The row has no device.'
  return { name: cell('label') === '' ? device : cell('label'), address: device, ...described }
}

function labelRow(kind: GxKind, cell: Cell, heading: GxHeading, described: Described): Draft['row'] {
  const name = cell('label')
  if (name === '') return 'The row has no label name.'
  const group = cell('class')
  if (/CONSTANT/i.test(group)) return `${name}: a constant stands in the program, not in a device.`
  const type = gxTypeOf(cell('type'))
  const address = cell('assign') === '' ? cell('device') : cell('assign')
  const { count } = type
  const array = count === undefined ? {} : { count }
  if (address !== '') return { name, address, type: storedType(type), ...array, ...described }
  if (/^VAR/i.test(group) && !/GLOBAL/i.test(group))
    return `${name}: ${group} is a class of local labels, and these cannot be reached.`
  if (kind === 'gxWorks2Labels') {
    return `${name}: GX Works2 assigns its device by itself, so nobody can know it: give the label a device.`
  }
  if (!isTicked(cell('external'))) {
    const how = heading.columns.external === undefined ? 'The file does not say that it can be' : 'It is not'
    return `${name}: it has no device. ${how} accessed by its name: give it a device, or tick "Access from External Device".`
  }
  const element = type.first === undefined ? '' : `[${type.first}]`
  return { name, address: `label:${name}${element}`, type: storedType({ type: type.type }), ...array, ...described }
}

function isTicked(text: string): boolean {
  return /^(1|true|yes|on|○|✓|✔)$/i.test(text)
}

const KEPT: readonly GxColumn[] = ['class', 'label', 'type', 'assign', 'device', 'external']

/** Columns with texts that a tag has no place for, each once. */
function notKept(head: CellRow, rows: readonly CellRow[], heading: GxHeading): TagMessage[] {
  const kept = new Set(KEPT.flatMap((column) => heading.columns[column] ?? []))
  return head.cells.flatMap((header, at): TagMessage[] => {
    if (kept.has(at)) return []
    const filled = rows.filter(({ cells }) => {
      const comment = commentAt(cells, heading)
      const text = textOf(cells[at])
      return text !== '' && comment !== at && !(heading.comments.includes(at) && text === textOf(cells[comment ?? -1]))
    })
    if (filled.length === 0) return []
    const many = filled.length === 1 ? '1 cell is' : `${filled.length} cells are`
    return [{ line: head.line, about: 'note', message: `Of the column ${show(header)} ${many} not kept.` }]
  })
}
