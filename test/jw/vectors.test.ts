import { describe, expect, test } from '@jest/globals'
import { type Context, decode, encode, readerOf, type Shape, writerOf } from '../../src/codec/codec'
import { EndCodeError, ProtocolError, RequestError } from '../../src/errors'
import { type JwCommands, jwCommands } from '../../src/jw/commands/commands'
import type { JwHead } from '../../src/jw/frame'
import { jwProtocol } from '../../src/jw/protocol'
import type { NamedCommand } from '../../src/link/link'
import { type FrameCase, testFeedings } from '../vectors/feedings'
import { bytesOf, type FrameVector, type Message, vectorsOfKind } from '../vectors/vectors'

/** Of other models: the program of a JW300 cannot be read. */
const UNKNOWN = ['readProgram']
const printed = vectorsOfKind('jw-printed', 'frame').filter(({ command }) => !UNKNOWN.includes(command))
const derived = vectorsOfKind('jw', 'frame')
const vectors = [...printed, ...derived]

/** Bytes are numbers in the vectors. */
type Bytes = Readonly<Record<string, unknown>>
const isBytes = (name: string, value: unknown) => ['data', 'attributes'].includes(name) && Array.isArray(value)
const withBytes = (message: Message): Bytes =>
  Object.fromEntries(
    Object.entries(message).map(([name, value]) => [
      name,
      isBytes(name, value) ? Buffer.from(value as readonly number[]) : value,
    ]),
  )

function commandOf(name: string): NamedCommand {
  const command = jwCommands[name as keyof JwCommands]
  if (command === undefined) throw new Error(`No JW command ${name} is declared`)
  return command
}

function protocolOf({ marker, header, command }: FrameVector) {
  return jwProtocol({
    ...(marker === undefined ? {} : { marker }),
    ...(header === undefined ? {} : { header: 'zero40' }),
    model: command === 'setMemorySize' ? 'jw30h' : 'jw300',
  })
}

const formOf = ({ marker }: FrameVector) => (marker === 'each' ? 1 : 0)

function requestOf({ id, request }: FrameVector): Bytes {
  if (request === undefined) throw new Error(`${id} has no request`)
  return withBytes(request)
}

function contextOf(vector: FrameVector): Context {
  return { shape: commandOf(vector.command).request, message: requestOf(vector) }
}

/** Text of the message: what stands behind the command or the result code. */
function bodyOf(vector: FrameVector): Buffer {
  const command = commandOf(vector.command)
  const writer = writerOf('binary', formOf(vector))
  if (vector.message === undefined) return Buffer.alloc(0)
  if (vector.side === 'request') encode<Shape>(command.request, withBytes(vector.message), writer)
  else encode<Shape>(command.response, withBytes(vector.message), writer, contextOf(vector))
  return writer.take()
}

function caseOf(vector: FrameVector): FrameCase<JwHead> {
  const protocol = protocolOf(vector)
  const command = commandOf(vector.command)
  const asked = { command: command.code }
  const exchange =
    vector.request === undefined ? undefined : protocol.exchange<NamedCommand>(command, requestOf(vector))
  return {
    framing: protocol.framing,
    side: vector.side,
    bytes: bytesOf(vector),
    head: vector.side === 'request' ? { ...asked, header: (vector.header?.length ?? 0) / 2 } : asked,
    askedHead: asked,
    body: bodyOf(vector),
    ...(vector.result === undefined ? {} : { endCode: vector.result }),
    // Of refusals it is not printed that nothing follows; behind the answer of 68H a cell without a name is.
    ...((vector.result ?? 0) !== 0 || (vector.side === 'response' && command.code === 0x68) ? { surplus: true } : {}),
    bodyLength: (head, soFar) =>
      vector.side === 'request' ? protocol.requestLength(head as JwHead, soFar) : exchange?.responseLength(head, soFar),
  }
}

describe.each([
  ['printed', printed],
  ['derived from the layouts', derived],
] as const)('JW frames, %s', (_basis, list) => {
  // A request to send a message back ends where what has arrived ends: test/jw/frame.test.ts.
  const fed = list.filter(({ command, side }) => command !== 'loopback' || side === 'response')
  for (const vector of fed) testFeedings(vector.id, vector.side, () => caseOf(vector))
})

describe('JW messages', () => {
  test('there is a vector of every command', () => {
    expect([...new Set(vectors.map(({ command }) => command))].sort()).toEqual(Object.keys(jwCommands).sort())
  })

  test.each(vectors)('$id is decoded to its meaning', (vector) => {
    const { code, request, response } = commandOf(vector.command)
    expect(code).toBe(vector.commandCode)
    if (vector.message === undefined) return
    const reader = readerOf('binary', bodyOf(vector), formOf(vector))
    const found =
      vector.side === 'request' ? decode<Shape>(request, reader) : decode<Shape>(response, reader, contextOf(vector))
    expect(found).toEqual(withBytes(vector.message))
    reader.end()
  })

  test.each(vectors.filter(({ side }) => side === 'request'))('$id is what a client sends', (vector) => {
    const command = commandOf(vector.command)
    const exchange = protocolOf(vector).exchange<NamedCommand>(command, withBytes(vector.message ?? {}))
    expect(exchange.write(0).toString('hex')).toBe(vector.hex)
  })

  test.each(vectorsOfKind('jw-printed', 'frame').filter(({ command }) => UNKNOWN.includes(command)))(
    '$id is of another model',
    (vector) => {
      const frame = { head: { command: bytesOf(vector)[2] as number }, serial: undefined, body: Buffer.alloc(0) }
      expect(() => jwProtocol().readRequest(frame)).toThrow('There is no command 04H')
    },
  )

  test.each(vectors.filter(({ result }) => result !== undefined && result !== 0))('$id is a refusal', (vector) => {
    const message = { head: { file: 0, address: 0o4000 }, data: Buffer.of(0x34, 0x12) }
    const exchange = jwProtocol().exchange(jwCommands.writeDataMemory, message)
    const frame = { head: {}, serial: undefined, endCode: vector.result ?? 0, body: Buffer.alloc(0) }
    expect(() => exchange.decode(frame)).toThrow(EndCodeError)
    // Where the manual does not say how far a write came, nobody knows.
    const isVague = [0x02, 0x04, 0x07, 0x08, 0x0f, 0x11, 0x1b, 0x21, 0x44, 0x4c, 0x53].includes(vector.result ?? 0)
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
    const reading = () => {
      const reader = readerOf('binary', bytesOf(vector).subarray(3))
      decode<Shape>(request, reader)
      reader.end()
    }
    expect(reading).toThrow(ProtocolError)
  })
})
