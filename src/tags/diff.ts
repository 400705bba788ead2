/**
 * What an import changes of a table, to be seen before anything is replaced, and the table that is made of both.
 *
 * An import says what is in the PLC: address, type, count and description. What people added (unit, scaling, limits, deadband and so on) stays,
 * unless the import has it too. Where both cannot be right, the row is in conflict and stays as it was, until somebody decides.
 */
import { show } from '../basics/show'
import { RequestError } from '../errors'
import { formatByteType, parseByteType } from '../value/byte-type'
import {
  checkTags,
  problemsOfTags,
  type ReadTagItem,
  sameName,
  type TagCheckOptions,
  type TagFacts,
} from './table/check'
import { itemOfTag, type Tag, type TagField, type TagItem, tagFields } from './table/tag'

/** One field that changes; undefined where it is not there. */
export interface TagFieldChange {
  /** Which field. */
  readonly field: TagField
  /** As the table has it. */
  readonly before: unknown
  /** As the merged table will have it. */
  readonly after: unknown
}

/** A tag that changes. */
export interface TagChange {
  /** Its name. */
  readonly name: string
  /** As the table has it. */
  readonly before: Tag
  /** As the merged table will have it. */
  readonly after: Tag
  /** What differs. */
  readonly fields: readonly TagFieldChange[]
}

/** A tag about which somebody must decide. */
export interface TagConflict {
  /** Its name in the table. */
  readonly name: string
  /** As the table has it. */
  readonly before: Tag
  /** As the import has it. */
  readonly imported: Tag
  /** Why both cannot be right. */
  readonly reason: string
}

/** What an import does to a table. */
export interface TagDifference {
  /** Tags that the import adds. */
  readonly added: readonly Tag[]
  /** Tags that change, field by field. */
  readonly changed: readonly TagChange[]
  /** Tags that the import does not have. */
  readonly gone: readonly Tag[]
  /** Tags about which somebody must decide. */
  readonly conflicts: readonly TagConflict[]
  /** How many tags stay as they are. */
  readonly same: number
}

/** What becomes of a tag of the table. */
type Fate = { readonly tag: Tag } & (
  | { readonly kind: 'same' | 'gone' }
  | { readonly kind: 'changed'; readonly after: Tag }
  | { readonly kind: 'conflict'; readonly imported: Tag; readonly reason: string }
)

interface Compared {
  readonly fates: readonly Fate[]
  readonly added: readonly Tag[]
}

/**
 * What `mergeTags` would do.
 * @throws RequestError BAD_OPTION for rows that are no table
 */
export function diffTags(
  table: readonly Tag[],
  imported: readonly Tag[],
  options: TagCheckOptions = {},
): TagDifference {
  const { fates, added } = compared(table, imported, options)
  return {
    added,
    changed: fates.flatMap((fate) => (fate.kind === 'changed' ? [changeOf(fate.tag, fate.after)] : [])),
    gone: fates.flatMap((fate) => (fate.kind === 'gone' ? [fate.tag] : [])),
    conflicts: fates.flatMap((fate) =>
      fate.kind === 'conflict'
        ? [{ name: fate.tag.name, before: fate.tag, imported: fate.imported, reason: fate.reason }]
        : [],
    ),
    same: fates.filter(({ kind }) => kind === 'same').length,
  }
}

/** How a table and an import become one. */
export interface TagMergeOptions extends TagCheckOptions {
  /** Tags that the import does not have: kept (default), because people may have added them, or removed. */
  readonly gone?: 'keep' | 'remove'
  /** Tags in conflict: the row of the table (default), or that of the import without what people added. */
  readonly conflicts?: 'keep' | 'replace'
}

/**
 * The table that is made of a table and an import, in the order of the table, with what is new behind it. Merging the same import again
 * changes nothing.
 * @throws RequestError BAD_OPTION for rows that are no table, and when the merged rows are none
 */
export function mergeTags(table: readonly Tag[], imported: readonly Tag[], options: TagMergeOptions = {}): Tag[] {
  const { gone = 'keep', conflicts = 'keep' } = options
  if (!['keep', 'remove'].includes(gone))
    throw new RequestError('BAD_OPTION', `gone is ${show(gone)}; it is keep or remove.`, 'gone')
  if (!['keep', 'replace'].includes(conflicts)) {
    throw new RequestError('BAD_OPTION', `conflicts is ${show(conflicts)}; it is keep or replace.`, 'conflicts')
  }
  const { fates, added } = compared(table, imported, options)
  const kept = fates.flatMap((fate): Tag[] => {
    if (fate.kind === 'changed') return [fate.after]
    if (fate.kind === 'conflict') return [conflicts === 'keep' ? fate.tag : fate.imported]
    return fate.kind === 'gone' && gone === 'remove' ? [] : [fate.tag]
  })
  const merged = [...kept, ...added]
  checkTags(merged, { template: true })
  return merged.map((tag) => structuredClone(tag))
}

function compared(table: readonly Tag[], imported: readonly Tag[], given: TagCheckOptions): Compared {
  const options = given.readItem === undefined ? given : { ...given, readItem: remembering(given.readItem) }
  checkTags(table, { template: true })
  checkTags(imported, { template: true })
  const found = new Map(imported.map((tag) => [sameName(tag.name), tag]))
  const fates = table.map((tag) => fateOf(tag, found.get(sameName(tag.name)), options))
  const names = new Set(table.map(({ name }) => sameName(name)))
  return { fates, added: imported.filter(({ name }) => !names.has(sameName(name))) }
}

function fateOf(tag: Tag, imported: Tag | undefined, options: TagCheckOptions): Fate {
  if (imported === undefined) return { kind: 'gone', tag }
  const after = mergedTag(tag, imported, options)
  const reason = conflictOf(tag, imported, after, options)
  if (reason !== undefined) return { kind: 'conflict', tag, imported, reason }
  return changeOf(tag, after).fields.length === 0 ? { kind: 'same', tag } : { kind: 'changed', tag, after }
}

function changeOf(before: Tag, after: Tag): TagChange {
  const fields = tagFields
    .filter((field) => !isSame(before[field], after[field]))
    .map((field): TagFieldChange => ({ field, before: before[field], after: after[field] }))
  return { name: before.name, before, after, fields }
}

/** Whether two fields say the same, in whatever order their parts stand. */
function isSame(a: unknown, b: unknown): boolean {
  if (Object.is(a, b)) return true
  if (typeof a !== 'object' || typeof b !== 'object' || a === null || b === null) return false
  const [ofA, ofB] = [new Map(Object.entries(a)), new Map(Object.entries(b))]
  return [...new Set([...ofA.keys(), ...ofB.keys()])].every((key) => isSame(ofA.get(key), ofB.get(key)))
}

/** What stands in front of type, count, range and index, as far as that can be said without knowing the family. */
function isBare(address: string): boolean {
  return !/[:[,]|\.\./.test(address.replace(/^\s*label:/i, ''))
}

function mergedTag(tag: Tag, imported: Tag, options: TagCheckOptions): Tag {
  const { name: _name, address, type, count, ...others } = imported
  const { address: oldAddress, type: oldType, count: oldCount, ...own } = tag
  const item = isSameItem(tag, imported, options)
    ? {
        address: oldAddress,
        ...(oldType === undefined ? {} : { type: oldType }),
        ...(oldCount === undefined ? {} : { count: oldCount }),
      }
    : isBare(address) && type === undefined && count === undefined
      ? untyped(tag, address)
      : { address, ...(type === undefined ? {} : { type }), ...(count === undefined ? {} : { count }) }
  const said = Object.fromEntries(Object.entries(others).filter(([, value]) => value !== undefined))
  return { ...own, ...said, ...item }
}

/** Whether the family reads the same device, type and count from two spellings: `D100:REAL` and `D100` with the type REAL. */
function isSameItem(tag: Tag, imported: Tag, { readItem }: TagCheckOptions): boolean {
  if (readItem === undefined) return false
  const [before, now] = [tag, imported].map(({ address, type, count }) =>
    factsOf(
      { name: tag.name, address, ...(type === undefined ? {} : { type }), ...(count === undefined ? {} : { count }) },
      readItem,
    ),
  )
  if (before?.device === undefined || now === undefined) return false
  return isSame({ ...before, readOnly: undefined }, { ...now, readOnly: undefined })
}

/** The same item is asked for as it was, as it is imported, and as it will be. */
function remembering(readItem: ReadTagItem): ReadTagItem {
  const known = new Map<string, () => TagFacts>()
  const asked = (item: TagItem) => {
    try {
      const facts = readItem(item)
      return () => facts
    } catch (error) {
      return () => {
        throw error
      }
    }
  }
  return (item) => {
    const key = JSON.stringify(item)
    const answer = known.get(key) ?? asked(item)
    known.set(key, answer)
    return answer()
  }
}

function factsOf(tag: Tag, readItem: ReadTagItem): TagFacts | undefined {
  try {
    return readItem(itemOfTag(tag))
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    return undefined
  }
}

/** Comments of devices have no type: that of the table stays. */
function untyped({ address: old, type, count }: Tag, address: string): Pick<Tag, 'address' | 'type' | 'count'> {
  const begins = old.trim().toUpperCase().startsWith(address.trim().toUpperCase())
  const isTyped = begins && /^\s*(?:[:[,]|\.\.)/.test(old.trim().slice(address.trim().length))
  return {
    address: isTyped ? old : address,
    ...(type === undefined ? {} : { type }),
    ...(count === undefined ? {} : { count }),
  }
}

/** What people added and what only holds for the type they saw. */
const DEPENDING: readonly TagField[] = ['scaling', 'deadband', 'min', 'max', 'format']

function conflictOf(tag: Tag, imported: Tag, after: Tag, options: TagCheckOptions): string | undefined {
  if (tag.name !== imported.name)
    return `The import calls it ${show(imported.name)}, which people take for the same name.`
  const [before, now] = [typeTextOf(tag, options), typeTextOf(after, options)]
  const depending = DEPENDING.filter((field) => tag[field] !== undefined && imported[field] === undefined)
  if (before !== now && depending.length > 0) {
    return `Its type was ${before ?? 'not said'} and is ${now ?? 'not said'} now, but its ${depending.join(', ')} ${depending.length === 1 ? 'was' : 'were'} made for the old one.`
  }
  if (!isBare(tag.address) && isBare(after.address) && after.type === undefined) {
    return `Its address was ${tag.address} and is ${after.address} now, without a type.`
  }
  return problemsOfTags([after], { ...options, template: options.template ?? options.readItem === undefined })[0]
    ?.message
}

/** The type of a tag in one spelling; of an address that does not say it what the family knows. */
function typeTextOf(tag: Tag, { readItem }: TagCheckOptions): string | undefined {
  if (readItem !== undefined) {
    const type = factsOf(tag, readItem)?.type
    return type === undefined ? undefined : formatByteType(type)
  }
  try {
    const text = tag.type ?? /:([^:[]*)/.exec(tag.address.replace(/^\s*label:/i, ''))?.[1]
    return text === undefined ? undefined : formatByteType(parseByteType(text))
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    return undefined
  }
}
