import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { ProtocolError, RequestError } from '../../src/errors'
import { checkAddress } from '../../src/melsec/device/access'
import {
  deviceAddress,
  FORM_EXTENDED,
  FORM_LONG,
  FORM_XY_OCTAL,
  FORM_ZR_HEX,
  formNeededBy,
  formProblem,
} from '../../src/melsec/device/codec'
import type { DeviceAddress, DeviceName } from '../../src/melsec/device/device'
import { anyAddress, read, readBytes, write } from './device-bytes'

const SHORT = 0
const LONG = FORM_LONG
const EXTENDED = FORM_EXTENDED
const EXTENDED_LONG = FORM_EXTENDED | FORM_LONG
const FORMS = [SHORT, LONG, EXTENDED, EXTENDED_LONG]

// The manual's table (SLMP reference manual p. 36-38; S: iQ-F communication manual), typed from it, each device with
// the number 1A0H = 416: [device, short binary, short ASCII, long binary, long ASCII]. `-`: no such form.
const TABLE: [DeviceName, string, string, string, string][] = [
  ['SM', 'a0010091', 'SM000416', 'a00100009100', 'SM**00000416'],
  ['SD', 'a00100a9', 'SD000416', 'a0010000a900', 'SD**00000416'],
  ['X', 'a001009c', 'X*0001A0', 'a00100009c00', 'X***000001A0'],
  ['Y', 'a001009d', 'Y*0001A0', 'a00100009d00', 'Y***000001A0'],
  ['M', 'a0010090', 'M*000416', 'a00100009000', 'M***00000416'],
  ['L', 'a0010092', 'L*000416', 'a00100009200', 'L***00000416'],
  ['F', 'a0010093', 'F*000416', 'a00100009300', 'F***00000416'],
  ['V', 'a0010094', 'V*000416', 'a00100009400', 'V***00000416'],
  ['B', 'a00100a0', 'B*0001A0', 'a0010000a000', 'B***000001A0'],
  ['D', 'a00100a8', 'D*000416', 'a0010000a800', 'D***00000416'],
  ['W', 'a00100b4', 'W*0001A0', 'a0010000b400', 'W***000001A0'],
  ['TS', 'a00100c1', 'TS000416', 'a0010000c100', 'TS**00000416'],
  ['TC', 'a00100c0', 'TC000416', 'a0010000c000', 'TC**00000416'],
  ['TN', 'a00100c2', 'TN000416', 'a0010000c200', 'TN**00000416'],
  ['LTS', '-', '-', 'a00100005100', 'LTS*00000416'],
  ['LTC', '-', '-', 'a00100005000', 'LTC*00000416'],
  ['LTN', '-', '-', 'a00100005200', 'LTN*00000416'],
  ['STS', 'a00100c7', 'SS000416', 'a0010000c700', 'STS*00000416'],
  ['STC', 'a00100c6', 'SC000416', 'a0010000c600', 'STC*00000416'],
  ['STN', 'a00100c8', 'SN000416', 'a0010000c800', 'STN*00000416'],
  ['LSTS', '-', '-', 'a00100005900', 'LSTS00000416'],
  ['LSTC', '-', '-', 'a00100005800', 'LSTC00000416'],
  ['LSTN', '-', '-', 'a00100005a00', 'LSTN00000416'],
  ['CS', 'a00100c4', 'CS000416', 'a0010000c400', 'CS**00000416'],
  ['CC', 'a00100c3', 'CC000416', 'a0010000c300', 'CC**00000416'],
  ['CN', 'a00100c5', 'CN000416', 'a0010000c500', 'CN**00000416'],
  ['LCS', '-', '-', 'a00100005500', 'LCS*00000416'],
  ['LCC', '-', '-', 'a00100005400', 'LCC*00000416'],
  ['LCN', '-', '-', 'a00100005600', 'LCN*00000416'],
  ['SB', 'a00100a1', 'SB0001A0', 'a0010000a100', 'SB**000001A0'],
  ['SW', 'a00100b5', 'SW0001A0', 'a0010000b500', 'SW**000001A0'],
  ['S', 'a0010098', 'S*000416', 'a00100009800', 'S***00000416'],
  ['DX', 'a00100a2', 'DX0001A0', 'a0010000a200', 'DX**000001A0'],
  ['DY', 'a00100a3', 'DY0001A0', 'a0010000a300', 'DY**000001A0'],
  ['Z', 'a00100cc', 'Z*000416', 'a0010000cc00', 'Z***00000416'],
  ['LZ', 'a0010062', 'LZ000416', 'a00100006200', 'LZ**00000416'],
  ['R', 'a00100af', 'R*000416', 'a0010000af00', 'R***00000416'],
  ['ZR', 'a00100b0', 'ZR000416', 'a0010000b000', 'ZR**00000416'],
  ['RD', '-', '-', 'a00100002c00', 'RD**00000416'],
]

describe.each(TABLE)('%s of the manual', (device, shortBinary, shortAscii, longBinary, longAscii) => {
  const address = { device, number: 0x1a0 }
  const forms: [string, string, boolean, number][] = [
    ['short binary', shortBinary, false, SHORT],
    ['short ASCII', shortAscii, true, SHORT],
    ['long binary', longBinary, false, LONG],
    ['long ASCII', longAscii, true, LONG],
  ]
  test.each(forms)('%s: %s', (_title, bytes, ascii, form) => {
    if (bytes === '-') {
      expect(() => write(deviceAddress, address, ascii, form)).toThrow(/long form/)
      return
    }
    expect(write(deviceAddress, address, ascii, form)).toBe(bytes)
    expect(read(deviceAddress, bytes, ascii, form)).toEqual(address)
  })

  test('ASCII codes padded with spaces and numbers with leading spaces are read as well', () => {
    for (const [bytes, form, width] of [
      [shortAscii, SHORT, 2],
      [longAscii, LONG, 4],
    ] as const) {
      if (bytes === '-') continue
      const digits = bytes.slice(width).replace(/^0+/, (zeros) => ' '.repeat(zeros.length))
      expect(read(deviceAddress, bytes.slice(0, width).replaceAll('*', ' ') + digits, true, form)).toEqual(address)
    }
  })
})

describe('extended form (SLMP manual appendix 1, the examples printed there)', () => {
  const EXAMPLES: [string, DeviceAddress, number, string, string | undefined][] = [
    [
      'J1\\W100',
      { device: 'W', number: 0x100, extension: { kind: 'link', network: 1 } },
      EXTENDED,
      '0000000100b400000100f9',
      '00J001000W*000100000',
    ],
    [
      'U3\\G1',
      { device: 'G', number: 1, extension: { kind: 'module', unit: 3 } },
      EXTENDED,
      '0000010000ab00000300f8',
      '00U003000G*000001000',
    ],
    [
      'U3E0\\G1',
      { device: 'G', number: 1, extension: { kind: 'cpu', cpu: 1 } },
      EXTENDED_LONG,
      '000001000000ab000000e003fa',
      '00U3E00000G***00000000010000',
    ],
    [
      'J1Z0\\W100',
      {
        device: 'W',
        number: 0x100,
        extension: { kind: 'link', network: 1 },
        extensionIndex: { register: 'Z', number: 0 },
      },
      EXTENDED,
      '0000000100b400400100f9',
      '00J001Z00W*000100000',
    ],
    [
      'D100Z4',
      { device: 'D', number: 100, index: { register: 'Z', number: 4 } },
      EXTENDED,
      '0440640000a80000000000',
      '000000000D*000100Z04',
    ],
    ['@D0', { device: 'D', number: 0, indirect: true }, EXTENDED, '0008000000a80000000000', '0@0000000D*000000000'],
  ]
  test.each(EXAMPLES)('%s', (_title, address, form, binary, ascii) => {
    expect(write(deviceAddress, address, false, form)).toBe(binary)
    expect(read(deviceAddress, binary, false, form)).toEqual(address)
    if (ascii === undefined) return
    expect(write(deviceAddress, address, true, form)).toBe(ascii)
    expect(read(deviceAddress, ascii, true, form)).toEqual(address)
  })

  const RULES: [string, DeviceAddress, number, string, string][] = [
    ['plain device', { device: 'D', number: 100 }, EXTENDED, '0000640000a80000000000', '000000000D*000100000'],
    [
      'plain device, long',
      { device: 'D', number: 100 },
      EXTENDED_LONG,
      '000064000000a8000000000000',
      '0000000000D***00000001000000',
    ],
    [
      'long timer contact: only the extended long form reaches it on an FX5',
      { device: 'LCS', number: 5 },
      EXTENDED_LONG,
      '00000500000055000000000000',
      '0000000000LCS*00000000050000',
    ],
    [
      'LZ index',
      { device: 'D', number: 100, index: { register: 'LZ', number: 12 } },
      EXTENDED_LONG,
      '0c8064000000a8000000000000',
      '0000000000D***0000000100LZ12',
    ],
    [
      'Z index, long',
      { device: 'M', number: 0, index: { register: 'Z', number: 24 } },
      EXTENDED_LONG,
      '18400000000090000000000000',
      '0000000000M***0000000000Z 24',
    ],
    [
      'indirect with index',
      { device: 'D', number: 0, index: { register: 'Z', number: 4 }, indirect: true },
      EXTENDED,
      '0448000000a80000000000',
      '0@0000000D*000000Z04',
    ],
    [
      'indirect with LZ',
      { device: 'D', number: 0, index: { register: 'LZ', number: 1 }, indirect: true },
      EXTENDED_LONG,
      '018800000000a8000000000000',
      '0@00000000D***0000000000LZ01',
    ],
    [
      'module and both indexes',
      {
        device: 'G',
        number: 10,
        extension: { kind: 'module', unit: 0x1f },
        extensionIndex: { register: 'Z', number: 1 },
        index: { register: 'Z', number: 2 },
      },
      EXTENDED_LONG,
      '02400a000000ab0001401f00f8',
      '00U01FZ 01G***0000000010Z 02',
    ],
    [
      'CPU buffer memory, fixed scan communication area',
      { device: 'HG', number: 100, extension: { kind: 'cpu', cpu: 4 } },
      EXTENDED_LONG,
      '0000640000002e000000e303fa',
      '00U3E30000HG**00000001000000',
    ],
    [
      'network 239 is EF',
      { device: 'X', number: 0x1f, extension: { kind: 'link', network: 239 } },
      EXTENDED,
      '00001f00009c0000ef00f9',
      '00J0EF000X*00001F000',
    ],
  ]
  test.each(RULES)('%s', (_title, address, form, binary, ascii) => {
    expect(write(deviceAddress, address, false, form)).toBe(binary)
    expect(read(deviceAddress, binary, false, form)).toEqual(address)
    expect(write(deviceAddress, address, true, form)).toBe(ascii)
    expect(read(deviceAddress, ascii, true, form)).toEqual(address)
  })
})

describe('radix of the ASCII digits', () => {
  test('X and Y in octal when the PLC is set so, hexadecimal otherwise, and the number itself in binary', () => {
    const y45 = { device: 'Y', number: 0o45 } as const
    expect(write(deviceAddress, y45, true, SHORT)).toBe('Y*000025')
    expect(write(deviceAddress, y45, true, FORM_XY_OCTAL)).toBe('Y*000045')
    expect(write(deviceAddress, y45, true, LONG | FORM_XY_OCTAL)).toBe('Y***00000045')
    expect(write(deviceAddress, y45, true, EXTENDED_LONG | FORM_XY_OCTAL)).toBe('0000000000Y***00000000450000')
    expect(write(deviceAddress, y45, false, FORM_XY_OCTAL)).toBe('2500009d')
    expect(read(deviceAddress, 'X*000017', true, FORM_XY_OCTAL)).toEqual({ device: 'X', number: 15 })
    expect(read(deviceAddress, 'X*000017', true, SHORT)).toEqual({ device: 'X', number: 23 })
  })

  test('8 and 9 are no octal digits', () => {
    expect(() => read(deviceAddress, 'X*000018', true, FORM_XY_OCTAL)).toThrow(/radix 8/)
  })

  test('link direct X and direct access DX stay hexadecimal under the octal setting', () => {
    const link = { device: 'X', number: 31, extension: { kind: 'link', network: 1 } } as const
    expect(write(deviceAddress, link, true, EXTENDED | FORM_XY_OCTAL)).toBe('00J001000X*00001F000')
    expect(read(deviceAddress, '00J001000X*00001F000', true, EXTENDED | FORM_XY_OCTAL)).toEqual(link)
    expect(write(deviceAddress, { device: 'DX', number: 31 }, true, FORM_XY_OCTAL)).toBe('DX00001F')
  })

  test('ZR is decimal as GX Works and the FX5 manual have it, and hexadecimal with FORM_ZR_HEX as the SLMP manual prints it', () => {
    const address = { device: 'ZR', number: 32768 } as const
    expect(write(deviceAddress, address, true, SHORT)).toBe('ZR032768')
    expect(write(deviceAddress, address, true, FORM_ZR_HEX)).toBe('ZR008000')
    expect(read(deviceAddress, 'ZR008000', true, FORM_ZR_HEX)).toEqual(address)
    expect(write(deviceAddress, { device: 'D', number: 100 }, true, FORM_ZR_HEX)).toBe('D*000100')
  })
})

describe('what a form cannot say is refused before anything is written', () => {
  const link: DeviceAddress = { device: 'W', number: 0, extension: { kind: 'link', network: 1 } }
  const cpu: DeviceAddress = { device: 'G', number: 0, extension: { kind: 'cpu', cpu: 1 } }
  const lz: DeviceAddress = { device: 'D', number: 0, index: { register: 'LZ', number: 0 } }
  const CASES: [DeviceAddress, boolean, number, string][] = [
    [{ device: 'LTN', number: 0 }, false, SHORT, 'UNSUPPORTED'],
    [{ device: 'RD', number: 0 }, true, EXTENDED, 'UNSUPPORTED'],
    [link, false, SHORT, 'UNSUPPORTED'],
    [link, true, LONG, 'UNSUPPORTED'],
    [{ device: 'D', number: 0, index: { register: 'Z', number: 0 } }, true, LONG, 'UNSUPPORTED'],
    [{ device: 'D', number: 0, indirect: true }, false, LONG, 'UNSUPPORTED'],
    [cpu, true, EXTENDED, 'UNSUPPORTED'],
    [cpu, false, EXTENDED, 'UNSUPPORTED'],
    [lz, true, EXTENDED, 'UNSUPPORTED'],
    [lz, false, EXTENDED, 'UNSUPPORTED'],
    [{ device: 'D', number: 0x1000000 }, false, SHORT, 'OUT_OF_RANGE'],
    [{ device: 'D', number: 1000000 }, true, SHORT, 'OUT_OF_RANGE'],
    [{ device: 'D', number: 100000000 }, true, LONG, 'OUT_OF_RANGE'],
    [{ device: 'W', number: 0x1000000 }, true, SHORT, 'OUT_OF_RANGE'],
    [{ device: 'X', number: 0o1000000 }, true, FORM_XY_OCTAL, 'OUT_OF_RANGE'],
    [{ device: 'D', number: -1 }, false, SHORT, 'OUT_OF_RANGE'],
    [{ device: 'G', number: 1 }, false, SHORT, 'BAD_ADDRESS'],
  ]
  test.each(CASES)('%j, ASCII %s, form %d: %s', (address, ascii, form, code) => {
    expect.assertions(2)
    try {
      write(deviceAddress, address, ascii, form)
    } catch (error) {
      expect(error).toBeInstanceOf(RequestError)
      expect(error).toHaveProperty('code', code)
    }
  })

  test('the last number of each form is carried', () => {
    const roundTrip = (address: DeviceAddress, ascii: boolean, form: number) =>
      expect(read(deviceAddress, write(deviceAddress, address, ascii, form), ascii, form)).toEqual(address)
    roundTrip({ device: 'D', number: 0xffffff }, false, SHORT)
    roundTrip({ device: 'D', number: 0xffffffff }, false, LONG)
    roundTrip({ device: 'D', number: 999999 }, true, SHORT)
    roundTrip({ device: 'D', number: 99999999 }, true, LONG)
    roundTrip({ device: 'W', number: 0xffffffff }, true, LONG)
    roundTrip({ device: 'D', number: 0xffffffff }, true, EXTENDED_LONG)
    roundTrip({ device: 'X', number: 0o777777 }, true, FORM_XY_OCTAL)
    roundTrip({ device: 'X', number: 0o7777777777 }, true, EXTENDED_LONG | FORM_XY_OCTAL)
  })
})

describe('received bytes that are no device address', () => {
  const CASES: [string, string, boolean, number, string][] = [
    ['unknown code', '000000ff', false, SHORT, 'BAD_FIELD'],
    ['unknown long code', '00000000a801', false, LONG, 'BAD_FIELD'],
    ['long-form device in the short form', '00000052', false, SHORT, 'BAD_FIELD'],
    ['G without a module', '000000ab', false, SHORT, 'BAD_FIELD'],
    ['unknown ASCII code', 'Q*000000', true, SHORT, 'BAD_FIELD'],
    ['lower-case code', 'd*000000', true, SHORT, 'BAD_FIELD'],
    ['mixed padding', 'D* *00000000', true, LONG, 'BAD_FIELD'],
    ['hexadecimal digit of a decimal device', 'D*00001F', true, SHORT, 'BAD_DIGIT'],
    ['letter behind F', 'W*00001g', true, SHORT, 'BAD_DIGIT'],
    ['lower-case digit of a decimal device', 'D*00001f', true, SHORT, 'BAD_DIGIT'],
    ['space behind a digit', 'D*0001 0', true, SHORT, 'BAD_DIGIT'],
    ['no digit at all', 'D*      ', true, SHORT, 'BAD_DIGIT'],
    ['number above 32 bits', '0000000000D***99999999990000', true, EXTENDED_LONG, 'BAD_FIELD'],
    ['modification register without its kind', '0400640000a80000000000', false, EXTENDED, 'BAD_FIELD'],
    ['unknown modification', '0420640000a80000000000', false, EXTENDED, 'BAD_FIELD'],
    ['register out of range', '1940640000a80000000000', false, EXTENDED, 'BAD_FIELD'],
    ['LZ in the short form', '0080640000a80000000000', false, EXTENDED, 'BAD_FIELD'],
    ['extension without direct memory', '0000000100b40000010000', false, EXTENDED, 'BAD_FIELD'],
    ['unknown direct memory', '0000000100b400000100f7', false, EXTENDED, 'BAD_FIELD'],
    ['module that is a CPU', '0000010000ab0000e003f8', false, EXTENDED, 'BAD_FIELD'],
    ['CPU that is a module', '000001000000ab0000000300fa', false, EXTENDED_LONG, 'BAD_FIELD'],
    ['extension modification without extension', '0000640000a80040000000', false, EXTENDED, 'BAD_FIELD'],
    ['extension modification by LZ', '0000000100b400800100f9', false, EXTENDED, 'BAD_FIELD'],
    ['network 0', '0000000100b400000000f9', false, EXTENDED, 'BAD_FIELD'],
    ['D on a network', '0000640000a800000100f9', false, EXTENDED, 'BAD_FIELD'],
    ['indirect bit device', '0008640000900000000000', false, EXTENDED, 'BAD_FIELD'],
    ['neither 00 nor 0@', '@00000000D*000100000', true, EXTENDED, 'BAD_FIELD'],
    ['unknown extension', '00K001000W*000100000', true, EXTENDED, 'BAD_FIELD'],
    ['extension digit', '00J00G000W*000100000', true, EXTENDED, 'BAD_DIGIT'],
    ['modification', '000000000D*000100Y04', true, EXTENDED, 'BAD_FIELD'],
    ['modification digit', '000000000D*000100Z0A', true, EXTENDED, 'BAD_DIGIT'],
    ['long Z without its space', '0000000000D***0000000100Z004', true, EXTENDED_LONG, 'BAD_FIELD'],
    ['ASCII extension modification by LZ', '00J001LZ00W***00000001000000', true, EXTENDED_LONG, 'BAD_FIELD'],
    ['ASCII extension modification alone', '000000Z00W*000100000', true, EXTENDED, 'BAD_FIELD'],
    ['too short', '0000', false, SHORT, 'TRUNCATED'],
  ]
  test.each(CASES)('%s', (_title, bytes, ascii, form, code) => {
    expect.assertions(2)
    try {
      read(deviceAddress, bytes, ascii, form)
    } catch (error) {
      expect(error).toBeInstanceOf(ProtocolError)
      expect(error).toHaveProperty('code', code)
    }
  })
})

describe('properties', () => {
  const forms = fc
    .record({
      base: fc.constantFrom(...FORMS),
      octal: fc.boolean(),
      zrHex: fc.boolean(),
      ascii: fc.boolean(),
    })
    .map(({ base, octal, zrHex, ascii }) => ({
      ascii,
      form: base | (octal ? FORM_XY_OCTAL : 0) | (zrHex ? FORM_ZR_HEX : 0),
    }))

  test('what a form can say is read back the same, in exactly size() bytes; the rest is refused', () => {
    fc.assert(
      fc.property(anyAddress, forms, (address, { ascii, form }) => {
        if (formProblem(address, ascii, form) !== undefined) {
          expect(() => write(deviceAddress, address, ascii, form)).toThrow(RequestError)
          return
        }
        const text = write(deviceAddress, address, ascii, form)
        expect(read(deviceAddress, text, ascii, form)).toEqual(address)
        expect(text.length).toBe(deviceAddress.size(ascii, form) * (ascii ? 1 : 2))
      }),
      { numRuns: 1000 },
    )
  })

  test('formNeededBy() names a form that says the address, unless only its number is too large for it', () => {
    fc.assert(
      fc.property(anyAddress, fc.boolean(), (address, ascii) => {
        const problem = formProblem(address, ascii, formNeededBy(address))
        expect(problem?.code).not.toBe('UNSUPPORTED')
        if (address.number <= 0x3ffff) expect(problem).toBeUndefined()
      }),
    )
  })

  test('any bytes give an address that can be written again, or a ProtocolError', () => {
    const codes = fc.constantFrom(0x9c, 0xa8, 0xab, 0xb4, 0x2e, 0x52, 0x90, 0xb0, 0x40, 0x80, 0xf8, 0xf9, 0xfa, 0)
    const bytes = fc.array(fc.oneof(fc.integer({ min: 0, max: 255 }), codes), { minLength: 0, maxLength: 14 })
    const text = fc.string({ unit: fc.constantFrom(...'0123456789ABCDEFJUZL@*GHDWX '), maxLength: 30 })
    const input = fc.oneof(
      bytes.map((values) => Buffer.from(values)),
      text.map((value) => Buffer.from(value, 'latin1')),
    )
    fc.assert(
      fc.property(input, forms, (raw, { ascii, form }) => {
        // Cut or fill to the size of the form, so that most runs get past the length check.
        const bytes = Buffer.alloc(deviceAddress.size(ascii, form), ascii ? 0x30 : 0)
        raw.copy(bytes)
        let address: DeviceAddress
        try {
          address = readBytes(deviceAddress, bytes, ascii, form)
        } catch (error) {
          expect(error).toBeInstanceOf(ProtocolError)
          return
        }
        checkAddress(address)
        expect(read(deviceAddress, write(deviceAddress, address, ascii, form), ascii, form)).toEqual(address)
      }),
      { numRuns: 2500 },
    )
  })

  test('bytes of every length give a value or a ProtocolError', () => {
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 30 }), forms, (raw, { ascii, form }) => {
        try {
          readBytes(deviceAddress, Buffer.from(raw), ascii, form)
        } catch (error) {
          expect(error).toBeInstanceOf(ProtocolError)
        }
      }),
    )
  })
})
