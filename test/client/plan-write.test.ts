import { describe, expect, test } from '@jest/globals'
import type { PlainValue } from '../../src/client/item/item-value'
import type { DataCode } from '../../src/codec/codec'
import type { ProfileId } from '../../src/melsec/profiles/profile'
import { bench, codes, type Entries, errorOf, RMW } from './plan-write-bench'

function range(count: number, text: (i: number) => string): string[] {
  return Array.from({ length: count }, (_, i) => text(i))
}

describe('requests', () => {
  test.each<[string, Entries, string[]]>([
    ['one word', [['D0', 1]], ['Write (word units): D0, 1 point']],
    [
      'words in a row',
      [
        ['D0', 1],
        ['D1:REAL', 1.5],
        ['D3', 2],
      ],
      ['Write (word units): D0 to D3, 4 points'],
    ],
    [
      'words in a row, the last first',
      [
        ['D1', 1],
        ['D0', 2],
      ],
      ['Write (word units): D0 to D1, 2 points'],
    ],
    [
      'scattered words and double words',
      [
        ['D0', 1],
        ['D2', 1],
        ['W0:REAL', 1],
        ['D10:LREAL', 1],
      ],
      ['Write Random (word units): 2 words, 3 double words'],
    ],
    [
      'bits in a row',
      [
        ['M0', true],
        ['M1[15]', Array.from({ length: 15 }, () => false)],
      ],
      ['Write (bit units): M0 to M15, 16 points'],
    ],
    [
      'scattered bits',
      [
        ['M0', true],
        ['Y10', false],
      ],
      ['Write Random (bit units): 2 bits'],
    ],
    ['K4 on a multiple of 16', [['K4M16', -1]], ['Write (word units): M16 to M31, 1 point']],
    ['K8 on a multiple of 16', [['K8M16:REAL', 1]], ['Write (word units): M16 to M47, 2 points']],
    ['K4 elsewhere', [['K4M5', -1]], ['Write (bit units): M5 to M20, 16 points']],
    ['K3', [['K3M16', 5]], ['Write (bit units): M16 to M27, 12 points']],
    ['a long counter', [['LCN5', 1]], ['Write Random (word units): 0 words, 1 double word']],
    ['many long counters', [['LCN0[100]', new Array(100).fill(7)]], ['Write (word units): LCN0 to LCN99, 200 points']],
    ['a long timer', [['LTN5', 1]], ['Write Random (word units): 0 words, 1 double word']],
    ['a long index register', [['LZ1', 1]], ['Write Random (word units): 0 words, 1 double word']],
    ['the contact of a long timer', [['LTS5', true]], ['Write Random (bit units): 1 bit']],
    ['the coil of a long counter', [['LCC5', true]], ['Write (bit units): LCC5, 1 point']],
    ['an index', [['D0Z1', 1]], ['Write Random (word units): 1 word, 0 double words']],
    ['an indexed bit', [['M0Z1', true]], ['Write Random (bit units): 1 bit']],
    ['@', [['@D0:DINT', 1]], ['Write Random (word units): 0 words, 1 double word']],
  ])('%s', (_, entries, texts) => {
    const { plan } = bench(entries)
    expect(plan.describe()).toMatchObject({ notes: [] })
    expect(plan.describe().requests.map(({ text }) => text)).toEqual(texts)
  })

  test('keep the order of the entries: the bit that starts the machine is written after its data', () => {
    const entries: Entries = [
      ['M0', false],
      ['D0', 1],
      ['D5', 2],
      ['M1', true],
    ]
    expect(bench(entries).texts()).toEqual([
      'Write (bit units): M0, 1 point',
      'Write Random (word units): 2 words, 0 double words',
      'Write (bit units): M1, 1 point',
    ])
  })

  test('of extended addresses are their own', () => {
    const entries: Entries = [
      ['D0', 1],
      ['U3\\G5', 2],
      ['J1\\W5', 2],
      ['D1', 3],
    ]
    expect(
      bench(entries)
        .plan.describe()
        .requests.map((request) => request.items),
    ).toEqual([['D0'], ['U3\\G5', 'J1\\W5'], ['D1']])
  })

  test('contacts of timers on iQ-F are written by Write, because Write Random does not take them', () => {
    const entries: Entries = [
      ['TS0', true],
      ['TS5', true],
    ]
    expect(bench(entries, { profile: 'iq-f' }).texts()).toEqual([
      'Write (bit units): TS0, 1 point',
      'Write (bit units): TS5, 1 point',
    ])
    expect(bench(entries).texts()).toEqual(['Write Random (bit units): 2 bits'])
  })

  const scatteredWords = (count: number): Entries => range(count, (i) => `D${2 * i}`).map((text) => [text, 1])
  const scatteredDoubles = (count: number): Entries => range(count, (i) => `D${3 * i}:DINT`).map((text) => [text, 1])
  const scatteredBits = (count: number): Entries => range(count, (i) => `M${2 * i}`).map((text) => [text, true])

  test.each<[ProfileId, DataCode, number, number, number]>([
    // 12 for each word, 14 for each double word: 960 or 1920 together
    ['iq-r', 'binary', 80, 68, 94],
    ['q', 'binary', 160, 137, 188],
    ['l', 'ascii', 160, 137, 188],
    ['iq-f', 'binary', 160, 137, 188],
    ['iq-f', 'ascii', 80, 68, 94],
    ['generic', 'binary', 160, 137, 188],
  ])('%s %s: Write Random carries %i words, %i double words or %i bits', (profile, code, words, doubles, bits) => {
    const points = (entries: Entries) =>
      bench(entries, { profile, code })
        .plan.describe()
        .requests.map((request) => request.points)
    for (const [make, most, rest] of [
      [scatteredWords, words, 1],
      [scatteredDoubles, doubles, 2],
      [scatteredBits, bits, 1],
    ] as const) {
      expect(points(make(most - 1))).toEqual([most - 1])
      expect(points(make(most))).toEqual([most])
      // What is left over is a row, so it is a Write: a double word is two of its points.
      expect(points(make(most + 1))).toEqual([most, rest])
    }
  })

  test('an array larger than a request is cut between two values and says so', () => {
    const { plan, texts } = bench([
      ['D5000', 1],
      ['D0:LREAL[300]', new Array(300).fill(1)],
      ['D1200', 1],
    ])
    expect(texts()).toEqual([
      'Write (word units): D5000, 1 point',
      'Write (word units): D0 to D959, 960 points',
      'Write (word units): D960 to D1199, 240 points',
      'Write (word units): D1200, 1 point',
    ])
    expect(plan.describe().notes).toEqual(['D0:LREAL[300] is written by 2 requests: the PLC may see it half written.'])
  })

  test('a text that fills a request does not share it', () => {
    const { texts } = bench([
      ['D0', 1],
      ['D1:STRING(1920)', 'x'],
    ])
    expect(texts()).toEqual(['Write (word units): D0, 1 point', 'Write (word units): D1 to D960, 960 points'])
  })
})

describe('what is wrong is found before anything is sent', () => {
  test.each<[string, PlainValue, string, string]>([
    ['D0', 40000, 'BAD_VALUE', 'INT'],
    ['D0', '5', 'BAD_VALUE', "'5'"],
    ['D0', [1], 'BAD_VALUE', 'one value, not an array'],
    ['D0[2]', 1, 'BAD_VALUE', 'an array of 2'],
    ['D0[2]', [1], 'BAD_VALUE', '2 values of INT, and 1'],
    ['M0', 1, 'BAD_VALUE', 'true or false'],
    ['M0[2]', [true, 0], 'BAD_VALUE', 'true or false'],
    ['M0[2]', new Array(2), 'BAD_VALUE', 'true or false'],
    ['D0[2]', new Array(2), 'BAD_VALUE', 'element 0'],
    ['K2M0', 256, 'BAD_VALUE', '8 bits'],
    ['K2M0', -1, 'BAD_VALUE', '8 bits'],
    ['D0:REAL', Number.NaN, 'BAD_VALUE', 'finite'],
    ['D0:STRING(2)', 'abc', 'BAD_VALUE', 'STRING(2)'],
    ['D0.3', true, 'UNSUPPORTED', 'readModifyWrite'],
    ['S0', true, 'UNSUPPORTED', 'Step relays'],
    ['D0:STRING(4000)', 'x', 'LIMIT_EXCEEDED', '2000 words'],
    ['NONSENSE', 1, 'BAD_ADDRESS', 'NONSENSE'],
  ])('%s = %p', async (text, value, code, part) => {
    const { run, plc } = bench([
      [text, value],
      ['D500', 7],
    ])
    const results = await run()
    expect(errorOf(results[0])).toMatchObject({ code, outcome: 'notSent' })
    expect(errorOf(results[0]).message).toContain(part)
    expect(errorOf(results[0]).message).toContain(text)
    // The other entry is written all the same.
    expect(results[1]).toEqual({ item: 'D500', ok: true })
    expect(plc.names).toEqual(['writeWords'])
  })

  test('the same device twice is refused for both, by name', async () => {
    const { run, plc } = bench([
      ['D0', 1],
      ['D1:DINT', 2],
      ['D0..D1', [3, 4]],
      ['D9', 5],
    ])
    const results = await run()
    expect(codes(results)).toEqual(['BAD_VALUE notSent', 'BAD_VALUE notSent', 'BAD_VALUE notSent', 'ok'])
    expect(errorOf(results[0]).message).toContain('D0 and D0..D1')
    expect(plc.names).toEqual(['writeWords'])
  })

  test.each<[string, PlainValue, string, PlainValue, boolean]>([
    ['M5', true, 'K4M0', 1, true],
    ['M16', true, 'K4M0', 1, false],
    ['D0.3', true, 'D0', 1, true],
    ['D0.3', true, 'D0.4', true, false],
    ['D0.3', true, 'D0.3', true, true],
    ['D0.0[20]', new Array(20).fill(true), 'D1.3', true, true],
    ['LTN0', 1, 'LTN1', 1, false],
    ['LTN0[2]', [1, 1], 'LTN1', 1, true],
    ['LTS0', true, 'LTN0', 1, false],
    ['U3\\G0', 1, 'U4\\G0', 1, false],
    ['D0Z1', 1, 'D0', 1, false],
    ['D0Z1', 1, 'D0Z1', 1, true],
  ])('%s = %p and %s = %p: twice is %p', async (a, x, b, y, twice) => {
    const entries: Entries = [
      [a, x],
      [b, y],
    ]
    const results = await bench(entries, RMW).run()
    expect(codes(results)).toEqual(twice ? ['BAD_VALUE notSent', 'BAD_VALUE notSent'] : ['ok', 'ok'])
  })

  test('all or nothing: one bad entry, and nothing is sent', async () => {
    const entries: Entries = [
      ['D0', 1],
      ['D1', 'bad'],
    ]
    const { run, plc } = bench(entries, { allOrNothing: true })
    expect(codes(await run())).toEqual(['ABORTED notSent', 'BAD_VALUE notSent'])
    expect(plc.seen).toEqual([])
  })
})

test('a plan as text is a line for each request, then the notes', () => {
  const { plan } = bench([
    ['D0', 1],
    ['D5', 'bad'],
  ])
  expect(plan.toString().split('\n')).toEqual([
    '1. Write (word units): D0, 1 point (25 bytes out, 11 in) for D0',
    expect.stringMatching(/^D5 is not written\. /),
  ])
})
