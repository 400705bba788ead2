import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import type { Message } from '../../src/codec/codec'
import { ProtocolError, RequestError } from '../../src/errors'
import type { JwDeclaration } from '../../src/jw/commands/command'
import { jwCommands } from '../../src/jw/commands/commands'
import { markerForms } from '../../src/jw/commands/data-memory'
import { jwProtocol } from '../../src/jw/protocol'
import type { NamedCommand } from '../../src/link/link'
import { arbitrary } from '../support/arbitrary'
import { vectorsOf } from '../vectors/vectors'

type AnyCommand = NamedCommand & JwDeclaration
const commands: readonly AnyCommand[] = Object.values(jwCommands)
/** The list of the manual, and B4, E4 and F4 of its reference. */
const CODES =
  '02 03 12 13 20 21 23 24 27 28 29 30 31 32 34 35 37 38 39 44 4D 54 5D 68 69 78 79 80 A2 A3 B2 B3 B4 E4 E8 E9 F4 F8 F9 FB FC FD'

test('the 42 commands of the manual, each once', () => {
  const codes = commands.map(({ code }) => code.toString(16).toUpperCase().padStart(2, '0')).sort()
  expect(codes.join(' ')).toBe(CODES)
  expect(codes).toHaveLength(42)
})

test('what a command does to the PLC', () => {
  const by = (effect: string) => commands.filter((command) => command.effect === effect).map(({ code }) => code)
  expect(by('configure').sort()).toEqual([0x12, 0x13, 0x54, 0x5d, 0x78, 0x79, 0xfb, 0xfc].sort())
  expect(by('control').sort()).toEqual([0xb2, 0xb3, 0xb4, 0xf4, 0xf8, 0xf9].sort())
  // The read pointer of a ring buffer moves, so that 29H is never repeated.
  expect(by('write').sort()).toEqual([0x29, 0x30, 0x31, 0x32, 0x34, 0x35, 0x37, 0x38, 0x39].sort())
  expect(by('diagnose')).toEqual([0x80])
  expect(by('lock')).toEqual([])
})

test('what is called printed is printed, and what is assumed says what', () => {
  const printed = new Set(vectorsOf('jw-printed').map((vector) => ('command' in vector ? vector.command : '')))
  for (const { name, confidence, open } of commands) {
    expect([name, confidence === 'printed']).toEqual([name, printed.has(name)])
    if (confidence === 'assumed') expect([name, open]).toEqual([name, expect.stringMatching(/\w/)])
  }
})

describe('JW300', () => {
  test('does not do what it does not have, and other models not what it added', () => {
    expect(() => jwProtocol().exchange(jwCommands.setMemorySize, { size: 3 })).toThrow(
      'Set memory size (5DH) does not exist on a JW300',
    )
    const old = jwProtocol({ model: 'jw30h' })
    expect(old.exchange(jwCommands.setMemorySize, { size: 3 }).write(0).toString('hex')).toBe('47005d03')
    const lacking = commands.filter(({ models }) => models?.includes('jw30h') === false).map(({ code }) => code)
    expect(lacking.sort()).toEqual([0x02, 0x03, 0x12, 0x13, 0x21, 0x27, 0x31, 0x37, 0x80].sort())
    expect(() => old.exchange(jwCommands.loopback, { data: Buffer.of(1) })).toThrow('does not exist on JW20H and JW30H')
    const head = { file: 1, address: 0, extended: true } as const
    expect(() => old.exchange(jwCommands.readDataMemory, { head, length: 1 })).toThrow('do not know extended addresses')
    const data = Buffer.of(1)
    for (const file of [0x08, 0x09]) {
      const program = { file, address: 0 }
      expect(() => old.exchange(jwCommands.writeDataMemory, { head: program, data })).toThrow('program memory')
      expect(() => old.exchange(jwCommands.setRelay, { address: program, bit: 0, value: 1 })).toThrow('program memory')
      expect(() => jwProtocol().exchange(jwCommands.writeDataMemory, { head: program, data })).not.toThrow()
    }
    expect(() => old.exchange(jwCommands.writeDataMemory, { head: { file: 7, address: 0 }, data })).not.toThrow()
  })
})

describe('a request past the end of its area', () => {
  const protocol = jwProtocol()
  const at = (file: number, address: number, extended?: true) =>
    extended === undefined ? { file, address } : { file, address, extended }
  const data = Buffer.of(1, 2)

  test.each<[string, () => unknown, (() => unknown) | undefined, string]>([
    [
      'data memory',
      () => protocol.exchange(jwCommands.readDataMemory, { head: at(0, 0xffff), length: 2 }),
      () => protocol.exchange(jwCommands.readDataMemory, { head: at(0, 0xfffe), length: 2 }),
      '177777',
    ],
    [
      'data memory, written',
      () => protocol.exchange(jwCommands.writeDataMemory, { head: at(1, 0x7fffff, true), data }),
      () => protocol.exchange(jwCommands.writeDataMemory, { head: at(1, 0xffff, true), data }),
      '37777777',
    ],
    [
      'data memory, filled',
      () => protocol.exchange(jwCommands.fillDataMemory, { head: at(0x80, 0xffff), length: 2, value: 0 }),
      undefined,
      '177777',
    ],
    [
      'system memory',
      () => protocol.exchange(jwCommands.readSystemMemory, { segment: 8, address: 0x81, length: 0x400 }),
      () => protocol.exchange(jwCommands.readSystemMemory, { segment: 8, address: 0x80, length: 0x400 }),
      '2177',
    ],
    [
      'system memory, written',
      () => protocol.exchange(jwCommands.writeSystemMemory, { segment: 8, address: 0x47f, data }),
      undefined,
      '2177',
    ],
    [
      'parameters',
      () => protocol.exchange(jwCommands.writeOptionParameters, { rack: 0, unit: 0, address: 0x7ff, data }),
      () => protocol.exchange(jwCommands.writeOptionParameters, { rack: 0, unit: 0, address: 0x7fe, data }),
      '3777',
    ],
    [
      'parameters of special I/O',
      () => protocol.exchange(jwCommands.readSpecialIoParameters, { rack: 0, unit: 0, address: 0x7f, length: 2 }),
      undefined,
      '0177',
    ],
  ])('of %s is not sent', (_area, beyond, within, last) => {
    expect(beyond).toThrow(expect.objectContaining({ code: 'OUT_OF_RANGE', outcome: 'notSent' }))
    expect(beyond).toThrow(`past ${last} (octal)`)
    if (within !== undefined) expect(within).not.toThrow()
  })
})

test('only the extended form fits into lists', () => {
  const address = { file: 0, address: 0 }
  const exchange = () => jwProtocol().exchange<NamedCommand>(jwCommands.monitorRegisters, { items: [{ address }] })
  expect(exchange).toThrow('items.0.address: only the extended form fits here')
})

test('a list holds 1 to 128 addresses', () => {
  const address = { file: 0, address: 0, extended: true } as const
  const exchange = (count: number) => () =>
    jwProtocol().exchange(jwCommands.monitorRegisters, { items: Array.from({ length: count }, () => ({ address })) })
  expect(exchange(128)).not.toThrow()
  for (const count of [0, 129]) expect(exchange(count)).toThrow(RequestError)
})

/** An exchange of any command in a form, with a right answer. */
function exchanges(command: AnyCommand) {
  const model = command.models?.includes('jw300') === false ? 'jw30h' : 'jw300'
  return fc.constantFrom(...(['once', 'each'] as const)).chain((marker) => {
    const protocol = jwProtocol({ marker, model })
    const form = markerForms[marker]
    return arbitrary(command.request, { ascii: false, form }).chain((message) => {
      const context = { shape: command.request, message }
      return arbitrary(command.response, { ascii: false, form, context }).map((response) => ({
        protocol,
        message,
        response,
      }))
    })
  })
}

/** `undefined` where the request ends behind its area. */
function sent(protocol: ReturnType<typeof jwProtocol>, command: AnyCommand, message: Message) {
  try {
    return protocol.exchange<NamedCommand>(command, message)
  } catch (error) {
    if (error instanceof RequestError && error.code === 'OUT_OF_RANGE') return undefined
    throw error
  }
}

describe.each(commands)('$name', (command) => {
  test('is read by the PLC as it was asked, and its answer by the client as it was given', () => {
    let seen = 0
    fc.assert(
      fc.property(exchanges(command), ({ protocol, message, response }) => {
        const exchange = sent(protocol, command, message)
        if (exchange === undefined) return
        seen++
        const request = protocol.framing.request.scan(exchange.write(0), (head, soFar) =>
          protocol.requestLength({ ...head, command: command.code }, soFar),
        )
        if (request === undefined) throw new Error('the request is not whole')
        const read = protocol.readRequest(request.frame)
        expect(read.command.name).toBe(command.name)
        expect(read.message).toEqual(plain(message))
        const body = protocol.writeResponse(read.command, read.message, response)
        expect(exchange.responseLength({ command: command.code }, body)).toBe(body.length)
        const frame = { head: { command: command.code }, serial: undefined, endCode: 0, body }
        expect(exchange.decode(frame)).toEqual(plain(response))
      }),
      { numRuns: 40 },
    )
    expect(seen).toBeGreaterThan(10)
  })

  test('an answer with one byte changed where it repeats the request is not believed', () => {
    fc.assert(
      fc.property(exchanges(command), fc.nat(), fc.integer({ min: 1, max: 255 }), (made, place, change) => {
        const { protocol, message, response } = made
        const exchange = sent(protocol, command, message)
        if (exchange === undefined) return
        const body = protocol.writeResponse(command, message, response)
        if (body.length === 0) return
        const at = place % body.length
        const damaged = Buffer.from(body)
        damaged[at] = (damaged[at] as number) ^ change
        const frame = { head: { command: command.code }, serial: undefined, endCode: 0, body: damaged }
        let found: unknown
        try {
          found = exchange.decode(frame)
        } catch (error) {
          expect(error).toBeInstanceOf(ProtocolError)
          return
        }
        // What is not repeated is a value of its own: it is read as the changed one, never as the right one.
        expect(found).not.toEqual(plain(response))
      }),
      { numRuns: 40 },
    )
  })
})

/** Bytes as the codec gives them, and what may be left out filled in. */
function plain(message: Message): Message {
  return Object.fromEntries(
    Object.entries(message).map(([name, value]) => [name, value instanceof Uint8Array ? Buffer.from(value) : value]),
  )
}
