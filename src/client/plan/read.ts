/**
 * A prepared read of devices: see `planned-read.ts` for how it is run.
 */
import type { Words } from '../../value/value'
import type { ParsedItem, RefusedItem } from '../item/item'
import type { PlanProtocol } from './limit'
import { PlannedRead } from './planned-read'
import { ReadShape, type ReadShapeOptions, type ReadStep } from './read-shape'
import { type Place, valueAt } from './value'

/** Devices are read as words. */
export type DeviceRead = PlannedRead<Words, Place, ReadStep>

/**
 * The requests that read the items. Items that cannot be read keep their error; they do not harm the others.
 *
 * @param options.gap words that may be read in vain between two items to read them by one request
 * @example const plan = planRead(items, protocol, { gap: 64 }); const results = await plan.run(send, clock.time)
 */
export function planRead(
  items: readonly (ParsedItem | RefusedItem)[],
  protocol: PlanProtocol,
  options: ReadShapeOptions,
): DeviceRead {
  const texts = items.map(({ text }) => text)
  return new PlannedRead(texts, new ReadShape(items, protocol, options), valueAt)
}
