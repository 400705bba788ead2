/** Labels and device comments of GX Works3 and GX Works2, in the languages of their interface. The files are written by hand. */
import { describe, expect, test } from '@jest/globals'
import { fileOfText } from '../../src/tags/files/encoding'
import { exportTags } from '../../src/tags/files/export'
import { gxWorks2Heading, gxWorks3Heading } from '../../src/tags/files/gx-headers'
import { gxTypeOf, storedType } from '../../src/tags/files/gx-type'
import { importTags } from '../../src/tags/files/import'
import type { Tag } from '../../src/tags/table/tag'
import { gxText, readItem, utf16 } from './support'

/** A row with its cells by header. */
function row(heading: readonly string[], cells: Readonly<Record<string, string>>): string[] {
  return heading.map((header) => cells[header] ?? '')
}

const label = (name: string, type: string, assign: string, more: Readonly<Record<string, string>> = {}) =>
  row(gxWorks3Heading, {
    Class: 'VAR_GLOBAL',
    'Label Name': name,
    'Data Type': type,
    'Assign (Device/Label)': assign,
    'Access from External Device': '0',
    ...more,
  })

const gx3 = (...rows: readonly string[][]) =>
  importTags(utf16(gxText(['Plant'], [...gxWorks3Heading], ...rows)), { readItem })

describe('global labels of GX Works3', () => {
  test('are tags with their devices, types, arrays and comments', () => {
    const found = gx3(
      label('Level', 'FLOAT [Single Precision]', 'D100', { Comment: 'level of tank 1' }),
      label('Pump', 'Bit', 'M10', { English: 'pump', 'Japanese/日本語': 'ポンプ' }),
      label('Recipe', 'Word [Unsigned]/Bit String [16-bit](0..9)', 'W1F'),
      label('Matrix', 'Word [Signed](0..2,1..4)', 'D200'),
      label('Ready', 'Bit', 'D300.F'),
      label('Name', 'String(20)', 'D400'),
      label('Names', 'String(20)(0..4)', 'D500'),
      label('Wide', 'String [Unicode](8)(0..1)', 'D600'),
      label('Line', 'Word [Signed]', '', { 'Access from External Device': '1' }),
      label('Values', 'Double Word [Signed](1..5)', '', { 'Access from External Device': '1' }),
    )
    expect(found).toMatchObject({ kind: 'gxWorks3Labels', encoding: 'utf-16le', delimiter: '\t' })
    expect(found.tags).toEqual([
      { name: 'Level', address: 'D100', type: 'REAL', description: 'level of tank 1' },
      { name: 'Pump', address: 'M10', type: 'BOOL', description: 'ポンプ' },
      { name: 'Recipe', address: 'W1F', type: 'WORD', count: 10 },
      { name: 'Matrix', address: 'D200', type: 'INT', count: 12 },
      { name: 'Ready', address: 'D300.F', type: 'BOOL' },
      { name: 'Name', address: 'D400', type: 'STRING(20)' },
      { name: 'Names', address: 'D500', type: 'STRING(21)', count: 5 },
      { name: 'Wide', address: 'D600', type: 'WSTRING(9)', count: 2 },
      { name: 'Line', address: 'label:Line', type: 'INT' },
      { name: 'Values', address: 'label:Values[1]', type: 'DINT', count: 5 },
    ])
    expect(found.messages).toEqual([{ line: 2, about: 'note', message: "Of the column 'English' 1 cell is not kept." }])
  })

  test('that are no tags say why, with their lines', () => {
    const { tags, messages } = gx3(
      label('Auto', 'Bit', ''),
      label('Max', 'Word [Signed]', '', { Class: 'VAR_GLOBAL_CONSTANT', Constant: '100' }),
      label('Delay', 'Timer', 'T0'),
      label('Axis1', 'AxisData', 'Detailed Setting'),
      label('', 'Bit', 'M0'),
      label('Bad', 'Word [Signed]', 'DD5'),
      label('Odd', 'Word [Signed](4..0)', 'D0'),
      label('Open', 'String', 'D0'),
      label('Inner', 'Bit', '', { Class: 'VAR_INPUT' }),
      label('Twice', 'Bit', 'M1', { 'Initial Value': 'TRUE' }),
      label('twice', 'Bit', 'M2'),
    )
    expect(tags).toEqual([{ name: 'Twice', address: 'M1', type: 'BOOL' }])
    expect(messages).toEqual([
      { line: 2, about: 'note', message: "Of the column 'Constant' 1 cell is not kept." },
      { line: 2, about: 'note', message: "Of the column 'Initial Value' 1 cell is not kept." },
      ...[
        [3, /^Auto: it has no device. It is not accessed by its name/],
        [4, /^Max: a constant stands in the program/],
        [5, /^Delay: Timer is three devices, contact, coil and current value/],
        [6, /^Axis1: AxisData is no type of a value: of a structure/],
        [7, /^The row has no label name/],
        [8, /^Bad: .*DD5/],
        [9, /^Odd: .* an array ends before it begins/],
        [10, /^Open: STRING needs a length/],
        [11, /^Inner: VAR_INPUT is a class of local labels/],
        [13, /^twice: The name 'twice' is that of line 12 already/],
      ].map(([line, message]) => ({ line, about: 'row', message: expect.stringMatching(message as RegExp) })),
    ])
  })

  test('are found by their headings in Japanese, whatever columns there are', () => {
    const text = gxText(
      ['プロジェクト'],
      ['ラベル名', 'データ型', 'クラス', '割付(デバイス/ラベル)', '初期値', 'コメント'],
      ['水位', '単精度実数', 'VAR_GLOBAL', 'D100', '', 'タンク１の水位'],
      ['運転', 'ビット', 'VAR_GLOBAL', 'M10', '', ''],
      ['数', 'ワード[符号なし]/16ビット列(0..3)', 'VAR_GLOBAL', 'D200', '', ''],
    )
    expect(importTags(utf16(text), { readItem })).toMatchObject({
      kind: 'gxWorks3Labels',
      messages: [],
      tags: [
        { name: '水位', address: 'D100', type: 'REAL', description: 'タンク１の水位' },
        { name: '運転', address: 'M10', type: 'BOOL' },
        { name: '数', address: 'D200', type: 'WORD', count: 4 },
      ],
    })
  })

  test('are found by their headings in Chinese', () => {
    const simplified = gxText(
      ['类', '标签名', '数据类型', '常数', '初始值', '分配(软元件/标签)', '地址', '注释', '外部设备访问'],
      ['VAR_GLOBAL', '液位', '字[有符号]', '', '', 'D100', '', '水箱液位', '0'],
      ['VAR_GLOBAL', '温度', '双字[有符号]', '', '', '', '', '', '1'],
    )
    expect(importTags(utf16(simplified), { readItem })).toMatchObject({
      messages: [],
      tags: [
        { name: '液位', address: 'D100', type: 'INT', description: '水箱液位' },
        { name: '温度', address: 'label:温度', type: 'DINT' },
      ],
    })
    const traditional = gxText(
      ['類別', '標籤名', '資料類型', '分配(軟元件/標籤)', '註解'],
      ['VAR_GLOBAL', '液位', '字[有符號]', 'D100', '水箱液位'],
    )
    expect(importTags(utf16(traditional), { readItem })).toMatchObject({
      messages: [],
      tags: [{ name: '液位', address: 'D100', type: 'INT', description: '水箱液位' }],
    })
  })

  test('without the column of external access cannot be reached by name', () => {
    const text = gxText(['Label Name', 'Data Type', 'Assign (Device/Label)'], ['A', 'Bit', ''])
    expect(importTags(utf16(text)).messages[0]?.message).toMatch(
      /The file does not say that it can be accessed by its name/,
    )
  })

  test('saved again by a spreadsheet, with commas and in Shift-JIS, are read all the same', () => {
    const text = 'ラベル名,データ型,割付(デバイス/ラベル),コメント\r\n水位,単精度実数,D100,"タンク,1"\r\n'
    expect(importTags(fileOfText(text, 'shift-jis'))).toMatchObject({
      encoding: 'shift-jis',
      delimiter: ',',
      messages: [],
      tags: [{ name: '水位', address: 'D100', type: 'REAL', description: 'タンク,1' }],
    })
  })
})

describe('labels of GX Works2', () => {
  const gx2 = (name: string, type: string, device: string, more = {}) =>
    row(gxWorks2Heading, { Class: 'VAR_GLOBAL', 'Label Name': name, 'Data Type': type, Device: device, ...more })

  test('are tags by their devices', () => {
    const found = importTags(
      utf16(
        gxText(
          ['Plant'],
          [...gxWorks2Heading],
          gx2('Speed', 'INT', 'D10', { Address: '%MW0.10', Comment: 'speed' }),
          gx2('Mass', 'FLOAT (Single Precision)', 'D20'),
          gx2('Flags', 'BOOL(0..15)', 'M0'),
          gx2('Old', 'ARRAY [0..3] OF DINT', 'D30'),
          gx2('Auto', 'INT', ''),
        ),
      ),
      { readItem },
    )
    expect(found.kind).toBe('gxWorks2Labels')
    expect(found.tags).toEqual([
      { name: 'Speed', address: 'D10', type: 'INT', description: 'speed' },
      { name: 'Mass', address: 'D20', type: 'REAL' },
      { name: 'Flags', address: 'M0', type: 'BOOL', count: 16 },
      { name: 'Old', address: 'D30', type: 'DINT', count: 4 },
    ])
    expect(found.messages).toEqual([
      { line: 2, about: 'note', message: "Of the column 'Address' 1 cell is not kept." },
      { line: 7, about: 'row', message: expect.stringMatching(/^Auto: GX Works2 assigns its device by itself/) },
    ])
  })
})

describe('device comments', () => {
  test('are tags named by their devices', () => {
    const text = gxText(
      ['COMMENT'],
      ['Device Name', 'English', 'Japanese/日本語'],
      ['D100', 'level', '水位'],
      ['M10', '', 'ポンプ'],
      ['T0', 'delay', ''],
      ['', 'nothing', ''],
    )
    const { kind, tags, messages } = importTags(utf16(text), { readItem })
    expect(kind).toBe('deviceComments')
    expect(tags).toEqual([
      { name: 'D100', address: 'D100', description: 'level' },
      { name: 'M10', address: 'M10', description: 'ポンプ' },
    ])
    expect(messages).toEqual([
      { line: 2, about: 'note', message: "Of the column 'Japanese/日本語' 1 cell is not kept." },
      { line: 5, about: 'row', message: expect.stringMatching(/^T0: .*TN0 \(current value\)/) },
      { line: 6, about: 'row', message: 'The row has no device.' },
    ])
  })

  test('of older tools have labels, too', () => {
    const text = 'Device number,Label,Comment\r\nD100,Level,level of tank 1\r\nD101,,\r\n'
    expect(importTags(Buffer.from(text), { readItem })).toMatchObject({
      kind: 'deviceComments',
      messages: [],
      tags: [
        { name: 'Level', address: 'D100', description: 'level of tank 1' },
        { name: 'D101', address: 'D101' },
      ],
    })
  })
})

describe('data types', () => {
  test.each([
    ['Word [Signed]', 'INT', undefined],
    ['word[signed](0..4)', 'INT', 5],
    ['Bit(0..7)', 'BOOL', 8],
    ['Time', 'TIME', undefined],
    ['FLOAT [Double Precision](-1..1)', 'LREAL', 3],
    ['文字列(32)', 'STRING(32)', undefined],
    ['文字列(32)(0..1)', 'STRING(33)', 2],
    ['String(31)(0..1)', 'STRING(31)', 2],
    ['ダブルワード[符号付き](0..1, 0..1)', 'DINT', 4],
  ])('%s are %s, %p of them', (text, type, count) => {
    const found = gxTypeOf(text)
    expect([storedType(found), found.count]).toEqual([type, count])
  })
})

describe('written for GX Works', () => {
  const tags: readonly Tag[] = [
    { name: 'Level', address: 'D100', type: 'REAL', description: 'level "1"' },
    { name: 'Counts', address: 'W10', type: 'UDINT', count: 3 },
    { name: 'Pump', address: 'M0', type: 'BOOL', unit: '-', access: 'read' },
    { name: 'Names', address: 'D200', type: 'STRING(21)', count: 2 },
    { name: 'Odd', address: 'D300', type: 'STRING(20)', count: 2 },
    { name: 'Text', address: 'D400:STRING(20)' },
    { name: 'Big', address: 'D500', type: 'LINT' },
    { name: 'm1.speed', address: 'D600' },
    { name: 'Far', address: 'label:Far', type: 'INT' },
    { name: 'Bad', address: 'DD1' },
  ]
  const read = [
    { name: 'Level', address: 'D100', type: 'REAL', description: 'level "1"' },
    { name: 'Counts', address: 'W10', type: 'DWORD', count: 3 },
    { name: 'Pump', address: 'M0', type: 'BOOL' },
    { name: 'Names', address: 'D200', type: 'STRING(21)', count: 2 },
    { name: 'Text', address: 'D400', type: 'STRING(20)' },
  ]
  const lost = [
    ['Pump', 'fields', 'The file has no place for unit, access.'],
    ['Odd', 'tag', 'GX Works has no data type for STRING that takes the same words.'],
    ['Big', 'tag', 'GX Works has no data type for LINT that takes the same words.'],
    ['m1.speed', 'tag', expect.stringMatching(/^Its name is no label name/)],
    ['Far', 'tag', 'It is a label of the PLC already.'],
    ['Bad', 'tag', expect.stringMatching(/DD1/)],
  ].map(([name, about, message]) => ({ name, about, message }))

  test.each(['gxWorks3Labels', 'gxWorks2Labels'] as const)(
    '%s are read again, and what is not in them is told',
    (kind) => {
      const { bytes, messages } = exportTags(tags, { kind, readItem })
      expect([...bytes.subarray(0, 2)]).toEqual([0xff, 0xfe])
      expect(importTags(bytes, { readItem })).toMatchObject({ kind, encoding: 'utf-16le', tags: read, messages: [] })
      expect(messages).toEqual(lost)
    },
  )

  test('device comments are read again', () => {
    const { bytes, messages } = exportTags(tags.slice(0, 2), { kind: 'deviceComments', readItem })
    expect(importTags(bytes, { readItem })).toMatchObject({
      kind: 'deviceComments',
      tags: [{ name: 'D100', address: 'D100', description: 'level "1"' }],
      messages: [],
    })
    expect(messages).toEqual([
      { name: 'Level', about: 'fields', message: 'The file has no place for name, type.' },
      { name: 'Counts', about: 'tag', message: 'It has no description.' },
    ])
  })

  test('needs somebody who knows addresses', () => {
    expect(() => exportTags(tags, { kind: 'gxWorks3Labels' })).toThrow(/need a function that reads addresses/)
  })

  test('has the bytes that GX Works3 has: UTF-16 with its mark, tabs, every cell quoted, CR LF', () => {
    const text = Buffer.from(exportTags(tags.slice(0, 1), { kind: 'gxWorks3Labels', readItem }).bytes).toString(
      'utf16le',
    )
    const [title, head = '', body = '', end] = text.split('\r\n')
    expect(title).toBe('\ufeff"Tags"')
    expect(head.split('\t')).toHaveLength(28)
    expect(head).toMatch(/^"Class"\t"Label Name"\t"Data Type"\t"Constant"\t"Initial Value"\t"Assign \(Device\/Label\)"/)
    expect(body).toMatch(/^"VAR_GLOBAL"\t"Level"\t"FLOAT \[Single Precision\]"\t""\t""\t"D100"\t""\t"level ""1"""\t/)
    expect(end).toBe('')
  })
})
