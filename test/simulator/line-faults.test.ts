/** Each fault switch of a simulated line, as it is seen on the wire. */
import { describe, expect, test } from '@jest/globals'
import type { Fault } from '../../src/simulator/simulator'
import { aLine, frameFormats, LONG, shown } from './line-support'

const READ = 'WR0D000001'
const ANSWER = '<STX>00FF0000<ETX>AF'

function withFault(fault: Fault) {
  const made = aLine()
  made.line.station(0).faults.add(fault)
  return made
}

describe('a fault switch', () => {
  test.each([
    [{ kind: 'silence' }, ''],
    [{ kind: 'drop' }, ''],
    [{ kind: 'wrongSum' }, '<STX>00FF0000<ETX>A0'],
    [{ kind: 'damaged', what: 'lost', at: 5 }, '<STX>00FF000<ETX>AF'],
    [{ kind: 'damaged', what: 'doubled', at: 5 }, '<STX>00FF00000<ETX>AF'],
    [{ kind: 'damaged', what: 'changed', at: 5, mask: 1 }, '<STX>00FF1000<ETX>AF'],
    [{ kind: 'damaged', what: 'lost', at: 0 }, '00FF0000<ETX>AF'],
    [{ kind: 'cut', at: 6 }, '<STX>00FF0'],
    [{ kind: 'duplicate' }, ANSWER + ANSWER],
    [{ kind: 'garbage', bytes: 2 }, `<ff><00>${ANSWER}`],
    [{ kind: 'garbage', bytes: 2, place: 'after' }, `${ANSWER}<ff><00>`],
    [{ kind: 'garbage', bytes: 3, place: 'instead' }, '<ff><00><a5>'],
    [{ kind: 'wrongRoute', station: 7 }, '<STX>07FF0000<ETX>B6'],
    [{ kind: 'endCode', endCode: 0x18 }, '<NAK>00FF18'],
  ] satisfies readonly (readonly [Fault, string])[])('%o', (fault, heard) => {
    expect(withFault(fault).host.ask('1C', 0, READ)).toBe(heard)
  })

  test('noise: bytes of any value behind the answer', () => {
    const { host, clock, request } = withFault({ kind: 'noise', bytes: 5, ms: 20 })
    host.send(request('1C', 0, READ))
    clock.advance(19)
    expect(host.heard()).toBe(ANSWER)
    clock.advance(1)
    expect(host.bytes()).toHaveLength(5)
  })

  test('dribble: slow characters', () => {
    const { host, clock, request } = withFault({ kind: 'dribble', pause: 30 })
    host.send(request('1C', 0, READ))
    clock.advance(60)
    expect(host.heard()).toBe('<STX>00')
    clock.advance(30 * 8)
    expect(host.heard()).toBe('FF0000<ETX>A')
    clock.advance(30)
    expect(host.heard()).toBe('F')
    expect(host.chunks.every(({ length }) => length === 1)).toBe(true)
  })

  test('delay: carried out at once, answered later', () => {
    const { line, host, clock, request } = withFault({ kind: 'delay', ms: 400 })
    host.send(request('1C', 0, 'WW0D000001ABCD'))
    clock.advance(399)
    expect([host.heard(), line.station(0).read('D0:WORD')]).toEqual(['', 0xabcd])
    clock.advance(1)
    expect(host.heard()).toBe('<ACK>00FF')
  })

  test('late: the answer comes with the next request', () => {
    const { host } = withFault({ kind: 'late', times: 1 })
    expect(host.ask('1C', 0, READ)).toBe('')
    expect(host.ask('1C', 0, 'PC0')).toBe(`${ANSWER}<STX>00FFF3<ETX>68`)
  })

  test('late, and EOT before the next request: it never comes', () => {
    const { host } = withFault({ kind: 'late', times: 1 })
    host.ask('1C', 0, READ)
    host.send('<EOT>')
    expect(host.ask('1C', 0, 'PC0')).toBe('<STX>00FFF3<ETX>68')
  })

  test.each(frameFormats)(
    'misheard, $frame format $messageFormat: a changed character of a write is not carried out',
    ({ frame, messageFormat }) => {
      const body =
        frame === '1C'
          ? 'WW0D000001ABCD'
          : messageFormat === 5
            ? Buffer.from('01140000000000a80100cdab', 'hex')
            : '14010000D*0000000001ABCD'
      const { length } = aLine({ messageFormat }).request(frame, 0, body)
      for (const what of ['lost', 'doubled', 'changed'] as const) {
        for (let at = 0; at < length; at++) {
          const { line, host } = aLine({ messageFormat })
          line.faults.add({ kind: 'misheard', what, at })
          const heard = host.ask(frame, 0, body)
          const written = line.station(0).read('D0:WORD')
          // What only frames it may be doubled: the same request all the same.
          expect([0, 0xabcd]).toContain(written)
          const isTaken = messageFormat === 5 ? heard.includes('<ff><ff><00><00>') : heard.startsWith('<ACK>')
          expect(`${what} ${at} ${isTaken}`).toBe(`${what} ${at} ${written === 0xabcd}`)
        }
      }
    },
  )

  test('misheard: the sum tells', () => {
    const { host, line } = withFault({ kind: 'misheard', at: 9 })
    expect(host.ask('1C', 0, READ)).toBe('<NAK>00FF02')
    expect(line.statistics.unreadable).toBe(1)
  })

  test('a NAK that the frame has no digits for does not strike', () => {
    const { host, line } = withFault({ kind: 'endCode', endCode: 0x7f24, times: 1 })
    expect(host.ask('1C', 0, READ)).toBe(ANSWER)
    expect(host.ask('3C', 0, '01010000')).toBe('<NAK>F90000FF007F24')
    expect(line.station(0).faults.active).toEqual([])
  })

  test('wrongSum waits for an answer that has a sum', () => {
    const { host } = withFault({ kind: 'wrongSum', times: 1 })
    expect(host.ask('1C', 0, 'WW0D0000010000')).toBe('<ACK>00FF')
    expect(host.ask('1C', 0, READ)).toBe('<STX>00FF0000<ETX>A0')
    expect(host.ask('1C', 0, READ)).toBe(ANSWER)
  })

  test.each([
    [4, '<CR><LF>'],
    [5, ''],
  ] as const)('wrongSum in format %d', (messageFormat, end) => {
    const right = aLine({ messageFormat })
    const wrong = aLine({ messageFormat })
    wrong.line.faults.add({ kind: 'wrongSum' })
    const body = messageFormat === 5 ? Buffer.from('01010000', 'hex') : '01010000'
    const [one, other] = [right, wrong].map(({ host }) => host.ask('4C', 0, body).slice(0, -end.length || undefined))
    expect(one?.slice(0, -1)).toBe(other?.slice(0, -1))
    expect(one).not.toBe(other)
  })

  test('of a station is its own, of the line everybody’s', () => {
    const { line, host } = aLine({ stations: { 0: {}, 1: {} } })
    line.station(1).faults.add({ kind: 'silence' })
    expect([host.ask('1C', 0, READ), host.ask('1C', 1, READ)]).toEqual([ANSWER, ''])
    line.station(1).faults.clear()
    const stations: unknown[] = []
    line.faults.add({
      kind: 'silence',
      when: ({ station, command }) => {
        stations.push(station, command)
        return true
      },
    })
    expect([host.ask('1C', 0, READ), host.ask('1C', 1, READ)]).toEqual(['', ''])
    expect(stations).toEqual([0, 'readWords', 1, 'readWords'])
  })

  test('of a silent station costs the others nothing', () => {
    const { line, host, clock, request } = aLine({ stations: { 0: {}, 1: {} } })
    line.station(1).faults.add({ kind: 'delay', ms: 1000 })
    host.send(request('1C', 1, READ))
    host.send(request('1C', 0, READ))
    expect(host.heard()).toBe(ANSWER)
    clock.advance(LONG)
    expect(host.heard()).toBe('')
  })
})

describe('hostile bytes', () => {
  test.each([
    ['a request without an end', '<ENQ>00FFWR0'],
    ['characters', ''],
    ['start codes', '<ENQ><ENQ>'],
    ['format 5', '<DLE><STX>'],
  ])('cost a bounded memory: %s', (_what, start) => {
    for (const messageFormat of [1, 4, 5] as const) {
      const { line, host, clock } = aLine({ messageFormat })
      host.send(start)
      for (let i = 0; i < 64; i++) host.send(Buffer.alloc(4096, 'A'))
      clock.advance(LONG)
      host.bytes()
      const answer = host.ask('4C', 0, messageFormat === 5 ? Buffer.from('01010000', 'hex') : '01010000')
      expect(answer).toMatch(/FX5U/)
      expect(line.statistics.bytesReceived).toBeGreaterThan(64 * 4096)
    }
  })

  test('requests that nobody waits for are thrown away', () => {
    const { line, host, request } = aLine()
    for (let i = 0; i < 100; i++) host.send(request('1C', 0, 'PCF'))
    expect(line.statistics.discarded).toBe(92)
  })

  test('characters faster than the line are lost', () => {
    const { line, host } = aLine({ pace: { baudRate: 300 } })
    host.send(Buffer.alloc(100_000, 'A'))
    expect(line.statistics.discarded).toBe(100_000 - 65_536)
  })

  test('of a frame that is broken off are forgotten', () => {
    const { host, clock, request } = aLine()
    const bytes = request('1C', 0, READ)
    for (let length = 1; length < bytes.length; length++) {
      host.send(bytes.subarray(0, length))
      clock.advance(LONG)
      expect(shown(host.bytes())).toBe('')
    }
    expect(host.ask('1C', 0, READ)).toBe(ANSWER)
  })
})
