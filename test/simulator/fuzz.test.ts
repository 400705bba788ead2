import { describe, expect, test } from '@jest/globals'
import * as fc from 'fast-check'
import { commands } from '../../src/melsec/commands/commands'
import { frameFacts, slmpFrameNames } from '../../src/melsec/frame/frames'
import { slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { profileIds } from '../../src/melsec/profiles/profile'
import { profiles } from '../../src/melsec/profiles/profiles'
import { createPlcSimulator } from '../../src/simulator/server'
import { manualClock } from '../support/manual-clock'
import { readD, word } from './wire'

const CODES = ['binary', 'ascii'] as const
const bytes = (max: number) => fc.uint8Array({ maxLength: max }).map((array) => Buffer.from(array))
/** Command codes as sent, so that bodies get past the first check. */
const codes = Object.values(commands).map(({ code }) => Buffer.from([code & 0xff, code >> 8]))
const subcommands = [0, 1, 2, 3, 0x80, 0x81, 0x82, 0x83].map((low) => Buffer.from([low, 0]))
const body = fc
  .tuple(fc.constantFrom(...codes), fc.constantFrom(...subcommands), bytes(40))
  .map((parts) => Buffer.concat(parts))

describe.each(profileIds.filter((id) => profiles[id].frames.includes('3E')))('%s', (id) => {
  const asked = (['3E', 'ext'] as const).flatMap((frame) =>
    CODES.filter((code) => profiles[id].frames.includes(frame) && frameFacts[frame].codes.includes(code)).map(
      (code) => [code, frame] as const,
    ),
  )

  test.each(asked)('%s %s: any bytes are answered by frames or by silence, and the PLC lives on', (code, frame) => {
    const framing = slmpFraming(frame, code)
    const head = { network: 0, station: 0xff, moduleIo: 0x3ff, multidrop: 0, timer: 0 }
    const ascii = (content: Buffer) => Buffer.from(content.toString('hex').toUpperCase(), 'latin1')
    const bodies = body.map((content) => (frame === 'ext' ? withSystemArea(content) : content))
    const request = bodies.map((content) => framing.request.write(head, 0, code === 'ascii' ? ascii(content) : content))
    const damaged = fc.tuple(request, fc.nat(), fc.nat(255)).map(([frame, at, value]) => {
      frame[at % frame.length] = value
      return frame
    })
    void fc.assert(
      fc.property(fc.array(fc.oneof(request, damaged, bytes(60)), { maxLength: 6 }), (chunks) => {
        const frames = slmpFrameNames.filter(
          (name) => profiles[id].frames.includes(name) && frameFacts[name].codes.includes(code),
        )
        const plc = createPlcSimulator({ profile: id, code, frames, clock: manualClock() })
        for (const kind of ['stream', 'datagram'] as const) {
          let received = Buffer.alloc(0)
          const transport = plc.connect({ kind, delivery: 'synchronous' })()
          let closed = false
          transport.open({
            opened() {},
            received(answer) {
              received = Buffer.concat([received, answer])
            },
            closed() {
              closed = true
            },
          })
          for (const chunk of chunks) if (!closed) transport.send(chunk)
          expect(framesIn(received, code)).toBe(true)
          if (!closed) transport.close()
        }
        expect(alive(plc)).toBe(code === 'binary' ? word(0).toString('hex') : '')
      }),
      { numRuns: 80 },
    )
  })
})

/** Fixed value and system area behind the subcommand. */
function withSystemArea(body: Buffer): Buffer {
  return Buffer.concat([body.subarray(0, 4), Buffer.alloc(6), body.subarray(4)])
}

/** Whether the bytes are whole answers of any frame, one behind the other. */
function framesIn(received: Buffer, code: 'binary' | 'ascii'): boolean {
  let rest = received
  while (rest.length > 0) {
    const numbered = rest[0] === 0xd4 || rest.subarray(0, 2).toString() === 'D4' ? '4E' : '3E'
    const frame = rest[0] === 0xe8 ? 'ext' : numbered
    const scanned = slmpFraming(frame, code).response.scan(rest, () => undefined)
    if (scanned === undefined) return false
    rest = rest.subarray(scanned.used)
  }
  return true
}

function alive(plc: ReturnType<typeof createPlcSimulator>): string {
  plc.memory.clear()
  const answers: string[] = []
  const transport = plc.connect({ delivery: 'synchronous' })()
  transport.open({ opened() {}, received: (answer) => void answers.push(answer.toString('hex')), closed() {} })
  transport.send(readD(0))
  transport.close()
  return answers.join()
}

test('a request cut at every byte, and dribbled, is answered once', () => {
  for (let at = 1; at < readD(0).length; at++) {
    const plc = createPlcSimulator({ profile: profiles['iq-r'] })
    const answers: Buffer[] = []
    const transport = plc.connect({ delivery: 'synchronous' })()
    transport.open({ opened() {}, received: (answer) => void answers.push(answer), closed() {} })
    transport.send(readD(0).subarray(0, at))
    transport.send(readD(0).subarray(at))
    for (const byte of readD(0, 5)) transport.send(Buffer.from([byte]))
    expect(answers).toEqual([word(0), word(0, 5)])
  }
})
