/** Items of a Sharp JW moved to other operands. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { parseJwItem } from '../../../src/client/jw/item'
import { type JwOffset, moveJwItem } from '../../../src/client/jw/move'
import { defineTags, tagsOfMachine } from '../../../src/index'
import { lastByteOf } from '../../../src/jw/operand/kind'
import { offsetOfJw } from '../../../src/jw/operand/place'

test.each([
  ['09012', 1, '09013'],
  ['09012:INT', 2, '09014:INT'],
  ['09777', 1, '19000'],
  ['09770:INT[4]', 8, '19000:INT[4]'],
  ['09012.3', 1, '09013.3'],
  ['004033', 5, '004040'],
  ['04033', 1, '004034'],
  ['KO0403', 1, 'KO0404'],
  ['TMR0007', 1, 'TMR0010'],
  ['F1:00001277:REAL', 1, 'F1:00001300:REAL'],
  ['09012:INT', 0, '09012:INT'],
  ['09012:INT', { register: 0o100, relay: 8 }, '09112:INT'],
  ['004033', { register: 8 }, '004033'],
] as const)('%s moved by %j is %s', (item, offset, moved) => {
  expect(moveJwItem(item, offset)).toBe(moved)
})

describe('refused is', () => {
  test.each([
    ['09012', -1, 'BAD_OPTION', /whole number of operands from 0, not -1/],
    ['09012', 1.5, 'BAD_OPTION', /not 1.5/],
    ['09012', '8', 'BAD_OPTION', /not '8'/],
    ['09012', { D: 8 }, 'BAD_OPTION', /There is no kind 'D' of operands/],
    ['09012', { register: undefined }, 'BAD_OPTION', /not undefined/],
    ['D100', 1, 'BAD_ADDRESS', /D100/],
    ['09012', 1_000_000, 'OUT_OF_RANGE', /is not in one piece with it/],
    [`F1:${(lastByteOf(1) - 1).toString(8).padStart(8, '0')}:INT`, 1, 'OUT_OF_RANGE', /./],
  ] as const)('%s moved by %j', (item, offset, code, message) => {
    expect(() => moveJwItem(item, offset as JwOffset)).toThrow(expect.objectContaining({ code }))
    expect(() => moveJwItem(item, offset as JwOffset)).toThrow(message)
  })
})

test('registers lie as many bytes on as they were moved', () => {
  fc.assert(
    fc.property(fc.nat(200), fc.nat(1000), (at, by) => {
      const item = `F1:${at.toString(8).padStart(8, '0')}:INT`
      const [from, to] = [parseJwItem(item).place, parseJwItem(moveJwItem(item, by)).place]
      expect(offsetOfJw(from, to)).toBe(8 * by)
    }),
  )
})

test('one table serves many equal machines', () => {
  const { tags } = defineTags({ level: '09012:INT', pump: '004033' })
  const moved = tagsOfMachine(tags, { offset: { register: 0o100, relay: 0o20 } }, moveJwItem)
  expect(moved.map(({ address }) => address)).toEqual(['09112:INT', '004053'])
})
