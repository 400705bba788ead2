// What the calls of every client do with items, whatever their names and in whatever form they are given.
import { RequestError } from '../../errors'
import type { CallOptions } from '../connection/call'
import { nameResults } from '../item/about'
import { isItem, isList, namesOf, namesOfItems } from '../item/input-checks'
import type { Items, ReadResult, WriteEntry, WriteValue, WriteValues } from '../item/item-value'
import type { Item } from '../item/parts'
import { byName, entriesOf, plainValue } from '../item/plain-values'
import type { ReadPlan } from './plans'
import type { WriteCallOptions, WriteResult } from './write'

/** What a family does with items. */
export interface ItemSource {
  prepare(items: readonly Item[]): Pick<ReadPlan, 'run'>
  /** A result for each entry, in their order. */
  write(entries: readonly WriteEntry[], options: WriteCallOptions | undefined): Promise<WriteResult[]>
}

const ITEMS = 'Items to read are one item, a list of items, or an object of items by name'

export async function readItems(source: ItemSource, items: Item | Items, options?: CallOptions): Promise<unknown> {
  if (isItem(items)) return plainValue((await source.prepare([items]).run(options))[0])
  if (!isList(items)) namesOfItems(items, ITEMS)
  return readEachOf(source, items, options)
}

export async function readEachOf(source: ItemSource, items: Items, options?: CallOptions): Promise<unknown> {
  if (isList(items)) return source.prepare(items).run(options)
  const names = namesOf(items, ITEMS)
  return byName(names, await named(source, names, items, options))
}

export async function readValuesOf(source: ItemSource, items: Items, options?: CallOptions): Promise<unknown> {
  if (isList(items)) return (await source.prepare(items).run(options)).map(plainValue)
  const names = namesOf(items, ITEMS)
  return byName(names, (await named(source, names, items, options)).map(plainValue))
}

async function named(
  source: ItemSource,
  names: readonly string[],
  items: Readonly<Record<string, Item>>,
  call?: CallOptions,
): Promise<ReadResult[]> {
  return nameResults(await source.prepare(names.map((name) => items[name] as Item)).run(call), names)
}

/** Something prepared for items, in their order. */
interface Prepared {
  plan(items: readonly Item[]): ReadPlan
}

/** The plan of a list, or of items by name: its results are in the same form. */
export function planItems(source: Prepared, items: Items): ReadPlan<unknown> {
  if (isList(items)) return source.plan(items)
  const { list, named } = namedItems(items)
  const plan = source.plan(list)
  return {
    run: async (options) => named(await plan.run(options)),
    describe: () => plan.describe(),
    toString: () => plan.toString(),
  }
}

/** Items by name as a list, and what makes results by name of the results of the list. */
export function namedItems(items: Readonly<Record<string, Item>>): {
  readonly list: readonly Item[]
  readonly named: (results: readonly ReadResult[]) => Record<string, ReadResult>
} {
  const names = namesOf(items, 'Items to read are a list of items, or an object of items by name')
  return {
    list: names.map((name) => items[name] as Item),
    named: (results) => byName(names, nameResults(results, names)),
  }
}

/** One item and its value. */
export async function writeItem(
  source: ItemSource,
  item: Item,
  value: WriteValue,
  options?: WriteCallOptions,
): Promise<void> {
  const [result] = await source.write([{ item, value }], options)
  if (result?.ok === false) throw result.error
}

export async function writeEachOf(
  source: ItemSource,
  values: WriteValues,
  options?: WriteCallOptions,
): Promise<WriteResult[] | Record<string, WriteResult>> {
  const results = await source.write(entriesOf(values), options)
  return isList(values) ? results : byName(Object.keys(values), results)
}

/** Options in the third place, ignored there, would be the usual ones without anybody noticing. */
export function optionsOfMany<Options>(second: Options, third: unknown): Options {
  if (third === undefined) return second
  const message =
    'Of many values the options stand in the second place: write({ D0: 1, D1: 2 }, { allOrNothing: true }).'
  throw new RequestError('BAD_OPTION', message, 'options')
}
