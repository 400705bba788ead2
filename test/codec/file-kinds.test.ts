// Kinds of fields that came with the file commands: characters that stand for themselves, spare areas, a second way to
// say "none", values that may be left out, and secrets in value codecs.
import { describe, expect, test } from '@jest/globals'
import { annotate, hasSecret, MASK, withoutSecrets } from '../../src/codec/annotate'
import { checkShapes } from '../../src/codec/check'
import {
  type DataCode,
  decode,
  encode,
  field,
  measure,
  readerOf,
  type Shape,
  type ValueCodec,
  writerOf,
} from '../../src/codec/codec'
import { ProtocolError, RequestError } from '../../src/errors'

const codes: readonly DataCode[] = ['binary', 'ascii']

function written(shape: Shape, message: Readonly<Record<string, unknown>>, code: DataCode): Buffer {
  const writer = writerOf(code)
  encode<Shape>(shape, message, writer)
  return writer.take()
}

function read(shape: Shape, bytes: Buffer, code: DataCode): Readonly<Record<string, unknown>> {
  const reader = readerOf(code, bytes)
  const message = decode<Shape>(shape, reader)
  reader.end()
  return message
}

describe('fixed characters', () => {
  const shape = { fixed: field.fixedText('0000', 0x30303030, 4), zero: field.fixedText('0000', 0, 4) }

  test('are themselves in ASCII code, a number in binary code', () => {
    expect(written(shape, {}, 'ascii').toString()).toBe('00000000')
    expect(written(shape, {}, 'binary').toString('hex')).toBe('3030303000000000')
    for (const code of codes) {
      const bytes = written(shape, {}, code)
      expect(read(shape, bytes, code)).toEqual({})
      expect(measure(shape, { ascii: code === 'ascii', form: 0 })).toBe(bytes.length)
    }
  })

  test('are checked', () => {
    expect(() => read(shape, Buffer.from('00100000'), 'ascii')).toThrow(ProtocolError)
    expect(() => read(shape, Buffer.from('3030303100000000', 'hex'), 'binary')).toThrow(ProtocolError)
  })
})

describe('spare areas', () => {
  const shape = { before: field.u8(), spare: field.spare(3), after: field.u8() }

  test('are zeros, are in no message, and hold anything', () => {
    expect(written(shape, { before: 1, after: 2 }, 'binary').toString('hex')).toBe('0100000002')
    expect(written(shape, { before: 1, after: 2 }, 'ascii').toString()).toBe('0100000002')
    expect(read(shape, Buffer.from('01ffeedd02', 'hex'), 'binary')).toEqual({ before: 1, after: 2 })
    expect(read(shape, Buffer.from('01xyz!?.02'), 'ascii')).toEqual({ before: 1, after: 2 })
    expect(() => written(shape, { before: 1, after: 2, spare: 0 }, 'binary')).toThrow(/filled in by itself/)
    for (const code of codes)
      expect(measure(shape, { ascii: code === 'ascii', form: 0 })).toBe(code === 'ascii' ? 10 : 5)
  })

  test('have a row of their own when a message is explained', () => {
    const { rows } = annotate(shape, Buffer.from('01ffeedd02', 'hex'), { code: 'binary' })
    expect(rows.map(({ name, length }) => [name, length])).toEqual([
      ['before', 1],
      ['spare', 3],
      ['after', 1],
    ])
  })

  test('have a size', () => {
    expect(() => checkShapes('x', { spare: field.spare(0) }, {})).toThrow(/has no size/)
  })
})

describe('a number that stands for none too', () => {
  const shape = {
    count: field.countOf('items', 2, { noneToo: 0xffff }),
    items: field.list('count', { item: field.u8() }),
  }

  test('is read as none and never written', () => {
    expect(written(shape, { items: [] }, 'binary').toString('hex')).toBe('0000')
    for (const hex of ['0000', 'ffff']) expect(read(shape, Buffer.from(hex, 'hex'), 'binary')).toEqual({ items: [] })
    const { message, fault } = annotate(shape, Buffer.from('ffff', 'hex'), { code: 'binary' })
    expect([message, fault]).toEqual([{ items: [] }, undefined])
  })
})

describe('values', () => {
  const codec: ValueCodec<string> = {
    name: 'word',
    secret: true,
    write: (writer, value) => writer.text(value),
    read: (reader) => reader.text(2),
    size: () => 2,
  }

  test('may have a default', () => {
    const shape = { word: field.optional(codec, 'no') }
    expect(written(shape, {}, 'binary').toString()).toBe('no')
    expect(written(shape, { word: 'ya' }, 'binary').toString()).toBe('ya')
    expect(measure(shape, { ascii: false, form: 0, message: {} })).toBe(2)
    expect(() => written({ word: field.value(codec) }, {}, 'binary')).toThrow(RequestError)
  })

  test('may be secret', () => {
    const shape = { word: field.value(codec) }
    expect(hasSecret(shape)).toBe(true)
    expect(withoutSecrets(shape, { word: 'pw' })).toEqual({ word: MASK })
    const [row] = annotate(shape, Buffer.from('pw'), { code: 'binary', describe: () => 'pw' }).rows
    expect(row).toMatchObject({ value: MASK, bytes: '** **', text: MASK, secret: true })
  })
})
