// Which module is where for Extend Unit: the manual's example, its table, and what must not be guessed.
import { describe, expect, test } from '@jest/globals'
import { byteAddressOf, extendUnitOf, extendUnits } from '../../src/melsec/extend-unit'

test('the example of the manual: Q62DA at 30 to 4F, address 18H', () => {
  const unit = extendUnitOf('Q62DA', { startIo: 0x30 })
  expect([unit.moduleNumber, byteAddressOf(unit, 0x18)]).toEqual([3, 0x1038])
})

// From the manual's table, by hand.
test.each([
  ['QD35ID1', 0x4000, 0],
  ['q64ad-gh', 0x1008, 0],
  ['Q64TCTTBW', 0x1000, 1],
  ['Q64TD (function version B)', 0x2000, 0],
  ['Q64RD (function version C)', 0x8000, 0],
  ['QD70D8', 0x5000, 1],
  ['QD72P3C3', 0x5000, 0],
  ['QJ61CL12', 0x1b4, 0],
  ['QJ71E71-100', 0x10000, 0],
])('%s: start address %d, on slot 0 module No. %d', (model, startAddress, slot0) => {
  expect(extendUnitOf(model, { startIo: 0x80 })).toMatchObject({ startAddress, moduleNumber: 8 + slot0 })
})

describe('modules whose number the manual does not show', () => {
  const models = extendUnits.filter(({ slot0 }) => slot0 === undefined).flatMap((info) => info.models)

  test('are those of the damaged rows', () => {
    const damaged = ['QD60P8-G', 'QD62', 'QD62E', 'QD62D', 'QD63P6', 'QD64D2', 'QD70P4', 'QD70P8']
    expect(models).toEqual(damaged)
  })

  test.each(models)('%s is refused without it and taken with it', (model) => {
    const refused = expect.objectContaining({ code: 'BAD_OPTION', field: 'slot0' })
    expect(() => extendUnitOf(model, { startIo: 0x10 })).toThrow(refused)
    expect(extendUnitOf(model, { startIo: 0x10, slot0: 1 }).moduleNumber).toBe(2)
    expect(extendUnitOf(model, { startIo: 0x10, slot0: 0 }).moduleNumber).toBe(1)
  })
})

test('no model is in two rows', () => {
  const models = extendUnits.flatMap((info) => info.models)
  expect(new Set(models).size).toBe(models.length)
})

test.each([
  ['Q99', { startIo: 0 }, 'model', 'U3\\G100'],
  ['Q64TD', { startIo: 0 }, 'model', 'function version B'],
  ['Q62DA', { startIo: 0x38 }, 'startIo', 'multiple of 16'],
  ['Q62DA', { startIo: -16 }, 'startIo', 'multiple of 16'],
  ['Q62DA', { startIo: 0x1000 }, 'startIo', '0xFF0'],
  ['Q62DA', { startIo: Number.NaN }, 'startIo', 'NaN'],
  ['Q62DA', { startIo: 0, slot0: 1 }, 'slot0', 'leave it out'],
  ['QD62', { startIo: 0, slot0: 2 }, 'slot0', 'it is 0 or 1'],
])('%s %j is refused: %s', (model, place, field, says) => {
  expect(() => extendUnitOf(model, place)).toThrow(expect.objectContaining({ code: 'BAD_OPTION', field }))
  expect(() => extendUnitOf(model, place)).toThrow(says)
})

test.each([-1, 0.5, Number.NaN, 2 ** 31])('%d is no buffer memory address', (address) => {
  const unit = extendUnitOf('QD75P1', { startIo: 0 })
  expect(() => byteAddressOf(unit, address)).toThrow(expect.objectContaining({ code: 'OUT_OF_RANGE' }))
})
