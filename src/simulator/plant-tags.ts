// The addresses of the demo plant, as data: the program, the demo flow, the examples and the documentation read them.
import { RequestError } from '../errors'
import type { ProfileId } from '../melsec/profiles/profile'
import { profiles } from '../melsec/profiles/profiles'
import type { ValueFormat } from '../value/value'

/** Which of the two demo PLCs: an iQ-R, or an FX5U with octal outputs. */
export type PlantVariant = 'iq-r' | 'iq-f'

/** One value of a plant of the demo. */
export interface PlantTag<Name extends string = PlantTagName> {
  /** Name of the tag. */
  readonly name: Name
  /** Address with type, as the client takes it, e.g. `D100:REAL`. */
  readonly address: string
  /** What it is, in English. */
  readonly title: string
  /** Unit of measurement. */
  readonly unit?: string
  /** Made to be written by people; the program overwrites the others. */
  readonly writable: boolean
  /** What the program accepts. */
  readonly min?: number
  /** The most it can be. */
  readonly max?: number
  /** Character code of text, when it is not ASCII. */
  readonly encoding?: NonNullable<ValueFormat['encoding']>
}

interface TagRow {
  readonly name: string
  readonly address: string | Readonly<Record<PlantVariant, string>>
  readonly title: string
  readonly unit?: string
  readonly writable?: true
  readonly min?: number
  readonly max?: number
  readonly encoding?: NonNullable<ValueFormat['encoding']>
}

const ROWS = [
  { name: 'start', address: 'M0:BOOL', title: 'Start button', writable: true },
  { name: 'stop', address: 'M1:BOOL', title: 'Stop button', writable: true },
  { name: 'acknowledge', address: 'M2:BOOL', title: 'Acknowledge the alarm', writable: true },
  { name: 'running', address: 'M10:BOOL', title: 'Automatic operation is on' },
  { name: 'alarm', address: 'M20:BOOL', title: 'Alarm' },
  { name: 'lowLevel', address: { 'iq-r': 'X10:BOOL', 'iq-f': 'X0:BOOL' }, title: 'Float switch: tank not empty' },
  { name: 'highLevel', address: { 'iq-r': 'X1A:BOOL', 'iq-f': 'X12:BOOL' }, title: 'Float switch: tank full' },
  { name: 'inlet', address: { 'iq-r': 'Y20:BOOL', 'iq-f': 'Y0:BOOL' }, title: 'Inlet valve open' },
  { name: 'outlet', address: { 'iq-r': 'Y21:BOOL', 'iq-f': 'Y1:BOOL' }, title: 'Outlet valve open' },
  { name: 'heater', address: { 'iq-r': 'Y2A:BOOL', 'iq-f': 'Y10:BOOL' }, title: 'Heater on' },
  { name: 'agitator', address: { 'iq-r': 'Y2B:BOOL', 'iq-f': 'Y11:BOOL' }, title: 'Agitator motor on' },
  { name: 'level', address: 'D100:REAL', title: 'Level', unit: 'l' },
  { name: 'temperature', address: 'D102:REAL', title: 'Temperature', unit: '°C' },
  {
    name: 'levelSetPoint',
    address: 'D110:REAL',
    title: 'Batch size',
    unit: 'l',
    writable: true,
    min: 100,
    max: 900,
  },
  {
    name: 'temperatureSetPoint',
    address: 'D112:REAL',
    title: 'Mixing temperature',
    unit: '°C',
    writable: true,
    min: 20,
    max: 80,
  },
  { name: 'mixingTime', address: 'D114:INT', title: 'Mixing time', unit: 's', writable: true, min: 1, max: 600 },
  { name: 'recipe', address: 'D115:INT', title: 'Product of the next batch', writable: true, min: 1, max: 3 },
  { name: 'batches', address: 'D120:DINT', title: 'Batches made' },
  { name: 'batchTime', address: 'D122:TIME', title: 'Duration of the batch so far', unit: 'ms' },
  { name: 'phase', address: 'D124:INT', title: '0 stopped, 1 filling, 2 heating, 3 mixing, 4 emptying' },
  { name: 'alarmCode', address: 'D125:UINT', title: '0 none, 1 set-point out of range, 2 tank full, 3 too hot' },
  { name: 'scans', address: 'D126:UDINT', title: 'Scans of the program: counts while the CPU is in RUN' },
  { name: 'product', address: 'D130:STRING(20)', title: 'Product' },
  { name: 'productJa', address: 'D140:STRING(20)', title: 'Product, in Japanese (Shift-JIS)', encoding: 'shift-jis' },
  { name: 'operator', address: 'D150:WSTRING(16)', title: 'Name of the operator (UTF-16)', writable: true },
] as const satisfies readonly TagRow[]

/** Names of the values of the demo plant. */
export type PlantTagName = (typeof ROWS)[number]['name']

function tagsOf(variant: PlantVariant): readonly PlantTag[] {
  const rows: readonly (TagRow & { readonly name: PlantTagName })[] = ROWS
  return rows.map(({ address, writable, ...row }) => ({
    ...row,
    address: typeof address === 'string' ? address : address[variant],
    writable: writable === true,
  }))
}

/** Every tag of the demo plant on each of the two demo PLCs. */
export const demoPlantTags: Readonly<Record<PlantVariant, readonly PlantTag[]>> = {
  'iq-r': tagsOf('iq-r'),
  'iq-f': tagsOf('iq-f'),
}

/** The tags that fit a profile: those of `iq-f` where inputs and outputs are octal, on whatever port. */
export function plantVariantOf(profile: ProfileId): PlantVariant {
  return profiles[profile].xyRadix === 8 ? 'iq-f' : 'iq-r'
}

/**
 * One tag.
 * @throws RequestError BAD_OPTION when there is no such tag
 */
export function plantTag(variant: PlantVariant, name: PlantTagName): PlantTag {
  const tag = demoPlantTags[variant].find((candidate) => candidate.name === name)
  if (tag === undefined) throw new RequestError('BAD_OPTION', `The demo plant has no ${String(name)}.`, 'name')
  return tag
}
