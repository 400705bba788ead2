// The two pairs of cursors: numbers, the bulk kinds, and what they refuse. The layouts of the manuals are in the vectors.
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import {
  BinaryWriter,
  putUint,
  readerOf,
  sumOf,
  uintAt,
  type Width,
  type Writer,
  writerOf,
} from '../../src/codec/codec'
import { ProtocolError, RequestError } from '../../src/errors'

const codes = ['binary', 'ascii'] as const
const widths = [1, 2, 3, 4] as const

/** A number and a width that can hold it. */
const numbers = fc
  .constantFrom(...widths)
  .chain((width) => fc.tuple(fc.constant<Width>(width), fc.integer({ min: 0, max: 2 ** (8 * width) - 1 })))

describe.each(codes)('%s', (code) => {
  const ascii = code === 'ascii'
  const write = (run: (writer: Writer) => void) => {
    const writer = writerOf(code)
    run(writer)
    return writer.take()
  }

  test('numbers of every width, low byte first or high digit first', () => {
    fc.assert(
      fc.property(numbers, ([width, number]) => {
        const bytes = write((writer) => writer.uint(number, width))
        const digits = number.toString(16).padStart(2 * width, '0')
        const expected = ascii ? Buffer.from(digits.toUpperCase()) : Buffer.from(digits, 'hex').reverse()
        expect(bytes).toEqual(expected)
        expect(readerOf(code, bytes).uint(width)).toBe(number)
        const frame = Buffer.alloc(bytes.length + 2, 0xff)
        expect(putUint(frame, 1, number, width, ascii)).toBe(bytes.length + 1)
        expect(frame.subarray(1, -1)).toEqual(bytes)
        expect(uintAt(frame, 1, width, ascii)).toBe(number)
      }),
    )
  })

  test('the bulk kinds are what their elements are one by one', () => {
    fc.assert(
      fc.property(
        fc.array(fc.nat(0xffff)),
        fc.array(fc.nat(0xffffffff)),
        fc.array(fc.nat(0xff)),
        (words, doubles, bytes) => {
          const bulk = write((writer) => {
            writer.words(words)
            writer.doubleWords(doubles)
            writer.bytes(bytes)
          })
          const single = write((writer) => {
            for (const word of words) writer.uint(word, 2)
            for (const double of doubles) writer.uint(double, 4)
            for (const byte of bytes) writer.uint(byte, 1)
          })
          expect(bulk).toEqual(single)
          const reader = readerOf(code, bulk)
          expect(reader.words(words.length)).toEqual(words)
          expect(reader.doubleWords(doubles.length)).toEqual(doubles)
          expect([...reader.bytes(bytes.length)]).toEqual(bytes)
          expect([reader.position, reader.remaining]).toEqual([bulk.length, 0])
          reader.end()
        },
      ),
    )
  })

  test('bits: a nibble each, the first one high, or a character each', () => {
    expect(write((writer) => writer.bits([true, false, true])).toString('latin1')).toBe(ascii ? '101' : '\x10\x10')
    fc.assert(
      fc.property(fc.array(fc.boolean()), (bits) => {
        const bytes = write((writer) => writer.bits(bits))
        expect(bytes.length).toBe(ascii ? bits.length : Math.ceil(bits.length / 2))
        expect(readerOf(code, bytes).bits(bits.length)).toEqual(bits)
      }),
    )
  })

  test('text is the same bytes in both codes', () => {
    expect(write((writer) => writer.text('A\u00e9\u0000')).toString('hex')).toBe('41e900')
    expect(readerOf(code, Buffer.from('41e900', 'hex')).text(3)).toBe('A\u00e9\u0000')
    expect(() => write((writer) => writer.text('\u3042'))).toThrow(RequestError)
  })

  test.each<[string, (writer: Writer) => void]>([
    ['a word of 17 bits', (writer) => writer.words([65_536])],
    ['a negative word', (writer) => writer.words([-1])],
    ['half a word', (writer) => writer.words([0.5])],
    ['a double word of 33 bits', (writer) => writer.doubleWords([2 ** 32])],
    ['a negative double word', (writer) => writer.doubleWords([-1])],
    ['NaN', (writer) => writer.doubleWords([Number.NaN])],
    ['a byte of 9 bits', (writer) => writer.bytes([256])],
    ['an infinite byte', (writer) => writer.bytes([Number.POSITIVE_INFINITY])],
  ])('refuses %s', (_what, run) => {
    expect(() => write(run)).toThrow(expect.objectContaining({ name: 'RequestError', code: 'BAD_MESSAGE' }))
  })

  test('a count that is not there costs no memory', () => {
    const before = process.memoryUsage().heapUsed
    for (const read of ['words', 'doubleWords', 'bits', 'bytes', 'text'] as const) {
      expect(() => readerOf(code, Buffer.alloc(8, 0x30))[read](100_000_000)).toThrow(
        expect.objectContaining({ code: 'TRUNCATED', offset: 0 }),
      )
    }
    expect(process.memoryUsage().heapUsed - before).toBeLessThan(20_000_000)
  })

  test('what is left over is told', () => {
    const reader = readerOf(code, Buffer.alloc(9, 0x30))
    reader.uint(1)
    const at = ascii ? 2 : 1
    expect(() => reader.end()).toThrow(expect.objectContaining({ code: 'TRAILING', offset: at }))
    expect(() => reader.end()).toThrow(ProtocolError)
  })
})

test('of many words in ASCII code the first digit that is none is found, wherever it stands', () => {
  const digits = '0123456789ABCDEF'.repeat(3).slice(0, 4 * 11)
  for (let at = 0; at < digits.length; at++) {
    const characters = Buffer.from(`${digits.slice(0, at)}G${digits.slice(at + 1, -1)}g`)
    const read = () => readerOf('ascii', characters).words(11)
    expect(read).toThrow(expect.objectContaining({ code: 'BAD_DIGIT', offset: at }))
  }
})

test('a writer grows, and is empty after take and clear', () => {
  const writer = new BinaryWriter()
  const values = Array.from({ length: 1000 }, (_, i) => i)
  writer.uint(7, 1)
  writer.words(values)
  const taken = writer.take()
  expect([taken.length, taken[0], taken.readUInt16LE(1999)]).toEqual([2001, 7, 999])
  expect(writer.take()).toHaveLength(0)
  writer.uint(1, 1)
  writer.clear()
  writer.uint(2, 1)
  expect(writer.take().toString('hex')).toBe('02')
  // What was taken is not overwritten by what comes next.
  expect(taken[0]).toBe(7)
})

test('the sum check is the low byte of the sum', () => {
  expect(sumOf(Buffer.from('00FFBRA0M000105', 'latin1'))).toBe(
    [...'00FFBRA0M000105'].reduce((sum, c) => sum + c.charCodeAt(0), 0) & 0xff,
  )
  expect(sumOf(Buffer.of(1, 0xff, 0xff, 9), 1, 3)).toBe(0xfe)
})
