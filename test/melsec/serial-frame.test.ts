// Serial frames beside what the manual prints: options, routes, noise, broken frames.
import { describe, expect, test } from '@jest/globals'
import { type PlcError, ProtocolError, RequestError } from '../../src/errors'
import { Responder, Session } from '../../src/link/link'
import {
  allStations,
  LONGEST_SERIAL_FRAME,
  type SerialHead,
  serialFrameFacts,
  serialRoute,
} from '../../src/melsec/frame/serial-frames'
import { type SerialFrameOptions, type SerialFraming, serialFraming } from '../../src/melsec/frame/serial-framing'
import { eventsOf } from '../link/support'
import { questionOf } from '../support/question'
import { controlText } from '../vectors/control-text'

const noLength = () => undefined
const frame = controlText

const head1c = { station: 0, pc: 0xff }
const own = (name: SerialFrameOptions['frame']) => serialRoute(name)

const all: readonly SerialFrameOptions[] = Object.entries(serialFrameFacts).flatMap(([name, { formats }]) =>
  formats.flatMap((format) =>
    [true, false].map((sumCheck) => ({ frame: name as SerialFrameOptions['frame'], format, sumCheck })),
  ),
)
const titled = all.map((options) => ({
  title: `${options.frame} format ${options.format}${options.sumCheck === true ? '' : ' without sum check'}`,
  options,
}))

function errorOf(run: () => unknown): PlcError {
  try {
    run()
  } catch (error) {
    if (error instanceof ProtocolError || error instanceof RequestError) return error
    throw error
  }
  throw new Error('nothing was thrown')
}

describe('what the manual leaves open', () => {
  const f = (options: Partial<SerialFrameOptions>) => serialFraming({ frame: '1C', format: 1, ...options })

  test('the sum of an answer with data includes ETX, or not', () => {
    expect(f({}).response.write(head1c, 0, 0, Buffer.from('01101'))).toEqual(frame('<STX>00FF01101<ETX>E2'))
    expect(f({ etxInSum: false }).response.write(head1c, 0, 0, Buffer.from('01101'))).toEqual(
      frame('<STX>00FF01101<ETX>DF'),
    )
    const with3c = serialFraming({ frame: '3C', format: 1 })
    expect(with3c.response.write(own('3C'), 0, 0, Buffer.from('00010011'))).toEqual(
      frame('<STX>F90000FF0000010011<ETX>B1'),
    )
    const with4c = serialFraming({ frame: '4C', format: 4 })
    expect(with4c.response.write(own('4C'), 0, 0, Buffer.from('00010011'))).toEqual(
      frame('<STX>F80000FF03FF000000010011<ETX>FF<CR><LF>'),
    )
  })

  test.each([true, false])('etxInSum %s: the other sum is refused', (etxInSum) => {
    const other = f({ etxInSum: !etxInSum }).response.write(head1c, 0, 0, Buffer.from('01101'))
    expect(errorOf(() => f({ etxInSum }).response.scan(other, noLength)).code).toBe('BAD_SUM')
  })

  test('ACK and NAK have no sum, or one', () => {
    const [ack, nak] = [
      f({}).response.write(head1c, 0, 0, Buffer.alloc(0)),
      f({}).response.write(head1c, 0, 6, Buffer.alloc(0)),
    ]
    expect([ack, nak]).toEqual([frame('<ACK>00FF'), frame('<NAK>00FF06')])
    const withSum = f({ sumOfAck: true })
    expect(withSum.response.write(head1c, 0, 0, Buffer.alloc(0))).toEqual(frame('<ACK>00FFEC'))
    expect(withSum.response.scan(frame('<ACK>00FFEC'), noLength)).toMatchObject({ used: 7, frame: { endCode: 0 } })
    expect(withSum.response.scan(frame('<NAK>00FF0652'), noLength)).toMatchObject({ used: 9, frame: { endCode: 6 } })
    expect(errorOf(() => withSum.response.scan(frame('<NAK>00FF0752'), noLength)).code).toBe('BAD_SUM')
  })

  test('digits of the error code', () => {
    expect(() => f({}).response.write(head1c, 0, 0x7143, Buffer.alloc(0))).toThrow('does not fit into 2 digits')
    expect(f({ errorDigits: 4 }).response.scan(frame('<NAK>00FF0006'), noLength)?.frame.endCode).toBe(6)
    const two = serialFraming({ frame: '3C', format: 4, errorDigits: 2 })
    expect(two.response.scan(frame('<NAK>F90000FF0043<CR><LF>'), noLength)?.frame.endCode).toBe(0x43)
  })

  test('error information in format 5', () => {
    expect(serialFraming({ frame: '4C', format: 5 }).body.errorInformation).toBeUndefined()
    expect(serialFraming({ frame: '4C', format: 5, errorInformation: true }).body.errorInformation).toBeDefined()
  })

  test('a format that the frame does not have', () => {
    expect(() => serialFraming({ frame: '1C', format: 5 })).toThrow('The 1C frame has formats 1, 4, not 5.')
  })
})

describe('routes', () => {
  test('of the connected CPU, with what differs', () => {
    expect(serialRoute('1C', { station: 15 })).toEqual({ station: 15, pc: 0xff })
    expect(serialRoute('3C', { network: 2, pc: 3 }, 'c24')).toEqual({ station: 0, network: 2, pc: 3, selfStation: 0 })
    const route = { station: 31, network: 1, pc: 2, moduleIo: 0x10, multidrop: 5, selfStation: 1 }
    expect(serialRoute('4C', route, 'c24')).toEqual(route)
  })

  test.each([
    ['1C', { station: 16 }, 'fx5', 'Station 16 does not exist: 0 to 15.'],
    ['1C', { station: 32 }, 'c24', 'Station 32 does not exist: 0 to 31.'],
    ['1C', { station: 255 }, 'fx5', 'All stations are for the global signal only.'],
    ['1C', { network: 1 }, 'c24', 'The 1C frame has no network: it has station, pc.'],
    ['3C', { moduleIo: 0x3ff }, 'c24', 'The 3C frame has no moduleIo'],
    ['4C', { network: 1 }, 'fx5', 'Network 1 is not reached through an FX5: it is always 0 (00H).'],
    ['4C', { moduleIo: 0x3e0 }, 'fx5', 'Module I/O 992 is not reached through an FX5: it is always 1023 (03FFH).'],
    ['4C', { multidrop: 32 }, 'c24', 'Multidrop station 32 does not exist: 0 to 31.'],
    ['4C', { pc: 1.5 }, 'c24', 'PC number 1.5 does not exist: 0 to 255.'],
  ] as const)('%s %j through %s is refused', (name, given, reach, message) => {
    expect(() => serialRoute(name, given, reach)).toThrow(message)
  })

  test.each(titled)('$title: every field comes back, and an answer of another station is told', ({ options }) => {
    const framing = serialFraming(options)
    const fields = serialFrameFacts[options.frame].route
    const asked: SerialHead = {
      ...own(options.frame),
      ...Object.fromEntries(fields.map((name, i) => [name, i + 0xa1])),
    }
    const answer = framing.response.scan(framing.response.write(asked, 0, 0, Buffer.from('1234')), noLength)
    expect(answer?.frame.head).toEqual(asked)
    expect(framing.mismatch(asked, answer?.frame.head ?? {})).toBeUndefined()
    for (const name of fields) {
      expect(framing.mismatch({ ...asked, [name]: 9 }, answer?.frame.head ?? {})).toMatch(
        new RegExp(`^${name} is \\d+, asked 9$`),
      )
    }
  })

  test('all stations', () => {
    const framing = serialFraming({ frame: '1C', format: 4 })
    expect(framing.request.write(allStations, 0, Buffer.from('GW01'))).toEqual(frame('<ENQ>FFFFGW0117<CR><LF>'))
  })
})

describe.each(titled)('$title', ({ options }) => {
  const framing: SerialFraming = serialFraming(options)
  const head = own(options.frame)
  const isBinary = options.format === 5
  const length = () => 4
  const request = (text = 'QQ0A') => framing.request.write(head, 0, Buffer.from(text))
  const answer = (endCode = 0, text = '1234') => framing.response.write(head, 0, endCode, Buffer.from(text))
  /** What no frame begins with; 10H and 02H stand apart. */
  const rubbish = Buffer.from('00ff5510 0002 4142'.replaceAll(' ', ''), 'hex').filter((byte) => isBinary || byte !== 2)

  test('rubbish up to the start is noise', () => {
    const noise = Buffer.from(rubbish)
    expect(framing.request.noise?.(Buffer.concat([noise, request()]))).toBe(noise.length)
    expect(framing.response.noise?.(Buffer.concat([noise, answer()]))).toBe(noise.length)
    expect(framing.request.noise?.(request())).toBe(0)
    for (const one of [answer(), answer(0, ''), answer(6)]) expect(framing.response.noise?.(one)).toBe(0)
    expect(framing.response.noise?.(Buffer.alloc(0))).toBe(0)
  })

  test('noise is the same however it is cut', () => {
    const bytes = Buffer.concat([Buffer.from(rubbish), answer()])
    for (let cut = 0; cut < bytes.length; cut++) {
      const noise = framing.response.noise?.(bytes.subarray(0, cut)) ?? 0
      // A byte that may become a start is kept.
      expect(noise).toBeLessThanOrEqual(rubbish.length)
      expect(framing.response.noise?.(bytes.subarray(noise))).toBe(rubbish.length - noise)
    }
  })

  test('a start code that nothing follows but another one is noise', () => {
    const start = (bytes: Buffer) => bytes.subarray(0, isBinary ? 2 : 1)
    expect(framing.response.noise?.(Buffer.concat([start(answer()), answer()]))).toBe(start(answer()).length)
    expect(framing.request.noise?.(Buffer.concat([start(request()), request()]))).toBe(start(request()).length)
  })

  test('the echo of a request is noise to the client, and an answer is noise to a PLC on the same line', () => {
    expect(framing.response.noise?.(Buffer.concat([request(), answer()]))).toBe(request().length)
    expect(framing.response.noise?.(request())).toBe(request().length)
    for (const one of [answer(), answer(0, ''), answer(6, '')]) {
      expect(framing.request.noise?.(Buffer.concat([one, request()]))).toBe(one.length)
    }
  })

  test.each(['at once', 'byte by byte'])('on a line that gives back what is sent the answer is found, %s', (how) => {
    for (const [code, text] of [
      [0, '1234'],
      [0, ''],
      [6, ''],
    ] as const) {
      const session = new Session(framing, { kind: 'stream', window: 1, recovery: { quiet: 1, betweenBytes: 1 } })
      session.submit({ ...questionOf(framing, head, Buffer.from('QQ0A')), deadline: 100 }, 0)
      const bytes = Buffer.concat([Buffer.from(rubbish), session.transmit() ?? Buffer.alloc(0), answer(code, text)])
      for (const chunk of how === 'at once' ? [bytes] : [...bytes].map((byte) => Buffer.of(byte)))
        session.receive(chunk, 0)
      // The line is silent then: the end of ACK and NAK in format 1.
      session.timeout(1)
      const done = eventsOf(session).filter(({ kind }) => kind === 'done')
      expect(done).toMatchObject([{ outcome: { kind: 'answered', frame: { endCode: code, body: Buffer.from(text) } } }])
    }
  })

  test('a message that no frame is long enough for is refused', () => {
    expect(() => framing.checkBody?.(Buffer.alloc(LONGEST_SERIAL_FRAME, 0x31))).toThrow('at most 16320 bytes')
    expect(framing.checkBody?.(Buffer.alloc(16_000, 0x31))).toBeUndefined()
  })

  test('the responder finds the next request behind a broken one', () => {
    const plc = new Responder(framing, 'stream', length)
    const half = request().subarray(0, -3)
    const wrong = Buffer.from(request())
    wrong[isBinary ? 4 : 1] = 0x47
    const bytes = Buffer.concat([Buffer.from(rubbish), half, request('QQ0B'), wrong, request('QQ0C'), answer()])
    const found = plc.receive(bytes).map(({ body }) => String(body))
    const apart = new Responder(framing, 'stream', length)
    expect([...bytes].flatMap((byte) => apart.receive(Buffer.of(byte))).map(({ body }) => String(body))).toEqual(found)
    // 1C has no frame ID: without a sum check code "G0" as a station is not told from a digit that was changed.
    expect(found).toEqual(['QQ0B', 'QQ0C'])
    expect([plc.buffered, apart.buffered]).toEqual([0, 0])
  })

  test('a frame that does not end is refused before it fills the memory', () => {
    const start = answer(0, '1'.repeat(40)).subarray(0, 40)
    if (isBinary) start.set([0xff, 0xff], 2)
    const endless = Buffer.concat([start, Buffer.alloc(LONGEST_SERIAL_FRAME, 0x31)])
    expect(errorOf(() => framing.response.scan(endless, noLength)).code).toBe('BAD_FRAME')
    expect(framing.response.scan(answer(0, '1'.repeat(8000)), noLength)?.frame.body).toHaveLength(8000)
  })

  test('a frame that lost its end does not take the next one along', () => {
    for (const one of [answer(), answer(0, ''), answer(6)]) {
      const cut = one.subarray(0, isBinary ? -5 : 4)
      const error = errorOf(() => framing.response.scan(Buffer.concat([cut, answer()]), noLength))
      expect(error).toBeInstanceOf(ProtocolError)
    }
  })

  test('scans never throw anything else, and noise throws nothing', () => {
    const starts = [Buffer.alloc(0), request(), answer(), answer(6), request().subarray(0, 4), answer().subarray(0, 9)]
    let seed = 1
    const next = (below: number) => {
      seed = (seed * 48271) % 0x7fffffff
      return seed % below
    }
    for (let i = 0; i < 2000; i++) {
      const tail = Buffer.from(Array.from({ length: next(12) }, () => (next(2) === 0 ? next(256) : next(0x18))))
      const bytes = Buffer.concat([
        starts[next(starts.length)] ?? Buffer.alloc(0),
        tail,
        starts[next(starts.length)] ?? tail,
      ])
      for (const side of [framing.request, framing.response]) {
        const noise = side.noise?.(bytes) ?? 0
        expect(noise <= bytes.length && (side.noise?.(bytes.subarray(noise)) ?? 0) === 0).toBe(true)
        try {
          side.scan(bytes, length)
        } catch (error) {
          expect(error).toBeInstanceOf(ProtocolError)
        }
      }
    }
  })
})

describe('formats 1 and 4', () => {
  const one = serialFraming({ frame: '3C', format: 1, sumCheck: false })
  const four = serialFraming({ frame: '3C', format: 4, sumCheck: false })

  test('a refusal without a code is none', () => {
    expect(errorOf(() => one.response.scan(frame('<NAK>F90000FF000000'), noLength)).code).toBe('BAD_FIELD')
  })

  test('characters behind a frame of format 1: the settings differ', () => {
    const error = errorOf(() => one.response.scan(frame('<STX>F90000FF001234<ETX>25'), noLength))
    expect([error.code, error.message]).toEqual(['TRAILING', expect.stringContaining('sum check code?')])
    // A refusal whose start code was changed into ACK.
    expect(errorOf(() => one.response.scan(frame('<ACK>F90000FF007143'), noLength)).code).toBe('TRAILING')
    expect(one.response.scan(frame('<ACK>F90000FF00<CR><LF>'), noLength)?.used).toBe(11)
  })

  test('format 4 needs its CR LF', () => {
    for (const text of ['<ACK>F90000FF00<LF><CR>', '<ACK>F90000FF00<CR><CR>', '<STX>F90000FF0012<ETX><ETX>']) {
      expect(errorOf(() => four.response.scan(frame(text), noLength)).code).toBe('BAD_FRAME')
    }
  })

  test('a frame of another kind is refused by its frame ID', () => {
    const of4c = serialFraming({ frame: '4C', format: 4, sumCheck: false })
    const answer = of4c.response.write(own('4C'), 0, 0, Buffer.from('12'))
    expect(errorOf(() => four.response.scan(answer, noLength)).message).toContain('the frame ID is not F9')
  })

  test('lower-case digits are read', () => {
    const sums = serialFraming({ frame: '3C', format: 1 })
    const answer = sums.response.write({ ...own('3C'), station: 0xa }, 0, 0, Buffer.from('00BC'))
    const lower = Buffer.from(answer.toString('latin1').toLowerCase(), 'latin1')
    expect(errorOf(() => sums.response.scan(lower, noLength)).code).toBe('BAD_SUM')
    expect(one.response.scan(frame('<STX>f90a00ff00ab<ETX>'), noLength)?.frame.head).toMatchObject({ station: 10 })
  })

  test('a body with anything but printable characters is not written', () => {
    for (const byte of [0x02, 0x0d, 0x7f, 0x80]) {
      expect(() => one.request.write(own('3C'), 0, Buffer.of(0x31, byte))).toThrow(`not ${byte}`)
      expect(() => one.checkBody?.(Buffer.of(0x31, byte))).toThrow(`not ${byte}`)
    }
  })
})
