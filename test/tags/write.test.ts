/** What is written of a value that people gave, and what is refused. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { RequestError } from '../../src/errors'
import { engineeringOf } from '../../src/tags/table/scaling'
import type { Tag } from '../../src/tags/table/tag'
import { rawValueOf } from '../../src/tags/table/write'
import { type PlcValue, parseType } from '../../src/value/type'

const tag = (fields: Partial<Tag> = {}): Tag => ({ name: 'level', address: 'D100', access: 'readWrite', ...fields })
const scaled = (fields: Partial<Tag> = {}): Tag =>
  tag({ scaling: { kind: 'linear', raw: [0, 4000], engineering: [0, 10] }, ...fields })

function refusal(run: () => unknown): RequestError {
  try {
    run()
  } catch (error) {
    if (error instanceof RequestError) return error
    throw error
  }
  throw new Error('it was not refused')
}

const refused = (of: Tag, type: string, value: PlcValue | PlcValue[], count?: number) => {
  const error = refusal(() => rawValueOf(of, parseType(type), count, value))
  expect(error.field).toBe('level')
  expect(error.message).toMatch(/^level \(D100\): /)
  return `${error.code} ${error.message.replace('level (D100): ', '')}`
}

describe('written is', () => {
  test.each([
    [scaled(), 'INT', 3.085, 1234, 3.085],
    [scaled(), 'INT', 3.086, 1234, 3.085],
    [scaled(), 'INT', -1, -400, -1],
    [scaled({ min: 0, max: 10 }), 'INT', 10, 4000, 10],
    [scaled(), 'LINT', 3.085, 1234n, 3.085],
    [scaled(), 'REAL', 0.001, 0.4, 0.001],
    [scaled(), 'INT', 5n, 2000, 5],
    [tag({ min: 0, max: 100 }), 'REAL', 71.3, 71.3, 71.3],
    [tag({ min: 0, max: 100 }), 'INT', 100, 100, 100],
    [tag({ min: 0 }), 'LINT', 2n ** 62n, 2n ** 62n, 2n ** 62n],
    [tag(), 'BOOL', true, true, true],
    [tag(), 'STRING(4)', 'ab', 'ab', 'ab'],
    [tag(), 'REAL', 1e300, 1e300, 1e300],
  ] as const)('of %j as %s for %p: %p, read as %p', (of, type, value, raw, read) => {
    expect(rawValueOf(of, parseType(type), undefined, value)).toEqual({ raw, value: read })
  })

  test('of halves the one away from zero', () => {
    const half = tag({ scaling: { kind: 'linear', raw: [0, 10], engineering: [0, 5] } })
    expect(rawValueOf(half, parseType('INT'), undefined, 1.25)).toEqual({ raw: 3, value: 1.5 })
    expect(rawValueOf(half, parseType('INT'), undefined, -1.25)).toEqual({ raw: -3, value: -1.5 })
    expect(rawValueOf(half, parseType('INT'), undefined, -0.1)).toEqual({ raw: 0, value: 0 })
  })

  test('of an array each element', () => {
    expect(rawValueOf(scaled(), parseType('INT'), 2, [1, 2])).toEqual({ raw: [400, 800], value: [1, 2] })
  })
})

describe('refused is', () => {
  test('a tag that is only read, also one that does not say', () => {
    const message = "NOT_PERMITTED it is only read: set access to 'readWrite' to write it."
    expect(refused(tag({ access: 'read' }), 'INT', 1)).toBe(message)
    expect(refusal(() => rawValueOf({ name: 'level', address: 'D100' }, parseType('INT'), undefined, 1)).code).toBe(
      'NOT_PERMITTED',
    )
  })

  test.each([
    [tag({ min: 0, max: 100, unit: '%' }), 'REAL', -0.1, 'OUT_OF_RANGE -0.1 is below its minimum of 0 %.'],
    [tag({ min: 0, max: 100 }), 'REAL', 100.1, 'OUT_OF_RANGE 100.1 is above its maximum of 100.'],
    [tag({ max: 100 }), 'LINT', 101n, 'OUT_OF_RANGE 101 is above its maximum of 100.'],
    [tag({ max: 1e6 }), 'INT', 40000, 'OUT_OF_RANGE 40000 is not from -32768 to 32767, as INT is.'],
    [tag({ max: 1e300 }), 'REAL', 1e299, 'OUT_OF_RANGE 1e+299 is more than REAL can hold.'],
    [tag({ max: 100 }), 'INT', 1.5, 'BAD_VALUE 1.5 is no whole number, as INT takes.'],
    [scaled(), 'INT', 100, 'OUT_OF_RANGE 100 (40000 in the PLC) is not from -32768 to 32767, as INT is.'],
    [scaled({ max: 3.086 }), 'INT', 3.0862, 'OUT_OF_RANGE 3.0862 is above its maximum of 3.086.'],
    [scaled(), 'INT', Number.NaN, 'BAD_VALUE it takes a finite number, not NaN.'],
    [scaled(), 'INT', Number.POSITIVE_INFINITY, 'BAD_VALUE it takes a finite number, not Infinity.'],
    [scaled(), 'INT', '5', "BAD_VALUE it takes a finite number, not '5'."],
    [scaled(), 'INT', true, 'BAD_VALUE it takes a finite number, not true.'],
    [scaled(), 'BOOL', 1, 'BAD_VALUE BOOL has no limits and no scaling.'],
    [scaled(), 'LINT', 2n ** 60n + 1n, /^BAD_VALUE .* has more digits than a scaled value can/],
  ])('%j as %s for %p', (of, type, value, message) => {
    if (typeof message === 'string') expect(refused(of, type, value)).toBe(message)
    else expect(refused(of, type, value)).toMatch(message)
  })

  test('what is beyond a clamped scaling: a write is never clamped', () => {
    const clamped = tag({ scaling: { kind: 'linear', raw: [0, 4000], engineering: [0, 10], clamp: true } })
    expect(refused(clamped, 'INT', 10.001)).toBe('OUT_OF_RANGE 10.001 is beyond 10, where its scale ends.')
    expect(rawValueOf(clamped, parseType('INT'), undefined, 10).raw).toBe(4000)
  })

  test('the low side of a square root', () => {
    const flow = tag({ scaling: { kind: 'squareRoot', raw: [0, 4000], engineering: [0, 10] } })
    expect(refused(flow, 'INT', -1)).toBe('OUT_OF_RANGE -1 has no value in the PLC by its scaling.')
  })

  test('a value within its limits when the nearest one in the PLC is not', () => {
    const coarse = tag({ max: 1.3, scaling: { kind: 'linear', raw: [0, 10], engineering: [0, 5] } })
    expect(refused(coarse, 'INT', 1.3)).toBe(
      'OUT_OF_RANGE 1.5, the nearest value to 1.3 that the PLC can hold, is above its maximum of 1.3.',
    )
    expect(rawValueOf(coarse, parseType('INT'), undefined, 1.2)).toEqual({ raw: 2, value: 1 })
  })

  test('one value for many, many for one, and another number of them', () => {
    expect(refused(tag(), 'INT', 1, 3)).toBe('BAD_VALUE it takes an array of 3 values, not 1.')
    expect(refused(tag(), 'INT', [1])).toBe('BAD_VALUE it takes one value, not an array of 1.')
    expect(refused(tag(), 'INT', [1, 2], 3)).toBe('BAD_VALUE it takes 3 values, not 2.')
    expect(refused(scaled(), 'INT', [1, 100], 2)).toMatch(/^OUT_OF_RANGE element 1: 100 \(40000 in the PLC\)/)
  })
})

test('whatever is written is within the limits, and not further from what was given than half a step', () => {
  const raw = fc.tuple(fc.integer({ min: -9000, max: 9000 }), fc.integer({ min: -9000, max: 9000 }))
  const ends = fc.tuple(fc.integer({ min: -500, max: 500 }), fc.integer({ min: -500, max: 500 }))
  const value = fc.integer({ min: -6000, max: 6000 }).map((n) => n / 10)
  fc.assert(
    fc.property(raw, ends, value, fc.boolean(), ([x0, x1], [y0, y1], given, clamp) => {
      fc.pre(x0 !== x1 && y0 !== y1)
      const of = tag({ min: -400, max: 400, scaling: { kind: 'linear', raw: [x0, x1], engineering: [y0, y1], clamp } })
      try {
        const written = rawValueOf(of, { name: 'INT' }, undefined, given)
        expect(Number.isInteger(written.raw)).toBe(true)
        expect(Math.abs(written.raw as number)).toBeLessThanOrEqual(32768)
        const read = engineeringOf(of.scaling as NonNullable<Tag['scaling']>, written.raw as number)
        expect(read).toEqual({ ok: true, value: written.value, clamped: false })
        expect(Math.abs(written.value as number)).toBeLessThanOrEqual(400)
        const step = Math.abs((y1 - y0) / (x1 - x0))
        expect(Math.abs((written.value as number) - given)).toBeLessThanOrEqual(step * 0.500001)
      } catch (error) {
        if (!(error instanceof RequestError)) throw error
        expect(error.code).toBe('OUT_OF_RANGE')
      }
    }),
  )
})
