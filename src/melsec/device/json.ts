// A device address in JSON: the text an engineer types, or the object that a program makes of it.
import { RequestError } from '../../errors'
import { addressProblem } from './access'
import { formatDevice, parseDevice } from './address'
import type { DeviceAddress } from './device'

/** How X, Y and W are numbered in addresses. */
export interface Notation {
  /** 8 octal (FX, iQ-F), 16 hexadecimal; without it an address that depends on it is refused. */
  readonly xyRadix?: 8 | 16
  /** 16 hexadecimal (default), 10 decimal (SLMP inverters). */
  readonly wRadix?: 10 | 16
}

/**
 * @param field path of the field, for refusals
 * @throws RequestError BAD_ADDRESS, OUT_OF_RANGE
 */
export function deviceFromJson(given: unknown, field: string, notation: Notation): DeviceAddress {
  try {
    return typeof given === 'string' ? fromText(given, notation) : fromObject(given)
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    throw new RequestError(error.code, `${field}: ${error.message}`, field)
  }
}

/** The text where it means one device only, else the object. */
export function deviceToJson(value: unknown, notation: Notation): unknown {
  if (!isAddress(value)) return value
  const [text, ...others] = radices(notation).map((xyRadix) => formatDevice(value, { ...notation, xyRadix }))
  return others.every((other) => other === text) ? text : value
}

function isAddress(value: unknown): value is DeviceAddress {
  return typeof value === 'object' && value !== null && 'device' in value && 'number' in value
}

function radices({ xyRadix }: Notation): readonly (8 | 16)[] {
  return xyRadix === undefined ? [16, 8] : [xyRadix]
}

function fromText(text: string, notation: Notation): DeviceAddress {
  const [address, ...others] = radices(notation).map((xyRadix) => wholeDevice(text, xyRadix, notation))
  if (address === undefined || others.some((other) => other?.number !== address.number)) refuseAmbiguous(text)
  return address
}

/** Octal cannot say 8, 9 and A to F: then only one of both is an address, and nobody knows whether it is meant. */
function wholeDevice(text: string, xyRadix: 8 | 16, notation: Notation): DeviceAddress | undefined {
  try {
    const { address, bit, digits } = parseDevice(text, { ...notation, xyRadix })
    if (bit === undefined && digits === undefined) return address
    bad(
      `${JSON.stringify(text)} is ${bit === undefined ? 'a digit designation' : 'a bit of a word'}; a command takes a device.`,
    )
  } catch (error) {
    // As hexadecimal it was one before.
    if (notation.xyRadix === undefined && xyRadix === 8) return undefined
    throw error
  }
}

function refuseAmbiguous(text: string): never {
  bad(
    `${JSON.stringify(text)}: X and Y are numbered in octal on iQ-F and FX and in hexadecimal elsewhere, and nothing says which. ` +
      'Choose the profile of the PLC, or set xyRadix to 8 or 16.',
  )
}

function fromObject(given: unknown): DeviceAddress {
  if (!isAddress(given))
    bad('a device is a text such as "D100", or an object such as { "device": "D", "number": 100 }.')
  const problem = addressProblem(given)
  if (problem !== undefined) throw new RequestError(problem.code, problem.message)
  // What the text does not say is a misspelt name or a value that would be passed over.
  const { address } = parseDevice(formatDevice(given, { xyRadix: 16 }), { xyRadix: 16 })
  if (!isSame(address, given))
    bad(`the object has something that an address has not; as text it is ${formatDevice(given, { xyRadix: 16 })}.`)
  return address
}

function isSame(a: unknown, b: unknown): boolean {
  if (typeof a !== 'object' || a === null || typeof b !== 'object' || b === null) return a === b
  const [left, right] = [Object.entries(a), new Map(Object.entries(b).filter(([, value]) => value !== undefined))]
  return left.length === right.size && left.every(([name, value]) => isSame(value, right.get(name)))
}

function bad(message: string): never {
  throw new RequestError('BAD_ADDRESS', message)
}
