import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import { type AnnotatedRow, annotate, hasSecret, MASK } from '../../src/codec/annotate'
import {
  type Context,
  type DataCode,
  type Declaration,
  decode,
  encode,
  field,
  type Message,
  readerOf,
  type Shape,
  writerOf,
} from '../../src/codec/codec'
import { ProtocolError } from '../../src/errors'
import { jwCommands } from '../../src/jw/commands/commands'
import { aCompatibleCommands } from '../../src/melsec/a-compatible/commands'
import { commands } from '../../src/melsec/commands/commands'
import { FORM_EXTENDED, FORM_LONG, FORM_XY_OCTAL } from '../../src/melsec/device/codec'
import { oneCCommands } from '../../src/melsec/one-c/commands'
import { messageOf } from './arbitrary-message'

/** Every declaration of this package with the forms and codes it is sent in. */
const families: readonly {
  list: Readonly<Record<string, Declaration>>
  codes: readonly DataCode[]
  forms: readonly number[]
}[] = [
  { list: commands, codes: ['binary', 'ascii'], forms: [0, FORM_LONG, FORM_EXTENDED, FORM_EXTENDED | FORM_LONG] },
  { list: aCompatibleCommands, codes: ['binary', 'ascii'], forms: [0] },
  { list: oneCCommands, codes: ['ascii'], forms: [0, FORM_XY_OCTAL] },
  { list: jwCommands, codes: ['binary'], forms: [0, 1] },
]
const cases = families.flatMap(({ list, codes, forms }) =>
  Object.entries(list).flatMap(([name, declaration]) => {
    const asked = declaration.context === undefined ? declaration : list[declaration.context]
    if (asked === undefined) throw new Error(`${name} refers to a command that does not exist`)
    return codes.map((code) => ({ name, code, declaration, asked, forms }))
  }),
)

interface Encoded {
  readonly shape: Shape
  readonly context?: Context
  readonly form: number
  readonly bytes: Buffer
}

/** A request or a response of the declaration, encoded. */
function encoded(side: 'request' | 'response', { declaration, asked, code, forms }: (typeof cases)[number]) {
  return fc.gen().map((generate): Encoded => {
    const form = generate(() => fc.constantFrom(...forms))
    const writer = writerOf(code, form)
    const shape = declaration[side]
    if (side === 'request') {
      encode(shape, messageOf(shape, generate), writer)
      return { shape, form, bytes: writer.take() }
    }
    const context = { shape: asked.request, message: messageOf(asked.request, generate) }
    encode(shape, messageOf(shape, generate, context), writer, context)
    return { shape, form, context, bytes: writer.take() }
  })
}

/** The value at a path such as `words.0.device`. */
function at(message: unknown, path: string): unknown {
  return path.split('.').reduce((value, name) => (value as Message | undefined)?.[name], message)
}

/** Where the rows leave a gap or overlap, or do not end at `length`; `undefined` when they cover it exactly. */
function uncovered(rows: readonly AnnotatedRow[], length: number, base = 0): string | undefined {
  let next = base
  for (const { offset, length: own, name } of rows) {
    if (offset !== next) return `${name} starts at ${offset}, expected ${next}`
    next += own
  }
  return next === base + length ? undefined : `the rows end at ${next}, expected ${base + length}`
}

/** Fields that the message does not show. */
const INVISIBLE = ['fixed', 'spare', 'count', 'echo', 'repeat']

function withoutMultiples(shape: Shape): Shape {
  const entries = Object.entries(shape).map(([name, field]): [string, Shape[string]] => [
    name,
    'multipleOf' in field ? { ...field, multipleOf: 1 } : field,
  ])
  return Object.fromEntries(entries)
}

describe.each(['request', 'response'] as const)('%s', (side) => {
  test.each(cases)('$name in $code code: rows cover every byte once, with the values decode gives', (given) => {
    fc.assert(
      fc.property(encoded(side, given), ({ shape, form, context, bytes }) => {
        const options = { code: given.code, form, ...(context === undefined ? {} : { context }) }
        const { rows, message, used, fault } = annotate(shape, bytes, options)
        expect(fault).toBeUndefined()
        expect(used).toBe(bytes.length)
        expect(uncovered(rows, bytes.length)).toBeUndefined()
        const decoded = decode(shape, readerOf(given.code, bytes, form), context)
        expect(message).toEqual(decoded)
        const visible = rows.filter(({ kind }) => !INVISIBLE.includes(kind))
        const shown = visible.map(({ name, secret }) => (secret === true ? '********' : at(decoded, name)))
        expect(visible.map(({ value }) => value)).toEqual(shown)
      }),
      { numRuns: 30, endOnFailure: true },
    )
  })

  test.each(cases)('$name in $code code: damaged bytes end where decode fails', (given) => {
    const damaged = fc
      .tuple(encoded(side, given), fc.nat(), fc.nat(), fc.integer({ min: 0, max: 0xff }))
      .map(([message, cut, place, byte]) => {
        const bytes = Buffer.from(message.bytes.subarray(0, message.bytes.length - (cut % 4)))
        if (bytes.length > 0) bytes[place % bytes.length] = byte
        return { ...message, bytes }
      })
    fc.assert(
      fc.property(damaged, ({ shape, form, context, bytes }) => {
        const { rows, used, fault, notes } = annotate(shape, bytes, {
          code: given.code,
          form,
          base: 100,
          ...(context === undefined ? {} : { context }),
        })
        expect(uncovered(rows, used, 100)).toBeUndefined()
        const failed = (read: Shape) => failureOf(() => decode(read, readerOf(given.code, bytes, form), context))
        // What is no multiple is noted, and is no end of reading.
        const failure = failed(withoutMultiples(shape))
        if (fault === undefined) expect(failed(shape) !== undefined).toBe(notes.length > 0)
        expect(fault?.offset).toBe(failure?.offset === undefined ? undefined : failure.offset + 100)
        expect(fault?.name).toBe(failure?.field)
        if (failure !== undefined) expect(failure.message).toContain(`(${failure.field}): ${fault?.message}.`)
      }),
      { numRuns: 30, endOnFailure: true },
    )
  })
})

function failureOf(read: () => unknown): ProtocolError | undefined {
  try {
    read()
    return undefined
  } catch (error) {
    if (error instanceof ProtocolError) return error
    throw error
  }
}

describe('rows', () => {
  test('name the field by its path, with offset, kind, value, bytes and words', () => {
    const { request } = commands.writeRandomWords
    const writer = writerOf('binary')
    const words = [{ device: { device: 'D', number: 100 }, value: 7 }] as const
    encode(request, { words, doubleWords: [] }, writer)
    expect(annotate(request, writer.take(), { code: 'binary', base: 15 }).rows).toEqual([
      { offset: 15, length: 1, name: 'wordPoints', kind: 'count', value: 1, bytes: '01', text: '1' },
      { offset: 16, length: 1, name: 'doubleWordPoints', kind: 'count', value: 0, bytes: '00', text: '0' },
      {
        offset: 17,
        length: 4,
        name: 'words.0.device',
        kind: 'device',
        value: { device: 'D', number: 100 },
        bytes: '64 00 00 A8',
        text: '{"device":"D","number":100}',
      },
      { offset: 21, length: 2, name: 'words.0.value', kind: 'u16', value: 7, bytes: '07 00', text: '7' },
    ])
  })

  test('show characters in ASCII code, and take words from whoever knows the protocol', () => {
    const { rows } = annotate(commands.readWords.request, Buffer.from('D*0001000010'), {
      code: 'ascii',
      describe: ({ name, value }) => (name === 'points' ? `${String(value)} points` : undefined),
    })
    expect(rows.map(({ bytes, text }) => [bytes, text])).toEqual([
      ['D*000100', '{"device":"D","number":100}'],
      ['0010', '16 points'],
    ])
  })

  test('a zero that means 256 is shown as 256', () => {
    const { rows } = annotate({ points: field.u8({ zeroMeans: 256, max: 256 }) }, Buffer.of(0), { code: 'binary' })
    expect(rows[0]?.value).toBe(256)
    const counted: Shape = { n: field.countOf('data', 1, { zeroMeans: 2 }), data: field.bytes('n') }
    expect(annotate(counted, Buffer.of(0, 5, 6), { code: 'binary' }).rows[0]?.value).toBe(2)
  })

  test('the bytes behind a message are left alone', () => {
    const { used, fault } = annotate({ a: field.u8() }, Buffer.of(1, 2, 3), { code: 'binary' })
    expect([used, fault]).toEqual([1, undefined])
  })

  test('a response without its request is a mistake of the caller', () => {
    expect(() => annotate(commands.readWords.response, Buffer.alloc(4), { code: 'binary' })).toThrow(TypeError)
  })
})

describe('secrets', () => {
  const unlock: Shape = {
    length: field.countOf('password', 2),
    password: field.text('length', { secret: true }),
    after: field.u8(),
  }
  const answer: Shape = { password: { kind: 'echo', of: 'password' } }
  const bytes = (code: DataCode) => {
    const writer = writerOf(code)
    encode(unlock, { password: 'hunter2!', after: 3 }, writer)
    return writer.take()
  }

  test.each(['binary', 'ascii'] as const)('are asterisks in value, bytes and words (%s)', (code) => {
    const { rows } = annotate(unlock, bytes(code), { code, describe: ({ value }) => `<${String(value)}>` })
    expect(rows[1]).toMatchObject({ name: 'password', length: 8, value: MASK, text: MASK, secret: true })
    expect(rows[1]?.bytes).toMatch(/^[* ]+$/)
    const shown = JSON.stringify(rows)
    for (const leak of ['hunter2', Buffer.from('hunter2').toString('hex'), '68 75 6E'])
      expect(shown).not.toContain(leak)
    expect(rows[2]).toMatchObject({ value: 3, text: '<3>' })
  })

  test('stay so where a response repeats them', () => {
    const context = { shape: { password: field.text(8, { secret: true }) }, message: { password: 'hunter2!' } }
    const { rows } = annotate(answer, Buffer.from('hunter2!'), { code: 'binary', context })
    expect(rows).toEqual([expect.objectContaining({ value: MASK, secret: true, text: MASK })])
  })

  test('are found in lists, too', () => {
    expect(hasSecret(unlock)).toBe(true)
    expect(hasSecret({ users: field.list(2, unlock) })).toBe(true)
    expect(hasSecret(commands.selfTest.request)).toBe(false)
  })
})

test('any bytes give rows and at most a fault, never an exception', () => {
  const requests = Object.values<Declaration>(commands).map(({ request }) => request)
  fc.assert(
    fc.property(
      fc.constantFrom(...requests),
      fc.uint8Array({ maxLength: 80 }),
      fc.constantFrom<DataCode>('binary', 'ascii'),
      fc.constantFrom(0, FORM_LONG, FORM_EXTENDED, FORM_EXTENDED | FORM_LONG),
      (shape, bytes, code, form) => {
        const { rows, used } = annotate(shape, Buffer.from(bytes), { code, form })
        expect(uncovered(rows, used)).toBeUndefined()
      },
    ),
  )
})
