/** Items moved to other devices: for tables that serve many equal machines. */
import { shown } from '../../basics/show'
import { RequestError } from '../../errors'
import type { AddressOptions } from '../../melsec/device/address'
import { type DeviceName, deviceInfo, devices } from '../../melsec/device/device'
import { formatItem, parseItem } from './item'
import { LABEL_PREFIX } from './parts'

/** How far: every device by so many numbers, or each device by its own; one that is not named stays. */
export type DeviceOffset = number | { readonly [D in DeviceName]?: number }

/**
 * The item whose device has a number that is greater by the offset, in its shortest spelling. The number counts devices, whatever radix it is written
 * in; of buffer memory it is the address in its module. With offsets by device, labels written `label:Name` stay.
 *
 * @throws RequestError BAD_ADDRESS and so on for what is no item, OUT_OF_RANGE when there is no such device, BAD_OPTION for an offset that is no whole
 *   number or of no device, UNSUPPORTED for a label that is to move by a number
 * @example moveItem('D100:REAL[4]', 50, { xyRadix: 16 })       // 'D150:REAL[4]'
 * @example moveItem('X1F', { X: 1, D: 100 }, { xyRadix: 16 })  // 'X20'
 */
export function moveItem(item: string, offset: DeviceOffset, options: AddressOptions): string {
  checkOffset(offset)
  if (typeof offset === 'object' && LABEL_PREFIX.test(item)) return item
  const parsed = parseItem(item, options)
  const { device, number } = parsed.address
  const by = typeof offset === 'number' ? offset : (offset[device] ?? 0)
  if (by === 0) return item
  if (number + by < 0) {
    const first = `${deviceInfo(device).name}0`
    throw new RequestError('OUT_OF_RANGE', `${item} moved by ${by} is in front of ${first}.`, item)
  }
  const moved = formatItem({ ...parsed, address: { ...parsed.address, number: number + by } }, options)
  // It may end behind the last number there can be.
  parseItem(moved, options)
  return moved
}

const NAMES: ReadonlySet<string> = new Set(devices.map(({ name }) => name))

function checkOffset(offset: DeviceOffset): void {
  const offsets: unknown[] = typeof offset === 'object' && offset !== null ? Object.values(offset) : [offset]
  const bad = offsets.find((by) => !Number.isSafeInteger(by))
  if (offsets.includes(undefined) || bad !== undefined) {
    throw new RequestError('BAD_OPTION', `An offset is a whole number of devices, not ${shown(bad)}.`, 'offset')
  }
  const unknown = typeof offset === 'object' ? Object.keys(offset).find((name) => !NAMES.has(name)) : undefined
  if (unknown === undefined) return
  throw new RequestError('BAD_OPTION', `There is no device ${shown(unknown)} to move.`, 'offset')
}
