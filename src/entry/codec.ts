/// <reference types="node" preserve="true" />
// The public names of `@melsec-jw/plc/codec`: frames, commands and messages, for those who have bytes. No code.

export type { AnnotatedRow, FrameFault } from '../codec/annotate'
export type {
  DataCode,
  Declaration,
  Effect,
  FieldDescription,
  Message,
  MessageInput,
  MessageOf,
  Shape,
} from '../codec/codec'
export { describe as describeFields } from '../codec/codec'
export type { Direction, FrameExplanation } from '../codec/explanation'
export type { Count } from '../codec/field'
export type { JwAddress, JwExtendedAddress } from '../jw/address'
export { type JwCommandConfidence, type JwModel, jwModels } from '../jw/commands/command'
export {
  describeJwCommand,
  type JwCommandDescription,
  jwCommandNamed,
} from '../jw/commands/command-name'
export { type JwCommand, type JwCommandName, type JwCommands, jwCommands } from '../jw/commands/commands'
export { jwAnswerToJson, jwMessageFromJson, jwMessageToJson } from '../jw/commands/message-json'
export { type ExplainJwOptions, explainJwFrame } from '../jw/explain-frame'
export { type Dl1Settings, dl1Parameters } from '../jw/parameters/dl1'
export { type Dl9Settings, type Dl9Slave, type Dl9Switches, dl9Parameters } from '../jw/parameters/dl9'
export {
  type FlNetAddress,
  type FlNetSettings,
  type FlNetSettingsRead,
  flNetParameters,
  type ParametersInDataMemory,
} from '../jw/parameters/fl-net'
export type { ParameterAddress, StoredAddress } from '../jw/parameters/memory-address'
export { fromClassicAddress, toClassicAddress } from '../jw/parameters/parameter-area'
export type {
  ParameterMap,
  ParameterProblem,
  ParameterRow,
  ReadParameters,
  WrittenParameters,
} from '../jw/parameters/parameter-map'
export { serialInterfaceProblems } from '../jw/parameters/serial-interface-unit'
export { type UnitError, unitErrors } from '../jw/parameters/unit-errors'
export { type UnitNumbers, unitNumbers } from '../jw/parameters/unit-number'
export {
  type ACompatibleCommandName,
  type ACompatibleCommands,
  aCompatibleCommands,
} from '../melsec/a-compatible/commands'
export type { Command, RequestOf, ResponseOf } from '../melsec/commands/command'
export { type CommandDescription, commandNamed, describeCommand } from '../melsec/commands/command-name'
export { type CommandName, type Commands, commands } from '../melsec/commands/commands'
export { answerToJson, messageFromJson, messageToJson, type ToJsonOptions } from '../melsec/commands/message-json'
export { unsolicitedCommands } from '../melsec/commands/on-demand'
export type { DeviceForm } from '../melsec/device/device-form'
export type { Notation } from '../melsec/device/json'
export { explainFrame, formatExplanation } from '../melsec/explain/frame'
export type { ExplainFrameOptions } from '../melsec/explain/options'
export { controlCodes, type SerialFormat, type SerialFrameName } from '../melsec/frame/serial-frames'
