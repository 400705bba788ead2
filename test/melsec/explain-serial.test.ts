// Serial frames in words.
import { describe, expect, test } from '@jest/globals'
import { commands } from '../../src/melsec/commands/commands'
import { explainFrame, formatExplanation } from '../../src/melsec/explain/frame'
import type { ExplainFrameOptions } from '../../src/melsec/explain/options'
import { serialRoute } from '../../src/melsec/frame/serial-frames'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import { controlText } from '../vectors/control-text'
import { headOf, optionsOf, serialVectors } from '../vectors/serial-case'
import { bytesOf, type FrameVector } from '../vectors/vectors'
import { expectMessage, explained, lines, uncovered } from './explained'

const octal = ({ xyRadix }: FrameVector): ExplainFrameOptions => (xyRadix === 8 ? { asciiXy: 'octal', xyRadix } : {})

describe.each(serialVectors.map((vector) => ({ id: vector.id, vector })))('$id', ({ vector }) => {
  const bytes = bytesOf(vector)
  const { frame, format, sumCheck } = optionsOf(vector)
  // ACK and NAK have no sum whatever the port is set to.
  const isSummed = sumCheck === true

  test('frame, format, side, route and sum are told from the bytes', () => {
    const explanation = explained(bytes, octal(vector))
    expect(explanation).toMatchObject({ frame, direction: vector.side, code: vector.code })
    expect(explanation.title).toContain(`${frame} ${vector.side}, format ${format}`)
    expect(explanation.endCode).toBe(vector.endCode)
    const values = Object.fromEntries(explanation.rows.map(({ name, value }) => [name, value]))
    expect(values).toMatchObject(headOf(vector))
    expect(lines(explanation).filter((line) => line.startsWith('sum: '))).toEqual(
      isSummed ? [expect.stringMatching(/\(right\)$/)] : [],
    )
    if (vector.side === 'request') expectMessage(explanation, vector.message)
  })

  test('the same when all of it is said', () => {
    const said = explained(bytes, { ...octal(vector), frame, format, ...(isSummed ? { sumCheck: true } : {}) })
    expect(said.rows).toEqual(explained(bytes, octal(vector)).rows)
  })

  test('cut anywhere: every byte in a row, nothing thrown', () => {
    for (let length = 1; length < bytes.length; length++) {
      const cut = bytes.subarray(0, length)
      const explanation = explainFrame(cut, { ...octal(vector), frame, format, sumCheck: isSummed })
      expect(uncovered(explanation, cut)).toBeUndefined()
      expect(explanation.fault?.offset ?? 0).toBeLessThanOrEqual(length)
    }
  })
})

test('a whole frame as it is printed', () => {
  const bytes = controlText('<ENQ>00FFBR0M00100A<CR><LF>')
  expect(formatExplanation(explainFrame(bytes))).toBe(
    [
      '1C request, format 4: Batch read (bit units) (BR), M10, 10 points',
      '     0  <ENQ>     start        ENQ',
      '     1  00        station      0',
      '     3  FF        pc           255 (FFH: the connected station)',
      '     5  BR        command      BR (Batch read (bit units))',
      '     7  0         messageWait  0 ms (the answer comes no sooner)',
      '     8  M0010     head         M10 (internal relay)',
      '    13  0A        points       10 (bits)',
      '    15  <CR><LF>  end of line  CR LF',
    ].join('\n'),
  )
})

describe('answers with their requests', () => {
  const protocolOf = (format: 1 | 4 | 5) => {
    const framing = serialFraming({ frame: '4C', format })
    return new MelsecProtocol({ framing, head: serialRoute('4C'), profile: resolveProfile('q'), code: framing.code })
  }

  test.each([1, 4, 5] as const)('4C format %s', (format) => {
    const protocol = protocolOf(format)
    const asked = protocol.exchange(commands.readWords, { head: { device: 'D', number: 0x10 }, points: 2 })
    const request = asked.write(0)
    const data = format === 5 ? Buffer.from('10101000', 'hex') : Buffer.from('10100010')
    const answer = protocol.framing.response.write(serialRoute('4C'), 0, 0, data)
    const explanation = explained(answer, { request })
    expect(lines(explanation)).toContain('values: D16..D17: 4112 16')
    expect(explanation).toMatchObject({ command: 'readWords', endCode: 0 })
    if (format === 5) {
      // Doubled DLEs belong to their value.
      const values = explanation.rows.find(({ name }) => name === 'values')
      expect(values).toMatchObject({ bytes: '10 10 10 10 10 10 00', length: 7 })
    }
    const refused = protocol.framing.response.write(serialRoute('4C'), 0, 0x7143, Buffer.alloc(0))
    expect(explained(refused, { request })).toMatchObject({ command: 'readWords', endCode: 0x7143 })
    expect(lines(explained(refused)).join()).toContain('7143H (refused)')
  })

  test('1C: values by their devices, and what a code means', () => {
    const request = controlText('<ENQ>00FFWR0TN123025F<CR><LF>')
    const answer = explained(controlText('<STX>00FF7BC91234<ETX>AE<CR><LF>'), { request })
    expect(answer).toMatchObject({ command: 'WR', endCode: 0 })
    expect(lines(answer)).toContain('values: TN123..TN124: 31689 4660')
    const alone = explained(controlText('<STX>00FF7BC91234<ETX>AE<CR><LF>'))
    expect(alone.notes).toEqual([expect.stringContaining('What the values mean is in the request')])
    const refused = explained(controlText('<NAK>00FF06'), { request })
    expect(refused).toMatchObject({ title: '1C response, format 1: refused', command: 'WR', endCode: 6 })
    expect(lines(refused).at(-1)).toMatch(/^endCode: 06H \(refused\) Character area error/)
    expect(explained(controlText('<ACK>00FF')).title).toBe('1C response, format 1: carried out')
  })

  test('1C: devices that the frame has under other names, and words in bit units', () => {
    const write = explained(controlText('<ENQ>00FFBT001M80021'), { profile: 'iq-f' })
    expect(lines(write)).toContain('bits.0.device: M8002 (internal relay), on iQ-F SM8002')
    const bits = explained(controlText('<ENQ>00FFBR0D010001'))
    expect(bits.notes).toEqual([expect.stringContaining('D has words')])
    const unknown = explained(controlText('<ENQ>00FFZZ0123'))
    expect(unknown.notes).toEqual(['No command ZZ is known here; its data is left as it is.'])
  })

  test('a request that is none is said to be none', () => {
    const request = controlText('<ENQ>00FFXX0')
    expect(explained(controlText('<ACK>00FF'), { request }).notes.join()).toContain('no request that can be read')
  })
})

describe('what is wrong', () => {
  const wrong = (text: string, options: ExplainFrameOptions = {}) => {
    const bytes = controlText(text)
    const explanation = explainFrame(bytes, options)
    expect(uncovered(explanation, bytes)).toBeUndefined()
    return explanation
  }

  test.each([
    ['a wrong sum of a request', '<ENQ>00FFWR0TN1230260', {}, 'the sum check code does not match', 'sum'],
    ['a wrong sum of an answer', '<STX>00FF7BC91234<ETX>AF', {}, 'the sum check code does not match', 'sum'],
    ['half a sum', '<STX>00FF7BC91234<ETX>A', {}, 'the sum check code is missing', 'sum'],
    ['no sum', '<STX>00FF7BC91234<ETX>', { sumCheck: true }, 'the sum check code is missing', 'sum'],
    ['no ETX', '<STX>00FF7BC9', {}, 'the frame ends without ETX', undefined],
    ['no CR LF', '<ACK>00FF', { format: 4 }, 'CR LF is missing', undefined],
    ['another frame', '<ACK>F80000FF00', { frame: '3C' }, 'this is no 3C frame', 'frameId'],
    ['more than an ACK', '<ACK>00FF12', {}, '2 byte(s) left over', undefined],
    ['a NAK without a code', '<NAK>00FF00', {}, 'NAK carries no error code', 'endCode'],
    ['no start code', '00FF', { frame: '1C' }, 'starts with ENQ, STX, ACK or NAK', undefined],
    ['no digits in the route', '<ENQ>0GFFWR0', { frame: '1C' }, 'hexadecimal digit', 'station'],
  ] as const)('%s', (_what, text, options, message, name) => {
    expect(wrong(text, options).fault).toMatchObject({
      message: expect.stringContaining(message),
      ...(name === undefined ? {} : { name }),
    })
  })

  test.each([
    ['no DLE STX', '1102', 0, 'DLE STX'],
    ['a lone DLE', '1002001005', 4, 'neither DLE nor ETX'],
    ['no end', '10021200f80000ffff030000', 12, 'without DLE ETX'],
    ['a wrong sum', '10021200f80000ffff030000010400006400 0000a80200 10033030', undefined, ''],
    ['another count', '10021300f80000ffff03000001040000640000a802001003', 2, '19 data bytes announced, 18 found'],
    ['another frame', '10021200f90000ffff03000001040000640000a802001003', 4, 'no 4C frame'],
  ])('format 5, %s', (_what, hex, offset, message) => {
    const bytes = Buffer.from(hex.replaceAll(' ', ''), 'hex')
    const explanation = explainFrame(bytes, { frame: '4C' })
    expect(uncovered(explanation, bytes)).toBeUndefined()
    expect(explanation.fault).toMatchObject({
      message: expect.stringContaining(message),
      ...(offset === undefined ? {} : { offset }),
    })
  })

  test('what the sum should be, and a sum that leaves ETX out', () => {
    expect(lines(wrong('<STX>00FF7BC91234<ETX>AF')).at(-1)).toBe('sum: "AF" (should be "AE")')
    expect(lines(explained(controlText('<STX>00FF7BC91234<ETX>AB'))).at(-1)).toBe('sum: "AB" (right, without ETX)')
    expect(lines(explained(controlText('<ACK>00FFEC'))).at(-1)).toBe('sum: "EC" (right)')
  })

  test('formats that are of another frame', () => {
    expect(() => explainFrame(Buffer.of(5), { frame: '1C', format: 5 })).toThrow(
      'The 1C frame has formats 1, 4, not 5.',
    )
    expect(() => explainFrame(Buffer.of(5), { frame: '3E', format: 1 })).toThrow(
      'The 3E frame has no format: 1C, 3C and 4C have.',
    )
  })
})

test('what brings the PLC to a known state', () => {
  expect(explained(controlText('<EOT><CR><LF>')).title).toMatch(/^EOT, format 4: the PLC gives up/)
  expect(explained(controlText('<CL>')).title).toMatch(/^CL, format 1: /)
})

test('frames one behind the other end where they end', () => {
  const stream = controlText('<ENQ>00FFRR0<ACK>00FF<ENQ>00FFWR0TN123025F<CR><LF><STX>00FF7BC91234<ETX>AE<CR><LF><EOT>')
  const titles: string[] = []
  for (let rest: Buffer = stream; rest.length > 0; ) {
    const explanation = explainFrame(rest)
    expect(explanation.fault).toBeUndefined()
    titles.push(explanation.title)
    rest = rest.subarray(rest.length - explanation.rest)
  }
  expect(titles.map((title) => title.split(/[:,] /).slice(0, 2).join(' '))).toEqual([
    '1C request format 1',
    '1C response format 1',
    '1C request format 4',
    '1C response format 4',
    'EOT format 1',
  ])
})
