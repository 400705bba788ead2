// Names and data types of global labels, and how many names fit into one request (SLMP reference manual 5.3).
import { RequestError } from '../../errors'

/** A data type a label can have. */
export interface LabelDataType {
  /** Data type ID in answers. */
  readonly id: number
  /** As the label editor of GX Works3 shows it. */
  readonly title: string
  /** Bytes of one value as Label Read Random and Label Write Random carry it; text: what the label was declared with. */
  readonly bytes?: 2 | 4 | 8
}

/** Every data type ID (5.3 "Data type ID"). Contacts and coils are 1, current values 2 or, of the long ones, 3. */
export const labelDataTypes: readonly LabelDataType[] = [
  { id: 1, title: 'Bit', bytes: 2 },
  { id: 2, title: 'Word [Unsigned]/Bit String [16-bit]', bytes: 2 },
  { id: 3, title: 'Double Word [Unsigned]/Bit String [32-bit]', bytes: 4 },
  { id: 4, title: 'Word [Signed]', bytes: 2 },
  { id: 5, title: 'Double Word [Signed]', bytes: 4 },
  { id: 6, title: 'FLOAT [Single Precision]', bytes: 4 },
  { id: 7, title: 'FLOAT [Double Precision]', bytes: 8 },
  { id: 8, title: 'Time', bytes: 4 },
  { id: 9, title: 'String' },
  { id: 10, title: 'String [Unicode]' },
]

/** The ID of bits, whose arrays are counted in bits. */
export const BIT_TYPE_ID = 1
/** Erratum: the manual's table says 10, its example of Label Read Random prints the byte 10H. Nothing else is 10H. */
const PRINTED_UNICODE_ID = 0x10

/** The data type an answer means; undefined when the manual does not know the ID. */
export function labelDataType(id: number): LabelDataType | undefined {
  const meant = id === PRINTED_UNICODE_ID ? 10 : id
  return labelDataTypes.find((type) => type.id === meant)
}

/** The name of a label, taken apart. */
export interface LabelAddress {
  /** As it is sent: `Line1.Values[2,0]`. */
  readonly name: string
  /** Without the index at its end: `Line1.Values`. */
  readonly stem: string
  /** Index at its end, one to three numbers; of a label that is no element of an array undefined. */
  readonly index?: readonly number[]
}

const SEGMENT = /^([^.,%[\]\s\p{Cc}]+)(?:\[\s*(\d{1,10}(?:\s*,\s*\d{1,10}){0,2})\s*\])?$/u

/** Characters of a text in a message. */
const SHOWN = 100

function badLabel(text: string, reason: string): RequestError {
  return new RequestError(
    'BAD_ADDRESS',
    `'${text.slice(0, SHOWN)}' is not the name of a label: ${reason.slice(0, SHOWN)}. Write it as in Line1.Speed, Line1.Values[2] or Table[1,0,3].`,
  )
}

/**
 * Takes the name of a label apart. The case is kept as it is; spaces around indexes are dropped.
 * @throws RequestError BAD_ADDRESS, also for what the manual does not take: bits of a label, an index that is a label
 * @example parseLabel('Line1.Values[2, 0]') // { name: 'Line1.Values[2,0]', stem: 'Line1.Values', index: [2, 0] }
 */
export function parseLabel(text: string): LabelAddress {
  if (typeof text !== 'string') throw badLabel(String(text), 'it must be a text')
  const given = text.trim()
  if (given === '') throw badLabel(text, 'it is empty')
  // A dot never stands within brackets: an index is numbers only.
  const parts = given.split('.').map((segment, at) => segmentOf(text, segment, at))
  const last = parts.at(-1)
  const name = parts.map(({ spelt }) => spelt).join('.')
  if (last?.index === undefined) return { name, stem: name }
  return { name, stem: [...parts.slice(0, -1).map(({ spelt }) => spelt), last.word].join('.'), index: last.index }
}

function segmentOf(text: string, segment: string, at: number) {
  const [, word, digits] = SEGMENT.exec(segment.trim()) ?? []
  if (word === undefined) {
    const index = /\[([^\]]*)\]/.exec(segment)?.[1]
    const reason =
      index === undefined ? `there is something wrong at '${segment}'` : `[${index}] is not one to three numbers`
    throw badLabel(text, reason)
  }
  if (at > 0 && /^[0-9]+$/.test(word)) throw badLabel(text, 'the bit of a label cannot be named; read the whole label')
  const index = digits?.split(',').map(Number)
  return { word, index, spelt: index === undefined ? word : `${word}[${index.join(',')}]` }
}

/** Names as they are sent, and what their abbreviations stand for. */
export interface Abbreviated {
  readonly abbreviations: readonly { readonly name: string }[]
  readonly names: readonly string[]
}

/**
 * Spells names with `%1`, `%2` ... where that makes the message shorter (5.3 "Label name abbreviation"): an
 * abbreviation is whole members, none of them an element of an array.
 * @example abbreviated(['Line1.Speed', 'Line1.Level']).names // ['%1.Speed', '%1.Level']
 */
export function abbreviated(names: readonly string[]): Abbreviated {
  const spelt = [...names]
  const abbreviations: { name: string }[] = []
  for (;;) {
    const mark = `%${abbreviations.length + 1}`
    const best = bestPrefix(spelt, mark)
    if (best === undefined) return { abbreviations, names: spelt }
    abbreviations.push({ name: best })
    spelt.forEach((name, at) => {
      if (name.startsWith(`${best}.`)) spelt[at] = `${mark}${name.slice(best.length)}`
    })
  }
}

/** UTF-16 units an abbreviation costs beside its characters: its length, which is as wide as one unit. */
const LENGTH_FIELD = 1

/** The beginning whose abbreviation saves most; undefined when none saves anything. */
function bestPrefix(names: readonly string[], mark: string): string | undefined {
  const uses = new Map<string, number>()
  for (const name of names) {
    if (name.startsWith('%')) continue
    for (const prefix of prefixesOf(name)) uses.set(prefix, (uses.get(prefix) ?? 0) + 1)
  }
  let best: string | undefined
  let most = 0
  for (const [prefix, count] of uses) {
    const saved = count * (prefix.length - mark.length) - (prefix.length + LENGTH_FIELD)
    if (saved > most) [best, most] = [prefix, saved]
  }
  return best
}

/** `A.B` and `A` of `A.B.C`; nothing from the first element of an array on. */
function prefixesOf(name: string): string[] {
  const members = name.split('.').slice(0, -1)
  const arrayAt = members.findIndex((member) => member.includes('['))
  const whole = arrayAt < 0 ? members : members.slice(0, arrayAt)
  return whole.map((_, at) => whole.slice(0, at + 1).join('.'))
}

/**
 * The full spelling of a name of a request; undefined when it uses an abbreviation that is not defined.
 * @example expandLabel('%1.%2.Speed', ['LabelA', 'memberA3']) // 'LabelA.memberA3.Speed'
 */
export function expandLabel(name: string, abbreviations: readonly string[]): string | undefined {
  const members = name.split('.').map((member) => {
    if (!member.startsWith('%')) return member
    return /^%[1-9]\d*$/.test(member) ? abbreviations[Number(member.slice(1)) - 1] : undefined
  })
  return members.includes(undefined) ? undefined : members.join('.')
}

/**
 * Divides entries, in their order, into requests that each fit.
 * @param fits whether these entries go into one request; one alone is taken as it is, and refused when it is encoded
 */
export function inRequests<T>(entries: readonly T[], fits: (entries: readonly T[]) => boolean): T[][] {
  const requests: T[][] = []
  for (const entry of entries) {
    const last = requests.at(-1)
    if (last !== undefined && fits([...last, entry])) last.push(entry)
    else requests.push([entry])
  }
  return requests
}
