/** A deadband hides no change that exceeds it. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { hasChanged, thresholdOf } from '../../src/tags/table/deadband'
import type { Tag } from '../../src/tags/table/tag'

const tag = (fields: Partial<Tag>): Tag => ({ name: 'level', address: 'D100', ...fields })

describe('the threshold', () => {
  test('is 0 without a deadband, else the number itself, or percent of the range', () => {
    const percent = { kind: 'percent', value: 2 } as const
    expect(thresholdOf(tag({}))).toBe(0)
    expect(thresholdOf(tag({ deadband: { kind: 'absolute', value: 0.5 } }))).toBe(0.5)
    expect(thresholdOf(tag({ deadband: percent, min: -10, max: 40 }))).toBe(1)
    const scaling = { kind: 'linear', raw: [0, 4000], engineering: [100, 0] } as const
    expect(thresholdOf(tag({ deadband: percent, scaling, min: 0, max: 1 }))).toBe(2)
  })
})

describe('what has changed', () => {
  test.each([
    [1, 20.5, 21.5, false],
    [1, 20.5, 21.6, true],
    [0, 1, 1, false],
    [0, 0, -0, false],
    [0, 0, Number.MIN_VALUE, true],
    [1e300, Number.NaN, Number.NaN, false],
    [1e300, Number.NaN, 1, true],
    [1e300, 1, Number.NaN, true],
    [1e300, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, false],
    [1e300, Number.POSITIVE_INFINITY, 1, true],
    [1e300, -1.7e308, 1.7e308, true],
    [5, 10n, 15n, false],
    [5, 10n, 16n, true],
    [5.5, 10n, 16n, true],
    [0, 2n ** 63n, 2n ** 63n - 1n, true],
    [5, true, false, true],
    [5, 'a', 'b', true],
    [5, 'a', 'a', false],
    [5, 5, 5n, true],
    [1, [1, 2], [2, 3], false],
    [1, [1, 2], [2, 3.5], true],
    [1, [1, 2], [1, 2, 3], true],
    [1, [1], 1, true],
  ] as const)('with %p from %p to %p: %p', (threshold, told, now, changed) => {
    expect(hasChanged(threshold, told, now)).toBe(changed)
    expect(hasChanged(threshold, now, told)).toBe(changed)
  })

  /** A floating-point number as the whole number of 2 ** -1074 that it is. */
  function exact(value: number): bigint {
    const view = new DataView(new ArrayBuffer(8))
    view.setFloat64(0, value)
    const bits = view.getBigUint64(0)
    const exponent = (bits >> 52n) & 0x7ffn
    const fraction = bits & ((1n << 52n) - 1n)
    const size = exponent === 0n ? fraction : (fraction | (1n << 52n)) << (exponent - 1n)
    return bits >> 63n === 1n ? -size : size
  }

  const finite = fc.double({ noNaN: true, noDefaultInfinity: true })
  const near = fc.integer({ min: -100, max: 100 }).map((n) => n / 10)

  test('is what differs by more than the threshold, to the last bit', () => {
    const number = fc.oneof(finite, near)
    fc.assert(
      fc.property(number, number, number.map(Math.abs), (told, now, threshold) => {
        const difference = exact(now) - exact(told)
        const exceeds = (difference < 0n ? -difference : difference) > exact(threshold)
        expect(hasChanged(threshold, told, now)).toBe(exceeds)
      }),
      { numRuns: 2000 },
    )
  })

  test('a slow drift is told each time it has left the last value by more than the threshold', () => {
    fc.assert(
      fc.property(fc.array(near, { minLength: 1 }), near.map(Math.abs), (steps, threshold) => {
        let told = 0
        let now = 0
        for (const step of steps) {
          now += step
          if (hasChanged(threshold, told, now)) told = now
          expect(exact(now) - exact(told) <= exact(threshold)).toBe(true)
          expect(exact(told) - exact(now) <= exact(threshold)).toBe(true)
        }
      }),
    )
  })
})
