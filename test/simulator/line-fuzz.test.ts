/** Any bytes at a simulated line: answered by whole frames or by silence, and the stations live on. */
import { describe, expect, test } from '@jest/globals'
import * as fc from 'fast-check'
import { commands } from '../../src/melsec/commands/commands'
import type { SerialFrameName } from '../../src/melsec/frame/serial-frames'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { oneCCommands } from '../../src/melsec/one-c/commands'
import { profileIds } from '../../src/melsec/profiles/profile'
import { profiles } from '../../src/melsec/profiles/profiles'
import { LineReceiver } from '../../src/simulator/line-receiver'
import { aLine, frameFormats } from './line-support'

const bytes = (max: number) => fc.uint8Array({ maxLength: max }).map((array) => Buffer.from(array))
const START = Buffer.from([5, 5, 4, 12, 16, 2, 16, 3, 0x46, 0x38, 0x46, 0x39, 0x30, 13, 10])
const starts = fc.array(fc.constantFrom(...START), { maxLength: 12 }).map((array) => Buffer.from(array))

/** Bodies that get past the first check. */
function bodiesOf(frame: SerialFrameName, messageFormat: number): fc.Arbitrary<Buffer> {
  const characters = fc.stringMatching(/^[0-9A-FXYMD*]{0,40}$/)
  if (frame === '1C') {
    const names = Object.keys(oneCCommands)
    return fc.tuple(fc.constantFrom(...names), characters).map((parts) => Buffer.from(`${parts[0]}0${parts[1]}`))
  }
  const codes = fc.constantFrom(...Object.values(commands).map(({ code }) => code))
  const subcommands = fc.constantFrom(0, 1, 2, 3, 0x80, 0x81, 0x82, 0x83)
  if (messageFormat === 5) {
    return fc
      .tuple(codes, subcommands, bytes(40))
      .map(([code, sub, rest]) => Buffer.concat([Buffer.from([code & 0xff, code >> 8, sub, 0]), rest]))
  }
  const hex = (value: number) => value.toString(16).toUpperCase().padStart(4, '0')
  return fc.tuple(codes, subcommands, characters).map(([code, sub, rest]) => Buffer.from(hex(code) + hex(sub) + rest))
}

describe.each(profileIds.filter((id) => profiles[id].serial !== undefined))('%s', (profile) => {
  const known = frameFormats.filter(({ frame }) => profiles[profile].frames.includes(frame))
  test.each(known)('$frame, format $messageFormat', ({ frame, messageFormat }) => {
    const framing = serialFraming({ frame, format: messageFormat })
    const { request } = aLine({ messageFormat, profile })
    const asked = bodiesOf(frame, messageFormat).map((body) => request(frame, 0, body))
    const damaged = fc.tuple(asked, fc.nat(), fc.nat(255)).map(([whole, at, value]) => {
      whole[at % whole.length] = value
      return whole
    })
    void fc.assert(
      fc.property(fc.array(fc.oneof(asked, damaged, bytes(60), starts), { maxLength: 6 }), (chunks) => {
        const { line, host, clock } = aLine({ messageFormat, profile, frames: [frame] })
        for (const chunk of chunks) {
          host.send(chunk)
          clock.advance(1)
        }
        clock.advance(300)
        let rest = host.bytes()
        while (rest.length > 0) {
          const scanned = framing.response.scan(rest, () => undefined)
          expect(scanned).toBeDefined()
          rest = rest.subarray(scanned?.used ?? rest.length)
        }
        line.station(0).restart(0)
        clock.advance(300)
        const alive = frame === '1C' ? 'PC0' : messageFormat === 5 ? Buffer.from('01010000', 'hex') : '01010000'
        expect(host.ask(frame, 0, alive)).not.toBe('')
      }),
      { numRuns: 60 },
    )
  })
})

describe('the receiver', () => {
  test.each(frameFormats)(
    '$frame, format $messageFormat: hears the same, wherever bytes are cut',
    ({ frame, messageFormat: format }) => {
      const { request } = aLine({ messageFormat: format })
      const receiver = () =>
        new LineReceiver({
          format,
          sumCheck: true,
          framings: new Map([[frame, serialFraming({ frame, format })]]),
          lengthOf: (_frame, _head, soFar) => (soFar.length < 4 ? undefined : 4),
        })
      const asked = request(frame, 3, format === 5 ? Buffer.from('10020310', 'hex') : 'ABCD')
      const wrong = Buffer.from(asked)
      wrong[wrong.length - (format === 4 ? 4 : 2)] = 0x47
      // Behind start codes that begin nothing, because what follows is no frame.
      const stream = Buffer.concat([Buffer.from([0xff, 0]), asked, wrong, asked])
      void fc.assert(
        fc.property(fc.array(fc.integer({ min: 1, max: 20 }), { minLength: 1, maxLength: 40 }), (sizes) => {
          const one = receiver()
          const heard: string[] = []
          for (let at = 0, i = 0; at < stream.length; i++) {
            const size = sizes[i % sizes.length] ?? 1
            for (const { kind } of one.receive(Buffer.from(stream.subarray(at, at + size)))) heard.push(kind)
            at += size
          }
          for (const { kind } of one.pause()) heard.push(kind)
          expect(heard).toEqual(['request', 'damaged', 'request'])
          expect(one.pending).toBe(false)
        }),
      )
    },
  )

  test.each(frameFormats)(
    '$frame, format $messageFormat: keeps no more than a frame',
    ({ frame, messageFormat: format }) => {
      void fc.assert(
        fc.property(fc.array(fc.oneof(bytes(4000), starts), { maxLength: 30 }), (chunks) => {
          const one = new LineReceiver({
            format,
            sumCheck: true,
            framings: new Map([[frame, serialFraming({ frame, format })]]),
            lengthOf: () => 'unknown',
          })
          for (const chunk of chunks) {
            one.receive(chunk)
            expect(one.buffered).toBeLessThan(40_000)
          }
          one.pause()
          expect(one.buffered).toBe(0)
        }),
        { numRuns: 30 },
      )
    },
  )
})
