// The operands of the bottling line of the demo, as data: the program, the demo flow, the examples and the documentation read them.
import { RequestError } from '../errors'
import type { PlantTag } from './plant-tags'

type Row = Omit<PlantTag<string>, 'writable'> & { readonly writable?: true }

const ROWS = [
  { name: 'start', address: '004000', title: 'Start button', writable: true },
  { name: 'stop', address: '004001', title: 'Stop button', writable: true },
  { name: 'acknowledge', address: '004002', title: 'Acknowledge the alarms', writable: true },
  { name: 'running', address: '004010', title: 'Automatic operation is on' },
  { name: 'alarm', address: '004020', title: 'Alarm' },
  { name: 'recipeAlarm', address: '004021', title: 'Alarm: the recipe is out of range' },
  { name: 'rejectAlarm', address: '004022', title: 'Alarm: too many rejected bottles in a row' },
  { name: 'supplyAlarm', address: '004023', title: 'Alarm: the supply tank is empty' },
  { name: 'bottlePresent', address: '000000', title: 'Sensor: a bottle is under the filler' },
  { name: 'supplyPump', address: '000100', title: 'Supply pump on' },
  { name: 'conveyor', address: '000101', title: 'Conveyor on' },
  { name: 'fillValve', address: '000102', title: 'Filling valve open' },
  { name: 'rejecter', address: '000103', title: 'Rejecter out' },
  { name: 'bottles', address: '09000:UDINT', title: 'Bottles that have left the filler' },
  { name: 'good', address: '09004:UDINT', title: 'Good bottles' },
  { name: 'rejected', address: '09010:UDINT', title: 'Rejected bottles' },
  { name: 'fillLevel', address: '09014:UINT', title: 'Content of the bottle under the filler', unit: 'ml' },
  { name: 'lastFill', address: '09016:UINT', title: 'Content of the last bottle', unit: 'ml' },
  { name: 'supply', address: '09020:REAL', title: 'Level of the supply tank', unit: '%' },
  { name: 'shiftCount', address: '09024:BCD32', title: 'Good bottles, in BCD, for the display' },
  { name: 'phase', address: '09030', title: '0 stopped, 1 conveying, 2 filling, 3 settling' },
  { name: 'scans', address: '09032:UDINT', title: 'Scans of the program: counts while the PLC runs' },
  {
    name: 'bottleSize',
    address: '19000:UINT',
    title: 'Recipe: content',
    unit: 'ml',
    writable: true,
    min: 100,
    max: 2000,
  },
  {
    name: 'tolerance',
    address: '19002:UINT',
    title: 'Recipe: tolerance',
    unit: 'ml',
    writable: true,
    min: 1,
    max: 100,
  },
  {
    name: 'conveyorSpeed',
    address: '19004:UINT',
    title: 'Recipe: speed of the conveyor',
    unit: 'mm/s',
    writable: true,
    min: 50,
    max: 500,
  },
  {
    name: 'settlingTime',
    address: '19006:UINT',
    title: 'Recipe: time before a bottle moves on',
    unit: 'ms',
    writable: true,
    min: 0,
    max: 5000,
  },
  { name: 'product', address: '19010:STRING(16)', title: 'Product', writable: true },
  {
    name: 'productJa',
    address: '19030:STRING(20)',
    title: 'Product, in Japanese (Shift-JIS)',
    writable: true,
    encoding: 'shift-jis',
  },
] as const satisfies readonly Row[]

/** Names of the values of the bottling line. */
export type BottlingTagName = (typeof ROWS)[number]['name']

const rows: readonly (Row & { readonly name: BottlingTagName })[] = ROWS

/** Every tag of the bottling line. */
export const demoBottlingTags: readonly PlantTag<BottlingTagName>[] = rows.map(({ writable, ...row }) => ({
  ...row,
  writable: writable === true,
}))

/**
 * One tag.
 * @throws RequestError BAD_OPTION when there is no such tag
 */
export function bottlingTag(name: BottlingTagName): PlantTag<BottlingTagName> {
  const tag = demoBottlingTags.find((candidate) => candidate.name === name)
  if (tag === undefined) throw new RequestError('BAD_OPTION', `The bottling line has no ${String(name)}.`, 'name')
  return tag
}
