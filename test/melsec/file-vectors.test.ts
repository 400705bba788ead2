// The file examples of the manual, in both directions.
import { describe, expect, test } from '@jest/globals'
import {
  type Context,
  type DataCode,
  decode,
  encode,
  measure,
  readerOf,
  type Shape,
  writerOf,
} from '../../src/codec/codec'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import { codecBits, subcommandOf } from '../../src/melsec/device/form'
import { directoryPath, fileName, fileNumber } from '../../src/melsec/file/codec'
import { profiles } from '../../src/melsec/profiles/profiles'
import { bytesOf, type Message, plain, vectorsOf, vectorsOfKind } from '../vectors/vectors'

const HEAD = { binary: 4, ascii: 8 } as const

function commandOf(name: string) {
  const command = commands[name as CommandName]
  if (command === undefined) throw new Error(`No command ${name} is declared`)
  return command
}

function written(shape: Shape, message: Message, code: DataCode, bits: number, context?: Context): Buffer {
  const writer = writerOf(code, bits)
  encode<Shape>(shape, message, writer, context)
  return writer.take()
}

describe('requests', () => {
  test.each(vectorsOfKind('files', 'requestData'))('$id', (vector) => {
    const { code, message, subcommand = 0 } = vector
    const command = commandOf(vector.command)
    const bits = codecBits(command, 'short', subcommand)
    const writer = writerOf(code)
    writer.uint(command.code, 2)
    writer.uint(subcommandOf(command, 'short', profiles.generic, subcommand), 2)
    const bytes = bytesOf(vector)
    expect(Buffer.concat([writer.take(), written(command.request, message, code, bits)]).toString('hex')).toBe(
      vector.hex,
    )
    const data = bytes.subarray(HEAD[code])
    const reader = readerOf(code, data, bits)
    expect(plain(decode<Shape>(command.request, reader))).toEqual(message)
    reader.end()
    expect(measure(command.request, { ascii: code === 'ascii', form: bits, message })).toBe(data.length)
    const short = readerOf(code, data.subarray(0, -1), bits)
    expect(() => decode<Shape>(command.request, short)).toThrow(/more byte/)
  })

  test.each(vectorsOfKind('files', 'requestData'))('$id is sent by a family that has the subcommand', (vector) => {
    const family = vector.subcommand === 0x40 ? profiles['iq-r'] : profiles.q
    expect(subcommandOf(commandOf(vector.command), 'short', family)).toBe(vector.subcommand)
  })
})

describe('answers', () => {
  test.each(vectorsOfKind('files', 'responseData'))('$id', (vector) => {
    const { code, subcommand = 0, message, request: asked } = vector
    const command = commandOf(vector.command)
    const bits = codecBits(command, 'short', subcommand)
    const context = { shape: command.request, message: asked }
    expect(written(command.response, message, code, bits, context).toString('hex')).toBe(vector.hex)
    const reader = readerOf(code, bytesOf(vector), bits)
    expect(plain(decode<Shape>(command.response, reader, context))).toEqual(message)
    reader.end()
  })

  test.each(vectorsOfKind('files', 'fileEntry'))('$id', ({ code, subcommand, entry, hex }) => {
    const { item } = commands.readDirectory.response.files
    expect(written(item, entry, code, subcommand).toString('hex')).toBe(hex)
    const reader = readerOf(code, Buffer.from(hex, 'hex'), subcommand)
    expect(plain(decode<Shape>(item, reader))).toEqual(entry)
    reader.end()
  })
})

describe('values', () => {
  const codecs = { fileName, directoryPath, fileNumber }

  test.each(vectorsOfKind('files', 'fileValue'))('$id', ({ codec, code, subcommand, value, counted, hex }) => {
    const shape = { value: { kind: 'value', codec: codecs[codec] } } as const
    const bytes = written(shape, { value }, code, subcommand)
    const at = counted === false ? { ascii: 4, binary: 2 }[code] : 0
    expect(bytes.subarray(at).toString('hex')).toBe(hex)
    expect(decode<Shape>(shape, readerOf(code, bytes, subcommand))).toEqual({ value })
  })
})

describe('fields', () => {
  const vectors = vectorsOfKind('files', 'field')
  /** Fields that no message holds: in front of the data, lengths, and half of a date. */
  const ALONE = ['command', 'subcommand', 'pathLength', 'time']
  const BYTES = { u8: 1, u16: 2, u32: 4 }

  test.each(vectors)('$id', ({ code, fields, hex }) => {
    const writer = writerOf(code)
    for (const { value, width } of fields) writer.uint(value, width)
    expect(writer.take().toString('hex')).toBe(hex)
  })

  test.each(vectors)('$id are fields of the declaration, as wide', ({ command = '', fields }) => {
    const { request, response } = commandOf(command)
    const shapes: Shape = { ...request, ...response }
    for (const { name, width } of fields) {
      if (ALONE.includes(name)) continue
      const field = shapes[name]
      const found = field?.kind === 'count' ? field.width : BYTES[(field?.kind ?? '') as keyof typeof BYTES]
      expect(`${name} ${found}`).toBe(`${name} ${width}`)
    }
  })

  test('the time is the half of a date', () => {
    const date = { year: 2010, month: 4, day: 1, hour: 20, minute: 50, second: 58 }
    const { date: changed } = commands.changeFileDate.request
    for (const { code, hex } of vectors.filter(({ fields }) => fields[0]?.name === 'time')) {
      expect(written({ changed }, { changed: date }, code, 0).toString('hex').endsWith(hex)).toBe(true)
    }
  })
})

test('every kind of vector is read here', () => {
  const kinds = new Set(vectorsOf('files').map(({ kind }) => kind))
  expect([...kinds].sort()).toEqual(['field', 'fileEntry', 'fileValue', 'requestData', 'responseData'])
})
