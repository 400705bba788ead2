/** What an import gives: every row is a tag, or a message says why it is none. */
import type { TagCheckOptions } from '../table/check'
import type { Tag } from '../table/tag'
import type { CellDelimiter } from './cells'
import type { TagFileEncoding } from './encoding'

/** Files that are known. */
export const tagFileKinds = ['csv', 'json', 'gxWorks3Labels', 'gxWorks2Labels', 'deviceComments'] as const
/** See {@link tagFileKinds}. */
export type TagFileKind = (typeof tagFileKinds)[number]

/** What is to be known of a row, or of the file. */
export interface TagMessage {
  /** Line of the file, from 1; of JSON which tag it is, from 1. */
  readonly line: number
  /** `row`: this row has become no tag. `note`: something of the file is not kept. */
  readonly about: 'row' | 'note'
  /** What it is, and what to do. */
  readonly message: string
}

/** How a file is read. */
export interface TagImportOptions extends Omit<TagCheckOptions, 'where'> {
  /** What the file is; without it that is found out. */
  readonly kind?: TagFileKind
  /** Character code; without it that is found out. */
  readonly encoding?: TagFileEncoding
  /** What stands between two cells; without it that is found out. */
  readonly delimiter?: CellDelimiter
}

/** Tags of a file. */
export interface TagImport {
  /** What the file was read as. */
  readonly kind: TagFileKind
  /** Its character code. */
  readonly encoding: TagFileEncoding
  /** What stands between its cells; of JSON nothing does. */
  readonly delimiter?: CellDelimiter
  /** The rows that are tags, in their order. */
  readonly tags: readonly Tag[]
  /** The others, and what is not kept of the file; in the order of its lines. */
  readonly messages: readonly TagMessage[]
}

/** A row as it was understood, to be checked with the others. */
export interface Draft {
  readonly line: number
  /** A tag, perhaps a bad one; or why it is none. */
  readonly row: Readonly<Record<string, unknown>> | string
}

/** What a reader of one kind of files gives. */
export interface Drafts {
  readonly drafts: readonly Draft[]
  readonly notes: readonly TagMessage[]
}
