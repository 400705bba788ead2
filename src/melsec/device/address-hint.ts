/**
 * What a text that is no MELSEC address may have meant: notations of other makers, devices SLMP cannot reach, and
 * addresses in other spellings.
 */
import { devices } from './device'

interface Hint {
  readonly looksLike: RegExp
  readonly hint: string
}

const SIEMENS =
  'It looks like a Siemens address; MELSEC writes words D100, W1F or ZR100, bits M0, X0 or B0, and a bit of a word D100.F.'
const FUNCTION_DEVICE =
  'FX, FY and FD (function devices) cannot be addressed by SLMP: copy them to M or D in the program.'
const POINTER = 'Pointers, constants and labels are no devices; a device looks like D100 or M0.'

/** The first that fits wins. The text is trimmed, upper case, ASCII. */
const HINTS: readonly Hint[] = [
  { looksLike: /^%/, hint: 'IEC notation (%MW10) does not name a MELSEC device; write the device, e.g. D100 or M0.' },
  { looksLike: /^\d+$/, hint: 'A number alone (Modbus, Sharp JW) names no device; write the device, e.g. D100.' },
  { looksLike: /[:[\]]/, hint: 'The type (:REAL) and the count ([10]) are not part of a device address.' },
  { looksLike: /\.\./, hint: 'A range (M0..M15) is not a device address.' },
  { looksLike: /^(DB\d|[VMIQE][BWD]\d|[AI]\d+\.\d|[MQEV]\d+\.\d)/, hint: SIEMENS },
  { looksLike: /^(DM|CIO|HR|EM|AR)\d/, hint: 'It looks like an Omron address; data memory of a MELSEC PLC is D100.' },
  { looksLike: /^F[XYD][0-9A-F]+$/, hint: FUNCTION_DEVICE },
  { looksLike: /^BL\d/, hint: 'SFC blocks (BL) cannot be addressed by SLMP.' },
  { looksLike: /^([PIN]\d+|[KH]-?[0-9A-F]+|E-?\d[\d.]*)$/, hint: POINTER },
]

/** A sentence with a space in front, or an empty text. */
export function hintFor(text: string): string {
  const found = HINTS.find(({ looksLike }) => looksLike.test(text))
  return found === undefined ? '' : ` ${found.hint}`
}

/** An address in another spelling. */
export interface OtherSpelling {
  /** What is to be known of our own spelling. */
  readonly because: string
  /** What it may have meant, in our spelling; not every one need be an address of this PLC. */
  readonly readings: readonly string[]
}

interface Spelling {
  readonly looksLike: RegExp
  readonly because: string
  readonly readings: (...groups: string[]) => readonly string[]
}

const NAME = devices
  .map(({ name }) => name)
  .sort((a, b) => b.length - a.length)
  .join('|')
const HEXADECIMAL_NAME = devices.flatMap(({ name, radix, octal }) => (radix === 16 || octal ? [name] : [])).join('|')
/** Devices of a network, as `J1\\W10` has them. */
const LINK_NAME = 'SB|SW|X|Y|B|W'

const SPELLINGS: readonly Spelling[] = [
  {
    looksLike: /^(U[0-9A-F]{1,3}(?:Z\d+)?)[.:,;|-]?(H?G\d+)$/,
    because: 'between the module and its buffer memory stands \\',
    readings: (unit, memory) => [`${unit}\\${memory}`],
  },
  {
    looksLike: new RegExp(String.raw`^(J\d{1,3}(?:Z\d+)?)[.:,;|\-]?((?:${LINK_NAME})[0-9A-F]+)$`),
    because: 'between the network and its device stands \\',
    readings: (network, device) => [`${network}\\${device}`],
  },
  {
    looksLike: new RegExp(String.raw`^(${NAME})\*([0-9A-F]+)$`),
    because: 'the * and the zeros are how ASCII code sends it',
    readings: (name, number) => [`${name}${number.replace(/^0+(?=.)/, '')}`],
  },
  {
    looksLike: new RegExp(`^(${HEXADECIMAL_NAME})([0-9A-F]+)H$`),
    because: 'the number is hexadecimal without an H',
    readings: (name, number) => [`${name}${number}`],
  },
  {
    looksLike: new RegExp(String.raw`^(${NAME})(\d[0-9A-F]*)H$`),
    because: 'the number of this device is decimal, without an H',
    readings: (name, number) => [`${name}${number}`, `${name}${Number.parseInt(number, 16)}`],
  },
  {
    looksLike: /^S([NSC])(\d+)$/,
    because: 'the retentive timer is ST',
    readings: (part, number) => [`ST${part}${number}`],
  },
  {
    looksLike: /^(.+)\.0+([0-9A-F])$/,
    because: 'a bit number is one hexadecimal digit, .0 to .F',
    readings: (word, bit) => [`${word}.${bit}`],
  },
]

/** `U3.G100`, `XFFFH`, `D*000100`, `SN5`, `D100.0F`, `D 100`. The text is trimmed and upper case. */
export function otherSpelling(text: string): OtherSpelling | undefined {
  if (text.length > LONGEST) return undefined
  if (/\s/.test(text)) return { because: 'it has a space', readings: [text.replace(/\s+/g, '')] }
  for (const { looksLike, because, readings } of SPELLINGS) {
    const found = looksLike.exec(text)
    if (found !== null) return { because, readings: readings(...found.slice(1)) }
  }
  return undefined
}

/** Longer than anything that is an address in another spelling. */
const LONGEST = 64
