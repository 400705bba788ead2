import { describe, expect, test } from '@jest/globals'
import { Tracer } from '../../src/client/connection/trace'
import { declare, field } from '../../src/codec/codec'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import { type SlmpExplainerOptions, slmpExplainer } from '../../src/melsec/explain/slmp-explainer'
import { type SlmpHead, slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'

const head: SlmpHead = { network: 0, station: 0xff, moduleIo: 0x3ff, multidrop: 0, timer: 0 }
const profile = resolveProfile('generic')

/** A tracer, and the frames of a client with its settings. */
function bench(
  frame: '3E' | '4E' = '4E',
  options: Partial<SlmpExplainerOptions> & { readonly kind?: 'stream' | 'datagram' } = {},
) {
  const framing = slmpFraming(frame, 'binary')
  const protocol = new MelsecProtocol({ framing, head, profile, code: 'binary' })
  const tracer = new Tracer(
    slmpExplainer({ frame, framing, code: 'binary', profile, ...options }),
    options.kind ?? 'stream',
  )
  return {
    tracer,
    read: (number: number, serial = 0) =>
      framing.request.write(
        head,
        serial,
        protocol.exchange(commands.readWords, { head: { device: 'D', number }, points: 1 }).body,
      ),
    command: (name: CommandName, message: never, context?: Readonly<Record<string, unknown>>) =>
      framing.request.write(
        head,
        0,
        protocol.exchange(commands[name], message, context === undefined ? {} : { context }).body,
      ),
    answer: (body: readonly number[], serial = 0) => framing.response.write(head, serial, 0, Buffer.from(body)),
    sent: (bytes: Buffer) => tracer.entry({ time: 1, direction: 'sent', bytes }),
    received: (bytes: Buffer) => tracer.entry({ time: 2, direction: 'received', bytes }),
  }
}

describe('an answer is explained with its request', () => {
  test('by serial number, whatever the order', () => {
    const { read, answer, sent, received } = bench()
    sent(read(1, 1))
    sent(read(2, 2))
    expect(received(answer([20, 0], 2)).text).toContain('D2: 20')
    expect(received(answer([10, 0], 1)).text).toContain('D1: 10')
    expect(received(answer([10, 0], 1)).frames[0]?.notes).toEqual([expect.stringContaining('the request')])
  })

  test('by order, where there is no serial number', () => {
    const { read, answer, sent, received } = bench('3E')
    sent(read(1))
    const first = received(answer([10, 0]))
    sent(read(2))
    expect(received(answer([20, 0])).text).toContain('D2: 20')
    // Explained only now, and still with its own request.
    expect(first.text).toContain('D1: 10')
  })

  test('and Execute Monitor with the last registration', () => {
    const { command, answer, sent, received } = bench('3E')
    const registration = { words: [{ device: { device: 'D', number: 77 } }], doubleWords: [] }
    sent(command('entryMonitorDevice', registration as never))
    received(answer([]))
    sent(command('executeMonitor', {} as never, registration))
    expect(received(answer([5, 0])).text).toContain('D77: 5')
  })
})

describe('chunks', () => {
  test('are entries of their own; the frame is explained where it ends', () => {
    const { read, answer, sent, received } = bench()
    sent(read(5, 3))
    const bytes = answer([7, 0], 3)
    const first = received(bytes.subarray(0, 6))
    const second = received(bytes.subarray(6))
    expect(first.bytes).toEqual(bytes.subarray(0, 6))
    expect(first.frames[0]?.notes).toContain('The rest of this frame is in a later chunk.')
    expect(second.bytes).toEqual(bytes.subarray(6))
    expect(second.text).toContain('D5: 7')
  })

  test('hold several frames', () => {
    const { read, answer, sent, received } = bench()
    sent(read(1, 1))
    sent(read(2, 2))
    const { frames } = received(Buffer.concat([answer([10, 0], 1), answer([20, 0], 2)]))
    expect(frames.map(({ serial, fault }) => [serial, fault])).toEqual([
      [1, undefined],
      [2, undefined],
    ])
  })

  test('after the connection was lost have nothing to do with those before', () => {
    const { tracer, read, answer, sent, received } = bench()
    received(answer([7, 0], 3).subarray(0, 6))
    tracer.reset()
    sent(read(5, 3))
    expect(received(answer([7, 0], 3)).text).toContain('D5: 7')
  })

  test('never go on in the next datagram', () => {
    const { read, answer, sent, received } = bench('4E', { kind: 'datagram' })
    expect(received(answer([7, 0], 3).subarray(0, 6)).frames[0]?.fault).toBeDefined()
    sent(read(5, 3))
    expect(received(answer([7, 0], 3)).text).toContain('D5: 7')
  })

  test('that are no frame are shown all the same', () => {
    const { received, sent } = bench()
    const entry = received(Buffer.from('garbage'))
    expect(entry.bytes.toString()).toBe('garbage')
    expect(entry.frames[0]?.fault).toMatchObject({ offset: 0 })
    expect(sent(Buffer.from('garbage')).frames[0]?.fault).toMatchObject({ offset: 0 })
    expect(received(Buffer.alloc(0)).frames).toEqual([])
  })

  test('in the form of a request are explained as such: the PLC sends some unasked', () => {
    const { read, received } = bench()
    expect(received(read(9, 1)).frames[0]).toMatchObject({ direction: 'request', command: 'readWords' })
  })
})

test('time, direction and bytes are as they came; the words are made once', () => {
  const { read, sent } = bench()
  const bytes = read(1, 1)
  const entry = sent(bytes)
  expect(entry).toMatchObject({ time: 1, direction: 'sent', bytes })
  expect(entry.frames).toBe(entry.frames)
  expect(entry.text).toMatch(/^4E request, binary code: Read \(word units\), D1, 1 point\n/)
})

test('secrets are asterisks in the bytes and in the words', () => {
  const request = { length: field.countOf('password', 2), password: field.text('length', { secret: true }) }
  const unlock = {
    title: 'Unlock',
    code: 0x1630,
    unit: 'none',
    effect: 'control',
    manual: 'test',
    request,
    response: {},
  } as const
  const { sent } = bench('3E', { commands: declare({ unlock }) })
  const body = Buffer.concat([Buffer.from('301600000700', 'hex'), Buffer.from('hunter2')])
  const entry = sent(slmpFraming('3E', 'binary').request.write(head, 0, body))
  expect(entry.bytes.toString('latin1')).toContain('*******')
  for (const shown of [
    entry.bytes.toString('latin1'),
    entry.text,
    JSON.stringify(entry),
    JSON.stringify(entry.frames),
  ]) {
    expect(shown).not.toMatch(/hunter|68 75 6E|68756e/)
  }
})

test('what a listener does to the bytes of a trace changes neither what is sent next nor what is read', () => {
  const tell = { time: 1, direction: 'sent' } as const
  const { tracer, read, answer } = bench('3E')
  const [request, reply] = [read(1), answer([10, 0])]
  const before = [Buffer.from(request), Buffer.from(reply)]
  tracer.entry({ ...tell, bytes: request }).bytes.fill(0)
  tracer.entry({ ...tell, direction: 'received', bytes: reply }).bytes.fill(0)
  expect([request, reply]).toEqual(before)
})
