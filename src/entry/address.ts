// The public names of `@melsec-jw/plc/address`: addresses, operands, items and types as texts and data. No code. Nothing behind it needs
// Node.js, so that an editor can check what is typed in a browser.

export {
  formatItem,
  type ItemParseOptions,
  type ParsedItem,
  parseItem,
  type RefusedItem,
  tryParseItem,
} from '../client/item/item'
export { type DeviceOffset, moveItem } from '../client/item/move'
export type { Item, ItemOptions } from '../client/item/parts'
export {
  formatJwItem,
  type JwItemOptions,
  type ParsedJwItem,
  parseJwItem,
  tryParseJwItem,
} from '../client/jw/item'
export { type JwOffset, moveJwItem } from '../client/jw/move'
export { RequestError, type RequestErrorCode } from '../errors'
export { assumedJwAreas, type JwArea, type JwConfidence, jwAreas } from '../jw/operand/area'
export { type JwKindName, type JwOperandKind, type JwUnit, jwKinds } from '../jw/operand/kind'
export type { JwOperandOptions } from '../jw/operand/map'
export { formatJwOperand, type JwOperand } from '../jw/operand/notation'
export { parseJwOperand } from '../jw/operand/parse'
export { type JwFilePlace, type JwPlace, placeOfJw } from '../jw/operand/place'
export { type AddressOptions, formatDevice, type ParsedDevice, parseDevice } from '../melsec/device/address'
export {
  type DeviceAddress,
  type DeviceExtension,
  type DeviceInfo,
  type DeviceName,
  type DeviceRow,
  type DeviceUnit,
  deviceInfo,
  devices,
  type ExtensionKind,
  type TimerPart,
} from '../melsec/device/device'
export {
  type ByteName,
  type ByteType,
  type ByteTypeName,
  byteTypes,
  formatByteType,
  parseByteType,
} from '../value/byte-type'
export { type Encoding, encodings, type ValueFormat } from '../value/format'
export {
  formatType,
  type PlcValue,
  parseType,
  type TypeInfo,
  type TypeName,
  typeNames,
  type ValueOf,
  type ValueType,
} from '../value/type'
export { valueTypes } from '../value/type-info'
