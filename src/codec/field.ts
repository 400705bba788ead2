// Fields are plain data. Nothing here runs on bytes; layout.ts gives the kinds their meaning.
import type { ValueCodec, Width } from './cursor'

/** How many elements: a fixed number, or the name of a number, count, list or bulk field of this message or the request. */
export type Count = number | string

/**
 * Characters a text field may hold. `hexDigits`: 0-9 and A-F (Self Test). `printable`: 20H to 7EH (passwords).
 * `alphanumeric`: 0-9, A-Z and a-z (passwords of Sharp JW).
 */
export type Charset = 'any' | 'hexDigits' | 'printable' | 'alphanumeric'

interface Documented {
  readonly doc?: string
}

interface Bounded {
  readonly min?: number
  readonly max?: number
  /** The value that is written as 0 because the field is too narrow for it (1E: 256 points as 00H). */
  readonly zeroMeans?: number
  /** Only multiples of this number: bytes of whole words (Extend Unit). */
  readonly multipleOf?: number
}

export interface IntegerField extends Documented, Bounded {
  readonly kind: 'u8' | 'u16' | 'u32'
  /** Makes the field optional in a message that is encoded. */
  readonly default?: number
  /** The only numbers that may stand here. */
  readonly oneOf?: readonly number[]
  /** Each half of a byte is a decimal digit: 59 as 59H (clock of Sharp JW). */
  readonly bcd?: true
}
/** Bytes of an integer field. */
export const WIDTH = { u8: 1, u16: 2, u32: 4 } as const satisfies Record<IntegerField['kind'], Width>

/** The lowest and the highest number of an integer field. */
export function boundsOf({ kind, min = 0, max, bcd }: IntegerField): readonly [min: number, max: number] {
  return [min, max ?? (bcd === true ? 10 ** (2 * WIDTH[kind]) : 2 ** (8 * WIDTH[kind])) - 1]
}

/** Written, checked on reading, invisible in the message. */
export interface FixedField extends Documented {
  readonly kind: 'fixed'
  readonly width: Width
  readonly value: number
  /** ASCII code: these characters, where they are not the digits of the value. */
  readonly ascii?: string
  /** It stands there in this form only (marker of Sharp JW lists). */
  readonly inForm?: number
}
/** Written as zeros, invisible in the message; whatever is read there is passed over. */
export interface SpareField extends Documented {
  readonly kind: 'spare'
  /** Bytes; in ASCII code twice as many characters. */
  readonly size: number
}
/** Number of elements of the sibling field `of`: derived, invisible in the message. */
export interface CountField extends Documented, Bounded {
  readonly kind: 'count'
  readonly width: Width
  readonly of: string
  /** A number that stands for no elements beside 0; only read, never written. */
  readonly noneToo?: number
  /** Of an answer: the number of the request that it cannot exceed. */
  readonly atMost?: string
}
/** Repeats a field of the request; derived, checked on reading, invisible in the message. */
export interface EchoField extends Documented {
  readonly kind: 'echo'
  readonly of: string
}
// biome-ignore lint/suspicious/noExplicitAny: a field of any value type; `ValueOf` recovers the type from the codec.
export interface ValueField<C extends ValueCodec<any> = ValueCodec<any>> extends Documented {
  readonly kind: 'value'
  readonly codec: C
  /** Makes the field optional in a message that is encoded. */
  readonly default?: unknown
}
export interface BulkField extends Documented {
  readonly kind: 'words' | 'doubleWords' | 'bits' | 'bytes'
  readonly count: Count
}
export interface TextField extends Documented {
  readonly kind: 'text'
  readonly count: Count
  readonly charset?: Charset
  /** A password: never shown in traces and explanations. */
  readonly secret?: true
  /** ASCII code: each character as the two digits of its code (1E loopback), not as itself. */
  readonly digits?: true
}
export interface ListField extends Documented {
  readonly kind: 'list'
  readonly count: Count
  readonly item: Shape
}
/** Bytes up to the end of the message, which says nowhere how many they are. The last field of a request. */
export interface RestField extends Documented {
  readonly kind: 'rest'
  readonly min: number
  readonly max: number
}
/** One item per element of the request's list `of`; the item's counts refer to that element. */
export interface EachField extends Documented {
  readonly kind: 'each'
  readonly of: string
  readonly item: BulkField | IntegerField
  /** What of the element is repeated in front of its item: echoes of its fields, and fixed ones. */
  readonly front?: Shape
}
/** Repeats of each element of the request's list `of` what `item` says, as `front` of `each`; invisible in the message. */
export interface RepeatField extends Documented {
  readonly kind: 'repeat'
  readonly of: string
  readonly item: Shape
}

export type Field =
  | IntegerField
  | FixedField
  | SpareField
  | CountField
  | EchoField
  | ValueField
  | BulkField
  | TextField
  | RestField
  | ListField
  | EachField
  | RepeatField

/**
 * The fields of a request or an answer, in the order they are sent.
 * @experimental Kinds of fields may be added or changed in any version.
 */
export interface Shape {
  readonly [name: string]: Field
}

/** Fields that are not in a message. */
const INVISIBLE = ['fixed', 'spare', 'count', 'echo', 'repeat'] as const satisfies readonly Field['kind'][]
type Invisible = (typeof INVISIBLE)[number]
export type VisibleField = Exclude<Field, { kind: Invisible }>

/** Whether a field is in the message: the others are written and checked by themselves. */
export function isVisible(field: Field): field is VisibleField {
  return !INVISIBLE.some((kind) => kind === field.kind)
}

/** Whether a fixed field is in messages of the form that is written or read. */
export function standsIn({ inForm }: FixedField, { form }: { readonly form: number }): boolean {
  return inForm === undefined || inForm === form
}

/** The field of a path as errors name it, e.g. `words.0.device`; undefined for one that the shape does not have. */
export function fieldAt(shape: Shape, path: string): Field | undefined {
  const [name = '', , ...inner] = path.split('.')
  const found = Object.hasOwn(shape, name) ? shape[name] : undefined
  return found?.kind === 'list' && inner.length > 0 ? fieldAt(found.item, inner.join('.')) : found
}

type VisibleKey<S extends Shape> = { [K in keyof S]: S[K]['kind'] extends Invisible ? never : K }[keyof S]
type OptionalKey<S extends Shape> = {
  [K in VisibleKey<S>]: S[K] extends { readonly default: unknown } ? K : never
}[VisibleKey<S>]

type ValueOf<F extends Field> = F extends { kind: 'u8' | 'u16' | 'u32' }
  ? number
  : F extends { kind: 'value'; codec: ValueCodec<infer T> }
    ? T
    : F extends { kind: 'words' | 'doubleWords' }
      ? readonly number[]
      : F extends { kind: 'bits' }
        ? readonly boolean[]
        : F extends { kind: 'bytes' | 'rest' }
          ? Uint8Array
          : F extends { kind: 'text' }
            ? string
            : F extends { kind: 'list'; item: infer I extends Shape }
              ? readonly MessageOf<I>[]
              : F extends { kind: 'each'; item: infer I extends Field }
                ? readonly ValueOf<I>[]
                : never

type Flat<T> = { [K in keyof T]: T[K] }

/** A decoded object, or one to encode, of which only the names of its fields are known. */
export type Message = Readonly<Record<string, unknown>>

/**
 * The message of a shape as it is decoded: every visible field.
 * @experimental How it is computed may change in any version.
 */
export type MessageOf<S extends Shape> = Flat<{ readonly [K in VisibleKey<S>]: ValueOf<S[K]> }>

/**
 * The message of a shape as it is given for encoding: fields with a default may be left out.
 * @experimental How it is computed may change in any version.
 */
export type MessageInput<S extends Shape> = Flat<
  { readonly [K in Exclude<VisibleKey<S>, OptionalKey<S>>]: ValueOf<S[K]> } & {
    readonly [K in OptionalKey<S>]?: ValueOf<S[K]>
  }
>

type IntegerOptions = {
  doc?: string
  min?: number
  max?: number
  zeroMeans?: number
  multipleOf?: number
  default?: number
  oneOf?: readonly number[]
  bcd?: true
}
export const u8 = <const O extends IntegerOptions = Record<never, never>>(options?: O) =>
  ({ kind: 'u8', ...(options as O) }) as const
export const u16 = <const O extends IntegerOptions = Record<never, never>>(options?: O) =>
  ({ kind: 'u16', ...(options as O) }) as const
export const u32 = <const O extends IntegerOptions = Record<never, never>>(options?: O) =>
  ({ kind: 'u32', ...(options as O) }) as const
export const fixed = (value: number, width: Width, doc?: string) =>
  ({ kind: 'fixed', value, width, ...(doc ? { doc } : {}) }) as const
/** A number that stands there in one form only. */
export const fixedInForm = (value: number, width: Width, inForm: number, doc?: string) =>
  ({ kind: 'fixed', value, width, inForm, ...(doc ? { doc } : {}) }) as const
/** Characters that stand for themselves in ASCII code; `value` is what binary code has there. */
export const fixedText = (ascii: string, value: number, width: Width, doc?: string) =>
  ({ kind: 'fixed', value, width, ascii, ...(doc ? { doc } : {}) }) as const
export const spare = (size: number, doc?: string) => ({ kind: 'spare', size, ...(doc ? { doc } : {}) }) as const
export const countOf = <const N extends string>(
  of: N,
  width: Width = 2,
  options: Bounded & Documented & Pick<CountField, 'noneToo' | 'atMost'> = {},
) => ({ kind: 'count', of, width, ...options }) as const
export const echo = <const N extends string>(of: N) => ({ kind: 'echo', of }) as const
export const value = <T>(codec: ValueCodec<T>, doc?: string) =>
  ({ kind: 'value', codec, ...(doc ? { doc } : {}) }) as const
/** A value that may be left out of a message that is encoded. */
export const optional = <T>(codec: ValueCodec<T>, fallback: T, doc?: string) =>
  ({ kind: 'value', codec, default: fallback, ...(doc ? { doc } : {}) }) as const
export const words = <const C extends Count>(count: C, doc?: string) =>
  ({ kind: 'words', count, ...(doc ? { doc } : {}) }) as const
export const doubleWords = <const C extends Count>(count: C, doc?: string) =>
  ({ kind: 'doubleWords', count, ...(doc ? { doc } : {}) }) as const
export const bits = <const C extends Count>(count: C, doc?: string) =>
  ({ kind: 'bits', count, ...(doc ? { doc } : {}) }) as const
export const bytes = <const C extends Count>(count: C, doc?: string) =>
  ({ kind: 'bytes', count, ...(doc ? { doc } : {}) }) as const
export const text = <const C extends Count>(
  count: C,
  options: { doc?: string; charset?: Charset; secret?: true; digits?: true } = {},
) => ({ kind: 'text', count, ...options }) as const
export const list = <const C extends Count, const S extends Shape>(count: C, item: S, doc?: string) =>
  ({ kind: 'list', count, item, ...(doc ? { doc } : {}) }) as const
export const rest = (bounds: { min: number; max: number }, doc?: string) =>
  ({ kind: 'rest', ...bounds, ...(doc ? { doc } : {}) }) as const
export const each = <const N extends string, const F extends BulkField | IntegerField>(of: N, item: F, front?: Shape) =>
  ({ kind: 'each', of, item, ...(front ? { front } : {}) }) as const
export const repeat = <const N extends string, const S extends Shape>(of: N, item: S) =>
  ({ kind: 'repeat', of, item }) as const
