/** The body of On-demand, from both sides. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { ProtocolError, RequestError } from '../../src/errors'
import { commands } from '../../src/melsec/commands/commands'
import { unsolicitedCommands, wordsOfBytes } from '../../src/melsec/commands/on-demand'
import { slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { readOnDemand, writeOnDemand } from '../../src/melsec/on-demand'
import { hex, ON_DEMAND_DATA, onDemandFrames, text } from './on-demand-frames'

const codes = ['binary', 'ascii'] as const

function errorOf(run: () => unknown): unknown {
  try {
    run()
  } catch (error) {
    return error
  }
  throw new Error('it was not refused')
}

describe.each(onDemandFrames)('On-demand in a $frame frame in $code code', ({ frame, code, bytes }) => {
  test('is written as the manual lays it out', () => {
    const head = { network: 0, station: 0xff, moduleIo: 0x3ff, multidrop: 0, timer: 0 }
    expect(slmpFraming(frame, code).request.write(head, 0x5678, writeOnDemand(code, ON_DEMAND_DATA))).toEqual(bytes)
  })

  test('is read to its data', () => {
    const scanned = slmpFraming(frame, code).request.scan(bytes, () => undefined)
    expect(scanned?.used).toBe(bytes.length)
    expect(readOnDemand(code, scanned?.frame.body ?? Buffer.alloc(0))).toEqual(ON_DEMAND_DATA)
  })
})

describe('the data', () => {
  test('are words low byte first in binary code, and four digits high digit first in ASCII code', () => {
    expect(writeOnDemand('binary', Buffer.from('ABCD')).toString('hex')).toBe('0121000041424344')
    expect(writeOnDemand('ascii', Buffer.from('ABCD')).toString('latin1')).toBe('2101000042414443')
  })

  test.each(codes)('may be none, and up to 1920 bytes, in %s code', (code) => {
    for (const size of [0, 2, 1918, 1920]) {
      const data = Buffer.alloc(size, 0xa5)
      expect(readOnDemand(code, writeOnDemand(code, data))).toEqual(data)
    }
    const body = Buffer.concat([writeOnDemand(code, Buffer.alloc(1920)), Buffer.alloc(code === 'ascii' ? 4 : 1, 0x30)])
    expect(errorOf(() => readOnDemand(code, body))).toMatchObject({ code: 'BAD_FIELD' })
    expect(errorOf(() => writeOnDemand(code, Buffer.alloc(1921)))).toMatchObject({ code: 'BAD_MESSAGE' })
    expect(errorOf(() => writeOnDemand(code, Buffer.alloc(1922)))).toBeInstanceOf(RequestError)
  })

  test('of an odd number of bytes exist in binary code only, and are no words', () => {
    const odd = Buffer.from([1, 2, 3])
    expect(readOnDemand('binary', writeOnDemand('binary', odd))).toEqual(odd)
    expect(wordsOfBytes(odd)).toBeUndefined()
    expect(errorOf(() => writeOnDemand('ascii', odd))).toMatchObject({ code: 'BAD_MESSAGE', field: 'data' })
  })

  test('that are no bytes are refused', () => {
    const wrong: readonly unknown[] = [
      'AB',
      5,
      null,
      undefined,
      {},
      [256],
      [-1],
      [1.5],
      ['1'],
      [1n],
      new Uint16Array(2),
    ]
    for (const code of codes) {
      for (const data of wrong) {
        const error = errorOf(() => writeOnDemand(code, data as Uint8Array))
        expect(error).toBeInstanceOf(RequestError)
        expect((error as RequestError).field).toBe('data')
      }
    }
  })

  test('of any bytes come back', () => {
    fc.assert(
      fc.property(fc.uint8Array({ maxLength: 1920 }), fc.constantFrom(...codes), (bytes, code) => {
        const data = code === 'ascii' ? bytes.subarray(0, bytes.length & ~1) : bytes
        expect(Buffer.compare(readOnDemand(code, writeOnDemand(code, data)), data)).toBe(0)
      }),
    )
  })
})

describe('what is no On-demand', () => {
  test.each([
    ['binary', hex(''), 'TRUNCATED'],
    ['binary', hex('012100'), 'TRUNCATED'],
    ['binary', hex('0104 0000 640000 a8 0100'), 'BAD_FIELD'],
    ['binary', hex('0121 0100 0100'), 'BAD_FIELD'],
    ['ascii', text('2101'), 'TRUNCATED'],
    ['ascii', text('21010000 00'), 'TRUNCATED'],
    ['ascii', text('21010000 000'), 'TRUNCATED'],
    ['ascii', text('21010000 00G0'), 'BAD_DIGIT'],
    ['ascii', text('21010080 0000'), 'BAD_FIELD'],
  ] as const)('in %s code: %s is refused with %s', (code, body, expected) => {
    const error = errorOf(() => readOnDemand(code, body))
    expect(error).toBeInstanceOf(ProtocolError)
    expect((error as ProtocolError).code).toBe(expected)
  })

  test('whatever bytes there are, they give data or a ProtocolError', () => {
    const body = fc.tuple(fc.constantFrom('', '01210000', '3231303130303030'), fc.uint8Array({ maxLength: 40 }))
    fc.assert(
      fc.property(body, fc.constantFrom(...codes), ([head, rest], code) => {
        try {
          expect(readOnDemand(code, Buffer.concat([hex(head), rest])).length).toBeLessThanOrEqual(40)
        } catch (error) {
          expect(error).toBeInstanceOf(ProtocolError)
        }
      }),
      { numRuns: 2000 },
    )
  })
})

test('it is no command that a client could request: no other list names it', () => {
  expect(Object.keys(unsolicitedCommands)).toEqual(['onDemand'])
  expect(unsolicitedCommands.onDemand).toMatchObject({ code: 0x2101, sender: 'plc', answered: 'no', response: {} })
  const codes: readonly number[] = Object.values(commands).map(({ code }) => code)
  expect(codes).not.toContain(unsolicitedCommands.onDemand.code)
})
