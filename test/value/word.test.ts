import { expect, test } from '@jest/globals'
import fc from 'fast-check'
import { bitOf } from '../../src/value/value'
import { refusal } from './support'

test('bit F is the highest, bit 0 the lowest', () => {
  expect(bitOf(0x8000, 15)).toBe(true)
  expect(bitOf(0x7fff, 15)).toBe(false)
  expect(bitOf(0x0001, 0)).toBe(true)
})

test('the sixteen bits make the word', () => {
  fc.assert(
    fc.property(fc.integer({ min: 0, max: 0xffff }), (word) => {
      let sum = 0
      for (let bit = 0; bit < 16; bit++) sum += bitOf(word, bit) ? 2 ** bit : 0
      expect(sum).toBe(word)
    }),
  )
})

test('another bit, or what is not a word, is refused', () => {
  for (const bit of [-1, 16, 0.5, Number.NaN]) refusal('OUT_OF_RANGE', () => bitOf(0, bit))
  for (const word of [-1, 65536, 0.5, Number.NaN]) refusal('OUT_OF_RANGE', () => bitOf(word, 0))
})
