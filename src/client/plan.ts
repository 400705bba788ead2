// The public names of the planner.
export {
  formatItem,
  type Item,
  type ItemOptions,
  type ItemParseOptions,
  type ParsedItem,
  parseItem,
  type RefusedItem,
  tryParseItem,
} from './item'
export { type DeviceExplanation, explainItem } from './plan-explain'
export { planRead, type ReadPlan, type ReadResult } from './plan-read'
export type { ReadShapeOptions as PlanReadOptions } from './plan-read-shape'
export type { PlanDescription, RequestDescription, Send } from './plan-request'
export {
  type PlanWriteOptions,
  planWrite,
  type WriteEntry,
  type WriteOptions,
  type WritePlan,
  type WriteResult,
} from './plan-write'
export type { WriteValue } from './plan-write-unit'
