// Declarations: their names, the checks at load, their rows for documentation, and the types TypeScript reads off them.
import { describe, expect, test } from '@jest/globals'
import {
  declare,
  describe as describeShape,
  field,
  type MessageInput,
  type MessageOf,
  type Shape,
} from '../../src/codec/codec'
import type { JwAddress } from '../../src/jw/address'
import { type JwCommands, jwCommands } from '../../src/jw/commands/commands'
import { type ACompatibleCommands, aCompatibleCommands } from '../../src/melsec/a-compatible/commands'
import { type Commands, commands } from '../../src/melsec/commands/commands'
import type { DeviceAddress } from '../../src/melsec/device/device'
import { declarationCases } from '../support/declarations'

const { bits, bytes, countOf, each, echo, fixed, list, repeat, rest, text, u16, u32, u8, value, words } = field

const plain = { title: 'Made up', code: 1, effect: 'read', manual: 'none' } as const
const declaring = (request: Shape, response: Shape = {}) => declare({ madeUp: { ...plain, request, response } })

describe('declare', () => {
  test('gives each declaration the name it has in the list, and freezes it', () => {
    expect(Object.entries(commands).filter(([name, command]) => command.name !== name)).toEqual([])
    expect(Object.isFrozen(commands.readWords)).toBe(true)
    expect([jwCommands.readDataMemory.name, aCompatibleCommands.readWords.name]).toEqual([
      'readDataMemory',
      'readWords',
    ])
  })

  test.each<[string, Shape, Shape, string]>([
    ['a count of nothing', { n: countOf('a', 1) }, {}, 'Made up request: n counts a, which is not beside it'],
    ['a count of a number', { n: countOf('a', 1), a: u8() }, {}, 'n counts a, which is not counted by it'],
    [
      'a count of what counts otherwise',
      { n: countOf('a', 1), a: words(3) },
      {},
      'n counts a, which is not counted by it',
    ],
    [
      'a count behind what it counts',
      { a: words('n'), n: countOf('a', 1) },
      {},
      'a is counted by n, which stands behind it',
    ],
    ['an unknown count', { a: words('m') }, {}, 'a is counted by m, which neither this message nor the request has'],
    ['a count by itself', { a: words('a') }, {}, 'a is counted by a, which neither'],
    ['a count by an inherited name', { a: words('toString') }, {}, 'a is counted by toString, which neither'],
    ['a count that comes later', { a: words('n'), n: u16() }, {}, 'a is counted by n, which stands behind it'],
    ['a count by a fixed number', { n: fixed(1, 1), a: words('n') }, {}, 'a is counted by n, which is no number'],
    ['an unknown count in a list', { n: u8(), a: list('n', { b: bits('m') }) }, {}, 'request.a: b is counted by m'],
    // The element alone is known where it is read: the message around it is not finished.
    ['a count outside of the list', { n: u8(), a: list(2, { b: bits('n') }) }, {}, 'request.a: b is counted by n'],
    ['an echo of nothing', { a: u8() }, { b: echo('c') }, 'Made up response: b repeats c, which the request lacks'],
    ['an echo in a request', { a: u8(), b: echo('a') }, {}, 'b repeats a, which the request lacks'],
    ['an echo of a row', { a: words(2) }, { a: echo('a') }, 'a repeats a, which is no single value'],
    ['an echo of a fixed number', { a: fixed(1, 1) }, { a: echo('a') }, 'a repeats a, which is no single value'],
    ['each of no list', { a: words(2) }, { b: each('a', words(1)) }, 'b goes over a, which is no list of the request'],
    [
      'each with a count its elements lack',
      { n: countOf('a', 1), a: list('n', { points: u16() }) },
      { b: each('a', words('size')) },
      'b is counted by size, which an element of a lacks',
    ],
    ['the rest before the end', { a: rest({ min: 1, max: 2 }), b: u8() }, {}, 'a takes the rest, and is not the last'],
    ['the rest of an impossible range', { a: rest({ min: 2, max: 1 }) }, {}, 'a has the range 2 to 1'],
    ['a repeat of no list', { a: words(2) }, { b: repeat('a', {}) }, 'b goes over a, which is no list of the request'],
    [
      'a repeat of what the elements lack',
      { n: countOf('a', 1), a: list('n', { points: u16() }) },
      { b: repeat('a', { size: echo('size') }) },
      'b has size, which repeats size, which the request lacks',
    ],
    [
      'a repeat with a field of its own',
      { n: countOf('a', 1), a: list('n', { points: u16() }) },
      { b: each('a', u8(), { points: u16() }) },
      'b repeats an element of a, and points is its own',
    ],
    [
      'at most what the request does not say',
      { b: words(1) },
      { n: countOf('a', 1, { atMost: 'b' }), a: words('n') },
      'n is at most b, which is no number of the request',
    ],
    ['more than decimal digits can say', { a: u8({ bcd: true, max: 100 }) }, {}, 'a goes up to 100, which its digits'],
    ['a range upside down', { a: u8({ min: 3, max: 2 }) }, {}, 'a has the range 3 to 2'],
    ['a range wider than the field', { a: u8({ max: 256 }) }, {}, 'a goes up to 256, which its width cannot hold'],
    ['a count wider than its field', { n: countOf('a', 1, { max: 999 }), a: words('n') }, {}, 'n goes up to 999'],
    ['0 with two meanings', { a: u8({ max: 256, zeroMeans: 256 }) }, {}, 'a writes 256 as 0, which is possible itself'],
    ['0 for what cannot be', { a: u8({ min: 1, max: 9, zeroMeans: 256 }) }, {}, 'a writes 256 as 0'],
    ['a default outside of the range', { a: u8({ max: 3, default: 4 }) }, {}, 'a has the default 4, which it refuses'],
    ['a default that is not in the list', { a: u8({ oneOf: [1], default: 0 }) }, {}, 'a has the default 0'],
    [
      'a list outside of the range',
      { a: u8({ max: 3, oneOf: [4] }) },
      {},
      'a has numbers in oneOf that its range excludes',
    ],
    ['a default that is no multiple', { a: u8({ multipleOf: 2, default: 3 }) }, {}, 'a has the default 3'],
    [
      'a bound that is no multiple',
      { a: u8({ multipleOf: 2, min: 1 }) },
      {},
      'a has the bound 1, which is no multiple',
    ],
    [
      'a count whose bound is no multiple',
      { n: countOf('a', 1, { multipleOf: 4, max: 6 }), a: bytes('n') },
      {},
      'n has the bound 6, which is no multiple of 4',
    ],
    ['multiples of a fraction', { a: u8({ multipleOf: 1.5 }) }, {}, 'a is a multiple of 1.5'],
    ['multiples of 0', { a: u8({ multipleOf: 0 }) }, {}, 'a is a multiple of 0'],
    ['a list with what is no multiple', { a: u8({ multipleOf: 2, oneOf: [2, 3] }) }, {}, 'a has numbers in oneOf'],
    ['a fixed number that is too wide', { a: fixed(256, 1) }, {}, 'a is fixed to what its width cannot hold'],
  ])('refuses %s', (_what, request, response, says) => {
    expect(() => declaring(request, response)).toThrow(TypeError)
    expect(() => declaring(request, response)).toThrow(says)
  })

  test('refuses the context of a command that does not exist', () => {
    expect(() => declare({ madeUp: { ...plain, request: {}, response: {}, context: 'other' } })).toThrow(
      'madeUp: there is no command other',
    )
  })

  test('takes what the declarations use', () => {
    expect(() =>
      declaring(
        {
          n: countOf('a', 1, { min: 1, max: 256, zeroMeans: 256 }),
          a: list('n', { points: u16(), b: bits('points') }),
        },
        { n: echo('n'), a: words('a'), c: each('a', words('points')), d: text('n'), e: bytes(4) },
      ),
    ).not.toThrow()
  })
})

describe('describe', () => {
  test('has a row for each field, with what a reader needs', () => {
    expect(describeShape(commands.writeBlock.request)).toEqual([
      { name: 'wordBlockCount', kind: 'count', of: 'wordBlocks' },
      { name: 'bitBlockCount', kind: 'count', of: 'bitBlocks' },
      {
        name: 'wordBlocks',
        kind: 'list',
        count: 'wordBlockCount',
        item: [
          { name: 'head', kind: 'device', doc: 'first device', takes: 'a device such as "D100"' },
          { name: 'points', kind: 'count', of: 'values', range: '1..' },
          {
            name: 'values',
            kind: 'words',
            count: 'points',
            takes: 'an array of words (0 to 65535), 1 to 65535 elements',
          },
        ],
        takes: 'an array of objects with head, values, 0 to 255 elements',
      },
      expect.objectContaining({ name: 'bitBlocks', item: expect.anything() }),
    ])
    expect(describeShape({ a: u16({ default: 4, oneOf: [2, 4], multipleOf: 2 }) })).toEqual([
      { name: 'a', kind: 'u16', multipleOf: 2, oneOf: [2, 4], default: 4, optional: true, takes: 'one of 2, 4' },
    ])
    expect(describeShape(commands.writeExtendUnit.request)).toEqual([
      expect.objectContaining({ name: 'address', multipleOf: 2 }),
      { name: 'byteCount', kind: 'count', of: 'data', range: '2..1920', multipleOf: 2 },
      expect.objectContaining({ name: 'moduleNumber' }),
      expect.objectContaining({ name: 'data' }),
    ])
    expect(describeShape({ a: fixed(7, 2, 'why'), b: u8({ max: 3 }), c: echo('b'), d: text(4) })).toEqual([
      { name: 'a', kind: 'fixed', value: 7, doc: 'why' },
      { name: 'b', kind: 'u8', range: '0..3', takes: 'a whole number from 0 to 3' },
      { name: 'c', kind: 'echo', of: 'b' },
      { name: 'd', kind: 'text', count: 4, takes: 'a text, 4 characters' },
    ])
  })

  test.each(declarationCases)('$title: one row per field, in the order of the bytes', ({ declaration }) => {
    for (const shape of [declaration.request, declaration.response]) {
      const rows = describeShape(shape)
      expect(rows.map(({ name }) => name)).toEqual(Object.keys(shape))
      expect(rows.filter(({ kind }) => kind === '')).toEqual([])
    }
  })
})

/** `true` only when the two types are the same. */
type Equal<A, B> = (<T>() => T extends A ? 1 : 2) extends <T>() => T extends B ? 1 : 2 ? true : false
type Request<C extends { request: Shape }> = MessageInput<C['request']>
type Response<C extends { response: Shape }> = MessageOf<C['response']>
const allTrue = <T extends readonly true[]>(...checks: T) => checks.length

test('TypeScript reads the messages off the declarations', () => {
  interface Block {
    readonly head: DeviceAddress
    readonly points: number
  }
  const checked = allTrue(
    true satisfies Equal<Request<Commands['readWords']>, { readonly head: DeviceAddress; readonly points: number }>,
    true satisfies Equal<Response<Commands['readWords']>, { readonly values: readonly number[] }>,
    true satisfies Equal<Response<Commands['readBits']>, { readonly values: readonly boolean[] }>,
    // Counts are derived and not there.
    true satisfies Equal<
      Request<Commands['writeBits']>,
      { readonly head: DeviceAddress; readonly values: readonly boolean[] }
    >,
    true satisfies Equal<
      Request<Commands['readBlock']>,
      {
        readonly wordBlocks: readonly { readonly head: DeviceAddress; readonly points: number }[]
        readonly bitBlocks: readonly { readonly head: DeviceAddress; readonly points: number }[]
      }
    >,
    true satisfies Equal<Request<Commands['readBlock']>['wordBlocks'][number] extends Block ? true : false, true>,
    true satisfies Equal<
      Response<Commands['readBlock']>,
      { readonly wordBlocks: readonly (readonly number[])[]; readonly bitBlocks: readonly (readonly number[])[] }
    >,
    // A field with a default may be left out when it is written, and is always there when it is read.
    true satisfies Equal<Request<Commands['remoteRun']>, { readonly mode: number; readonly clearMode?: number }>,
    true satisfies Equal<
      MessageOf<Commands['remoteRun']['request']>,
      { readonly mode: number; readonly clearMode: number }
    >,
    // Fixed fields are not there.
    true satisfies Equal<Request<Commands['remoteStop']>, Record<never, never>>,
    true satisfies Equal<Response<Commands['readTypeName']>, { readonly model: string; readonly modelCode: number }>,
    true satisfies Equal<
      Request<Commands['writeRandomBits']>,
      { readonly bits: readonly { readonly device: DeviceAddress; readonly value: boolean }[] }
    >,
    // Echoes are not there.
    true satisfies Equal<Response<JwCommands['readDataMemory']>, { readonly data: Uint8Array }>,
    true satisfies Equal<
      Request<JwCommands['writeDataMemory']>,
      { readonly head: JwAddress; readonly data: Uint8Array }
    >,
    true satisfies Equal<
      Request<ACompatibleCommands['readWords']>,
      { readonly head: DeviceAddress; readonly points: number }
    >,
    true satisfies Equal<Commands['readWords']['name'], 'readWords'>,
    true satisfies Equal<Commands['readWords']['code'], 0x0401>,
  )
  expect(checked).toBe(17)
})

test('TypeScript refuses what the message does not have', () => {
  const shape = { a: u32(), b: u8({ default: 1 }), c: value({ name: 'c', write() {}, read: () => 'c', size: () => 0 }) }
  const right: MessageInput<typeof shape> = { a: 1, c: 'x' }
  // @ts-expect-error `a` is missing
  const missing: MessageInput<typeof shape> = { c: 'x' }
  // @ts-expect-error `d` is too much
  const more: MessageInput<typeof shape> = { a: 1, c: 'x', d: 1 }
  // @ts-expect-error `c` is a text
  const wrong: MessageInput<typeof shape> = { a: 1, c: 2 }
  expect([right, missing, more, wrong]).toHaveLength(4)
})
