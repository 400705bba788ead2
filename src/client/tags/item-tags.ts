// A table of tags on the items of a client of any family.
import { checkNames, isPlainObject, type OptionNames } from '../../basics/option-checks'
import { show } from '../../basics/show'
import { ClosedError, type PlcError, RequestError, type WriteResult } from '../../errors'
import { checkTags, type ReadTagItem } from '../../tags/table/check'
import { thresholdOf } from '../../tags/table/deadband'
import type { TagTable } from '../../tags/table/table'
import { itemOfTag, type Tag, type TagItem } from '../../tags/table/tag'
import { rawValueOf } from '../../tags/table/write'
import type { CallOptions } from '../connection/call'
import { nameResults } from '../item/about'
import { namesOf } from '../item/input-checks'
import type { Items, ReadResult, WriteEntry, WriteValue } from '../item/item-value'
import { asPlainValue, byName, plainValue } from '../item/plain-values'
import { attempt, isFine } from '../item/value-or-error'
import { checkAllWritten } from '../item/write-outcome'
import type { ItemSource } from '../plan/item-calls'
import type { TagsOptions, TagWatchOptions } from '../plan/plc-tags'
import type { WriteCallOptions } from '../plan/write'
import type { Watch } from '../watch/watch'
import type { WatchedValue } from '../watch/watched-value'
import type { Watching } from '../watch/watching'
import { engineeringResult } from './engineering'

/** What a client lends its tags. */
export interface TagParts {
  readonly source: ItemSource
  readonly watching: Watching
  readonly readItem: ReadTagItem
}

type Names = readonly string[]
type Values = Readonly<Record<string, WatchedValue>>
type WatchCall = TagWatchOptions<Values>

const TAGS_OPTIONS: OptionNames<TagsOptions> = { scanClasses: true }

/** Tags by name, in their units. Its calls are typed by `PlcTags`. */
export class ItemTags {
  readonly table: TagTable
  readonly #parts: TagParts
  readonly #scanClasses: Readonly<Record<string, number>>
  /** One item for each tag: plans are found again, and what two watches share is read once. */
  readonly #items: ReadonlyMap<string, TagItem | string>

  /** @throws RequestError BAD_OPTION with one message for each row that is wrong for this PLC */
  constructor(parts: TagParts, table: TagTable, options: TagsOptions = {}) {
    if (!isPlainObject(table) || !Array.isArray(table.tags) || typeof table.tag !== 'function') {
      const message = `tags() takes a table that defineTags() or tagTable() has made, not ${show(table)}.`
      throw new RequestError('BAD_OPTION', message, 'table')
    }
    checkNames('', options, TAGS_OPTIONS)
    checkTags(table.tags, { readItem: parts.readItem })
    this.table = table
    this.#parts = parts
    this.#items = new Map(table.tags.map((tag) => [tag.name, shortest(itemOfTag(tag))]))
    const { scanClasses = {} } = options
    if (!isPlainObject(scanClasses)) {
      const message = `scanClasses are ms by scan class, e.g. { fast: 100 }, not ${show(scanClasses)}.`
      throw new RequestError('BAD_OPTION', message, 'scanClasses')
    }
    this.#scanClasses = { ...scanClasses }
  }

  async read(names?: string | Names, options?: CallOptions): Promise<unknown> {
    if (typeof names === 'string') return plainValue((await this.#results([names], options))[0])
    const chosen = this.#chosen(names)
    return byName(chosen, (await this.#results(chosen, options)).map(plainValue))
  }

  async readEach(names?: Names, options?: CallOptions): Promise<Record<string, ReadResult>> {
    const chosen = this.#chosen(names)
    return byName(chosen, await this.#results(chosen, options))
  }

  async #results(names: Names, options: CallOptions | undefined): Promise<ReadResult[]> {
    const tags = names.map((name) => this.table.tag(name))
    const results = await this.#parts.source.prepare(tags.map((tag) => this.#item(tag))).run(options)
    return nameResults(results, names).map((result, at) => {
      const tag = tags[at] as Tag
      return { ...engineeringResult(tag, result), item: tag.name }
    })
  }

  /** @throws RequestError BAD_OPTION */
  #chosen(names: Names | undefined): Names {
    if (names === undefined) return this.table.tags.map(({ name }) => name)
    if (Array.isArray(names)) return Array.from(names)
    throw new RequestError('BAD_OPTION', `Tags are a list of names, or nothing for all, not ${show(names)}.`, 'names')
  }

  async write(
    target: string | Readonly<Record<string, WriteValue>>,
    second?: WriteValue | WriteCallOptions,
    third?: WriteCallOptions,
  ): Promise<void> {
    if (typeof target === 'string') {
      const [result] = await this.#written([target], [second as WriteValue], third)
      if (result?.ok === false) throw result.error
      return
    }
    if (third !== undefined) {
      throw new RequestError('BAD_OPTION', 'Of many tags the options stand in the second place.', 'options')
    }
    const names = inOrder(target)
    // What is no object is refused by the client, as in any call.
    const given = (second ?? {}) as WriteCallOptions
    const options = isPlainObject(given) ? { allOrNothing: true, ...given } : given
    checkAllWritten(await this.#written(names, valuesOf(target, names), options))
  }

  async writeEach(
    values: Readonly<Record<string, WriteValue>>,
    options?: WriteCallOptions,
  ): Promise<Record<string, WriteResult>> {
    const names = inOrder(values)
    return byName(names, await this.#written(names, valuesOf(values, names), options))
  }

  /** A result for each, in their order: those that are refused here are never sent. */
  async #written(
    names: Names,
    values: readonly WriteValue[],
    options: WriteCallOptions | undefined,
  ): Promise<WriteResult[]> {
    const drafts = names.map((name, at) => attempt(() => this.#entry(name, values[at] as WriteValue)))
    const refusal = drafts.find((draft): draft is PlcError => !isFine(draft))
    if (refusal !== undefined && options?.allOrNothing === true) {
      return drafts.map((draft, at) => refused(names[at] ?? '', isFine(draft) ? leftOut(names[at], refusal) : draft))
    }
    const sent = drafts.flatMap((draft, at) => (isFine(draft) ? [{ entry: draft, name: names[at] ?? '' }] : []))
    const entries = sent.map(({ entry }) => entry)
    // Without entries there is nothing to permit.
    const results = nameResults(
      entries.length === 0 ? [] : await this.#parts.source.write(entries, options),
      sent.map(({ name }) => name),
    )
    const done = new Map(sent.map(({ name }, at) => [name, results[at]]))
    return drafts.map((draft, at) => {
      const name = names[at] ?? ''
      return isFine(draft) ? ({ ...done.get(name), item: name } as WriteResult) : refused(name, draft)
    })
  }

  /** @throws RequestError why it is not written */
  #entry(name: string, value: WriteValue): WriteEntry {
    const tag = this.table.tag(name)
    const { type, count } = this.#parts.readItem(itemOfTag(tag))
    return { item: this.#item(tag), value: rawValueOf(tag, type, count, asPlainValue(value)).raw }
  }

  watch(first: Names | WatchCall, second?: WatchCall): Watch<Values> {
    const isNamed = Array.isArray(first)
    const given: unknown = isNamed ? second : first
    if (!isPlainObject(given)) {
      throw new RequestError('BAD_OPTION', `Options of a watch are an object, e.g. { every: 100 }, not ${show(given)}.`)
    }
    const { scanClass, ...options } = given as WatchCall
    if (isNamed && scanClass !== undefined) {
      throw new RequestError('BAD_OPTION', 'Give the names of tags or their scan class, not both.', 'scanClass')
    }
    if ('deadband' in options) {
      throw new RequestError('BAD_OPTION', 'A tag has its deadband in the table.', 'deadband')
    }
    const every = options.every ?? this.#rateOf(scanClass)
    const tags = isNamed ? this.#chosen(first).map((name) => this.table.tag(name)) : this.#ofClass(scanClass)
    const items: Items = Object.fromEntries(tags.map((tag) => [tag.name, this.#item(tag)]))
    return this.#parts.watching.open(items, { ...options, ...(every === undefined ? {} : { every }) }, (name) => {
      const tag = this.table.tag(String(name))
      return { reach: thresholdOf(tag), seen: (result) => engineeringResult(tag, result) }
    }) as Watch<Values>
  }

  #item(tag: Tag): TagItem | string {
    return this.#items.get(tag.name) ?? itemOfTag(tag)
  }

  #rateOf(scanClass: string | undefined): number | undefined {
    if (scanClass === undefined) return undefined
    if (Object.hasOwn(this.#scanClasses, scanClass)) return this.#scanClasses[scanClass]
    const message = `Nothing says how fast ${show(scanClass)} is: give every, or scanClasses to tags().`
    throw new RequestError('BAD_OPTION', message, 'scanClass')
  }

  #ofClass(scanClass: string | undefined): readonly Tag[] {
    if (scanClass === undefined) return this.table.tags
    const tags = this.table.tags.filter((tag) => tag.scanClass === scanClass)
    if (tags.length > 0) return tags
    throw new RequestError('BAD_OPTION', `No tag has the scan class ${show(scanClass)}.`, 'scanClass')
  }
}

/**
 * JavaScript moves names that are whole numbers to the front of an object: the order in which they were written down is lost.
 * @throws RequestError BAD_OPTION
 */
function inOrder(values: Readonly<Record<string, WriteValue>>): Names {
  const names = namesOf(values, 'Values to write are a name and its value, or an object of values by name')
  const moved = names.find((name) => /^(0|[1-9]\d*)$/.test(name))
  if (moved === undefined || names.length < 2) return names
  const message = `In an object ${moved} comes first wherever it was written down, so that the order is lost: write it alone.`
  throw new RequestError('BAD_OPTION', message, moved)
}

/** An address alone is a text. */
function shortest(item: TagItem): TagItem | string {
  return Object.keys(item).length === 1 ? item.address : item
}

function valuesOf(values: Readonly<Record<string, WriteValue>>, names: Names): readonly WriteValue[] {
  return names.map((name) => values[name] as WriteValue)
}

function refused(item: string, error: PlcError): WriteResult {
  return { item, ok: false, error }
}

function leftOut(name: string | undefined, first: PlcError): ClosedError {
  const message = `${name} was not written, because all or nothing shall be: ${first.message}`
  return new ClosedError('ABORTED', message, 'notSent', first)
}
