import { describe, expect, jest, test } from '@jest/globals'
import { type ExplainCodeOptions, explainEndCode, meaningsOfEndCode } from '../../src/end-code/explain'
import { EndCodeError, endCodeAbouts, RequestError } from '../../src/errors'
import { each } from '../../src/link/link'
import { commands } from '../../src/melsec/commands/commands'
import {
  endCodes,
  languages,
  type MelsecEndCodeFamily,
  melsecEndCodeFamilies,
} from '../../src/melsec/end-codes/end-code'
import { endCodeTables, factsOf } from '../../src/melsec/end-codes/facts'
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

const entries = melsecEndCodeFamilies.flatMap((family) => endCodes(family))

/** Of the four digits that most frames carry. */
function slmp(code: number, options: Omit<ExplainCodeOptions, 'family'> = {}) {
  return explainEndCode(code, { family: 'slmp', ...options })
}

const allTexts = [
  ...entries.map(({ code, meaning }) => [`meaning of ${code.toString(16)}`, meaning] as const),
  ...entries.flatMap(({ code, remedy }) =>
    typeof remedy === 'string' ? [] : [[`remedy of ${code.toString(16)}`, remedy] as const],
  ),
  ...Object.entries(remedies),
  ...endCodeGroups.map(({ from, meaning }) => [`group ${from.toString(16)}`, meaning] as const),
  ...endCodeHints.map(({ code, cause }) => [`hint of ${code.toString(16)}`, cause] as const),
  ...endCodePlaces.map(({ name, text }) => [`place ${name}`, text] as const),
]

const range = (from: number, to: number): number[] => Array.from({ length: to - from + 1 }, (_, index) => from + index)
const placesIn = (asked: MelsecEndCodeFamily) => endCodePlaces.filter(({ family = 'slmp' }) => family === asked)
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
    for (const family of melsecEndCodeFamilies) {
      const codes = endCodes(family).flatMap(({ code, to = code }) => range(code, to))
      expect([family, codes.filter((code, index) => codes.indexOf(code) !== index)]).toEqual([family, []])
    }
    for (const { source } of [...entries, ...endCodeGroups, ...endCodeHints]) expect(source).not.toBe('')
  })

  test.each([
    [
      'CPU modules in general',
      'slmp',
      '4000 4001 4002 4003 4004 4005 4008 4010 4013 4021 4022 4030 4031 4032 4033 4034 4040 4041 4042 4043 4080 408B 4A00 4B00',
    ],
    ['Q and L Ethernet', 'slmp', '0055 C055 C05A C05D C070 C071 C072 C073 C075 C0B5 C0D4 C200 C201 C202 C203 C204'],
    ['1E', '1E', '50 54 55 56 57 58 5B 60 10 11 12 18'],
  ] as const)('%s: every code has a text of its own', (_name, family, list) => {
    const missing = list
      .split(' ')
      .filter((hex) => explainEndCode(Number.parseInt(hex, 16), { family })?.exact !== true)
    expect(missing).toEqual([])
  })

  test.each(errorTables.map(({ table, place, codes }) => [table, place, codes] as const))(
    'FX5 %s: every code has a text of its own and says where it is seen',
    (_table, place, list) => {
      const { text: [shown] = [], family = 'slmp' } = endCodePlaces.find(({ name }) => name === place) ?? {}
      expect(codesOf(list).filter((code) => explainEndCode(code, { family })?.exact !== true)).toEqual([])
      expect(
        codesOf(list).filter((code) => explainEndCode(code, { family })?.where.includes(shown ?? '') !== true),
      ).toEqual([])
    },
  )

  test('FX5: the places hold no code the tables do not', () => {
    for (const { name, codes } of endCodePlaces.filter(({ answer }) => !answer)) {
      const expected = errorTables.filter(({ place }) => place === name).flatMap((table) => codesOf(table.codes))
      expect([name, sorted(each(codes))]).toEqual([name, sorted(expected)])
    }
  })

  test.each(melsecEndCodeFamilies)(
    '%s: every code with a text says where it is seen, and every code of a place has a text',
    (family) => {
      const known = new Set(endCodes(family).flatMap(({ code, to = code }) => range(code, to)))
      expect([...known].filter((code) => placesOf(family, code).length === 0).map((code) => code.toString(16))).toEqual(
        [],
      )
      const listed = placesIn(family).flatMap(({ codes }) => each(codes))
      // Of 4000H to 4FFFH the manual says only that the CPU module detected the error: groups.ts.
      const without = listed.filter((code) => !known.has(code) && (code < 0x4000 || code > 0x4fff))
      expect([...new Set(without)].map((code) => code.toString(16))).toEqual([])
    },
  )

  test('a code of a register is no answer, a code of an answer is one, a range is one text', () => {
    expect(slmp(0xc059)).toMatchObject({ answer: true })
    expect(slmp(0x7601)).toMatchObject({
      answer: false,
      exact: true,
      where: [expect.stringContaining('SD8500')],
      meaning: expect.stringContaining('inverter does not respond'),
    })
    expect(slmp(0xc06f)).toMatchObject({ answer: false })
    expect(slmp(0x7143, { language: 'zh-CN' })?.where).toEqual([
      expect.stringContaining('NAK'),
      expect.stringContaining('SD8500'),
    ])
    for (const code of [0x3e30, 0x3e3f, 0x3e42]) expect(slmp(code)).toEqual(slmp(0x3e30))
    expect(slmp(0x3e43)).toBeUndefined()
    expect(slmp(0x4fff)).toMatchObject({ exact: false, where: [], answer: true })
  })

  test('errors of an inverter are put together as the manual lists them', () => {
    expect(slmp(0x7640)?.meaning).toContain('send data 1 was refused (mode error)')
    expect(slmp(0x7645)?.meaning).toContain('send data 2 was refused (data range error)')
    expect(slmp(0x764b)?.meaning).toContain('send data 1 (instruction code error) and send data 2 (data range error)')
    expect(slmp(0x764d, { language: 'ja' })?.meaning).toContain(
      '送信データ1はデータ範囲エラー、送信データ2は命令コードエラー',
    )
    for (const { code, meaning } of entries) expect([code, meaning.join().includes('{')]).toEqual([code, false])
  })

  test('each language gives its own text; English is the default', () => {
    const texts = languages.map((language) => slmp(0xc059, { language })?.meaning)
    expect(new Set(texts).size).toBe(4)
    expect(slmp(0xc059)?.meaning).toBe('This module does not have the command or subcommand.')
    expect(slmp(0xc059, { language: 'zh-TW' })?.meaning).toContain('子指令')
  })

  test('what only registers hold is about nothing an error could say', () => {
    expect(slmp(0x7601)?.about).toBe('unknown')
    expect(slmp(0x4fff)?.about).toBe('unknown')
  })

  test('a command adds the likely cause, where one is known', () => {
    expect(slmp(0xc059)).not.toHaveProperty('cause')
    expect(slmp(0xc059, { command: 'executeMonitor' })?.cause).toContain('Read Random')
    expect(slmp(0xc059, { command: 'readBlock' })?.cause).toContain('E71')
    expect(slmp(0xc059, { command: 'readWords' })).not.toHaveProperty('cause')
    expect(slmp(0x408b, { command: 'remoteReset', language: 'ja' })?.cause).toContain('リモートリセット')
  })

  test('hints are about codes with a text and commands that exist', () => {
    for (const { code, commands: names } of endCodeHints) {
      expect(entries.map((entry) => entry.code)).toContain(code)
      for (const name of names) expect(Object.keys(commands)).toContain(name)
    }
  })

  test('a code without a text in a known range names the module that reported it', () => {
    expect(slmp(0x4fff)).toMatchObject({
      exact: false,
      about: 'unknown',
      meaning: expect.stringContaining('CPU module'),
    })
    expect(slmp(0xc0ff)).toMatchObject({ exact: false, meaning: expect.stringContaining('Ethernet') })
    expect(slmp(0xd123, { language: 'zh-CN' })).toMatchObject({
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
      expect(library.explainEndCode(0xc059, { family: 'slmp' })?.exact).toBe(true)
      expect(library.explainEndCode(0x7601, { family: 'slmp' })?.exact).toBe(true)
      expect(library.endCodes('slmp').length).toBeGreaterThan(380)
    })
    jest.dontMock('../../src/melsec/end-codes/tables')
    expect(loads).toBe(1)
  })

  test('a code nobody knows is undefined', () => {
    for (const code of [0x0001, 0x0400, 0x5000, 0x9999, 0xafff]) expect(slmp(code)).toBeUndefined()
  })
})

describe('what an end code is about', () => {
  const answered = (family: MelsecEndCodeFamily) =>
    endCodes(family)
      .map(({ code }) => code)
      .filter((code) => code !== 0 && placesOf(family, code).some(({ answer }) => answer))

  test.each(melsecEndCodeFamilies)(
    '%s: it is said of every code that answers carry and that has a text, once',
    (family) => {
      const tables = Object.values(endCodeTables[family].about).flatMap((codes) => each(codes))
      expect(tables.filter((code, index) => tables.indexOf(code) !== index)).toEqual([])
      // 5BH says that another code follows, which says why.
      const silent = answered(family).filter((code) => factsOf[family].about(code) === 'unknown')
      expect(silent).toEqual(family === '1E' ? [0x5b] : [])
      expect(sorted(tables).filter((code) => explainEndCode(code, { family })?.exact !== true)).toEqual([])
      const perhaps = each(endCodeTables[family].perhapsCarriedOut)
      expect(perhaps.filter((code) => !tables.includes(code))).toEqual([])
    },
  )

  test('is the same as its remedy says', () => {
    for (const family of melsecEndCodeFamilies) {
      for (const { code, remedy } of endCodes(family)) {
        if (!answered(family).includes(code)) continue
        const { about } = explainEndCode(code, { family }) ?? {}
        if (remedy === 'correctDevice') expect([code.toString(16), about]).toEqual([code.toString(16), 'item'])
        if (remedy === 'lessPoints') expect([code.toString(16), about]).toEqual([code.toString(16), 'size'])
        if (remedy === 'unlockPassword') expect([code.toString(16), about]).toEqual([code.toString(16), 'state'])
        expect(endCodeAbouts).toContain(about)
      }
    }
  })

  test('a write is refused when the code says so; when somebody on the way waited in vain nobody knows', () => {
    const { writeWords, readWords } = commands
    expect(factsOf.slmp.refusal(writeWords, 0xc056)).toEqual({
      command: 'Write (word units)',
      commandName: 'writeWords',
      about: 'item',
      carriedOut: false,
    })
    // No answer of the target; a module on the way; a code nobody knows.
    for (const code of [0xc1a2, 0xc05e, 0x4b00, 0xd123]) {
      expect([code, factsOf.slmp.refusal(writeWords, code)]).toEqual([
        code,
        expect.not.objectContaining({ carriedOut: expect.anything() }),
      ])
      expect([code, factsOf.slmp.refusal(readWords, code)]).toEqual([
        code,
        expect.objectContaining({ carriedOut: false }),
      ])
    }
    expect(factsOf['1E'].refusal(writeWords, 0x60)).not.toHaveProperty('carriedOut')
  })
})

describe('a number that several families have', () => {
  test('means what it means in its own', () => {
    expect(explainEndCode(0x06, { family: '1C' })?.meaning).toContain('Character area error')
    expect(explainEndCode(0x06, { family: '1E' })).toBeUndefined()
    expect(explainEndCode(0x06, { family: 'slmp' })).toBeUndefined()
    expect(explainEndCode(0x50, { family: '1E' })?.meaning).toContain('subheader')
    expect(explainEndCode(0x50, { family: 'slmp' })).toBeUndefined()
    expect(explainEndCode(0xc056, { family: '1E' })).toBeUndefined()
    // The ranges of the modules have four digits.
    expect(explainEndCode(0xc0ff, { family: '1C' })).toBeUndefined()
  })

  test('all its meanings, for whoever does not know where it is from', () => {
    expect(meaningsOfEndCode(0x10).map(({ family }) => family)).toEqual(['1E', '1C', 'jw'])
    expect(meaningsOfEndCode(0x55, { language: 'ja' }).map(({ family }) => family)).toEqual(['slmp', '1E'])
    expect(meaningsOfEndCode(0xc056)).toEqual([slmp(0xc056)])
    expect(meaningsOfEndCode(0x9999)).toEqual([])
  })

  test('of a JW has no text of MELSEC', () => {
    const refused = new EndCodeError(0x10, 'refused', { family: 'jw' })
    expect(explainEndCode(refused)).toMatchObject({ family: 'jw', meaning: 'The write mode does not allow it.' })
    // 05H is a code of other models; of MELSEC 55H is one of 1E.
    expect(explainEndCode(0x05, { family: 'jw' })).toBeUndefined()
    expect(explainEndCode(0x55, { family: 'jw' })).toBeUndefined()
  })

  test('an error says by itself whose it is, which command got it, and what is behind it', () => {
    const told = explainEndCode(new EndCodeError(0xc059, 'm', { family: 'slmp', commandName: 'executeMonitor' }))
    expect(told).toEqual(slmp(0xc059, { command: 'executeMonitor' }))
    const behind = explainEndCode(new EndCodeError(0x5b, 'm', { family: '1E', abnormalCode: 0x18 }), { language: 'ja' })
    const reason = explainEndCode(0x18, { family: '1E', language: 'ja' })
    expect(behind).toMatchObject({ remedy: reason?.remedy, about: 'state' })
    expect(behind?.meaning).toContain(reason?.meaning)
  })

  test('without its family it is not guessed', () => {
    const untyped = explainEndCode as (code: number, options?: object) => unknown
    for (const options of [undefined, {}, { family: 'melsec' }])
      expect(() => untyped(0x10, options)).toThrow(RequestError)
  })
})
