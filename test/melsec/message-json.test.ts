// Messages of commands as JSON: the same message there and back, and refusals that say what a field takes.
import { isDeepStrictEqual } from 'node:util'
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { RequestError } from '../../src/errors'
import type { Command } from '../../src/melsec/commands/command'
import { commandNamed, describeCommand } from '../../src/melsec/commands/command-name'
import { commands } from '../../src/melsec/commands/commands'
import { answerToJson, messageFromJson, messageToJson } from '../../src/melsec/commands/message-json'
import type { Notation } from '../../src/melsec/device/json'
import { arbitrary } from '../support/arbitrary'
import { declarationCases } from '../support/declarations'

const cases = declarationCases.filter(({ title }) => title.startsWith('melsec '))

function refusal(command: Command, json: unknown, xyRadix?: 8 | 16): RequestError {
  try {
    messageFromJson(command, json, xyRadix === undefined ? {} : { xyRadix })
  } catch (error) {
    if (error instanceof RequestError) return error
    throw error
  }
  throw new Error('it was not refused')
}

describe('a message goes into JSON text and comes back as it was', () => {
  test.each(cases)('$title', ({ declaration, code, forms }) => {
    const command = commandNamed(commandName(declaration.title))
    for (const form of forms) {
      const messages = arbitrary(command.request, { ascii: code === 'ascii', form })
      const notations = fc.constantFrom<Notation>({ xyRadix: 8 }, { xyRadix: 16, wRadix: 10 }, { wRadix: 10 }, {})
      fc.assert(
        fc.property(messages, notations, (message, notation) => {
          const json = messageToJson<Command>(command, message, { ...notation, secrets: true })
          const back = messageFromJson(command, JSON.parse(JSON.stringify(json)), notation)
          if (!isDeepStrictEqual(plain(back), plain(message))) expect(plain(back)).toEqual(plain(message))
        }),
        { numRuns: 10 },
      )
    }
  })

  function commandName(title: string): string {
    const found = Object.values<Command>(commands).find((command) => command.title === title)
    if (found === undefined) throw new Error(`no command ${title}`)
    return found.name
  }

  /** A Buffer and other bytes are the same bytes. */
  function plain(value: unknown): unknown {
    if (value instanceof Uint8Array) return [...value]
    if (Array.isArray(value)) return value.map(plain)
    if (typeof value !== 'object' || value === null) return value
    return Object.fromEntries(Object.entries(value).map(([name, part]) => [name, plain(part)]))
  }
})

describe('from JSON', () => {
  const D100 = { device: 'D', number: 100 }

  test('devices are texts or objects, numbers may be hexadecimal, bits 1 and 0, bytes digits', () => {
    const { readWords, writeBits, writeExtendUnit, writeMemory } = commands
    expect(messageFromJson(readWords, { head: 'd100', points: 2 })).toEqual({ head: D100, points: 2 })
    expect(messageFromJson(readWords, { head: D100, points: '0x10' })).toEqual({ head: D100, points: 16 })
    const bits = { head: 'M0', values: [1, 0, true, false] }
    expect(messageFromJson(writeBits, bits).values).toEqual([true, false, true, false])
    const unit = { address: '0x1008', moduleNumber: 3 }
    const digits = messageFromJson(writeExtendUnit, { ...unit, data: '34 12 FE dc' })
    expect(digits).toEqual({ address: 0x1008, moduleNumber: 3, data: Buffer.from([0x34, 0x12, 0xfe, 0xdc]) })
    expect(messageFromJson(writeExtendUnit, { ...unit, data: [0x34, '0x12'] }).data).toEqual(
      new Uint8Array([0x34, 0x12]),
    )
    expect(messageFromJson(writeExtendUnit, { ...unit, data: Buffer.from([1, 2]) }).data).toEqual(
      new Uint8Array([1, 2]),
    )
    expect(messageFromJson(writeMemory, { address: 0, values: new Uint16Array([1, 2]) }).values).toEqual([1, 2])
  })

  test('what may be left out may be left out, and is not filled in', () => {
    expect(messageFromJson(commands.remoteRun, { mode: 1 })).toEqual({ mode: 1 })
    expect(messageFromJson(commands.clearError, {})).toEqual({})
  })

  test('X and Y are as they are numbered, and refused where nobody knows', () => {
    const { readBits } = commands
    const read = (head: unknown, xyRadix?: 8 | 16) =>
      messageFromJson(readBits, { head, points: 1 }, xyRadix === undefined ? {} : { xyRadix }).head
    expect(read('X10', 8)).toEqual({ device: 'X', number: 8 })
    expect(read('X10', 16)).toEqual({ device: 'X', number: 16 })
    expect(read('X7')).toEqual({ device: 'X', number: 7 })
    expect(read('J1\\X10')).toMatchObject({ number: 16 })
    expect(read({ device: 'X', number: 16 })).toEqual({ device: 'X', number: 16 })
    for (const text of ['X10', 'y9', 'Y77', 'XA']) {
      expect(refusal(readBits, { head: text, points: 1 })).toMatchObject({ code: 'BAD_ADDRESS', field: 'head' })
    }
    expect(refusal(readBits, { head: 'X8', points: 1 }, 8).message).toContain('octal')
    expect(refusal(readBits, { head: 'X8', points: 1 }).message).toMatch(/^head: "X8": X and Y .* xyRadix/)
  })

  const { readWords, readRandom, writeBits, writeExtendUnit, writeWords, selfTest, unlock, writeRandomBits } = commands
  const bad: readonly [what: string, command: Command, json: unknown, field: string | undefined, says: RegExp][] = [
    [
      'no object',
      readWords,
      5,
      undefined,
      /^The message is 5; the message of Read \(word units\) is an object with head, points/,
    ],
    ['null', readWords, null, undefined, /is null/],
    ['an array', readWords, [], undefined, /is an array/],
    [
      'a missing field',
      readWords,
      { head: 'D0' },
      'points',
      /^points: is missing; it takes a whole number from 1 to 65535/,
    ],
    ['a missing device', readWords, { points: 1 }, 'head', /is missing; it takes a device such as "D100"/],
    ['an unknown field', readWords, { head: 'D0', points: 1, point: 2 }, 'point', /is not a field .* has head, points/],
    ['a derived field', writeWords, { head: 'D0', points: 1, values: [1] }, 'points', /filled in by itself/],
    ['a name of every object', readWords, JSON.parse('{"__proto__":1}'), '__proto__', /is not a field/],
    ['a text for a number', readWords, { head: 'D0', points: '2' }, 'points', /is "2"; it takes a whole number/],
    ['out of range', readWords, { head: 'D0', points: 0 }, 'points', /is 0, must be 1 to 65535/],
    ['a fraction', readWords, { head: 'D0', points: 1.5 }, 'points', /is 1.5; it takes/],
    ['no address', readWords, { head: 'Q0', points: 1 }, 'head', /^head: "Q0": /],
    ['a bit of a word', readWords, { head: 'D0.F', points: 1 }, 'head', /is a bit of a word; a command takes a device/],
    ['digits', readWords, { head: 'K4M0', points: 1 }, 'head', /digit designation/],
    ['an array for a device', readWords, { head: [1], points: 1 }, 'head', /is a text such as "D100"/],
    [
      'a misspelt part',
      readWords,
      { head: { device: 'D', number: 1, idnex: {} }, points: 1 },
      'head',
      /as text it is D1/,
    ],
    ['a false part', readWords, { head: { device: 'D', number: 1, indirect: false }, points: 1 }, 'head', /as text/],
    ['no device', readWords, { head: { device: 'Q', number: 1 }, points: 1 }, 'head', /no device "Q"/],
    [
      'no array',
      writeWords,
      { head: 'D0', values: 5 },
      'values',
      /is 5; it takes an array of words .*, 1 to 65535 elements/,
    ],
    ['a text among words', writeWords, { head: 'D0', values: [1, 'a'] }, 'values.1', /is "a"; values takes an array/],
    ['a negative word', writeWords, { head: 'D0', values: [-1] }, 'values', /element 0 is -1/],
    [
      'null among bits',
      writeBits,
      { head: 'M0', values: [null] },
      'values.0',
      /is null; values takes an array of true/,
    ],
    ['two for a bit', writeBits, { head: 'M0', values: [2] }, 'values.0', /is 2/],
    ['odd digits', writeExtendUnit, { address: 0, moduleNumber: 0, data: '123' }, 'data', /takes bytes as hexadecimal/],
    ['a large byte', writeExtendUnit, { address: 0, moduleNumber: 0, data: [1, 256] }, 'data.1', /is 256/],
    ['half a word', writeExtendUnit, { address: 0, moduleNumber: 0, data: '12' }, 'byteCount', /2 to 1920/],
    [
      'no list',
      readRandom,
      { words: {}, doubleWords: [] },
      'words',
      /is an object; it takes an array of objects with device/,
    ],
    ['in a list', readRandom, { words: [{ device: 'D0' }, {}], doubleWords: [] }, 'words.1.device', /is missing/],
    [
      'no object in a list',
      readRandom,
      { words: ['D0'], doubleWords: [] },
      'words.0',
      /is "D0"; it is an object with device/,
    ],
    [
      'a number for a text',
      selfTest,
      { data: 12 },
      'data',
      /is 12; it takes a text of the characters 0-9 and A-F, 1 to 960/,
    ],
    ['other characters', selfTest, { data: 'xyz' }, 'data', /0-9 and A-F/],
    ['a set that is none', writeRandomBits, { bits: [{ device: 'M0', value: 2 }] }, 'bits.0.value', /true or false/],
  ]
  test.each(bad)('%s is refused', (_what, command, json, field, says) => {
    const error = refusal(command, json, 16)
    expect(error.field).toBe(field)
    expect(error.message).toMatch(says)
    expect(error.outcome).toBe('notSent')
  })

  test.each([
    { password: 12345678 },
    { password: ['hush-hush'] },
    { password: 'hush' + '\u00fc' },
    { password: 'huh' },
  ])('a password is never repeated, %j', (json) => {
    expect(refusal(unlock, json).message).not.toMatch(/hu|1234/)
    expect(refusal(unlock, json).field).toMatch(/password|length/)
  })

  test('nor when it stands where the message should be', () => {
    for (const command of [unlock, commands.openFile]) {
      const { message } = refusal(command, 'hush-hush')
      expect(message).not.toContain('hush')
      expect(message).toContain('is an object with')
    }
  })
})

describe('to JSON', () => {
  test('devices are texts where they mean one device', () => {
    const json = (number: number, xyRadix?: 8 | 16) =>
      messageToJson(
        commands.readBits,
        { head: { device: 'X', number }, points: 1 },
        xyRadix === undefined ? {} : { xyRadix },
      ).head
    expect([json(16, 16), json(16, 8), json(7)]).toEqual(['X10', 'X20', 'X7'])
    expect(json(16)).toEqual({ device: 'X', number: 16 })
  })

  test('passwords are left out unless they are asked for', () => {
    const message = { password: 'hush-hush' }
    expect(messageToJson(commands.unlock, message)).toEqual({})
    expect(messageToJson(commands.unlock, message, { secrets: true })).toEqual(message)
  })

  test('answers: words as numbers, bytes as digits, parts of blocks', () => {
    expect(answerToJson(commands.readWords, { values: new Uint16Array([1, 2]) })).toEqual({ values: [1, 2] })
    expect(answerToJson(commands.readExtendUnit, { data: Buffer.from([1, 255]) })).toEqual({ data: '01ff' })
    const blocks = { wordBlocks: [[1, 2], [3]], bitBlocks: [] }
    expect(answerToJson(commands.readBlock, blocks)).toEqual(blocks)
    expect(answerToJson(commands.clearError, {})).toEqual({})
  })
})

describe('a command', () => {
  test('is found by its name in any case, and by a code that it alone has', () => {
    expect(commandNamed('readWords').name).toBe('readWords')
    expect(commandNamed(' READWORDS ').name).toBe('readWords')
    for (const text of ['1617', '0x1617', '1617h', '1617H']) expect(commandNamed(text).name).toBe('clearError')
    for (const command of Object.values(commands)) expect(commandNamed(command.name)).toBe(command)
  })

  test('is refused by a code that several have, and by what is none', () => {
    expect(() => commandNamed('0401')).toThrow(/^"0401" is readBits, readWords: say which\.$/)
    expect(() => commandNamed('readWord')).toThrow(/There is no command "readWord"\. There are readBits, readWords/)
    expect(() => commandNamed('FFFF')).toThrow(RequestError)
    expect(() => commandNamed('constructor')).toThrow(RequestError)
  })

  test('is described with what each field takes, without what is filled in by itself', () => {
    const { request, response, ...about } = describeCommand(commands.writeWords)
    expect(about).toEqual({
      name: 'writeWords',
      title: 'Write (word units)',
      code: '1401',
      effect: 'write',
      manual: 'SLMP reference manual 5.2',
      example: { head: 'D100', values: [0] },
    })
    expect(request.map(({ name, takes }) => [name, takes])).toEqual([
      ['head', 'a device such as "D100"'],
      ['values', 'an array of words (0 to 65535), 1 to 65535 elements'],
    ])
    expect(response).toEqual([])
    expect(describeCommand(commands.unlock).request[0]).toMatchObject({ name: 'password', secret: true })
    expect(describeCommand(commands.remoteRun).request[1]).toMatchObject({ name: 'clearMode', optional: true })
  })

  test.each(Object.values<Command>(commands))('$name: every field says what it takes', (command) => {
    const { request, response } = describeCommand(command)
    const rows = [...request, ...response].flatMap((row) => [row, ...(row.item ?? [])])
    expect(rows.filter(({ takes }) => takes === '')).toEqual([])
  })

  // A password of an example could be sent, and a wrong one is counted; what has no example must be filled in.
  const examples = Object.values<Command>(commands).filter(
    (command) => !/":(null|"")/.test(JSON.stringify(describeCommand(command).example)),
  )
  test.each(examples)('$name: its example is a message', (command) => {
    const { example, context } = describeCommand(command)
    if (context === undefined) expect(() => messageFromJson(command, example)).not.toThrow()
    else expect(() => messageFromJson(commandNamed(context), example[context])).not.toThrow()
  })

  test('most have an example that is a message', () => {
    expect(examples.length).toBeGreaterThan(20)
  })
})
