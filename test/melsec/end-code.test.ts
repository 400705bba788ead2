import { describe, expect, test } from '@jest/globals'
import { commands } from '../../src/melsec/commands/commands'
import { endCodes, explainEndCode, languages } from '../../src/melsec/end-code'
import { endCodeGroups } from '../../src/melsec/end-codes/groups'
import { endCodeHints } from '../../src/melsec/end-codes/hints'
import { remedies } from '../../src/melsec/end-codes/remedies'

/** Characters that exist in one of the two Chinese scripts only, as far as these texts could need them. */
const SIMPLIFIED_ONLY =
  /[软号错请认连访问数设备据执检编码读写时间单图块无锁径网络协议远现响应输关闭变动态储务为对与过发]/
const TRADITIONAL_ONLY = /[軟號錯請認連訪問數據設備執檢編碼讀寫時間單圖塊無鎖徑網絡協議遠現響應輸關閉變動態儲務體與並]/
const KANA = /[ぁ-んァ-ヶ]/

const allTexts = [
  ...endCodes.map(({ code, meaning }) => [`meaning of ${code.toString(16)}`, meaning] as const),
  ...endCodes.flatMap(({ code, remedy }) =>
    typeof remedy === 'string' ? [] : [[`remedy of ${code.toString(16)}`, remedy] as const],
  ),
  ...Object.entries(remedies),
  ...endCodeGroups.map(({ from, meaning }) => [`group ${from.toString(16)}`, meaning] as const),
  ...endCodeHints.map(({ code, cause }) => [`hint of ${code.toString(16)}`, cause] as const),
]

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
    const codes = endCodes.map(({ code }) => code)
    expect(codes.filter((code, index) => codes.indexOf(code) !== index)).toEqual([])
    for (const { source } of [...endCodes, ...endCodeGroups, ...endCodeHints]) expect(source).not.toBe('')
  })

  test.each([
    [
      'SLMP 3E of the FX5 CPU module',
      'C035 C050 C051 C052 C053 C054 C056 C058 C059 C05B C05C C05F C060 C061 C06F C0D8 C200 C201 C204 C810 C815 C816',
    ],
    ['SLMP of the FX5 Ethernet module', 'C057 C05E C0B2 4030 4031 4032 4033 4041 4043'],
    [
      'CPU modules in general',
      '4000 4001 4002 4003 4004 4005 4008 4010 4013 4021 4022 4030 4031 4032 4033 4034 4040 4041 4042 4043 4080 408B 4A00 4B00',
    ],
    ['Q and L Ethernet', 'C055 C05A C05D C070 C071 C072 C073 C075 C0B5 C0D4 C200 C201 C202 C203 C204'],
    ['1E', '50 54 55 56 57 58 5B 60 10 11 12 18'],
    ['1C', '02 03 06 07 10 18'],
    ['3C and 4C', '7143 7164 7167 7168 7E40 7E41 7E42 7E43 7F21 7F22 7F23 7F24 7F26 7F40 7F67 7F68 7F69 7FE6'],
    [
      'Ethernet history of the FX5 CPU module',
      '1120 1134 2160 2250 C012 C013 C015 C020 C024 C025 C027 C029 C0B6 C0DE C1A2 C1AC C1AD C1AF C1B0 C1B1 C1B3 C1B4 C1BA C1C6 C1CC C1CD C1D0 C1D3 C400 C401 C404 C405 C410 C411 C417 C431 C614 CEE0 CEE1 CEE2 CF10 CF20 CF30 CF31 CF70 CF71 CFB2',
    ],
    [
      'Ethernet history of the FX5 Ethernet module',
      'C017 C04C C1A4 C1A6 C1A7 C1A8 C1B2 C709 CFB0 CFB1 CFB3 CFB4 CFB5 CFBF',
    ],
    ['FX5 FTP client', '41C5 41C7 41CC 41CD 41CE 41CF 41D8 41DF 41E4 41EB 41FE C616 C618 C619 C620 C621 C622'],
  ])('%s: every code has a text of its own', (_name, list) => {
    const missing = list.split(' ').filter((hex) => explainEndCode(Number.parseInt(hex, 16))?.exact !== true)
    expect(missing).toEqual([])
  })

  test('each language gives its own text; English is the default', () => {
    const texts = languages.map((language) => explainEndCode(0xc059, { language })?.meaning)
    expect(new Set(texts).size).toBe(4)
    expect(explainEndCode(0xc059)?.meaning).toBe('This module does not have the command or subcommand.')
    expect(explainEndCode(0xc059, { language: 'zh-TW' })?.meaning).toContain('子指令')
  })

  test('the codes about a device or address of one item, and only those, may be asked for one by one', () => {
    const about = endCodes.filter(({ aboutDevice }) => aboutDevice === true).map(({ code }) => code)
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
      expect(endCodes.map((entry) => entry.code)).toContain(code)
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

  test('a code nobody knows is undefined', () => {
    for (const code of [0x0001, 0x0400, 0x5000, 0x9999, 0xafff]) expect(explainEndCode(code)).toBeUndefined()
  })
})
