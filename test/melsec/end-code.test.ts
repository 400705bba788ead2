import { describe, expect, jest, test } from '@jest/globals'
import { commands } from '../../src/melsec/commands/commands'
import { endCodes, explainEndCode, languages } from '../../src/melsec/end-codes/end-code'
import { endCodeGroups } from '../../src/melsec/end-codes/groups'
import { endCodeHints } from '../../src/melsec/end-codes/hints'
import { endCodePlaces, placesOf } from '../../src/melsec/end-codes/places'
import { remedies } from '../../src/melsec/end-codes/remedies'
import { codesOf, errorTables } from './error-tables'

/** Characters that exist in one of the two Chinese scripts only, as far as these texts could need them. */
const SIMPLIFIED_ONLY =
  /[软号错请认连访问数设备据执检编码读写时间单图块无锁径网络协议远现响应输关闭变动态储务为对与过发]/
const TRADITIONAL_ONLY = /[軟號錯請認連訪問數據設備執檢編碼讀寫時間單圖塊無鎖徑網絡協議遠現響應輸關閉變動態儲務體與並]/
const KANA = /[ぁ-んァ-ヶ]/

const allTexts = [
  ...endCodes().map(({ code, meaning }) => [`meaning of ${code.toString(16)}`, meaning] as const),
  ...endCodes().flatMap(({ code, remedy }) =>
    typeof remedy === 'string' ? [] : [[`remedy of ${code.toString(16)}`, remedy] as const],
  ),
  ...Object.entries(remedies),
  ...endCodeGroups.map(({ from, meaning }) => [`group ${from.toString(16)}`, meaning] as const),
  ...endCodeHints.map(({ code, cause }) => [`hint of ${code.toString(16)}`, cause] as const),
  ...endCodePlaces.map(({ name, text }) => [`place ${name}`, text] as const),
]

const range = (from: number, to: number): number[] => Array.from({ length: to - from + 1 }, (_, index) => from + index)
const sorted = (codes: readonly number[]): number[] => [...new Set(codes)].sort((a, b) => a - b)

describe('end code texts', () => {
  test('every text exists in four languages, none empty, each in its own script, each a sentence', () => {
    for (const [name, texts] of allTexts) {
      expect([name, texts.length]).toEqual([name, 4])
      const [en, ja, zhCN, zhTW] = texts
      expect([name, en]).toEqual([name, expect.stringMatching(/^[\x20-\x7e]+[.]$/)])
      expect([name, ja]).toEqual([name, expect.stringMatching(/。$/)])
      expect([name, KANA.test(ja)]).toEqual([name, true])
      expect([name, zhCN]).toEqual([name, expect.stringMatching(/。$/)])
      expect([name, zhTW]).toEqual([name, expect.stringMatching(/。$/)])
      expect([name, KANA.test(zhCN) || KANA.test(zhTW)]).toEqual([name, false])
      expect([name, zhCN.match(TRADITIONAL_ONLY)]).toEqual([name, null])
      expect([name, zhTW.match(SIMPLIFIED_ONLY)]).toEqual([name, null])
    }
  })

  test('no code stands twice, and every one names its source', () => {
    const codes = endCodes().flatMap(({ code, to = code }) => range(code, to))
    expect(codes.filter((code, index) => codes.indexOf(code) !== index)).toEqual([])
    for (const { source } of [...endCodes(), ...endCodeGroups, ...endCodeHints]) expect(source).not.toBe('')
  })

  test.each([
    [
      'CPU modules in general',
      '4000 4001 4002 4003 4004 4005 4008 4010 4013 4021 4022 4030 4031 4032 4033 4034 4040 4041 4042 4043 4080 408B 4A00 4B00',
    ],
    ['Q and L Ethernet', 'C055 C05A C05D C070 C071 C072 C073 C075 C0B5 C0D4 C200 C201 C202 C203 C204'],
    ['1E', '50 54 55 56 57 58 5B 60 10 11 12 18'],
  ])('%s: every code has a text of its own', (_name, list) => {
    const missing = list.split(' ').filter((hex) => explainEndCode(Number.parseInt(hex, 16))?.exact !== true)
    expect(missing).toEqual([])
  })

  test.each(errorTables.map(({ table, place, codes }) => [table, place, codes] as const))(
    'FX5 %s: every code has a text of its own and says where it is seen',
    (_table, place, list) => {
      const shown = endCodePlaces.find(({ name }) => name === place)?.text[0]
      expect(codesOf(list).filter((code) => explainEndCode(code)?.exact !== true)).toEqual([])
      expect(codesOf(list).filter((code) => explainEndCode(code)?.where.includes(shown ?? '') !== true)).toEqual([])
    },
  )

  test('FX5: the places hold no code the tables do not', () => {
    for (const { name, codes } of endCodePlaces.filter(({ answer }) => !answer)) {
      const expected = errorTables.filter(({ place }) => place === name).flatMap((table) => codesOf(table.codes))
      const held = codes.flatMap((entry) => (typeof entry === 'number' ? entry : range(...entry)))
      expect([name, sorted(held)]).toEqual([name, sorted(expected)])
    }
  })

  test('every code with a text says where it is seen, and every code of a place has a text', () => {
    const known = new Set(endCodes().flatMap(({ code, to = code }) => range(code, to)))
    expect([...known].filter((code) => placesOf(code).length === 0).map((code) => code.toString(16))).toEqual([])
    const listed = endCodePlaces.flatMap(({ codes }) =>
      codes.flatMap((entry) => (typeof entry === 'number' ? entry : range(...entry))),
    )
    // Of 4000H to 4FFFH the manual says only that the CPU module detected the error: groups.ts.
    const without = listed.filter((code) => !known.has(code) && (code < 0x4000 || code > 0x4fff))
    expect([...new Set(without)].map((code) => code.toString(16))).toEqual([])
  })

  test('a code of a register is no answer, a code of an answer is one, a range is one text', () => {
    expect(explainEndCode(0xc059)).toMatchObject({ answer: true })
    expect(explainEndCode(0x7601)).toMatchObject({
      answer: false,
      exact: true,
      where: [expect.stringContaining('SD8500')],
      meaning: expect.stringContaining('inverter does not respond'),
    })
    expect(explainEndCode(0xc06f)).toMatchObject({ answer: false })
    expect(explainEndCode(0x7143, { language: 'zh-CN' })?.where).toEqual([
      expect.stringContaining('NAK'),
      expect.stringContaining('SD8500'),
    ])
    for (const code of [0x3e30, 0x3e3f, 0x3e42]) expect(explainEndCode(code)).toEqual(explainEndCode(0x3e30))
    expect(explainEndCode(0x3e43)).toBeUndefined()
    expect(explainEndCode(0x4fff)).toMatchObject({ exact: false, where: [], answer: true })
  })

  test('errors of an inverter are put together as the manual lists them', () => {
    expect(explainEndCode(0x7640)?.meaning).toContain('send data 1 was refused (mode error)')
    expect(explainEndCode(0x7645)?.meaning).toContain('send data 2 was refused (data range error)')
    expect(explainEndCode(0x764b)?.meaning).toContain(
      'send data 1 (instruction code error) and send data 2 (data range error)',
    )
    expect(explainEndCode(0x764d, { language: 'ja' })?.meaning).toContain(
      '送信データ1はデータ範囲エラー、送信データ2は命令コードエラー',
    )
    for (const { code, meaning } of endCodes()) expect([code, meaning.join().includes('{')]).toEqual([code, false])
  })

  test('each language gives its own text; English is the default', () => {
    const texts = languages.map((language) => explainEndCode(0xc059, { language })?.meaning)
    expect(new Set(texts).size).toBe(4)
    expect(explainEndCode(0xc059)?.meaning).toBe('This module does not have the command or subcommand.')
    expect(explainEndCode(0xc059, { language: 'zh-TW' })?.meaning).toContain('子指令')
  })

  test('the codes about a device or address of one item, and only those, may be asked for one by one', () => {
    const about = endCodes()
      .filter(({ aboutDevice }) => aboutDevice === true)
      .map(({ code }) => code)
    for (const code of [0xc056, 0xc05b, 0xc05c, 0x4030, 0x4031, 0x4032, 0x4033, 0x4041, 0x4043, 0xc070, 0x56, 0x7e43]) {
      expect(about).toContain(code)
      expect(explainEndCode(code)?.aboutDevice).toBe(true)
    }
    for (const code of [0xc051, 0xc052, 0xc053, 0xc054, 0xc059, 0xc061, 0xc0d8, 0xc201, 0x4005, 0x4008, 0x4010]) {
      expect(explainEndCode(code)?.aboutDevice).toBe(false)
    }
  })

  test('a command adds the likely cause, where one is known', () => {
    expect(explainEndCode(0xc059)).not.toHaveProperty('cause')
    expect(explainEndCode(0xc059, { command: 'executeMonitor' })?.cause).toContain('Read Random')
    expect(explainEndCode(0xc059, { command: 'readBlock' })?.cause).toContain('E71')
    expect(explainEndCode(0xc059, { command: 'readWords' })).not.toHaveProperty('cause')
    expect(explainEndCode(0x408b, { command: 'remoteReset', language: 'ja' })?.cause).toContain('リモートリセット')
  })

  test('hints are about codes with a text and commands that exist', () => {
    for (const { code, commands: names } of endCodeHints) {
      expect(endCodes().map((entry) => entry.code)).toContain(code)
      for (const name of names) expect(Object.keys(commands)).toContain(name)
    }
  })

  test('a code without a text in a known range names the module that reported it', () => {
    expect(explainEndCode(0x4fff)).toMatchObject({
      exact: false,
      aboutDevice: false,
      meaning: expect.stringContaining('CPU module'),
    })
    expect(explainEndCode(0xc0ff)).toMatchObject({ exact: false, meaning: expect.stringContaining('Ethernet') })
    expect(explainEndCode(0xd123, { language: 'zh-CN' })).toMatchObject({
      exact: false,
      meaning: expect.stringContaining('CC-Link IE'),
    })
  })

  test('ranges do not overlap and are inside 16 bits', () => {
    const sorted = [...endCodeGroups].sort((a, b) => a.from - b.from)
    sorted.forEach((group, index) => {
      expect(group.to).toBeGreaterThan(group.from)
      expect(group.to).toBeLessThanOrEqual(0xffff)
      expect(group.from).toBeGreaterThan(sorted[index - 1]?.to ?? -1)
    })
  })

  test('the texts are loaded with the first code somebody asks for, and once', () => {
    let loads = 0
    jest.isolateModules(() => {
      jest.doMock('../../src/melsec/end-codes/tables', () => {
        loads += 1
        return jest.requireActual('../../src/melsec/end-codes/tables')
      })
      const library = require('../../src/index') as typeof import('../../src/index')
      expect(loads).toBe(0)
      expect(library.explainEndCode(0xc059)?.exact).toBe(true)
      expect(library.explainEndCode(0x7601)?.exact).toBe(true)
      expect(library.endCodes().length).toBeGreaterThan(400)
    })
    jest.dontMock('../../src/melsec/end-codes/tables')
    expect(loads).toBe(1)
  })

  test('a code nobody knows is undefined', () => {
    for (const code of [0x0001, 0x0400, 0x5000, 0x9999, 0xafff]) expect(explainEndCode(code)).toBeUndefined()
  })
})
