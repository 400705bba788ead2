// The public names of this room.
export type { RequestEvent } from './connection'
export type { Cpu, CpuState, Hold, StateChange, SwitchPosition } from './cpu'
export type { ErrorLog, LoggedError } from './error-log'
export { type FaultKind, type FaultParameter, faultKinds } from './fault-kinds'
export type { ActiveFault, Fault, FaultAim, FaultSubject, Faults } from './faults'
export type { OpenFile } from './files'
export type { ProgramLabels, SimulatedLabel, SimulatedLabels } from './labels'
export type { ExtensionMemory } from './memory'
export type { PlcSimulatorOptions, PortOptions } from './options'
export {
  type DemoPlant,
  type DemoPlantOptions,
  demoPlantTags,
  type PlantTag,
  type PlantTagName,
  type PlantVariant,
  plantVariantOf,
  startDemoPlant,
} from './plant'
export type { ProgramFiles } from './program-files'
export type { ProgramMemory } from './program-memory'
export {
  type ConnectionInfo,
  type ConnectOptions,
  createPlcSimulator,
  type Endpoint,
  type OnDemandData,
  type OnDemandOptions,
  type PlcSimulator,
  type SimulatorEvents,
  type WriteEvent,
} from './server'
export type { SimulatedDrive, SimulatedDrives, SimulatedFile } from './simulated-drive'
export type { SimulatorStatistics } from './statistics'
