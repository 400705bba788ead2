/**
 * Items as people know them from other drivers and from manuals: `D100~D109`, `D100:STR,10`, `DREAL100`, `D552, D553`.
 *
 * They are not taken, because a reading that is only likely may be the wrong value. They are refused with what they may
 * have meant, in our spelling. A reading is named only when it is an item of this PLC.
 */
import { hex } from '../../basics/hex'
import { RequestError } from '../../errors'
import { devices } from '../../melsec/device/device'
import { parseType, type TypeName, valueTypes } from '../../value/type'

/** Whether a text is an item. */
type IsItem = (text: string) => boolean

/** What a text may have meant, as a sentence. The text is trimmed, upper case and half-width. */
type Notation = (text: string, isItem: IsItem) => string | undefined

/** Longer than what anybody types for one item. */
const LONGEST = 200
/** Length of a text whose length is not known. */
const SOME_LENGTH = 20

/** What it may have meant, with what is to be known; `undefined`: it looks like nothing of the kind. */
export function otherNotation(given: string, isItem: IsItem): string | undefined {
  if (given.length > LONGEST) return undefined
  const text = given.normalize('NFKC').trim().toUpperCase()
  for (const notation of NOTATIONS) {
    const meant = notation(text, isItem)
    if (meant !== undefined) return meant
  }
  return undefined
}

function sentence(because: string, readings: readonly string[], isItem: IsItem): string | undefined {
  const meant = [...new Set(readings)].filter(isItem)
  return meant.length === 0 ? undefined : `${because}: ${meant.join(' or ')}.`
}

/** `D552, D553`, `M0;M1`, `D100 D102`, `D552,`. */
const list: Notation = (text, isItem) => {
  const parts = text.split(/\s*[,;、]\s*|\s+/)
  const items = parts.filter((part) => part !== '')
  if (parts.length < 2 || items.length === 0 || !items.every(isItem)) return undefined
  if (items.length === 1) return `a comma too many: write ${items[0]}.`
  const quoted = items.slice(0, 4).map((item) => `'${item}'`)
  const all = `[${[...quoted, ...(items.length > quoted.length ? ['...'] : [])].join(', ')}]`
  return `these are ${items.length} items: give each its own row or argument, in a program a list ${all}.`
}

/** `D100,BIT3`, `D100.BIT3`, `D100 BIT 3`. */
const bit: Notation = (text, isItem) => {
  const [, word, number] = /^(\S+?)\s*[.,: ]\s*BIT\s*(\d+)$/.exec(text) ?? []
  if (number === undefined) return undefined
  return sentence(
    'a bit is one digit behind a dot, of a word a hexadecimal one',
    [`${word}.${hex(Number(number))}`],
    isItem,
  )
}

/** `D100.3,5`: five bits, or two. */
const bitsOrCount: Notation = (text, isItem) => {
  const [, word, first, second] = /^([^,.]+)\.([0-9A-F])\s*,\s*(\d+)$/.exec(text) ?? []
  if (second === undefined || !isItem(`${word}.${first}`)) return undefined
  const count = `${second} bits are ${word}.${first}[${second}]`
  const other = `${word}.${hex(Number(second))}`
  return isItem(other) ? `${count}; bit ${second} is an item of its own, ${other}.` : `${count}.`
}

/** Types of a driver that has letters for them. */
const LETTERS: Readonly<Record<string, readonly TypeName[]>> = {
  F: ['REAL'],
  U: ['UINT'],
  S: ['INT', 'STRING'],
  L: ['DINT'],
  D: ['UDINT'],
}

/** `D100:STR,10`, `D100:STRING10`, `D100:S20`, `D100:INT,10`, `D100,REAL`, `D100,INT,10`. */
const typeAndCount: Notation = (text, isItem) => {
  const [, device, type = '', separator = '', count] =
    /^([^\s,:]+)\s*[:,]\s*([A-Z]+)(\s*[,:]\s*|\s*)(\d+)?$/.exec(text) ?? []
  if (device === undefined) return undefined
  const isGlued = separator.trim() === '' && count !== undefined
  // `INT8` and `UINT8` would be types, so only texts have their length without anything between.
  const types = (isGlued && type === 'S' ? ['STRING' as const] : typesOf(type)).filter(
    (name) => !isGlued || isText(name),
  )
  return sentence(
    isText(types[0]) ? 'the length of a text stands in parentheses behind its type' : BEHIND,
    types.map((name) => typed(device, name, count)),
    isItem,
  )
}

const BEHIND = 'the type stands behind the address, a count in brackets behind the type'

/** `DREAL100`, `DSTR200,20`, `DINT100`, `REALD100`, `REAL D100`, `D100.REAL`, `D100_REAL`. */
const typeWithin: Notation = (text, isItem) => {
  const [, item = '', count] = /^(.*?)(?:\s*,\s*(\d+))?$/.exec(text) ?? []
  const readings = [...letteredReadings(item, count), ...besideReadings(item, count)].filter(({ text }) => isItem(text))
  if (readings.length === 0) return undefined
  const shown = new Map(readings.map(({ text, as }) => [text, as]))
  const list = [...shown].map(([reading, as]) => (shown.size === 1 ? reading : `${reading} (${as})`))
  const choice =
    shown.size === 1
      ? 'the type stands behind the address: '
      : 'the type stands behind the address, and this has more than one reading: '
  return `${choice}${list.join(' or ')}.`
}

interface Reading {
  readonly text: string
  /** What the letters are in this reading. */
  readonly as: string
}

/** `DREAL100` and `DINT100`: letters of a device and of a type, or of a type alone, before a number. */
function letteredReadings(text: string, count: string | undefined): Reading[] {
  const [, letters = '', number] = /^([A-Z]+?)([0-9][0-9A-F.]*)$/.exec(text) ?? []
  if (number === undefined) return []
  const within = devices.flatMap(({ name }): Reading[] => {
    const rest = letters.startsWith(name) ? letters.slice(name.length) : ''
    const type = knownType(rest)
    return type === undefined
      ? []
      : [{ text: typed(`${name}${number}`, type, count), as: `device ${name}, type ${type}` }]
  })
  const alone = knownType(letters)
  return alone === undefined ? within : [...within, { text: typed(`D${number}`, alone, count), as: `type ${alone}` }]
}

/** `REALD100`, `REAL D100`, `D100 REAL`, `D100.REAL`. */
function besideReadings(text: string, count: string | undefined): Reading[] {
  const [, before = '', first = ''] = /^([A-Z]+)[ ._;/-]+([A-Z]+[0-9][0-9A-F]*)$/.exec(text) ?? []
  const [, second = '', behind = ''] = /^([A-Z]+[0-9][0-9A-F]*)[ ._;/-]*([A-Z]+)$/.exec(text) ?? []
  const parts = [[before, first], [behind, second], ...Array.from(text, (_, at) => [text.slice(0, at), text.slice(at)])]
  return parts.flatMap(([type = '', device = '']): Reading[] => {
    const name = /^[A-Z]/.test(device) ? knownType(type) : undefined
    return name === undefined ? [] : [{ text: typed(device, name, count), as: `device ${device}, type ${name}` }]
  })
}

/** `D100.16H`, `D100.10L`: length and order of the bytes of a text. */
const textLength: Notation = (text, isItem) => {
  const [, word, length] = /^([^.]+)\.(\d+)[HL]$/.exec(text) ?? []
  if (length === undefined) return undefined
  const because = 'the length of a text stands behind its type, and byteOrder says which byte of a word comes first'
  return sentence(because, [`${word}:STRING(${Number(length)})`], isItem)
}

/** `D100~D109`, `D100-109`, `M0-M15`, `M0:M15`, `M0 TO M15`, `M0...M15`. */
const range: Notation = (text, isItem) => {
  const found = /^([^\s~〜–—→,:-]+?)\s*(?:[~〜–—→:-]|\.{2,}|\bTO\b)\s*([0-9A-Z.\\/¥@]+)((?::.*)?)$/.exec(text)
  if (found === null) return undefined
  const [, first = '', last = '', type = ''] = found
  const ends = [last, ...namesIn(first).map((name) => `${name}${last}`)]
  const meant = ends.map((end) => `${first}..${end}${type}`).find(isItem)
  return meant === undefined ? undefined : sentence('a range is written with two dots', [meant], isItem)
}

/** What may stand before the number of the first end: `D` of `D100`, `U3\G` of `U3\G100`, `D100.` of `D100.0`. */
function namesIn(first: string): string[] {
  const [, place = '', device = ''] = /^(.*[\\/¥])?(.*)$/.exec(first) ?? []
  const names = devices.flatMap(({ name }) => (device.startsWith(name) ? [`${place}${name}`] : []))
  const dot = first.lastIndexOf('.')
  return dot < 0 ? names : [first.slice(0, dot + 1)]
}

/** `D100:3`: a bit or a count. */
const numberBehind: Notation = (text, isItem) => {
  const [, device, number] = /^([^\s,:]+):(\d+)$/.exec(text) ?? []
  if (number === undefined) return undefined
  const readings = [`${device}.${hex(Number(number))}`, `${device}[${Number(number)}]`]
  return sentence('behind the colon stands a type, a bit behind a dot, a count in brackets', readings, isItem)
}

/** `D100[10]:REAL`, `D100(10)`, `D100{10}`. */
const misplacedCount: Notation = (text, isItem) => {
  const [, device, open, count, type = ''] = /^([^\s,:[({]+)([[({])(\d+)[\])}]((?::.*)?)$/.exec(text) ?? []
  if (count === undefined || (open === '[' && type === '')) return undefined
  return sentence('a count stands in brackets at the end', [`${device}${type}[${count}]`], isItem)
}

/** The first that has a reading wins. */
const NOTATIONS: readonly Notation[] = [
  list,
  bit,
  bitsOrCount,
  textLength,
  typeAndCount,
  typeWithin,
  numberBehind,
  range,
  misplacedCount,
]

function typed(device: string, type: TypeName, count: string | undefined): string {
  if (isText(type)) return `${device}:${type}(${Number(count ?? SOME_LENGTH)})`
  return `${device}:${type}${count === undefined ? '' : `[${Number(count)}]`}`
}

function isText(type: TypeName | undefined): boolean {
  return type !== undefined && valueTypes[type].kind === 'text'
}

function typesOf(text: string): readonly TypeName[] {
  const type = knownType(text)
  if (type !== undefined) return [type]
  return Object.hasOwn(LETTERS, text) ? (LETTERS[text] ?? []) : []
}

function knownType(text: string): TypeName | undefined {
  for (const candidate of text === '' ? [] : [text, `${text}(1)`]) {
    try {
      return parseType(candidate).name
    } catch (error) {
      if (!(error instanceof RequestError)) throw error
    }
  }
  return undefined
}
