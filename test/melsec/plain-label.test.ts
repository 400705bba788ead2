import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { formatDevice } from '../../src/melsec/device/address'
import { devices, devicesOfGroup } from '../../src/melsec/device/device'
import { isLabelName, isPlainLabel } from '../../src/melsec/label/plain-label'

const options = { xyRadix: 16 } as const

test.each([
  'Speed',
  'Line1.Speed',
  'Line1.Values[2]',
  'Line[3].Speed',
  'Line1[3].A',
  'Values[3]',
  'Table[1, 0,3]',
  'Motor_1',
  '_start',
  'D_100',
  'D100_old',
  'Line1Speed',
  'Timer1.S',
  'Timer1.C',
  'Timer1.N',
  'Tank.C',
  'X.Speed',
  'Pos1.X',
  'Line1.Motor5',
  'Head',
  'Fill',
  '速度',
  'モータ1',
  'モータ１',
  'ﾓｰﾀ1.速度',
  'Größe.Wert',
  'Скорость.X',
])('%s is a label', (text) => {
  expect(isPlainLabel(text)).toBe(true)
})

test.each([
  ['letters and a number', ['DD100', 'Q5', 'Motor5', 'XX1F', 'DD100Z2', 'Line1', 'DI0', 'М100', 'Δ1']],
  ['devices', ['D100', 'd100', 'M0', 'X1F', 'W1F.A', 'ZR5', 'TN5', 'D100Z2', 'Bed', 'Face0', 'Ｄ１００', 'LSTN0']],
  ['timers and counters, whose part is missing', ['T5', 'ST0', 'C10', 'LT1.S', 'T5.Value', 'C1.N']],
  ['something wrong behind a device', ['D100.G', 'D100.Speed', 'M0.A', 'D100A', 'D10O', 'M1Speed', 'K4Motor', 'D100F']],
  ['bits of what looks like a word', ['DD100.F', 'Line1.F', 'Q5.A', 'DD100.F[4]']],
  ['a device without its number', ['D', 'zr', 'X', 'T', 'DO', 'MO', 'D.F']],
  ['counts', ['DD100[16]', 'Q5[2]', 'M0[16]', 'D[3]', 'D100[1,0]', 'D100[2].F']],
  ['other makers', ['DB1.DBW0', 'DB1.DBX0.0', 'MW10', 'I0.1', 'DM100', '%MW10', '40001']],
  ['digit designation', ['K4M0', 'K4Motor', 'K4']],
  [
    'what has other signs',
    ['D-100', 'Line1..Line5', 'Line 1.Speed', '@D0', 'U3\\G100', 'a/b', 'A.', '.A', '', 'A.3', 'A[x]'],
  ],
  ['addresses where X, Y and W are hexadecimal', ['XFACE', 'yada', 'XFA.F', 'WED', 'Wed[2]']],
  ['digits of other scripts', ['D١٠٠', 'Speed٣']],
])('%s: no label', (_, texts) => {
  expect(texts.filter((text) => isPlainLabel(text))).toEqual([])
})

test.each(['D100', 'T5', 'ST0', 'd0', 'D-100', 'K4'.replace('4', '-4'), 'A.3', ''])('%s cannot be a name', (text) => {
  expect(isLabelName(text)).toBe(false)
})

describe('no device address', () => {
  const address = fc.record({ device: fc.constantFrom(...devices), number: fc.nat(0xffff) })
  const text = address.map(({ device, number }) => formatDevice({ device: device.name, number }, options))

  test('is ever a label', () => {
    fc.assert(
      fc.property(text, fc.constantFrom('', '.0', '.F', '[10]', '.Speed'), (device, tail) => {
        expect(isPlainLabel(device + tail)).toBe(false)
        expect(isPlainLabel((device + tail).toLowerCase())).toBe(false)
      }),
    )
  })

  test('becomes a label by one sign that was typed twice, left out, or is a letter O for a zero', () => {
    fc.assert(
      fc.property(address, fc.nat(), fc.boolean(), ({ device: { name, unit }, number }, random, withBit) => {
        const device = formatDevice({ device: name, number }, options)
        const bit = withBit && unit === 'word' ? '.F' : ''
        const at = random % device.length
        const mistyped = [
          device.slice(0, at) + device.slice(at, at + 1) + device.slice(at),
          device.slice(0, at) + device.slice(at + 1),
          device.replace(/0/g, 'O'),
        ]
        // What has no digit at all is a word; hexadecimal numbers can be.
        const risky = mistyped.filter((one) => /\d/.test(one))
        expect(risky.filter((one) => isPlainLabel(one + bit))).toEqual([])
      }),
    )
  })

  test('is a timer or counter without its part', () => {
    expect(devicesOfGroup('T').length).toBeGreaterThan(0)
    expect(isPlainLabel('LST5')).toBe(false)
  })
})
