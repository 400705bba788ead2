/**
 * Labels among items: `label:Line1.Speed`, `Line1.Speed` and `Line1.Values[0]:INT[10]` beside `D100`.
 *
 * With the prefix `label:` anything is a label. Without it a text is one when the profile surely has labels and the text
 * cannot have been meant as an address: see `melsec/label/plain-label.ts`. The type behind a name is what the user expects; the
 * PLC says the type.
 */

import { shown } from '../../basics/show'
import { RequestError } from '../../errors'
import { isLabelName, isPlainLabel } from '../../melsec/label/plain-label'
import { doubtOf, lackOf, type Profile } from '../../melsec/profiles/profile'
import type { ParsedItem, RefusedItem } from '../item/item'
import { checkedItem, type Item, type ItemOptions, LABEL_PREFIX } from '../item/parts'
import { type AskedLabel, askedLabel } from './item'

/** An item that is a label. */
export interface LabelInItems {
  /** As it was given. Results and messages carry it. */
  readonly text: string
  readonly label: AskedLabel
}

/** What an item turned out to be. */
export type AnyItem = ParsedItem | RefusedItem | LabelInItems

export function isLabel(item: AnyItem): item is LabelInItems {
  return 'label' in item
}

/** Whether the item says that it is a label. Programs without types pass anything. */
export function hasPrefix(item: Item | undefined): boolean {
  return LABEL_PREFIX.test(addressOf(item))
}

function addressOf(item: Item | undefined): string {
  const text: unknown = typeof item === 'object' && item !== null ? item.address : item
  return typeof text === 'string' ? text : ''
}

/** What results call an item, also one that is none. */
export function itemText(item: Item | undefined): string {
  return typeof item === 'string' ? item : String(item?.address)
}

/**
 * A label as an item names it, with or without the prefix.
 * @throws RequestError BAD_ADDRESS, BAD_TYPE, BAD_OPTION, OUT_OF_RANGE
 */
export function parseLabelItem(item: Item): LabelInItems {
  const given = checkedItem(item)
  const { wordOrder, byteOrder, encoding, trimSpaces } = given
  for (const [field, value] of Object.entries({ wordOrder, byteOrder })) {
    if (value === undefined) continue
    const message = `${given.address}: a label takes no ${field}: the PLC says its type.`
    throw new RequestError('BAD_OPTION', message, field)
  }
  const parts = partsOf(given.address)
  const type = onlyOne(given, 'type', parts.type)
  const count = onlyOne(given, 'count', parts.count)
  const label = askedLabel({
    label: parts.name,
    ...(count === undefined ? {} : { count }),
    ...(type === undefined ? {} : { type }),
    ...(encoding === undefined ? {} : { encoding }),
    ...(trimSpaces === undefined ? {} : { trimSpaces }),
  })
  return { text: given.address, label }
}

/** Name, type and count of `Line1.Values[0]:INT[10]`. Brackets behind the name are an index, behind the type a count. */
function partsOf(text: string): { readonly name: string; readonly type?: string; readonly count?: number } {
  const [, name = '', type] = /^([^:]*)(?::(.*))?$/s.exec(text.replace(LABEL_PREFIX, '')) ?? []
  if (type === undefined) return { name }
  const [, counted = '', digits] = /^(.*?)(?:\[\s*(\d+)\s*\])?$/s.exec(type) ?? []
  return { name, type: counted, ...(digits === undefined ? {} : { count: Number(digits) }) }
}

function onlyOne<F extends 'type' | 'count'>(given: ItemOptions, field: F, inText: ItemOptions[F]): ItemOptions[F] {
  const own = given[field]
  if (inText === undefined || own === undefined || inText === own) return own ?? inText
  const message = `${given.address}: the ${field} is given twice, as ${inText} and as ${own}: leave one out.`
  throw new RequestError('BAD_OPTION', message, field)
}

/** What a text that is no device may be on this PLC. */
export interface LabelContext {
  readonly profile: Profile
}

/**
 * An item that no device is named by: the label it is, or why it is none, with what to do.
 * @param error why it is no item of a device
 */
export function labelInstead(item: Item, error: RequestError, { profile }: LabelContext): AnyItem {
  const text = addressOf(item)
  const refused = (message: string): RefusedItem => ({
    text: itemText(item),
    error: message === '' ? error : new RequestError(error.code, `${error.message} ${message}`, error.field),
  })
  const { name } = partsOf(text)
  if (!isLabelName(name.trim())) return refused('')
  const lack = lackOf(profile, 'readRandomLabels')
  const isPlain = isPlainLabel(name)
  if (lack !== undefined) return refused(isPlain ? `If it is a label: ${lack.reason} ${lack.instead}` : '')
  if (isPlain && doubtOf(profile, 'readRandomLabels') === undefined) return parsedLabel(item)
  return refused(error.code === 'BAD_ADDRESS' ? `If it is a label, write label:${shown(text.trim())}.` : '')
}

/** As `parseLabelItem`, with the error instead of the label. */
export function parsedLabel(item: Item): LabelInItems | RefusedItem {
  try {
    return parseLabelItem(item)
  } catch (error) {
    if (error instanceof RequestError) return { text: itemText(item), error }
    throw error
  }
}
