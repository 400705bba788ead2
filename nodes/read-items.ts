// What a read node reads: the rows of its list, or addresses out of the message or the context.
import type { Item } from '../src/index'
import { refusal } from './failure'
import { kindOf } from './kind'
import type { Texts } from './texts'

/** Items with the names that the message will call them by. */
export interface NamedItems {
  readonly names: readonly string[]
  readonly items: readonly Item[]
}

/**
 * @param given an address, a list of addresses, or addresses by name; in place of an address an item with its type or
 *   order, as the library takes it
 * @throws NodeFailure BAD_INPUT when it is none of these.
 * @example namedItems({ level: 'D100:REAL' }, texts)   // names ['level'], items ['D100:REAL']
 */
export function namedItems(given: unknown, texts: Texts): NamedItems {
  const entries = entriesOf(given, texts)
  if (entries.length === 0) throw refusal('BAD_INPUT', texts('error.noAddresses'))
  return { names: entries.map(([name]) => name), items: entries.map(([, item]) => item) }
}

function entriesOf(given: unknown, texts: Texts): [string, Item][] {
  if (Array.isArray(given)) return given.map((item: unknown, index) => named(checked(item, texts, `[${index}]`)))
  if (isItem(given)) return [named(given)]
  if (typeof given !== 'object' || given === null || Buffer.isBuffer(given)) return [named(checked(given, texts))]
  return Object.entries(given).map(([name, item]: [string, unknown]) => [name, checked(item, texts, name)])
}

function named(item: Item): [string, Item] {
  return [typeof item === 'string' ? item : item.address, item]
}

/** @param place where it stands among others */
function checked(item: unknown, texts: Texts, place?: string): Item {
  if (isItem(item)) return item
  const kind = place === undefined ? kindOf(item) : `${place} = ${kindOf(item)}`
  throw refusal('BAD_INPUT', texts('error.notAddress', { kind }))
}

function isItem(given: unknown): given is Item {
  if (typeof given === 'string') return given.trim() !== ''
  return typeof given === 'object' && given !== null && 'address' in given && typeof given.address === 'string'
}
