import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { ProtocolError, RequestError } from '../../src/errors'
import { aCompatibleDevice, aCompatibleDevices } from '../../src/melsec/a-compatible/device'
import { FORM_XY_OCTAL } from '../../src/melsec/device/codec'
import type { DeviceAddress, DeviceName } from '../../src/melsec/device/device'
import { read, readBytes, write } from './device-bytes'

// iQ-F communication manual ch. 39.2: [device, binary, ASCII] of number 4D2H = 1234.
const TABLE: [DeviceName, string, string][] = [
  ['X', 'd20400002058', '5820000004D2'],
  ['Y', 'd20400002059', '5920000004D2'],
  ['M', 'd2040000204d', '4D20000004D2'],
  ['S', 'd20400002053', '5320000004D2'],
  ['D', 'd20400002044', '4420000004D2'],
  ['R', 'd20400002052', '5220000004D2'],
  ['TS', 'd20400005354', '5453000004D2'],
  ['TN', 'd20400004e54', '544E000004D2'],
  ['CS', 'd20400005343', '4353000004D2'],
  ['CN', 'd20400004e43', '434E000004D2'],
]

describe('devices of the 1E frame', () => {
  test('are those of the manual that an FX5 lets through', () => {
    expect(aCompatibleDevices.map(({ name }) => name)).toEqual(TABLE.map(([name]) => name))
  })

  test.each(TABLE)('%s', (device, binary, ascii) => {
    const address = { device, number: 1234 }
    expect(write(aCompatibleDevice, address, false, 0)).toBe(binary)
    expect(read(aCompatibleDevice, binary, false, 0)).toEqual(address)
    expect(write(aCompatibleDevice, address, true, 0)).toBe(ascii)
    expect(read(aCompatibleDevice, ascii, true, 0)).toEqual(address)
  })

  test('Y100 in octal is 40H; with the octal setting ASCII writes the octal digits', () => {
    const y100 = { device: 'Y', number: 0o100 } as const
    expect(write(aCompatibleDevice, y100, true, 0)).toBe('592000000040')
    expect(write(aCompatibleDevice, y100, true, FORM_XY_OCTAL)).toBe('592000000100')
    expect(read(aCompatibleDevice, '592000000100', true, FORM_XY_OCTAL)).toEqual(y100)
    expect(write(aCompatibleDevice, y100, false, FORM_XY_OCTAL)).toBe('400000002059')
  })

  const REFUSED: [DeviceAddress, boolean, number][] = [
    [{ device: 'W', number: 0 }, false, 0],
    [{ device: 'TC', number: 0 }, true, 0],
    [{ device: 'D', number: 0, index: { register: 'Z', number: 0 } }, false, 0],
    [{ device: 'D', number: 0, indirect: true }, false, 0],
    [{ device: 'X', number: 0, extension: { kind: 'link', network: 1 } }, false, 0],
    [{ device: 'X', number: 8 ** 8 }, true, FORM_XY_OCTAL],
    [{ device: 'D', number: -1 }, false, 0],
  ]
  test.each(REFUSED)('%j is refused', (address, ascii, form) => {
    expect(() => write(aCompatibleDevice, address, ascii, form)).toThrow(RequestError)
  })

  test('codes that are listed but not accessible are not read', () => {
    expect(() => read(aCompatibleDevice, '000000002057', false, 0)).toThrow(ProtocolError)
    expect(() => read(aCompatibleDevice, '582000000019', true, FORM_XY_OCTAL)).toThrow(ProtocolError)
  })

  test('every number comes back; any bytes give a value or a ProtocolError', () => {
    const address = fc.record({
      device: fc.constantFrom(...aCompatibleDevices.map(({ name }) => name)),
      number: fc.integer({ min: 0, max: 8 ** 8 - 1 }),
    })
    const form = fc.constantFrom(0, FORM_XY_OCTAL)
    fc.assert(
      fc.property(address, fc.boolean(), form, fc.uint8Array({ maxLength: 14 }), (value, ascii, bits, raw) => {
        expect(read(aCompatibleDevice, write(aCompatibleDevice, value, ascii, bits), ascii, bits)).toEqual(value)
        try {
          readBytes(aCompatibleDevice, Buffer.from(raw), ascii, bits)
        } catch (error) {
          expect(error).toBeInstanceOf(ProtocolError)
        }
      }),
    )
  })
})
