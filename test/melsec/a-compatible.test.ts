/** The command set of the 1E frame: what a request may say, what goes into the frame, and what an answer is read as. */

import { describe, expect, test } from '@jest/globals'
import type { Declaration, Message, Named } from '../../src/codec/codec'
import { RequestError } from '../../src/errors'
import type { NamedCommand } from '../../src/link/link'
import { type ACompatibleCommandName, aCompatibleCommands } from '../../src/melsec/a-compatible/commands'
import { pointLimit } from '../../src/melsec/a-compatible/device-rules'
import { type ACompatibleOptions, aCompatibleProtocol } from '../../src/melsec/a-compatible/protocol'
import { aCompatibleLimits, aCompatibleRules, fx3Over1e, fx5Over1e } from '../../src/melsec/a-compatible/rules'
import { fromFrame, toFrame } from '../../src/melsec/a-compatible/windows'
import { type DeviceName, deviceInfo } from '../../src/melsec/device/device'
import { bytesOf, vectorsOfKind } from '../vectors/vectors'

function command(name: string): Named<Declaration, string> {
  const found = Object.values<Named<Declaration, string>>(aCompatibleCommands).find((entry) => entry.name === name)
  if (found === undefined) throw new Error(`no command ${name}`)
  return found
}

function exchange(name: string, message: Message, options: Partial<ACompatibleOptions> = {}) {
  return aCompatibleProtocol({ code: 'binary', ...options }).exchange(command(name), message)
}

function refused(
  name: ACompatibleCommandName,
  message: Message,
  options: Partial<ACompatibleOptions> = {},
): RequestError {
  try {
    exchange(name, message, options)
  } catch (error) {
    if (error instanceof RequestError) return error
    throw error
  }
  throw new Error('it was not refused')
}

const at = (device: DeviceName, number: number) => ({ device, number })
const headOf = ({ code }: NamedCommand) => ({ command: code, pc: 0xff, timer: 0 })

describe('vectors through the protocol', () => {
  const frames = vectorsOfKind('mc-ethernet-1e', 'frame')
  const asciiXy = 'hexadecimal'

  test.each(frames.filter(({ side }) => side === 'request'))('$id is sent, and read by the PLC side', (vector) => {
    const { code, message = {}, head } = vector
    const protocol = aCompatibleProtocol({ code, asciiXy, timer: head?.timer ?? 0 })
    const sent = protocol.exchange(command(vector.command), message)
    expect(sent.write(0).toString('hex')).toBe(vector.hex)
    const scanned = protocol.framing.request.scan(bytesOf(vector), (on, soFar) => protocol.requestLength(on, soFar))
    if (scanned === undefined) throw new Error('the request is not whole')
    expect(protocol.readRequest(scanned.frame)).toMatchObject({ command: { name: vector.command }, message })
  })

  test.each(frames.filter(({ side }) => side === 'response'))('$id is written by the PLC side and read', (vector) => {
    const { code, message = {}, request = {} } = vector
    const protocol = aCompatibleProtocol({ code, asciiXy })
    const declared = command(vector.command)
    const asked = protocol.exchange(declared, request)
    const scanned = protocol.framing.response.scan(bytesOf(vector), asked.responseLength)
    if (scanned === undefined) throw new Error('the answer is not whole')
    expect(asked.decode(scanned.frame)).toEqual(message)
    const body = protocol.writeResponse(command(vector.command), request, message)
    expect(protocol.framing.response.write(headOf(declared), 0, 0, body).toString('hex')).toBe(vector.hex)
  })
})

describe('names of devices', () => {
  test.each([
    ['SM', 8000, 'readBits', '401f0000204d0100'],
    ['SM', 8511, 'readBits', '3f210000204d0100'],
    ['SD', 8000, 'readWords', '401f000020440100'],
    ['LCS', 0, 'readBits', 'c800000053430100'],
    ['LCS', 55, 'readBits', 'ff00000053430100'],
  ] as const)('%s%s goes out as the name it has in the frame', (device, number, name, hex) => {
    expect(exchange(name, { head: at(device, number), points: 1 }).body.toString('hex')).toBe(hex)
  })

  test('a long counter is two words', () => {
    const lcn55 = { head: at('LCN', 55), points: 2 }
    expect(exchange('readWords', lcn55).body.toString('hex')).toBe('ff0000004e430200')
    const written = exchange('writeWords', { head: at('LCN', 20), values: [0x614e, 0x00bc] })
    expect(written.body.toString('hex')).toBe('dc0000004e4302004e61bc00')
    expect(refused('readWords', { head: at('LCN', 0), points: 3 })).toMatchObject({ code: 'LIMIT_EXCEEDED' })
    expect(refused('writeRandomWords', { words: [{ device: at('LCN', 0), value: 1 }] }).message).toContain('writeWords')
  })

  test('what would reach another device under the same name is refused with its right name', () => {
    for (const [device, number, right] of [
      ['M', 8000, 'SM8000'],
      ['D', 8013, 'SD8013'],
      ['CS', 201, 'LCS1'],
      ['CN', 255, 'LCN55'],
    ] as const) {
      const name = deviceInfo(device).unit === 'bit' ? 'readBits' : 'readWords'
      const error = refused(name, { head: at(device, number), points: 1 })
      expect(error).toMatchObject({ code: 'OUT_OF_RANGE', field: 'head' })
      expect(error.message).toContain(right)
    }
  })

  test('FX3 calls special relays and registers M8000 and D8000, and has 32-bit counters from 200 on', () => {
    const fx3 = { family: fx3Over1e }
    expect(exchange('readBits', { head: at('M', 8000), points: 1 }, fx3).body.toString('hex')).toBe('401f0000204d0100')
    expect(exchange('readWords', { head: at('D', 8013), points: 2 }, fx3).body.toString('hex')).toBe('4d1f000020440200')
    expect(exchange('readBits', { head: at('CS', 200), points: 1 }, fx3).body.toString('hex')).toBe('c800000053430100')
    expect(refused('readWords', { head: at('CN', 200), points: 2 }, fx3).message).toContain('LCN0')
  })

  test.each([fx5Over1e, fx3Over1e])('$title: every window has its own place in the frame', ({ windows }) => {
    for (const window of windows) {
      const real = fromFrame(windows, { device: window.as, number: window.from })
      if (real === undefined) throw new Error('no device')
      const back = windows.find((row) => row.device === real.device && row.number === real.number)
      expect(back && toFrame(back, real)).toEqual({ device: window.as, number: window.from })
    }
  })
})

describe('limits', () => {
  const heads = { bit: at('M', 0), word: at('D', 0) }
  const single = aCompatibleLimits.filter(({ command: name }) => !name.startsWith('writeRandom'))

  test.each(single)('$command of $of devices takes $max points and no more', ({ command: name, of, max }) => {
    const value = name.endsWith('Bits') ? false : 0
    const message = (points: number) => ({
      head: heads[of],
      ...(name.startsWith('read') ? { points } : { values: new Array(points).fill(value) }),
    })
    expect(exchange(name, message(max)).title).toBe(aCompatibleCommands[name].title)
    expect(refused(name, message(max + 1))).toMatchObject({ code: 'LIMIT_EXCEEDED', field: 'head' })
    expect(refused(name, message(0))).toBeInstanceOf(RequestError)
    expect(pointLimit(aCompatibleRules, name, heads[of].device)).toBe(max)
  })

  test('random writes take 80 bits or 10 words', () => {
    const bits = (n: number) => ({ bits: Array.from({ length: n }, (_, i) => ({ device: at('M', i), value: true })) })
    const words = (n: number) => ({ words: Array.from({ length: n }, (_, i) => ({ device: at('D', i), value: i })) })
    expect(exchange('writeRandomBits', bits(80)).body.length).toBe(2 + 80 * 7)
    expect(refused('writeRandomBits', bits(81))).toMatchObject({ code: 'LIMIT_EXCEEDED', field: 'bits' })
    expect(exchange('writeRandomWords', words(10)).body.length).toBe(2 + 10 * 8)
    expect(refused('writeRandomWords', words(11))).toMatchObject({ code: 'LIMIT_EXCEEDED', field: 'words' })
    expect(refused('writeRandomWords', words(0))).toMatchObject({ code: 'BAD_MESSAGE' })
  })

  test.each([
    ['beyond the last device', 'readWords', { head: at('D', 7999), points: 2 }, 'OUT_OF_RANGE', 'D7999'],
    ['over counter 200', 'readWords', { head: at('CN', 199), points: 2 }, 'OUT_OF_RANGE', 'CN199'],
    ['octal in the text', 'readBits', { head: at('X', 0o377), points: 2 }, 'OUT_OF_RANGE', 'X377'],
    ['bits of a word device', 'readBits', { head: at('D', 0), points: 1 }, 'UNSUPPORTED', 'word units'],
    ['an odd head in words', 'readWords', { head: at('M', 8), points: 1 }, 'UNSUPPORTED', 'multiple of 16'],
    ['an odd head, written', 'writeWords', { head: at('Y', 8), values: [1] }, 'UNSUPPORTED', 'multiple of 16'],
    ['a device 1E has not', 'readWords', { head: at('W', 0), points: 1 }, 'OUT_OF_RANGE', 'it has X, Y'],
    [
      'an index',
      'readWords',
      { head: { ...at('D', 0), index: { register: 'Z', number: 1 } }, points: 1 },
      'UNSUPPORTED',
      '3E',
    ],
    ['lower case in the loopback', 'loopback', { data: 'abc' }, 'BAD_MESSAGE', '0-9'],
    ['too long a loopback', 'loopback', { data: 'A'.repeat(255) }, 'BAD_MESSAGE', '254'],
    ['a field that is not there', 'remoteRun', { mode: 1 }, 'BAD_MESSAGE', 'mode'],
  ] as const)('%s is refused', (_what, name, message, code, text) => {
    const error = refused(name, message)
    expect(error.code).toBe(code)
    expect(error.message).toContain(text)
  })
})

describe('ASCII code', () => {
  const odd = { head: at('M', 0), points: 3 }

  test('X and Y need to know their digits', () => {
    const y = { head: at('Y', 0o100), points: 2 }
    expect(refused('readBits', y, { code: 'ascii' })).toMatchObject({ code: 'BAD_OPTION', field: 'asciiXy' })
    const random = { bits: [{ device: at('X', 1), value: true }] }
    expect(refused('writeRandomBits', random, { code: 'ascii' })).toMatchObject({ field: 'asciiXy' })
    const octal = exchange('readBits', y, { code: 'ascii', asciiXy: 'octal' })
    expect(octal.body.toString('latin1')).toBe('5920000001000200')
  })

  test('an odd number of bits needs to know whether a dummy follows', () => {
    expect(refused('readBits', odd, { code: 'ascii' })).toMatchObject({ code: 'BAD_OPTION', field: 'oddBits' })
    expect(refused('writeBits', { head: at('M', 0), values: [true] }, { code: 'ascii' })).toMatchObject({
      field: 'oddBits',
    })
    expect(exchange('readBits', { ...odd, points: 4 }, { code: 'ascii' }).body.length).toBe(16)
  })

  test.each([
    ['exact', '101', '1'],
    ['padded', '1010', '10'],
  ] as const)('%s', (oddBits, answer, written) => {
    const protocol = aCompatibleProtocol({ code: 'ascii', oddBits })
    const asked = protocol.exchange(aCompatibleCommands.readBits, { head: at('M', 0), points: 3 })
    expect(protocol.framing.response.scan(Buffer.from(`8000${answer}`), asked.responseLength)?.used).toBe(
      4 + answer.length,
    )
    const frame = {
      head: headOf(aCompatibleCommands.readBits),
      serial: undefined,
      endCode: 0,
      body: Buffer.from(answer),
    }
    expect(asked.decode(frame)).toEqual({ values: [true, false, true] })
    expect(protocol.writeResponse(command('readBits'), odd, { values: [true, false, true] }).toString()).toBe(answer)
    const write = protocol.exchange(aCompatibleCommands.writeBits, { head: at('M', 0), values: [true] })
    expect(write.body.toString('latin1')).toBe(`4D20000000000100${written}`)
    const head = headOf(aCompatibleCommands.writeBits)
    const request = { head, serial: undefined, body: write.body }
    expect(protocol.requestLength(head, Buffer.concat([write.body, Buffer.from('02FF')]))).toBe(write.body.length)
    expect(protocol.readRequest(request).message).toMatchObject({ values: [true] })
  })

  test('a dummy that is none is not taken', () => {
    const protocol = aCompatibleProtocol({ code: 'ascii', oddBits: 'padded' })
    const asked = protocol.exchange(aCompatibleCommands.readBits, { head: at('M', 0), points: 1 })
    const frame = { head: headOf(aCompatibleCommands.readBits), serial: undefined, endCode: 0, body: Buffer.from('11') }
    expect(() => asked.decode(frame)).toThrow(expect.objectContaining({ code: 'BAD_FIELD' }))
  })
})

describe('refusals', () => {
  test.each([
    ['binary', '815b10', 3, '00'],
    ['binary', '815b1000', 3, '00'],
    ['ascii', '815B10', 6, '3030'],
    ['ascii', '815B1000', 6, '3030'],
  ] as const)(
    '%s %s: end code 5B and its abnormal code, behind which 00H may follow',
    (code, text, length, follows) => {
      const protocol = aCompatibleProtocol({ code })
      const asked = protocol.exchange(aCompatibleCommands.readWords, { head: at('D', 0), points: 64 })
      const bytes = Buffer.from(text, code === 'binary' ? 'hex' : 'latin1')
      const scanned = protocol.framing.response.scan(bytes, asked.responseLength)
      if (scanned === undefined) throw new Error('the answer is not whole')
      expect(scanned.used).toBe(length)
      expect(scanned.mayFollow?.toString('hex')).toBe(follows)
      expect(() => asked.decode(scanned.frame)).toThrow(
        expect.objectContaining({
          endCode: 0x5b,
          abnormalCode: 0x10,
          message: expect.stringContaining('abnormal code 10H'),
        }),
      )
    },
  )

  test('an end code is explained', () => {
    const asked = exchange('readWords', { head: at('D', 0), points: 1 })
    const frame = { head: { command: 1, pc: 0, timer: 0 }, serial: undefined, endCode: 0x57, body: Buffer.alloc(0) }
    expect(() => asked.decode(frame)).toThrow(/end code 57H: Too many points/)
  })
})
