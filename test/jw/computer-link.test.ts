/** The computer link over serial lines: the printed frame, both kinds of answers, damage and noise. */
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { ProtocolError, RequestError } from '../../src/errors'
import { type ComputerLinkHead, computerLinkFrame, responseTimes } from '../../src/jw/computer-link'
import { type FrameCase, testFeedings } from '../vectors/feedings'
import { bytesOf, type FrameVector, vectorsOfKind } from '../vectors/vectors'

const link = computerLinkFrame()
const head: ComputerLinkHead = { station: 1, responseTime: 4 }
const length = () => undefined
const frame = (text: string) => Buffer.from(text, 'latin1')

/** Station and response time are digits in the vectors. */
function caseOf(vector: FrameVector): FrameCase<ComputerLinkHead> {
  const { station, responseTime } = vector.head as unknown as Record<string, string>
  const asked = { station: Number.parseInt(station ?? '', 8), responseTime: Number.parseInt(responseTime ?? '', 16) }
  return {
    framing: computerLinkFrame({ sumCheck: vector.sumCheck === true }),
    side: vector.side,
    bytes: bytesOf(vector),
    head: asked,
    askedHead: asked,
    body: frame(String(vector.message?.content)),
    bodyLength: length,
  }
}

const vectors = vectorsOfKind('jw-serial', 'frame')

describe('printed frames', () => {
  test('are there', () => {
    expect(vectors.map(({ hex }) => Buffer.from(hex, 'hex').toString('latin1'))).toEqual([
      ':01?4MRL0020001F\r',
      ':01?4MRL002000@@\r',
    ])
  })
  for (const vector of vectors) testFeedings(vector.id, vector.side, () => caseOf(vector))
})

/** No answer is printed: made by the layout, with the sums reckoned by hand. */
const answers: readonly [string, string, number, string][] = [
  ['response', ':01#4117\r', 0, '1'],
  ['response without content', ':01#448\r', 0, ''],
  ['error', ':01%40ED1\r', 0x0e, ''],
]

describe('answers', () => {
  for (const [id, text, endCode, body] of answers)
    testFeedings(id, 'response', () => ({
      framing: link,
      side: 'response',
      bytes: frame(text),
      head,
      askedHead: head,
      body: frame(body),
      endCode,
      bodyLength: length,
    }))
})

test('the sum of every answer made here, with its check, is 0', () => {
  for (const [, text] of answers) {
    const sum = [...frame(text.slice(1, -3))].reduce((all, byte) => all + byte, 0)
    expect((sum + Number.parseInt(text.slice(-3, -1), 16)) & 0xff).toBe(0)
  }
})

test('RI stands for these times', () => {
  expect([...'0123456789ABCDEF'].map((digit) => responseTimes[Number.parseInt(digit, 16)])).toEqual([
    0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 200, 300, 400, 500, 600,
  ])
})

const heads = fc.record({ station: fc.integer({ min: 0, max: 31 }), responseTime: fc.integer({ min: 0, max: 15 }) })
const contents = fc.string({ maxLength: 60 }).map((text) => frame(text.replace(/[^\x20-\x7e]|:/g, '-')))

test('what is written is read, for every station, time and content', () => {
  fc.assert(
    fc.property(heads, contents, fc.integer({ min: 1, max: 255 }), fc.boolean(), (asked, body, endCode, sumCheck) => {
      const request = computerLinkFrame({ sumCheck }).request.write(asked, 0, body)
      expect(link.request.scan(request, length)?.frame).toEqual({ head: asked, serial: undefined, body })
      const answer = link.response.write(asked, 0, 0, body)
      expect(link.response.scan(answer, length)?.frame).toEqual({ head: asked, serial: undefined, endCode: 0, body })
      const refused = link.response.write(asked, 0, endCode, body)
      expect(link.response.scan(refused, length)?.frame).toMatchObject({ head: asked, endCode, body: frame('') })
    }),
  )
})

test('one character changed, lost or doubled is never read as an answer, but for the case of a digit', () => {
  for (const [, text] of answers) {
    for (let at = 0; at < text.length; at++) {
      const damaged = [
        text.slice(0, at) + text.slice(at + 1),
        text.slice(0, at) + text.slice(at, at + 1) + text.slice(at),
      ]
      for (let byte = 0; byte < 0x100; byte++)
        damaged.push(text.slice(0, at) + String.fromCharCode(byte) + text.slice(at + 1))
      for (const other of damaged) {
        if (other.toUpperCase() === text || other.startsWith(text)) continue
        expect([other, readOf(other)]).toEqual([other, undefined])
      }
    }
  }
})

/** The answer in the characters; undefined when there is none, or a ProtocolError. */
function readOf(text: string): unknown {
  try {
    return link.response.scan(frame(text), length)?.frame
  } catch (error) {
    if (error instanceof ProtocolError) return undefined
    throw error
  }
}

test.each([
  ['an answer without a sum', ':01#41@@\r', 'BAD_SUM'],
  ['a wrong sum', ':01#4118\r', 'BAD_SUM'],
  ['a command in place of an answer', ':01?4MRL0020001F\r', 'BAD_FRAME'],
  ['the start of another frame', ':01#41:01#4117\r', 'BAD_FRAME'],
  ['another end', ':01#4117\n', 'BAD_FRAME'],
  ['no content and no sum', ':01#4\r', 'TRUNCATED'],
  ['a station that is not octal', ':08#4110\r', 'BAD_FIELD'],
  ['a station that is no number', ':0G#4101\r', 'BAD_DIGIT'],
  ['an error without a code', ':01%446\r', 'BAD_FRAME'],
  ['an error with the code 00', ':01%400E6\r', 'BAD_FIELD'],
  ['an error with other characters', ':01%4ZZ92\r', 'BAD_DIGIT'],
  ['no end', `:01#4${'0'.repeat(5000)}`, 'BAD_FRAME'],
])('%s is refused', (_what, text, code) => {
  expect(() => link.response.scan(frame(text), length)).toThrow(expect.objectContaining({ code }))
})

test('digits of a sum are read in either case', () => {
  expect(link.request.scan(frame(':01?4MRL0020001f\r'), length)?.frame.body.toString()).toBe('MRL002000')
})

test.each<[string, ComputerLinkHead, string, number]>([
  ['station is 32, must be 0 to 31', { station: 32, responseTime: 0 }, 'MRL002000', 0],
  ['station is -1', { station: -1, responseTime: 0 }, 'MRL002000', 0],
  ['responseTime is 16, must be 0 to 15', { station: 1, responseTime: 16 }, 'MRL002000', 0],
  ['printable characters other than a colon, not 58', head, 'A:B', 0],
  ['printable characters other than a colon, not 13', head, 'A\rB', 0],
  ['at most 4096 characters here, not 5008', head, 'A'.repeat(5000), 0],
  ['error code is 256, must be 0 to 255', head, '', 256],
])('%s: refused before it is sent', (reason, given, content, endCode) => {
  const write = () =>
    endCode === 0 ? link.request.write(given, 0, frame(content)) : link.response.write(given, 0, endCode, frame(''))
  expect(write).toThrow(RequestError)
  expect(write).toThrow(reason)
})

test('an answer of another station is not taken', () => {
  expect(link.mismatch(head, { station: 1, responseTime: 9 })).toBeUndefined()
  expect(link.mismatch(head, { station: 2, responseTime: 4 })).toBe('station is 2, asked 1')
})

test.each([
  ['the echo of the command', ':01?4MRL0020001F\r:01#4117\r', 17],
  ['rubbish', '\xff\x00:9:01#4117\r', 4],
  ['rubbish only', '\xff1?4', 4],
  ['the beginning of a frame', '##:0', 2],
  ['nothing', '', 0],
])('noise in front of an answer: %s', (_what, text, noise) => {
  expect(link.response.noise?.(frame(text))).toBe(noise)
})

test('any bytes give a frame, more to come or a ProtocolError, and noise that leaves the start of a frame', () => {
  const characters = fc.constantFrom(...Buffer.from(':?#%0123456789ABCDEF@\r\xff', 'latin1'))
  fc.assert(
    fc.property(fc.uint8Array({ maxLength: 40 }), fc.array(characters, { maxLength: 40 }), (any, likely) => {
      for (const bytes of [
        Buffer.from(any),
        Buffer.from(likely),
        Buffer.concat([frame(':01#4'), Buffer.from(likely)]),
      ]) {
        for (const side of [link.request, link.response]) {
          try {
            const scanned = side.scan(bytes, length)
            if (scanned !== undefined) expect(bytes[scanned.used - 1]).toBe(0x0d)
          } catch (error) {
            expect(error).toBeInstanceOf(ProtocolError)
          }
          const noise = side.noise?.(bytes) ?? 0
          if (noise < bytes.length) expect(bytes[noise]).toBe(0x3a)
        }
      }
    }),
  )
})
