// Messages of the commands of a Sharp JW as JSON: the same bytes there and back, and addresses as operands.
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { encode, type Shape, writerOf } from '../../src/codec/codec'
import { RequestError } from '../../src/errors'
import { describeJwCommand, jwCommandNamed } from '../../src/jw/commands/command-name'
import { type JwCommand, jwCommands } from '../../src/jw/commands/commands'
import { jwAnswerToJson, jwMessageFromJson, jwMessageToJson } from '../../src/jw/commands/message-json'
import { arbitrary } from '../support/arbitrary'

const all = Object.values<JwCommand>(jwCommands)

function refusal(work: () => unknown): RequestError {
  try {
    work()
  } catch (error) {
    if (error instanceof RequestError) return error
    throw error
  }
  throw new Error('it was not refused')
}

const bytesOf = (command: JwCommand, message: object) => {
  const writer = writerOf('binary')
  encode<Shape>(command.request, { ...message }, writer)
  return writer.take().toString('hex')
}

const withPassword = new Set(['secretPassword'])

describe('a message goes into JSON text and comes back', () => {
  test.each(all.filter(({ name }) => !withPassword.has(name)).map((command) => [command.name, command] as const))(
    '%s',
    (_, command) => {
      const messages = arbitrary(command.request, { ascii: false, form: 0 })
      fc.assert(
        fc.property(messages, (message) => {
          const json = JSON.parse(JSON.stringify(jwMessageToJson<JwCommand>(command, message as never))) as unknown
          const back = jwMessageFromJson(command, json)
          // An extended address may come back in the basic form: the same byte.
          expect(jwMessageToJson<JwCommand>(command, back)).toEqual(json)
          const isExtended = JSON.stringify(message).includes('"extended":true')
          if (!isExtended) expect(bytesOf(command, back)).toBe(bytesOf(command, message as object))
        }),
        { numRuns: 20 },
      )
    },
  )
})

describe('addresses', () => {
  const read = (head: unknown) => jwMessageFromJson(jwCommands.readDataMemory, { head, length: 1 }).head

  test.each([
    ['09000', { file: 0, address: 0o4000 }],
    ['KO0403', { file: 0, address: 0o403 }],
    ['F2:012345', { file: 2, address: 0o12345 }],
    ['F1:00177777', { file: 1, address: 0xffff }],
    // The file registers behind 64 KiB are in the extended form, which a JW30H refuses: its file 2 is another byte.
    ['F1:00200000', { file: 1, address: 0x10000, extended: true }],
    ['F1:37777777', { file: 1, address: 0x7f_ffff, extended: true }],
  ])('%s', (text, address) => {
    expect(read(text)).toEqual(address)
  })

  test('of lists are extended', () => {
    const message = jwMessageFromJson(jwCommands.monitorRegisters, {
      items: [{ address: '09000' }, { address: 'F2:000001' }],
    })
    expect(message.items.map(({ address }) => address)).toEqual([
      { file: 0, address: 0o4000, extended: true },
      { file: 1, address: 0o200001, extended: true },
    ])
  })

  test('are shown as operands', () => {
    const shown = (address: object) =>
      jwMessageToJson(jwCommands.readDataMemory, { head: address as never, length: 1 }).head
    expect(shown({ file: 0, address: 0o4000 })).toBe('F0:004000')
    expect(shown({ file: 2, address: 0 })).toBe('F2:000000')
    expect(shown({ file: 1, address: 0o200000, extended: true })).toBe('F1:00200000')
  })

  test.each([
    ['004033', /^head: .*is a relay; a command takes the byte of a file/],
    ['09000.1', /^head: .*is a bit; a command takes the byte/],
    ['TMR0012', /^head: .*is a timer; a command takes the byte/],
    ['#0201', /^head: .*is a byte of the system memory; a command takes the byte/],
    ['09018', /^head: .*octal/],
    ['D100', /^head: .*MELSEC/],
  ])('%s is refused', (text, message) => {
    const error = refusal(() => read(text))
    expect(error.message).toMatch(message)
    expect(error.field).toBe('head')
  })

  test('of areas that the user gives', () => {
    const areas = [{ first: '016000', last: '017777', file: 0, address: 0o20000 }]
    const message = jwMessageFromJson(jwCommands.readDataMemory, { head: 'KO1600', length: 1 }, { areas })
    expect(message.head).toEqual({ file: 0, address: 0o20000 })
  })
})

test('numbers may be octal or hexadecimal texts', () => {
  const json = { rack: 0, unit: 7, address: '0o3777', length: '0x1' }
  expect(jwMessageFromJson(jwCommands.readOptionParameters, json)).toEqual({
    rack: 0,
    unit: 7,
    address: 0o3777,
    length: 1,
  })
  expect(refusal(() => jwMessageFromJson(jwCommands.readOptionParameters, { ...json, address: '0o8' })).message).toBe(
    'address: is "0o8"; it takes a whole number from 0 to 2047.',
  )
})

test('characters of a loopback are hexadecimal digits', () => {
  expect(jwMessageFromJson(jwCommands.loopback, { data: '48 45' })).toEqual({ data: Buffer.from('HE') })
  expect(jwMessageToJson(jwCommands.loopback, { data: Buffer.from('HE') })).toEqual({ data: '4845' })
})

test('an answer has bytes as hexadecimal digits, and not again what the request said', () => {
  const answer = { data: Buffer.from('HE') }
  expect(jwAnswerToJson(jwCommands.readDataMemory, answer)).toEqual({ data: '4845' })
})

test('no password is shown', () => {
  const message = { function: 0, password: 'AB12' }
  expect(jwMessageToJson(jwCommands.secretPassword, message)).toEqual({ function: 0 })
  const wrong = { function: 0, password: 'SEKRET' }
  expect(refusal(() => jwMessageFromJson(jwCommands.secretPassword, wrong)).message).not.toContain('SEKRET')
})

test.each(all.filter(({ name }) => !withPassword.has(name)).map((command) => [command.name, command] as const))(
  'the example of %s is a message',
  (_, command) => {
    expect(() => jwMessageFromJson(command, describeJwCommand(command).example)).not.toThrow()
  },
)

test.each([
  ['readDataMemory', 'readDataMemory'],
  ['READDATAMEMORY', 'readDataMemory'],
  ['24', 'readDataMemory'],
  ['24H', 'readDataMemory'],
  ['0xfd', 'readSecretState'],
])('%s names a command', (text, name) => {
  expect(jwCommandNamed(text).name).toBe(name)
})

test.each(['readWords', '0401', '25', ''])('%j names none', (text) => {
  expect(refusal(() => jwCommandNamed(text)).message).toMatch(/has no command .* There are readOptionParameters, /)
})
