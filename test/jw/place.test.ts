import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { writerOf } from '../../src/codec/codec'
import { RequestError } from '../../src/errors'
import { jwAddress } from '../../src/jw/address-codec'
import { assumedJwAreas, type JwArea, jwAreas } from '../../src/jw/operand/area'
import type { JwOperandOptions } from '../../src/jw/operand/map'
import { formatJwOperand } from '../../src/jw/operand/notation'
import { parseJwOperand } from '../../src/jw/operand/parse'
import {
  advanceJw,
  type JwFilePlace,
  jwAddressOf,
  offsetOfJw,
  placeOfJw,
  stepsBehind,
} from '../../src/jw/operand/place'

const placeOf = (text: string, options?: JwOperandOptions) => placeOfJw(parseJwOperand(text, options), options)

function messageOf(run: () => unknown): string {
  try {
    run()
  } catch (error) {
    if (error instanceof RequestError) return `${error.code} ${error.message}`
    throw error
  }
  return 'no error'
}

describe('operands lie where the manuals print them', () => {
  /** JW-21MN manual, 8-1: operand and file address (octal); JW-20FL5 manual, 9-19 and 9-29. */
  test.each<[string, number, number?]>([
    ['000000', 0o0, 0],
    ['003777', 0o377, 7],
    ['004000', 0o400, 0],
    ['006777', 0o677, 7],
    ['007000', 0o700, 0],
    ['007777', 0o777, 7],
    ['010000', 0o1000, 0],
    ['015777', 0o1577, 7],
    ['KO0000', 0o0],
    ['KO0377', 0o377],
    ['KO0400', 0o400],
    ['KO1577', 0o1577],
    ['b0000', 0o2000],
    ['b1777', 0o3777],
    ['09000', 0o4000],
    ['09777', 0o4777],
    ['19000', 0o5000],
    ['29777', 0o6777],
    ['39000', 0o7000],
    ['49777', 0o10777],
    ['59000', 0o11000],
    ['59777', 0o11777],
    ['69000', 0o12000],
    ['79000', 0o13000],
    ['89000', 0o14000],
    ['99777', 0o15777],
    ['04033', 0x103, 3],
    ['09000', 0x800],
    ['09000.7', 0x800, 7],
    ['KO0403.3', 0x103, 3],
  ])('%s', (...[text, address, bit]) => {
    expect(placeOf(text)).toEqual({ in: 'file', file: 0, address, ...(bit === undefined ? {} : { bit }) })
  })

  test('timers go by their number, system memory by its own address, files by themselves', () => {
    expect(placeOf('TMR0012')).toEqual({ in: 'timer', number: 10 })
    expect(placeOf('CNT177777')).toEqual({ in: 'timer', number: 0xffff })
    // JW-21MN manual, 10-6: #201 is 81H.
    expect(placeOf('#201')).toEqual({ in: 'system', address: 0x81 })
    expect(placeOf('#201.4')).toEqual({ in: 'system', address: 0x81, bit: 4 })
    expect(placeOf('F2:012345')).toEqual({ in: 'file', file: 2, address: 0x14e5 })
    expect(placeOf('F1:37777777.7')).toEqual({ in: 'file', file: 1, address: 0x7fffff, bit: 7 })
  })

  test('what is known says from where, and nothing assumed is among it', () => {
    for (const { confidence, source } of jwAreas) {
      expect(['printed', 'derived']).toContain(confidence)
      expect(source).toMatch(/manual/)
    }
    for (const { confidence } of assumedJwAreas) expect(confidence).toBe('assumed')
  })

  test('what is known does not overlap and has no hole from byte 0 on, but for the contacts', () => {
    const ends = jwAreas.map(({ first, last }) => [placeOf(first), placeOf(last)] as JwFilePlace[])
    const bytes = ends.map(([from, to]) => [from?.address ?? -1, to?.address ?? -1]).sort(([a = 0], [b = 0]) => a - b)
    let next = 0
    for (const [from = -1, to = -1] of bytes) {
      if (next === 0o1600) next = 0o2000
      expect(from).toBe(next)
      next = to + 1
    }
    expect(next).toBe(0o16000)
  })
})

describe('areas that the user gives', () => {
  const areas: readonly JwArea[] = [
    { first: '016000', last: '077777', file: 0, address: 0o20000 },
    { first: 'KO20000', last: 'KO20007', file: 2, address: 0o7 },
    { first: '109000', last: '109777', file: 0, address: 0o40000 },
    { first: 'b0000', last: 'b0007', file: 3, address: 1 },
  ]

  test('are where operands lie, before what is known', () => {
    expect(placeOf('016013', { areas })).toEqual({ in: 'file', file: 0, address: 0o20001, bit: 3 })
    expect(placeOf('KO1601', { areas })).toEqual({ in: 'file', file: 0, address: 0o20001 })
    expect(placeOf('KO20007', { areas })).toEqual({ in: 'file', file: 2, address: 0o16 })
    expect(placeOf('200077', { areas })).toEqual({ in: 'file', file: 2, address: 0o16, bit: 7 })
    expect(placeOf('109001', { areas })).toEqual({ in: 'file', file: 0, address: 0o40001 })
    expect(placeOf('b0001', { areas })).toEqual({ in: 'file', file: 3, address: 2 })
    expect(placeOf('b0010', { areas })).toEqual({ in: 'file', file: 0, address: 0o2010 })
    expect(messageOf(() => placeOf('200100', { areas }))).toContain('no source says')
  })

  test('may be the assumed ones', () => {
    expect(placeOf('E0012', { areas: assumedJwAreas })).toEqual({ in: 'file', file: 0, address: 0o16012 })
    expect(placeOf('E1777', { areas: assumedJwAreas })).toEqual({ in: 'file', file: 0, address: 0o17777 })
    expect(placeOf('T-C0013', { areas: assumedJwAreas })).toEqual({ in: 'file', file: 0, address: 0o1601, bit: 3 })
  })

  const good = { first: '016000', last: '016777', file: 0, address: 0o20000 }
  test.each<[string, unknown, string]>([
    ['no list', good, 'areas is a list of areas'],
    ['no object', ['016000'], 'an area is an object with first, last, file and address'],
    ['no operand', [{ ...good, first: '016800' }], 'octal'],
    ['no text', [{ ...good, first: 16000 }], 'An address is a text'],
    ['two kinds', [{ ...good, last: '09777' }], 'of one kind, the lower one first'],
    ['backwards', [{ ...good, last: '015777' }], 'the lower one first'],
    ['a bit', [{ ...good, first: '109000.0', last: '109777' }], 'its ends are relays, KO, registers, b, E or T-C'],
    ['a timer', [{ ...good, first: 'TMR0000', last: 'TMR0777' }], 'its ends are relays'],
    ['a bit within a byte', [{ ...good, first: '016001' }], 'the first of a byte, e.g. 016000'],
    ['half a byte', [{ ...good, last: '016773' }], 'the last of a byte, e.g. 016777'],
    [
      'twice',
      [good, { ...good, first: '016700', last: '017777' }],
      '016700 to 017777 and 016000 to 016777 place the same',
    ],
    ['twice, as bytes', [good, { ...good, first: 'KO1670', last: 'KO1700' }], 'place the same operands twice'],
    ['no file', [{ ...good, file: 0x81 }], 'file is a number from 0 to 0x80'],
    ['a fraction', [{ ...good, address: 1.5 }], 'address is a byte of the file'],
    ['an address as text', [{ ...good, address: '20000' }], 'address is a byte of the file'],
    ['behind the file', [{ ...good, address: 0o177777 }], 'it ends behind byte 177777 of the file'],
  ])('are refused: %s', (_what, given, part) => {
    const message = messageOf(() => placeOf('016000', { areas: given as readonly JwArea[] }))
    expect(message).toMatch(/^BAD_OPTION areas/)
    expect(message).toContain(part)
  })
})

describe('what lies behind an operand', () => {
  const next = (text: string, steps = 1, options?: JwOperandOptions) =>
    formatJwOperand(advanceJw(parseJwOperand(text, options), steps, options))

  test.each([
    ['004033', '004034'],
    ['004037', '004040'],
    ['003777', '004000'],
    ['KO0377', 'KO0400'],
    ['09007', '09010'],
    ['09777', '19000'],
    ['59777', '69000'],
    ['09012.7', '09013.0'],
    ['09777.7', '19000.0'],
    ['b0777', 'b1000'],
    ['TMR0007', 'TMR0010'],
    ['#0377', '#0400'],
    ['F1:00177777', 'F1:00200000'],
    ['F2:000007.7', 'F2:000010.0'],
  ])('%s goes on with %s', (text, wanted) => {
    expect(next(text)).toBe(wanted)
  })

  test.each([
    ['015777', '015777'],
    ['KO1577', 'KO1577'],
    ['b1777', 'b1777'],
    ['99777', '99777'],
    ['99777.7', '99777.7'],
    ['KO1577.7', 'KO1577.7'],
    ['F2:177777', 'F2:177777'],
    ['F1:37777777', 'F1:37777777'],
    ['#2177', '#2177'],
    ['TMR177777', 'TMR177777'],
  ])('%s is the last of its piece', (text, last) => {
    const operand = parseJwOperand(text)
    expect(stepsBehind(operand)).toBe(0)
    expect(messageOf(() => advanceJw(operand, 1))).toContain(`${last} is the last`)
  })

  test('an area that lies elsewhere ends the piece', () => {
    const apart = { areas: [{ first: '016000', last: '016777', file: 0, address: 0o20000 }] }
    expect(stepsBehind(parseJwOperand('015770'), apart)).toBe(7)
    const joined = { areas: [{ first: '016000', last: '016777', file: 0, address: 0o1600 }] }
    expect(next('015777', 1, joined)).toBe('016000')
  })

  test('an area within what is known cuts it', () => {
    const within = { areas: [{ first: '001000', last: '001777', file: 2, address: 0 }] }
    expect(stepsBehind(parseJwOperand('000000'), within)).toBe(0o777)
    expect(stepsBehind(parseJwOperand('001000'), within)).toBe(0o777)
    expect(placeOf('002000', within)).toEqual({ in: 'file', file: 0, address: 0o200, bit: 0 })
    expect(placeOf('000777', within)).toEqual({ in: 'file', file: 0, address: 0o77, bit: 7 })
    expect(formatJwOperand(advanceJw(parseJwOperand('002000'), 0o13777, within))).toBe('015777')
    expect(messageOf(() => advanceJw(parseJwOperand('KO0077'), 1, within))).toContain('KO0077 is the last')
  })

  test('steps and places agree', () => {
    const firsts = ['000000', 'KO0000', '09000', '09000.0', 'b0000', 'TMR0000', '#0000', 'F1:0', 'F2:0.3']
    fc.assert(
      fc.property(fc.constantFrom(...firsts), fc.nat(), fc.nat(), (text, a, b) => {
        const first = parseJwOperand(text)
        const room = stepsBehind(first) + 1
        const [one, other] = [advanceJw(first, a % room), advanceJw(first, b % room)]
        const isByte = first.bit === undefined && !['relay', 'TMR'].includes(first.kind)
        const distance = offsetOfJw(placeOfJw(one), placeOfJw(other))
        expect(distance).toBe(((b % room) - (a % room)) * (isByte ? 8 : 1))
      }),
    )
  })

  test('what is not in one file has no distance', () => {
    expect(offsetOfJw(placeOf('004033'), placeOf('09000'))).toBe((0o4000 - 0o403) * 8 - 3)
    expect(offsetOfJw(placeOf('F1:0'), placeOf('F2:0'))).toBeUndefined()
    expect(offsetOfJw(placeOf('#0000'), placeOf('F0:0'))).toBeUndefined()
    expect(offsetOfJw(placeOf('TMR0000'), placeOf('F0:0'))).toBeUndefined()
    expect(offsetOfJw(placeOf('#0001'), placeOf('#0000'))).toBe(-8)
  })
})

describe('addresses of commands', () => {
  /** The bytes of the address field, as manuals print them or the layouts give them. */
  test.each([
    // JW-20FL5 manual, 9-19: 20 00 03 01 03 monitors relay 04033; 9-29: 24 00 00 08 04 00 reads 09000 to 09003.
    ['04033', 'basic', '000301'],
    ['09000', 'basic', '000008'],
    ['04033', 'extended', 'FF0003010000'],
    ['F1:37777777', 'extended', 'FF01FFFF7F00'],
    ['F1:37777777', 'basic', '80FFFF'],
    ['F2:012345', 'basic', '02E514'],
  ] as const)('of %s, %s, are %s', (text, form, hex) => {
    const writer = writerOf('binary')
    jwAddress.write(writer, jwAddressOf(placeOf(text) as JwFilePlace, form))
    expect(writer.take().toString('hex').toUpperCase()).toBe(hex)
  })

  const addressOf = (text: string, form: 'basic' | 'extended') => jwAddressOf(placeOf(text) as JwFilePlace, form)

  test.each([
    ['004033', { file: 0, address: 0x103 }, { file: 0, address: 0x103, extended: true }],
    ['09000', { file: 0, address: 0x800 }, { file: 0, address: 0x800, extended: true }],
    ['F1:00177777', { file: 1, address: 0xffff }, { file: 1, address: 0xffff, extended: true }],
    ['F1:00200000', { file: 2, address: 0 }, { file: 1, address: 0x10000, extended: true }],
    ['F1:37777774', { file: 0x80, address: 0xfffc }, { file: 1, address: 0x7ffffc, extended: true }],
    ['F2:012345', { file: 2, address: 0x14e5 }, { file: 1, address: 0x114e5, extended: true }],
    ['F80:177777', { file: 0x80, address: 0xffff }, { file: 1, address: 0x7fffff, extended: true }],
  ] as const)('of %s', (text, basic, extended) => {
    expect(addressOf(text, 'basic')).toEqual(basic)
    expect(addressOf(text, 'extended')).toEqual(extended)
  })
})
