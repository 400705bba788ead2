/**
 * The ways bytes can arrive: each frame of the manuals is fed to the scan functions and to the session (answers) or
 * responder (requests) whole, byte by byte, cut at every index, twice in one chunk, behind rubbish and one byte short.
 */

import { expect, test } from '@jest/globals'
import { ProtocolError } from '../../src/errors'
import type { Head } from '../../src/link/link'
import {
  type BodyLength,
  type Framing,
  Responder,
  Session,
  type SessionEvent,
  type SessionOptions,
} from '../../src/link/link'
import { questionOf } from '../support/question'
import type { Side } from './vectors'

/** A frame with everything it must be read as. */
export interface FrameCase<H extends Head> {
  readonly framing: Framing<H>
  readonly side: Side
  readonly bytes: Buffer
  /** What the scan gives as head. */
  readonly head: H
  /** What a session that gets this answer has asked with. */
  readonly askedHead: H
  readonly body: Buffer
  readonly serial?: number
  /** Of an answer. */
  readonly endCode?: number
  /** What some PLCs send behind it. */
  readonly mayFollow?: Buffer
  /** What else stands in its datagram means nothing. */
  readonly surplus?: true
  readonly bodyLength: BodyLength
  /** Where the serial number stands: an answer gets the one the session asked with. */
  readonly serialAt?: { readonly start: number; readonly end: number }
}

const DEADLINE = 1000
/** No frame starts with it, in no code. */
const RUBBISH = Buffer.of(0xff, 0xfe)

function scan<H extends Head>(given: FrameCase<H>, bytes: Buffer) {
  return given.framing[given.side].scan(bytes, given.bodyLength)
}

function frameOf<H extends Head>({ head, serial, body, side, endCode }: FrameCase<H>) {
  return side === 'request' ? { head, serial, body } : { head, serial, endCode, body }
}

/** Every split of `bytes` into two, every byte alone, and the whole. */
function cuts(bytes: Buffer): Buffer[][] {
  const halves = Array.from({ length: bytes.length - 1 }, (_, i) => [bytes.subarray(0, i + 1), bytes.subarray(i + 1)])
  return [[bytes], [...bytes].map((byte) => Buffer.of(byte)), ...halves]
}

/** A session that has asked, and the answer with the serial number it asked with. */
function asking<H extends Head>(
  given: FrameCase<H>,
  kind: 'stream' | 'datagram',
  recovery?: SessionOptions['recovery'],
) {
  const session = new Session(given.framing, { kind, window: 1, ...(recovery && { recovery }) })
  const { askedHead: head, bodyLength: responseLength } = given
  // Its frames have the head of the case, so that it is only asked with such ones.
  session.submit({ ...questionOf(given.framing, head, Buffer.alloc(0)), responseLength, deadline: DEADLINE }, 0)
  const sent = session.transmit()
  if (sent === undefined) throw new Error('the session sent nothing')
  const answer = Buffer.from(given.bytes)
  const serial = given.serialAt && sent.subarray(given.serialAt.start, given.serialAt.end)
  if (serial !== undefined && given.serialAt !== undefined) answer.set(serial, given.serialAt.start)
  return { session, answer }
}

function eventsOf<_H extends Head>(session: Session): SessionEvent[] {
  const events: SessionEvent[] = []
  for (let event = session.poll(); event !== undefined; event = session.poll()) events.push(event)
  return events
}

/** How the request of a session ended: the answer's end code and body, the error's code, or what else. */
function outcomesOf<_H extends Head>(events: readonly SessionEvent[]) {
  const ends = events.flatMap((event) => (event.kind === 'done' ? [event.outcome] : []))
  return ends.map((outcome) => {
    if (outcome.kind === 'answered') return { endCode: outcome.frame.endCode, body: outcome.frame.body.toString('hex') }
    return outcome.kind === 'failed' ? outcome.error.code : outcome.kind
  })
}

/**
 * Lends bytes as a transport does: what becomes of them is looked at before their memory holds something else.
 * @returns how the request ended, and the kind of every other event
 */
function lend(session: Session, bytes: Buffer): unknown[] {
  const lent = Buffer.from(bytes)
  session.receive(lent, 1)
  const outcomes = eventsOf(session).map((event) => (event.kind === 'done' ? outcomesOf([event])[0] : event.kind))
  lent.fill(0x5a)
  return outcomes
}

/** Registers the tests of one frame. `make` runs inside of each. */
export function testFeedings<H extends Head>(id: string, side: Side, make: () => FrameCase<H>): void {
  test(`${id}: written as printed`, () => {
    const { framing, head, askedHead, serial = 0, endCode = 0, body, bytes } = make()
    const written =
      side === 'request'
        ? framing.request.write(head, serial, body)
        : framing.response.write(askedHead, serial, endCode, body)
    expect(written.toString('hex')).toBe(bytes.toString('hex'))
  })

  test(`${id}: scanned whole, and out of two in one chunk`, () => {
    const given = make()
    const { mayFollow, surplus } = given
    const more = { ...(mayFollow && { mayFollow }), ...(surplus && { surplus }) }
    const scanned = { used: given.bytes.length, frame: frameOf(given), ...more }
    expect(scan(given, given.bytes)).toMatchObject(scanned)
    expect(scan(given, Buffer.concat([given.bytes, given.bytes]))).toMatchObject(scanned)
  })

  test(`${id}: no frame before its last byte`, () => {
    const given = make()
    for (let length = 0; length < given.bytes.length; length++) {
      expect([length, scan(given, given.bytes.subarray(0, length))]).toEqual([length, undefined])
    }
  })

  if (side === 'request') testResponder(id, make)
  else testSession(id, make)
}

function testResponder<H extends Head>(id: string, make: () => FrameCase<H>): void {
  const receiving = (given: FrameCase<H>, kind: 'stream' | 'datagram' = 'stream') =>
    new Responder(given.framing, kind, given.bodyLength)

  test(`${id}: one request however it is cut`, () => {
    const given = make()
    for (const chunks of cuts(given.bytes)) {
      const responder = receiving(given)
      expect(chunks.flatMap((chunk) => responder.receive(chunk))).toEqual([frameOf(given)])
    }
  })

  test(`${id}: two requests in one chunk`, () => {
    const given = make()
    const requests = receiving(given).receive(Buffer.concat([given.bytes, given.bytes]))
    expect(requests).toEqual([frameOf(given), frameOf(given)])
  })

  test(`${id}: rubbish in front gives no request of its own, and the next one is read`, () => {
    const given = make()
    expect(() => scan(given, Buffer.concat([RUBBISH, given.bytes]))).toThrow(ProtocolError)
    const responder = receiving(given)
    // Where lines have noise the request behind it is found.
    const found = given.framing.request.noise === undefined ? [] : [frameOf(given)]
    expect(responder.receive(Buffer.concat([RUBBISH, given.bytes]))).toEqual(found)
    expect(responder.receive(given.bytes)).toEqual([frameOf(given)])
  })

  test(`${id}: one byte short is no request, and no part of the next datagram`, () => {
    const given = make()
    const responder = receiving(given, 'datagram')
    expect(responder.receive(given.bytes.subarray(0, -1))).toEqual([])
    expect(responder.receive(given.bytes)).toEqual([frameOf(given)])
  })
}

function testSession<H extends Head>(id: string, make: () => FrameCase<H>): void {
  const answered = ({ endCode, body }: FrameCase<H>) => ({ endCode, body: body.toString('hex') })

  test(`${id}: one answer however it is cut`, () => {
    const given = make()
    for (const chunks of cuts(given.bytes).map((cut) => cut.map((chunk) => chunk.length))) {
      const { session, answer } = asking(given, 'stream')
      let at = 0
      const outcomes = chunks.flatMap((length) => {
        at += length
        return lend(session, answer.subarray(at - length, at))
      })
      expect(outcomes).toEqual([answered(given)])
    }
  })

  test(`${id}: of two in one chunk only the first is the answer`, () => {
    const given = make()
    const { session, answer } = asking(given, 'stream')
    session.receive(Buffer.concat([answer, answer]), 1)
    const events = eventsOf(session)
    expect(outcomesOf(events)).toEqual([answered(given)])
    // With a serial number the second is known to be stale; without one the connection cannot be trusted any more.
    expect(events.map((event) => event.kind)).toEqual([
      'done',
      given.framing.correlation === 'serial' ? 'stale' : 'drop',
    ])
  })

  test(`${id}: rubbish in front fails the request and drops the connection`, () => {
    const { session, answer } = asking(make(), 'stream')
    session.receive(Buffer.concat([RUBBISH, answer]), 1)
    const events = eventsOf(session)
    expect(events.map((event) => event.kind)).toEqual(['done', 'drop'])
    expect(events[0]).toMatchObject({ outcome: { kind: 'failed', error: { name: 'ProtocolError' } } })
  })

  test(`${id}: on a line with noise the answer behind it counts`, () => {
    const given = make()
    if (given.framing.recovery === undefined) return
    const { session, answer } = asking(given, 'stream', { quiet: 1, betweenBytes: 1 })
    const outcomes = [...Buffer.concat([RUBBISH, answer])].flatMap((byte) => lend(session, Buffer.of(byte)))
    // Silence shows that no more comes, where nothing else does.
    session.timeout(2)
    const ends = outcomes.filter((outcome) => outcome !== 'stray')
    expect([...ends, ...outcomesOf(eventsOf(session))]).toEqual([answered(given)])
  })

  test(`${id}: one byte short is no answer`, () => {
    const given = make()
    const stream = asking(given, 'stream')
    stream.session.receive(stream.answer.subarray(0, -1), 1)
    expect(eventsOf(stream.session)).toEqual([])
    stream.session.timeout(DEADLINE)
    expect(outcomesOf(eventsOf(stream.session))).toEqual(['timedOut'])

    const datagram = asking(given, 'datagram')
    datagram.session.receive(datagram.answer.subarray(0, -1), 1)
    expect(outcomesOf(eventsOf(datagram.session))).toEqual(['TRUNCATED'])
  })
}

/** Registers the test of a wrong sum check code: every other value of its two characters. */
export function testWrongSum<H extends Head>(id: string, make: () => FrameCase<H>): void {
  test(`${id}: any other sum check code is refused`, () => {
    const given = make()
    const right = given.bytes.subarray(-2).toString('latin1')
    for (let sum = 0; sum <= 0xff; sum++) {
      const code = sum.toString(16).toUpperCase().padStart(2, '0')
      if (code === right) continue
      const wrong = Buffer.concat([given.bytes.subarray(0, -2), Buffer.from(code)])
      expect(() => scan(given, wrong)).toThrow(expect.objectContaining({ code: 'BAD_SUM' }))
    }
  })
}
