// Addresses as people type them, with the answer each gets.
import { describe, expect, test } from '@jest/globals'
import { createPlcSimulator } from '../../src/entry/simulator'
import { createMelsecClient, RequestError } from '../../src/index'

type ProfileId = 'iq-r' | 'iq-f' | 'q' | 'fx3'

function clientOf(profile: ProfileId) {
  return createMelsecClient({ host: 'nowhere', port: 1, profile })
}

const clients = new Map((['iq-r', 'iq-f', 'q', 'fx3'] as const).map((profile) => [profile, clientOf(profile)]))

/** Our spelling of it, or why it is refused. */
function answerTo(text: string, profile: ProfileId): string {
  try {
    const explanation = clients.get(profile)?.explain(text)
    if (explanation === undefined) throw new Error(`no client of ${profile}`)
    return 'label' in explanation ? `label ${explanation.label}` : explanation.text
  } catch (error) {
    if (!(error instanceof RequestError)) throw error
    return `refused: ${error.message}`
  }
}

describe('taken as it was meant', () => {
  test.each([
    ['D100', 'D100'],
    ['d0100', 'D100'],
    [' D100 ', 'D100'],
    ['D100,10', 'D100[10]'],
    ['D100, 10', 'D100[10]'],
    ['X0,16', 'X0[16]'],
    ['M0,1', 'M0[1]'],
    ['K4M0,3', 'K4M0[3]'],
    ['D100[10]', 'D100[10]'],
    ['M0..M15', 'M0[16]'],
    ['D100.F', 'D100.F'],
    ['D100:REAL', 'D100:REAL'],
    ['D100:FLOAT [Single Precision]', 'D100:REAL'],
    ['D100:FLOAT[Single Precision]', 'D100:REAL'],
    ['D100:Word [Unsigned]/Bit String [16-bit]', 'D100:WORD'],
    ['D100:Word [Unsigned]', 'D100:WORD'],
    ['D100:ワード[符号付き]', 'D100'],
    ['D100:ワード［符号付き］', 'D100'],
    ['D100:ワード[符号なし]/ビット列[16ビット]', 'D100:WORD'],
    ['D100:ダブルワード[符号付き]', 'D100:DINT'],
    ['D100:ダブルワード[符号なし]/ビット列[32ビット]', 'D100:DWORD'],
    ['D100:単精度実数', 'D100:REAL'],
    ['D100:倍精度実数[2]', 'D100:LREAL[2]'],
    ['D100:時間', 'D100:TIME'],
    ['D100:文字列(20)', 'D100:STRING(20)'],
    ['D100:文字列[Unicode](20)', 'D100:WSTRING(20)'],
    ['M0:ビット', 'M0'],
    ['M0:位', 'M0'],
    ['D100:字[有符号]', 'D100'],
    ['D100:双字[有符号]', 'D100:DINT'],
    ['D100:双字[无符号]/位列[32位]', 'D100:DWORD'],
    ['D100:单精度实数', 'D100:REAL'],
    ['D100:双精度实数', 'D100:LREAL'],
    ['D100:字符串(10)', 'D100:STRING(10)'],
    ['D100:單精度實數', 'D100:REAL'],
    ['D100:雙字[有符號]', 'D100:DINT'],
  ])('%s is %s', (text, meant) => {
    for (const profile of ['iq-r', 'iq-f', 'q'] as const) expect(answerTo(text, profile)).toBe(meant)
  })
})

describe('refused with what it may have meant', () => {
  test.each([
    ['D552, D553', ["['D552', 'D553']"]],
    ['D552,D553,D554', ['3 items']],
    ['D552，D553', ["['D552', 'D553']"]],
    ['M0,M1', ["['M0', 'M1']"]],
    ['M0;M1', ["['M0', 'M1']"]],
    ['D100 D102', ["['D100', 'D102']"]],
    ['D552,', ['write D552.']],
    ['D100,bit3', ['D100.3']],
    ['D100.bit12', ['D100.C']],
    ['D100.3,5', ['D100.3[5]', 'D100.5']],
    ['D100,1F', ['behind a comma']],
    ['DINT100', ['D100:INT (device D, type INT)', 'D100:DINT (type DINT)']],
    ['DWORD100', ['D100:WORD (', 'D100:DWORD (']],
    ['DDINT100', ['D100:DINT.']],
    ['DREAL100', ['D100:REAL.']],
    ['LREAL100', ['D100:LREAL.']],
    ['WORD100', ['D100:WORD.']],
    ['REALD100', ['D100:REAL.']],
    ['REAL D100', ['D100:REAL.']],
    ['D100 REAL', ['D100:REAL.']],
    ['D100.REAL', ['D100:REAL.']],
    ['BOOLM0', ['M0:BOOL.']],
    ['DSTR200,20', ['D200:STRING(20)']],
    ['DREAL100,4', ['D100:REAL[4]']],
    ['D100~D109', ['D100..D109']],
    ['D100～D109', ['D100..D109']],
    ['D100〜D109', ['D100..D109']],
    ['D100-109', ['D100..D109']],
    ['D100-D109', ['D100..D109']],
    ['D100~D109:INT', ['D100..D109:INT']],
    ['M0-M15', ['M0..M15']],
    ['M0:M15', ['M0..M15']],
    ['M0 to M15', ['M0..M15']],
    ['M0…M15', ['M0..M15']],
    ['D0..9', ['D0..D9']],
    ['TN0-5', ['TN0..TN5']],
    ['SB10-1F', ['SB10..SB1F']],
    ['D100.0-F', ['D100.0..D100.F']],
    ['D100:STR,10', ['D100:STRING(10)']],
    ['D100:STRING10', ['D100:STRING(10)']],
    ['D100:S20', ['D100:STRING(20)']],
    ['D100:INT,10', ['D100:INT[10]']],
    ['D100:F,4', ['D100:REAL[4]']],
    ['D100:F', ['REAL']],
    ['D100,REAL', ['D100:REAL.']],
    ['D100,INT,4', ['D100:INT[4]']],
    ['D100:UINT8', ['not a type']],
    ['D100:STRING[20]', ['STRING(20)']],
    ['D100:3', ['D100.3 or D100[3]']],
    ['D100[10]:REAL', ['D100:REAL[10]']],
    ['D100(10)', ['D100[10]']],
    ['D100.0F', ['D100.F']],
    ['D100.15', ['.F']],
    ['D100.16H', ['D100:STRING(16)']],
    ['D100.10L', ['D100:STRING(10)']],
    ['SN5', ['STN5']],
    ['SS5', ['STS5']],
    ['SC5', ['STC5']],
    ['T5', ['TS5', 'TC5', 'TN5']],
    ['D*000100', ['write D100.']],
    ['M*000100', ['write M100.']],
    ['D 100', ['write D100.']],
    ['Ｄ１００', ['write D100']],
    ['D100H', ['D100 or D256']],
    ['W1FH', ['write W1F.']],
    ['G100', ['U3\\G100']],
    ['40001', ['A number alone']],
    ['MW10', ['Siemens']],
    ['%MW10', ['IEC']],
    ['FX0', ['function devices']],
  ])('%s', (text, parts) => {
    for (const profile of ['iq-r', 'iq-f', 'q'] as const) {
      const answer = answerTo(text, profile)
      expect(answer).toMatch(/^refused: /)
      for (const part of parts) expect(answer).toContain(part)
    }
  })

  test.each([
    ['iq-r', 'X0-1F', 'X0..X1F'],
    ['iq-f', 'X0-17', 'X0..X17'],
    ['iq-f', 'X*000017', 'X17'],
    ['iq-r', 'J1.W10', 'J1\\W10'],
  ] as const)('on %s: %s', (profile, text, meant) => {
    const answer = answerTo(text, profile)
    expect(answer).toMatch(/^refused: /)
    expect(answer).toContain(meant)
  })

  test('a reading that this PLC does not have is not named', () => {
    expect(answerTo('X0-1F', 'iq-f')).not.toContain('X0..X1F')
  })
})

describe('nothing mistyped is sent as a label of an iQ-R', () => {
  test.each([
    ['U3.G100', 'U3\\G100'],
    ['U3G100', 'U3\\G100'],
    ['U3E0.HG100', 'U3E0\\HG100'],
    ['J1W10', 'J1\\W10'],
    ['XFFFH', 'XFFF'],
    ['BEACH', 'label:BEACH'],
    ['DINT100', 'label:DINT100'],
  ])('%s', (text, part) => {
    const answer = answerTo(text, 'iq-r')
    expect(answer).toMatch(/^refused: /)
    expect(answer).toContain(part)
  })

  test.each(['Speed', 'Line1.Speed', 'D100_Speed', '速度', 'Values[3]'])('%s still is one', (text) => {
    expect(answerTo(text, 'iq-r')).toMatch(/^label /)
  })
})

test.each(['C220', 'CN220', 'C220:DINT'])('%s of an FX3 leads to LCN20 at once', (text) => {
  expect(answerTo(text, 'fx3')).toBe(
    `refused: "${text}": C200 to C255 are counters of 32 bits: write LCN20 (current value) or LCS20 (contact).`,
  )
  expect(answerTo('LCN20', 'fx3')).toBe('LCN20')
  expect(answerTo('CN199', 'fx3')).toBe('CN199')
})

test('a list entry that is no item is named by its place', async () => {
  const simulator = createPlcSimulator({ profile: 'q' })
  const plc = createMelsecClient({ host: 'x', port: 1, profile: 'q', openTransport: simulator.connect() })
  // What a program without types may pass.
  const items: unknown = ['D100', 5, null, {}]
  const results = await plc.read(items as string[])
  expect(results.map(({ item }) => item)).toEqual(['D100', 'items[1]', 'items[2]', 'items[3]'])
  expect(results.map((result) => (result.ok ? 'ok' : result.error.message.split(':')[0]))).toEqual([
    'ok',
    'items[1] is 5',
    'items[2] is null',
    'items[3] is a value of type object',
  ])
  await plc.close()
  await simulator.close()
})
