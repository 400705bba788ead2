/** Frames that come unasked, between the answers and whatever way the bytes are cut: each is told once, none disturbs. */
import { describe, expect, test } from '@jest/globals'
import { slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { onDemandFrames } from '../melsec/on-demand-frames'
import { answer, job, sent, sessionOf, type TestSession, told } from './support'

describe.each(onDemandFrames)('On-demand in a $frame frame in $code code', ({ frame, code, bytes }) => {
  const framing = slmpFraming(frame, code)
  const scanned = framing.request.scan(bytes, () => undefined)
  const unasked = `unsolicited ${scanned?.frame.body.toString('latin1')}`

  /** A session with requests A and B under way or waiting, and everything the PLC sends while it answers A. */
  function asked(window: number): { readonly session: TestSession; readonly arriving: Buffer } {
    const session = sessionOf(framing, { window })
    session.submit(job('A'), 0)
    session.submit(job('B'), 0)
    const [a] = sent(session, framing)
    if (a === undefined) throw new Error('nothing was sent')
    return { session, arriving: Buffer.concat([bytes, answer(framing, a), bytes, bytes]) }
  }

  const windows = frame === '4E' ? [1, 2] : [1]
  test.each(windows)('around an answer, cut in two anywhere, with %d request(s) in flight', (window) => {
    const { length } = asked(window).arriving
    for (let cut = 0; cut <= length; cut++) {
      const { session, arriving } = asked(window)
      session.receive(Buffer.from(arriving.subarray(0, cut)), 1)
      session.receive(Buffer.from(arriving.subarray(cut)), 2)
      expect(told(session)).toEqual([unasked, 'A answered A', unasked, unasked])
      expect(session.inFlight).toBe(1)
    }
  })

  test('around an answer, byte by byte', () => {
    const { session, arriving } = asked(1)
    for (const byte of arriving) session.receive(Buffer.of(byte), 1)
    expect(told(session)).toEqual([unasked, 'A answered A', unasked, unasked])
  })

  test('with nothing asked, and before the first request', () => {
    const session = sessionOf(framing)
    session.receive(bytes, 0)
    session.receive(Buffer.concat([bytes, bytes]), 1)
    expect(told(session)).toEqual([unasked, unasked, unasked])
  })

  test('does not put off the deadline of a request, and is told when the connection ends', () => {
    const { session } = asked(1)
    session.receive(bytes, 999)
    expect(session.nextTimeout(0)).toBe(1000)
    session.disconnected()
    expect(told(session)).toEqual([unasked, 'A disconnected sent', 'B disconnected unsent'])
  })

  test('as a datagram is one frame: whole, alone, and no answer', () => {
    const session = sessionOf(framing, { kind: 'datagram' })
    session.submit(job('A'), 0)
    const [a] = sent(session, framing)
    if (a === undefined) throw new Error('nothing was sent')
    session.receive(bytes, 1)
    session.receive(answer(framing, a), 1)
    session.receive(bytes, 1)
    const renewed = frame === '3E' ? ['renew answered'] : []
    expect(told(session)).toEqual([unasked, 'A answered A', ...renewed, unasked])
    session.receive(Buffer.concat([bytes, bytes]), 2)
    expect(told(session)).toEqual(['drop TRAILING'])
  })
})
