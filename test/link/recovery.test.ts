// A line that is no connection: noise, echoes, silence and rubbish cost one request at most, and never the line.
import { describe, expect, test } from '@jest/globals'
import { type Framing, Session } from '../../src/link/link'
import { type SerialHead, serialRoute } from '../../src/melsec/frame/serial-frames'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { questionOf } from '../support/question'
import { eventsOf, type TestJob } from './support'

const EOT = Buffer.of(0x04)
const DLE = 0x10
const format5 = serialFraming({ frame: '4C', format: 5 })
const framing: Framing<SerialHead> = {
  ...format5,
  recovery: EOT,
  response: {
    ...format5.response,
    noise(bytes) {
      const start = bytes.indexOf(DLE)
      return start < 0 ? bytes.length : start
    },
  },
}
const head = (station: number): SerialHead => ({
  station,
  network: 0,
  pc: 0xff,
  moduleIo: 0x3ff,
  multidrop: 0,
  selfStation: 0,
})
const QUIET = 20
const BETWEEN = 5

class Line {
  readonly session = new Session<TestJob>(framing, {
    kind: 'stream',
    window: 1,
    recovery: { quiet: QUIET, betweenBytes: BETWEEN },
  })

  ask(name: string, station = 0, deadline = 1000, now = 0): Buffer | undefined {
    this.session.submit({ name, deadline, ...questionOf(framing, head(station), Buffer.from(name)) }, now)
    return this.session.transmit()
  }

  answer(name: string, station = 0): Buffer {
    return framing.response.write(head(station), 0, 0, Buffer.from(name))
  }

  get told(): string[] {
    return eventsOf(this.session).map((event) => {
      if (event.kind !== 'done') return event.kind
      const { outcome } = event
      if (outcome.kind === 'answered') return `${event.job.name} answered ${String(outcome.frame.body)}`
      return `${event.job.name} ${outcome.kind}${outcome.kind === 'failed' ? ` ${outcome.error.code}` : ''}`
    })
  }
}

describe('noise', () => {
  test('while nothing is asked is thrown away', () => {
    const line = new Line()
    line.session.receive(Buffer.of(0x00, 0xff), 0)
    expect(line.told).toEqual(['stray'])
    expect(line.ask('A', 0, 1000, 1)).toBeDefined()
    line.session.receive(line.answer('a'), 2)
    expect(line.told).toEqual(['A answered a'])
  })

  test('before an answer costs nothing', () => {
    const line = new Line()
    line.ask('A')
    line.session.receive(Buffer.concat([Buffer.of(0x00, 0x55), line.answer('a')]), 1)
    expect(line.told).toEqual(['stray', 'A answered a'])
  })

  test('that looks like the beginning of a frame is thrown away, too', () => {
    const line = new Line()
    line.session.receive(Buffer.of(DLE), 0)
    expect([line.told, line.session.buffered, line.session.nextTimeout(0)]).toEqual([['stale'], 0, undefined])
  })
})

describe('the echo of the own request', () => {
  test.each([1, 3, 1000])('is passed over, in chunks of %i', (size) => {
    const line = new Line()
    const request = line.ask('A') ?? EOT
    const bytes = Buffer.concat([request, line.answer('a')])
    for (let at = 0; at < bytes.length; at += size) line.session.receive(bytes.subarray(at, at + size), 1)
    expect(line.told).toEqual(['A answered a'])
  })
})

describe('silence', () => {
  test('of one station: the line is brought to a known state, then the next one is asked', () => {
    const line = new Line()
    line.ask('A', 1, 100)
    expect(line.ask('B', 2, 1000)).toBeUndefined()
    line.session.timeout(100)
    expect(line.told).toEqual(['A timedOut'])
    expect([line.session.transmit(), line.session.transmit()]).toEqual([EOT, undefined])
    expect(line.session.nextTimeout(100)).toBe(100 + QUIET)
    // The late answer comes, and the line must be quiet anew.
    line.session.receive(line.answer('a', 1), 110)
    expect([line.told, line.session.transmit()]).toEqual([['stray'], undefined])
    line.session.timeout(120)
    expect(line.session.transmit()).toBeUndefined()
    line.session.timeout(130)
    expect(line.session.transmit()).toBeDefined()
    line.session.receive(line.answer('b', 2), 131)
    expect(line.told).toEqual(['B answered b'])
  })

  test('in the middle of an answer ends it soon, whatever the deadline', () => {
    const line = new Line()
    line.ask('A')
    line.session.receive(line.answer('a').subarray(0, 8), 3)
    expect(line.session.nextTimeout(3)).toBe(3 + BETWEEN)
    line.session.timeout(3 + BETWEEN)
    expect([line.told, line.session.transmit()]).toEqual([['A failed TRUNCATED'], EOT])
  })

  test('after a request that was aborted in flight is waited for, too', () => {
    const line = new Line()
    const job: TestJob = { name: 'A', deadline: 1000, ...questionOf(framing, head(1), Buffer.from('A')) }
    line.session.submit(job, 0)
    line.session.transmit()
    expect(line.session.abandon(job, 5)).toBe(true)
    expect(line.ask('B', 2, 1000, 5)).toEqual(EOT)
    line.session.timeout(5 + QUIET)
    expect(line.session.transmit()).toBeDefined()
  })
})

describe('rubbish', () => {
  test('a wrong sum fails its request and nothing else', () => {
    const line = new Line()
    line.ask('A', 1)
    line.ask('B', 2)
    const damaged = Buffer.from(line.answer('a', 1))
    damaged.writeUInt8(damaged.readUInt8(14) ^ 1, 14)
    line.session.receive(damaged, 10)
    expect([line.told, line.session.transmit()]).toEqual([['A failed BAD_SUM'], EOT])
    line.session.timeout(10 + QUIET)
    line.session.transmit()
    line.session.receive(line.answer('b', 2), 40)
    expect(line.told).toEqual(['B answered b'])
  })

  test('the answer of another station fails the request, and is not taken for it', () => {
    const line = new Line()
    line.ask('A', 1)
    line.session.receive(line.answer('x', 7), 1)
    expect(line.told).toEqual(['A failed ECHO_MISMATCH'])
  })

  test('an answer that nobody asked for is thrown away', () => {
    const line = new Line()
    line.session.receive(line.answer('x', 7), 1)
    expect(line.told).toEqual(['stale'])
    expect(line.ask('A', 1, 1000, 2)).toBeDefined()
  })

  test('without end keeps the line busy until the deadlines, and costs bounded memory', () => {
    const line = new Line()
    line.ask('A', 1, 50)
    line.session.timeout(50)
    line.session.transmit()
    line.ask('B', 2, 500, 50)
    for (let now = 51; now < 500; now += 10) line.session.receive(Buffer.alloc(1000, DLE), now)
    line.session.timeout(500)
    expect(line.told.filter((event) => event !== 'stray')).toEqual(['A timedOut', 'B timedOut'])
    expect(line.session.buffered).toBe(0)
  })
})

test('what may not go yet is waited for, also when the line is in a known state long before', () => {
  const line = new Line()
  line.ask('A', 0, 10)
  line.session.timeout(10)
  line.session.transmit()
  const question = questionOf(framing, head(0), Buffer.from('B'))
  line.session.submit({ name: 'B', deadline: 10_000, notBefore: 5000, ...question }, 11)
  expect(line.session.nextTimeout(11)).toBe(5000)
  line.session.timeout(10 + QUIET)
  expect(line.session.nextTimeout(10 + QUIET)).toBe(5000)
  line.session.timeout(5000)
  expect(line.session.transmit()).toBeDefined()
})

describe('format 1, where nothing marks the end of ACK and NAK', () => {
  const format1 = serialFraming({ frame: '3C', format: 1 })
  const station = serialRoute('3C', { station: 2 })

  function asking() {
    const recovery = { quiet: QUIET, betweenBytes: 100, echo: 'never' } as const
    const session = new Session<TestJob>(format1, { kind: 'stream', window: 1, recovery })
    session.submit({ name: 'A', deadline: 1000, ...questionOf(format1, station, Buffer.from('1401')) }, 0)
    session.transmit()
    return session
  }

  const outcomes = (session: Session<TestJob>) =>
    eventsOf(session).flatMap((event) => (event.kind === 'done' ? event.outcome.kind : []))

  test('an ACK counts when nothing has followed it as long as an adapter keeps a character back', () => {
    const session = asking()
    session.receive(format1.response.write(station, 0, 0, Buffer.alloc(0)), 10)
    expect([outcomes(session), session.nextTimeout(10)]).toEqual([[], 30])
    session.timeout(30)
    expect([outcomes(session), session.nextTimeout(30)]).toEqual([['answered'], undefined])
  })

  test('a NAK that the line has made an ACK is found out by its error code', () => {
    const session = asking()
    const nak = Buffer.from(format1.response.write(station, 0, 0x7143, Buffer.alloc(0)))
    nak[0] = 0x06
    session.receive(nak.subarray(0, -4), 10)
    session.receive(nak.subarray(-4), 25)
    expect(outcomes(session)).toEqual(['failed'])
  })
})

describe('a line that begins', () => {
  const asked = (framingOf: Framing<SerialHead>, answerTime?: number) => {
    const recovery = { quiet: QUIET, betweenBytes: BETWEEN, ...(answerTime === undefined ? {} : { answerTime }) }
    const session = new Session<TestJob>(framingOf, { kind: 'stream', window: 1, recovery })
    session.restore(0)
    session.submit({ name: 'A', deadline: 1000, ...questionOf(framingOf, head(1), Buffer.from('A')) }, 0)
    return session
  }

  test('is brought to a known state: what was asked on it before may still be answered', () => {
    const session = asked(framing)
    expect([session.transmit(), session.transmit(), session.nextTimeout(0)]).toEqual([EOT, undefined, QUIET])
    session.receive(Buffer.from('late'), 10)
    session.timeout(QUIET)
    expect(session.transmit()).toBeUndefined()
    session.timeout(10 + QUIET)
    expect(session.transmit()).toBeDefined()
  })

  test('where nothing ends that, waits as long as an answer may take', () => {
    expect(asked(format5, 200).nextTimeout(0)).toBe(200 + QUIET)
  })
})

describe('an answer that may still come', () => {
  const RECOVERY = { quiet: QUIET, betweenBytes: BETWEEN, answerTime: 200, byteTime: 1, echo: 'never' } as const

  function abandoned(came: Buffer) {
    const session = new Session<TestJob>(framing, { kind: 'stream', window: 1, recovery: RECOVERY })
    const job: TestJob = { name: 'A', deadline: 1000, ...questionOf(framing, head(1), Buffer.from('A')) }
    session.submit(job, 0)
    const request = session.transmit()?.length ?? 0
    if (came.length > 0) session.receive(came, 4)
    session.abandon(job, 5)
    session.submit({ name: 'B', deadline: 1000, ...questionOf(framing, head(1), Buffer.from('B')) }, 5)
    expect([session.transmit(), session.transmit()]).toEqual([EOT, undefined])
    return { session, request }
  }

  test('to a request that was given up before anything came is waited for: EOT may get lost', () => {
    const { session, request } = abandoned(Buffer.alloc(0))
    expect(session.nextTimeout(5)).toBe(request + 200 + QUIET)
    // It comes, and is nobody's.
    const late = framing.response.write(head(1), 0, 0, Buffer.from('a'))
    session.receive(late, 150)
    session.timeout(request + 200 + QUIET)
    expect(session.transmit()).toBeDefined()
    expect(eventsOf(session).map(({ kind }) => kind)).toEqual(['stray'])
  })

  test('is waited for behind a damaged one, too, where nothing ends what was asked', () => {
    const session = new Session<TestJob>(format5, { kind: 'stream', window: 1, recovery: RECOVERY })
    session.submit({ name: 'A', deadline: 1000, ...questionOf(format5, head(1), Buffer.from('A')) }, 0)
    const request = session.transmit()?.length ?? 0
    const damaged = Buffer.from(format5.response.write(head(1), 0, 0, Buffer.from('a')))
    damaged.writeUInt8(damaged.readUInt8(14) ^ 1, 14)
    session.receive(damaged, 4)
    session.submit({ name: 'B', deadline: 1000, ...questionOf(format5, head(1), Buffer.from('B')) }, 5)
    expect(session.nextTimeout(5)).toBe(request + 200 + QUIET)
  })

  test('is on its way when a part of it has come: then the line has to be quiet only', () => {
    const { session } = abandoned(framing.response.write(head(1), 0, 0, Buffer.from('a')).subarray(0, 8))
    expect(session.nextTimeout(5)).toBe(5 + QUIET)
  })
})

test('a request of which nothing has come is silent after the time of its characters, its wait and the answer time', () => {
  const recovery = { quiet: QUIET, betweenBytes: BETWEEN, answerTime: 50, byteTime: 2, gap: 7 }
  const session = new Session<TestJob>(framing, { kind: 'stream', window: 1, recovery })
  const ask = (name: string, now: number, answerDelay?: number) => {
    session.submit({ name, deadline: now + 1000, answerDelay, ...questionOf(framing, head(1), Buffer.from(name)) }, now)
    return session.transmit()
  }
  const length = ask('A', 0)?.length ?? 0
  expect(session.nextTimeout(0)).toBe(2 * length + 50)
  session.receive(framing.response.write(head(1), 0, 0, Buffer.from('an answer that is longer')), 40)
  expect(ask('B', 41, 30)).toBeUndefined()
  expect(session.nextTimeout(41)).toBe(47)
  session.timeout(47)
  expect(session.transmit()).toBeDefined()
  const silentAt = 47 + 2 * length + 30 + 50
  // Noise is no answer.
  session.receive(Buffer.of(0x55), 60)
  expect(session.nextTimeout(60)).toBe(silentAt)
  session.timeout(silentAt)
  const ends = eventsOf(session).flatMap((event) => (event.kind === 'done' ? [event.outcome] : []))
  expect(ends).toMatchObject([{ kind: 'answered' }, { kind: 'timedOut', sent: true, isSilent: true }])
})
