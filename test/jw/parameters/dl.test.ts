/** Data links DL1 and DL9 of a JW-21CM: the tables, rules and worked example of the manual. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { RequestError } from '../../../src/errors'
import { type Dl1Settings, dl1Parameters } from '../../../src/jw/parameters/dl1'
import { type Dl9Settings, type Dl9Slave, dl9Areas, dl9Parameters } from '../../../src/jw/parameters/dl9'
import { unitNumbers } from '../../../src/jw/parameters/unit-number'
import { messagesOf, refusal } from './problems'

const slave = (given: Partial<Dl9Slave>): Dl9Slave => ({
  sendOffset: 0,
  sendBytes: 0,
  receiveOffset: 0,
  receiveBytes: 0,
  ...given,
})

describe('DL1', () => {
  const stations = (...bytes: readonly number[]): Dl1Settings => ({ stations: bytes.map((each) => ({ bytes: each })) })
  const all = (each: number, last = each) => stations(...Array.from({ length: 15 }, () => each), last)

  test('has the bytes of stations 00 to 17 at 0100 to 0117', () => {
    expect(dl1Parameters.leaves.map(({ path, address }) => [path, address])).toEqual(
      Array.from({ length: 16 }, (_, i) => [`stations.${i}.bytes`, 0o100 + i]),
    )
    const { blocks, warnings } = dl1Parameters.write(all(4))
    expect(blocks).toEqual([{ address: 0o100, bytes: Buffer.alloc(16, 4) }])
    expect(warnings).toEqual([])
  })

  test('refuses a station without 1 to 63 bytes', () => {
    expect(refusal(() => dl1Parameters.write(stations(0, 8)))).toEqual({
      field: 'stations.0.bytes',
      message: 'JW-21CM data link DL1: stations.0.bytes: Station 00 has 0, must have 1 to 63 (error 70H).',
    })
    expect(refusal(() => dl1Parameters.write(stations(1, 64))).message).toContain('Station 01 has 64')
    expect(refusal(() => dl1Parameters.write(stations(8, 0))).field).toBe('stations.1.bytes')
    expect(dl1Parameters.write(stations(1, 63)).blocks[0]?.bytes.subarray(0, 3)).toEqual(Buffer.of(1, 63, 0))
  })

  test('refuses 65 bytes in all, and says everything that is wrong at once', () => {
    expect(dl1Parameters.write(stations(63, 1)).blocks).toHaveLength(1)
    expect(refusal(() => dl1Parameters.write(all(4, 5)))).toEqual({
      field: 'stations',
      message: 'JW-21CM data link DL1: stations: They have 65 bytes in all, may have 64 (error 70H).',
    })
    expect(refusal(() => dl1Parameters.write(stations(64, 1))).message).toBe(
      'JW-21CM data link DL1: stations.0.bytes: Station 00 has 64, must have 1 to 63 (error 70H). stations: They have 65 bytes in all, may have 64 (error 70H).',
    )
  })

  test('warns of stations that are not given, because the manual says "each station"', () => {
    expect(messagesOf(dl1Parameters.write(stations(8, 8)).warnings)).toEqual([
      'warning stations: Stations 02 to 17 have 0 bytes. If the unit reports error 70H, give each of them 1 byte or more.',
    ])
    expect(refusal(() => dl1Parameters.write(stations())).message).toContain('There is none')
  })

  test('refuses more stations than there are, other names and other values', () => {
    expect(refusal(() => dl1Parameters.write(stations(...Array<number>(17).fill(1))))).toEqual({
      field: 'stations',
      message: 'JW-21CM data link DL1: stations: has 17 elements, the unit has room for 16.',
    })
    const wrong: readonly [unknown, string][] = [
      [{ stations: [{ bytes: 1, byte: 2 }] }, 'there is no setting stations.0.byte; there are bytes'],
      [{ stations: [{ bytes: 1 }], slaves: [] }, 'there is no setting slaves; there are stations'],
      [{ stations: [{ bytes: '1' }] }, 'stations.0.bytes: must be a whole number, is "1"'],
      [{ stations: [7] }, 'stations.0: must be an object with bytes, is 7'],
      [{ stations: 7 }, 'stations: must be an array, is 7'],
      [{}, 'stations: must be an array, is missing'],
      [undefined, 'settings are an object, not undefined'],
    ]
    for (const [given, reason] of wrong)
      expect(refusal(() => dl1Parameters.write(given as Dl1Settings)).message).toBe(`JW-21CM data link DL1: ${reason}.`)
  })

  test('reads back what was written, for all settings that are allowed', () => {
    fc.assert(
      fc.property(fc.array(fc.integer({ min: 1, max: 63 }), { minLength: 1, maxLength: 16 }), (bytes) => {
        fc.pre(bytes.reduce((sum, each) => sum + each, 0) <= 64)
        const settings = stations(...bytes)
        const { blocks, warnings } = dl1Parameters.write(settings)
        expect(dl1Parameters.read(blocks)).toEqual({ settings, problems: warnings })
      }),
    )
  })

  test('reads a unit with wrong parameters, and says what is wrong', () => {
    const bytes = Buffer.from([8, 0, 64, ...Array<number>(13).fill(0)])
    const { settings, problems } = dl1Parameters.read([{ address: 0o100, bytes }])
    expect(settings).toEqual(stations(8, 0, 64))
    expect(problems.map(({ severity, setting }) => `${severity} ${setting}`)).toEqual([
      'error stations.1.bytes',
      'error stations.2.bytes',
      'error stations',
      'warning stations',
    ])
  })

  test('is explained station by station', () => {
    const { blocks } = dl1Parameters.write(all(4))
    expect(dl1Parameters.explain(blocks)[8]).toEqual({
      address: 0o110,
      length: 1,
      setting: 'stations.8.bytes',
      bytes: '04',
      text: 'station 10: 4 bytes',
    })
  })
})

describe('DL9', () => {
  /** The example of the manual: unit No. 1, two slaves, values in octal. */
  const example: Dl9Settings = {
    slaves: [
      { sendOffset: 0o40, receiveOffset: 0o60, sendBytes: 0o10, receiveBytes: 0o4 },
      { sendOffset: 0o100, receiveOffset: 0o150, sendBytes: 0o20, receiveBytes: 0o6 },
    ],
  }
  const zeros = (count: number) => Array<number>(count).fill(0)
  const exampleBlocks = [
    {
      address: 0o1000,
      bytes: Buffer.from([0o40, 0, 0o60, 0, 0o100, 0, 0o150, 0, ...zeros(52)]),
    },
    { address: 0o1100, bytes: Buffer.from([0o10, 0o4, 0o20, 0o6, ...zeros(26)]) },
  ]

  test('writes and reads the worked example of the manual', () => {
    expect(dl9Parameters.write(example, { unitNumber: 1 })).toEqual({ blocks: exampleBlocks, warnings: [] })
    expect(dl9Parameters.read(exampleBlocks, { unitNumber: 1 })).toEqual({ settings: example, problems: [] })
  })

  test('explains the worked example as the manual does', () => {
    const rows = dl9Parameters.explain(exampleBlocks, { unitNumber: 1 })
    const texts = new Map(rows.map(({ address, text }) => [address.toString(8), text]))
    expect([...'1000 1002 1004 1006 1100 1101 1102 1103'.split(' ')].map((address) => texts.get(address))).toEqual([
      '00 -> 01: offset 000040 octal, KO1140',
      '01 -> 00: offset 000060 octal, KO1160',
      '00 -> 02: offset 000100 octal, KO1200',
      '02 -> 00: offset 000150 octal, KO1250',
      '00 -> 01: 8 bytes',
      '01 -> 00: 4 bytes',
      '00 -> 02: 16 bytes',
      '02 -> 00: 6 bytes',
    ])
    expect(dl9Parameters.explain(exampleBlocks)[0]?.text).toBe('00 -> 01: offset 000040 octal')
  })

  test('has the addresses of the table: slave 17 at 1070 and 1134', () => {
    const at = new Map(dl9Parameters.leaves.map(({ path, address }) => [path, address.toString(8)]))
    expect(at.get('slaves.0.sendOffset')).toBe('1000')
    expect(at.get('slaves.7.receiveOffset')).toBe('1036')
    expect(at.get('slaves.7.sendBytes')).toBe('1116')
    expect(at.get('slaves.14.sendOffset')).toBe('1070')
    expect(at.get('slaves.14.receiveOffset')).toBe('1072')
    expect(at.get('slaves.14.sendBytes')).toBe('1134')
    expect(at.get('slaves.14.receiveBytes')).toBe('1135')
    expect(at.size).toBe(60)
  })

  test('has the areas of the table, one for each number of the unit number switch', () => {
    expect(dl9Areas.map(({ first, last }) => last - first + 1)).toEqual([320, 256, 192, 128, 64, 512])
    const numbers = unitNumbers.find(({ units }) => units.includes('DL9'))
    expect(dl9Areas).toHaveLength((numbers?.last.jw300 ?? 0) + 1)
    const place = (unitNumber: number, sendOffset: number) =>
      dl9Parameters.explain(
        dl9Parameters.write({ slaves: [slave({ sendOffset, sendBytes: 1 })] }, { unitNumber }).blocks,
        {
          unitNumber,
        },
      )[0]?.text
    expect(place(0, 0o477)).toContain('KO1477')
    expect(place(5, 0o777)).toContain('89777')
  })

  test.each(dl9Areas.map(({ first, last }, unitNumber) => ({ unitNumber, size: last - first + 1 })))(
    'refuses what leaves the area of unit No. $unitNumber',
    ({ unitNumber, size }) => {
      const settings = (receiveOffset: number) => ({ slaves: [slave({ receiveOffset, receiveBytes: 4 })] })
      expect(dl9Parameters.write(settings(size - 4), { unitNumber }).warnings).toEqual([])
      const { field, message } = refusal(() => dl9Parameters.write(settings(size - 3), { unitNumber }))
      expect(field).toBe('slaves.0.receiveOffset')
      expect(message).toContain(`leave the area`)
      expect(message).toContain(`of ${size} bytes (error 70H).`)
    },
  )

  test('refuses more than 128 bytes of a slave, and more than 512 in all', () => {
    const unit = { unitNumber: 5 }
    expect(dl9Parameters.write({ slaves: [slave({ sendBytes: 128 })] }, unit).warnings).toEqual([])
    expect(refusal(() => dl9Parameters.write({ slaves: [slave({ sendBytes: 129 })] }, unit))).toEqual({
      field: 'slaves.0.sendBytes',
      message: 'JW-21CM data link DL9: slaves.0.sendBytes: Slave 01 has 129, may have 0 to 128 (error 70H).',
    })
    const four = [0, 128, 256, 384].map((sendOffset) => slave({ sendOffset, sendBytes: 128 }))
    expect(dl9Parameters.write({ slaves: four }, unit).warnings).toEqual([])
    expect(refusal(() => dl9Parameters.write({ slaves: [...four, slave({ sendBytes: 1 })] }, unit))).toEqual({
      field: 'slaves',
      message: 'JW-21CM data link DL9: slaves: They have 513 bytes in all, may have 512 (error 70H).',
    })
  })

  test('warns of bytes that overlap, and of more than the area has', () => {
    const both = [slave({ receiveBytes: 40 }), slave({ receiveOffset: 39, receiveBytes: 25 })]
    expect(messagesOf(dl9Parameters.write({ slaves: both }, { unitNumber: 4 }).warnings)).toEqual([
      'warning slaves: They have 65 bytes in all; the manual prints 64 as the most of this unit number.',
      'warning slaves.1.receiveOffset: Its bytes overlap those of slaves.0.receiveOffset.',
    ])
  })

  test.each([undefined, -1, 6, 1.5, '1'])('refuses the unit number %p', (unitNumber) => {
    const switches = { unitNumber } as unknown as { unitNumber: number }
    expect(() => dl9Parameters.write(example, switches)).toThrow(
      expect.objectContaining({
        code: 'BAD_OPTION',
        field: 'unitNumber',
        message: expect.stringContaining('is 0 to 5.'),
      }),
    )
  })

  test('reads back what was written, for all settings that are allowed', () => {
    const one = fc.integer({ min: 0, max: 5 }).chain((unitNumber) => {
      const { first, last } = dl9Areas[unitNumber] ?? dl9Areas[0]
      const size = last - first + 1
      const range = fc
        .integer({ min: 0, max: 17 })
        .chain((bytes) => fc.integer({ min: 0, max: size - bytes }).map((offset) => ({ bytes, offset })))
      const one = fc.tuple(range, range).map(([send, receive]) => ({
        sendOffset: send.offset,
        sendBytes: send.bytes,
        receiveOffset: receive.offset,
        receiveBytes: receive.bytes,
      }))
      const slaves = fc.array(one, { minLength: 1, maxLength: 14 })
      return slaves.map((some) => ({ unitNumber, slaves: [...some, slave({ sendOffset: 1 })] }))
    })
    fc.assert(
      fc.property(one, ({ unitNumber, slaves }) => {
        const { blocks, warnings } = dl9Parameters.write({ slaves }, { unitNumber })
        expect(dl9Parameters.read(blocks, { unitNumber })).toEqual({ settings: { slaves }, problems: warnings })
        // Slaves without anything at the end are not there; the parameters are the same.
        const longer = dl9Parameters.write({ slaves: [...slaves.slice(0, 14), slave({})] }, { unitNumber })
        expect(dl9Parameters.read(longer.blocks, { unitNumber }).settings?.slaves.length).toBeLessThan(15)
      }),
    )
  })

  test('is not read from less than all of its parameters', () => {
    const [offsets] = exampleBlocks
    const read = () => dl9Parameters.read(offsets === undefined ? [] : [offsets], { unitNumber: 1 })
    expect(refusal(read)).toEqual({
      field: 'slaves.0.sendBytes',
      message: 'JW-21CM data link DL9: parameter 1100 is missing. Read it too.',
    })
    expect(read).toThrow(RequestError)
  })

  test('is read from all parameters of a unit in one block or in two', () => {
    const image = Buffer.alloc(0o4000)
    for (const { address, bytes } of exampleBlocks) image.set(bytes, address)
    const expected = { settings: example, problems: [] }
    expect(dl9Parameters.read([{ address: 0, bytes: image }], { unitNumber: 1 })).toEqual(expected)
    const halves = [
      { address: 1000, bytes: image.subarray(1000) },
      { address: 0, bytes: image.subarray(0, 1000) },
    ]
    expect(dl9Parameters.read(halves, { unitNumber: 1 })).toEqual(expected)
  })
})
