import { describe, expect, test } from '@jest/globals'
import { type Context, decode, encode, measure, readerOf, type Shape, writerOf } from '../../src/codec/codec'
import { EndCodeError, ProtocolError, RequestError } from '../../src/errors'
import { type JwCommands, jwCommands } from '../../src/jw/commands'
import { type JwHead, jwFrame } from '../../src/jw/frame'
import { jwProtocol } from '../../src/jw/protocol'
import { type FrameCase, testFeedings } from '../vectors/feedings'
import { bytesOf, type FrameVector, type Message, vectorsOfKind } from '../vectors/vectors'

/** Bytes are numbers in the vectors. */
type Bytes = Readonly<Record<string, unknown>>
const withBytes = (message: Message): Bytes =>
  Array.isArray(message.data) ? { ...message, data: Buffer.from(message.data as number[]) } : message

function commandOf(name: string): JwCommands[keyof JwCommands] {
  const command = jwCommands[name as keyof JwCommands]
  if (command === undefined) throw new Error(`No JW command ${name} is declared`)
  return command
}

function contextOf(vector: FrameVector): Context {
  if (vector.request === undefined) throw new Error(`${vector.id} has no request`)
  return { shape: commandOf(vector.command).request, message: withBytes(vector.request) }
}

/** Text of the message: what stands behind the command or the result code. */
function bodyOf(vector: FrameVector): Buffer {
  const command = commandOf(vector.command)
  const writer = writerOf('binary')
  if (vector.message === undefined) return Buffer.alloc(0)
  if (vector.side === 'request') encode<Shape>(command.request, withBytes(vector.message), writer)
  else encode<Shape>(command.response, withBytes(vector.message), writer, contextOf(vector))
  return writer.take()
}

const protocol = jwProtocol()

function caseOf(vector: FrameVector): FrameCase<JwHead> {
  const head = { command: commandOf(vector.command).code }
  return {
    framing: jwFrame(vector.header === undefined ? {} : { header: 'zero40' }),
    side: vector.side,
    bytes: bytesOf(vector),
    head,
    askedHead: head,
    body: bodyOf(vector),
    ...(vector.result === undefined ? {} : { endCode: vector.result }),
    bodyLength: (asked, soFar) =>
      vector.side === 'request'
        ? protocol.requestLength(asked, soFar)
        : measure(commandOf(vector.command).response, { ascii: false, form: 0, context: contextOf(vector) }),
  }
}

const vectors = vectorsOfKind('jw', 'frame')

describe('JW frames', () => {
  for (const vector of vectors) testFeedings(vector.id, vector.side, () => caseOf(vector))
})

describe('JW messages', () => {
  test.each(vectors)('$id is decoded to its meaning', (vector) => {
    const { code, request, response } = commandOf(vector.command)
    expect(code).toBe(vector.commandCode)
    if (vector.message === undefined) return
    const reader = readerOf('binary', bodyOf(vector))
    const found =
      vector.side === 'request' ? decode<Shape>(request, reader) : decode<Shape>(response, reader, contextOf(vector))
    expect(found).toEqual(withBytes(vector.message))
    reader.end()
  })

  test.each(vectors.filter(({ result }) => result !== undefined && result !== 0))('$id is a refusal', (vector) => {
    const message = { head: { file: 0, address: 0o4000 }, data: [0x34, 0x12] }
    const exchange = protocol.exchange(jwCommands.writeDataMemory, { ...message, data: Buffer.from(message.data) })
    const frame = { head: {}, serial: undefined, endCode: vector.result ?? 0, body: Buffer.alloc(0) }
    expect(() => exchange.decode(frame)).toThrow(EndCodeError)
    // Where the manual does not say how far a write came, nobody knows.
    const isVague = [0x02, 0x04, 0x11, 0x21, 0x53].includes(vector.result ?? 0)
    expect(() => exchange.decode(frame)).toThrow(
      expect.objectContaining({
        endCode: vector.result,
        family: 'jw',
        commandName: 'writeDataMemory',
        outcome: isVague ? 'unknown' : 'refused',
      }),
    )
  })

  test.each(vectorsOfKind('jw', 'refused'))('$id is refused by both sides', (vector) => {
    const { request } = commandOf(vector.command)
    expect(() => encode<Shape>(request, withBytes(vector.message), writerOf('binary'))).toThrow(RequestError)
    expect(() => decode<Shape>(request, readerOf('binary', bytesOf(vector).subarray(3)))).toThrow(ProtocolError)
  })
})
