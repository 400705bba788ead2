// Reading settings as flows store them: a flow can be edited by hand, so nothing is taken for granted.
import { type NodeFailure, refusal } from './failure'
import type { StoredSettings } from './migration'
import type { Texts } from './texts'

/** One row of the list in the editor. */
export interface ItemRow {
  /** What the user calls it; `''`: the address. */
  readonly name: string
  readonly address: string
  /** `''`: the device's own. */
  readonly type: string
}

/** A text of the settings; `''` when there is none. @throws NodeFailure */
export function textIn(settings: StoredSettings, field: string, texts: Texts): string {
  const value = settings[field]
  if (value === undefined || value === null) return ''
  if (typeof value === 'string') return value
  if (typeof value === 'number') return String(value)
  throw notUnderstood(field, texts)
}

/** One of several words; the first when there is none. @throws NodeFailure */
export function wordIn<const T extends string>(
  settings: StoredSettings,
  field: string,
  words: readonly [T, ...T[]],
  texts: Texts,
): T {
  const text = textIn(settings, field, texts)
  const word = text === '' ? words[0] : words.find((candidate) => candidate === text)
  if (word === undefined) throw notUnderstood(field, texts)
  return word
}

/** The rows of the list, without empty ones. @throws NodeFailure for rows without an address, and for two of the same name. */
export function rowsIn(settings: StoredSettings, texts: Texts): (ItemRow & { readonly stored: StoredSettings })[] {
  const given = settings.items ?? []
  if (!Array.isArray(given)) throw notUnderstood('items', texts)
  const rows = given.flatMap((row: unknown, index) => rowOf(row, index, texts))
  const names = rows.map(nameOf)
  const twice = names.find((name, index) => names.indexOf(name) !== index)
  if (twice !== undefined) throw refusal('NOT_CONFIGURED', texts('error.sameName', { name: twice }), { field: 'items' })
  return rows
}

function rowOf(row: unknown, index: number, texts: Texts): (ItemRow & { readonly stored: StoredSettings })[] {
  if (typeof row !== 'object' || row === null) throw notUnderstood(`items[${index}]`, texts)
  const stored = row as StoredSettings
  const [name, address, type] = ['name', 'address', 'type'].map((field) => textIn(stored, field, texts).trim())
  if (!address && !name) return []
  if (!address)
    throw refusal('NOT_CONFIGURED', texts('error.rowWithoutAddress', { row: index + 1 }), { field: 'items' })
  return [{ name: name ?? '', address, type: type ?? '', stored }]
}

/** What an item is called in messages. */
export function nameOf({ name, address }: ItemRow): string {
  return name === '' ? address : name
}

/** What the client takes. */
export function itemOf({ address, type }: ItemRow): string | { readonly address: string; readonly type: string } {
  return type === '' ? address : { address, type }
}

function notUnderstood(field: string, texts: Texts): NodeFailure {
  return refusal('NOT_CONFIGURED', texts('error.notUnderstood', { field }), { field })
}
