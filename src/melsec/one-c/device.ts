/**
 * Devices of the 1C frame (FX5 communication manual 44.4): the name, then decimal digits, of X and Y octal or hexadecimal
 * ones. Five characters in all, seven in commands that begin with Q; names of timers and counters have two of them.
 */
import type { Reader, ValueCodec } from '../../codec/codec'
import { digitValue } from '../../codec/codec'
import { RequestError } from '../../errors'
import { checkAddress } from '../device/access'
import { FORM_XY_OCTAL } from '../device/codec'
import { type DeviceAddress, type DeviceName, deviceInfo } from '../device/device'

/** Names that a 1C frame has; SM, SD, LCS and LCN go under others. */
const names = ['X', 'Y', 'M', 'S', 'TS', 'TN', 'CS', 'CN', 'D', 'R'] as const satisfies readonly DeviceName[]

const ONE_C_ONLY = 'A 1C frame takes no J, U, index register or @: use a 3C or 4C frame.'

/** In commands that do not begin with Q. */
export const shortDevice = deviceOf(5)
/** In QR, QW and QT. */
export const longDevice = deviceOf(7)

/** Of the form bits only FORM_XY_OCTAL has a meaning here. */
function deviceOf(size: 5 | 7): ValueCodec<DeviceAddress> {
  return {
    name: `device of ${size} characters`,
    takes: 'a device such as "D100"',
    example: { device: 'D', number: 100 },
    write(writer, address) {
      checkPlain(address)
      const digits = address.number.toString(radixOf(address.device, writer.form)).toUpperCase()
      const room = size - address.device.length
      if (digits.length > room) {
        throw new RequestError(
          'OUT_OF_RANGE',
          `${address.device} number ${address.number} has more than ${room} digits in a 1C frame.`,
        )
      }
      writer.text(address.device + digits.padStart(room, '0'))
    },
    read(reader) {
      const text = reader.text(size)
      const device = names.find((name) => text.startsWith(name))
      if (device === undefined) return reader.fail('BAD_FIELD', `${JSON.stringify(text)} is no device of the 1C frame`)
      return { device, number: numberIn(reader, text.slice(device.length), radixOf(device, reader.form)) }
    },
    size: () => size,
  }
}

function radixOf(device: DeviceName, form: number): 8 | 10 | 16 {
  const { octal, radix } = deviceInfo(device)
  return octal === true && (form & FORM_XY_OCTAL) !== 0 ? 8 : radix
}

function numberIn(reader: Reader, digits: string, radix: number): number {
  let number = 0
  for (const character of digits) {
    const digit = digitValue(character.charCodeAt(0))
    if (digit < 0 || digit >= radix) reader.fail('BAD_DIGIT', `device number "${digits}" is not of radix ${radix}`)
    number = number * radix + digit
  }
  return number
}

function checkPlain(address: DeviceAddress): void {
  checkAddress(address)
  if (!names.some((name) => name === address.device)) {
    throw new RequestError(
      'UNSUPPORTED',
      `${address.device} cannot be addressed in a 1C frame: it has ${names.join(', ')}.`,
    )
  }
  const { extension, extensionIndex, index, indirect } = address
  if (extension ?? extensionIndex ?? index ?? indirect) throw new RequestError('UNSUPPORTED', ONE_C_ONLY)
}
