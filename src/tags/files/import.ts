/** Files into tags: what a file is, and each of its rows as a tag or as a message that says why it is none. */
import { checkNames, isPlainObject, type OptionNames, oneOf } from '../../basics/option-checks'
import { RequestError } from '../../errors'
import { problemsOfTags } from '../table/check'
import type { Tag } from '../table/tag'
import { type CellDelimiter, type CellRow, delimiters, rowsOf } from './cells'
import { draftsOfCsv, isCsvHeader } from './csv'
import { type FileText, textOfFile } from './encoding'
import { gxKindOf, headingOf } from './gx-headers'
import { draftsOfGx } from './gx-rows'
import {
  type Drafts,
  type TagFileKind,
  type TagImport,
  type TagImportOptions,
  type TagMessage,
  tagFileKinds,
} from './result'

/**
 * The tags of a file: labels and device comments of GX Works3 and GX Works2, CSV, JSON. What it is, its character code, delimiter and
 * decimal sign are found out.
 *
 * No row is dropped in silence: each is a tag, or there is a message with its line; of columns that are not kept there are notes.
 *
 * @throws RequestError BAD_VALUE for a file that is none of these, or of the given `kind`; BAD_OPTION for an unknown option
 * @example importTags(await readFile('GlobalLabels.csv')).tags
 */
export function importTags(bytes: Uint8Array, options: TagImportOptions = {}): TagImport {
  checkNames('', options, OPTIONS)
  if (options.kind !== undefined) oneOf('kind', options.kind, tagFileKinds)
  if (options.delimiter !== undefined) oneOf('delimiter', options.delimiter, delimiters)
  const file = textOfFile(bytes, options.encoding, isKnown)
  const { kind, delimiter, drafts, notes } = contentOf(file.text, options)
  const rows = drafts.flatMap(({ line, row }) => (typeof row === 'string' ? [] : [{ line, row }]))
  const unread = drafts.flatMap(({ line, row }) => (typeof row === 'string' ? [about(line, row)] : []))
  const problems = problemsOfTags(
    rows.map(({ row }) => row),
    { ...options, where: (at) => `${kind === 'json' ? 'entry' : 'line'} ${rows[at]?.line}` },
  )
  const bad = new Map(problems.map((problem) => [problem.row, problem]))
  const refused = [...bad.values()].map(({ row, name, message }) =>
    about(rows[row]?.line ?? 0, name === undefined ? message : `${name}: ${message}`),
  )
  return {
    kind,
    encoding: file.encoding,
    ...(delimiter === undefined ? {} : { delimiter }),
    // Checked: what is left is a table.
    tags: rows.filter((_, at) => !bad.has(at)).map(({ row }) => row as unknown as Tag),
    messages: [...doubtOf(file, kind), ...notes, ...unread, ...refused].sort((a, b) => a.line - b.line),
  }
}

const OPTIONS: OptionNames<TagImportOptions> = {
  kind: true,
  encoding: true,
  delimiter: true,
  readItem: true,
  template: true,
}

function about(line: number, message: string): TagMessage {
  return { line, about: 'row', message }
}

function doubtOf({ encoding, alternatives }: FileText, kind: TagFileKind): TagMessage[] {
  // JSON is UTF-8 (RFC 8259).
  if (alternatives.length === 0 || (kind === 'json' && encoding === 'utf-8')) return []
  const message = `The file was read as ${encoding}; ${alternatives.join(' or ')} is nearly as likely. If texts are wrong, say the encoding.`
  return [{ line: 1, about: 'note', message }]
}

interface Content extends Drafts {
  readonly kind: TagFileKind
  readonly delimiter?: CellDelimiter
}

function contentOf(text: string, options: TagImportOptions): Content {
  const { kind } = options
  if (kind === 'json' || (kind === undefined && /^\s*[[{]/.test(text))) return { kind: 'json', ...draftsOfJson(text) }
  const found = tableIn(text, options.delimiter)
  if (found === undefined || (kind !== undefined && kind !== found.kind)) {
    const expected = kind === undefined ? 'a file of tags, labels or device comments' : `a file of the kind ${kind}`
    const is = found === undefined ? '' : ` It looks like ${found.kind}.`
    throw new RequestError(
      'BAD_VALUE',
      `This is not ${expected}: no line names its columns, such as "Name" and "Address", or "Label Name" and "Data Type".${is}`,
      'kind',
    )
  }
  const { rows, delimiter } = found
  const drafts = found.kind === 'csv' ? draftsOfCsv(rows, delimiter) : draftsOfGx(rows, found.kind)
  return { kind: found.kind, delimiter, ...drafts }
}

interface FoundTable {
  readonly kind: Exclude<TagFileKind, 'json'>
  readonly delimiter: CellDelimiter
  /** From the heading on. */
  readonly rows: readonly CellRow[]
}

/** In front of the heading stand the name of a project, and for Excel the delimiter. */
const MOST_TITLES = 4

/** The table that the first delimiter with a heading makes. */
function tableIn(text: string, given: CellDelimiter | undefined): FoundTable | undefined {
  for (const delimiter of given === undefined ? delimiters : [given]) {
    const top = rowsOf(firstLines(text), delimiter).slice(0, MOST_TITLES)
    for (const { line, cells } of top) {
      const kind = isCsvHeader(cells) ? 'csv' : gxKindOf(headingOf(cells))
      if (kind === undefined) continue
      return { kind, delimiter, rows: rowsOf(text, delimiter).filter((row) => row.line >= line) }
    }
  }
  return undefined
}

function firstLines(text: string): string {
  return text.split('\n', MOST_TITLES + 1).join('\n')
}

/** Whether a text has the heading of such a file: then its character code is the right one. */
function isKnown(text: string): boolean {
  return tableIn(text, undefined) !== undefined
}

function draftsOfJson(text: string): Drafts {
  let found: unknown
  try {
    found = JSON.parse(text)
  } catch (error) {
    throw new RequestError(
      'BAD_VALUE',
      `The file is no JSON: ${error instanceof Error ? error.message : String(error)}.`,
    )
  }
  const rows: unknown = isPlainObject(found) ? found.tags : found
  if (!Array.isArray(rows))
    throw new RequestError(
      'BAD_VALUE',
      'A JSON file of tags is a list of tags, or an object with such a list as "tags".',
    )
  const others = isPlainObject(found) ? Object.keys(found).filter((key) => key !== 'tags') : []
  const notes = others.map(
    (key): TagMessage => ({ line: 1, about: 'note', message: `"${key}" is not known, and is not kept.` }),
  )
  const drafts = Array.from(rows, (row: unknown, at) => ({
    line: at + 1,
    row: isPlainObject(row) ? row : 'It is no object with name and address.',
  }))
  return { drafts, notes }
}
