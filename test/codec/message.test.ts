// Messages that do not fit their declaration are refused with the path of the field, before anything is sent.
import { describe, expect, test } from '@jest/globals'
import {
  type Context,
  type DataCode,
  decode,
  encode,
  field,
  readerOf,
  type Shape,
  writerOf,
} from '../../src/codec/codec'
import { ProtocolError, RequestError } from '../../src/errors'
import { jwCommands } from '../../src/jw/commands/commands'
import { commands } from '../../src/melsec/commands/commands'

const { bits, bytes, countOf, doubleWords, each, echo, fieldAt, fixed, list, text, u16, u32, u8, words } = field
const codes = ['binary', 'ascii'] as const

/** Without the types of the declaration, as a program without types calls it. */
function write(shape: Shape, message: unknown, code: DataCode = 'binary', context?: Context): Buffer {
  const writer = writerOf(code)
  encode<Shape>(shape, message as Record<string, never>, writer, context)
  return writer.take()
}

function refusal(shape: Shape, message: unknown, code: DataCode = 'binary', context?: Context): RequestError {
  try {
    write(shape, message, code, context)
  } catch (error) {
    if (error instanceof RequestError) return error
    throw error
  }
  throw new Error('it was not refused')
}

const D0 = { device: 'D', number: 0 }
const unprintable = Object.create(null) as object

describe.each(codes)('a message that does not fit is refused with the path of the field, %s', (code) => {
  const { readWords, writeWords, writeBits, readRandom, writeRandomBits, writeRandomWords, writeBlock } = commands
  const cases: readonly [what: string, shape: Shape, message: unknown, path: string | undefined, says: string][] = [
    ['nothing at all', readWords.request, undefined, undefined, 'must be an object with head, points'],
    ['null', readWords.request, null, undefined, 'must be an object'],
    ['an array', readWords.request, [], undefined, 'is an array'],
    ['a missing number', readWords.request, { head: D0 }, 'points', 'must be a whole number, is missing'],
    ['null for a number', readWords.request, { head: D0, points: null }, 'points', 'must be a whole number'],
    ['a text for a number', readWords.request, { head: D0, points: '3' }, 'points', 'must be a whole number, is "3"'],
    ['a fraction', readWords.request, { head: D0, points: 1.5 }, 'points', 'is 1.5'],
    ['NaN', readWords.request, { head: D0, points: Number.NaN }, 'points', 'is NaN'],
    ['BigInt', readWords.request, { head: D0, points: 1n }, 'points', 'must be a whole number'],
    ['what cannot be shown', readWords.request, { head: D0, points: unprintable }, 'points', 'is an object'],
    ['too few', readWords.request, { head: D0, points: 0 }, 'points', 'is 0, must be 1 to 65535'],
    ['too many for the width', readWords.request, { head: D0, points: 65536 }, 'points', 'must be 1 to 65535'],
    ['a missing device', readWords.request, { points: 1 }, 'head', 'is missing'],
    ['null for a device', readWords.request, { head: null, points: 1 }, 'head', 'is missing'],
    ['a misspelt field', readWords.request, { head: D0, points: 1, point: 2 }, 'point', 'it has head, points'],
    ['a misspelt option', commands.remoteRun.request, { mode: 1, clearmode: 2 }, 'clearmode', 'it has mode, clearMode'],
    ['a field that is derived', writeWords.request, { head: D0, points: 2, values: [1] }, 'points', 'by itself'],
    ['a field of the message without fields', commands.clearError.request, { mode: 1 }, 'mode', 'it has no fields'],
    ['a number that is not in the list', commands.remotePause.request, { mode: 2 }, 'mode', 'must be one of 1, 3'],
    ['null for an option', commands.remoteRun.request, { mode: 1, clearMode: null }, 'clearMode', 'whole number'],
    ['missing values', writeWords.request, { head: D0 }, 'points', 'values is missing'],
    ['no values', writeWords.request, { head: D0, values: [] }, 'points', 'values has 0 element(s), must have 1 to'],
    ['a text for values', writeWords.request, { head: D0, values: '12' }, 'values', 'must be an array, is "12"'],
    [
      'a view without elements',
      writeWords.request,
      { head: D0, values: new DataView(new ArrayBuffer(2)) },
      'points',
      '',
    ],
    ['a negative word', writeWords.request, { head: D0, values: [1, -1] }, 'values', 'element 1 is -1'],
    ['a wide word', writeWords.request, { head: D0, values: [65536] }, 'values', 'a word is 0 to 65535'],
    ['a hole', writeWords.request, { head: D0, values: new Array(2) }, 'values', 'element 0 is a undefined'],
    ['a BigInt word', writeWords.request, { head: D0, values: [1n] }, 'values', 'element 0 is a bigint'],
    ['BigInt words', writeWords.request, { head: D0, values: new BigInt64Array(1) }, 'values', 'a bigint'],
    ['an object for a word', writeWords.request, { head: D0, values: [unprintable] }, 'values', 'a object'],
    [
      'a number for a bit',
      writeBits.request,
      { head: D0, values: [true, 1] },
      'values',
      'element 1 is 1, must be true',
    ],
    ['a hole in a list', readRandom.request, { words: new Array(1), doubleWords: [] }, 'words.0', 'must be an object'],
    ['a missing list', readRandom.request, { words: [] }, 'doubleWordPoints', 'doubleWords is missing'],
    [
      'a wrong device in a list',
      readRandom.request,
      { words: [{ device: D0 }, { device: { device: 'QQ', number: 0 } }], doubleWords: [] },
      'words.1.device',
      'There is no device "QQ"',
    ],
    [
      'more than the count can say',
      readRandom.request,
      { words: Array.from({ length: 256 }, () => ({ device: D0 })), doubleWords: [] },
      'wordPoints',
      'words has 256 element(s), must have 0 to 255',
    ],
    [
      'a wrong value in a list',
      writeRandomWords.request,
      { words: [], doubleWords: [{ device: D0, value: 2 ** 32 }] },
      'doubleWords.0.value',
      'must be 0 to 4294967295',
    ],
    [
      'a misspelt field in a list',
      writeRandomWords.request,
      { words: [{ device: D0, value: 1, type: 'INT' }], doubleWords: [] },
      'words.0.type',
      'it has device, value',
    ],
    [
      'a number for set and reset',
      writeRandomBits.request,
      { bits: [{ device: { device: 'M', number: 0 }, value: 1 }] },
      'bits.0.value',
      'must be true or false',
    ],
    [
      'a value inside a block',
      writeBlock.request,
      { wordBlocks: [{ head: D0, values: [0, 70000] }], bitBlocks: [] },
      'wordBlocks.0.values',
      'element 1 is 70000',
    ],
    [
      'an odd number of bytes',
      commands.readExtendUnit.request,
      { address: 0, byteCount: 3, moduleNumber: 0 },
      'byteCount',
      'is 3, must be a multiple of 2',
    ],
    [
      'an odd number of data',
      commands.writeExtendUnit.request,
      { address: 0, moduleNumber: 0, data: [1, 2, 3] },
      'byteCount',
      'data has 3 element(s), must have a multiple of 2',
    ],
    ['a character that is no digit', commands.selfTest.request, { data: '0g' }, 'data', 'only the characters 0-9'],
    ['a number for a text', commands.selfTest.request, { data: 12 }, 'count', 'data is missing'],
  ]
  test.each(cases)('%s', (_what, shape, message, path, says) => {
    const error = refusal(shape, message, code)
    expect([error.field, error.outcome]).toEqual([path, 'notSent'])
    expect(error.message).toContain(path === undefined ? says : `${path}: `)
    expect(error.message).toContain(says)
  })
})

describe('what is left out', () => {
  test('takes its default; explicitly undefined is left out too', () => {
    const { request } = commands.remoteRun
    expect(write(request, { mode: 1 }).toString('hex')).toBe('01000000')
    expect(write(request, { mode: 1, clearMode: undefined, other: undefined }).toString('hex')).toBe('01000000')
    expect(write(request, { mode: 3, clearMode: 2 }).toString('hex')).toBe('03000200')
  })

  test('typed arrays are arrays', () => {
    const head = { device: 'D', number: 0 }
    const plain = write(commands.writeWords.request, { head, values: [1, 0xffff] })
    expect(write(commands.writeWords.request, { head, values: Uint16Array.of(1, 0xffff) })).toEqual(plain)
    const address = { file: 0, address: 0 }
    const data = write(jwCommands.writeDataMemory.request, { head: address, data: [1, 2] })
    expect(write(jwCommands.writeDataMemory.request, { head: address, data: Uint8Array.of(1, 2) })).toEqual(data)
  })
})

describe('an answer is held against its request', () => {
  const random = (wordCount: number): Context => ({
    shape: commands.readRandom.request,
    message: { words: Array.from({ length: wordCount }, () => ({ device: D0 })), doubleWords: [] },
  })

  test('the PLC side cannot answer another number of values than was asked for', () => {
    const { response } = commands.readRandom
    expect(write(response, { words: [1, 2], doubleWords: [] }, 'binary', random(2)).toString('hex')).toBe('01000200')
    const error = refusal(response, { words: [1, 2, 3], doubleWords: [] }, 'binary', random(2))
    expect([error.field, error.message]).toEqual(['words', 'words: has 3 element(s), must have 2'])
  })

  test('nor another number of blocks, nor longer ones', () => {
    const { response } = commands.readBlock
    const block = (points: number) => ({ head: D0, points })
    const context = {
      shape: commands.readBlock.request,
      message: { wordBlocks: [block(1), block(2)], bitBlocks: [] },
    }
    const refused = (wordBlocks: unknown) => refusal(response, { wordBlocks, bitBlocks: [] }, 'binary', context)
    expect(refused([[1]]).message).toBe("wordBlocks: has 1 element(s), the request's wordBlocks has 2")
    expect(refused([[1], [2]]).message).toBe('wordBlocks.1: has 1 element(s), must have 2')
    expect(refused(undefined).message).toBe('wordBlocks: must be an array, is missing')
  })

  test('a list whose length is given elsewhere must have that length', () => {
    const shape = { points: u16(), entries: list('points', { value: u8() }), pair: list(2, { value: u8() }) }
    const message = { points: 1, entries: [{ value: 1 }], pair: [{ value: 2 }, { value: 3 }] }
    expect(write(shape, message).toString('hex')).toBe('0100010203')
    expect(refusal(shape, { ...message, points: 2 }).message).toBe('entries: has 1 element(s), must have 2')
    expect(refusal(shape, { ...message, pair: [] }).message).toBe('pair: has 0 element(s), must have 2')
  })

  test('an echo of a field that was left at its default', () => {
    const request = { mode: u16({ default: 7 }), head: u8() }
    const response = { mode: echo('mode'), head: echo('head') }
    const context = { shape: request, message: { head: 0 } }
    const answer = write(response, {}, 'binary', context)
    expect(answer.toString('hex')).toBe('070000')
    expect(decode(response, readerOf('binary', answer), context)).toEqual({})
    // -0 is a 0 on the wire.
    const negative = { shape: request, message: { mode: 7, head: -0 } }
    expect(decode(response, readerOf('binary', answer), negative)).toEqual({})
    expect(() => decode(response, readerOf('binary', Buffer.from('080000', 'hex')), context)).toThrow(
      expect.objectContaining({ code: 'ECHO_MISMATCH', offset: 2 }),
    )
  })

  test('without its request an answer is neither written nor read: a mistake of the program', () => {
    const { response } = commands.readWords
    expect(() => decode(response, readerOf('binary', Buffer.alloc(2)))).toThrow(TypeError)
    const echoing = { head: echo('head') }
    expect(() => write(echoing, {})).toThrow(TypeError)
    expect(() => decode({ parts: each('blocks', words('points')) }, readerOf('binary', Buffer.alloc(0)))).toThrow(
      TypeError,
    )
  })
})

describe('reading refuses', () => {
  const read = (shape: Shape, hex: string) => {
    const reader = readerOf('binary', Buffer.from(hex, 'hex'))
    const message = decode(shape, reader)
    reader.end()
    return message
  }
  test.each<[string, Shape, string, string, number]>([
    ['a byte too few', { a: u16() }, '01', 'TRUNCATED', 0],
    ['a byte too many', { a: u8() }, '0102', 'TRAILING', 1],
    ['a number out of its range', { a: u8({ max: 3 }) }, '04', 'BAD_FIELD', 1],
    ['a number that is not in the list', { a: u8({ oneOf: [1, 3] }) }, '02', 'BAD_FIELD', 1],
    ['a number that is no multiple', { a: u8({ multipleOf: 2 }) }, '03', 'BAD_FIELD', 1],
    [
      'a count that is no multiple',
      { n: countOf('a', 1, { multipleOf: 2 }), a: bytes('n') },
      '03010203',
      'BAD_FIELD',
      1,
    ],
    ['another fixed number', { a: fixed(5, 1) }, '06', 'BAD_FIELD', 1],
    ['a count out of its range', { n: countOf('a', 1, { min: 1 }), a: words('n') }, '00', 'BAD_FIELD', 1],
    ['a count with too little behind it', { n: countOf('a', 2), a: words('n') }, 'ffff0000', 'TRUNCATED', 2],
    [
      'a list with too little behind it',
      { n: countOf('a', 1), a: list('n', { b: u32() }) },
      '0201000000',
      'TRUNCATED',
      5,
    ],
    ['a bit that is neither 0 nor 1', { a: bits(2) }, '12', 'BAD_FIELD', 0],
    ['a last nibble that is not empty', { a: bits(1) }, '11', 'BAD_FIELD', 0],
    ['characters outside the set', { a: text(2, { charset: 'hexDigits' }) }, '3067', 'BAD_FIELD', 2],
  ])('%s', (_what, shape, hex, code, offset) => {
    expect(() => read(shape, hex)).toThrow(ProtocolError)
    expect(() => read(shape, hex)).toThrow(expect.objectContaining({ code, offset }))
  })

  test.each<[string, Shape, string, string]>([
    ['a letter behind F', { a: u8() }, '0g', 'BAD_DIGIT'],
    ['a space in a word', { a: words(2) }, '0000 000', 'BAD_DIGIT'],
    ['a bit that is no digit', { a: bits(2) }, '02', 'BAD_FIELD'],
    ['a byte with one digit', { a: bytes(2) }, '001', 'TRUNCATED'],
    ['double words that are not there', { n: countOf('a', 4), a: doubleWords('n') }, 'FFFFFFFF0', 'TRUNCATED'],
  ])('in ASCII code %s', (_what, shape, characters, code) => {
    expect(() => decode(shape, readerOf('ascii', Buffer.from(characters)))).toThrow(expect.objectContaining({ code }))
  })

  const readBlock = {
    shape: commands.readBlock.request,
    message: { wordBlocks: [{ head: D0, points: 1 }], bitBlocks: [] },
  }
  const points = { shape: { points: u8() }, message: { points: 1 } }
  test.each<[string, Shape, string, string | undefined, Context | undefined]>([
    ['a number', { a: u8(), b: u16() }, '0001', 'b', undefined],
    ['a count', { n: countOf('a', 1, { max: 1 }), a: words('n') }, '02', 'n', undefined],
    ['an array', { n: countOf('a', 1), a: words('n') }, '020100', 'a', undefined],
    ['a fixed number', { a: u8(), b: fixed(5, 1) }, '0006', 'b', undefined],
    [
      'in an element',
      { n: countOf('a', 1), a: list('n', { b: u8(), c: u8({ max: 3 }) }) },
      '0200030004',
      'a.1.c',
      undefined,
    ],
    ['a device that is cut', commands.readRandom.request, '0200640000a86400', 'words.1.device', undefined],
    ['a device nobody knows', commands.readRandom.request, '010064000001', 'words.0.device', undefined],
    ['what belongs to an element of the request', commands.readBlock.response, '01', 'wordBlocks.0', readBlock],
    ['what repeats the request', { a: echo('points') }, '02', 'a', points],
    ['bytes behind the message are in none', { a: u8() }, '0102', undefined, undefined],
  ])('the error names the field: %s', (_what, shape, hex, path, context) => {
    const reader = readerOf('binary', Buffer.from(hex, 'hex'))
    const all = () => {
      decode(shape, reader, context)
      reader.end()
    }
    const place = path === undefined ? ': ' : ` (${path}): `
    expect(all).toThrow(expect.objectContaining({ field: path, message: expect.stringContaining(place) }))
    if (path !== undefined) expect(fieldAt(shape, path)).toBeDefined()
  })

  test('0 where the field is too narrow for its highest number', () => {
    const shape = {
      points: u8({ min: 1, max: 256, zeroMeans: 256 }),
      n: countOf('a', 1, { min: 1, max: 256, zeroMeans: 256 }),
      a: bits('n'),
    }
    const values = new Array<boolean>(256).fill(true)
    const written = write(shape, { points: 256, a: values })
    expect(written.subarray(0, 2).toString('hex')).toBe('0000')
    expect(read(shape, written.toString('hex'))).toEqual({ points: 256, a: values })
    expect(() => read({ points: u8({ min: 1 }) }, '00')).toThrow(ProtocolError)
  })
})
