/// <reference types="node" preserve="true" />
// The public names. No code.

export type { CallOptions } from './client/connection/call'
export type { ConnectionState } from './client/connection/connection'
export type { RoundTrip, Statistics } from './client/connection/statistics'
export type { ConnectionStateName } from './client/connection/supervisor'
export type { TraceEntry } from './client/connection/trace'
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
} from './client/file/files'
export { headOfError, nameResults } from './client/item/about'
export type { Item, ItemOptions } from './client/item/item'
export type {
  Items,
  ItemValue,
  NumberArray,
  ReadResult,
  ReadValue,
  WriteEntry,
  WriteValue,
  WriteValues,
} from './client/item/item-value'
export type { ItemExplanation, LabelExplanation } from './client/label/explain'
export type {
  LabelFormat,
  LabelItem,
  LabelItemOptions,
  LabelOptions,
  LabelReadResult,
  Labels,
  LabelValue,
  LabelWriteResult,
} from './client/label/labels'
export type { BufferMemory } from './client/melsec/buffer-memory'
export type { ClientEvents, OnDemand, UnsolicitedFrame } from './client/melsec/client-events'
export type {
  ClearMode,
  Control,
  Identity,
  IdentityWarning,
  LatchClearOptions,
  PauseOptions,
  RunOptions,
  StopOptions,
} from './client/melsec/control'
export { createMelsecClient, MelsecClient } from './client/melsec/melsec-client'
export type { RequestExplanation } from './client/melsec/named-request'
export type { MelsecClientOptions } from './client/melsec/options'
export type { DeviceExplanation } from './client/plan/explain'
export type { Monitor } from './client/plan/monitor'
export type { ReadPlan, WritePlan } from './client/plan/plans'
export type { PlanDescription, RequestDescription } from './client/plan/request'
export type { WriteOptions } from './client/plan/write'
export type { DataCode, Declaration, MessageInput, MessageOf } from './codec/codec'
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
export type { RequestOf, ResponseOf } from './melsec/commands/command'
export type { CommandName, Commands } from './melsec/commands/commands'
export type { DeviceAddress, DeviceName } from './melsec/device/device'
export type { DeviceForm } from './melsec/device/device-form'
export type { Notation } from './melsec/device/json'
export {
  type EndCodeExplanation,
  type ExplainOptions,
  endCodes,
  explainEndCode,
  type Language,
  languages,
} from './melsec/end-codes/end-code'
export { type ExtendUnitInfo, extendUnits, type ModulePlace } from './melsec/extend-unit'
export { type FileTime, fileTimeOf, formatFileTime, isFileTime } from './melsec/file/time'
export { moduleIoNumbers, type Route } from './melsec/frame/route'
export { modelCodes, modelOf } from './melsec/model-code'
export {
  type Drive,
  type FileFacts,
  type FrameName,
  type Profile,
  type ProfileId,
  type ProfileOverrides,
  profileIds,
  type TransportName,
} from './melsec/profiles/profile'
export { profiles, resolveProfile } from './melsec/profiles/profiles'
export type { ExchangeOptions } from './melsec/protocol'
export { isPortLocked } from './melsec/remote-password'
export type { Clock } from './transport/clock'
export type { OpenTransport, Transport, TransportHandlers } from './transport/transport'
export {
  bytesOfText,
  type Encoding,
  encodings,
  type PlcValue,
  type TypeName,
  textOfBytes,
  type ValueFormat,
  type ValueOf,
  type ValueType,
  valueOfBytes,
} from './value/value'
