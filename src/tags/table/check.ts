/** Tables as programs without types, files and people give them: checked as a whole, with one message for each row. */

import { isPlainObject } from '../../basics/option-checks'
import { show } from '../../basics/show'
import { shortened } from '../../basics/typed-text'
import { RequestError } from '../../errors'
import { type ByteType, parseByteType } from '../../value/byte-type'
import { checkFormat } from '../../value/format'
import { deadbandProblem } from './deadband'
import { itemOfTag, scalingKinds, type Tag, type TagField, type TagItem, tagAccesses, tagFields } from './tag'
import { isNumberType } from './type'

/** What a family of PLCs knows of the item of a tag. */
export interface TagFacts {
  /** Type of one value. A label may have none here: its PLC says it. */
  readonly type?: ByteType
  /** Values of an array. */
  readonly count?: number
  /** The address alone, without type and count, as the tools of the family write it; missing for a label. */
  readonly device?: string
  /** Why it can only be read, e.g. for an input that the CPU refreshes. */
  readonly readOnly?: string
}

/**
 * Reads the item of a tag; a family of PLCs gives it.
 * @throws RequestError what is wrong with it
 */
export type ReadTagItem = (item: TagItem) => TagFacts

/** What is wrong with one row. */
export interface TagProblem {
  /** Which row, from 0. */
  readonly row: number
  /** Its name, when it has one. */
  readonly name?: string
  /** The fields that are wrong. */
  readonly fields: readonly TagField[]
  /** What is wrong, and what to write: all of it, one sentence or several. */
  readonly message: string
}

/** How rows are checked. */
export interface TagCheckOptions {
  /** Checks addresses, labels and types; without it only whether there are some. */
  readonly readItem?: ReadTagItem
  /** Rows for many machines: `{station}` stands for what differs, so addresses are not checked. */
  readonly template?: boolean
  /** What a row is called where a message names it; without it `row 3`. */
  readonly where?: (row: number) => string
}

/** Longest name, as other products have it. */
const LONGEST_NAME = 256
const LONGEST_DESCRIPTION = 1000
/** More rows are a mistake. */
const MOST_TAGS = 100_000

/** Half of a pair of surrogates: no file can hold it. */
const HALF = /\p{Surrogate}/u

/** What was left open for each machine. */
export const PLACEHOLDER = /\{([\p{L}_][\p{L}\p{M}\p{Nd}_]*)\}/gu

type Tell = (field: TagField, message: string) => void

/**
 * What is wrong with the rows of a table: one entry for each bad row, none when it can be used.
 * @example problemsOfTags([{ name: 'level', address: 'D100', type: 'REEL' }])[0].message
 */
export function problemsOfTags(rows: readonly unknown[], options: TagCheckOptions = {}): readonly TagProblem[] {
  if (!Array.isArray(rows))
    throw new RequestError('BAD_OPTION', `A table of tags is a list of rows, not ${show(rows)}.`)
  if (rows.length > MOST_TAGS) {
    throw new RequestError('LIMIT_EXCEEDED', `A table has at most ${MOST_TAGS} tags, not ${rows.length}.`)
  }
  const names = new Map<string, number>()
  return Array.from(rows, (row: unknown, at) => problemOf(row, at, names, options)).flatMap((problem) => problem ?? [])
}

function problemOf(
  row: unknown,
  at: number,
  names: Map<string, number>,
  options: TagCheckOptions,
): TagProblem | undefined {
  const fields = new Set<TagField>()
  const messages: string[] = []
  const tell: Tell = (field, message) => {
    fields.add(field)
    messages.push(message)
  }
  if (!isPlainObject(row)) {
    return { row: at, fields: [], message: `A row is an object with name and address, not ${show(row)}.` }
  }
  const known: readonly string[] = tagFields
  const unknown = Object.keys(row).filter((key) => !known.includes(key))
  if (unknown.length > 0) {
    messages.push(`A tag has no ${unknown.map((key) => show(key)).join(', ')}; it has ${tagFields.join(', ')}.`)
  }
  checkName(row.name, at, names, options, tell)
  if (checkFields(row, tell)) checkMeaning(row, options, tell)
  if (messages.length === 0) return undefined
  const name = typeof row.name === 'string' ? { name: row.name } : {}
  return { row: at, ...name, fields: [...fields], message: messages.join(' ') }
}

function checkName(
  name: unknown,
  at: number,
  names: Map<string, number>,
  { where = (row) => `row ${row + 1}` }: TagCheckOptions,
  tell: Tell,
): void {
  if (typeof name !== 'string' || name === '') {
    tell('name', `A tag needs a name, not ${show(name)}.`)
    return
  }
  if (name !== name.trim()) tell('name', `The name ${show(name)} has spaces around it.`)
  if (/\p{Cc}/u.test(name)) tell('name', 'The name has a control character, such as a tab or a new line.')
  if (HALF.test(name)) tell('name', 'The name has half a character.')
  if (name === '__proto__') tell('name', 'No tag can have the name __proto__.')
  if (name.length > LONGEST_NAME) tell('name', `The name has ${name.length} characters; ${LONGEST_NAME} is the most.`)
  // Two names that people take for one are one: GX Works does not tell upper from lower case either.
  const key = sameName(name)
  const first = names.get(key)
  if (first !== undefined) tell('name', `The name ${show(name)} is that of ${where(first)} already.`)
  else names.set(key, at)
}

/** What is the same for two names that differ in case or width only. */
export function sameName(name: string): string {
  return name.normalize('NFKC').toLowerCase()
}

/** Whether every field is of the kind it must be: only then it can be looked at as a tag. */
function checkFields(
  row: Readonly<Record<string, unknown>>,
  tell: Tell,
): row is Readonly<Record<string, unknown>> & Tag {
  let good = true
  const wrong: Tell = (field, message) => {
    good = false
    tell(field, message)
  }
  const { address, type, count, description, unit, scanClass, access, format } = row
  if (typeof address !== 'string' || address.trim() === '')
    wrong('address', `It needs an address, not ${show(address)}.`)
  if (type !== undefined && typeof type !== 'string')
    wrong('type', `The type is a text such as REAL, not ${show(type)}.`)
  if (count !== undefined && !(typeof count === 'number' && Number.isInteger(count) && count >= 1)) {
    wrong('count', `The count is a whole number from 1, not ${show(count)}.`)
  }
  for (const [field, text] of [
    ['description', description],
    ['unit', unit],
    ['scanClass', scanClass],
  ] as const) {
    if (text !== undefined && typeof text !== 'string') wrong(field, `${field} is a text, not ${show(text)}.`)
    else if (text !== undefined && text.length > LONGEST_DESCRIPTION)
      wrong(field, `${field} has ${text.length} characters; ${LONGEST_DESCRIPTION} is the most.`)
    else if (text !== undefined && HALF.test(text)) wrong(field, `${field} has half a character.`)
  }
  const accesses: readonly unknown[] = tagAccesses
  if (access !== undefined && !accesses.includes(access)) {
    wrong('access', `The access is ${tagAccesses.join(' or ')}, not ${show(access)}.`)
  }
  checkNumbers(row, wrong)
  if (format !== undefined)
    refusal(
      () => checkFormat(format as object),
      (message) => wrong('format', message),
    )
  return good
}

function isNumber(value: unknown): value is number {
  return typeof value === 'number' && Number.isFinite(value)
}

function checkNumbers({ scaling, deadband, min, max }: Readonly<Record<string, unknown>>, wrong: Tell): void {
  if (scaling !== undefined) checkScaling(scaling, wrong)
  if (deadband !== undefined) checkDeadband(deadband, wrong)
  for (const [field, limit] of [
    ['min', min],
    ['max', max],
  ] as const) {
    if (limit !== undefined && !isNumber(limit)) wrong(field, `${field} is a finite number, not ${show(limit)}.`)
  }
  if (isNumber(min) && isNumber(max) && min > max) wrong('min', `min (${min}) is above max (${max}).`)
}

function checkScaling(scaling: unknown, wrong: Tell): void {
  const kinds: readonly unknown[] = scalingKinds
  if (!isPlainObject(scaling) || !kinds.includes(scaling.kind)) {
    wrong(
      'scaling',
      `A scaling is an object whose kind is ${scalingKinds.join(' or ')}, with raw and engineering limits.`,
    )
    return
  }
  checkKeys(scaling, ['kind', 'raw', 'engineering', 'clamp'], (message) => wrong('scaling', message))
  for (const ends of ['raw', 'engineering'] as const) {
    const limits = scaling[ends]
    if (!Array.isArray(limits) || limits.length !== 2 || !limits.every(isNumber)) {
      wrong('scaling', `The ${ends} limits of a scaling are two finite numbers, as in [0, 4000].`)
    } else if (limits[0] === limits[1]) {
      wrong('scaling', `The ${ends} limits of a scaling are two different numbers, not twice ${limits[0]}.`)
    }
  }
  if (scaling.clamp !== undefined && typeof scaling.clamp !== 'boolean') {
    wrong('scaling', `clamp of a scaling is true or false, not ${show(scaling.clamp)}.`)
  }
}

function checkDeadband(deadband: unknown, wrong: Tell): void {
  const problem = deadbandProblem(deadband)
  if (problem !== undefined) wrong('deadband', problem)
  else if (isPlainObject(deadband) && deadband.of !== undefined) {
    wrong('deadband', 'The range of percent of a tag is that of its scaling, else from min to max: leave of out.')
  }
}

function checkKeys(given: object, names: readonly string[], tell: (message: string) => void): void {
  const unknown = Object.keys(given).find((key) => !names.includes(key))
  if (unknown !== undefined) tell(`There is no ${show(unknown)} in it; there is ${names.join(', ')}.`)
}

/** What the fields say together, and what the family of PLCs says to it. */
function checkMeaning(tag: Tag, { readItem, template = false }: TagCheckOptions, tell: Tell): void {
  if (!template) {
    for (const field of ['name', 'address', 'description', 'unit', 'scanClass'] as const) {
      const [open] = tag[field]?.match(PLACEHOLDER) ?? []
      if (open !== undefined) tell(field, `${open} in its ${field} has no value: tagsOfMachine() puts one in.`)
    }
  }
  if (
    tag.deadband?.kind === 'percent' &&
    tag.scaling === undefined &&
    (tag.min === undefined || tag.max === undefined)
  ) {
    tell('deadband', 'A deadband in percent needs a range: a scaling, or min and max.')
  }
  checkWithin(tag, tell)
  // Of a template the addresses are not there yet, but types are.
  const facts = factsOf(tag, template ? undefined : readItem, tell)
  if (facts?.type !== undefined) checkType(tag, facts.type, tell)
  if (facts?.readOnly !== undefined && tag.access === 'readWrite') tell('access', facts.readOnly)
}

/** What a clamped scaling never lets through cannot be written. */
function checkWithin({ scaling, min, max }: Tag, tell: Tell): void {
  if (scaling?.clamp !== true) return
  const [low, high] = [...scaling.engineering].sort((a, b) => a - b) as [number, number]
  if (min !== undefined && min > high) tell('min', `min (${min}) is above ${high}, where its scale ends.`)
  if (max !== undefined && max < low) tell('max', `max (${max}) is below ${low}, where its scale begins.`)
}

function factsOf(tag: Tag, readItem: ReadTagItem | undefined, tell: Tell): TagFacts | undefined {
  if (readItem !== undefined) {
    return refusal(
      () => readItem(itemOfTag(tag)),
      (message, error) => tell(error.code === 'BAD_TYPE' ? 'type' : 'address', message),
    )
  }
  const { type } = tag
  if (type === undefined) return undefined
  return refusal(
    () => ({ type: parseByteType(type) }),
    (message) => tell('type', message),
  )
}

/** What `run` gives, or undefined when it refuses; `tell` says why. */
function refusal<T>(run: () => T, tell: (message: string, error: RequestError) => void): T | undefined {
  try {
    return run()
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    tell(/[.!?]$/.test(error.message) ? error.message : `${error.message}.`, error)
    return undefined
  }
}

function checkType(tag: Tag, type: ByteType, tell: Tell): void {
  if (isNumberType(type)) return
  for (const field of ['scaling', 'deadband', 'min', 'max'] as const) {
    if (tag[field] !== undefined) tell(field, `${type.name} is no number: leave ${field} out.`)
  }
}

/**
 * Refuses rows that are no table, and says of each what is wrong.
 * @throws RequestError BAD_OPTION
 */
export function checkTags(rows: readonly unknown[], options: TagCheckOptions = {}): asserts rows is readonly Tag[] {
  const problems = problemsOfTags(rows, options)
  if (problems.length === 0) return
  const shown = problems.slice(0, MOST_SHOWN).map(textOfProblem)
  const more = problems.length > MOST_SHOWN ? [`And ${problems.length - MOST_SHOWN} more rows.`] : []
  throw new RequestError('BAD_OPTION', ['The table cannot be used.', ...shown, ...more].join('\n'), problems[0]?.name)
}

const MOST_SHOWN = 10

/** One line for people: row and name, and what is wrong. Rows count from 1. */
export function textOfProblem({ row, name, message }: TagProblem): string {
  return `Row ${row + 1}${name === undefined ? '' : ` (${shortened(name)})`}: ${message}`
}
