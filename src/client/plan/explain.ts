// What an item is, for people and editors: plain data.

import { type AddressOptions, formatDevice, formatParsedDevice } from '../../melsec/device/address'
import { type DeviceInfo, type DeviceUnit, deviceInfo, type Radix } from '../../melsec/device/device'
import type { Profile, ProfileId } from '../../melsec/profiles/profile'
import { formatType, wordsOf } from '../../value/value'
import { formatItem, type ParsedItem } from '../item/item'
import type { PlanProtocol } from './limit'
import { planRead } from './read'

/** An item that is a device. */
export interface DeviceExplanation {
  /** The item in its shortest spelling, e.g. `D100:REAL[10]`. */
  readonly text: string
  /** Name of the device, e.g. `D`. */
  readonly device: string
  /** The manual's term, e.g. `data register`. */
  readonly title: string
  /** What one device is. */
  readonly unit: DeviceUnit
  /** First and last device (or bit) of the item, e.g. `D100` and `D119`. */
  readonly first: string
  /** Last device (or bit) of the item, e.g. `D119`. */
  readonly last: string
  /** Size of the item: bits of BOOL and digits, words of everything else. */
  readonly size: { readonly count: number; readonly unit: 'bit' | 'word' }
  /** Radix of the device number. */
  readonly radix: Radix
  /** Type of each value, e.g. `REAL`. */
  readonly type: string
  /** Values of an array. */
  readonly count?: number
  /** Requests that read it; more than one: an array whose values may be of different moments. */
  readonly requests: number
  /**
   * Behind the last device that a CPU of the profile has as delivered. Parameters can give it more, so it is no refusal.
   */
  readonly beyond?: { readonly profile: ProfileId; readonly last: string }
  /** What one should know, e.g. that it is read by several requests. */
  readonly notes: readonly string[]
}

/**
 * What reading the item would do, without doing it.
 *
 * @throws RequestError when this PLC cannot be asked for it
 * @example explainItem(parseItem('D100:REAL[10]', options), protocol, options).last   // 'D119'
 */
export function explainItem(item: ParsedItem, protocol: PlanProtocol, options: AddressOptions): DeviceExplanation {
  const info = deviceInfo(item.address.device)
  const plan = planRead([item], protocol, { gap: 0, ...options })
  const { requests, notes } = plan.describe()
  const refusal = plan.errorOf(0)
  if (refusal !== undefined) throw refusal
  return {
    text: formatItem(item, options),
    device: info.name,
    title: info.title,
    unit: info.unit,
    first: firstOf(item, options),
    last: lastOf(item, info, options),
    size: sizeOf(item),
    radix: radixOf(item, info, options),
    type: formatType(item.type),
    ...(item.count === undefined ? {} : { count: item.count }),
    requests: requests.length,
    ...beyondOf(item, info, protocol.profile, options),
    notes: info.note === undefined ? notes : [...notes, info.note],
  }
}

/** The first device without the digits, which stand for a size and not for a place. */
function firstOf({ address, bit }: ParsedItem, options: AddressOptions): string {
  return formatParsedDevice({ address, ...(bit === undefined ? {} : { bit }) }, options)
}

function sizeOf({ type, digits, count = 1 }: ParsedItem): DeviceExplanation['size'] {
  if (digits !== undefined) return { count: 4 * digits * count, unit: 'bit' }
  return type.name === 'BOOL' ? { count, unit: 'bit' } : { count: wordsOf(type) * count, unit: 'word' }
}

/** Only of the CPU's own devices, and where the text says which they are. */
function beyondOf(
  item: ParsedItem,
  info: DeviceInfo,
  { id, ranges }: Profile,
  options: AddressOptions,
): Pick<DeviceExplanation, 'beyond'> {
  const { address } = item
  const points = ranges.points[info.name]
  const plain = address.extension === undefined && address.index === undefined && address.indirect !== true
  if (points === undefined || !plain || lastNumberOf(item, info) < points) return {}
  return { beyond: { profile: id, last: formatDevice({ ...address, number: points - 1 }, options) } }
}

/** Number of the last device. */
function lastNumberOf(item: ParsedItem, { unit }: DeviceInfo): number {
  const { address, bit } = item
  const { count } = sizeOf(item)
  if (bit !== undefined) return address.number + Math.floor((bit + count - 1) / 16)
  return address.number + (unit === 'doubleWord' ? (item.count ?? 1) : count) - 1
}

function lastOf(item: ParsedItem, info: DeviceInfo, options: AddressOptions): string {
  const { address, bit } = item
  const { count } = sizeOf(item)
  if (bit !== undefined) {
    const last = { address: { ...address, number: lastNumberOf(item, info) }, bit: (bit + count - 1) % 16 }
    return formatParsedDevice(last, options)
  }
  // The words behind an indirect address have no names.
  if (address.indirect === true) return formatDevice(address, options)
  return formatDevice({ ...address, number: lastNumberOf(item, info) }, options)
}

function radixOf({ address }: ParsedItem, { name }: DeviceInfo, options: AddressOptions): Radix {
  // Asked of the formatter, so that the rules about X, Y and ZR stand in one place.
  const { index: _, ...plain } = address
  const text = formatDevice({ ...plain, number: 15 }, options)
  const digits = text.slice(text.lastIndexOf(name) + name.length)
  return digits.startsWith('F') ? 16 : digits.startsWith('17') ? 8 : 10
}
