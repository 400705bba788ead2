import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { type FrameExplanation, formatExplanation } from '../../src/codec/explanation'
import { jwCommands } from '../../src/jw/commands/commands'
import { type ExplainJwOptions, explainJwFrame } from '../../src/jw/explain-frame'
import { jwProtocol } from '../../src/jw/protocol'
import type { NamedCommand } from '../../src/link/link'
import { bytesOf, type FrameVector, type Message, vectorsOfKind } from '../vectors/vectors'

const vectors = [...vectorsOfKind('jw-printed', 'frame'), ...vectorsOfKind('jw', 'frame')].filter(
  ({ command }) => command in jwCommands,
)

function uncovered({ rows, rest }: FrameExplanation, bytes: Buffer): string | undefined {
  let next = 0
  for (const { offset, length, name } of rows) {
    if (offset !== next) return `${name} starts at ${offset}, expected ${next}`
    next += length
  }
  return next === bytes.length - rest ? undefined : `the rows end at ${next} of ${bytes.length - rest}`
}

/** The frame of the request of an answer. */
function requestOf({ command: name, request, header, marker }: FrameVector): Buffer {
  if (request === undefined) throw new Error('the vector has no request')
  const command: NamedCommand = jwCommands[name as keyof typeof jwCommands]
  const model = name === 'setMemorySize' ? 'jw30h' : 'jw300'
  return jwProtocol({ header: header === undefined ? 'none' : 'zero40', marker: marker ?? 'once', model })
    .exchange(command, withBytes(request))
    .write(0)
}

const withBytes = (message: Message): Readonly<Record<string, unknown>> =>
  Array.isArray(message.data) ? { ...message, data: Buffer.from(message.data as number[]) } : message

function explained(bytes: Buffer, options: ExplainJwOptions): FrameExplanation {
  const explanation = explainJwFrame(bytes, options)
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
    const explanation = explained(bytesOf(vector), { marker: vector.marker ?? 'once' })
    expect(explanation).toMatchObject({ frame: 'JW', direction: 'request', command: vector.command })
    const head = explanation.rows.find(({ name }) => name === 'head')
    expect(head?.value).toEqual(vector.message?.head)
    if (Array.isArray(vector.message?.data)) expect([...dataOf(explanation)]).toEqual(vector.message.data)
  })

  test.each(vectors.filter(({ side }) => side === 'response'))('$id', (vector) => {
    const marker = vector.marker ?? 'once'
    const explanation = explained(bytesOf(vector), { marker, request: requestOf(vector) })
    expect(explanation).toMatchObject({ frame: 'JW', direction: 'response', endCode: vector.result })
    if (Array.isArray(vector.message?.data)) expect([...dataOf(explanation)]).toEqual(vector.message.data)
  })
})

describe('words', () => {
  const request = Buffer.from('4700240000080400', 'hex')

  test('say the address as a JW numbers it, and what the answer repeats', () => {
    const answer = Buffer.from('450024000000080400004f3201', 'hex')
    const lines = explained(answer, { request }).rows.map(({ name, text }) => `${name}: ${text}`)
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

  test.each([
    ['47000200 02ff070100', 'address', '003777 octal'],
    ['470023 09000100', 'number', '0011 octal'],
    ['470044 0881000200', 'segment', '08H'],
    ['470044 0881000200', 'address', '000201 octal'],
    ['470078 01010201002000 04', 'file', 'file 01H'],
    ['470078 01010201002000 04', 'address', '020000 octal'],
    ['470027 01ff0100080000', 'items.0.address', 'file 01H, byte 004000 octal (extended)'],
  ])('of %s say %s as it is numbered', (hex, name, text) => {
    const { rows, fault } = explainJwFrame(Buffer.from(hex.replaceAll(' ', ''), 'hex'))
    expect(fault).toBeUndefined()
    expect(rows.find((row) => row.name === name)?.text).toBe(text)
  })

  test('say what a result code means, and pass an unknown one on', () => {
    const result = (code: string) =>
      explainJwFrame(Buffer.from(`450034${code}`, 'hex')).rows.find(({ name }) => name === 'result')?.text
    expect(result('10')).toBe('10H (refused: The write mode does not allow it)')
    expect(result('05')).toBe('05H (refused: no text is known for this code)')
  })

  test('say where a relay leads', () => {
    const frame = jwProtocol({ header: { pda: 1, psa: 2, slot: 3, station: 4 } })
      .exchange(jwCommands.readRunState, {})
      .write(0)
    expect(explained(frame, {}).rows[0]?.text).toBe(
      'header of 40 bytes: relay to station 4 by the unit in slot 3, PDA 1, PSA 2',
    )
  })

  test('say what each timer and counter of an answer is', () => {
    const request = Buffer.from('470023' + '00000300', 'hex')
    const answer = Buffer.from('45002300' + '00000300' + '349278D60100' + '080A03', 'hex')
    const { rows } = explainJwFrame(answer, { request })
    expect(rows.at(-1)?.text).toBe('08H DTMR (BCD), 0AH UTMR (BCD), 03H not printed')
  })

  test.each(['4700fc0041423132', '4701fc0041423132', '4700fc00414231', '4700fc004142312d', '4700fc0341423132'])(
    'of %s never show the password',
    (hex) => {
      const text = formatExplanation(explainJwFrame(Buffer.from(hex, 'hex')))
      expect(text).not.toMatch(/41 42|AB1/)
      expect(text).toMatch(/\*\* \*\*/)
    },
  )

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
