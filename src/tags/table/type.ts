/** What is to be known of the types of tags: those of words, and of PLCs whose registers are bytes. */
import { type ByteType, byteTypes, isWordType } from '../../value/byte-type'
import { type TypeInfo, valueTypes } from '../../value/type'

/** How the values of a type are kept, and their range where they are whole numbers. */
export function infoOf(type: ByteType): Pick<TypeInfo, 'kind' | 'min' | 'max'> {
  return isWordType(type) ? valueTypes[type.name] : byteTypes[type.name]
}

/** Whether values of the type are numbers, which can be scaled and limited. */
export function isNumberType(type: ByteType): boolean {
  const { kind } = infoOf(type)
  return kind !== 'bit' && kind !== 'text'
}
