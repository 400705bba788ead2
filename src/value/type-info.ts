// The table of types as users see it: what each is, and not the very texts and numbers as types.
import { type TypeInfo, type TypeName, valueTypes as table } from './type'

/** Every type: words, range and spellings. */
export const valueTypes: Readonly<Record<TypeName, TypeInfo>> = table
