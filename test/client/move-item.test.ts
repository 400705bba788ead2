/** Items moved to other devices. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { parseItem } from '../../src/client/item/item'
import { type DeviceOffset, moveItem } from '../../src/client/item/move'

const hexadecimal = { xyRadix: 16 } as const

test.each([
  ['D100', 50, 'D150'],
  ['d0100:real[4]', 50, 'D150:REAL[4]'],
  ['D100:INT', 1, 'D101'],
  ['M0..M15', 16, 'M16[16]'],
  ['X1F', 1, 'X20'],
  ['W1F', 1, 'W20'],
  ['D100.F', 1, 'D101.F'],
  ['K4M0', 16, 'K4M16'],
  ['U3\\G100', 5, 'U3\\G105'],
  ['J1\\W10', 16, 'J1\\W20'],
  ['D100Z2', 5, 'D105Z2'],
  ['D100', -100, 'D0'],
  ['D100', 0, 'D100'],
  ['X1F', { X: 1, D: 5 }, 'X20'],
  ['SM400', { D: 5 }, 'SM400'],
  ['label:Line1.Speed', { D: 5 }, 'label:Line1.Speed'],
] as const)('%s moved by %j is %s', (item, offset, moved) => {
  expect(moveItem(item, offset, hexadecimal)).toBe(moved)
})

test('numbers count devices, also where they are octal', () => {
  expect(moveItem('X7', 1, { xyRadix: 8 })).toBe('X10')
})

describe('refused is', () => {
  test.each([
    ['D5', -6, 'OUT_OF_RANGE', 'D5 moved by -6 is in front of D0.'],
    ['D4294967295', 1, 'OUT_OF_RANGE', /./],
    ['DD5', 1, 'BAD_ADDRESS', /DD5/],
    ['label:Speed', 1, 'UNSUPPORTED', /a label is no device/],
    ['D5', 1.5, 'BAD_OPTION', 'An offset is a whole number of devices, not 1.5.'],
    ['D5', '1', 'BAD_OPTION', 'An offset is a whole number of devices, not 1.'],
    ['D5', null, 'BAD_OPTION', 'An offset is a whole number of devices, not null.'],
    ['D5', { D: undefined }, 'BAD_OPTION', 'An offset is a whole number of devices, not undefined.'],
    ['D5', { Q: 1 }, 'BAD_OPTION', 'There is no device Q to move.'],
  ] as const)('%s by %j', (item, offset, code, message) => {
    const run = () => moveItem(item, offset as DeviceOffset, hexadecimal)
    expect(run).toThrow(expect.objectContaining({ code }))
    expect(run).toThrow(message)
  })
})

test('nothing but the number changes, and the way back leads to the same item', () => {
  const number = fc.nat({ max: 10_000 })
  const text = fc.constantFrom('D', 'M', 'X', 'W', 'ZR', 'K4M', 'U3\\G').chain((device) =>
    fc.tuple(number, fc.constantFrom('', '[3]')).map(([at, count]) => {
      const radix = device === 'X' || device === 'W' ? 16 : 10
      return `${device}${at.toString(radix).toUpperCase()}${count}`
    }),
  )
  fc.assert(
    fc.property(text, number, (item, by) => {
      const before = parseItem(item, hexadecimal)
      const after = parseItem(moveItem(item, by, hexadecimal), hexadecimal)
      const { number: at, ...place } = before.address
      expect(after).toEqual({ ...before, text: after.text, address: { ...place, number: at + by } })
      expect(moveItem(after.text, -by, hexadecimal)).toBe(item)
    }),
  )
})
