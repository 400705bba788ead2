/** Scaling, and the way back of it. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { engineeringOf, rawOf } from '../../src/tags/table/scaling'
import type { Scaling } from '../../src/tags/table/tag'

function linear(raw: readonly [number, number], engineering: readonly [number, number], clamp?: boolean): Scaling {
  return { kind: 'linear', raw, engineering, ...(clamp === undefined ? {} : { clamp }) }
}

const value = (scaling: Scaling, raw: number | bigint) => {
  const scaled = engineeringOf(scaling, raw)
  return scaled.ok ? scaled.value : scaled.reason
}

describe('linear scaling', () => {
  test.each([
    [linear([0, 1000], [0, 100]), 123, 12.3],
    [linear([0, 4000], [0, 10]), 1234, 3.085],
    [linear([0, 4000], [-50, 150]), 1002, 0.1],
    [linear([0, 3], [0, 0.1]), 3, 0.1],
    [linear([0, 3], [0.1, 0.7]), 0, 0.1],
    [linear([4000, 0], [0, 10]), 1000, 7.5],
    [linear([0, 100], [0, 1000]), -5, -50],
    [linear([0, 10], [32, 50]), 100, 212],
  ])('%j of %d is %d', (scaling, raw, engineering) => {
    expect(value(scaling, raw)).toBe(engineering)
    expect(rawOf(scaling, engineering)).toBe(raw)
  })

  test('is not clamped unless it is asked for, and says when it was', () => {
    expect(engineeringOf(linear([0, 100], [0, 10]), 120)).toEqual({ ok: true, value: 12, clamped: false })
    expect(engineeringOf(linear([0, 100], [0, 10], true), 120)).toEqual({ ok: true, value: 10, clamped: true })
    expect(engineeringOf(linear([0, 100], [10, 0], true), 120)).toEqual({ ok: true, value: 0, clamped: true })
    expect(engineeringOf(linear([0, 100], [0, 10], true), 100)).toEqual({ ok: true, value: 10, clamped: false })
  })

  test('takes 64-bit numbers', () => {
    expect(value(linear([0, 1000], [0, 1]), 123n)).toBe(0.123)
    expect(value(linear([0, 1000], [0, 1]), 2n ** 63n)).toBe(2 ** 63 / 1000)
  })

  test('of what is no number says so, clamped or not', () => {
    for (const clamp of [false, true]) {
      for (const raw of [Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY]) {
        expect(engineeringOf(linear([0, 100], [0, 10], clamp), raw)).toEqual({
          ok: false,
          reason: `${raw} in the PLC is no number that can be scaled.`,
        })
      }
    }
  })

  test('of what becomes too large says so, and large limits do no harm', () => {
    expect(value(linear([0, 1], [0, 1e308]), 100)).toBe('100 in the PLC is too large to be scaled.')
    expect(value(linear([0, 1e300], [0, 1e300]), 5e299)).toBeCloseTo(5e299, -290)
    expect(rawOf(linear([0, 1e308], [0, 1]), 100)).toBeUndefined()
  })
})

describe('square root', () => {
  const flow: Scaling = { kind: 'squareRoot', raw: [0, 4000], engineering: [0, 20] }

  test('is that of the part of the raw range', () => {
    expect(value(flow, 1000)).toBe(10)
    expect(value(flow, 4000)).toBe(20)
    expect(value(flow, 0)).toBe(0)
    expect(rawOf(flow, 10)).toBe(1000)
    expect(rawOf(flow, 20)).toBe(4000)
  })

  test('has no value below its beginning, and is the limit when it is clamped', () => {
    expect(value(flow, -1)).toBe('-1 in the PLC is beyond 0, where the square root begins.')
    expect(engineeringOf({ ...flow, clamp: true }, -1)).toEqual({ ok: true, value: 0, clamped: true })
    expect(engineeringOf({ ...flow, engineering: [20, 0], clamp: true }, -1)).toEqual({
      ok: true,
      value: 20,
      clamped: true,
    })
    expect(rawOf(flow, -1)).toBeUndefined()
  })
})

/** Limits as people write them: whole numbers in the PLC, up to three decimals for people. */
const rawLimits = fc
  .tuple(fc.integer({ min: -32768, max: 65535 }), fc.integer({ min: -32768, max: 65535 }))
  .filter(([low, high]) => low !== high)
const decimal = fc.integer({ min: -10_000_000, max: 10_000_000 }).map((n) => n / 1000)
const limits = fc.tuple(decimal, decimal).filter(([low, high]) => Math.abs(high - low) >= 0.01)

describe('for any scaling', () => {
  test('both ends are exact', () => {
    fc.assert(
      fc.property(fc.constantFrom('linear', 'squareRoot'), rawLimits, limits, (kind, raw, engineering) => {
        const scaling: Scaling = { kind, raw, engineering }
        expect(value(scaling, raw[0])).toBe(engineering[0])
        expect(value(scaling, raw[1])).toBe(engineering[1])
        expect(rawOf(scaling, engineering[0])).toBe(raw[0])
        expect(rawOf(scaling, engineering[1])).toBe(raw[1])
      }),
    )
  })

  test('the way back of a linear one leads to the same whole number', () => {
    fc.assert(
      fc.property(rawLimits, limits, fc.integer({ min: -32768, max: 65535 }), (raw, engineering, number) => {
        const scaling = linear(raw, engineering)
        const back = rawOf(scaling, value(scaling, number) as number)
        expect(Math.round(back ?? Number.NaN)).toBe(Math.round(number))
      }),
    )
  })

  test('the way back of a square root leads to the same whole number', () => {
    const inside = fc.integer({ min: 0, max: 4000 })
    fc.assert(
      fc.property(fc.integer({ min: -1000, max: 1000 }), limits, inside, (low, engineering, step) => {
        const scaling: Scaling = { kind: 'squareRoot', raw: [low, low + 4000], engineering }
        const back = rawOf(scaling, value(scaling, low + step) as number)
        // Of limits far from 0 a few digits are taken by the distance.
        expect(Math.abs((back ?? Number.NaN) - (low + step))).toBeLessThan(0.01)
      }),
    )
  })

  test('a linear one is the fraction of whole numbers, rounded once', () => {
    const whole = fc.integer({ min: -100_000, max: 100_000 })
    fc.assert(
      fc.property(rawLimits, fc.tuple(whole, whole), fc.integer({ min: -32768, max: 32767 }), (raw, ends, x) => {
        fc.pre(ends[0] !== ends[1])
        const [x0, x1] = raw
        // Exact: both are far below 2 ** 53.
        const sum = ends[0] * (x1 - x) + ends[1] * (x - x0)
        expect(value(linear(raw, [ends[0] / 1000, ends[1] / 1000]), x)).toBe(sum / ((x1 - x0) * 1000) + 0)
      }),
    )
  })

  test('nothing that is read becomes NaN or infinite', () => {
    const any = fc.double({ noNaN: false })
    const finite = fc.double({ noNaN: true, noDefaultInfinity: true })
    fc.assert(
      fc.property(
        fc.constantFrom('linear', 'squareRoot'),
        fc.tuple(finite, finite).filter(([a, b]) => a !== b),
        fc.tuple(finite, finite).filter(([a, b]) => a !== b),
        fc.boolean(),
        any,
        (kind, raw, engineering, clamp, number) => {
          const scaling: Scaling = { kind, raw, engineering, clamp }
          const scaled = engineeringOf(scaling, number)
          if (scaled.ok) expect(Number.isFinite(scaled.value)).toBe(true)
          if (scaled.ok && clamp) {
            expect(scaled.value).toBeGreaterThanOrEqual(Math.min(...engineering))
            expect(scaled.value).toBeLessThanOrEqual(Math.max(...engineering))
          }
          const back = Number.isFinite(number) ? rawOf(scaling, number) : 0
          if (back !== undefined) expect(Number.isFinite(back)).toBe(true)
        },
      ),
    )
  })
})
