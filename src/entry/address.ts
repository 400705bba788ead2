// The public names of `@melsec-jw/plc/address`: addresses, items and types as texts and data. No code. Nothing behind it needs
// Node.js, so that an editor can check what is typed in a browser.

export {
  formatItem,
  type ItemParseOptions,
  type ParsedItem,
  parseItem,
  type RefusedItem,
  tryParseItem,
} from '../client/item/item'
export type { Item, ItemOptions } from '../client/item/parts'
export { RequestError, type RequestErrorCode } from '../errors'
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
