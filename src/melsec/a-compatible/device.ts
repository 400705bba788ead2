/**
 * Devices of the A-compatible 1E frame (iQ-F communication manual ch. 39.2): a two-character code as a 2-byte number
 * (`X ` = 5820H), and the number as 4 bytes. Unlike 3E, ASCII code writes decimal devices in hexadecimal too.
 * The manual lists more codes (L, F, B, W, ...) that the FX5 does not let through 1E; they are not here.
 */
import type { ValueCodec } from '../../codec/codec'
import { RequestError } from '../../errors'
import { checkAddress } from '../device/access'
import { FORM_XY_OCTAL, readDigits, writeDigits } from '../device/codec'
import { type DeviceAddress, type DeviceName, deviceInfo } from '../device/device'

/** One row: the device and its code, e.g. 4420H = `D `. */
export interface ACompatibleDevice {
  readonly name: DeviceName
  readonly code: number
}

export const aCompatibleDevices = [
  { name: 'X', code: 0x5820 },
  { name: 'Y', code: 0x5920 },
  { name: 'M', code: 0x4d20 },
  { name: 'S', code: 0x5320 },
  { name: 'D', code: 0x4420 },
  { name: 'R', code: 0x5220 },
  { name: 'TS', code: 0x5453 },
  { name: 'TN', code: 0x544e },
  { name: 'CS', code: 0x4353 },
  { name: 'CN', code: 0x434e },
] as const satisfies readonly ACompatibleDevice[]

const BY_NAME: ReadonlyMap<string, ACompatibleDevice> = new Map(aCompatibleDevices.map((row) => [row.name, row]))
const BY_CODE: ReadonlyMap<number, ACompatibleDevice> = new Map(aCompatibleDevices.map((row) => [row.code, row]))

const LAST_OCTAL = 8 ** 8 - 1

/** Device and number of a 1E request. Of the form bits only FORM_XY_OCTAL has a meaning here. */
export const aCompatibleDevice: ValueCodec<DeviceAddress> = {
  name: 'A-compatible device',
  takes: 'a device such as "D100"',
  example: { device: 'D', number: 100 },
  write(writer, address) {
    checkAddress(address)
    const row = rowOf(address)
    if (!writer.ascii) {
      writer.uint(address.number, 4)
      writer.uint(row.code, 2)
      return
    }
    const octal = isOctal(row.name, writer.form)
    if (octal && address.number > LAST_OCTAL) {
      throw new RequestError('OUT_OF_RANGE', `${row.name} number ${address.number} has more than eight octal digits.`)
    }
    writer.uint(row.code, 2)
    if (octal) writeDigits(writer, address.number, 8, 8)
    else writer.uint(address.number, 4)
  },
  read(reader) {
    const first = reader.ascii ? 0 : reader.uint(4)
    const code = reader.uint(2)
    const row = BY_CODE.get(code)
    if (row === undefined) {
      return reader.fail('BAD_FIELD', `${code.toString(16).toUpperCase()}H is not a device code of the 1E frame`)
    }
    if (!reader.ascii) return { device: row.name, number: first }
    const number = isOctal(row.name, reader.form) ? readDigits(reader, 8, 8) : reader.uint(4)
    return { device: row.name, number }
  },
  size: (ascii) => (ascii ? 12 : 6),
}

function isOctal(name: DeviceName, form: number): boolean {
  return deviceInfo(name).octal === true && (form & FORM_XY_OCTAL) !== 0
}

function rowOf(address: DeviceAddress): ACompatibleDevice {
  const row = BY_NAME.get(address.device)
  if (row === undefined) {
    const names = aCompatibleDevices.map(({ name }) => name).join(', ')
    throw new RequestError('UNSUPPORTED', `${address.device} cannot be addressed in a 1E frame: it has ${names}.`)
  }
  const { extension, extensionIndex, index, indirect } = address
  if (extension ?? extensionIndex ?? index ?? indirect) {
    throw new RequestError('UNSUPPORTED', 'A 1E frame takes no J, U, index register or @: use a 3E or 4E frame.')
  }
  return row
}
