/** Typed values over words of 16 bits: the public names of this room. */
export { valueOfBytes } from './bytes'
export { decodeArray, decoderOf, decodeValue, encodeArray, encodeValue } from './convert'
export { checkFormat, type Encoding, encodings, formatOptions, type ValueFormat } from './format'
export { bytesOfText, textOfBytes } from './text'
export {
  formatType,
  maxTextLength,
  type PlcValue,
  parseType,
  type TypeName,
  type TypeNamed,
  type TypeToValue,
  type TypeToWritten,
  typeNames,
  type ValueOf,
  type ValueType,
  valueTypes,
  wordsOf,
} from './type'
export { bitOf, type Words } from './word'
