// What must be true of every declaration, in both directions, both codes and all forms.
import { isDeepStrictEqual } from 'node:util'
import { describe, expect, test } from '@jest/globals'
import fc from 'fast-check'
import {
  type Context,
  decode,
  encode,
  type Message,
  measure,
  readerOf,
  type Shape,
  writerOf,
} from '../../src/codec/codec'
import { ProtocolError, RequestError } from '../../src/errors'
import { arbitrary, type Wanted } from '../support/arbitrary'
import { fileCodecs } from '../support/arbitrary-file'
import { type DeclarationCase, declarationCases } from '../support/declarations'

/** A message with everything that is needed to write and read it. */
interface Written {
  readonly shape: Shape
  readonly form: number
  readonly message: Message
  readonly context: Context | undefined
}

function requests({ declaration, code, forms }: DeclarationCase): fc.Arbitrary<Written> {
  const shape = declaration.request
  return fc.constantFrom(...forms).chain((form) =>
    arbitrary(shape, { ascii: code === 'ascii', form }).map((message) => ({
      shape,
      form,
      message,
      context: undefined,
    })),
  )
}

function responses({ declaration, asked, code, forms }: DeclarationCase): fc.Arbitrary<Written> {
  const shape = declaration.response
  return fc.constantFrom(...forms).chain((form) => {
    const wanted: Wanted = { ascii: code === 'ascii', form }
    return arbitrary(asked, wanted).chain((request) => {
      const context = { shape: asked, message: request }
      return arbitrary(shape, { ...wanted, context }).map((message) => ({ shape, form, message, context }))
    })
  })
}

function bytesOf({ code }: DeclarationCase, { shape, form, message, context }: Written): Buffer {
  const writer = writerOf(code, form)
  encode<Shape>(shape, message, writer, context)
  return writer.take()
}

function messageOf({ code }: DeclarationCase, { shape, form, context }: Written, bytes: Buffer): unknown {
  const reader = readerOf(code, bytes, form)
  const message = decode<Shape>(shape, reader, context)
  reader.end()
  return message
}

function measured({ code }: DeclarationCase, { shape, form, context }: Written, message?: Message): number {
  return measure(shape, {
    ascii: code === 'ascii',
    form,
    ...(message === undefined ? {} : { message }),
    ...(context === undefined ? {} : { context }),
  })
}

describe.each(declarationCases)('$title', (declared) => {
  describe.each([
    ['request', requests],
    ['response', responses],
  ] as const)('%s', (side, written) => {
    test('is read as it was written, and takes the bytes that were measured', () => {
      fc.assert(
        fc.property(written(declared), (given) => {
          const bytes = bytesOf(declared, given)
          same(messageOf(declared, given, bytes), given.message)
          expect(measured(declared, given, given.message)).toBe(bytes.length)
          // What a client knows before the answer comes.
          if (side === 'response' && !tellsItsSize(given.shape)) expect(measured(declared, given)).toBe(bytes.length)
        }),
        { numRuns: 100 },
      )
    })

    test('any bytes, and any damage to right ones, give a message or a ProtocolError', () => {
      // Making messages takes longer than reading them, so a few right ones are damaged in many ways.
      const right = fc.sample(written(declared), { numRuns: 40, seed: 1 })
      const damaged = fc
        .constantFrom(...right.map((given) => ({ given, whole: bytesOf(declared, given) })))
        .chain(({ given, whole }) => fc.oneof(bytesLike(declared), damageTo(whole)).map((bytes) => ({ given, bytes })))
      fc.assert(
        fc.property(damaged, ({ given, bytes }) => {
          try {
            // What can be read can be written, and is the same message then: no two meanings for the same bytes.
            const message = messageOf(declared, given, bytes) as Message
            const again = bytesOf(declared, { ...given, message })
            same(messageOf(declared, given, again), message)
          } catch (error) {
            if (!(error instanceof ProtocolError || isForeign(given.shape, error))) throw error
          }
        }),
        { numRuns: 1000 },
      )
    })
  })
})

/** Whether the size is known only with the message itself. */
function tellsItsSize(shape: Shape): boolean {
  return Object.values(shape).some((field) => {
    if (field.kind === 'list') return tellsItsSize(field.item)
    if (field.kind === 'bytes') return typeof field.count === 'string' && shape[field.count]?.kind === 'count'
    return field.kind === 'value' && field.codec.variable === true
  })
}

/** Names and dates of files are read as they stand in the PLC, also those that nobody may write. */
function isForeign(shape: Shape, error: unknown): boolean {
  return error instanceof RequestError && error.code === 'BAD_MESSAGE' && holdsFileCodec(shape)
}

function holdsFileCodec(shape: Shape): boolean {
  return Object.values(shape).some((field) => {
    if (field.kind === 'list') return holdsFileCodec(field.item)
    return field.kind === 'value' && fileCodecs.some((codec) => codec === field.codec)
  })
}

/** As `toEqual`, which takes too long for thousands of long messages. */
function same(found: unknown, expected: unknown): void {
  if (!isDeepStrictEqual(found, expected)) expect(found).toEqual(expected)
}

/** Bytes that look a little like the code: only digits are worth reading in ASCII. */
function bytesLike({ code }: DeclarationCase): fc.Arbitrary<Buffer> {
  const any = fc.uint8Array({ maxLength: 60 }).map((bytes) => Buffer.from(bytes))
  const digits = fc
    .array(fc.constantFrom(...'0123456789ABCDEF *DMXYZR@LJU'), { maxLength: 60 })
    .map((characters) => Buffer.from(characters.join(''), 'latin1'))
  return code === 'ascii' ? fc.oneof(any, digits) : any
}

/** One byte changed, bytes cut off, or bytes added. */
function damageTo(bytes: Buffer): fc.Arbitrary<Buffer> {
  const at = fc.nat(bytes.length)
  return fc.oneof(
    fc.tuple(at, fc.nat(0xff)).map(([place, byte]) => {
      const changed = Buffer.from(bytes)
      if (place < changed.length) changed[place] = byte
      return changed
    }),
    at.map((length) => bytes.subarray(0, length)),
    fc.uint8Array({ minLength: 1, maxLength: 4 }).map((more) => Buffer.concat([bytes, more])),
  )
}
