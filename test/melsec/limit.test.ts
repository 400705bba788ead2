import { describe, expect, test } from '@jest/globals'
import { RequestError } from '../../src/errors'
import type { DeviceForm } from '../../src/melsec/device/device-form'
import { brokenLimit, checkLimits, limitsOf, measureLimit } from '../../src/melsec/device/limit'
import type { ProfileId } from '../../src/melsec/profiles/profile'
import { profiles, resolveProfile } from '../../src/melsec/profiles/profiles'

type Message = Readonly<Record<string, unknown>>

const devices = (n: number) => Array.from({ length: n }, (_, number) => ({ device: { device: 'D', number } }))
const blocks = (n: number, points: number) => Array.from({ length: n }, () => ({ points, values: new Array(points) }))

/** Messages with n of what is counted; only what limits look at. */
const messages = {
  readWords: (n: number) => ({ points: n }),
  readBits: (n: number) => ({ points: n }),
  writeWords: (n: number) => ({ values: new Array(n) }),
  writeBits: (n: number) => ({ values: new Array(n) }),
  readRandom: (n: number) => ({ words: devices(n), doubleWords: [] }),
  entryMonitorDevice: (n: number) => ({ words: [], doubleWords: devices(n) }),
  writeRandomBits: (n: number) => ({ bits: devices(n) }),
  writeRandomWords: (n: number) => ({ words: devices(n), doubleWords: [] }),
  'writeRandomWords, double words': (n: number) => ({ words: [], doubleWords: devices(n) }),
  'readBlock, blocks': (n: number) => ({ wordBlocks: blocks(n, 1), bitBlocks: [] }),
  'readBlock, points': (n: number) => ({ wordBlocks: [], bitBlocks: blocks(1, n) }),
  'writeBlock, blocks': (n: number) => ({ wordBlocks: [], bitBlocks: blocks(n, 1) }),
  'writeBlock, points of one block': (n: number) => ({ wordBlocks: blocks(1, n), bitBlocks: [] }),
} as const satisfies Readonly<Record<string, (n: number) => Message>>

type Counted = keyof typeof messages
type Command =
  | 'readWords'
  | 'readBits'
  | 'writeWords'
  | 'writeBits'
  | 'readRandom'
  | 'entryMonitorDevice'
  | 'writeRandomBits'
  | 'writeRandomWords'
  | 'readBlock'
  | 'writeBlock'

/** [binary, ascii] maxima by form, copied by hand from the manuals' tables: SLMP 5.2, FX5 38.1. */
type Table = Readonly<Record<Counted, Readonly<Partial<Record<DeviceForm, readonly [binary: number, ascii: number]>>>>>

const iqR: Table = {
  readWords: { short: [960, 960], long: [960, 960], extendedShort: [960, 960], extendedLong: [960, 960] },
  writeWords: { short: [960, 960], long: [960, 960], extendedShort: [960, 960], extendedLong: [960, 960] },
  readBits: { short: [7168, 3584], long: [7168, 3584], extendedShort: [7168, 3584], extendedLong: [7168, 3584] },
  writeBits: { short: [7168, 3584], long: [7168, 3584], extendedShort: [7168, 3584], extendedLong: [7168, 3584] },
  readRandom: { short: [192, 192], long: [96, 96], extendedShort: [96, 96], extendedLong: [96, 96] },
  entryMonitorDevice: { short: [192, 192], long: [96, 96], extendedShort: [96, 96], extendedLong: [96, 96] },
  writeRandomBits: { short: [188, 188], long: [94, 94], extendedShort: [94, 94], extendedLong: [94, 94] },
  writeRandomWords: { short: [160, 160], long: [80, 80], extendedShort: [80, 80], extendedLong: [80, 80] },
  'writeRandomWords, double words': {
    short: [137, 137],
    long: [68, 68],
    extendedShort: [68, 68],
    extendedLong: [68, 68],
  },
  'readBlock, blocks': { short: [120, 120], long: [60, 60], extendedShort: [60, 60], extendedLong: [60, 60] },
  'readBlock, points': { short: [960, 960], long: [960, 960], extendedShort: [960, 960], extendedLong: [960, 960] },
  'writeBlock, blocks': { short: [120, 120], long: [60, 60], extendedShort: [60, 60], extendedLong: [60, 60] },
  'writeBlock, points of one block': {
    short: [956, 956],
    long: [951, 951],
    extendedShort: [952, 952],
    extendedLong: [951, 951],
  },
}

const iqF: Table = {
  readWords: { short: [960, 480], extendedShort: [960, 480], extendedLong: [960, 480] },
  writeWords: { short: [960, 480], extendedShort: [960, 480], extendedLong: [960, 480] },
  readBits: { short: [3584, 1792], extendedShort: [3584, 1792], extendedLong: [3584, 1792] },
  writeBits: { short: [3584, 1792], extendedShort: [3584, 1792], extendedLong: [3584, 1792] },
  readRandom: { short: [192, 96], extendedShort: [96, 48], extendedLong: [96, 48] },
  entryMonitorDevice: {},
  writeRandomBits: { short: [188, 94], extendedShort: [94, 47], extendedLong: [94, 47] },
  writeRandomWords: { short: [160, 80], extendedShort: [80, 40], extendedLong: [80, 40] },
  'writeRandomWords, double words': { short: [137, 68], extendedShort: [68, 34], extendedLong: [68, 34] },
  'readBlock, blocks': { short: [120, 60], extendedShort: [60, 30], extendedLong: [60, 30] },
  'readBlock, points': { short: [960, 480], extendedShort: [960, 480], extendedLong: [960, 480] },
  'writeBlock, blocks': { short: [120, 60], extendedShort: [60, 30], extendedLong: [60, 30] },
  'writeBlock, points of one block': { short: [756, 376], extendedShort: [756, 376], extendedLong: [756, 376] },
}

/** FX5 38.1, table of the Ethernet module; its own figures are in binary code, subcommand 0000. */
const fx5Enet: Table = {
  readWords: { short: [960, 480], extendedShort: [960, 480], extendedLong: [960, 480] },
  writeWords: { short: [949, 480], extendedShort: [949, 480], extendedLong: [949, 480] },
  readBits: { short: [3584, 1792], extendedShort: [3584, 1792], extendedLong: [3584, 1792] },
  writeBits: { short: [3584, 1792], extendedShort: [3584, 1792], extendedLong: [3584, 1792] },
  readRandom: { short: [123, 96], extendedShort: [96, 48], extendedLong: [96, 48] },
  entryMonitorDevice: {},
  writeRandomBits: { short: [188, 94], extendedShort: [94, 47], extendedLong: [94, 47] },
  // 18 x 109 = 1962; (12 x 80) x 2 = 1920
  writeRandomWords: { short: [109, 80], extendedShort: [80, 40], extendedLong: [80, 40] },
  // 20 x 98 = 1960
  'writeRandomWords, double words': { short: [98, 68], extendedShort: [68, 34], extendedLong: [68, 34] },
  'readBlock, blocks': { short: [120, 60], extendedShort: [60, 30], extendedLong: [60, 30] },
  'readBlock, points': { short: [960, 480], extendedShort: [960, 480], extendedLong: [960, 480] },
  'writeBlock, blocks': { short: [120, 60], extendedShort: [60, 30], extendedLong: [60, 30] },
  // 4 + 766 = 770; (4 + 381) x 2 = 770
  'writeBlock, points of one block': { short: [766, 381], extendedShort: [766, 381], extendedLong: [766, 381] },
}

const qAndL: Table = {
  readWords: { short: [960, 960], extendedShort: [960, 960] },
  writeWords: { short: [960, 960], extendedShort: [960, 960] },
  readBits: { short: [7168, 3584], extendedShort: [7168, 3584] },
  writeBits: { short: [7168, 3584], extendedShort: [7168, 3584] },
  readRandom: { short: [192, 192], extendedShort: [96, 96] },
  entryMonitorDevice: { short: [192, 192], extendedShort: [96, 96] },
  writeRandomBits: { short: [188, 188], extendedShort: [188, 188] },
  writeRandomWords: { short: [160, 160], extendedShort: [160, 160] },
  'writeRandomWords, double words': { short: [137, 137], extendedShort: [137, 137] },
  'readBlock, blocks': { short: [120, 120], extendedShort: [120, 120] },
  'readBlock, points': { short: [960, 960], extendedShort: [960, 960] },
  'writeBlock, blocks': { short: [120, 120], extendedShort: [120, 120] },
  'writeBlock, points of one block': { short: [956, 956], extendedShort: [956, 956] },
}

/** Built-in ports of QnU have no block commands. */
const qBuiltIn: Table = {
  ...qAndL,
  'readBlock, blocks': {},
  'readBlock, points': {},
  'writeBlock, blocks': {},
  'writeBlock, points of one block': {},
}

const generic: Table = {
  readWords: { short: [960, 480], long: [960, 960], extendedShort: [960, 480], extendedLong: [960, 480] },
  writeWords: { short: [960, 480], long: [960, 960], extendedShort: [960, 480], extendedLong: [960, 480] },
  readBits: { short: [3584, 1792], long: [7168, 3584], extendedShort: [3584, 1792], extendedLong: [3584, 1792] },
  writeBits: { short: [3584, 1792], long: [7168, 3584], extendedShort: [3584, 1792], extendedLong: [3584, 1792] },
  readRandom: { short: [192, 96], long: [96, 96], extendedShort: [96, 48], extendedLong: [96, 48] },
  entryMonitorDevice: { short: [192, 192], long: [96, 96], extendedShort: [96, 96], extendedLong: [96, 96] },
  writeRandomBits: { short: [188, 94], long: [94, 94], extendedShort: [94, 47], extendedLong: [94, 47] },
  writeRandomWords: { short: [160, 80], long: [80, 80], extendedShort: [80, 40], extendedLong: [80, 40] },
  'writeRandomWords, double words': {
    short: [137, 68],
    long: [68, 68],
    extendedShort: [68, 34],
    extendedLong: [68, 34],
  },
  'readBlock, blocks': { short: [120, 60], long: [60, 60], extendedShort: [60, 30], extendedLong: [60, 30] },
  'readBlock, points': { short: [960, 480], long: [960, 960], extendedShort: [960, 480], extendedLong: [960, 480] },
  'writeBlock, blocks': { short: [120, 60], long: [60, 60], extendedShort: [60, 30], extendedLong: [60, 30] },
  'writeBlock, points of one block': {
    short: [756, 376],
    long: [951, 951],
    extendedShort: [756, 376],
    extendedLong: [756, 376],
  },
}

/** FX5 39.1, the lower of bit and word devices. */
const fx3: Table = {
  readWords: { short: [32, 32], long: [32, 32] },
  writeWords: { short: [10, 10], long: [10, 10] },
  readBits: { short: [256, 256], long: [256, 256] },
  writeBits: { short: [160, 160], long: [160, 160] },
  readRandom: {},
  entryMonitorDevice: {},
  writeRandomBits: { short: [80, 80], long: [80, 80] },
  writeRandomWords: { short: [10, 10], long: [10, 10] },
  'writeRandomWords, double words': { short: [5, 5], long: [5, 5] },
  'readBlock, blocks': {},
  'readBlock, points': {},
  'writeBlock, blocks': {},
  'writeBlock, points of one block': {},
}

/** The figures of one code in both. */
function alike(table: Table, which: 'binary' | 'ascii'): Table {
  const entries = Object.entries(table).map(([counted, forms]) => {
    const figures = Object.entries(forms).map(([form, [binary, ascii]]) => {
      const max = which === 'binary' ? binary : ascii
      return [form, [max, max]]
    })
    return [counted, Object.fromEntries(figures)]
  })
  return Object.fromEntries(entries)
}

const tables: Readonly<Record<ProfileId, Table>> = {
  'iq-r': iqR,
  'iq-f': iqF,
  'fx5-enet': fx5Enet,
  q: qAndL,
  'q-built-in': qBuiltIn,
  'q-e71': qAndL,
  l: qAndL,
  fx3,
  // Not halved in ASCII code (43.2).
  'fx5-serial': {
    ...alike(iqF, 'binary'),
    // With an extension all points count double there.
    'writeBlock, points of one block': { short: [756, 756], extendedShort: [376, 376], extendedLong: [376, 376] },
  },
  'fx3-serial': { ...fx3, writeRandomBits: { short: [20, 20], long: [20, 20] } },
  // Not printed: the lower figures.
  'iq-r-c24': alike(iqR, 'ascii'),
  'q-c24': alike(qAndL, 'ascii'),
  'l-c24': alike(qAndL, 'ascii'),
  'remote-head': iqR,
  'nz2gf-etb': qAndL,
  generic,
}

function caught(run: () => void): RequestError {
  try {
    run()
  } catch (error) {
    if (error instanceof RequestError) return error
    throw error
  }
  throw new Error('nothing was thrown')
}

const rows = Object.entries(tables).flatMap(([id, table]) =>
  Object.entries(table).flatMap(([counted, forms]) =>
    Object.entries(forms).flatMap(([form, [binary, ascii]]) => [
      {
        id: id as ProfileId,
        counted: counted as Counted,
        form: form as DeviceForm,
        code: 'binary' as const,
        max: binary,
      },
      {
        id: id as ProfileId,
        counted: counted as Counted,
        form: form as DeviceForm,
        code: 'ascii' as const,
        max: ascii,
      },
    ]),
  ),
)

describe('limits of one request, against the tables of the manuals', () => {
  test.each(rows)('$id $counted $form $code: $max pass, one more is refused', ({ id, counted, form, code, max }) => {
    const command = counted.split(',')[0] as Command
    const message = messages[counted]
    expect(() => checkLimits(profiles[id], command, form, code, message(max))).not.toThrow()
    expect(caught(() => checkLimits(profiles[id], command, form, code, message(max + 1)))).toMatchObject({
      code: 'LIMIT_EXCEEDED',
      outcome: 'notSent',
      field: command,
    })
  })

  test('no form of a profile is without limits, and a form it lacks has none', () => {
    for (const profile of Object.values(profiles)) {
      for (const form of ['short', 'long', 'extendedShort', 'extendedLong'] as const) {
        expect([profile.id, form, limitsOf(profile, 'readWords', form, 'binary').length > 0]).toEqual([
          profile.id,
          form,
          profile.forms.includes(form),
        ])
      }
    }
  })

  test('words and double words of Write Random weigh 12 and 14 together', () => {
    const message = (words: number, doubleWords: number) => ({
      words: devices(words),
      doubleWords: devices(doubleWords),
    })
    expect(() => checkLimits(profiles.q, 'writeRandomWords', 'short', 'binary', message(90, 60))).not.toThrow()
    expect(() => checkLimits(profiles.q, 'writeRandomWords', 'short', 'binary', message(90, 61))).toThrow(
      /1934 weighted points/,
    )
    expect(() => checkLimits(profiles['iq-f'], 'writeRandomWords', 'short', 'ascii', message(45, 30))).not.toThrow()
    expect(() => checkLimits(profiles['iq-f'], 'writeRandomWords', 'short', 'ascii', message(46, 30))).toThrow(
      RequestError,
    )
  })

  test('the points of all blocks are added up, word and bit blocks together', () => {
    const message = { wordBlocks: blocks(3, 200), bitBlocks: blocks(2, 180) }
    expect(() => checkLimits(profiles['iq-r'], 'readBlock', 'long', 'binary', message)).not.toThrow()
    const more = { ...message, bitBlocks: [...message.bitBlocks, { points: 1 }] }
    expect(() => checkLimits(profiles['iq-r'], 'readBlock', 'long', 'binary', more)).toThrow(/961 points/)
  })
})

describe('ZR on High Performance model QCPUs (SLMP 5.2, Read Random, footnote *1)', () => {
  const read = (zr: number, d: number, doubleWords = 0) => ({
    words: [...Array.from({ length: zr }, (_, number) => ({ device: { device: 'ZR', number } })), ...devices(d)],
    doubleWords: Array.from({ length: doubleWords }, (_, number) => ({ device: { device: 'ZR', number } })),
  })
  const fits = (id: ProfileId, message: Message, form: DeviceForm = 'short', command: Command = 'readRandom') =>
    brokenLimit(profiles[id], command, form, 'binary', message) === undefined

  test.each(['q', 'q-e71'] as const)('%s counts it twice, in words and double words, with others', (id) => {
    for (const command of ['readRandom', 'entryMonitorDevice'] as const) {
      expect([fits(id, read(96, 0), 'short', command), fits(id, read(97, 0), 'short', command)]).toEqual([true, false])
      expect([fits(id, read(50, 92)), fits(id, read(50, 93)), fits(id, read(51, 92))]).toEqual([true, false, false])
      expect([fits(id, read(0, 0, 96)), fits(id, read(0, 0, 97)), fits(id, read(0, 192))]).toEqual([true, false, true])
    }
  })

  test('with 008x four times, which is safe whatever the footnote means', () => {
    expect([fits('q', read(48, 0), 'extendedShort'), fits('q', read(49, 0), 'extendedShort')]).toEqual([true, false])
  })

  test.each(['q-built-in', 'l', 'iq-r', 'nz2gf-etb'] as const)('%s counts it once', (id) => {
    expect(fits(id, read(192, 0))).toBe(true)
  })

  test('can be set either way; the refusal names what counts twice', () => {
    const once = resolveProfile('q-e71', { zrCountsDouble: false })
    expect(brokenLimit(once, 'readRandom', 'short', 'binary', read(192, 0))).toBeUndefined()
    const twice = resolveProfile('q-built-in', { zrCountsDouble: true })
    expect(caught(() => checkLimits(twice, 'readRandom', 'short', 'binary', read(97, 0))).message).toContain(
      'points of ZR again',
    )
    expect(limitsOf(once, 'writeRandomWords', 'short', 'binary')).toEqual(
      limitsOf(profiles['q-e71'], 'writeRandomWords', 'short', 'binary'),
    )
    expect(caught(() => resolveProfile('q', JSON.parse('{ "zrCountsDouble": "yes" }')))).toMatchObject({
      code: 'BAD_OPTION',
      field: 'profile.zrCountsDouble',
    })
  })
})

describe('what a refusal says', () => {
  test('what, how many, the maximum, for what, and what to do', () => {
    const { message } = caught(() => checkLimits(profiles['iq-f'], 'readWords', 'short', 'ascii', { points: 481 }))
    expect(message).toContain('readWords: 481 points in one request')
    expect(message).toContain('at most 480 for MELSEC iQ-F in ascii code')
    expect(message).toContain('Split the request')
  })

  test('a request without a single point is out of range', () => {
    for (const command of ['readRandom', 'writeRandomWords'] as const) {
      expect(
        caught(() => checkLimits(profiles['iq-r'], command, 'long', 'binary', { words: [], doubleWords: [] })),
      ).toMatchObject({ code: 'OUT_OF_RANGE', field: command })
    }
    expect(
      caught(() => checkLimits(profiles['iq-r'], 'readBlock', 'long', 'binary', { wordBlocks: [], bitBlocks: [] }))
        .code,
    ).toBe('OUT_OF_RANGE')
  })

  test('a message without the counted fields is a bad message, never taken for zero', () => {
    expect(caught(() => checkLimits(profiles['iq-r'], 'readWords', 'long', 'binary', {})).code).toBe('BAD_MESSAGE')
    expect(
      caught(() => checkLimits(profiles['iq-r'], 'readBlock', 'long', 'binary', { wordBlocks: [{}], bitBlocks: [] }))
        .code,
    ).toBe('BAD_MESSAGE')
    expect(
      caught(() => checkLimits(profiles['iq-r'], 'readWords', 'long', 'binary', { points: Number.NaN })).code,
    ).toBe('BAD_MESSAGE')
  })

  test('commands without limits are not held up', () => {
    expect(limitsOf(profiles['iq-r'], 'remoteStop', 'short', 'binary')).toEqual([])
    expect(() => checkLimits(profiles['iq-r'], 'executeMonitor', 'long', 'binary', {})).not.toThrow()
  })
})

describe('end codes of broken limits', () => {
  const over = (id: ProfileId, counted: Counted, n: number) =>
    brokenLimit(profiles[id], counted.split(',')[0] as Command, profiles[id].form, 'binary', messages[counted](n))
      ?.limit.endCode

  test('iQ-R, Q and L answer C051 for words and C052 for bits, iQ-F the other way round', () => {
    for (const id of ['iq-r', 'q', 'l'] as const) {
      expect([over(id, 'readWords', 961), over(id, 'writeWords', 961)]).toEqual([0xc051, 0xc051])
      expect([over(id, 'readBits', 7169), over(id, 'writeBits', 7169)]).toEqual([0xc052, 0xc052])
    }
    expect([over('iq-f', 'readWords', 961), over('iq-f', 'writeWords', 961)]).toEqual([0xc052, 0xc052])
    expect([over('iq-f', 'readBits', 3585), over('iq-f', 'writeBits', 3585)]).toEqual([0xc051, 0xc051])
  })

  test('random access: C054 in word units, C053 in bit units; blocks: C0D8', () => {
    for (const id of ['iq-r', 'iq-f', 'q', 'l'] as const) {
      expect(over(id, 'readRandom', 193)).toBe(0xc054)
      expect(over(id, 'writeRandomWords', 161)).toBe(0xc054)
      expect(over(id, 'writeRandomBits', 189)).toBe(0xc053)
      expect(over(id, 'readBlock, blocks', 121)).toBe(0xc0d8)
      expect(over(id, 'writeBlock, blocks', 121)).toBe(0xc0d8)
    }
    for (const id of ['iq-r', 'q', 'l'] as const) expect(over(id, 'entryMonitorDevice', 193)).toBe(0xc054)
  })

  test('a request within its limits breaks none', () => {
    expect(brokenLimit(profiles['iq-r'], 'readWords', 'long', 'binary', { points: 960 })).toBeUndefined()
  })
})

describe('limits for planning', () => {
  test('weights and maximum of each limit are given, the same array each time', () => {
    const limits = limitsOf(profiles['iq-r'], 'writeBlock', 'long', 'binary')
    expect(limits.map(({ sum, max, unit }) => ({ sum, max, unit }))).toEqual([
      { sum: { wordBlocks: 1, bitBlocks: 1 }, max: 60, unit: 'blocks' },
      {
        sum: { wordBlocks: 9, bitBlocks: 9, 'wordBlocks.values': 1, 'bitBlocks.values': 1 },
        max: 960,
        unit: 'weightedPoints',
      },
    ])
    expect(limitsOf(profiles['iq-r'], 'writeBlock', 'long', 'binary')).toBe(limits)
  })

  test('the generic profile keeps one limit for each sum: the lower one', () => {
    const limits = limitsOf(profiles.generic, 'readBits', 'short', 'binary')
    expect(limits.map(({ max }) => max)).toEqual([3584])
    expect(limitsOf(profiles.generic, 'readWords', 'short', 'binary').map(({ max }) => max)).toEqual([960])
  })

  test('measureLimit counts typed arrays too', () => {
    const [limit] = limitsOf(profiles.q, 'writeWords', 'short', 'binary')
    if (limit === undefined) throw new Error('no limit')
    expect(measureLimit(limit, { values: new Uint16Array(7) })).toBe(7)
  })

  test('own maxima hold in every form and code, for the named command only', () => {
    const profile = resolveProfile('iq-r', {
      limits: { readWords: 480, writeRandomWords: { weightedPoints: 600 }, readBlock: { blocks: 10 } },
    })
    for (const form of profile.forms) {
      for (const code of ['binary', 'ascii'] as const) {
        expect(limitsOf(profile, 'readWords', form, code).map(({ max }) => max)).toEqual([480])
        expect(limitsOf(profile, 'writeWords', form, code).map(({ max }) => max)).toEqual([960])
        expect(limitsOf(profile, 'writeRandomWords', form, code).map(({ max }) => max)).toEqual([600])
        expect(limitsOf(profile, 'readBlock', form, code).find(({ unit }) => unit === 'blocks')?.max).toBe(10)
        expect(limitsOf(profile, 'readBlock', form, code).find(({ unit }) => unit === 'points')?.max).toBe(960)
        expect(limitsOf(profile, 'writeBlock', form, code).find(({ unit }) => unit === 'blocks')?.max).toBe(
          form === 'short' ? 120 : 60,
        )
      }
    }
    expect(limitsOf(profiles['iq-r'], 'readWords', 'long', 'binary')[0]?.max).toBe(960)
  })

  test('an own maximum may also be higher than the profile’s, in both codes', () => {
    const profile = resolveProfile('q', { limits: { readRandom: 185 } })
    expect(limitsOf(profile, 'readRandom', 'extendedShort', 'binary').map(({ max }) => max)).toEqual([185])
  })
})
