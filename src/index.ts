/// <reference types="node" preserve="true" />
// The public names. No code.

export { headOfError, nameResults } from './client/about'
export type { BufferMemory } from './client/buffer-memory'
export type { CallOptions } from './client/call'
export type {
  ClientEvents,
  Items,
  ItemValue,
  NumberArray,
  OnDemand,
  ReadPlan,
  ReadValue,
  UnsolicitedFrame,
  WriteEntry,
  WritePlan,
  WriteValue,
  WriteValues,
} from './client/client-types'
export type { ConnectionState } from './client/connection'
export type {
  ClearMode,
  Control,
  Identity,
  IdentityWarning,
  LatchClearOptions,
  PauseOptions,
  RunOptions,
  StopOptions,
} from './client/control'
export type {
  CopyOptions,
  FileData,
  FileEntry,
  FileOptions,
  FilePath,
  FileProgress,
  FileReadOptions,
  Files,
  FileWriteOptions,
} from './client/files'
export type { ItemExplanation, LabelExplanation } from './client/label-explain'
export type {
  LabelFormat,
  LabelItem,
  LabelItemOptions,
  LabelOptions,
  LabelReadResult,
  Labels,
  LabelValue,
  LabelWriteResult,
} from './client/labels'
export { createMelsecClient, MelsecClient } from './client/melsec-client'
export type { Monitor } from './client/monitor'
export type { RequestExplanation } from './client/named-request'
export type { MelsecClientOptions } from './client/options'
export {
  type DeviceExplanation,
  formatItem,
  type Item,
  type ItemOptions,
  type ParsedItem,
  type PlanDescription,
  parseItem,
  type ReadResult,
  type RefusedItem,
  type RequestDescription,
  tryParseItem,
  type WriteOptions,
} from './client/plan'
export type { RoundTrip, Statistics } from './client/statistics'
export type { ConnectionStateName } from './client/supervisor'
export type { TraceEntry } from './client/trace'
export type { DataCode, Declaration, Effect, FieldDescription, MessageInput, MessageOf } from './codec/codec'
export { describe as describeFields } from './codec/codec'
export {
  ClosedError,
  ConnectionError,
  EndCodeError,
  type Outcome,
  PlcError,
  type PlcErrorCode,
  type PlcErrorData,
  ProtocolError,
  plcErrorFrom,
  RequestError,
  TimeoutError,
  UnfinishedError,
  VerifyError,
  WriteError,
  type WriteResult,
} from './errors'
export { explainJwFrame } from './jw/explain-frame'
export { type ACompatibleCommandName, type ACompatibleCommands, aCompatibleCommands } from './melsec/a-compatible'
export { type AddressOptions, formatDevice, type ParsedDevice, parseDevice } from './melsec/address'
export type { RequestOf, ResponseOf } from './melsec/command'
export { type CommandDescription, commandNamed, describeCommand } from './melsec/command-name'
export { type CommandName, type Commands, commands } from './melsec/commands/commands'
export { unsolicitedCommands } from './melsec/commands/on-demand'
export { type DeviceAddress, type DeviceInfo, type DeviceName, deviceInfo, devices } from './melsec/device'
export type { Notation } from './melsec/device-json'
export {
  type EndCodeExplanation,
  type ExplainOptions,
  endCodes,
  explainEndCode,
  type Language,
  languages,
} from './melsec/end-code'
export { explainFrame, formatExplanation } from './melsec/explain-frame'
export { type ExtendUnitInfo, extendUnits, type ModulePlace } from './melsec/extend-unit'
export { type FileTime, fileTimeOf, formatFileTime, isFileTime } from './melsec/file-time'
export { answerToJson, messageFromJson, messageToJson, type ToJsonOptions } from './melsec/message-json'
export { modelCodes, modelOf } from './melsec/model-code'
export {
  type DeviceForm,
  type Drive,
  type FileFacts,
  type FrameName,
  type Profile,
  type ProfileId,
  type ProfileOverrides,
  profileIds,
  profiles,
  resolveProfile,
  type TransportName,
} from './melsec/profile'
export type { ExchangeOptions } from './melsec/protocol'
export { isPortLocked } from './melsec/remote-password'
export { moduleIoNumbers, type Route } from './melsec/route'
export * from './simulator/simulator'
export type { Clock } from './transport/clock'
export type { OpenTransport, Transport, TransportHandlers } from './transport/transport'
export {
  bytesOfText,
  type Encoding,
  encodings,
  formatType,
  type PlcValue,
  parseType,
  type TypeName,
  textOfBytes,
  typeNames,
  type ValueFormat,
  type ValueOf,
  type ValueType,
  valueOfBytes,
  valueTypes,
} from './value/value'
