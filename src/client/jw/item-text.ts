/**
 * What the compiler reads out of the text of an item of a Sharp JW, as `parseJwItem` reads it: the type of its values, and whether
 * they are one or many. What it cannot tell is unknown, never a guess. It may take a text that is refused: then there is no value.
 */
import type { ByteTypeName, ByteTypeNamed, ByteTypeToValue, ByteTypeToWritten } from '../../value/byte-type'
import type { PlcValue } from '../../value/type'
import type { IsWritten, Trim } from '../item/item-text'
import type { Counted, CountedInput, ReadValue, WriteValue } from '../item/item-value'
import type { Item, ItemOptions } from '../item/parts'
import type { JwDefaultTypes } from './item'

interface Facts<T extends ByteTypeName = ByteTypeName, N extends HowMany = HowMany> {
  /** `never` when it is not known. */
  readonly type: T
  readonly count: N
}
type HowMany = 'one' | 'many' | 'unknown'

type FactsOf<I extends Item> = string extends I
  ? Facts<never, 'unknown'>
  : I extends string
    ? FactsOfText<Trim<I>>
    : I extends ItemOptions
      ? WithCount<I, WithType<I, FactsOf<I['address']>>>
      : never

type WithType<I extends ItemOptions, F extends Facts> = I extends { readonly type: infer T extends string }
  ? Facts<ByteTypeNamed<T>, F['count']>
  : 'type' extends keyof I
    ? Facts<never, F['count']>
    : F

type WithCount<I extends ItemOptions, F extends Facts> = I extends { readonly count: number }
  ? Facts<F['type'], 'many'>
  : 'count' extends keyof I
    ? Facts<F['type'], 'unknown'>
    : F

/** The colon of a file stands in front of a digit. */
type FactsOfText<T extends string> = T extends `${infer Before}:${infer Behind}`
  ? Trim<Behind> extends `${Digit}${string}`
    ? Uppercase<Before> extends `F${string}`
      ? FactsOfFile<Behind>
      : Facts<never, 'unknown'>
    : Typed<Before, Behind>
  : FactsOfOperand<T>

/** Behind `F1:`; of a range also what stands behind its second file. */
type FactsOfFile<T extends string> = T extends `${infer First}..${infer Last}`
  ? Last extends `${string}:${infer Behind}`
    ? Behind extends `${string}:${infer Type}`
      ? Facts<TypeIn<Type>, 'many'>
      : Facts<IsWritten<Behind> extends true ? BitOrByte<First> : never, 'many'>
    : Facts<never, 'unknown'>
  : T extends `${infer Byte}:${infer Type}`
    ? Typed<Byte, Type>
    : WithBrackets<T> extends [infer Byte extends string, infer N extends HowMany]
      ? Facts<BitOrByte<Byte>, N>
      : Facts<never, 'unknown'>

/** What is in front of a colon, and a type behind it. */
type Typed<Before extends string, T extends string> = Facts<
  TypeIn<T>,
  Before extends `${string}..${string}`
    ? 'many'
    : T extends `${string}[${number}]`
      ? 'many'
      : IsWritten<Before> extends true
        ? IsWritten<T> extends true
          ? 'one'
          : 'unknown'
        : 'unknown'
>

/** The type behind a colon. The brackets of `Word [Signed]` are no count. */
type TypeIn<T extends string, Before extends string = ''> = T extends `${infer A}[${infer B}`
  ? B extends `${number}]`
    ? ByteTypeNamed<Trim<`${Before}${A}`>>
    : TypeIn<B, `${Before}${A}[`>
  : ByteTypeNamed<Trim<`${Before}${T}`>>

type FactsOfOperand<T extends string> = T extends `${infer First}..${infer Last}`
  ? Facts<IsWritten<Last> extends true ? DefaultType<First> : never, 'many'>
  : WithBrackets<T> extends [infer Operand extends string, infer N extends HowMany]
    ? Facts<DefaultType<Operand>, N>
    : Facts<never, 'unknown'>

/** `09012[10]`, `09012,10`. */
type WithBrackets<T extends string> = T extends `${infer Operand}[${number}]`
  ? [Operand, 'many']
  : T extends `${infer Operand},${number}`
    ? [Operand, 'many']
    : [T, IsWritten<T> extends true ? 'one' : 'unknown']

type Octal = '0' | '1' | '2' | '3' | '4' | '5' | '6' | '7'
type Digit = Octal | '8' | '9'

/** The type of an operand that says none. */
type DefaultType<T extends string> =
  Trim<Uppercase<T>> extends infer U extends string
    ? U extends `${'TMR' | 'CNT' | 'MD'}${string}`
      ? JwDefaultTypes['timer']
      : U extends `T-C${string}`
        ? JwDefaultTypes['bit']
        : U extends `${'KO' | 'コ' | 'ｺ' | 'B' | 'E' | '#'}${string}`
          ? BitOrByte<U>
          : U extends `${Digit}${string}`
            ? BareNumber<U>
            : never
    : never

/** With a 9 it is a register, of octal digits alone a relay. */
type BareNumber<T extends string> = T extends `${string}9${string}`
  ? BitOrByte<T>
  : OnlyOctal<T> extends true
    ? JwDefaultTypes['bit']
    : never

type OnlyOctal<T extends string> = T extends '' ? true : T extends `${Octal}${infer Rest}` ? OnlyOctal<Rest> : false

type BitOrByte<T extends string> =
  IsWritten<T> extends true
    ? T extends `${string}.${Octal}`
      ? JwDefaultTypes['bit']
      : T extends `${string}.${string}`
        ? never
        : JwDefaultTypes['byte']
    : never

/**
 * The type of the value of an item of a Sharp JW, as far as its text says it: `004033` boolean, `09012` number, `09012:REAL[4]`
 * number[]; where nobody can know it any {@link ReadValue}.
 */
export type JwItemValue<I> = I extends Item ? ValueRead<FactsOf<I>> : ReadValue

type ValueRead<F extends Facts> = [F['type']] extends [never]
  ? F['count'] extends 'unknown'
    ? ReadValue
    : Counted<F['count'], PlcValue>
  : Counted<F['count'], ByteTypeToValue[F['type']]>

/** What may be written to an item of a Sharp JW, as far as its text says it; where nobody can know it any {@link WriteValue}. */
export type JwItemInput<I> = I extends Item ? ValueWritten<FactsOf<I>> : WriteValue

type ValueWritten<F extends Facts> = [F['type']] extends [never]
  ? F['count'] extends 'unknown'
    ? WriteValue
    : CountedInput<F['count'], PlcValue>
  : CountedInput<F['count'], ByteTypeToWritten[F['type']]>
