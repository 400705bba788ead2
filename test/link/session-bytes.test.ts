// How bytes arrive, and what becomes of them: pieces, rubbish, too much, too little, nothing.

import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { jwFrame } from '../../src/jw/frame'
import type { Head } from '../../src/link/link'
import { type Framing, Session, type SessionOptions } from '../../src/link/link'
import { frame1e } from '../../src/melsec/frame/frame-1e'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { questionOf } from '../support/question'
import { answer, eventsOf, HEAD, job, sent, sessionOf, slmpFrames, told } from './support'

describe.each(slmpFrames)('$title', ({ framing }) => {
  /** A session with a request in flight, and its answer. */
  function asking(options: Partial<SessionOptions> = {}) {
    const session = sessionOf(framing, options)
    session.submit(job('A'), 0)
    const [request] = sent(session, framing)
    if (request === undefined) throw new Error('nothing was sent')
    return { session, reply: answer(framing, request) }
  }
  const serial = framing.correlation === 'serial'

  test('an answer is one however it is cut, and is told with its last byte', () => {
    const { reply } = asking()
    for (let cut = 0; cut <= reply.length; cut++) {
      const { session } = asking()
      session.receive(reply.subarray(0, cut), 1)
      expect([cut, session.inFlight]).toEqual([cut, cut === reply.length ? 0 : 1])
      if (cut < reply.length) session.receive(reply.subarray(cut), 2)
      expect(told(session)).toEqual(['A answered A'])
    }
  })

  test('an answer in single bytes, and two in one segment with the cut in the second', () => {
    const { session, reply } = asking()
    for (const byte of reply) session.receive(Buffer.of(byte), 1)
    session.submit(job('B'), 2)
    const [second] = sent(session, framing)
    const answers = Buffer.concat([answer(framing, second ?? { serial: 0, body: Buffer.alloc(0) }), reply])
    session.receive(answers.subarray(0, reply.length + 3), 3)
    session.receive(answers.subarray(reply.length + 3), 4)
    // The second one belongs to nobody: known to be stale by its number, and the end of the trust without one.
    expect(told(session)).toEqual(['A answered A', 'B answered B', serial ? 'stale 1' : 'drop UNEXPECTED_ANSWER'])
  })

  test('rubbish fails what is in flight and drops the connection; nothing is attributed afterwards', () => {
    const { session, reply } = asking()
    session.submit(job('B'), 0)
    session.receive(Buffer.concat([Buffer.of(0xff), reply]), 1)
    session.receive(reply, 2)
    session.submit(job('C'), 3)
    expect(told(session)).toEqual(['A failed BAD_FRAME', 'drop BAD_FRAME'])
    expect(session.transmit()).toBeUndefined()
    session.disconnected()
    expect(told(session)).toEqual(['B disconnected unsent', 'C disconnected unsent'])
  })

  test('a frame that does not end is given up before it fills the memory', () => {
    const { session, reply } = asking({ maxFrame: 100 })
    // The longest length the head can say.
    const code = framing.name.endsWith('ascii') ? 'FFFF' : '\xff\xff'
    const at = framing.response.write(HEAD, 1, 0, Buffer.alloc(0)).length - 2 * code.length
    const endless = Buffer.concat([reply.subarray(0, at), Buffer.from(code, 'latin1')])
    session.receive(endless, 1)
    expect(told(session)).toEqual([])
    session.receive(Buffer.alloc(101, 0x30), 2)
    expect(told(session)).toEqual(['A failed BAD_FRAME', 'drop BAD_FRAME'])
  })

  test('a datagram is believed as a whole or not at all', () => {
    const trailing = asking({ kind: 'datagram' })
    trailing.session.receive(Buffer.concat([trailing.reply, Buffer.of(0)]), 1)
    expect(told(trailing.session)).toEqual(['A failed TRAILING', 'drop TRAILING'])

    const doubled = asking({ kind: 'datagram' })
    doubled.session.receive(Buffer.concat([doubled.reply, doubled.reply]), 1)
    expect(told(doubled.session)).toEqual(['A failed TRAILING', 'drop TRAILING'])

    const short = asking({ kind: 'datagram' })
    short.session.receive(short.reply.subarray(0, -1), 1)
    expect(told(short.session)).toEqual(['A failed TRUNCATED', 'drop TRUNCATED'])

    const unasked = asking({ kind: 'datagram' })
    unasked.session.receive(Buffer.concat([framing.request.write(HEAD, 1, Buffer.from('news')), Buffer.of(0)]), 1)
    expect(told(unasked.session)).toEqual(['A failed TRAILING', 'drop TRAILING'])
  })

  test('what was not handed out yet was not sent, whatever happens', () => {
    const untouched = () => {
      const session = sessionOf(framing)
      session.submit(job('A', 10), 0)
      return session
    }
    const lost = untouched()
    lost.disconnected()
    expect([told(lost), lost.transmit()]).toEqual([['A disconnected unsent'], undefined])

    const late = untouched()
    late.timeout(10)
    expect([told(late), late.transmit()]).toEqual([['A timedOut unsent'], undefined])

    const broken = untouched()
    broken.receive(Buffer.from('rubbish'), 1)
    broken.disconnected()
    const why = framing.correlation === 'serial' ? 'drop BAD_FRAME' : 'drop UNEXPECTED_ANSWER'
    expect([told(broken), broken.transmit()]).toEqual([[why, 'A disconnected unsent'], undefined])

    const session = sessionOf(framing)
    const a = job('A')
    session.submit(a, 0)
    session.submit(job('B'), 0)
    expect(session.abandon(a, 1)).toBe(false)
    expect(sent(session, framing).map(({ body }) => String(body))).toEqual(['B'])
    expect(told(session)).toEqual([])
  })

  test('what waits in the queue can be abandoned, runs out of time, and is not sent then', () => {
    const session = sessionOf(framing)
    const [a, b, c, d] = [job('A', 100), job('B', 50), job('C', 100), job('D', 100)] as const
    for (const each of [a, b, c, d]) session.submit(each, 0)
    const [request] = sent(session, framing)
    expect(session.abandon(c, 1)).toBe(false)
    expect(session.abandon(c, 1)).toBeUndefined()
    session.timeout(50)
    expect(told(session)).toEqual(['B timedOut unsent'])
    session.receive(answer(framing, request ?? { serial: 0, body: Buffer.alloc(0) }), 60)
    expect(sent(session, framing).map(({ body }) => String(body))).toEqual(['D'])
    // One that is overdue by the time its turn comes is not sent either.
    session.submit(job('E', 70), 61)
    session.submit(job('F', 200), 61)
    session.receive(framing.response.write(HEAD, 2, 0, Buffer.from('D')), 80)
    expect(sent(session, framing).map(({ body }) => String(body))).toEqual(['F'])
    expect(told(session)).toEqual(['A answered A', 'D answered D', 'E timedOut unsent'])
  })

  test('half an answer whose end never comes is not put in front of the next one: the connection goes first', () => {
    const { session, reply } = asking()
    session.submit(job('B', 5000), 0)
    session.receive(reply.subarray(0, -1), 999)
    session.timeout(1000)
    expect(told(session)).toEqual(['A timedOut sent', 'drop DISCONNECTED'])
    expect(sent(session, framing)).toEqual([])
    session.disconnected()
    expect(told(session)).toEqual(['B disconnected unsent'])

    const abandoned = sessionOf(framing)
    const a = job('A')
    abandoned.submit(a, 0)
    sent(abandoned, framing)
    abandoned.receive(reply.subarray(0, 1), 1)
    expect(abandoned.abandon(a, 2)).toBe(true)
    expect(told(abandoned)).toEqual(['drop DISCONNECTED'])
  })

  test('the end of the connection ends everything once, with what is known', () => {
    const { session, reply } = asking()
    session.submit(job('B'), 0)
    session.disconnected()
    session.disconnected()
    session.timeout(5000)
    session.receive(reply, 5001)
    expect(told(session)).toEqual(['A disconnected sent', 'B disconnected unsent'])
    expect([session.nextTimeout(0), session.inFlight, session.queued]).toEqual([undefined, 0, 0])
  })

  test('nextTimeout is the earliest deadline of all that wait', () => {
    const session = sessionOf(framing)
    expect(session.nextTimeout(0)).toBeUndefined()
    session.submit(job('A', 300), 0)
    session.submit(job('B', 200), 0)
    session.submit(job('C', 250), 0)
    const [request] = sent(session, framing)
    expect(session.nextTimeout(0)).toBe(200)
    session.timeout(199)
    expect([told(session), session.nextTimeout(0)]).toEqual([[], 200])
    session.timeout(200)
    expect([told(session), session.nextTimeout(0)]).toEqual([['B timedOut unsent'], 250])
    session.receive(answer(framing, request ?? { serial: 0, body: Buffer.alloc(0) }), 210)
    expect([told(session), session.nextTimeout(0)]).toEqual([['A answered A'], 250])
    session.timeout(250)
    expect(session.nextTimeout(0)).toBeUndefined()
  })
})

describe('any bytes', () => {
  interface Fuzzed {
    readonly name: string
    run(kind: 'stream' | 'datagram', chunks: readonly Uint8Array[]): readonly string[]
  }

  function fuzzed<H extends Head>(framing: Framing<H>, head: H): Fuzzed {
    const run: Fuzzed['run'] = (kind, chunks) => {
      const session = new Session(framing, { kind, window: 1, maxFrame: 200 })
      const length = () => 6
      session.submit({ ...questionOf(framing, head, Buffer.from('0123'), length), deadline: 1000 }, 0)
      session.transmit()
      for (const chunk of chunks) session.receive(Buffer.from(chunk), 1)
      session.timeout(1000)
      session.disconnected()
      return eventsOf(session).flatMap((event) => (event.kind === 'done' ? [event.outcome.kind] : []))
    }
    return { name: framing.name, run }
  }

  const route = { station: 0, network: 0, pc: 0xff, moduleIo: 0x3ff, multidrop: 0, selfStation: 0 }
  const all: readonly Fuzzed[] = [
    ...slmpFrames.map(({ framing }) => fuzzed(framing, HEAD)),
    ...(['binary', 'ascii'] as const).map((code) => fuzzed(frame1e(code), { command: 1, pc: 0xff, timer: 0 })),
    ...([1, 4, 5] as const).map((format) => fuzzed(serialFraming({ frame: '4C', format }), route)),
    fuzzed(jwFrame(), { command: 0x24 }),
  ]
  /** Heads of every frame, so that the bytes come far enough to be read. */
  const starts = [
    'd000',
    'd400010000',
    'e800010000',
    'e800010000000000ffff030000',
    '5000',
    '6800',
    '44303030',
    '44343030',
    '8100',
    '38313030',
    '1002',
    '0246383030',
    '0646383030303046463033464630303030',
    '1546383030',
    '450024',
    '00'.repeat(40),
  ]
  const chunk = fc.oneof(
    fc.uint8Array({ minLength: 1, maxLength: 40 }),
    fc.constantFrom(...starts).map((hex) => Uint8Array.from(Buffer.from(hex, 'hex'))),
    fc.stringMatching(/^[0-9A-F]{1,40}$/).map((text) => Uint8Array.from(Buffer.from(text))),
  )

  test.each(all)('$name: the request ends once, and nothing but a PlcError comes of them', ({ run }) => {
    fc.assert(
      fc.property(fc.constantFrom('stream', 'datagram'), fc.array(chunk, { maxLength: 12 }), (kind, chunks) => {
        expect(run(kind, chunks)).toHaveLength(1)
      }),
      { numRuns: 2000 },
    )
  })
})
