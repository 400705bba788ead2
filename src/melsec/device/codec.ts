/**
 * A device address on the wire (SLMP reference manual p. 36-40 and appendix 1; iQ-F communication manual App. 9, 11).
 *
 * Binary code sends the number before the code, ASCII code the code before the number. The subcommand selects the form:
 *
 * | form     | binary                                                | ASCII                                                  |
 * |----------|-------------------------------------------------------|--------------------------------------------------------|
 * | short    | number 3, code 1                                      | code 2, number 6                                       |
 * | long     | number 4, code 2                                      | code 4, number 8                                       |
 * | extended | modification 2, (short or long), extension            | `00`/`0@` 2, extension 4, extension modification 3 or  |
 * |          | modification 2, extension 2, direct memory 1          | 4, code 2 or 4, number 6 or 10, modification 3 or 4    |
 */
import { digitValue, type Reader, type ValueCodec, type Writer } from '../../codec/codec'
import { RequestError } from '../../errors'
import { type AccessProblem, addressProblem, checkAddress } from './access'
import { type DeviceAddress, type DeviceInfo, deviceInfo, devices, LAST_NUMBER, type Radix } from './device'
import {
  readAsciiExtension,
  readAsciiModification,
  readBinaryExtension,
  readBinaryModification,
  writeAsciiExtension,
  writeAsciiModification,
  writeBinaryExtension,
  writeBinaryModification,
} from './extension'

/** Long form: 2-byte code and 4-byte number, 4 and 8 characters in ASCII code. Equals bit 1 of the subcommand. */
export const FORM_LONG = 0x02
/** With extension specification. Equals bit 7 of the subcommand. */
export const FORM_EXTENDED = 0x80
/** ASCII code writes X and Y in octal digits: the iQ-F setting "ASCII (X, Y OCT)". Not part of the subcommand. */
export const FORM_XY_OCTAL = 0x100
/** ASCII code writes ZR in hexadecimal digits, as the SLMP manual prints it. Not part of the subcommand. */
export const FORM_ZR_HEX = 0x200

/**
 * The address of a device, or of the head device.
 * Writing throws RequestError for what the form cannot say; reading throws ProtocolError for what is not an address.
 */
export const deviceAddress: ValueCodec<DeviceAddress> = {
  name: 'device',
  takes: 'a device such as "D100"',
  example: { device: 'D', number: 100 },
  write(writer, address) {
    checkAddress(address)
    const problem = formProblem(address, writer.ascii, writer.form)
    if (problem !== undefined) throw new RequestError(problem.code, problem.message)
    if (writer.ascii) writeAscii(writer, address)
    else writeBinary(writer, address)
  },
  read(reader) {
    return reader.ascii ? readAscii(reader) : readBinary(reader)
  },
  size(ascii, form) {
    const long = (form & FORM_LONG) !== 0
    if ((form & FORM_EXTENDED) === 0) return (long ? 6 : 4) * (ascii ? 2 : 1)
    return ascii ? (long ? 28 : 20) : long ? 13 : 11
  },
}

/**
 * Why this form cannot say this (otherwise right) address, or undefined when it can.
 * @param form bits FORM_LONG, FORM_EXTENDED, FORM_XY_OCTAL, FORM_ZR_HEX
 */
export function formProblem(address: DeviceAddress, ascii: boolean, form: number): AccessProblem | undefined {
  const info = deviceInfo(address.device)
  const long = (form & FORM_LONG) !== 0
  const need = formNeededBy(address)
  if ((need & FORM_EXTENDED) !== 0 && (form & FORM_EXTENDED) === 0) {
    return unsupported(`${info.name}${address.number}: J, U, index registers and @ need the extended form (008x).`)
  }
  if ((need & FORM_LONG) !== 0 && !long) {
    return unsupported(`${longReason(info, address)} needs the long form of subcommands 0002, 0003, 0082 and 0083.`)
  }
  const last = ascii ? LAST_ASCII_NUMBER[wireRadix(info, address, form)][digitsOf(form)] : long ? LAST_NUMBER : 0xffffff
  if (address.number > last) {
    return {
      code: 'OUT_OF_RANGE',
      message: `${info.name} number ${address.number} is more than the ${long ? 'long' : 'short'} ${ascii ? 'ASCII' : 'binary'} form can carry (${last}).`,
    }
  }
  return undefined
}

function longReason(info: DeviceInfo, address: DeviceAddress): string {
  if (info.text2 === undefined) return `${info.name} (${info.title})`
  return address.extension?.kind === 'cpu' ? 'The buffer memory of a CPU' : 'An LZ index'
}

/** The form bits an address cannot do without, whatever its number: FORM_LONG, FORM_EXTENDED, both or 0. */
export function formNeededBy(address: DeviceAddress): number {
  const { extension, extensionIndex, index, indirect } = address
  const extended =
    extension !== undefined || extensionIndex !== undefined || index !== undefined || indirect !== undefined
  // SLMP p. 212 gives the CPU buffer memory for 0082 only, p. 220 an LZ index for 0082 and 0083 only.
  const long = deviceInfo(address.device).text2 === undefined || extension?.kind === 'cpu' || index?.register === 'LZ'
  return (extended ? FORM_EXTENDED : 0) | (long ? FORM_LONG : 0)
}

/** Radix of the digits in ASCII code. Link direct X and Y are hexadecimal on every PLC that has them. */
function wireRadix(info: DeviceInfo, address: Pick<DeviceAddress, 'extension'>, form: number): Radix {
  if (info.octal === true && (form & FORM_XY_OCTAL) !== 0 && address.extension?.kind !== 'link') return 8
  if (info.name === 'ZR' && (form & FORM_ZR_HEX) !== 0) return 16
  return info.radix
}

/** Digits of a number in ASCII code (SLMP p. 39; extended long: iQ-F manual, ten digits). */
function digitsOf(form: number): Digits {
  if ((form & FORM_LONG) === 0) return 6
  return (form & FORM_EXTENDED) === 0 ? 8 : 10
}

type Digits = 6 | 8 | 10

function lastNumbers(radix: Radix): Readonly<Record<Digits, number>> {
  const last = (digits: Digits) => Math.min(radix ** digits - 1, LAST_NUMBER)
  return { 6: last(6), 8: last(8), 10: last(10) }
}
const LAST_ASCII_NUMBER = { 8: lastNumbers(8), 10: lastNumbers(10), 16: lastNumbers(16) } as const

const BY_CODE: readonly (DeviceInfo | undefined)[] = Array.from({ length: 256 }, (_, code) =>
  devices.find((info) => info.code === code),
)

/** Codes are padded with `*` or with spaces (SLMP p. 36, note *1). */
function byText(textOf: (info: DeviceInfo) => string | undefined): ReadonlyMap<string, DeviceInfo> {
  const map = new Map<string, DeviceInfo>()
  for (const info of devices) {
    const text = textOf(info)
    if (text !== undefined) map.set(text, info).set(text.replaceAll('*', ' '), info)
  }
  return map
}
const BY_TEXT2 = byText((info) => info.text2)
const BY_TEXT4 = byText((info) => info.text4)

function writeBinary(writer: Writer, address: DeviceAddress): void {
  const long = (writer.form & FORM_LONG) !== 0
  const extended = (writer.form & FORM_EXTENDED) !== 0
  if (extended) writeBinaryModification(writer, address)
  writer.uint(address.number, long ? 4 : 3)
  writer.uint(deviceInfo(address.device).code, long ? 2 : 1)
  if (extended) writeBinaryExtension(writer, address)
}

function writeAscii(writer: Writer, address: DeviceAddress): void {
  const { form } = writer
  const long = (form & FORM_LONG) !== 0
  const extended = (form & FORM_EXTENDED) !== 0
  const info = deviceInfo(address.device)
  if (extended) writeAsciiExtension(writer, address, long)
  // `text2` is there: formProblem() has refused the short form of a device without one.
  writer.text(long ? info.text4 : (info.text2 ?? ''))
  writeDigits(writer, address.number, wireRadix(info, address, form), digitsOf(form))
  if (extended) writeAsciiModification(writer, address, long)
}

/**
 * Writes digits of any radix by way of the hexadecimal ones: each digit becomes one nibble (100 -> 100H), so that no
 * string is built.
 */
export function writeDigits(writer: Writer, number: number, radix: Radix, digits: Digits): void {
  if (digits === 6) {
    writer.uint(nibbles(number, radix), 3)
    return
  }
  const low = EIGHT_DIGITS[radix]
  if (digits === 10) writer.uint(nibbles(Math.floor(number / low), radix), 1)
  writer.uint(nibbles(number % low, radix), 4)
}

const EIGHT_DIGITS = { 8: 8 ** 8, 10: 10 ** 8, 16: 16 ** 8 } as const

function nibbles(number: number, radix: Radix): number {
  if (radix === 16) return number
  let packed = 0
  let place = 1
  for (let rest = number; rest > 0; rest = Math.floor(rest / radix)) {
    packed += (rest % radix) * place
    place *= 16
  }
  return packed
}

function readBinary(reader: Reader): DeviceAddress {
  const long = (reader.form & FORM_LONG) !== 0
  const extended = (reader.form & FORM_EXTENDED) !== 0
  const modification = extended ? readBinaryModification(reader) : undefined
  const number = reader.uint(long ? 4 : 3)
  const code = reader.uint(long ? 2 : 1)
  const info = BY_CODE[code]
  if (info === undefined || (!long && info.text2 === undefined)) {
    return reader.fail('BAD_FIELD', `${code.toString(16).toUpperCase()}H is not a device code of this form`)
  }
  const address: DeviceAddress = { device: info.name, number }
  return checked(reader, extended ? { ...address, ...modification, ...readBinaryExtension(reader) } : address)
}

function readAscii(reader: Reader): DeviceAddress {
  const { form } = reader
  const long = (form & FORM_LONG) !== 0
  const extended = (form & FORM_EXTENDED) !== 0
  const extension = extended ? readAsciiExtension(reader, long) : {}
  const text = reader.text(long ? 4 : 2)
  const info = (long ? BY_TEXT4 : BY_TEXT2).get(text)
  if (info === undefined) return reader.fail('BAD_FIELD', `${JSON.stringify(text)} is not a device code of this form`)
  const number = readDigits(reader, wireRadix(info, extension, form), digitsOf(form))
  const address: DeviceAddress = { device: info.name, number }
  return checked(reader, extended ? { ...address, ...extension, ...readAsciiModification(reader, long) } : address)
}

/** An address that cannot be written in this form must not come out of it either. */
function checked(reader: Reader, address: DeviceAddress): DeviceAddress {
  const problem = addressProblem(address) ?? formProblem(address, reader.ascii, reader.form)
  return problem === undefined ? address : reader.fail('BAD_FIELD', problem.message)
}

/** Reads digits as `writeDigits` writes them. Leading zeros may be spaces (SLMP p. 39, note *1). */
export function readDigits(reader: Reader, radix: Radix, count: number): number {
  const text = reader.text(count)
  let at = 0
  while (at < count - 1 && text.charCodeAt(at) === 0x20) at++
  let value = 0
  for (; at < count; at++) {
    const digit = digitValue(text.charCodeAt(at))
    if (digit < 0 || digit >= radix)
      reader.fail('BAD_DIGIT', `device number ${JSON.stringify(text)} is not of radix ${radix}`)
    value = value * radix + digit
  }
  return value
}

function unsupported(message: string): AccessProblem {
  return { code: 'UNSUPPORTED', message }
}
