/** What a text that is no operand of a Sharp JW may have meant: other makers' addresses, and operands in other spellings. */

import { jwKind, jwKindNames } from './kind'

interface Hint {
  readonly looksLike: RegExp
  readonly hint: string
}

const MELSEC = /^(?:[A-Z]\d*\\)?(?:S[MDBWN]|Z?R|T[NS]|C[NS]|D[XY]?|[MXYWLBVZ])\d[0-9A-F]*(?:\.[0-9A-F])?$/

/** The first that fits wins. The text is trimmed, upper case, ASCII. */
const HINTS: readonly Hint[] = [
  {
    looksLike: MELSEC,
    hint: ' It looks like a device of a MELSEC PLC; a Sharp JW has registers (09000), relays (000000) and bytes of relays (KO0000).',
  },
  { looksLike: /^%/, hint: ' IEC notation (%MW10) names no operand of a Sharp JW.' },
  {
    looksLike: /^(DB\d|[IQ][BWD]\d)/,
    hint: ' It looks like a Siemens address; a Sharp JW has registers (09000) and relays (000000).',
  },
  { looksLike: /^0X|^\$|^[0-9A-F]+H$/, hint: ' Numbers are octal, without a sign for it.' },
  { looksLike: /\[|\]|,/, hint: ' The count ([10]) is not part of an operand.' },
  { looksLike: /\.\./, hint: ' A range (09000..09017) is not an operand.' },
]

/** A sentence with a space in front, or an empty text. */
export function hintFor(text: string): string {
  return HINTS.find(({ looksLike }) => looksLike.test(text))?.hint ?? ''
}

/** An operand in another spelling. */
export interface OtherSpelling {
  readonly because: string
  /** What it may have meant, in our spelling; not every one need be an operand. */
  readonly readings: readonly string[]
}

interface Spelling {
  readonly looksLike: RegExp
  readonly because: string
  /** Of the groups of the expression; one that matched nothing is missing. */
  readonly readings: (...groups: string[]) => readonly string[]
}

const NAMES = jwKindNames.flatMap((name) => (name === 'F' ? [] : jwKind(name).prefix || [])).join('|')

/** With the fewest digits that are taken, as its kind writes it. */
function filled(prefix: string, digits: string): string {
  const kind = jwKindNames.map(jwKind).find((one) => one.prefix.toUpperCase() === prefix)
  return `${kind?.prefix ?? prefix}${digits.replace(/^0+(?=.)/, '').padStart(kind?.shown ?? 1, '0')}`
}

const SPELLINGS: readonly Spelling[] = [
  {
    looksLike: /^(9[0-7]{3}(?:\.[0-7])?)$/,
    because: 'a register has 5 digits',
    readings: (text) => [`0${text}`],
  },
  {
    looksLike: /^([0-7]{1,4})\.([0-7])$/,
    because: 'a byte of relays begins with KO',
    readings: (byte, bit) => [`${filled('KO', byte)}.${bit}`],
  },
  {
    looksLike: /^([0-7]{1,4})$/,
    because: 'a relay has 5 or 6 digits, and a byte of relays begins with KO',
    readings: (digits) => [digits.padStart(6, '0'), filled('KO', digits)],
  },
  {
    looksLike: /^([0-7]{4,5})([0-7])\.([0-7])$/,
    because: 'a relay is one bit already, and a bit of a byte of relays begins with KO',
    readings: (byte, last, bit) => [`${byte}${last}`.padStart(6, '0'), `${filled('KO', byte)}.${bit}`],
  },
  {
    looksLike: /^([0-7]{1,2})([0-7]{6})(\.[0-7])?$/,
    because: 'a file register is written with its file, and a relay has 5 or 6 digits',
    readings: (head, rest, bit = '') => [`F1:${head}${rest}${bit}`, ...(/^0+$/.test(head) ? [`${rest}${bit}`] : [])],
  },
  {
    looksLike: new RegExp(`^(${NAMES.toUpperCase()})([0-7]+)(\\.[0-7])?$`),
    because: 'the number has other digits',
    readings: (prefix, digits, bit = '') => [`${filled(prefix, digits)}${bit}`],
  },
  {
    looksLike: /^(?:T|TIM|TM|TN)([0-7]+)$/,
    because: 'a timer has a current value and a contact',
    readings: (digits) => [filled('TMR', digits), filled('T-C', digits)],
  },
  {
    looksLike: /^(?:C|CT|CNTR|CN)([0-7]+)$/,
    because: 'a counter has a current value and a contact',
    readings: (digits) => [filled('CNT', digits), filled('T-C', digits)],
  },
  {
    looksLike: /^F?([0-9A-F]{1,2})[\\/.;-]([0-7]{1,8}(?:\.[0-7])?)$/,
    because: 'between a file and its byte stands a colon',
    readings: (file, byte) => [`F${file}:${byte}`],
  },
  {
    looksLike: /^([0-9A-E][0-9A-F]?):([0-7]{1,8}(?:\.[0-7])?)$/,
    because: 'a file number begins with F',
    readings: (file, byte) => [`F${file}:${byte}`],
  },
]

/** Longer than anything that is an operand in another spelling. */
const LONGEST = 64

/** `9012`, `b12`, `0403.3`, `T0012`, `F1.1234`, `TMR 0012`. The text is trimmed and upper case. */
export function otherSpelling(text: string): OtherSpelling | undefined {
  if (text.length > LONGEST) return undefined
  if (/\s/.test(text)) return { because: 'it has a space', readings: [text.replace(/\s+/g, '')] }
  for (const { looksLike, because, readings } of SPELLINGS) {
    const found = looksLike.exec(text)
    if (found !== null) return { because, readings: readings(...found.slice(1)) }
  }
  return undefined
}
