// What a write node makes of values that are almost those of the type: text for numbers, 0 and 1 for bits.
import { byteTypes, parseByteType, valueTypes } from '../src/entry/address'
import type { PlcValue } from '../src/index'
import { NodeFailure } from './failure'
import type { NodeClient } from './family'
import type { Texts } from './texts'
import { isSame, type NamedEntry, type WritableValue } from './write-values'

/** Numbers as JSON writes them: no spaces, plus sign, leading zeros or hexadecimal digits. */
const WHOLE = /^-?(?:0|[1-9][0-9]*)$/
const REAL = /^-?(?:0|[1-9][0-9]*)(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?$/
/** Longer than any whole number of a type, so that nobody makes the node count millions of digits. */
const LONGEST = 20

const BITS: ReadonlyMap<PlcValue, boolean> = new Map<PlcValue, boolean>([
  [1, true],
  ['1', true],
  ['true', true],
  [0, false],
  ['0', false],
  ['false', false],
])

/**
 * The entries with their values as the types take them. What is no such text stays as it is, and the client refuses it.
 * @param almost text for every number, and 0, 1 and text for bits, as the user allowed; else text for LINT and ULINT alone,
 *   whose values are text in messages
 */
export async function fittingEntries(
  client: NodeClient,
  entries: readonly NamedEntry[],
  almost: boolean,
): Promise<NamedEntry[]> {
  const types = await typesOf(client, entries, almost)
  return entries.map((entry, index) => ({ ...entry, value: fitting(entry.value, types[index] ?? '', almost) }))
}

/** The failure of values that were not written as they are, with what to tick when that would make one of them fit. */
export function withHint(
  failure: NodeFailure,
  client: NodeClient,
  entries: readonly NamedEntry[],
  texts: Texts,
): NodeFailure {
  if (failure.code !== 'BAD_VALUE') return failure
  const helps = entries.some(({ item, value }) => {
    const type = knownType(client, item) ?? ''
    return !isSame(value, fitting(value, type, true), type)
  })
  if (!helps) return failure
  const sentence = failure.cause.message.replace(/\.?$/, '.')
  return new NodeFailure({ ...failure.cause, message: `${sentence} ${texts('error.almost')}` })
}

/** @param type of the item, e.g. `LINT` or `STRING(20)`; `''` when it is not known */
export function fitting(value: WritableValue, type: string, almost: boolean): WritableValue {
  if (type === '') return value
  const { kind } = KINDS[parseByteType(type).name]
  if (!almost && kind !== 'long') return value
  return Array.isArray(value) ? value.map((element) => fittingOne(element, kind)) : fittingOne(value, kind)
}

/** The types of every family. */
const KINDS = { ...valueTypes, ...byteTypes }
type Kind = (typeof KINDS)[keyof typeof KINDS]['kind']

function fittingOne(value: PlcValue, kind: Kind): PlcValue {
  switch (kind) {
    case 'bit':
      return BITS.get(value) ?? value
    case 'long':
      return isWhole(value) ? BigInt(value) : value
    case 'integer':
    case 'bcd':
      // Too large for a number is too large for the type: the client refuses it.
      return isWhole(value) ? Number(value) : value
    case 'real':
      return typeof value === 'string' && REAL.test(value) ? finite(value) : value
    case 'text':
      return value
    default:
      return kind satisfies never
  }
}

function isWhole(value: PlcValue): value is string {
  return typeof value === 'string' && value.length <= LONGEST && WHOLE.test(value)
}

/** `1e999` is no number of any type: as a text it is refused with what was given. */
function finite(text: string): number | string {
  const number = Number(text)
  return Number.isFinite(number) ? number : text
}

/** The type of each item whose value may need it. Of labels only the PLC knows it, and no label is a LINT. */
async function typesOf(client: NodeClient, entries: readonly NamedEntry[], almost: boolean): Promise<string[]> {
  const types = entries.map(({ item, value }) => (mayNeedType(value, almost) ? knownType(client, item) : ''))
  const asked = almost ? entries.filter((_, index) => types[index] === undefined) : []
  const results = asked.length === 0 ? [] : await client.read(asked.map(({ item }) => item))
  const found = new Map(asked.map((entry, index) => [entry, results[index]]))
  return entries.map((entry, index) => {
    const result = found.get(entry)
    // Why it could not be read is said by the write.
    return types[index] ?? (result?.ok === true ? result.type : undefined) ?? ''
  })
}

/** `''` for what is no item, which the write refuses; undefined for a label whose type was not given. */
function knownType(client: NodeClient, item: NamedEntry['item']): string | undefined {
  try {
    return client.explain(item).type
  } catch {
    return ''
  }
}

function mayNeedType(value: WritableValue, almost: boolean): boolean {
  if (Array.isArray(value)) return value.some((element) => mayNeedType(element, almost))
  return typeof value === 'string' || (almost && (value === 0 || value === 1))
}
