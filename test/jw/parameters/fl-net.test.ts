/** The FL-net unit: the table of the manual, its rules and advice. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { type FlNetSettings, flNetParameters } from '../../../src/jw/parameters/fl-net'
import { messagesOf, refusal } from './problems'

const registers = (address: number) => ({ file: 1, address, extended: true }) as const

const settings = {
  address: '192.168.250.7',
  tokenWatchdog: 10,
  minimumFrameInterval: 2,
  area1SendOffset: 0x12,
  area1SendWords: 0x34,
  area2SendOffset: 0x156,
  area2SendWords: 0x278,
  area1Place: registers(0o200000),
  area2Place: registers(0o400000),
  managementPlace: registers(0o1000),
} as const satisfies FlNetSettings

const imageOf = (given: FlNetSettings) => flNetParameters.write(given).blocks[0]?.bytes as Buffer
const warningsOf = (given: Partial<FlNetSettings>) =>
  messagesOf(flNetParameters.write({ ...settings, ...given }).warnings)
const refused = (given: object) => refusal(() => flNetParameters.write({ ...settings, ...given }))

describe('the table of the manual', () => {
  test('every setting at its address', () => {
    const at = flNetParameters.leaves.map(({ address, length, path }) => `${address.toString(8)} ${length} ${path}`)
    expect(at).toEqual([
      '0 4 address',
      '4 1 tokenWatchdog',
      '5 1 minimumFrameInterval',
      '6 1 function',
      '7 1 reserved07',
      '10 2 area1SendOffset',
      '12 2 area1SendWords',
      '14 2 area2SendOffset',
      '16 2 area2SendWords',
      '20 3 area1Place',
      '23 1 reserved23',
      '24 3 area2Place',
      '27 1 reserved27',
      '30 3 managementPlace',
      '33 1 managementTransfer',
      '34 3 bufferPlace',
      '37 1 bufferUse',
      '40 10 nodeName',
      '52 1 reserved52',
      '53 1 sendReceiveTimeout',
      '54 4 reserved54',
      '60 2 area1ReceiveOffset',
      '62 2 area1ReceiveWords',
      '64 2 area2ReceiveOffset',
      '66 2 area2ReceiveWords',
    ])
  })

  test('bytes low first; file registers halved, with the file number of their 64 KB', () => {
    const full: FlNetSettings = {
      ...settings,
      function: 'memorySaving',
      managementTransfer: 'nodesAndStates',
      bufferPlace: registers(0o37577774),
      nodeName: 'PUMP 1',
      sendReceiveTimeout: 2500,
      area1ReceiveOffset: 1,
      area1ReceiveWords: 2,
      area2ReceiveOffset: 0x304,
      area2ReceiveWords: 0x506,
    }
    expect(imageOf(full).toString('hex').replace(/../g, '$& ').trim()).toBe(
      [
        'c0 a8 fa 07 0a 02 01 00', // 00: IP address, watchdog, interval, function, reserved
        '12 00 34 00 56 01 78 02', // 10: what is sent
        '00 00 02 00 00 00 03 00', // 20: 00200000 is file 02, 00400000 file 03
        '00 01 01 81 fe 7f 7f 00', // 30: 00001000 / 2 in file 01; 77774 octal / 2 in file 7F
        '50 55 4d 50 20 31 00 00', // 40: node name
        '00 00 00 19 00 00 00 00', // 50: reserved, 2.5 s, reserved
        '01 00 02 00 04 03 06 05', // 60: memory saving
      ].join(' '),
    )
  })

  test.each([
    ['all', 0x00],
    ['none', 0x80],
    ['nodesAndStates', 0x81],
    ['all83', 0x83],
  ] as const)('transfer of the management area %s is %i', (managementTransfer, byte) => {
    expect(imageOf({ ...settings, managementTransfer })[0o33]).toBe(byte)
  })

  test('FF at 03: the parameters are in the data memory', () => {
    const address = { parameters: { fileNumber: 2, fileAddress: 0o1234 } } as const
    expect(imageOf({ ...settings, address }).subarray(0, 4)).toEqual(Buffer.of(0o234, 2, 2, 0xff))
  })
})

describe('refused', () => {
  test.each<[object, string, string]>([
    [
      { address: '192.168.250.255' },
      'address',
      'ends with 255, which makes the unit look for its parameters in the data memory; nodes are 1 to 254.',
    ],
    [{ address: '192.168.250.0' }, 'address', '192.168.250.0 ends with node 0; nodes are 1 to 254.'],
    [
      { address: '192.168.250' },
      'address',
      'is 192.168.250, must be an IP address of four numbers, e.g. 192.168.250.1.',
    ],
    [
      { address: '192.168.256.1' },
      'address',
      'is 192.168.256.1, must be an IP address of four numbers, e.g. 192.168.250.1.',
    ],
    [{ tokenWatchdog: 256 }, 'tokenWatchdog', 'is 256, must be 0 to 255.'],
    [{ function: 'saving' }, 'function', 'is saving, must be one of standard, memorySaving.'],
    [{ function: 'toString' }, 'function', 'is toString, must be one of standard, memorySaving.'],
    [{ area1SendOffset: 0x1cd }, 'area1SendWords', 'Words 461 to 512 are what it sends; area 1 has 512 words.'],
    [{ area2SendWords: 0x1ff0 }, 'area2SendWords', 'Words 342 to 8517 are what it sends; area 2 has 8192 words.'],
    [
      { area1Place: registers(0o200001) },
      'area1Place',
      'is at an odd byte, 000001 octal; the unit counts words, so use an even one.',
    ],
    [
      { area1Place: registers(0o37600000) },
      'area1Place',
      'is behind the file registers that the unit reaches: 00000000 to 37577777 octal.',
    ],
    [{ area1Place: registers(0o40000000) }, 'area1Place', 'address is 8388608, must be 0 to 37777777 octal.'],
    [
      { area1Place: { file: 0, address: 0o4000 } },
      'area1Place',
      'is in file 0: how it is set there is not printed. Give fileNumber 0 and fileAddress as the tool of the unit shows it.',
    ],
    [{ area1Place: { fileNumber: 0x80, fileAddress: 0 } }, 'area1Place', 'fileNumber is 128, must be 0 to 127.'],
    [
      { area1Place: { fileNumber: 1, fileAddress: 0o100000 } },
      'area1Place',
      'fileAddress is 32768, must be 0 to 077777 octal.',
    ],
    [
      { area1Place: { fileNumber: 1, address: 0 } },
      'area1Place',
      'has address beside fileNumber; give an address as { file: 1, address, extended: true } or { fileNumber, fileAddress }.',
    ],
    [
      { area1Place: registers(0o177000) },
      'area1Place',
      '1024 bytes from file 1, byte 00177000 octal on cross a border of 64 KB. Move the area to one side of it.',
    ],
    [{ managementTransfer: 0x82 }, 'managementTransfer', 'is 130, must be one of all, none, nodesAndStates, all83.'],
    [{ nodeName: 'TOO LONG NAME' }, 'nodeName', 'has 13 characters, may have 10.'],
    [{ nodeName: 'ポンプ' }, 'nodeName', 'may hold only the characters 20H to 7EH (ASCII).'],
    [{ sendReceiveTimeout: 150 }, 'sendReceiveTimeout', 'is 150, must be 0 to 25500 ms in steps of 100.'],
    [{ sendReceiveTimeout: 25600 }, 'sendReceiveTimeout', 'is 25600, must be 0 to 25500 ms in steps of 100.'],
    [
      { function: 'memorySaving', area2ReceiveOffset: 8000, area2ReceiveWords: 193 },
      'area2ReceiveWords',
      'Words 8000 to 8192 are what it receives; area 2 has 8192 words.',
    ],
  ])('%j', (given, field, reason) => {
    expect(refused(given)).toEqual({ field, message: `FL-net unit: ${field}: ${reason}` })
  })

  test('what is missing, and names that are no setting', () => {
    const { area1Place: _, ...rest } = settings
    expect(refusal(() => flNetParameters.write(rest as unknown as FlNetSettings))).toEqual({
      field: 'area1Place',
      message: 'FL-net unit: area1Place: is missing.',
    })
    expect(refused({ tokenWatchDog: 1 }).message).toContain(
      'FL-net unit: there is no setting tokenWatchDog; there are address,',
    )
    expect(refused({ reserved07: 1 }).message).toContain('there is no setting reserved07')
  })
})

describe('advised', () => {
  test.each([
    [0, 9, 10],
    [2559, 9, 10],
    [2560, 29, 30],
    [5119, 29, 30],
    [5120, 39, 40],
    [8192, 39, 40],
  ])('%i words sent in %i ms: the manual advises %i ms', (words, tokenWatchdog, advised) => {
    const given = { area1SendWords: 0, area2SendOffset: 0, area2SendWords: words }
    expect(warningsOf({ ...given, tokenWatchdog })).toEqual([
      `warning tokenWatchdog: ${tokenWatchdog} ms for ${2 * words} bytes that are sent; the manual advises ${advised} ms.`,
    ])
    expect(warningsOf({ ...given, tokenWatchdog: advised })).toEqual([])
  })

  test('areas up to the border are as they should be, and those that are not there are not looked at', () => {
    expect(warningsOf({ area1Place: registers(0o176000) })).toEqual([])
    expect(warningsOf({ area1Place: { fileNumber: 1, fileAddress: 0o77000 } })).toEqual([])
    expect(warningsOf({ function: 'memorySaving', area1Place: registers(0o177776) })).toEqual([
      'warning area1Place: With the words that are sent it would cross a border of 64 KB; where they lie in the CU is not printed. Keep away from the border.',
    ])
  })

  test('areas in file 0 are not checked, and that is said', () => {
    expect(warningsOf({ area1Place: { fileNumber: 0, fileAddress: 0o4000 } })).toEqual([
      'warning area1Place: It is in file 0, where the notation is not printed: whether the area fits is not checked.',
    ])
  })

  test('areas that overlap, with the transmission buffer when it is used', () => {
    expect(warningsOf({ area1Place: registers(0o437776) })).toEqual([
      'warning area2Place: It overlaps area1Place, which has 1024 bytes.',
    ])
    expect(warningsOf({ bufferPlace: registers(0o201776), bufferUse: 1 })).toEqual([
      'warning bufferPlace: It overlaps area1Place, which has 1024 bytes.',
    ])
    expect(warningsOf({ bufferPlace: registers(0o201776) })).toEqual([])
    expect(warningsOf({ bufferPlace: registers(0o177776), bufferUse: 1 })).toEqual([
      'warning bufferPlace: It overlaps area1Place, which has 1024 bytes.',
      'warning bufferPlace: Its 2094 bytes cross a border of 64 KB, which the areas may not do.',
    ])
  })

  test('memory saving that is set and not used', () => {
    expect(warningsOf({ area2ReceiveWords: 8 })).toEqual([
      'warning area2ReceiveWords: It has no effect: function is standard. Set function to memorySaving, or leave it out.',
    ])
  })
})

describe('read', () => {
  const area = (words: number) =>
    fc
      .integer({ min: 0, max: words })
      .chain((offset) => fc.tuple(fc.constant(offset), fc.integer({ min: 0, max: words - offset })))
  const page = fc.integer({ min: 0, max: 0x7e })
  const inPage = (bytes: number) =>
    fc
      .tuple(page, fc.integer({ min: 0, max: (0x10000 - bytes) / 2 }))
      .map(([at, word]) => registers(at * 0x10000 + 2 * word))
  const stored = fc.record({ fileNumber: fc.constant(0), fileAddress: fc.integer({ min: 0, max: 0xffff }) })
  const byte = fc.integer({ min: 0, max: 255 })
  const address = fc.oneof(
    fc.tuple(byte, byte, byte, fc.integer({ min: 1, max: 254 })).map((parts) => parts.join('.')),
    fc.record({
      parameters: fc.record({
        fileNumber: fc.integer({ min: 0, max: 0x80 }),
        fileAddress: fc.integer({ min: 0, max: 0xffff }),
      }),
    }),
  )
  const any = fc
    .record({
      address,
      tokenWatchdog: byte,
      minimumFrameInterval: byte,
      function: fc.constantFrom('standard', 'memorySaving'),
      sent1: area(512),
      sent2: area(8192),
      received1: area(512),
      received2: area(8192),
      area1Place: fc.oneof(inPage(1024), stored),
      area2Place: fc.oneof(inPage(16384), stored),
      managementPlace: fc.oneof(inPage(2), stored),
      managementTransfer: fc.constantFrom('all', 'none', 'nodesAndStates', 'all83'),
      bufferPlace: fc.oneof(inPage(2), stored),
      bufferUse: byte,
      nodeName: fc.string({ maxLength: 10 }).filter((text) => /^[\x20-\x7e]*$/.test(text)),
      sendReceiveTimeout: byte.map((tenths) => tenths * 100),
    })
    .map(({ sent1, sent2, received1, received2, ...rest }) => ({
      ...rest,
      area1SendOffset: sent1[0],
      area1SendWords: sent1[1],
      area2SendOffset: sent2[0],
      area2SendWords: sent2[1],
      area1ReceiveOffset: received1[0],
      area1ReceiveWords: received1[1],
      area2ReceiveOffset: received2[0],
      area2ReceiveWords: received2[1],
    }))

  test('gives back what was written, for all settings that are allowed', () => {
    fc.assert(
      fc.property(any, (given) => {
        const { blocks, warnings } = flNetParameters.write(given)
        expect(flNetParameters.read(blocks)).toEqual({ settings: given, problems: warnings })
        expect(flNetParameters.explain(blocks).filter(({ text }) => text.startsWith('not known'))).toEqual([])
      }),
    )
  })

  test('gives back the basic form of an address in the extended one, of the same byte', () => {
    const { blocks } = flNetParameters.write({ ...settings, area1Place: { file: 3, address: 0o1000 } })
    expect(flNetParameters.read(blocks).settings?.area1Place).toEqual(registers(0o401000))
  })

  test('any bytes give settings that are written as the same bytes, or say why not', () => {
    fc.assert(
      fc.property(fc.uint8Array({ minLength: 0o70, maxLength: 0o70 }), (bytes) => {
        const { settings: found, problems } = flNetParameters.read([{ address: 0, bytes }])
        const errors = problems.filter(({ severity }) => severity === 'error')
        if (found === undefined) expect(errors).not.toEqual([])
        else if (errors.length === 0) {
          const reserved = problems.filter(({ setting }) => setting.startsWith('reserved')).length
          const different = [...imageOf(found)].filter((byteThere, i) => byteThere !== bytes[i]).length
          expect(different > 0).toBe(reserved > 0)
        } else expect(() => flNetParameters.write(found)).toThrow()
      }),
    )
  })

  test('a unit that was never set is read, with what is missing', () => {
    const { settings: found, problems } = flNetParameters.read([{ address: 0, bytes: Buffer.alloc(0o4000) }])
    expect(found).toMatchObject({ address: '0.0.0.0', function: 'standard', nodeName: '', sendReceiveTimeout: 0 })
    expect(problems.map(({ severity, setting }) => `${severity} ${setting}`)).toEqual([
      'error address',
      'warning tokenWatchdog',
      'warning area1Place',
      'warning area2Place',
    ])
  })

  test('what no setting says and what is reserved is told with its address', () => {
    const bytes = Buffer.from(imageOf(settings))
    bytes[0o7] = 5
    bytes[0o6] = 2
    bytes[0o33] = 0x82
    bytes[0o41] = 0xb1
    bytes[0o22] = 0x80
    const { settings: found, problems } = flNetParameters.read([{ address: 0, bytes }])
    expect(found).toBeUndefined()
    expect(messagesOf(problems)).toEqual([
      'error function: Parameter 0006 holds what no setting says: 02H is none of standard, memorySaving.',
      'warning reserved07: Parameter 0007 is reserved and holds 5; writing the settings makes it 0.',
      'error area1Place: Parameter 0020 holds what no setting says: file number 80H, file address 000000 octal is no address that the unit reaches.',
      'error managementTransfer: Parameter 0033 holds what no setting says: 82H is none of all, none, nodesAndStates, all83.',
      'error nodeName: Parameter 0040 holds what no setting says: it holds other bytes than characters 20H to 7EH.',
    ])
    const texts = flNetParameters.explain([{ address: 0, bytes }]).map(({ text }) => text)
    expect(texts.slice(0, 4)).toEqual(['192.168.250.7', '10', '2', 'not known: 02H is none of standard, memorySaving'])
    expect(texts[11]).toBe('file 1, byte 00400000 octal')
  })
})
