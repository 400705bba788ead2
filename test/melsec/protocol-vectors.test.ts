// The vectors through the protocol itself: form and subcommand chosen, requests recognised, answers read, refusals told.
import { describe, expect, test } from '@jest/globals'
import { EndCodeError } from '../../src/errors'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import { type SlmpHead, slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import { bytesOf, plain, type RequestDataVector, vectorsOfKind } from '../vectors/vectors'

const head: SlmpHead = { network: 0, station: 0xff, moduleIo: 0x3ff, multidrop: 0, timer: 0 }

interface Coded {
  readonly code: 'binary' | 'ascii'
  readonly xyRadix?: 8
  readonly frame?: string
}

function protocolOf({ code, xyRadix, frame }: Coded): MelsecProtocol<SlmpHead> {
  return new MelsecProtocol({
    framing: slmpFraming(frame === '4E' || frame === 'ext' ? frame : '3E', code),
    head,
    profile: resolveProfile('generic'),
    code,
    ...(xyRadix === 8 ? { asciiXy: 'octal' } : {}),
  })
}

/** Execute Monitor needs a registration; which one does not show in its request. */
const REGISTRATION = { words: [{ device: { device: 'D', number: 0 } }], doubleWords: [] }

function exchangeOf(vector: Coded & Pick<RequestDataVector, 'command' | 'form' | 'message'>) {
  const { form, command, message } = vector
  return protocolOf(vector).exchange(commands[command as CommandName], message, {
    ...(form === undefined ? {} : { form }),
    ...(command === 'executeMonitor' ? { context: REGISTRATION } : {}),
  })
}

describe.each(['slmp', 'mc-serial'] as const)('requests of %s', (family) => {
  const vectors = vectorsOfKind(family, 'requestData')

  test.each(vectors)('$id is the body of an exchange', (vector) => {
    expect(exchangeOf(vector).body.toString('hex')).toBe(vector.hex)
  })

  test.each(vectors)('$id is recognised by the PLC side', (vector) => {
    const frame = { head, serial: undefined, body: bytesOf(vector) }
    const read = protocolOf(vector).readRequest(frame)
    if ('unknown' in read) throw new Error('the PLC side does not know the command')
    expect([read.name, plain(read.message)]).toEqual([vector.command, vector.message])
  })
})

describe('devices with an extension, an index or @', () => {
  const vectors = vectorsOfKind('slmp', 'device').filter(({ complete }) => complete !== false)

  test.each(vectors)('$id: form and subcommand are computed', (vector) => {
    const digits = vector.code === 'ascii' ? 2 : 1
    const exchange = protocolOf(vector).exchange(commands.readRandom, {
      words: [{ device: vector.address }],
      doubleWords: [],
    })
    // Command, then subcommand, two counts of one byte, and the device specification.
    const { body } = exchange
    const found = Buffer.concat([body.subarray(2 * digits, 4 * digits), body.subarray(6 * digits)])
    expect(found.toString('hex')).toBe(vector.hex)
  })
})

describe('answers', () => {
  const frames = vectorsOfKind('slmp', 'frame').filter(({ side }) => side === 'response')

  const STATIONS: Readonly<Record<string, string>> = {
    'cmp-ext-bin-err-elsewhere': 'network 1, station 4660, module I/O 03FF, multidrop 0',
  }

  function answerOf(vector: (typeof frames)[number]) {
    const protocol = protocolOf(vector)
    const scanned = protocol.framing.response.scan(bytesOf(vector), () => undefined)
    if (scanned === undefined || vector.request === undefined) throw new Error(`${vector.id} is not an answer`)
    return { frame: scanned.frame, exchange: exchangeOf({ ...vector, message: vector.request }) }
  }

  test.each(frames.filter(({ endCode }) => endCode === 0))('$id is read', (vector) => {
    const { frame, exchange } = answerOf(vector)
    expect(exchange.decode(frame)).toEqual(vector.message)
  })

  test.each(frames.filter(({ endCode }) => endCode !== 0))('$id is a refusal', (vector) => {
    const { frame, exchange } = answerOf(vector)
    expect(() => exchange.decode(frame)).toThrow(EndCodeError)
    expect(() => exchange.decode(frame)).toThrow(
      expect.objectContaining({
        endCode: vector.endCode,
        outcome: 'refused',
        station: STATIONS[vector.id] ?? 'network 0, station 255, module I/O 03FF, multidrop 0',
      }),
    )
  })

  test.each(vectorsOfKind('slmp', 'responseData'))('$id is written by the PLC side and read back', (vector) => {
    const protocol = protocolOf(vector)
    const registration = vector.registration ?? REGISTRATION
    const command = commands[vector.command as CommandName]
    const exchange = protocol.exchange(command, vector.request, {
      ...(vector.form === undefined ? {} : { form: vector.form }),
      context: registration,
    })
    const request = protocol.readRequest(exchange)
    if ('unknown' in request) throw new Error('the PLC side does not know the command')
    const context = vector.registration ?? request.message
    const written = protocol.writeResponse(request, vector.message, context)
    expect(written.toString('hex')).toBe(vector.hex)
    const decoded = exchange.decode({ head, serial: undefined, endCode: 0, body: bytesOf(vector) })
    expect(plain(decoded)).toEqual(vector.message)
  })
})
