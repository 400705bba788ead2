// The public names of this room.
export { type BottlingHost, type BottlingTagName, demoBottlingTags, startDemoBottling } from './bottling'
export type { RequestEvent } from './connection'
export type { CpuState, Hold, StateChange, SwitchPosition } from './cpu'
export type { LoggedError } from './error-log'
export type { FaultAction, JwFaultAction, JwFaultKind, MelsecFaultKind } from './fault-kinds'
export {
  type ChoiceParameter,
  type FaultDescription,
  type FaultKind,
  type FaultParameter,
  faultKinds,
  type NumberParameter,
} from './fault-kinds'
export type { ActiveFault, AnyAction, Fault, FaultAim, FaultSubject } from './faults'
export type { OpenFile } from './files'
export type { SimulatedBuffer, SimulatedRingBuffer } from './jw/buffers'
export type { JwRequestEvent } from './jw/connection'
export type { JwStateChange, JwWriteMode, SimulatedJwCpu } from './jw/cpu'
export type { JwSimulatorOptions } from './jw/options'
export type { JwProgramMemory } from './jw/program-memory'
export {
  createJwSimulator,
  type JwSimulator,
  type JwSimulatorEvents,
  type JwWriteEvent,
  type ProgramRingBuffers,
} from './jw/server'
export type { SimulatedTimer, SimulatedTimers } from './jw/timers'
export type { JwUnitKind, OptionUnitState, SimulatedOptionUnit } from './jw/units'
export type { SimulatedLabel, SimulatedLabels } from './labels'
export {
  createLineSimulator,
  type LineEvents,
  type LineFrameDetails,
  type LineHost,
  type LineSimulator,
  type LineSimulatorOptions,
  type LineSpeed,
  type LineStationOptions,
  type SimulatedStation,
  type StationEvents,
} from './line'
export type { ConnectionEvent, ConnectionInfo, ConnectOptions, Endpoint, PortOptions } from './listening'
export type { ExtensionMemory } from './memory'
export type { PlcSimulatorOptions } from './options'
export {
  type DemoPlant,
  type DemoPlantOptions,
  demoPlantTags,
  type PlantHost,
  type PlantTag,
  type PlantTagName,
  type PlantVariant,
  plantVariantOf,
  startDemoPlant,
} from './plant'
export type {
  FaultSwitches,
  ProgramFiles,
  ProgramLabels,
  ProgramMemory,
  SimulatedCpu,
  SimulatedErrors,
} from './program'
export {
  createPlcSimulator,
  type OnDemandData,
  type OnDemandOptions,
  type PlcSimulator,
  type SimulatorEvents,
  type WriteEvent,
} from './server'
export type { SimulatedDrive, SimulatedDrives, SimulatedFile } from './simulated-drive'
export type { SimulatorStatistics } from './statistics'
