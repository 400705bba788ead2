/**
 * Addresses as an engineer types them and GX Works shows them. Formatting is the exact inverse of parsing.
 *
 * | text                      | meaning                                                                        |
 * |---------------------------|--------------------------------------------------------------------------------|
 * | `D100` `M0` `W1F` `TN5`   | device and number; X, Y, B, W, SB, SW, DX, DY hexadecimal, the others decimal  |
 * | `X17`                     | X and Y are octal where `xyRadix` is 8 (FX, iQ-F)                              |
 * | `W902`                    | W is decimal where `wRadix` is 10 (SLMP inverters)                             |
 * | `D100.F`                  | bit 15 of a word device: one hexadecimal digit                                 |
 * | `K4M0`                    | digit designation: 4 x 4 bits from M0                                          |
 * | `J1\W10`                  | link direct device of network 1 (decimal)                                      |
 * | `U3\G100`                 | buffer memory of the module whose start I/O number is 0030H (hexadecimal)      |
 * | `U3E0\G100` `U3E0\HG100`  | buffer memory of CPU No. 1 to 4 (U3E0 to U3E3)                                 |
 * | `D100Z2` `D100LZ2`        | the number is added to the value of an index register                          |
 * | `J1Z0\W100` `U3Z1\G0`     | the network or start I/O number is added to the value of an index register     |
 * | `@D0`                     | indirect: D0 and D1 hold the address                                           |
 *
 * Case, leading zeros and spaces around do not matter; `/` and the yen sign (the same key) stand for `\` as well.
 */
import { hex } from '../../basics/hex'
import { shortened, typedAddress } from '../../basics/typed-text'
import { RequestError, type RequestErrorCode } from '../../errors'
import { addressProblem } from './access'
import { hintFor, otherSpelling } from './address-hint'
import {
  CPU_UNIT,
  type DeviceAddress,
  type DeviceExtension,
  type DeviceInfo,
  deviceInfo,
  devices,
  devicesOfGroup,
  type Radix,
} from './device'

/** How numbers are written. */
export interface AddressOptions {
  /** X and Y: 8 on FX and iQ-F, 16 elsewhere; the profile knows. */
  readonly xyRadix: 8 | 16
  /** W: 16; 10 on SLMP inverters. Link direct devices are hexadecimal whatever it is. */
  readonly wRadix?: 10 | 16
  /** ZR is decimal in GX Works; 16 for texts that come from a driver which takes it as hexadecimal. */
  readonly radixOverrides?: { readonly ZR?: 10 | 16 }
}

/** A parsed text. At most one of `bit` and `digits` is there. */
export interface ParsedDevice {
  /** Device and number, and what modifies them. */
  readonly address: DeviceAddress
  /** `D100.F`: bit 0 (lowest) to 15 of the word. */
  readonly bit?: number
  /** `K4M0`: 1 to 8 digits of 4 bits each. */
  readonly digits?: number
}

/**
 * @param text e.g. `D100`, `x1f`, `U3\G100`, `D100.F`
 * @throws RequestError BAD_ADDRESS when it is not an address, OUT_OF_RANGE when a number in it cannot be; the message
 *   says what was understood and what to write.
 * @example parseDevice('X17', { xyRadix: 8 })     // { address: { device: 'X', number: 15 } }
 * @example parseDevice('D100.F', { xyRadix: 16 }) // { address: { device: 'D', number: 100 }, bit: 15 }
 */
export function parseDevice(text: string, options: AddressOptions): ParsedDevice {
  try {
    return parsedDevice(text, options)
  } catch (error) {
    if (!(error instanceof RequestError) || typeof text !== 'string') throw error
    const meant = meantBy(text, options)
    if (meant === undefined) throw error
    throw new RequestError(error.code, `${JSON.stringify(text.trim())}: ${meant}`)
  }
}

/** The address in our spelling, when it has another one. */
function meantBy(text: string, options: AddressOptions): string | undefined {
  const { because, readings = [] } = otherSpelling(text.trim().toUpperCase()) ?? {}
  const meant = readings.filter((reading) => isDevice(reading, options))
  return meant.length === 0 ? undefined : `${because}: write ${meant.join(' or ')}.`
}

function isDevice(text: string, options: AddressOptions): boolean {
  try {
    parsedDevice(text, options)
    return true
  } catch (error) {
    if (error instanceof RequestError) return false
    throw error
  }
}

function parsedDevice(text: string, options: AddressOptions): ParsedDevice {
  const clean = typedAddress(text, 'D100', FOREIGN)
  const fail: Fail = (message, code = 'BAD_ADDRESS') => {
    throw new RequestError(code, `${JSON.stringify(shortened(text))}: ${message}${hintFor(clean)}`)
  }
  const indirect = clean.startsWith('@')
  const parts = partsOf(indirect ? clean.slice(1) : clean)
  const [first = '', second] = parts
  if (parts.length > 2) fail('one \\ at most, between the network or module and the device.')
  const place = second === undefined ? NO_PLACE : parsePlace(first, fail)
  const device = parseTail(second ?? first, place, options, fail)
  const parsed: ParsedDevice =
    place === NO_PLACE && !indirect
      ? device
      : { ...device, address: { ...device.address, ...place, ...(indirect ? { indirect } : {}) } }
  const problem = addressProblem(parsed.address)
  if (problem !== undefined) fail(problem.message, problem.code)
  return parsed
}

/** The yen sign is the key of `\`. */
const FOREIGN = /[^\x21-\x7e¥]/

type Fail = (message: string, code?: RequestErrorCode) => never
type Place = Pick<DeviceAddress, 'extension' | 'extensionIndex'>

const NO_PLACE: Place = {}

function partsOf(text: string): readonly string[] {
  return /[\\/¥]/.test(text) ? text.split(/[\\/¥]/) : [text]
}

/** `J1`, `U3`, `U3E0`, `J1Z0`, `U3Z1`. */
function parsePlace(text: string, fail: Fail): Place {
  const [, kind, digits = '', register, index] = /^([JU])([0-9A-F]*)(?:(L?Z)([0-9]+))?$/.exec(text) ?? []
  if (kind === undefined) {
    return fail('before \\ stands a network (J1) or the upper three digits of a start I/O number (U3, U3E0).')
  }
  if (register === 'LZ') fail('LZ cannot index a network or start I/O number, Z can.')
  const extension = kind === 'J' ? network(digits, fail) : unit(digits, fail)
  return index === undefined ? { extension } : { extension, extensionIndex: { register: 'Z', number: Number(index) } }
}

function network(digits: string, fail: Fail): DeviceExtension {
  if (!DIGITS[10].test(digits)) fail('J takes a decimal network number, 1 to 239.')
  return { kind: 'link', network: Number(digits) }
}

function unit(digits: string, fail: Fail): DeviceExtension {
  if (digits === '') fail('U takes the upper three digits of a start I/O number, e.g. U3 for 0030.')
  if (digits.length > 3) {
    // Four digits are the start I/O number itself: U0030 means U3, not U30.
    fail('U takes the upper three digits of a start I/O number only, e.g. U3 for 0030.')
  }
  const value = Number.parseInt(digits, 16)
  const cpu = value - CPU_UNIT + 1
  return cpu === 1 || cpu === 2 || cpu === 3 || cpu === 4 ? { kind: 'cpu', cpu } : { kind: 'module', unit: value }
}

const DIGITS = { 8: /^[0-7]+$/, 10: /^[0-9]+$/, 16: /^[0-9A-F]+$/ } as const
const RADIX_NAME = { 8: 'octal (0-7)', 10: 'decimal (0-9)', 16: 'hexadecimal (0-9, A-F)' } as const

/** Longest name first: `SB10` is SB, not S; `DX1` is DX, not D. A hexadecimal number never continues into a name. */
const BY_LENGTH = [...devices].sort((a, b) => b.name.length - a.name.length)
const NAMES = BY_LENGTH.map(({ name }) => name)
const BY_FIRST_LETTER: ReadonlyMap<string, readonly DeviceInfo[]> = new Map(
  BY_LENGTH.map(({ name: { 0: letter = '' } }) => [letter, BY_LENGTH.filter(({ name }) => name.startsWith(letter))]),
)

/** Device, number, index and bit: what stands behind `\`. */
function parseTail(text: string, place: Place, options: AddressOptions, fail: Fail): ParsedDevice {
  const [, digitText, device = text] = (text.startsWith('K') && /^K(\d+)([A-Z].*)$/.exec(text)) || []
  const info = BY_FIRST_LETTER.get(device.charAt(0))?.find(({ name }) => device.startsWith(name))
  if (info === undefined) return fail(noDevice(device))
  const rest = device.slice(info.name.length)
  const radix = radixOf(info, place, options)
  // The usual address is a name and a number.
  if (digitText === undefined && DIGITS[radix].test(rest)) return { address: addressOf(info, rest, radix) }
  const [, digits = '', register, index, bit] = /^([0-9A-F]*)(?:(L?Z)([0-9]+))?(?:\.(.*))?$/.exec(rest) ?? []
  if (!DIGITS[radix].test(digits)) {
    return fail(chooseTimerPart(device) ?? badNumber(info, rest, radix))
  }
  const address: DeviceAddress = {
    ...addressOf(info, digits, radix),
    ...(register === undefined ? {} : { index: { register: register === 'LZ' ? 'LZ' : 'Z', number: Number(index) } }),
  }
  return { address, ...digitCount(digitText, info, bit, fail), ...bitOf(bit, info, fail) }
}

function addressOf(info: DeviceInfo, digits: string, radix: Radix): DeviceAddress {
  return { device: info.name, number: Number.parseInt(digits, radix) }
}

/** `T5`, `ST5`, `C5`: what GX Works shows as one thing is three devices. */
function chooseTimerPart(text: string): string | undefined {
  const [, group = '', number = ''] = /^([A-Z]+)([0-9].*)$/.exec(text) ?? []
  const parts = devicesOfGroup(group)
  if (parts.length === 0) return undefined
  const choices = parts.map((info) => `${info.name}${shortened(number)} (${info.part})`)
  return `${group} is a timer or counter: choose ${choices.join(', ')}.`
}

function noDevice(text: string): string {
  const choice = chooseTimerPart(text)
  if (choice !== undefined) return choice
  const understood = /^[A-Z]+/.exec(text)?.[0]
  const near = understood === undefined ? [] : NAMES.filter((name) => name[0] === understood[0])
  const list = [...(near.length > 0 ? near : NAMES)].sort().join(' ')
  return `${understood === undefined ? 'no device name' : `there is no device ${shortened(understood)}`}; devices are ${list}.`
}

function badNumber(info: DeviceInfo, rest: string, radix: Radix): string {
  if (rest === '') return `the number is missing after ${info.name}.`
  if (info.octal === true && radix === 8 && /^[0-9A-F]+/.test(rest)) {
    return `X and Y are numbered in octal here, as on FX and iQ-F, so ${info.name} takes the digits 0 to 7. If this PLC shows them in hexadecimal, set the X/Y numbering to hexadecimal (xyRadix: 16).`
  }
  if (info.name === 'W' && radix === 10 && DIGITS[16].test(rest)) {
    return 'W is numbered in decimal here, as on SLMP inverters, so it takes the digits 0 to 9. If this device shows it in hexadecimal, set the W numbering to hexadecimal (wRadix: 16).'
  }
  return `after ${info.name} (${info.title}) stands a ${RADIX_NAME[radix]} number, not ${JSON.stringify(shortened(rest))}.`
}

function digitCount(
  text: string | undefined,
  info: DeviceInfo,
  bit: string | undefined,
  fail: Fail,
): { digits?: number } {
  if (text === undefined) return {}
  const digits = Number(text)
  if (!(digits >= 1 && digits <= 8)) return fail(`K${shortened(text)} is not a digit designation: K1 to K8.`)
  if (info.unit !== 'bit') return fail(`K${digits} takes bits of a bit device, and ${info.name} is a ${info.title}.`)
  if (bit !== undefined) return fail('a digit designation has no bit number.')
  return { digits }
}

function bitOf(text: string | undefined, info: DeviceInfo, fail: Fail): { bit?: number } {
  if (text === undefined) return {}
  if (info.unit === 'bit') return fail(`${info.name} is a bit device already: leave .${shortened(text)} out.`)
  if (info.unit === 'doubleWord')
    return fail(`${info.name} has 32 bits; a bit number goes with word devices, e.g. D100.F.`)
  if (!/^[0-9A-F]$/.test(text)) {
    const decimal = /^0*1[0-5]$/.test(text) ? ` For bit ${Number(text)} write .${hex(Number(text))}.` : ''
    return fail(`a bit number is one hexadecimal digit, .0 to .F.${decimal}`)
  }
  return { bit: Number.parseInt(text, 16) }
}

/** Link direct devices are hexadecimal whatever the numbering of the CPU's own (SLMP p. 208). */
function radixOf(info: DeviceInfo, place: Pick<DeviceAddress, 'extension'>, options: AddressOptions): Radix {
  if (info.octal === true) {
    if (place.extension?.kind === 'link') return 16
    const { xyRadix } = options
    if (xyRadix === 8 || xyRadix === 16) return xyRadix
    throw new RequestError('BAD_OPTION', `xyRadix is ${JSON.stringify(xyRadix)}; it is 8 or 16.`, 'xyRadix')
  }
  if (info.name === 'W' && place.extension?.kind !== 'link') {
    const { wRadix = info.radix } = options
    if (wRadix === 10 || wRadix === 16) return wRadix
    throw new RequestError('BAD_OPTION', `wRadix is ${JSON.stringify(wRadix)}; it is 10 or 16.`, 'wRadix')
  }
  if (info.name === 'ZR') return options.radixOverrides?.ZR ?? info.radix
  return info.radix
}

/**
 * The text `parseDevice` reads back as this address.
 * @example formatDevice({ device: 'X', number: 31 }, { xyRadix: 16 })   // X1F
 */
export function formatDevice(address: DeviceAddress, options: AddressOptions): string {
  return formatParsedDevice({ address }, options)
}

/** As `formatDevice`, with the bit or the digits. */
export function formatParsedDevice({ address, bit, digits }: ParsedDevice, options: AddressOptions): string {
  const { extension, extensionIndex, index } = address
  const info = deviceInfo(address.device)
  const place = extension === undefined ? '' : `${formatExtension(extension)}${formatIndex(extensionIndex)}\\`
  const number = address.number.toString(radixOf(info, address, options)).toUpperCase()
  return [
    address.indirect === undefined ? '' : '@',
    place,
    digits === undefined ? '' : `K${digits}`,
    info.name,
    number,
    formatIndex(index),
    bit === undefined ? '' : `.${hex(bit)}`,
  ].join('')
}

function formatExtension(extension: DeviceExtension): string {
  switch (extension.kind) {
    case 'link':
      return `J${extension.network}`
    case 'module':
      return `U${hex(extension.unit)}`
    case 'cpu':
      return `U${hex(CPU_UNIT + extension.cpu - 1)}`
    default:
      return extension satisfies never
  }
}

function formatIndex(index: DeviceAddress['index']): string {
  return index === undefined ? '' : `${index.register}${index.number}`
}
