/** Profiles of serial lines: what differs from the Ethernet port of the same PLC, and that nothing offers them yet. */
import { describe, expect, test } from '@jest/globals'
import { parseItem } from '../../src/client/item/item'
import { planRead } from '../../src/client/plan/read'
import { planWrite } from '../../src/client/plan/write'
import { explainEndCode } from '../../src/end-code/explain'
import type { CommandName } from '../../src/melsec/commands/commands'
import { commands } from '../../src/melsec/commands/commands'
import type { DeviceForm } from '../../src/melsec/device/device-form'
import { limitsOf } from '../../src/melsec/device/limit'
import { isSerialFrame, serialRoute } from '../../src/melsec/frame/serial-frames'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { iqF } from '../../src/melsec/profiles/iq-f'
import { profileOver1c } from '../../src/melsec/profiles/over-1c'
import { doubtfulUse, exclusionOf, lackOf } from '../../src/melsec/profiles/profile'
import { profiles } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'

const set = profiles['fx5-serial']
const channels = set.serial?.channels
const all = Object.values(profiles).filter(({ serial }) => serial !== undefined)

/** Everything inside a value, itself included. */
function* parts(value: unknown): Generator<unknown> {
  yield value
  if (typeof value === 'object' && value !== null) for (const inner of Object.values(value)) yield* parts(inner)
}

test('they are those of the FX5, the FX3 and the C24 modules, and nobody else has serial frames', () => {
  expect(all.map(({ id }) => id)).toEqual(['fx5-serial', 'fx3-serial', 'iq-r-c24', 'q-c24', 'l-c24'])
  for (const profile of Object.values(profiles)) {
    expect(profile.frames.some(isSerialFrame)).toBe(profile.serial !== undefined)
    expect(profile.transports.includes('serial')).toBe(profile.serial !== undefined)
  }
})

test.each(all)('$id is plain data, and every figure says where it comes from', (profile) => {
  expect(structuredClone(profile)).toEqual(profile)
  for (const part of parts(profile)) {
    expect(part).not.toBe('')
    expect(part).not.toBeUndefined()
  }
  const { lacks, exclusions, limits, ranges, refusals, reach, remote } = profile
  for (const { source } of [...lacks, ...exclusions, ...limits, ranges, refusals, reach, remote]) {
    expect(source.length).toBeGreaterThan(3)
  }
  for (const source of Object.values(profile.sources)) expect(source.length).toBeGreaterThan(5)
})

describe('FX5 in 3C and 4C frames', () => {
  const most = (name: CommandName, form: DeviceForm, code: 'binary' | 'ascii') =>
    limitsOf(set, name, form, code).map(({ max, unit }) => [max, unit])

  test.each([
    ['readBits', 'short', [[3584, 'points']]],
    ['writeBits', 'extendedShort', [[3584, 'points']]],
    ['readWords', 'short', [[960, 'points']]],
    ['writeWords', 'extendedLong', [[960, 'points']]],
    ['readRandom', 'short', [[192, 'points']]],
    ['readRandom', 'extendedShort', [[96, 'points']]],
    ['writeRandomBits', 'short', [[188, 'points']]],
    ['writeRandomBits', 'extendedShort', [[94, 'points']]],
    ['writeRandomWords', 'short', [[1920, 'weightedPoints']]],
    ['writeRandomWords', 'extendedLong', [[960, 'weightedPoints']]],
    [
      'readBlock',
      'short',
      [
        [120, 'blocks'],
        [960, 'points'],
      ],
    ],
    [
      'readBlock',
      'extendedShort',
      [
        [60, 'blocks'],
        [960, 'points'],
      ],
    ],
    [
      'writeBlock',
      'short',
      [
        [120, 'blocks'],
        [760, 'weightedPoints'],
      ],
    ],
    [
      'writeBlock',
      'extendedShort',
      [
        [60, 'blocks'],
        [380, 'weightedPoints'],
      ],
    ],
  ] as const)('%s (%s) takes the same in both codes: ASCII code is not halved', (name, form, limits) => {
    expect(most(name, form, 'ascii')).toEqual(limits)
    expect(most(name, form, 'binary')).toEqual(limits)
  })

  test('there is no password and none of the other commands that its Ethernet port lacks', () => {
    for (const name of ['unlock', 'lock'] as const) expect(lackOf(set, name)).toMatchObject({ endCode: 0x7e40 })
    for (const { command } of iqF.lacks) expect(lackOf(set, command)).toBeDefined()
    const own = new Set([...iqF.lacks.map(({ command }) => command), 'unlock', 'lock'])
    expect(set.lacks.filter(({ command }) => !own.has(command))).toEqual([])
  })

  test('what only the Ethernet part prints of contacts and double words is doubtful, not lacking', () => {
    for (const name of ['readWords', 'writeWords', 'readBits', 'writeBits'] as const) {
      expect(exclusionOf(set, name, 'LCN')).toBeDefined()
    }
    for (const [name, device] of [
      ['readBlock', 'LZ'],
      ['writeBlock', 'LCN'],
      ['readRandom', 'TS'],
      ['readRandom', 'LCS'],
      ['writeRandomBits', 'CC'],
      ['writeRandomWords', 'STC'],
    ] as const) {
      expect(exclusionOf(iqF, name, device)).toBeDefined()
      expect(exclusionOf(set, name, device)).toBeUndefined()
      expect(doubtfulUse(set, name, device)?.source).toContain('not in the serial chapter')
    }
  })

  const route = serialRoute('3C')
  const protocol = new MelsecProtocol({
    framing: serialFraming({ frame: '3C', format: 1 }),
    head: route,
    profile: set,
    code: 'ascii',
    asciiXy: 'octal',
    asciiZr: 'decimal',
  })

  test('a doubtful use is sent when asked for', () => {
    const message = { words: [{ device: { device: 'TS', number: 0 } }], doubleWords: [] } as const
    const { body } = protocol.exchange(commands.readRandom, message)
    expect(body.toString('latin1')).toBe('040300000100TS000000')
  })

  test('and never chosen by the planner, which takes what the serial part prints', () => {
    const written = (...texts: string[]) =>
      planWrite(
        texts.map((text) => ({ item: parseItem(text, { xyRadix: 8 }), value: true })),
        protocol,
      )
        .describe()
        .requests.map(({ command }) => command)
    expect(written('M0', 'M4000')).toEqual(['writeRandomBits'])
    expect(written('TS0', 'TS400')).toEqual(['writeBits', 'writeBits'])
    const read = (...texts: string[]) =>
      planRead(
        texts.map((text) => parseItem(text, { xyRadix: 8 })),
        protocol,
        { gap: 0 },
      )
        .describe()
        .requests.map(({ command }) => command)
    // Contacts in bit blocks are printed.
    expect(read('D0', 'D2000', 'TS0', 'TS400')).toEqual(['readBlock'])
    expect(read('LCN0', 'LCN20')).toEqual(['readRandom'])
  })

  test('as many words go into one request in ASCII code as in binary code', () => {
    const { requests } = planRead([parseItem('D0[960]', { xyRadix: 8 })], protocol, { gap: 0 }).describe()
    expect(requests).toHaveLength(1)
  })
})

test('in 1C frames the end codes are the two digits of NAK', () => {
  for (const serial of all.filter(({ frames }) => frames.includes('1C'))) {
    const { refusals, lacks, limits, exclusions } = profileOver1c(serial)
    const { source, ...codes } = refusals
    expect(source).toContain('1C')
    const used = [...lacks, ...limits, ...exclusions].map(({ endCode }) => endCode)
    for (const code of [...Object.values(codes), ...used]) {
      expect(explainEndCode(code, { family: '1C' })).toMatchObject({ exact: true, answer: true })
    }
  }
})

describe('channels of FX5', () => {
  test('are at most two of FX5S and FX5UJ, and FX5UC has no second one', () => {
    const found = channels?.cpus.map(({ cpu, channels: of, most }) => [cpu, of.join(' '), most])
    expect(found).toEqual([
      ['FX5S', '2 3 4', 2],
      ['FX5UJ', '2 3 4', 2],
      ['FX5U', '1 2 3 4', 4],
      ['FX5UC', '1 3 4', 3],
    ])
  })

  test('tell of themselves where the manual says', () => {
    const numbers = Object.values(channels?.devices ?? {}).map((of) =>
      Object.values(of)
        .map(({ device, number }) => `${device}${number}`)
        .join(' '),
    )
    expect(numbers).toEqual([
      'SM8500 SD8500 SD8502 SM8503 SD8503 SM8680 SM8740 SD8740 SD8741 SD8742',
      'SM8510 SD8510 SD8512 SM8513 SD8513 SM8690 SM8750 SD8750 SD8751 SD8752',
      'SM8520 SD8520 SD8522 SM8523 SD8523 SM8700 SM8760 SD8760 SD8761 SD8762',
      'SM8530 SD8530 SD8532 SM8533 SD8533 SM8710 SM8770 SD8770 SD8771 SD8772',
    ])
  })

  test('are called otherwise in programs of an FX3', () => {
    expect(channels?.fx3.channels[2]).toMatchObject({
      error: { device: 'SM', number: 8438 },
      globalSignal: { device: 'SM', number: 8426 },
      mcProtocol: { device: 'SM', number: 8439 },
      errorCode: { device: 'SD', number: 8438 },
      mode: { device: 'SD', number: 8439 },
    })
  })

  test('note codes that no NAK carries', () => {
    const { setUpTwice = 0, line = 0 } = channels?.errorCodes ?? {}
    for (const code of [setUpTwice, line]) {
      const explained = explainEndCode(code, { family: 'slmp' })
      expect(explained).toMatchObject({ exact: true, answer: false })
      expect(explained?.where.join(' ')).toContain('SD8500')
    }
  })
})
