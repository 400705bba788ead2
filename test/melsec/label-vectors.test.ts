// The label examples of the manual, in both directions.
import { describe, expect, test } from '@jest/globals'
import { type Context, decode, encode, measure, readerOf, type Shape, writerOf } from '../../src/codec/codec'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import { labelData, labelName, writtenLabelArea } from '../../src/melsec/label/codec'
import { expandLabel, labelDataType } from '../../src/melsec/label/label'
import { bytesOf, vectorsOfKind } from '../vectors/vectors'

const HEAD = { binary: 4, ascii: 8 } as const

function written(
  shape: Shape,
  message: Readonly<Record<string, unknown>>,
  code: 'binary' | 'ascii',
  context?: Context,
) {
  const writer = writerOf(code)
  encode<Shape>(shape, message as Record<string, never>, writer, context)
  return writer.take()
}

describe('requests', () => {
  const vectors = vectorsOfKind('labels', 'requestData')

  test.each(vectors)('$id', ({ command: name, code, message, ...vector }) => {
    const command = commands[name as CommandName]
    const writer = writerOf(code)
    writer.uint(command.code, 2)
    writer.uint(0, 2)
    encode<Shape>(command.request, message, writer)
    const bytes = bytesOf({ command: name, code, message, ...vector })
    expect(writer.take().toString('hex')).toBe(bytes.toString('hex'))
    const reader = readerOf(code, bytes.subarray(HEAD[code]))
    expect(decode<Shape>(command.request, reader)).toEqual(message)
    reader.end()
    expect(measure(command.request, { ascii: code === 'ascii', form: 0, message })).toBe(bytes.length - HEAD[code])
    expect(() => decode<Shape>(command.request, readerOf(code, bytes.subarray(HEAD[code], -1)))).toThrow(/more byte/)
  })
})

describe('answers', () => {
  test.each(vectorsOfKind('labels', 'responseData'))('$id', (vector) => {
    const { request, response } = commands[vector.command as CommandName]
    const context = { shape: request, message: vector.request }
    expect(written(response, vector.message, vector.code, context).toString('hex')).toBe(vector.hex)
    const reader = readerOf(vector.code, bytesOf(vector))
    expect(decode<Shape>(response, reader, context)).toEqual(vector.message)
    reader.end()
  })
})

describe('names', () => {
  test.each(vectorsOfKind('labels', 'labelName'))('$id', ({ name, counted, expanded, code, hex }) => {
    const writer = writerOf(code)
    labelName.write(writer, name)
    const bytes = writer.take()
    expect(bytes.subarray(counted === true ? 0 : code === 'ascii' ? 4 : 2).toString('hex')).toBe(hex)
    expect(labelName.read(readerOf(code, bytes))).toBe(name)
    expect(labelName.size(code === 'ascii', 0, name)).toBe(bytes.length)
    if (expanded !== undefined) expect(expandLabel(name, ['LabelA', 'memberA3'])).toBe(expanded)
  })

  test.each(vectorsOfKind('labels', 'labelAbbreviations'))('$id', ({ names, code, hex }) => {
    const message = { abbreviations: names.map((name) => ({ name })), labels: [{ name: 'A' }] }
    const bytes = written(commands.readRandomLabels.request, message, code)
    const points = code === 'ascii' ? 4 : 2
    expect(bytes.subarray(points, points + hex.length / 2).toString('hex')).toBe(hex)
  })
})

describe('fields', () => {
  const fields = vectorsOfKind('labels', 'field')
  const titled = fields.map((vector) => ({ ...vector, names: vector.fields.map(({ name }) => name).join(' ') }))
  const of = (names: string) => {
    const found = titled.filter((vector) => vector.names === names)
    if (found.length === 0) throw new Error(`no vector of ${names}`)
    return found
  }
  const three = Array.from({ length: 3 }, () => 'A')
  const unit = (code: 'binary' | 'ascii') => (code === 'ascii' ? 2 : 1)

  test.each(of('arrayPoints'))('$id', ({ code, hex }) => {
    const arrays = three.map((name) => ({ name, unit: 1, length: 2 }))
    const bytes = written(commands.readArrayLabels.request, { abbreviations: [], arrays }, code)
    expect(bytes.toString('hex').startsWith(hex)).toBe(true)
  })

  test.each(of('points'))('$id', ({ code, hex }) => {
    const labels = three.map((name) => ({ name }))
    const bytes = written(commands.readRandomLabels.request, { abbreviations: [], labels }, code)
    expect(bytes.toString('hex').startsWith(hex)).toBe(true)
  })

  test.each(of('abbreviationPoints'))('$id', ({ code, hex }) => {
    const abbreviations = three.map((name) => ({ name }))
    const bytes = written(commands.readRandomLabels.request, { abbreviations, labels: [{ name: 'B' }] }, code)
    expect(
      bytes
        .subarray(2 * unit(code))
        .toString('hex')
        .startsWith(hex),
    ).toBe(true)
  })

  test.each(of('nameLength'))('$id', ({ code, hex, fields: [length] }) => {
    const writer = writerOf(code)
    labelName.write(writer, 'n'.repeat(length?.value ?? 0))
    expect(writer.take().toString('hex').startsWith(hex)).toBe(true)
  })

  test.each(of('fixed'))('$id', ({ code, hex }) => {
    const arrays = [{ name: 'A', unit: 1, length: 2 }]
    const bytes = written(commands.readArrayLabels.request, { abbreviations: [], arrays }, code)
    const at = bytes.length - 3 * unit(code)
    expect(bytes.subarray(at, at + unit(code)).toString('hex')).toBe(hex)
  })

  test.each(of('unit fixed length data'))('$id', ({ code, hex, fields: [of, , length, data] }) => {
    const area = { unit: of?.value === 0 ? 0 : 1, length: length?.value ?? -1, words: [data?.value ?? -1] } as const
    const writer = writerOf(code)
    writtenLabelArea.write(writer, area)
    expect(writer.take().toString('hex')).toBe(hex)
    expect(writtenLabelArea.read(readerOf(code, Buffer.from(hex, 'hex')))).toEqual(area)
  })

  test.each([...of('length data'), ...of('length data data data data')])(
    '$id',
    ({ code, hex, fields: [, ...data] }) => {
      // A double word is printed in ASCII code with its high word first; the codec gives the words as they stand.
      const words = data.flatMap(({ value, width }) => {
        const [low, high] = [value & 0xffff, value >>> 16]
        return width === 2 ? [value] : code === 'ascii' ? [high, low] : [low, high]
      })
      const writer = writerOf(code)
      labelData.write(writer, words)
      expect(writer.take().toString('hex')).toBe(hex)
      expect(labelData.read(readerOf(code, Buffer.from(hex, 'hex')))).toEqual(words)
    },
  )

  test.each(of('typeId'))('$id', ({ code, hex, fields: [id] }) => {
    // One label, its data type ID as printed, the undefined byte, two bytes of data.
    const [head, rest] =
      code === 'ascii' ? ['30303031', Buffer.from('FF00020000')] : ['0100', Buffer.from('ff02000000', 'hex')]
    const answer = Buffer.from(`${head}${hex}${rest.toString('hex')}`, 'hex')
    const context = {
      shape: commands.readRandomLabels.request,
      message: { abbreviations: [], labels: [{ name: 'A' }] },
    }
    const { labels } = decode(commands.readRandomLabels.response, readerOf(code, answer), context)
    expect(labels).toEqual([{ typeId: id?.value, spare: 0xff, data: [0] }])
    expect(labelDataType(id?.value ?? 0)).toBeDefined()
  })

  test.each(of('data data data data data'))('$id', ({ code, hex, fields: data }) => {
    const words = data.map(({ value }) => value)
    const arrays = [{ typeId: 2, area: { unit: 1, length: 10, words } }]
    const context = {
      shape: commands.readArrayLabels.request,
      message: { abbreviations: [], arrays: [{ name: 'A', unit: 1, length: 10 }] },
    }
    expect(written(commands.readArrayLabels.response, { arrays }, code, context).toString('hex').endsWith(hex)).toBe(
      true,
    )
  })

  test('every field is tested here', () => {
    const tested = [
      'arrayPoints',
      'points',
      'abbreviationPoints',
      'nameLength',
      'fixed',
      'unit fixed length data',
      'length data',
      'length data data data data',
      'typeId',
      'data data data data data',
    ]
    for (const { names } of titled) expect(tested).toContain(names)
  })
})
