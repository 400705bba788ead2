import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { type FrameExplanation, formatExplanation } from '../../src/codec/explanation'
import { jwCommands } from '../../src/jw/commands'
import { explainJwFrame } from '../../src/jw/explain-frame'
import { jwFrame } from '../../src/jw/frame'
import { jwProtocol } from '../../src/jw/protocol'
import type { NamedCommand } from '../../src/link/link'
import { bytesOf, type FrameVector, type Message, vectorsOfKind } from '../vectors/vectors'

const vectors = vectorsOfKind('jw', 'frame')
const protocol = jwProtocol()

function uncovered({ rows, rest }: FrameExplanation, bytes: Buffer): string | undefined {
  let next = 0
  for (const { offset, length, name } of rows) {
    if (offset !== next) return `${name} starts at ${offset}, expected ${next}`
    next += length
  }
  return next === bytes.length - rest ? undefined : `the rows end at ${next} of ${bytes.length - rest}`
}

/** The frame of the request of an answer. */
function requestOf({ command: name, request, header }: FrameVector): Buffer {
  if (request === undefined) throw new Error('the vector has no request')
  const command: NamedCommand = jwCommands[name as keyof typeof jwCommands]
  const exchange = protocol.exchange(command, withBytes(request))
  const framing = jwFrame(header === undefined ? {} : { header: 'zero40' })
  return framing.request.write({ command: command.code }, 0, exchange.body)
}

const withBytes = (message: Message): Readonly<Record<string, unknown>> =>
  Array.isArray(message.data) ? { ...message, data: Buffer.from(message.data as number[]) } : message

function explained(bytes: Buffer, request?: Buffer): FrameExplanation {
  const explanation = explainJwFrame(bytes, request === undefined ? {} : { request })
  expect(explanation.fault).toBeUndefined()
  expect(explanation.rest).toBe(0)
  expect(uncovered(explanation, bytes)).toBeUndefined()
  return explanation
}

function dataOf({ rows }: FrameExplanation): Buffer {
  const data = rows.filter(({ name }) => name === 'data' || name.startsWith('data.'))
  return Buffer.concat(data.map(({ value }) => value as Buffer))
}

// JW300 manual: file numbers are hexadecimal, the addresses in a file octal.
test('a file number is hexadecimal, its byte address octal', () => {
  const { rows } = explainJwFrame(Buffer.from('4700241a00080400', 'hex'))
  expect(rows.find(({ name }) => name === 'head')?.text).toBe('file 1AH, byte 004000 octal')
})

describe('frames of the manuals', () => {
  test.each(vectors.filter(({ side }) => side === 'request'))('$id', (vector) => {
    const explanation = explained(bytesOf(vector))
    expect(explanation).toMatchObject({ frame: 'JW', direction: 'request', command: vector.command })
    const head = explanation.rows.find(({ name }) => name === 'head')
    expect(head?.value).toEqual(vector.message?.head)
    if (Array.isArray(vector.message?.data)) expect([...dataOf(explanation)]).toEqual(vector.message.data)
  })

  test.each(vectors.filter(({ side }) => side === 'response'))('$id', (vector) => {
    const explanation = explained(bytesOf(vector), requestOf(vector))
    expect(explanation).toMatchObject({ frame: 'JW', direction: 'response', endCode: vector.result })
    if (Array.isArray(vector.message?.data)) expect([...dataOf(explanation)]).toEqual(vector.message.data)
  })
})

describe('words', () => {
  const request = Buffer.from('4700240000080400', 'hex')

  test('say the address as a JW numbers it, and what the answer repeats', () => {
    const answer = Buffer.from('450024000000080400004f3201', 'hex')
    const lines = explained(answer, request).rows.map(({ name, text }) => `${name}: ${text}`)
    expect(lines).toEqual([
      'id: response',
      'attr: 0',
      'command: 24H (Read data memory)',
      'result: 00H (carried out)',
      'head: file 00H, byte 004000 octal (repeats the request)',
      'length: 4 (repeats the request)',
      'data: 00 4F 32 01',
    ])
  })

  test('without the request say that it is needed', () => {
    const { notes, fault } = explainJwFrame(Buffer.from('450024000000080400004f3201', 'hex'))
    expect(fault).toBeUndefined()
    expect(notes).toEqual([expect.stringContaining('the request')])
  })

  test.each([
    ['', 0, 'missing'],
    ['48', 0, 'fixed to 71'],
    ['470124', 1, 'fixed to 0'],
    ['47002400000804', 6, 'needs 2 more'],
  ])('%s is wrong', (hex, offset, message) => {
    const { fault } = explainJwFrame(Buffer.from(hex, 'hex'))
    expect(fault?.message).toContain(message)
    expect(fault?.offset).toBeGreaterThanOrEqual(offset)
  })

  test('an answer to another request is wrong', () => {
    expect(explainJwFrame(Buffer.from('450034000000080400', 'hex'), { request }).fault).toMatchObject({
      name: 'command',
    })
    const other = Buffer.from('450024000001080400004f3201', 'hex')
    expect(explainJwFrame(other, { request }).fault).toMatchObject({
      name: 'head',
      message: expect.stringContaining('repeat'),
    })
  })
})

test('any bytes: never an exception, every byte in a row', () => {
  const starts = ['', '4700', '4500', '00'.repeat(40), `${'00'.repeat(40)}4700`].map((hex) => Buffer.from(hex, 'hex'))
  fc.assert(
    fc.property(fc.constantFrom(...starts), fc.uint8Array({ maxLength: 40 }), fc.boolean(), (start, rest, self) => {
      const bytes = Buffer.concat([start, rest])
      const explanation = explainJwFrame(bytes, self ? { request: bytes } : {})
      expect(uncovered(explanation, bytes)).toBeUndefined()
      expect(formatExplanation(explanation)).toEqual(expect.any(String))
    }),
    { numRuns: 1000 },
  )
})
