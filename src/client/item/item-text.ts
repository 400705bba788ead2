/**
 * What the compiler reads out of the text of an item: the type of its values, and whether they are one or many.
 *
 * It follows `parseItem` and the tables of devices and types. What it cannot tell is unknown, never a guess: a label
 * without a type, or a text put together at run time. It may take a text that `parseItem` refuses, because then there is no
 * value; where two spellings of a text could be of different types, it has to be as strict.
 */
import type { DeviceName, DeviceTable } from '../../melsec/device/device'
import type { TypeName, TypeNamed } from '../../value/value'
import type { DefaultTypes } from './item'
import type { Item, ItemOptions } from './parts'

/**
 * One value, or an array. `element`: of an array of a label; read it is one value, written it may be many.
 * `unknown`: it cannot be told.
 */
type HowMany = 'one' | 'many' | 'element' | 'unknown'

/** What is known of an item. `type`: `never` when it is not known. */
export interface ItemFacts<T extends TypeName = TypeName, N extends HowMany = HowMany> {
  readonly type: T
  readonly count: N
}

/** What is known of an item; of any text, and of `any`, nothing. */
export type FactsOf<I extends Item> = string extends I
  ? ItemFacts<never, 'unknown'>
  : I extends string
    ? FactsOfText<Trim<I>>
    : I extends ItemOptions
      ? WithCount<I, WithType<I, FactsOf<I['address']>>>
      : never

/** `{ address: 'D100', type: 'REAL' }` */
type WithType<I extends ItemOptions, F extends ItemFacts> = I extends { readonly type: infer T extends string }
  ? ItemFacts<TypeNamed<T>, F['count']>
  : 'type' extends keyof I
    ? ItemFacts<never, F['count']>
    : F

/** `{ address: 'D100', count: 10 }` */
type WithCount<I extends ItemOptions, F extends ItemFacts> = I extends { readonly count: number }
  ? ItemFacts<F['type'], 'many'>
  : 'count' extends keyof I
    ? ItemFacts<F['type'], 'unknown'>
    : F

type FactsOfText<T extends string> = T extends `${infer Name}:${infer Type}`
  ? Uppercase<Name> extends 'LABEL'
    ? FactsOfLabel<Type>
    : Named<Name, FactsOfType<Type>>
  : FactsOfDevice<T>

/** What stands behind `label:`. */
type FactsOfLabel<T extends string> = T extends `${infer Name}:${infer Type}`
  ? Named<Name, FactsOfType<Type>>
  : Named<T, ItemFacts<never, 'one'>>

/** With what is before the colon: a range, or an element of an array of a label. */
type Named<Name extends string, F extends ItemFacts> = Name extends `${string}..${string}`
  ? ItemFacts<F['type'], 'many'>
  : F['count'] extends 'one'
    ? IsWritten<Name> extends true
      ? ItemFacts<F['type'], Name extends `${string}[${string}` ? 'element' : 'one'>
      : ItemFacts<F['type'], 'unknown'>
    : F

/** What is behind the colon. The brackets of `Word [Signed]` are no count, those of `Word [Signed][4]` are both. */
type FactsOfType<T extends string, Before extends string = ''> = T extends `${infer A}[${infer B}`
  ? B extends `${number}]`
    ? ItemFacts<TypeNamed<`${Before}${A}`>, 'many'>
    : FactsOfType<B, `${Before}${A}[`>
  : ItemFacts<TypeNamed<`${Before}${T}`>, IsWritten<`${Before}${T}`> extends true ? 'one' : 'unknown'>

/** Whether all of a text is known, but for numbers: `D${number}`. A number has no colon, range or brackets. */
export type IsWritten<T extends string> =
  Record<never, never> extends Record<T, 1> ? (T extends `${infer Head}${number}` ? IsWritten<Head> : false) : true

/** An address without a type: `D100`, `D100[10]`, `D100,10`, `D0..D9`. */
type FactsOfDevice<T extends string> = T extends `${infer Device}[${infer Rest}`
  ? Rest extends `${number}]`
    ? DeviceFacts<Device, 'many', 'unknown'>
    : ItemFacts<never, 'unknown'>
  : T extends `${infer Device},${number}`
    ? DeviceFacts<Device, 'many', 'unknown'>
    : T extends `${infer First}..${infer Last}`
      ? DeviceFacts<IsWritten<Last> extends true ? First : '', 'many', 'many'>
      : DeviceFacts<T, 'one', IsWritten<T> extends true ? 'one' : 'unknown'>

/** Of a text that is no device: it may be a label, and brackets may be its index. */
type DeviceFacts<Device extends string, N extends HowMany, Otherwise extends HowMany> =
  DefaultType<Trim<Uppercase<Device>>> extends infer Type extends TypeName
    ? ItemFacts<Type, [Type] extends [never] ? Otherwise : N>
    : never

/** The type of a device that says none. `@D0`, `U3\G100`, `J1\W10`; no device has a name with J or U. */
type DefaultType<T extends string> = T extends `@${infer Rest}`
  ? DefaultType<Rest>
  : T extends `${'J' | 'U'}${string}${'\\' | '/' | '¥'}${infer Tail}`
    ? TypeOfTail<Tail>
    : TypeOfTail<T>

/** Digits of bits are a number: `K4M0`. Asked this way round, because `K4_Motor` has no type, which fits anything. */
type TypeOfTail<T extends string> = T extends `K${1 | 2 | 3 | 4 | 5 | 6 | 7 | 8}${infer Bits}`
  ? DefaultTypes['bit'] extends TypeOfName<Bits>
    ? DefaultTypes['word' | 'doubleWord']
    : never
  : TypeOfName<T>

type Digit = `${0 | 1 | 2 | 3 | 4 | 5 | 6 | 7 | 8 | 9}`
interface DigitsOf {
  readonly 10: Digit
  readonly 16: Digit | 'A' | 'B' | 'C' | 'D' | 'E' | 'F'
}

/** Takes the longest name of a device from the front: `SB10` is SB, not S. */
type TypeOfName<T extends string, Taken extends string = '', Found = never> = T extends `${infer C}${infer Rest}`
  ? C extends Digit
    ? Found
    : TypeOfName<
        Rest,
        `${Taken}${C}`,
        `${Taken}${C}` extends infer Name extends DeviceName ? TypeOfNumber<Name, Rest> : Found
      >
  : Found

/** The number of a device, and what stands behind it. */
type TypeOfNumber<Name extends DeviceName, T extends string> =
  WithoutDigits<T, DigitsOf[DeviceTable[Name]['radix']]> extends infer Rest extends string
    ? Rest extends T
      ? never
      : TypeOfRest<DeviceTable[Name]['unit'], WithoutIndex<Rest>>
    : never

/** What is behind the digits in front; all of it when there are none. */
type WithoutDigits<T extends string, D extends string> = T extends `${infer C}${infer Rest}`
  ? C extends D
    ? WithoutDigits<Rest, D>
    : T
  : T

/** `D100Z2` and `D100LZ2` are of the type of D100. */
type WithoutIndex<T extends string> = T extends `${'Z' | 'LZ'}${infer Index}`
  ? WithoutDigits<Index, Digit> extends infer Rest extends string
    ? Rest extends Index
      ? T
      : Rest
    : never
  : T

/** `D100.F`: words have bits. */
type TypeOfRest<Unit extends keyof DefaultTypes, T extends string> = T extends ''
  ? DefaultTypes[Unit]
  : Unit extends 'word'
    ? T extends `.${DigitsOf[16]}`
      ? DefaultTypes['bit']
      : never
    : never

/** Spaces around say nothing: those that input methods and spreadsheets leave, too. */
export type Trim<T extends string> = T extends `${Space}${infer Rest}`
  ? Trim<Rest>
  : T extends `${infer Rest}${Space}`
    ? Trim<Rest>
    : T

/** What JavaScript trims. */
type Space =
  | ' '
  | '\t'
  | '\n'
  | '\v'
  | '\f'
  | '\r'
  | '\u00a0'
  | '\u1680'
  | '\u2000'
  | '\u2001'
  | '\u2002'
  | '\u2003'
  | '\u2004'
  | '\u2005'
  | '\u2006'
  | '\u2007'
  | '\u2008'
  | '\u2009'
  | '\u200a'
  | '\u2028'
  | '\u2029'
  | '\u202f'
  | '\u205f'
  | '\u3000'
  | '\ufeff'
