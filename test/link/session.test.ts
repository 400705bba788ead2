// Which answer belongs to which request, and when that can no longer be told. Time is a number.
import { describe, expect, test } from '@jest/globals'
import { RequestError } from '../../src/errors'
import { type Framing, type RequestFrame, SerialNumbers } from '../../src/link/link'
import { type SlmpHead, slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { answer, HEAD, job, sent, sessionOf, slmpFrames, type TestSession, told } from './support'

const codes = ['binary', 'ascii'] as const
/** Frames with a serial number. */
const numbered = slmpFrames.filter(({ framing }) => framing.correlation === 'serial')

/** Submits the jobs and returns the requests that went out for them. */
function ask(session: TestSession, framing: Framing<SlmpHead>, names: string, now = 0): RequestFrame<SlmpHead>[] {
  for (const name of names) session.submit(job(name), now)
  return sent(session, framing)
}

describe.each(numbered)('$title: answers find their requests by the serial number', ({ framing }) => {
  const reply = (request: RequestFrame<SlmpHead> | undefined, options?: Parameters<typeof answer>[2]) => {
    if (request === undefined) throw new Error('nothing was asked')
    return answer(framing, request, options)
  }

  test('two in flight are answered out of order, byte by byte', () => {
    const session = sessionOf(framing, { window: 2 })
    const [a, b, ...more] = ask(session, framing, 'ABC')
    expect([a?.serial, b?.serial, more]).toEqual([1, 2, []])
    expect([session.inFlight, session.queued]).toEqual([2, 1])
    for (const byte of Buffer.concat([reply(b), reply(a)])) session.receive(Buffer.of(byte), 10)
    expect(told(session)).toEqual(['B answered B', 'A answered A'])
    expect(sent(session, framing).map(({ body }) => String(body))).toEqual(['C'])
  })

  test('the window is never exceeded, and every request goes out exactly once, in order', () => {
    const session = sessionOf(framing, { window: 3 })
    const out = ask(session, framing, 'ABCDEFGHIJ')
    expect([out.length, session.inFlight, session.queued]).toEqual([3, 3, 7])
    for (let answered = 0; answered < out.length; answered++) {
      session.receive(reply(out[answered]), 1)
      out.push(...sent(session, framing))
      expect(session.inFlight).toBe(Math.min(3, 10 - 1 - answered))
    }
    expect(out.map(({ body }) => String(body)).join('')).toBe('ABCDEFGHIJ')
    expect(told(session)).toEqual([...'ABCDEFGHIJ'].map((name) => `${name} answered ${name}`))
  })

  test('a late answer is dropped as stale, and the next request gets its own', () => {
    const session = sessionOf(framing)
    const [a] = ask(session, framing, 'AB')
    session.timeout(1000)
    expect(told(session)).toEqual(['B timedOut unsent', 'A timedOut sent'])
    session.submit(job('C', 2000), 1000)
    const [c] = sent(session, framing)
    expect([a?.serial, c?.serial]).toEqual([1, 2])
    session.receive(reply(a), 1001)
    session.receive(reply(c), 1002)
    expect(told(session)).toEqual(['stale 1', 'C answered C'])
  })

  test('an answer that comes twice is stale the second time', () => {
    const session = sessionOf(framing, { window: 2 })
    const [a, b] = ask(session, framing, 'AB')
    session.receive(Buffer.concat([reply(a), reply(a), reply(b), reply(a)]), 1)
    expect(told(session)).toEqual(['A answered A', 'stale 1', 'B answered B', 'stale 1'])
  })

  test('an answer with a serial number that was never asked with is stale', () => {
    const session = sessionOf(framing)
    ask(session, framing, 'A')
    session.receive(answer(framing, { serial: 7, body: Buffer.from('?') }), 1)
    expect(told(session)).toEqual(['stale 7'])
    expect(session.inFlight).toBe(1)
  })

  test('an answer from another station than asked fails the request and drops the connection', () => {
    const session = sessionOf(framing, { window: 2 })
    const [a] = ask(session, framing, 'AB')
    session.receive(reply(a, { head: { ...{ ...HEAD, network: 2 } } }), 1)
    expect(told(session)).toEqual(['A failed ECHO_MISMATCH', 'B failed ECHO_MISMATCH', 'drop ECHO_MISMATCH'])
  })

  test('an end code is an answer', () => {
    const session = sessionOf(framing)
    const [a] = ask(session, framing, 'A')
    session.receive(reply(a, { endCode: 0xc056 }), 1)
    expect(told(session)).toEqual(['A answered A c056'])
  })

  test('a timeout or an abandoned request costs nothing but itself', () => {
    const session = sessionOf(framing, { window: 2 })
    const early = job('A', 10)
    session.submit(early, 0)
    const b = job('B')
    session.submit(b, 0)
    const [a] = sent(session, framing)
    session.timeout(10)
    expect(session.abandon(b, 11)).toBe(true)
    expect(told(session)).toEqual(['A timedOut sent'])
    const [c] = ask(session, framing, 'C', 11)
    session.receive(Buffer.concat([reply(a), reply(c)]), 12)
    expect(told(session)).toEqual(['stale 1', 'C answered C'])
  })

  test('a frame in the form of a request, in the place of an answer, was sent unasked', () => {
    const session = sessionOf(framing)
    const onDemand = framing.request.write(HEAD, 0x99, Buffer.from('news'))
    session.receive(onDemand, 0)
    const [a] = ask(session, framing, 'A')
    session.receive(Buffer.concat([onDemand, reply(a), onDemand]), 1)
    expect(told(session)).toEqual(['unsolicited news', 'unsolicited news', 'A answered A', 'unsolicited news'])
  })
})

describe('serial numbers', () => {
  const framing = slmpFraming('4E', 'binary')

  test('wrap around, and leave out what is resting or in use', () => {
    const serials = new SerialNumbers(0xfffe)
    const free = () => false
    expect([serials.take(free), serials.take(free), serials.take(free)]).toEqual([0xfffe, 0xffff, 0])
    serials.rest(1)
    expect(serials.take((serial) => serial === 2)).toBe(3)
    serials.release(1)
    expect(takeAround(serials, 0)).toBe(1)
  })

  /** The number that comes after `last`. */
  function takeAround(serials: SerialNumbers, last: number): number {
    for (let taken = -1; taken !== last; ) taken = serials.take(() => false)
    return serials.take(() => false)
  }

  test('no more than the latest 256 rest, so that the numbers never run out', () => {
    const serials = new SerialNumbers(0)
    for (let serial = 0; serial < 0x10000; serial++) serials.rest(serial)
    expect(serials.take(() => false)).toBe(0)
    expect(takeAround(serials, 0xfeff)).toBe(0)
  })

  test('a request that is still in flight keeps its number, however many come after it', () => {
    const session = sessionOf(framing, { window: 2 })
    session.submit(job('slow', 1e9), 0)
    const [slow] = sent(session, framing)
    for (let i = 0; i < 0x10000; i++) {
      session.submit(job('x', 1e9), 0)
      const [request] = sent(session, framing)
      if (request === undefined || request.serial === slow?.serial) throw new Error(`number ${i} is in use`)
      session.receive(answer(framing, request), 0)
      session.poll()
    }
    session.receive(answer(framing, { serial: slow?.serial, body: Buffer.from('own') }), 0)
    expect(told(session)).toEqual(['slow answered own'])
  })

  test('the number of a given-up request rests until its answer has come', () => {
    const serials = new SerialNumbers(5)
    const session = sessionOf(framing, { serials })
    const [a] = ask(session, framing, 'A')
    session.timeout(1000)
    expect([a?.serial, takeAround(serials, 4)]).toEqual([5, 6])
    session.receive(answer(framing, { serial: 5, body: Buffer.from('late') }), 1001)
    expect(takeAround(serials, 4)).toBe(5)
  })

  test('the next session of the same peer goes on counting: answers of the one before are stale there', () => {
    const serials = new SerialNumbers(5)
    const first = sessionOf(framing, { kind: 'datagram', serials })
    const [a] = ask(first, framing, 'A')
    first.disconnected()
    const second = sessionOf(framing, { kind: 'datagram', serials })
    const [b] = ask(second, framing, 'B')
    expect([a?.serial, b?.serial]).toEqual([5, 6])
    second.receive(answer(framing, { serial: 5, body: Buffer.from('A') }), 1)
    second.receive(answer(framing, { serial: 6, body: Buffer.from('B') }), 2)
    expect(told(second)).toEqual(['stale 5', 'B answered B'])
  })

  test.each(['disconnected', 'rubbish'])('what was in flight at the end (%s) rests, too', (end) => {
    const serials = new SerialNumbers(5)
    const session = sessionOf(framing, { serials, window: 2 })
    ask(session, framing, 'A')
    session.submit(job('unsent'), 0)
    if (end === 'rubbish') session.receive(Buffer.from('rubbish'), 1)
    session.disconnected()
    expect(takeAround(serials, 4)).toBe(6)
  })
})

describe.each(codes)('4E %s: half an answer', (code) => {
  const framing = slmpFraming('4E', code)

  test('is waited for as long as another request in flight waits; then the connection is dropped', () => {
    const session = sessionOf(framing, { window: 2 })
    session.submit(job('A', 100), 0)
    session.submit(job('B', 200), 0)
    const [a, b] = sent(session, framing)
    if (a === undefined || b === undefined) throw new Error('not sent')
    const late = answer(framing, a)
    session.receive(late.subarray(0, 10), 1)
    session.timeout(100)
    expect(told(session)).toEqual(['A timedOut sent'])
    // Its end comes after all: nothing is lost.
    session.receive(Buffer.concat([late.subarray(10), answer(framing, b).subarray(0, 12)]), 150)
    expect(told(session)).toEqual([`stale ${a.serial}`])
    session.timeout(200)
    expect(told(session)).toEqual(['B timedOut sent', 'drop DISCONNECTED'])
  })

  test('no half answer, no drop: whatever is late is known by its number', () => {
    const session = sessionOf(framing)
    ask(session, framing, 'A')
    session.timeout(1000)
    expect(told(session)).toEqual(['A timedOut sent'])
    session.submit(job('B', 2000), 1000)
    expect(sent(session, framing)).toHaveLength(1)
  })
})

describe.each(codes)('3E %s: without a serial number answers come in order', (code) => {
  const framing = slmpFraming('3E', code)
  const reply = (text: string) => answer(framing, { serial: undefined, body: Buffer.from(text) })

  test('only one request may be in flight', () => {
    expect(() => sessionOf(framing, { window: 2 })).toThrow(RequestError)
    const session = sessionOf(framing)
    expect(ask(session, framing, 'AB')).toHaveLength(1)
    session.receive(reply('A'), 1)
    expect(sent(session, framing)).toHaveLength(1)
    session.receive(reply('B'), 2)
    expect(told(session)).toEqual(['A answered A', 'B answered B'])
  })

  test('on a stream a timeout drops the connection: a late answer would be taken for the next one', () => {
    const session = sessionOf(framing)
    const late = job('B', 5000)
    ask(session, framing, 'A')
    session.submit(late, 0)
    session.timeout(1000)
    expect(told(session)).toEqual(['A timedOut sent', 'drop DISCONNECTED'])
    session.receive(reply('A'), 1001)
    expect([told(session), sent(session, framing)]).toEqual([[], []])
    session.disconnected()
    expect(told(session)).toEqual(['B disconnected unsent'])
  })

  test('on a stream an abandoned request in flight drops the connection', () => {
    const session = sessionOf(framing)
    const a = job('A')
    session.submit(a, 0)
    sent(session, framing)
    expect(session.abandon(a, 1)).toBe(true)
    expect(told(session)).toEqual(['drop DISCONNECTED'])
  })

  test('with datagrams the next request leaves from a new port, after a timeout and after every answer', () => {
    const session = sessionOf(framing, { kind: 'datagram' })
    ask(session, framing, 'A')
    session.timeout(1000)
    expect(told(session)).toEqual(['A timedOut sent', 'renew givenUp'])
    expect(ask(session, framing, 'B', 1)).toHaveLength(1)
    session.receive(reply('B'), 2)
    expect(told(session)).toEqual(['B answered B', 'renew answered'])
    session.submit(job('C'), 3)
    sent(session, framing)
    const c = session.abandon(job('other'), 4)
    expect([c, told(session)]).toEqual([undefined, []])
  })

  test('an answer that nobody asked for drops a stream, and is thrown away with datagrams', () => {
    const stream = sessionOf(framing)
    stream.receive(reply('A'), 0)
    expect(told(stream)).toEqual(['drop UNEXPECTED_ANSWER'])
    const datagram = sessionOf(framing, { kind: 'datagram' })
    datagram.receive(reply('A'), 0)
    expect(told(datagram)).toEqual(['stale'])
    ask(datagram, framing, 'B')
    datagram.receive(reply('B'), 1)
    expect(told(datagram)).toEqual(['B answered B', 'renew answered'])
  })
})
