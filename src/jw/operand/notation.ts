/**
 * Operands of a Sharp JW as texts. Formatting is the exact inverse of reading; numbers are octal, file numbers hexadecimal.
 *
 * | text            | meaning                                                                                       |
 * |-----------------|-----------------------------------------------------------------------------------------------|
 * | `004033`        | relay: the last digit is the bit, the others the byte; 5 digits (JW20H, JW30H) or 6 (JW300)   |
 * | `KO0403`        | the byte of the relays 004030 to 004037; `コ0403` is the same                                  |
 * | `09012` `19012` | register, a byte: block 0 or 1, then 9, then the byte of the block                            |
 * | `b0012`         | byte of the current values of timers and counters; number n has the bytes 2n and 2n + 1       |
 * | `TMR0012`       | timer 12 octal by its number, and so `CNT0012` and `MD0012`                                   |
 * | `T-C0012`       | contact of timer or counter 12 octal                                                          |
 * | `E0012`         | register E, a byte                                                                            |
 * | `#0201`         | byte of the system memory                                                                     |
 * | `F2:012345`     | byte 012345 octal of file 2; `F1:` and 8 digits are the file registers of a JW300             |
 * | `09012.3`       | bit 3 of a byte, of whatever kind                                                             |
 *
 * Case and spaces around do not matter.
 */
import { hex } from '../../basics/hex'
import { octal } from '../../basics/octal'
import { shortened, typedAddress } from '../../basics/typed-text'
import { RequestError, type RequestErrorCode } from '../../errors'
import { FILE_REGISTERS, LAST_FILE } from '../address'
import { type JwKindName, jwKind, jwKindNames, lastByteOf, REGISTER_BLOCK } from './kind'

/** An operand as plain data. */
export interface JwOperand {
  /** What it is. */
  readonly kind: JwKindName
  /** Its number in its kind; of a register 512 for each block before it, and the byte of its block. */
  readonly number: number
  /** Of kind `F`: the file number. */
  readonly file?: number
  /** Bit 0 (lowest) to 7 of a byte. */
  readonly bit?: number
}

type Fail = (message: string, code?: RequestErrorCode) => never

/** What it is about in front of the message. */
export type Hint = (clean: string) => string

/**
 * Reads a text as it stands; whether the operand exists in a PLC is not asked.
 * @throws RequestError BAD_ADDRESS when it is no operand, OUT_OF_RANGE when a number in it cannot be
 */
export function readOperand(text: string, hint: Hint = () => ''): JwOperand {
  const clean = cleanOperand(text)
  const fail: Fail = (message, code = 'BAD_ADDRESS') => {
    throw new RequestError(code, `${JSON.stringify(shortened(text))}: ${message}${hint(clean)}`)
  }
  const [, fileText, rest = clean] = /^F([^:]*):(.*)$/.exec(clean) ?? []
  const [, body = '', bitText] = /^([^.]*)(?:\.(.*))?$/s.exec(rest) ?? []
  const operand = fileText === undefined ? namedOperand(body, fail) : fileByte(fileText, body, fail)
  return bitText === undefined ? operand : { ...operand, bit: bitOf(bitText, operand.kind, fail) }
}

/** In upper case, with KO in Latin letters: Sharp writes the katakana コ. @throws RequestError BAD_ADDRESS */
export function cleanOperand(text: string): string {
  return typedAddress(typeof text === 'string' ? text.replace(/[コｺ]/g, 'KO') : text, '09012')
}

function namedOperand(text: string, fail: Fail): JwOperand {
  if (/^\d/.test(text)) return bareNumber(text, fail)
  const kind = NAMED.find((name) => text.startsWith(jwKind(name).prefix.toUpperCase()))
  if (kind === undefined) return fail(noOperand(text))
  const digits = text.slice(jwKind(kind).prefix.length)
  return { kind, number: numberOf(digits, kind, fail) }
}

/** Longest name first. */
const NAMED = jwKindNames
  .filter((name) => name !== 'F' && jwKind(name).prefix !== '')
  .sort((a, b) => jwKind(b).prefix.length - jwKind(a).prefix.length)

/** `004033` and `09012`: a register has a 9 in front of its last three digits, and a relay has none. */
function bareNumber(text: string, fail: Fail): JwOperand {
  const [, block, byte = ''] = /^(\d*)9(...)$/s.exec(text) ?? []
  const kind = block === undefined ? 'relay' : 'register'
  checkDigits(text, kind, fail)
  if (block === undefined) return { kind, number: numberOf(text, kind, fail) }
  if (!OCTAL.test(byte)) fail(`behind the 9 of a register stand three octal digits (0 to 7), not ${byte}.`)
  return { kind, number: Number(block) * REGISTER_BLOCK + Number.parseInt(byte, 8) }
}

/** `F1:00001234` */
function fileByte(fileText: string, digits: string, fail: Fail): JwOperand {
  const file = /^[0-9A-F]{1,2}$/.test(fileText) ? Number.parseInt(fileText, 16) : -1
  if (file < 0) fail('between F and : stands a file number of one or two hexadecimal digits, e.g. F2:012345.')
  if (file > LAST_FILE) fail(`files have the numbers 00 to ${hex(LAST_FILE)} (hexadecimal).`, 'OUT_OF_RANGE')
  const number = numberOf(digits, 'F', fail)
  const last = lastByteOf(file)
  if (number > last) fail(`file ${hex(file)} ends at byte ${octal(last)} (octal).${elsewhere(file)}`, 'OUT_OF_RANGE')
  return { kind: 'F', file, number }
}

function elsewhere(file: number): string {
  return file === 0 ? '' : ` On a JW300 the file registers go on in F${FILE_REGISTERS}:, up to ${octal(lastByteOf(1))}.`
}

const OCTAL = /^[0-7]+$/

function numberOf(digits: string, name: JwKindName, fail: Fail): number {
  const { title, last, prefix } = jwKind(name)
  if (digits === '') return fail(`the number is missing behind ${name === 'F' ? 'the file' : prefix}.`)
  if (/^\d+$/.test(digits)) checkDigits(digits, name, fail)
  if (!OCTAL.test(digits))
    return fail(`a ${title} has an octal number (digits 0 to 7: behind 17 comes 20)${wrongDigit(digits)}.`)
  const number = Number.parseInt(digits, 8)
  if (number > last) fail(`the last ${title} that can be written is ${octal(last)}.`, 'OUT_OF_RANGE')
  return number
}

function wrongDigit(digits: string): string {
  const [wrong] = /[^0-7]/.exec(digits) ?? []
  return `, and ${JSON.stringify(wrong)} is none`
}

function checkDigits(text: string, name: JwKindName, fail: Fail): void {
  const {
    digits: [fewest, most],
    title,
    example,
  } = jwKind(name)
  if (text.length >= fewest && text.length <= most) return
  fail(
    `a ${title} has ${fewest} ${most - fewest === 1 ? 'or' : 'to'} ${most} digits, e.g. ${example}; this has ${text.length}.`,
  )
}

function bitOf(text: string, kind: JwKindName, fail: Fail): number {
  const { unit, title } = jwKind(kind)
  if (unit === 'bit') return fail(`a ${title} is one bit already: leave .${shortened(text)} out.`)
  if (unit === 'timer') return fail(`a ${title} is taken as a whole and has no bits: leave .${shortened(text)} out.`)
  if (!/^[0-7]$/.test(text)) fail('behind the dot stands the bit of a byte, one digit from 0 to 7.')
  return Number(text)
}

function noOperand(text: string): string {
  const examples = jwKindNames.map((name) => jwKind(name).example).join(', ')
  const what = text === '' ? 'no operand' : `there is no operand ${JSON.stringify(shortened(text))}`
  return `${what}; operands of a Sharp JW look like ${examples}.`
}

/**
 * The text that is read back as this operand.
 * @example formatJwOperand({ kind: 'relay', number: 0o4033 }) // '004033'
 */
export function formatJwOperand({ kind, number, file, bit }: JwOperand): string {
  const { prefix, shown } = jwKind(kind)
  const behind = bit === undefined ? '' : `.${bit}`
  if (kind === 'F') return `F${hex(file ?? 0)}:${octal(number, file === FILE_REGISTERS ? 8 : shown)}${behind}`
  if (kind !== 'register') return `${prefix}${octal(number, shown)}${behind}`
  const block = Math.floor(number / REGISTER_BLOCK)
  return `${block}9${octal(number % REGISTER_BLOCK, 3)}${behind}`
}
