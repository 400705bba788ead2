/** Tags as files: CSV and JSON hold all of them; those for GX Works hold what it knows, and the rest is told. */
import { checkNames, type OptionNames, oneOf } from '../../basics/option-checks'
import { RequestError } from '../../errors'
import { isWordType } from '../../value/byte-type'
import { checkTags, type ReadTagItem, type TagFacts } from '../table/check'
import { itemOfTag, type Tag, type TagField, tagFields } from '../table/tag'
import { textOfRows } from './cells'
import { type CsvOptions, csvOfTags } from './csv'
import { fileOfText, type TagFileEncoding } from './encoding'
import { gxWorks2Heading, gxWorks3Heading } from './gx-headers'
import { gxNameOf } from './gx-type'
import { type TagFileKind, tagFileKinds } from './result'

/** How tags are written. */
export interface TagExportOptions extends CsvOptions {
  /** What the file is to be. */
  readonly kind: TagFileKind
  /** Character code; without it UTF-16 for GX Works, UTF-8 for the others. */
  readonly encoding?: TagFileEncoding
  /** Knows devices and types; needed for files of GX Works. */
  readonly readItem?: ReadTagItem
}

/** A file of tags. */
export interface TagExport {
  /** The file. */
  readonly bytes: Uint8Array
  /** Tags that are not in it or not with all that they say, and why. */
  readonly messages: readonly TagExportMessage[]
}

/** What of a tag is not in a file. */
export interface TagExportMessage {
  /** The tag. */
  readonly name: string
  /** `tag`: it is not in the file. `fields`: it is, without some of its fields. */
  readonly about: 'tag' | 'fields'
  /** What it is. */
  readonly message: string
}

/**
 * A file of tags. Texts that a spreadsheet would take for formulas are guarded by an apostrophe in CSV, which the import takes away.
 *
 * @throws RequestError BAD_OPTION for an option or a table that is wrong, BAD_VALUE for a character that the encoding does not have
 * @example exportTags(table.tags, { kind: 'csv' }).bytes
 */
export function exportTags(tags: readonly Tag[], options: TagExportOptions): TagExport {
  checkNames('', options, OPTIONS)
  const { kind, readItem } = options
  oneOf('kind', kind, tagFileKinds)
  checkTags(tags, { template: true })
  const { text, messages } = kind === 'csv' || kind === 'json' ? whole(tags, options) : forGxWorks(tags, kind, readItem)
  const usual = kind === 'csv' || kind === 'json' ? 'utf-8' : 'utf-16le'
  const bytes = fileOfText(text, options.encoding ?? usual)
  // JSON has no byte order mark (RFC 8259).
  return { bytes: kind === 'json' && (options.encoding ?? usual) === 'utf-8' ? bytes.subarray(3) : bytes, messages }
}

const OPTIONS: OptionNames<TagExportOptions> = { kind: true, encoding: true, delimiter: true, readItem: true }

interface Written {
  readonly text: string
  readonly messages: readonly TagExportMessage[]
}

function whole(tags: readonly Tag[], { kind, delimiter }: TagExportOptions): Written {
  if (kind === 'json') return { text: `${JSON.stringify({ tags: tags.map(ordered) }, null, 2)}\n`, messages: [] }
  return { text: csvOfTags(tags, delimiter === undefined ? {} : { delimiter }), messages: [] }
}

function ordered(tag: Tag): Partial<Tag> {
  return Object.fromEntries(tagFields.filter((field) => tag[field] !== undefined).map((field) => [field, tag[field]]))
}

type GxKind = Exclude<TagFileKind, 'csv' | 'json'>

function forGxWorks(tags: readonly Tag[], kind: GxKind, readItem: ReadTagItem | undefined): Written {
  if (readItem === undefined) {
    throw new RequestError('BAD_OPTION', 'Files of GX Works need a function that reads addresses.', 'readItem')
  }
  const messages: TagExportMessage[] = []
  const rows = tags.flatMap((tag) => {
    const made = rowOf(tag, kind, readItem)
    if (typeof made === 'string') messages.push({ name: tag.name, about: 'tag', message: made })
    else messages.push(...lostOf(tag, kind))
    return typeof made === 'string' ? [] : [made]
  })
  const heading = HEADINGS[kind]
  const body = rows.map((row) => heading.map((header) => row[header] ?? ''))
  return { text: textOfRows([[TITLE], [...heading], ...body], '\t', true), messages }
}

const TITLE = 'Tags'
const HEADINGS: Readonly<Record<GxKind, readonly string[]>> = {
  gxWorks3Labels: gxWorks3Heading,
  gxWorks2Labels: gxWorks2Heading,
  deviceComments: ['Device Name', 'Comment'],
}

/** Cells by header, or why the tag cannot be in such a file. */
type GxRow = Readonly<Record<string, string>> | string

function rowOf(tag: Tag, kind: GxKind, readItem: ReadTagItem): GxRow {
  let facts: TagFacts
  try {
    facts = readItem(itemOfTag(tag))
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    return error.message
  }
  const { device, type } = facts
  if (kind === 'deviceComments') {
    if (device === undefined) return 'A label has no device comment.'
    return tag.description === undefined
      ? 'It has no description.'
      : { 'Device Name': device, Comment: tag.description }
  }
  if (!/^[\p{L}_][\p{L}\p{M}\p{Nd}_]*$/u.test(tag.name)) {
    return 'Its name is no label name: these are letters, digits and underscores, and do not begin with a digit.'
  }
  if (device === undefined) return 'It is a label of the PLC already.'
  const dataType = type !== undefined && isWordType(type) ? gxNameOf(type, facts.count) : undefined
  if (dataType === undefined) return `GX Works has no data type for ${type?.name ?? 'it'} that takes the same words.`
  return {
    Class: 'VAR_GLOBAL',
    'Label Name': tag.name,
    'Data Type': dataType,
    [kind === 'gxWorks3Labels' ? 'Assign (Device/Label)' : 'Device']: device,
    Comment: tag.description ?? '',
  }
}

const HELD: Readonly<Record<GxKind, readonly TagField[]>> = {
  gxWorks3Labels: ['name', 'address', 'type', 'count', 'description'],
  gxWorks2Labels: ['name', 'address', 'type', 'count', 'description'],
  deviceComments: ['address', 'description'],
}

function lostOf(tag: Tag, kind: GxKind): TagExportMessage[] {
  const lost = tagFields.filter((field) => tag[field] !== undefined && !HELD[kind].includes(field))
  if (lost.length === 0) return []
  return [{ name: tag.name, about: 'fields', message: `The file has no place for ${lost.join(', ')}.` }]
}
