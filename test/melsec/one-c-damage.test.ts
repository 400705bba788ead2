/**
 * One byte changed, lost or doubled in a 1C frame: with sum check the message is what was sent, or none. Without sum check
 * nothing in a frame tells a digit from another; there the length at least is held against the request.
 */
import { describe, expect, test } from '@jest/globals'
import type { Message } from '../../src/codec/codec'
import { PlcError, RequestError } from '../../src/errors'
import { type DeviceName, deviceInfo } from '../../src/melsec/device/device'
import type { OneCCommandName } from '../../src/melsec/one-c/commands'
import { oneCProtocol } from '../../src/melsec/one-c/protocol'
import { command, framing1c, HEAD_1C } from './one-c-support'

const at = (device: DeviceName, number: number) => ({ device, number: number % (deviceInfo(device).octal ? 256 : 1e4) })
const bits = [true, false, false, true, true]

interface Exchanged {
  readonly name: OneCCommandName
  readonly request: Message
  readonly answer: Message
}

const exchanges: readonly Exchanged[] = [
  { name: 'BR', request: { head: at('X', 0o40), points: 5 }, answer: { values: bits } },
  { name: 'WR', request: { head: at('TN', 123), points: 2 }, answer: { values: [31_689, 4660] } },
  { name: 'QR', request: { head: at('D', 7000), points: 3 }, answer: { values: [0, 1, 0xffff] } },
  { name: 'BW', request: { head: at('M', 903), values: bits }, answer: {} },
  { name: 'WW', request: { head: at('D', 0), values: [0x1234, 0xacd7] }, answer: {} },
  { name: 'QW', request: { head: at('R', 9999), values: [7] }, answer: {} },
  {
    name: 'BT',
    request: {
      bits: [
        { device: at('M', 50), value: true },
        { device: at('Y', 1), value: false },
      ],
    },
    answer: {},
  },
  { name: 'WT', request: { words: [{ device: at('D', 500), value: 0x1234 }] }, answer: {} },
  { name: 'RS', request: {}, answer: {} },
  { name: 'PC', request: {}, answer: { typeCode: 0xf3 } },
  { name: 'GW', request: { on: true }, answer: {} },
  { name: 'TT', request: { data: 'ABCDE' }, answer: { data: 'ABCDE' } },
]

/** Every frame that differs by one byte: changed to any other, lost, doubled. */
function* damaged(frame: Buffer): Generator<Buffer> {
  for (let at = 0; at < frame.length; at++) {
    for (let byte = 0; byte < 256; byte++) {
      if (byte === frame[at]) continue
      const changed = Buffer.from(frame)
      changed[at] = byte
      yield changed
    }
    yield Buffer.concat([frame.subarray(0, at), frame.subarray(at + 1)])
    yield Buffer.concat([frame.subarray(0, at + 1), frame.subarray(at)])
  }
}

/** What is read; `undefined` where it is nothing: an error, or a frame that is not whole. */
function read(run: () => unknown): unknown {
  try {
    return run()
  } catch (error) {
    if (!(error instanceof PlcError) || error instanceof RequestError) throw error
    return undefined
  }
}

describe.each([1, 4] as const)('format %s', (format) => {
  const framing = framing1c(format, { sumCheck: true })
  const mc = oneCProtocol({ framing, head: HEAD_1C, asciiXy: 'octal' })

  test.each(exchanges)('a request of $name with another byte is none, or the same', ({ name, request }) => {
    const whole = mc.exchange(command(name), request).write(0)
    const readIn = (bytes: Buffer) =>
      read(() => {
        const scanned = framing.request.scan(bytes, (head, soFar) => mc.requestLength(head, soFar))
        return (
          scanned && [
            scanned.frame.head,
            mc.readRequest(scanned.frame).command.name,
            mc.readRequest(scanned.frame).message,
          ]
        )
      })
    const sent = [HEAD_1C, name, request]
    expect(readIn(whole)).toEqual(sent)
    for (const bytes of damaged(whole)) {
      const found = readIn(bytes)
      if (found !== undefined) expect([bytes.toString('latin1'), found]).toEqual([bytes.toString('latin1'), sent])
    }
  })

  test.each(exchanges.filter(({ answer }) => Object.keys(answer).length > 0))(
    'an answer to $name with another byte is none, or the same',
    ({ name, request, answer }) => {
      const asked = mc.exchange(command(name), request)
      const whole = framing.response.write(HEAD_1C, 0, 0, mc.writeResponse(command(name), request, answer))
      const readIn = (bytes: Buffer) =>
        read(() => {
          const scanned = framing.response.scan(bytes, asked.responseLength)
          if (scanned === undefined || asked.mismatch(scanned.frame.head) !== undefined) return undefined
          return asked.decode(scanned.frame)
        })
      expect(readIn(whole)).toEqual(answer)
      for (const bytes of damaged(whole)) {
        const found = readIn(bytes)
        if (found !== undefined) expect([bytes.toString('latin1'), found]).toEqual([bytes.toString('latin1'), answer])
      }
    },
  )
})

test('without sum check an answer that lost or doubled a character is no value', () => {
  const framing = framing1c(1, { sumCheck: false })
  const mc = oneCProtocol({ framing, head: HEAD_1C, asciiXy: 'octal' })
  for (const { name, request, answer } of exchanges.filter(({ answer: of }) => 'values' in of)) {
    const asked = mc.exchange(command(name), request)
    const whole = framing.response.write(HEAD_1C, 0, 0, mc.writeResponse(command(name), request, answer))
    for (let at = 1; at < whole.length; at++) {
      for (const bytes of [
        Buffer.concat([whole.subarray(0, at), whole.subarray(at + 1)]),
        Buffer.concat([whole.subarray(0, at + 1), whole.subarray(at)]),
      ]) {
        const found = read(() => {
          const scanned = framing.response.scan(bytes, asked.responseLength)
          return scanned && asked.decode(scanned.frame)
        })
        // A doubled ETX is behind the frame.
        if (found !== undefined) expect([name, at, found]).toEqual([name, whole.length - 1, answer])
      }
    }
  }
})
