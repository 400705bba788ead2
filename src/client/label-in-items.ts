// Labels among the items of read and write: `label:Line1.Speed` beside `D100`.
import { ClosedError, PlcError, RequestError } from '../errors'
import type { CallOptions } from './call'
import type { Deadline } from './deadline'
import type { LabelItem } from './label-item'
import type { LabelAccess, LabelReadResult, LabelValue } from './labels'
import type { Item, ReadResult, WriteOptions, WriteResult } from './plan'

const PREFIX = /^\s*label:/i

/** What labels and devices are read and written with. */
export interface MixedAccess {
  readonly labels: Pick<LabelAccess, 'readList' | 'writeList'>
  readonly read: (items: readonly Item[], options: CallOptions | undefined) => Promise<ReadResult[]>
  readonly write: (entries: readonly Entry[], options: CallOptions & WriteOptions) => Promise<WriteResult[]>
  readonly deadline: (options: CallOptions | undefined) => Deadline
  /** ms since 1970 */
  readonly time: () => number
}

interface Entry {
  readonly item: Item
  readonly value: LabelValue
}

/** Whether the item says that it is a label. Programs without types pass anything. */
export function isLabelItem(item: Item | undefined): boolean {
  const text: unknown = typeof item === 'object' && item !== null ? item.address : item
  return typeof text === 'string' && PREFIX.test(text)
}

/** @throws RequestError BAD_OPTION for what only devices take */
function labelOf(item: Item): LabelItem {
  if (typeof item === 'string') return item.replace(PREFIX, '')
  const { address, count, ...others } = item
  const label = address.replace(PREFIX, '')
  const given = Object.entries(others).filter(([, value]) => value !== undefined)
  for (const [name] of given) {
    const message = `${address}: a label takes a count, but no ${name}: the PLC says its type, the client's format its encoding.`
    throw new RequestError('BAD_OPTION', message, name)
  }
  return count === undefined ? label : { label, count }
}

function textOf(item: Item): string {
  return typeof item === 'string' ? item : String(item?.address)
}

/** Reads the devices and, at the same time, the labels. */
export async function readWithLabels(
  items: readonly Item[],
  options: CallOptions | undefined,
  access: MixedAccess,
): Promise<ReadResult[]> {
  const wanted = items.map((item) => (isLabelItem(item) ? attempt(() => labelOf(item)) : undefined))
  const labels = wanted.flatMap((one) => (one === undefined || one instanceof PlcError ? [] : [one]))
  const devices = items.filter((_, at) => wanted[at] === undefined)
  const [deviceResults, labelResults] = await Promise.all([
    devices.length === 0 ? [] : access.read(devices, options),
    access.labels.readList(labels, options ?? {}),
  ])
  let device = 0
  let label = 0
  return items.map((item, at): ReadResult => {
    const one = wanted[at]
    if (one === undefined) return deviceResults[device++] as ReadResult
    if (one instanceof PlcError) return { item: textOf(item), ok: false, error: one, timestamp: access.time() }
    return itemResult(textOf(item), labelResults[label++] as LabelReadResult)
  })
}

function itemResult(item: string, result: LabelReadResult): ReadResult {
  const { timestamp } = result
  if (!result.ok) return { item, ok: false, error: result.error, timestamp }
  const { value, torn } = result
  return { item, ok: true, value, timestamp, ...(torn === undefined ? {} : { torn }) }
}

/** Writes in the order given; what stands behind a write of unknown outcome is not sent. */
export async function writeWithLabels(
  entries: readonly Entry[],
  options: CallOptions & WriteOptions,
  access: MixedAccess,
): Promise<WriteResult[]> {
  if (options.allOrNothing === true) {
    const message = 'allOrNothing cannot be kept with labels: their types are known only to the PLC.'
    throw new RequestError('BAD_OPTION', message, 'allOrNothing')
  }
  const deadline = access.deadline(options)
  const results: WriteResult[] = []
  for (const run of runsOf(entries)) {
    const unknown = results.find((result) => !result.ok && result.error.outcome === 'unknown')
    results.push(...(await writeRun(run, unknown, { ...options }, deadline, access)))
  }
  return results
}

/** Entries of one kind that follow one another. */
function runsOf(entries: readonly Entry[]): Entry[][] {
  const runs: Entry[][] = []
  for (const entry of entries) {
    const last = runs.at(-1)
    if (last?.[0] !== undefined && isLabelItem(last[0].item) === isLabelItem(entry?.item)) last.push(entry)
    else runs.push([entry])
  }
  return runs
}

async function writeRun(
  run: readonly Entry[],
  unknown: WriteResult | undefined,
  options: CallOptions & WriteOptions,
  deadline: Deadline,
  access: MixedAccess,
): Promise<WriteResult[]> {
  const failed = (error: PlcError) => run.map(({ item }): WriteResult => ({ item: textOf(item), ok: false, error }))
  if (unknown?.ok === false) {
    const message = 'It was not written: whether the write before it was carried out is not known.'
    return failed(new ClosedError('ABORTED', message, 'notSent', unknown.error))
  }
  const left = attempt(() => deadline.options('Writing'))
  if (left instanceof PlcError) return failed(left)
  const [first] = run
  if (!isLabelItem(first?.item)) return access.write(run, { ...options, ...left })
  const labels = run.map(({ item, value }) => ({ label: attempt(() => writtenLabelOf(item)), value }))
  const good = labels.flatMap(({ label, value }) => (typeof label === 'string' ? [[label, value] as const] : []))
  const written = await access.labels.writeList(good, left)
  let at = 0
  return run.map(({ item }, index): WriteResult => {
    const label = labels[index]?.label
    if (label instanceof PlcError) return { item: textOf(item), ok: false, error: label }
    const result = written[at++]
    return result?.ok === false
      ? { item: textOf(item), ok: false, error: result.error }
      : { item: textOf(item), ok: true }
  })
}

/** A list that is written says itself how many elements it has. */
function writtenLabelOf(item: Item): string {
  const label = labelOf(item)
  if (typeof label === 'string') return label
  const message = `${textOf(item)}: a label that is written takes no count; write a list of values.`
  throw new RequestError('BAD_OPTION', message, 'count')
}

function attempt<T>(run: () => T): T | PlcError {
  try {
    return run()
  } catch (error) {
    if (error instanceof PlcError) return error
    throw error
  }
}
