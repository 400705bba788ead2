import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { RequestError } from '../../src/errors'
import { addressProblem } from '../../src/melsec/device/access'
import { type AddressOptions, formatDevice, formatParsedDevice, parseDevice } from '../../src/melsec/device/address'
import { type DeviceAddress, devices } from '../../src/melsec/device/device'
import { anyAddress } from './device-bytes'

const HEX: AddressOptions = { xyRadix: 16 }
const OCTAL: AddressOptions = { xyRadix: 8 }

function messageOf(text: string, options = HEX): string {
  try {
    parseDevice(text, options)
  } catch (error) {
    if (error instanceof RequestError) return `${error.code} ${error.message}`
    throw error
  }
  return 'no error'
}

describe('spellings of device and number', () => {
  const SPELLINGS: [string, string, number][] = [
    ['D100', 'D', 100],
    ['M0', 'M', 0],
    ['X1F', 'X', 0x1f],
    ['XFFF', 'X', 0xfff],
    ['Y10', 'Y', 0x10],
    ['W1F', 'W', 0x1f],
    ['WABC', 'W', 0xabc],
    ['BABC', 'B', 0xabc],
    ['BB', 'B', 0xb],
    ['BD10', 'B', 0xd10],
    ['SB10', 'SB', 0x10],
    ['SBB', 'SB', 0xb],
    ['SWF', 'SW', 0xf],
    ['DX1F', 'DX', 0x1f],
    ['DYA', 'DY', 0xa],
    ['ZR32768', 'ZR', 32768],
    ['R32767', 'R', 32767],
    ['RD100', 'RD', 100],
    ['Z5', 'Z', 5],
    ['LZ0', 'LZ', 0],
    ['L10', 'L', 10],
    ['S4095', 'S', 4095],
    ['SM400', 'SM', 400],
    ['SD203', 'SD', 203],
    ['F9', 'F', 9],
    ['V3', 'V', 3],
    ['TN5', 'TN', 5],
    ['TS5', 'TS', 5],
    ['TC5', 'TC', 5],
    ['STN5', 'STN', 5],
    ['STS5', 'STS', 5],
    ['STC5', 'STC', 5],
    ['LTN5', 'LTN', 5],
    ['LTS5', 'LTS', 5],
    ['LTC5', 'LTC', 5],
    ['LSTN5', 'LSTN', 5],
    ['LSTS5', 'LSTS', 5],
    ['LSTC5', 'LSTC', 5],
    ['CN5', 'CN', 5],
    ['CS5', 'CS', 5],
    ['CC5', 'CC', 5],
    ['LCN5', 'LCN', 5],
    ['LCS5', 'LCS', 5],
    ['LCC5', 'LCC', 5],
    ['D4294967295', 'D', 0xffffffff],
  ]
  test.each(SPELLINGS)('%s is %s %d', (text, device, number) => {
    expect(parseDevice(text, HEX)).toEqual({ address: { device, number } })
    expect(parseDevice(text.toLowerCase(), HEX)).toEqual({ address: { device, number } })
    expect(formatDevice(parseDevice(text, HEX).address, HEX)).toBe(text)
  })

  test('case, leading zeros and spaces around do not matter, and the canonical text has none of them', () => {
    for (const [text, canonical] of [
      ['  d0100 ', 'D100'],
      ['x01f', 'X1F'],
      ['X000', 'X0'],
      ['w0a', 'WA'],
      ['k4m016', 'K4M16'],
      ['d0100.f', 'D100.F'],
      ['d0100z02', 'D100Z2'],
      ['j001/w010', 'J1\\W10'],
      ['u003¥g0100', 'U3\\G100'],
      ['u3e0/hg0100', 'U3E0\\HG100'],
      ['@d00', '@D0'],
    ] as const) {
      expect(formatParsedDevice(parseDevice(text, HEX), HEX)).toBe(canonical)
    }
  })
})

describe('X and Y by their numbering', () => {
  test('octal: X17 is 15, hexadecimal: 23', () => {
    expect(parseDevice('X17', OCTAL).address).toEqual({ device: 'X', number: 15 })
    expect(parseDevice('X17', HEX).address).toEqual({ device: 'X', number: 23 })
    expect(formatDevice({ device: 'Y', number: 31 }, OCTAL)).toBe('Y37')
    expect(formatDevice({ device: 'Y', number: 31 }, HEX)).toBe('Y1F')
  })

  test.each(['X8', 'Y9', 'X18', 'X1F', 'YA', 'K4X18'])('%s is refused in octal and told how to change it', (text) => {
    const message = messageOf(text, OCTAL)
    expect(message).toMatch(/^BAD_ADDRESS/)
    expect(message).toContain('octal')
    expect(message).toContain('xyRadix: 16')
    expect(messageOf(text, HEX)).toBe('no error')
  })

  test('nothing but X and Y changes with it', () => {
    for (const text of ['B1F', 'W1F', 'DX1F', 'SB1F', 'D99', 'J1\\X1F']) {
      expect(parseDevice(text, OCTAL)).toEqual(parseDevice(text, HEX))
    }
  })

  test('another radix is an option error, not a wrong number', () => {
    const wrong: AddressOptions = JSON.parse('{ "xyRadix": 10 }')
    expect(messageOf('X10', wrong)).toMatch(/^BAD_OPTION/)
    expect(() => formatDevice({ device: 'X', number: 10 }, wrong)).toThrow(RequestError)
  })
})

test('ZR is decimal unless overridden', () => {
  expect(parseDevice('ZR100', HEX).address.number).toBe(100)
  const override: AddressOptions = { xyRadix: 16, radixOverrides: { ZR: 16 } }
  expect(parseDevice('ZR1FF', override).address.number).toBe(0x1ff)
  expect(formatDevice({ device: 'ZR', number: 0x1ff }, override)).toBe('ZR1FF')
  expect(messageOf('ZR1FF')).toContain('decimal')
})

describe('bits and digits', () => {
  test('D100.F is bit 15, with any word device, any place and an index', () => {
    expect(parseDevice('D100.F', HEX)).toEqual({ address: { device: 'D', number: 100 }, bit: 15 })
    expect(parseDevice('w1f.0', HEX)).toEqual({ address: { device: 'W', number: 0x1f }, bit: 0 })
    expect(parseDevice('U3\\G100.a', HEX).bit).toBe(10)
    expect(parseDevice('D100Z2.5', HEX)).toEqual({
      address: { device: 'D', number: 100, index: { register: 'Z', number: 2 } },
      bit: 5,
    })
  })

  test('K4M0 is 4 digits of M0', () => {
    expect(parseDevice('K4M0', HEX)).toEqual({ address: { device: 'M', number: 0 }, digits: 4 })
    expect(parseDevice('J1\\K8X10', HEX)).toEqual({
      address: { device: 'X', number: 16, extension: { kind: 'link', network: 1 } },
      digits: 8,
    })
  })

  test.each([
    ['M0.5', 'bit device already'],
    ['LTN0.5', '32 bits'],
    ['D0.G', 'one hexadecimal digit'],
    ['D0.10', 'For bit 10 write .A'],
    ['D0.15', 'For bit 15 write .F'],
    ['D0.16', 'one hexadecimal digit'],
    ['D0.', 'one hexadecimal digit'],
    ['D0.1.2', 'one hexadecimal digit'],
    ['K0M0', 'K1 to K8'],
    ['K9M0', 'K1 to K8'],
    ['K4D0', 'bit device'],
    ['K4M0.1', 'digit designation has no bit'],
  ])('%s is refused', (text, message) => {
    expect(messageOf(text)).toMatch(/^BAD_ADDRESS/)
    expect(messageOf(text)).toContain(message)
  })
})

describe('networks, modules, CPUs, index registers, @', () => {
  const SPELLINGS: [string, DeviceAddress][] = [
    ['J1\\W10', { device: 'W', number: 0x10, extension: { kind: 'link', network: 1 } }],
    ['J239\\SB1', { device: 'SB', number: 1, extension: { kind: 'link', network: 239 } }],
    ['U3\\G100', { device: 'G', number: 100, extension: { kind: 'module', unit: 3 } }],
    ['U1F\\G0', { device: 'G', number: 0, extension: { kind: 'module', unit: 0x1f } }],
    ['U3E0\\G10000', { device: 'G', number: 10000, extension: { kind: 'cpu', cpu: 1 } }],
    ['U3E3\\HG0', { device: 'HG', number: 0, extension: { kind: 'cpu', cpu: 4 } }],
    ['U3E4\\G0', { device: 'G', number: 0, extension: { kind: 'module', unit: 0x3e4 } }],
    ['D100Z2', { device: 'D', number: 100, index: { register: 'Z', number: 2 } }],
    ['D100LZ2', { device: 'D', number: 100, index: { register: 'LZ', number: 2 } }],
    ['W10Z24', { device: 'W', number: 0x10, index: { register: 'Z', number: 24 } }],
    ['ZR0Z1', { device: 'ZR', number: 0, index: { register: 'Z', number: 1 } }],
    ['LZ0LZ1', { device: 'LZ', number: 0, index: { register: 'LZ', number: 1 } }],
    ['@D0', { device: 'D', number: 0, indirect: true }],
    ['@D0Z4', { device: 'D', number: 0, index: { register: 'Z', number: 4 }, indirect: true }],
    [
      'J1Z0\\W100',
      {
        device: 'W',
        number: 0x100,
        extension: { kind: 'link', network: 1 },
        extensionIndex: { register: 'Z', number: 0 },
      },
    ],
    [
      'U3Z1\\G0Z2',
      {
        device: 'G',
        number: 0,
        extension: { kind: 'module', unit: 3 },
        extensionIndex: { register: 'Z', number: 1 },
        index: { register: 'Z', number: 2 },
      },
    ],
  ]
  test.each(SPELLINGS)('%s', (text, address) => {
    expect(parseDevice(text, HEX)).toEqual({ address })
    expect(parseDevice(text.replace('\\', '/'), HEX)).toEqual({ address })
    expect(formatDevice(address, HEX)).toBe(text)
  })

  test.each([
    ['G100', 'BAD_ADDRESS', 'U3\\G100'],
    ['HG100', 'BAD_ADDRESS', 'U3E0\\HG100'],
    ['U3\\HG0', 'BAD_ADDRESS', 'CPUs only'],
    ['U3\\D0', 'BAD_ADDRESS', 'U takes G'],
    ['J1\\D0', 'BAD_ADDRESS', 'link direct'],
    ['U0030\\G0', 'BAD_ADDRESS', 'upper three digits'],
    ['U\\G0', 'BAD_ADDRESS', 'upper three digits'],
    ['J\\W0', 'BAD_ADDRESS', 'decimal network'],
    ['JA\\W0', 'BAD_ADDRESS', 'decimal network'],
    ['J0\\W0', 'OUT_OF_RANGE', '1 to 239'],
    ['J240\\W0', 'OUT_OF_RANGE', '1 to 239'],
    ['Q1\\W0', 'BAD_ADDRESS', 'before \\'],
    ['\\W0', 'BAD_ADDRESS', 'before \\'],
    ['J1\\U3\\G0', 'BAD_ADDRESS', 'one \\'],
    ['J1LZ0\\W0', 'BAD_ADDRESS', 'LZ cannot index'],
    ['J1Z25\\W0', 'OUT_OF_RANGE', 'Z0 to Z24'],
    ['U3E0Z1\\G0', 'BAD_ADDRESS', 'cannot be indexed'],
    ['D0Z25', 'OUT_OF_RANGE', 'Z0 to Z24'],
    ['D0LZ13', 'OUT_OF_RANGE', 'LZ0 to LZ12'],
    ['D0Z', 'BAD_ADDRESS', 'decimal'],
    ['@M0', 'BAD_ADDRESS', 'word devices only'],
    ['@LTN0', 'BAD_ADDRESS', 'word devices only'],
    ['@@D0', 'BAD_ADDRESS', 'no device name'],
    ['D4294967296', 'OUT_OF_RANGE', 'whole number'],
    [`D${'9'.repeat(400)}`, 'OUT_OF_RANGE', 'whole number'],
    ['W100000000', 'OUT_OF_RANGE', 'whole number'],
  ])('%s is refused with %s', (text, code, message) => {
    expect(messageOf(text)).toMatch(new RegExp(`^${code}`))
    expect(messageOf(text)).toContain(message)
  })
})

describe('what is no address is refused with what it may have meant', () => {
  test.each([
    ['T5', 'choose TS5 (contact), TC5 (coil), TN5 (current value)'],
    ['C5', 'choose CS5 (contact), CC5 (coil), CN5 (current value)'],
    ['ST5', 'STN5 (current value)'],
    ['LT5', 'LTN5 (current value)'],
    ['LST5', 'LSTN5 (current value)'],
    ['lc5', 'LCN5 (current value)'],
    ['', 'no device name'],
    ['   ', 'no device name'],
    ['D', 'number is missing'],
    ['A100', 'there is no device A; devices are'],
    ['DQ1', 'decimal'],
    ['M1F', 'M (internal relay) stands a decimal'],
    ['X1G', 'hexadecimal'],
    ['D-1', 'decimal'],
    ['D1.5e3', 'one hexadecimal digit'],
    ['D 100', 'space'],
    ['D100:REAL', 'type (:REAL)'],
    ['D100[10]', 'count ([10])'],
    ['M0..M15', 'range'],
    ['40001', 'A number alone'],
    ['%MW10', 'IEC'],
    ['DB1.DBX0', 'Siemens'],
    ['VD100', 'Siemens'],
    ['MW10', 'Siemens'],
    ['M10.0', 'Siemens'],
    ['I0.0', 'Siemens'],
    ['DM100', 'Omron'],
    ['FD5', 'function devices'],
    ['FX0', 'function devices'],
    ['BL3', 'SFC blocks'],
    ['K100', 'Pointers, constants'],
    ['P10', 'Pointers, constants'],
    ['Ｄ１００', 'write D100 in half-width'],
    ['D100\u3000', 'write D100 in half-width'],
    ['D１', 'write D1 in half-width'],
    ['Xﬀ', 'not of an address'],
    ['д100', 'not of an address'],
    ['D100\u0000', 'not of an address'],
  ])('%j', (text, message) => {
    expect(messageOf(text)).toMatch(/^BAD_ADDRESS/)
    expect(messageOf(text)).toContain(message)
  })

  test('the message stays short whatever is typed', () => {
    for (const text of ['A', 'D', 'J', 'T1', 'D0.', 'K', '\\', '@', 'D1Z'].map((head) => head + 'Q'.repeat(5000))) {
      expect(messageOf(text).length).toBeLessThan(600)
    }
  })

  test('values that are no text', () => {
    const values: unknown[] = [undefined, null, 100, {}, ['D0']]
    for (const value of values) {
      expect(() => parseDevice(value as string, HEX)).toThrow(RequestError)
    }
  })
})

describe('W in decimal, as SLMP inverters number it', () => {
  const decimal: AddressOptions = { xyRadix: 16, wRadix: 10 }

  test('is read and written so; without the option it is hexadecimal', () => {
    expect(parseDevice('W902', decimal)).toEqual({ address: { device: 'W', number: 902 } })
    expect(parseDevice('W902.F', decimal)).toEqual({ address: { device: 'W', number: 902 }, bit: 15 })
    expect(formatDevice({ device: 'W', number: 902 }, decimal)).toBe('W902')
    expect(parseDevice('W902', HEX)).toEqual({ address: { device: 'W', number: 0x902 } })
    expect(formatDevice({ device: 'W', number: 0x902 }, { xyRadix: 16, wRadix: 16 })).toBe('W902')
  })

  test('SW, B and link direct devices stay hexadecimal', () => {
    for (const text of ['SW10', 'B10', 'SB10']) expect(parseDevice(text, decimal).address.number).toBe(16)
    const direct = parseDevice('J1\\W10', decimal)
    expect(direct.address.number).toBe(16)
    expect(formatDevice(direct.address, decimal)).toBe('J1\\W10')
  })

  test('a hexadecimal digit is refused with what to set', () => {
    expect(() => parseDevice('W1F', decimal)).toThrow(/W is numbered in decimal here.*wRadix: 16/)
    const wrong: AddressOptions = JSON.parse('{ "xyRadix": 16, "wRadix": 8 }')
    expect(() => parseDevice('W1', wrong)).toThrow('wRadix is 8; it is 10 or 16.')
  })
})

describe('properties', () => {
  const options: fc.Arbitrary<AddressOptions> = fc.record(
    {
      xyRadix: fc.constantFrom(8 as const, 16 as const),
      wRadix: fc.constantFrom(10 as const, 16 as const),
      radixOverrides: fc.record({ ZR: fc.constantFrom(10 as const, 16 as const) }),
    },
    { requiredKeys: ['xyRadix'] },
  )

  test('parsing what was formatted gives the same address, for every device and numbering', () => {
    fc.assert(
      fc.property(anyAddress, options, (address, how) => {
        expect(parseDevice(formatDevice(address, how), how)).toEqual({ address })
      }),
      { numRuns: 1500 },
    )
    for (const info of devices) {
      const address: DeviceAddress = { device: info.name, number: 0xbadc0de }
      if (addressProblem(address) !== undefined) continue
      for (const how of [HEX, OCTAL]) expect(parseDevice(formatDevice(address, how), how)).toEqual({ address })
    }
  })

  test('the same with bits and digits', () => {
    fc.assert(
      fc.property(anyAddress, fc.integer({ min: 0, max: 15 }), options, (address, number, how) => {
        const unit = devices.find((info) => info.name === address.device)?.unit
        const parsed =
          unit === 'word'
            ? { address, bit: number }
            : unit === 'bit'
              ? { address, digits: (number % 8) + 1 }
              : { address }
        expect(parseDevice(formatParsedDevice(parsed, how), how)).toEqual(parsed)
      }),
      { numRuns: 2000 },
    )
  })

  test('any text is an address whose canonical text means the same, or a RequestError', () => {
    const maybe = (...texts: string[]) =>
      fc.oneof({ weight: 6, arbitrary: fc.constant('') }, { weight: 1, arbitrary: fc.constantFrom(...texts) })
    const likely = fc
      .tuple(
        maybe('@', ' '),
        maybe('J1\\', 'U3\\', 'U3E0/', 'j2z1\\', 'U1Z2/', 'U0030\\', 'J\\'),
        maybe('K4', 'k9'),
        fc.constantFrom(...devices.map((info) => info.name), 'T', 'd', 'LST', 'ﬀ'),
        fc.constantFrom('0', '17', '0100', '8', 'F', '1F', '4294967295', '4294967296', ''),
        maybe('Z1', 'LZ2', 'Z99', 'z'),
        maybe('.5', '.F', '.10', '.'),
      )
      .map((pieces) => pieces.join(''))
    const text = fc.oneof({ weight: 1, arbitrary: fc.string() }, { weight: 4, arbitrary: likely })
    let parsedTexts = 0
    fc.assert(
      fc.property(text, options, (typed, how) => {
        let parsed: ReturnType<typeof parseDevice>
        try {
          parsed = parseDevice(typed, how)
        } catch (error) {
          expect(error).toBeInstanceOf(RequestError)
          return
        }
        parsedTexts++
        const canonical = formatParsedDevice(parsed, how)
        expect(parseDevice(canonical, how)).toEqual(parsed)
        expect(formatParsedDevice(parseDevice(canonical, how), how)).toBe(canonical)
      }),
      { numRuns: 1500 },
    )
    // Some 750 in practice: the property is not about refusals only.
    expect(parsedTexts).toBeGreaterThan(100)
  })
})
