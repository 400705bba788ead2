// The PLC's side of a connection.
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { Responder } from '../../src/link/link'
import { serialFraming } from '../../src/melsec/frame/serial-framing'
import { HEAD, slmpFrames } from './support'

describe.each(slmpFrames)('$title', ({ framing }) => {
  const responder = (kind: 'stream' | 'datagram' = 'stream') => new Responder(framing, kind, () => undefined)
  const request = (text: string, serial = 0x1234) => framing.request.write(HEAD, serial, Buffer.from(text))
  const bodies = (found: readonly { body: Buffer }[]) => found.map(({ body }) => String(body))

  test('requests are one however they are cut', () => {
    const bytes = Buffer.concat([request('A'), request('BB')])
    for (let cut = 0; cut <= bytes.length; cut++) {
      const plc = responder()
      const found = [...plc.receive(bytes.subarray(0, cut)), ...plc.receive(bytes.subarray(cut))]
      expect([cut, bodies(found)]).toEqual([cut, ['A', 'BB']])
    }
    const plc = responder()
    expect(bodies([...bytes].flatMap((byte) => plc.receive(Buffer.of(byte))))).toEqual(['A', 'BB'])
  })

  test('rubbish is answered by silence, and where lines have no noise takes what stands behind it along', () => {
    const plc = responder()
    expect(bodies(plc.receive(Buffer.concat([request('A'), Buffer.of(0xff), request('B')])))).toEqual(['A'])
    expect(bodies(plc.receive(request('C')))).toEqual(['C'])
  })

  test('a frame that does not end is forgotten before it fills the memory', () => {
    const plc = responder()
    const whole = request('x'.repeat(60_000))
    expect(plc.receive(whole.subarray(0, 40_000))).toEqual([])
    expect(bodies(plc.receive(whole.subarray(40_000)))).toEqual(['x'.repeat(60_000)])
  })

  test('one datagram is one request', () => {
    const plc = responder('datagram')
    expect(plc.receive(request('A').subarray(0, -1))).toEqual([])
    expect(plc.receive(Buffer.concat([request('A'), Buffer.of(0x35)]))).toEqual([])
    expect(plc.receive(Buffer.concat([request('A'), Buffer.of(0xff)]))).toEqual([])
    expect(plc.receive(Buffer.concat([request('A'), request('B')]))).toEqual([])
    expect(plc.receive(Buffer.alloc(0))).toEqual([])
    expect(bodies(plc.receive(request('C')))).toEqual(['C'])
  })

  test('an answer repeats the serial number and the route of its request', () => {
    const [asked] = responder().receive(request('A', 0xabcd))
    if (asked === undefined) throw new Error('no request')
    const bytes = responder().answer(asked, 0xc059, Buffer.from('why'))
    const scanned = framing.response.scan(bytes, () => undefined)
    expect(scanned).toMatchObject({ used: bytes.length, frame: { endCode: 0xc059, serial: asked.serial } })
    expect(scanned?.frame.head).toMatchObject(HEAD)
    expect(String(scanned?.frame.body)).toBe('why')
  })

  test('any bytes give requests or nothing', () => {
    const chunk = fc.oneof(fc.uint8Array({ maxLength: 30 }), fc.constant(Uint8Array.from(request('A'))))
    fc.assert(
      fc.property(fc.constantFrom('stream', 'datagram'), fc.array(chunk, { maxLength: 8 }), (kind, chunks) => {
        const plc = responder(kind)
        for (const bytes of chunks)
          for (const { body } of plc.receive(Buffer.from(bytes))) expect(body).toBeInstanceOf(Buffer)
      }),
      { numRuns: 1000 },
    )
  })
})

test('a frame without a length is forgotten when it gets longer than any frame', () => {
  const plc = new Responder(serialFraming({ frame: '4C', format: 5 }), 'stream', () => undefined)
  const start = Buffer.from('1002', 'hex')
  expect(plc.receive(Buffer.concat([start, Buffer.alloc(70_000, 0x41)]))).toEqual([])
  const route = { station: 1, network: 0, pc: 0xff, moduleIo: 0x3ff, multidrop: 0, selfStation: 0 }
  const request = serialFraming({ frame: '4C', format: 5 }).request.write(route, 0, Buffer.from('next'))
  expect(plc.receive(request).map(({ body }) => String(body))).toEqual(['next'])
})
