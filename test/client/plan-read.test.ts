import { describe, expect, test } from '@jest/globals'
import { planRead } from '../../src/client/plan/read'
import type { RequestDescription } from '../../src/client/plan/request'
import type { DataCode } from '../../src/codec/codec'
import type { ProfileId, ProfileOverrides } from '../../src/melsec/profiles/profile'
import { items, protocolOf } from './plan-plc'

function range(count: number, text: (i: number) => string): string[] {
  return Array.from({ length: count }, (_, i) => text(i))
}

interface Setting {
  readonly profile?: ProfileId
  readonly code?: DataCode
  readonly gap?: number
  readonly overrides?: ProfileOverrides
}

function requestsFor(texts: readonly string[], setting: Setting = {}): readonly RequestDescription[] {
  const protocol = protocolOf(setting.profile ?? 'iq-r', setting.code, setting.overrides)
  const plan = planRead(items(protocol, texts), protocol, { gap: setting.gap ?? 64 })
  const bad = texts.filter((_, i) => plan.errorOf(i) !== undefined)
  expect(bad).toEqual([])
  return plan.describe().requests
}

function texts(texts: readonly string[], setting?: Setting): string[] {
  return requestsFor(texts, setting).map(({ text }) => text)
}

describe('words', () => {
  test('in a row are one Read', () => {
    expect(texts(['D100', 'D101', 'D102:REAL'])).toEqual(['Read (word units): D100 to D103, 4 points'])
  })

  test('that lie near one another are one Read, as far as the gap allows', () => {
    expect(texts(['D0', 'D65'])).toEqual(['Read (word units): D0 to D65, 66 points'])
    expect(texts(['D0', 'D66'])).toEqual(['Read Random: 2 words, 0 double words'])
    expect(texts(['D0', 'D5'], { gap: 3 })).toEqual(['Read Random: 2 words, 0 double words'])
  })

  test('of different devices, in ordinary numbers, share a Read Random', () => {
    expect(texts(['D0', 'W0', 'TN5', 'D1000:REAL'])).toEqual(['Read Random: 3 words, 1 double word'])
  })

  test.each<[ProfileId, DataCode, number]>([
    ['iq-r', 'binary', 960],
    ['iq-r', 'ascii', 960],
    ['iq-f', 'binary', 960],
    ['iq-f', 'ascii', 480],
    ['q', 'binary', 960],
    ['l', 'ascii', 960],
    ['generic', 'binary', 960],
    ['generic', 'ascii', 480],
  ])('%s %s: a Read carries %i', (profile, code, most) => {
    const points = (count: number) => requestsFor([`D0[${count}]`], { profile, code }).map((request) => request.points)
    expect(points(most - 1)).toEqual([most - 1])
    expect(points(most)).toEqual([most])
    expect(points(most + 1)).toEqual([most, 1])
  })

  test('a thousand in a row are two Reads', () => {
    expect(texts(range(1000, (i) => `D${i}`))).toEqual([
      'Read (word units): D0 to D959, 960 points',
      'Read (word units): D960 to D999, 40 points',
    ])
  })

  test.each<[ProfileId, DataCode, number]>([
    ['iq-f', 'binary', 1],
    ['iq-f', 'ascii', 2],
    ['q', 'binary', 1],
    ['l', 'ascii', 1],
    ['iq-r', 'binary', 2],
    ['generic', 'binary', 1],
    ['generic', 'ascii', 2],
  ])('%s %s: a hundred scattered ones are %i request(s)', (profile, code, requests) => {
    const found = requestsFor(
      range(100, (i) => `D${75 * i}`),
      { profile, code },
    )
    expect(found).toHaveLength(requests)
    expect(found.flatMap((request) => request.items)).toHaveLength(100)
  })

  test.each<[ProfileId, DataCode, number]>([
    ['iq-r', 'binary', 96],
    ['q', 'binary', 192],
    ['iq-f', 'binary', 192],
    ['iq-f', 'ascii', 96],
  ])('%s %s: a Read Random carries %i points', (profile, code, most) => {
    const points = (count: number) =>
      requestsFor(
        range(count, (i) => `${i % 2 === 0 ? 'D' : 'R'}${100 * (i >> 1)}`),
        { profile, code, gap: 0 },
      ).map((request) => request.points)
    expect(points(most - 1)).toEqual([most - 1])
    expect(points(most)).toEqual([most])
    expect(points(most + 1)).toHaveLength(2)
    expect(points(2 * most)).toEqual([most, most])
  })
})

describe('bits', () => {
  test('are read in the words they are in, from a multiple of 16 on', () => {
    expect(texts(['M5'])).toEqual(['Read (word units): M0 to M15, 1 point'])
    expect(texts(['M15', 'M16'])).toEqual(['Read (word units): M0 to M31, 2 points'])
    expect(texts(['X1F'])).toEqual(['Read (word units): X10 to X1F, 1 point'])
    expect(texts(['X17'], { profile: 'iq-f' })).toEqual(['Read (word units): X0 to X17, 1 point'])
  })

  test('78 clustered ones are one Read of five or six words', () => {
    expect(texts(range(78, (i) => `M${i + 5}`))).toEqual(['Read (word units): M0 to M95, 6 points'])
    expect(texts(range(78, (i) => `M${i + 16}`))).toEqual(['Read (word units): M16 to M95, 5 points'])
  })

  test('of long counters are read in bit units', () => {
    expect(texts(['LCS3', 'LCS5'])).toEqual(['Read (bit units): LCS3 to LCS5, 3 points'])
  })

  test('of long timers are in the third word of their record', () => {
    expect(texts(['LTS3', 'LTC5'])).toEqual(['Read (word units): LTN3 to LTN5, 12 points'])
  })

  test('of a timer are no part of a Read Random on iQ-F', () => {
    expect(texts(['TS0', 'CC0'], { profile: 'iq-f' })).toEqual(['Read Block: 0 word blocks, 2 bit blocks, 2 points'])
    const overrides = { lacks: { readBlock: true } }
    expect(texts(['TS0', 'CC0'], { profile: 'iq-f', overrides })).toEqual([
      'Read (word units): TS0 to TS15, 1 point',
      'Read (word units): CC0 to CC15, 1 point',
    ])
  })
})

describe('devices of two words', () => {
  test('are double words of a Read Random', () => {
    expect(texts(['LZ1'])).toEqual(['Read Random: 0 words, 1 double word'])
    expect(texts(['LCN3', 'LZ1', 'D0', 'LTN500'])).toEqual(['Read Random: 1 word, 3 double words'])
  })

  test('LTN with its contact is one record', () => {
    expect(texts(['LTN3', 'LTS3'])).toEqual(['Read (word units): LTN3, 4 points'])
  })

  test('an array of long timers is read in whole records', () => {
    expect(requestsFor(['LTN0[240]']).map(({ points }) => points)).toEqual([960])
    expect(requestsFor(['LTN0[241]'])).toHaveLength(2)
  })

  test('on iQ-F only Read Random has them, in the form that can say them', () => {
    expect(requestsFor(['LCN3', 'D0'], { profile: 'iq-f' })).toMatchObject([
      { command: 'readRandom', form: 'extendedLong', subcommand: 0x0082, items: ['LCN3'] },
      { command: 'readWords', form: 'short', subcommand: 0x0000, items: ['D0'] },
    ])
    expect(requestsFor(['LZ1'], { profile: 'iq-f' })).toMatchObject([{ command: 'readRandom', form: 'short' }])
  })
})

describe('extended addresses', () => {
  test('never share a request with ordinary ones', () => {
    const found = requestsFor(['D0', 'U3\\G100', 'D1000', 'J1\\W10', 'D5Z2'])
    expect(found.map((request) => request.items)).toEqual([
      ['D0', 'D1000'],
      ['U3\\G100', 'J1\\W10', 'D5Z2'],
    ])
  })

  test('in a row are one Read', () => {
    expect(texts(['U3\\G100', 'U3\\G101:REAL', 'U3\\G103'])).toEqual([
      'Read (word units): U3\\G100 to U3\\G103, 4 points',
    ])
  })

  test('of buffer memories and direct inputs are never read in vain', () => {
    expect(texts(['U3\\G100', 'U3\\G102'])).toEqual(['Read Random: 2 words, 0 double words'])
    expect(texts(['DX0', 'DX20'])).toEqual(['Read Random: 2 words, 0 double words'])
    expect(texts(['J1\\W100', 'J1\\W102'])).toEqual(['Read (word units): J1\\W100 to J1\\W102, 3 points'])
  })

  test('with an index or @ are read by Read Random only', () => {
    expect(texts(['D100Z2'])).toEqual(['Read Random: 1 word, 0 double words'])
    expect(texts(['D100Z2', 'D101Z2', '@D0:REAL'])).toEqual(['Read Random: 2 words, 1 double word'])
    expect(texts(['M0Z1[20]'])).toEqual(['Read Random: 0 words, 1 double word'])
  })

  test('count double where the manual says so', () => {
    const indexed = (count: number) => range(count, (i) => `D${i}Z1`)
    expect(requestsFor(indexed(96), { profile: 'q' })).toHaveLength(1)
    expect(requestsFor(indexed(97), { profile: 'q' })).toHaveLength(2)
    expect(requestsFor(indexed(48), { profile: 'iq-f', code: 'ascii' })).toHaveLength(1)
    expect(requestsFor(indexed(49), { profile: 'iq-f', code: 'ascii' })).toHaveLength(2)
  })
})

describe('Read Block', () => {
  const scattered = range(30, (i) => `D${i * 200}:INT[5]`)

  test('is taken where it needs fewer requests than Read Random', () => {
    // 30 runs of 5 words: 90 points of Read Random, 30 blocks of 150 words
    const more = [...scattered, 'M0', 'X0', 'W0:INT[300]']
    expect(texts(more)).toEqual(['Read Block: 31 word blocks, 2 bit blocks, 452 points'])
  })

  test('is never chosen where not every CPU of the family has it', () => {
    const commands = requestsFor([...scattered, 'W0:INT[300]'], { profile: 'q' }).map(({ command }) => command)
    expect(commands).not.toContain('readBlock')
    const overrides = { lacks: { readBlock: false } }
    expect(requestsFor([...scattered, 'W0:INT[300]'], { profile: 'q', overrides })).toHaveLength(1)
  })

  test.each<[ProfileId, number]>([
    ['iq-r', 60],
    ['iq-f', 120],
  ])('%s: it carries %i blocks', (profile, most) => {
    // Runs of 7 words: 4 points each, so that Read Random needs more requests.
    const blocks = (count: number) =>
      requestsFor(
        range(count, (i) => `D${i * 50}:INT[7]`),
        { profile, gap: 0 },
      )
    expect(blocks(most).map(({ text }) => text)).toEqual([
      `Read Block: ${most} word blocks, 0 bit blocks, ${7 * most} points`,
    ])
    expect(blocks(most + 1)).toHaveLength(2)
  })

  test('a block and a large Read share what fits', () => {
    expect(texts(['D0:INT[900]', 'W0:INT[60]', 'R0:INT[200]'])).toHaveLength(2)
  })
})

describe('profiles that lack commands', () => {
  test('without Read Random and Read Block everything is a Read', () => {
    const overrides = { lacks: { readRandom: true, readBlock: true } }
    expect(texts(['D0', 'D1000', 'M3'], { overrides })).toEqual([
      'Read (word units): D0, 1 point',
      'Read (word units): D1000, 1 point',
      'Read (word units): M0 to M15, 1 point',
    ])
  })

  test('own limits are kept', () => {
    const overrides = { limits: { readWords: 100, readRandom: 3 }, lacks: { readBlock: true } }
    expect(requestsFor(['D0[250]'], { overrides }).map(({ points }) => points)).toEqual([100, 100, 50])
    const found = requestsFor(
      range(7, (i) => `D${i * 500}`),
      { overrides },
    )
    expect(found.map(({ points }) => points)).toEqual([3, 3, 1])
    expect(
      requestsFor(['D0[250]'], { overrides: { limits: { readWords: 100, readBlock: { points: 240 } } } }),
    ).toHaveLength(2)
  })
})

describe('a value is never torn', () => {
  test('in silence: an array is cut between two values and says so', () => {
    const protocol = protocolOf('iq-r')
    const plan = planRead(items(protocol, ['D0:LREAL[241]']), protocol, { gap: 64 })
    expect(plan.describe().requests.map(({ points }) => points)).toEqual([960, 4])
    expect(plan.describe().notes).toEqual([
      'D0:LREAL[241] is read by 2 requests: its values may be of different moments.',
    ])
  })

  test('at the end of a full request: it goes into the next one as a whole', () => {
    const texts = ['D0:INT[958]', 'D958:LREAL']
    expect(requestsFor(texts).map((request) => [request.points, request.items])).toEqual([
      [958, ['D0:INT[958]']],
      [4, ['D958:LREAL']],
    ])
  })

  test('a text that no request can carry is refused', () => {
    const protocol = protocolOf('iq-r')
    const plan = planRead(items(protocol, ['D0:STRING(1920)', 'D0:STRING(1922)']), protocol, { gap: 64 })
    expect(plan.errorOf(0)).toBeUndefined()
    expect(plan.errorOf(1)).toMatchObject({ code: 'LIMIT_EXCEEDED' })
    expect(plan.describe().requests.map(({ points }) => points)).toEqual([960])
  })

  test('in an array of bits that begins within a word', () => {
    expect(requestsFor(['M5[15355]']).map(({ points }) => points)).toEqual([960])
    expect(requestsFor(['M5[15356]']).map(({ points }) => points)).toEqual([960, 1])
  })

  test('in an array of digits that do not end on words', () => {
    const found = requestsFor(['K3M0[1281]'])
    expect(found.map(({ points }) => points)).toEqual([960, 1])
  })
})

describe('what cannot be asked for', () => {
  test('keeps its error, and the others are read', () => {
    const protocol = protocolOf('q')
    const given = ['D0', 'NONSENSE', 'LTN0', 'U3E0\\G0', 'D1']
    const plan = planRead(items(protocol, given), protocol, { gap: 64 })
    expect(given.map((_, i) => plan.errorOf(i)?.code)).toEqual([
      undefined,
      'BAD_ADDRESS',
      'UNSUPPORTED',
      'UNSUPPORTED',
      undefined,
    ])
    expect(plan.describe().requests.map(({ text }) => text)).toEqual(['Read (word units): D0 to D1, 2 points'])
    expect(plan.describe().notes).toHaveLength(3)
  })

  test('because of a number the form cannot carry', () => {
    const protocol = protocolOf('q')
    const plan = planRead(items(protocol, ['ZR16777215', 'ZR16777216', 'D0']), protocol, { gap: 64 })
    expect(plan.errorOf(0)).toBeUndefined()
    expect(plan.errorOf(1)).toMatchObject({ code: 'OUT_OF_RANGE' })
    expect(plan.errorOf(1)?.message).toContain('ZR16777216')
  })

  test('a gap that is no number of words', () => {
    const protocol = protocolOf('q')
    expect(() => planRead([], protocol, { gap: -1 })).toThrow(/gap/)
    expect(() => planRead([], protocol, { gap: Number.NaN })).toThrow(/gap/)
  })

  test('nothing at all is no request', () => {
    expect(requestsFor([])).toEqual([])
  })
})

test('the description counts the bytes of whole frames', () => {
  expect(requestsFor(['D100:REAL'])).toEqual([
    {
      command: 'readWords',
      form: 'long',
      subcommand: 0x0002,
      points: 2,
      // 3E binary: 9 + timer 2 + command 4 + device 6 + points 2; 9 + end code 2 + 2 words
      requestBytes: 23,
      responseBytes: 15,
      items: ['D100:REAL'],
      text: 'Read (word units): D100 to D101, 2 points',
    },
  ])
})

test('a plan as text is a line for each request, then the notes', () => {
  const protocol = protocolOf('q')
  const plan = planRead(items(protocol, ['D0', 'M0', 'LTN0']), protocol, { gap: 64 })
  expect(plan.toString().split('\n')).toEqual([
    '1. Read Random: 2 words, 0 double words (25 bytes out, 15 in) for D0, M0',
    expect.stringMatching(/^LTN0 is not read\. .*no device LTN/),
  ])
})
