// A line with two wires gives back what is sent. Whatever becomes of that echo, no answer is made of it.
import { describe, expect, test } from '@jest/globals'
import { type Echoing, Session } from '../../src/link/link'
import { serialRoute } from '../../src/melsec/frame/serial-frames'
import { type SerialFrameOptions, serialFraming } from '../../src/melsec/frame/serial-framing'
import { questionOf } from '../support/question'
import { eventsOf, type TestJob } from './support'

const BETWEEN = 5
const ANSWER = 50
class Line {
  readonly framing
  readonly session: Session<TestJob>
  readonly #head
  now = 0

  constructor(echo: Echoing, options: SerialFrameOptions = { frame: '3C', format: 1 }) {
    this.framing = serialFraming(options)
    this.#head = serialRoute(options.frame, { station: 2 })
    const recovery = { quiet: 20, betweenBytes: BETWEEN, answerTime: ANSWER, echo }
    this.session = new Session<TestJob>(this.framing, { kind: 'stream', window: 1, recovery })
  }

  ask(body: string): Buffer {
    const question = questionOf(this.framing, this.#head, Buffer.from(body))
    this.session.submit({ name: body, deadline: this.now + 1000, ...question }, this.now)
    let sent = this.session.transmit()
    // What brings the line to a known state goes first.
    for (let i = 0; i < 3 && sent?.length !== question.write(0).length; i++) {
      this.now = this.session.nextTimeout(this.now) ?? this.now
      this.session.timeout(this.now)
      sent = this.session.transmit()
    }
    if (sent === undefined) throw new Error('nothing was sent')
    return sent
  }

  answer(body: string, endCode = 0): Buffer {
    return this.framing.response.write(this.#head, 0, endCode, Buffer.from(body))
  }

  /** How the request ends when these chunks come, one each millisecond, and then nothing. */
  comes(...chunks: readonly Buffer[]): { readonly ended: string; readonly after: number } {
    let last = this.now
    for (const chunk of chunks) {
      this.now += 1
      last = this.now
      this.session.receive(chunk, this.now)
    }
    for (let events = eventsOf(this.session); ; events = eventsOf(this.session)) {
      const done = events.find((event) => event.kind === 'done')
      if (done?.kind === 'done') {
        const { outcome } = done
        const ended =
          outcome.kind === 'answered' ? `${outcome.frame.endCode} ${String(outcome.frame.body)}` : outcome.kind
        return { ended, after: this.now - last }
      }
      const due = this.session.nextTimeout(this.now)
      if (due === undefined) return { ended: 'nothing', after: this.now - last }
      this.now = due
      this.session.timeout(this.now)
    }
  }
}

/** A line on which a request with its echo has been answered. */
function echoing(echo: Echoing, options?: SerialFrameOptions): Line {
  const line = new Line(echo, options)
  expect(line.comes(line.ask('04010000D*0000000001'), line.answer('1234')).ended).toBe('0 1234')
  return line
}

/** Every bit of every byte turned, every byte lost, doubled, and one of noise in front of it. */
function damagesOf(bytes: Buffer): Buffer[] {
  return [...bytes].flatMap((byte, at) => {
    const [before, behind] = [bytes.subarray(0, at), bytes.subarray(at + 1)]
    const others = [0, 1, 2, 3, 4, 5, 6, 7].map((bit) => Buffer.of(byte ^ (1 << bit)))
    const controls = [0x02, 0x06, 0x10, 0x15].map((code) => Buffer.of(code))
    const pieces = [...others, ...controls, Buffer.alloc(0), Buffer.of(byte, byte), Buffer.of(0, byte)]
    return pieces.map((piece) => Buffer.concat([before, piece, behind]))
  })
}

const each = (bytes: Buffer) => [...bytes].map((byte) => Buffer.of(byte))

describe.each([
  ['3C format 1', { frame: '3C', format: 1 }],
  ['3C format 4', { frame: '3C', format: 4 }],
  ['4C format 5', { frame: '4C', format: 5 }],
] as const)('%s', (_title, options) => {
  test.each(['auto', 'always'] as const)('%s: an echo with one damaged byte is counted away', (mode) => {
    const ends = new Map<string, number>()
    for (const [body, answered, endCode] of [
      ['04010000D*0000000001', '0102', 0],
      ['14010000D*00000000010102', '', 0],
      ['14010000D*00000000010102', '', 0x7f24],
    ] as const) {
      const meant = `${endCode} ${answered}`
      const request = new Line(mode, options).ask(body)
      for (const damaged of damagesOf(request)) {
        for (const chunks of [
          (answer: Buffer) => [damaged, answer],
          (answer: Buffer) => [...each(damaged), ...each(answer)],
        ]) {
          for (const line of [echoing(mode, options), new Line(mode, options)]) {
            line.ask(body)
            const { ended } = line.comes(...chunks(line.answer(answered, endCode)))
            const kind = ended === meant ? 'right' : ended
            ends.set(kind, (ends.get(kind) ?? 0) + 1)
          }
        }
      }
    }
    expect([...ends.keys()]).toEqual(['right'])
  })
})

describe('a line that gives nothing back', () => {
  test('is known after its first answer, which comes a little late; the next ones come at once', () => {
    const line = new Line('auto', { frame: '3C', format: 4 })
    line.ask('04010000D*0000000001')
    expect(line.comes(line.answer('1234'))).toEqual({ ended: '0 1234', after: BETWEEN })
    line.ask('04010000D*0000000001')
    expect(line.comes(line.answer('1235'))).toEqual({ ended: '0 1235', after: 0 })
  })

  test('loses no time with never, and no answer is wrong with always', () => {
    const never = new Line('never', { frame: '3C', format: 4 })
    never.ask('04010000D*0000000001')
    expect(never.comes(never.answer('1234'))).toEqual({ ended: '0 1234', after: 0 })
    const always = new Line('always', { frame: '3C', format: 4 })
    always.ask('04010000D*0000000001')
    expect(always.comes(always.answer('1234')).ended).toBe('failed')
  })

  test('may begin to give it back, and stop again', () => {
    const line = new Line('auto', { frame: '3C', format: 4 })
    line.ask('04010000D*0000000001')
    line.comes(line.answer('1234'))
    expect(line.comes(line.ask('04010000D*0000000002'), line.answer('12345678')).ended).toBe('0 12345678')
    line.ask('04010000D*0000000001')
    expect(line.comes(line.answer('1236')).ended).toBe('failed')
    line.ask('04010000D*0000000001')
    expect(line.comes(line.answer('1237')).ended).toBe('0 1237')
  })
})
