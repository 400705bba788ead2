/** Our own files: CSV as spreadsheets save it, and JSON. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { exportTags } from '../../src/tags/files/export'
import { importTags } from '../../src/tags/files/import'
import type { Tag } from '../../src/tags/table/tag'
import { anyTable, readItem } from './support'

const table: readonly Tag[] = [
  {
    name: 'level',
    address: 'D100',
    type: 'REAL',
    description: 'level; of "tank 1",\r\nin m',
    unit: 'm',
    scaling: { kind: 'squareRoot', raw: [0, 4000.5], engineering: [-1, 10], clamp: true },
    deadband: { kind: 'percent', value: 0.5 },
    scanClass: 'fast',
    access: 'readWrite',
    min: -0.5,
    max: 9.5,
    format: { wordOrder: 'high-first', encoding: 'shift-jis', trimSpaces: false },
  },
  { name: '=danger', address: '@D0', description: "'-5 °C" },
  { name: '水位', address: 'D200', count: 4, access: 'read', deadband: { kind: 'absolute', value: 1.25 } },
]

const csv = (text: string, options = {}) => importTags(Buffer.from(text), options)
const only = (text: string) => {
  const { tags, messages } = csv(text)
  expect(messages).toEqual([])
  return tags
}

describe('a CSV file', () => {
  test('is UTF-8 with a mark, has only the columns that are used, and no cell that is a formula', () => {
    const { bytes, messages } = exportTags(table.slice(1, 2), { kind: 'csv' })
    const expected = "Name,Address,Type,Count,Description,Unit\r\n'=danger,'@D0,,,''-5 °C,\r\n"
    expect(Buffer.from(bytes).toString('utf8')).toBe(`\ufeff${expected}`)
    expect(messages).toEqual([])
  })

  test.each([',', ';', '\t'] as const)('with %j between its cells is read as it was written', (delimiter) => {
    const { bytes } = exportTags(table, { kind: 'csv', delimiter })
    expect(importTags(bytes)).toEqual({ kind: 'csv', encoding: 'utf-8', delimiter, tags: table, messages: [] })
  })

  test('has a decimal comma with semicolons', () => {
    const text = Buffer.from(exportTags(table, { kind: 'csv', delimiter: ';' }).bytes).toString('utf8')
    expect(text).toContain(';0;4000,5;-1;10;true;0,5%;fast;RW;-0,5;9,5;')
  })

  test('has its columns in any order, by any of their names', () => {
    expect(only('data type,TAG NAME,address,Array_Length\nReal,level,D100,3\n')).toEqual([
      { name: 'level', address: 'D100', type: 'Real', count: 3 },
    ])
    expect(
      only(
        'Name;Address;Scaling;Raw Low;Raw High;Scaled Low;Scaled High\na;D0;None;0;1;0;1\nb;D1;Square Root;0;1;0;2,5\nc;D2;;0;1;0;2',
      ),
    ).toEqual([
      { name: 'a', address: 'D0' },
      { name: 'b', address: 'D1', scaling: { kind: 'squareRoot', raw: [0, 1], engineering: [0, 2.5] } },
      { name: 'c', address: 'D2', scaling: { kind: 'linear', raw: [0, 1], engineering: [0, 2] } },
    ])
  })

  test('may begin with the line by which Excel knows the delimiter, and with a title', () => {
    expect(only('sep=;\r\nName;Address\r\na;D0\r\n')).toEqual([{ name: 'a', address: 'D0' }])
    expect(only('Plant 1\r\n\r\nName;Address\r\na;D0\r\n')).toEqual([{ name: 'a', address: 'D0' }])
  })

  test('says of each row that is no tag why, with its line', () => {
    const rows = [
      'Name,Address,Min,Clamp,Remark',
      'good,D0,,,',
      ',D1,,,',
      'a,D2,1.5.2,maybe,',
      '"b\n2",D3,,,',
      'good,D4,,,',
      'c,D5,,,x,y',
      'd,"D6"7,,,',
      '"e,D8,,,',
    ]
    const { tags, messages } = csv(rows.join('\n'))
    expect(tags).toEqual([{ name: 'good', address: 'D0' }])
    expect(messages).toEqual([
      { line: 1, about: 'note', message: "The column 'Remark' is not known: 1 cell is not kept." },
      { line: 3, about: 'row', message: 'A tag needs a name, not undefined.' },
      { line: 4, about: 'row', message: "Min: '1.5.2' is no number. Clamp: 'maybe' is not true or false." },
      { line: 5, about: 'row', message: 'b\n2: The name has a control character, such as a tab or a new line.' },
      { line: 7, about: 'row', message: "good: The name 'good' is that of line 2 already." },
      {
        line: 8,
        about: 'row',
        message: expect.stringMatching(/^The row has more cells than the heading, the first of them 'y'/),
      },
      { line: 9, about: 'row', message: 'The row cannot be read: behind the quotes of cell 2 stands "7".' },
      { line: 10, about: 'row', message: 'The row cannot be read: a quotation mark is not closed.' },
    ])
  })

  test('is held against the addresses of a PLC, unless it is a template', () => {
    const text = 'Name,Address\na,DD1\nb,D{station}00\n'
    expect(csv(text, { readItem }).tags).toEqual([])
    expect(csv(text, { readItem }).messages.map(({ line }) => line)).toEqual([2, 3])
    expect(csv(text, { template: true }).tags).toHaveLength(2)
  })

  test('with two columns that mean the same is refused', () => {
    expect(() => csv('Name,Address,Unit,Units\na,D0,m,mm\n')).toThrow(
      'Two columns of the file mean Unit: leave one out.',
    )
  })

  test('in Shift-JIS is read, too', () => {
    const { bytes } = exportTags([{ name: '水位', address: 'D0', description: 'タンク' }], {
      kind: 'csv',
      encoding: 'shift-jis',
    })
    expect(importTags(bytes)).toMatchObject({
      encoding: 'shift-jis',
      messages: [],
      tags: [{ name: '水位', description: 'タンク' }],
    })
  })
})

describe('a JSON file', () => {
  test('is read as it was written, without a mark', () => {
    const { bytes } = exportTags(table, { kind: 'json' })
    expect(bytes[0]).toBe('{'.charCodeAt(0))
    expect(importTags(bytes)).toEqual({ kind: 'json', encoding: 'utf-8', tags: table, messages: [] })
    expect(csv(JSON.stringify(table)).tags).toEqual(table)
  })

  test('is UTF-8: letters that might be another code in CSV are no doubt here', () => {
    const tags = [{ name: 'gap', address: 'D0', unit: 'μm' }]
    expect(csv(JSON.stringify(tags))).toMatchObject({ tags, messages: [] })
    const { messages } = csv('Name,Address,Unit\ngap,D0,μm\n')
    expect(messages).toEqual([
      {
        line: 1,
        about: 'note',
        message: expect.stringMatching(/^The file was read as utf-8; .*gb18030.* nearly as likely/),
      },
    ])
  })

  test('says what is wrong with an entry', () => {
    const { tags, messages } = csv('{ "version": 1, "tags": [5, { "name": "a" }, { "name": "b", "address": "D0" }] }')
    expect(tags).toEqual([{ name: 'b', address: 'D0' }])
    expect(messages).toEqual([
      { line: 1, about: 'note', message: '"version" is not known, and is not kept.' },
      { line: 1, about: 'row', message: 'It is no object with name and address.' },
      { line: 2, about: 'row', message: 'a: It needs an address, not undefined.' },
    ])
    expect(() => csv('{ "tags": ')).toThrow(/^The file is no JSON: /)
    expect(() => csv('{ "a": 1 }')).toThrow(/A JSON file of tags is a list of tags/)
  })
})

describe('refused is', () => {
  test('what is no file of tags', () => {
    expect(() => csv('a,b\n1,2\n')).toThrow(/^This is not a file of tags, labels or device comments/)
    expect(() => csv('')).toThrow(/^This is not a file of tags/)
    expect(() => csv('Name,Address\na,D0', { kind: 'gxWorks3Labels' })).toThrow(/It looks like csv\.$/)
  })

  test('an option that does not exist', () => {
    expect(() => csv('', { encodings: 'utf-8' })).toThrow(/no option encodings/)
    expect(() => csv('', { kind: 'xlsx' })).toThrow(/kind is xlsx/)
    expect(() => csv('', { delimiter: '|' })).toThrow(/delimiter is |/)
    expect(() => exportTags([], { kind: 'xlsx' as never })).toThrow(/kind is xlsx/)
  })

  test('a table that is none', () => {
    expect(() => exportTags([{ name: '', address: 'D0' }], { kind: 'csv' })).toThrow(/The table cannot be used/)
  })
})

test('any table is read as it was written', () => {
  const ways = [
    { kind: 'json' },
    { kind: 'csv' },
    { kind: 'csv', delimiter: ';' },
    { kind: 'csv', delimiter: '\t', encoding: 'utf-16le' },
  ] as const
  fc.assert(
    fc.property(anyTable, fc.constantFrom(...ways), (tags, way) => {
      const { bytes } = exportTags(tags, way)
      expect(importTags(bytes)).toMatchObject({ tags, messages: [] })
    }),
    { numRuns: 500 },
  )
})

test('10,000 rows are read at once', () => {
  const tags = Array.from(
    { length: 10_000 },
    (_, at): Tag => ({ name: `t${at}`, address: `D${at}`, type: 'INT', unit: 'm' }),
  )
  const { bytes } = exportTags(tags, { kind: 'csv' })
  const start = performance.now()
  expect(importTags(bytes, { readItem }).tags).toHaveLength(10_000)
  expect(performance.now() - start).toBeLessThan(5000)
})
