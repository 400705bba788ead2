// One character that is changed, lost or doubled, in every place of every kind of serial frame: it is found out, or it
// changes nothing, or it is named here. What arrives at once and what arrives byte by byte are both tried.
import { afterAll, beforeAll, describe, expect, test } from '@jest/globals'
import { EndCodeError, ProtocolError } from '../../src/errors'
import { type Exchange, type Head, Responder, Session } from '../../src/link/link'
import { commands } from '../../src/melsec/commands/commands'
import {
  type SerialFormat,
  type SerialFrameName,
  type SerialHead,
  serialFrameFacts,
  serialRoute,
} from '../../src/melsec/frame/serial-frames'
import { type SerialFraming, serialFraming } from '../../src/melsec/frame/serial-framing'
import { oneCCommands } from '../../src/melsec/one-c/commands'
import { oneCProtocol } from '../../src/melsec/one-c/protocol'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import { eventsOf } from '../link/support'

/** A request, and right answers to it. */
interface Asked {
  readonly name: string
  readonly exchange: Exchange<unknown>
  readonly answers: readonly Buffer[]
}

interface Spoken {
  readonly framing: SerialFraming
  readonly asked: readonly Asked[]
  /** A request as its PLC understands it. */
  readonly understood: (frame: { readonly head: SerialHead; readonly body: Buffer }) => unknown
  readonly requestLength: (head: Head, soFar: Buffer) => number | undefined
}

const D = (number: number) => ({ device: 'D', number }) as const
const VALUES = [0x1234, 0x1010, 0xffff]
const EMPTY = Buffer.alloc(0)

function speak(frame: SerialFrameName, format: SerialFormat, sumCheck: boolean): Spoken {
  const framing = serialFraming({ frame, format, sumCheck })
  const head = { ...serialRoute(frame), station: 5 }
  return frame === '1C' ? speak1c(framing, head) : speakSlmp(framing, head)
}

function speakSlmp(framing: SerialFraming, head: SerialHead): Spoken {
  const protocol = new MelsecProtocol({ framing, head, profile: resolveProfile('q'), code: framing.code })
  const read = protocol.exchange(commands.readWords, { head: D(0x1010), points: 3 })
  const write = protocol.exchange(commands.writeWords, { head: D(16), values: VALUES })
  const bits = protocol.exchange(commands.writeRandomBits, {
    bits: [{ device: { device: 'M', number: 3 }, value: true }],
  })
  const request = protocol.readRequest(read)
  if ('unknown' in request) throw new Error('the request is not known')
  const answer = (endCode: number, body: Buffer) => framing.response.write(head, 0, endCode, body)
  return {
    framing,
    asked: [
      {
        name: 'read',
        exchange: read,
        answers: [answer(0, protocol.writeResponse(request, { values: VALUES })), answer(0x7143, EMPTY)],
      },
      { name: 'write', exchange: write, answers: [answer(0, EMPTY), answer(0x4031, EMPTY)] },
      { name: 'write bits', exchange: bits, answers: [] },
    ],
    understood: (found) => {
      const request = protocol.readRequest(found)
      if ('unknown' in request) throw new ProtocolError('BAD_FIELD', 'no command is known')
      return { name: request.name, message: request.message, head: found.head }
    },
    requestLength: (_head, soFar) => protocol.requestLength(soFar),
  }
}

function speak1c(framing: SerialFraming, head: SerialHead): Spoken {
  const protocol = oneCProtocol({ framing, head, messageWait: 10 })
  const answer = (endCode: number, text: string) => framing.response.write(head, 0, endCode, Buffer.from(text))
  const read = protocol.exchange(oneCCommands.WR, { head: D(16), points: 3 })
  const write = protocol.exchange(oneCCommands.WW, { head: D(16), values: VALUES })
  const bits = protocol.exchange(oneCCommands.BT, { bits: [{ device: { device: 'M', number: 3 }, value: true }] })
  return {
    framing,
    asked: [
      { name: 'read', exchange: read, answers: [answer(0, '12341010FFFF'), answer(6, '')] },
      { name: 'write', exchange: write, answers: [answer(0, ''), answer(0x10, '')] },
      { name: 'write bits', exchange: bits, answers: [] },
    ],
    understood: (found) => {
      const { command, message } = protocol.readRequest({ ...found, serial: undefined })
      return { name: command.name, message, head: found.head }
    },
    requestLength: (asked, soFar) => protocol.requestLength(asked, soFar),
  }
}

interface Damaged {
  /** e.g. `byte 3 41 -> 42`. */
  readonly what: string
  readonly bytes: Buffer
  /** One bit is another one, or a byte is lost or doubled. */
  readonly isSmall: boolean
}

function* damagesOf(bytes: Buffer): Generator<Damaged> {
  for (const [at, byte] of bytes.entries()) {
    const [front, behind] = [bytes.subarray(0, at), bytes.subarray(at + 1)]
    for (let other = 0; other < 256; other++) {
      if (other === byte) continue
      const what = `byte ${at} ${byte.toString(16)} -> ${other.toString(16)}`
      const isSmall = Number.isInteger(Math.log2(byte ^ other))
      yield { what, isSmall, bytes: Buffer.concat([front, Buffer.of(other), behind]) }
    }
    yield { what: `byte ${at} lost`, isSmall: true, bytes: Buffer.concat([front, behind]) }
    yield { what: `byte ${at} doubled`, isSmall: true, bytes: Buffer.concat([front, Buffer.of(byte, byte), behind]) }
  }
}

/** How the bytes arrive: at once, and where it matters (in format 1 nothing else marks an end) or costs little byte by byte. */
function feedingsOf({ framing }: Spoken, { bytes, isSmall }: Damaged): Buffer[][] {
  const apart = isSmall || framing.name.endsWith('1') ? [[...bytes].map((byte) => Buffer.of(byte))] : []
  return [[bytes], ...apart]
}

/** What a PLC does on the bytes, as JSON. */
function received(spoken: Spoken, chunks: readonly Buffer[]): string[] {
  const responder = new Responder<SerialHead>(spoken.framing, 'stream', spoken.requestLength)
  return chunks
    .flatMap((chunk) => responder.receive(chunk))
    .flatMap((frame) => {
      try {
        return [JSON.stringify(spoken.understood(frame))]
      } catch (error) {
        // The PLC refuses it.
        if (error instanceof ProtocolError) return []
        throw error
      }
    })
}

/** How a request ends with these bytes as its answer: `found out` is a ProtocolError or silence. */
function ended({ framing }: Spoken, exchange: Exchange<unknown>, chunks: readonly Buffer[]): string {
  const session = new Session(framing, {
    kind: 'stream',
    window: 1,
    recovery: { quiet: 1, betweenBytes: 1, echo: 'never' },
  })
  session.submit({ ...exchange, deadline: 100 }, 0)
  session.transmit()
  for (const chunk of chunks) session.receive(chunk, 0)
  // Then the line is silent.
  session.timeout(1)
  const done = eventsOf(session).find((event) => event.kind === 'done')
  if (done?.kind !== 'done' || done.outcome.kind !== 'answered') return 'found out'
  try {
    return `${exchange.effect === 'read' ? 'value' : 'done'} ${JSON.stringify(exchange.decode(done.outcome.frame))}`
  } catch (error) {
    if (error instanceof EndCodeError) return `refused ${error.endCode.toString(16)}`
    if (error instanceof ProtocolError) return 'found out'
    throw error
  }
}

/** Kinds of what is not found out, in requests and answers, each with an example. */
function undetected(spoken: Spoken): Record<string, string> {
  const kinds: Record<string, string> = {}
  for (const { name, exchange, answers } of spoken.asked) {
    const request = exchange.write(0)
    const [right = ''] = received(spoken, [request])
    for (const damaged of damagesOf(request)) {
      for (const chunks of feedingsOf(spoken, damaged)) {
        const found = received(spoken, chunks)
        if (found.some((one) => one !== right)) kinds['another request'] ??= `${name}, ${damaged.what}: ${found.join()}`
        if (found.length > 1) kinds['two requests'] ??= `${name}, ${damaged.what}`
      }
    }
    for (const answer of answers) {
      const meant = ended(spoken, exchange, [answer])
      for (const damaged of damagesOf(answer)) {
        for (const chunks of feedingsOf(spoken, damaged)) {
          const found = ended(spoken, exchange, chunks)
          if (found === 'found out' || found === meant) continue
          kinds[`${meant.split(' ')[0]} -> ${found.split(' ')[0]}`] ??= `${name}, ${damaged.what}: ${found}`
        }
      }
    }
  }
  return kinds
}

/** Error codes behind NAK have no sum: a refusal stays one, with another code. */
const NAK_CODE = 'refused -> refused'
/** Without a sum, digits are other digits. */
const NO_SUM = ['another request', 'value -> value']

function expectedOf(format: SerialFormat, sumCheck: boolean): string[] {
  if (format === 5) return sumCheck ? [] : [...NO_SUM, 'done -> refused', NAK_CODE, 'value -> refused']
  return [NAK_CODE, ...(sumCheck ? [] : NO_SUM)]
}

const all = (Object.keys(serialFrameFacts) as SerialFrameName[]).flatMap((frame) =>
  serialFrameFacts[frame].formats.flatMap((format) =>
    [true, false].map((sumCheck) => ({
      title: `${frame} format ${format}, sum check ${sumCheck}`,
      frame,
      format,
      sumCheck,
    })),
  ),
)

/** Hundreds of thousands of errors are made: without traces they are cheap. */
const { stackTraceLimit } = Error
beforeAll(() => {
  Error.stackTraceLimit = 0
})
afterAll(() => {
  Error.stackTraceLimit = stackTraceLimit
})

describe.each(all)('$title', ({ frame, format, sumCheck }) => {
  const spoken = speak(frame, format, sumCheck)
  const expected = expectedOf(format, sumCheck).sort()

  test('what is not found out', () => {
    const found = undetected(spoken)
    expect({ kinds: Object.keys(found).sort(), found }).toEqual({ kinds: expected, found })
  })

  test('the request behind a damaged one is read', () => {
    const missed: string[] = []
    for (const { name, exchange } of spoken.asked) {
      const request = exchange.write(0)
      const [right] = received(spoken, [request])
      for (const { what, bytes, isSmall } of damagesOf(request)) {
        if (isSmall && received(spoken, [Buffer.concat([bytes, request])]).at(-1) !== right)
          missed.push(`${name}, ${what}`)
      }
    }
    expect(missed).toEqual([])
  })
})
