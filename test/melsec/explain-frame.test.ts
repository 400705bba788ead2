import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { type AnnotatedRow, MASK } from '../../src/codec/annotate'
import { declare, field, type Shape } from '../../src/codec/codec'
import { maskSecrets } from '../../src/codec/explanation'
import { ProtocolError, RequestError } from '../../src/errors'
import type { NamedCommand } from '../../src/link/link'
import { aCompatibleCommands } from '../../src/melsec/a-compatible/commands'
import { aCompatibleProtocol } from '../../src/melsec/a-compatible/protocol'
import type { Command } from '../../src/melsec/commands/command'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import { explainFrame, type FrameExplanation, formatExplanation } from '../../src/melsec/explain/frame'
import type { ExplainFrameOptions } from '../../src/melsec/explain/options'
import { frameFacts, type SlmpFrameName, slmpFrameNames } from '../../src/melsec/frame/frames'
import { type SlmpHead, slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import { bytesOf, type FrameVector, type Message, vectorsOfKind } from '../vectors/vectors'
import { expectMessage, explained, lines, uncovered } from './explained'

type Code = 'binary' | 'ascii'
const head: SlmpHead = { network: 0, station: 0xff, moduleIo: 0x3ff, multidrop: 0, timer: 16 }
const REGISTRATION = { words: [{ device: { device: 'D', number: 0 } }], doubleWords: [] } as const

const requestVectors = [...vectorsOfKind('slmp', 'requestData'), ...vectorsOfKind('mc-serial', 'requestData')]
const responseVectors = [...vectorsOfKind('slmp', 'responseData'), ...vectorsOfKind('mc-serial', 'responseData')]

interface Asked {
  readonly code: Code
  readonly command: string
  readonly form?: 'short' | 'long' | 'extendedShort' | 'extendedLong'
  readonly xyRadix?: 8
}

function protocolOf({ code, xyRadix }: Pick<Asked, 'code' | 'xyRadix'>, frame: SlmpFrameName = '3E') {
  return new MelsecProtocol({
    framing: slmpFraming(frame, code),
    head,
    profile: resolveProfile('generic'),
    code,
    asciiZr: 'decimal',
    ...(xyRadix === 8 ? { asciiXy: 'octal' } : {}),
  })
}

/** The frame of a request with this message. */
function requestFrame(
  asked: Asked,
  message: Message | Readonly<Record<string, unknown>>,
  frame: SlmpFrameName,
  serial = 0,
) {
  const protocol = protocolOf(asked, frame)
  const command: Command = commands[asked.command as CommandName]
  const exchange = protocol.exchange(command, message, {
    ...(asked.form === undefined ? {} : { form: asked.form }),
    context: REGISTRATION,
  })
  return protocol.framing.request.write(head, serial, exchange.body)
}

const octal = ({ xyRadix }: { readonly xyRadix?: 8 }): ExplainFrameOptions =>
  xyRadix === 8 ? { asciiXy: 'octal', xyRadix } : {}

describe('3E, 4E and station extension frames of the manuals', () => {
  const vectors = vectorsOfKind('slmp', 'frame')

  test.each(vectors)('$id: frame, code, side and head are told from the bytes', (vector) => {
    const explanation = explained(bytesOf(vector), octal(vector))
    const { frame, code, side, head: known, endCode } = vector
    expect(explanation).toMatchObject({ frame, code, direction: side })
    expect(explanation.serial).toBe(known?.serial)
    expect(explanation.endCode).toBe(endCode)
    const shown = Object.fromEntries(headOf(explanation).map(({ name, value }) => [name, value]))
    expect(shown).toMatchObject({
      ...known?.route,
      ...(known?.timer === undefined ? {} : { monitoringTimer: known.timer }),
    })
  })

  test.each(vectors.filter(({ side }) => side === 'request'))('$id: the request field by field', (vector) => {
    const explanation = explained(bytesOf(vector), octal(vector))
    expect(explanation.command).toBe(vector.command)
    expectMessage(explanation, vector.message)
  })

  const answers = vectors.filter(({ side }) => side === 'response')
  test.each(answers)('$id: the answer field by field with its request', (vector) => {
    const request = requestOf(vector)
    const explanation = explained(bytesOf(vector), { ...octal(vector), request })
    expect(explanation.command).toBe(vector.command)
    const rows = explanation.rows.slice(headOf(explanation).length)
    expectMessage({ ...explanation, rows }, vector.errorInformation ?? vector.message)
    expect(explanation.notes).toEqual([])
  })

  test.each(answers)('$id: without its request the values have no names, and it is said why', (vector) => {
    const { rows, notes, command } = explained(bytesOf(vector))
    // The station extension frame repeats the command.
    expect(command).toBe(vector.frame === 'ext' && vector.endCode === 0 ? vector.command : undefined)
    const data = rows.filter(({ name }) => name.startsWith('data') && name !== 'dataLength')
    expect(notes).toEqual(data.length === 0 ? [] : [expect.stringContaining('the request')])
  })

  /** Rows up to timer or end code: the error information has fields of the same names. */
  function headOf({ rows }: FrameExplanation): readonly AnnotatedRow[] {
    return rows.slice(0, rows.findIndex(({ name }) => name === 'dataLength') + 2)
  }

  function requestOf(vector: FrameVector): Buffer {
    if (vector.request === undefined) throw new Error(`${vector.id} has no request`)
    return requestFrame(vector, vector.request, vector.frame as SlmpFrameName, vector.head?.serial)
  }
})

/** Data of the manuals that the frame can carry. */
function carried<V extends { readonly code: Code }>(frame: SlmpFrameName, vectors: readonly V[]): V[] {
  return vectors.filter(({ code }) => frameFacts[frame].codes.includes(code))
}

/** Fixed value and system area of the station extension frame. */
const RESERVED = Buffer.alloc(6)

/** Body of a request with this command, subcommand and data. */
function requestBody(frame: SlmpFrameName, data: Buffer): Buffer {
  return frame === 'ext' ? Buffer.concat([data.subarray(0, 4), RESERVED, data.subarray(4)]) : data
}

/** Body of the answer to a request: the station extension frame repeats its command. */
function answerBody(frame: SlmpFrameName, vector: (typeof responseVectors)[number]): Buffer {
  if (frame !== 'ext') return bytesOf(vector)
  const request = requestFrame(vector, vector.request, frame)
  return Buffer.concat([request.subarray(18, 22), RESERVED, bytesOf(vector)])
}

describe.each(slmpFrameNames)('the data of the manuals in a %s frame', (frame) => {
  test.each(carried(frame, requestVectors))('$id', (vector) => {
    const { request } = slmpFraming(frame, vector.code)
    const explanation = explained(request.write(head, 0x1234, requestBody(frame, bytesOf(vector))), octal(vector))
    expect(explanation.command).toBe(vector.command)
    expectMessage(explanation, vector.message)
  })

  test.each(carried(frame, responseVectors))('$id', (vector) => {
    const bytes = slmpFraming(frame, vector.code).response.write(head, 0x1234, 0, answerBody(frame, vector))
    const registration = { ...vector, command: 'entryMonitorDevice' }
    const explanation = explained(bytes, {
      ...octal(vector),
      request: requestFrame(vector, vector.request, frame, 0x1234),
      ...(vector.registration === undefined
        ? {}
        : { registration: requestFrame(registration, vector.registration, frame) }),
    })
    expect(explanation.command).toBe(vector.command)
    expectMessage(explanation, vector.message)
    expect(explanation.notes).toEqual([])
  })
})

describe('words', () => {
  const binary = { code: 'binary' } as const
  const read = (device: string, number: number, points: number, command = 'readWords') =>
    requestFrame({ ...binary, command }, { head: { device, number }, points }, '3E')
  const answer = (body: readonly number[]) => slmpFraming('3E', 'binary').response.write(head, 0, 0, Buffer.from(body))

  test('say devices as GX Works does, with the values that belong to them', () => {
    expect(lines(explained(answer([0xd2, 4, 0xff, 0xff]), { request: read('W', 0x1f, 2) }))).toContain(
      'values: W1F..W20: 1234 -1',
    )
    expect(lines(explained(answer([0xd2, 4]), { request: read('D', 100, 1) }))).toContain('values: D100: 1234 (04D2H)')
    expect(lines(explained(answer([0x01, 0x80]), { request: read('M', 16, 1) }))).toContain(
      'values: M16..M31: ON M16 M31',
    )
    expect(lines(explained(answer([0, 0]), { request: read('X', 0x20, 1) }))).toContain('values: X20..X2F: all OFF')
    expect(lines(explained(answer([0x10]), { request: read('Y', 0x1e, 2, 'readBits') }))).toContain(
      'values: Y1E..Y1F: 1 0',
    )
    const timer = requestFrame(
      { ...binary, command: 'readWords', form: 'long' },
      { head: { device: 'LTN', number: 3 }, points: 4 },
      '3E',
    )
    expect(lines(explained(answer([1, 0, 0, 0, 3, 0, 0, 0]), { request: timer }))).toContain(
      'values: LTN3 word 0..LTN3 word 3: 1 0 3 0',
    )
  })

  test('number X and Y as the family does', () => {
    const request = read('X', 15, 1, 'readBits')
    expect(lines(explained(request))).toContain('head: XF (input)')
    expect(lines(explained(request, { profile: 'iq-f' }))).toContain('head: X17 (input)')
    expect(lines(explained(request, { profile: 'iq-f', xyRadix: 16 }))).toContain('head: XF (input)')
  })

  test('number W as it is said', () => {
    const request = read('W', 902, 1)
    expect(lines(explained(request))).toContain('head: W386 (link register)')
    expect(lines(explained(request, { wRadix: 10 }))).toContain('head: W902 (link register)')
    const inAscii = requestFrame(
      { code: 'ascii', command: 'readWords' },
      { head: { device: 'W', number: 902 }, points: 1 },
      '3E',
    )
    expect(explained(inAscii, { wRadix: 10 }).notes.join()).toMatch(/^W is read as hexadecimal digits/)
    expect(explained(inAscii).notes).toEqual([])
  })

  test('name each value of a random read and of blocks', () => {
    const words = [{ device: { device: 'D', number: 5 } }, { device: { device: 'W', number: 16 } }]
    const random = requestFrame(
      { ...binary, command: 'readRandom' },
      { words, doubleWords: [{ device: { device: 'D', number: 8 } }] },
      '3E',
    )
    expect(lines(explained(answer([1, 0, 2, 0, 0xff, 0xff, 0xff, 0xff]), { request: random }))).toEqual(
      expect.arrayContaining(['words: D5..W10: 1 2', 'doubleWords: D8: -1 (FFFFFFFFH)']),
    )
    const blocks = {
      wordBlocks: [{ head: { device: 'D', number: 0 }, points: 1 }],
      bitBlocks: [{ head: { device: 'M', number: 32 }, points: 1 }],
    }
    const request = requestFrame({ ...binary, command: 'readBlock' }, blocks, '3E')
    expect(lines(explained(answer([7, 0, 2, 0]), { request }))).toEqual(
      expect.arrayContaining(['wordBlocks.0: D0: 7 (0007H)', 'bitBlocks.0: M32..M47: ON M33']),
    )
  })

  test('explain timer, length, route, subcommand, set and reset', () => {
    const bits = [{ device: { device: 'M', number: 7 }, value: true }]
    const bytes = requestFrame({ ...binary, command: 'writeRandomBits', form: 'long' }, { bits }, '3E')
    expect(lines(explained(bytes))).toEqual(
      expect.arrayContaining([
        'station: 255 (FFH: the connected station)',
        'moduleIo: 03FFH (own station, control CPU)',
        'monitoringTimer: 16 (4000 ms)',
        'dataLength: 15 (bytes that follow)',
        'command: 1402H (Write Random (bit units))',
        'subcommand: 0003H (bit units, device code and number in the long (iQ-R) form)',
        'bits.0.device: M7 (internal relay)',
        'bits.0.value: 1 (set: ON)',
      ]),
    )
  })

  test('explain an end code with meaning and remedy, and who reported it', () => {
    const body = Buffer.from('00ffff030001040000', 'hex')
    const bytes = slmpFraming('4E', 'binary').response.write(head, 5, 0xc056, body)
    const explanation = explained(bytes, {
      request: requestFrame(
        { ...binary, command: 'readWords' },
        { head: { device: 'D', number: 1 }, points: 1 },
        '4E',
        5,
      ),
    })
    expect(explanation).toMatchObject({ serial: 5, endCode: 0xc056, command: 'readWords' })
    expect(lines(explanation)).toEqual(
      expect.arrayContaining([
        expect.stringMatching(/^endCode: C056H \(refused\) .* Check device name and number/),
        'command: 0401H (Read (word units))',
        'subcommand: 0000H (word units, device code and number in the short form)',
      ]),
    )
  })

  test('identify a CPU by its model code', () => {
    const request = requestFrame({ ...binary, command: 'readTypeName' }, {}, '3E')
    const body = Buffer.concat([Buffer.from('R08CPU          '), Buffer.from('0148', 'hex')])
    expect(lines(explained(slmpFraming('3E', 'binary').response.write(head, 0, 0, body), { request }))).toEqual(
      expect.arrayContaining(['model: "R08CPU          "', 'modelCode: 4801H (R08CPU)']),
    )
  })

  test('say which settings were assumed in ASCII code', () => {
    const x = requestFrame(
      { code: 'ascii', command: 'readBits', xyRadix: 8 },
      { head: { device: 'X', number: 8 }, points: 1 },
      '3E',
    )
    const zr = requestFrame(
      { code: 'ascii', command: 'readWords' },
      { head: { device: 'ZR', number: 8 }, points: 1 },
      '3E',
    )
    const notes = (bytes: Buffer, options: ExplainFrameOptions) => explained(bytes, options).notes
    expect(notes(x, { profile: 'iq-f' })).toEqual([expect.stringContaining('octal')])
    expect(notes(x, { profile: 'iq-f', asciiXy: 'octal' })).toEqual([])
    expect(notes(zr, {})).toEqual([expect.stringContaining('decimal')])
    expect(notes(zr, { asciiZr: 'decimal' })).toEqual([])
  })

  test('keep the data of a command nobody declared', () => {
    const bytes = slmpFraming('3E', 'binary').request.write(head, 0, Buffer.from('3412000001020304', 'hex'))
    const explanation = explained(bytes)
    expect(explanation.command).toBeUndefined()
    expect(explanation.title).toContain('command 1234H, subcommand 0000H')
    expect(explanation.notes).toEqual([expect.stringContaining('No command is known')])
    expect(explanation.rows.at(-1)).toMatchObject({ name: 'data', bytes: '01 02 03 04' })
  })
})

describe('what is wrong', () => {
  const good = Buffer.from('500000ffff03000c00100001040000640000a80a00', 'hex')
  const wrong = (bytes: Buffer, options: ExplainFrameOptions = {}) => {
    const explanation = explainFrame(bytes, options)
    expect(uncovered(explanation, bytes)).toBeUndefined()
    return explanation
  }

  test('a frame that is cut short is explained up to there', () => {
    for (let length = 1; length < good.length; length++) {
      const { fault, rows } = wrong(good.subarray(0, length))
      expect(fault?.offset).toBeLessThanOrEqual(length)
      expect(rows.filter(({ name }) => name === 'not read').length).toBeLessThanOrEqual(1)
    }
    expect(wrong(good.subarray(0, -1)).fault).toEqual({
      offset: 19,
      name: 'points',
      message: 'needs 2 more byte(s), has 1',
    })
    expect(wrong(good.subarray(0, -1)).notes).toEqual([expect.stringContaining('1 of the 12 bytes')])
  })

  test('bytes behind the frame are counted', () => {
    const explanation = explainFrame(Buffer.concat([good, good]))
    expect(explanation).toMatchObject({ rest: good.length })
    expect(explanation.fault).toBeUndefined()
    expect(formatExplanation(explanation)).toContain(`${good.length} byte(s) follow this frame.`)
  })

  test('a wrong byte is named with its place and field', () => {
    const device = Buffer.from(good)
    device[18] = 0x01
    expect(wrong(device).fault).toMatchObject({
      offset: 19,
      name: 'head',
      message: expect.stringContaining('not a device code'),
    })
    const length = Buffer.from(good)
    length[7] = 1
    expect(wrong(length).fault).toMatchObject({ offset: 7, name: 'dataLength' })
    const longer = Buffer.concat([good, Buffer.of(0)])
    longer[7] = 13
    expect(wrong(longer).fault).toEqual({ offset: 21, message: '1 byte(s) left over' })
    const digit = Buffer.from('500000FF03FF00001800100401000ZM*0000000002')
    expect(wrong(digit).fault).toMatchObject({ offset: 29, name: 'subcommand' })
  })

  test.each([
    ['nothing', '', {}, 'there are no bytes'],
    ['no subheader', 'ffff', {}, 'no 3E, 4E or station extension subheader'],
    [
      'another frame than said',
      '500000ffff0300',
      { frame: '4E' },
      'this is the subheader of a 3E request, binary code',
    ],
    [
      'another code than said',
      '500000ffff0300',
      { code: 'ascii' },
      'this is the subheader of a 3E request, binary code',
    ],
    ['too little of ASCII code', '35', {}, 'too few to tell'],
  ] as const)('%s', (_what, hex, options, message) => {
    const { fault, frame } = wrong(Buffer.from(hex, 'hex'), options)
    expect(frame).toBeUndefined()
    expect(fault).toMatchObject({ offset: 0, message: expect.stringContaining(message) })
  })

  test.each([
    ['4700', 'frame JW'],
    ['01ff0a00', 'frame 1E'],
    ['ffff', undefined],
  ])('%s: what else it may be is hinted at', (hex, hint) => {
    expect(explainFrame(Buffer.from(hex, 'hex')).notes).toEqual(
      hint === undefined ? [] : [expect.stringContaining(hint)],
    )
  })

  test("a request that is none, or another answer's, is said", () => {
    const answer = slmpFraming('4E', 'binary').response.write(head, 7, 0, Buffer.of(1, 0))
    const asked = (serial: number) =>
      requestFrame(
        { code: 'binary', command: 'readWords' },
        { head: { device: 'D', number: 1 }, points: 1 },
        '4E',
        serial,
      )
    expect(explainFrame(answer, { request: asked(7) }).notes).toEqual([])
    expect(explainFrame(answer, { request: asked(8) }).notes).toEqual([expect.stringContaining('does not answer it')])
    expect(explainFrame(answer, { request: Buffer.from('junk') }).notes).toContain(
      'The frame given as request is no request that can be read.',
    )
    expect(explainFrame(answer, { request: answer }).notes).toContain(
      'The frame given as request is no request that can be read.',
    )
  })

  test('an unknown profile is a mistake of the caller', () => {
    const profile = 'q9' as 'q'
    expect(() => explainFrame(good, { profile })).toThrow(RequestError)
  })
})

/** A frame with some bytes changed, taken away or added. */
function mutated(frame: Buffer): fc.Arbitrary<Buffer> {
  const change = fc.tuple(fc.nat(frame.length - 1), fc.integer({ min: 0, max: 255 }))
  return fc
    .tuple(fc.array(change, { maxLength: 3 }), fc.nat(frame.length), fc.uint8Array({ maxLength: 3 }), fc.boolean())
    .map(([changes, length, added, whole]) => {
      const bytes = Buffer.concat([frame.subarray(0, whole ? frame.length : length), added])
      for (const [place, byte] of changes) if (place < bytes.length) bytes[place] = byte
      return bytes
    })
}

describe('mutated frames', () => {
  test.each(slmpFrameNames)(
    '%s requests: never an exception, and a fault exactly where the PLC side finds one',
    (frame) => {
      const frames = carried(frame, requestVectors).map((vector) => ({
        vector,
        bytes: slmpFraming(frame, vector.code).request.write(head, 9, requestBody(frame, bytesOf(vector))),
      }))
      const one = fc
        .constantFrom(...frames)
        .chain(({ vector, bytes }) => fc.record({ vector: fc.constant(vector), bytes: mutated(bytes) }))
      fc.assert(
        fc.property(one, ({ vector, bytes }) => {
          const options: ExplainFrameOptions = { ...octal(vector), frame, code: vector.code, direction: 'request' }
          const explanation = explainFrame(bytes, options)
          expect(uncovered(explanation, bytes)).toBeUndefined()
          expect([bytes.toString('hex'), explanation.fault === undefined]).toEqual([
            bytes.toString('hex'),
            readable(vector, frame, bytes),
          ])
        }),
        { numRuns: 1500, endOnFailure: true },
      )
    },
  )

  function readable(vector: (typeof requestVectors)[number], frame: SlmpFrameName, bytes: Buffer): boolean {
    const protocol = protocolOf(vector, frame)
    try {
      const scanned = protocol.framing.request.scan(bytes, () => undefined)
      if (scanned === undefined) return false
      protocol.readRequest(scanned.frame)
      return true
    } catch (error) {
      if (error instanceof ProtocolError) return false
      throw error
    }
  }

  const kinds = ['3E', 'ext'] as const
  test.each(kinds)('%s answers, with and without their request: never an exception, every byte in a row', (frame) => {
    const one = fc.constantFrom(...carried(frame, responseVectors)).chain((vector) => {
      const bytes = slmpFraming(frame, vector.code).response.write(head, 0, 0, answerBody(frame, vector))
      return fc.record({ vector: fc.constant(vector), bytes: mutated(bytes), asked: fc.boolean() })
    })
    fc.assert(
      fc.property(one, ({ vector, bytes, asked }) => {
        const request = requestFrame(vector, vector.request, frame)
        const explanation = explainFrame(bytes, { ...octal(vector), ...(asked ? { request } : {}) })
        expect(uncovered(explanation, bytes)).toBeUndefined()
        expect(formatExplanation(explanation)).toEqual(expect.any(String))
      }),
      { numRuns: 1000, endOnFailure: true },
    )
  })

  test('any bytes as any frame: never an exception, every byte in a row', () => {
    const frames = [undefined, '3E', '4E', 'ext', '1E', '1C', '3C', '4C'] as const
    const starts = [
      '',
      '5000',
      'd000',
      '5400',
      'd400',
      '6800',
      'e800',
      '35303030',
      '44343030',
      '1002',
      '1002f800',
      '053030',
      '02463930',
      '06',
      '15463830',
      '04',
    ].map((hex) => Buffer.from(hex, 'hex'))
    fc.assert(
      fc.property(
        fc.constantFrom(...frames),
        fc.constantFrom(...starts),
        fc.uint8Array({ maxLength: 60 }),
        fc.boolean(),
        (frame, start, rest, self) => {
          const bytes = Buffer.concat([start, rest])
          const explanation = explainFrame(bytes, {
            ...(frame === undefined ? {} : { frame }),
            ...(self ? { request: bytes } : {}),
          })
          expect(uncovered(explanation, bytes)).toBeUndefined()
        },
      ),
      { numRuns: 2000, endOnFailure: true },
    )
  })
})

describe('1E frames', () => {
  const frames = vectorsOfKind('mc-ethernet-1e', 'frame')

  test.each(frames)('$id: the head', (vector) => {
    const explanation = explained(bytesOf(vector), { frame: '1E' })
    expect(explanation).toMatchObject({ frame: '1E', code: vector.code, direction: vector.side })
    expect(explanation.endCode).toBe(vector.endCode)
    const shown = Object.fromEntries(explanation.rows.map(({ name, value }) => [name, value]))
    const { pc, timer } = vector.head ?? {}
    expect(shown).toMatchObject({
      ...(pc === undefined ? {} : { pc }),
      ...(timer === undefined ? {} : { monitoringTimer: timer }),
    })
  })

  test.each(frames.filter(({ side }) => side === 'request'))('$id: the data', (vector) => {
    expectMessage(explained(bytesOf(vector), { frame: '1E' }), vector.message)
  })

  test.each(vectorsOfKind('mc-ethernet-1e', 'responseData'))('$id: an answer with its request', (vector) => {
    const protocol = aCompatibleProtocol({ code: vector.code, asciiXy: 'hexadecimal' })
    const command: NamedCommand | undefined = Object.values(aCompatibleCommands).find(
      ({ name }) => name === vector.command,
    )
    if (command === undefined) throw new Error(`no command ${vector.command}`)
    const request = protocol.exchange(command, vector.request).write(0)
    const bytes = protocol.framing.response.write({ command: command.code, pc: 0, timer: 0 }, 0, 0, bytesOf(vector))
    const explanation = explained(bytes, { frame: '1E', request })
    expect(explanation.command).toBe(vector.command)
    expectMessage(explanation, vector.message)
  })

  test('an answer with its request, also one with an abnormal code or to another command', () => {
    const request = Buffer.from('01ff0a00640000002044 0300'.replaceAll(' ', ''), 'hex')
    const options = { frame: '1E', request } as const
    expect(lines(explained(Buffer.from('8100010002000300', 'hex'), options))).toEqual([
      'subheader: 81H (Batch read (word units)) answer',
      'endCode: 00H (carried out)',
      'values: D100..D102: 1 2 3',
    ])
    expect(explainFrame(Buffer.from('8100010002000300ff', 'hex'), options).rest).toBe(1)
    expect(explainFrame(Buffer.from('81000100', 'hex'), options).fault).toMatchObject({ name: 'values', offset: 2 })
    expect(lines(explained(Buffer.from('815b10', 'hex'), options)).at(-1)).toMatch(
      /^abnormalCode: 10H: There is no station with this PC No\./,
    )
    expect(explainFrame(Buffer.from('8200', 'hex'), options).fault).toMatchObject({ offset: 0, name: 'subheader' })
  })

  test('the byte 00H of an FX3 behind type code and abnormal code', () => {
    const request = Buffer.from('15ff0000', 'hex')
    const answer = explainFrame(Buffer.from('9500f300', 'hex'), { frame: '1E', request })
    expect(answer).toMatchObject({ rest: 0 })
    expect(answer.fault).toBeUndefined()
    expect(lines(answer).slice(-2)).toEqual([expect.stringMatching(/^typeCode: F3H/), 'reserved: fixed, of FX3'])
    expect(explainFrame(Buffer.from('9500f3', 'hex'), { frame: '1E', request }).fault).toBeUndefined()
    expect(lines(explained(Buffer.from('815b1000', 'hex'), { frame: '1E' })).at(-1)).toBe('reserved: fixed, of FX3')
    expect(explainFrame(Buffer.from('9500f301', 'hex'), { frame: '1E', request }).fault).toMatchObject({
      name: 'reserved',
    })
  })

  test('digits of X and Y in ASCII code: a setting of an iQ-F, none of an FX3', () => {
    const request = Buffer.from('02FF000A592000000010010010')
    const iqF = explainFrame(request, { frame: '1E', profile: 'iq-f' })
    expect([iqF.title, iqF.notes]).toEqual([expect.stringContaining('Y10'), [expect.stringContaining('say asciiXy')]])
    const fx3 = explainFrame(request, { frame: '1E', profile: 'fx3' })
    expect([fx3.title, fx3.notes]).toEqual([expect.stringContaining('Y20'), []])
  })
})

describe('secrets', () => {
  const shape = {
    length: field.countOf('password', 2),
    password: field.text('length', { secret: true }),
  } as const satisfies Shape
  const secretCommands = declare({
    unlock: {
      title: 'Unlock',
      code: 0x1630,
      unit: 'none',
      effect: 'control',
      manual: 'test',
      request: shape,
      response: {},
    },
  })
  const body = Buffer.from('3016000008006875 6e746572322178'.replaceAll(' ', ''), 'hex').subarray(0, 14)
  const frame = slmpFraming('3E', 'binary').request.write(head, 0, body)

  test('are asterisks in rows, in text and in the bytes a trace keeps', () => {
    const explanation = explained(frame, { commands: secretCommands })
    expect(explanation.rows.at(-1)).toMatchObject({ name: 'password', value: MASK, text: MASK, secret: true })
    const shown = `${JSON.stringify(explanation)}${formatExplanation(explanation)}`
    for (const leak of ['hunter', '68 75 6E', '68756e']) expect(shown).not.toContain(leak)
    const kept = maskSecrets(frame, explanation)
    expect(kept.toString('latin1')).toContain('********')
    expect(kept.toString('latin1')).not.toContain('hunter')
    expect(kept.subarray(0, -8)).toEqual(frame.subarray(0, -8))
  })

  test('stay hidden in a frame that is cut short or too long', () => {
    for (const bytes of [frame.subarray(0, -2), withLength(frame, 20)]) {
      const explanation = explainFrame(bytes, { commands: secretCommands })
      expect(explanation.fault).toBeDefined()
      expect(`${JSON.stringify(explanation)}${formatExplanation(explanation)}`).not.toMatch(/hunter|68 75 6E|unter/)
      expect(maskSecrets(bytes, explanation).toString('latin1')).not.toContain('hunter')
    }
  })

  function withLength(bytes: Buffer, length: number): Buffer {
    const changed = Buffer.from(bytes)
    changed[15] = length
    return changed
  }
})

test('the text is aligned: title, then offset, bytes, field and meaning', () => {
  const bytes = Buffer.from('500000ffff03000c00100001040000640000a80a00', 'hex')
  expect(formatExplanation(explainFrame(bytes))).toBe(
    [
      '3E request, binary code: Read (word units), D100, 10 points',
      '     0  50 00        subheader        3E request, binary code',
      '     2  00           network          0 (network of the connected station)',
      '     3  FF           station          255 (FFH: the connected station)',
      '     4  FF 03        moduleIo         03FFH (own station, control CPU)',
      '     6  00           multidrop        0 (no multidrop station)',
      '     7  0C 00        dataLength       12 (bytes that follow)',
      '     9  10 00        monitoringTimer  16 (4000 ms)',
      '    11  01 04        command          0401H (Read (word units))',
      '    13  00 00        subcommand       0000H (word units, device code and number in the short form)',
      '    15  64 00 00 A8  head             D100 (data register)',
      '    19  0A 00        points           10 (words; of bit devices 16 points each)',
    ].join('\n'),
  )
})
