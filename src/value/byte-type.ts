/**
 * Types of PLCs whose registers are bytes (Sharp JW): those of words, and some of one byte. Sizes are bytes here.
 *
 * Their names are those of IEC 61131-3; BCD8 has two digits, as BCD16 has four.
 */
import { RequestError } from '../errors'
import {
  formatType,
  parseType,
  type TypeInfo,
  type TypeName,
  type TypeNamed,
  type TypeToValue,
  type TypeToWritten,
  type ValueType,
  wordsOf,
} from './type'

interface ByteTypeInfo extends Pick<TypeInfo, 'aliases'> {
  readonly kind: 'integer' | 'bcd'
  readonly min: number
  readonly max: number
}

/** The types of one byte. */
export const byteTypes = {
  BYTE: { kind: 'integer', min: 0, max: 0xff },
  USINT: { kind: 'integer', min: 0, max: 0xff, aliases: ['UINT8'] },
  SINT: { kind: 'integer', min: -0x80, max: 0x7f, aliases: ['INT8'] },
  BCD8: { kind: 'bcd', min: 0, max: 99 },
} as const satisfies Readonly<Record<string, ByteTypeInfo>>

/** Name of a type of one byte. */
export type ByteName = keyof typeof byteTypes
/** Name of any type that bytes can have. */
export type ByteTypeName = ByteName | TypeName

/** A type of bytes as {@link parseByteType} gives it. */
export type ByteType =
  | ValueType
  | {
      /** Of one byte. */
      readonly name: ByteName
      /** Only texts have one. */
      readonly length?: never
    }

/** What a value of each type is in JavaScript. */
export type ByteTypeToValue = TypeToValue & { readonly [N in ByteName]: number }
/** What may be written as a value of each type. */
export type ByteTypeToWritten = TypeToWritten & { readonly [N in ByteName]: number | bigint }

type Spelt = { [N in ByteName as N | AliasOf<(typeof byteTypes)[N]>]: N }
type AliasOf<R> = R extends { readonly aliases: readonly (infer A extends string)[] } ? A : never
/** The name of the type that a text names; `never` when the compiler cannot tell. */
export type ByteTypeNamed<T extends string> = Uppercase<T> extends keyof Spelt ? Spelt[Uppercase<T>] : TypeNamed<T>

const SPELLINGS: ReadonlyMap<string, ByteName> = new Map(
  Object.keys(byteTypes)
    .filter(isByteName)
    .flatMap((name) => {
      const row: ByteTypeInfo = byteTypes[name]
      const { aliases = [] } = row
      return [name, ...aliases].map((spelling): [string, ByteName] => [spelling, name])
    }),
)

/** Whether a type is one of a single byte. */
export function isByteName(name: string): name is ByteName {
  return Object.hasOwn(byteTypes, name)
}

/** Whether a type is one that words have, too. */
export function isWordType(type: ByteType): type is ValueType {
  return !isByteName(type.name)
}

/**
 * The type a text names: BYTE, USINT, SINT, BCD8, and all that words have.
 * @throws RequestError BAD_TYPE
 * @example parseByteType('BCD8') // { name: 'BCD8' }
 */
export function parseByteType(text: string): ByteType {
  const name = typeof text === 'string' ? SPELLINGS.get(text.normalize('NFKC').trim().toUpperCase()) : undefined
  if (name !== undefined) return { name }
  try {
    return parseType(text)
  } catch (error) {
    // Where the types are listed, those of one byte belong to them.
    if (!(error instanceof RequestError) || !error.message.includes('Types:')) throw error
    throw new RequestError(error.code, `${error.message} ${Object.keys(byteTypes).join(' ')}`, error.field)
  }
}

/** The text that is read back as this type. */
export function formatByteType(type: ByteType): string {
  return isWordType(type) ? formatType(type) : type.name
}

/**
 * Bytes one value takes. A text takes the bytes its length says: STRING(5) five.
 * @throws RequestError BAD_TYPE for BOOL, which is a bit
 */
export function bytesOf(type: ByteType): number {
  if (!isWordType(type)) return 1
  return type.name === 'STRING' ? (type.length ?? 0) : 2 * wordsOf(type)
}
