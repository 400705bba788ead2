// Names, passwords, numbers and dates of the file commands where the manual prints no example.
import { describe, expect, test } from '@jest/globals'
import { type DataCode, decode, encode, readerOf, type Shape, type ValueCodec, writerOf } from '../../src/codec/codec'
import { ProtocolError, RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import { attributeNumber, attributesOf, attributeText } from '../../src/melsec/file/attribute'
import {
  directoryPath,
  entryName,
  FORM_FILE_0004,
  FORM_FILE_UTF16,
  fileName,
  fileNumber,
  filePassword,
  searchPassword,
} from '../../src/melsec/file/codec'
import { changedTime, formatFileTime, isFileTime, modifiedTime } from '../../src/melsec/file/time'

const LONG = FORM_FILE_UTF16

function written<T>(codec: ValueCodec<T>, value: T, form = 0, code: DataCode = 'binary'): Buffer {
  const writer = writerOf(code, form)
  codec.write(writer, value)
  return writer.take()
}

function read<T>(codec: ValueCodec<T>, bytes: Buffer, form = 0, code: DataCode = 'binary'): T {
  const reader = readerOf(code, bytes, form)
  const value = codec.read(reader)
  reader.end()
  return value
}

describe('names of 0000 and 0004', () => {
  test('are Shift-JIS, the same bytes in both codes; a full-width character counts twice', () => {
    // 表 is 95 5C: its second byte is the separator's, ソ is 83 5C.
    const bytes = Buffer.from('955c835c2e435356', 'hex')
    for (const form of [0, FORM_FILE_0004]) {
      expect(written(fileName, '表ソ.CSV', form)).toEqual(Buffer.concat([Buffer.of(8, 0), bytes]))
      expect(written(fileName, '表ソ.CSV', form, 'ascii')).toEqual(Buffer.concat([Buffer.from('0008'), bytes]))
      expect(read(fileName, Buffer.concat([Buffer.of(8, 0), bytes]), form)).toBe('表ソ.CSV')
    }
  })

  test.each(['四文字名', '12345678.123', 'A', 'A B.C'])('%s is one', (name) => {
    expect(read(fileName, written(fileName, name))).toBe(name)
  })

  test.each(['五文字名前', '123456789.A', 'A.1234', 'A.B.C', '.CSV', 'A.', 'DIR\\A', '中国汉', ''])(
    '%j is none',
    (name) => {
      expect(() => written(fileName, name)).toThrow(RequestError)
    },
  )

  test('stand in a list with 8 and 3 bytes, without the period', () => {
    expect(written(entryName, 'AB.C').toString()).toBe('AB      C  ')
    expect(written(entryName, 'SUBDIR').toString()).toBe('SUBDIR     ')
    expect(read(entryName, Buffer.from('AB      C  '))).toBe('AB.C')
    expect(read(entryName, Buffer.from('A B        '))).toBe('A B')
  })

  test('that are no Shift-JIS are read so that they cannot be sent', () => {
    const name = read(entryName, Buffer.from('ff8141202020202043535f', 'hex'))
    expect(name).toContain('\ufffd')
    expect(() => written(fileName, name)).toThrow(RequestError)
  })
})

describe('names of 0040', () => {
  test('are counted in UTF-16 units', () => {
    expect(written(fileName, '表', LONG).toString('hex')).toBe('01006888')
    expect(written(fileName, '表', LONG, 'ascii').toString()).toBe('00018868')
    expect(written(fileName, '😀', LONG).toString('hex')).toBe('02003dd800de')
  })

  test('have 64 characters, with their path 252, beside a separator in front', () => {
    const directory = `${'D'.repeat(62)}\\`.repeat(3)
    const longest = `${directory}${'N'.repeat(63)}`
    expect(longest).toHaveLength(252)
    for (const name of ['N'.repeat(64), longest, `\\${longest}`]) {
      expect(read(fileName, written(fileName, name, LONG), LONG)).toBe(name)
    }
    for (const name of ['N'.repeat(65), `${longest}N`]) expect(() => written(fileName, name, LONG)).toThrow(/at most/)
  })

  test.each(['A/B', 'C:\\A', 'A*', 'A?', 'A"', '<A>', 'A|B', 'A\u0000', '\ud800', '..\\A', 'A\\\\B', 'A\\', '', '\\'])(
    '%j is none',
    (name) => {
      expect(() => written(fileName, name, LONG)).toThrow(RequestError)
    },
  )

  test('of the root directory are empty, with 0000 there is no other', () => {
    for (const [path, form] of [
      ['', LONG],
      ['', 0],
      ['\\', LONG],
      ['LOG\\OLD', LONG],
    ] as const) {
      expect(read(directoryPath, written(directoryPath, path, form), form)).toBe(path)
    }
    expect(() => written(directoryPath, 'LOG', 0)).toThrow(/no directories/)
    expect(() => read(directoryPath, Buffer.of(1, 0), 0)).toThrow(ProtocolError)
  })
})

describe('passwords', () => {
  test('are 4 characters, none is 4 spaces', () => {
    expect(written(filePassword, '').toString()).toBe('    ')
    expect(written(filePassword, 'a1 Z', FORM_FILE_0004, 'ascii').toString()).toBe('a1 Z')
    expect(read(filePassword, Buffer.from('    '))).toBe('')
    for (const wrong of ['abc', 'abcde', 'äbcd']) expect(() => written(filePassword, wrong)).toThrow(RequestError)
  })

  test('have their length with 0040', () => {
    expect(written(filePassword, 'abc', LONG).toString('hex')).toBe('0300616263')
    expect(written(filePassword, '', LONG, 'ascii').toString()).toBe('0000')
    expect(() => written(filePassword, 'x'.repeat(33), LONG)).toThrow(/at most 32/)
  })

  test('are a fixed field where 0040 takes none', () => {
    expect(written(searchPassword, '', LONG).toString('hex')).toBe('00000000')
    expect(written(searchPassword, '', LONG, 'ascii').toString()).toBe('0000')
    expect(() => written(searchPassword, 'secret', LONG)).toThrow(/leave it out/)
    expect(() => read(searchPassword, Buffer.from('abcd'), LONG)).toThrow(ProtocolError)
  })

  test('are never in an error', () => {
    for (const form of [0, LONG]) {
      for (const codec of [filePassword, searchPassword]) {
        for (const secret of ['hush!'.repeat(8), 'hüsh']) {
          const error = (() => {
            try {
              written(codec, secret, form)
            } catch (reason) {
              return String(reason)
            }
            return ''
          })()
          expect(error).toMatch(/RequestError/)
          expect(error).not.toMatch(/hush|hüsh/)
        }
      }
    }
  })
})

describe('lists of files', () => {
  const { request, response } = commands.readDirectory
  const context = { shape: request, message: { drive: 4, start: 9, count: 3, path: '' } }
  const answer = (hex: string, form: number) =>
    decode(response, readerOf('binary', Buffer.from(hex, 'hex'), form), context)

  test.each([
    ['0, with the last file number', '000008000000', LONG, 8],
    ['-1, with the last file number', 'ffff08000000', LONG, 8],
    ['-1, and nothing behind it', 'ffff', LONG, 0],
    ['0 of 0000', '0000', 0, 0],
  ])('end with %s', (_what, hex, form, lastFileNumber) => {
    expect(answer(hex, form)).toEqual({ lastFileNumber, files: [] })
  })

  test('pass over what spare areas hold, in both codes', () => {
    const head = '01000100000001004100'
    const entry = { name: 'A', attribute: 0x20, size: 7, modified: { ...zero, year: 1980, month: 0, day: 0 } }
    expect(answer(`${head}2000ffeeddccbbaa99887700000000665507000000`, LONG).files).toEqual([entry])
    const ascii = '0001000000010001004100200123456789ABCDxyz!00000000ZZZZ00000007'
    const reader = readerOf('ascii', Buffer.from(ascii), LONG)
    expect(decode(response, reader, context).files).toEqual([entry])
  })

  test('have file numbers of 2 and 4 bytes', () => {
    expect(written(fileNumber, 0x1234).toString('hex')).toBe('3412')
    expect(written(fileNumber, 0x12345678, LONG).toString('hex')).toBe('78563412')
    expect(() => written(fileNumber, 0x10000)).toThrow(/0 to 65535/)
  })
})

const zero = { year: 1980, month: 1, day: 1, hour: 0, minute: 0, second: 0 }

describe('dates', () => {
  test('go from 1980 to 2107, date and time in either order', () => {
    const last = { year: 2107, month: 12, day: 31, hour: 23, minute: 59, second: 58 }
    expect(written(changedTime, last).toString('hex')).toBe('9fff7dbf')
    expect(written(modifiedTime, last).toString('hex')).toBe('7dbf9fff')
    expect(read(changedTime, Buffer.from('9fff7dbf', 'hex'))).toEqual(last)
    expect(read(modifiedTime, Buffer.from('21000000', 'hex').swap16())).not.toEqual(last)
  })

  test('that are none are read as they stand, and not written', () => {
    for (const hex of ['00000000', 'ffffffff', '0000e0ff', '1f000000']) {
      const time = read(modifiedTime, Buffer.from(hex, 'hex'))
      expect(isFileTime(time)).toBe(false)
      expect(() => written(modifiedTime, time)).toThrow(RequestError)
    }
    expect(formatFileTime(read(modifiedTime, Buffer.alloc(4)))).toBe('1980-00-00 00:00:00')
  })

  test.each([
    ['year', 1979],
    ['year', 2108],
    ['month', 13],
    ['day', 0],
    ['day', 32],
    ['hour', 24],
    ['minute', 60],
    ['second', 59],
    ['second', 60],
    ['second', 0.5],
  ] as const)('are refused with %s %d', (field, value) => {
    expect(() => written(changedTime, { ...zero, [field]: value })).toThrow(new RegExp(field))
  })

  test('know leap years', () => {
    expect(isFileTime({ ...zero, year: 2000, month: 2, day: 29 })).toBe(true)
    expect(isFileTime({ ...zero, year: 2100, month: 2, day: 29 })).toBe(false)
  })
})

test('attributes are those of the manual, others are of the system', () => {
  for (const [number, text] of [
    [0x00, 'file'],
    [0x20, 'file'],
    [0x01, 'read-only file'],
    [0x21, 'read-only file'],
    [0x10, 'directory'],
    [0x30, 'directory'],
    [0x11, 'read-only directory'],
    [0x31, 'read-only directory'],
    [0x22, 'file of the system'],
  ] as const) {
    expect(attributeText(number)).toBe(text)
    if (number !== 0x22) expect(attributeText(attributeNumber(attributesOf(number)))).toBe(text)
  }
})

test('a message that leaves passwords and the path out is whole', () => {
  const writer = writerOf('binary', LONG)
  encode<Shape>(commands.deleteFile.request, { drive: 4, name: 'A' }, writer)
  expect(writer.take().toString('hex')).toBe('00000400' + '01004100')
})
