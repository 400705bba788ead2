// Kinds of fields that frames without a length have: what tells where a message ends, and answers that repeat a list.
import { describe, expect, test } from '@jest/globals'
import { annotate, hasSecret, MASK } from '../../src/codec/annotate'
import {
  type Context,
  decode,
  encode,
  exampleOf,
  field,
  type Message,
  measure,
  readerOf,
  type Shape,
  saysItsLength,
  takesOf,
  writerOf,
} from '../../src/codec/codec'
import { ProtocolError, RequestError } from '../../src/errors'

const { bytes, countOf, each, echo, fixedInForm, list, repeat, rest, text, u16, u8 } = field

function written(shape: Shape, message: Message, context?: Context, form = 0): string {
  const writer = writerOf('binary', form)
  encode(shape, message, writer, context)
  return writer.take().toString('hex')
}

function readAs(shape: Shape, hex: string, context?: Context, form = 0): Message {
  const reader = readerOf('binary', Buffer.from(hex, 'hex'), form)
  const message = decode(shape, reader, context)
  reader.end()
  return message
}

describe('a byte of two decimal digits', () => {
  const shape = { minute: u8({ bcd: true, max: 59 }), year: u16({ bcd: true }) }

  test('is written and read as its digits', () => {
    expect(written(shape, { minute: 59, year: 1999 })).toBe('599919')
    expect(readAs(shape, '599919')).toEqual({ minute: 59, year: 1999 })
    expect(written(shape, { minute: 0, year: 7 })).toBe('000700')
  })

  test.each([60, -1, 1.5])('refuses %d', (minute) => {
    expect(() => written(shape, { minute, year: 0 })).toThrow(RequestError)
  })

  test('holds as many digits as it has halves', () => {
    expect(() => written(shape, { minute: 0, year: 10_000 })).toThrow('must be 0 to 9999')
    expect(takesOf(shape, 'year')).toBe('a whole number from 0 to 9999')
  })

  test.each(['5a0000', 'a50000', '600000', '000a00'])('reads no %s', (hex) => {
    expect(() => readAs(shape, hex)).toThrow(ProtocolError)
  })
})

describe('a secret of letters and digits', () => {
  const shape = { password: text(4, { charset: 'alphanumeric', secret: true }) }

  test('takes no other character, and does not say which was given', () => {
    expect(written(shape, { password: 'aZ09' })).toBe('615a3039')
    expect(() => written(shape, { password: 'AB-2' })).toThrow(
      'password: may hold only the characters 0-9, A-Z and a-z',
    )
    expect(() => written(shape, { password: 'AB-2' })).not.toThrow('AB-2')
    expect(() => readAs(shape, '41422d32')).toThrow('a character other than 0-9, A-Z and a-z')
  })

  test('is not shown', () => {
    expect(hasSecret(shape)).toBe(true)
    const [row] = annotate(shape, Buffer.from('AB12'), { code: 'binary' }).rows
    expect(row).toMatchObject({ value: MASK, bytes: '** ** ** **', text: MASK, secret: true })
  })
})

describe('bytes up to the end of the message', () => {
  const request = { data: rest({ min: 1, max: 4 }) }
  const response = { data: echo('data') }

  test('are all there are', () => {
    expect(written(request, { data: [1, 2] })).toBe('0102')
    expect(readAs(request, '0102')).toEqual({ data: Buffer.of(1, 2) })
    expect(exampleOf(request, () => undefined)).toEqual({ data: '00' })
    expect(takesOf(request, 'data')).toContain('1 to 4 elements')
  })

  test.each([[[]], [[1, 2, 3, 4, 5]], ['1']])('refuses %j', (data) => {
    expect(() => written(request, { data })).toThrow(RequestError)
  })

  test('take no more than may be, and wait for the first', () => {
    expect(() => readAs(request, '')).toThrow(expect.objectContaining({ code: 'TRUNCATED' }))
    expect(() => readAs(request, '0102030405')).toThrow(expect.objectContaining({ code: 'TRAILING' }))
  })

  test('are repeated by the answer, whose length is theirs', () => {
    const context = { shape: request, message: { data: Buffer.of(1, 2, 3) } }
    expect(written(response, {}, context)).toBe('010203')
    expect(measure(response, { ascii: false, form: 0, context })).toBe(3)
    expect(readAs(response, '010203', context)).toEqual({})
    for (const hex of ['010204', '0102', '01020304'])
      expect(() => readAs(response, hex, context)).toThrow(expect.objectContaining({ code: 'ECHO_MISMATCH' }))
  })

  test('are two characters each in ASCII code', () => {
    const writer = writerOf('ascii')
    encode(request, { data: Uint8Array.of(1, 0xab) }, writer)
    const characters = writer.take()
    expect(characters.toString('latin1')).toBe('01AB')
    expect(decode(request, readerOf('ascii', characters))).toEqual({ data: Buffer.of(1, 0xab) })
  })
})

describe('an answer that repeats the list of the request', () => {
  const ONCE = 0
  const EACH = 1
  const request = {
    count: countOf('items', 1),
    marker: fixedInForm(0xff, 1, ONCE),
    items: list('count', { marker: fixedInForm(0xff, 1, EACH), place: u16(), bit: u8({ max: 7 }) }),
  }
  const repeated = { marker: fixedInForm(0xff, 1, EACH), place: echo('place'), bit: echo('bit') }
  const withValues = {
    count: echo('count'),
    marker: fixedInForm(0xff, 1, ONCE),
    values: each('items', u8({ max: 1 }), repeated),
  }
  const without = { count: echo('count'), marker: fixedInForm(0xff, 1, ONCE), items: repeat('items', repeated) }
  const message = {
    items: [
      { place: 0x1234, bit: 3 },
      { place: 5, bit: 7 },
    ],
  }
  const context = { shape: request, message }
  const known = (form: number) => ({ ascii: false, form, context })

  test.each([
    [ONCE, '02ff341203050007', '02ff3412030105000700', '02ff341203050007'],
    [EACH, '02ff341203ff050007', '02ff34120301ff05000700', '02ff341203ff050007'],
  ])('in form %d', (form, asked, answered, repeatedOnly) => {
    expect(written(request, message, undefined, form)).toBe(asked)
    expect(readAs(request, asked, undefined, form)).toEqual(message)
    expect(written(withValues, { values: [1, 0] }, context, form)).toBe(answered)
    expect(readAs(withValues, answered, context, form)).toEqual({ values: [1, 0] })
    expect(measure(withValues, known(form))).toBe(answered.length / 2)
    expect(written(without, {}, context, form)).toBe(repeatedOnly)
    expect(readAs(without, repeatedOnly, context, form)).toEqual({})
    expect(measure(without, known(form))).toBe(repeatedOnly.length / 2)
  })

  test('every repeated byte is checked, and named', () => {
    const right = Buffer.from('02ff3412030105000700', 'hex')
    const wrong = right.map((byte, i) => (i === 7 ? byte ^ 1 : byte))
    expect(() => readAs(withValues, Buffer.from(wrong).toString('hex'), context)).toThrow(
      expect.objectContaining({ code: 'ECHO_MISMATCH', field: 'values.1.place' }),
    )
    for (let i = 0; i < right.length; i++) {
      if (i === 5 || i === 9) continue
      const damaged = Buffer.from(right)
      damaged[i] = (damaged[i] as number) ^ 1
      expect(() => readAs(withValues, damaged.toString('hex'), context)).toThrow(ProtocolError)
    }
  })

  test('as many values as elements were asked', () => {
    expect(() => written(withValues, { values: [1] }, context)).toThrow(
      "values: has 1 element(s), the request's items has 2",
    )
  })

  test('is explained with the element in front of its value', () => {
    const { rows, fault } = annotate(withValues, Buffer.from('02ff3412030105000700', 'hex'), {
      code: 'binary',
      context,
    })
    expect(fault).toBeUndefined()
    expect(rows.map(({ name, value }) => [name, value])).toEqual([
      ['count', 2],
      ['marker', 0xff],
      ['values.0.place', 0x1234],
      ['values.0.bit', 3],
      ['values.0', 1],
      ['values.1.place', 5],
      ['values.1.bit', 7],
      ['values.1', 0],
    ])
  })
})

test('an answer has no more than the request wants', () => {
  const response = { arrived: countOf('data', 1, { atMost: 'length' }), data: bytes('arrived') }
  const context = { shape: { length: u8() }, message: { length: 2 } }
  expect(written(response, { data: [1, 2] }, context)).toBe('020102')
  expect(readAs(response, '0101', context)).toEqual({ data: Buffer.of(1) })
  expect(() => written(response, { data: [1, 2, 3] }, context)).toThrow('the request wants no more than 2')
  expect(() => readAs(response, '03010203', context)).toThrow('3 data, asked were no more than 2')
})

test('an answer that says its length is told from one whose length the request says', () => {
  const request = { length: u16() }
  const own = { arrived: countOf('data', 2), more: u8(), data: bytes('arrived') }
  expect(saysItsLength(own, request)).toBe(true)
  expect(saysItsLength({ length: echo('length'), data: bytes('length') }, request)).toBe(false)
  expect(saysItsLength({ more: u8() }, request)).toBe(false)
})
