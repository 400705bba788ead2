import { describe, expect, test } from '@jest/globals'
import { ProtocolError, RequestError } from '../../src/errors'
import { jwCommands } from '../../src/jw/commands/commands'
import { type JwHead, jwFrame } from '../../src/jw/frame'
import type { JwHeader } from '../../src/jw/header'
import { jwProtocol } from '../../src/jw/protocol'
import { Responder, Session } from '../../src/link/link'

const relay = { pda: 1, psa: 2, slot: 3, station: 4 } as const
const given = Buffer.from('00112233', 'hex')
const RELAY = `0000000001026003044000${'00'.repeat(29)}`

const headers: readonly [string, JwHeader, string][] = [
  ['none', 'none', ''],
  ['40 bytes 00', 'zero40', '00'.repeat(40)],
  ['a relay', relay, RELAY.slice(0, 80)],
  ['bytes', given, '00112233'],
]

/** The PLC's side, in one process. */
function responderOf(header: JwHeader = 'none', kind: 'stream' | 'datagram' = 'stream') {
  const protocol = jwProtocol({ header })
  return new Responder<JwHead>(protocol.framing, kind, (head, soFar) => protocol.requestLength(head, soFar))
}

describe('the header', () => {
  const exchangeOf = (header: JwHeader) => jwProtocol({ header }).exchange(jwCommands.readRunState, {})

  test.each(headers)('%s stands in front of a request', (_name, header, hex) => {
    expect(exchangeOf(header).write(0).toString('hex')).toBe(`${hex}4700e8`)
  })

  test('of a relay is printed as in the manual of the JW-20FL5, 9-43', () => {
    const bytes = exchangeOf(relay).write(0)
    expect([...bytes.subarray(0, 10)]).toEqual([0, 0, 0, 0, 1, 2, 0x60, 3, 4, 0x40])
    expect(bytes.subarray(10, 40).equals(Buffer.alloc(30))).toBe(true)
  })

  test.each(['none', 'zero40', relay] as const)('of an answer is detected, whatever was sent (%j)', (header) => {
    const exchange = exchangeOf(header)
    const { framing } = jwProtocol({ header })
    for (const front of ['', '00'.repeat(40), RELAY.slice(0, 80)]) {
      const answer = Buffer.from(`${front}4500e80001`, 'hex')
      const scanned = framing.response.scan(answer, (head, soFar) => exchange.responseLength(head, soFar))
      expect(scanned?.used).toBe(answer.length)
      expect(scanned && exchange.decode(scanned.frame)).toEqual({ state: 1 })
      // None of it is a whole answer.
      for (let end = 0; end < answer.length; end++) {
        expect(
          framing.response.scan(answer.subarray(0, end), (head, soFar) => exchange.responseLength(head, soFar)),
        ).toBeUndefined()
      }
    }
  })

  test('of bytes is as long in the answer, when there is one', () => {
    const exchange = exchangeOf(given)
    const { framing } = jwProtocol({ header: given })
    for (const front of ['', '00000000', '00112233']) {
      const scanned = framing.response.scan(Buffer.from(`${front}4500e80000`, 'hex'), () => 1)
      expect(scanned && exchange.decode(scanned.frame)).toEqual({ state: 0 })
    }
  })

  test.each(['48', 'ff', '47', `${'00'.repeat(40)}47`, '4501'])('%s begins no answer', (hex) => {
    expect(() => jwFrame().response.scan(Buffer.from(hex, 'hex'), () => 0)).toThrow(ProtocolError)
  })

  test.each<[JwHeader, string]>([
    [Buffer.of(0x45, 0), '45H or 47H'],
    [Buffer.of(0x47), '45H or 47H'],
    [Buffer.alloc(0), '1 to 255'],
    [Buffer.alloc(256), '1 to 255'],
    [{ ...relay, slot: 1 }, 'header.slot is 1'],
    [{ ...relay, station: 255 }, 'header.station is 255'],
    [{ ...relay, pda: 0 }, 'header.pda is 0'],
    [{ ...relay, psa: 1.5 }, 'header.psa is 1.5'],
  ])('%j is refused', (header, says) => {
    expect(() => jwProtocol({ header })).toThrow(RequestError)
    expect(() => jwProtocol({ header })).toThrow(says)
  })

  test('what programs without types pass is refused by name', () => {
    const from = (options: unknown) => () => jwProtocol(options as Parameters<typeof jwProtocol>[0])
    expect(from({ header: 'zero' })).toThrow('header is zero')
    expect(from({ header: { ...relay, slots: 3 } })).toThrow('There is no option header.slots')
    expect(from({ marker: 'twice' })).toThrow('marker is twice')
    expect(from({ model: 'jw20' })).toThrow('model is jw20')
  })

  test.each(headers)('%s of a request is that of its answer', (name, header, hex) => {
    const responder = responderOf(name === 'bytes' ? given : 'none')
    const [request] = responder.receive(exchangeOf(header).write(0))
    if (request === undefined) throw new Error('nothing was received')
    const answer = responder.answer(request, 0, Buffer.of(2)).toString('hex')
    const front = { 'a relay': hex.replace('0102', '0201'), bytes: '00000000' }[name] ?? hex
    expect(answer).toBe(`${front}4500e80002`)
  })
})

describe('a message that says nowhere how long it is', () => {
  test('is what has arrived, up to 1024 bytes', () => {
    const [first, second] = responderOf().receive(
      Buffer.concat([Buffer.from('470080', 'hex'), Buffer.alloc(1024, 0x47)]),
    )
    expect([first?.body.length, second]).toEqual([1024, undefined])
    const [short] = responderOf('zero40').receive(Buffer.from('4700804845', 'hex'))
    expect(short?.body.toString('hex')).toBe('4845')
  })

  test('is one datagram', () => {
    const datagram = responderOf('none', 'datagram')
    expect(datagram.receive(Buffer.from('47008001', 'hex'))).toHaveLength(1)
    expect(datagram.receive(Buffer.concat([Buffer.from('470080', 'hex'), Buffer.alloc(1025)]))).toEqual([])
  })

  test('comes back as it was, or the answer is not believed', () => {
    const exchange = jwProtocol().exchange(jwCommands.loopback, { data: Buffer.from('HELLO') })
    const frame = (text: string) => ({
      head: { command: 0x80 },
      serial: undefined,
      endCode: 0,
      body: Buffer.from(text),
    })
    expect(exchange.responseLength({ command: 0x80 }, Buffer.alloc(0))).toBe(5)
    expect(exchange.answerBody()).toBe(5)
    expect(exchange.decode(frame('HELLO'))).toEqual({})
    expect(() => exchange.decode(frame('HELLP'))).toThrow(expect.objectContaining({ code: 'ECHO_MISMATCH' }))
  })
})

describe('an answer that says how long it is', () => {
  const exchange = jwProtocol().exchange(jwCommands.readRingBuffer, { buffer: 15, function: 1, length: 1024 })
  const answer = Buffer.from('45002900' + '0f01000103000161' + '6263', 'hex')

  test('is whole when as much has arrived as it says', () => {
    const { framing } = jwProtocol()
    const length = (head: Parameters<typeof exchange.responseLength>[0], soFar: Buffer) =>
      exchange.responseLength(head, soFar)
    expect(exchange.answerBody()).toBeUndefined()
    for (let end = 0; end < answer.length; end++) {
      expect(framing.response.scan(answer.subarray(0, end), length)).toBeUndefined()
    }
    const scanned = framing.response.scan(Buffer.concat([answer, answer]), length)
    expect(scanned?.used).toBe(answer.length)
    expect(scanned && exchange.decode(scanned.frame)).toEqual({ pointer: 0x100, more: 1, data: Buffer.from('abc') })
  })

  test('is not waited for when it says more than may be, or is about another buffer', () => {
    const head = { command: 0x29 }
    expect(() => exchange.responseLength(head, Buffer.from('0f0100010104', 'hex'))).toThrow('1025 data')
    const few = jwProtocol().exchange(jwCommands.readRingBuffer, { buffer: 15, function: 1, length: 2 })
    expect(() => few.responseLength(head, answer.subarray(4))).toThrow('3 data, asked were no more than 2')
    expect(() => exchange.responseLength(head, Buffer.from('0e', 'hex'))).toThrow('does not repeat the request')
  })
})

describe('what stands behind an answer', () => {
  function ask(kind: 'stream' | 'datagram', hex: string) {
    const exchange = jwProtocol().exchange(jwCommands.readSpecifiedBufferInformation, { buffer: 1 })
    const session = new Session(jwProtocol().framing, { kind, window: 1 })
    session.submit({ ...exchange, deadline: 1000 }, 0)
    session.transmit()
    session.receive(Buffer.from(hex, 'hex'), 1)
    const events = []
    for (let event = session.poll(); event !== undefined; event = session.poll()) {
      events.push(event.kind === 'done' ? event.outcome.kind : event.kind)
    }
    return events
  }
  const information = '45006800010102000010010020' + '0004'

  test('in a datagram means nothing where the manual leaves it open', () => {
    expect(ask('datagram', `${information}00`)).toContain('answered')
    expect(ask('datagram', '4500684800')).toContain('answered')
  })

  test('of a stream is a breach', () => {
    expect(ask('stream', `${information}00`)).toContain('drop')
    expect(ask('stream', '4500684800')).toContain('drop')
  })
})
