/// <reference types="node" preserve="true" />
// The public names. No code.

export type { CallOptions } from './client/connection/call'
export type { ConnectionState } from './client/connection/connection'
export type { ReconnectOptions } from './client/connection/option-checks'
export type { RoundTrip, Statistics } from './client/connection/statistics'
export type { ConnectionStateName, Phase } from './client/connection/supervisor'
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
export type { WriteMode } from './client/file/write'
export { headOfError, type ItemResult, nameResults } from './client/item/about'
export type {
  AnyItems,
  EntriesIn,
  InputIn,
  InputsIn,
  ItemTyping,
  MelsecItems,
  ResultsIn,
  ValueIn,
  ValuesIn,
} from './client/item/item-typing'
export type {
  ItemInput,
  ItemInputs,
  ItemResults,
  Items,
  ItemValue,
  ItemValues,
  NumberArray,
  ReadResult,
  ReadValue,
  WriteEntries,
  WriteEntry,
  WriteValue,
  WriteValues,
} from './client/item/item-value'
export type { Item, ItemOptions } from './client/item/parts'
export type {
  JwBuffers,
  JwRingBuffers,
  JwRingData,
  JwRingOptions,
  JwRingWritten,
  JwSpecifiedBuffers,
} from './client/jw/buffers'
export type { JwClient, JwClientEvents, JwInfo, JwItemTypes, JwMemorySize } from './client/jw/client'
export type { JwAdjustOptions, JwClock, JwClockTime } from './client/jw/clock'
export {
  type JwControl,
  type JwRunState,
  type JwStopOptions,
  type JwWriteModeName,
  jwWriteModes,
} from './client/jw/control'
export { findJwHeader, type JwHeaderFound, type JwHeaderTried } from './client/jw/find-header'
export type { JwItemExplanation } from './client/jw/item-access'
export type { JwItemInput, JwItemValue } from './client/jw/item-text'
export { createJwClient } from './client/jw/jw-client'
export type { JwRequestExplanation } from './client/jw/named-request'
export {
  type JwClientOptions,
  type JwProbeKind,
  type JwTransportName,
  jwProbeKinds,
  jwTransportNames,
} from './client/jw/options'
export type {
  JwOptionParameters,
  JwParameters,
  JwSpecialIoParameters,
  JwStarted,
  JwUnitPlace,
} from './client/jw/parameters'
export type { JwSecret } from './client/jw/secret'
export type { JwRequestOf, JwResponseOf } from './client/jw/send-command'

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
export type { MelsecClient } from './client/melsec/client'
export type { ClientEvents, OnDemand, UnsolicitedFrame } from './client/melsec/client-events'
export type {
  ClearMode,
  Control,
  GlobalSignalOptions,
  Identity,
  IdentityWarning,
  LatchClearOptions,
  PauseOptions,
  RunOptions,
  StopOptions,
} from './client/melsec/control'
export { createMelsecClient } from './client/melsec/melsec-client'
export type { RequestExplanation } from './client/melsec/named-request'
export type {
  MelsecClientOptions,
  MelsecOptions,
  NetworkPlc,
  PlcOnLine,
  RouteOptions,
  SerialPlc,
} from './client/melsec/options'
export { type ProbeKind, probeKinds } from './client/melsec/probes'
export { createMelsecLine, type MelsecLine, type MelsecLineOptions } from './client/melsec/serial-line'
export type { SerialFrameDetails, SerialLineFormat, SerialPortOptions } from './client/melsec/serial-options'
export type { DeviceExplanation } from './client/plan/explain'
export type { Monitor } from './client/plan/monitor'
export type { ReadPlan, WritePlan } from './client/plan/plans'
export type { PlcClient, PlcEvents, WatchedIn } from './client/plan/plc-client'
export type {
  PlcTags,
  TagInputIn,
  TagInputsIn,
  TagName,
  TagResultsIn,
  TagsOptions,
  TagValueIn,
  TagValuesIn,
  TagWatchOptions,
  WatchedTagsIn,
  WritableTagName,
} from './client/plan/plc-tags'
export type { PlanDescription, RequestDescription } from './client/plan/request'
export type { WriteCallOptions, WriteOptions } from './client/plan/write'
export { type ExplainedItem, tagReaderOf } from './client/tags/tag-reader'
export type { Watch, WatchedName, WatchGap, WatchOptions, WatchStatistics, WatchUpdate } from './client/watch/watch'
export type { WatchedValue } from './client/watch/watched-value'
export type { DataCode, Declaration, Effect, MessageInput, MessageOf, Shape } from './codec/codec'
export {
  type ExplainCodeOptions,
  type ExplainOptions,
  explainEndCode,
  meaningsOfEndCode,
} from './end-code/explain'
export {
  type CauseData,
  ClosedError,
  type ClosedErrorCode,
  ConnectionError,
  type ConnectionErrorCode,
  type EndCodeAbout,
  type EndCodeDetail,
  EndCodeError,
  type EndCodeErrorCode,
  type EndCodeFamily,
  endCodeFamilies,
  type Outcome,
  PlcError,
  type PlcErrorCode,
  type PlcErrorData,
  ProtocolError,
  type ProtocolErrorCode,
  type ProtocolErrorDetail,
  RequestError,
  type RequestErrorCode,
  TimeoutError,
  type TimeoutErrorCode,
  UnfinishedError,
  type UnfinishedErrorCode,
  VerifyError,
  type VerifyErrorCode,
  WriteError,
  type WriteErrorCode,
  type WriteResult,
} from './errors'
export { plcErrorFrom } from './errors/from-data'
export type { JwAddress, JwExtendedAddress } from './jw/address'
export { type JwModel, jwModels } from './jw/commands/command'
export type { JwHeader, JwRelay } from './jw/header'
export { assumedJwAreas, type JwArea, type JwConfidence, jwAreas } from './jw/operand/area'
export type { ParameterBlock } from './jw/parameters/parameter-area'
export type { Command, RequestOf, ResponseOf } from './melsec/commands/command'
export type { CommandName, Commands } from './melsec/commands/commands'
export type { DeviceAddress, DeviceExtension, DeviceName, DeviceUnit, Radix } from './melsec/device/device'
export type { DeviceForm } from './melsec/device/device-form'
export type { Notation } from './melsec/device/json'
export type { LimitUnit } from './melsec/device/limit-rule'
export {
  type EndCodeExplanation,
  endCodes,
  type Language,
  languages,
  type MelsecEndCodeFamily,
  melsecEndCodeFamilies,
} from './melsec/end-codes/end-code'
export type { EndCodeEntry } from './melsec/end-codes/entry'
export type { RemedyName } from './melsec/end-codes/remedies'
export type { Texts } from './melsec/end-codes/texts'
export { type ExtendUnitInfo, extendUnits, type ModulePlace } from './melsec/extend-unit'
export { type FileTime, fileTimeOf, formatFileTime, isFileTime } from './melsec/file/time'
export { type EthernetFrameName, ethernetFrameNames, type FrameName, frameNames } from './melsec/frame/frames'
export { type ModuleIoNumber, moduleIoNumbers, type Route } from './melsec/frame/route'
export { type SerialFormat, type SerialFrameName, serialFrameNames } from './melsec/frame/serial-frames'
export { type Model, modelCodes, modelOf, type Series } from './melsec/model-code'
export { profiles, resolveProfile } from './melsec/profiles/info'
export {
  type Connections,
  type Drive,
  type FileInfo,
  type InFlight,
  type Lack,
  type LastIndex,
  type LimitOverrides,
  type MonitoringTimer,
  type ProfileId,
  type ProfileInfo,
  type ProfileOverrides,
  profileIds,
  type Reach,
  type RemoteFacts,
  type StatusRegister,
  type TransportName,
  transportNames,
} from './melsec/profiles/profile'
export type { SerialFacts } from './melsec/profiles/serial-facts'
export type { ExchangeOptions } from './melsec/protocol'
export { isPortLocked } from './melsec/remote-password'
export type {
  ChannelDevices,
  ChannelNumber,
  CpuChannels,
  Fx3Aliases,
  Fx5ChannelDevices,
  SerialChannels,
  SpecialDevice,
} from './melsec/serial-channels'
export {
  diffTags,
  mergeTags,
  type TagChange,
  type TagConflict,
  type TagDifference,
  type TagFieldChange,
  type TagMergeOptions,
} from './tags/diff'
export type { CellDelimiter } from './tags/files/cells'
export type { CsvOptions } from './tags/files/csv'
export { type TagFileEncoding, tagFileEncodings } from './tags/files/encoding'
export { exportTags, type TagExport, type TagExportMessage, type TagExportOptions } from './tags/files/export'
export { importTags } from './tags/files/import'
export {
  type TagFileKind,
  type TagImport,
  type TagImportOptions,
  type TagMessage,
  tagFileKinds,
} from './tags/files/result'
export {
  problemsOfTags,
  type ReadTagItem,
  type TagCheckOptions,
  type TagFacts,
  type TagProblem,
  textOfProblem,
} from './tags/table/check'
export { hasChanged, type TagValue, thresholdOf } from './tags/table/deadband'
export { type MoveAddress, type TagMachine, tagsOfMachine } from './tags/table/machine'
export { engineeringOf, type ScaledValue } from './tags/table/scaling'
export { defineTags, type TagDefinition, type TagDefinitions, type TagTable, tagTable } from './tags/table/table'
export {
  type Deadband,
  itemOfTag,
  type Scaling,
  type Tag,
  type TagAccess,
  type TagField,
  type TagFields,
  type TagItem,
  tagFields,
} from './tags/table/tag'
export { type RawWrite, rawValueOf } from './tags/table/write'
export type { Clock, TimerOptions } from './transport/clock'
export { type BaudRate, baudRates, type SerialOptions } from './transport/serial'
export { type SerialPortInfo, serialPorts } from './transport/serial-ports'
export type { OpenTransport, Transport, TransportHandlers } from './transport/transport'
export type { TextName, TypeToValue } from './value/type'
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
