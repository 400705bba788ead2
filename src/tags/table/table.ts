/** Tags as a table: checked once, found by name. */

import { isPlainObject } from '../../basics/option-checks'
import { show } from '../../basics/show'
import { RequestError } from '../../errors'
import { checkTags, sameName, type TagCheckOptions } from './check'
import type { Tag, TagFields } from './tag'

/** A tag of `defineTags`: an address, or all of its fields but the name. */
export type TagDefinition = string | TagFields

/** Tags by name. */
export type TagDefinitions = Readonly<Record<string, TagDefinition>>

/** A table of tags. Its type parameter carries the definitions, so that values can be typed by name. */
export interface TagTable<D extends TagDefinitions = TagDefinitions> {
  /** Every tag, in the order it was given. */
  readonly tags: readonly Tag[]
  /** The tags as they were defined, by name. */
  readonly definitions: D
  /**
   * The tag of a name.
   * @throws RequestError BAD_OPTION when there is none, with the name that may be meant
   */
  tag(name: keyof D & string): Tag
}

/**
 * A table from names and addresses, as a program writes it.
 * @throws RequestError BAD_OPTION with one message for each row that is wrong
 * @example defineTags({ level: 'D100:REAL', pump: { address: 'M0', access: 'readWrite' } })
 */
export function defineTags<const D extends TagDefinitions>(definitions: D, options: TagCheckOptions = {}): TagTable<D> {
  if (!isPlainObject(definitions)) {
    throw new RequestError(
      'BAD_OPTION',
      `Tags are an object of addresses by name, as in { level: 'D100:REAL' }, not ${show(definitions)}.`,
    )
  }
  const rows = Object.entries(definitions).map(([name, given]: [string, unknown]) => {
    if (typeof given === 'string') return { name, address: given }
    return isPlainObject(given) ? { ...given, name } : { name, address: given }
  })
  checkTags(rows, options)
  return tableOf(rows, definitions)
}

/**
 * A table from rows, as a file or an editor gives them.
 * @throws RequestError BAD_OPTION with one message for each row that is wrong; `problemsOfTags` gives them as data
 */
export function tagTable(rows: readonly Tag[], options: TagCheckOptions = {}): TagTable {
  checkTags(rows, options)
  return tableOf(rows, Object.fromEntries(rows.map(({ name, ...fields }) => [name, fields])))
}

function tableOf<D extends TagDefinitions>(rows: readonly Tag[], definitions: D): TagTable<D> {
  // Whoever gave the rows may change them later: a checked table does not change.
  const tags = rows.map((row) => structuredClone(row))
  const byName = new Map(tags.map((tag) => [tag.name, tag]))
  return {
    tags,
    definitions,
    tag: (name) => byName.get(name) ?? noTag(name, tags),
  }
}

function noTag(name: unknown, tags: readonly Tag[]): never {
  const meant = typeof name === 'string' ? tags.find((tag) => sameName(tag.name) === sameName(name.trim())) : undefined
  const hint = meant === undefined ? `The table has ${tags.length} tags.` : `It has ${show(meant.name)}.`
  throw new RequestError('BAD_OPTION', `There is no tag ${show(name)}. ${hint}`, String(name))
}
