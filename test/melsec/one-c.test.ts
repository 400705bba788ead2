/** The command set of the 1C frame: what a request may say, what goes into the frame, and what an answer is read as. */

import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { type Message, readerOf, writerOf } from '../../src/codec/codec'
import { EndCodeError, ProtocolError, RequestError } from '../../src/errors'
import type { NamedCommand } from '../../src/link/link'
import { pointLimit } from '../../src/melsec/a-compatible/device-rules'
import { fx3Windows } from '../../src/melsec/a-compatible/windows'
import { FORM_XY_OCTAL } from '../../src/melsec/device/codec'
import { type DeviceName, deviceInfo } from '../../src/melsec/device/device'
import type { SerialHead } from '../../src/melsec/frame/serial-frames'
import { isOneC, type OneCCommandName, oneCCommands } from '../../src/melsec/one-c/commands'
import { longDevice, shortDevice } from '../../src/melsec/one-c/device'
import { codeOf, frontShape } from '../../src/melsec/one-c/front'
import { type OneCOptions, oneCProtocol } from '../../src/melsec/one-c/protocol'
import { oneCLimits, oneCRules } from '../../src/melsec/one-c/rules'
import { Line } from '../link/line'
import { arbitrary } from '../support/arbitrary'
import { bytesOf, vectorsOf } from '../vectors/vectors'
import { command, framing1c, HEAD_1C, Plc1c } from './one-c-support'

function protocol(options: Partial<OneCOptions<SerialHead>> = {}) {
  return oneCProtocol({ framing: framing1c(), head: HEAD_1C, asciiXy: 'hexadecimal', ...options })
}

function exchange(name: string, message: Message, options: Partial<OneCOptions<SerialHead>> = {}) {
  return protocol(options).exchange(command(name), message)
}

function body(name: string, message: Message, options: Partial<OneCOptions<SerialHead>> = {}): string {
  return exchange(name, message, options).body.toString('latin1')
}

function refused(name: string, message: Message, options: Partial<OneCOptions<SerialHead>> = {}): RequestError {
  try {
    exchange(name, message, options)
  } catch (error) {
    if (error instanceof RequestError) return error
    throw error
  }
  throw new Error('it was not refused')
}

const at = (device: DeviceName, number: number) => ({ device, number })
const of1c = vectorsOf('mc-serial-ascii').filter((vector) => 'frame' in vector && vector.frame?.startsWith('1C'))
const xyOf = (vector: { readonly xyRadix?: 8 }) => (vector.xyRadix === 8 ? 'octal' : 'hexadecimal')

describe('vectors', () => {
  test.each(of1c.flatMap((vector) => (vector.kind === 'requestData' || vector.kind === 'prefix' ? [vector] : [])))(
    '$id is what the request says',
    (vector) => {
      const { message, messageWait = 0, hex } = vector
      const sent = exchange(vector.command, message, { messageWait, asciiXy: xyOf(vector) }).body.toString('hex')
      expect(vector.kind === 'prefix' ? sent.slice(0, hex.length) : sent).toBe(hex)
    },
  )

  test.each(of1c.flatMap((vector) => (vector.kind === 'requestData' ? [vector] : [])))(
    '$id is read by the PLC side, which also finds where it ends',
    (vector) => {
      const plc = protocol({ asciiXy: xyOf(vector) })
      const bytes = bytesOf(vector)
      expect(plc.requestLength(HEAD_1C, Buffer.concat([bytes, Buffer.from('1C')]))).toBe(bytes.length)
      for (let cut = 0; cut < bytes.length; cut++) {
        expect(plc.requestLength(HEAD_1C, bytes.subarray(0, cut))).toBeUndefined()
      }
      expect(plc.readRequest({ head: HEAD_1C, serial: undefined, body: bytes })).toMatchObject({
        command: { name: vector.command },
        message: vector.message,
      })
    },
  )

  test.each(of1c.flatMap((vector) => (vector.kind === 'responseData' ? [vector] : [])))(
    '$id is written by the PLC side and read',
    (vector) => {
      const { message, request } = vector
      const asked = exchange(vector.command, request)
      const answer = { head: HEAD_1C, serial: undefined, endCode: 0, body: bytesOf(vector) }
      expect(asked.decode(answer)).toEqual(message)
      expect(asked.answerBody()).toBe(answer.body.length)
      expect(protocol().writeResponse(command(vector.command), request, message).toString('hex')).toBe(vector.hex)
    },
  )

  test.each(of1c.flatMap((vector) => (vector.kind === 'device1C' ? [vector] : [])))('$id is the device', (vector) => {
    const codec = vector.hex.length === 10 ? shortDevice : longDevice
    const writer = writerOf('ascii')
    codec.write(writer, vector.address)
    expect(writer.take().toString('hex')).toBe(vector.hex)
    expect(codec.read(readerOf('ascii', bytesOf(vector)))).toEqual(vector.address)
  })

  test.each(of1c.flatMap((vector) => (vector.kind === 'text' && vector.field === 'command' ? [vector] : [])))(
    '$id is the code of the command',
    ({ text, hex }) => expect(command(text).code).toBe(Number.parseInt(hex, 16)),
  )

  test('the message wait of 100 ms is the digit A', () => {
    const { hex } = of1c.find(({ id }) => id === '1c-f-wait-100ms') ?? { hex: '' }
    expect(body('RR', {}, { messageWait: 100 })).toBe(`RR${Buffer.from(hex, 'hex').toString('latin1')}`)
  })
})

test('the code of a command is the characters of its name', () => {
  for (const { name, code } of Object.values<NamedCommand>(oneCCommands)) expect(codeOf(name)).toBe(code)
})

describe('the message wait', () => {
  test.each([-10, 5, 160, Number.NaN])('%s ms is refused', (messageWait) => {
    expect(() => protocol({ messageWait })).toThrow(/messageWait must be 0 to 150 ms in steps of 10/)
  })

  test('is one of sixteen digits', () => {
    for (let i = 0; i < 16; i++) {
      expect(body('PC', {}, { messageWait: 10 * i })).toBe(`PC${i.toString(16).toUpperCase()}`)
    }
    expect(() => frontShape.messageWait.codec.read(readerOf('ascii', Buffer.from('G')))).toThrow(ProtocolError)
  })
})

describe('devices', () => {
  test.each([
    ['BR', at('SM', 8000), 'BR0M800001'],
    ['BR', at('SM', 8511), 'BR0M851101'],
    ['WR', at('SD', 8000), 'WR0D800001'],
    ['QR', at('SD', 8013), 'QR0D00801301'],
    ['BR', at('LCS', 0), 'BR0CS20001'],
    ['BR', at('LCS', 55), 'BR0CS25501'],
    ['WR', at('R', 9999), 'WR0R999901'],
    ['QR', at('R', 32767), 'QR0R03276701'],
    ['BR', at('X', 0o377), 'BR0X00FF01'],
  ] as const)('%s of %j goes out under the name it has in the frame', (name, head, text) => {
    expect(body(name, { head, points: 1 })).toBe(text)
  })

  test('X and Y have octal or hexadecimal digits, as the port is set', () => {
    expect(body('BR', { head: at('Y', 0o377), points: 1 }, { asciiXy: 'octal' })).toBe('BR0Y037701')
    expect(body('BR', { head: at('Y', 0o377), points: 1 })).toBe('BR0Y00FF01')
    const error = refused('BT', { bits: [{ device: at('Y', 1), value: true }] }, { asciiXy: undefined })
    expect(error).toMatchObject({ code: 'BAD_OPTION', field: 'asciiXy' })
  })

  test('what would reach another device under the same name is refused with its right name', () => {
    for (const [device, number, right] of [
      ['M', 8000, 'SM8000'],
      ['D', 8013, 'SD8013'],
      ['CS', 201, 'LCS1'],
      ['CN', 255, 'LCN55'],
    ] as const) {
      const name = deviceInfo(device).unit === 'bit' ? 'BR' : 'WR'
      const error = refused(name, { head: at(device, number), points: 1 })
      expect(error).toMatchObject({ code: 'OUT_OF_RANGE', field: 'head' })
      expect(error.message).toContain(right)
    }
    expect(body('BR', { head: at('M', 8000), points: 1 }, { windows: fx3Windows })).toBe('BR0M800001')
  })

  test('R ends at R9999 where the command has four digits for its number', () => {
    expect(refused('WR', { head: at('R', 10_000), points: 1 }).message).toContain('only R0 to R9999')
    expect(refused('WW', { head: at('R', 9999), values: [1, 2] }).message).toContain('R ends at R9999')
    expect(refused('WT', { words: [{ device: at('R', 10_000), value: 1 }] })).toMatchObject({
      field: 'words.0.device',
    })
    expect(body('QW', { head: at('R', 9999), values: [1, 2] })).toBe('QW0R0099990200010002')
  })

  test('no request goes from data registers into special ones', () => {
    expect(refused('WR', { head: at('D', 7999), points: 2 }).message).toContain('D ends at D7999')
    expect(refused('BR', { head: at('M', 7679), points: 2 }).message).toContain('M ends at M7679')
    expect(refused('BR', { head: at('CS', 199), points: 2 }).message).toContain('CS ends at CS199')
  })

  test('in word units a bit device starts at a multiple of eight, of its number in the frame', () => {
    expect(body('WR', { head: at('M', 8), points: 1 })).toBe('WR0M000801')
    expect(refused('WR', { head: at('M', 4), points: 1 }).message).toContain('multiple of 8')
    expect(body('WW', { head: at('LCS', 8), values: [1] })).toBe('WW0CS208010001')
    expect(refused('WT', { words: [{ device: at('Y', 9), value: 1 }] }).message).toContain('multiple of 8')
  })

  test('counters of 32 bits are not taken in word units: nothing says in which order their words stand', () => {
    for (const [name, message] of [
      ['WR', { head: at('LCN', 0), points: 2 }],
      ['QW', { head: at('LCN', 0), values: [1, 2] }],
      ['WT', { words: [{ device: at('LCN', 0), value: 1 }] }],
    ] as const) {
      expect(refused(name, message).message).toContain('counter of 32 bits')
    }
  })

  test('devices that 1C does not have, extensions and index registers are refused', () => {
    expect(refused('WR', { head: at('W', 0), points: 1 }).message).toContain('cannot be addressed in a 1C frame')
    const indexed = { ...at('D', 0), index: { register: 'Z', number: 1 } }
    expect(refused('WR', { head: indexed, points: 1 })).toMatchObject({ code: 'UNSUPPORTED', field: 'head' })
    expect(refused('BR', { head: at('D', 0), points: 1 }).message).toContain('no bit device')
  })
})

describe('limits', () => {
  const heads = { bit: at('M', 0), word: at('D', 0) }
  const single = oneCLimits.filter(({ command: name }) => !name.endsWith('T'))

  test.each(single)('$command of $of devices takes $max points and no more', ({ command: name, of, max }) => {
    const message = (points: number) => ({
      head: heads[of],
      ...(name.endsWith('R') ? { points } : { values: new Array(points).fill(name === 'BW' ? false : 0) }),
    })
    expect(exchange(name, message(max)).title).toBe(oneCCommands[name].title)
    expect(refused(name, message(max + 1))).toMatchObject({ code: 'LIMIT_EXCEEDED', field: 'head' })
    expect(refused(name, message(0))).toBeInstanceOf(RequestError)
    expect(pointLimit(oneCRules, name, heads[of].device)).toBe(max)
  })

  test('256 bits are written as 00', () => {
    expect(body('BR', { head: at('M', 0), points: 256 })).toBe('BR0M000000')
  })

  test('random writes take 20 bits or 10 words', () => {
    const bits = (n: number) => ({ bits: Array.from({ length: n }, (_, i) => ({ device: at('M', i), value: true })) })
    const words = (n: number) => ({ words: Array.from({ length: n }, (_, i) => ({ device: at('D', i), value: i })) })
    expect(body('BT', bits(20)).length).toBe(5 + 20 * 6)
    expect(refused('BT', bits(21))).toMatchObject({ code: 'LIMIT_EXCEEDED', field: 'bits' })
    for (const name of ['WT', 'QT']) {
      expect(exchange(name, words(10)).effect).toBe('write')
      expect(refused(name, words(11))).toMatchObject({ code: 'LIMIT_EXCEEDED', field: 'words' })
      expect(refused(name, words(0))).toMatchObject({ code: 'BAD_MESSAGE' })
    }
  })

  test('a loopback takes 1 to 254 printable characters', () => {
    expect(body('TT', { data: 'A'.repeat(254) }).slice(0, 5)).toBe('TT0FE')
    for (const data of ['', 'A'.repeat(255), 'A\x03']) expect(refused('TT', { data }).message).toContain('data')
  })
})

describe('answers', () => {
  const answer = (endCode: number, text = '') => ({
    head: HEAD_1C,
    serial: undefined,
    endCode,
    body: Buffer.from(text, 'latin1'),
  })

  test('of another length than the request says are refused', () => {
    const asked = exchange('WR', { head: at('D', 0), points: 2 })
    expect(asked.decode(answer(0, '12345678'))).toEqual({ values: [0x1234, 0x5678] })
    for (const text of ['', '1234567', '123456789', '1234567G']) {
      expect(() => asked.decode(answer(0, text))).toThrow(ProtocolError)
    }
    expect(() => exchange('RR', {}).decode(answer(0, '00'))).toThrow(ProtocolError)
    expect(() => exchange('BR', { head: at('M', 0), points: 2 }).decode(answer(0, '02'))).toThrow(ProtocolError)
  })

  test('that refuse say what it is about and that nothing was carried out', () => {
    const asked = exchange('WW', { head: at('D', 0), values: [1] })
    const thrown = (code: number) => {
      try {
        asked.decode(answer(code))
      } catch (error) {
        if (error instanceof EndCodeError) return error
      }
      throw new Error('it was not refused')
    }
    expect(thrown(0x06)).toMatchObject({
      family: '1C',
      about: 'item',
      outcome: 'refused',
      command: 'Batch write (word units)',
    })
    expect(thrown(0x02)).toMatchObject({ about: 'transmission', outcome: 'refused' })
    expect(thrown(0x06).message).toContain('(WW) was refused with error code 06H')
    // A code that no table has tells nothing.
    expect(thrown(0x42)).toMatchObject({ about: 'unknown', outcome: 'unknown' })
  })
})

describe('the global signal', () => {
  test('goes to one station, which answers, or to all, of which none does', () => {
    expect(exchange('GW', { on: true }).answered).toBe(true)
    const all = { head: { station: 0xff, pc: 0xff } }
    expect(exchange('GW', { on: false }, all).answered).toBe(false)
    expect(body('GW', { on: false }, all)).toBe('GW00')
    expect(refused('GW', { on: 1 }).message).toContain('must be true or false')
  })

  test('is the only command for all stations', () => {
    const all = { head: { station: 0xff, pc: 0xff } }
    for (const name of ['RS', 'PC']) {
      expect(refused(name, {}, all)).toMatchObject({ code: 'UNSUPPORTED', field: 'route.station' })
    }
  })
})

const wires = (['whole', 'byte by byte'] as const).flatMap((wire) =>
  ([1, 4] as const).flatMap((format) => [true, false].map((sumCheck) => ({ wire, format, sumCheck }))),
)

describe.each(wires)('session and responder in memory, $wire, format $format, sum check $sumCheck', (how) => {
  test('every command reads what the other side wrote', () => {
    const framing = framing1c(how.format, { sumCheck: how.sumCheck })
    const mc = protocol({ framing, asciiXy: 'octal' })
    const plc = new Plc1c(mc)
    const line = new Line(
      framing,
      {
        bodyLength: (head, soFar) => mc.requestLength(head, soFar),
        answer(frame) {
          const answer = plc.answer(frame)
          return plc.seen.at(-1)?.name === 'RS' ? { endCode: 0x18, body: Buffer.alloc(0) } : answer
        },
      },
      how.wire,
    )
    const values = [0, 1, 0x0303, 0xffff]
    expect(line.ask(mc.exchange(oneCCommands.WW, { head: at('D', 16), values }))).toEqual({})
    expect(line.ask(mc.exchange(oneCCommands.QR, { head: at('D', 16), points: 4 }))).toEqual({ values })
    const bits = [true, false, true]
    expect(line.ask(mc.exchange(oneCCommands.BW, { head: at('Y', 5), values: bits }))).toEqual({})
    expect(line.ask(mc.exchange(oneCCommands.BR, { head: at('Y', 5), points: 3 }))).toEqual({ values: bits })
    expect(line.ask(mc.exchange(oneCCommands.WR, { head: at('Y', 0), points: 1 }))).toEqual({ values: [0b1010_0000] })
    const random = [{ device: at('R', 32_767), value: 7 }]
    expect(line.ask(mc.exchange(oneCCommands.QT, { words: random }))).toEqual({})
    expect(line.ask(mc.exchange(oneCCommands.PC, {}))).toEqual({ typeCode: 0xf3 })
    expect(line.ask(mc.exchange(oneCCommands.TT, { data: 'ABCDE' }))).toEqual({ data: 'ABCDE' })
    expect(line.ask(mc.exchange(oneCCommands.GW, { on: true }))).toEqual({})
    expect(line.fails(mc.exchange(oneCCommands.RS, {}))).toMatchObject({ endCode: 0x18, about: 'state' })
    expect(line.dropped).toBeUndefined()
    expect(plc.seen.map(({ name }) => name)).toEqual(['WW', 'QR', 'BW', 'BR', 'WR', 'QT', 'PC', 'TT', 'GW', 'RS'])
    expect(plc.word(at('R', 32_767))).toBe(7)
  })
})

describe('vectors of whole frames', () => {
  const frames = of1c.flatMap((vector) => (vector.kind === 'frame' ? [vector] : []))
  const spoken = (vector: (typeof frames)[number]) => {
    const { station = 0, pc = 0xff } = vector.head?.route ?? {}
    const framing = framing1c(vector.frame === '1C4' ? 4 : 1, { sumCheck: vector.sumCheck === true })
    return protocol({
      framing,
      head: { station, pc },
      asciiXy: xyOf(vector),
      ...(vector.messageWait === undefined ? {} : { messageWait: vector.messageWait }),
    })
  }

  test.each(frames.filter(({ side }) => side === 'request'))('$id is sent, and read by the PLC side', (vector) => {
    const mc = spoken(vector)
    expect(
      mc
        .exchange(command(vector.command), vector.message ?? {})
        .write(0)
        .toString('hex'),
    ).toBe(vector.hex)
    const scanned = mc.framing.request.scan(bytesOf(vector), (head, soFar) => mc.requestLength(head, soFar))
    if (scanned === undefined) throw new Error('the request is not whole')
    expect(mc.readRequest(scanned.frame)).toMatchObject({ command: { name: vector.command }, message: vector.message })
  })

  test.each(frames.filter(({ side }) => side === 'response'))('$id is written by the PLC side and read', (vector) => {
    const mc = spoken(vector)
    const { request = {}, message = {}, endCode = 0 } = vector
    const asked = mc.exchange(command(vector.command), request)
    const scanned = mc.framing.response.scan(bytesOf(vector), asked.responseLength)
    if (scanned === undefined) throw new Error('the answer is not whole')
    if (endCode === 0) expect(asked.decode(scanned.frame)).toEqual(message)
    else expect(() => asked.decode(scanned.frame)).toThrow(EndCodeError)
    const body = endCode === 0 ? mc.writeResponse(command(vector.command), request, message) : Buffer.alloc(0)
    expect(mc.framing.response.write(scanned.frame.head, 0, endCode, body).toString('hex')).toBe(vector.hex)
  })
})

test.each(Object.keys(oneCCommands).filter(isOneC))(
  'any message of %s goes through the frame as it is',
  (name: OneCCommandName) => {
    const wanted = { ascii: true, form: FORM_XY_OCTAL }
    const mc = protocol({ asciiXy: 'octal' })
    fc.assert(
      fc.property(arbitrary(oneCCommands[name].request, wanted), (message) => {
        let sent: Buffer
        try {
          sent = mc.exchange(command(name), message).write(0)
        } catch (error) {
          // The rules of devices refuse what the layout alone could say.
          if (error instanceof RequestError) return
          throw error
        }
        const scanned = mc.framing.request.scan(sent, (head, soFar) => mc.requestLength(head, soFar))
        expect(scanned?.used).toBe(sent.length)
        if (scanned === undefined) return
        expect(mc.readRequest(scanned.frame)).toEqual({ command: oneCCommands[name], message })
      }),
      { numRuns: 200 },
    )
  },
)
