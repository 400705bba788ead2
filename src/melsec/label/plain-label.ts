/**
 * Whether a text that is no device address is meant as the name of a label.
 *
 * A typing error in an address must not be sent as the name of a label, so a name is taken for a label only when it
 * cannot have been meant as an address. `Line1.Speed`, `Motor_1`, `Speed`, `Values[3]` and `モータ1` are labels; `DD100`,
 * `Q5`, `D1OO`, `D100.G` and `DB1.DBW0` are not: they look like letters and a number. GX Works3 refuses label names that
 * are devices, so what is an address is never a label here.
 */
import { RequestError } from '../../errors'
import { parseDevice } from '../device/address'
import { hintFor, otherSpelling } from '../device/address-hint'
import { devices } from '../device/device'
import { parseLabel } from './label'

/** Letters, digits and underscores, as GX Works3 allows them; members with dots between, elements in brackets. */
const INDEX = String.raw`(?:\[[\d\s,]+\])?`
const NAME = new RegExp(
  String.raw`^[\p{L}_][\p{L}\p{M}\p{Nd}_]*${INDEX}(?:\.[\p{L}_][\p{L}\p{M}\p{Nd}_]*${INDEX})*$`,
  'u',
)
const ASCII_DIGITS = /^[^\p{Nd}]*(?:[0-9][^\p{Nd}]*)*$/u

/** Scripts whose letters can be taken for those of a device. */
const LETTER = String.raw`[\p{Script=Latin}\p{Script=Greek}\p{Script=Cyrillic}]`
const FOREIGN_LETTER = new RegExp(String.raw`(?!${LETTER})\p{L}`, 'u')
/** Letters, then digits, with O for a zero too: `DD100`, `Q5`, `XX1F`, `X1O`, `DD100Z2`. */
const LETTERS_AND_NUMBER = new RegExp(String.raw`^(${LETTER}+)\d[\dA-FO]*(?:L?Z\d*)?$`, 'u')

const NAMES = [...new Set(devices.flatMap(({ name, group }) => (group === undefined ? [name] : [name, group])))]
const DEVICE = NAMES.sort((a, b) => b.length - a.length).join('|')
/** A device, timer or counter with a number behind it, or a digit designation. */
const DEVICE_AND_NUMBER = new RegExp(`^(?:K\\d|(?:${DEVICE})\\d)`)
const DEVICE_ITSELF = new RegExp(`^(?:${DEVICE})\\d+$`, 'i')
/** `D` alone, and `DO` or `MOO` with letters O for zeros. */
const DEVICE_ALONE = new RegExp(`^(?:${DEVICE})O*$`)
/** Letters of the longest word device that has bits, and one that was typed too many. */
const MOST_LETTERS = 1 + Math.max(...devices.filter(({ unit }) => unit === 'word').map(({ name }) => name.length))

/** Whether the text could be the name of a label: GX Works3 refuses those of devices, timers and counters. */
export function isLabelName(text: string): boolean {
  const plain = text.normalize('NFKC')
  if (DEVICE_ITSELF.test(plain)) return false
  if (!NAME.test(text) || !NAME.test(plain) || !ASCII_DIGITS.test(plain)) return false
  try {
    parseLabel(text)
    return true
  } catch (error) {
    if (error instanceof RequestError) return false
    throw error
  }
}

/**
 * Whether it is the name of a label and cannot have been meant as an address.
 * @param text without a type behind it
 * @example isPlainLabel('Line1.Speed') // true
 * @example isPlainLabel('DD100')       // false
 */
export function isPlainLabel(text: string): boolean {
  const name = text.trim()
  // Full-width letters, as an input method leaves them, look like the same address.
  return isLabelName(name) && !looksLikeAddress(name.normalize('NFKC').toUpperCase())
}

function looksLikeAddress(name: string): boolean {
  // `U3.G100`, `XFFFH`: whatever this PLC has of it, it is not sent as a name.
  if (otherSpelling(name.replace(/\[[^\]]*\]$/, '')) !== undefined) return true
  const [, first = '', index, rest] = /^([^.[]*)(\[[^\]]*\])?(?:\.(.*))?$/s.exec(name) ?? []
  if (first.includes('_') || FOREIGN_LETTER.test(first)) return isAddress(first)
  if (DEVICE_AND_NUMBER.test(first) || isAddress(first)) return true
  // Nothing but a bit number stands behind the dot of an address; an index stands at its end.
  const isBit = rest !== undefined && index === undefined && /^[0-9A-F](?:\[|$)/.test(rest)
  if (rest === undefined || isBit) {
    const letters = LETTERS_AND_NUMBER.exec(first)?.[1]
    // The letters of a hexadecimal number stand behind those of its device.
    if (letters !== undefined && (rest === undefined || letters.replace(/[A-F]*$/, '').length <= MOST_LETTERS))
      return true
    return DEVICE_ALONE.test(first)
  }
  // Brackets are what labels have and addresses do not.
  return /\d/.test(first) && hintFor(name.replace(/\[[^\]]*\]/g, '')) !== ''
}

/** The notation that takes most: where X and Y are octal, `XFACE` is refused, but it is no name either. */
const HEXADECIMAL = { xyRadix: 16, wRadix: 16 } as const

function isAddress(text: string): boolean {
  try {
    parseDevice(text, HEXADECIMAL)
    return true
  } catch (error) {
    if (error instanceof RequestError) return false
    throw error
  }
}
