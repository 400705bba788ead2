/**
 * The ground carries more than SLMP: client session and responder joined in memory, with the time as a number, for
 * 3E and 4E, 3C and 4C (control codes, byte stuffing, sum check), 1E (no length in the answer) and Sharp JW (another vendor).
 */

import { describe, expect, test } from '@jest/globals'
import type { Message } from '../../src/codec/codec'
import { EndCodeError, type PlcError, ProtocolError } from '../../src/errors'
import type { JwAddress } from '../../src/jw/address'
import { jwCommands } from '../../src/jw/commands/commands'
import { jwProtocol } from '../../src/jw/protocol'
import type { Head } from '../../src/link/link'
import { aCompatibleCommands } from '../../src/melsec/a-compatible/commands'
import { aCompatibleProtocol } from '../../src/melsec/a-compatible/protocol'
import { commands } from '../../src/melsec/commands/commands'
import { type SerialHead, serialFrameFacts, serialRoute } from '../../src/melsec/frame/serial-frames'
import { type SerialFrameOptions, serialFraming } from '../../src/melsec/frame/serial-framing'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import { type Answer, Line, type Plc, type Wire } from './line'
import { HEAD, slmpFrames } from './support'

const D = (number: number) => ({ device: 'D', number }) as const

/** A PLC with the words D0 to D9999 that knows Read and Write in word units. */
function melsecPlc<H extends Head>(protocol: MelsecProtocol<H>, words = new Uint16Array(10_000)): Plc<H> {
  return {
    bodyLength: () => undefined,
    answer(frame) {
      const request = protocol.readRequest(frame)
      if ('unknown' in request) return { endCode: 0xc059, body: Buffer.alloc(0) }
      const { head, points, values } = request.message as { head: { number: number }; points: number; values: number[] }
      if (request.name === 'readTypeName')
        return { endCode: 0, body: protocol.writeResponse(request, { model: 'R04CPU'.padEnd(16), modelCode: 0x4800 }) }
      if (request.name === 'remoteRun') return { endCode: 0, body: protocol.writeResponse(request, {}) }
      if (head.number >= words.length) return { endCode: 0xc056, body: Buffer.alloc(0) }
      if (request.name === 'writeWords') {
        words.set(values, head.number)
        return { endCode: 0, body: protocol.writeResponse(request, {}) }
      }
      const found = [...words.subarray(head.number, head.number + points)]
      return { endCode: 0, body: protocol.writeResponse(request, { values: found }) }
    },
  }
}

function serialProtocol(options: SerialFrameOptions): MelsecProtocol<SerialHead> {
  const framing = serialFraming(options)
  const { code } = framing
  return new MelsecProtocol({ framing, head: serialRoute(options.frame), profile: resolveProfile('iq-r'), code })
}

/** In format 1 nobody but the command knows where a request ends. */
function serialPlc(protocol: MelsecProtocol<SerialHead>): Plc<SerialHead> {
  return { ...melsecPlc(protocol), bodyLength: (_head, soFar) => protocol.requestLength(soFar) }
}

const wires: readonly Wire[] = ['whole', 'byte by byte', 'datagrams']

describe.each(wires)('SLMP, %s', (wire) => {
  test.each(slmpFrames)('$title reads what it wrote', ({ framing, code }) => {
    const protocol = new MelsecProtocol({
      framing,
      head: HEAD,
      profile: resolveProfile('iq-r'),
      code,
    })
    const line = new Line(protocol.framing, melsecPlc(protocol), wire)
    const values = [0, 1, 0x1010, 0xffff]
    expect(line.ask(protocol.exchange(commands.writeWords, { head: D(16), values }))).toEqual({})
    expect(line.ask(protocol.exchange(commands.readWords, { head: D(15), points: 6 }))).toEqual({
      values: [0, ...values, 0],
    })
    expect(line.ask(protocol.exchange(commands.readTypeName, {}))).toEqual({
      model: 'R04CPU          ',
      modelCode: 0x4800,
    })
    const refused = line.fails(protocol.exchange(commands.readWords, { head: D(10_000), points: 1 }))
    expect(refused).toMatchObject({ name: 'EndCodeError', endCode: 0xc056, outcome: 'refused' })
    // A refusal leaves the connection as it is.
    expect(line.ask(protocol.exchange(commands.readWords, { head: D(16), points: 1 }))).toEqual({ values: [0] })
  })
})

describe.each(['whole', 'byte by byte'] as const)('3C and 4C, %s', (wire) => {
  const lines = (['3C', '4C'] as const).flatMap((frame) =>
    serialFrameFacts[frame].formats.flatMap((format) =>
      [true, false].map((sumCheck) => ({
        title: `${frame} format ${format}${sumCheck ? '' : ' without sum check'}`,
        protocol: serialProtocol({ frame, format, sumCheck }),
      })),
    ),
  )

  test.each(lines)('$title reads what it wrote, and goes on after a refusal', ({ protocol }) => {
    const line = new Line(protocol.framing, serialPlc(protocol), wire)
    const values = [0, 1, 0x1010, 0xffff, 0x0310, 0x0210]
    expect(line.ask(protocol.exchange(commands.writeWords, { head: D(16), values }))).toEqual({})
    expect(line.ask(protocol.exchange(commands.readWords, { head: D(15), points: 8 }))).toEqual({
      values: [0, ...values, 0],
    })
    expect(line.ask(protocol.exchange(commands.readTypeName, {}))).toMatchObject({ modelCode: 0x4800 })
    expect(line.ask(protocol.exchange(commands.remoteRun, { mode: 1 }))).toEqual({})
    const refused = line.fails(protocol.exchange(commands.readWords, { head: D(10_000), points: 1 }))
    expect(refused).toMatchObject({ name: 'EndCodeError', endCode: 0xc056, outcome: 'refused', station: undefined })
    expect(refused).toMatchObject({ command: 'Read (word units)', family: 'slmp' })
    expect(line.ask(protocol.exchange(commands.readWords, { head: D(18), points: 1 }))).toEqual({ values: [0x1010] })
    expect(line.dropped).toBeUndefined()
  })

  test.each(lines)('$title: start codes are those of the answers', ({ protocol }) => {
    const line = new Line(protocol.framing, serialPlc(protocol), wire)
    line.ask(protocol.exchange(commands.writeWords, { head: D(0), values: [1] }))
    line.ask(protocol.exchange(commands.readWords, { head: D(0), points: 1 }))
    line.fails(protocol.exchange(commands.readWords, { head: D(10_000), points: 1 }))
    const starts = line.received.map(([start]) => start)
    expect(starts).toEqual(protocol.code === 'ascii' ? [0x06, 0x02, 0x15] : [0x10, 0x10, 0x10])
  })

  test.each(lines)('$title: an answer of another station is not taken', ({ protocol }) => {
    const line = new Line(protocol.framing, serialPlc(protocol), wire)
    const { framing } = protocol
    const route = serialRoute('4C', { station: 5 })
    line.damage = () => framing.response.write(route, 0, 0, Buffer.alloc(0))
    const error = line.fails(protocol.exchange(commands.writeWords, { head: D(0), values: [1] }))
    expect(error).toMatchObject({ code: 'ECHO_MISMATCH', outcome: 'unknown' })
  })

  test('what the characters of a frame cannot say is refused before it is sent', () => {
    const framing = serialFraming({ frame: '3C', format: 1 })
    const q = new MelsecProtocol({ framing, head: serialRoute('3C'), profile: resolveProfile('q'), code: framing.code })
    expect(() => q.exchange(commands.deleteFile, { drive: 4, name: 'ライン.CSV' })).toThrow(
      /printable characters only, not 131/,
    )
  })

  const withSum = lines.filter(({ title }) => !title.includes('without'))
  test.each(withSum)('$title: a wrong sum of a request is answered by silence', ({ protocol }) => {
    const line = new Line(protocol.framing, serialPlc(protocol), wire)
    line.damageRequest = (request) => Buffer.from(request).map((byte, i) => (i === 5 ? byte ^ 1 : byte)) as Buffer
    const error = line.fails(protocol.exchange(commands.writeWords, { head: D(0), values: [1] }))
    expect(error).toMatchObject({ code: 'TIMEOUT', outcome: 'unknown' })
    expect(line.received).toEqual([])
  })
})

describe.each(['whole', 'byte by byte'] as const)('MC 4C format 5, %s', (wire) => {
  const route = { station: 0, network: 0, pc: 0xff, moduleIo: 0x3ff, multidrop: 0, selfStation: 0 }
  const protocol = (sumCheck = true) =>
    new MelsecProtocol({
      framing: serialFraming({ frame: '4C', format: 5, sumCheck }),
      head: route,
      profile: resolveProfile('q'),
      code: 'binary',
    })
  /** How often DLE stands between DLE STX and DLE ETX. */
  const stuffed = (frame: Buffer | undefined, sumCheck: boolean) =>
    [...(frame ?? []).slice(2, sumCheck ? -4 : -2)].filter((byte) => byte === 0x10).length

  test.each([true, false])('reads what it wrote; 10H is doubled wherever it stands (sum check: %s)', (sumCheck) => {
    const mc = protocol(sumCheck)
    const line = new Line(mc.framing, melsecPlc(mc), wire)
    // 10H as head device, in the count of points and in the data.
    const values = Array.from({ length: 16 }, (_, i) => (i % 3 === 0 ? 0x1010 : i))
    line.ask(mc.exchange(commands.writeWords, { head: D(0x10), values }))
    const { values: read } = line.ask(mc.exchange(commands.readWords, { head: D(0x10), points: 0x10 }))
    expect(read).toEqual(values)
    expect(stuffed(line.sent[0], sumCheck)).toBe(2 * (1 + 1 + 2 * 6))
    expect(stuffed(line.sent[1], sumCheck)).toBe(2 * (1 + 1))
    // 10H in the command itself, which is 1001 for Remote Run, and in its byte count.
    line.ask(mc.exchange(commands.remoteRun, { mode: 1 }))
    expect(stuffed(line.sent[2], sumCheck)).toBe(2 * (1 + 1))
    // 10H as the number of data bytes: 8 of the route and 8 of an answer with 2 words.
    line.ask(mc.exchange(commands.readWords, { head: D(0), points: 2 }))
    expect(line.received.at(-1)?.subarray(0, 5).toString('hex')).toBe('1002101000')
  })

  test('a refusal has no error information', () => {
    const mc = protocol()
    const line = new Line(mc.framing, melsecPlc(mc), wire)
    const error = line.fails(mc.exchange(commands.readWords, { head: D(10_000), points: 1 }))
    expect(error).toBeInstanceOf(EndCodeError)
    expect(error).toMatchObject({ endCode: 0xc056, command: 'Read (word units)', station: undefined })
  })

  test('a wrong sum of the answer is a ProtocolError and drops the line', () => {
    const mc = protocol()
    const line = new Line(mc.framing, melsecPlc(mc), wire)
    line.damage = (answer) => Buffer.concat([answer.subarray(0, -1), Buffer.of(answer.at(-1) === 0x30 ? 0x31 : 0x30)])
    const error = line.fails(mc.exchange(commands.readWords, { head: D(0), points: 1 }))
    expect(error).toBeInstanceOf(ProtocolError)
    expect([error.code, error.outcome, line.dropped]).toEqual(['BAD_SUM', 'unknown', 'BAD_SUM'])
  })

  test('a wrong sum of the request is answered by silence', () => {
    const mc = protocol()
    const line = new Line(mc.framing, melsecPlc(mc), wire)
    line.damageRequest = (request) => Buffer.concat([request.subarray(0, -1), Buffer.from('G')])
    expect(line.fails(mc.exchange(commands.writeWords, { head: D(0), values: [1] }))).toMatchObject({
      code: 'TIMEOUT',
      outcome: 'unknown',
    })
    // Without a serial number, and without an answer, nothing on this line can be attributed any more.
    expect(line.dropped).toBe('DISCONNECTED')
  })

  test('an answer of another station is not taken', () => {
    const mc = protocol()
    const line = new Line(mc.framing, melsecPlc(mc), wire)
    const other = mc.framing.response.write({ ...route, station: 5 }, 0, 0, Buffer.of(1, 0))
    line.damage = () => other
    expect(line.fails(mc.exchange(commands.readWords, { head: D(0), points: 1 }))).toMatchObject({
      code: 'ECHO_MISMATCH',
    })
  })
})

describe.each(wires)('1E, %s', (wire) => {
  /** A PLC that knows batch read: D[n] = n, and the odd M are on. */
  const plcOf = (
    mc: ReturnType<typeof aCompatibleProtocol>,
    refuse?: Answer,
  ): Plc<{ command: number; pc: number; timer: number }> => ({
    bodyLength: (head, soFar) => mc.requestLength(head, soFar),
    answer(frame) {
      const { command, message } = mc.readRequest(frame)
      const { head, points } = message as { head: { number: number }; points: number }
      const numbers = Array.from({ length: points }, (_, i) => head.number + i)
      const values = command.name === 'readBits' ? numbers.map((n) => n % 2 === 1) : numbers
      return refuse ?? { endCode: 0, body: mc.writeResponse(command, message, { values }) }
    },
  })

  describe.each(['binary', 'ascii'] as const)('%s', (code) => {
    const mc = aCompatibleProtocol({ code })
    const readWords = (head: number, points: number) =>
      mc.exchange(aCompatibleCommands.readWords, { head: D(head), points })

    test('reads words: the answer has no length, its request knows it', () => {
      const line = new Line(mc.framing, plcOf(mc), wire)
      for (const points of [3, 1, 64]) {
        const expected = Array.from({ length: points }, (_, i) => 100 + i)
        expect(line.ask(readWords(100, points))).toEqual({ values: expected })
      }
      // FX5 communication manual 39.2: D100, 3 points.
      const binary = '01ff00006400000020440300'
      const [first] = line.sent
      expect(code === 'binary' ? first?.toString('hex') : first?.toString('latin1')).toBe(
        code === 'binary' ? binary : '01FF0000442000000064' + '0300',
      )
    })

    test('256 points are written as 00', () => {
      const line = new Line(mc.framing, plcOf(mc), wire)
      const head = { device: 'M', number: 1000 } as const
      const { values } = line.ask(mc.exchange(aCompatibleCommands.readBits, { head, points: 256 }))
      expect([values.length, values[0], values[255]]).toEqual([256, false, true])
      const points = (line.sent[0] as Buffer).subarray(code === 'binary' ? 10 : 20)
      expect(code === 'binary' ? points.toString('hex') : points.toString('latin1')).toBe('0000')
    })

    test('end code 5B is followed by an abnormal code, the others by nothing', () => {
      const abnormal = code === 'binary' ? Buffer.of(0x10) : Buffer.from('10')
      const with5b = new Line(mc.framing, plcOf(mc, { endCode: 0x5b, body: abnormal }), wire)
      const error = with5b.fails(readWords(0, 5))
      expect(error).toMatchObject({ name: 'EndCodeError', endCode: 0x5b, outcome: 'refused' })
      expect(error.message).toContain('abnormal code 10H')
      expect(with5b.dropped).toBeUndefined()
      const other = new Line(mc.framing, plcOf(mc, { endCode: 0x56, body: Buffer.alloc(0) }), wire)
      expect(other.fails(readWords(0, 5))).toMatchObject({ endCode: 0x56 })
      expect(other.dropped).toBeUndefined()
    })

    test('an answer to another command is refused by its head, not waited for', () => {
      const line = new Line(mc.framing, plcOf(mc), wire)
      const head = mc.framing.response.write({ command: 0x00, pc: 0, timer: 0 }, 0, 0, Buffer.alloc(0))
      // Much shorter than the answer that is waited for.
      line.damage = () => head
      const error = line.fails(readWords(0, 64))
      expect([error.code, line.dropped]).toEqual(['ECHO_MISMATCH', 'ECHO_MISMATCH'])
      expect(error.message).toContain('to command 00H, asked was 01H')
    })

    test('an answer that is too short is waited for, and one that is too long ends the trust', () => {
      const short = new Line(mc.framing, plcOf(mc), wire)
      short.damage = (answer) => answer.subarray(0, -1)
      // One datagram is one frame, and cannot be waited for.
      const error = short.fails(readWords(0, 2))
      expect(error.code).toBe(wire === 'datagrams' ? 'TRUNCATED' : 'TIMEOUT')
      expect(short.dropped).toBe(wire === 'datagrams' ? 'TRUNCATED' : 'DISCONNECTED')
      const long = new Line(mc.framing, plcOf(mc), wire)
      long.damage = (answer) => Buffer.concat([answer, Buffer.from('00')])
      if (wire === 'datagrams') expect(long.fails(readWords(0, 2)).code).toBe('TRAILING')
      else expect(long.ask(readWords(0, 2))).toEqual({ values: [0, 1] })
      expect(long.dropped).toBe(wire === 'datagrams' ? 'TRAILING' : 'UNEXPECTED_ANSWER')
    })
  })
})

describe.each(wires)('Sharp JW, %s', (wire) => {
  describe.each(['none', 'zero40'] as const)('header %s', (header) => {
    const jw = jwProtocol({ header })
    /** A PLC with 64 KB at each segment, addressed in bytes. */
    function plcOf(memory = new Map<string, Buffer>()): Plc<{ command: number }> {
      const segmentOf = ({ file, extended }: JwAddress) => {
        const key = `${file} ${extended === true}`
        const bytes = memory.get(key) ?? Buffer.alloc(0x10000)
        memory.set(key, bytes)
        return bytes
      }
      return {
        bodyLength: (head, soFar) => jw.requestLength(head, soFar),
        answer(frame) {
          const { command, message } = jw.readRequest(frame)
          const { head, length, data } = message as { head: JwAddress; length: number; data: Buffer }
          const bytes = segmentOf(head)
          const { address } = head
          if (address + (data?.length ?? length) > bytes.length) return { endCode: 0x0d, body: Buffer.alloc(0) }
          const response: Message = data === undefined ? { data: bytes.subarray(address, address + length) } : {}
          if (data !== undefined) bytes.set(data, address)
          return { endCode: 0, body: jw.writeResponse(command, message, response) }
        },
      }
    }

    test.each<[string, JwAddress]>([
      ['basic', { file: 8, address: 0o4000 }],
      ['extended', { file: 1, address: 0x1234, extended: true }],
    ])('commands 34 and 24, %s form: writes, and reads it back', (form, head) => {
      const line = new Line(jw.framing, plcOf(), wire)
      const data = Buffer.from('00ff45470010', 'hex')
      expect(line.ask(jw.exchange(jwCommands.writeDataMemory, { head, data }))).toEqual({})
      expect(line.ask(jw.exchange(jwCommands.readDataMemory, { head, length: 6 }))).toEqual({ data })
      const front = header === 'zero40' ? '00'.repeat(40) : ''
      const address = form === 'basic' ? '080008' : 'ff0134120000'
      expect(line.sent.map((frame) => frame.toString('hex'))).toEqual([
        `${front}470034${address}060000ff45470010`,
        `${front}470024${address}0600`,
      ])
      expect(line.received.map((frame) => frame.toString('hex'))).toEqual([
        `${front}45003400${address}0600`,
        `${front}45002400${address}060000ff45470010`,
      ])
    })

    test('a result code is a refusal, and the connection lives', () => {
      const line = new Line(jw.framing, plcOf(), wire)
      const error = line.fails(
        jw.exchange(jwCommands.readDataMemory, { head: { file: 1, address: 0xffff, extended: true }, length: 2 }),
      )
      expect(error).toMatchObject({
        name: 'EndCodeError',
        endCode: 0x0d,
        outcome: 'refused',
        command: 'Read data memory',
      })
      expect(line.ask(jw.exchange(jwCommands.readDataMemory, { head: { file: 0, address: 0 }, length: 1 }))).toEqual({
        data: Buffer.of(0),
      })
    })

    test('an answer about another address or another length is not taken', () => {
      const read = jw.exchange(jwCommands.readDataMemory, { head: { file: 0, address: 0x0102 }, length: 2 })
      for (const offset of [4, 5, 6, 7]) {
        const line = new Line(jw.framing, plcOf(), wire)
        line.damage = (answer) => {
          const changed = Buffer.from(answer)
          const at = offset + (header === 'zero40' ? 40 : 0)
          changed[at] = (changed[at] as number) ^ 1
          return changed
        }
        expect([offset, line.fails(read).code]).toEqual([offset, 'ECHO_MISMATCH'])
      }
    })

    test('an answer to another command is refused by its head, not waited for', () => {
      const line = new Line(jw.framing, plcOf(), wire)
      line.damage = () => jw.framing.response.write({ command: 0x34 }, 0, 0, Buffer.alloc(0))
      const error: PlcError = line.fails(
        jw.exchange(jwCommands.readDataMemory, { head: { file: 0, address: 0 }, length: 500 }),
      )
      expect(error.code).toBe('ECHO_MISMATCH')
      expect(error.message).toContain('to command 34H, asked was 24H')
    })

    test('a request is what it was when it was made, whatever becomes of the message', () => {
      const line = new Line(jw.framing, plcOf(), wire)
      const message = { head: { file: 0, address: -0 }, length: 4 }
      const exchange = jw.exchange(jwCommands.readDataMemory, message)
      message.length = 2
      message.head.address = 7
      expect(line.ask(exchange)).toEqual({ data: Buffer.alloc(4) })
    })
  })
})
