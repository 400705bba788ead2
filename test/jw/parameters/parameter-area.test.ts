/** Start switch, check code, classic addresses and the two notations of memory addresses. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import {
  type AddressNotation,
  byteOf,
  type ParameterAddress,
  placeOf,
  storedAddress,
} from '../../../src/jw/parameters/memory-address'
import {
  checkCodeOf,
  fromClassicAddress,
  parameterArea,
  startProcedure,
  startSwitch,
  toClassicAddress,
} from '../../../src/jw/parameters/parameter-area'
import { serialInterfaceProblems } from '../../../src/jw/parameters/serial-interface-unit'
import { unitErrors } from '../../../src/jw/parameters/unit-errors'
import { unitNumbers } from '../../../src/jw/parameters/unit-number'
import { type FrameVector, vectorsOfKind } from '../../vectors/vectors'
import { messagesOf, refusal } from './problems'

describe('the start switch', () => {
  /** Requests of 12H and 02H among the vectors, which hold address and bytes. */
  const vectors: readonly FrameVector[] = vectorsOfKind('jw', 'frame')
  const requestOf = (id: string) => vectors.find((vector) => vector.id === id)?.hex.slice(10)
  const hexOf = (address: number, bytes: Uint8Array) => {
    const head = Buffer.alloc(4)
    head.writeUInt16LE(address, 0)
    head.writeUInt16LE(bytes.length, 2)
    return Buffer.concat([head, bytes]).toString('hex')
  }

  test('is stopped as the vector of 12H says, and then read as that of 02H says', () => {
    const [stop] = startProcedure([])
    expect(stop).toMatchObject({ kind: 'write', purpose: 'stop' })
    if (stop?.kind !== 'write') throw new Error('no write')
    expect(hexOf(stop.block.address, stop.block.bytes)).toBe(requestOf('jw.12.stop.req'))
    expect(hexOf(parameterArea.startSwitch, Buffer.alloc(1)).slice(0, 8)).toBe(requestOf('jw.02.startsw.req'))
  })

  test('is 0 before the parameters and 1 behind them; then the check code is read', () => {
    const bytes = Buffer.alloc(0o3776, 7)
    const steps = startProcedure([{ address: 0, bytes }])
    expect(steps.map((step) => step.purpose)).toEqual(['stop', 'parameters', 'parameters', 'start', 'checkCode'])
    expect(steps[3]).toEqual({ kind: 'write', purpose: 'start', block: { address: 0o3777, bytes: Uint8Array.of(1) } })
    expect(steps[4]).toEqual({ kind: 'read', purpose: 'checkCode', address: 0o3776, length: 2 })
    const written = steps.flatMap((step) => (step.purpose === 'parameters' ? [step.block] : []))
    expect(written.map(({ address, bytes: some }) => [address, some.length])).toEqual([
      [0, 1024],
      [1024, 1022],
    ])
  })

  test('and the check code are no parameters to be given', () => {
    const message =
      'The parameters reach 3776 and 3777: check code and start switch are written by the procedure itself. Leave them out.'
    expect(refusal(() => startProcedure([{ address: 0o3777, bytes: Uint8Array.of(1) }])).message).toBe(message)
    expect(refusal(() => startProcedure([{ address: 0o3775, bytes: Uint8Array.of(1, 2) }])).message).toBe(message)
    expect(startProcedure([{ address: 0o3775, bytes: Uint8Array.of(1) }])).toHaveLength(4)
  })

  test.each<[unknown, string]>([
    [[{ address: 0, bytes: Buffer.alloc(0) }], 'The block at address 0000 has no bytes. Leave it out.'],
    [
      [{ address: 0o3777, bytes: Buffer.alloc(2) }],
      'Parameters have the addresses 0000 to 3777 octal; 2 bytes from 2047 on leave them.',
    ],
    [
      [{ address: -1, bytes: Buffer.alloc(1) }],
      'Parameters have the addresses 0000 to 3777 octal; 1 bytes from -1 on leave them.',
    ],
    [
      [
        { address: 5, bytes: Buffer.alloc(1) },
        { address: 0, bytes: Buffer.alloc(6) },
      ],
      'Two blocks of parameters hold address 0005. Give each address once.',
    ],
    [[[1, 2]], 'A block of parameters is an object with address (a whole number) and bytes, not an array of 2.'],
    [
      [{ address: 1.5, bytes: Buffer.alloc(1) }],
      'A block of parameters is an object with address (a whole number) and bytes, not a value of type object.',
    ],
    [7, 'Parameters are a list of blocks with address and bytes, not 7.'],
  ])('%j are refused', (blocks, message) => {
    expect(refusal(() => startProcedure(blocks as Parameters<typeof startProcedure>[0])).message).toBe(message)
  })

  test('has values and refusals as data', () => {
    expect(startSwitch).toEqual({ stop: 0, start: 1, likelyRefusals: [0x07, 0x10] })
  })

  test('the check code is that of 0000 to 3775, whatever stands behind them', () => {
    const parameters = Buffer.alloc(0o4000)
    parameters[0] = 0xff
    parameters[0o3775] = 0x03
    parameters[0o3776] = 0x55
    parameters[0o3777] = 0x01
    expect(checkCodeOf(parameters)).toBe(0x02)
  })
})

describe('classic addresses of JW-22CM and JW-21MN', () => {
  test('are 4000 octal higher', () => {
    expect(fromClassicAddress(0o4000)).toBe(0)
    expect(fromClassicAddress(0o7777)).toBe(0o3777)
    for (let address = 0; address <= 0o3777; address++)
      expect(fromClassicAddress(toClassicAddress(address))).toBe(address)
  })

  test.each([0o3777, 0o10000, 0o4000 + 0.5, Number.NaN])('%d is none', (classic) => {
    expect(() => fromClassicAddress(classic)).toThrow(
      expect.objectContaining({ code: 'OUT_OF_RANGE', message: expect.stringContaining('4000 to 7777 octal') }),
    )
  })

  test.each([-1, 0o4000, 1.5])('%d has none', (address) => {
    expect(() => toClassicAddress(address)).toThrow(expect.objectContaining({ code: 'OUT_OF_RANGE' }))
  })
})

describe('memory addresses in parameters', () => {
  const registers = (address: number) => ({ file: 1, address, extended: true }) as const

  /** Rows of the manual's tables: byte address of the file register, file number, file address. */
  test.each<[AddressNotation, number, number, number]>([
    ['whole', 0o00000000, 0x01, 0o000000],
    ['whole', 0o00177777, 0x01, 0o177777],
    ['whole', 0o00200000, 0x02, 0o000000],
    ['whole', 0o00377777, 0x02, 0o177777],
    ['whole', 0o37600000, 0x80, 0o000000],
    ['whole', 0o37777777, 0x80, 0o177777],
    ['halved', 0o00000000, 0x01, 0o000000],
    ['halved', 0o00177776, 0x01, 0o077777],
    ['halved', 0o00200000, 0x02, 0o000000],
    ['halved', 0o00377776, 0x02, 0o077777],
    ['halved', 0o37400000, 0x7f, 0o000000],
    ['halved', 0o37577776, 0x7f, 0o077777],
  ])('%s: byte %d of the file registers is file %d, address %d', (notation, address, fileNumber, fileAddress) => {
    expect(storedAddress(registers(address), notation)).toEqual({ fileNumber, fileAddress })
    expect(placeOf({ fileNumber, fileAddress }, notation)).toEqual(registers(address))
  })

  test('a place goes there and back, and both forms of an address are the same place', () => {
    const notation = fc.constantFrom<AddressNotation>('whole', 'halved')
    fc.assert(
      fc.property(notation, fc.integer({ min: 0, max: 0o37577777 }), (how, byte) => {
        const place = registers(how === 'halved' ? byte - (byte % 2) : byte)
        expect(placeOf(storedAddress(place, how), how)).toEqual(place)
        const basic = { file: 1 + (place.address >> 16), address: place.address & 0xffff }
        expect(storedAddress(basic, how)).toEqual(storedAddress(place, how))
        expect(byteOf(place, how)).toBe(0x10000 + place.address)
      }),
    )
  })

  test('file 0 is whole in bytes; of the FL-net units it is not printed', () => {
    expect(storedAddress({ file: 0, address: 0o4000 }, 'whole')).toEqual({ fileNumber: 0, fileAddress: 0o4000 })
    expect(placeOf({ fileNumber: 0, fileAddress: 0o4000 }, 'whole')).toEqual({ file: 0, address: 0o4000 })
    expect(placeOf({ fileNumber: 0, fileAddress: 0o4000 }, 'halved')).toBeUndefined()
    expect(() => storedAddress({ file: 0, address: 0o4000 }, 'halved')).toThrow('not printed')
  })

  test.each<[unknown, string]>([
    ['09000', 'must be an address as { file: 0, address }, { file: 1'],
    [undefined, 'must be an address as { file: 0, address }, { file: 1'],
    [{ file: 0x81, address: 0 }, 'file is 129, must be 0 to 128'],
    [{ file: 2, address: 0x10000 }, 'address is 65536, must be 0 to 177777 octal'],
    [{ file: 2, address: 0, extended: true }, 'file is 2, must be 0 to 1'],
    [{ file: 1, address: 0, extended: 1 }, 'extended is 1, must be true or left out'],
    [{ file: 1, address: '0', extended: true }, 'address is 0, must be'],
    [{ fileNumber: 1 }, 'fileAddress is undefined, must be 0 to 177777 octal'],
  ])('%j is refused', (place, reason) => {
    expect(() => storedAddress(place as ParameterAddress, 'whole')).toThrow(reason)
  })
})

describe('the JW-22SU', () => {
  test('has 0 at 0042', () => {
    expect(serialInterfaceProblems([{ address: 0o40, bytes: Buffer.of(1, 2, 0, 4) }])).toEqual([])
    expect(serialInterfaceProblems([{ address: 0o43, bytes: Buffer.of(1) }])).toEqual([])
    expect(messagesOf(serialInterfaceProblems([{ address: 0o40, bytes: Buffer.of(0, 0, 1) }]))).toEqual([
      'error 0042: Parameter 0042 is 1, must be 0 (error 3CH): control relays cannot be in file registers.',
    ])
  })
})

describe('data', () => {
  test('errors of units about their parameters, in four languages', () => {
    expect(unitErrors.map(({ code }) => code)).toEqual([0x70, 0x3c, 0x7f])
    for (const { meaning, remedy } of unitErrors)
      for (const texts of [meaning, remedy]) expect(new Set(Object.values(texts)).size).toBe(4)
  })

  test('unit numbers of a JW300: 7 was added where the manual says so', () => {
    const added = unitNumbers.filter(({ last }) => last.jw300 > last.jw20h30h).map(({ units }) => units)
    expect(added).toEqual([
      'JW-255CM, JW-25TCM',
      'JW-22FL5, JW-22FLT, JW-20FL5, JW-20FLT',
      'JW-22CM, JW-21MN, standard',
      'JW-22SU',
    ])
  })
})
