/** What a text that is no MELSEC address may have meant: notations of other makers and devices SLMP cannot reach. */

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
